#include "runtime/plan/library/drawn.h"

#include <stdlib.h>

#include "runtime/automata/search.h"
#include "runtime/base/random.h"

/* The letters of each column: those of column c are letters[first[c]] to letters[first[c + 1] - 1]. */
typedef struct column_letters {
    uint32_t *first, *letters;
} column_letters;

static bool list_letters(const tn_sparse *sparse, column_letters *l)
{
    l->first = calloc((size_t)sparse->columns + 2, sizeof *l->first);
    l->letters = malloc(((size_t)sparse->letters + 1) * sizeof *l->letters);
    if (!l->first || !l->letters)
        return false;
    for (uint32_t letter = 0; letter < sparse->letters; letter++)
        l->first[sparse->column[letter] + 2]++;
    for (uint32_t c = 1; c <= sparse->columns; c++)
        l->first[c + 1] += l->first[c];
    for (uint32_t letter = 0; letter < sparse->letters; letter++)
        l->letters[l->first[sparse->column[letter] + 1]++] = letter;
    return true;
}

/* Every state leads on or accepts, so that a walk ends only where it may. */
static bool draw(const tn_sparse *sparse, const column_letters *l, uint64_t number, tn_key *plan)
{
    for (uint32_t state = 0;;) {
        size_t first = sparse->first[state], edges = sparse->first[state + 1] - first;
        uint64_t chance = tn_random64(0, number, plan->size);
        uint64_t way = chance % (edges + sparse->accept[state]);
        if (way == edges)
            return true;
        uint32_t column = sparse->label[first + way];
        uint32_t letters = l->first[column + 1] - l->first[column];
        if (!tn_key_push(plan, l->letters[l->first[column] + (chance >> 32) % letters]))
            return false;
        state = sparse->target[first + way];
    }
}

tn_status tn_drawn_plans_make(const tn_sparse *sparse, tn_drawn_plans *drawn, tn_error *error)
{
    column_letters letters = {0};
    *drawn = (tn_drawn_plans){0};
    bool good = list_letters(sparse, &letters);
    while (good && drawn->count < TN_DRAWN) {
        good = draw(sparse, &letters, drawn->count, &drawn->plans[drawn->count]);
        drawn->count++;
    }
    free(letters.first);
    free(letters.letters);
    return good ? TN_OK : tn_fail_memory(error);
}

void tn_drawn_plans_clear(tn_drawn_plans *drawn)
{
    for (size_t i = 0; i < drawn->count; i++)
        free(drawn->plans[i].data);
    *drawn = (tn_drawn_plans){0};
}

uint64_t tn_drawn_plans_failing(const tn_drawn_plans *drawn, const tn_dfa *dfa, bool accepts)
{
    uint64_t failing = 0;
    for (size_t i = 0; i < drawn->count; i++)
        failing |= (uint64_t)(tn_dfa_accepts(dfa, drawn->plans[i].data, drawn->plans[i].size) != accepts) << i;
    return failing;
}
