/* The measures of a report: what a library's plans come to, as a table, and each measure with its histogram and the
 * plans with the least and the most of it. */
#include <stdlib.h>

#include "driver/measure/spread.h"
#include "driver/report/reporting.h"
#include "runtime/base/array.h"
#include "runtime/plan/measure/best.h"
#include "runtime/plan/measure/named.h"

enum { SHOWN = 5 };

/* The picture has the measure's name, and says what it is of. */
static bool put_title(const tn_reporting *r, const tn_reported_measure *measure)
{
    const char *name = tn_named_measure(r->module, measure->measure);
    bool good = tn_page_html(&r->page, "<section class=\"card measure\" id=\"measure-") &&
                tn_page_text(&r->page, name) && tn_page_html(&r->page, "\" aria-label=\"") &&
                tn_page_text(&r->page, name) && tn_page_html(&r->page, "\">\n");
    return good && (!measure->limit || (tn_page_html(&r->page, "<h3>") && tn_page_text(&r->page, name) &&
                                        tn_page_html(&r->page, "</h3>\n")));
}

/* ---- the plans with the least or the most */

static bool put_value(const tn_reporting *r, const tn_spread *spread, const int64_t *values, const mpz_t rank)
{
    tn_buffer text = {0};
    mpq_t value;
    mpq_init(value);
    tn_weighed_value(spread->weighed, 0, values, value);
    bool good = tn_amount_write(spread->bins.unit, value, &text) && tn_page_html(&r->page, "<div><p><b>") &&
                tn_page_text(&r->page, text.data) && tn_page_html(&r->page, "</b>, rank ") &&
                tn_report_number(r, rank) && tn_page_html(&r->page, "</p>\n");
    mpq_clear(value);
    free(text.data);
    return good;
}

static tn_status put_best_plan(tn_reporting *r, const tn_spread *spread, const tn_tray *trays, uint32_t length,
                               const int64_t *values)
{
    mpz_t rank;
    mpz_init(rank);
    tn_library_rank(r->ready->library, trays, length, rank);
    tn_status status = tn_page_written(&r->page, put_value(r, spread, values, rank));
    mpz_clear(rank);
    if (status == TN_OK)
        status = tn_report_put_plan(r, trays, length, "one of the best plans by a measure");
    if (status != TN_OK)
        return status;
    return tn_page_written(&r->page, tn_page_html(&r->page, "<p class=\"line\">") && tn_report_plan(r, trays, length) &&
                                         tn_page_html(&r->page, "</p></div>\n"));
}

static tn_status put_best_plans(tn_reporting *r, const tn_spread *spread, tn_best *best)
{
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(r->ready->library) + 1));
    tn_status status = trays ? TN_OK : tn_fail_memory(r->page.error);
    bool found = true;
    for (int i = 0; status == TN_OK && found && i < SHOWN; i++) {
        int64_t values[TN_WEIGHED_MAX];
        uint32_t length;
        status = tn_best_next(best, trays, &length, values, &found, r->page.error);
        if (status == TN_OK && found)
            status = put_best_plan(r, spread, trays, length, values);
    }
    free(trays);
    return status;
}

static tn_status put_best(tn_reporting *r, const tn_spread *spread, bool most)
{
    tn_best *best = NULL;
    tn_status status = tn_best_new(spread->weighed, &most, &best, r->page.error);
    if (status == TN_OK)
        status =
            tn_page_written(&r->page, tn_page_html(&r->page, most ? "<details><summary>the plans with the most"
                                                                  : "<details><summary>the plans with the least") &&
                                          tn_page_html(&r->page, "</summary>\n<div class=\"best\">\n"));
    if (status == TN_OK)
        status = put_best_plans(r, spread, best);
    tn_best_free(best);
    return status == TN_OK ? tn_page_written(&r->page, tn_page_html(&r->page, "</div></details>\n")) : status;
}

/* ---- one measure */

static tn_status put_spread(tn_reporting *r, tn_spread *spread)
{
    tn_picture picture = tn_page_next_picture(&r->page);
    if (spread->d.count > TN_VALUES_LISTED)
        tn_bins_few(&spread->bins, TN_BINS_DEFAULT);
    tn_status status = tn_spread_draw(spread, &picture, r->page.error);
    status = tn_page_put_picture(&r->page, &picture, "how the plans are spread over the measure", status);
    if (status == TN_OK && spread->d.count > 0)
        status = put_best(r, spread, false);
    if (status == TN_OK && spread->d.count > 0)
        status = put_best(r, spread, true);
    return status;
}

/* A measure past a limit is not shown, and why is told. */
static tn_status put_measure(tn_reporting *r, tn_reported_measure *measure)
{
    tn_status status = tn_page_written(&r->page, put_title(r, measure));
    if (status == TN_OK && measure->limit)
        status =
            tn_page_written(&r->page, tn_page_html(&r->page, "<p class=\"quiet\">not worked out: ") &&
                                          tn_page_prose(&r->page, measure->limit) && tn_page_html(&r->page, "</p>\n"));
    else if (status == TN_OK)
        status = put_spread(r, &measure->spread);
    return status == TN_OK ? tn_page_written(&r->page, tn_page_html(&r->page, "</section>\n")) : status;
}

tn_status tn_report_measures(tn_reporting *r, const tn_reported_measures *measures)
{
    if (measures->count == 0)
        return TN_OK;
    tn_status status = tn_page_written(&r->page, tn_page_html(&r->page, "<h2 id=\"measures\">Measures</h2>\n"));
    for (size_t i = 0; status == TN_OK && i < measures->count; i++)
        status = put_measure(r, &measures->items[i]);
    return status;
}

/* ---- all measures */

static tn_status add_measure(const tn_reporting *r, uint32_t number, tn_reported_measures *measures)
{
    if (!tn_array_reserve_from(&measures->items, &measures->room, 8, measures->count, 1, sizeof *measures->items))
        return tn_fail_memory(r->page.error);
    tn_reported_measure *added = &measures->items[measures->count++];
    *added = (tn_reported_measure){.measure = number};
    tn_status status = tn_spread_make(&added->spread, r->ready, number, r->page.error);
    if (status == TN_OK)
        status = tn_spread_show(&added->spread, r->page.error);
    if (status != TN_LIMIT)
        return status;
    added->limit = strdup(r->page.error->message);
    return added->limit ? TN_OK : tn_fail_memory(r->page.error);
}

tn_status tn_reported_measures_make(const tn_reporting *r, tn_reported_measures *measures)
{
    tn_status status = TN_OK;
    for (uint32_t i = TN_NO_RECORD; status == TN_OK && tn_named_measure_next(r->module, r->ready->record, &i);)
        status = add_measure(r, i, measures);
    return status;
}

void tn_reported_measures_clear(tn_reported_measures *measures)
{
    for (size_t i = 0; i < measures->count; i++) {
        tn_spread_clear(&measures->items[i].spread);
        free(measures->items[i].limit);
    }
    free(measures->items);
}

/* ---- as a table */

static bool put_figure(const tn_reporting *r, const tn_reported_measure *measure)
{
    static const size_t shown[] = {0, 2, 4, 5}; /* least, half, most, mean */
    const char *name = tn_named_measure(r->module, measure->measure);
    bool good =
        tn_page_html(&r->page, "<tr><td><a href=\"#measure-") && tn_page_text(&r->page, name) &&
        tn_page_html(&r->page, "\">") && tn_page_text(&r->page, name) && tn_page_html(&r->page, "</a></td><td>") &&
        tn_page_text(&r->page, tn_named_measure_doc(r->module, measure->measure)) && tn_page_html(&r->page, "</td>");
    for (size_t i = 0; good && i < sizeof shown / sizeof *shown; i++) {
        const char *fact = measure->limit ? NULL : measure->spread.facts[shown[i]];
        good = tn_page_html(&r->page, "<td class=\"number\">") &&
               tn_page_text(&r->page, fact ? fact : "\xe2\x80\x93") && tn_page_html(&r->page, "</td>");
    }
    return good && tn_page_html(&r->page, "</tr>\n");
}

bool tn_report_figures(const tn_reporting *r, const tn_reported_measures *measures)
{
    bool good = measures->count == 0 ||
                tn_page_html(&r->page, "<table class=\"words figures\"><tr><th>measure</th><th></th><th>least</th>"
                                       "<th>half have at most</th><th>most</th><th>mean</th></tr>\n");
    for (size_t i = 0; good && i < measures->count; i++)
        good = put_figure(r, &measures->items[i]);
    return good && (measures->count == 0 || tn_page_html(&r->page, "</table>\n"));
}
