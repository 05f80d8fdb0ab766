/* Constructors of a file's items: schemas, rules, libraries, tests. */
#include "compiler/plan/syntax/ast.h"

tn_ast_list tn_ast_lost(tn_ast_list items, tn_parse *parse)
{
    parse->result->broken = true;
    return items;
}

tn_ast_list tn_ast_skipped(tn_ast_list clauses, tn_parse *parse)
{
    parse->result->skipped = true;
    return clauses;
}

tn_ast_file *tn_ast_unread(tn_ast_file *file)
{
    file->broken = true;
    return file;
}

void *tn_ast_use_new(tn_parse *parse, tn_span span, const tn_ast_word *path)
{
    tn_ast_use *use = TN_NEW(parse->arena, tn_ast_use);
    if (!use || !path)
        return NULL;
    *use = (tn_ast_use){.top = {.node.span = span, .kind = TN_ITEM_USE}, .path = path};
    return use;
}

/* ---- schemas */

void *tn_ast_value_new(tn_parse *parse, tn_span span, const tn_ast_word *word, const tn_ast_list *depths,
                       const tn_ast_word *doc, const tn_ast_word *role)
{
    tn_ast_value *value = TN_NEW(parse->arena, tn_ast_value);
    if (!value || !word)
        return NULL;
    *value = (tn_ast_value){.node.span = span, .word = word, .doc = doc, .role = role};
    value->has_depths = depths != NULL;
    if (depths)
        value->depths = *depths;
    return value;
}

void *tn_ast_older_values(tn_parse *parse, tn_span span)
{
    tn_ast_value *value = TN_NEW(parse->arena, tn_ast_value);
    if (value)
        *value = (tn_ast_value){.node.span = span};
    return value;
}

/* Takes `...` out of a field's values. It stands first, once. */
static tn_ast_list take_older(tn_parse *parse, tn_ast_list values, bool *extends)
{
    tn_ast_list taken = tn_ast_empty();
    for (tn_ast_node *node = values.first, *next; node; node = next) {
        next = node->next;
        node->next = NULL;
        if (((const tn_ast_value *)node)->word) {
            taken = tn_ast_append(taken, node);
            continue;
        }
        if (*extends || taken.count > 0) {
            tn_diagnostic *d =
                tn_report(parse->diagnostics, E_OLDER_VALUES, node->span, "`...` stands before all other values, once");
            tn_help(parse->diagnostics, d, "the values of the older schema come first: `= ... | VALUE`");
        }
        *extends = true;
    }
    return taken;
}

void *tn_ast_field_new(tn_parse *parse, tn_span span, tn_field_form form, tn_ast_field head, tn_ast_list values)
{
    tn_ast_field *field = TN_NEW(parse->arena, tn_ast_field);
    if (!field || !head.name)
        return NULL;
    values = take_older(parse, values, &head.extends);
    *field = head;
    field->node = (tn_ast_node){.span = span};
    field->form = form;
    field->values = values;
    return field;
}

void *tn_ast_ordered_new(tn_parse *parse, tn_span span, tn_ast_field head, tn_ast_list values)
{
    tn_ast_field *field = tn_ast_field_new(parse, span, TN_FORM_VALUES, head, values);
    if (field)
        field->ordered = true;
    return field;
}

tn_ast_list tn_ast_mixed_order(tn_parse *parse, tn_span sign, tn_ast_list values, void *value)
{
    tn_diagnostic *d =
        tn_report(parse->diagnostics, E_MIXED_ORDER, sign, "values are either all in an order or all apart");
    tn_help(parse->diagnostics, d, "write `<` between all of them, from the least to the greatest, or `|`");
    return tn_ast_append(values, value);
}

void *tn_ast_schema_new(tn_parse *parse, tn_span span, const tn_ast_word *name, const tn_ast_word *doc,
                        const tn_ast_word *from, tn_ast_body body)
{
    tn_ast_schema *schema = TN_NEW(parse->arena, tn_ast_schema);
    if (!schema || !name)
        return NULL;
    *schema = (tn_ast_schema){
        .top = {.node.span = span, .kind = TN_ITEM_SCHEMA}, .name = name, .doc = doc, .from = from, .body = body};
    return schema;
}

void *tn_ast_rows_new(tn_parse *parse, tn_span span, const tn_ast_word *name, const tn_ast_word *doc,
                      const tn_ast_word *of, tn_ast_body body)
{
    tn_ast_schema *schema = tn_ast_schema_new(parse, span, name, doc, NULL, body);
    if (schema)
        schema->of = of;
    return schema;
}

void *tn_ast_said_new(tn_parse *parse, tn_span span, tn_field_form form, tn_ast_field head, const tn_ast_word *said_by)
{
    tn_ast_field *field = tn_ast_field_new(parse, span, form, head, tn_ast_empty());
    if (field)
        field->said_by = said_by;
    return field;
}

tn_ast_body tn_ast_body_field(tn_ast_body body, void *field)
{
    body.fields = tn_ast_append(body.fields, field);
    return body;
}

void *tn_ast_forbid_new(tn_parse *parse, tn_span span, tn_ast_expr *expr, bool only)
{
    tn_ast_forbid *forbid = TN_NEW(parse->arena, tn_ast_forbid);
    if (!forbid || !expr)
        return NULL;
    if (expr->kind == TN_EXPR_TRAY && !only)
        expr->node.span = span;
    *forbid = (tn_ast_forbid){.node.span = span, .expr = expr, .only = only};
    return forbid;
}

tn_ast_body tn_ast_body_forbid(tn_ast_body body, void *forbid)
{
    body.forbids = tn_ast_append(body.forbids, forbid);
    return body;
}

void *tn_ast_number_new(tn_parse *parse, tn_span span, tn_ast_field head, tn_ast_list cases)
{
    tn_ast_number *number = TN_NEW(parse->arena, tn_ast_number);
    if (!number || !head.name || !cases.first)
        return NULL;
    *number = (tn_ast_number){.node.span = span, .name = head.name, .doc = head.doc, .cases = cases};
    return number;
}

void *tn_ast_number_case_new(tn_parse *parse, tn_span span, tn_ast_expr *sum, tn_ast_expr *tray)
{
    tn_ast_number_case *made = TN_NEW(parse->arena, tn_ast_number_case);
    if (!made || !sum)
        return NULL;
    *made = (tn_ast_number_case){.node.span = span, .sum = sum, .tray = tray};
    return made;
}

tn_ast_body tn_ast_body_number(tn_ast_body body, void *number)
{
    body.numbers = tn_ast_append(body.numbers, number);
    return body;
}

tn_ast_body tn_ast_body_broken(tn_ast_body body)
{
    body.broken = true;
    return body;
}

/* ---- rules and libraries */

void *tn_ast_rule_new(tn_parse *parse, tn_span span, tn_ast_rule head, tn_ast_expr *body)
{
    tn_ast_rule *rule = TN_NEW(parse->arena, tn_ast_rule);
    if (!rule || !head.name)
        return NULL;
    *rule = head;
    rule->top = (tn_ast_top){.node.span = span, .kind = TN_ITEM_RULE};
    rule->body = body ? body : tn_ast_leaf(parse, TN_EXPR_BROKEN, span);
    rule->written = rule->body;
    return rule->body ? rule : NULL;
}

void *tn_ast_measure_new(tn_parse *parse, tn_span span, const tn_ast_word *name, const tn_ast_word *doc,
                         const tn_ast_word *using, tn_ast_expr *body)
{
    tn_ast_rule *measure = tn_ast_rule_new(parse, span, (tn_ast_rule){.name = name, .doc = doc, .using = using}, body);
    if (measure)
        measure->top.kind = TN_ITEM_MEASURE;
    return measure;
}

void *tn_ast_let_new(tn_parse *parse, tn_span span, const tn_ast_word *name, tn_ast_expr *body)
{
    tn_ast_rule *let = tn_ast_rule_new(parse, span, (tn_ast_rule){.name = name}, body);
    if (let)
        let->top.kind = TN_ITEM_LET;
    return let;
}

void *tn_ast_param_new(tn_parse *parse, tn_span span, tn_ast_rule head, tn_ast_expr *value)
{
    if (head.words.first)
        value = tn_ast_name(parse, (const tn_ast_word *)head.words.first);
    tn_ast_rule *param = tn_ast_rule_new(parse, span, head, value);
    if (param)
        param->top.kind = TN_ITEM_PARAM;
    return param;
}

void *tn_ast_setting_new(tn_parse *parse, tn_span span, const tn_ast_word *name, tn_ast_expr *value)
{
    tn_ast_setting *setting = name && value ? TN_NEW(parse->arena, tn_ast_setting) : NULL;
    if (setting)
        *setting = (tn_ast_setting){.node.span = span, .name = name, .value = value};
    return setting;
}

void *tn_ast_library_new(tn_parse *parse, tn_span span, tn_ast_library head, tn_ast_list clauses)
{
    tn_ast_library *library = TN_NEW(parse->arena, tn_ast_library);
    if (!library || !head.name)
        return NULL;
    *library = head;
    library->top = (tn_ast_top){.node.span = span, .kind = TN_ITEM_LIBRARY};
    library->clauses = clauses;
    return library;
}

static tn_ast_clause *clause_new(tn_parse *parse, tn_clause_form form, tn_span span)
{
    tn_ast_clause *clause = TN_NEW(parse->arena, tn_ast_clause);
    if (clause)
        *clause = (tn_ast_clause){.node.span = span, .form = form};
    return clause;
}

tn_ast_clause *tn_ast_trays(tn_parse *parse, tn_span span, tn_ast_range range)
{
    tn_ast_clause *clause = clause_new(parse, TN_FORM_TRAYS, span);
    if (!clause || !range.low || !range.high)
        return NULL;
    clause->range = range;
    return clause;
}

/* FIELD, or FIELD depth; or nothing. */
static void set_field(tn_ast_clause *clause, tn_ast_list field)
{
    clause->field = (const tn_ast_word *)field.first;
    clause->detail = field.first ? (const tn_ast_word *)field.first->next : NULL;
}

tn_ast_clause *tn_ast_total_range(tn_parse *parse, tn_span span, tn_ast_list field, tn_ast_range range,
                                  const tn_ast_word *doc)
{
    tn_ast_clause *clause = clause_new(parse, TN_FORM_TOTAL_RANGE, span);
    if (!clause || !range.low || !range.high)
        return NULL;
    set_field(clause, field);
    clause->range = range;
    clause->doc = doc;
    return clause;
}

tn_ast_clause *tn_ast_total_compare(tn_parse *parse, tn_span span, tn_ast_list field, tn_operator op,
                                    const tn_ast_word *word, const tn_ast_word *doc)
{
    tn_ast_clause *clause = clause_new(parse, TN_FORM_TOTAL_COMPARE, span);
    if (!clause || !word)
        return NULL;
    set_field(clause, field);
    clause->op = op;
    clause->word = word;
    clause->doc = doc;
    return clause;
}

tn_ast_clause *tn_ast_require(tn_parse *parse, tn_span span, tn_ast_expr *expr, const tn_ast_word *doc)
{
    tn_ast_clause *clause = clause_new(parse, TN_FORM_REQUIRE, span);
    if (!clause || !expr)
        return NULL;
    clause->expr = expr;
    clause->written = expr;
    clause->doc = doc;
    return clause;
}

tn_ast_clause *tn_ast_generate(tn_ast_clause *require)
{
    if (require)
        require->form = TN_FORM_GENERATE;
    return require;
}

tn_ast_clause *tn_ast_prune(tn_parse *parse, tn_span span, tn_ast_expr *expr, const tn_ast_word *name,
                            const tn_ast_word *doc)
{
    tn_ast_clause *clause = clause_new(parse, TN_FORM_PRUNE, span);
    if (!clause || !expr)
        return NULL;
    clause->expr = expr;
    clause->written = expr;
    clause->name = name;
    clause->doc = doc;
    return clause;
}

tn_ast_clause *tn_ast_preference(tn_parse *parse, tn_span span, tn_ast_expr *expr, const tn_ast_word *worth,
                                 const tn_ast_word *name, const tn_ast_word *doc)
{
    tn_ast_clause *clause = clause_new(parse, TN_FORM_PREFER, span);
    if (!clause || !expr)
        return NULL;
    clause->expr = expr;
    clause->word = worth;
    clause->name = name;
    clause->doc = doc;
    return clause;
}

tn_ast_clause *tn_ast_weight(tn_parse *parse, tn_span span, tn_ast_expr *expr, const tn_ast_word *number)
{
    tn_ast_clause *clause = clause_new(parse, TN_FORM_WEIGHT, span);
    if (!clause || !expr)
        return NULL;
    clause->expr = tn_ast_counted(parse, TN_EXPR_QUANTITY, expr->node.span, expr, TN_AST_STRETCH, NULL);
    clause->word = number;
    return clause->expr ? clause : NULL;
}

tn_ast_clause *tn_ast_allow(tn_parse *parse, tn_span span, tn_ast_list codes)
{
    tn_ast_clause *clause = clause_new(parse, TN_FORM_ALLOW, span);
    if (clause)
        clause->allow = codes;
    return clause;
}

/* ---- tests */

void *tn_ast_test_new(tn_parse *parse, tn_span span, tn_ast_list subjects, tn_ast_list settings, tn_ast_list cases)
{
    tn_ast_test *test = TN_NEW(parse->arena, tn_ast_test);
    if (!test || !subjects.count)
        return NULL;
    *test = (tn_ast_test){
        .top = {.node.span = span, .kind = TN_ITEM_TEST}, .subjects = subjects, .settings = settings, .cases = cases};
    return test;
}

tn_ast_word *tn_ast_expect(tn_parse *parse, tn_span span, const char *text, tn_expectation expectation)
{
    return tn_ast_word_new(parse, TN_WORD_NAME, span, text, expectation);
}

void *tn_ast_case_todo(void *test_case)
{
    tn_ast_case *made = test_case;
    if (made)
        made->todo = true;
    return made;
}

void *tn_ast_case_new(tn_parse *parse, tn_span span, tn_ast_list expectations, tn_ast_literal literal,
                      const tn_ast_word *doc, tn_ast_list by)
{
    tn_ast_case *made = TN_NEW(parse->arena, tn_ast_case);
    if (!made)
        return NULL;
    *made = (tn_ast_case){.node.span = span, .expectations = expectations, .literal = literal, .doc = doc, .by = by};
    return made;
}

void *tn_ast_value_case(tn_parse *parse, tn_span span, tn_ast_literal literal, tn_ast_expr *value,
                        const tn_ast_word *doc)
{
    tn_ast_word *word = tn_ast_expect(parse, span, "value", TN_EXPECT_VALUE);
    tn_ast_case *made =
        word && value ? tn_ast_case_new(parse, span, tn_ast_one(word), literal, doc, tn_ast_empty()) : NULL;
    if (made)
        made->value = value;
    return made;
}

void *tn_ast_literal_tray(tn_parse *parse, tn_span span, tn_ast_list words)
{
    tn_ast_tray *tray = TN_NEW(parse->arena, tn_ast_tray);
    if (tray)
        *tray = (tn_ast_tray){.node.span = span, .words = words};
    return tray;
}
