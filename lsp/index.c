/* Finds what the names in a .plan file stand for. */
#include "lsp/index_parts.h"

#include <string.h>

#include "compiler/plan/check/form.h"

/* ---- symbols and occurrences */

static tn_symbol *add_symbol(tn_index *index, tn_symbol_kind kind, const tn_ast_word *name, const tn_ast_word *doc,
                             const tn_ast_node *ast, const tn_symbol *parent)
{
    tn_symbol *symbol = TN_NEW(index->arena, tn_symbol);
    if (!symbol || !name->text)
        return NULL;
    *symbol = (tn_symbol){.kind = kind,
                          .name = name->text,
                          .doc = doc ? doc->text : NULL,
                          .name_span = name->node.span,
                          .span = ast->span,
                          .parent = parent,
                          .ast = ast};
    if (index->last)
        index->last->next = symbol;
    else
        index->first = symbol;
    index->last = symbol;
    return symbol;
}

void tn_index_occur(tn_index *index, tn_span span, const tn_symbol *symbol)
{
    if (!symbol)
        return;
    if (index->count == index->capacity) {
        size_t capacity = index->capacity ? 2 * index->capacity : 256;
        tn_occurrence *grown = TN_NEW_ARRAY(index->arena, tn_occurrence, capacity);
        if (!grown)
            return;
        if (index->count)
            memcpy(grown, index->occurrences, index->count * sizeof *grown);
        index->occurrences = grown;
        index->capacity = capacity;
    }
    index->occurrences[index->count++] = (tn_occurrence){span, symbol};
}

tn_symbol *tn_index_define(tn_index *index, tn_symbol_kind kind, const tn_ast_word *name, const tn_ast_word *doc,
                           const tn_ast_node *ast, const tn_symbol *parent)
{
    tn_symbol *symbol = add_symbol(index, kind, name, doc, ast, parent);
    tn_index_occur(index, name->node.span, symbol);
    return symbol;
}

const tn_symbol *tn_index_field(const tn_symbol *schema, const char *name)
{
    for (const tn_symbol *s = schema ? schema->next : NULL; s && (s->parent == schema || s->kind == TN_SYMBOL_VALUE);
         s = s->next)
        if (s->kind == TN_SYMBOL_FIELD && strcmp(s->name, name) == 0)
            return s;
    return schema && schema->schema ? tn_index_field(schema->schema, name) : NULL;
}

const tn_symbol *tn_index_value(const tn_symbol *schema, const tn_symbol *field, const char *name)
{
    const tn_symbol *found = NULL;
    for (const tn_symbol *s = schema ? schema->next : NULL; s && (s->parent == schema || s->kind == TN_SYMBOL_VALUE);
         s = s->next) {
        if (s->kind != TN_SYMBOL_VALUE || strcmp(s->name, name) != 0 ||
            (field && strcmp(s->parent->name, field->name) != 0))
            continue;
        if (found)
            return NULL;
        found = s;
    }
    return !found && schema && schema->schema ? tn_index_value(schema->schema, field, name) : found;
}

const tn_symbol *tn_index_schema(const tn_index *index, const char *owner)
{
    const tn_symbol *symbol = owner ? tn_names_get(&index->names, owner) : NULL;
    if (symbol && symbol->schema)
        return symbol->schema;
    return index->last_schema;
}

/* ---- definitions */

static void define_schema(tn_index *index, const tn_ast_schema *ast)
{
    const tn_symbol *schema = tn_index_define(index, TN_SYMBOL_SCHEMA, ast->name, ast->doc, &ast->top.node, NULL);
    if (!schema)
        return;
    index->last_schema = schema;
    if (!tn_names_get(&index->schemas, schema->name))
        tn_names_put(&index->schemas, schema->name, (void *)(uintptr_t)schema);
    for (TN_EACH(const tn_ast_field, field, ast->body.fields)) {
        const tn_symbol *symbol =
            tn_index_define(index, TN_SYMBOL_FIELD, field->name, field->doc, &field->node, schema);
        for (TN_EACH(const tn_ast_value, value, field->values))
            if (value->word->kind == TN_WORD_NAME && symbol)
                tn_index_define(index, TN_SYMBOL_VALUE, value->word, value->doc, &value->node, symbol);
    }
}

static void define_named(tn_index *index, tn_symbol_kind kind, const tn_ast_word *name, const tn_ast_word *doc,
                         const tn_ast_node *ast)
{
    tn_symbol *symbol = tn_index_define(index, kind, name, doc, ast, NULL);
    if (symbol && !tn_names_get(&index->names, symbol->name))
        tn_names_put(&index->names, symbol->name, symbol);
}

static void define_items(tn_index *index, const tn_ast_file *file)
{
    for (TN_EACH(const tn_ast_top, item, file->items)) {
        if (item->kind == TN_ITEM_SCHEMA)
            define_schema(index, (const tn_ast_schema *)item);
        if (item->kind == TN_ITEM_RULE || item->kind == TN_ITEM_MEASURE || item->kind == TN_ITEM_PARAM) {
            const tn_ast_rule *rule = (const tn_ast_rule *)item;
            define_named(index,
                         item->kind == TN_ITEM_RULE      ? TN_SYMBOL_RULE
                         : item->kind == TN_ITEM_MEASURE ? TN_SYMBOL_MEASURE
                                                         : TN_SYMBOL_PARAM,
                         rule->name, rule->doc, &item->node);
        }
        if (item->kind == TN_ITEM_FORM)
            tn_index_define_form(index, (const tn_ast_form *)item);
        if (item->kind == TN_ITEM_LIBRARY) {
            const tn_ast_library *library = (const tn_ast_library *)item;
            define_named(index, TN_SYMBOL_LIBRARY, library->name, library->doc, &item->node);
        }
    }
}

/* ---- uses */

const tn_symbol *tn_index_use(tn_index *index, const tn_names *names, const tn_ast_word *word)
{
    const tn_symbol *symbol = word && word->text ? tn_names_get(names, word->text) : NULL;
    if (symbol)
        tn_index_occur(index, word->node.span, symbol);
    return symbol;
}

/* The param of that name; NULL: there is none. */
static const tn_symbol *param_named(const tn_index *index, const tn_ast_word *word)
{
    const tn_symbol *symbol =
        word && word->kind == TN_WORD_NAME && word->text ? tn_names_get(&index->names, word->text) : NULL;
    return symbol && symbol->kind == TN_SYMBOL_PARAM ? symbol : NULL;
}

/* The words of one alternative of a specifier, or of one tray of a plan: fields, and values after their field or alone;
 * of cells also what their form declares. */
static const tn_symbol *use_words(tn_index *index, const tn_index_about *about, const tn_symbol *field,
                                  const tn_ast_list *words)
{
    const tn_symbol *schema = about->schema;
    for (TN_EACH(const tn_ast_word, word, *words)) {
        if (word->kind != TN_WORD_NAME || !word->text)
            continue;
        const tn_symbol *part = param_named(index, word);
        if (!part)
            part = tn_index_part(about->form, word->text);
        if (part) {
            tn_index_occur(index, word->node.span, part);
            continue;
        }
        const tn_symbol *value = field ? tn_index_value(schema, field, word->text) : NULL;
        const tn_symbol *named = value ? NULL : tn_index_field(schema, word->text);
        if (!value && !named)
            value = tn_index_value(schema, NULL, word->text);
        tn_index_occur(index, word->node.span, named ? named : value);
        field = named ? named : value ? value->parent : field;
    }
    return field;
}

static void use_specifier(tn_index *index, const tn_index_about *about, const tn_ast_expr *tray)
{
    bool of_cells = tray->kind == TN_EXPR_CELL || tray->kind == TN_EXPR_ROOM;
    const tn_index_about here = {about->schema, of_cells ? about->form : NULL};
    for (TN_EACH(const tn_ast_item, item, tn_ast_tray_items(tray))) {
        const tn_symbol *field = NULL;
        for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives))
            field = use_words(index, &here, field, &alternative->words);
    }
}

static void use_field(tn_index *index, const tn_symbol *schema, const tn_ast_word *word)
{
    if (word && word->text)
        tn_index_occur(index, word->node.span, tn_index_field(schema, word->text));
}

static void use_condition(tn_index *index, const tn_ast_cond *cond)
{
    const tn_ast_word *const words[] = {cond->left, cond->right, cond->modulus, cond->range.low, cond->range.high};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        bool again = i + 1 == sizeof words / sizeof *words && cond->range.low == cond->range.high;
        const tn_symbol *param = again ? NULL : param_named(index, words[i]);
        if (param)
            tn_index_occur(index, words[i]->node.span, param);
    }
    for (TN_EACH(const tn_ast_cond, part, cond->parts))
        use_condition(index, part);
}

/* What a sum adds up: fields, params. */
static void use_figure(tn_index *index, const tn_index_about *about, const tn_ast_expr *figure)
{
    if (figure->kind == TN_EXPR_FIGURE && param_named(index, figure->name))
        tn_index_use(index, &index->names, figure->name);
    else if (figure->kind == TN_EXPR_FIGURE)
        use_field(index, about->schema, figure->name);
    for (TN_EACH(const tn_ast_expr, part, figure->parts))
        use_figure(index, about, part);
}

/* As deep as expressions nest, at most TN_NESTING_MAX. */
void tn_index_expression(tn_index *index, const tn_index_about *about, const tn_ast_expr *expr)
{
    if (!expr)
        return;
    if (expr->kind == TN_EXPR_NAME || expr->kind == TN_EXPR_CALL)
        tn_index_use(index, &index->names, expr->name);
    else if (expr->kind == TN_EXPR_SOME || expr->kind == TN_EXPR_EACH)
        use_field(index, about->schema, expr->name);
    if (expr->condition)
        use_condition(index, expr->condition);
    if (expr->figure)
        use_figure(index, about, expr->figure);
    if (expr->kind == TN_EXPR_SECTION)
        tn_index_section(index, about->form, expr);
    use_specifier(index, about, expr);
    tn_index_kinds(index, about->form, expr->kinds);
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        tn_index_expression(index, about, part);
}

static void use_library(tn_index *index, tn_symbol *library, const tn_ast_library *ast)
{
    const tn_index_about about = {library->schema, library->form};
    for (TN_EACH(const tn_ast_clause, clause, ast->clauses)) {
        use_field(index, library->schema, clause->field);
        tn_index_expression(index, &about, clause->written);
        if (!clause->name)
            continue;
        const tn_symbol *symbol =
            tn_index_define(index, TN_SYMBOL_CLAUSE, clause->name, clause->doc, &clause->node, library);
        if (symbol && !tn_names_get(&index->clauses, symbol->name))
            tn_names_put(&index->clauses, symbol->name, (void *)(uintptr_t)symbol);
    }
}

static void use_test(tn_index *index, const tn_ast_test *test)
{
    const tn_symbol *subject = NULL;
    for (TN_EACH(const tn_ast_word, name, test->subjects)) {
        const tn_symbol *named = tn_index_use(index, &index->names, name);
        subject = subject ? subject : named;
    }
    const tn_index_about about = {tn_index_schema(index, subject ? subject->name : NULL), NULL};
    for (TN_EACH(const tn_ast_setting, setting, test->settings)) {
        tn_index_use(index, &index->names, setting->name);
        tn_index_expression(index, &about, setting->value);
    }
    for (TN_EACH(const tn_ast_case, test_case, test->cases)) {
        for (TN_EACH(const tn_ast_tray, tray, test_case->literal.trays))
            use_words(index, &about, NULL, &tray->words);
        tn_index_house(index, subject ? subject->form : NULL, test_case->literal.house);
        for (TN_EACH(const tn_ast_word, name, test_case->by))
            if (!tn_index_use(index, &index->clauses, name))
                tn_index_use(index, &index->names, name);
    }
}

/* The symbol of this very item, not of another of the same name. */
static tn_symbol *own_symbol(const tn_index *index, const tn_ast_node *item)
{
    for (tn_symbol *s = index->first; s; s = s->next)
        if (s->ast == item)
            return s;
    return NULL;
}

static void use_item(tn_index *index, const tn_ast_top *item)
{
    if (item->kind == TN_ITEM_SCHEMA) {
        const tn_ast_schema *schema = (const tn_ast_schema *)item;
        const tn_index_about about = {own_symbol(index, &item->node), NULL};
        tn_index_use(index, &index->schemas, schema->from);
        for (TN_EACH(const tn_ast_forbid, forbid, schema->body.forbids))
            tn_index_expression(index, &about, forbid->expr);
    } else if (item->kind == TN_ITEM_RULE || item->kind == TN_ITEM_MEASURE) {
        const tn_ast_rule *rule = (const tn_ast_rule *)item;
        tn_index_use(index, &index->schemas, rule->using);
        const tn_symbol *symbol = own_symbol(index, &item->node);
        const tn_index_about about = {tn_index_schema(index, rule->name->text), symbol ? symbol->form : NULL};
        tn_index_expression(index, &about, rule->written);
    } else if (item->kind == TN_ITEM_PARAM || item->kind == TN_ITEM_LET) {
        const tn_ast_rule *rule = (const tn_ast_rule *)item;
        const tn_index_about about = {NULL, NULL};
        tn_index_expression(index, &about, rule->words.first ? NULL : rule->written);
        tn_index_expression(index, &about, rule->low);
        tn_index_expression(index, &about, rule->high);
    } else if (item->kind == TN_ITEM_FORM) {
        tn_index_use_form(index, own_symbol(index, &item->node), (const tn_ast_form *)item);
    } else if (item->kind == TN_ITEM_TEST) {
        use_test(index, (const tn_ast_test *)item);
    }
}

/* Which schema rules and libraries are about, as far as checking has found out. */
static void set_schemas(tn_index *index, const tn_checked *checked)
{
    for (size_t i = 0; checked && i < checked->schema_count; i++) {
        const tn_checked_schema *schema = checked->schemas[i];
        tn_symbol *symbol = tn_names_get(&index->schemas, schema->name);
        if (symbol && schema->base)
            symbol->schema = tn_names_get(&index->schemas, schema->base->name);
    }
    for (size_t i = 0; checked && i < checked->rule_count; i++) {
        const tn_checked_rule *rule = checked->rules[i];
        tn_symbol *symbol = rule->hidden ? NULL : tn_names_get(&index->names, rule->name);
        if (symbol && rule->schema)
            symbol->schema = tn_names_get(&index->schemas, rule->schema->name);
        if (symbol && rule->form)
            symbol->form = tn_names_get(&index->forms, rule->form->name);
    }
    for (size_t i = 0; checked && i < checked->library_count; i++) {
        const tn_checked_library *library = checked->libraries[i];
        tn_symbol *symbol = tn_names_get(&index->names, library->name);
        if (symbol && library->schema)
            symbol->schema = tn_names_get(&index->schemas, library->schema->name);
        if (symbol && library->form)
            symbol->form = tn_names_get(&index->forms, library->form->name);
    }
}

static void use_libraries(tn_index *index, const tn_ast_file *file)
{
    for (TN_EACH(const tn_ast_top, item, file->items)) {
        const tn_ast_library *library = (const tn_ast_library *)item;
        if (item->kind != TN_ITEM_LIBRARY)
            continue;
        tn_symbol *symbol = tn_names_get(&index->names, library->name->text);
        tn_index_use(index, &index->schemas, library->using);
        tn_index_use(index, &index->names, library->from);
        tn_index_use(index, &index->forms, library->in);
        if (symbol)
            use_library(index, symbol, library);
    }
}

bool tn_index_build(tn_index *index, const tn_compilation *compilation)
{
    const tn_imports *imports = compilation->imports;
    *index = (tn_index){.arena = compilation->arena};
    index->schemas.arena = index->forms.arena = index->names.arena = index->clauses.arena = compilation->arena;
    for (size_t i = 0; imports && i < imports->count; i++)
        define_items(index, imports->units[i]->tree);
    set_schemas(index, compilation->checked);
    for (size_t i = 0; imports && i < imports->count; i++)
        use_libraries(index, imports->units[i]->tree);
    for (size_t i = 0; imports && i < imports->count; i++) {
        const tn_ast_file *file = imports->units[i]->tree;
        for (TN_EACH(const tn_ast_top, item, file->items))
            use_item(index, item);
    }
    return compilation->arena && !tn_arena_failed(compilation->arena);
}

const tn_occurrence *tn_index_at(const tn_index *index, uint32_t file, size_t offset)
{
    for (size_t i = 0; i < index->count; i++) {
        tn_span span = index->occurrences[i].span;
        if (span.file == file && span.begin <= offset && offset <= span.end)
            return &index->occurrences[i];
    }
    return NULL;
}
