/* Completion: from the tokens before the cursor, which say where it is also in a text that is not finished. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "lsp/features.h"

/* CompletionItemKind of the protocol. */
enum {
    KIND_FUNCTION = 3,
    KIND_FIELD = 5,
    KIND_MODULE = 9,
    KIND_KEYWORD = 14,
    KIND_FILE = 17,
    KIND_VALUE = 20,
    KIND_STRUCT = 22
};

enum { DEPTH_MAX = 1024 }; /* brackets around the cursor that are told apart */

/* Where the cursor is. */
typedef struct cursor {
    const tn_file_analysis *analysis;
    const char *text;
    const tn_token *tokens;
    size_t count; /* tokens before the cursor; not the word that it is in or just behind */
    size_t item;  /* the word that starts the item; `count` where there is none */
    bool in_braces;
    size_t braces;              /* how many are open */
    size_t clause;              /* the last word at the level of the braces that starts a clause, field or case */
    size_t brackets[DEPTH_MAX]; /* open ones */
    size_t depth;
    json_t *list;
} cursor;

static bool is(const cursor *c, size_t i, const char *text)
{
    if (i >= c->count)
        return false;
    tn_span span = c->tokens[i].span;
    return strlen(text) == span.end - span.begin && strncasecmp(c->text + span.begin, text, strlen(text)) == 0;
}

static bool is_any(const cursor *c, size_t i, const char *const *texts)
{
    for (; *texts; texts++)
        if (is(c, i, *texts))
            return true;
    return false;
}

static char *word_at(const cursor *c, size_t i)
{
    tn_span span = c->tokens[i].span;
    return strndup(c->text + span.begin, span.end - span.begin);
}

static void offer(cursor *c, const char *label, int kind, const char *detail, const char *group)
{
    json_t *item = json_pack("{s:s,s:i}", "label", label, "kind", kind);
    if (detail)
        json_object_set_new(item, "detail", json_string(detail));
    json_object_set_new(item, "sortText", json_sprintf("%s%s", group, label));
    json_array_append_new(c->list, item);
}

static void offer_words(cursor *c, const char *const *words)
{
    for (; *words; words++)
        offer(c, *words, KIND_KEYWORD, NULL, "2");
}

static void offer_symbols(cursor *c, tn_symbol_kind kind, int shown)
{
    for (const tn_symbol *s = c->analysis->index.first; s; s = s->next)
        if (s->kind == kind)
            offer(c, s->name, shown, s->doc, "1");
}

/* ---- inside specifiers and plans */

static const tn_symbol *schema_here(const cursor *c)
{
    const tn_index *index = &c->analysis->index;
    for (size_t i = c->item; i + 1 < c->count && i < c->item + 8; i++) {
        if (!is(c, i, "using"))
            continue;
        char *name = word_at(c, i + 1);
        const tn_symbol *schema = name ? tn_names_get(&index->schemas, name) : NULL;
        free(name);
        if (schema)
            return schema;
    }
    size_t named = is(c, c->item, "schema") ? 0 : 1;
    char *owner = c->item + 1 < c->count ? word_at(c, c->item + 1) : NULL;
    const tn_symbol *schema = !owner  ? NULL
                              : named ? tn_index_schema(index, owner)
                                      : tn_names_get(&index->schemas, owner);
    free(owner);
    return schema;
}

/* The field that the words before the cursor, back to a comma or bracket, are about; NULL where none is named. */
static const tn_symbol *field_here(const cursor *c, const tn_symbol *schema)
{
    const tn_symbol *field = NULL;
    size_t start = c->depth ? c->brackets[c->depth - 1] + 1 : c->count;
    for (size_t i = start; i < c->count; i++) {
        if (is(c, i, ",") || is(c, i, "|"))
            field = NULL;
        if (c->tokens[i].kind != TN_TOKEN_NAME)
            continue;
        char *name = word_at(c, i);
        const tn_symbol *named = name ? tn_index_field(schema, name) : NULL;
        field = named ? named : field;
        free(name);
    }
    return field;
}

static void offer_values(cursor *c, const tn_symbol *field, const char *group)
{
    const tn_ast_field *ast = (const tn_ast_field *)field->ast;
    const tn_source *sources = c->analysis->compilation.sources.files;
    for (TN_EACH(const tn_ast_value, value, ast->values)) {
        tn_span span = value->word->node.span;
        char *text = strndup(sources[span.file].text + span.begin, span.end - span.begin);
        if (text)
            offer(c, text, KIND_VALUE, value->doc ? value->doc->text : field->name, group);
        free(text);
        for (TN_EACH(const tn_ast_word, depth, value->depths))
            if (depth->text)
                offer(c, depth->text, KIND_VALUE, "a depth", "1");
    }
}

/* The fields that a schema declares, those that add values to an older one's included. */
static void offer_declared(cursor *c, const tn_symbol *schema, const tn_symbol *field)
{
    for (const tn_symbol *s = schema->next; s && (s->parent == schema || s->kind == TN_SYMBOL_VALUE); s = s->next) {
        if (s->kind != TN_SYMBOL_FIELD)
            continue;
        const tn_ast_field *ast = (const tn_ast_field *)s->ast;
        bool named = field && strcmp(s->name, field->name) == 0;
        if (!named && !ast->extends)
            offer(c, s->name, KIND_FIELD, s->doc, "1");
        if (named || ast->form == TN_FORM_VALUES)
            offer_values(c, s, named ? "0" : "1");
    }
}

static void complete_tray(cursor *c, bool literal)
{
    static const char *const words[] = {"not", "or", NULL}, *const literal_words[] = {"not", NULL};
    const tn_symbol *schema = schema_here(c), *field = schema ? field_here(c, schema) : NULL;
    for (const tn_symbol *s = schema; s; s = s->schema)
        offer_declared(c, s, field);
    offer_words(c, literal ? literal_words : words);
}

/* ---- codes of warnings */

static void complete_codes(cursor *c)
{
    static const struct {
        int code;
        const char *summary;
    } warnings[] = {
#define ERROR(NUMBER, NAME, SUMMARY)
#define WARNING(NUMBER, NAME, SUMMARY) {NUMBER, SUMMARY},
#include "runtime/base/codes.def"
#undef ERROR
#undef WARNING
    };
    for (size_t i = 0; i < sizeof warnings / sizeof *warnings; i++) {
        char code[16];
        snprintf(code, sizeof code, "W%03d", warnings[i].code);
        offer(c, code, KIND_VALUE, warnings[i].summary, "1");
    }
}

/* ---- houses */

/* The form that the item is, or is about; else the last one there is. */
static const tn_symbol *form_here(const cursor *c)
{
    const tn_index *index = &c->analysis->index;
    char *name = c->item + 1 < c->count ? word_at(c, c->item + 1) : NULL;
    const tn_symbol *symbol = !name                    ? NULL
                              : is(c, c->item, "form") ? tn_names_get(&index->forms, name)
                                                       : tn_names_get(&index->names, name);
    free(name);
    if (symbol && symbol->kind != TN_SYMBOL_FORM)
        symbol = symbol->form;
    return symbol ? symbol : index->last_form;
}

static void offer_parts(cursor *c, tn_symbol_kind kind, int shown)
{
    const tn_symbol *form = form_here(c);
    for (const tn_symbol *s = form ? form->next : NULL; s && s->parent == form; s = s->next)
        if (s->kind == kind)
            offer(c, s->name, shown, s->doc, "1");
}

static void complete_cell(cursor *c, bool room)
{
    static const char *const words[] = {"any", "void", "area", "not", "or", NULL};
    static const char *const room_words[] = {"cells", "by", "glazing", NULL};
    const tn_symbol *form = form_here(c), *field = form ? field_here(c, form->schema) : NULL;
    offer_parts(c, TN_SYMBOL_STOREY, KIND_VALUE);
    offer_parts(c, TN_SYMBOL_FUNCTION, KIND_FUNCTION);
    for (const tn_symbol *s = form ? form->schema : NULL; s; s = s->schema)
        offer_declared(c, s, field);
    offer_words(c, words);
    if (room) {
        offer_parts(c, TN_SYMBOL_OPENING, KIND_VALUE);
        offer_words(c, room_words);
    }
}

static void complete_kinds(cursor *c)
{
    static const char *const kinds[] = {"wall", "party", "open", "floor", "stair", NULL};
    offer_parts(c, TN_SYMBOL_OPENING, KIND_VALUE);
    offer_words(c, kinds);
}

/* In the braces of a form, outside of parentheses. */
static void complete_form(cursor *c)
{
    static const char *const clauses[] = {"storey",  "spine",  "wall", "partition", "deck",     "roof",
                                          "section", "forbid", "void", "no",        "function", "opening",
                                          "flight",  "face",   "tile", "material",  "allow",    NULL};
    static const char *const faces[] = {"cell", "beside", "along", "across", "under", "outside",
                                        "back", "front",  "left",  "right",  NULL};
    static const char *const tiles[] = {"for",  "against", "or",   "wide",  "deep", "item", "keep",
                                        "left", "right",   "back", "front", "up",   NULL};
    static const char *const openings[] = {"wide", "high", "sill", "clear", "passage", "glazed", NULL};
    static const char *const flights[] = {"wide", "rise", "going", "turn", "half", "quarter", NULL};
    static const char *const sections[] = {"storeys", "roof",  "flat", "shed",   "gable",
                                           "vault",   "eaves", "open", "across", NULL};
    static const char *const materials[] = {"price", "per", "each", "sf", "m2", "cf", "m3", "for", "where", NULL};
    static const char *const at[] = {"at", "cell", NULL};
    if (c->braces > 1 || is(c, c->clause, "tile")) {
        offer_parts(c, TN_SYMBOL_FUNCTION, KIND_FUNCTION);
        complete_kinds(c);
        offer_words(c, tiles);
    } else if (is(c, c->clause, "face")) {
        complete_kinds(c);
        offer_words(c, faces);
    } else if (is(c, c->clause, "material")) {
        offer_parts(c, TN_SYMBOL_OPENING, KIND_VALUE);
        offer_words(c, materials);
    } else if (is(c, c->clause, "allow")) {
        complete_codes(c);
    } else if (is(c, c->clause, "opening")) {
        offer_words(c, openings);
    } else if (is(c, c->clause, "flight")) {
        offer_words(c, flights);
    } else if (is(c, c->clause, "section")) {
        offer_words(c, sections);
    } else if (is(c, c->clause, "function")) {
        offer_words(c, at);
    }
    if (c->braces == 1)
        offer_words(c, clauses);
}

/* ---- elsewhere */

static void offer_fields(cursor *c, const char *group)
{
    for (const tn_symbol *schema = schema_here(c); schema; schema = schema->schema)
        for (const tn_symbol *s = schema->next; s; s = s->next)
            if (s->kind == TN_SYMBOL_FIELD && s->parent == schema && !((const tn_ast_field *)s->ast)->extends)
                offer(c, s->name, KIND_FIELD, s->doc, group);
}

static void complete_expression(cursor *c)
{
    static const char *const words[] = {
        "tray",  "cell",  "room",        "section",  "touch", "apart", "any",     "neighbour", "symmetric", "quantity",
        "sum",   "many",  "occurrences", "distance", "and",   "or",    "not",     "optional",  "beginning", "end",
        "using", "allow", "implies",     "every",    "some",  "plan",  "matches", "trays",     NULL};
    offer_symbols(c, TN_SYMBOL_RULE, KIND_FUNCTION);
    offer_symbols(c, TN_SYMBOL_MEASURE, KIND_VALUE);
    offer_words(c, words);
}

static void complete_in_call(cursor *c, size_t bracket)
{
    static const char *const counted[] = {"quantity", "occurrences", "sum", NULL};
    static const char *const condition[] = {"and", "or", "not", "in", "mod", NULL};
    static const char *const distance[] = {"from", "to", "by", NULL};
    bool comma = false;
    for (size_t i = bracket + 1, depth = 0; i < c->count; i++) {
        depth += is(c, i, "(");
        depth -= depth > 0 && is(c, i, ")");
        comma |= depth == 0 && is(c, i, ",");
    }
    if (bracket > 0 && is_any(c, bracket - 1, counted) && comma) {
        offer_words(c, condition);
        return;
    }
    if (bracket > 0 && is(c, bracket - 1, "sum") && bracket + 1 == c->count) {
        offer_fields(c, "1");
        return;
    }
    if (bracket > 0 && is(c, bracket - 1, "distance"))
        offer_words(c, distance);
    complete_expression(c);
}

static void complete_clause_names(cursor *c)
{
    static const char *const words[] = {"total", "trays", NULL};
    offer_symbols(c, TN_SYMBOL_CLAUSE, KIND_VALUE);
    offer_symbols(c, TN_SYMBOL_RULE, KIND_FUNCTION);
    offer_symbols(c, TN_SYMBOL_MEASURE, KIND_VALUE);
    offer_words(c, words);
}

static void complete_library(cursor *c)
{
    static const char *const clauses[] = {"trays", "total", "require", "prune", "allow", NULL};
    static const char *const as[] = {"as", NULL};
    offer_words(c, clauses);
    if (is(c, c->clause, "require") || is(c, c->clause, "prune")) {
        offer_words(c, as);
        complete_expression(c);
    } else if (is(c, c->clause, "allow")) {
        complete_codes(c);
    } else if (is(c, c->clause, "total") && c->clause + 1 == c->count) {
        offer_fields(c, "0");
    }
}

static void complete_schema(cursor *c)
{
    static const char *const words[] = {"zone", "forbid", "flag", "role", "number", "where", NULL};
    static const char *const roles[] = {"length", "level", "public-end", "great-hall", "band",   "text",
                                        "tone",   "hatch", "solid",      "void",       "absent", NULL};
    offer_words(c, c->count > 0 && is(c, c->count - 1, "role") ? roles : words);
}

static void complete_test(cursor *c)
{
    static const char *const rule_words[] = {"match", "reject", "todo", NULL}, *const library_words[] = {"keep", "drop",
                                                                                                         "by", NULL};
    char *subject = c->item + 1 < c->count ? word_at(c, c->item + 1) : NULL;
    const tn_symbol *symbol = subject ? tn_names_get(&c->analysis->index.names, subject) : NULL;
    free(subject);
    bool by = false;
    for (size_t i = c->clause; i < c->count; i++)
        by |= is(c, i, "by");
    if (by)
        complete_clause_names(c);
    offer_words(c, symbol && symbol->kind == TN_SYMBOL_LIBRARY ? library_words : rule_words);
}

static void complete_top(cursor *c)
{
    static const char *const items[] = {"use", "schema", "rule", "measure", "let", "library", "form", "test", NULL};
    static const char *const head[] = {"using", "from", "in", "of", "allow", NULL};
    size_t last = c->count - 1;
    if (c->count > 0 && is(c, last, "using")) {
        offer_symbols(c, TN_SYMBOL_SCHEMA, KIND_STRUCT);
    } else if (c->count > 0 && is(c, last, "in") && is(c, c->item, "library")) {
        offer_symbols(c, TN_SYMBOL_FORM, KIND_STRUCT);
    } else if (c->count > 0 && is(c, last, "of") && is(c, c->item, "form")) {
        offer_symbols(c, TN_SYMBOL_SCHEMA, KIND_STRUCT);
    } else if (c->count > 0 && is(c, last, "from")) {
        offer_symbols(c, TN_SYMBOL_LIBRARY, KIND_MODULE);
    } else if (c->count > 0 && is(c, last, "test") && last == c->item) {
        offer_symbols(c, TN_SYMBOL_RULE, KIND_FUNCTION);
        offer_symbols(c, TN_SYMBOL_MEASURE, KIND_VALUE);
        offer_symbols(c, TN_SYMBOL_LIBRARY, KIND_MODULE);
    } else if (c->count > 0 && is(c, last, "allow")) {
        complete_codes(c);
    } else {
        bool body = false;
        for (size_t i = c->item; i < c->count; i++)
            body |= is(c, i, "=");
        if ((is(c, c->item, "rule") || is(c, c->item, "measure")) && body)
            complete_expression(c);
        else if (c->item + 1 < c->count)
            offer_words(c, head);
        offer_words(c, items);
    }
}

static void complete_files(cursor *c, const tn_workspace *workspace)
{
    for (size_t i = 0; i < workspace->stdlib.count; i++) {
        DIR *folder = opendir(workspace->stdlib.dirs[i]);
        for (struct dirent *entry; folder && (entry = readdir(folder));) {
            size_t size = strlen(entry->d_name);
            size_t tail = strlen(TN_NOTATION(plan)->extension);
            if (size <= tail || strcmp(entry->d_name + size - tail, TN_NOTATION(plan)->extension) != 0)
                continue;
            char *name = strndup(entry->d_name, size - tail);
            if (name)
                offer(c, name, KIND_FILE, "standard library", "1");
            free(name);
        }
        if (folder)
            closedir(folder);
    }
}

/* ---- where the cursor is */

/* Takes the tokens up to the cursor. False inside a comment; *quoted: inside a text in quotes. */
static bool find_tokens(cursor *c, size_t offset, bool *quoted)
{
    const tn_tokens *tokens = &c->analysis->tokens;
    *quoted = false;
    for (size_t i = 0; i < tokens->count; i++) {
        tn_token token = tokens->items[i];
        bool word = token.kind == TN_TOKEN_WORD || token.kind == TN_TOKEN_NAME || token.kind == TN_TOKEN_FIELD;
        if (token.span.begin >= offset || (word && token.span.end >= offset))
            break;
        if (token.kind == TN_TOKEN_COMMENT && offset <= token.span.end)
            return false;
        *quoted = (token.kind == TN_TOKEN_STRING || token.kind == TN_TOKEN_HOUSE) && offset < token.span.end;
        if (*quoted)
            break;
        c->count = i + 1;
    }
    return true;
}

static void find_context(cursor *c)
{
    static const char *const items[] = {"use", "schema", "rule", "measure", "let", "library", "form", "test", NULL};
    static const char *const clauses[] = {"trays",  "total", "require", "prune", "allow",  "match",
                                          "reject", "keep",  "drop",    "zone",  "forbid", NULL};
    static const char *const of_form[] = {"storey", "spine",    "section", "function", "opening", "flight",
                                          "face",   "material", "allow",   "forbid",   "tile",    NULL};
    c->item = c->clause = c->count;
    for (size_t i = 0; i < c->count; i++) {
        if (c->tokens[i].kind == TN_TOKEN_WORD && is_any(c, i, items)) {
            c->item = i;
            c->clause = c->count;
            c->depth = 0;
            c->in_braces = false;
            c->braces = 0;
        } else if (is(c, i, "{")) {
            c->in_braces = true;
            c->braces++;
        } else if (is(c, i, "}") && c->braces > 1) {
            c->braces--;
            c->clause = c->count;
            c->depth = 0;
        } else if (is(c, i, "}")) {
            c->braces = 0;
            c->in_braces = false;
            c->item = c->clause = c->count;
            c->depth = 0;
        } else if ((is(c, i, "(") || is(c, i, "[")) && c->depth < DEPTH_MAX) {
            c->brackets[c->depth++] = i;
        } else if ((is(c, i, ")") || is(c, i, "]")) && c->depth > 0) {
            c->depth--;
        } else if (c->in_braces && c->tokens[i].kind == TN_TOKEN_WORD &&
                   is_any(c, i, is(c, c->item, "form") ? of_form : clauses)) {
            c->clause = i;
            c->depth = 0;
        }
    }
}

static void complete(cursor *c)
{
    size_t bracket = c->depth ? c->brackets[c->depth - 1] : 0;
    size_t outer = c->depth;
    while (outer > 0 && !(c->brackets[outer - 1] > 0 && is(c, c->brackets[outer - 1] - 1, "tray")))
        outer--;
    bool of_room = c->depth && bracket > 0 && is(c, bracket - 1, "room");
    if (c->depth && is(c, bracket, "["))
        complete_tray(c, true);
    else if (of_room || (c->depth && bracket > 0 && is(c, bracket - 1, "cell")))
        complete_cell(c, of_room);
    else if (outer > 0)
        complete_tray(c, false);
    else if (c->depth && !is(c, c->item, "schema"))
        complete_in_call(c, bracket);
    else if (c->in_braces && is(c, c->item, "library"))
        complete_library(c);
    else if (c->in_braces && is(c, c->item, "schema"))
        complete_schema(c);
    else if (c->in_braces && is(c, c->item, "form"))
        complete_form(c);
    else if (c->in_braces && is(c, c->item, "test"))
        complete_test(c);
    else
        complete_top(c);
}

/* The same label once. */
static json_t *without_repeats(json_t *list)
{
    json_t *seen = json_object(), *kept = json_array(), *item;
    size_t i;
    json_array_foreach(list, i, item)
    {
        const char *label = json_string_value(json_object_get(item, "label"));
        if (!label || json_object_get(seen, label))
            continue;
        json_object_set_new(seen, label, json_true());
        json_array_append(kept, item);
    }
    json_decref(seen);
    json_decref(list);
    return kept;
}

json_t *tn_lsp_completion(tn_workspace *workspace, tn_document *document, tn_file_analysis *analysis, size_t offset)
{
    cursor *c = calloc(1, sizeof *c);
    bool quoted;
    if (!c)
        return NULL;
    c->analysis = analysis;
    c->text = document->text;
    c->tokens = analysis->tokens.items;
    c->list = json_array();
    if (find_tokens(c, offset, &quoted)) {
        find_context(c);
        if (!quoted)
            complete(c);
        else if (c->count > 0 && is(c, c->count - 1, "use"))
            complete_files(c, workspace);
    }
    json_t *list = without_repeats(c->list);
    free(c);
    return list;
}
