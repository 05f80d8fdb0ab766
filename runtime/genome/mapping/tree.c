/* Makes a tree of a derivation, and writes it as a table, as text and as JSON. */
#include "runtime/genome/mapping/tree.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/json.h"

void tn_tree_clear(tn_tree *tree)
{
    free(tree->nodes);
    *tree = (tn_tree){0};
}

tn_status tn_tree_make(const tn_event *events, size_t count, tn_tree *tree, tn_error *error)
{
    *tree = (tn_tree){0};
    if (count >= TN_TREE_NONE)
        return tn_fail(error, TN_LIMIT, E_DERIVATION_TOO_LONG, "the derivation has more steps than a tree can hold");
    tree->nodes = calloc(count + 1, sizeof *tree->nodes);
    uint32_t *last_child = calloc(count + 1, sizeof *last_child); /* by node; the last place is the roots' */
    if (!tree->nodes || !last_child) {
        free(last_child);
        tn_tree_clear(tree);
        return tn_fail_memory(error);
    }
    uint32_t open = TN_TREE_NONE;
    last_child[count] = TN_TREE_NONE;
    for (size_t i = 0; i < count; i++) {
        if (events[i].kind == TN_EVENT_PLACE)
            continue;
        if (events[i].kind == TN_EVENT_END) {
            tree->nodes[open].event_end = (uint32_t)i;
            open = tree->nodes[open].parent;
            continue;
        }
        uint32_t node = (uint32_t)tree->count++;
        uint32_t *last = &last_child[open == TN_TREE_NONE ? count : open];
        tree->nodes[node] = (tn_tree_node){(uint32_t)i, open, TN_TREE_NONE, TN_TREE_NONE, (uint32_t)count};
        if (*last != TN_TREE_NONE)
            tree->nodes[*last].next = node;
        else if (open != TN_TREE_NONE)
            tree->nodes[open].first_child = node;
        *last = node;
        last_child[node] = TN_TREE_NONE;
        if (events[i].kind == TN_EVENT_EXPAND)
            open = node;
    }
    free(last_child);
    return TN_OK;
}

/* ---- texts */

/* A text that holds line ends and quotes, on one line. */
static void write_plain(FILE *out, const char *text, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        if (text[i] == '\n')
            fputs("\\n", out);
        else if (text[i] == '\t')
            fputs("\\t", out);
        else if ((unsigned char)text[i] < 0x20 || text[i] == 0x7F)
            fprintf(out, "\\x%02x", (unsigned char)text[i]);
        else
            fputc(text[i], out);
    }
}

static void write_terminal(const tn_grammar *g, uint32_t index, FILE *out)
{
    const tn_terminal *terminal = &g->terminals[index];
    const char *text = g->texts + terminal->offset;
    char quote = memchr(text, '\'', terminal->length) ? '"' : '\'';
    fputc(quote, out);
    write_plain(out, text, terminal->length);
    fputc(quote, out);
}

void tn_production_write(const tn_grammar *g, uint32_t production, FILE *out)
{
    uint32_t ends[TN_GROUP_DEPTH]; /* of options, which have no word of their own at their end */
    size_t depth = 0;
    const char *between = "";
    for (uint32_t at = g->productions[production].words;; at++) {
        for (; depth && ends[depth - 1] == at; depth--)
            fputs(" ]", out);
        uint32_t word = g->words[at], argument = TN_WORD_ARGUMENT(word);
        if (TN_WORD_OP(word) == TN_WORD_DONE)
            return;
        fputs(between, out);
        between = " ";
        switch (TN_WORD_OP(word)) {
        case TN_WORD_TERMINAL:
            write_terminal(g, argument, out);
            break;
        case TN_WORD_RULE:
            fputs(tn_rule_name(g, argument), out);
            break;
        case TN_WORD_EDGE:
            fputs("Edge", out);
            break;
        case TN_WORD_SAME:
            fprintf(out, "Edge%c", (char)('X' + argument));
            break;
        case TN_WORD_REPEAT:
            fputs("{", out);
            break;
        case TN_WORD_AGAIN:
            fputs("}", out);
            break;
        case TN_WORD_MAYBE:
            fputs("[", out);
            ends[depth++] = at + 1 + argument;
            break;
        case TN_WORD_DONE:
            break;
        }
    }
}

/* ---- the table */

static void write_choice(const tn_grammar *g, const tn_event *event, FILE *out)
{
    switch ((tn_event_kind)event->kind) {
    case TN_EVENT_EXPAND:
        fprintf(out, "%s ::= ", tn_rule_name(g, event->symbol));
        tn_production_write(g, event->production, out);
        break;
    case TN_EVENT_PLACE:
        fprintf(out, "non-terminal %" PRIu64 " of %" PRIu64 ", %s", event->value + 1, event->modulus,
                tn_rule_name(g, event->symbol));
        break;
    case TN_EVENT_EDGE:
        if (event->letter)
            fprintf(out, "Edge%c is Edge%" PRIu64, event->letter, event->value);
        else
            fprintf(out, "Edge is Edge%" PRIu64, event->value);
        if (event->symbol)
            fputs(", a new type", out);
        break;
    case TN_EVENT_AGAIN:
        fprintf(out, "{ } once more, %" PRIu64 " > %u", event->value, event->symbol);
        break;
    case TN_EVENT_STOP:
        fprintf(out, "{ } ends after %u, %" PRIu64 " <= %u", event->symbol, event->value, event->symbol);
        break;
    case TN_EVENT_TAKE:
        fputs("[ ] taken", out);
        break;
    case TN_EVENT_SKIP:
        fputs("[ ] left out", out);
        break;
    default:
        break;
    }
}

static void write_traced(const tn_grammar *grammar, const tn_event *event, FILE *out)
{
    if (event->kind == TN_EVENT_REPAIR)
        fprintf(out, "repair: Edge%" PRIu64 " has no rule\n", event->value);
    if (event->read == TN_NO_READ)
        return;
    char remainder[48];
    snprintf(remainder, sizeof remainder, "%" PRIu64 " = %" PRIu64, event->modulus, event->value);
    fprintf(out, "%6" PRIu64 "  %20" PRIu64 "  %14s  ", event->read + 1, event->codon, remainder);
    write_choice(grammar, event, out);
    fputc('\n', out);
}

static int by_read(const void *one, const void *other)
{
    const tn_event *a = *(const tn_event *const *)one, *b = *(const tn_event *const *)other;
    return (a->read > b->read) - (a->read < b->read);
}

/* Events that read, in the order in which they did: that of the text only where the leftmost is replaced each time. */
static bool write_by_read(const tn_grammar *grammar, const tn_event *events, size_t count, FILE *out)
{
    const tn_event **reading = malloc((count + 1) * sizeof *reading);
    size_t found = 0;
    if (!reading)
        return false;
    for (size_t i = 0; i < count; i++)
        if (events[i].read != TN_NO_READ)
            reading[found++] = &events[i];
    qsort(reading, found, sizeof *reading, by_read);
    for (size_t i = 0; i < found && !ferror(out); i++)
        write_traced(grammar, reading[i], out);
    free(reading);
    return true;
}

bool tn_trace_write(const tn_grammar *grammar, const tn_event *events, size_t count, FILE *out)
{
    fprintf(out, "%6s  %20s  %14s  %s\n", "gene", "value", "mod", "chooses");
    if (count && events[0].kind == TN_EVENT_PLACE)
        return write_by_read(grammar, events, count, out) && !ferror(out);
    for (size_t i = 0; i < count && !ferror(out); i++)
        write_traced(grammar, &events[i], out);
    return !ferror(out);
}

/* ---- the tree */

static void write_node(const tn_grammar *g, const tn_event *event, FILE *out)
{
    switch ((tn_event_kind)event->kind) {
    case TN_EVENT_EXPAND:
        fputs(tn_rule_name(g, event->symbol), out);
        break;
    case TN_EVENT_TERMINAL:
        write_terminal(g, event->symbol, out);
        break;
    case TN_EVENT_EDGE:
        fprintf(out, "Edge%" PRIu64, event->value);
        if (event->letter)
            fprintf(out, " (Edge%c)", event->letter);
        break;
    case TN_EVENT_REPAIR:
        fprintf(out, "repair of Edge%" PRIu64, event->value);
        break;
    default:
        write_choice(g, event, out);
        break;
    }
    if (event->read != TN_NO_READ)
        fprintf(out, "  %" PRIu64 " mod %" PRIu64 " = %" PRIu64, event->codon, event->modulus, event->value);
    fputc('\n', out);
}

void tn_tree_walk(const tn_tree *tree, tn_tree_visit *enter, tn_tree_visit *leave, void *context)
{
    uint32_t node = tree->count ? 0 : TN_TREE_NONE, depth = 0;
    while (node != TN_TREE_NONE) {
        const tn_tree_node *n = &tree->nodes[node];
        enter(context, node, depth);
        if (n->first_child != TN_TREE_NONE) {
            node = n->first_child;
            depth++;
            continue;
        }
        for (;;) {
            n = &tree->nodes[node];
            if (leave)
                leave(context, node, depth);
            if (n->next != TN_TREE_NONE) {
                node = n->next;
                break;
            }
            node = n->parent;
            if (node == TN_TREE_NONE)
                return;
            depth--;
        }
    }
}

typedef struct writer {
    const tn_grammar *grammar;
    const tn_event *events;
    const tn_tree *tree;
    FILE *out;    /* as text, */
    tn_json json; /* or as JSON */
} writer;

static void enter_text(void *context, uint32_t node, uint32_t depth)
{
    const writer *w = context;
    for (uint32_t i = 0; i < depth; i++)
        fputs("  ", w->out);
    write_node(w->grammar, &w->events[w->tree->nodes[node].event], w->out);
}

bool tn_tree_write_text(const tn_grammar *grammar, const tn_event *events, const tn_tree *tree, FILE *out)
{
    writer w = {.grammar = grammar, .events = events, .tree = tree, .out = out};
    tn_tree_walk(tree, enter_text, NULL, &w);
    return !ferror(out);
}

/* Numbers of 64 bits are texts: readers of JSON round them. */
static void json_choice(tn_json *json, const tn_event *event)
{
    const struct {
        const char *key;
        uint64_t value;
    } parts[] = {{"codon", event->codon}, {"modulus", event->modulus}, {"choice", event->value}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        char digits[24];
        snprintf(digits, sizeof digits, "%" PRIu64, parts[i].value);
        tn_json_string(json, parts[i].key, digits);
    }
}

static void enter_json(void *context, uint32_t node, uint32_t depth)
{
    writer *w = context;
    const tn_event *event = &w->events[w->tree->nodes[node].event];
    static const char *const kinds[] = {
        [TN_EVENT_AGAIN] = "again", [TN_EVENT_STOP] = "stop", [TN_EVENT_TAKE] = "take", [TN_EVENT_SKIP] = "skip"};
    (void)depth;
    tn_json_object(&w->json, NULL);
    switch ((tn_event_kind)event->kind) {
    case TN_EVENT_EXPAND:
        tn_json_string(&w->json, "symbol", tn_rule_name(w->grammar, event->symbol));
        tn_json_count(&w->json, "depth", event->depth);
        break;
    case TN_EVENT_TERMINAL:
        tn_json_string(&w->json, "terminal", w->grammar->texts + w->grammar->terminals[event->symbol].offset);
        break;
    case TN_EVENT_EDGE:
        tn_json_count(&w->json, "edge", event->value);
        if (event->letter)
            tn_json_bytes(&w->json, "letter", (const char[]){(char)event->letter}, 1);
        break;
    case TN_EVENT_REPAIR:
        tn_json_count(&w->json, "repair", event->value);
        break;
    default:
        tn_json_string(&w->json, "loop", kinds[event->kind]);
        break;
    }
    if (event->read != TN_NO_READ)
        json_choice(&w->json, event);
    if (event->kind == TN_EVENT_EXPAND)
        tn_json_list(&w->json, "children");
}

static void leave_json(void *context, uint32_t node, uint32_t depth)
{
    writer *w = context;
    (void)depth;
    if (w->events[w->tree->nodes[node].event].kind == TN_EVENT_EXPAND)
        tn_json_list_end(&w->json);
    tn_json_object_end(&w->json);
}

bool tn_tree_write_json(const tn_grammar *grammar, const tn_event *events, const tn_tree *tree, FILE *out)
{
    writer w = {.grammar = grammar, .events = events, .tree = tree, .json = tn_json_file(out, TN_JSON_TIGHT)};
    tn_json_list(&w.json, NULL);
    tn_tree_walk(tree, enter_json, leave_json, &w);
    tn_json_list_end(&w.json);
    tn_json_end_line(&w.json);
    return !ferror(out);
}
