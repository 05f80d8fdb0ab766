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
        return tn_fail_memory(r->error);
    }
    tn_status status = TN_OK;
    for (size_t i = 0; i < count; i++)
        mpz_inits(generated[i], kept[i], NULL);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        tn_library_kept(library, low + (uint32_t)i, kept[i]);
        status = tn_library_generated(library, low + (uint32_t)i, generated[i], r->error);
    }
    if (status == TN_OK)
        status = tn_report_written(r, tn_report_chart(r, low, (const mpz_t *)generated, (const mpz_t *)kept, count));
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
    tn_status status = tn_library_generated(r->ready->library, TN_ALL_LENGTHS, generated, r->error);
    tn_library_kept(r->ready->library, TN_ALL_LENGTHS, kept);
    if (status == TN_OK)
        status =
            tn_report_written(r, tn_report_html(r, "<h2 id=\"counts\">Counts</h2>\n<p>") &&
                                     tn_report_number(r, generated) && tn_report_html(r, " plans generated, <b>") &&
                                     tn_report_number(r, kept) && tn_report_html(r, "</b> kept (") &&
                                     tn_report_share(r, kept, generated) && tn_report_html(r, ").</p>\n"));
    mpz_clears(generated, kept, NULL);
    return status;
}

/* ---- findings */

/* "houses.plan:12: " */
static bool put_place(const tn_reporting *r, bool has_span, tn_span span)
{
    if (!has_span)
        return true;
    tn_place where = tn_sources_place(&r->opened->compilation.sources, span);
    const char *slash = strrchr(where.path, '/');
    return tn_report_text(r, slash ? slash + 1 : where.path) &&
           tn_buffer_printf(r->page, ":%u: ", (unsigned)where.line);
}

/* A finding with its notes: what checking says at the terminal. */
static bool put_finding(const tn_reporting *r, const tn_diagnostic *item)
{
    char code[8] = "";
    if (item->code != TN_CODE_NONE)
        tn_code_name(item->code, code);
    bool good = tn_report_html(r, "<div class=\"card\"><p>") && put_place(r, item->has_span, item->span) &&
                (!*code || (tn_report_text(r, code) && tn_report_html(r, ": "))) && tn_report_prose(r, item->message) &&
                tn_report_html(r, "</p>\n");
    for (size_t n = 0; good && n < item->note_count; n++)
        good = tn_report_html(r, "<p class=\"quiet\">") && put_place(r, item->notes[n].has_span, item->notes[n].span) &&
               tn_report_prose(r, item->notes[n].text ? item->notes[n].text : "") && tn_report_html(r, "</p>\n");
    if (good && item->help)
        good = tn_report_html(r, "<p>") && tn_report_prose(r, item->help) && tn_report_html(r, "</p>\n");
    return good && tn_report_html(r, "</div>\n");
}

/* The warnings of checking, and its notes but for limits. */
static bool put_findings(const tn_reporting *r)
{
    tn_diagnostics *found = &r->opened->compilation.diagnostics;
    bool good = tn_report_html(r, "<h2 id=\"findings\">Warnings</h2>\n"), any = false;
    tn_diagnostics_sort(found);
    for (size_t i = 0; good && i < found->count; i++) {
        const tn_diagnostic *item = &found->items[i];
        if ((item->severity != TN_WARNING && item->severity != TN_NOTE) || item->limit || !item->message)
            continue;
        good = put_finding(r, item);
        any = true;
    }
    return good && (any || tn_report_html(r, "<p class=\"quiet\"><code>tartan check</code> has no warnings.</p>\n"));
}

/* ---- limits */

/* Has an earlier limit the same place? Then it has the same cause. */
static bool is_told(const tn_diagnostics *found, size_t i)
{
    const tn_diagnostic *item = &found->items[i];
    for (size_t k = 0; k < i; k++) {
        const tn_diagnostic *other = &found->items[k];
        if (other->limit && other->has_span && item->has_span &&
            memcmp(&other->span, &item->span, sizeof item->span) == 0)
            return true;
    }
    return false;
}

static bool put_limit(const tn_reporting *r, const tn_diagnostic *item)
{
    bool good =
        tn_report_html(r, "<li>") && put_place(r, item->has_span, item->span) && tn_report_prose(r, item->message);
    for (size_t n = 0; good && n < item->note_count; n++)
        good = tn_report_html(r, n ? ", " : " (") && tn_report_prose(r, item->notes[n].text ? item->notes[n].text : "");
    good = good && (item->note_count == 0 || tn_report_html(r, ")"));
    if (good && item->help)
        good = tn_report_html(r, "<br><span class=\"quiet\">") && tn_report_prose(r, item->help) &&
               tn_report_html(r, "</span>");
    return good && tn_report_html(r, "</li>\n");
}

/* What was not found out: below everything else, each limit once. */
static bool put_limits(const tn_reporting *r)
{
    tn_diagnostics *found = &r->opened->compilation.diagnostics;
    bool good = true, any = false;
    tn_diagnostics_sort(found);
    for (size_t i = 0; good && i < found->count; i++) {
        const tn_diagnostic *item = &found->items[i];
        if (!item->limit || !item->message || is_told(found, i))
            continue;
        if (!any)
            good = tn_report_html(r, "<h2 id=\"limits\">What was not found out</h2>\n<ul>\n");
        good = good && put_limit(r, item);
        any = true;
    }
    return good && (!any || tn_report_html(r, "</ul>\n"));
}

/* ---- the page */

static bool put_head(const tn_reporting *r)
{
    const char *name = tn_text(r->module, r->ready->record->name), *doc = tn_text(r->module, r->ready->record->doc);
    return tn_report_html(r, "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>") &&
           tn_report_text(r, name) && tn_report_html(r, "</title>\n") && tn_report_html(r, tn_report_head) &&
           tn_report_html(r, "<h1>") && tn_report_text(r, name) && tn_report_html(r, "</h1>\n<p>") &&
           tn_report_text(r, doc) &&
           tn_report_html(
               r, "</p>\n<nav><a href=\"#counts\">Counts</a> <a href=\"#findings\">Warnings</a> <a "
                  "href=\"#measures\">Measures</a> <a href=\"#rules\">Rules</a> <a href=\"#plans\">Plans</a></nav>\n");
}

static bool put_foot(const tn_reporting *r)
{
    const tn_module *module = r->module;
    char hash[33];
    tn_library_hash(r->ready->library, hash);
    return tn_buffer_printf(r->page, "<p class=\"quiet\">library %s, seed %llu, ", hash,
                            (unsigned long long)r->options->seed) &&
           tn_report_text(r, module->PRODUCER_count ? tn_text(module, module->PRODUCER_records[0].version) : "") &&
           tn_report_html(r, "</p>\n") && tn_report_html(r, tn_report_foot) && tn_report_html(r, "</html>\n");
}

tn_status tn_report_page(tn_opened *opened, const tn_ready_library *ready, const tn_plan_analyses *analyses,
                         const tn_covered *covered, const tn_report_options *options, tn_buffer *page, tn_error *error)
{
    tn_reporting r = {opened, ready, opened->module, analyses, covered, options, page, 0, error};
    tn_status status = tn_report_written(&r, put_head(&r));
    if (status == TN_OK)
        status = put_totals(&r);
    if (status == TN_OK)
        status = put_chart(&r);
    if (status == TN_OK)
        status = tn_report_written(&r, put_findings(&r));
    if (status == TN_OK)
        status = tn_report_measures(&r);
    if (status == TN_OK)
        status = tn_report_rules(&r);
    if (status == TN_OK)
        status = tn_report_plans(&r);
    return status == TN_OK ? tn_report_written(&r, put_limits(&r) && put_foot(&r)) : status;
}
