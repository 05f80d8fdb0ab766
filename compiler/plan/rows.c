/* Counts what schemas of libraries are made of, on the text without them. */
#include "compiler/plan/rows.h"

#include <stdio.h>
#include <string.h>

#include "compiler/common/names.h"
#include "compiler/plan/syntax/form_ast.h"
#include "compiler/plan/syntax/parse.h"
#include "runtime/module/values.h"

static tn_ast_file *tree_of(const tn_imports *imports, size_t unit)
{
    return imports->units[unit]->tree;
}

static const tn_ast_word *name_of(const tn_ast_top *item)
{
    return item->kind == TN_ITEM_SCHEMA    ? ((const tn_ast_schema *)item)->name
           : item->kind == TN_ITEM_LIBRARY ? ((const tn_ast_library *)item)->name
           : item->kind == TN_ITEM_FORM    ? ((const tn_ast_form *)item)->name
                                           : NULL;
}

/* The item of that kind and name, the first; NULL: there is none. */
static tn_ast_top *item_named(const tn_imports *imports, tn_item_kind kind, const char *name, size_t *unit)
{
    for (*unit = 0; *unit < imports->count; ++*unit)
        for (TN_EACH(tn_ast_top, item, tree_of(imports, *unit)->items))
            if (item->kind == kind && strcmp(name_of(item)->text, name) == 0)
                return item;
    return NULL;
}

/* ---- what is about rows of plans that are not counted yet */

typedef struct leaving {
    tn_names about;     /* schemas and forms */
    tn_names libraries; /* of these */
} leaving;

static bool names_it(const tn_names *names, const tn_ast_word *word)
{
    return word && tn_names_get(names, word->text);
}

static bool is_uncounted(const tn_ast_schema *schema)
{
    return schema->of && !(schema->counted && schema->counted->census);
}

static bool is_left_out(const leaving *l, const tn_ast_top *item)
{
    switch (item->kind) {
    case TN_ITEM_SCHEMA:
        return is_uncounted((const tn_ast_schema *)item) || names_it(&l->about, ((const tn_ast_schema *)item)->from);
    case TN_ITEM_FORM:
        return names_it(&l->about, ((const tn_ast_form *)item)->schema);
    case TN_ITEM_RULE:
    case TN_ITEM_MEASURE:
        return names_it(&l->about, ((const tn_ast_rule *)item)->using);
    case TN_ITEM_LIBRARY: {
        const tn_ast_library *library = (const tn_ast_library *)item;
        return names_it(&l->about, library->using) || names_it(&l->about, library->in) ||
               names_it(&l->about, library->onto) || names_it(&l->libraries, library->from);
    }
    default:
        return false;
    }
}

/* Notes the item's name, if that is new. */
static bool note(leaving *l, const tn_ast_top *item)
{
    const tn_ast_word *name = name_of(item);
    tn_names *names = item->kind == TN_ITEM_LIBRARY ? &l->libraries : &l->about;
    if (!name || tn_names_get(names, name->text) || !is_left_out(l, item))
        return false;
    tn_names_put(names, name->text, (void *)(uintptr_t)name);
    return true;
}

/* Each round finds a name more, or is the last. */
static void find_left_out(tn_arena *arena, const tn_imports *imports, leaving *l)
{
    *l = (leaving){.about.arena = arena, .libraries.arena = arena};
    for (bool more = true; more && !tn_arena_failed(arena);) {
        more = false;
        for (size_t u = 0; u < imports->count; u++)
            for (TN_EACH(const tn_ast_top, item, tree_of(imports, u)->items))
                more |= note(l, item);
    }
}

/* Takes the items out of a tree, and what tests ask: how many tests there are, settings still count. */
static void leave_out(const leaving *l, tn_ast_file *file)
{
    tn_ast_list kept = tn_ast_empty();
    for (tn_ast_node *node = file->items.first, *next; node; node = next) {
        next = node->next;
        node->next = NULL;
        tn_ast_top *item = (tn_ast_top *)node;
        if (item->kind == TN_ITEM_TEST)
            ((tn_ast_test *)item)->subjects = ((tn_ast_test *)item)->cases = tn_ast_empty();
        if (!is_left_out(l, item))
            kept = tn_ast_append(kept, node);
    }
    file->items = kept;
}

/* ---- the text without them */

/* What is counted, and for which schema. */
typedef struct counting {
    const tn_imports *known; /* trees with the censuses so far */
    const char *schema;
    const char *library;
    const char *const *measures; /* a name for each column: a measure's own, or that of a rule's */
    size_t columns;
    bool found; /* the schema was there */
} counting;

/* The only schema that a file sees, or NULL. */
static const tn_ast_word *schema_seen(const tn_imports *imports, size_t from)
{
    const tn_ast_word *found = NULL;
    for (size_t u = 0; u < imports->count; u++)
        for (TN_EACH(const tn_ast_top, item, tree_of(imports, u)->items))
            if (item->kind == TN_ITEM_SCHEMA && tn_import_reaches(imports, from, u)) {
                if (found)
                    return NULL;
                found = name_of(item);
            }
    return found;
}

/* What a library's plans are of; as far as it is made from others, at most once around. */
static const tn_ast_word *schema_of_library(const tn_imports *imports, const char *name)
{
    const tn_ast_word *word = NULL;
    for (size_t rounds = 0; rounds < 1000 && !word; rounds++) {
        size_t unit;
        const tn_ast_library *library = (const tn_ast_library *)item_named(imports, TN_ITEM_LIBRARY, name, &unit);
        if (!library)
            return NULL;
        if (library->onto || library->using)
            return library->onto ? library->onto : library->using;
        if (!library->from)
            return schema_seen(imports, unit);
        name = library->from->text;
    }
    return word;
}

/* Gives their censuses to the schemas that the library's plans rest on: its own, those that it is made from, and those
 * of the libraries whose plans they are rows of. What is wrong with others does not matter. */
static void give_known(const counting *c, const tn_imports *imports)
{
    const tn_ast_word *name = schema_of_library(imports, c->library);
    for (size_t rounds = 0; rounds < 1000 && name; rounds++) {
        size_t unit;
        tn_ast_schema *schema = (tn_ast_schema *)item_named(imports, TN_ITEM_SCHEMA, name->text, &unit);
        const tn_ast_top *known = schema ? item_named(c->known, TN_ITEM_SCHEMA, name->text, &unit) : NULL;
        if (!schema || !known)
            return;
        if (schema->of)
            schema->counted = ((const tn_ast_schema *)known)->counted;
        name = schema->of ? schema_of_library(imports, schema->of->text) : schema->from;
    }
}

static tn_ast_word *word_at(tn_arena *arena, tn_span span, const char *text)
{
    tn_ast_word *word = TN_NEW(arena, tn_ast_word);
    if (word)
        *word = (tn_ast_word){.node.span = span, .kind = TN_WORD_NAME, .text = text};
    return word;
}

/* measure NAME using SCHEMA = matches(RULE) */
static void add_measure(tn_arena *arena, tn_ast_file *file, const tn_ast_word *schema, const char *name,
                        const tn_ast_word *rule)
{
    tn_span span = rule->node.span;
    tn_ast_rule *measure = TN_NEW(arena, tn_ast_rule);
    tn_ast_expr *body = TN_NEW(arena, tn_ast_expr), *part = TN_NEW(arena, tn_ast_expr);
    tn_ast_word *own = word_at(arena, span, name), *using = word_at(arena, span, schema ? schema->text : "");
    if (!measure || !body || !part || !own || !using)
        return;
    *part = (tn_ast_expr){.node.span = span, .kind = TN_EXPR_NAME, .depth = 1, .name = rule};
    *body = (tn_ast_expr){.node.span = span, .kind = TN_EXPR_MATCHES, .depth = 2, .parts = tn_ast_one(part)};
    *measure = (tn_ast_rule){.top = {.node.span = span, .kind = TN_ITEM_MEASURE},
                             .name = own,
                             .using = schema ? using : NULL,
                             .body = body,
                             .written = body};
    file->items = tn_ast_append(file->items, measure);
}

/* Changes the trees to what can be compiled already. */
static void prepare(void *context, tn_arena *arena, const tn_imports *imports)
{
    counting *c = context;
    leaving l;
    size_t unit, column = 0;
    const tn_ast_schema *schema = (const tn_ast_schema *)item_named(imports, TN_ITEM_SCHEMA, c->schema, &unit);
    const tn_ast_word *using = schema ? schema_of_library(imports, c->library) : NULL;
    c->found = schema != NULL;
    give_known(c, imports);
    find_left_out(arena, imports, &l);
    for (size_t u = 0; u < imports->count; u++)
        leave_out(&l, tree_of(imports, u));
    for (TN_EACH(const tn_ast_field, field, schema ? schema->body.fields : tn_ast_empty())) {
        if (!tn_field_is_said(field))
            continue;
        if (field->form == TN_FORM_RULE)
            add_measure(arena, tree_of(imports, unit), using, c->measures[column], field->said_by);
        column++;
    }
}

/* ---- counting */

/* A name for each column: no rule of the file can have that of a rule's. */
static const char **columns_of(tn_arena *arena, const tn_ast_schema *schema, size_t *count)
{
    const char **names = TN_NEW_ARRAY(arena, const char *, schema->body.fields.count + 1);
    *count = 0;
    for (TN_EACH(const tn_ast_field, field, names ? schema->body.fields : tn_ast_empty())) {
        char name[32];
        snprintf(name, sizeof name, "rows@%zu", *count);
        if (tn_field_is_said(field))
            names[(*count)++] =
                field->form == TN_FORM_RULE ? tn_arena_copy(arena, name, strlen(name)) : field->said_by->text;
    }
    return names;
}

static const tn_ast_word *column_word(const tn_ast_schema *schema, size_t column)
{
    size_t at = 0;
    for (TN_EACH(const tn_ast_field, field, schema->body.fields))
        if (tn_field_is_said(field) && at++ == column)
            return field->said_by;
    return schema->of;
}

static tn_status ask(tn_arena *arena, const tn_compile_options *options, const tn_compilation *inner, const counting *c,
                     const tn_ast_schema *schema, tn_error *error)
{
    tn_ast_census *counted = schema->counted;
    tn_census *census = TN_NEW(arena, tn_census);
    size_t column = SIZE_MAX;
    if (!census)
        return tn_fail_memory(error);
    const tn_census_request request = {.module = inner->module,
                                       .module_size = inner->module_size,
                                       .library = c->library,
                                       .measures = c->measures,
                                       .measure_count = c->columns,
                                       .most_values = TN_VALUES_MAX,
                                       .brief = options->partial,
                                       .watch = options->watch};
    tn_status status = options->census.take(options->census.context, &request, arena, census, &column, &counted->error);
    if (status == TN_MEMORY || status == TN_STOPPED) {
        *error = counted->error;
        return status;
    }
    counted->failed = status != TN_OK;
    counted->brief = options->partial;
    counted->census = status == TN_OK ? census : NULL;
    counted->place = column_word(schema, column);
    return TN_OK;
}

static void note_error(const tn_diagnostics *list, tn_error *error)
{
    for (size_t i = 0; i < list->count && !error->message[0]; i++)
        if (list->items[i].severity == TN_ERROR)
            tn_fail(error, TN_INVALID, TN_CODE_NONE, "%.400s", list->items[i].message);
}

static tn_status count_schema(tn_compilation *compilation, const tn_compile_options *options, const tn_imports *imports,
                              tn_ast_schema *schema, tn_rows_compile *compile, tn_error *error)
{
    tn_arena *arena = compilation->arena;
    counting c = {.known = imports, .schema = schema->name->text, .library = schema->of->text};
    c.measures = columns_of(arena, schema, &c.columns);
    if (!c.measures)
        return tn_fail_memory(error);
    tn_compile_options own = *options;
    own.questions = NULL;
    own.warnings_are_errors = false;
    own.change = prepare;
    own.change_context = &c;
    tn_compilation inner;
    tn_status status = tn_compilation_start(&inner, compilation->notation, compilation->input, error);
    if (status == TN_OK)
        status = compile(&inner, &own, error);
    if (status == TN_OK && c.found)
        status = ask(arena, options, &inner, &c, schema, error);
    if (status == TN_INVALID)
        note_error(&inner.diagnostics, &schema->counted->error);
    tn_compilation_clear(&inner);
    return status == TN_MEMORY || status == TN_STOPPED ? status : TN_OK; /* the text itself says what else is wrong */
}

/* Can the library's plans be counted: is it not itself about rows that are not counted yet? */
static bool is_ready(const leaving *l, const tn_ast_schema *schema)
{
    return !names_it(&l->libraries, schema->of);
}

static bool is_waiting(const tn_ast_top *item)
{
    const tn_ast_schema *schema = (const tn_ast_schema *)item;
    return item->kind == TN_ITEM_SCHEMA && schema->of && !schema->of->broken && !schema->counted;
}

/* Counts for one schema that can be; *any: there was one. */
static tn_status count_next(tn_compilation *compilation, const tn_compile_options *options, const tn_imports *imports,
                            tn_rows_compile *compile, bool *any, tn_error *error)
{
    leaving l;
    *any = false;
    find_left_out(compilation->arena, imports, &l);
    for (size_t u = 0; u < imports->count; u++)
        for (TN_EACH(tn_ast_top, item, tree_of(imports, u)->items)) {
            tn_ast_schema *schema = (tn_ast_schema *)item;
            if (!is_waiting(item) || !is_ready(&l, schema))
                continue;
            *any = true;
            schema->counted = TN_NEW(compilation->arena, tn_ast_census);
            return schema->counted ? count_schema(compilation, options, imports, schema, compile, error)
                                   : tn_fail_memory(error);
        }
    return TN_OK;
}

/* Do its plans rest on itself? If not, those that they rest on could not be counted, which is said there. */
static bool goes_round(const tn_imports *imports, const tn_ast_schema *first)
{
    const tn_ast_schema *schema = first;
    for (size_t rounds = 0; rounds < 1000 && schema; rounds++) {
        size_t unit;
        const tn_ast_word *name = schema->of ? schema_of_library(imports, schema->of->text) : schema->from;
        schema = name ? (const tn_ast_schema *)item_named(imports, TN_ITEM_SCHEMA, name->text, &unit) : NULL;
        if (schema == first)
            return true;
    }
    return schema != NULL;
}

tn_status tn_rows_count(tn_compilation *compilation, const tn_compile_options *options, const tn_imports *imports,
                        tn_rows_compile *compile, tn_error *error)
{
    tn_status status = TN_OK;
    if (!options->census.take)
        return TN_OK;
    for (bool any = true; any && status == TN_OK;)
        status = count_next(compilation, options, imports, compile, &any, error);
    for (size_t u = 0; u < imports->count && status == TN_OK; u++)
        for (TN_EACH(tn_ast_top, item, tree_of(imports, u)->items))
            if (is_waiting(item)) {
                tn_ast_schema *schema = (tn_ast_schema *)item;
                schema->counted = TN_NEW(compilation->arena, tn_ast_census);
                if (!schema->counted)
                    return tn_fail_memory(error);
                schema->counted->circular = goes_round(imports, schema);
            }
    return status;
}
