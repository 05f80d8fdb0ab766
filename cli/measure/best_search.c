/* Finds the best plans of a library by measures, and puts them onto a sheet. */
#include "cli/measure/best_search.h"

#include <stdlib.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "driver/open/digits.h"
#include "runtime/plan/library/ranking.h"

bool tn_best_search_open(tn_best_search *search, tn_job *job, const tn_ready_library *ready,
                         const tn_option_list *wanted)
{
    tn_error error;
    *search = (tn_best_search){.job = job, .ready = ready};
    if (!tn_wishes_read(job, ready, wanted, 1, &search->wishes))
        return false;
    const tn_wishes *wishes = &search->wishes;
    tn_status status = tn_weighed_new(ready->library, wishes->measures, wishes->count, &search->weighed, &error);
    if (status == TN_OK)
        status = tn_best_new(search->weighed, wishes->most, &search->best, &error);
    tn_job_show(job);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

void tn_best_search_close(tn_best_search *search)
{
    tn_best_free(search->best);
    tn_weighed_free(search->weighed);
}

void tn_best_search_give(tn_best_search *search, uint64_t count, bool mirror, tn_best_take *take, void *to)
{
    const tn_library *library = search->ready->library;
    tn_error error;
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(library) + 1));
    tn_ranking *ranking = NULL;
    tn_status status = trays ? tn_ranking_new(library, &ranking, &error) : tn_fail_memory(&error);
    bool found = true;
    tn_progress progress;
    tn_progress_watch(&progress, "looking for the best", tn_interrupt_waiting());
    for (uint64_t given = 0; status == TN_OK && found && given < count;) {
        int64_t values[TN_WEIGHED_MAX];
        uint32_t length;
        status = tn_best_next(search->best, trays, &length, values, &found, &error);
        if (given == 0) /* the first takes longest; from then on lines are written */
            tn_progress_unwatch(&progress, tn_interrupt_waiting());
        if (status != TN_OK || !found || (mirror && !tn_library_mirror_first(library, trays, length)))
            continue;
        status = take(to, &(tn_best_plan){trays, length, values, tn_ranking_next(ranking, trays, length)}, &error);
        given++;
    }
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    if (status != TN_OK)
        tn_job_fail(search->job, &error);
    tn_ranking_free(ranking);
    free(trays);
}

static const char *measure_name(const tn_best_search *search, uint32_t k)
{
    const tn_module *module = search->ready->schema->module;
    return tn_text(module, module->MEASURE_records[search->wishes.measures[k]].name);
}

typedef struct drawing {
    const tn_best_search *search;
    tn_plan_sheet *sheet;
} drawing;

/* "3.  cost 87,880, area 304 ft2" */
static tn_status add_to_sheet(void *to, const tn_best_plan *plan, tn_error *error)
{
    const drawing *d = to;
    const tn_wishes *wishes = &d->search->wishes;
    tn_buffer caption = {0};
    bool ok = tn_buffer_printf(&caption, "%zu.  ", d->sheet->count + 1);
    for (uint32_t k = 0; ok && k < wishes->count; k++)
        ok = tn_buffer_printf(&caption, "%s%s ", k ? ", " : "", measure_name(d->search, k)) &&
             tn_wishes_text(wishes, d->search->weighed, k, plan->values[k], &caption);
    if (ok)
        return tn_sheet_add(d->sheet, plan->trays, plan->length, mpz_get_str(NULL, 10, plan->rank), NULL, caption.data,
                            error);
    free(caption.data);
    return tn_fail_memory(error);
}

void tn_best_search_sheet(tn_best_search *search, uint64_t count, bool mirror, tn_plan_sheet *sheet)
{
    drawing d = {search, sheet};
    tn_best_search_give(search, count, mirror, add_to_sheet, &d);
}

bool tn_best_search_aim(const tn_best_search *search, size_t count, char *note, size_t size)
{
    const tn_wishes *wishes = &search->wishes;
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(search->ready->library, TN_ALL_LENGTHS, kept);
    char *digits = tn_digits(kept, true);
    tn_buffer text = {0};
    bool ok = digits && tn_buffer_printf(&text, "the %zu of %s plans with the ", count, digits);
    for (uint32_t k = 0; ok && k < wishes->count; k++)
        ok = tn_buffer_printf(&text, "%s%s %s", k ? ", then the " : "", wishes->most[k] ? "most" : "least",
                              measure_name(search, k));
    if (ok)
        snprintf(note, size, "%s", text.data);
    free(text.data);
    free(digits);
    mpz_clear(kept);
    return ok;
}
