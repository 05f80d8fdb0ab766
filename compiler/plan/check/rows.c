/* Schemas of libraries: fields that measures and rules say, which trays there are, and for how many plans each stands.
 *
 * What the plans are was counted before (compiler/plan/rows.h). A schema without a census is broken from the start, so
 * that nothing is said of the words of its trays; why it has none is said once the names of the file are known. */
#include <gmp.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/form.h"
#include "runtime/base/length.h"

const tn_checked_schema *tn_schema_of_library(const tn_checked_schema *schema)
{
    while (schema && !schema->ast->of)
        schema = schema->base;
    return schema;
}

const tn_census *tn_schema_census(const tn_checked_schema *schema)
{
    const tn_checked_schema *of = tn_schema_of_library(schema);
    return of && of->ast->counted ? of->ast->counted->census : NULL;
}

/* ---- fields */

size_t tn_said_column(const tn_checked_schema *schema, const tn_ast_field *field)
{
    size_t column = 0;
    for (TN_EACH(const tn_ast_field, other, schema->ast->body.fields)) {
        if (other == field)
            return column;
        column += tn_field_is_said(other);
    }
    return column;
}

/* The value in whole nanometres, as lengths of fields are; false: it is none. */
static bool read_length(const char *value, int64_t *length)
{
    char *end;
    long long number = strtoll(value, &end, 10);
    *length = number;
    return *end == '\0' && number >= 0 && number <= TN_LENGTH_MAX;
}

static void report_no_length(tn_check *check, const tn_checked_schema *schema, const tn_ast_field *field,
                             const char *value)
{
    bool below = value[0] == '-';
    tn_diagnostic *d = tn_report(check->diagnostics, E_PLAN_VALUES, field->said_by->node.span,
                                 "some plans of `%s` have %s of `%s`, which no field can have", schema->ast->of->text,
                                 below                ? "a value below 0"
                                 : strchr(value, '/') ? "a value that is no whole number of nanometres"
                                                      : "a value larger than the limit of 1,000 km",
                                 field->said_by->text);
    tn_help(check->diagnostics, d, "ask a measure whose values are lengths from 0 on, such as `sum(width)`");
}

static int compare_lengths(const void *left, const void *right)
{
    int64_t a = *(const int64_t *)left, b = *(const int64_t *)right;
    return (a > b) - (a < b);
}

static void add_length(tn_check *check, tn_checked_field *field, int64_t length, tn_length_style style, tn_span span)
{
    char text[64];
    tn_length_write_style(length, style, text, sizeof text);
    int64_t back;
    if (tn_length_read(text, strlen(text), false, &back, NULL) != strlen(text) || back != length)
        tn_length_write(length, text, sizeof text);
    const char *spelling = tn_arena_copy(check->arena, text, strlen(text));
    if (spelling)
        field->values[field->value_count++] =
            (tn_checked_value){.name = spelling, .spelling = spelling, .measure = "", .span = span, .length = length};
}

/* ---- values that are no lengths */

typedef struct said_number {
    mpq_t number;
    const char *exact, *name;
} said_number;

static int compare_numbers(const void *left, const void *right)
{
    return mpq_cmp(((const said_number *)left)->number, ((const said_number *)right)->number);
}

/* Each number once, from the least to the greatest. */
static void add_numbers(tn_checked_field *field, const said_number *said, size_t count, tn_span span)
{
    for (size_t i = 0; i < count && field->value_count < TN_VALUES_MAX; i++)
        if (i == 0 || strcmp(said[i].exact, said[i - 1].exact) != 0)
            field->values[field->value_count++] = (tn_checked_value){
                .name = said[i].name, .spelling = said[i].name, .measure = "", .number = said[i].exact, .span = span};
}

static void report_long(tn_check *check, const tn_checked_schema *schema, const tn_ast_field *field)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_PLAN_VALUES, field->said_by->node.span,
                                 "some plans of `%s` have a value of `%s` of more than %u characters",
                                 schema->ast->of->text, field->said_by->text, TN_NAME_MAX);
    tn_help(check->diagnostics, d, "ask a measure of rounder numbers, or rules that say what matters of it");
}

/* Counts, areas and shares are values that have an order, each with its number. */
static bool add_said_numbers(tn_check *check, const tn_checked_schema *schema, tn_checked_field *field, size_t column)
{
    const tn_census *census = tn_schema_census(schema);
    said_number *said = TN_NEW_ARRAY(check->arena, said_number, census->count);
    if (!said)
        return false;
    for (size_t i = 0; i < census->count; i++)
        if (strlen(census->rows[i].texts[column]) > TN_NAME_MAX) {
            report_long(check, schema, field->ast);
            return false;
        }
    field->kind = TN_FIELD_CHOICE;
    field->ordered = field->measured = true;
    field->power = census->powers[column];
    for (size_t i = 0; i < census->count; i++) {
        said[i] = (said_number){.exact = census->rows[i].values[column], .name = census->rows[i].texts[column]};
        mpq_init(said[i].number);
        mpq_set_str(said[i].number, said[i].exact, 10);
    }
    qsort(said, census->count, sizeof *said, compare_numbers);
    add_numbers(field, said, census->count, field->ast->said_by->node.span);
    for (size_t i = 0; i < census->count; i++)
        mpq_clear(said[i].number);
    return true;
}

void tn_check_said_values(tn_check *check, tn_checked_schema *schema, tn_checked_field *field)
{
    const tn_census *census = tn_schema_census(schema);
    const tn_ast_field *ast = field->ast;
    size_t column = tn_said_column(schema, ast);
    int64_t *lengths = census ? TN_NEW_ARRAY(check->arena, int64_t, census->count) : NULL;
    if (!lengths)
        return;
    if (census->powers[column] != 1) {
        schema->broken |= !add_said_numbers(check, schema, field, column);
        return;
    }
    for (size_t i = 0; i < census->count; i++)
        if (!read_length(census->rows[i].values[column], &lengths[i])) {
            report_no_length(check, schema, ast, census->rows[i].values[column]);
            schema->broken = true;
            return;
        }
    qsort(lengths, census->count, sizeof *lengths, compare_lengths);
    for (size_t i = 0; i < census->count && field->value_count < TN_VALUES_MAX; i++)
        if (i == 0 || lengths[i] != lengths[i - 1])
            add_length(check, field, lengths[i], census->style, ast->said_by->node.span);
}

/* ---- which trays there are */

/* The value that a row of the census gives the field. */
static uint32_t value_of(const tn_checked_field *field, const char *said)
{
    int64_t length = 0;
    if (field->kind == TN_FIELD_FLAG)
        return strcmp(said, "0") != 0;
    if (!field->measured)
        read_length(said, &length);
    for (uint32_t v = 0; v < field->value_count; v++)
        if (field->measured ? strcmp(field->values[v].number, said) == 0 : field->values[v].length == length)
            return v;
    return 0;
}

void tn_schema_row_mask(const tn_checked_schema *schema, size_t row, uint64_t *mask)
{
    const tn_checked_schema *of = tn_schema_of_library(schema);
    const tn_census *census = tn_schema_census(schema);
    memset(mask, 0, schema->words * sizeof *mask);
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const tn_checked_field *field = &schema->fields[f];
        bool said = f < of->field_count && tn_field_is_said(of->fields[f].ast);
        uint32_t only =
            said ? value_of(field, census->rows[row].values[tn_said_column(of, of->fields[f].ast)]) : TN_NONE;
        for (uint32_t v = 0; v < field->value_count; v++)
            if (!said || v == only)
                mask[(field->first_bit + v) / 64] |= UINT64_C(1) << ((field->first_bit + v) % 64);
    }
}

bool tn_check_rows_legal(tn_check *check, tn_checked_schema *schema, tn_checked_trays *out)
{
    const tn_checked_schema *of = tn_schema_of_library(schema);
    const tn_census *census = tn_schema_census(schema);
    tn_choice_diagram *choices = tn_schema_choices(check, schema);
    uint64_t *mask = TN_NEW_ARRAY(check->arena, uint64_t, schema->words);
    tn_choice_set *boxes = TN_NEW_ARRAY(check->arena, tn_choice_set, census->count + 1);
    if (!choices || !mask || !boxes)
        return false;
    for (size_t i = 0; i < census->count; i++) {
        tn_schema_row_mask(schema, i, mask);
        boxes[i] = tn_choices_box(choices, mask);
    }
    tn_choice_set none = tn_choices_not(choices, tn_choices_any_of(choices, boxes, (uint32_t)census->count));
    return tn_check_boxes(check, schema, none, TN_FORBID_BOXES_MAX,
                          tn_span_join(of->ast->top.node.span, of->ast->of->node.span), out);
}

/* ---- names, and why there is no census */

/* Is the rule or measure of plans of the library? */
static bool is_of(const tn_checked_rule *rule, const tn_checked_library *library)
{
    return !rule->form && (!rule->schema || !library->schema || rule->schema == library->schema ||
                           tn_schema_extends(library->schema, rule->schema));
}

static void report_kind(tn_check *check, const tn_ast_field *field, const tn_checked_name *name)
{
    bool measure = field->form == TN_FORM_MEASURE;
    const char *what = name->rule->is_measure    ? "a measure"
                       : name->rule->is_let      ? "no rule"
                       : name->rule->is_template ? "a rule with parameters"
                                                 : "a rule";
    tn_diagnostic *d = tn_report(check->diagnostics, E_WRONG_KIND, field->said_by->node.span, "`%s` is %s, not a %s",
                                 field->said_by->text, what, measure ? "measure" : "rule of whole plans");
    tn_note(check->diagnostics, d, &name->span, "`%s` is here", field->said_by->text);
    if (measure == name->rule->is_measure || name->rule->is_let)
        tn_help(check->diagnostics, d, "name a %s here", measure ? "measure" : "rule without parameters");
    else
        tn_help(check->diagnostics, d, "write `%s = %s %s`", field->name->text, measure ? "rule" : "measure",
                field->said_by->text);
}

static void check_said(tn_check *check, const tn_ast_field *field, const tn_checked_library *library)
{
    bool measure = field->form == TN_FORM_MEASURE;
    const tn_checked_name *name = tn_check_name(check, field->said_by, measure ? TN_WANT_MEASURE : TN_WANT_RULE);
    if (!name)
        return;
    tn_checked_rule *rule = name->rule;
    if (rule->is_measure != measure || rule->is_let || rule->is_template) {
        report_kind(check, field, name);
        return;
    }
    rule->used = true;
    if (!library || is_of(rule, library))
        return;
    tn_diagnostic *d = rule->form
                           ? tn_report(check->diagnostics, E_OTHER_SCHEMA, field->said_by->node.span,
                                       "`%s` is about houses, and library `%s` is of plans", rule->name, library->name)
                           : tn_report(check->diagnostics, E_OTHER_SCHEMA, field->said_by->node.span,
                                       "`%s` is about plans of schema `%s`, and library `%s` is of schema `%s`",
                                       rule->name, rule->schema->name, library->name, library->schema->name);
    tn_note(check->diagnostics, d, &name->span, "`%s` is here", rule->name);
    tn_help(check->diagnostics, d, "name a %s of schema `%s`", measure ? "measure" : "rule", library->schema->name);
}

static const tn_checked_library *find_library(tn_check *check, const tn_checked_schema *schema)
{
    const tn_ast_word *of = schema->ast->of;
    const tn_checked_name *name = tn_check_name(check, of, TN_WANT_LIBRARY);
    const tn_checked_library *library = name ? name->library : NULL;
    if (!library || !library->form)
        return library;
    tn_diagnostic *d = tn_report(check->diagnostics, E_WRONG_KIND, of->node.span,
                                 "library `%s` is of houses, and a tray stands for plans", library->name);
    tn_note(check->diagnostics, d, &name->span, "library `%s` is here", library->name);
    tn_help(check->diagnostics, d, "name a library of plans, such as `%s`",
            library->plans ? library->plans->name : "rows");
    return NULL;
}

/* An editor does not wait long: then nothing is wrong, and nothing is known. */
static void note_brief(tn_check *check, const tn_ast_census *counted, tn_span span)
{
    tn_diagnostic *d = tn_report_bare(check->diagnostics, TN_NOTE, TN_CODE_NONE, "the plans are not counted here: %s",
                                      counted->error.message);
    d->has_span = true;
    d->span = span;
}

/* The library and what says the fields are as they should be. */
static void report_uncounted(tn_check *check, const tn_checked_schema *schema)
{
    const tn_ast_census *counted = schema->ast->counted;
    tn_span of = schema->ast->of->node.span;
    check->result->uncounted = true;
    if (counted && counted->circular) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_SCHEMA_CYCLE, of,
                                     "the trays of schema `%s` are plans of a library that is of `%s` itself",
                                     schema->name, schema->name);
        tn_help(check->diagnostics, d, "name a library of plans of another schema");
    } else if (counted && counted->failed && counted->brief && counted->error.status == TN_LIMIT) {
        note_brief(check, counted, of);
    } else if (counted && counted->failed) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, counted->error.code, counted->place->node.span, "%s", counted->error.message);
        if (counted->error.help[0])
            tn_help(check->diagnostics, d, "%s", counted->error.help);
    } else if (check->diagnostics->error_count == 0 && !check->incomplete) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_NO_PLANS, of, "the plans of `%s` are not counted: %s",
                                     schema->ast->of->text, counted ? counted->error.message : "nobody here can");
        tn_help(check->diagnostics, d, "the trays of schema `%s` are known once they are", schema->name);
    }
}

/* ---- what the fields are of a plan, for whoever asks which plans a tray stands for */

/* The measure as the library's schema has it: of an older one it has its own. */
static tn_checked_sum *sum_of_measure(const tn_check *check, const tn_ast_word *name, const tn_checked_schema *schema)
{
    for (size_t i = 0; i < check->result->rule_count; i++) {
        const tn_checked_rule *measure = check->result->rules[i];
        if (measure->is_measure && measure->schema == schema && strcmp(measure->name, name->text) == 0)
            return measure->sum;
    }
    return NULL;
}

/* matches(rule), in the library's schema. */
static tn_checked_sum *sum_of_rule(tn_check *check, const tn_ast_word *name, tn_checked_schema *schema)
{
    tn_ast_clause *clause = TN_NEW(check->arena, tn_ast_clause);
    tn_ast_expr *expr = TN_NEW(check->arena, tn_ast_expr);
    tn_checked_sum *sum = TN_NEW(check->arena, tn_checked_sum);
    tn_checked_term *term = TN_NEW(check->arena, tn_checked_term);
    if (!clause || !expr || !sum || !term)
        return NULL;
    *expr = (tn_ast_expr){.node.span = name->node.span, .kind = TN_EXPR_NAME, .depth = 1, .name = name};
    *clause = (tn_ast_clause){.expr = expr};
    check->schema = schema;
    check->quiet = true;
    tn_check_clause_expr(check, clause);
    check->quiet = false;
    bool named = clause->expr->kind == TN_EXPR_NAME;
    *term = (tn_checked_term){.kind = TN_TERM_MATCHES,
                              .factor = "1",
                              .part = named ? NULL : clause->expr,
                              .rule = named ? clause->expr->rule : NULL,
                              .span = name->node.span};
    *sum = (tn_checked_sum){.schema = schema,
                            .terms = term,
                            .count = 1,
                            .constant = "0",
                            .whole = true,
                            .span = name->node.span,
                            .index = TN_NONE};
    return sum;
}

static void find_sums(tn_check *check, tn_checked_schema *schema, const tn_checked_library *library)
{
    for (uint32_t f = 0; f < schema->field_count; f++) {
        tn_checked_field *field = &schema->fields[f];
        if (!tn_field_is_said(field->ast))
            continue;
        const tn_ast_word *name = field->ast->said_by;
        field->said = field->ast->form == TN_FORM_MEASURE ? sum_of_measure(check, name, library->schema)
                                                          : sum_of_rule(check, name, library->schema);
    }
}

void tn_check_rows(tn_check *check)
{
    tn_checked *result = check->result;
    check->rule = NULL;
    check->schema = NULL;
    for (size_t i = 0; i < result->schema_count; i++) {
        tn_checked_schema *schema = result->schemas[i];
        if (!schema->ast->of)
            continue;
        size_t errors = check->diagnostics->error_count;
        check->unit = schema->unit;
        const tn_checked_library *library = find_library(check, schema);
        for (TN_EACH(const tn_ast_field, field, schema->ast->body.fields))
            if (tn_field_is_said(field))
                check_said(check, field, library);
        if (!library || check->diagnostics->error_count > errors)
            continue;
        if (tn_schema_census(schema))
            find_sums(check, schema, library);
        else
            report_uncounted(check, schema);
    }
}
