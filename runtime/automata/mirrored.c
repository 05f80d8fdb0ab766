/* MIRRORED: stretches on which each letter has the value of the one as far from the other end.
 *
 * The construction reads the stretch's letters and keeps what may still have to be matched: for each middle that has
 * passed, how many of the stretch's first values are left to match, and as many of these values; all of them as long as
 * a middle may be to come.
 */
#include <stdlib.h>

#include "runtime/automata/explore.h"
#include "runtime/automata/marked.h"

typedef struct tn_mirroring {
    tn_join join;
    uint32_t marker;
    const uint32_t *value; /* [letters] */
    uint32_t longest;      /* letters of a word */
    uint64_t effort;
} tn_mirroring;

/* A key is {phase, may a middle be to come, how many middles have passed, what each has left from the most to the
 * least, the values}; the empty key is where nothing is accepted. */
enum { PHASE, OPEN, PASSED, LEFT };

static bool write_head(tn_key *next, uint32_t phase, bool open, const uint32_t *left, uint32_t passed)
{
    bool ok = tn_key_push(next, phase) && tn_key_push(next, open) && tn_key_push(next, passed);
    for (uint32_t i = 0; ok && i < passed; i++)
        ok = tn_key_push(next, left[i]);
    return ok;
}

/* The second marker is good where nothing was read, or a middle has nothing left to match. */
static bool step_marker(const uint32_t *key, size_t size, tn_key *next)
{
    uint32_t passed = key[PASSED];
    if (key[PHASE] == 0)
        return write_head(next, 1, true, NULL, 0);
    bool good = key[PHASE] == 1 && (size == LEFT || (passed > 0 && key[LEFT + passed - 1] == 0));
    return !good || write_head(next, 2, false, NULL, 0);
}

/* After `held` values, the next letter may be a middle (of an odd stretch) or the first behind one (of an even one).
 * Writes what each middle then has left to `left`; how many there are. */
static uint32_t pass_middles(const uint32_t *key, const uint32_t *values, uint32_t held, uint32_t value, uint32_t *left)
{
    uint32_t count = 0;
    if (key[OPEN])
        left[count++] = held;
    if (key[OPEN] && held > 0 && values[held - 1] == value)
        left[count++] = held - 1;
    for (uint32_t i = 0; i < key[PASSED]; i++)
        if (key[LEFT + i] > 0 && values[key[LEFT + i] - 1] == value)
            left[count++] = key[LEFT + i] - 1;
    return count;
}

static bool step_inside(const tn_mirroring *mirroring, const uint32_t *key, size_t size, uint32_t value, tn_key *next)
{
    const uint32_t *values = key + LEFT + key[PASSED];
    uint32_t held = (uint32_t)(size - LEFT - key[PASSED]);
    uint32_t *left = malloc(((size_t)key[PASSED] + 2) * sizeof *left);
    if (!left)
        return false;
    uint32_t passed = pass_middles(key, values, held, value, left);
    bool open = key[OPEN] && held + 1 <= mirroring->longest / 2;
    uint32_t keep = open ? held + 1 : passed > 0 ? left[0] : 0;
    bool ok = passed == 0 || write_head(next, 1, open, left, passed);
    for (uint32_t i = 0; ok && i < keep; i++)
        ok = tn_key_push(next, i < held ? values[i] : value);
    free(left);
    return ok;
}

static bool mirroring_step(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    tn_mirroring *mirroring = context;
    mirroring->effort += size;
    if (size == 0)
        return true;
    if (column == mirroring->marker)
        return step_marker(key, size, next);
    if (key[PHASE] != 1)
        return write_head(next, key[PHASE], key[OPEN], NULL, 0);
    return step_inside(mirroring, key, size, mirroring->value[mirroring->join.letter[column]], next);
}

static bool mirroring_accepts(void *context, const uint32_t *key, size_t size)
{
    (void)context;
    return size > 0 && key[PHASE] == 2;
}

tn_status tn_marked_mirrored(const tn_marked *marked, const uint32_t *values, uint32_t longest, tn_dfa **out,
                             tn_error *error)
{
    tn_mirroring mirroring = {.value = values, .longest = longest};
    tn_key start = {0};
    tn_status status = tn_join_make(&mirroring.join, NULL, 0, marked->letters, values, true, error);
    if (status == TN_OK && !write_head(&start, 0, false, NULL, 0))
        status = tn_fail_memory(error);
    if (status == TN_OK) {
        mirroring.marker = mirroring.join.column[marked->letters - 1];
        tn_construction construction = {"mirrored", &mirroring.join, &mirroring, mirroring_step, mirroring_accepts};
        status = tn_explore(&construction, &start, &mirroring.effort, marked->bounds, out, error);
    }
    free(start.data);
    tn_join_clear(&mirroring.join);
    return status;
}
