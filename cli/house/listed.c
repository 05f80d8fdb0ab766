/* Lists the houses of a library in the order of their ranks: plan by plan, each plan's houses one after another. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/house/house_output.h"
#include "driver/plan/made.h"

typedef struct house_list {
    const tn_house_range *range;
    mpz_t next;    /* the rank of the next house to be written */
    mpz_t to;      /* one past the last, where `bounded` */
    mpz_t before;  /* houses on the plans before */
    mpz_t variant; /* of the next house on the plan in hand */
    bool bounded;
    uint64_t written; /* houses in the file, those resumed included */
    tn_house_rows out;
    tn_progress progress;
    tn_house_variants *quick; /* plans are gone through in so many steps, before they are counted */
} house_list;

enum { QUICK_STEPS = 1000000 };

static bool is_done(const house_list *list)
{
    return (list->range->limited && list->written >= list->range->limit) ||
           (list->bounded && mpz_cmp(list->next, list->to) >= 0) || tn_interrupted();
}

static tn_status write_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    house_list *list = context;
    tn_status status = tn_house_rows_write(&list->out, house, list->next, list->variant, error);
    if (status != TN_OK)
        return status;
    mpz_add_ui(list->next, list->next, 1);
    mpz_add_ui(list->variant, list->variant, 1);
    tn_progress_update(&list->progress, (double)++list->written);
    *stop = is_done(list);
    return TN_OK;
}

/* The number on its plan of the next house; false: it is not one of the plan's. */
static bool find_variant(house_list *list, const mpz_t houses)
{
    if (is_done(list))
        return false;
    mpz_sub(list->variant, list->next, list->before);
    return mpz_cmp(list->variant, houses) < 0;
}

/* Goes through the houses on a plan one by one: TN_LIMIT where that takes many steps, and what is written stays. */
static tn_status list_through(tn_house_variants *variants, house_list *list, const tn_tray *trays, uint32_t length,
                              mpz_t houses, tn_error *error)
{
    tn_house_counts counts;
    tn_house_counts_init(&counts);
    tn_status status = tn_house_variants_count(variants, trays, length, &counts, error);
    if (status == TN_OK && find_variant(list, counts.houses)) {
        mpz_set(houses, list->variant);
        status = tn_house_variants_each(variants, trays, length, houses, write_house, list, error);
    }
    mpz_set(houses, counts.houses);
    tn_house_counts_clear(&counts);
    return status;
}

/* From house to house by their numbers: that takes a while for each, but nothing that clauses drop is gone through. */
static tn_status list_by_number(tn_numbered *n, house_list *list, tn_plan_houses *plan, const mpz_t houses,
                                tn_error *error)
{
    tn_status status = TN_OK;
    while (status == TN_OK && find_variant(list, houses)) {
        tn_house house;
        status = tn_plan_houses_at(plan, list->variant, &house, error);
        if (status == TN_OK)
            status = tn_house_variants_tiles_from(n->variants, &house, write_house, list, error);
        tn_house_clear(&house);
    }
    return status;
}

/* Are so few of the houses on the plan asked for that going through all of them would take longer? */
static bool wants_few(house_list *list, const mpz_t houses)
{
    enum { FEW = 5000 };
    mpz_t end;
    mpz_init_set(end, houses);
    mpz_add(end, end, list->before);
    if (list->bounded && mpz_cmp(list->to, end) < 0)
        mpz_set(end, list->to);
    mpz_sub(end, end, list->next);
    bool few = (list->range->limited && list->range->limit - list->written <= FEW) || mpz_cmp_ui(end, FEW) <= 0;
    mpz_clear(end);
    return few;
}

/* Writes the houses on a plan that are asked for, where they are many to go through: they are counted tray by tray. */
static tn_status list_many(tn_numbered *n, house_list *list, const tn_tray *trays, uint32_t length, mpz_t houses,
                           tn_error *error)
{
    tn_plan_houses *plan;
    tn_status status = tn_numbered_among(n, NULL, trays, length, &plan, error);
    if (status == TN_LIMIT)
        return list_through(n->variants, list, trays, length, houses, error);
    if (status != TN_OK)
        return status;
    tn_houses_count(n->ranked.counted, TN_ALL_LENGTHS, houses);
    status = TN_LIMIT;
    if (!wants_few(list, houses))
        status = list_through(n->variants, list, trays, length, houses, error);
    if (status != TN_LIMIT)
        return status;
    tn_houses_count(n->ranked.counted, TN_ALL_LENGTHS, houses);
    return list_by_number(n, list, plan, houses, error);
}

/* Writes the houses on a plan that are asked for. */
static tn_status list_plan(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                           tn_error *error)
{
    house_list *list = context;
    mpz_t houses;
    mpz_init(houses);
    tn_status status = list_through(list->quick, list, trays, length, houses, error);
    if (status == TN_LIMIT)
        status = list_many(n, list, trays, length, houses, error);
    mpz_add(list->before, list->before, houses); /* those up to the end of this plan */
    *stop = is_done(list);
    mpz_clear(houses);
    return status;
}

static bool begin(tn_job *job, house_list *list, const tn_house_range *range)
{
    *list = (house_list){.range = range, .bounded = range->to != NULL};
    mpz_inits(list->next, list->to, list->before, list->variant, NULL);
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

/* What was written stays, and how to go on is said. A database that was to be replaced is as it was, which is said at
 * the end. */
static void interrupted(tn_job *job, house_list *list)
{
    if (tn_plan_writer_replaces(list->out.writer))
        return;
    tn_interrupt_answered();
    if (tn_plan_writer_resumes(list->out.writer)) {
        tn_job_interrupted(job, "interrupted; a database keeps its whole batches, and --resume goes on after them");
        return;
    }
    tn_house_rows_close(&list->out);
    char *rank = mpz_get_str(NULL, 10, list->next);
    tn_job_interrupted(job, "interrupted; %" PRIu64 " houses are written, and --from %s goes on after them",
                       list->written, rank ? rank : "?");
    free(rank);
}

static void say_none(const tn_numbered *n, bool on_plan, const house_list *list)
{
    tn_job *job = tn_numbered_job(n);
    bool past = list->written == 0 && mpz_cmp(list->next, list->before) >= 0;
    if (!past || list->bounded || (list->range->limited && list->range->limit == 0))
        return;
    if (mpz_sgn(list->before) == 0) {
        tn_numbered_say_few(n, on_plan, 0, 1);
        return;
    }
    char *rank = mpz_get_str(NULL, 10, list->next), *houses = mpz_get_str(NULL, 10, list->before);
    tn_job_note(job, "there are %.400s houses, none of them from rank %.40s on", houses ? houses : "?",
                rank ? rank : "?");
    free(houses);
    free(rank);
}

/* Finds the rank of the plan to begin with, and the houses before it: at once where all can be counted together; else
 * the plans before it are gone through. */
static tn_status find_plan(tn_numbered *n, house_list *list, mpz_t plan, tn_error *error)
{
    mpz_set_ui(plan, 0);
    if (mpz_sgn(list->next) == 0)
        return TN_OK;
    tn_status status = tn_numbered_all(n, error);
    if (status != TN_OK)
        return status == TN_LIMIT ? TN_OK : status;
    return tn_numbered_locate(n, list->next, plan, list->before, error);
}

static tn_status list_from(tn_numbered *n, house_list *list, tn_error *error)
{
    mpz_t plan;
    mpz_init(plan);
    tn_status status = find_plan(n, list, plan, error);
    if (status == TN_OK)
        status = tn_numbered_plans_from(n, plan, list_plan, list, error);
    mpz_clear(plan);
    return status;
}

static void resume(tn_job *job, house_list *list)
{
    mpz_t last;
    mpz_init(last);
    list->written = tn_plan_writer_resumed(list->out.writer, last);
    if (list->written > 0) {
        mpz_add_ui(list->next, last, 1);
        tn_job_note(job, "%" PRIu64 " houses are there already; going on after them", list->written);
        tn_job_show(job);
    }
    mpz_clear(last);
}

static void list_all(tn_numbered *n, const tn_plan *plan, house_list *list)
{
    tn_job *job = tn_numbered_job(n);
    bool stop = false;
    tn_error error;
    tn_progress_begin(&list->progress, "houses", (double)list->written,
                      list->range->limited ? (double)list->range->limit : 0);
    tn_status status = tn_house_variants_new(&n->form, n->record, QUICK_STEPS, &list->quick, &error);
    if (status == TN_OK)
        status =
            plan ? list_plan(n, list, plan->trays, (uint32_t)plan->length, &stop, &error) : list_from(n, list, &error);
    tn_house_variants_free(list->quick);
    tn_progress_end(&list->progress);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    else if (tn_interrupted())
        interrupted(job, list);
    else
        say_none(n, plan != NULL, list);
}

/* The command, as files of houses say how they were made. The limit is left out: a library can be resumed to go on past
 * it. */
static char *describe(const tn_house_settings *settings, const tn_house_range *range, const char *plan)
{
    const tn_enumerated asked = {.from = range->from,
                                 .to = range->to,
                                 .trays_given = settings->plans.override_trays,
                                 .trays_min = settings->plans.trays_min,
                                 .trays_max = settings->plans.trays_max,
                                 .plan = plan,
                                 .wheres = settings->wheres,
                                 .where_count = settings->where_count};
    return tn_enumerated_words(&asked);
}

static void write_list(tn_numbered *n, const tn_plan *plan, house_list *list, const tn_written_settings *written,
                       char *made)
{
    tn_error error;
    if (!made) {
        tn_fail_memory(&error);
        tn_job_fail(tn_numbered_job(n), &error);
    } else if (tn_house_rows_open(&list->out, n, written, made)) {
        resume(tn_numbered_job(n), list);
        list_all(n, plan, list);
    }
    tn_house_rows_close(&list->out);
}

void tn_job_list_houses(tn_job *job, const tn_house_settings *settings, const char *plan, const tn_house_range *range,
                        const tn_written_settings *written)
{
    tn_numbered n = {0};
    house_list list;
    tn_error error = {0};
    tn_plan on = {0};
    if (begin(job, &list, range) && tn_job_numbered(job, &n, settings)) {
        char *made = describe(settings, range, plan);
        if (plan && tn_numbered_plan(&n, plan, settings->max_length, &on, &error) != TN_OK)
            tn_job_bad_text(job, &error, "PLAN", plan);
        else
            write_list(&n, plan ? &on : NULL, &list, written, made);
        free(made);
    }
    free(on.trays);
    tn_numbered_close(&n);
    mpz_clears(list.next, list.to, list.before, list.variant, NULL);
}
