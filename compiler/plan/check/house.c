/* Checks what rules and libraries ask of houses: whose houses they are, and the cells, rooms, sections, faces and walks
 * that they name. */
#include <string.h>

#include "compiler/plan/check/form.h"
#include "runtime/base/nearest.h"

/* ---- the form that is meant */

tn_checked_form *tn_check_form_named(const tn_check *check, size_t unit, const char *name)
{
    for (size_t i = 0; i < check->result->form_count; i++) {
        tn_checked_form *form = check->result->forms[i];
        if (strcmp(form->name, name) == 0 && tn_import_reaches(check->imports, unit, form->unit))
            return form;
    }
    return NULL;
}

void tn_check_find_schema(tn_check *check, tn_checked_rule *rule)
{
    const tn_ast_word *using = rule->ast->using;
    bool schema = !using || tn_names_get(&check->schemas, using->text);
    rule->form = schema ? NULL : tn_check_form_named(check, rule->unit, using->text);
    rule->schema =
        rule->form ? rule->form->schema : tn_check_schema_for(check, rule->unit, using, rule->ast->name->node.span);
}

/* The first form of the schema that is in scope, if there is one. */
static const tn_checked_form *first_form(const tn_check *check)
{
    for (size_t i = 0; i < check->result->form_count; i++) {
        const tn_checked_form *form = check->result->forms[i];
        if (form->schema == check->schema && tn_import_reaches(check->imports, check->unit, form->unit))
            return form;
    }
    return NULL;
}

/* The name of a library of houses in the form; NULL: there is none. */
static const char *library_in(const tn_check *check, const tn_checked_form *form)
{
    for (size_t i = 0; form && i < check->result->library_count; i++)
        if (check->result->libraries[i]->form == form)
            return check->result->libraries[i]->name;
    return NULL;
}

static tn_checked_form *no_form(tn_check *check, tn_span place)
{
    if (check->incomplete || (!check->rule && check->form_wrong))
        return NULL;
    tn_diagnostic *d = tn_report(check->diagnostics, E_NO_FORM, place,
                                 "this asks for cells of houses, and no form says what they are");
    const tn_checked_form *form = first_form(check);
    const char *library = check->asking ? library_in(check, form) : NULL;
    if (library)
        tn_help(check->diagnostics, d, "the library is one of plans; `--library %s` asks about houses", library);
    else if (!check->rule)
        tn_help(check->diagnostics, d, "a library of houses is one `from` a library of plans `in` a form%s%s%s",
                form ? ": `from PLANS in " : "", form ? form->name : "", form ? "`" : "");
    else
        tn_help(check->diagnostics, d, "declare a form of schema `%s`, or `use` the file that does",
                check->schema ? check->schema->name : "...");
    return NULL;
}

/* The only form of the rule's schema that is in scope. */
static tn_checked_form *only_form(tn_check *check, tn_span place)
{
    tn_checked_form *found = NULL, *other = NULL;
    for (size_t i = 0; i < check->result->form_count && !other; i++) {
        tn_checked_form *form = check->result->forms[i];
        if (form->schema != check->schema || !tn_import_reaches(check->imports, check->unit, form->unit))
            continue;
        other = found;
        found = form;
    }
    if (!found)
        return no_form(check, place);
    if (!other)
        return found;
    tn_diagnostic *d = tn_report(check->diagnostics, E_NO_FORM, place,
                                 "several forms are in scope here, and it is not clear which one the houses have");
    tn_note(check->diagnostics, d, &other->ast->name->node.span, "form `%s`", other->name);
    tn_note(check->diagnostics, d, &found->ast->name->node.span, "form `%s`", found->name);
    tn_help(check->diagnostics, d, "write `using %s` or `using %s` after the name of the %s", other->name, found->name,
            check->rule->is_measure ? "measure" : "rule");
    return NULL;
}

static tn_checked_form *form_meant(tn_check *check, tn_span place)
{
    if (!check->schema || check->schema->broken)
        return NULL;
    tn_checked_form *form = check->rule ? check->rule->form : check->form;
    if (!form)
        form = check->rule ? only_form(check, place) : no_form(check, place);
    if (check->rule)
        check->rule->form = form;
    return form && form->broken ? NULL : form; /* what is wrong with it is said at its place */
}

void tn_check_same_form(tn_check *check, const tn_ast_expr *name)
{
    tn_checked_form *other = name->rule ? name->rule->form : NULL;
    if (!other)
        return;
    if (check->rule && !check->rule->form) {
        check->rule->form = other;
        return;
    }
    tn_checked_form *form = check->rule ? check->rule->form : check->form;
    if (!form) {
        no_form(check, name->node.span);
        return;
    }
    if (form == other || (!check->rule && check->form_wrong))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_OTHER_FORM, name->node.span,
                                 "`%s` is about houses of form `%s`, and this is about those of `%s`", name->rule->name,
                                 other->name, form->name);
    tn_note(check->diagnostics, d, &name->rule->ast->name->node.span, "`%s` is here", name->rule->name);
    tn_help(check->diagnostics, d, "use rules about one form together; `using %s` after a rule's name says which",
            form->name);
}

/* ---- what is asked */

static tn_checked_ask *new_ask(tn_check *check, tn_ast_expr *expr)
{
    tn_checked_form *form = form_meant(check, expr->node.span);
    tn_checked_ask *ask = form && form->schema ? TN_NEW(check->arena, tn_checked_ask) : NULL;
    if (ask)
        *ask = (tn_checked_ask){.form = form};
    return ask;
}

/* Can one walk through a face of the kind? Up and down by stairs. */
static bool is_passable(const tn_checked_form *form, uint32_t kind)
{
    return kind == TN_FACE_OPEN || kind == TN_FACE_STAIR ||
           (kind >= TN_FACE_KIND_COUNT && form->openings[kind - TN_FACE_KIND_COUNT].passage);
}

static bool is_walk(const tn_ast_expr *expr)
{
    return expr->kind == TN_EXPR_APART || expr->kind == TN_EXPR_WALK;
}

/* `by step-free`: all that one walks through but stairs, unless the form has an opening of this name. */
static bool is_step_free(const tn_ast_expr *expr, const tn_checked_form *form, const tn_ast_word *word)
{
    return is_walk(expr) && tn_word_is(word, "step-free") &&
           tn_form_opening_named(form, word->text) == TN_NONE;
}

static void add_step_free(tn_checked_ask *ask)
{
    ask->kinds[ask->kind_count++] = TN_FACE_OPEN;
    for (uint32_t i = 0; i < ask->form->opening_count; i++)
        if (ask->form->openings[i].passage && ask->form->openings[i].turn == TN_TURN_NONE)
            ask->kinds[ask->kind_count++] = TN_FACE_KIND_COUNT + i;
}

static bool read_kinds(tn_check *check, const tn_ast_expr *expr, tn_checked_ask *ask)
{
    bool good = true;
    size_t most = expr->kinds.count;
    for (TN_EACH(const tn_ast_word, word, expr->kinds))
        most += is_step_free(expr, ask->form, word) ? ask->form->opening_count : 0;
    ask->kinds = TN_NEW_ARRAY(check->arena, uint32_t, most);
    for (TN_EACH(const tn_ast_word, word, expr->kinds)) {
        if (ask->kinds && is_step_free(expr, ask->form, word)) {
            add_step_free(ask);
            continue;
        }
        uint32_t kind = ask->kinds ? tn_form_kind(check, ask->form, TN_FACE_RELATION_COUNT, word) : TN_NONE;
        good &= kind != TN_NONE;
        if (kind == TN_NONE)
            continue;
        ask->kinds[ask->kind_count++] = kind;
        if (!is_walk(expr) || is_passable(ask->form, kind))
            continue;
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_BAD_CELL, word->node.span, "nobody walks through `%s`", word->text);
        tn_help(check->diagnostics, d, "a walk goes by `open`, `stair` and the openings that are a `passage`");
        good = false;
    }
    return good;
}

static bool read_meeting(tn_check *check, const tn_ast_expr *expr, tn_checked_ask *ask)
{
    bool outside = expr->kind == TN_EXPR_WALK && expr->name;
    const tn_ast_expr *first = (const tn_ast_expr *)expr->parts.first, *next = (const tn_ast_expr *)first->node.next,
                      *second = outside ? NULL : next, *through = second ? (const tn_ast_expr *)second->node.next : next;
    bool good = tn_form_cell(check, ask->form, first, true, &ask->first);
    ask->to_outside = outside;
    if (second)
        good &= tn_form_cell(check, ask->form, second, true, &ask->second);
    ask->has_through = through != NULL;
    if (through)
        good &= tn_form_cell(check, ask->form, through, true, &ask->through);
    return read_kinds(check, expr, ask) && good;
}

/* Walks are over floors on which a person finds room. */
static bool has_ways(tn_check *check, const tn_ast_expr *expr, const tn_checked_form *form)
{
    if (form->way > 0)
        return true;
    bool feet = form->storey_count > 0 && tn_length_style_of(form->storeys[0].ast->length->text) == TN_STYLE_FEET;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_BAD_WALK, expr->node.span,
                  "nobody knows how one walks in houses of form `%s`: it does not say how wide a person is", form->name);
    tn_note(check->diagnostics, d, &form->ast->name->node.span, "form `%s` is here", form->name);
    tn_help(check->diagnostics, d, "add a line such as `way %s` to the form", feet ? "2'8\"" : "800mm");
    return false;
}

/* Where a walk leads to is cells, or the outside. */
static bool leads_somewhere(tn_check *check, const tn_ast_expr *walk)
{
    if (walk->kind != TN_EXPR_WALK || !walk->name || tn_word_is(walk->name, "outside"))
        return true;
    static const char *const words[] = {"outside", "outdoors", "out"};
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_WALK, walk->name->node.span,
                                 "a walk leads to cells or to `outside`, not to `%s`", walk->name->text);
    if (tn_nearest(walk->name->text, words, sizeof words / sizeof *words))
        tn_suggest(check->diagnostics, d, "outside");
    else
        tn_help(check->diagnostics, d, "write `to cell(%s)` if that is a function of the form", walk->name->text);
    return false;
}

void tn_check_ask(tn_check *check, tn_ast_expr *expr)
{
    tn_checked_ask *ask = new_ask(check, expr);
    bool walks = expr->kind == TN_EXPR_WALK || expr->kind == TN_EXPR_EXITS;
    if (!ask)
        return;
    bool good = !walks || leads_somewhere(check, expr);
    good = (!walks || has_ways(check, expr, ask->form)) && good; /* says what it lacks, too */
    if (!good)
        return;
    if (expr->kind == TN_EXPR_EXITS)
        tn_form_cell(check, ask->form, (const tn_ast_expr *)expr->parts.first, true, &ask->first);
    else if (expr->kind == TN_EXPR_CELL)
        tn_form_cell(check, ask->form, expr, true, &ask->first);
    else if (expr->kind == TN_EXPR_SECTION)
        tn_form_section(check, ask->form, expr, &ask->first);
    else if (expr->kind == TN_EXPR_ROOM)
        tn_form_room(check, ask->form, expr, &ask->first);
    else
        read_meeting(check, expr, ask);
    expr->ask = ask;
}

/* ---- areas */

static bool names_cells(const tn_ast_expr *expr)
{
    if (expr->kind == TN_EXPR_CELL)
        return true;
    bool joined = expr->kind == TN_EXPR_AND || expr->kind == TN_EXPR_OR || expr->kind == TN_EXPR_NOT;
    return joined && names_cells((const tn_ast_expr *)expr->parts.first);
}

bool tn_sums_areas(const tn_ast_expr *sum)
{
    const tn_ast_expr *part = (const tn_ast_expr *)sum->parts.first;
    return part && sum->name && !sum->detail && tn_word_is(sum->name, "area") && names_cells(part);
}

void tn_check_areas(tn_check *check, tn_ast_expr *sum)
{
    tn_checked_ask *ask = new_ask(check, sum);
    if (sum->condition)
        sum->condition_checked = tn_check_condition(check, sum->condition, TN_AREAS);
    if (ask)
        tn_form_cell(check, ask->form, (const tn_ast_expr *)sum->parts.first, true, &ask->first);
    sum->ask = ask;
}

/* ---- what measures of houses add up */

tn_ast_expr *tn_counts_house(const tn_ast_expr *quantity)
{
    tn_ast_expr *part = (tn_ast_expr *)quantity->parts.first;
    if (part->kind == TN_EXPR_NAME)
        part = part->rule && !part->rule->is_measure ? part->rule->meaning : NULL;
    return part && (part->kind == TN_EXPR_CELL || part->kind == TN_EXPR_ROOM) ? part : NULL;
}

/* A field or a number of that name goes first. */
bool tn_sums_cost(const tn_check *check, const tn_ast_expr *sum)
{
    return !sum->parts.first && sum->name && !sum->detail && tn_word_is(sum->name, "cost") && check->schema &&
           tn_field_find(check->schema, "cost") == TN_NONE && !tn_schema_number(check->schema, "cost");
}

void tn_check_cost(tn_check *check, tn_ast_expr *sum)
{
    sum->ask = new_ask(check, sum);
}

/* Does it ask for cells, rooms, sections or walks, itself or by a rule that it names? NULL does not. */
static bool asks_house(const tn_ast_expr *expr)
{
    if (!expr)
        return false;
    bool asks = expr->ask || (expr->kind == TN_EXPR_NAME && expr->rule && expr->rule->form);
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        asks |= asks_house(part);
    for (TN_EACH(const tn_ast_expr, test, expr->tests))
        asks |= asks_house(test);
    for (TN_EACH(const tn_ast_expr, idle, expr->idle)) /* with another value of a param they are asked */
        asks |= asks_house(idle);
    return asks;
}

static bool term_asks_house(const tn_checked_term *term)
{
    return term->rule ? term->rule->form != NULL : asks_house(term->part);
}

void tn_check_house_sum(tn_check *check, const tn_checked_sum *sum)
{
    for (size_t i = 0; i < sum->count; i++) {
        const tn_checked_term *term = &sum->terms[i];
        if (term->kind >= TN_TERM_CELLS || !term_asks_house(term))
            continue;
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_HOUSE_CLAUSE, term->span,
                      "a measure counts trays and places of plans, and cells and rooms of houses, not both at once");
        tn_help(
            check->diagnostics, d,
            "of houses write `quantity(cell(...))`, `quantity(room(...))`, `sum(area of cell(...))` or `sum(cost)`");
    }
}

/* `matches` is no number of trays: a comparison asks for it by itself. */
static void check_compared_trays(tn_check *check, const tn_checked_sum *sum)
{
    for (size_t i = 0; i < sum->count; i++) {
        const tn_checked_term *term = &sum->terms[i];
        if (term->kind == TN_TERM_MATCHES || !term_asks_house(term))
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, E_HOUSE_CLAUSE, term->span,
                                     "this is about houses, and the trays that it is so of cannot be counted in a "
                                     "comparison of sums");
        tn_help(check->diagnostics, d,
                "write the condition inside, as in `sum(FIELD of cell(...), n >= 4m)` or `occurrences(..., n > 1)`; "
                "cells and rooms are counted by `quantity(cell(...))` and `quantity(room(...))`");
        return;
    }
}

void tn_check_compared_sum(tn_check *check, const tn_checked_sum *sum)
{
    if (sum->houses)
        tn_check_house_sum(check, sum);
    else
        check_compared_trays(check, sum);
}

/* ---- records */

void tn_check_number_records(tn_check *check)
{
    tn_checked *result = check->result;
    uint32_t of_plans = 0, of_houses = 0;
    for (size_t i = 0; i < result->rule_count; i++) {
        tn_checked_rule *rule = result->rules[i];
        if (!rule->is_measure && !rule->hidden)
            rule->index = rule->form ? of_houses++ : of_plans++;
    }
    of_plans = of_houses = 0;
    for (size_t i = 0; i < result->rule_count; i++) {
        tn_checked_rule *rule = result->rules[i];
        if (rule->is_measure && (!rule->hidden || rule->listed))
            rule->index = rule->form ? of_houses++ : of_plans++;
    }
    of_plans = of_houses = 0;
    for (size_t i = 0; i < result->library_count; i++)
        result->libraries[i]->index = result->libraries[i]->form ? of_houses++ : of_plans++;
}
