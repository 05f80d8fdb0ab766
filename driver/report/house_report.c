/* Writes the report of a library of houses: the page, its counts, its clauses and some of its houses. */
#include "driver/report/house_report.h"

#include <inttypes.h>
#include <stdlib.h>

#include "driver/open/digits.h"
#include "driver/report/house_data.h"
#include "runtime/house/picture/draw.h"

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
           tn_page_html(&r->page, "</b> houses.</p>\n<table class=\"words\"><tr><th>trays</th><th>houses</th></tr>\n");
    mpz_clear(all);
    for (uint32_t k = report->low; good && k <= report->high; k++)
        good = put_length(r, k);
    return good && tn_page_html(&r->page, "</table>\n");
}

static bool put_clause(const tn_house_reporting *r, uint32_t clause)
{
    const tn_house_report *report = r->report;
    const tn_house_clause_record *record = &r->module->HOUSE_CLAUSE_records[report->library->clause_first + clause];
    const char *text = tn_text(r->module, r->module->SOURCE_records[record->file].text);
    bool good = tn_page_html(&r->page, "<tr><td>") && tn_page_text(&r->page, tn_text(r->module, record->name)) &&
                tn_page_html(&r->page, "</td><td>") && tn_page_text(&r->page, tn_text(r->module, record->doc)) &&
                tn_page_html(&r->page, "</td><td><code>") &&
                tn_page_text_part(&r->page, text + record->begin, record->end - record->begin) &&
                tn_page_html(&r->page, "</code></td>");
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
        tn_page_html(&r->page, counted ? "<th>keeps out</th><th>it alone</th></tr>\n" : "</tr>\n");
    for (uint32_t i = 0; good && i < r->report->library->clause_count; i++)
        good = put_clause(r, i);
    return good && tn_page_html(&r->page, "</table>\n");
}

/* ---- houses */

static tn_status put_line(tn_house_reporting *r, const tn_reported_house *reported)
{
    tn_buffer line = {0};
    tn_status status = tn_house_write(&reported->house, &line, r->page.error);
    if (status == TN_OK)
        status = tn_page_written(&r->page, tn_page_html(&r->page, "<p class=\"line\">") &&
                                               tn_page_text(&r->page, reported->name) && tn_page_html(&r->page, "  ") &&
                                               tn_page_text_part(&r->page, line.data, line.size) &&
                                               tn_page_html(&r->page, "</p>\n"));
    free(line.data);
    return status;
}

/* All to one scale. */
static tn_status draw_houses(tn_house_reporting *r)
{
    const tn_house_report *report = r->report;
    tn_pictured_house *pictured = calloc(report->house_count, sizeof *pictured);
    if (!pictured)
        return tn_fail_memory(r->page.error);
    for (size_t i = 0; i < report->house_count; i++)
        pictured[i] =
            (tn_pictured_house){&report->houses[i].house, &report->houses[i].solids, report->houses[i].name, ""};
    const tn_house_gallery gallery = {
        .houses = pictured, .count = report->house_count, .camera = {60, 30, 480}}; /* from the front */
    tn_picture picture = tn_page_next_picture(&r->page);
    tn_status status = tn_page_put_picture(&r->page, &picture, "houses of the library",
                                           tn_house_gallery_draw(&gallery, &picture, r->page.error));
    free(pictured);
    return status;
}

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
        status = draw_houses(r);
    for (size_t i = 0; status == TN_OK && i < report->house_count; i++)
        status = put_line(r, &report->houses[i]);
    return status;
}

/* ---- the page */

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
           tn_page_html(&r->page, "</b>: walls ") && tn_house_put_length(r, form->wall) &&
           tn_page_html(&r->page, " thick, partitions ") && tn_house_put_length(r, form->partition) &&
           tn_page_html(&r->page, ", decks ") && tn_house_put_length(r, form->deck) &&
           tn_page_html(&r->page, ", roofs ") && tn_house_put_length(r, form->roof) &&
           tn_page_html(&r->page, ".</p>\n<nav><a href=\"#counts\">Counts</a> <a href=\"#clauses\">Clauses</a> "
                                  "<a href=\"#houses\">Houses</a> <a href=\"#storeys\">Storeys</a> "
                                  "<a href=\"#functions\">Functions</a> <a href=\"#openings\">Openings</a> "
                                  "<a href=\"#tiles\">Tiles</a> <a href=\"#findings\">Warnings</a></nav>\n");
}

tn_status tn_house_report_page(const tn_house_report *report, tn_buffer *page, tn_error *error)
{
    tn_house_reporting r = {report, report->form->module, {.text = page, .error = error}};
    tn_status status = tn_page_written(&r.page, put_head(&r) && put_counts(&r) && put_clauses(&r));
    if (status == TN_OK)
        status = put_houses(&r);
    return status == TN_OK
               ? tn_page_written(&r.page, tn_house_report_form(&r) && tn_page_findings(&r.page, report->opened) &&
                                              tn_page_html(&r.page, "<p class=\"quiet\">") &&
                                              tn_page_version(&r.page, r.module) &&
                                              tn_page_html(&r.page, "</p>\n</html>\n"))
               : status;
}
