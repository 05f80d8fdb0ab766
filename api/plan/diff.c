/* The C interface to what an edit does to a library. */
#include "runtime/plan/library/diff.h"

#include <stdlib.h>

#include "api/plan/plan.h"

_Static_assert((int)TARTAN_REMOVED == (int)TN_CLAUSE_REMOVED, "changes are the same numbers");

typedef struct clause_texts {
    char *removes, *adds;
} clause_texts;

struct tartan_diff {
    tn_library_diff *diff;
    const tn_module *modules[2];
    tartan_library parts[TN_DIFF_PARTS];
    clause_texts *texts; /* [clauses] */
};

static tartan_status count_text(const mpz_t number, char **text, tartan_error *error)
{
    if (mpz_sgn(number) >= 0)
        return tn_api_decimal(number, text, error);
    *text = calloc(2, 1); /* past a limit */
    if (!*text)
        return tn_api_memory(error);
    **text = '-';
    return TARTAN_OK;
}

static tartan_status write_texts(tartan_diff *d, tartan_error *error)
{
    size_t count = tn_library_diff_clauses(d->diff);
    tartan_status status = TARTAN_OK;
    d->texts = calloc(count + 1, sizeof *d->texts);
    if (!d->texts)
        return tn_api_memory(error);
    for (size_t i = 0; i < count && status == TARTAN_OK; i++) {
        const tn_changed_clause *c = tn_library_diff_clause(d->diff, i);
        status = count_text(c->removes, &d->texts[i].removes, error);
        if (status == TARTAN_OK)
            status = count_text(c->adds, &d->texts[i].adds, error);
    }
    return status;
}

static tartan_status compare(const tartan_library *before, const tartan_library *after, const tartan_watch *given,
                             tartan_diff *d, tartan_error *error)
{
    tn_watch watch;
    tn_error found;
    if (!before || !after)
        return tn_api_missing(error, "library");
    if (!before->owned || !after->owned)
        return tn_api_refuse(error, TARTAN_INVALID, "a part of a diff has no clauses to be compared");
    tartan_status status = tn_api_watch(given, &watch, error);
    if (status != TARTAN_OK)
        return status;
    if (tn_library_diff_new(before->library, after->library, 0, &watch, &d->diff, &found) != TN_OK)
        return tn_api_fail(&found, error);
    d->modules[0] = &before->plans.module;
    d->modules[1] = &after->plans.module;
    for (int part = 0; part < TN_DIFF_PARTS; part++)
        d->parts[part] =
            (tartan_library){.schema = before->schema, .library = tn_library_diff_part(d->diff, (tn_diff_part)part)};
    return write_texts(d, error);
}

tartan_status tartan_diff_new(const tartan_library *before, const tartan_library *after, const tartan_watch *watch,
                              tartan_diff **diff, tartan_error *error)
{
    tartan_diff *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = compare(before, after, watch, made, error);
    if (status == TARTAN_OK)
        *diff = made;
    else
        tartan_diff_free(made);
    return status;
}

void tartan_diff_free(tartan_diff *diff)
{
    if (!diff)
        return;
    for (size_t i = 0; diff->texts && i < tn_library_diff_clauses(diff->diff); i++) {
        free(diff->texts[i].removes);
        free(diff->texts[i].adds);
    }
    free(diff->texts);
    tn_library_diff_free(diff->diff);
    free(diff);
}

const tartan_library *tartan_diff_removed(const tartan_diff *diff)
{
    return &diff->parts[TN_DIFF_REMOVED];
}

const tartan_library *tartan_diff_added(const tartan_diff *diff)
{
    return &diff->parts[TN_DIFF_ADDED];
}

const tartan_library *tartan_diff_kept(const tartan_diff *diff)
{
    return &diff->parts[TN_DIFF_KEPT];
}

size_t tartan_diff_clause_count(const tartan_diff *diff)
{
    return tn_library_diff_clauses(diff->diff);
}

tartan_status tartan_diff_clause(const tartan_diff *diff, size_t i, tartan_changed_clause *clause, tartan_error *error)
{
    if (!diff || i >= tn_library_diff_clauses(diff->diff))
        return diff ? tn_api_refuse(error, TARTAN_INVALID, "there is no changed clause %zu", i)
                    : tn_api_missing(error, "diff");
    const tn_changed_clause *c = tn_library_diff_clause(diff->diff, i);
    int side = c->before == UINT32_MAX;
    uint32_t record = side ? c->after : c->before;
    tartan_changed_clause own = {
        .change = (tartan_change)c->change, .removes = diff->texts[i].removes, .adds = diff->texts[i].adds};
    if (!c->lengths && record < diff->modules[side]->CLAUSE_count)
        own.name = tn_text(diff->modules[side], diff->modules[side]->CLAUSE_records[record].name);
    return TN_API_GIVE(tartan_changed_clause, clause, &own, error);
}
