/* Draws plans of a library and measures them. */
#include "runtime/plan/measure/cloud.h"

#include <stdlib.h>

#include "runtime/plan/library/library_data.h"

tn_status tn_weighed_plan(tn_weighed *weighed, const tn_tray *trays, size_t length, int64_t *values, bool *valued,
                          tn_error *error)
{
    uint32_t state = 0, measures = tn_weighed_count(weighed);
    for (uint32_t k = 0; k < measures; k++)
        values[k] = tn_weighed_start(weighed, k);
    for (size_t i = 0; i < length; i++) {
        int64_t gain[TN_WEIGHED_MAX];
        tn_status status = tn_weighed_step(weighed, state, tn_weighed_letter(weighed, trays[i]), &state, gain, error);
        if (status != TN_OK)
            return status;
        if (state == UINT32_MAX)
            return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a plan that is measured is not in its library");
        for (uint32_t k = 0; k < measures; k++)
            values[k] += gain[k];
    }
    for (uint32_t k = 0; k < measures; k++)
        values[k] += tn_weighed_rest(weighed, state, k);
    *valued = tn_weighed_valued(weighed, state);
    return TN_OK;
}

static tn_status measure_ranks(tn_cloud *cloud, tn_weighed *weighed, mpz_t *ranks, size_t count, tn_error *error)
{
    const tn_library *library = tn_weighed_library(weighed);
    tn_tray *trays = malloc(sizeof *trays * ((size_t)tn_library_max(library) + 1));
    cloud->values = calloc(count + 1, sizeof *cloud->values);
    tn_status status = trays && cloud->values ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        uint32_t length = 0;
        bool valued = false;
        tn_library_unrank(library, ranks[i], trays, &length);
        status = tn_weighed_plan(weighed, trays, length, cloud->values[cloud->count], &valued, error);
        cloud->count += valued;
    }
    free(trays);
    return status;
}

tn_status tn_cloud_make(tn_cloud *cloud, tn_weighed *weighed, uint64_t seed, size_t count, tn_error *error)
{
    const tn_library *library = tn_weighed_library(weighed);
    *cloud = (tn_cloud){0};
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    if (mpz_cmp_ui(kept, count) < 0)
        count = (size_t)mpz_get_ui(kept);
    mpz_clear(kept);
    mpz_t *ranks = tn_integers_new(count);
    size_t found = 0;
    if (!ranks)
        return tn_fail_memory(error);
    tn_status status = tn_library_sample(library, seed, TN_ALL_LENGTHS, count, ranks, &found, error);
    if (status == TN_OK)
        status = measure_ranks(cloud, weighed, ranks, found, error);
    tn_integers_free(ranks, count);
    return status;
}

void tn_cloud_clear(tn_cloud *cloud)
{
    free(cloud->values);
    *cloud = (tn_cloud){0};
}
