/* Lists the houses of a library in the order of their ranks: plan by plan, each plan's houses one after another. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/house/numbered_parts.h"

typedef struct house_list {
    const tn_house_range *range;
    mpz_t next;   /* the rank of the next house to be written */
    mpz_t to;     /* one past the last, where `bounded` */
    mpz_t before; /* houses on the plans before */
    bool bounded;
    uint64_t written;
    FILE *out;
    tn_buffer line;
    tn_progress progress;
} house_list;

static bool is_done(const house_list *list)
{
    return (list->range->limited && list->written >= list->range->limit) ||
           (list->bounded && mpz_cmp(list->next, list->to) >= 0) || tn_interrupted();
}

static tn_status write_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    house_list *list = context;
    list->line.size = 0;
    tn_status status = tn_house_write(house, &list->line, error);
    if (status == TN_OK && !tn_buffer_append(&list->line, "\n", 1))
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    fwrite(list->line.data, 1, list->line.size, list->out);
    mpz_add_ui(list->next, list->next, 1);
    tn_progress_update(&list->progress, (double)++list->written);
    *stop = is_done(list);
    return TN_OK;
}

/* Writes the houses on a plan that are asked for. */
static tn_status list_plan(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                           tn_error *error)
{
    house_list *list = context;
    tn_house_counts counts;
    mpz_t variant;
    mpz_init(variant);
    tn_house_counts_init(&counts);
    tn_status status = tn_house_variants_count(n->variants, trays, length, &counts, error);
    mpz_add(counts.houses, counts.houses, list->before); /* those up to the end of this plan */
    if (status == TN_OK && !is_done(list) && mpz_cmp(list->next, counts.houses) < 0) {
        mpz_sub(variant, list->next, list->before);
        status = tn_house_variants_each(n->variants, trays, length, variant, write_house, list, error);
    }
    mpz_set(list->before, counts.houses);
    *stop = is_done(list);
    tn_house_counts_clear(&counts);
    mpz_clear(variant);
    return status;
}

static bool begin(tn_job *job, house_list *list, const tn_house_range *range)
{
    *list = (house_list){.range = range, .bounded = range->to != NULL};
    mpz_inits(list->next, list->to, list->before, NULL);
    if (range->from)
        mpz_set_str(list->next, range->from, 10);
    if (range->to)
        mpz_set_str(list->to, range->to, 10);
    if (!list->bounded || mpz_cmp(list->next, list->to) <= 0)
        return true;
    tn_diagnostic *d = tn_job_usage(job, "no rank is from %.60s on and before %.60s", range->from, range->to);
    tn_help(tn_job_diagnostics(job), d, "write the smaller rank after --from");
    return false;
}

/* What was written stays, and how to go on is said. */
static void end(tn_job *job, const house_list *list)
{
    char *rank = mpz_get_str(NULL, 10, list->next);
    if (tn_interrupted()) {
        tn_interrupt_answered();
        tn_job_interrupted(job, "interrupted; %" PRIu64 " houses are written, and --from %s goes on after them",
                           list->written, rank ? rank : "?");
    } else if (list->written == 0 && mpz_cmp(list->next, list->before) >= 0 && !list->bounded &&
               !(list->range->limited && list->range->limit == 0)) {
        char *houses = mpz_get_str(NULL, 10, list->before);
        tn_job_note(job, "there are %.400s houses, none of them from rank %.40s on", houses ? houses : "?",
                    rank ? rank : "?");
        free(houses);
    }
    free(rank);
}

static tn_status list_all(tn_numbered *n, const tn_plan *plan, house_list *list, tn_error *error)
{
    bool stop = false;
    tn_progress_begin(&list->progress, "houses", 0, list->range->limited ? (double)list->range->limit : 0);
    tn_status status = plan ? list_plan(n, list, plan->trays, (uint32_t)plan->length, &stop, error)
                            : tn_numbered_plans_until(n, list_plan, list, error);
    tn_progress_end(&list->progress);
    return status;
}

void tn_job_list_houses(tn_job *job, const tn_house_settings *settings, const char *plan, const tn_house_range *range,
                        const char *output)
{
    tn_numbered n = {0};
    house_list list;
    tn_error error = {0};
    tn_output out;
    tn_plan on = {0};
    if (begin(job, &list, range) && tn_job_takes_houses(job, output) && tn_numbered_open(&n, job, settings)) {
        tn_status status = plan ? tn_numbered_plan(&n, plan, settings->max_length, &on, &error) : TN_OK;
        if (status != TN_OK) {
            tn_numbered_bad_text(job, &error, "PLAN", plan);
        } else if (tn_job_output(job, output, &out)) {
            list.out = out.stream;
            status = list_all(&n, plan ? &on : NULL, &list, &error);
            if (status != TN_OK)
                tn_job_fail(job, &error);
            tn_job_close(job, &out, status == TN_OK);
            if (status == TN_OK)
                end(job, &list);
        }
    }
    free(on.trays);
    tn_numbered_close(&n);
    mpz_clears(list.next, list.to, list.before, NULL);
    free(list.line.data);
}
