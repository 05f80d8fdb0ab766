/* Completion: from the tokens before the cursor, which say where it is also in a text that is not finished. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "lsp/complete_parts.h"

bool tn_cursor_is(const tn_lsp_cursor *c, size_t i, const char *text)
{
    if (i >= c->count)
        return false;
    tn_span span = c->tokens[i].span;
    return strlen(text) == span.end - span.begin && strncasecmp(c->text + span.begin, text, strlen(text)) == 0;
}

bool tn_cursor_is_any(const tn_lsp_cursor *c, size_t i, const char *const *texts)
{
    for (; *texts; texts++)
        if (tn_cursor_is(c, i, *texts))
            return true;
    return false;
}

char *tn_cursor_word(const tn_lsp_cursor *c, size_t i)
{
    tn_span span = c->tokens[i].span;
    return strndup(c->text + span.begin, span.end - span.begin);
}

void tn_offer(tn_lsp_cursor *c, const char *label, int kind, const char *detail, const char *group)
{
    json_t *item = json_pack("{s:s,s:i}", "label", label, "kind", kind);
    if (detail)
        json_object_set_new(item, "detail", json_string(detail));
    json_object_set_new(item, "sortText", json_sprintf("%s%s", group, label));
    json_array_append_new(c->list, item);
}

void tn_offer_words(tn_lsp_cursor *c, const char *const *words)
{
    for (; *words; words++)
        tn_offer(c, *words, KIND_KEYWORD, NULL, "2");
}

static void offer_symbols(tn_lsp_cursor *c, tn_symbol_kind kind, int shown)
{
    for (const tn_symbol *s = c->analysis->index.first; s; s = s->next)
        if (s->kind == kind)
            tn_offer(c, s->name, shown, s->doc, "1");
}

/* ---- inside specifiers and plans */

static const tn_symbol *schema_here(const tn_lsp_cursor *c)
{
    const tn_index *index = &c->analysis->index;
    for (size_t i = c->item; i + 1 < c->count && i < c->item + 8; i++) {
        if (!tn_cursor_is(c, i, "using"))
            continue;
        char *name = tn_cursor_word(c, i + 1);
        const tn_symbol *schema = name ? tn_names_get(&index->schemas, name) : NULL;
        free(name);
        if (schema)
            return schema;
    }
    size_t named = tn_cursor_is(c, c->item, "schema") ? 0 : 1;
    char *owner = c->item + 1 < c->count ? tn_cursor_word(c, c->item + 1) : NULL;
    const tn_symbol *schema = !owner  ? NULL
                              : named ? tn_index_schema(index, owner)
                                      : tn_names_get(&index->schemas, owner);
    free(owner);
    return schema;
}

/* The field that the words before the cursor, back to a comma or bracket, are about; NULL where none is named. */
const tn_symbol *tn_cursor_field(const tn_lsp_cursor *c, const tn_symbol *schema)
{
    const tn_symbol *field = NULL;
    size_t start = c->depth ? c->brackets[c->depth - 1] + 1 : c->count;
    for (size_t i = start; i < c->count; i++) {
        if (tn_cursor_is(c, i, ",") || tn_cursor_is(c, i, "|"))
            field = NULL;
        if (c->tokens[i].kind != TN_TOKEN_NAME)
            continue;
        char *name = tn_cursor_word(c, i);
        const tn_symbol *named = name ? tn_index_field(schema, name) : NULL;
        field = named ? named : field;
        free(name);
    }
    return field;
}

static void offer_values(tn_lsp_cursor *c, const tn_symbol *field, const char *group)
{
    const tn_ast_field *ast = (const tn_ast_field *)field->ast;
    const tn_source *sources = c->analysis->compilation.sources.files;
    for (TN_EACH(const tn_ast_value, value, ast->values)) {
        tn_span span = value->word->node.span;
        char *text = strndup(sources[span.file].text + span.begin, span.end - span.begin);
        if (text)
            tn_offer(c, text, KIND_VALUE, value->doc ? value->doc->text : field->name, group);
        free(text);
        for (TN_EACH(const tn_ast_word, depth, value->depths))
            if (depth->text)
                tn_offer(c, depth->text, KIND_VALUE, "a depth", "1");
    }
}

/* The fields that a schema declares, those that add values to an older one's included. */
void tn_offer_declared(tn_lsp_cursor *c, const tn_symbol *schema, const tn_symbol *field)
{
    for (const tn_symbol *s = schema->next; s && (s->parent == schema || s->kind == TN_SYMBOL_VALUE); s = s->next) {
        if (s->kind != TN_SYMBOL_FIELD)
            continue;
        const tn_ast_field *ast = (const tn_ast_field *)s->ast;
        bool named = field && strcmp(s->name, field->name) == 0;
        if (!named && !ast->extends)
            tn_offer(c, s->name, KIND_FIELD, s->doc, "1");
        if (named || ast->form == TN_FORM_VALUES)
            offer_values(c, s, named ? "0" : "1");
    }
}

static void complete_tray(tn_lsp_cursor *c, bool literal)
{
    static const char *const words[] = {"not", "or", NULL}, *const literal_words[] = {"not", NULL};
    const tn_symbol *schema = schema_here(c), *field = schema ? tn_cursor_field(c, schema) : NULL;
    for (const tn_symbol *s = schema; s; s = s->schema)
        tn_offer_declared(c, s, field);
    tn_offer_words(c, literal ? literal_words : words);
}

/* ---- codes of warnings */

void tn_complete_codes(tn_lsp_cursor *c)
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
        tn_offer(c, code, KIND_VALUE, warnings[i].summary, "1");
    }
}

/* ---- elsewhere */

static void offer_fields(tn_lsp_cursor *c, const char *group)
{
    for (const tn_symbol *schema = schema_here(c); schema; schema = schema->schema)
        for (const tn_symbol *s = schema->next; s; s = s->next)
            if (s->kind == TN_SYMBOL_FIELD && s->parent == schema && !((const tn_ast_field *)s->ast)->extends)
                tn_offer(c, s->name, KIND_FIELD, s->doc, group);
}

static void complete_expression(tn_lsp_cursor *c)
{
    static const char *const words[] = {
        "tray",  "cell",  "room",        "section",  "touch", "apart", "any",     "neighbour", "symmetric", "quantity",
        "sum",   "many",  "occurrences", "distance", "and",   "or",    "not",     "optional",  "beginning", "end",
        "using", "allow", "implies",     "every",    "some",  "plan",  "matches", "trays",     NULL};
    offer_symbols(c, TN_SYMBOL_RULE, KIND_FUNCTION);
    offer_symbols(c, TN_SYMBOL_MEASURE, KIND_VALUE);
    tn_offer_words(c, words);
}

static void complete_in_call(tn_lsp_cursor *c, size_t bracket)
{
    static const char *const counted[] = {"quantity", "occurrences", "sum", NULL};
    static const char *const condition[] = {"and", "or", "not", "in", "mod", NULL};
    static const char *const distance[] = {"from", "to", "by", NULL};
    bool comma = false;
    for (size_t i = bracket + 1, depth = 0; i < c->count; i++) {
        depth += tn_cursor_is(c, i, "(");
        depth -= depth > 0 && tn_cursor_is(c, i, ")");
        comma |= depth == 0 && tn_cursor_is(c, i, ",");
    }
    if (bracket > 0 && tn_cursor_is_any(c, bracket - 1, counted) && comma) {
        tn_offer_words(c, condition);
        return;
    }
    if (bracket > 0 && tn_cursor_is(c, bracket - 1, "sum") && bracket + 1 == c->count) {
        offer_fields(c, "1");
        return;
    }
    if (bracket > 0 && tn_cursor_is(c, bracket - 1, "distance"))
        tn_offer_words(c, distance);
    complete_expression(c);
}

static void complete_clause_names(tn_lsp_cursor *c)
{
    static const char *const words[] = {"total", "trays", NULL};
    offer_symbols(c, TN_SYMBOL_CLAUSE, KIND_VALUE);
    offer_symbols(c, TN_SYMBOL_RULE, KIND_FUNCTION);
    offer_symbols(c, TN_SYMBOL_MEASURE, KIND_VALUE);
    tn_offer_words(c, words);
}

static void complete_library(tn_lsp_cursor *c)
{
    static const char *const clauses[] = {"trays", "total", "require", "prune", "allow", NULL};
    static const char *const as[] = {"as", NULL};
    tn_offer_words(c, clauses);
    if (tn_cursor_is(c, c->clause, "require") || tn_cursor_is(c, c->clause, "prune")) {
        tn_offer_words(c, as);
        complete_expression(c);
    } else if (tn_cursor_is(c, c->clause, "allow")) {
        tn_complete_codes(c);
    } else if (tn_cursor_is(c, c->clause, "total") && c->clause + 1 == c->count) {
        offer_fields(c, "0");
    }
}

static void complete_schema(tn_lsp_cursor *c)
{
    static const char *const words[] = {"zone", "forbid", "flag", "role", "number", "where", NULL};
    static const char *const roles[] = {"length", "level", "public-end", "great-hall", "band",   "text",
                                        "tone",   "hatch", "solid",      "void",       "absent", NULL};
    tn_offer_words(c, c->count > 0 && tn_cursor_is(c, c->count - 1, "role") ? roles : words);
}

static void complete_test(tn_lsp_cursor *c)
{
    static const char *const rule_words[] = {"match", "reject", "todo", NULL}, *const library_words[] = {"keep", "drop",
                                                                                                         "by", NULL};
    char *subject = c->item + 1 < c->count ? tn_cursor_word(c, c->item + 1) : NULL;
    const tn_symbol *symbol = subject ? tn_names_get(&c->analysis->index.names, subject) : NULL;
    free(subject);
    bool by = false;
    for (size_t i = c->clause; i < c->count; i++)
        by |= tn_cursor_is(c, i, "by");
    if (by)
        complete_clause_names(c);
    tn_offer_words(c, symbol && symbol->kind == TN_SYMBOL_LIBRARY ? library_words : rule_words);
}

static void complete_top(tn_lsp_cursor *c)
{
    static const char *const items[] = {"use", "schema", "rule", "measure", "let", "library", "form", "test", NULL};
    static const char *const head[] = {"using", "from", "in", "of", "allow", NULL};
    size_t last = c->count - 1;
    if (c->count > 0 && tn_cursor_is(c, last, "using")) {
        offer_symbols(c, TN_SYMBOL_SCHEMA, KIND_STRUCT);
    } else if (c->count > 0 && tn_cursor_is(c, last, "in") && tn_cursor_is(c, c->item, "library")) {
        offer_symbols(c, TN_SYMBOL_FORM, KIND_STRUCT);
    } else if (c->count > 0 && tn_cursor_is(c, last, "of") && tn_cursor_is(c, c->item, "form")) {
        offer_symbols(c, TN_SYMBOL_SCHEMA, KIND_STRUCT);
    } else if (c->count > 0 && tn_cursor_is(c, last, "from")) {
        offer_symbols(c, TN_SYMBOL_LIBRARY, KIND_MODULE);
    } else if (c->count > 0 && tn_cursor_is(c, last, "test") && last == c->item) {
        offer_symbols(c, TN_SYMBOL_RULE, KIND_FUNCTION);
        offer_symbols(c, TN_SYMBOL_MEASURE, KIND_VALUE);
        offer_symbols(c, TN_SYMBOL_LIBRARY, KIND_MODULE);
    } else if (c->count > 0 && tn_cursor_is(c, last, "allow")) {
        tn_complete_codes(c);
    } else {
        bool body = false;
        for (size_t i = c->item; i < c->count; i++)
            body |= tn_cursor_is(c, i, "=");
        if ((tn_cursor_is(c, c->item, "rule") || tn_cursor_is(c, c->item, "measure")) && body)
            complete_expression(c);
        else if (c->item + 1 < c->count)
            tn_offer_words(c, head);
        tn_offer_words(c, items);
    }
}

static void complete_files(tn_lsp_cursor *c, const tn_workspace *workspace)
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
                tn_offer(c, name, KIND_FILE, "standard library", "1");
            free(name);
        }
        if (folder)
            closedir(folder);
    }
}

/* ---- where the cursor is */

/* Takes the tokens up to the cursor. False inside a comment; *quoted: inside a text in quotes. */
static bool find_tokens(tn_lsp_cursor *c, size_t offset, bool *quoted)
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

static void find_context(tn_lsp_cursor *c)
{
    static const char *const items[] = {"use", "schema", "rule", "measure", "let", "library", "form", "test", NULL};
    static const char *const clauses[] = {"trays",  "total", "require", "prune", "allow",  "match",
                                          "reject", "keep",  "drop",    "zone",  "forbid", NULL};
    static const char *const of_form[] = {"storey", "spine",    "section", "function", "opening", "flight",
                                          "face",   "material", "allow",   "forbid",   "tile",    NULL};
    c->item = c->clause = c->count;
    for (size_t i = 0; i < c->count; i++) {
        if (c->tokens[i].kind == TN_TOKEN_WORD && tn_cursor_is_any(c, i, items)) {
            c->item = i;
            c->clause = c->count;
            c->depth = 0;
            c->in_braces = false;
            c->braces = 0;
        } else if (tn_cursor_is(c, i, "{")) {
            c->in_braces = true;
            c->braces++;
        } else if (tn_cursor_is(c, i, "}") && c->braces > 1) {
            c->braces--;
            c->clause = c->count;
            c->depth = 0;
        } else if (tn_cursor_is(c, i, "}")) {
            c->braces = 0;
            c->in_braces = false;
            c->item = c->clause = c->count;
            c->depth = 0;
        } else if ((tn_cursor_is(c, i, "(") || tn_cursor_is(c, i, "[")) && c->depth < DEPTH_MAX) {
            c->brackets[c->depth++] = i;
        } else if ((tn_cursor_is(c, i, ")") || tn_cursor_is(c, i, "]")) && c->depth > 0) {
            c->depth--;
        } else if (c->in_braces && c->tokens[i].kind == TN_TOKEN_WORD &&
                   tn_cursor_is_any(c, i, tn_cursor_is(c, c->item, "form") ? of_form : clauses)) {
            c->clause = i;
            c->depth = 0;
        }
    }
}

static void complete(tn_lsp_cursor *c)
{
    size_t bracket = c->depth ? c->brackets[c->depth - 1] : 0;
    size_t outer = c->depth;
    while (outer > 0 && !(c->brackets[outer - 1] > 0 && tn_cursor_is(c, c->brackets[outer - 1] - 1, "tray")))
        outer--;
    bool of_room = c->depth && bracket > 0 && tn_cursor_is(c, bracket - 1, "room");
    if (c->depth && tn_cursor_is(c, bracket, "["))
        complete_tray(c, true);
    else if (of_room || (c->depth && bracket > 0 && tn_cursor_is(c, bracket - 1, "cell")))
        tn_complete_cell(c, bracket, of_room);
    else if (c->depth && bracket > 0 && tn_cursor_is(c, bracket - 1, "section"))
        tn_complete_section(c, bracket);
    else if (outer > 0)
        complete_tray(c, false);
    else if (c->depth && !tn_cursor_is(c, c->item, "schema"))
        complete_in_call(c, bracket);
    else if (c->in_braces && tn_cursor_is(c, c->item, "library"))
        complete_library(c);
    else if (c->in_braces && tn_cursor_is(c, c->item, "schema"))
        complete_schema(c);
    else if (c->in_braces && tn_cursor_is(c, c->item, "form"))
        tn_complete_form(c);
    else if (c->in_braces && tn_cursor_is(c, c->item, "test"))
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
    tn_lsp_cursor *c = calloc(1, sizeof *c);
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
        else if (c->count > 0 && tn_cursor_is(c, c->count - 1, "use"))
            complete_files(c, workspace);
    }
    json_t *list = without_repeats(c->list);
    free(c);
    return list;
}
