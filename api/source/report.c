/* The C interface to reports: a library as one HTML page. */
#include <stdlib.h>

#include "api/source/source.h"
#include "driver/report/report.h"

enum { SAMPLES_DEFAULT = 24, SAMPLES_MOST = 2000 };

/* Analyses, measures and writes, as `tartan report` does. */
static tn_status write_page(tn_opened *opened, const char *library, const tn_report_options *options, tn_buffer *page)
{
    tn_ready_library ready = {0};
    tn_plan_analyses analyses = {0};
    tn_covered covered = {0};
    tn_error error;
    const tn_library_options opening = {.max_states = options->max_states};
    tn_status status = tn_library_ready(opened, library, &opening, &ready);
    if (status == TN_OK) {
        const tn_plan_analysis_options analysis = {.max_states = options->max_states, .library = ready.library};
        status = tn_plan_analyse(opened, &analysis, &analyses);
    }
    if (status == TN_OK) {
        const tn_coverage_options coverage = {.library = tn_text(opened->module, ready.record->name),
                                              .max_states = options->max_states,
                                              .imported = true};
        status = tn_coverage_measure(opened, &coverage, &covered);
    }
    if (status == TN_OK) {
        status = tn_report_page(opened, &ready, &analyses, &covered, options, page, &error);
        if (status != TN_OK)
            tn_finding_error(opened, &error);
    }
    tn_covered_clear(&covered);
    tn_plan_analyses_free(&analyses);
    tn_library_close(&ready);
    return status;
}

tartan_status tartan_source_report(tartan_source *source, const tartan_report_options *given, const tartan_watch *watch,
                                   char **page, size_t *size, tartan_error *error)
{
    tartan_report_options options;
    tn_api_work work;
    tn_buffer made = {0};
    if (!page || !size)
        return tn_api_missing(error, "room for the page");
    tartan_status status = TN_API_TAKE(tartan_report_options, &options, given, error);
    if (status == TARTAN_OK && options.samples > SAMPLES_MOST)
        status = tn_api_refuse(error, TARTAN_LIMIT, "a report shows at most %d plans", SAMPLES_MOST);
    if (status == TARTAN_OK)
        status = tn_api_source_begin(source, watch, &work, error);
    if (status != TARTAN_OK)
        return status;
    const tn_report_options own = {.seed = options.seed,
                                   .samples = options.samples ? options.samples : SAMPLES_DEFAULT,
                                   .max_states = options.max_states};
    status = tn_api_source_end(&work, write_page(&source->opened, options.library, &own, &made), error);
    if (status == TARTAN_OK) {
        *page = made.data;
        *size = made.size;
    } else {
        free(made.data);
    }
    return status;
}
