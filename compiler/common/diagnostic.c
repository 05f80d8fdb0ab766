/* Collects errors, warnings and notes. */
#include "compiler/common/diagnostic.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

#define ERRORS_SHOWN 100u
#define FIRST_WARNING 10000u /* added to the numbers of warnings */

void tn_diagnostics_init(tn_diagnostics *list, tn_sources *sources)
{
    *list = (tn_diagnostics){.sources = sources};
}

static void clear_item(tn_diagnostic *item)
{
    for (size_t i = 0; i < item->note_count; i++)
        free(item->notes[i].text);
    free(item->notes);
    free(item->message);
    free(item->help);
    free(item->replacement);
    free(item->input_path);
    free(item->input_text);
}

void tn_diagnostics_clear(tn_diagnostics *list)
{
    for (size_t i = 0; i < list->count; i++)
        clear_item(&list->items[i]);
    free(list->items);
    clear_item(&list->scratch);
    *list = (tn_diagnostics){.sources = list->sources, .error_limit = list->error_limit};
}

/* The text in memory of its own, or NULL (remembered). */
__attribute__((format(printf, 2, 0))) static char *print(tn_diagnostics *list, const char *format, va_list args)
{
    char *text;
    if (vasprintf(&text, format, args) < 0) {
        list->failed = true;
        return NULL;
    }
    return text;
}

static char *copy(tn_diagnostics *list, const char *text, size_t size)
{
    char *result = strndup(text, size);
    if (!result)
        list->failed = true;
    return result;
}

/* Counts one of that severity; does the list still keep it? */
static bool admit(tn_diagnostics *list, tn_severity severity)
{
    size_t limit = list->error_limit ? list->error_limit : ERRORS_SHOWN;
    if (severity == TN_ERROR)
        return list->error_count++ < limit;
    if (severity == TN_WARNING)
        return list->warning_count++ < limit;
    return true;
}

/* A new item with nothing but its severity and code: the list's, or the scratch item. */
static tn_diagnostic *add(tn_diagnostics *list, tn_severity severity, uint32_t code)
{
    clear_item(&list->scratch);
    list->scratch = (tn_diagnostic){.severity = severity, .code = code};
    if (!admit(list, severity)) {
        list->dropped++;
        return &list->scratch;
    }
    if (!tn_array_reserve_from(&list->items, &list->capacity, 16, list->count, 1, sizeof *list->items)) {
        list->failed = true;
        return &list->scratch;
    }
    tn_diagnostic *item = &list->items[list->count];
    *item = (tn_diagnostic){.severity = severity, .code = code, .order = list->count};
    list->count++;
    return item;
}

tn_diagnostic *tn_report(tn_diagnostics *list, tn_code code, tn_span span, const char *format, ...)
{
    tn_diagnostic *item = add(list, (uint32_t)code > FIRST_WARNING ? TN_WARNING : code ? TN_ERROR : TN_NOTE, code);
    item->has_span = true;
    item->span = span;
    va_list args;
    va_start(args, format);
    item->message = print(list, format, args);
    va_end(args);
    return item;
}

tn_diagnostic *tn_report_bare(tn_diagnostics *list, tn_severity severity, uint32_t code, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    tn_diagnostic *item = tn_report_bare_list(list, severity, code, format, args);
    va_end(args);
    return item;
}

tn_diagnostic *tn_report_bare_list(tn_diagnostics *list, tn_severity severity, uint32_t code, const char *format,
                                   va_list args)
{
    tn_diagnostic *item = add(list, severity, code);
    item->message = print(list, format, args);
    return item;
}

tn_diagnostic *tn_report_error(tn_diagnostics *list, const tn_error *error, const char *input_path,
                               const char *input_text, size_t input_size)
{
    if (error->status == TN_STOPPED) { /* why is said in the end, once */
        list->stopped = true;
        clear_item(&list->scratch);
        list->scratch = (tn_diagnostic){.severity = TN_NOTE};
        return &list->scratch;
    }
    tn_diagnostic *item = tn_report_bare(list, TN_ERROR, error->code, "%s", error->message);
    if (error->help[0])
        tn_help(list, item, "%s", error->help);
    if (error->line == 0)
        return item;
    item->input_line = error->line;
    item->input_column = error->column;
    item->input_column_end = error->column_end;
    if (input_path)
        item->input_path = copy(list, input_path, strlen(input_path));
    if (input_text)
        item->input_text = copy(list, input_text, input_size);
    return item;
}

void tn_diagnostics_move(tn_diagnostics *from, tn_diagnostics *to, uint32_t first_file)
{
    for (size_t i = 0; i < from->count; i++) {
        tn_diagnostic *item = add(to, from->items[i].severity, from->items[i].code);
        size_t order = item->order;
        *item = from->items[i];
        item->order = order;
        item->span.file += first_file;
        for (size_t n = 0; n < item->note_count; n++)
            item->notes[n].span.file += first_file;
        from->items[i] = (tn_diagnostic){0};
    }
    to->dropped += from->dropped;
    to->failed |= from->failed;
    tn_diagnostics_clear(from);
}

void tn_diagnostics_keep_errors(tn_diagnostics *list)
{
    size_t kept = 0;
    for (size_t i = 0; i < list->count; i++) {
        if (list->items[i].severity == TN_ERROR)
            list->items[kept++] = list->items[i];
        else
            clear_item(&list->items[i]);
    }
    list->count = kept;
    list->warning_count = 0;
}

void tn_note(tn_diagnostics *list, tn_diagnostic *diagnostic, const tn_span *span, const char *format, ...)
{
    if (!tn_array_resize(&diagnostic->notes, diagnostic->note_count + 1, sizeof *diagnostic->notes)) {
        list->failed = true;
        return;
    }
    va_list args;
    va_start(args, format);
    char *text = print(list, format, args);
    va_end(args);
    diagnostic->notes[diagnostic->note_count++] =
        (tn_diagnostic_note){.has_span = span != NULL, .span = span ? *span : (tn_span){0}, .text = text};
}

void tn_help(tn_diagnostics *list, tn_diagnostic *diagnostic, const char *format, ...)
{
    free(diagnostic->help);
    va_list args;
    va_start(args, format);
    diagnostic->help = print(list, format, args);
    va_end(args);
}

void tn_replace_with(tn_diagnostics *list, tn_diagnostic *diagnostic, const char *format, ...)
{
    free(diagnostic->replacement);
    va_list args;
    va_start(args, format);
    diagnostic->replacement = print(list, format, args);
    va_end(args);
}

/* Takes the replacement over. */
static void set_replacement(tn_diagnostics *list, tn_diagnostic *diagnostic, bool sure, char *replacement)
{
    if (!replacement)
        return;
    tn_help(list, diagnostic, sure ? "write `%s`" : "did you mean `%s`?", replacement);
    free(diagnostic->replacement);
    diagnostic->replacement = replacement;
}

void tn_suggest(tn_diagnostics *list, tn_diagnostic *diagnostic, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    set_replacement(list, diagnostic, false, print(list, format, args));
    va_end(args);
}

void tn_advise(tn_diagnostics *list, tn_diagnostic *diagnostic, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    set_replacement(list, diagnostic, true, print(list, format, args));
    va_end(args);
}

static int order(uint64_t a, uint64_t b)
{
    return (a > b) - (a < b);
}

static int compare(const void *left, const void *right)
{
    const tn_diagnostic *a = left, *b = right;
    if (a->has_span != b->has_span)
        return a->has_span ? -1 : 1;
    int result = 0;
    if (a->has_span) {
        result = order(a->span.file, b->span.file);
        result = result ? result : order(a->span.begin, b->span.begin);
        result = result ? result : order(a->code, b->code);
    }
    return result ? result : order(a->order, b->order);
}

static bool repeats(const tn_diagnostic *a, const tn_diagnostic *b)
{
    return a->has_span && b->has_span && a->span.file == b->span.file && a->span.begin == b->span.begin &&
           a->span.end == b->span.end && a->code == b->code && a->message && b->message &&
           strcmp(a->message, b->message) == 0;
}

void tn_diagnostics_sort(tn_diagnostics *list)
{
    if (list->count < 2)
        return;
    qsort(list->items, list->count, sizeof *list->items, compare);
    size_t kept = 1;
    for (size_t i = 1; i < list->count; i++) {
        tn_diagnostic *item = &list->items[i];
        if (!repeats(&list->items[kept - 1], item)) {
            list->items[kept++] = *item;
            continue;
        }
        list->error_count -= item->severity == TN_ERROR;
        list->warning_count -= item->severity == TN_WARNING;
        clear_item(item);
    }
    list->count = kept;
}

void tn_code_name(uint32_t code, char name[8])
{
    if (code > FIRST_WARNING)
        snprintf(name, 8, "W%03u", (code - FIRST_WARNING) % 1000);
    else
        snprintf(name, 8, "E%04u", code % 10000);
}
