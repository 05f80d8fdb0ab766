/* Completion: from the tokens before the cursor, which say where it is also in a text that is not finished. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "driver/open/stdlib_texts.h"
#include "lsp/complete_parts.h"

bool tn_cursor_is(const tn_lsp_cursor *c, size_t i, const char *text)
{
    if (i >= c->count)
        return false;
    tn_span span = c->tokens[i].span;
    return strlen(text) == span.end - span.begin && strncasecmp(c->text + span.begin, text, strlen(text)) == 0;
}

bool tn_cursor_is_word(const tn_lsp_cursor *c, size_t i, uint64_t places, uint32_t uses)
{
    if (i >= c->count || c->tokens[i].kind != TN_TOKEN_WORD)
        return false;
    tn_span span = c->tokens[i].span;
    return tn_vocabulary_find(&tn_plan_words, c->text + span.begin, span.end - span.begin, places, uses) != NULL;
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

void tn_offer_words(tn_lsp_cursor *c, uint64_t places)
{
    c->places |= places;
    for (size_t i = 0; i < c->words->count; i++) {
        const tn_vocabulary_word *word = &c->words->words[i];
        if ((word->places & places) && word->use != TN_AS_SPELLING)
            tn_offer(c, word->text, KIND_KEYWORD, word->sentence, "2");
    }
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
    const tn_symbol *schema = schema_here(c), *field = schema ? tn_cursor_field(c, schema) : NULL;
    for (const tn_symbol *s = schema; s; s = s->schema)
        tn_offer_declared(c, s, field);
    tn_offer_words(c, literal ? TN_AT(PLAN) : TN_AT(TRAY));
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

/* The param of words that the two tokens before the cursor compare or give: `side =`, `side !=`. */
static const tn_ast_rule *compared_param(const tn_lsp_cursor *c)
{
    if (c->count < 2 || !(tn_cursor_is(c, c->count - 1, "=") || tn_cursor_is(c, c->count - 1, "!=")))
        return NULL;
    char *name = tn_cursor_word(c, c->count - 2);
    const tn_symbol *symbol = name ? tn_names_get(&c->analysis->index.names, name) : NULL;
    free(name);
    return symbol && symbol->kind == TN_SYMBOL_PARAM ? (const tn_ast_rule *)symbol->ast : NULL;
}

static void offer_param_words(tn_lsp_cursor *c)
{
    const tn_ast_rule *param = compared_param(c);
    if (!param)
        return;
    for (TN_EACH(const tn_ast_word, word, param->words))
        tn_offer(c, word->text, KIND_VALUE, param->name->text, "0");
}

static void complete_expression(tn_lsp_cursor *c)
{
    offer_param_words(c);
    offer_symbols(c, TN_SYMBOL_RULE, KIND_FUNCTION);
    offer_symbols(c, TN_SYMBOL_MEASURE, KIND_VALUE);
    offer_symbols(c, TN_SYMBOL_PARAM, KIND_VALUE);
    tn_offer_words(c, TN_AT(RULE));
}

/* Does the word or the sign stand behind this bracket, in no further one? */
static bool stands_behind(const tn_lsp_cursor *c, size_t bracket, const char *text)
{
    for (size_t i = bracket + 1, depth = 0; i < c->count; i++) {
        depth += tn_cursor_is(c, i, "(");
        depth -= depth > 0 && tn_cursor_is(c, i, ")");
        if (depth == 0 && tn_cursor_is(c, i, text))
            return true;
    }
    return false;
}

/* Does the word stand a few before the cursor, in the same item? */
static bool stands_after(const tn_lsp_cursor *c, const char *word)
{
    enum { FEW = 8 };
    for (size_t i = c->count, seen = 0; i-- > c->item && seen < FEW; seen++)
        if (tn_cursor_is(c, i, word))
            return true;
    return false;
}

/* Is the cursor in a number of one tray, of `sum(`, `max(` or `min(`: in its parenthesis, or in further ones inside? */
static bool in_tally(const tn_lsp_cursor *c)
{
    for (size_t i = c->depth; i-- > 0;) {
        if (tn_cursor_is(c, c->brackets[i] - 1, "sum") || tn_cursor_is(c, c->brackets[i] - 1, "max") ||
            tn_cursor_is(c, c->brackets[i] - 1, "min"))
            return true;
        if (tn_cursor_is_word(c, c->brackets[i] - 1, TN_AT(RULE), TN_AS_KEYWORDS))
            return false;
    }
    return false;
}

/* Of `max(gap from a to b by FIELD)`. */
static void complete_gap(tn_lsp_cursor *c)
{
    tn_offer_words(c, TN_AT(DISTANCE));
    if (c->count > 0 && tn_cursor_is(c, c->count - 1, "by"))
        offer_fields(c, "0");
    else
        complete_expression(c);
}

static void complete_in_call(tn_lsp_cursor *c, size_t bracket)
{
    bool counted = tn_cursor_is(c, bracket - 1, "quantity") || tn_cursor_is(c, bracket - 1, "occurrences") ||
                   tn_cursor_is(c, bracket - 1, "sum");
    if (counted && stands_behind(c, bracket, ",")) {
        tn_offer_words(c, TN_AT(CONDITION));
        offer_symbols(c, TN_SYMBOL_PARAM, KIND_VALUE);
        return;
    }
    if (stands_behind(c, bracket, "gap")) {
        complete_gap(c);
        return;
    }
    if (in_tally(c) && !stands_behind(c, bracket, "of")) {
        tn_offer_words(c, TN_AT(TALLY));
        offer_fields(c, "1");
        return;
    }
    if (tn_cursor_is(c, bracket - 1, "distance"))
        tn_offer_words(c, TN_AT(DISTANCE));
    if (tn_cursor_is(c, bracket - 1, "touch") || tn_cursor_is(c, bracket - 1, "apart"))
        tn_offer_words(c, TN_AT(MEETING));
    complete_expression(c);
}

static void complete_clause_names(tn_lsp_cursor *c)
{
    offer_symbols(c, TN_SYMBOL_CLAUSE, KIND_VALUE);
    offer_symbols(c, TN_SYMBOL_RULE, KIND_FUNCTION);
    offer_symbols(c, TN_SYMBOL_MEASURE, KIND_VALUE);
    tn_offer_words(c, TN_AT(REASON));
}

static void complete_library(tn_lsp_cursor *c)
{
    tn_offer_words(c, TN_AT(CLAUSE));
    if (tn_cursor_is(c, c->clause, "require") || tn_cursor_is(c, c->clause, "generate") || tn_cursor_is(c, c->clause, "prune") ||
        tn_cursor_is(c, c->clause, "prefer")) {
        tn_offer_words(c, TN_AT(CLAUSE_END));
        complete_expression(c);
    } else if (tn_cursor_is(c, c->clause, "weight")) {
        complete_expression(c);
    } else if (tn_cursor_is(c, c->clause, "allow")) {
        tn_complete_codes(c);
    } else if (tn_cursor_is(c, c->clause, "total") && c->clause + 1 == c->count) {
        offer_fields(c, "0");
    }
}

static void complete_schema(tn_lsp_cursor *c)
{
    bool role = c->count > 0 && tn_cursor_is(c, c->count - 1, "role");
    bool limit = tn_cursor_is(c, c->clause, "only") || tn_cursor_is(c, c->clause, "forbid");
    tn_offer_words(c, role ? TN_AT(ROLE) : TN_AT(SCHEMA) | TN_AT(FIELD) | (limit ? TN_AT(LIMIT) : 0));
}

static void complete_test(tn_lsp_cursor *c)
{
    char *subject = c->item + 1 < c->count ? tn_cursor_word(c, c->item + 1) : NULL;
    const tn_symbol *symbol = subject ? tn_names_get(&c->analysis->index.names, subject) : NULL;
    free(subject);
    bool library = symbol && symbol->kind == TN_SYMBOL_LIBRARY, by = false;
    for (size_t i = c->clause; i < c->count; i++)
        by |= tn_cursor_is(c, i, "by");
    if (by)
        complete_clause_names(c);
    tn_offer_words(c, library                                       ? TN_AT(CASE_OF_LIBRARY) | TN_AT(CASE_END)
                      : symbol && symbol->kind == TN_SYMBOL_MEASURE ? TN_AT(CASE_OF_MEASURE)
                                                                    : TN_AT(CASE_OF_RULE));
}

/* In the head of a test, behind `with`: params, and the words of the one that is given a value. */
static bool complete_with(tn_lsp_cursor *c)
{
    bool with = false;
    for (size_t i = c->item; i < c->count && tn_cursor_is(c, c->item, "test"); i++)
        with |= tn_cursor_is(c, i, "with") && c->tokens[i].kind == TN_TOKEN_WORD;
    if (!with)
        return false;
    if (tn_cursor_is(c, c->count - 1, "with") || tn_cursor_is(c, c->count - 1, ","))
        offer_symbols(c, TN_SYMBOL_PARAM, KIND_VALUE);
    else
        offer_param_words(c);
    tn_offer_words(c, TN_AT(HEAD));
    return true;
}

static void complete_top(tn_lsp_cursor *c)
{
    size_t last = c->count - 1;
    if (c->count > 0 && complete_with(c))
        return;
    if (c->count > 0 && tn_cursor_is(c, last, "using")) {
        offer_symbols(c, TN_SYMBOL_SCHEMA, KIND_STRUCT);
    } else if (c->count > 0 && tn_cursor_is(c, last, "in") && tn_cursor_is(c, c->item, "library")) {
        offer_symbols(c, TN_SYMBOL_FORM, KIND_STRUCT);
    } else if (c->count > 0 && tn_cursor_is(c, last, "of") && tn_cursor_is(c, c->item, "form")) {
        offer_symbols(c, TN_SYMBOL_SCHEMA, KIND_STRUCT);
    } else if (c->count > 0 && tn_cursor_is(c, last, "from") && !stands_after(c, "least")) {
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
            tn_offer_words(c, TN_AT(HEAD));
        tn_offer_words(c, TN_AT(ITEM));
    }
}

/* By its name, without the extension, if it is of the text's own notation. */
static void offer_library_file(tn_lsp_cursor *c, const char *file)
{
    const char *extension = c->analysis->compilation.notation->extension;
    size_t size = strlen(file), tail = strlen(extension);
    if (size <= tail || strcmp(file + size - tail, extension) != 0)
        return;
    char *name = strndup(file, size - tail);
    if (name)
        tn_offer(c, name, KIND_FILE, "standard library", "1");
    free(name);
}

static void complete_files(tn_lsp_cursor *c, const tn_workspace *workspace)
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

/* Does the token start a line of what the braces hold? `section(` is a part of one. */
static bool starts_line(const tn_lsp_cursor *c, size_t i)
{
    if (tn_cursor_is(c, c->item, "form"))
        return tn_cursor_is_word(c, i, TN_AT(FORM), TN_AS_KEYWORDS) &&
               !(tn_cursor_is_word(c, i, TN_AT(SECTIONS), TN_AS_CALL) && tn_cursor_is(c, i + 1, "("));
    return tn_cursor_is_word(c, i,
                             tn_cursor_is(c, c->item, "test")     ? TN_AT_CASES
                             : tn_cursor_is(c, c->item, "schema") ? TN_AT(SCHEMA)
                                                                  : TN_AT(CLAUSE),
                             TN_AS_KEYWORDS);
}

static void find_context(tn_lsp_cursor *c)
{
    c->item = c->clause = c->count;
    for (size_t i = 0; i < c->count; i++) {
        if (tn_cursor_is_word(c, i, TN_AT(ITEM), TN_AS_KEYWORDS)) {
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
        } else if (c->in_braces && starts_line(c, i)) {
            c->clause = i;
            c->depth = 0;
        }
    }
}

static void complete_plan(tn_lsp_cursor *c)
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
    else if (c->depth && c->in_braces && tn_cursor_is(c, c->item, "form"))
        tn_complete_form(c);
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

static void complete(tn_lsp_cursor *c)
{
    if (c->words->places) {
        tn_offer_words(c, tn_vocabulary_places(c->words, c->text, c->tokens, c->count));
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

static tn_lsp_cursor *cursor_new(const tn_document *document, const tn_file_analysis *analysis)
{
    tn_lsp_cursor *c = calloc(1, sizeof *c);
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
    tn_lsp_cursor *c = cursor_new(document, analysis);
    bool quoted;
    if (!c)
        return NULL;
    if (c->words && find_tokens(c, offset, &quoted)) {
        if (!quoted)
            complete(c);
        else if (c->count > 0 && tn_cursor_is(c, c->count - 1, "use"))
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
    tn_lsp_cursor *c = token ? cursor_new(document, analysis) : NULL;
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
