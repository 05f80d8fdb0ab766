/* Ranks plans one after the other. */
#include "runtime/plan/library/ranking.h"

#include <stdlib.h>

#include "runtime/plan/library/library_data.h"

/* Where a plan stands before a tray: the state, and how many plans come before its beginning. */
typedef struct step {
    tn_tray tray; /* that follows */
    uint32_t state;
    mpz_t before;
} step;

struct tn_ranking {
    const tn_library *library;
    step *steps;   /* [longest + 1] */
    size_t length; /* of the last plan; SIZE_MAX before the first */
    mpz_t sum;
};

tn_status tn_ranking_new(const tn_library *library, tn_ranking **out, tn_error *error)
{
    tn_ranking *ranking = calloc(1, sizeof *ranking);
    step *steps = ranking ? calloc((size_t)tn_library_max(library) + 1, sizeof *steps) : NULL;
    if (!steps) {
        free(ranking);
        return tn_fail_memory(error);
    }
    *ranking = (tn_ranking){.library = library, .steps = steps, .length = SIZE_MAX};
    mpz_init(ranking->sum);
    for (size_t i = 0; i <= tn_library_max(library); i++)
        mpz_init(steps[i].before);
    *out = ranking;
    return TN_OK;
}

void tn_ranking_free(tn_ranking *ranking)
{
    if (!ranking)
        return;
    for (size_t i = 0; i <= tn_library_max(ranking->library); i++)
        mpz_clear(ranking->steps[i].before);
    mpz_clear(ranking->sum);
    free(ranking->steps);
    free(ranking);
}

/* How many of the first trays are those of the last plan, which is as long. */
static size_t shared(tn_ranking *ranking, const tn_tray *trays, size_t length)
{
    size_t same = 0;
    if (ranking->length != length) {
        ranking->steps[0].state = 0;
        mpz_set(ranking->steps[0].before, ranking->library->before[length]);
        return 0;
    }
    while (same < length && ranking->steps[same].tray == trays[same])
        same++;
    return same;
}

mpz_srcptr tn_ranking_next(tn_ranking *ranking, const tn_tray *trays, size_t length)
{
    const tn_library *library = ranking->library;
    if (!tn_library_has(library, trays, length))
        return NULL;
    step *steps = ranking->steps;
    for (size_t i = shared(ranking, trays, length); i < length; i++) {
        tn_plans_before(library, steps[i].state, trays[i], (uint32_t)(length - 1 - i), ranking->sum);
        steps[i].tray = trays[i];
        steps[i + 1].state = tn_library_step(library, steps[i].state, trays[i]);
        mpz_add(steps[i + 1].before, steps[i].before, ranking->sum);
    }
    ranking->length = length;
    return steps[length].before;
}
