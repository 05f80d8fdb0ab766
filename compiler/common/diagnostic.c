/* Collects errors, warnings and notes, and between what numbers may lie; and shows them: as text with the source line
 * and a caret, or as JSON. */
#include "compiler/common/diagnostic.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/buffer.h"
#include "runtime/base/json.h"
#include "runtime/base/utf8.h"

/* ==== gathers between what numbers may lie */

static void note(tn_number_ranges *ranges, tn_span span, const char *least, const char *most)
{
    tn_number_range *range = TN_NEW(ranges->arena, tn_number_range);
    if (!range)
        return;
    *range = (tn_number_range){.span = span, .least = least, .most = most};
    TN_CHAIN(ranges, range);
    ranges->count++;
}

static const char *written(tn_arena *arena, double number)
{
    char text[TN_NUMBER_TEXT_SIZE];
    if (!isfinite(number))
        return NULL;
    tn_number_text(number, text);
    return tn_arena_copy(arena, text, strlen(text));
}

void tn_range_note(tn_diagnostics *diagnostics, tn_span span, double least, double most)
{
    tn_number_ranges *ranges = diagnostics->ranges;
    if (ranges)
        note(ranges, span, written(ranges->arena, least), written(ranges->arena, most));
}

void tn_range_note_whole64(tn_diagnostics *diagnostics, tn_span span)
{
    char most[TN_NUMBER_TEXT_SIZE];
    tn_number_ranges *ranges = diagnostics->ranges;
    if (!ranges)
        return;
    snprintf(most, sizeof most, "%" PRIu64, UINT64_MAX);
    note(ranges, span, "0", tn_arena_copy(ranges->arena, most, strlen(most)));
}

/* ==== collects errors, warnings and notes */

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

/* ==== shows diagnostics: as text with the source line and a caret, or as JSON */

/* Tabs are shown as blanks up to the next multiple of TAB_STOP; of a longer line than LINE_COLUMNS a window is shown
 * that begins CONTEXT_CHARACTERS before the mark. */
enum { TAB_STOP = 4, LINE_COLUMNS = 110, CONTEXT_CHARACTERS = 50 };

typedef struct tn_style {
    const char *place, *error, *warning, *note, *gutter, *mark, *end;
} tn_style;

static const tn_style plain = {"", "", "", "", "", "", ""};
static const tn_style coloured = {"\x1b[1m",  "\x1b[1;31m", "\x1b[1;35m", "\x1b[1;36m",
                                  "\x1b[34m", "\x1b[1;32m", "\x1b[0m"};

/* One line of text with the bytes [begin, end) of it marked; a mark without bytes is one caret wide. */
typedef struct tn_marked_source {
    const char *text;
    size_t size, begin, end;
} tn_marked_source;

const char *tn_severity_text(tn_severity severity)
{
    static const char *const names[] = {"note", "warning", "error"};
    return names[severity];
}

/* ---- the source line */

static unsigned shown_width(uint32_t character, size_t column)
{
    if (character == '\t')
        return (unsigned)(TAB_STOP - column % TAB_STOP);
    return tn_character_hidden(character) ? 1 : tn_character_width(character);
}

/* The byte up to which the line from `from` fits into LINE_COLUMNS. */
static size_t fitting_end(const tn_marked_source *line, size_t from)
{
    size_t column = 0, at = from;
    for (size_t step; at < line->size; at += step) {
        column += shown_width(tn_utf8_read(line->text + at, line->size - at, &step), column);
        if (column > LINE_COLUMNS)
            break;
    }
    return at;
}

/* The window [*from, *to) of the line that is shown: all of it where it fits, else with the mark in view. */
static void choose_window(const tn_marked_source *line, size_t *from, size_t *to)
{
    *from = 0;
    *to = fitting_end(line, 0);
    if (*to == line->size || line->end < *to)
        return;
    size_t start = line->begin;
    for (size_t back = 0; start > 0 && back < CONTEXT_CHARACTERS; back++) {
        start--;
        for (int i = 0; i < 3 && start > 0 && ((unsigned char)line->text[start] & 0xC0) == 0x80; i++)
            start--;
    }
    *from = start;
    *to = fitting_end(line, start);
}

static void write_character(FILE *out, const char *bytes, size_t size, uint32_t character, unsigned width)
{
    if (character == '\t')
        fprintf(out, "%*s", (int)width, "");
    else if (character == TN_REPLACEMENT || tn_character_hidden(character))
        fputs("\xEF\xBF\xBD", out);
    else
        fwrite(bytes, 1, size, out);
}

static void write_many(FILE *out, char character, size_t count)
{
    for (size_t i = 0; i < count; i++)
        fputc(character, out);
}

static void show_line(FILE *out, const tn_style *style, int gutter, size_t number, const tn_marked_source *line)
{
    size_t from, to, column = 0, mark_from = 0, mark_to = 0;
    choose_window(line, &from, &to);
    fprintf(out, "%s%*zu |%s%s", style->gutter, gutter, number, style->end, line->size ? " " : "");
    fputs(from > 0 ? "..." : "", out);
    for (size_t at = from, step; at < to; at += step) {
        uint32_t character = tn_utf8_read(line->text + at, line->size - at, &step);
        unsigned width = shown_width(character, column);
        write_character(out, line->text + at, step, character, width);
        column += width;
        if (at + step <= line->begin)
            mark_from = column;
        if (at < line->end)
            mark_to = column;
    }
    fputs(to < line->size ? "...\n" : "\n", out);
    fprintf(out, "%s%*s |%s ", style->gutter, gutter, "", style->end);
    write_many(out, ' ', mark_from + (from > 0 ? 3 : 0));
    fputs(style->mark, out);
    write_many(out, '^', mark_to > mark_from ? mark_to - mark_from : 1);
    fprintf(out, "%s\n", style->end);
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

static int gutter_width(size_t number)
{
    int width = 1;
    for (; number >= 10; number /= 10)
        width++;
    return width < 4 ? 4 : width;
}

/* The lines of a span: its first and, where it goes on, its last, with a row of dots for those between. */
static void show_span(tn_diagnostics *list, const tn_style *style, tn_span span, FILE *out)
{
    if (span.file >= list->sources->count)
        return;
    const tn_source *source = &list->sources->files[span.file];
    uint32_t end = span.end < source->size ? span.end : (uint32_t)source->size;
    while (end > span.begin && is_blank(source->text[end - 1]))
        end--; /* a mark that takes in the line's end, or blank lines after it, says nothing */
    tn_place place =
        tn_sources_place(list->sources, (tn_span){span.file, span.begin, end > span.begin ? end : span.begin});
    bool one = place.end_line == place.line;
    int gutter = gutter_width(place.end_line);
    size_t first_end = one ? place.end_column - 1 : place.line_size;
    tn_marked_source first = {place.line_text, place.line_size, place.column - 1, first_end};
    show_line(out, style, gutter, place.line, &first);
    if (one)
        return;
    if (place.end_line > place.line + 1)
        fprintf(out, "%s%*s |%s\n", style->gutter, gutter, "...", style->end);
    tn_place last = tn_sources_place(list->sources, (tn_span){span.file, end, end});
    size_t begin = 0;
    while (begin + 1 < last.column && is_blank(last.line_text[begin]))
        begin++;
    tn_marked_source marked = {last.line_text, last.line_size, begin, last.column - 1};
    show_line(out, style, gutter, last.line, &marked);
}

/* ---- text form */

static void show_place(FILE *out, const char *path, size_t line, size_t column)
{
    tn_write_clean(out, path, strlen(path));
    fprintf(out, ":%zu:%zu: ", line, column);
}

static void show_head(tn_diagnostics *list, const tn_style *style, const tn_diagnostic *item, FILE *out)
{
    fputs(style->place, out);
    if (item->has_span && item->span.file < list->sources->count) {
        tn_place place = tn_sources_place(list->sources, item->span);
        show_place(out, place.path, place.line, place.column);
    } else if (item->input_line > 0) {
        show_place(out, item->input_path ? item->input_path : "input", tn_as_size(item->input_line),
                   item->input_column);
    }
    fputs(style->end, out);
    const char *const colours[] = {style->note, style->warning, style->error};
    fprintf(out, "%s%s", colours[item->severity], tn_severity_text(item->severity));
    if (item->code != TN_CODE_NONE) {
        char name[8];
        tn_code_name(item->code, name);
        fprintf(out, "[%s]", name);
    }
    const char *message = item->message ? item->message : "out of memory";
    fprintf(out, ":%s%s ", style->end, style->place);
    tn_write_clean(out, message, strlen(message));
    fprintf(out, "%s\n", style->end);
}

static void show_input(const tn_style *style, const tn_diagnostic *item, FILE *out)
{
    size_t size = strlen(item->input_text);
    size_t begin = item->input_column > 0 ? item->input_column - 1 : 0;
    size_t end = item->input_column_end > 0 ? item->input_column_end - 1 : 0;
    begin = begin < size ? begin : size;
    end = end < size ? end : size;
    tn_marked_source line = {item->input_text, size, begin, end > begin ? end : begin};
    size_t number = tn_as_size(item->input_line);
    show_line(out, style, gutter_width(number), number, &line);
}

static void show_tail(tn_diagnostics *list, const tn_style *style, const tn_diagnostic *item, FILE *out)
{
    for (size_t i = 0; i < item->note_count; i++) {
        const tn_diagnostic_note *note = &item->notes[i];
        fprintf(out, "  %snote:%s ", style->note, style->end);
        if (note->has_span && note->span.file < list->sources->count) {
            tn_place place = tn_sources_place(list->sources, note->span);
            show_place(out, place.path, place.line, place.column);
        }
        const char *text = note->text ? note->text : "out of memory";
        tn_write_clean(out, text, strlen(text));
        fputc('\n', out);
    }
    if (!item->help)
        return;
    fprintf(out, "  %shelp:%s ", style->note, style->end);
    tn_write_clean(out, item->help, strlen(item->help));
    fputc('\n', out);
}

static void show_text(tn_diagnostics *list, const tn_style *style, FILE *out)
{
    for (size_t i = 0; i < list->count; i++) {
        const tn_diagnostic *item = &list->items[i];
        show_head(list, style, item, out);
        if (item->has_span)
            show_span(list, style, item->span, out);
        else if (item->input_line > 0 && item->input_text)
            show_input(style, item, out);
        show_tail(list, style, item, out);
    }
    if (list->dropped > 0)
        fprintf(out, "%snote:%s %zu more like these are not shown\n", style->note, style->end, list->dropped);
    if (list->failed)
        fprintf(out, "%serror[E0801]:%s out of memory: some of what is wrong may not be shown\n", style->error,
                style->end);
}

/* ---- JSON form */

static tn_json_place place_of(tn_diagnostics *list, bool has_span, tn_span span)
{
    tn_place place = {0};
    if (has_span)
        place = tn_sources_place(list->sources, span);
    return (tn_json_place){place.line > 0 ? place.path : NULL, place.line, place.column, place.end_line,
                           place.end_column};
}

static void json_notes(tn_diagnostics *list, const tn_diagnostic *item, tn_json *json)
{
    tn_json_list(json, "notes");
    for (size_t i = 0; i < item->note_count; i++) {
        const tn_diagnostic_note *note = &item->notes[i];
        const tn_json_place place = place_of(list, note->has_span, note->span);
        tn_json_object(json, NULL);
        tn_json_string(json, "message", note->text);
        tn_json_place_begin(json, &place);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static void json_item(tn_diagnostics *list, const tn_diagnostic *item, tn_json *json)
{
    char name[8];
    size_t line = tn_as_size(item->input_line);
    tn_json_place place = {item->input_path, line, item->input_column, line, item->input_column_end};
    if (item->has_span || line == 0)
        place = place_of(list, item->has_span, item->span);
    tn_code_name(item->code, name);
    tn_json_object(json, NULL);
    tn_json_string(json, "severity", tn_severity_text(item->severity));
    tn_json_string(json, "code", item->code != TN_CODE_NONE ? name : NULL);
    tn_json_string(json, "message", item->message);
    tn_json_place_whole(json, &place);
    json_notes(list, item, json);
    tn_json_string(json, "help", item->help);
    tn_json_string(json, "replacement", item->replacement);
    tn_json_object_end(json);
}

static void show_json(tn_diagnostics *list, FILE *out)
{
    tn_json json = tn_json_file(out, (tn_json_layout){.lines = 1, .indent = 1});
    tn_json_list(&json, NULL);
    for (size_t i = 0; i < list->count; i++)
        json_item(list, &list->items[i], &json);
    tn_json_list_end(&json);
    tn_json_end_line(&json);
}

void tn_diagnostics_show_alone(tn_severity severity, tn_code code, const char *message, const char *help, FILE *out)
{
    char words[2][512];
    snprintf(words[0], sizeof words[0], "%s", message);
    snprintf(words[1], sizeof words[1], "%s", help ? help : "");
    tn_diagnostic item = {.severity = severity, .code = code, .message = words[0], .help = help ? words[1] : NULL};
    show_json(&(tn_diagnostics){.items = &item, .count = 1}, out);
}

void tn_diagnostics_show(tn_diagnostics *list, const tn_show_options *options, FILE *out)
{
    if (options->json)
        show_json(list, out);
    else
        show_text(list, options->colour ? &coloured : &plain, out);
}
