/* The members of a generation, its first front, and its statistics. */
#include <math.h>
#include <stdlib.h>

#include "runtime/genome/breeding/evolve_state.h"

const tn_individual *const *tn_evolution_members(const tn_evolution *e, size_t *count)
{
    *count = e->member_count;
    return (const tn_individual *const *)e->members;
}

const tn_individual *const *tn_evolution_born(const tn_evolution *e, size_t *count)
{
    *count = e->born_count;
    return (const tn_individual *const *)e->born;
}

size_t tn_evolution_known(const tn_evolution *e)
{
    return e->cache.count;
}

uint32_t tn_evolution_generation(const tn_evolution *e)
{
    return e->generation;
}

size_t tn_evolution_front(const tn_evolution *e)
{
    size_t count = 0;
    while (count < e->member_count && e->merits[count].front == 0 && e->evaluator.objectives > 1)
        count++;
    return e->evaluator.objectives > 1 ? count : e->member_count > 0;
}

static int compare_hashes(const void *left, const void *right)
{
    const uint64_t *a = left, *b = right;
    return *a < *b ? -1 : *a > *b;
}

static uint32_t count_distinct(const tn_evolution *e)
{
    uint64_t *hashes = e->hashes;
    size_t count = 0;
    uint32_t distinct = 0;
    for (size_t i = 0; i < e->member_count; i++)
        if (e->members[i]->reason == TN_MAPPING_VALID)
            hashes[count++] = e->members[i]->hash[0];
    qsort(hashes, count, sizeof *hashes, compare_hashes);
    for (size_t i = 0; i < count; i++)
        distinct += i == 0 || hashes[i] != hashes[i - 1];
    return distinct;
}

static int compare_scores(const void *left, const void *right)
{
    const double *a = left, *b = right;
    return *a < *b ? -1 : *a > *b;
}

/* Each is the score at its share of the order, between two neighbours where it falls between them. */
static void find_quartiles(const tn_evolution *e, tn_generation_stats *s)
{
    double *scores = e->scores;
    size_t count = 0;
    for (size_t i = 0; i < e->member_count; i++)
        if (e->members[i]->score.state == TN_SCORED)
            scores[count++] = e->members[i]->score.objectives[0];
    qsort(scores, count, sizeof *scores, compare_scores);
    for (size_t q = 0; q < 3 && count; q++) {
        double place = (double)(count - 1) * (double)(q + 1) / 4, low = floor(place);
        double below = scores[(size_t)low], share = place - low;
        s->quartiles[q] = share > 0 ? below + share * (scores[(size_t)low + 1] - below) : below;
        if (s->quartiles[q] != s->quartiles[q])
            s->quartiles[q] = below; /* between infinite ones */
    }
}

tn_generation_stats tn_evolution_stats(const tn_evolution *e)
{
    tn_generation_stats s = {.generation = e->generation, .evaluations = e->evaluations, .births = e->births};
    for (size_t o = 0; o < TN_OBJECTIVES_MAX; o++)
        s.best[o] = o < e->evaluator.objectives ? HUGE_VAL : 0;
    double sum = 0, codons = 0, depths = 0;
    for (size_t i = 0; i < e->member_count; i++) {
        const tn_individual *m = e->members[i];
        s.no_sentence += m->score.state == TN_SCORE_NO_SENTENCE;
        s.failed += m->score.state == TN_SCORE_FAILED;
        s.limited += m->score.state == TN_SCORE_LIMIT;
        if (m->reason == TN_MAPPING_VALID) {
            codons += (double)m->used;
            depths += m->depth;
        }
        if (m->score.state != TN_SCORED)
            continue;
        s.scored++;
        sum += m->score.objectives[0];
        for (size_t o = 0; o < e->evaluator.objectives; o++)
            if (m->score.objectives[o] < s.best[o])
                s.best[o] = m->score.objectives[o];
    }
    find_quartiles(e, &s);
    uint32_t sentences = (uint32_t)e->member_count - s.no_sentence;
    s.mean = s.scored ? sum / s.scored : 0;
    s.mean_codons = sentences ? codons / sentences : 0;
    s.mean_depth = sentences ? depths / sentences : 0;
    s.distinct = count_distinct(e);
    return s;
}
