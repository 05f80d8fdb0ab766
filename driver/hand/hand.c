/* Reads and does what a person decides of a population: who is bred, and who is inserted, edited or taken out. */
#include "driver/hand/hand.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/buffer.h"
#include "runtime/genome/mapping/invert.h"

/* ---- parents */

void tn_choices_clear(tn_choices *choices)
{
    free(choices->items);
    *choices = (tn_choices){0};
}

static bool read_number(const char **at, uint64_t *number)
{
    char *end;
    if (**at < '0' || **at > '9')
        return false;
    *number = strtoull(*at, &end, 10);
    *at = end;
    return true;
}

/* A weight is above 0 and at most 1. */
static bool read_weight(const char **at, double *weight)
{
    char *end;
    if (!strchr("0123456789.", **at))
        return false;
    *weight = strtod(*at, &end);
    *at = end;
    return *weight > 0 && *weight <= 1;
}

/* One word, up to `end`. */
static bool read_word(const char *at, const char *end, tn_chosen *chosen, uint64_t *times)
{
    *chosen = (tn_chosen){.weight = 1};
    *times = 1;
    chosen->by_id = *at == '#';
    at += chosen->by_id;
    if (!read_number(&at, &chosen->number) || (!chosen->by_id && chosen->number-- == 0))
        return false;
    while (at < end) {
        char sign = *at++;
        bool read = sign == '*' ? read_number(&at, times) : sign == '@' ? read_weight(&at, &chosen->weight) : false;
        if (!read)
            return false;
    }
    return at == end && *times >= 1 && *times <= TN_CHOICE_TURNS_MAX;
}

tn_status tn_choices_read(const char *line, tn_choices *choices, char wrong[40], tn_error *error)
{
    static const char between[] = " ,\t\r\n";
    choices->count = 0;
    for (const char *at = line + strspn(line, between); *at; at += strspn(at, between)) {
        size_t size = strcspn(at, between);
        tn_chosen chosen;
        uint64_t times;
        if (!read_word(at, at + size, &chosen, &times)) {
            snprintf(wrong, 40, "%.*s", (int)(size < 39 ? size : 39), at);
            return tn_fail(error, TN_INVALID, E_NO_INDIVIDUAL, "`%s` names no parent", wrong);
        }
        if (!tn_array_reserve(&choices->items, &choices->capacity, choices->count, (size_t)times,
                              sizeof *choices->items))
            return tn_fail_memory(error);
        for (uint64_t i = 0; i < times; i++)
            choices->items[choices->count++] = chosen;
        at += size;
    }
    return TN_OK;
}

char *tn_choices_text(const tn_chosen *items, size_t count)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        char weight[TN_NUMBER_TEXT_SIZE];
        fprintf(out, "%s%s%" PRIu64, i ? " " : "", items[i].by_id ? "#" : "", items[i].number + !items[i].by_id);
        if (items[i].weight != 1)
            fprintf(out, "@%s", tn_number_text(items[i].weight, weight));
    }
    bool written = !ferror(out);
    if (fclose(out) == 0 && written)
        return text;
    free(text);
    return NULL;
}

bool tn_choices_have_ids(const char *text)
{
    return strchr(text, '#') != NULL;
}

/* ---- changes */

static const char worst_place[] = "in the worst place", room[] = "where there is room";

bool tn_by_hand(const char *kind)
{
    return strcmp(kind, "insert") == 0 || strcmp(kind, "edit") == 0 || strcmp(kind, "remove") == 0;
}

/* ---- events as text */

static char *text_of(const char *place, const tn_genome *genome)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fprintf(out, "%s:", place);
    for (size_t i = 0; i < genome->count; i++)
        fprintf(out, " %" PRIu64, genome->codons[i]);
    bool written = !ferror(out);
    if (fclose(out) == 0 && written)
        return text;
    free(text);
    return NULL;
}

char *tn_by_hand_text(uint64_t out, const tn_genome *genome)
{
    char place[60];
    snprintf(place, sizeof place, "in place of %" PRIu64, out);
    return text_of(out == TN_NO_PARENT ? worst_place : place, genome);
}

static tn_status not_an_event(const char *text, tn_error *error)
{
    return tn_fail(error, TN_INVALID, E_RUN_DATABASE, "the run's database has an event that is none: `%.80s`", text);
}

/* Where the text says that the genome goes: *out is a member's id, or TN_NO_PARENT where there is room. */
static bool read_place(const tn_evolution *evolution, const char *text, uint64_t *out)
{
    static const char before[] = "in place of ";
    char *end;
    if (strncmp(text, worst_place, strlen(worst_place)) == 0) {
        *out = tn_evolution_worst(evolution);
        return true;
    }
    *out = TN_NO_PARENT;
    if (strncmp(text, room, strlen(room)) == 0)
        return true;
    if (strncmp(text, before, strlen(before)) != 0)
        return false;
    *out = strtoull(text + strlen(before), &end, 10);
    return *end == ':';
}

static tn_status insert(tn_evolution *evolution, bool edited, const char *text, char **said, tn_error *error)
{
    tn_genome genome = {0};
    uint64_t out;
    const char *codons = strchr(text, ':');
    if (!codons || !read_place(evolution, text, &out))
        return not_an_event(text, error);
    tn_status status = tn_genome_read(codons + 1, strlen(codons + 1), &genome, error);
    if (status == TN_OK)
        status = tn_evolution_insert(evolution, &genome, out, edited ? out : TN_NO_PARENT, error);
    if (status == TN_OK && !(*said = out == TN_NO_PARENT ? text_of(room, &genome) : tn_by_hand_text(out, &genome)))
        status = tn_fail_memory(error);
    tn_genome_clear(&genome);
    return status;
}

tn_status tn_by_hand_do(tn_evolution *evolution, const char *kind, const char *text, char **said, tn_error *error)
{
    char *end;
    *said = NULL;
    if (strcmp(kind, "remove") != 0)
        return insert(evolution, strcmp(kind, "edit") == 0, text, said, error);
    uint64_t id = strtoull(text, &end, 10);
    if (end == text || *end)
        return not_an_event(text, error);
    tn_status status = tn_evolution_remove(evolution, id, error);
    if (status == TN_OK && !(*said = strdup(text)))
        status = tn_fail_memory(error);
    return status;
}

/* ---- sentences */

/* How many bytes the next token of a rewrite system has. A name may end in an age: `Edge0_i+1`. */
static size_t token_size(const char *text, size_t size)
{
    size_t name = 0;
    while (name < size && (isalnum((unsigned char)text[name]) || text[name] == '_' || text[name] == '.'))
        name++;
    bool age = name >= 2 && text[name - 2] == '_' && text[name - 1] == 'i' && name + 1 < size;
    if (age && (text[name] == '+' || text[name] == '-') && text[name + 1] == '1')
        return name + 2;
    if (name)
        return name;
    return size >= 2 && text[0] == '-' && text[1] == '>' ? 2 : 1;
}

static bool is_comment(const char *text, size_t size)
{
    return text[0] == '#' || (size >= 2 && text[0] == '/' && text[1] == '/');
}

/* A rewrite system in one line: tokens with a blank between them, statements with ` ; `. A line that begins with `->`
 * goes on with the rule before it. */
static void write_line(const char *text, size_t size, FILE *out)
{
    bool begun = false, ends = false;
    for (size_t at = 0; at < size;) {
        size_t token = token_size(text + at, size - at);
        if (is_comment(text + at, size - at)) {
            const char *end = memchr(text + at, '\n', size - at);
            at = end ? (size_t)(end - text) : size;
            continue;
        }
        if (text[at] == ';' || text[at] == '\n') {
            ends = begun;
        } else if (!isspace((unsigned char)text[at])) {
            bool goes_on = token == 2 && text[at] == '-' && text[at + 1] == '>';
            fputs(ends && !goes_on ? " ; " : begun ? " " : "", out);
            fwrite(text + at, 1, token, out);
            begun = true;
            ends = false;
        }
        at += token;
    }
}

/* The statements of the line again: rules (or what is none of them) in their order. */
static void write_statements(const char *line, bool rules, FILE *out)
{
    for (const char *at = line; *at;) {
        const char *end = strstr(at, " ; ");
        size_t size = end ? (size_t)(end - at) : strlen(at);
        bool is_rule = at == line || memmem(at, size, "->", 2);
        if (is_rule == rules)
            fprintf(out, "%s%.*s", at == line ? "" : " ; ", (int)size, at);
        at = end ? end + 3 : at + size;
    }
}

/* The line with its rules first, as many grammars write them. */
static void write_rules_first(const char *line, FILE *out)
{
    write_statements(line, true, out);
    write_statements(line, false, out);
}

static char *line_of(const char *text, size_t size, bool rules_first)
{
    char *line = NULL;
    size_t length;
    FILE *out = open_memstream(&line, &length);
    if (!out)
        return NULL;
    if (rules_first)
        write_rules_first(text, out);
    else
        write_line(text, size, out);
    bool written = !ferror(out);
    if (fclose(out) == 0 && written)
        return line;
    free(line);
    return NULL;
}

static tn_status find_genome(const tn_by_hand_language *l, const char *sentence, tn_genome *genome, tn_error *error)
{
    tn_invert_options options = {.max_depth = l->settings->mapping.max_depth,
                                 .position_independent = l->settings->mapping.position_independent,
                                 .watch = l->settings->watch};
    tn_status status = tn_invert(l->grammar, sentence, strlen(sentence), &options, genome, error);
    if (status != TN_OK && error->column)
        error->line = 1;
    return status;
}

tn_status tn_by_hand_genome(const tn_by_hand_language *l, const char *text, size_t size, tn_genome *genome,
                            char **sentence, tn_error *error)
{
    *sentence = NULL;
    if (!l->grammar) {
        tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "only sentences of a grammar can be inserted into a run");
        tn_error_help(error, "a form that is a file of its own can be a parent of another run's study");
        return TN_INVALID;
    }
    while (!l->rewrites && size && text[size - 1] == '\n')
        size--;
    *sentence = l->rewrites ? line_of(text, size, false) : strndup(text, size);
    if (!*sentence)
        return tn_fail_memory(error);
    tn_status status = find_genome(l, *sentence, genome, error);
    if (status != TN_INVALID || !l->rewrites)
        return status;
    char *ordered = line_of(*sentence, 0, true);
    tn_error other;
    if (!ordered)
        return tn_fail_memory(error);
    if (find_genome(l, ordered, genome, &other) == TN_OK)
        status = TN_OK;
    free(ordered);
    return status;
}
