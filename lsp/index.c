/* Finds what the names in a .plan file stand for. */
#include "lsp/index.h"

#include <stdio.h>
#include <string.h>

#include "compiler/plan/check/form.h"
#include "compiler/plan/syntax/form_ast.h"

/* What words are looked for in; NULL: none. */
typedef struct index_about {
    const tn_symbol *schema, *form;
} index_about;

static tn_symbol *index_define(tn_index *index, tn_symbol_kind kind, const tn_ast_word *name, const tn_ast_word *doc,
                               const tn_ast_node *ast, const tn_symbol *parent);
static void index_occur(tn_index *index, tn_span span, const tn_symbol *symbol); /* NULL: nothing */
static const tn_symbol *index_use(tn_index *index, const tn_names *names, const tn_ast_word *word);
static void index_expression(tn_index *index, const index_about *about, const tn_ast_expr *expr);

/* ---- what a form declares, and where it is named: in the form, in questions about houses, in lines of houses */

/* A storey, function, opening, tile or layer of a form; NULL where it has none of that name. */
static const tn_symbol *index_part(const tn_symbol *form, const char *name)
{
    for (const tn_symbol *s = form ? form->next : NULL; s && s->parent == form; s = s->next)
        if (s->kind != TN_SYMBOL_CHOICE && strcmp(s->name, name) == 0)
            return s;
    return NULL;
}

/* ---- definitions */

static bool is_defined(tn_form_part part, tn_symbol_kind *kind)
{
    switch (part) {
    case TN_PART_STOREY:
        *kind = TN_SYMBOL_STOREY;
        return true;
    case TN_PART_FUNCTION:
        *kind = TN_SYMBOL_FUNCTION;
        return true;
    case TN_PART_OPENING:
    case TN_PART_FLIGHT:
        *kind = TN_SYMBOL_OPENING;
        return true;
    case TN_PART_TILE:
        *kind = TN_SYMBOL_TILE;
        return true;
    default:
        return false;
    }
}

/* `option NAME = ...`, or `option ZONE NAME = ...`. */
static void define_choice(tn_index *index, const tn_ast_form_clause *clause, const tn_symbol *form)
{
    const tn_ast_word *zone = clause->name, *own = clause->detail ? clause->detail : zone;
    tn_symbol *choice = index_define(index, TN_SYMBOL_CHOICE, own, clause->doc, &clause->node, form);
    char name[2 * TN_NAME_MAX + 2];
    if (!choice || !clause->detail || !zone->text)
        return;
    int size = snprintf(name, sizeof name, "%s %s", zone->text, own->text);
    const char *copied = size < (int)sizeof name ? tn_arena_copy(index->arena, name, (size_t)size) : NULL;
    if (copied)
        choice->name = copied;
}

/* Layers of one name are one part, which the first declares. */
static void define_layers(tn_index *index, const tn_ast_form_clause *clause, const tn_symbol *form)
{
    for (TN_EACH(const tn_ast_layer, layer, clause->parts))
        if (!index_part(form, layer->name->text))
            index_define(index, TN_SYMBOL_LAYER, layer->name, NULL, &layer->node, form);
}

static void index_define_form(tn_index *index, const tn_ast_form *ast)
{
    tn_symbol *form = index_define(index, TN_SYMBOL_FORM, ast->name, ast->doc, &ast->top.node, NULL);
    tn_symbol_kind kind;
    if (!form)
        return;
    index->last_form = form;
    form->schema = ast->schema && ast->schema->text ? tn_names_get(&index->schemas, ast->schema->text) : NULL;
    if (!tn_names_get(&index->forms, form->name))
        tn_names_put(&index->forms, form->name, form);
    for (TN_EACH(const tn_ast_form_clause, clause, ast->clauses))
        if (clause->part == TN_PART_SECTION && clause->name)
            define_choice(index, clause, form);
        else if (clause->part >= TN_PART_WALL && clause->part <= TN_PART_ROOF)
            define_layers(index, clause, form);
        else if (is_defined(clause->part, &kind) && clause->name)
            index_define(index, kind, clause->name, clause->doc, &clause->node, form);
}

/* ---- uses */

/* Openings by name, of a form or NULL: kinds of faces, functions of tiles, parts of materials (tn_ast_word). */
static void index_kinds(tn_index *index, const tn_symbol *form, tn_ast_list words)
{
    for (TN_EACH(const tn_ast_word, word, words))
        if (word->text)
            index_occur(index, word->node.span, index_part(form, word->text));
}

static void use_zone(tn_index *index, const tn_symbol *form, const tn_ast_word *zone)
{
    if (zone && zone->text)
        index_occur(index, zone->node.span, tn_index_field(form->schema, zone->text));
}

/* The choice that words before a value name; second: NULL where there is one word. */
static const tn_symbol *find_choice(const tn_symbol *form, const tn_ast_word *first, const tn_ast_word *second)
{
    for (const tn_symbol *s = form ? form->next : NULL; s && s->parent == form; s = s->next) {
        const tn_ast_form_clause *clause = (const tn_ast_form_clause *)s->ast;
        if (s->kind == TN_SYMBOL_CHOICE && clause->name->text && strcmp(clause->name->text, first->text) == 0 &&
            (second ? clause->detail && strcmp(clause->detail->text, second->text) == 0 : !clause->detail))
            return s;
    }
    return NULL;
}

/* The last node of an alternative is its value. */
static void use_choice(tn_index *index, const tn_symbol *form, const tn_ast_list *words)
{
    const tn_ast_word *named[2] = {NULL, NULL};
    size_t count = 0;
    for (const tn_ast_node *node = words->first; node && node != words->last; node = node->next) {
        const tn_ast_word *word = (const tn_ast_word *)node;
        if (word->kind == TN_WORD_NAME && word->text && count < 2)
            named[count++] = word;
    }
    if (count == 0)
        return;
    const tn_symbol *choice = find_choice(form, named[0], named[1]);
    index_occur(index, named[count - 1]->node.span, choice);
    if (choice && count == 2)
        use_zone(index, form, named[0]);
}

/* `option(...)`, of a form or NULL. */
static void index_section(tn_index *index, const tn_symbol *form, const tn_ast_expr *section)
{
    for (TN_EACH(const tn_ast_item, item, section->items))
        for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives))
            use_choice(index, form, &alternative->words);
}

static void use_tile(tn_index *index, const tn_symbol *form, const tn_ast_form_clause *tile)
{
    index_kinds(index, form, tile->list);
    for (TN_EACH(const tn_ast_tile_part, part, tile->parts))
        if (part->part == TN_TILE_AGAINST)
            index_kinds(index, form, part->list);
}

static void use_layers(tn_index *index, const tn_symbol *form, const tn_ast_form_clause *clause)
{
    for (TN_EACH(const tn_ast_layer, layer, clause->parts)) {
        const tn_symbol *first = index_part(form, layer->name->text);
        if (first && first->ast != &layer->node)
            index_occur(index, layer->name->node.span, first);
    }
}

static void use_classes(tn_index *index, const tn_symbol *form, const tn_ast_form_clause *clause)
{
    for (TN_EACH(const tn_ast_class, class, clause->parts))
        index_occur(index, class->name->node.span, index_part(form, class->name->text));
}

static void index_use_form(tn_index *index, const tn_symbol *form, const tn_ast_form *ast)
{
    if (!form)
        return;
    const index_about about = {form->schema, form};
    index_use(index, &index->schemas, ast->schema);
    for (TN_EACH(const tn_ast_form_clause, clause, ast->clauses)) {
        index_expression(index, &about, clause->first);
        index_expression(index, &about, clause->second);
        if (clause->part == TN_PART_SPINE || clause->part == TN_PART_SECTION)
            use_zone(index, form, clause->name);
        else if (clause->part == TN_PART_FACE || clause->part == TN_PART_MATERIAL)
            index_kinds(index, form, clause->list);
        else if (clause->part == TN_PART_TILE)
            use_tile(index, form, clause);
        else if (clause->part >= TN_PART_WALL && clause->part <= TN_PART_ROOF)
            use_layers(index, form, clause);
        else if (clause->part == TN_PART_CLASSIFICATION)
            use_classes(index, form, clause);
    }
}

/* ---- lines of houses */

static bool is_in_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           (c & 0x80);
}

/* A word of a part of the line names what that part is about: a function, an opening, a tile with its side. */
static void use_house_word(tn_index *index, const tn_symbol *form, int part, const char *name, size_t size,
                           tn_span span)
{
    static const tn_symbol_kind kinds[] = {[2] = TN_SYMBOL_FUNCTION, [3] = TN_SYMBOL_OPENING, [4] = TN_SYMBOL_TILE};
    char *text = tn_arena_copy(index->arena, name, size);
    const tn_symbol *found = text ? index_part(form, text) : NULL;
    if (found && found->kind == kinds[part])
        index_occur(index, span, found);
}

/* The line of a house, in the brackets of a test; NULL: none. */
static void index_house(tn_index *index, const tn_symbol *form, const tn_ast_word *line)
{
    int part = 0; /* plan, section, functions, faces, tiles */
    if (!form || !line || !line->text || line->node.span.end - line->node.span.begin != strlen(line->text))
        return;
    for (const char *at = line->text; *at;) {
        size_t size = 0;
        while (is_in_name(at[size]))
            size++;
        uint32_t begin = line->node.span.begin + (uint32_t)(at - line->text);
        if (size > 0 && part >= 2 && part <= 4)
            use_house_word(index, form, part, at, size, (tn_span){line->node.span.file, begin, begin + (uint32_t)size});
        part += *at == ';';
        at += size ? size : 1;
        while (part == 4 && size && *at && *at != ' ' && *at != '\n' && *at != '\t')
            at++; /* the side of a tile */
    }
}

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

static void index_occur(tn_index *index, tn_span span, const tn_symbol *symbol)
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

/* Defines a symbol, which occurs where it is defined. NULL where out of memory. */
static tn_symbol *index_define(tn_index *index, tn_symbol_kind kind, const tn_ast_word *name, const tn_ast_word *doc,
                               const tn_ast_node *ast, const tn_symbol *parent)
{
    tn_symbol *symbol = add_symbol(index, kind, name, doc, ast, parent);
    index_occur(index, name->node.span, symbol);
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

static const tn_symbol *index_value(const tn_symbol *schema, const tn_symbol *field, const char *name)
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
    return !found && schema && schema->schema ? index_value(schema->schema, field, name) : found;
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
    const tn_symbol *schema = index_define(index, TN_SYMBOL_SCHEMA, ast->name, ast->doc, &ast->top.node, NULL);
    if (!schema)
        return;
    index->last_schema = schema;
    if (!tn_names_get(&index->schemas, schema->name))
        tn_names_put(&index->schemas, schema->name, (void *)(uintptr_t)schema);
    for (TN_EACH(const tn_ast_field, field, ast->body.fields)) {
        const tn_symbol *symbol = index_define(index, TN_SYMBOL_FIELD, field->name, field->doc, &field->node, schema);
        for (TN_EACH(const tn_ast_value, value, field->values))
            if (value->word->kind == TN_WORD_NAME && symbol)
                index_define(index, TN_SYMBOL_VALUE, value->word, value->doc, &value->node, symbol);
    }
}

static void define_named(tn_index *index, tn_symbol_kind kind, const tn_ast_word *name, const tn_ast_word *doc,
                         const tn_ast_node *ast)
{
    tn_symbol *symbol = index_define(index, kind, name, doc, ast, NULL);
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
            index_define_form(index, (const tn_ast_form *)item);
        if (item->kind == TN_ITEM_LIBRARY) {
            const tn_ast_library *library = (const tn_ast_library *)item;
            define_named(index, TN_SYMBOL_LIBRARY, library->name, library->doc, &item->node);
        }
    }
}

/* ---- uses */

/* The symbol that the word names, which occurs there; NULL where there is none. */
static const tn_symbol *index_use(tn_index *index, const tn_names *names, const tn_ast_word *word)
{
    const tn_symbol *symbol = word && word->text ? tn_names_get(names, word->text) : NULL;
    if (symbol)
        index_occur(index, word->node.span, symbol);
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
static const tn_symbol *use_words(tn_index *index, const index_about *about, const tn_symbol *field,
                                  const tn_ast_list *words)
{
    const tn_symbol *schema = about->schema;
    for (TN_EACH(const tn_ast_word, word, *words)) {
        if (word->kind != TN_WORD_NAME || !word->text)
            continue;
        const tn_symbol *part = param_named(index, word);
        if (!part)
            part = index_part(about->form, word->text);
        if (part) {
            index_occur(index, word->node.span, part);
            continue;
        }
        const tn_symbol *value = field ? index_value(schema, field, word->text) : NULL;
        const tn_symbol *named = value ? NULL : tn_index_field(schema, word->text);
        if (!value && !named)
            value = index_value(schema, NULL, word->text);
        index_occur(index, word->node.span, named ? named : value);
        field = named ? named : value ? value->parent : field;
    }
    return field;
}

static void use_specifier(tn_index *index, const index_about *about, const tn_ast_expr *tray)
{
    bool of_cells = tray->kind == TN_EXPR_CELL || tray->kind == TN_EXPR_ROOM;
    const index_about here = {about->schema, of_cells ? about->form : NULL};
    for (TN_EACH(const tn_ast_item, item, tn_ast_tray_items(tray))) {
        const tn_symbol *field = NULL;
        for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives))
            field = use_words(index, &here, field, &alternative->words);
    }
}

static void use_field(tn_index *index, const tn_symbol *schema, const tn_ast_word *word)
{
    if (word && word->text)
        index_occur(index, word->node.span, tn_index_field(schema, word->text));
}

static void use_condition(tn_index *index, const tn_ast_cond *cond)
{
    const tn_ast_word *const words[] = {cond->left, cond->right, cond->modulus, cond->range.low, cond->range.high};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        bool again = i + 1 == sizeof words / sizeof *words && cond->range.low == cond->range.high;
        const tn_symbol *param = again ? NULL : param_named(index, words[i]);
        if (param)
            index_occur(index, words[i]->node.span, param);
    }
    for (TN_EACH(const tn_ast_cond, part, cond->parts))
        use_condition(index, part);
}

/* What a sum adds up: fields, params. */
static void use_figure(tn_index *index, const index_about *about, const tn_ast_expr *figure)
{
    if (figure->kind == TN_EXPR_FIGURE && param_named(index, figure->name))
        index_use(index, &index->names, figure->name);
    else if (figure->kind == TN_EXPR_FIGURE)
        use_field(index, about->schema, figure->name);
    for (TN_EACH(const tn_ast_expr, part, figure->parts))
        use_figure(index, about, part);
}

/* As deep as expressions nest, at most TN_NESTING_MAX. */
static void index_expression(tn_index *index, const index_about *about, const tn_ast_expr *expr)
{
    if (!expr)
        return;
    if (expr->kind == TN_EXPR_NAME || expr->kind == TN_EXPR_CALL)
        index_use(index, &index->names, expr->name);
    else if (expr->kind == TN_EXPR_SOME || expr->kind == TN_EXPR_EACH)
        use_field(index, about->schema, expr->name);
    if (expr->condition)
        use_condition(index, expr->condition);
    if (expr->figure)
        use_figure(index, about, expr->figure);
    if (expr->kind == TN_EXPR_SECTION)
        index_section(index, about->form, expr);
    use_specifier(index, about, expr);
    index_kinds(index, about->form, expr->kinds);
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        index_expression(index, about, part);
}

static void use_library(tn_index *index, tn_symbol *library, const tn_ast_library *ast)
{
    const index_about about = {library->schema, library->form};
    for (TN_EACH(const tn_ast_clause, clause, ast->clauses)) {
        use_field(index, library->schema, clause->field);
        index_expression(index, &about, clause->written);
        if (!clause->name)
            continue;
        const tn_symbol *symbol =
            index_define(index, TN_SYMBOL_CLAUSE, clause->name, clause->doc, &clause->node, library);
        if (symbol && !tn_names_get(&index->clauses, symbol->name))
            tn_names_put(&index->clauses, symbol->name, (void *)(uintptr_t)symbol);
    }
}

static void use_test(tn_index *index, const tn_ast_test *test)
{
    const tn_symbol *subject = NULL;
    for (TN_EACH(const tn_ast_word, name, test->subjects)) {
        const tn_symbol *named = index_use(index, &index->names, name);
        subject = subject ? subject : named;
    }
    const index_about about = {tn_index_schema(index, subject ? subject->name : NULL), NULL};
    for (TN_EACH(const tn_ast_setting, setting, test->settings)) {
        index_use(index, &index->names, setting->name);
        index_expression(index, &about, setting->value);
    }
    for (TN_EACH(const tn_ast_case, test_case, test->cases)) {
        for (TN_EACH(const tn_ast_tray, tray, test_case->literal.trays))
            use_words(index, &about, NULL, &tray->words);
        index_house(index, subject ? subject->form : NULL, test_case->literal.house);
        for (TN_EACH(const tn_ast_word, name, test_case->by))
            if (!index_use(index, &index->clauses, name))
                index_use(index, &index->names, name);
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
        const index_about about = {own_symbol(index, &item->node), NULL};
        index_use(index, &index->schemas, schema->from);
        index_use(index, &index->names, schema->of);
        for (TN_EACH(const tn_ast_field, field, schema->body.fields))
            index_use(index, &index->names, field->said_by);
        for (TN_EACH(const tn_ast_forbid, forbid, schema->body.forbids))
            index_expression(index, &about, forbid->expr);
    } else if (item->kind == TN_ITEM_RULE || item->kind == TN_ITEM_MEASURE) {
        const tn_ast_rule *rule = (const tn_ast_rule *)item;
        index_use(index, &index->schemas, rule->using);
        const tn_symbol *symbol = own_symbol(index, &item->node);
        const index_about about = {tn_index_schema(index, rule->name->text), symbol ? symbol->form : NULL};
        index_expression(index, &about, rule->written);
    } else if (item->kind == TN_ITEM_PARAM || item->kind == TN_ITEM_LET) {
        const tn_ast_rule *rule = (const tn_ast_rule *)item;
        const index_about about = {NULL, NULL};
        index_expression(index, &about, rule->words.first ? NULL : rule->written);
        index_expression(index, &about, rule->low);
        index_expression(index, &about, rule->high);
    } else if (item->kind == TN_ITEM_FORM) {
        index_use_form(index, own_symbol(index, &item->node), (const tn_ast_form *)item);
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
        index_use(index, &index->schemas, library->using);
        index_use(index, &index->names, library->from);
        index_use(index, &index->forms, library->in);
        index_use(index, &index->schemas, library->onto);
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
