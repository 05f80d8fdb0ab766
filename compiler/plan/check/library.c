/* Libraries: clauses with their names, and what one library takes over from another. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/form.h"

enum { UNSEEN, OPEN, DONE };

/* ---- clauses and their names */

static void put_clause(tn_check *check, tn_checked_library *library, tn_checked_clause *clause)
{
    tn_checked_clause **clauses =
        tn_arena_room(check->arena, library->clauses, library->clause_count, &library->clause_capacity);
    if (!clauses)
        return;
    library->clauses = clauses;
    library->clauses[library->clause_count++] = clause;
    tn_names_put(&library->clause_names, clause->name, clause);
}

static const char *make_name(tn_check *check, const tn_names *names, const char *word, size_t number)
{
    char name[64], numbered[96];
    snprintf(name, sizeof name, "%s@%zu", word, number);
    snprintf(numbered, sizeof numbered, "%s", name);
    for (unsigned n = 2; tn_names_get(names, numbered); n++)
        snprintf(numbered, sizeof numbered, "%s.%u", name, n);
    return tn_arena_copy(check->arena, numbered, strlen(numbered));
}

const char *tn_clause_name(tn_check *check, const tn_names *names, const char *word, tn_span span)
{
    return make_name(check, names, word, tn_sources_place(check->diagnostics->sources, span).line);
}

/* Is the name that the author gave free? Where it is not, says so. The same rule pruned twice is harmless. */
static bool name_is_free(tn_check *check, const tn_checked_library *library, const tn_checked_clause *clause,
                         tn_span place)
{
    const tn_checked_clause *before = tn_names_get(&library->clause_names, clause->name);
    if (!before)
        return true;
    if (clause->rule && before->rule == clause->rule && before->kind == clause->kind) {
        if (tn_check_wanted(check, W_PRUNED_TWICE)) {
            const char *verb = clause->kind == TN_CLAUSE_PRUNE      ? "prunes"
                               : clause->kind == TN_CLAUSE_GENERATE ? "generates"
                                                                    : "requires";
            tn_diagnostic *d = tn_report(check->diagnostics, W_PRUNED_TWICE, place, "library `%s` %s `%s` twice",
                                         library->name, verb, clause->name);
            tn_note(check->diagnostics, d, &before->span, "the first time is here");
            tn_help(check->diagnostics, d, "leave this one out");
        }
        return false;
    }
    tn_diagnostic *d = tn_report(check->diagnostics, E_DUPLICATE_CLAUSE, place,
                                 "library `%s` has a clause `%s` already", library->name, clause->name);
    tn_note(check->diagnostics, d, &before->span, "it is here");
    tn_help(check->diagnostics, d, "give one of the two another name with `as`");
    return false;
}

void tn_check_clause_expr(tn_check *check, tn_ast_clause *clause)
{
    check->met_param = false;
    tn_expand(check, &clause->expr);
    check->settable = check->met_param;
    tn_ast_expr *expr = clause->expr;
    size_t unit = check->unit;
    tn_checked_schema *schema = check->schema;
    tn_ast_list allow = check->allow;
    tn_check_settle(check);
    check->unit = unit;
    check->schema = schema;
    check->allow = allow;
    check->rule = NULL;
    tn_check_expr(check, expr);
    tn_check_meaning(check, expr);
    tn_check_around(check, expr);
    tn_check_whole(check, expr);
    tn_check_warnings(check, expr);
}

/* A clause that is a rule's name has its name and text; but not one that calls a rule with arguments. */
tn_checked_rule *tn_clause_rule(const tn_ast_expr *expr)
{
    tn_checked_rule *rule = expr->kind == TN_EXPR_NAME ? expr->rule : NULL;
    return rule && (!rule->hidden || !rule->of->is_template) ? rule : NULL;
}

static void add_expr_clause(tn_check *check, tn_checked_library *library, tn_ast_clause *ast, tn_checked_clause *clause)
{
    tn_check_clause_expr(check, ast);
    clause->settable = check->settable;
    check->settable = false;
    clause->expr = ast->expr;
    clause->rule = tn_clause_rule(clause->expr);
    if (clause->rule) {
        clause->name = clause->rule->name;
        if (!clause->doc && clause->rule->ast->doc)
            clause->doc = clause->rule->ast->doc->text;
    }
    if (ast->name)
        clause->name = ast->name->text;
    if (ast->name && !tn_name_fits(check->diagnostics, clause->name, ast->name->node.span))
        return;
    if (clause->name) {
        if (name_is_free(check, library, clause, ast->name ? ast->name->node.span : ast->expr->node.span))
            put_clause(check, library, clause);
    } else {
        const char *word = ast->form == TN_FORM_PRUNE      ? "prune"
                           : ast->form == TN_FORM_GENERATE ? "generate"
                                                           : "require";
        clause->name = tn_clause_name(check, &library->clause_names, word, ast->node.span);
        if (clause->name)
            put_clause(check, library, clause);
    }
}

/* The fields of lengths that there are, and a zone, whose depths are added. */
static void help_total(tn_check *check, tn_diagnostic *d, const tn_checked_schema *schema)
{
    char names[300] = "";
    size_t used = 0;
    for (uint32_t f = 0; f < schema->field_count && used < sizeof names; f++)
        if (schema->fields[f].kind == TN_FIELD_LENGTH || schema->fields[f].kind == TN_FIELD_ZONE)
            used += (size_t)snprintf(names + used, sizeof names - used, "%s`total %s ...`", used ? ", " : "",
                                     schema->fields[f].name);
    if (used)
        tn_help(check->diagnostics, d, "lengths are added up by %s", names);
    else
        tn_help(check->diagnostics, d, "give the schema a field of lengths, such as `width = 3m | 4m`");
}

static void add_total(tn_check *check, tn_checked_library *library, const tn_ast_clause *ast, tn_checked_clause *clause)
{
    const tn_checked_schema *schema = library->schema;
    clause->field = ast->field ? tn_field_find(schema, ast->field->text) : schema->length_field;
    const tn_checked_field *field = clause->field == TN_NONE ? NULL : &schema->fields[clause->field];
    if (!field || (field->kind != TN_FIELD_LENGTH && field->kind != TN_FIELD_ZONE)) {
        if (schema->broken)
            return;
        tn_span place = ast->field ? ast->field->node.span : ast->node.span;
        tn_diagnostic *d = ast->field
                               ? tn_report(check->diagnostics, E_NOT_A_LENGTH, place,
                                           "schema `%s` has no field of lengths `%s`", schema->name, ast->field->text)
                               : tn_report(check->diagnostics, E_NO_LENGTH_FIELD, place,
                                           "schema `%s` has no field of lengths to add up", schema->name);
        tn_note(check->diagnostics, d, &schema->ast->name->node.span, "schema `%s` is here", schema->name);
        help_total(check, d, schema);
        return;
    }
    if (!tn_check_detail(check, field, ast->detail))
        return;
    clause->condition = tn_check_total(check, ast, clause->field);
    clause->any = tn_check_any(check, library->schema, ast->node.span);
    clause->name = "total"; /* several have the same name: `drop ... by total` means any of them */
    if (clause->condition)
        put_clause(check, library, clause);
}

/* A plan has as many trays as the one that lies above it. */
static void report_projected_trays(tn_check *check, const tn_checked_library *library, const tn_ast_clause *ast)
{
    const tn_checked_library *from = library->from;
    tn_diagnostic *d = tn_report(check->diagnostics, E_TRAYS_TWICE, ast->node.span,
                                 "the plans of `%s` have as many trays as those of `%s`", library->name, from->name);
    if (from->trays)
        tn_note(check->diagnostics, d, &from->trays->node.span, "how many these have is said here");
    tn_help(check->diagnostics, d, "leave this out, or write it in a library that is made `from %s`", library->name);
}

static void set_trays(tn_check *check, tn_checked_library *library, const tn_ast_clause *ast)
{
    if (library->ast->onto && library->from) {
        report_projected_trays(check, library, ast);
        return;
    }
    bool own = library->trays && (!library->from || library->trays != library->from->trays);
    if (own) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_TRAYS_TWICE, ast->node.span,
                                     "library `%s` says twice how many trays a plan has", library->name);
        tn_note(check->diagnostics, d, &library->trays->node.span, "the first time is here");
        tn_help(check->diagnostics, d, "write one range: `trays 4..9`");
        return;
    }
    library->trays = ast;
    if (!tn_check_range(check, &ast->range, false))
        return;
    int64_t low = ast->range.low->value, high = ast->range.high->value;
    if (low < 0 || high > TN_TRAYS_MAX) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_TRAYS, ast->range.span, "a plan cannot have %lld trays",
                                     (long long)(low < 0 ? low : high));
        tn_help(check->diagnostics, d, "the number of trays lies between 0 and %u", TN_TRAYS_MAX);
        return;
    }
    library->trays_min = (uint32_t)low;
    library->trays_max = (uint32_t)high;
}

/* Plans are made in one way, also if the library is made from another. */
static bool generates_twice(tn_check *check, const tn_checked_library *library, const tn_checked_clause *clause)
{
    for (size_t i = 0; i < library->clause_count; i++) {
        const tn_checked_clause *before = library->clauses[i];
        if (before->kind != TN_CLAUSE_GENERATE && before->kind != TN_CLAUSE_ONTO)
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, E_GENERATED_TWICE, clause->span,
                                     "library `%s` says already what its plans are made of", library->name);
        tn_note(check->diagnostics, d, &before->span, "it is said here");
        tn_help(check->diagnostics, d, "a plan that is this, too: `require neighbour(beginning, ..., end)`");
        return true;
    }
    return false;
}

static void add_clause(tn_check *check, tn_checked_library *library, tn_ast_clause *ast)
{
    static const tn_clause_kind kinds[] = {
        [TN_FORM_TOTAL_RANGE] = TN_CLAUSE_TOTAL, [TN_FORM_TOTAL_COMPARE] = TN_CLAUSE_TOTAL,
        [TN_FORM_REQUIRE] = TN_CLAUSE_REQUIRE,   [TN_FORM_PRUNE] = TN_CLAUSE_PRUNE,
        [TN_FORM_GENERATE] = TN_CLAUSE_GENERATE, [TN_FORM_ALLOW] = TN_CLAUSE_PRUNE,
        [TN_FORM_WEIGHT] = TN_CLAUSE_REQUIRE,    [TN_FORM_PREFER] = TN_CLAUSE_REQUIRE,
    };
    bool of_plans = ast->form == TN_FORM_TRAYS || ast->form == TN_FORM_WEIGHT || ast->form == TN_FORM_PREFER ||
                    kinds[ast->form] == TN_CLAUSE_TOTAL || ast->form == TN_FORM_GENERATE;
    if (library->form && of_plans) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_HOUSE_CLAUSE, ast->node.span, "a library of houses cannot say %s",
                      ast->form == TN_FORM_WEIGHT   ? "how likely plans are"
                      : ast->form == TN_FORM_PREFER ? "which plans are preferred"
                                                    : "which plans there are");
        tn_note(check->diagnostics, d, &library->plans->ast->name->node.span, "its plans are those of `%s`",
                library->plans->name);
        tn_help(check->diagnostics, d, "write this line in a library of plans, and make the houses `from` that");
        return;
    }
    if (ast->form == TN_FORM_TRAYS) {
        set_trays(check, library, ast);
        return;
    }
    if (ast->form == TN_FORM_WEIGHT || ast->form == TN_FORM_PREFER) {
        (ast->form == TN_FORM_WEIGHT ? tn_check_weight : tn_check_preference)(check, library, ast);
        return;
    }
    if (ast->form == TN_FORM_ALLOW || !tn_check_room(check, library->clause_count, TN_CLAUSES_MAX, "clause",
                                                     ast->node.span, "join some of them by `or`"))
        return;
    tn_checked_clause *clause = TN_NEW(check->arena, tn_checked_clause);
    if (!clause)
        return;
    *clause = (tn_checked_clause){.ast = ast,
                                  .kind = kinds[ast->form],
                                  .doc = ast->doc ? ast->doc->text : NULL,
                                  .unit = library->unit,
                                  .older = library->schema,
                                  .written = ast->expr,
                                  .span = ast->node.span,
                                  .field = TN_NONE};
    if (clause->kind == TN_CLAUSE_GENERATE && generates_twice(check, library, clause))
        return;
    if (clause->kind != TN_CLAUSE_TOTAL)
        add_expr_clause(check, library, ast, clause);
    else if (library->schema)
        add_total(check, library, ast, clause);
}

/* ---- libraries */

static void check_library(tn_check *check, tn_checked_library *library);

/* `from PLANS in FORM`: houses on the plans of a library. From a library of houses: more clauses, in the same form. */
static void stand_in_form(tn_check *check, tn_checked_library *library, tn_checked_library *from)
{
    const tn_ast_word *word = library->ast->in;
    tn_checked_form *form = tn_check_form_named(check, library->unit, word->text);
    const char *other = from->form ? from->form->name : NULL;
    library->broken |= !form;
    if (!form) {
        if (check->incomplete || word->broken)
            return;
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_UNKNOWN_FORM, word->node.span, "there is no form `%s`", word->text);
        const char *near = NULL;
        for (size_t i = 0; i < check->result->form_count && !near; i++)
            near = tn_nearest(word->text, &(const char *){check->result->forms[i]->name}, 1);
        if (near)
            tn_suggest(check->diagnostics, d, "%s", near);
        else
            tn_help(check->diagnostics, d, "declare it with `form %s of SCHEMA { ... }`, or `use` the file that does",
                    word->text);
    } else if (other && form != from->form) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_OTHER_FORM, word->node.span,
                                     "library `%s` has houses of form `%s`", from->name, other);
        tn_note(check->diagnostics, d, &from->ast->name->node.span, "library `%s` is here", from->name);
        tn_help(check->diagnostics, d, "write `in %s`, or begin with a library of plans", other);
    } else if (form->schema && library->schema && form->schema != library->schema) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_OTHER_FORM, word->node.span,
                                     "form `%s` is of schema `%s`, and the plans are of schema `%s`", form->name,
                                     form->schema->name, library->schema->name);
        tn_note(check->diagnostics, d, &form->ast->name->node.span, "form `%s` is here", form->name);
        tn_help(check->diagnostics, d, "name a form of schema `%s`", library->schema->name);
    } else if (!from->form) {
        library->form = form;
        library->plans = from;
    }
}

/* A clause of a library for an older schema, for the schema of this one. */
static tn_checked_clause *renew(tn_check *check, const tn_checked_library *library, const tn_checked_clause *old)
{
    tn_ast_clause *ast = TN_NEW(check->arena, tn_ast_clause);
    tn_checked_clause *clause = TN_NEW(check->arena, tn_checked_clause);
    if (!ast || !clause)
        return NULL;
    *clause = *old;
    *ast = *old->ast;
    clause->ast = ast;
    clause->rule = NULL;
    check->schema = library->schema;
    check->unit = old->unit;
    check->quiet = true;
    if (old->written) {
        ast->expr = tn_expand_older(check, old->written, old->unit, old->older);
        if (ast->expr)
            tn_check_clause_expr(check, ast);
        clause->expr = ast->expr;
        if (clause->expr)
            clause->rule = tn_clause_rule(clause->expr);
    } else if (old->above) {
        clause->function = 0;
    } else {
        clause->condition = tn_check_total(check, ast, clause->field);
        clause->any = tn_check_any(check, library->schema, ast->node.span);
    }
    check->quiet = false;
    return clause;
}

/* `using NEWER from LIBRARY`: is the schema made from that of the library? */
static bool find_newer(tn_check *check, tn_checked_library *library, const tn_checked_library *from)
{
    const tn_ast_word *using = library->ast->using;
    library->schema = from->schema;
    tn_checked_schema *newer = using ? tn_check_schema_for(check, library->unit, using, using->node.span) : NULL;
    if (!newer || !from->schema || newer == from->schema)
        return false;
    if (tn_schema_extends(newer, from->schema) && !from->form) {
        library->schema = newer;
        return true;
    }
    tn_diagnostic *d = from->form
                           ? tn_report(check->diagnostics, E_OTHER_SCHEMA, using->node.span,
                                       "houses of form `%s` are of schema `%s`", from->form->name, from->schema->name)
                           : tn_report(check->diagnostics, E_OTHER_SCHEMA, using->node.span,
                                       "library `%s` is of schema `%s`, and schema `%s` is not made from that",
                                       from->name, from->schema->name, newer->name);
    tn_note(check->diagnostics, d, &from->ast->name->node.span, "library `%s` is here", from->name);
    if (from->form)
        tn_help(check->diagnostics, d, "leave `using %s` out", newer->name);
    else
        tn_help(check->diagnostics, d, "leave `using %s` out, or declare `schema %s from %s { ... }`", newer->name,
                newer->name, from->schema->name);
    return false;
}

/* ---- `from LIBRARY onto SCHEMA`: the plans of a library without the fields that are newer than the schema */

/* "`lahave`, `walls`": what the schema is made from. */
static const char *older_schemas(tn_check *check, const tn_checked_schema *schema)
{
    char names[300] = "";
    size_t used = 0;
    for (const tn_checked_schema *base = schema->base; base && used < sizeof names; base = base->base)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s`%s`", used ? ", " : "", base->name);
    return tn_arena_copy(check->arena, names, strlen(names));
}

static void report_schema(tn_check *check, const tn_checked_library *from, const tn_ast_word *onto)
{
    const tn_checked_schema *schema = from->schema;
    bool own = strcmp(schema->name, onto->text) == 0;
    tn_diagnostic *d = own ? tn_report(check->diagnostics, E_NOT_OLDER, onto->node.span,
                                       "`%s` is the schema of library `%s` itself", onto->text, from->name)
                           : tn_report(check->diagnostics, E_NOT_OLDER, onto->node.span,
                                       "library `%s` is of schema `%s`, which is not made from schema `%s`", from->name,
                                       schema->name, onto->text);
    tn_note(check->diagnostics, d, &schema->ast->name->node.span, "schema `%s` is here", schema->name);
    const char *older = older_schemas(check, schema);
    if (older && *older)
        tn_help(check->diagnostics, d, "name one that `%s` is made from: %s", schema->name, older);
    else if (own)
        tn_help(check->diagnostics, d, "leave `onto %s` out: no field is newer", onto->text);
    else
        tn_help(check->diagnostics, d,
                "`%s` is made from no other schema: only `schema NEWER from OLDER` has newer fields", schema->name);
}

static void report_houses(tn_check *check, const tn_checked_library *from, const tn_ast_word *onto)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_NOT_OLDER, onto->node.span,
                                 "`%s` is a library of houses, and a plan is what is projected", from->name);
    tn_note(check->diagnostics, d, &from->ast->name->node.span, "library `%s` is here", from->name);
    tn_help(check->diagnostics, d, "begin with the library of its plans: `from %s onto %s`", from->plans->name,
            onto->text);
}

static void report_using(tn_check *check, const tn_ast_library *ast)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_NOT_OLDER, ast->using->node.span,
                                 "the schema of library `%s` stands behind `onto`", ast->name->text);
    tn_note(check->diagnostics, d, &ast->onto->node.span, "it is `%s`", ast->onto->text);
    tn_help(check->diagnostics, d, "leave `using %s` out", ast->using->text);
}

/* Is the schema one that the library's is made from? */
static bool fits(tn_check *check, const tn_checked_library *from, const tn_checked_schema *schema,
                 const tn_ast_library *ast)
{
    if (ast->using)
        report_using(check, ast);
    else if (from->form)
        report_houses(check, from, ast->onto);
    else if (from->schema && !tn_schema_extends(from->schema, schema))
        report_schema(check, from, ast->onto);
    else
        return from->schema != NULL;
    return false;
}

static tn_checked_clause *onto_clause(tn_check *check, tn_checked_library *library, tn_checked_library *from)
{
    const tn_ast_library *ast = library->ast;
    library->schema = tn_check_schema_for(check, library->unit, ast->onto, ast->onto->node.span);
    library->heights = from->heights + 1;
    if (!library->schema || !fits(check, from, library->schema, ast) ||
        !tn_check_room(check, from->heights, TN_PROJECTIONS_MAX, "projection", ast->onto->node.span,
                       "say in one library what several say in turn"))
        return NULL;
    tn_ast_clause *written = TN_NEW(check->arena, tn_ast_clause);
    tn_checked_clause *clause = TN_NEW(check->arena, tn_checked_clause);
    if (!written || !clause)
        return NULL;
    *written = (tn_ast_clause){.node.span = ast->projected, .form = TN_FORM_REQUIRE};
    *clause = (tn_checked_clause){.ast = written,
                                  .kind = TN_CLAUSE_ONTO,
                                  .name = from->name,
                                  .doc = from->ast->doc ? from->ast->doc->text : NULL,
                                  .unit = library->unit,
                                  .older = library->schema,
                                  .above = from,
                                  .onto = library->schema,
                                  .span = ast->projected,
                                  .field = TN_NONE};
    return clause;
}

/* Its clauses are asked of the plans that lie above. */
static void project(tn_check *check, tn_checked_library *library, tn_checked_library *from)
{
    tn_checked_clause *clause = onto_clause(check, library, from);
    library->trays = from->trays;
    library->trays_min = from->trays_min;
    library->trays_max = from->trays_max;
    library->broken |= !clause;
    if (clause)
        put_clause(check, library, clause);
}

/* Takes over the clauses of another library. */
static void take_over(tn_check *check, tn_checked_library *library)
{
    const tn_ast_word *word = library->ast->from;
    check->unit = library->unit;
    check->schema = NULL;
    const tn_checked_name *name = tn_check_name(check, word, TN_WANT_LIBRARY);
    if (!name)
        return;
    if (name->library->state == OPEN) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_LIBRARY_CYCLE, word->node.span, "library `%s` is made from itself%s",
                      library->name, name->library == library ? "" : ", by way of others");
        tn_note(check->diagnostics, d, &name->span, "`%s` is here", name->library->name);
        tn_help(check->diagnostics, d, "start one of them with `using SCHEMA` instead of `from`");
        return;
    }
    check_library(check, name->library);
    tn_checked_library *from = library->from = name->library;
    if (library->ast->onto) {
        project(check, library, from);
        return;
    }
    library->heights = from->heights;
    bool newer = find_newer(check, library, from);
    library->form = from->form;
    library->plans = from->form ? from->plans : NULL;
    if (library->ast->in)
        stand_in_form(check, library, from);
    library->trays = from->trays;
    library->trays_min = from->trays_min;
    library->trays_max = from->trays_max;
    for (size_t i = 0; i < from->clause_count && !library->form == !from->form; i++) {
        tn_checked_clause *clause = newer ? renew(check, library, from->clauses[i]) : from->clauses[i];
        if (clause)
            put_clause(check, library, clause);
    }
    if (library->form)
        return;
    tn_check_weights_of(check, library, from, newer);
    tn_check_preferences_of(check, library, from, newer);
}

/* Recursion is as deep as libraries are made from each other: at most TN_LIBRARIES_MAX. */
static void check_library(tn_check *check, tn_checked_library *library)
{
    if (library->state != UNSEEN)
        return;
    library->state = OPEN;
    const tn_ast_library *ast = library->ast;
    if (ast->from)
        take_over(check, library);
    else
        library->schema = tn_check_schema_for(check, library->unit, ast->using, ast->name->node.span);
    check->unit = library->unit;
    check->schema = library->schema;
    check->rule = NULL;
    check->form = library->form;
    check->form_wrong = ast->in && (!library->form || strcmp(library->form->name, ast->in->text) != 0);
    for (TN_EACH(const tn_ast_clause, clause, ast->clauses)) {
        if (clause->form != TN_FORM_ALLOW)
            continue;
        tn_check_allow(check, clause->allow);
        for (TN_EACH(const tn_ast_word, word, clause->allow)) {
            tn_ast_word *copy = TN_NEW(check->arena, tn_ast_word);
            if (!copy)
                return;
            *copy = *word;
            copy->node.next = NULL;
            library->allow = tn_ast_append(library->allow, copy);
        }
    }
    check->allow = library->allow;
    for (TN_EACH(tn_ast_clause, clause, ast->clauses))
        add_clause(check, library, clause);
    tn_check_preferred(check, library);
    library->state = DONE;
    library->broken |= ast->from && (!library->from || library->from->broken);
    if (library->trays || check->skipped || library->broken)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_NO_TRAYS, ast->name->node.span,
                                 "library `%s` does not say how many trays its plans have", library->name);
    tn_help(check->diagnostics, d, "add a line such as `trays 4..9`");
}

void tn_check_libraries(tn_check *check)
{
    for (size_t i = 0; i < check->result->library_count; i++)
        check_library(check, check->result->libraries[i]);
}

/* ---- what the command line asks */

/* The library named, or the only one of plans of the file itself, or the only one at all; NULL where that is not clear:
 * the command says so. Libraries of houses are asked for by name. */
static tn_checked_library *asked_library(const tn_check *check)
{
    const tn_checked *result = check->result;
    tn_checked_library *own = NULL, *any = NULL;
    size_t owns = 0, all = 0;
    for (size_t i = 0; i < result->library_count; i++) {
        tn_checked_library *library = result->libraries[i];
        if (check->asked->library && strcmp(library->name, check->asked->library) == 0)
            return library;
        if (library->form)
            continue;
        any = library;
        all++;
        if (library->unit + 1 < check->imports->count)
            continue;
        own = library;
        owns++;
    }
    if (check->asked->library)
        return NULL;
    return owns == 1 ? own : owns == 0 && all == 1 ? any : NULL;
}

static void add_where(tn_check *check, tn_checked_library *library, tn_ast_expr *expr, size_t number)
{
    tn_ast_clause *ast = TN_NEW(check->arena, tn_ast_clause);
    tn_checked_clause *clause = TN_NEW(check->arena, tn_checked_clause);
    if (!ast || !clause)
        return;
    *ast = (tn_ast_clause){.node.span = expr->node.span, .form = TN_FORM_REQUIRE, .expr = expr};
    tn_check_clause_expr(check, ast);
    *clause = (tn_checked_clause){
        .ast = ast, .kind = TN_CLAUSE_REQUIRE, .expr = ast->expr, .span = expr->node.span, .field = TN_NONE};
    if (ast->expr->kind == TN_EXPR_NAME && ast->expr->rule && !ast->expr->rule->hidden)
        clause->rule = ast->expr->rule;
    clause->name = make_name(check, &library->clause_names, "where", number);
    if (clause->name)
        put_clause(check, library, clause);
}

static tn_checked_schema *named_schema(const tn_check *check)
{
    const tn_checked *result = check->result;
    for (size_t i = 0; check->asked->schema && i < result->schema_count; i++)
        if (strcmp(result->schemas[i]->name, check->asked->schema) == 0)
            return result->schemas[i];
    return NULL;
}

static void check_pattern(tn_check *check, tn_ast_list pattern)
{
    tn_checked *result = check->result;
    result->pattern = TN_NEW_ARRAY(check->arena, tn_ast_expr *, pattern.count);
    for (TN_EACH(tn_ast_expr, tray, pattern)) {
        if (!result->pattern)
            return;
        if (tray->kind != TN_EXPR_OPTIONAL) {
            tn_check_expr(check, tray);
            tn_check_meaning(check, tray);
        }
        result->pattern[result->pattern_count++] = tray->kind == TN_EXPR_OPTIONAL ? NULL : tray;
    }
}

/* The plan in brackets that is asked about, for the program. */
static void check_literal(tn_check *check, const tn_ast_literal *literal)
{
    if (literal->house) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_PLAN_SYNTAX, literal->house->node.span,
                                     "this is a house, and a plan is wanted");
        tn_help(check->diagnostics, d, "leave out what stands from the first `;` on, and the brackets");
        return;
    }
    check->result->asked_plan = tn_check_plan(check, check->schema, literal->trays, &check->result->asked_length);
}

/* An open plan, or a plan in brackets. */
static void check_asked_plan(tn_check *check)
{
    const tn_asked_for *asked = check->asked;
    tn_checked_schema *schema = asked->pattern || asked->literal ? named_schema(check) : NULL;
    check->result->pattern_schema = schema;
    if (!schema)
        return;
    check->unit = check->imports->count - 1;
    check->schema = schema;
    check->rule = NULL;
    check->form = NULL; /* a plan is about trays */
    check->allow = tn_ast_empty();
    if (asked->pattern)
        check_pattern(check, *asked->pattern);
    else
        check_literal(check, asked->literal);
}

static void check_wheres(tn_check *check)
{
    const tn_asked_for *asked = check->asked;
    tn_checked_library *library = asked->where_count ? asked_library(check) : NULL;
    check->result->asked = library;
    if (!library || !library->schema)
        return;
    check->unit = check->imports->count - 1;
    check->schema = library->schema;
    check->rule = NULL;
    check->form = library->form;
    check->form_wrong = false;
    check->allow = library->allow;
    check->asking = true;
    tn_check_name_preference(check, library);
    for (size_t i = 0; i < asked->where_count; i++)
        add_where(check, library, asked->wheres[i], i + 1);
    check->asking = false;
    check->form = NULL;
}

void tn_check_asked(tn_check *check)
{
    check_wheres(check);
    check_asked_plan(check);
}
