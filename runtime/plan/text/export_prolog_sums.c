/* Comparisons of sums as Prolog: whole steps are added up, as the engines do. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/module/code.h"
#include "runtime/plan/schema/sum.h"
#include "runtime/plan/text/prolog_writing.h"

typedef tn_prolog_writing writing;

/* ---- can it be said? */

static bool says_sum(const writing *w, uint32_t index)
{
    const tn_sum_record *sum = &w->module->SUM_records[index];
    for (uint32_t i = 0; i < sum->term_count; i++) {
        const tn_term_record *term = &w->module->TERM_records[sum->term_first + i];
        tn_sum_kind kind = tn_term_counts(term->kind);
        if ((kind != TN_SUM_SINGLES && kind != TN_SUM_STARTS && kind != TN_SUM_PRESENT) || !w->said[term->part])
            return false;
    }
    return true;
}

bool tn_prolog_says_comparison(const writing *w, const tn_part *part)
{
    for (uint32_t offset = part->code_begin; offset < part->code_end;) {
        tn_instruction code = tn_code_read(w->module->code, offset);
        bool known = code.opcode == TN_OP_NOT || code.opcode == TN_OP_AND || code.opcode == TN_OP_OR ||
                     code.opcode == TN_OP_MIRRORED || code.opcode == TN_OP_TRAY;
        bool said = tn_code_compares(code.opcode) ? says_sum(w, (uint32_t)code.first)
                    : code.opcode == TN_OP_CALL   ? w->said[code.first]
                                                  : known;
        if (!said)
            return false;
        offset += code.length;
    }
    return true;
}

/* ---- comparisons: goals as texts on a stack */

enum { GOALS_MAX = 4096 }; /* the deepest stack of a module */

typedef struct goals {
    writing *w;
    char *items[GOALS_MAX]; /* owned */
    size_t count;
} goals;

static void push(goals *g, tn_buffer *goal)
{
    if (g->count == GOALS_MAX) {
        g->w->ok = false;
        free(goal->data);
        return;
    }
    g->items[g->count++] = goal->data;
}

/* One goal, or two, inside signs. */
static void join(goals *g, const char *before, const char *between, bool both)
{
    tn_buffer made = {0};
    char *second = both && g->count ? g->items[--g->count] : NULL, *first = g->count ? g->items[--g->count] : NULL;
    g->w->ok =
        g->w->ok && first && tn_buffer_printf(&made, "%s( %s%s%s )", before, first, between, second ? second : "");
    free(first);
    free(second);
    push(g, &made);
}

static tn_status push_compared(goals *g, const tn_instruction *code, tn_error *error)
{
    uint32_t index = (uint32_t)code->first;
    int64_t modulus = 0;
    tn_buffer made = {0};
    g->w->asked_sums[index] = true;
    if (code->opcode == TN_OP_MULTIPLE) {
        tn_sum *sum;
        tn_status status = tn_sum_new(g->w->schema, index, &sum, error);
        if (status != TN_OK)
            return status;
        modulus = tn_sum_modulus(sum, code->second);
        tn_sum_free(sum);
    }
    char outcome[64];
    if (modulus > 0)
        snprintf(outcome, sizeof outcome, "mod %" PRId64 " =:= 0", modulus);
    else
        snprintf(outcome, sizeof outcome, "%s 0",
                 code->opcode == TN_OP_BELOW  ? "<"
                 : code->opcode == TN_OP_ZERO ? "=:="
                                              : ">");
    g->w->ok = g->w->ok && tn_buffer_printf(&made, "'sum %" PRIu32 "'(W, I, J, S%" PRIu32 "), S%" PRIu32 " %s", index,
                                            index, index, outcome);
    push(g, &made);
    return TN_OK;
}

/* A call, or a tray. */
static void push_plain(goals *g, const tn_instruction *code)
{
    tn_buffer made = {0}, *out = g->w->out;
    g->w->out = &made;
    if (code->opcode == TN_OP_TRAY)
        tn_prolog_put_tray(g->w, (uint32_t)code->first);
    else
        tn_prolog_put_name(g->w, (uint32_t)code->first, 0);
    tn_prolog_put(g->w, code->opcode == TN_OP_TRAY ? "" : "(W, I, J)");
    g->w->out = out;
    push(g, &made);
}

static tn_status read_goal(goals *g, const tn_instruction *code, tn_error *error)
{
    tn_buffer made = {0};
    switch (code->opcode) {
    case TN_OP_CALL:
    case TN_OP_TRAY:
        push_plain(g, code);
        return TN_OK;
    case TN_OP_MIRRORED:
        g->w->ok = g->w->ok && tn_buffer_printf(&made, "same_both_ways(%" PRIu32 ", W, I, J)",
                                                (uint32_t)code->first - g->w->schema->record->field_first + 1);
        push(g, &made);
        return TN_OK;
    case TN_OP_NOT:
        join(g, "\\+ ", "", false);
        return TN_OK;
    case TN_OP_AND:
        join(g, "", ", ", true);
        return TN_OK;
    case TN_OP_OR:
        join(g, "", " ; ", true);
        return TN_OK;
    default:
        return push_compared(g, code, error);
    }
}

tn_status tn_prolog_put_comparison(writing *w, const tn_part *part, tn_error *error)
{
    goals *g = calloc(1, sizeof *g);
    if (!g)
        return tn_fail_memory(error);
    g->w = w;
    tn_status status = TN_OK;
    for (uint32_t offset = part->code_begin; status == TN_OK && offset < part->code_end;) {
        tn_instruction code = tn_code_read(w->module->code, offset);
        status = read_goal(g, &code, error);
        offset += code.length;
    }
    if (w->ok && g->count > 0)
        tn_prolog_put(w, g->items[0]);
    while (g->count > 0)
        free(g->items[--g->count]);
    free(g);
    return status;
}

/* ---- what trays count */

/* The fields that a tally depends on. */
static void find_fields(const writing *w, uint32_t tally, bool *depends)
{
    const tn_function_record *record = &w->module->FUNCTION_records[tally];
    const tn_schema *schema = w->schema;
    for (uint32_t offset = record->code_begin; offset < record->code_end;) {
        tn_instruction code = tn_code_read(w->module->code, offset);
        if (code.opcode == TN_OP_EXTENT)
            depends[(uint32_t)code.first - schema->record->field_first] = true;
        for (uint32_t f = 0; code.opcode == TN_OP_PICK && f < schema->field_count; f++)
            for (uint32_t bit = schema->value_start[f]; bit < schema->value_start[f + 1]; bit++)
                depends[f] |= !(tn_spec_word(w->module, (uint32_t)code.first, bit / 64) >> (bit % 64) & 1);
        offset += code.length;
    }
}

static void put_tray(writing *w, tn_tray tray, const bool *depends)
{
    const tn_schema *schema = w->schema;
    tn_prolog_put(w, "tray(");
    for (uint32_t f = 0; f < schema->field_count; f++) {
        tn_prolog_put(w, f ? ", " : "");
        if (depends[f])
            tn_prolog_put_atom(w, tn_text(w->module, tn_tray_value_record(schema, tray, f)->spelling), NULL);
        else
            tn_prolog_put(w, "_");
    }
    tn_prolog_put(w, ")");
}

/* 'tally 3 1'(tray('2m', _), 4): a fact for each different tray, of the fields that matter. */
static tn_status put_tally(writing *w, uint32_t index, uint32_t term, const tn_sum *sum, tn_error *error)
{
    const tn_schema *schema = w->schema;
    bool depends[TN_FIELDS_MAX] = {0};
    uint32_t key[TN_FIELDS_MAX];
    tn_interner seen = {0};
    tn_status status = tn_schema_listed(schema, "a Prolog program with sums goes", error);
    if (status != TN_OK)
        return status;
    find_fields(w, w->module->TERM_records[sum->record->term_first + term].tally, depends);
    bool good = true;
    for (tn_tray t = 0; good && t < schema->tray_count; t++) {
        uint32_t count = seen.count;
        for (uint32_t f = 0; f < schema->field_count; f++)
            key[f] = depends[f] ? tn_tray_value(schema, t, f) : 0;
        good = tn_intern(&seen, key, schema->field_count) != UINT32_MAX;
        if (!good || seen.count == count)
            continue;
        w->ok = w->ok && tn_buffer_printf(w->out, "'tally %" PRIu32 " %" PRIu32 "'(", index, term + 1);
        put_tray(w, t, depends);
        w->ok = w->ok && tn_buffer_printf(w->out, ", %" PRId64 ") :- !.\n", sum->terms[term].weight[t]);
    }
    tn_interner_clear(&seen);
    return good ? TN_OK : tn_fail_memory(error);
}

/* ---- sums */

static void put_term(writing *w, uint32_t index, uint32_t i, const tn_sum_term *term)
{
    static const char *const regions[] = {"I, J", "0, I", "J, N"};
    bool weighed = term->weight != NULL;
    tn_prolog_put(w, weighed                        ? "singles("
                     : term->kind == TN_SUM_STARTS  ? "starts("
                     : term->kind == TN_SUM_PRESENT ? "present("
                                                    : "count(");
    tn_prolog_put_name(w, term->part, 0);
    if (weighed)
        w->ok = w->ok && tn_buffer_printf(w->out, ", 'tally %" PRIu32 " %" PRIu32 "'", index, i + 1);
    w->ok = w->ok && tn_buffer_printf(w->out, ", W, %s, T%" PRIu32 "), ", regions[term->region], i + 1);
}

tn_status tn_prolog_put_sum(writing *w, uint32_t index, tn_error *error)
{
    tn_sum *sum;
    tn_status status = tn_sum_new(w->schema, index, &sum, error);
    if (status != TN_OK)
        return status;
    bool behind = false, begins = false, ends = false;
    for (uint32_t i = 0; i < sum->count; i++) {
        behind |= sum->terms[i].region == TN_REGION_AFTER;
        begins |= sum->terms[i].region != TN_REGION_AFTER;
        ends |= sum->terms[i].region != TN_REGION_BEFORE;
    }
    w->ok = w->ok && tn_buffer_printf(w->out, "'sum %" PRIu32 "'(%s, %s, %s, S) :- ", index, sum->count ? "W" : "_",
                                      begins ? "I" : "_", ends ? "J" : "_");
    tn_prolog_put(w, behind ? "W = w(N, _), " : "");
    for (uint32_t i = 0; i < sum->count; i++)
        put_term(w, index, i, &sum->terms[i]);
    w->ok = w->ok && tn_buffer_printf(w->out, "S is %" PRId64, sum->constant);
    for (uint32_t i = 0; i < sum->count; i++)
        w->ok = w->ok && (sum->terms[i].weight
                              ? tn_buffer_printf(w->out, " + T%" PRIu32, i + 1)
                              : tn_buffer_printf(w->out, " + %" PRId64 " * T%" PRIu32, sum->terms[i].each, i + 1));
    tn_prolog_put(w, ".\n");
    for (uint32_t i = 0; status == TN_OK && i < sum->count; i++)
        if (sum->terms[i].weight)
            status = put_tally(w, index, i, sum, error);
    tn_prolog_put(w, "\n");
    tn_sum_free(sum);
    return status;
}
