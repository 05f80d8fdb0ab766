/* The measures of a report: for each a histogram, and the plans that have the least and the most of it. */
#include <stdlib.h>

#include "driver/measure/spread.h"
#include "driver/report/report_data.h"
#include "runtime/plan/measure/best.h"
#include "runtime/plan/measure/named.h"

enum { SHOWN = 5 };

/* The picture says what the measure is of. */
static bool put_title(const tn_reporting *r, uint32_t measure)
{
    const char *name = tn_named_measure(r->module, measure);
    return tn_page_html(&r->page, "<section class=\"card measure\" id=\"measure-") && tn_page_text(&r->page, name) &&
           tn_page_html(&r->page, "\"><h3>") && tn_page_text(&r->page, name) && tn_page_html(&r->page, "</h3>\n");
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

static tn_status put_plan(tn_reporting *r, const tn_spread *spread, const tn_tray *trays, uint32_t length,
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

static tn_status put_plans(tn_reporting *r, const tn_spread *spread, tn_best *best)
{
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(r->ready->library) + 1));
    tn_status status = trays ? TN_OK : tn_fail_memory(r->page.error);
    bool found = true;
    for (int i = 0; status == TN_OK && found && i < SHOWN; i++) {
        int64_t values[TN_WEIGHED_MAX];
        uint32_t length;
        status = tn_best_next(best, trays, &length, values, &found, r->page.error);
        if (status == TN_OK && found)
            status = put_plan(r, spread, trays, length, values);
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
        status = put_plans(r, spread, best);
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
static tn_status put_measure(tn_reporting *r, uint32_t measure)
{
    tn_spread spread;
    size_t before = r->page.text->size;
    tn_status status = tn_page_written(&r->page, put_title(r, measure));
    if (status != TN_OK)
        return status;
    status = tn_spread_make(&spread, r->ready, measure, r->page.error);
    if (status == TN_OK)
        status = put_spread(r, &spread);
    tn_spread_clear(&spread);
    if (status == TN_LIMIT) {
        r->page.text->size = before;
        status = tn_page_written(
            &r->page, put_title(r, measure) && tn_page_html(&r->page, "<p class=\"quiet\">not worked out: ") &&
                          tn_page_prose(&r->page, r->page.error->message) && tn_page_html(&r->page, "</p>\n"));
    }
    return status == TN_OK ? tn_page_written(&r->page, tn_page_html(&r->page, "</section>\n")) : status;
}

tn_status tn_report_measures(tn_reporting *r)
{
    tn_status status = tn_page_written(&r->page, tn_page_html(&r->page, "<h2 id=\"measures\">Measures</h2>\n"));
    bool any = false;
    for (uint32_t i = TN_NO_RECORD; status == TN_OK && tn_named_measure_next(r->module, r->ready->record, &i);) {
        status = put_measure(r, i);
        any = true;
    }
    if (status == TN_OK && !any)
        status =
            tn_page_written(&r->page, tn_page_html(&r->page, "<p class=\"quiet\">The file has no measures.</p>\n"));
    return status;
}
