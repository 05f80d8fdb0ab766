/* Checks a grammar (.bnf): terminals, names, rules that never end, what cannot be reached, what repair needs. */
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "compiler/bnf/ast.h"

/* ==== terminals of .bnf files. In ge, the pieces between two non-terminals are one terminal, white space and all, and
 * escapes are read as PonyGE2 reads them; in genr8, each token is one */

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}

static bool is_piece(const tn_bnf_item *item)
{
    return item->kind == TN_BNF_PLAIN || item->kind == TN_BNF_QUOTED || item->kind == TN_BNF_NEWLINE;
}

/* ---- escapes */

typedef struct piece_writer {
    tn_bnf_reader *reader;
    char *out; /* room for as many bytes as were read, and two for each \x */
    size_t size;
    tn_span span; /* of the piece */
} piece_writer;

static void put_character(piece_writer *w, uint32_t c)
{
    if (c < 0x80) {
        w->out[w->size++] = (char)c;
    } else if (c < 0x800) {
        w->out[w->size++] = (char)(0xC0 | c >> 6);
        w->out[w->size++] = (char)(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
        w->out[w->size++] = (char)(0xE0 | c >> 12);
        w->out[w->size++] = (char)(0x80 | (c >> 6 & 0x3F));
        w->out[w->size++] = (char)(0x80 | (c & 0x3F));
    } else {
        w->out[w->size++] = (char)(0xF0 | c >> 18);
        w->out[w->size++] = (char)(0x80 | (c >> 12 & 0x3F));
        w->out[w->size++] = (char)(0x80 | (c >> 6 & 0x3F));
        w->out[w->size++] = (char)(0x80 | (c & 0x3F));
    }
}

static void bad_escape(piece_writer *w, const char *what)
{
    tn_diagnostic *diagnostic = tn_report(w->reader->diagnostics, E_GRAMMAR_ESCAPE, w->span, "%s", what);
    tn_help(w->reader->diagnostics, diagnostic, "a backslash itself is written \\\\");
}

static int digit(char c, int base)
{
    int value = c >= '0' && c <= '9'   ? c - '0'
                : c >= 'a' && c <= 'f' ? c - 'a' + 10
                : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                       : base;
    return value < base ? value : -1;
}

/* Reads up to `most` digits; their number in *count. */
static uint32_t read_digits(const char *text, size_t left, size_t most, int base, size_t *count)
{
    uint32_t value = 0;
    for (*count = 0; *count < most && *count < left && digit(text[*count], base) >= 0; ++*count)
        value = value * (uint32_t)base + (uint32_t)digit(text[*count], base);
    return value;
}

static void put_code(piece_writer *w, uint32_t code)
{
    if (code == TN_CODE_NONE)
        bad_escape(w, "a terminal cannot hold the character 0");
    else if (code > 0x10FFFF || (code >= 0xD800 && code < 0xE000))
        bad_escape(w, "there is no character of that number");
    else
        put_character(w, code);
}

/* Reads the escape that starts at text[0] == '\\'; returns its length. */
static size_t read_escape(piece_writer *w, const char *text, size_t left)
{
    static const char letters[] = "abfnrtv\\'\"", values[] = "\a\b\f\n\r\t\v\\'\"";
    if (left < 2) {
        bad_escape(w, "this text ends in a single backslash");
        return 1;
    }
    const char *letter = text[1] ? strchr(letters, text[1]) : NULL;
    if (letter) {
        w->out[w->size++] = values[letter - letters];
        return 2;
    }
    size_t count, wanted = text[1] == 'x' ? 2 : text[1] == 'u' ? 4 : text[1] == 'U' ? 8 : 0;
    if (wanted) {
        uint32_t code = read_digits(text + 2, left - 2, wanted, 16, &count);
        if (count < wanted)
            bad_escape(w, "an escape has too few hexadecimal digits: \\xHH, \\uHHHH or \\UHHHHHHHH");
        else
            put_code(w, code);
        return 2 + count;
    }
    uint32_t code = read_digits(text + 1, left - 1, 3, 8, &count);
    if (count) {
        put_code(w, code);
        return 1 + count;
    }
    w->out[w->size++] = '\\'; /* unknown ones stay as they are */
    return 1;
}

static void put_piece(piece_writer *w, const tn_bnf_item *item)
{
    w->span = item->span;
    const char *text = item->text.text;
    for (size_t i = 0; i < item->text.length;) {
        if (item->kind == TN_BNF_NEWLINE) {
            if (text[i] == '\n' || (text[i] == '\r' && !(i + 1 < item->text.length && text[i + 1] == '\n')))
                w->out[w->size++] = '\n';
            i++;
        } else if (text[i] == '\\') {
            i += read_escape(w, text + i, item->text.length - i);
        } else {
            w->out[w->size++] = text[i++];
        }
    }
}

/* ---- ge: pieces to terminals */

/* White space at an alternative's ends does not count, unless it is quoted. */
static void trim_begin(tn_bnf_items *items)
{
    tn_bnf_item *item;
    while ((item = items->first) && (item->kind == TN_BNF_PLAIN || item->kind == TN_BNF_NEWLINE)) {
        while (item->text.length && is_space(item->text.text[0])) {
            item->text.text++;
            item->text.length--;
        }
        if (item->text.length)
            return;
        items->first = item->next;
    }
    if (!items->first)
        items->last = NULL;
}

static void trim_end(tn_bnf_items *items)
{
    tn_bnf_item *keep = NULL; /* the last that is not white space */
    for (tn_bnf_item *item = items->first; item; item = item->next) {
        bool blank = item->kind == TN_BNF_NEWLINE;
        if (item->kind == TN_BNF_PLAIN) {
            blank = true;
            for (size_t i = 0; i < item->text.length && blank; i++)
                blank = is_space(item->text.text[i]);
        }
        if (!blank)
            keep = item;
    }
    items->last = keep;
    if (!keep) {
        items->first = NULL;
        return;
    }
    keep->next = NULL;
    while (keep->kind == TN_BNF_PLAIN && keep->text.length && is_space(keep->text.text[keep->text.length - 1]))
        keep->text.length--;
}

/* The pieces from `first` up to the next non-terminal, as one terminal, which takes the place of `first`. */
static void merge_pieces(tn_bnf_reader *reader, tn_bnf_item *first)
{
    size_t size = 0;
    tn_bnf_item *end = first;
    tn_span span = first->span;
    for (; end && is_piece(end); end = end->next) {
        size += end->text.length;
        span = tn_span_join(span, end->span);
    }
    piece_writer w = {.reader = reader, .out = tn_arena_alloc(reader->arena, size + 4)};
    if (!w.out)
        return;
    for (const tn_bnf_item *item = first; item != end; item = item->next)
        put_piece(&w, item);
    first->kind = TN_BNF_TERMINAL;
    first->text = (tn_bnf_text){w.out, w.size};
    first->span = span;
    first->next = end;
}

static tn_bnf_item *range_item(tn_bnf_reader *reader, tn_span span, uint32_t value)
{
    char digits[12];
    int length = 0;
    do
        digits[11 - ++length] = (char)('0' + value % 10);
    while (value /= 10);
    char *copy = tn_arena_copy(reader->arena, digits + 11 - length, (size_t)length);
    return copy ? tn_bnf_item_new(reader, TN_BNF_TERMINAL, span, (tn_bnf_text){copy, (size_t)length}) : NULL;
}

/* What PonyGE2 calls the numbers of a data set: how many columns are given, and how many different values there are in
 * those and in the column wanted. */
static const char *const data_words[TN_BNF_DATA] = {"dataset_n_vars", "dataset_n_is", "dataset_n_os"};

/* The number behind GE_RANGE:, and how many bytes say it; 0 bytes where none is known. */
static uint32_t read_range(const tn_bnf_reader *reader, const char *text, size_t left, size_t *count)
{
    for (size_t i = 0; i < TN_BNF_DATA; i++) {
        *count = strlen(data_words[i]);
        if (reader->ast.data[i] && left >= *count && memcmp(text, data_words[i], *count) == 0)
            return reader->ast.data[i];
    }
    return read_digits(text, left, 9, 10, count);
}

static void bad_range(tn_bnf_reader *reader, const tn_bnf_item *item, size_t length)
{
    const char *text = item->text.text + length;
    size_t left = item->text.length - length, size = 0;
    tn_span span = {item->span.file, item->span.begin, item->span.begin + (uint32_t)item->text.length};
    while (size < left && !is_space(text[size]))
        size++;
    for (size_t i = 0; i < TN_BNF_DATA; i++) {
        if (strlen(data_words[i]) != size || memcmp(text, data_words[i], size) != 0)
            continue;
        tn_diagnostic *diagnostic =
            tn_report(reader->diagnostics, E_GRAMMAR_RANGE, span,
                      "%s is a number of a data set, and there are no data here", data_words[i]);
        tn_help(reader->diagnostics, diagnostic,
                "evolve a study with this grammar and a line `fit \"DATA.csv\"`, or write the number above the first "
                "rule: `%s 5`",
                tn_bnf_data_directives[i]);
        return;
    }
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, E_GRAMMAR_RANGE, span, "GE_RANGE takes a whole number of up to nine digits");
    tn_help(reader->diagnostics, diagnostic,
            "GE_RANGE:3 stands for 0 | 1 | 2; numbers of a data set are dataset_n_vars, dataset_n_is and "
            "dataset_n_os");
}

/* `GE_RANGE:n` at the start of an alternative stands for the alternatives 0 to n-1. Returns false if this is none.
 */
static bool expand_range(tn_bnf_reader *reader, tn_bnf_rule *rule, const tn_bnf_alternative *from,
                         tn_bnf_alternatives *kept)
{
    static const char word[] = "GE_RANGE:";
    size_t length = sizeof word - 1, count;
    const tn_bnf_item *item = from->items.first;
    if (!item || item->kind != TN_BNF_PLAIN || item->text.length < length || memcmp(item->text.text, word, length) != 0)
        return false;
    tn_span span = {item->span.file, item->span.begin, item->span.begin + (uint32_t)item->text.length};
    uint32_t top = read_range(reader, item->text.text + length, item->text.length - length, &count);
    bool word_goes_on = length + count < item->text.length && !is_space(item->text.text[length + count]);
    rule->broken |= count == 0 || word_goes_on || top > TN_BNF_PRODUCTIONS_MAX;
    if (count == 0 || word_goes_on) {
        bad_range(reader, item, length);
        return true;
    }
    if (top > TN_BNF_PRODUCTIONS_MAX) {
        tn_report(reader->diagnostics, E_GRAMMAR_TOO_LARGE, span,
                  "GE_RANGE:%u makes more than %u alternatives, the limit", top, TN_BNF_PRODUCTIONS_MAX);
        return true;
    }
    if (item->next || length + count < item->text.length)
        tn_report(reader->diagnostics, W_GRAMMAR_RANGE_REST, from->span,
                  "what follows GE_RANGE:%u in its alternative is dropped", top);
    for (uint32_t value = 0; value < top; value++) {
        tn_bnf_items items = tn_bnf_append((tn_bnf_items){0}, range_item(reader, span, value));
        *kept = tn_bnf_next(*kept, tn_bnf_alternative_new(reader, from->span, items), false);
    }
    return true;
}

/* Warns about text that looks like something else. In quotes it is certainly text. line_ends: before it. */
static void warn_of_text(tn_bnf_reader *reader, const tn_bnf_item *item, size_t line_ends)
{
    if (item->kind != TN_BNF_PLAIN)
        return;
    const char *looks = memmem(item->text.text, item->text.length, "::=", 3)  ? "rule"
                        : line_ends > 0 && tn_bnf_names_directive(item->text) ? "directive"
                        : line_ends > 1                                       ? "note"
                                                                              : NULL;
    if (!looks)
        return;
    tn_diagnostic *diagnostic = tn_report(reader->diagnostics, W_GRAMMAR_TEXT, item->span,
                                          "this looks like a %s, but is text of the rule above", looks);
    tn_help(reader->diagnostics, diagnostic, "%s",
            *looks == 'r'
                ? "a rule is written `<name> ::= one | other`, no blanks in its name; quote what is to be text"
            : *looks == 'd' ? "directives stand above the first rule; quote what is to be text"
                            : "a line of remarks begins with `#`; quote what is to be text");
}

static size_t count_line_ends(const tn_bnf_item *item)
{
    size_t count = 0;
    for (size_t i = 0; i < item->text.length; i++)
        count += item->text.text[i] == '\n' ||
                 (item->text.text[i] == '\r' && (i + 1 == item->text.length || item->text.text[i + 1] != '\n'));
    return count;
}

/* An empty line begins a note, which goes on to the end of the alternative: some keep notes behind the last rule. */
static void make_ge(tn_bnf_reader *reader, tn_bnf_alternative *alternative)
{
    size_t line_ends = 0;
    bool begun = false, noted = false;
    for (tn_bnf_item *item = alternative->items.first; item; item = item->next) {
        if (item->kind == TN_BNF_NEWLINE) {
            line_ends += count_line_ends(item);
            continue;
        }
        bool note = begun && !noted && line_ends > 1;
        warn_of_text(reader, item, note ? line_ends : line_ends > 0);
        noted |= note;
        begun = true;
        line_ends = 0;
    }
    for (tn_bnf_item *item = alternative->items.first; item; item = item->next)
        if (is_piece(item))
            merge_pieces(reader, item);
}

/* ---- genr8: tokens to terminals */

static void bad_token(tn_bnf_reader *reader, const tn_bnf_item *item, const char *what)
{
    tn_diagnostic *diagnostic = tn_report(reader->diagnostics, E_GRAMMAR_TOKEN, item->span, "%s", what);
    tn_help(reader->diagnostics, diagnostic, "%s", tn_bnf_token_help);
}

static void check_token(tn_bnf_reader *reader, const tn_bnf_item *item)
{
    tn_bnf_text text = item->text;
    const char *open = memchr(text.text, '<', text.length);
    if (text.text[0] == '\'' || text.text[0] == '"')
        return; /* has been reported (tn_bnf_open_quote) */
    if (memchr(text.text, '{', text.length) || memchr(text.text, '}', text.length) ||
        memchr(text.text, '[', text.length) || memchr(text.text, ']', text.length) ||
        memchr(text.text, '|', text.length))
        bad_token(reader, item, "a brace, bracket or bar sticks to other text");
    else if (open && memchr(open, '>', text.length - (size_t)(open - text.text)) && text.length > 2)
        bad_token(reader, item, "a non-terminal sticks to other text");
}

static void check_edge(tn_bnf_reader *reader, const tn_bnf_item *item)
{
    if (item->text.length > 4 && memcmp(item->text.text, "Edge", 4) == 0 && digit(item->text.text[4], 10) >= 0)
        bad_token(reader, item,
                  "an edge with a number of its own: the genome draws the numbers, write Edge, EdgeX, EdgeY or EdgeZ");
}

static void make_genr8(tn_bnf_reader *reader, tn_bnf_items items)
{
    for (tn_bnf_item *item = items.first; item; item = item->next) {
        if (item->kind == TN_BNF_PLAIN)
            check_token(reader, item);
        warn_of_text(reader, item, 1);
        if (is_piece(item)) {
            check_edge(reader, item);
            item->kind = TN_BNF_TERMINAL;
        }
        make_genr8(reader, item->body);
    }
}

/* ---- all */

static void make_rule(tn_bnf_reader *reader, tn_bnf_rule *rule)
{
    bool genr8 = reader->ast.dialect == TN_DIALECT_GENR8;
    tn_bnf_alternatives kept = {0};
    for (tn_bnf_alternative *a = rule->alternatives.first, *next; a; a = next) {
        next = a->next;
        a->next = NULL;
        if (!genr8) {
            trim_begin(&a->items);
            trim_end(&a->items);
        }
        if (!genr8 && expand_range(reader, rule, a, &kept))
            continue;
        if (!a->items.first) {
            if (a->beside_comment || rule->alternatives.count == 1)
                continue;
            tn_diagnostic *diagnostic =
                tn_report(reader->diagnostics, W_GRAMMAR_EMPTY_ALTERNATIVE, a->span, "an empty alternative is dropped");
            if (!genr8)
                tn_help(reader->diagnostics, diagnostic, "to write nothing to the sentence, say so: \"\"");
            continue;
        }
        if (genr8)
            make_genr8(reader, a->items);
        else
            make_ge(reader, a);
        kept = tn_bnf_next(kept, a, false);
    }
    rule->alternatives = kept;
    if (!kept.first && !rule->broken) {
        rule->broken = true;
        tn_diagnostic *diagnostic =
            tn_report(reader->diagnostics, E_GRAMMAR_EMPTY_RULE, rule->name_span, "the rule %.*s has no alternatives",
                      (int)rule->name.length, rule->name.text);
        if (!genr8)
            tn_help(reader->diagnostics, diagnostic, "to write nothing to the sentence, say so: \"\"");
    }
}

void tn_bnf_make_terminals(tn_bnf_grammar *grammar)
{
    for (size_t r = 0; r < grammar->rule_count; r++) {
        make_rule(grammar->reader, grammar->rules[r]);
        grammar->production_count += grammar->rules[r]->alternatives.count;
    }
}

/* ==== checks a grammar (.bnf): names, rules that never end, what cannot be reached, what repair needs */

/* ---- names */

static bool same(tn_bnf_text a, tn_bnf_text b)
{
    return a.length == b.length && memcmp(a.text, b.text, a.length) == 0;
}

static size_t place_of(const tn_bnf_grammar *g, tn_bnf_text name)
{
    size_t place = (size_t)XXH3_64bits(name.text, name.length) & (g->names_size - 1);
    while (g->names[place] != TN_BNF_NONE && !same(g->rules[g->names[place]]->name, name))
        place = (place + 1) & (g->names_size - 1);
    return place;
}

uint32_t tn_bnf_find(const tn_bnf_grammar *grammar, tn_bnf_text name)
{
    return grammar->names[place_of(grammar, name)];
}

static void enter_names(tn_bnf_grammar *g)
{
    for (g->names_size = 16; g->names_size < g->rule_count * 2;)
        g->names_size *= 2;
    g->names = TN_NEW_ARRAY(g->reader->arena, uint32_t, g->names_size);
    if (!g->names)
        return;
    memset(g->names, 0xFF, g->names_size * sizeof *g->names);
    for (size_t r = 0; r < g->rule_count; r++) {
        tn_bnf_rule *rule = g->rules[r];
        size_t place = place_of(g, rule->name);
        if (g->names[place] == TN_BNF_NONE) {
            g->names[place] = (uint32_t)r;
            continue;
        }
        tn_diagnostic *diagnostic = tn_report(g->reader->diagnostics, E_GRAMMAR_DUPLICATE, rule->name_span,
                                              "%.*s has a rule already", (int)rule->name.length, rule->name.text);
        tn_note(g->reader->diagnostics, diagnostic, &g->rules[g->names[place]]->name_span, "it is here");
        tn_help(g->reader->diagnostics, diagnostic, "put the alternatives together, separated by |");
    }
}

#define SUGGESTIONS_MAX 1000u /* rules looked through for a name that is nearly right */

static void undefined(tn_bnf_grammar *g, const tn_bnf_item *item)
{
    tn_diagnostics *list = g->reader->diagnostics;
    tn_diagnostic *diagnostic = tn_report(list, E_GRAMMAR_UNDEFINED, item->span, "there is no rule %.*s",
                                          (int)item->text.length, item->text.text);
    size_t count = g->rule_count < SUGGESTIONS_MAX ? g->rule_count : SUGGESTIONS_MAX;
    const char **names = TN_NEW_ARRAY(g->reader->arena, const char *, count);
    const char *wanted = tn_arena_copy(g->reader->arena, item->text.text, item->text.length);
    if (!names || !wanted)
        return;
    for (size_t r = 0; r < count; r++)
        if (!(names[r] = tn_arena_copy(g->reader->arena, g->rules[r]->name.text, g->rules[r]->name.length)))
            return;
    const char *near = tn_nearest(wanted, names, count);
    if (near)
        tn_help(list, diagnostic, "did you mean %s?", near);
    else if (g->reader->ast.dialect == TN_DIALECT_GE)
        tn_help(list, diagnostic, "if it is meant as text, quote it: \"%s\"", wanted);
}

static void find_names(tn_bnf_grammar *g, tn_bnf_items items)
{
    for (tn_bnf_item *item = items.first; item; item = item->next) {
        if (item->kind == TN_BNF_NAME && (item->rule = tn_bnf_find(g, item->text)) == TN_BNF_NONE)
            undefined(g, item);
        find_names(g, item->body);
    }
}

/* ---- which rules can end */

/* A rule can end if one of its alternatives needs only rules that can; what is in a group is not needed. Each
 * alternative waits for a number of names, and a rule that is found to end wakes the alternatives that wait for it:
 * linear time. */
typedef struct ending {
    tn_bnf_grammar *grammar;
    uint32_t *rule_of;     /* by alternative */
    uint32_t *waits_for;   /* by alternative: names still open */
    uint32_t *first, *use; /* by rule: where its uses start; alternatives that name it */
    bool *ends;
    uint32_t *ready; /* rules found to end, to be worked off */
    size_t ready_count;
} ending;

static bool ending_init(ending *e, tn_bnf_grammar *g)
{
    size_t uses = 0;
    for (size_t r = 0; r < g->rule_count; r++)
        for (const tn_bnf_alternative *a = g->rules[r]->alternatives.first; a; a = a->next)
            for (const tn_bnf_item *item = a->items.first; item; item = item->next)
                uses += item->kind == TN_BNF_NAME;
    tn_arena *arena = g->reader->arena;
    e->grammar = g;
    e->rule_of = TN_NEW_ARRAY(arena, uint32_t, g->production_count + 1);
    e->waits_for = TN_NEW_ARRAY(arena, uint32_t, g->production_count + 1);
    e->first = TN_NEW_ARRAY(arena, uint32_t, g->rule_count + 2);
    e->use = TN_NEW_ARRAY(arena, uint32_t, uses + 1);
    e->ends = TN_NEW_ARRAY(arena, bool, g->rule_count + 1);
    e->ready = TN_NEW_ARRAY(arena, uint32_t, g->rule_count + 1);
    return e->rule_of && e->waits_for && e->first && e->use && e->ends && e->ready;
}

static void rule_ends(ending *e, uint32_t rule)
{
    if (!e->ends[rule]) {
        e->ends[rule] = true;
        e->ready[e->ready_count++] = rule;
    }
}

/* Twice over all alternatives: to count each rule's uses, then to list them. */
static void list_uses(ending *e)
{
    tn_bnf_grammar *g = e->grammar;
    for (int pass = 0; pass < 2; pass++) {
        uint32_t production = 0;
        for (size_t r = 0; r < g->rule_count; r++)
            for (const tn_bnf_alternative *a = g->rules[r]->alternatives.first; a; a = a->next, production++) {
                e->rule_of[production] = (uint32_t)r;
                for (const tn_bnf_item *item = a->items.first; item; item = item->next) {
                    if (item->kind != TN_BNF_NAME || item->rule == TN_BNF_NONE)
                        continue;
                    if (pass == 0) {
                        e->first[item->rule + 2]++;
                    } else {
                        e->use[e->first[item->rule + 1]++] = production;
                        e->waits_for[production]++;
                    }
                }
                if (pass == 1 && e->waits_for[production] == 0)
                    rule_ends(e, (uint32_t)r);
            }
        for (size_t r = 0; pass == 0 && r < g->rule_count; r++)
            e->first[r + 2] += e->first[r + 1];
    }
}

static void check_ends(tn_bnf_grammar *g)
{
    ending e = {0};
    if (!ending_init(&e, g))
        return;
    list_uses(&e);
    while (e.ready_count) {
        uint32_t rule = e.ready[--e.ready_count];
        for (uint32_t i = e.first[rule]; i < e.first[rule + 1]; i++)
            if (--e.waits_for[e.use[i]] == 0)
                rule_ends(&e, e.rule_of[e.use[i]]);
    }
    for (size_t r = 0; r < g->rule_count; r++) {
        const tn_bnf_rule *rule = g->rules[r];
        if (e.ends[r] || rule->broken)
            continue;
        tn_diagnostic *diagnostic =
            tn_report(g->reader->diagnostics, E_GRAMMAR_NEVER_ENDS, rule->name_span,
                      "%.*s can never end: each of its alternatives leads back to it, or to a rule that never ends",
                      (int)rule->name.length, rule->name.text);
        tn_help(g->reader->diagnostics, diagnostic, "add an alternative of terminals");
    }
}

/* ---- which rules can be reached */

static void reach(tn_bnf_items items, bool *reached, uint32_t *pending, size_t *count)
{
    for (const tn_bnf_item *item = items.first; item; item = item->next) {
        if (item->kind == TN_BNF_NAME && item->rule != TN_BNF_NONE && !reached[item->rule]) {
            reached[item->rule] = true;
            pending[(*count)++] = item->rule;
        }
        reach(item->body, reached, pending, count);
    }
}

static void check_reached(tn_bnf_grammar *g)
{
    bool *reached = TN_NEW_ARRAY(g->reader->arena, bool, g->rule_count);
    uint32_t *pending = TN_NEW_ARRAY(g->reader->arena, uint32_t, g->rule_count);
    if (!reached || !pending)
        return;
    size_t count = 1;
    reached[0] = true;
    pending[0] = 0;
    while (count) {
        const tn_bnf_rule *rule = g->rules[pending[--count]];
        for (const tn_bnf_alternative *a = rule->alternatives.first; a; a = a->next)
            reach(a->items, reached, pending, &count);
    }
    for (size_t r = 0; r < g->rule_count; r++) {
        const tn_bnf_rule *rule = g->rules[r];
        bool repairs = g->reader->ast.dialect == TN_DIALECT_GENR8 && g->reader->ast.repair != TN_REPAIR_OFF &&
                       same(rule->name, (tn_bnf_text){"<Successor>", 11});
        if (!reached[r] && !repairs && tn_bnf_find(g, rule->name) == r)
            tn_report(g->reader->diagnostics, W_GRAMMAR_UNREACHABLE, rule->name_span,
                      "%.*s cannot be reached from the start symbol %.*s", (int)rule->name.length, rule->name.text,
                      (int)g->rules[0]->name.length, g->rules[0]->name.text);
    }
}

/* ---- what repair needs */

static void check_repair(tn_bnf_grammar *g)
{
    static const char *const names[] = {"<RewriteRule>", "<Predecessor>", "<Successor>"};
    const tn_bnf_file *ast = &g->reader->ast;
    if (ast->dialect == TN_DIALECT_GE) {
        if (ast->says_repair)
            tn_report(g->reader->diagnostics, E_GRAMMAR_DIRECTIVE, ast->repair_span,
                      "%%repair is of the genr8 dialect, which this file is not in");
        return;
    }
    for (size_t i = 0; ast->repair != TN_REPAIR_OFF && i < 3; i++) {
        if (tn_bnf_find(g, (tn_bnf_text){names[i], strlen(names[i])}) != TN_BNF_NONE)
            continue;
        tn_diagnostic *diagnostic =
            tn_report(g->reader->diagnostics, E_GRAMMAR_REPAIR, g->rules[0]->name_span,
                      "repair gives a rule to edge types that have none, and needs a rule %s", names[i]);
        tn_help(g->reader->diagnostics, diagnostic, "write that rule, or begin the file with `%%repair off`");
    }
}

/* Position-independent mapping reads two codons for each non-terminal, and none within a production. */
static void check_mapping(tn_bnf_grammar *g)
{
    const tn_bnf_file *ast = &g->reader->ast;
    bool genr8 = ast->dialect == TN_DIALECT_GENR8;
    if (!ast->position_independent || (!genr8 && !ast->skip_single))
        return;
    tn_diagnostic *diagnostic =
        tn_report(g->reader->diagnostics, E_MAPPING_ORDER, ast->mapping_span,
                  genr8 ? "position-independent mapping is for the dialect ge, and this grammar is in genr8"
                        : "position-independent mapping reads two codons for every non-terminal, also for a single "
                          "choice");
    tn_help(g->reader->diagnostics, diagnostic,
            genr8 ? "leave it out: genomes are then mapped leftmost"
                  : "leave out `%%single-choice skip` of the grammar");
}

void tn_bnf_check(tn_bnf_grammar *g)
{
    enter_names(g);
    if (!g->names)
        return;
    bool broken = false;
    for (size_t r = 0; r < g->rule_count; r++) {
        broken |= g->rules[r]->broken;
        for (const tn_bnf_alternative *a = g->rules[r]->alternatives.first; a; a = a->next)
            find_names(g, a->items);
    }
    if (g->reader->diagnostics->error_count == 0 || !broken)
        check_ends(g);
    check_reached(g);
    check_repair(g);
    check_mapping(g);
}
