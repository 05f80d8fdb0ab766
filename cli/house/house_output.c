/* Writes houses in the format that the options ask for. */
#include "cli/house/house_output.h"

#include <stdlib.h>

#include "driver/plan/made.h"

bool tn_house_rows_open(tn_house_rows *w, const tn_numbered *n, const tn_written_settings *settings, const char *made)
{
    static const tn_row_columns columns = {"houses", {"plan_rank", "variant", "house"}, 3};
    tn_job *job = tn_numbered_job(n);
    tn_made described;
    *w = (tn_house_rows){.n = n, .json = settings->format == TN_FORMAT_JSON};
    tn_made_describe_houses(&job->opened, n->plans, tn_text(n->form.module, n->record->name),
                            job->settings->operands.items[0], made, &described);
    const tn_row_source source = {.schema = n->schema, .metadata = &described.metadata, .rows = &columns};
    return tn_job_row_writer(job, settings, &source, &w->writer);
}

/* The texts of the row are those of the columns above. */
static tn_status write_row(tn_house_rows *w, const tn_house *house, const mpz_t rank, const char *plan_rank,
                           const char *variant, tn_error *error)
{
    w->line.size = w->members.size = 0;
    tn_status status = tn_house_write(house, &w->line, error);
    tn_json members = tn_json_text(&w->members, TN_JSON_TIGHT);
    if (status == TN_OK && w->json)
        status = tn_house_write_members(house, &members, error);
    if (status == TN_OK && w->members.failed)
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    const tn_plan_row row = {.trays = house->trays,
                             .length = house->length,
                             .texts = {plan_rank, variant, w->line.data},
                             .members = w->members.data};
    return tn_plan_writer_write_row(w->writer, rank, &row, error);
}

tn_status tn_house_rows_write(tn_house_rows *w, const tn_house *house, const mpz_t rank, const mpz_t variant,
                              tn_error *error)
{
    mpz_t plan;
    mpz_init(plan);
    bool kept = tn_library_rank(w->n->plans, house->trays, (uint32_t)house->length, plan);
    char *plan_rank = mpz_get_str(NULL, 10, plan), *number = mpz_get_str(NULL, 10, variant);
    tn_status status = TN_OK;
    if (!kept)
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a house stands on a plan that is not in the library");
    else if (!plan_rank || !number)
        status = tn_fail_memory(error);
    else
        status = write_row(w, house, rank, plan_rank, number, error);
    free(plan_rank);
    free(number);
    mpz_clear(plan);
    return status;
}

void tn_house_rows_close(tn_house_rows *w)
{
    if (w->writer)
        tn_job_rows_close(tn_numbered_job(w->n), w->writer);
    free(w->line.data);
    free(w->members.data);
    *w = (tn_house_rows){0};
}
