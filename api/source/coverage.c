/* The C interface to coverage: which changes of rules the tests notice. */
#include <stdlib.h>

#include "api/source/source.h"
#include "driver/coverage/coverage.h"

struct tartan_coverage {
    tn_covered covered;
    char **plans;   /* [part]: in decimal; NULL: not counted */
    char **changes; /* [part] */
};

static tn_status write_part(tartan_coverage *coverage, size_t i)
{
    const tn_covered_part *part = &coverage->covered.parts[i];
    tn_buffer change = {0};
    bool ok = tn_covered_change(part, &change);
    coverage->changes[i] = change.data;
    if (!ok || part->of_houses || !part->counted)
        return ok ? TN_OK : TN_MEMORY;
    coverage->plans[i] = malloc(mpz_sizeinbase(part->flips, 10) + 2);
    if (!coverage->plans[i])
        return TN_MEMORY;
    mpz_get_str(coverage->plans[i], 10, part->flips);
    return TN_OK;
}

static tn_status write_parts(tartan_coverage *coverage)
{
    tn_status status = TN_OK;
    coverage->plans = calloc(coverage->covered.count + 1, sizeof *coverage->plans);
    coverage->changes = calloc(coverage->covered.count + 1, sizeof *coverage->changes);
    if (!coverage->plans || !coverage->changes)
        return TN_MEMORY;
    for (size_t i = 0; status == TN_OK && i < coverage->covered.count; i++)
        status = write_part(coverage, i);
    return status;
}

tartan_status tartan_source_cover(tartan_source *source, const char *library, uint32_t max_states,
                                  const tartan_watch *watch, tartan_coverage **coverage, tartan_error *error)
{
    tn_api_work work;
    const tn_coverage_options options = {.library = library, .max_states = max_states};
    if (!coverage)
        return tn_api_missing(error, "room for the coverage");
    if (source && !source->opened.compilation.program)
        return tn_api_refuse(error, TARTAN_INVALID, "%.300s is no .plan file, and only those hold tests", source->path);
    tartan_status status = tn_api_source_begin(source, watch, &work, error);
    if (status != TARTAN_OK)
        return status;
    tartan_coverage *made = calloc(1, sizeof *made);
    tn_status measured = made ? tn_coverage_measure(&source->opened, &options, &made->covered) : TN_MEMORY;
    if (measured == TN_OK)
        measured = write_parts(made);
    status = tn_api_source_end(&work, measured, error);
    if (status == TARTAN_OK)
        *coverage = made;
    else
        tartan_coverage_free(made);
    return status;
}

void tartan_coverage_free(tartan_coverage *coverage)
{
    if (!coverage)
        return;
    for (size_t i = 0; coverage->plans && i < coverage->covered.count; i++)
        free(coverage->plans[i]);
    for (size_t i = 0; coverage->changes && i < coverage->covered.count; i++)
        free(coverage->changes[i]);
    free(coverage->plans);
    free(coverage->changes);
    tn_covered_clear(&coverage->covered);
    free(coverage);
}

size_t tartan_coverage_count(const tartan_coverage *coverage)
{
    return coverage->covered.count;
}

size_t tartan_coverage_noticed(const tartan_coverage *coverage)
{
    return coverage->covered.noticed;
}

tartan_status tartan_coverage_part(const tartan_coverage *coverage, size_t i, tartan_covered_part *part,
                                   tartan_error *error)
{
    if (!coverage)
        return tn_api_missing(error, "coverage");
    if (i >= coverage->covered.count)
        return tn_api_refuse(error, TARTAN_INVALID, "there are %zu parts", coverage->covered.count);
    const tn_covered_part *from = &coverage->covered.parts[i];
    tartan_covered_part own = {.size = sizeof own,
                               .rule = from->name,
                               .depth = from->depth,
                               .kind = from->kind,
                               .text = from->text,
                               .plans = coverage->plans[i],
                               .noticed = from->noticed,
                               .change = coverage->changes[i]};
    return TN_API_GIVE(tartan_covered_part, part, &own, error);
}
