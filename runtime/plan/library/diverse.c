/* Chooses plans that differ: farthest-point sampling (Gonzalez 1985) over fresh draws instead of over all plans. */
#include "runtime/plan/library/diverse.h"

#include <stdlib.h>

#include "runtime/base/random.h"
#include "runtime/base/watch.h"
#include "runtime/plan/library/near.h"

enum { DRAWS = 1000 };

typedef struct plan {
    uint32_t length;
    tn_tray *trays;
} plan;

typedef struct choosing {
    const tn_library *library;
    const tn_schema *schema;
    plan *chosen;
    size_t count;
    tn_tray *candidate;
    uint32_t *row; /* of distances: [longest plan + 1] */
    mpz_t *ranks;  /* of those chosen, in the order chosen */
    mpz_t draws[DRAWS];
} choosing;

static uint32_t smaller(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

/* The edit distance of two plans (Wagner and Fischer 1974), row by row. */
static uint32_t distance(const choosing *c, const plan *p, const tn_tray *trays, uint32_t length)
{
    uint32_t added = c->schema->field_count, *row = c->row;
    for (uint32_t j = 0; j <= length; j++)
        row[j] = j * added;
    for (uint32_t i = 0; i < p->length; i++) {
        uint32_t corner = row[0];
        row[0] += added;
        for (uint32_t j = 0; j < length; j++) {
            uint32_t changed = corner + tn_tray_distance(c->schema, p->trays[i], trays[j]);
            corner = row[j + 1];
            row[j + 1] = smaller(changed, smaller(corner, row[j]) + added);
        }
    }
    return row[length];
}

/* Exact where it is above `enough`: a candidate that is not farther than another one needs no more looking at. */
static uint32_t least_distance(const choosing *c, const tn_tray *trays, uint32_t length, uint32_t enough)
{
    uint32_t least = UINT32_MAX;
    for (size_t i = 0; i < c->count && least > enough; i++)
        least = smaller(least, distance(c, &c->chosen[i], trays, length));
    return least;
}

static tn_status take(choosing *c, const mpz_t rank, tn_error *error)
{
    plan *p = &c->chosen[c->count];
    p->trays = malloc(((size_t)tn_library_max(c->library) + 1) * sizeof *p->trays);
    if (!p->trays)
        return tn_fail_memory(error);
    if (!tn_library_unrank(c->library, rank, p->trays, &p->length))
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a sampled rank is not in the library");
    mpz_set(c->ranks[c->count++], rank);
    return TN_OK;
}

/* The farthest of some draws; *found is false where each is one of those chosen. Draws are ascending: of equal ones the
 * first has the lowest rank. */
static tn_status choose_next(choosing *c, uint64_t seed, uint32_t length, bool *found, tn_error *error)
{
    size_t drawn, best = 0;
    uint32_t farthest = 0, size;
    uint64_t fresh = tn_random64(seed, c->count, 0);
    tn_status status = tn_library_sample(c->library, fresh, length, DRAWS, c->draws, &drawn, error);
    for (size_t i = 0; status == TN_OK && i < drawn; i++) {
        tn_library_unrank(c->library, c->draws[i], c->candidate, &size);
        uint32_t least = least_distance(c, c->candidate, size, farthest);
        if (least > farthest) {
            farthest = least;
            best = i;
        }
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
    tn_watch *watch = c->schema->module->watch;
    tn_status status = tn_library_sample(c->library, seed, length, 1, c->draws, &drawn, error);
    if (status == TN_OK && drawn > 0)
        status = take(c, c->draws[0], error);
    while (status == TN_OK && found && c->count > 0 && c->count < count) {
        status = choose_next(c, seed, length, &found, error);
        if (status == TN_OK && watch)
            status = tn_watch_check(watch, error);
    }
    qsort(c->ranks, c->count, sizeof *c->ranks, by_rank);
    return status;
}

tn_status tn_library_diverse(const tn_library *library, uint64_t seed, uint32_t length, size_t count, mpz_t *ranks,
                             size_t *found, tn_error *error)
{
    *found = 0;
    if (count == 0)
        return TN_OK;
    size_t room = (size_t)tn_library_max(library) + 1;
    choosing *c = calloc(1, sizeof *c);
    if (!c)
        return tn_fail_memory(error);
    for (size_t i = 0; i < DRAWS; i++)
        mpz_init(c->draws[i]);
    c->library = library;
    c->schema = tn_library_schema(library);
    c->ranks = ranks;
    c->chosen = calloc(count, sizeof *c->chosen);
    c->candidate = malloc(room * sizeof *c->candidate);
    c->row = malloc((room + 1) * sizeof *c->row);
    tn_status status =
        c->chosen && c->candidate && c->row ? choose(c, seed, length, count, error) : tn_fail_memory(error);
    *found = c->count;
    for (size_t i = 0; c->chosen && i < count; i++)
        free(c->chosen[i].trays);
    for (size_t i = 0; i < DRAWS; i++)
        mpz_clear(c->draws[i]);
    free(c->chosen);
    free(c->candidate);
    free(c->row);
    free(c);
    return status;
}
