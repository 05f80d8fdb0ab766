/* Writes the report of a library of houses: the page, its counts, its clauses and some of its houses. */
#include "driver/report/house_report.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "driver/open/digits.h"
#include "driver/report/page.h"
#include "runtime/base/length.h"

typedef struct tn_house_reporting {
    const tn_house_report *report;
    const tn_module *module;
    tn_page page;
} tn_house_reporting;

/* ---- the form of a report of houses */

/* A length in the units of the schema. */
static bool house_put_length(const tn_house_reporting *r, int64_t length)
{
    const tn_schema *schema = r->report->form->schema;
    char text[48];
    const char *width = tn_text(schema->module, schema->values[schema->value_start[r->report->form->width]].name);
    tn_length_write_style(length, tn_length_style_of(width), text, sizeof text);
    return tn_page_text(&r->page, text);
}

/* The text of a record's place in its source. */
static bool put_source(const tn_house_reporting *r, uint32_t file, uint32_t begin, uint32_t end)
{
    const char *text = tn_text(r->module, r->module->SOURCE_records[file].text);
    return tn_page_html(&r->page, "<code>") && tn_page_text_part(&r->page, text + begin, end - begin) &&
           tn_page_html(&r->page, "</code>");
}

static bool put_name(const tn_house_reporting *r, tn_string name, tn_string doc)
{
    return tn_page_html(&r->page, "<tr><td>") && tn_page_text(&r->page, tn_text(r->module, name)) &&
           tn_page_html(&r->page, "</td><td>") && tn_page_text(&r->page, tn_text(r->module, doc)) &&
           tn_page_html(&r->page, "</td><td>");
}

/* What a declaration says behind its name and the text that says what it is, which stand beside. */
static bool put_declared(const tn_house_reporting *r, tn_string name, tn_string doc, uint32_t file, uint32_t begin,
                         uint32_t end)
{
    const char *text = tn_text(r->module, r->module->SOURCE_records[file].text), *called = tn_text(r->module, name),
               *from = strstr(text + begin, called),
               *quote = *tn_text(r->module, doc) ? strchr(text + begin, '"') : NULL;
    quote = quote ? strchr(quote + 1, '"') : NULL;
    if (quote && quote < text + end)
        begin = (uint32_t)(quote + 1 - text);
    else if (from && from + strlen(called) < text + end)
        begin = (uint32_t)(from + strlen(called) - text);
    begin += (uint32_t)strspn(text + begin, " `");
    return put_source(r, file, begin < end ? begin : end, end);
}

static bool put_storeys(const tn_house_reporting *r)
{
    const tn_form_record *form = r->report->form->record;
    bool good = tn_page_html(&r->page, "<h2 id=\"storeys\">Storeys</h2>\n<table class=\"words\"><tr><th>storey</th>"
                                       "<th></th><th>from floor to floor</th></tr>\n");
    for (uint32_t i = 0; good && i < form->storey_count; i++) {
        const tn_storey_record *storey = &r->module->STOREY_records[form->storey_first + i];
        good = put_name(r, storey->name, storey->doc) && house_put_length(r, storey->height) &&
               tn_page_html(&r->page, "</td></tr>\n");
    }
    return good && tn_page_html(&r->page, "</table>\n");
}

/* Functions with the cells that may have them; then what cells are open or not there. */
static bool put_functions(const tn_house_reporting *r)
{
    const tn_form_record *form = r->report->form->record;
    bool good = tn_page_html(&r->page, "<h2 id=\"functions\">Functions</h2>\n<table class=\"words\"><tr><th>function"
                                       "</th><th></th><th>where it may be</th></tr>\n");
    for (uint32_t i = 0; good && i < form->rule_count; i++) {
        const tn_cell_rule_record *rule = tn_form_rule(r->report->form, i);
        good = put_name(r, rule->name, rule->doc) &&
               put_declared(r, rule->name, rule->doc, rule->file, rule->begin, rule->end) &&
               tn_page_html(&r->page, "</td></tr>\n");
    }
    return good && tn_page_html(&r->page, "</table>\n");
}

static bool put_openings(const tn_house_reporting *r)
{
    const tn_form_record *form = r->report->form->record;
    bool good = tn_page_html(&r->page, "<h2 id=\"openings\">Openings</h2>\n<table class=\"words\"><tr><th>opening</th>"
                                       "<th></th><th>what it is</th></tr>\n");
    for (uint32_t i = 0; good && i < form->opening_count; i++) {
        const tn_opening_record *opening = &r->module->OPENING_records[form->opening_first + i];
        good = put_name(r, opening->name, opening->doc) &&
               put_declared(r, opening->name, opening->doc, opening->file, opening->begin, opening->end) &&
               tn_page_html(&r->page, "</td></tr>\n");
    }
    good =
        good && tn_page_html(&r->page, "</table>\n<p>What may be in a face; the first line that applies decides:</p>\n"
                                       "<pre>");
    for (uint32_t i = 0; good && i < form->face_count; i++) {
        const tn_face_line_record *line = &r->module->FACE_LINE_records[form->face_first + i];
        good = put_source(r, line->file, line->begin, line->end) && tn_page_html(&r->page, "\n");
    }
    return good && tn_page_html(&r->page, "</pre>\n");
}

/* ---- tiles */

#define MORE_ROOM INT64_C(304800000)   /* a foot beyond what the boxes need: it can be larger */
#define LEAST_ROOM INT64_C(2438400000) /* 8', where boxes go from wall to wall */
enum { DRAWN_WIDE = 200 };             /* points */

/* A stretch that is measured from the far side where so, in a room of that size. */
static void stretch(int64_t from, int64_t to, bool from_far, bool to_far, int64_t size, int64_t *low, int64_t *high)
{
    int64_t a = from_far ? size - from : from, b = to_far ? size - to : to;
    *low = a < b ? a : b;
    *high = a < b ? b : a;
}

static int64_t needed(int64_t from, int64_t to, bool from_far, bool to_far)
{
    return from_far != to_far ? from + to : from > to ? from : to;
}

/* As large a room as the tile asks for, somewhat larger than its boxes, and not too small. */
static void find_room(const tn_house_reporting *r, const tn_tile_record *tile, int64_t *wide, int64_t *deep)
{
    *wide = *deep = LEAST_ROOM - MORE_ROOM;
    for (uint32_t i = 0; i < tile->box_count; i++) {
        const tn_tile_box_record *box = &r->module->TILE_BOX_records[tile->box_first + i];
        int64_t x = needed(box->x_from, box->x_to, box->flags & TN_TILE_X_FROM_RIGHT, box->flags & TN_TILE_X_TO_RIGHT);
        int64_t y = needed(box->y_from, box->y_to, box->flags & TN_TILE_Y_FROM_FRONT, box->flags & TN_TILE_Y_TO_FRONT);
        *wide = x > *wide ? x : *wide;
        *deep = y > *deep ? y : *deep;
    }
    *wide = *wide + MORE_ROOM > tile->wide_least ? *wide + MORE_ROOM : tile->wide_least;
    *deep = *deep + MORE_ROOM > tile->deep_least ? *deep + MORE_ROOM : tile->deep_least;
}

static bool put_box(const tn_house_reporting *r, const tn_tile_box_record *box, int64_t wide, int64_t deep)
{
    int64_t x[2], y[2];
    double scale = DRAWN_WIDE / (double)wide;
    bool keep = box->flags & TN_TILE_KEEP;
    stretch(box->x_from, box->x_to, box->flags & TN_TILE_X_FROM_RIGHT, box->flags & TN_TILE_X_TO_RIGHT, wide, &x[0],
            &x[1]);
    stretch(box->y_from, box->y_to, box->flags & TN_TILE_Y_FROM_FRONT, box->flags & TN_TILE_Y_TO_FRONT, deep, &y[0],
            &y[1]);
    return tn_buffer_printf(
               r->page.text, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" %s><title>",
               (double)x[0] * scale, (double)y[0] * scale, (double)(x[1] - x[0]) * scale, (double)(y[1] - y[0]) * scale,
               keep ? "fill=\"none\" stroke=\"#777\" stroke-dasharray=\"3 2\"" : "fill=\"#d9cfb8\" stroke=\"#444\"") &&
           tn_page_text(&r->page, tn_text(r->module, box->name)) &&
           tn_page_html(&r->page, keep ? ", kept free</title></rect>\n" : "</title></rect>\n");
}

/* Seen from above, its back at the top. */
static bool put_drawn(const tn_house_reporting *r, const tn_tile_record *tile)
{
    int64_t wide, deep;
    find_room(r, tile, &wide, &deep);
    double high = (double)deep * DRAWN_WIDE / (double)wide;
    bool good = tn_buffer_printf(r->page.text,
                                 "<figure><svg width=\"%d\" height=\"%.0f\" viewBox=\"-2 -2 %d %.2f\" role=\"img\" "
                                 "aria-label=\"the tile from above, its back at the top\">\n<rect x=\"0\" y=\"0\" "
                                 "width=\"%d\" height=\"%.2f\" fill=\"#fff\" stroke=\"#bbb\"/>\n"
                                 "<path d=\"M0 0H%d\" stroke=\"#222\" stroke-width=\"3\"/>\n",
                                 DRAWN_WIDE + 4, high + 4, DRAWN_WIDE + 4, high + 4, DRAWN_WIDE, high, DRAWN_WIDE);
    for (int keeps = 0; good && keeps < 2; keeps++)
        for (uint32_t i = 0; good && i < tile->box_count; i++) {
            const tn_tile_box_record *box = &r->module->TILE_BOX_records[tile->box_first + i];
            if (((box->flags & TN_TILE_KEEP) != 0) == (keeps == 1))
                good = put_box(r, box, wide, deep);
        }
    return good && tn_page_html(&r->page, "</svg></figure>\n");
}

static bool put_tiles(const tn_house_reporting *r)
{
    const tn_form_record *form = r->report->form->record;
    bool good =
        tn_page_html(&r->page, "<h2 id=\"tiles\">Tiles</h2>\n<p>From above, in a room that is large enough. The "
                               "dark line is the back; dashed boxes are kept free.</p>\n<div class=\"cards\">\n");
    for (uint32_t i = 0; good && i < form->tile_count; i++) {
        const tn_tile_record *tile = &r->module->TILE_records[form->tile_first + i];
        good = tn_page_html(&r->page, "<div class=\"card\"><h3>") &&
               tn_page_text(&r->page, tn_text(r->module, tile->name)) && tn_page_html(&r->page, "</h3>\n") &&
               put_drawn(r, tile) && tn_page_html(&r->page, "<details><summary>in words</summary><pre>") &&
               put_source(r, tile->file, tile->begin, tile->end) && tn_page_html(&r->page, "</pre></details></div>\n");
    }
    return good && tn_page_html(&r->page, form->tile_count ? "</div>\n" : "</div>\n<p class=\"quiet\">none</p>\n");
}

/* What the form declares: storeys, functions, openings, faces, and tiles with their boxes. */
static bool house_report_form(const tn_house_reporting *r)
{
    return put_storeys(r) && put_functions(r) && put_openings(r) && put_tiles(r);
}

static bool put_number(const tn_house_reporting *r, const mpz_t number)
{
    char *digits = tn_digits(number, true);
    bool good = digits && tn_page_html(&r->page, digits);
    free(digits);
    return good;
}

/* ---- counts */

static bool put_length(const tn_house_reporting *r, uint32_t length)
{
    const tn_house_report *report = r->report;
    return tn_buffer_printf(r->page.text, "<tr><td>%u</td><td class=\"number\">", length) &&
           put_number(r, report->lengths[length - report->low]) && tn_page_html(&r->page, "</td></tr>\n");
}

static bool put_counts(const tn_house_reporting *r)
{
    const tn_house_report *report = r->report;
    bool good = tn_page_html(&r->page, "<h2 id=\"counts\">Counts</h2>\n");
    if (!report->lengths)
        return good && tn_page_html(&r->page, "<p class=\"quiet\">The houses are not counted: ") &&
               tn_page_text(&r->page, report->limit) && tn_page_html(&r->page, ".</p>\n");
    mpz_t all;
    mpz_init(all);
    for (uint32_t k = report->low; k <= report->high; k++)
        mpz_add(all, all, report->lengths[k - report->low]);
    good = good && tn_page_html(&r->page, "<p><b>") && put_number(r, all) &&
           tn_page_html(
               &r->page,
               "</b> houses.</p>\n<table class=\"words\"><tr><th>trays</th><th class=\"number\">houses</th></tr>\n");
    mpz_clear(all);
    for (uint32_t k = report->low; good && k <= report->high; k++)
        good = put_length(r, k);
    return good && tn_page_html(&r->page, "</table>\n");
}

/* What a clause asks, unless that is the rule that it is called after. */
static bool put_asked(const tn_house_reporting *r, const tn_house_clause_record *record)
{
    const char *text = tn_text(r->module, r->module->SOURCE_records[record->file].text) + record->begin,
               *name = tn_text(r->module, record->name);
    size_t size = record->end - record->begin;
    if (size == strlen(name) && memcmp(text, name, size) == 0)
        return true;
    return tn_page_html(&r->page, "<code>") && tn_page_text_part(&r->page, text, size) &&
           tn_page_html(&r->page, "</code>");
}

static bool put_clause(const tn_house_reporting *r, uint32_t clause)
{
    const tn_house_report *report = r->report;
    const tn_house_clause_record *record = &r->module->HOUSE_CLAUSE_records[report->library->clause_first + clause];
    bool good = tn_page_html(&r->page, "<tr><td>") && tn_page_text(&r->page, tn_text(r->module, record->name)) &&
                tn_page_html(&r->page, "</td><td>") && tn_page_text(&r->page, tn_text(r->module, record->doc)) &&
                tn_page_html(&r->page, "</td><td>") && put_asked(r, record) && tn_page_html(&r->page, "</td>");
    if (good && report->kept_out)
        good = tn_page_html(&r->page, "<td class=\"number\">") && put_number(r, report->kept_out[clause]) &&
               tn_page_html(&r->page, "</td><td class=\"number\">") && put_number(r, report->alone[clause]) &&
               tn_page_html(&r->page, "</td>");
    return good && tn_page_html(&r->page, "</tr>\n");
}

static bool put_clauses(const tn_house_reporting *r)
{
    bool counted = r->report->kept_out != NULL;
    bool good =
        tn_page_html(&r->page, "<h2 id=\"clauses\">Clauses</h2>\n") &&
        (!counted || tn_page_html(&r->page, "<p>Of the houses that the form allows, a clause keeps out so many, "
                                            "and so many of them that no other does.</p>\n")) &&
        tn_page_html(&r->page, "<table class=\"words\"><tr><th>clause</th><th></th><th></th>") &&
        tn_page_html(&r->page, counted ? "<th class=\"number\">keeps out</th><th class=\"number\">it alone</th></tr>\n"
                                       : "</tr>\n");
    for (uint32_t i = 0; good && i < r->report->library->clause_count; i++)
        good = put_clause(r, i);
    return good && tn_page_html(&r->page, "</table>\n");
}

/* ---- houses */

static tn_status put_houses(tn_house_reporting *r)
{
    const tn_house_report *report = r->report;
    bool good =
        tn_page_html(&r->page, "<h2 id=\"houses\">Houses</h2>\n<p class=\"quiet\">") &&
        (report->house_count
             ? tn_buffer_printf(r->page.text, "drawn at random, seed %" PRIu64 "; all to one scale</p>\n", report->seed)
             : tn_page_html(&r->page, "none is shown</p>\n"));
    tn_status status = tn_page_written(&r->page, good);
    if (status == TN_OK && report->house_count > 0)
        status = tn_page_put_gallery(&r->page, report->houses, report->house_count);
    for (size_t i = 0; status == TN_OK && i < report->house_count; i++)
        status = tn_page_put_house(&r->page, &report->houses[i], false);
    return status;
}

/* ---- the page */

/* " (boards 1\", studs 5\")", if it has layers. */
static bool put_layers(const tn_house_reporting *r, tn_layered of)
{
    const tn_house_form *form = r->report->form;
    uint32_t first = tn_form_layers(form, of), end = form->layers_end[of];
    bool good = true;
    for (uint32_t i = first; good && i < end; i++)
        good = tn_page_html(&r->page, i == first ? " (" : ", ") &&
               tn_page_text(&r->page, tn_text(r->module, tn_form_layer(form, i)->name)) &&
               tn_page_html(&r->page, " ") && house_put_length(r, tn_form_layer(form, i)->thick);
    return good && (first == end || tn_page_html(&r->page, ")"));
}

static bool has_party_layers(const tn_house_reporting *r)
{
    const tn_house_form *form = r->report->form;
    return tn_form_layers(form, TN_LAYERED_PARTY) < form->layers_end[TN_LAYERED_PARTY];
}

static bool put_head(const tn_house_reporting *r)
{
    const tn_house_report *report = r->report;
    const tn_form_record *form = report->form->record;
    return tn_page_begin(&r->page, tn_text(r->module, report->library->name),
                         tn_text(r->module, report->library->doc)) &&
           tn_page_params(&r->page, report->opened) && tn_page_html(&r->page, "<p>Houses in the form <b>") &&
           tn_page_text(&r->page, tn_text(r->module, form->name)) &&
           tn_page_html(&r->page, "</b>, on the plans of <b>") &&
           tn_page_text(&r->page, tn_text(r->module, r->module->LIBRARY_records[report->library->plans].name)) &&
           tn_page_html(&r->page, "</b>: walls ") && house_put_length(r, form->wall) &&
           tn_page_html(&r->page, " thick") && put_layers(r, TN_LAYERED_OUTSIDE) &&
           (!has_party_layers(r) ||
            (tn_page_html(&r->page, ", party walls as thick") && put_layers(r, TN_LAYERED_PARTY))) &&
           tn_page_html(&r->page, ", partitions ") && house_put_length(r, form->partition) &&
           put_layers(r, TN_LAYERED_PARTITION) && tn_page_html(&r->page, ", floors ") &&
           house_put_length(r, form->deck) && put_layers(r, TN_LAYERED_DECK) && tn_page_html(&r->page, ", roofs ") &&
           house_put_length(r, form->roof) && put_layers(r, TN_LAYERED_ROOF) &&
           tn_page_html(&r->page, ".</p>\n<nav><a href=\"#houses\">Houses</a> <a href=\"#counts\">Counts</a> "
                                  "<a href=\"#clauses\">Clauses</a> <a href=\"#storeys\">Storeys</a> "
                                  "<a href=\"#functions\">Functions</a> <a href=\"#openings\">Openings</a> "
                                  "<a href=\"#tiles\">Tiles</a> <a href=\"#findings\">Warnings</a></nav>\n");
}

tn_status tn_house_report_page(const tn_house_report *report, tn_buffer *page, tn_error *error)
{
    tn_house_reporting r = {report, report->form->module, {.text = page, .error = error}};
    tn_status status = tn_page_written(&r.page, put_head(&r));
    if (status == TN_OK)
        status = put_houses(&r);
    if (status == TN_OK)
        status = tn_page_written(&r.page, put_counts(&r) && put_clauses(&r));
    return status == TN_OK
               ? tn_page_written(&r.page, house_report_form(&r) && tn_page_findings(&r.page, report->opened) &&
                                              tn_page_html(&r.page, "<p class=\"quiet\">") &&
                                              tn_page_version(&r.page, r.module) &&
                                              tn_page_html(&r.page, "</p>\n</html>\n"))
               : status;
}
