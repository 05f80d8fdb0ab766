/* Writes the report of a library: the page, its counts and its warnings. */
#include "driver/report/report.h"

#include <stdlib.h>

#include "driver/report/report_data.h"

/* ---- counts */

static tn_status put_chart(const tn_reporting *r)
{
    const tn_library *library = r->ready->library;
    uint32_t low = tn_library_min(library), high = tn_library_max(library);
    if (low > high)
        return TN_OK;
    size_t count = (size_t)high - low + 1;
    mpz_t *generated = malloc(sizeof *generated * count), *kept = malloc(sizeof *kept * count);
    if (!generated || !kept) {
        free(generated);
        free(kept);
        return tn_fail_memory(r->page.error);
    }
    tn_status status = TN_OK;
    for (size_t i = 0; i < count; i++)
        mpz_inits(generated[i], kept[i], NULL);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        tn_library_kept(library, low + (uint32_t)i, kept[i]);
        status = tn_library_generated(library, low + (uint32_t)i, generated[i], r->page.error);
    }
    if (status == TN_OK)
        status =
            tn_page_written(&r->page, tn_report_chart(r, low, (const mpz_t *)generated, (const mpz_t *)kept, count));
    for (size_t i = 0; i < count; i++)
        mpz_clears(generated[i], kept[i], NULL);
    free(generated);
    free(kept);
    return status;
}

/* "12 plans generated, 5 kept" */
static tn_status put_totals(const tn_reporting *r)
{
    mpz_t generated, kept;
    mpz_inits(generated, kept, NULL);
    tn_status status = tn_library_generated(r->ready->library, TN_ALL_LENGTHS, generated, r->page.error);
    tn_library_kept(r->ready->library, TN_ALL_LENGTHS, kept);
    if (status == TN_OK)
        status = tn_page_written(
            &r->page, tn_page_html(&r->page, "<h2 id=\"counts\">Counts</h2>\n<p>") && tn_report_number(r, generated) &&
                          tn_page_html(&r->page, " plans generated, <b>") && tn_report_number(r, kept) &&
                          tn_page_html(&r->page, "</b> kept (") && tn_report_share(r, kept, generated) &&
                          tn_page_html(&r->page, ").</p>\n"));
    mpz_clears(generated, kept, NULL);
    return status;
}

/* ---- the page */

static bool put_head(const tn_reporting *r)
{
    return tn_page_begin(&r->page, tn_text(r->module, r->ready->record->name),
                         tn_text(r->module, r->ready->record->doc)) &&
           tn_page_params(&r->page, r->opened) &&
           tn_page_html(
               &r->page,
               "<nav><a href=\"#counts\">Counts</a> <a href=\"#findings\">Warnings</a> <a "
               "href=\"#measures\">Measures</a> <a href=\"#rules\">Rules</a> <a href=\"#plans\">Plans</a></nav>\n");
}

static bool put_foot(const tn_reporting *r)
{
    const tn_module *module = r->module;
    char hash[33];
    tn_library_hash(r->ready->library, hash);
    return tn_buffer_printf(r->page.text, "<p class=\"quiet\">library %s, seed %llu, ", hash,
                            (unsigned long long)r->options->seed) &&
           tn_page_version(&r->page, module) && tn_page_html(&r->page, "</p>\n") &&
           tn_page_html(&r->page, tn_report_foot) && tn_page_html(&r->page, "</html>\n");
}

tn_status tn_report_page(tn_opened *opened, const tn_ready_library *ready, const tn_plan_analyses *analyses,
                         const tn_covered *covered, const tn_report_options *options, tn_buffer *page, tn_error *error)
{
    tn_reporting r = {opened, ready, opened->module, analyses, covered, options, {.text = page, .error = error}};
    tn_status status = tn_page_written(&r.page, put_head(&r));
    if (status == TN_OK)
        status = put_totals(&r);
    if (status == TN_OK)
        status = put_chart(&r);
    if (status == TN_OK)
        status = tn_page_written(&r.page, tn_page_findings(&r.page, opened));
    if (status == TN_OK)
        status = tn_report_measures(&r);
    if (status == TN_OK)
        status = tn_report_rules(&r);
    if (status == TN_OK)
        status = tn_report_plans(&r);
    return status == TN_OK ? tn_page_written(&r.page, tn_page_limits(&r.page, opened) && put_foot(&r)) : status;
}
