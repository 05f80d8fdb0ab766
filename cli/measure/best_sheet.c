/* Puts the best plans of a library onto a sheet. */
#include "cli/measure/best_sheet.h"

#include <stdlib.h>

#include "ask/session/questions.h"
#include "driver/open/digits.h"

static bool begins(void *context, tn_found_of *of)
{
    tn_best_sheet *s = context;
    s->ready = of->plans;
    s->wishes = *of->wishes;
    return true;
}

/* "3.  cost 87,880, area 304 ft2" */
static tn_status add(tn_best_sheet *s, const tn_found_one *found, tn_error *error)
{
    tn_buffer caption = {0};
    bool ok = tn_buffer_printf(&caption, "%zu.  ", s->drawn.count + 1);
    for (uint32_t k = 0; ok && k < s->wishes.count; k++)
        ok = tn_buffer_printf(&caption, "%s%s ", k ? ", " : "", s->wishes.names[k]) &&
             tn_amount_write(s->wishes.units[k], found->values[k], &caption);
    if (ok)
        return tn_sheet_add(&s->drawn, found->trays, found->length, mpz_get_str(NULL, 10, found->rank), NULL,
                            caption.data, error);
    free(caption.data);
    return tn_fail_memory(error);
}

static bool takes(void *context, const tn_found_one *found)
{
    tn_best_sheet *s = context;
    tn_error error;
    tn_status status = add(s, found, &error);
    if (status != TN_OK)
        tn_job_fail(s->job, &error);
    return status == TN_OK;
}

bool tn_job_best_sheet(tn_job *job, const tn_best_request *request, tn_best_sheet *sheet)
{
    const tn_taker taker = {begins, takes, sheet};
    tn_reply answer;
    *sheet = (tn_best_sheet){.job = job};
    job->session.taker = &taker;
    bool found = tn_job_answered(job, tn_ask_best(&job->session, request, &answer));
    job->session.taker = NULL;
    tn_reply_clear(&answer);
    return found && job->exit_code == TN_EXIT_DONE;
}

bool tn_best_sheet_aim(const tn_best_sheet *sheet, char *note, size_t size)
{
    const tn_wishes *wishes = &sheet->wishes;
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(sheet->ready->library, TN_ALL_LENGTHS, kept);
    char *digits = tn_digits(kept, true);
    tn_buffer text = {0};
    bool ok = digits && tn_buffer_printf(&text, "the %zu of %s plans with the ", sheet->drawn.count, digits);
    for (uint32_t k = 0; ok && k < wishes->count; k++)
        ok = tn_buffer_printf(&text, "%s%s %s", k ? ", then the " : "", wishes->most[k] ? "most" : "least",
                              wishes->names[k]);
    if (ok)
        snprintf(note, size, "%s", text.data);
    free(text.data);
    free(digits);
    mpz_clear(kept);
    return ok;
}
