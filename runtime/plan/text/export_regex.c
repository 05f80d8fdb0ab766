/* Writes a rule as a regular expression. */
#include "runtime/plan/text/export_regex.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

/* While states are eliminated an expression may be longer than the whole will be, though not by much. */
#define PART_MAX (8 * TN_REGEX_LENGTH_MAX)

/* What an expression is made of decides where it needs parentheses. */
typedef enum form { FORM_EMPTY, FORM_ATOM, FORM_ROW, FORM_CHOICE } form;

/* The words that lead from one state to another; text NULL: there are none. FORM_EMPTY: only the empty word. `maybe`:
 * the empty word besides what the text says. */
typedef struct words {
    char *text;
    form form;
    bool maybe;
} words;

/* States 0..count-1 are the automaton's, then a start and an end of their own. */
typedef struct elimination {
    words *between; /* [count + 2][count + 2] */
    uint32_t count;
    bool failed, long_; /* out of memory; too long */
} elimination;

char tn_regex_letter(uint32_t column)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    return letters[column];
}

static words *at(const elimination *e, uint32_t from, uint32_t to)
{
    return &e->between[(size_t)from * (e->count + 2) + to];
}

static char *take(elimination *e, tn_buffer *made)
{
    if (made->failed)
        e->failed = true;
    if (made->size > PART_MAX)
        e->long_ = true;
    return made->data;
}

/* Writes an expression where a form of at least `need` is wanted (an atom, to repeat it; a row, to go on after it). */
static void write(tn_buffer *out, const words *w, form need, const char *repeat)
{
    bool wrap = w->form > need && w->form != FORM_EMPTY;
    tn_buffer_printf(out, "%s%s%s%s", wrap ? "(" : "", w->text ? w->text : "", wrap ? ")" : "", repeat);
}

/* Is it one letter, or a set of letters in brackets? */
static bool is_set(const words *w)
{
    return w->form == FORM_ATOM && (w->text[1] == '\0' || w->text[0] == '[');
}

static void write_set(tn_buffer *out, const words *w)
{
    size_t length = strlen(w->text);
    if (w->text[0] == '[')
        tn_buffer_append(out, w->text + 1, length - 2);
    else
        tn_buffer_append(out, w->text, length);
}

/* *into := either; takes `other`. */
static void unite(elimination *e, words *into, words other)
{
    if (!other.text)
        return;
    if (!into->text) {
        *into = other;
        return;
    }
    bool maybe = into->maybe || other.maybe || into->form == FORM_EMPTY || other.form == FORM_EMPTY;
    if (into->form == FORM_EMPTY || other.form == FORM_EMPTY || strcmp(into->text, other.text) == 0) {
        words kept = into->form == FORM_EMPTY ? other : *into;
        free(into->form == FORM_EMPTY ? into->text : other.text);
        *into = kept;
        into->maybe = kept.form != FORM_EMPTY && maybe;
        return;
    }
    tn_buffer made = {0};
    form shape = FORM_CHOICE;
    if (is_set(into) && is_set(&other)) {
        tn_buffer_printf(&made, "[");
        write_set(&made, into);
        write_set(&made, &other);
        tn_buffer_printf(&made, "]");
        shape = FORM_ATOM;
    } else {
        tn_buffer_printf(&made, "%s|%s", into->text, other.text);
    }
    free(into->text);
    free(other.text);
    *into = (words){take(e, &made), shape, maybe};
}

/* What stands for the words themselves in a row: an empty word's part is nothing. */
static void write_in_row(tn_buffer *out, const words *w)
{
    if (w->form != FORM_EMPTY)
        write(out, w, w->maybe ? FORM_ATOM : FORM_ROW, w->maybe ? "?" : "");
}

/* One after the other, with any number of `loop` between. */
static words follow(elimination *e, const words *first, const words *loop, const words *second)
{
    tn_buffer made = {0};
    tn_buffer_printf(&made, "%s", "");
    bool loops = loop->text && loop->form != FORM_EMPTY;
    write_in_row(&made, first);
    if (loops)
        write(&made, loop, FORM_ATOM, "*");
    write_in_row(&made, second);
    words joined = {take(e, &made), FORM_ROW, false};
    if (joined.text && !*joined.text)
        joined.form = FORM_EMPTY;
    else if (!loops && (first->form == FORM_EMPTY || second->form == FORM_EMPTY)) {
        const words *alone = first->form == FORM_EMPTY ? second : first;
        if (!alone->maybe)
            joined.form = alone->form == FORM_CHOICE ? FORM_ATOM : alone->form;
    }
    return joined;
}

static void eliminate(elimination *e, uint32_t state)
{
    uint32_t all = e->count + 2;
    const words *loop = at(e, state, state);
    for (uint32_t p = 0; p < all && !e->failed && !e->long_; p++) {
        if (p == state || !at(e, p, state)->text)
            continue;
        for (uint32_t q = 0; q < all && !e->failed && !e->long_; q++)
            if (q != state && at(e, state, q)->text)
                unite(e, at(e, p, q), follow(e, at(e, p, state), loop, at(e, state, q)));
    }
    for (uint32_t p = 0; p < all; p++) {
        words *ends[2] = {at(e, p, state), at(e, state, p)};
        for (int i = 0; i < 2; i++) {
            free(ends[i]->text);
            *ends[i] = (words){0};
        }
    }
}

/* How much longer eliminating a state makes the rest (Delgado, Morais 2004): the least goes first. */
static size_t weight(const elimination *e, uint32_t state)
{
    size_t in = 0, out = 0, in_length = 0, out_length = 0, loop = 0;
    for (uint32_t p = 0; p < e->count + 2; p++) {
        const words *enter = at(e, p, state), *leave = at(e, state, p);
        if (p == state) {
            loop = enter->text ? strlen(enter->text) : 0;
            continue;
        }
        in += enter->text != NULL;
        out += leave->text != NULL;
        in_length += enter->text ? strlen(enter->text) : 0;
        out_length += leave->text ? strlen(leave->text) : 0;
    }
    return in_length * (out ? out - 1 : 0) + out_length * (in ? in - 1 : 0) + loop * (in && out ? in * out - 1 : 0);
}

static words letter(elimination *e, uint32_t column)
{
    tn_buffer made = {0};
    tn_buffer_printf(&made, "%c", tn_regex_letter(column));
    return (words){take(e, &made), FORM_ATOM, false};
}

static words nothing(elimination *e)
{
    tn_buffer made = {0};
    tn_buffer_printf(&made, "%s", "");
    return (words){take(e, &made), FORM_EMPTY, false};
}

/* The automaton's transitions, but for those into the state that accepts nothing. */
static void set_up(elimination *e, const tn_dfa *dfa)
{
    uint32_t dead = tn_dfa_sink(dfa, 0);
    *at(e, e->count, 0) = nothing(e);
    for (uint32_t s = 0; s < dfa->states; s++) {
        if (dfa->accept[s])
            *at(e, s, e->count + 1) = nothing(e);
        for (uint32_t c = 0; c < dfa->columns; c++) {
            uint32_t to = dfa->delta[(size_t)s * dfa->columns + c];
            if (s != dead && to != dead)
                unite(e, at(e, s, to), letter(e, c));
        }
    }
}

static void eliminate_all(elimination *e)
{
    bool *gone = calloc((size_t)e->count + 1, sizeof *gone);
    e->failed = e->failed || !gone;
    for (uint32_t i = 0; i < e->count && !e->failed && !e->long_; i++) {
        uint32_t best = UINT32_MAX;
        size_t least = SIZE_MAX;
        for (uint32_t s = 0; s < e->count; s++) {
            size_t w = gone[s] ? SIZE_MAX : weight(e, s);
            if (!gone[s] && (best == UINT32_MAX || w < least)) {
                best = s;
                least = w;
            }
        }
        eliminate(e, best);
        gone[best] = true;
    }
    free(gone);
}

static tn_status too_large(const tn_dfa *dfa, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES,
            "the automaton has %u classes of trays and %u states; a pattern has at most %u letters and %u states",
            dfa->columns, dfa->states, TN_REGEX_LETTERS_MAX, TN_REGEX_LENGTH_MAX);
    tn_error_help(error, "a rule that tells fewer kinds of trays apart, or counts less far, may have a pattern");
    return TN_LIMIT;
}

tn_status tn_export_regex(const tn_dfa *dfa, tn_buffer *out, tn_error *error)
{
    elimination e = {.count = dfa->states};
    if (dfa->columns > TN_REGEX_LETTERS_MAX || dfa->states > TN_REGEX_LENGTH_MAX)
        return too_large(dfa, error);
    size_t all = (size_t)e.count + 2;
    e.between = calloc(tn_size_of(all, all), sizeof *e.between);
    if (!e.between)
        return tn_fail_memory(error);
    set_up(&e, dfa);
    eliminate_all(&e);
    const words *whole = at(&e, e.count, e.count + 1);
    tn_status status = e.failed ? tn_fail_memory(error) : TN_OK;
    tn_buffer made = {0};
    if (status == TN_OK && whole->text && !e.long_) {
        tn_buffer_printf(&made, "^");
        if (whole->form != FORM_EMPTY)
            write(&made, whole, whole->maybe ? FORM_ATOM : FORM_ROW, whole->maybe ? "?" : "");
        tn_buffer_printf(&made, "$");
    }
    if (made.failed)
        status = tn_fail_memory(error);
    if (status == TN_OK && (e.long_ || made.size > TN_REGEX_LENGTH_MAX))
        status = tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES,
                         "the pattern would be longer than the limit of %u characters", TN_REGEX_LENGTH_MAX);
    if (status == TN_OK && made.size && !tn_buffer_append(out, made.data, made.size))
        status = tn_fail_memory(error);
    free(made.data);
    for (size_t i = 0; i < all * all; i++)
        free(e.between[i].text);
    free(e.between);
    return status;
}

bool tn_regex_plan(const tn_dfa *dfa, const tn_classes *classes, const tn_tray *trays, size_t length, tn_buffer *out)
{
    bool ok = tn_buffer_append(out, "", 0);
    for (size_t i = 0; ok && i < length; i++) {
        char c = tn_regex_letter(dfa->column[tn_class_of(classes, trays[i])]);
        ok = tn_buffer_append(out, &c, 1);
    }
    return ok;
}
