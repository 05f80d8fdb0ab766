/* Writes rules as a Prolog program. */
#include "runtime/plan/text/export_prolog.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/plan/match/parts.h"
#include "runtime/plan/schema/sum.h"

/* The judgements of docs/plan-language.md that are not a rule's own. w(N, Plan) is a plan of N trays, [I, J) a stretch
 * of it. */
extern const char tn_prolog_prelude[];

/* ---- holds the beginning of exported Prolog programs, and the names that they may not define */

const char tn_prolog_prelude[] =
    "plan_of(Trays, w(N, Plan)) :- Plan =.. [plan|Trays], functor(Plan, _, N).\n"
    "tray_at(w(_, Plan), I, Tray) :- K is I + 1, arg(K, Plan, Tray).\n"
    "\n"
    "from_to(I, J, I) :- I =< J.\n"
    "from_to(I, J, K) :- I < J, I1 is I + 1, from_to(I1, J, K).\n"
    "\n"
    "one_of(X, [X|_]) :- !.\n"
    "one_of(X, [_|Xs]) :- one_of(X, Xs).\n"
    "\n"
    "stretch(I, J, A, B) :- Last is J - 1, from_to(I, Last, A), A1 is A + 1, from_to(A1, J, B).\n"
    "somewhere(Part, W, I, J) :- stretch(I, J, A, B), call(Part, W, A, B), !.\n"
    "\n"
    "% Parts side by side; may(Part) can be left out.\n"
    "side_by_side([], _, I, I).\n"
    "side_by_side([may(Part)|Parts], W, I, J) :- side_by_side([Part|Parts], W, I, J), !.\n"
    "side_by_side([may(_)|Parts], W, I, J) :- !, side_by_side(Parts, W, I, J).\n"
    "side_by_side([Part|Parts], W, I, J) :-\n"
    "    needed(Parts, R), Last is J - R, I1 is I + 1, from_to(I1, Last, C), call(Part, W, I, C),\n"
    "    side_by_side(Parts, W, C, J), !.\n"
    "needed([], 0).\n"
    "needed([may(_)|Parts], R) :- !, needed(Parts, R).\n"
    "needed([_|Parts], R) :- needed(Parts, R1), R is R1 + 1.\n"
    "\n"
    "at_beginning(_, I, _) :- I =:= 0.\n"
    "at_end(w(N, _), _, J) :- J =:= N.\n"
    "\n"
    "mirrored(Part, w(N, Plan), I, J) :-\n"
    "    Plan =.. [plan|Trays], reversed(Trays, [], Back), plan_of(Back, W), A is N - J, B is N - I, call(Part, W, A, "
    "B).\n"
    "reversed([], Back, Back).\n"
    "reversed([T|Ts], Done, Back) :- reversed(Ts, [T|Done], Back).\n"
    "\n"
    "every_tray(Part, W, I, J) :-\n"
    "    I < J, Last is J - 1, \\+ (from_to(I, Last, K), K1 is K + 1, \\+ call(Part, W, K, K1)).\n"
    "\n"
    "% The part several times side by side; each takes a tray at least.\n"
    "repeated(Least, Most, Part, W, I, J) :- repeated(Least, Most, 0, Part, W, I, J), !.\n"
    "repeated(Least, _, N, _, _, J, J) :- N >= Least.\n"
    "repeated(Least, Most, N, Part, W, I, J) :-\n"
    "    ( Most == inf -> true ; N < Most ), I < J, N1 is N + 1, R is max(0, Least - N1), Last is J - R, I1 is I + 1,\n"
    "    from_to(I1, Last, C), call(Part, W, I, C), repeated(Least, Most, N1, Part, W, C, J).\n"
    "\n"
    "count(_, _, J, J, 0) :- !.\n"
    "count(Part, W, I, J, N) :-\n"
    "    I1 is I + 1, count(Part, W, I1, J, M), ( call(Part, W, I, I1) -> N is M + 1 ; N = M ).\n"
    "\n"
    "sum(_, _, _, J, J, 0) :- !.\n"
    "sum(Field, Part, W, I, J, S) :-\n"
    "    I1 is I + 1, sum(Field, Part, W, I1, J, R),\n"
    "    ( call(Part, W, I, I1) -> tray_at(W, I, Tray), arg(Field, Tray, V), length_of(Field, V, L), S is R + L ; S = "
    "R ).\n"
    "\n"
    "starts(Part, W, I, J, N) :- starts(Part, W, I, I, J, N).\n"
    "starts(_, _, _, J, J, 0) :- !.\n"
    "starts(Part, W, I, K, J, N) :-\n"
    "    K1 is K + 1, starts(Part, W, I, K1, J, M),\n"
    "    ( from_to(K1, J, B), call(Part, W, K, B) -> N is M + 1 ; N = M ).\n"
    "\n"
    "% Some source such that what separates it from every destination meets the separator.\n"
    "distance(Source, Destination, Separator, W, I, J) :-\n"
    "    I < J, call(Source, W, I, J), W = w(N, _),\n"
    "    \\+ ( stretch(0, N, A, B), call(Destination, W, A, B), gap(I, J, A, B, G, H), \\+ call(Separator, W, G, H) "
    ").\n"
    "% Some destination, or every one, that shares no tray with the source is at a gap that meets the separator.\n"
    "near(Source, Destination, Separator, W, I, J) :-\n"
    "    I < J, call(Source, W, I, J), around(Destination, W, I, J, G, H), call(Separator, W, G, H), !.\n"
    "far(Source, Destination, Separator, W, I, J) :-\n"
    "    I < J, call(Source, W, I, J),\n"
    "    \\+ ( around(Destination, W, I, J, G, H), \\+ call(Separator, W, G, H) ).\n"
    "around(Destination, W, I, J, G, H) :-\n"
    "    W = w(N, _), stretch(0, N, A, B), ( B =< I ; J =< A ), call(Destination, W, A, B), gap(I, J, A, B, G, H).\n"
    "gap(I, _, _, B, B, I) :- B =< I, !.\n"
    "gap(_, J, A, _, J, A) :- J =< A, !.\n"
    "gap(I, _, _, _, I, I).\n";

/* Built-in predicates of one argument (ISO/IEC 13211-1, Cor. 1 to 3), which a program may not define. */
static const char *const built_in[] = {
    "abolish",       "acyclic_term",    "assert",        "asserta",    "assertz",      "atom",
    "atomic",        "callable",        "call",          "close",      "compound",     "consult",
    "discontiguous", "dynamic",         "ensure_loaded", "float",      "flush_output", "get_byte",
    "get_char",      "get_code",        "ground",        "halt",       "include",      "initialization",
    "integer",       "is_list",         "listing",       "multifile",  "nl",           "nonvar",
    "not",           "number",          "once",          "op",         "peek_byte",    "peek_char",
    "peek_code",     "print",           "put_byte",      "put_char",   "put_code",     "read",
    "retract",       "retractall",      "set_input",     "set_output", "throw",        "var",
    "write",         "write_canonical", "writeq",
};

/* Is this a built-in predicate of one argument, which a program may not define? */
static bool prolog_built_in(const char *name)
{
    for (size_t i = 0; i < sizeof built_in / sizeof *built_in; i++)
        if (strcmp(built_in[i], name) == 0)
            return true;
    return false;
}

/* A program being written. */
typedef struct writing {
    const tn_schema *schema;
    const tn_module *module;
    tn_buffer *out;
    bool ok;
    bool *left_out; /* [rules]: they say what the prelude has no words for */
} writing;

static void put(writing *w, const char *text)
{
    w->ok = w->ok && tn_buffer_append(w->out, text, strlen(text));
}

/* The rest of a comment, on one line whatever an author wrote. */
static void put_comment(writing *w, const char *text)
{
    for (const char *c = text; *c; c++)
        put(w, (unsigned char)*c < 0x20 ? " " : (char[]){*c, '\0'});
}

/* A quoted atom. */
static void put_atom(writing *w, const char *text, const char *more)
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

/* The predicate of a function's part: 'rule whole', 'rule whole 3'. */
static void put_name(writing *w, uint32_t function, uint32_t part)
{
    char suffix[64];
    const tn_function_record *record = &w->module->FUNCTION_records[function];
    uint32_t rule = tn_function_rule(w->module, function);
    const char *kind = tn_function_is_whole(record) ? "whole" : "somewhere";
    if (part == 0 && rule != UINT32_MAX)
        snprintf(suffix, sizeof suffix, " %s", kind);
    else if (part == 0)
        snprintf(suffix, sizeof suffix, " %s %" PRIu32, kind, function);
    else
        snprintf(suffix, sizeof suffix, " %s %" PRIu32 " %" PRIu32, kind, function, part);
    put_atom(w, tn_text(w->module, record->name), suffix);
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

static void put_tray(writing *w, uint32_t spec)
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

static void put_body(writing *w, const tn_parts *parts, uint32_t function, uint32_t part)
{
    const tn_part *it = &parts->parts[part];
    switch (it->kind) {
    case TN_PART_TRAY:
        put_tray(w, it->spec);
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
}

static void put_part(writing *w, const tn_parts *parts, uint32_t function, uint32_t part)
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
    put_body(w, parts, function, part);
    put(w, ", !.\n");
}

/* What the predicates of the prelude have no words for; NULL where they have words for all of it. *part is which. */
static const char *no_words(const writing *w, const tn_parts *parts, uint32_t *part)
{
    for (*part = 0; *part < parts->count; ++*part) {
        const tn_part *it = &parts->parts[*part];
        if (it->kind == TN_PART_COMPARISON)
            return "a comparison of sums";
        if (it->kind == TN_PART_RULE && it->rule == UINT32_MAX)
            return "a call of a rule with parameters";
        if (it->kind == TN_PART_RULE && w->left_out[it->rule])
            return "a rule that is not exported";
    }
    return NULL;
}

static void put_parts(writing *w, const tn_parts *parts, uint32_t function)
{
    for (uint32_t part = 0; part < parts->count; part++)
        put_part(w, parts, function, part);
    put(w, "\n");
}

/* The function of a clause that is no rule of its own. */
static tn_status put_function(writing *w, uint32_t function, tn_error *error)
{
    tn_parts parts;
    uint32_t part;
    tn_status status = tn_parts_read(w->module, function, &parts, error);
    const char *lacks = status == TN_OK ? no_words(w, &parts, &part) : NULL;
    if (lacks) {
        status = tn_fail(error, TN_INVALID, E_NO_PARTS, "a clause with %s is not exported to Prolog", lacks);
        tn_error_help(error, "it can be matched, explained, drawn and counted");
        if (error)
            error->code_offset = parts.parts[part].root;
    } else if (status == TN_OK) {
        put_parts(w, &parts, function);
    }
    tn_parts_clear(&parts);
    return status;
}

/* ---- rules and libraries */

/* The predicate of the rule's own name. */
static void put_own_name(writing *w, const tn_rule_record *rule)
{
    const char *name = tn_text(w->module, rule->name);
    if (prolog_built_in(name)) {
        put(w, "% a built-in predicate has this name: match_plan/2 asks for the rule\n\n");
        return;
    }
    put_atom(w, name, NULL);
    put(w, "(Trays) :- plan_of(Trays, W), W = w(N, _), ");
    put_name(w, rule->holds, 0);
    put(w, "(W, 0, N), !.\n\n");
}

static void put_heading(writing *w, const tn_rule_record *rule, const char *lacks)
{
    const char *name = tn_text(w->module, rule->name), *doc = tn_text(w->module, rule->doc);
    put(w, "% ---- ");
    put(w, name);
    put(w, *doc ? ": " : "");
    put_comment(w, doc);
    if (lacks) {
        put(w, "\n% left out, as it has ");
        put(w, lacks);
        put(w, "\n");
    }
    put(w, "\n");
}

static tn_status put_rule(writing *w, uint32_t index, tn_error *error)
{
    const tn_rule_record *rule = &w->module->RULE_records[index];
    tn_parts whole = {0}, holds = {0};
    uint32_t part;
    tn_status status = tn_parts_read(w->module, rule->whole, &whole, error);
    if (status == TN_OK)
        status = tn_parts_read(w->module, rule->holds, &holds, error);
    if (status == TN_OK) {
        const char *lacks = no_words(w, &whole, &part);
        if (!lacks)
            lacks = no_words(w, &holds, &part);
        put_heading(w, rule, lacks);
        w->left_out[index] = lacks != NULL;
        if (!lacks) {
            put_own_name(w, rule);
            put_parts(w, &whole, rule->whole);
            put_parts(w, &holds, rule->holds);
        }
    }
    tn_parts_clear(&whole);
    tn_parts_clear(&holds);
    return status;
}

/* Every rule by its name as an atom. */
static void put_rule_names(writing *w)
{
    put(w, "% ---- rules by name\n:- dynamic(rule_part/2).\n");
    for (size_t i = 0; i < w->module->RULE_count; i++) {
        const tn_rule_record *rule = &w->module->RULE_records[i];
        if (&w->module->SCHEMA_records[rule->schema] != w->schema->record || w->left_out[i])
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

/* *all: can every preference of the library be said in Prolog? Else none is: a part of what they are worth together
 * means nothing. */
static tn_status says_preferences(const writing *w, const tn_library_record *library, bool *all, tn_error *error)
{
    tn_status status = TN_OK;
    *all = library->preference_count > 0;
    for (uint32_t i = 0; status == TN_OK && *all && i < library->preference_count; i++) {
        uint32_t function = preferred(w->module, library, i), rule = tn_function_rule(w->module, function), part;
        tn_parts parts = {0};
        if (rule == UINT32_MAX) {
            status = tn_parts_read(w->module, function, &parts, error);
            *all = status == TN_OK && !no_words(w, &parts, &part);
            tn_parts_clear(&parts);
        } else {
            *all = !w->left_out[rule];
        }
    }
    return status;
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
static tn_status put_preferences(writing *w, const tn_library_record *library, bool *any, tn_error *error)
{
    bool all;
    tn_status status = says_preferences(w, library, &all, error);
    if (!all && library->preference_count > 0)
        put(w, "% Its preferences are left out: not all of them can be said here.\n");
    if (all && !*any)
        put(w, ":- discontiguous(preference/5).\n");
    for (uint32_t i = 0; all && i < library->preference_count; i++)
        put_preference(w, library, i);
    *any |= all;
    return status;
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
    uint32_t rule = tn_function_rule(w->module, clause->holds);
    if (rule == UINT32_MAX || !w->left_out[rule])
        return TN_OK;
    tn_status status = tn_fail(error, TN_INVALID, E_NO_PARTS, "the rule `%s` of a clause is not exported to Prolog",
                               tn_text(w->module, w->module->RULE_records[rule].name));
    tn_error_help(error,
                  "it compares sums or calls a rule with parameters: it can be matched, explained, drawn and counted");
    return status;
}

/* What clauses of these libraries say that is no rule of its own. Those of libraries of houses are not about plans. */
static tn_status put_clauses(writing *w, tn_error *error)
{
    const tn_module *module = w->module;
    bool *asked = calloc((size_t)module->FUNCTION_count + 1, sizeof *asked);
    tn_status status = asked ? TN_OK : tn_fail_memory(error);
    for (uint32_t l = 0; status == TN_OK && l < module->LIBRARY_count; l++) {
        const tn_library_record *library = &module->LIBRARY_records[l];
        bool ours = &module->SCHEMA_records[library->schema] == w->schema->record;
        for (uint32_t i = 0; ours && i < library->clause_count; i++)
            asked[module->CLAUSE_records[library->clause_first + i].holds] = true;
        bool prefers = false;
        status = ours ? says_preferences(w, library, &prefers, error) : TN_OK;
        for (uint32_t i = 0; prefers && i < library->preference_count; i++)
            asked[preferred(module, library, i)] = true;
    }
    for (uint32_t f = 0; status == TN_OK && f < module->FUNCTION_count; f++)
        if (asked[f] && tn_function_rule(module, f) == UINT32_MAX)
            status = put_function(w, f, error);
    free(asked);
    return status;
}

static tn_status put_libraries(writing *w, tn_error *error)
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
        put(w, "trays_of(");
        put_atom(w, tn_text(module, library->name), NULL);
        w->ok =
            w->ok && tn_buffer_printf(w->out, ", %" PRIu32 ", %" PRIu32 ").\n", library->trays_min, library->trays_max);
        if (library->weight_count > 0)
            put(w, "% Its weights say which plans samples draw, and are left out.\n");
        for (uint32_t i = 0; status == TN_OK && i < library->clause_count; i++) {
            put_clause(w, library, &module->CLAUSE_records[library->clause_first + i]);
            status = check_clause(w, &module->CLAUSE_records[library->clause_first + i], error);
        }
        if (status == TN_OK)
            status = put_preferences(w, library, &prefers, error);
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
    return status == TN_OK ? put_clauses(w, error) : status;
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

/* Marks the rules that are left out, and those that call one, until there are no more. */
static tn_status find_left_out(writing *w, tn_error *error)
{
    tn_buffer nothing = {0}, *out = w->out;
    tn_status status = TN_OK;
    w->out = &nothing;
    for (uint32_t before = 1, found = 0; status == TN_OK && found != before;) {
        before = found;
        found = 0;
        nothing.size = 0;
        status = put_rules(w, error);
        for (uint32_t i = 0; i < w->module->RULE_count; i++)
            found += w->left_out[i];
    }
    free(nothing.data);
    w->out = out;
    return status;
}

tn_status tn_export_prolog(const tn_schema *schema, tn_buffer *out, tn_error *error)
{
    writing w = {schema, schema->module, out, true, calloc(schema->module->RULE_count + 1, sizeof(bool))};
    if (!w.left_out)
        return tn_fail_memory(error);
    put_beginning(&w);
    tn_status status = find_left_out(&w, error);
    if (status == TN_OK)
        status = put_rules(&w, error);
    put_rule_names(&w);
    if (status == TN_OK)
        status = put_libraries(&w, error);
    free(w.left_out);
    return status == TN_OK && !w.ok ? tn_fail_memory(error) : status;
}
