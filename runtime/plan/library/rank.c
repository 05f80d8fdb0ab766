/* Plan to rank and back. */
#include <stdlib.h>

#include "runtime/plan/library/library.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/library/rank.h"

/* ---- the ranks of plans, one after the other */

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

/* How many trays of a column come before a tray, from the nearest mark. `mark` is the tray of that mark. */
static uint32_t marked(const tn_library *library, tn_tray tray, uint32_t column)
{
    return library->passed[(size_t)(tray / library->stride) * library->kept->columns + column];
}

/* The same where counts have one limb, as most have: without GMP. */
static void few_plans_before(const tn_library *library, const uint32_t *next, tn_tray tray, uint32_t left, mpz_t sum)
{
    const mp_limb_t *counts = library->rows[left].value;
    const uint32_t *passed = library->passed + (size_t)(tray / library->stride) * library->kept->columns;
    tn_wide_limb plans = 0;
    for (uint32_t c = 0; c < library->kept->columns; c++)
        plans += (tn_wide_limb)counts[next[c]] * passed[c];
    for (tn_tray t = tray - tray % library->stride; t < tray; t++)
        plans += counts[next[library->tray_column[t]]];
    mpz_set_ui(sum, (mp_limb_t)(plans >> 64));
    mpz_mul_2exp(sum, sum, 64);
    mpz_add_ui(sum, sum, (mp_limb_t)plans);
}

/* Where trays are not listed: stretches of trays that go by as a whole, or not. */
typedef struct passing {
    const tn_library *library;
    const uint32_t *next; /* of the state */
    uint32_t left;
    mpz_ptr sum;  /* plans that start in the trays of stretches */
    mpz_ptr rest; /* to find a tray: its plan, counted from the trays that were not passed */
} passing;

static void add_plans(void *context, const tn_label_count *counts, size_t count)
{
    const passing *p = context;
    const tn_count_row *row = &p->library->rows[p->left];
    for (size_t i = 0; i < count; i++) {
        uint32_t state = p->next[p->library->kept->column[counts[i].label]];
        if (tn_library_alive(p->library, p->left, state))
            tn_count_row_add(row, state, counts[i].count, p->sum);
    }
}

static bool pass_plans(void *context, const tn_label_count *counts, size_t count)
{
    const passing *p = context;
    mpz_set_ui(p->sum, 0);
    add_plans(context, counts, count);
    if (mpz_cmp(p->sum, p->rest) > 0)
        return false;
    mpz_sub(p->rest, p->rest, p->sum);
    return true;
}

void tn_plans_before(const tn_library *library, uint32_t state, tn_tray tray, uint32_t left, mpz_t sum)
{
    const tn_dfa *kept = library->kept;
    const tn_count_row *row = &library->rows[left];
    const uint32_t *next = kept->delta + (size_t)state * kept->columns;
    if (library->schema->legal) {
        passing p = {library, next, left, sum, NULL};
        mpz_set_ui(sum, 0);
        tn_labelling_before(tn_kinds_of(&library->classes->kinds), tray, add_plans, &p);
        return;
    }
    if (row->limbs == 1) {
        few_plans_before(library, next, tray, left, sum);
        return;
    }
    mpz_set_ui(sum, 0);
    for (uint32_t c = 0; c < kept->columns; c++) {
        uint32_t trays = marked(library, tray, c);
        if (trays > 0 && tn_library_alive(library, left, next[c]))
            tn_count_row_add(row, next[c], trays, sum);
    }
    for (tn_tray t = tray - tray % library->stride; t < tray; t++)
        tn_count_row_add(row, next[library->tray_column[t]], 1, sum);
}

uint32_t tn_library_next(const tn_library *library, uint32_t state, tn_tray tray)
{
    return tn_library_step(library, state, tray);
}

bool tn_library_lives(const tn_library *library, uint32_t left, uint32_t state)
{
    return left <= library->max && tn_library_alive(library, left, state);
}

bool tn_library_rank(const tn_library *library, const tn_tray *trays, size_t length, mpz_t rank)
{
    if (!tn_library_has(library, trays, length))
        return false;
    mpz_t sum;
    mpz_init(sum);
    mpz_set(rank, library->before[length]);
    uint32_t state = 0;
    for (size_t i = 0; i < length; i++) {
        tn_plans_before(library, state, trays[i], (uint32_t)(length - 1 - i), sum);
        mpz_add(rank, rank, sum);
        state = tn_library_step(library, state, trays[i]);
    }
    mpz_clear(sum);
    return true;
}

/* ---- the rank of a plan of a library that leaves a clause out */

typedef struct apart_plan {
    const tn_classes *classes;
    const tn_tray *trays;
} apart_plan;

static void add_classes(void *context, const tn_label_count *counts, size_t count)
{
    uint64_t *classes = context;
    for (size_t i = 0; i < count; i++)
        classes[counts[i].label] += counts[i].count;
}

static void add_lower_trays(void *context, uint32_t place, uint64_t *classes)
{
    const apart_plan *plan = context;
    tn_tray tray = plan->trays[place];
    if (!plan->classes->of_tray) {
        tn_labelling_before(tn_kinds_of(&plan->classes->kinds), tray, add_classes, classes);
        return;
    }
    for (tn_tray t = 0; t < tray; t++)
        classes[plan->classes->of_tray[t]]++;
}

static tn_status rank_apart(const tn_library *library, const tn_tray *trays, uint32_t length, mpz_t rank,
                            tn_error *error)
{
    uint32_t *letters = malloc(((size_t)length + 1) * sizeof *letters);
    if (!letters)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < length; i++)
        letters[i] = tn_class_of(library->classes, trays[i]);
    apart_plan plan = {library->classes, trays};
    const tn_count_word word = {length, letters, add_lower_trays, &plan};
    tn_bounds bounds = tn_library_bounds(library);
    tn_status status = tn_count_both_before(library->live, library->clauses[library->apart],
                                            tn_library_keeping(library, library->apart), library->classes->size, &word,
                                            "library", &bounds, rank, error);
    mpz_add(rank, rank, library->before[length]);
    free(letters);
    return status;
}

tn_status tn_library_counted_rank(const tn_library *library, const tn_tray *trays, size_t length, bool *has, mpz_t rank,
                                  tn_error *error)
{
    if (library->apart == SIZE_MAX) {
        *has = tn_library_rank(library, trays, length, rank);
        return TN_OK;
    }
    *has = tn_library_has(library, trays, length);
    return *has ? rank_apart(library, trays, (uint32_t)length, rank, error) : TN_OK;
}

/* ---- the plan of a rank */

/* As tn_plans_before, nearly, and divided like the nearly row. */
static double nearly_before(const tn_library *library, const double *nearly, const uint32_t *next, tn_tray tray)
{
    double sum = 0;
    for (uint32_t c = 0; c < library->kept->columns; c++)
        sum += marked(library, tray, c) * nearly[next[c]];
    for (tn_tray t = tray - tray % library->stride; t < tray; t++)
        sum += nearly[next[library->tray_column[t]]];
    return sum;
}

/* About the tray in which plan `rest` of those from a state starts, by halving. */
static tn_tray guess_tray(const tn_library *library, const uint32_t *next, uint32_t left, const mpz_t rest)
{
    const double *nearly = library->nearly + (size_t)left * library->kept->states;
    double wanted = tn_nearly(rest, library->rows[left].limbs);
    tn_tray low = 0, high = library->schema->tray_count;
    while (high - low > 1) {
        tn_tray middle = low + (high - low) / 2;
        if (nearly_before(library, nearly, next, middle) <= wanted)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The tray in which plan `rest` (from 0) of those from `state` starts; `rest` becomes its rank among those with that
 * tray. The guess only saves work: from it, exact counts step to the tray. */
static tn_tray find_tray(const tn_library *library, uint32_t state, uint32_t left, mpz_t rest, mpz_t sum, mpz_t one)
{
    const uint32_t *next = library->kept->delta + (size_t)state * library->kept->columns;
    const tn_count_row *row = &library->rows[left];
    if (library->schema->legal) {
        passing p = {library, next, left, sum, rest};
        return tn_labelling_find(tn_kinds_of(&library->classes->kinds), pass_plans, &p);
    }
    tn_tray tray = guess_tray(library, next, left, rest);
    tn_plans_before(library, state, tray, left, sum);
    while (mpz_cmp(sum, rest) > 0) {
        tray--;
        mpz_set_ui(one, 0);
        tn_count_row_add(row, next[library->tray_column[tray]], 1, one);
        mpz_sub(sum, sum, one);
    }
    mpz_sub(rest, rest, sum);
    for (;; tray++) { /* rest is below the plans that start with this tray or a later one */
        mpz_set_ui(one, 0);
        tn_count_row_add(row, next[library->tray_column[tray]], 1, one);
        if (mpz_cmp(rest, one) < 0)
            return tray;
        mpz_sub(rest, rest, one);
    }
}

/* The length of the plan of a rank below the number kept, by halving. */
static uint32_t find_length(const tn_library *library, const mpz_t rank)
{
    uint32_t low = library->min, high = library->max + 1; /* before[low] <= rank < before[high] */
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (mpz_cmp(library->before[middle], rank) <= 0)
            low = middle;
        else
            high = middle;
    }
    return low;
}

bool tn_library_unrank(const tn_library *library, const mpz_t rank, tn_tray *trays, uint32_t *length)
{
    if (mpz_sgn(rank) < 0 || mpz_cmp(rank, library->before[library->max + 1]) >= 0)
        return false;
    mpz_t rest, sum, one;
    mpz_inits(rest, sum, one, NULL);
    *length = find_length(library, rank);
    mpz_sub(rest, rank, library->before[*length]);
    uint32_t state = 0;
    for (uint32_t i = 0; i < *length; i++) {
        trays[i] = find_tray(library, state, *length - 1 - i, rest, sum, one);
        state = tn_library_step(library, state, trays[i]);
    }
    mpz_clears(rest, sum, one, NULL);
    return true;
}
