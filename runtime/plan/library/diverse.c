/* Chooses plans that differ: farthest-point sampling (Gonzalez 1985) over plans at hand, or over fresh draws instead of
 * over all plans of a library. */
#include "runtime/plan/library/diverse.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/base/watch.h"
#include "runtime/plan/library/near.h"

enum { DRAWS = 1000 };

/* A plan that is held against those chosen. */
typedef struct plan {
    uint32_t length;
    const tn_tray *trays;
    uint32_t least; /* the least distance from the first `held` of those chosen; UINT32_MAX: from none */
    size_t held;
} plan;

typedef struct chosen_plans {
    const tn_schema *schema;
    plan *items; /* room for all that are wanted */
    size_t count;
    uint32_t *row; /* of distances: [longest plan + 1] */
} chosen_plans;

static uint32_t smaller(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

/* The edit distance of two plans (Wagner and Fischer 1974), row by row. */
static uint32_t distance(const chosen_plans *c, const plan *p, const plan *q)
{
    uint32_t added = c->schema->field_count, *row = c->row;
    for (uint32_t j = 0; j <= q->length; j++)
        row[j] = j * added;
    for (uint32_t i = 0; i < p->length; i++) {
        uint32_t corner = row[0];
        row[0] += added;
        for (uint32_t j = 0; j < q->length; j++) {
            uint32_t changed = corner + tn_tray_distance(c->schema, p->trays[i], q->trays[j]);
            corner = row[j + 1];
            row[j + 1] = smaller(changed, smaller(corner, row[j]) + added);
        }
    }
    return row[q->length];
}

/* Exact where it is above `enough`: a candidate that is not farther than another one needs no more looking at. */
static uint32_t least_distance(const chosen_plans *c, plan *candidate, uint32_t enough)
{
    while (candidate->held < c->count && candidate->least > enough)
        candidate->least = smaller(candidate->least, distance(c, &c->items[candidate->held++], candidate));
    return candidate->least;
}

/* Is the candidate farther from those chosen than that? Then it is what others have to be farther than. */
static bool is_farther(const chosen_plans *c, plan *candidate, uint32_t *farthest)
{
    uint32_t least = least_distance(c, candidate, *farthest);
    if (least <= *farthest)
        return false;
    *farthest = least;
    return true;
}

/* ---- plans at hand */

/* The farthest of the plans, of equal ones the first; `count`: each is one of those chosen. */
static size_t farthest_of(const chosen_plans *c, plan *plans, size_t count)
{
    size_t best = count;
    uint32_t farthest = 0;
    for (size_t i = 0; i < count; i++)
        if (is_farther(c, &plans[i], &farthest))
            best = i;
    return best;
}

static tn_status choose_of(chosen_plans *c, plan *plans, size_t count, size_t wanted, bool *chosen, tn_error *error)
{
    tn_watch *watch = c->schema->module->watch;
    tn_status status = TN_OK;
    for (size_t next = 0; status == TN_OK && c->count < wanted && next < count;) {
        chosen[next] = true;
        c->items[c->count++] = plans[next];
        next = farthest_of(c, plans, count);
        if (watch)
            status = tn_watch_check(watch, error);
    }
    return status;
}

tn_status tn_plans_diverse(const tn_schema *schema, const tn_plan *plans, size_t count, size_t wanted, bool *chosen,
                           tn_error *error)
{
    size_t longest = 0;
    for (size_t i = 0; i < count; i++)
        longest = plans[i].length > longest ? plans[i].length : longest;
    chosen_plans c = {
        .schema = schema, .items = calloc(wanted + 1, sizeof *c.items), .row = malloc((longest + 1) * sizeof *c.row)};
    plan *held = malloc((count + 1) * sizeof *held);
    tn_status status = c.items && c.row && held ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        held[i] = (plan){.length = (uint32_t)plans[i].length, .trays = plans[i].trays, .least = UINT32_MAX};
        chosen[i] = false;
    }
    if (status == TN_OK)
        status = choose_of(&c, held, count, wanted, chosen, error);
    free(held);
    free(c.row);
    free(c.items);
    return status;
}

/* ---- plans of a library, drawn */

typedef struct choosing {
    const tn_library *library;
    chosen_plans chosen;
    tn_tray *trays; /* [wanted + 1][longest plan]: of those chosen, and of a candidate */
    size_t longest;
    mpz_t *ranks; /* of those chosen, in the order chosen */
    mpz_t draws[DRAWS];
} choosing;

/* The plan of a rank, in the place for the one that is chosen next. */
static tn_status draw(choosing *c, const mpz_t rank, plan *drawn, tn_error *error)
{
    tn_tray *trays = c->trays + c->chosen.count * c->longest;
    *drawn = (plan){.trays = trays, .least = UINT32_MAX};
    if (!tn_library_unrank(c->library, rank, trays, &drawn->length))
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a sampled rank is not in the library");
    return TN_OK;
}

static tn_status take(choosing *c, const mpz_t rank, tn_error *error)
{
    plan drawn;
    tn_status status = draw(c, rank, &drawn, error);
    if (status != TN_OK)
        return status;
    mpz_set(c->ranks[c->chosen.count], rank);
    c->chosen.items[c->chosen.count++] = drawn;
    return TN_OK;
}

/* The farthest of some draws; *found is false where each is one of those chosen. Draws are ascending: of equal ones the
 * first has the lowest rank. */
static tn_status choose_next(choosing *c, uint64_t seed, uint32_t length, bool *found, tn_error *error)
{
    size_t drawn, best = 0;
    uint32_t farthest = 0;
    uint64_t fresh = tn_random64(seed, c->chosen.count, 0);
    tn_status status = tn_library_sample(c->library, fresh, length, DRAWS, c->draws, &drawn, error);
    for (size_t i = 0; status == TN_OK && i < drawn; i++) {
        plan candidate;
        status = draw(c, c->draws[i], &candidate, error);
        if (status == TN_OK && is_farther(&c->chosen, &candidate, &farthest))
            best = i;
    }
    *found = farthest > 0;
    return status == TN_OK && *found ? take(c, c->draws[best], error) : status;
}

static int by_rank(const void *a, const void *b)
{
    const __mpz_struct *first = a, *second = b;
    return mpz_cmp(first, second);
}

static tn_status choose(choosing *c, uint64_t seed, uint32_t length, size_t count, tn_error *error)
{
    size_t drawn = 0;
    bool found = true;
    tn_watch *watch = c->chosen.schema->module->watch;
    tn_status status = tn_library_sample(c->library, seed, length, 1, c->draws, &drawn, error);
    if (status == TN_OK && drawn > 0)
        status = take(c, c->draws[0], error);
    while (status == TN_OK && found && c->chosen.count > 0 && c->chosen.count < count) {
        status = choose_next(c, seed, length, &found, error);
        if (status == TN_OK && watch)
            status = tn_watch_check(watch, error);
    }
    qsort(c->ranks, c->chosen.count, sizeof *c->ranks, by_rank);
    return status;
}

tn_status tn_library_diverse(const tn_library *library, uint64_t seed, uint32_t length, size_t count, mpz_t *ranks,
                             size_t *found, tn_error *error)
{
    *found = 0;
    if (count == 0)
        return TN_OK;
    choosing *c = calloc(1, sizeof *c);
    if (!c)
        return tn_fail_memory(error);
    for (size_t i = 0; i < DRAWS; i++)
        mpz_init(c->draws[i]);
    c->library = library;
    c->longest = (size_t)tn_library_max(library) + 1;
    c->ranks = ranks;
    c->chosen = (chosen_plans){.schema = tn_library_schema(library),
                               .items = calloc(count, sizeof *c->chosen.items),
                               .row = malloc((c->longest + 1) * sizeof *c->chosen.row)};
    c->trays = malloc(tn_size_of(count + 1, c->longest * sizeof *c->trays));
    tn_status status =
        c->chosen.items && c->trays && c->chosen.row ? choose(c, seed, length, count, error) : tn_fail_memory(error);
    *found = c->chosen.count;
    for (size_t i = 0; i < DRAWS; i++)
        mpz_clear(c->draws[i]);
    free(c->chosen.items);
    free(c->chosen.row);
    free(c->trays);
    free(c);
    return status;
}
