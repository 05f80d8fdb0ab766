/* settings: the numbers that may be turned in a file. */
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "ask/source/check.h"
#include "compiler/common/lexical.h"
#include "compiler/common/token.h"
#include "compiler/compile.h"
#include "compiler/plan/syntax/program.h"

static char *copy(const char *text, tn_span span)
{
    return strndup(text + span.begin, span.end - span.begin);
}

/* The unit of a number that has one at its end, and no other: "m" of 3.5m, nothing of 5' 6". */
static const char *unit_of(const char *value)
{
    static const char digits[] = "0123456789.,_eE+-";
    size_t number = strspn(value, digits);
    const char *unit = value + number;
    while (*unit == ' ')
        unit++;
    return number && *unit && !strpbrk(unit, "0123456789 ") ? unit : NULL;
}

/* Adds a setting whose value, which becomes its own, stands there. */
static tn_shown_setting *add(tn_sources *sources, tn_found_settings *found, tn_span place, char *value, tn_error *error)
{
    tn_shown_setting *to = TN_ADD(shown_setting, found->settings, error);
    if (!to) {
        free(value);
        return NULL;
    }
    to->value = value;
    const char *unit = value ? unit_of(value) : NULL;
    to->has_unit = unit != NULL;
    to->unit = unit ? strdup(unit) : NULL;
    if (to->value && (!unit || to->unit) && tn_text_place_of(sources, true, place, &to->place))
        return to;
    tn_fail_memory(error);
    return NULL;
}

/* ---- params */

static tn_status add_words(const tn_program_param *from, tn_shown_setting *to, tn_error *error)
{
    to->words.items = calloc(from->word_count, sizeof *to->words.items);
    if (!to->words.items)
        return tn_fail_memory(error);
    to->has_words = true;
    while (to->words.count < from->word_count) {
        to->words.items[to->words.count] = from->words[to->words.count];
        to->words.count++;
    }
    return TN_OK;
}

static tn_status add_param(tn_sources *sources, const tn_program_param *from, tn_found_settings *found, tn_error *error)
{
    tn_shown_setting *to = add(sources, found, from->place, strdup(from->value), error);
    if (!to)
        return TN_MEMORY;
    to->name = strdup(from->name);
    to->has_doc = from->doc != NULL;
    to->doc = from->doc;
    to->has_least = to->has_most = from->least != NULL;
    to->least = from->least;
    to->most = from->most;
    if (!to->name)
        return tn_fail_memory(error);
    return from->word_count ? add_words(from, to, error) : TN_OK;
}

static tn_status add_params(tn_compilation *compilation, bool used, tn_found_settings *found, tn_error *error)
{
    const tn_program *program = compilation->program;
    tn_status status = TN_OK;
    for (size_t i = 0; program && status == TN_OK && i < program->param_count; i++)
        if (used || !program->params[i].imported)
            status = add_param(&compilation->sources, &program->params[i], found, error);
    return status;
}

/* ---- numbers */

/* Sorted by where their numbers end, which the sign before one leaves as it is. */
typedef struct range_list {
    const tn_number_range **items;
    size_t count;
} range_list;

static int compare_places(tn_span a, tn_span b)
{
    if (a.file != b.file)
        return a.file < b.file ? -1 : 1;
    return a.end < b.end ? -1 : a.end > b.end;
}

static int compare_ranges(const void *a, const void *b)
{
    return compare_places((*(const tn_number_range *const *)a)->span, (*(const tn_number_range *const *)b)->span);
}

static tn_status sort_ranges(const tn_number_ranges *ranges, range_list *sorted, tn_error *error)
{
    sorted->count = 0;
    sorted->items = calloc(ranges->count + 1, sizeof *sorted->items);
    if (!sorted->items)
        return tn_fail_memory(error);
    for (const tn_number_range *range = ranges->first; range; range = range->next)
        sorted->items[sorted->count++] = range;
    qsort(sorted->items, sorted->count, sizeof *sorted->items, compare_ranges);
    return TN_OK;
}

/* What was noted of the number there; NULL: nothing. */
static const tn_number_range *range_of(const range_list *sorted, tn_span place)
{
    const tn_number_range wanted = {.span = place}, *key = &wanted;
    const tn_number_range *const *found =
        bsearch(&key, sorted->items, sorted->count, sizeof *sorted->items, compare_ranges);
    return found ? *found : NULL;
}

typedef struct numbers {
    tn_sources *sources;
    const range_list *ranges;
    const tn_source *source;
    const tn_listing *listing;
    tn_found_settings *found;
} numbers;

/* The smallest entry that the token is in, or NULL. */
static const tn_listing_entry *entry_of(const tn_listing *listing, tn_span place)
{
    const tn_listing_entry *found = NULL;
    for (size_t i = 0; i < listing->entry_count; i++) {
        const tn_listing_entry *entry = &listing->entries[i];
        bool inside = entry->whole.begin <= place.begin && place.end <= entry->whole.end;
        if (inside && (!found || entry->whole.end - entry->whole.begin <= found->whole.end - found->whole.begin))
            found = entry;
    }
    return found;
}

static bool is_word(const tn_token *token)
{
    return token->kind == TN_TOKEN_WORD || token->kind == TN_TOKEN_NAME || token->kind == TN_TOKEN_FIELD;
}

/* The last word before the number, after `from`; NULL if there is none. */
static const tn_token *word_before(const tn_listing *listing, size_t number, size_t from)
{
    for (size_t i = number; i-- > 0 && listing->tokens[i].span.begin >= from;)
        if (is_word(&listing->tokens[i]))
            return &listing->tokens[i];
    return NULL;
}

/* With the sign before it, if that is not between two numbers. */
static tn_span with_sign(const numbers *n, size_t i)
{
    const tn_token *tokens = n->listing->tokens;
    tn_span span = tokens[i].span;
    if (i == 0 || !tn_listing_is(n->listing, i - 1, "-"))
        return span;
    bool between = i > 1 && (is_word(&tokens[i - 2]) || tokens[i - 2].kind == TN_TOKEN_NUMBER ||
                             tokens[i - 2].kind == TN_TOKEN_LENGTH || tn_listing_is(n->listing, i - 2, ")"));
    if (!between && tokens[i - 1].span.end == span.begin)
        span.begin = tokens[i - 1].span.begin;
    return span;
}

static bool same_text(const char *text, tn_span a, tn_span b)
{
    size_t size = a.end - a.begin;
    return b.end - b.begin == size && memcmp(text + a.begin, text + b.begin, size) == 0;
}

static tn_status add_number(const numbers *n, size_t i, tn_error *error)
{
    const tn_token *token = &n->listing->tokens[i];
    const tn_listing_entry *entry = entry_of(n->listing, token->span);
    const tn_token *word = word_before(n->listing, i, entry ? entry->whole.begin : 0);
    tn_span place = with_sign(n, i);
    tn_shown_setting *to = add(n->sources, n->found, place, copy(n->source->text, place), error);
    if (!to)
        return TN_MEMORY;
    to->name = word ? copy(n->source->text, word->span) : strdup("");
    to->has_part = entry && (!word || !same_text(n->source->text, entry->name, word->span));
    to->part = to->has_part ? copy(n->source->text, entry->name) : NULL;
    const tn_number_range *range = range_of(n->ranges, place);
    to->least = range ? range->least : NULL;
    to->most = range ? range->most : NULL;
    to->has_least = to->least != NULL;
    to->has_most = to->most != NULL;
    return to->name && (to->part || !to->has_part) ? TN_OK : tn_fail_memory(error);
}

static tn_status add_tokens(const numbers *n, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < n->listing->count; i++)
        if (n->listing->tokens[i].kind == TN_TOKEN_NUMBER || n->listing->tokens[i].kind == TN_TOKEN_LENGTH)
            status = add_number(n, i, error);
    return status;
}

/* The compilation has read the tokens and forgotten them. */
static tn_status add_file(tn_compilation *compilation, const range_list *ranges, uint32_t file,
                          tn_found_settings *found, tn_error *error)
{
    tn_sources *sources = &compilation->sources;
    const tn_source *source = &sources->files[file];
    const tn_notation *notation = tn_notation_or_first(source->path, source->text, source->size);
    tn_diagnostics said;
    tn_reading reading;
    tn_listing listing;
    tn_diagnostics_init(&said, sources);
    bool read = tn_text_check(&said, file) && tn_read(compilation->arena, &said, notation, file, &reading) &&
                tn_listing_start(&listing, source->text, &reading.tokens);
    if (read && notation->front->list)
        notation->front->list(&listing);
    tn_status status =
        read ? add_tokens(&(numbers){sources, ranges, source, &listing, found}, error) : tn_fail_memory(error);
    tn_diagnostics_clear(&said);
    return status;
}

static tn_status add_numbers(tn_compilation *compilation, bool used, tn_found_settings *found, tn_error *error)
{
    size_t count = used ? compilation->sources.count : 1;
    range_list ranges;
    tn_status status = sort_ranges(compilation->ranges, &ranges, error);
    for (uint32_t file = 0; status == TN_OK && file < count; file++)
        status = add_file(compilation, &ranges, file, found, error);
    free(ranges.items);
    return status;
}

/* ---- asked */

tn_status tn_ask_settings(tn_session *session, const tn_settings_request *request, tn_reply *answer)
{
    tn_opened *opened = session->opened;
    tn_compilation *compilation = &opened->compilation;
    tn_error error;
    *answer = (tn_reply){0};
    if (!opened->compiled)
        return tn_session_refuse(session, "name the rule file that it was built from",
                                 "%.200s is a module, and only the text of a rule file has places", opened->path);
    tn_status status = tn_reply_new(&tn_message_found_settings, answer, &error);
    if (status == TN_OK)
        status = compilation->notation->front->settable
                     ? add_params(compilation, request->used, answer->value, &error)
                     : add_numbers(compilation, request->used, answer->value, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}
