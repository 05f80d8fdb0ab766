/* Puts houses on a page, one by one and side by side. */
#include "driver/report/house_page.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/house/tables.h"
#include "runtime/base/array.h"
#include "runtime/house/model/views.h"
#include "runtime/house/picture/draw.h"
#include "runtime/house/schedule/describe.h"

/* ---- tables that are written for programs, read by people */

/* A number with its thousands apart. */
static bool put_apart(const tn_page *page, const char *number)
{
    size_t whole = strcspn(number, ".");
    bool good = true;
    for (size_t i = 0; good && number[i]; i++)
        good = (i == 0 || i >= whole || (whole - i) % 3 != 0 || number[i - 1] == '-' || tn_page_html(page, ",")) &&
               tn_page_text_part(page, number + i, 1);
    return good;
}

/* A number to two places; anything else as it is. Numbers without a point may be codes: they are left alone, unless
 * others in their place have one. */
static bool put_cell(const tn_page *page, const char *text, size_t size, bool decimal)
{
    char number[48], *end;
    if (size == 0 || size >= sizeof number || !(decimal || memchr(text, '.', size)))
        return tn_page_text_part(page, text, size);
    memcpy(number, text, size);
    number[size] = '\0';
    double value = strtod(number, &end);
    if (*end || fabs(value) > 1e15)
        return tn_page_text_part(page, text, size);
    snprintf(number, sizeof number, "%.2f", value);
    return put_apart(page, number);
}

/* "m2", as tables have it, is "m²" on pages. */
static bool put_word(const tn_page *page, const char *word, size_t size)
{
    if (size == 2 && word[0] == 'm' && (word[1] == '2' || word[1] == '3'))
        return tn_page_html(page, word[1] == '2' ? "m\xc2\xb2" : "m\xc2\xb3");
    return tn_page_text_part(page, word, size);
}

/* The name of a column: `_` is a blank. */
static bool put_name(const tn_page *page, const char *name, size_t size)
{
    bool good = true;
    for (size_t at = 0, word; good && at < size; at += word + 1) {
        for (word = 0; at + word < size && name[at + word] != '_';)
            word++;
        good = (at == 0 || tn_page_html(page, " ")) && put_word(page, name + at, word);
    }
    return good;
}

/* A line of CSV without quotes, as a row. */
static bool put_row(const tn_page *page, const char *line, size_t size, bool head)
{
    bool good = tn_page_html(page, "<tr>");
    for (size_t at = 0; good && at <= size;) {
        size_t length = 0;
        while (at + length < size && line[at + length] != ',')
            length++;
        good = tn_page_html(page, head ? "<th>" : "<td>");
        if (good && head)
            good = put_name(page, line + at, length) && tn_page_html(page, "</th>");
        else if (good)
            good = (memchr(line + at, '.', length) ? put_cell(page, line + at, length, true)
                                                   : put_word(page, line + at, length)) &&
                   tn_page_html(page, "</td>");
        at += length + 1;
    }
    return good && tn_page_html(page, "</tr>\n");
}

static bool put_table(const tn_page *page, const char *title, const tn_buffer *csv)
{
    bool good = tn_page_html(page, "<h4>") && tn_page_html(page, title) &&
                tn_page_html(page, "</h4>\n<table class=\"bill\">\n"),
         head = true;
    for (size_t at = 0; good && at < csv->size;) {
        size_t size = 0;
        while (at + size < csv->size && csv->data[at + size] != '\r' && csv->data[at + size] != '\n')
            size++;
        good = put_row(page, csv->data + at, size, head);
        head = false;
        at += size;
        while (at < csv->size && (csv->data[at] == '\r' || csv->data[at] == '\n'))
            at++;
    }
    return good && tn_page_html(page, "</table>\n");
}

/* ---- one house */

static tn_status draw_sheet(tn_page *page, const tn_reported_house *reported)
{
    tn_aspect aspects[TN_HOUSE_VIEWS_MAX];
    size_t count;
    const tn_views all = {0};
    tn_picture picture = tn_page_next_picture(page);
    tn_status status = tn_house_views(&reported->house, &all, aspects, &count, page->error);
    const tn_house_drawing drawing = {.aspects = aspects, .count = count, .title = reported->name};
    if (status == TN_OK)
        status = tn_house_draw(&reported->house, &reported->solids, &drawing, &picture, page->error);
    return tn_page_put_picture(page, &picture, "plans and views of the house", status);
}

static tn_status put_tables(tn_page *page, const tn_reported_house *reported)
{
    tn_buffer rooms = {0}, parts = {0};
    tn_status status = tn_house_schedule(&reported->house, &rooms, page->error);
    if (status == TN_OK)
        status = tn_house_parts(&reported->house, &reported->solids, &parts, page->error);
    if (status == TN_OK)
        status = tn_page_written(page, tn_page_html(page, "<div class=\"side\"><div>") &&
                                           put_table(page, "Rooms", &rooms) && tn_page_html(page, "</div><div>") &&
                                           put_table(page, "Parts and prices", &parts) &&
                                           tn_page_html(page, "</div></div>\n"));
    free(rooms.data);
    free(parts.data);
    return status;
}

static tn_status put_line(tn_page *page, const tn_house *house)
{
    tn_buffer line = {0};
    tn_status status = tn_house_write(house, &line, page->error);
    if (status == TN_OK)
        status =
            tn_page_written(page, tn_page_html(page, "<p class=\"line\">") &&
                                      tn_page_text_part(page, line.data, line.size) && tn_page_html(page, "</p>\n"));
    free(line.data);
    return status;
}

tn_status tn_page_put_house(tn_page *page, const tn_reported_house *reported, bool full)
{
    tn_status status = tn_page_written(page, tn_page_html(page, "<section class=\"card house\"><h3>") &&
                                                 tn_page_text(page, reported->name) && tn_page_html(page, "</h3>\n"));
    if (status == TN_OK)
        status = put_line(page, &reported->house);
    if (status == TN_OK && !full)
        status = tn_page_written(
            page, tn_page_html(page, "<details><summary>plans and views, rooms, parts and prices</summary>\n"));
    if (status == TN_OK)
        status = draw_sheet(page, reported);
    if (status == TN_OK)
        status = put_tables(page, reported);
    return status == TN_OK ? tn_page_written(page, (full || tn_page_html(page, "</details>\n")) &&
                                                       tn_page_html(page, "</section>\n"))
                           : status;
}

enum { IN_A_ROW = 4 }; /* so many houses need no second row */

tn_status tn_page_put_gallery(tn_page *page, const tn_reported_house *houses, size_t count)
{
    tn_pictured_house *pictured = calloc(count + 1, sizeof *pictured);
    if (!pictured)
        return tn_fail_memory(page->error);
    for (size_t i = 0; i < count; i++)
        pictured[i] = (tn_pictured_house){&houses[i].house, &houses[i].solids, houses[i].name, ""};
    const tn_house_gallery gallery = {.houses = pictured,
                                      .count = count,
                                      .columns = count <= IN_A_ROW ? count : 0,
                                      .camera = tn_house_sheet_camera()};
    tn_picture picture = tn_page_next_picture(page);
    tn_status status =
        tn_page_put_picture(page, &picture, "the houses", tn_house_gallery_draw(&gallery, &picture, page->error));
    free(pictured);
    return status;
}

/* ---- side by side */

/* Parts of a house's line that no column says: its section is the choices, which have columns. */
enum { PARTS = 4 };

/* What stands in the table: a row for each column of a table of houses, then for each part of a line. */
typedef struct compared {
    tn_page *page;
    const tn_reported_house *houses;
    size_t count;
    tn_house_tables *tables;
    const tn_house_column *columns;
    size_t column_count;
    char **cells; /* [house][column]; owned, NULL where there is no value */
    size_t row;   /* the house at hand */
} compared;

static tn_status keep_row(void *context, tn_house_table table, const char *const *cells, tn_error *error)
{
    compared *c = context;
    for (size_t i = 0; table == TN_TABLE_HOUSES && i < c->column_count; i++) {
        char **kept = &c->cells[c->row * c->column_count + i];
        if (cells[i] && !(*kept = strdup(cells[i])))
            return tn_fail_memory(error);
    }
    return TN_OK;
}

static tn_status fill(compared *c)
{
    tn_status status = TN_OK;
    for (c->row = 0; status == TN_OK && c->row < c->count; c->row++)
        status = tn_house_tables_add(c->tables, &c->houses[c->row].house, c->row + 1, NULL, NULL, keep_row, c,
                                     c->page->error);
    return status;
}

/* A part of a house's line, which ends it. */
static const char *part_of(const char *line, int part, size_t *size)
{
    for (; part > 0; part--) {
        const char *next = strchr(line, ';');
        line = next ? next + 1 : line + strlen(line);
    }
    while (*line == ' ')
        line++;
    *size = strcspn(line, ";");
    while (*size > 0 && line[*size - 1] == ' ')
        --*size;
    return line;
}

static const char *cell_of(const compared *c, size_t house, size_t column, int part, size_t *size)
{
    const char *text = c->cells[house * c->column_count + column];
    *size = text ? strlen(text) : 0;
    return part < 0 || !text ? text : part_of(text, part, size);
}

static bool differs(const compared *c, size_t column, int part)
{
    size_t first, other;
    const char *text = cell_of(c, 0, column, part, &first);
    bool same = true;
    for (size_t i = 1; same && i < c->count; i++) {
        const char *next = cell_of(c, i, column, part, &other);
        same = other == first && (first == 0 || memcmp(text, next, first) == 0);
    }
    return !same;
}

/* Has a house a number with a point in the row? Then all of its numbers are written alike. */
static bool is_decimal(const compared *c, size_t column, int part)
{
    size_t size;
    bool decimal = false;
    for (size_t i = 0; part < 0 && i < c->count; i++) {
        const char *text = cell_of(c, i, column, part, &size);
        decimal |= text && memchr(text, '.', size);
    }
    return decimal;
}

static bool put_compared(const compared *c, const char *name, size_t column, int part)
{
    bool decimal = is_decimal(c, column, part),
         good = tn_page_html(c->page, differs(c, column, part) ? "<tr class=\"differs\"><th>" : "<tr><th>") &&
                put_name(c->page, name, strlen(name)) && tn_page_html(c->page, "</th>");
    for (size_t i = 0; good && i < c->count; i++) {
        size_t size;
        const char *text = cell_of(c, i, column, part, &size);
        good = tn_page_html(c->page, part < 0 ? "<td>" : "<td class=\"line\">") &&
               (size == 0 || put_cell(c->page, text, size, decimal)) && tn_page_html(c->page, "</td>");
    }
    return good && tn_page_html(c->page, "</tr>\n");
}

/* Rows that say the same of each house in other words, or nothing to people, are left out. */
static bool is_shown(const char *name)
{
    static const char *const hidden[] = {"house", "rank", "plan_rank", "plan", "line"};
    for (size_t i = 0; i < sizeof hidden / sizeof *hidden; i++)
        if (strcmp(name, hidden[i]) == 0)
            return false;
    return true;
}

static bool put_compared_rows(const compared *c)
{
    static const struct {
        const char *name;
        int part;
    } parts[PARTS] = {{"plan", 0}, {"functions", 2}, {"faces", 3}, {"tiles", 4}};
    bool good = tn_page_html(c->page, "<h2 id=\"compared\">Side by side</h2>\n<p class=\"quiet\">What differs is "
                                      "marked.</p>\n<table class=\"compared\">\n<tr><th></th>");
    for (size_t i = 0; good && i < c->count; i++)
        good =
            tn_page_html(c->page, "<th>") && tn_page_text(c->page, c->houses[i].name) && tn_page_html(c->page, "</th>");
    good = good && tn_page_html(c->page, "</tr>\n");
    for (size_t i = 0; good && i < c->column_count; i++)
        good = !is_shown(c->columns[i].name) || put_compared(c, c->columns[i].name, i, -1);
    for (size_t i = 0; good && i < PARTS; i++) /* of the line, which is the last column */
        good = put_compared(c, parts[i].name, c->column_count - 1, parts[i].part);
    return good && tn_page_html(c->page, "</table>\n");
}

static tn_status put_side_by_side(tn_page *page, const tn_house_form *form, const tn_reported_house *houses,
                                  size_t count)
{
    compared c = {.page = page, .houses = houses, .count = count};
    size_t longest = 0;
    for (size_t i = 0; i < count; i++)
        longest = houses[i].house.length > longest ? houses[i].house.length : longest;
    tn_status status = tn_house_tables_new(form, longest, &c.tables, page->error);
    if (status == TN_OK) {
        c.columns = tn_house_table_columns(c.tables, TN_TABLE_HOUSES, &c.column_count);
        c.cells = calloc(tn_size_of(count + 1, c.column_count), sizeof *c.cells);
        status = c.cells ? fill(&c) : tn_fail_memory(page->error);
    }
    if (status == TN_OK)
        status = tn_page_written(page, put_compared_rows(&c));
    for (size_t i = 0; c.cells && i < count * c.column_count; i++)
        free(c.cells[i]);
    free(c.cells);
    tn_house_tables_free(c.tables);
    return status;
}

/* ---- the page */

tn_status tn_houses_page(tn_opened *opened, const tn_house_form *form, const tn_reported_house *houses, size_t count,
                         tn_buffer *text, tn_error *error)
{
    tn_page page = {.text = text, .error = error};
    const tn_module *module = form->module;
    tn_status status = tn_page_written(
        &page, tn_page_begin(&page, tn_text(module, form->record->name), tn_text(module, form->record->doc)) &&
                   tn_page_params(&page, opened));
    if (status == TN_OK && count > 1)
        status = tn_page_put_gallery(&page, houses, count);
    if (status == TN_OK && count > 1)
        status = put_side_by_side(&page, form, houses, count);
    if (status == TN_OK)
        status = tn_page_written(&page, tn_page_html(&page, count > 1 ? "<h2 id=\"houses\">One by one</h2>\n" : ""));
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = tn_page_put_house(&page, &houses[i], true);
    return status == TN_OK
               ? tn_page_written(&page, tn_page_html(&page, "<p class=\"quiet\">") && tn_page_version(&page, module) &&
                                            tn_page_html(&page, "</p>\n</html>\n"))
               : status;
}
