/* Writes rules as a Prolog program. */
#include "runtime/plan/text/export_prolog.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/plan/schema/projection.h"
#include "runtime/plan/schema/sum.h"
#include "runtime/plan/text/prolog_writing.h"

typedef tn_prolog_writing writing;

void tn_prolog_put(writing *w, const char *text)
{
    w->ok = w->ok && tn_buffer_append(w->out, text, strlen(text));
}

static void put(writing *w, const char *text)
{
    tn_prolog_put(w, text);
}

/* The rest of a comment, on one line whatever an author wrote. */
static void put_comment(writing *w, const char *text)
{
    for (const char *c = text; *c; c++)
        put(w, (unsigned char)*c < 0x20 ? " " : (char[]){*c, '\0'});
}

void tn_prolog_put_atom(writing *w, const char *text, const char *more)
{
    put(w, "'");
    for (const char *part = text; part; part = part == text && more ? more : NULL)
        for (const char *c = part; *c; c++) {
            if (*c == '\'' || *c == '\\')
                w->ok = w->ok && tn_buffer_append(w->out, c, 1);
            w->ok = w->ok && tn_buffer_append(w->out, c, 1);
        }
    put(w, "'");
}

static void put_atom(writing *w, const char *text, const char *more)
{
    tn_prolog_put_atom(w, text, more);
}

void tn_prolog_put_name(writing *w, uint32_t function, uint32_t part)
{
    char suffix[64];
    const tn_function_record *record = &w->module->FUNCTION_records[function];
    uint32_t rule = tn_function_rule(w->module, function);
    const char *kind = tn_function_is_whole(record) ? "whole" : "somewhere";
    w->asked[function] |= part == 0;
    if (part == 0 && rule != UINT32_MAX)
        snprintf(suffix, sizeof suffix, " %s", kind);
    else if (part == 0)
        snprintf(suffix, sizeof suffix, " %s %" PRIu32, kind, function);
    else
        snprintf(suffix, sizeof suffix, " %s %" PRIu32 " %" PRIu32, kind, function, part);
    put_atom(w, tn_text(w->module, record->name), suffix);
}

static void put_name(writing *w, uint32_t function, uint32_t part)
{
    tn_prolog_put_name(w, function, part);
}

/* ---- conditions */

typedef struct texts {
    char **items; /* owned */
    size_t count;
} texts;

/* Conditions are small: expressions as texts on a stack. Takes `made`. */
static bool push_condition(texts *stack, bool ok, tn_buffer *made)
{
    stack->items[stack->count++] = made->data;
    return ok;
}

/* Two conditions, or one, inside signs. */
static bool join_conditions(texts *stack, const char *before, const char *between, bool both)
{
    tn_buffer made = {0};
    char *second = both ? stack->items[--stack->count] : NULL, *first = stack->items[--stack->count];
    bool ok = tn_buffer_printf(&made, "%s( %s%s%s )", before, first, between, second ? second : "");
    free(first);
    free(second);
    return push_condition(stack, ok, &made);
}

static bool run_condition(const tn_instruction *code, texts *stack)
{
    tn_buffer made = {0};
    int64_t k = code->first, m = code->second;
    switch (code->opcode) {
    case TN_OP_LESS:
        return push_condition(stack, tn_buffer_printf(&made, "N < %" PRId64, k), &made);
    case TN_OP_EQUAL:
        return push_condition(stack, tn_buffer_printf(&made, "N =:= %" PRId64, k), &made);
    case TN_OP_GREATER:
        return push_condition(stack, tn_buffer_printf(&made, "N > %" PRId64, k), &made);
    case TN_OP_WITHIN:
        return push_condition(stack, tn_buffer_printf(&made, "( %" PRId64 " =< N, N =< %" PRId64 " )", k, m), &made);
    case TN_OP_REMAINDER:
        return push_condition(stack, tn_buffer_printf(&made, "N mod %" PRId64 " =:= %" PRId64, k, m), &made);
    case TN_OP_BOTH:
        return join_conditions(stack, "", ", ", true);
    case TN_OP_EITHER:
        return join_conditions(stack, "", " ; ", true);
    default: /* NEITHER: verifying has refused anything else */
        return join_conditions(stack, "\\+ ", "", false);
    }
}

static void put_condition(writing *w, uint32_t function)
{
    const tn_function_record *record = &w->module->FUNCTION_records[function];
    texts stack = {calloc((size_t)record->stack_max + 1, sizeof *stack.items), 0};
    w->ok = w->ok && stack.items;
    for (uint32_t offset = record->code_begin; w->ok;) {
        tn_instruction code = tn_code_read(w->module->code, offset);
        if (code.opcode == TN_OP_ANSWER)
            break;
        w->ok = run_condition(&code, &stack);
        offset += code.length;
    }
    if (w->ok)
        put(w, stack.items[0]);
    while (stack.count > 0)
        free(stack.items[--stack.count]);
    free(stack.items);
}

/* ---- parts */

static bool allows(const writing *w, uint32_t spec, uint32_t field, uint32_t value)
{
    uint32_t bit = w->schema->value_start[field] + value;
    return tn_spec_word(w->module, spec, bit / 64) >> (bit % 64) & 1;
}

static bool is_free(const writing *w, uint32_t spec, uint32_t field)
{
    for (uint32_t v = 0; v < w->schema->fields[field].value_count; v++)
        if (!allows(w, spec, field, v))
            return false;
    return true;
}

void tn_prolog_put_tray(writing *w, uint32_t spec)
{
    put(w, "J =:= I + 1, tray_at(W, I, tray(");
    for (uint32_t f = 0; f < w->schema->field_count; f++)
        w->ok = w->ok && (is_free(w, spec, f) ? tn_buffer_printf(w->out, "%s_", f ? ", " : "")
                                              : tn_buffer_printf(w->out, "%sV%" PRIu32, f ? ", " : "", f + 1));
    put(w, "))");
    for (uint32_t f = 0; f < w->schema->field_count; f++) {
        if (is_free(w, spec, f))
            continue;
        w->ok = w->ok && tn_buffer_printf(w->out, ", one_of(V%" PRIu32 ", [", f + 1);
        const char *between = "";
        for (uint32_t v = 0; v < w->schema->fields[f].value_count; v++) {
            if (!allows(w, spec, f, v))
                continue;
            put(w, between);
            put_atom(w, tn_text(w->module, w->schema->values[w->schema->value_start[f] + v].spelling), NULL);
            between = ", ";
        }
        put(w, "])");
    }
}

/* A goal that asks for a part on the stretch at hand. */
static void put_goal(writing *w, const tn_parts *parts, uint32_t function, uint32_t part)
{
    if (parts->parts[part].somewhere)
        put(w, "somewhere(");
    put_name(w, function, part);
    put(w, parts->parts[part].somewhere ? ", W, I, J)" : "(W, I, J)");
}

static void put_joined(writing *w, const tn_parts *parts, uint32_t function, uint32_t part, const char *between)
{
    const char *before = "";
    put(w, "( ");
    for (uint32_t child = parts->parts[part].first; child != TN_NO_PART; child = parts->parts[child].next) {
        put(w, before);
        put_goal(w, parts, function, child);
        before = between;
    }
    put(w, " )");
}

static void put_neighbour(writing *w, const tn_parts *parts, uint32_t function, uint32_t part)
{
    const tn_part *it = &parts->parts[part];
    const char *before = "";
    put(w, it->beginning ? "at_beginning(W, I, J), " : "");
    put(w, it->end ? "at_end(W, I, J), " : "");
    put(w, "side_by_side([");
    for (uint32_t child = it->first; child != TN_NO_PART; child = parts->parts[child].next) {
        put(w, before);
        put(w, parts->parts[child].optional ? "may(" : "");
        put_name(w, function, child);
        put(w, parts->parts[child].optional ? ")" : "");
        before = ", ";
    }
    put(w, "], W, I, J)");
}

/* A number of the only child's, under a condition. */
static void put_counted(writing *w, const tn_parts *parts, uint32_t function, uint32_t part)
{
    const tn_part *it = &parts->parts[part];
    if (it->kind == TN_PART_SUM)
        w->ok = w->ok && tn_buffer_printf(w->out, "sum(%" PRIu32 ", ", it->field - w->schema->record->field_first + 1);
    else
        put(w, it->kind == TN_PART_QUANTITY ? "count(" : "starts(");
    put_name(w, function, it->first);
    put(w, ", W, I, J, N), ");
    put_condition(w, it->condition);
}

/* Source, destination and separator. */
static void put_gaps(writing *w, const char *predicate, const tn_parts *parts, uint32_t function, uint32_t part)
{
    put(w, predicate);
    for (uint32_t child = parts->parts[part].first; child != TN_NO_PART; child = parts->parts[child].next) {
        put_name(w, function, child);
        put(w, ", ");
    }
    put(w, "W, I, J)");
}

static tn_status put_body(writing *w, const tn_parts *parts, uint32_t function, uint32_t part, tn_error *error)
{
    const tn_part *it = &parts->parts[part];
    switch (it->kind) {
    case TN_PART_COMPARISON:
        return tn_prolog_put_comparison(w, it, error);
    case TN_PART_TRAY:
        tn_prolog_put_tray(w, it->spec);
        break;
    case TN_PART_RULE:
        put_name(w, it->function, 0);
        put(w, "(W, I, J)");
        break;
    case TN_PART_AND:
        put_joined(w, parts, function, part, ", ");
        break;
    case TN_PART_OR:
        put_joined(w, parts, function, part, " ; ");
        break;
    case TN_PART_NOT:
        put(w, "\\+ ");
        put_goal(w, parts, function, it->first);
        break;
    case TN_PART_NEIGHBOUR:
        put_neighbour(w, parts, function, part);
        break;
    case TN_PART_SYMMETRIC:
        put(w, "( ");
        put_name(w, function, it->first);
        put(w, "(W, I, J) ; mirrored(");
        put_name(w, function, it->first);
        put(w, ", W, I, J) )");
        break;
    case TN_PART_MANY:
        put(w, "every_tray(");
        put_name(w, function, it->first);
        put(w, ", W, I, J)");
        break;
    case TN_PART_REPEAT:
        w->ok = w->ok && tn_buffer_printf(w->out, "repeated(%" PRIu32 ", ", it->least);
        if (it->most > 0)
            w->ok = w->ok && tn_buffer_printf(w->out, "%" PRIu32 ", ", it->most);
        else
            put(w, "inf, ");
        put_name(w, function, it->first);
        put(w, ", W, I, J)");
        break;
    case TN_PART_DISTANCE:
        put_gaps(w, "distance(", parts, function, part);
        break;
    case TN_PART_NEAR:
        put_gaps(w, "near(", parts, function, part);
        break;
    case TN_PART_FAR:
        put_gaps(w, "far(", parts, function, part);
        break;
    case TN_PART_WHERE:
        put(w, "I < J, ");
        put_joined(w, parts, function, part, ", ");
        break;
    default:
        put_counted(w, parts, function, part);
        break;
    }
    return TN_OK;
}

static tn_status put_part(writing *w, const tn_parts *parts, uint32_t function, uint32_t part, tn_error *error)
{
    char text[TN_PART_TEXT_MAX];
    tn_part_text(parts, part, text, sizeof text);
    put(w, "% ");
    put_comment(w, text);
    put(w, "\n");
    /* of the root, what the function as a whole says; of others, the part itself: put_goal says where to look for it */
    put_name(w, function, part);
    put(w, "(W, I, J) :- ");
    if (part == 0 && parts->parts[0].somewhere) {
        w->ok = w->ok && tn_buffer_printf(w->out, "somewhere(");
        put_name(w, function, parts->count);
        put(w, ", W, I, J).\n");
        put_name(w, function, parts->count);
        put(w, "(W, I, J) :- ");
    }
    tn_status status = put_body(w, parts, function, part, error);
    put(w, ", !.\n");
    return status;
}

/* Do the predicates of the prelude have words for the part? */
static bool has_words(const writing *w, const tn_part *part)
{
    switch (part->kind) {
    case TN_PART_COMPARISON:
        return tn_prolog_says_comparison(w, part);
    case TN_PART_RULE:
        return w->said[part->function];
    case TN_PART_TRAY:
    case TN_PART_AND:
    case TN_PART_OR:
    case TN_PART_NOT:
    case TN_PART_NEIGHBOUR:
    case TN_PART_SYMMETRIC:
    case TN_PART_QUANTITY:
    case TN_PART_SUM:
    case TN_PART_OCCURRENCES:
    case TN_PART_MANY:
    case TN_PART_REPEAT:
    case TN_PART_DISTANCE:
    case TN_PART_NEAR:
    case TN_PART_FAR:
    case TN_PART_WHERE:
        return true;
    default:
        return false;
    }
}

static tn_status says(const writing *w, uint32_t function, bool *said, tn_error *error)
{
    tn_parts parts = {0};
    tn_status status = tn_parts_read(w->module, function, &parts, error);
    *said = status == TN_OK;
    for (uint32_t part = 0; *said && part < parts.count; part++)
        *said = has_words(w, &parts.parts[part]);
    tn_parts_clear(&parts);
    return status == TN_MEMORY ? status : TN_OK;
}

/* Finds out which functions can be said: all are taken to be, until one that they call is not. */
static tn_status find_said(writing *w, tn_error *error)
{
    for (uint32_t f = 0; f < w->module->FUNCTION_count; f++) {
        const tn_function_record *record = &w->module->FUNCTION_records[f];
        w->said[f] = tn_function_is_whole(record) || record->kind == TN_FUNCTION_HOLDS;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t f = 0; f < w->module->FUNCTION_count; f++) {
            bool said = w->said[f];
            tn_status status = said ? says(w, f, &said, error) : TN_OK;
            if (status != TN_OK)
                return status;
            changed |= said != w->said[f];
            w->said[f] = said;
        }
    }
    return TN_OK;
}

static tn_status put_parts(writing *w, const tn_parts *parts, uint32_t function, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t part = 0; status == TN_OK && part < parts->count; part++)
        status = put_part(w, parts, function, part, error);
    put(w, "\n");
    return status;
}

/* Functions that are called from some function on: those that were met, and those to be looked at of them. */
typedef struct reaching {
    bool *met;       /* [functions] */
    uint32_t *to_go; /* [functions] */
    uint32_t count;
} reaching;

static tn_status look_at(const writing *w, uint32_t function, reaching *r, tn_error *error)
{
    tn_parts parts = {0};
    tn_status status = tn_parts_read(w->module, function, &parts, error);
    for (uint32_t p = 0; status == TN_OK && p < parts.count; p++) {
        if (parts.parts[p].kind != TN_PART_RULE || r->met[parts.parts[p].function])
            continue;
        r->met[parts.parts[p].function] = true;
        r->to_go[r->count++] = parts.parts[p].function;
    }
    tn_parts_clear(&parts);
    return status;
}

/* Does a function come to call itself? */
static tn_status uses_itself(const writing *w, uint32_t function, bool *uses, tn_error *error)
{
    size_t functions = w->module->FUNCTION_count;
    reaching r = {calloc(functions + 1, sizeof *r.met), calloc(functions + 1, sizeof *r.to_go), 0};
    tn_status status = r.met && r.to_go ? look_at(w, function, &r, error) : tn_fail_memory(error);
    while (status == TN_OK && r.count > 0 && !r.met[function])
        status = look_at(w, r.to_go[--r.count], &r, error);
    *uses = status == TN_OK && r.met[function];
    free(r.met);
    free(r.to_go);
    return status;
}

/* Prologs that can remember what a predicate has answered do: stretches are asked about again and again. */
static void put_table(writing *w, uint32_t function)
{
    put(w, ":- if(current_op(_, fx, table)).\n:- table(");
    put_name(w, function, 0);
    put(w, "/3).\n:- endif.\n");
}

static tn_status put_function(writing *w, uint32_t function, tn_error *error)
{
    tn_parts parts = {0};
    bool itself;
    w->written[function] = true;
    tn_status status = uses_itself(w, function, &itself, error);
    if (status == TN_OK && itself)
        put_table(w, function);
    if (status == TN_OK)
        status = tn_parts_read(w->module, function, &parts, error);
    if (status == TN_OK)
        status = put_parts(w, &parts, function, error);
    tn_parts_clear(&parts);
    return status;
}

/* Functions and sums that are named, and are not there yet: what is written may name others. */
static tn_status put_asked(writing *w, tn_error *error)
{
    tn_status status = TN_OK;
    for (bool more = true; more && status == TN_OK;) {
        more = false;
        for (uint32_t s = 0; status == TN_OK && s < w->module->SUM_count; s++) {
            if (!w->asked_sums[s] || w->written_sums[s])
                continue;
            more = w->written_sums[s] = true;
            status = tn_prolog_put_sum(w, s, error);
        }
        for (uint32_t f = 0; status == TN_OK && f < w->module->FUNCTION_count; f++) {
            if (!w->asked[f] || w->written[f])
                continue;
            more = true;
            status = put_function(w, f, error);
        }
    }
    return status;
}

/* ---- rules and libraries */

/* The predicate of the rule's own name. */
static void put_own_name(writing *w, const tn_rule_record *rule)
{
    const char *name = tn_text(w->module, rule->name);
    if (w->fetch && strcmp(name, "prune_plan") == 0) {
        put(w, "% prune_plan/1 asks for the library: match_plan/2 asks for the rule\n\n");
        return;
    }
    if (tn_prolog_built_in(name)) {
        put(w, "% a built-in predicate has this name: match_plan/2 asks for the rule\n\n");
        return;
    }
    put_atom(w, name, NULL);
    put(w, "(Trays) :- plan_of(Trays, W), W = w(N, _), ");
    put_name(w, rule->holds, 0);
    put(w, "(W, 0, N), !.\n\n");
}

static bool says_rule(const writing *w, const tn_rule_record *rule)
{
    return w->said[rule->whole] && w->said[rule->holds];
}

static void put_heading(writing *w, const tn_rule_record *rule)
{
    const char *name = tn_text(w->module, rule->name), *doc = tn_text(w->module, rule->doc);
    put(w, "% ---- ");
    put(w, name);
    put(w, *doc ? ": " : "");
    put_comment(w, doc);
    put(w, says_rule(w, rule) ? "\n" : "\n% left out: this program has no words for all of it\n\n");
}

static tn_status put_rule(writing *w, uint32_t index, tn_error *error)
{
    const tn_rule_record *rule = &w->module->RULE_records[index];
    put_heading(w, rule);
    if (!says_rule(w, rule))
        return TN_OK;
    put_own_name(w, rule);
    tn_status status = put_function(w, rule->whole, error);
    return status == TN_OK ? put_function(w, rule->holds, error) : status;
}

/* Every rule by its name as an atom. */
static void put_rule_names(writing *w)
{
    put(w, "% ---- rules by name\n:- dynamic(rule_part/2).\n");
    for (size_t i = 0; i < w->module->RULE_count; i++) {
        const tn_rule_record *rule = &w->module->RULE_records[i];
        if (&w->module->SCHEMA_records[rule->schema] != w->schema->record || !says_rule(w, rule))
            continue;
        put(w, "rule_part(");
        put_atom(w, tn_text(w->module, rule->name), NULL);
        put(w, ", ");
        put_name(w, rule->holds, 0);
        put(w, ").\n");
    }
    put(w, "\nmatch_plan(Rule, Trays) :-\n"
           "    plan_of(Trays, W), W = w(N, _), rule_part(Rule, Part), call(Part, W, 0, N).\n\n");
}

/* The function of H of a preference. */
static uint32_t preferred(const tn_module *module, const tn_library_record *library, uint32_t i)
{
    return tn_preferred_term(module, library, i)->part;
}

/* Can every preference of the library be said? Else none is: a part of what they are worth together means nothing. */
static bool says_preferences(const writing *w, const tn_library_record *library)
{
    bool all = true;
    for (uint32_t i = 0; i < library->preference_count; i++)
        all = all && w->said[preferred(w->module, library, i)];
    return all;
}

/* What a preference is worth, as two whole numbers. */
static void put_preference(writing *w, const tn_library_record *library, uint32_t i)
{
    const char *worth = tn_text(w->module, tn_preferred_term(w->module, library, i)->factor);
    int size = (int)strcspn(worth, "/");
    put(w, "preference(");
    put_atom(w, tn_text(w->module, library->name), NULL);
    put(w, ", ");
    put_atom(w, tn_text(w->module, w->module->PREFERENCE_records[library->preference_first + i].name), NULL);
    put(w, ", ");
    put_name(w, preferred(w->module, library, i), 0);
    w->ok = w->ok && tn_buffer_printf(w->out, ", %.*s, %s).\n", size, worth, worth[size] ? worth + size + 1 : "1");
}

/* *any: becomes true if the library's are said. */
static void put_preferences(writing *w, const tn_library_record *library, bool *any)
{
    bool all = says_preferences(w, library);
    if (library->preference_count == 0)
        return;
    if (!all)
        put(w, "% Its preferences are left out: not all of them can be said here.\n");
    if (all && !*any)
        put(w, ":- discontiguous(preference/5).\n");
    for (uint32_t i = 0; all && i < library->preference_count; i++)
        put_preference(w, library, i);
    *any |= all;
}

static void put_clause(writing *w, const tn_library_record *library, const tn_clause_record *clause)
{
    put(w, clause->kind == TN_CLAUSE_PRUNE ? "prune_clause(" : "require_clause(");
    put_atom(w, tn_text(w->module, library->name), NULL);
    put(w, ", ");
    put_atom(w, tn_text(w->module, clause->name), NULL);
    put(w, ", ");
    put_name(w, clause->holds, 0);
    put(w, ").\n");
}

/* A library is nothing without one of its clauses. */
static tn_status check_clause(const writing *w, const tn_clause_record *clause, tn_error *error)
{
    tn_instruction image;
    if (w->said[clause->holds])
        return TN_OK;
    tn_status status = tn_fail(error, TN_INVALID, E_NO_PARTS, "the clause `%s` is not exported to Prolog",
                               tn_text(w->module, clause->name));
    if (tn_function_is_image(w->module, clause->holds, &image))
        tn_error_help(
            error, "it asks for plans of another schema, and the program has the trays of one: with --library and the "
                   "name of another one, this is left out");
    else
        tn_error_help(error, "the program has no words for all of it: it can be matched, explained, drawn and counted");
    if (error)
        error->code_offset = w->module->FUNCTION_records[clause->holds].code_begin;
    return status;
}

/* Is the library projected from one with other trays, and not the one that is asked for? Then the others are exported
 * without it. */
static bool is_left_out(const writing *w, const tn_library_record *library, const char *asked)
{
    tn_instruction image;
    bool projected = false;
    for (uint32_t i = 0; i < library->clause_count; i++)
        projected |=
            tn_function_is_image(w->module, w->module->CLAUSE_records[library->clause_first + i].holds, &image);
    return projected && !(asked && strcmp(asked, tn_text(w->module, library->name)) == 0);
}

static tn_status put_libraries(writing *w, const char *asked, tn_error *error)
{
    const tn_module *module = w->module;
    tn_status status = TN_OK;
    static const char *const facts[] = {"trays_of", "prune_clause", "require_clause"};
    bool prefers = false;
    put(w, "% ---- libraries\n");
    for (size_t i = 0; i < sizeof facts / sizeof *facts; i++)
        w->ok = w->ok && tn_buffer_printf(w->out, ":- dynamic(%s/3).\n:- discontiguous(%s/3).\n", facts[i], facts[i]);
    for (size_t l = 0; status == TN_OK && l < module->LIBRARY_count; l++) {
        const tn_library_record *library = &module->LIBRARY_records[l];
        if (&module->SCHEMA_records[library->schema] != w->schema->record)
            continue;
        if (is_left_out(w, library, asked)) {
            put(w, "% ");
            put_comment(w, tn_text(module, library->name));
            put(w, " is projected from a library with other trays, and is left out.\n");
            continue;
        }
        put(w, "trays_of(");
        put_atom(w, tn_text(module, library->name), NULL);
        w->ok =
            w->ok && tn_buffer_printf(w->out, ", %" PRIu32 ", %" PRIu32 ").\n", library->trays_min, library->trays_max);
        if (library->weight_count > 0)
            put(w, "% Its weights say which plans samples draw, and are left out.\n");
        if (tn_schema_of_plans(w->schema))
            put(w, "% For how many plans its trays stand is left out.\n");
        for (uint32_t i = 0; status == TN_OK && i < library->clause_count; i++) {
            put_clause(w, library, &module->CLAUSE_records[library->clause_first + i]);
            status = check_clause(w, &module->CLAUSE_records[library->clause_first + i], error);
        }
        put_preferences(w, library, &prefers);
    }
    put(w, "\nprune_plan(Library, Clause, Trays) :-\n"
           "    plan_of(Trays, W), W = w(N, _), prune_clause(Library, Clause, Part), call(Part, W, 0, N).\n"
           "keep_plan(Library, Trays) :-\n"
           "    plan_of(Trays, W), W = w(N, _), trays_of(Library, Min, Max), Min =< N, N =< Max,\n"
           "    \\+ ( require_clause(Library, _, Part), \\+ call(Part, W, 0, N) ),\n"
           "    \\+ ( prune_clause(Library, _, Part), call(Part, W, 0, N) ).\n\n");
    if (prefers)
        put(w, "% What the preferences that a plan meets are worth together: P / Q.\n"
               "plan_preference(Library, Trays, P, Q) :-\n"
               "    plan_of(Trays, W), W = w(N, _),\n"
               "    findall(A-B, ( preference(Library, _, Part, A, B), call(Part, W, 0, N) ), Met),\n"
               "    worth_together(Met, 0, 1, P, Q).\n"
               "worth_together([], P, Q, P, Q).\n"
               "worth_together([A-B|Met], P0, Q0, P, Q) :-\n"
               "    P1 is P0 * B + A * Q0, Q1 is Q0 * B, worth_together(Met, P1, Q1, P, Q).\n\n");
    return status;
}

static void put_lengths(writing *w)
{
    put(w, "% lengths of values, in nanometres\n:- dynamic(length_of/3).\n");
    for (uint32_t f = 0; f < w->schema->field_count; f++) {
        uint32_t kind = w->schema->fields[f].kind;
        for (uint32_t v = 0; v < w->schema->fields[f].value_count; v++) {
            const tn_value_record *value = &w->schema->values[w->schema->value_start[f] + v];
            if (kind != TN_FIELD_LENGTH && kind != TN_FIELD_ZONE)
                continue;
            w->ok = w->ok && tn_buffer_printf(w->out, "length_of(%" PRIu32 ", ", f + 1);
            put_atom(w, tn_text(w->module, value->spelling), NULL);
            w->ok = w->ok && tn_buffer_printf(w->out, ", %" PRId64 ").\n", (int64_t)value->length);
        }
    }
    put(w, "\n");
}

static void put_beginning(writing *w)
{
    const tn_schema *schema = w->schema;
    put(w, "% Trays of schema ");
    put(w, tn_text(w->module, schema->record->name));
    put(w, ": tray(");
    for (uint32_t f = 0; f < schema->field_count; f++) {
        put(w, f ? ", " : "");
        put(w, tn_text(w->module, schema->fields[f].name));
    }
    put(w, ").\n\n");
    put(w, tn_prolog_prelude);
    put(w, "\n");
    put_lengths(w);
}

/* Rules are numbered in the order in which they are written down: what one calls may come after it. */
static tn_status put_rules(writing *w, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < w->module->RULE_count; i++)
        if (&w->module->SCHEMA_records[w->module->RULE_records[i].schema] == w->schema->record)
            status = put_rule(w, i, error);
    return status;
}

/* ---- fetch/3 and prune_plan/1, as the paper's rules ask for them */

/* fetch(tray(_, V2, _), 'width', ...): *variable is V2. */
static void put_fetch(writing *w, uint32_t field, const char *before, const char *after)
{
    put(w, "fetch(tray(");
    for (uint32_t f = 0; f < w->schema->field_count; f++)
        w->ok = w->ok && (f == field ? tn_buffer_printf(w->out, "%sV", f ? ", " : "")
                                     : tn_buffer_printf(w->out, "%s_", f ? ", " : ""));
    put(w, "), ");
    put(w, before);
    put_atom(w, tn_text(w->module, w->schema->fields[field].name), NULL);
    put(w, after);
}

/* zone_of(V, Fill, Depth) of each value with a depth, zone_of(V, Fill) of all. */
static void put_zone(writing *w, uint32_t field, bool depths)
{
    for (uint32_t v = 0; v < w->schema->fields[field].value_count; v++) {
        const tn_value_record *value = &w->schema->values[w->schema->value_start[field] + v];
        const char *depth = tn_text(w->module, value->measure);
        if (depths && !*depth)
            continue;
        w->ok = w->ok && tn_buffer_printf(w->out, "zone_%s(%" PRIu32 ", ", depths ? "depth" : "fill", field + 1);
        put_atom(w, tn_text(w->module, value->spelling), NULL);
        put(w, ", ");
        put_atom(w, depths ? depth : tn_text(w->module, value->name), NULL);
        put(w, ").\n");
    }
}

static void put_accessors(writing *w)
{
    char goal[64];
    put(w, "% ---- fetch(Tray, Field, Value): a zone's fill, of depth(ZONE) its depth; of a flag true or false\n"
           ":- dynamic(zone_fill/3).\n:- dynamic(zone_depth/3).\n");
    for (uint32_t f = 0; f < w->schema->field_count; f++) {
        uint32_t kind = w->schema->fields[f].kind;
        if (kind == TN_FIELD_FLAG) {
            put_fetch(w, f, "", ", Set) :- ( V = '-' -> Set = false ; Set = true ).\n");
        } else if (kind == TN_FIELD_ZONE) {
            snprintf(goal, sizeof goal, ", Fill) :- zone_fill(%" PRIu32 ", V, Fill).\n", f + 1);
            put_fetch(w, f, "", goal);
            snprintf(goal, sizeof goal, "), Depth) :- zone_depth(%" PRIu32 ", V, Depth).\n", f + 1);
            put_fetch(w, f, "depth(", goal);
        } else {
            put_fetch(w, f, "", ", V).\n");
        }
    }
    for (uint32_t f = 0; f < w->schema->field_count; f++)
        if (w->schema->fields[f].kind == TN_FIELD_ZONE) {
            put_zone(w, f, false);
            put_zone(w, f, true);
        }
}

static void put_paper(writing *w, const char *library)
{
    put_accessors(w);
    put(w, "\n% what a library does not keep is pruned\nprune_plan(Trays) :- \\+ keep_plan(");
    if (library)
        put_atom(w, library, NULL);
    else
        put(w, "_");
    put(w, ", Trays).\n\n");
}

/* ---- the program */

static tn_status write_program(writing *w, const tn_prolog_options *options, tn_error *error)
{
    put_beginning(w);
    tn_status status = find_said(w, error);
    if (status == TN_OK)
        status = put_rules(w, error);
    put_rule_names(w);
    if (status == TN_OK)
        status = put_libraries(w, options->library, error);
    if (status == TN_OK)
        status = put_asked(w, error);
    if (options->fetch)
        put_paper(w, options->library);
    return status == TN_OK && !w->ok ? tn_fail_memory(error) : status;
}

tn_status tn_export_prolog(const tn_schema *schema, const tn_prolog_options *options, tn_buffer *out, tn_error *error)
{
    size_t functions = schema->module->FUNCTION_count + 1, sums = schema->module->SUM_count + 1;
    bool *marks = calloc(3 * functions + 2 * sums, sizeof *marks);
    if (!marks)
        return tn_fail_memory(error);
    writing w = {.schema = schema,
                 .module = schema->module,
                 .out = out,
                 .ok = true,
                 .said = marks,
                 .asked = marks + functions,
                 .written = marks + 2 * functions,
                 .asked_sums = marks + 3 * functions,
                 .written_sums = marks + 3 * functions + sums,
                 .fetch = options->fetch};
    tn_status status = write_program(&w, options, error);
    free(marks);
    return status;
}
