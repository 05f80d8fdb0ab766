/* Measures that commands are told to make small or great. */
#include "cli/measure/wishes.h"

#include <string.h>

bool tn_wishes_names(tn_job *job, const tn_option_list *list, uint32_t least, tn_wishes *wishes)
{
    *wishes = (tn_wishes){0};
    if (list->count / 2 < least || list->count / 2 > TN_WEIGHED_MAX) {
        tn_diagnostic *d = tn_job_usage(job, "%s measures to go by: %u to %d are needed",
                                        list->count / 2 < least ? "too few" : "too many", least, TN_WEIGHED_MAX);
        tn_help(tn_job_diagnostics(job), d, "name them with --least MEASURE or --most MEASURE");
        return false;
    }
    for (size_t i = 0; i + 1 < list->count; i += 2) {
        uint32_t k = wishes->count;
        bool then = strncmp(list->items[i], "then-", 5) == 0;
        if (then != (i > 0 && least == 1)) {
            tn_diagnostic *d = tn_job_usage(job, then ? "--%s is first" : "--%s stands twice", list->items[i]);
            tn_help(tn_job_diagnostics(job), d,
                    "the first measure is told by --least or --most, the next by --then-least or --then-most");
            return false;
        }
        wishes->names[k] = list->items[i + 1];
        wishes->most[k] = strstr(list->items[i], "most") != NULL;
        wishes->count++;
    }
    return true;
}

bool tn_wishes_read(tn_job *job, const tn_ready_library *ready, const tn_option_list *list, uint32_t least,
                    tn_wishes *wishes)
{
    const tn_module *module = job->opened.module;
    if (!tn_wishes_names(job, list, least, wishes))
        return false;
    for (uint32_t k = 0; k < wishes->count; k++) {
        tn_status status =
            tn_measure_choose(&job->opened, wishes->names[k], ready->record->schema, &wishes->measures[k]);
        tn_job_status(job, status);
        if (status != TN_OK)
            return false;
        wishes->unit[k] = tn_amount_unit_of(
            ready->schema, module->SUM_records[module->MEASURE_records[wishes->measures[k]].sum].power);
    }
    return true;
}

tn_house_wishes tn_wishes_of_houses(const tn_wishes *wishes)
{
    tn_house_wishes of = {.count = wishes->count};
    for (uint32_t k = 0; k < wishes->count; k++) {
        of.names[k] = wishes->names[k];
        of.most[k] = wishes->most[k];
    }
    return of;
}

static void value_of(const tn_weighed *weighed, uint32_t k, int64_t steps, mpq_t value)
{
    mpq_init(value);
    mpq_set_si(value, steps, 1);
    mpq_mul(value, value, tn_weighed_unit(weighed, k));
}

bool tn_wishes_exact(const tn_wishes *wishes, const tn_weighed *weighed, uint32_t k, int64_t steps, tn_buffer *out)
{
    mpq_t value;
    value_of(weighed, k, steps, value);
    bool ok = tn_amount_write_exact(wishes->unit[k], value, out);
    mpq_clear(value);
    return ok;
}

bool tn_wishes_text(const tn_wishes *wishes, const tn_weighed *weighed, uint32_t k, int64_t steps, tn_buffer *out)
{
    mpq_t value;
    value_of(weighed, k, steps, value);
    bool ok = tn_amount_write(wishes->unit[k], value, out);
    mpq_clear(value);
    return ok;
}
