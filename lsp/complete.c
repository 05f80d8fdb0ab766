/* Completion: from the tokens before the cursor, which say where it is also in a text that is not finished. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/plan/check/check.h"
#include "compiler/plan/syntax/form_ast.h"
#include "compiler/plan/syntax/words.h"
#include "driver/open/stdlib.h"
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
typedef struct lsp_cursor {
    const tn_file_analysis *analysis;
    const char *text;
    const tn_vocabulary *words; /* of the notation */
    const tn_token *tokens;
    size_t count; /* tokens before the cursor; not the word that it is in or just behind */
    size_t item;  /* the word that starts the item; `count` where there is none */
    bool in_braces;
    size_t braces;              /* how many are open */
    size_t clause;              /* the last word at the level of the braces that starts a clause, field or case */
    size_t brackets[DEPTH_MAX]; /* open ones */
    size_t depth;
    uint64_t places; /* where a word of the language may stand here */
    json_t *list;
} lsp_cursor;

static void complete_cell(lsp_cursor *c, size_t bracket, bool room);
static void complete_option(lsp_cursor *c, size_t bracket);
static void complete_form(lsp_cursor *c);

/* Is token i this word? */
static bool cursor_is(const lsp_cursor *c, size_t i, const char *text)
{
    if (i >= c->count)
        return false;
    tn_span span = c->tokens[i].span;
    return strlen(text) == span.end - span.begin && strncasecmp(c->text + span.begin, text, strlen(text)) == 0;
}

/* Is it a word of the language that stands in one of these places, and is one of these uses there? */
static bool cursor_is_word(const lsp_cursor *c, size_t i, uint64_t places, uint32_t uses)
{
    if (i >= c->count || c->tokens[i].kind != TN_TOKEN_WORD)
        return false;
    tn_span span = c->tokens[i].span;
    return tn_vocabulary_find(&tn_plan_words, c->text + span.begin, span.end - span.begin, places, uses) != NULL;
}

/* Is it `option`, which was `section`? */
static bool says_option(const lsp_cursor *c, size_t i)
{
    return cursor_is(c, i, "option") || cursor_is(c, i, "section");
}

static char *cursor_word(const lsp_cursor *c, size_t i)
{
    tn_span span = c->tokens[i].span;
    return strndup(c->text + span.begin, span.end - span.begin);
}

/* Offers one more; those of an earlier group come first. */
static void offer(lsp_cursor *c, const char *label, int kind, const char *detail, const char *group)
{
    json_t *item = json_pack("{s:s,s:i}", "label", label, "kind", kind);
    if (detail)
        json_object_set_new(item, "detail", json_string(detail));
    json_object_set_new(item, "sortText", json_sprintf("%s%s", group, label));
    json_array_append_new(c->list, item);
}

static void offer_words(lsp_cursor *c, uint64_t places)
{
    c->places |= places;
    for (size_t i = 0; i < c->words->count; i++) {
        const tn_vocabulary_word *word = &c->words->words[i];
        if ((word->places & places) && word->use != TN_AS_SPELLING)
            offer(c, word->text, KIND_KEYWORD, word->sentence, "2");
    }
}

static void offer_symbols(lsp_cursor *c, tn_symbol_kind kind, int shown)
{
    for (const tn_symbol *s = c->analysis->index.first; s; s = s->next)
        if (s->kind == kind)
            offer(c, s->name, shown, s->doc, "1");
}

/* ---- inside specifiers and plans */

static const tn_symbol *schema_here(const lsp_cursor *c)
{
    const tn_index *index = &c->analysis->index;
    for (size_t i = c->item; i + 1 < c->count && i < c->item + 8; i++) {
        if (!cursor_is(c, i, "using"))
            continue;
        char *name = cursor_word(c, i + 1);
        const tn_symbol *schema = name ? tn_names_get(&index->schemas, name) : NULL;
        free(name);
        if (schema)
            return schema;
    }
    size_t named = cursor_is(c, c->item, "schema") ? 0 : 1;
    char *owner = c->item + 1 < c->count ? cursor_word(c, c->item + 1) : NULL;
    const tn_symbol *schema = !owner  ? NULL
                              : named ? tn_index_schema(index, owner)
                                      : tn_names_get(&index->schemas, owner);
    free(owner);
    return schema;
}

/* The field that the words before the cursor, back to a comma or bracket, are about; NULL where none is named. */
static const tn_symbol *cursor_field(const lsp_cursor *c, const tn_symbol *schema)
{
    const tn_symbol *field = NULL;
    size_t start = c->depth ? c->brackets[c->depth - 1] + 1 : c->count;
    for (size_t i = start; i < c->count; i++) {
        if (cursor_is(c, i, ",") || cursor_is(c, i, "|"))
            field = NULL;
        if (c->tokens[i].kind != TN_TOKEN_NAME)
            continue;
        char *name = cursor_word(c, i);
        const tn_symbol *named = name ? tn_index_field(schema, name) : NULL;
        field = named ? named : field;
        free(name);
    }
    return field;
}

static void offer_values(lsp_cursor *c, const tn_symbol *field, const char *group)
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

/* What a measure of plans says: as far as the plans are counted. */
static void offer_said(lsp_cursor *c, const tn_symbol *schema, const tn_symbol *field, const char *group)
{
    const tn_checked *checked = c->analysis->compilation.checked;
    for (size_t i = 0; checked && i < checked->schema_count; i++) {
        const tn_checked_schema *s = checked->schemas[i];
        uint32_t f = strcmp(s->name, schema->name) == 0 ? tn_field_find(s, field->name) : TN_NONE;
        for (uint32_t v = 0; f != TN_NONE && v < s->fields[f].value_count; v++)
            offer(c, s->fields[f].values[v].spelling, KIND_VALUE, field->name, group);
    }
}

/* The fields that a schema declares, those that add values to an older one's included. */
static void offer_declared(lsp_cursor *c, const tn_symbol *schema, const tn_symbol *field)
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
        if (ast->form == TN_FORM_MEASURE)
            offer_said(c, schema, s, named ? "0" : "1");
    }
}

static void complete_tray(lsp_cursor *c, bool literal)
{
    const tn_symbol *schema = schema_here(c), *field = schema ? cursor_field(c, schema) : NULL;
    for (const tn_symbol *s = schema; s; s = s->schema)
        offer_declared(c, s, field);
    offer_words(c, literal ? TN_AT(PLAN) : TN_AT(TRAY));
}

/* ---- codes of warnings */

static void complete_codes(lsp_cursor *c)
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

/* ---- elsewhere */

static void offer_fields(lsp_cursor *c, const char *group)
{
    for (const tn_symbol *schema = schema_here(c); schema; schema = schema->schema)
        for (const tn_symbol *s = schema->next; s; s = s->next)
            if (s->kind == TN_SYMBOL_FIELD && s->parent == schema && !((const tn_ast_field *)s->ast)->extends)
                offer(c, s->name, KIND_FIELD, s->doc, group);
}

/* The param of words that the two tokens before the cursor compare or give: `side =`, `side !=`. */
static const tn_ast_rule *compared_param(const lsp_cursor *c)
{
    if (c->count < 2 || !(cursor_is(c, c->count - 1, "=") || cursor_is(c, c->count - 1, "!=")))
        return NULL;
    char *name = cursor_word(c, c->count - 2);
    const tn_symbol *symbol = name ? tn_names_get(&c->analysis->index.names, name) : NULL;
    free(name);
    return symbol && symbol->kind == TN_SYMBOL_PARAM ? (const tn_ast_rule *)symbol->ast : NULL;
}

static void offer_param_words(lsp_cursor *c)
{
    const tn_ast_rule *param = compared_param(c);
    if (!param)
        return;
    for (TN_EACH(const tn_ast_word, word, param->words))
        offer(c, word->text, KIND_VALUE, param->name->text, "0");
}

static void complete_expression(lsp_cursor *c)
{
    offer_param_words(c);
    offer_symbols(c, TN_SYMBOL_RULE, KIND_FUNCTION);
    offer_symbols(c, TN_SYMBOL_MEASURE, KIND_VALUE);
    offer_symbols(c, TN_SYMBOL_PARAM, KIND_VALUE);
    offer_words(c, TN_AT(RULE));
}

/* Does the word or the sign stand behind this bracket, in no further one? */
static bool stands_behind(const lsp_cursor *c, size_t bracket, const char *text)
{
    for (size_t i = bracket + 1, depth = 0; i < c->count; i++) {
        depth += cursor_is(c, i, "(");
        depth -= depth > 0 && cursor_is(c, i, ")");
        if (depth == 0 && cursor_is(c, i, text))
            return true;
    }
    return false;
}

/* Does the word stand a few before the cursor, in the same item? */
static bool stands_after(const lsp_cursor *c, const char *word)
{
    enum { FEW = 8 };
    for (size_t i = c->count, seen = 0; i-- > c->item && seen < FEW; seen++)
        if (cursor_is(c, i, word))
            return true;
    return false;
}

/* Is the cursor in a number of one tray, of `sum(`, `max(` or `min(`: in its parenthesis, or in further ones inside? */
static bool in_tally(const lsp_cursor *c)
{
    for (size_t i = c->depth; i-- > 0;) {
        if (cursor_is(c, c->brackets[i] - 1, "sum") || cursor_is(c, c->brackets[i] - 1, "max") ||
            cursor_is(c, c->brackets[i] - 1, "min"))
            return true;
        if (cursor_is_word(c, c->brackets[i] - 1, TN_AT(RULE), TN_AS_KEYWORDS))
            return false;
    }
    return false;
}

/* Of `max(gap from a to b by FIELD)`. */
static void complete_gap(lsp_cursor *c)
{
    offer_words(c, TN_AT(DISTANCE));
    if (c->count > 0 && cursor_is(c, c->count - 1, "by"))
        offer_fields(c, "0");
    else
        complete_expression(c);
}

static void complete_in_call(lsp_cursor *c, size_t bracket)
{
    bool counted = cursor_is(c, bracket - 1, "quantity") || cursor_is(c, bracket - 1, "occurrences") ||
                   cursor_is(c, bracket - 1, "sum");
    if (counted && stands_behind(c, bracket, ",")) {
        offer_words(c, TN_AT(CONDITION));
        offer_symbols(c, TN_SYMBOL_PARAM, KIND_VALUE);
        return;
    }
    if (stands_behind(c, bracket, "gap")) {
        complete_gap(c);
        return;
    }
    if (in_tally(c) && !stands_behind(c, bracket, "of")) {
        offer_words(c, TN_AT(TALLY));
        offer_fields(c, "1");
        return;
    }
    if (cursor_is(c, bracket - 1, "distance"))
        offer_words(c, TN_AT(DISTANCE));
    if (cursor_is(c, bracket - 1, "touch") || cursor_is(c, bracket - 1, "apart") || cursor_is(c, bracket - 1, "walk"))
        offer_words(c, TN_AT(MEETING));
    complete_expression(c);
}

static void complete_clause_names(lsp_cursor *c)
{
    offer_symbols(c, TN_SYMBOL_CLAUSE, KIND_VALUE);
    offer_symbols(c, TN_SYMBOL_RULE, KIND_FUNCTION);
    offer_symbols(c, TN_SYMBOL_MEASURE, KIND_VALUE);
    offer_words(c, TN_AT(REASON));
}

static void complete_library(lsp_cursor *c)
{
    offer_words(c, TN_AT(CLAUSE));
    if (cursor_is(c, c->clause, "require") || cursor_is(c, c->clause, "generate") || cursor_is(c, c->clause, "prune") ||
        cursor_is(c, c->clause, "prefer")) {
        offer_words(c, TN_AT(CLAUSE_END));
        complete_expression(c);
    } else if (cursor_is(c, c->clause, "weight")) {
        complete_expression(c);
    } else if (cursor_is(c, c->clause, "allow")) {
        complete_codes(c);
    } else if (cursor_is(c, c->clause, "total") && c->clause + 1 == c->count) {
        offer_fields(c, "0");
    }
}

static void complete_schema(lsp_cursor *c)
{
    bool role = c->count > 0 && cursor_is(c, c->count - 1, "role");
    bool said = c->count > 1 && cursor_is(c, c->count - 2, "=");
    if (said && cursor_is(c, c->count - 1, "measure"))
        offer_symbols(c, TN_SYMBOL_MEASURE, KIND_VALUE);
    if (said && cursor_is(c, c->count - 1, "rule"))
        offer_symbols(c, TN_SYMBOL_RULE, KIND_FUNCTION);
    bool limit = cursor_is(c, c->clause, "only") || cursor_is(c, c->clause, "forbid");
    offer_words(c, role ? TN_AT(ROLE) : TN_AT(SCHEMA) | TN_AT(FIELD) | (limit ? TN_AT(LIMIT) : 0));
}

static void complete_test(lsp_cursor *c)
{
    char *subject = c->item + 1 < c->count ? cursor_word(c, c->item + 1) : NULL;
    const tn_symbol *symbol = subject ? tn_names_get(&c->analysis->index.names, subject) : NULL;
    free(subject);
    bool library = symbol && symbol->kind == TN_SYMBOL_LIBRARY, by = false;
    for (size_t i = c->clause; i < c->count; i++)
        by |= cursor_is(c, i, "by");
    if (by)
        complete_clause_names(c);
    offer_words(c, library                                       ? TN_AT(CASE_OF_LIBRARY) | TN_AT(CASE_END)
                   : symbol && symbol->kind == TN_SYMBOL_MEASURE ? TN_AT(CASE_OF_MEASURE)
                                                                 : TN_AT(CASE_OF_RULE));
}

/* In the head of a test, behind `with`: params, and the words of the one that is given a value. */
static bool complete_with(lsp_cursor *c)
{
    bool with = false;
    for (size_t i = c->item; i < c->count && cursor_is(c, c->item, "test"); i++)
        with |= cursor_is(c, i, "with") && c->tokens[i].kind == TN_TOKEN_WORD;
    if (!with)
        return false;
    if (cursor_is(c, c->count - 1, "with") || cursor_is(c, c->count - 1, ","))
        offer_symbols(c, TN_SYMBOL_PARAM, KIND_VALUE);
    else
        offer_param_words(c);
    offer_words(c, TN_AT(HEAD));
    return true;
}

/* `library NAME from ZONED onto`: the schemas that the library's is made from; all, if that is not known. */
static void complete_onto(lsp_cursor *c)
{
    char *name = cursor_word(c, c->count - 2);
    const tn_symbol *library = name ? tn_names_get(&c->analysis->index.names, name) : NULL;
    const tn_symbol *schema = library ? library->schema : NULL;
    free(name);
    if (!schema)
        offer_symbols(c, TN_SYMBOL_SCHEMA, KIND_STRUCT);
    for (schema = schema ? schema->schema : NULL; schema; schema = schema->schema)
        offer(c, schema->name, KIND_STRUCT, schema->doc, "1");
}

static void complete_top(lsp_cursor *c)
{
    size_t last = c->count - 1;
    if (c->count > 0 && complete_with(c))
        return;
    if (c->count > 0 && cursor_is(c, last, "using")) {
        offer_symbols(c, TN_SYMBOL_SCHEMA, KIND_STRUCT);
    } else if (c->count > 1 && cursor_is(c, last, "onto") && cursor_is(c, c->item, "library")) {
        complete_onto(c);
    } else if (c->count > 0 && cursor_is(c, last, "in") && cursor_is(c, c->item, "library")) {
        offer_symbols(c, TN_SYMBOL_FORM, KIND_STRUCT);
    } else if (c->count > 0 && cursor_is(c, last, "of") && cursor_is(c, c->item, "form")) {
        offer_symbols(c, TN_SYMBOL_SCHEMA, KIND_STRUCT);
    } else if (c->count > 0 && cursor_is(c, last, "of") && cursor_is(c, c->item, "schema")) {
        offer_symbols(c, TN_SYMBOL_LIBRARY, KIND_MODULE);
    } else if (c->count > 0 && cursor_is(c, last, "from") && !stands_after(c, "least")) {
        offer_symbols(c, TN_SYMBOL_LIBRARY, KIND_MODULE);
    } else if (c->count > 0 && cursor_is(c, last, "test") && last == c->item) {
        offer_symbols(c, TN_SYMBOL_RULE, KIND_FUNCTION);
        offer_symbols(c, TN_SYMBOL_MEASURE, KIND_VALUE);
        offer_symbols(c, TN_SYMBOL_LIBRARY, KIND_MODULE);
    } else if (c->count > 0 && cursor_is(c, last, "allow")) {
        complete_codes(c);
    } else {
        bool body = false;
        for (size_t i = c->item; i < c->count; i++)
            body |= cursor_is(c, i, "=");
        if ((cursor_is(c, c->item, "rule") || cursor_is(c, c->item, "measure")) && body)
            complete_expression(c);
        else if (c->item + 1 < c->count)
            offer_words(c, TN_AT(HEAD));
        offer_words(c, TN_AT(ITEM));
    }
}

/* By its name, without the extension, if it is of the text's own notation. */
static void offer_library_file(lsp_cursor *c, const char *file)
{
    const char *extension = c->analysis->compilation.notation->extension;
    size_t size = strlen(file), tail = strlen(extension);
    if (size <= tail || strcmp(file + size - tail, extension) != 0)
        return;
    char *name = strndup(file, size - tail);
    if (name)
        offer(c, name, KIND_FILE, "standard library", "1");
    free(name);
}

static void complete_files(lsp_cursor *c, const tn_workspace *workspace)
{
    for (size_t i = 0; workspace->served && i < tn_stdlib_text_count; i++)
        offer_library_file(c, tn_stdlib_texts[i].name);
    for (size_t i = 0; i < workspace->stdlib.count; i++) {
        DIR *folder = opendir(workspace->stdlib.dirs[i]);
        for (struct dirent *entry; folder && (entry = readdir(folder));)
            offer_library_file(c, entry->d_name);
        if (folder)
            closedir(folder);
    }
}

/* ---- where the cursor is */

/* Takes the tokens up to the cursor. False inside a comment; *quoted: inside a text in quotes. */
static bool find_tokens(lsp_cursor *c, size_t offset, bool *quoted)
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

/* Does the token start a line of what the braces hold? `option(` is a part of one. */
static bool starts_line(const lsp_cursor *c, size_t i)
{
    if (cursor_is(c, c->item, "form"))
        return cursor_is_word(c, i, TN_AT(FORM), TN_AS_KEYWORDS) &&
               !(cursor_is_word(c, i, TN_AT(OPTIONS), TN_AS_CALL | TN_AS_SPELLING) && cursor_is(c, i + 1, "("));
    return cursor_is_word(c, i,
                          cursor_is(c, c->item, "test")     ? TN_AT_CASES
                          : cursor_is(c, c->item, "schema") ? TN_AT(SCHEMA)
                                                            : TN_AT(CLAUSE),
                          TN_AS_KEYWORDS);
}

static void find_context(lsp_cursor *c)
{
    c->item = c->clause = c->count;
    for (size_t i = 0; i < c->count; i++) {
        if (cursor_is_word(c, i, TN_AT(ITEM), TN_AS_KEYWORDS) && !(i > 0 && cursor_is(c, i - 1, "="))) {
            c->item = i;
            c->clause = c->count;
            c->depth = 0;
            c->in_braces = false;
            c->braces = 0;
        } else if (cursor_is(c, i, "{")) {
            c->in_braces = true;
            c->braces++;
        } else if (cursor_is(c, i, "}") && c->braces > 1) {
            c->braces--;
            c->clause = c->count;
            c->depth = 0;
        } else if (cursor_is(c, i, "}")) {
            c->braces = 0;
            c->in_braces = false;
            c->item = c->clause = c->count;
            c->depth = 0;
        } else if ((cursor_is(c, i, "(") || cursor_is(c, i, "[")) && c->depth < DEPTH_MAX) {
            c->brackets[c->depth++] = i;
        } else if ((cursor_is(c, i, ")") || cursor_is(c, i, "]")) && c->depth > 0) {
            c->depth--;
        } else if (c->in_braces && starts_line(c, i)) {
            c->clause = i;
            c->depth = 0;
        }
    }
}

static void complete_plan(lsp_cursor *c)
{
    size_t bracket = c->depth ? c->brackets[c->depth - 1] : 0;
    size_t outer = c->depth;
    while (outer > 0 && !(c->brackets[outer - 1] > 0 && cursor_is(c, c->brackets[outer - 1] - 1, "tray")))
        outer--;
    bool of_room = c->depth && bracket > 0 && cursor_is(c, bracket - 1, "room");
    if (c->depth && cursor_is(c, bracket, "["))
        complete_tray(c, true);
    else if (of_room || (c->depth && bracket > 0 && cursor_is(c, bracket - 1, "cell")))
        complete_cell(c, bracket, of_room);
    else if (c->depth && bracket > 0 && says_option(c, bracket - 1))
        complete_option(c, bracket);
    else if (outer > 0)
        complete_tray(c, false);
    else if (c->depth && c->in_braces && cursor_is(c, c->item, "form"))
        complete_form(c);
    else if (c->depth && !cursor_is(c, c->item, "schema"))
        complete_in_call(c, bracket);
    else if (c->in_braces && cursor_is(c, c->item, "library"))
        complete_library(c);
    else if (c->in_braces && cursor_is(c, c->item, "schema"))
        complete_schema(c);
    else if (c->in_braces && cursor_is(c, c->item, "form"))
        complete_form(c);
    else if (c->in_braces && cursor_is(c, c->item, "test"))
        complete_test(c);
    else
        complete_top(c);
}

static void complete(lsp_cursor *c)
{
    if (c->words->places) {
        offer_words(c, tn_vocabulary_places(c->words, c->text, c->tokens, c->count));
        return;
    }
    find_context(c);
    complete_plan(c);
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

static lsp_cursor *cursor_new(const tn_document *document, const tn_file_analysis *analysis)
{
    lsp_cursor *c = calloc(1, sizeof *c);
    if (!c)
        return NULL;
    c->analysis = analysis;
    c->words = analysis->compilation.notation->front->words;
    c->text = document->text;
    c->tokens = analysis->tokens.items;
    c->list = json_array();
    return c;
}

json_t *tn_lsp_completion(tn_workspace *workspace, tn_document *document, tn_file_analysis *analysis, size_t offset)
{
    lsp_cursor *c = cursor_new(document, analysis);
    bool quoted;
    if (!c)
        return NULL;
    if (c->words && find_tokens(c, offset, &quoted)) {
        if (!quoted)
            complete(c);
        else if (c->count > 0 && cursor_is(c, c->count - 1, "use"))
            complete_files(c, workspace);
    }
    json_t *list = without_repeats(c->list);
    free(c);
    return list;
}

/* ---- what words say */

/* The word or name that the cursor is in; NULL where it is in none. */
static const tn_token *token_at(const tn_tokens *tokens, size_t offset)
{
    for (size_t i = 0; i < tokens->count; i++) {
        const tn_token *token = &tokens->items[i];
        if (token->span.begin <= offset && offset <= token->span.end &&
            (token->kind == TN_TOKEN_WORD || token->kind == TN_TOKEN_NAME))
            return token;
    }
    return NULL;
}

/* What could stand where the word does tells which of its rows it is, and whether `(` follows; one that the lexer takes
 * for a name says nothing elsewhere. */
const char *tn_lsp_word(tn_document *document, tn_file_analysis *analysis, size_t offset, tn_span *span)
{
    bool words = analysis->compilation.notation->front->words != NULL;
    const tn_token *token = words ? token_at(&analysis->tokens, offset) : NULL;
    lsp_cursor *c = token ? cursor_new(document, analysis) : NULL;
    bool quoted;
    if (!c)
        return NULL;
    if (find_tokens(c, token->span.begin, &quoted))
        complete(c);
    *span = token->span;
    const char *text = document->text + span->begin;
    size_t size = span->end - span->begin;
    uint32_t uses = token->kind == TN_TOKEN_WORD ? TN_AS_KEYWORDS : TN_AS_NAMES;
    uint32_t calls = text[size] == '(' ? TN_AS_CALL | TN_AS_SPELLING : ~(uint32_t)(TN_AS_CALL | TN_AS_SPELLING);
    const tn_vocabulary_word *word = tn_vocabulary_find(c->words, text, size, c->places, uses & calls);
    if (!word)
        word = tn_vocabulary_find(c->words, text, size, c->places, uses);
    if (!word && token->kind == TN_TOKEN_WORD)
        word = tn_vocabulary_find(c->words, text, size, TN_ANYWHERE, uses);
    json_decref(c->list);
    free(c);
    return word ? word->sentence : NULL;
}

/* ---- in forms, and in what is asked of houses */

/* The form that the item is, or is about; else the last one there is. */
static const tn_symbol *form_here(const lsp_cursor *c)
{
    const tn_index *index = &c->analysis->index;
    char *name = c->item + 1 < c->count ? cursor_word(c, c->item + 1) : NULL;
    const tn_symbol *symbol = !name                           ? NULL
                              : cursor_is(c, c->item, "form") ? tn_names_get(&index->forms, name)
                                                              : tn_names_get(&index->names, name);
    free(name);
    if (symbol && symbol->kind != TN_SYMBOL_FORM)
        symbol = symbol->form;
    return symbol ? symbol : index->last_form;
}

static void offer_parts(lsp_cursor *c, tn_symbol_kind kind, int shown)
{
    const tn_symbol *form = form_here(c);
    for (const tn_symbol *s = form ? form->next : NULL; s && s->parent == form; s = s->next)
        if (s->kind == kind)
            offer(c, s->name, shown, s->doc, "1");
}

/* Is this the `cell(` of a line `function`, `void` or `no` of a form? These lines say where functions and voids may be,
 * so that their cells have none yet (E1607). */
static bool before_functions(const lsp_cursor *c, size_t bracket)
{
    size_t depth = 0;
    for (size_t i = bracket; cursor_is(c, c->item, "form") && i-- > c->item;) {
        if (cursor_is(c, i, ")"))
            depth++;
        else if (cursor_is(c, i, "(") && depth > 0)
            depth--;
        else if (depth == 0 && (cursor_is(c, i, "at") || cursor_is(c, i, "void") || cursor_is(c, i, "no")))
            return true;
        else if (depth == 0 && cursor_is_word(c, i, TN_AT(FORM) | TN_AT(FACE), TN_AS_KEYWORDS))
            return false;
    }
    return false;
}

/* In `cell(` and `room(`, whose bracket is that token. */
static void complete_cell(lsp_cursor *c, size_t bracket, bool room)
{
    const tn_symbol *form = form_here(c), *field = form ? cursor_field(c, form->schema) : NULL;
    offer_parts(c, TN_SYMBOL_STOREY, KIND_VALUE);
    if (!before_functions(c, bracket)) {
        offer_parts(c, TN_SYMBOL_FUNCTION, KIND_FUNCTION);
        offer_words(c, TN_AT(CELL_BUILT));
    }
    for (const tn_symbol *s = form ? form->schema : NULL; s; s = s->schema)
        offer_declared(c, s, field);
    if (room) {
        offer_parts(c, TN_SYMBOL_OPENING, KIND_VALUE);
        offer_words(c, TN_AT(ROOM));
    } else {
        offer_words(c, TN_AT(CELL));
    }
}

/* The values of a choice, by their names. */
static void offer_choices(lsp_cursor *c, const tn_ast_form_clause *choice)
{
    for (TN_EACH(const tn_ast_shape, shape, choice->list))
        if (shape->word && shape->word->text)
            offer(c, shape->word->text, KIND_VALUE, NULL, "1");
}

/* `option(body roof gable)`, or `option(cladding board)`: a choice is one word or two. */
static void complete_choice(lsp_cursor *c, const tn_ast_form_clause *choice, size_t first)
{
    size_t detail = choice->detail != NULL;
    if (!choice->name || !choice->name->text || (detail && !choice->detail->text))
        return;
    if (first == c->count)
        offer(c, choice->name->text, KIND_FIELD, NULL, "1");
    else if (!cursor_is(c, first, choice->name->text))
        return;
    else if (detail && first + 1 == c->count)
        offer(c, choice->detail->text, KIND_FIELD, NULL, "1");
    else if (!detail || cursor_is(c, first + 1, choice->detail->text))
        offer_choices(c, choice);
}

/* In `option(`, whose bracket is that token: the choices of the form, then their values. */
static void complete_option(lsp_cursor *c, size_t bracket)
{
    const tn_symbol *form = form_here(c);
    if (!form)
        return;
    for (TN_EACH(const tn_ast_form_clause, clause, ((const tn_ast_form *)form->ast)->clauses))
        if (clause->part == TN_PART_SECTION)
            complete_choice(c, clause, bracket + 1);
    if (c->count > bracket + 2)
        offer_words(c, TN_AT(OPTION));
}

static void complete_kinds(lsp_cursor *c)
{
    offer_parts(c, TN_SYMBOL_OPENING, KIND_VALUE);
    offer_words(c, TN_AT(KIND));
}

/* In a line that says how thick something is, which may have layers in braces. */
static bool starts_thickness(const lsp_cursor *c)
{
    return cursor_is(c, c->clause, "wall") || cursor_is(c, c->clause, "partition") || cursor_is(c, c->clause, "floor") ||
           cursor_is(c, c->clause, "deck") || cursor_is(c, c->clause, "roof");
}

/* In the braces of a form, outside of parentheses. */
static void complete_form(lsp_cursor *c)
{
    if (starts_thickness(c)) {
        offer_parts(c, TN_SYMBOL_LAYER, KIND_VALUE);
        if (c->braces == 1)
            offer_words(c, TN_AT(WALL));
    } else if (c->braces > 1 || cursor_is(c, c->clause, "tile")) {
        offer_parts(c, TN_SYMBOL_FUNCTION, KIND_FUNCTION);
        complete_kinds(c);
        offer_words(c, TN_AT(TILE) | TN_AT(TILE_LINE));
    } else if (cursor_is(c, c->clause, "face")) {
        complete_kinds(c);
        offer_words(c, TN_AT(FACE) | TN_AT(CELLS));
    } else if (cursor_is(c, c->clause, "material")) {
        offer_parts(c, TN_SYMBOL_OPENING, KIND_VALUE);
        offer_parts(c, TN_SYMBOL_LAYER, KIND_VALUE);
        offer_words(c, TN_AT(MATERIAL) | TN_AT(OPTIONS));
    } else if (cursor_is(c, c->clause, "classification")) {
        offer_parts(c, TN_SYMBOL_OPENING, KIND_VALUE);
        offer_parts(c, TN_SYMBOL_FUNCTION, KIND_FUNCTION);
        offer_words(c, TN_AT(CLASSIFICATION));
    } else if (cursor_is(c, c->clause, "allow")) {
        complete_codes(c);
    } else if (cursor_is(c, c->clause, "opening")) {
        offer_words(c, TN_AT(OPENING));
    } else if (cursor_is(c, c->clause, "way")) {
        offer_parts(c, TN_SYMBOL_FUNCTION, KIND_FUNCTION);
        offer_words(c, TN_AT(WAY));
    } else if (cursor_is(c, c->clause, "flight")) {
        offer_words(c, TN_AT(FLIGHT));
    } else if (cursor_is(c, c->clause, "beam")) {
        offer_words(c, TN_AT(BEAM));
    } else if (says_option(c, c->clause)) {
        offer_words(c, TN_AT(CHOICE));
    } else if (cursor_is(c, c->clause, "forbid")) {
        offer_words(c, TN_AT(OPTIONS));
    } else if (cursor_is(c, c->clause, "function")) {
        offer_words(c, TN_AT(FUNCTION) | TN_AT(CELLS));
    } else if (cursor_is(c, c->clause, "void") || cursor_is(c, c->clause, "no")) {
        offer_words(c, TN_AT(CELLS));
    }
    if (c->braces == 1)
        offer_words(c, TN_AT(FORM));
}
