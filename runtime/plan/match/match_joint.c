/* Matches several rules by joined tables. */
#include "runtime/plan/match/match_joint.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

#define JOINED_STATES_MAX 256u  /* a state is a byte */
#define JOINED_BYTES_MAX 32768u /* of the table of several rules: with the plans it stays in the first-level cache */
#define JOINED_ROWS_MAX 4096u   /* joining takes 2 x 256 bytes a row */
#define ALONE_BYTES_MAX 262144u /* of such a table of one rule: past it the rule's own columns are narrower */
#define NO_NUMBER UINT16_MAX

/* Rules joined so far, from the first state on. */
typedef struct joining {
    uint32_t states;
    uint32_t word;
    uint8_t *next;                    /* [row][JOINED_STATES_MAX] */
    uint64_t bits[JOINED_STATES_MAX]; /* by state */
} joining;

static unsigned shift_for(uint32_t states)
{
    unsigned shift = 0;
    while (UINT32_C(1) << shift < states)
        shift++;
    return shift;
}

static uint64_t table_bytes(const tn_row_map *map, uint32_t states)
{
    return (uint64_t)(map->rows + 1) << shift_for(states);
}

/* ---- joining */

static void join_first(joining *j, const tn_row_map *map, const tn_dfa *dfa, size_t rule)
{
    j->states = dfa->states;
    j->word = (uint32_t)(rule / 64);
    for (uint32_t s = 0; s < dfa->states; s++) {
        for (uint32_t row = 0; row < map->rows; row++)
            j->next[(size_t)row * JOINED_STATES_MAX + s] = (uint8_t)tn_dfa_read(dfa, s, map->letter[row]);
        j->bits[s] = (uint64_t)dfa->accept[s] << rule % 64;
    }
}

/* The states of the product of what is joined and one rule more, found breadth first. */
typedef struct pairs {
    uint32_t count, limit;
    uint8_t left[JOINED_STATES_MAX], right[JOINED_STATES_MAX];
    uint16_t numbers[JOINED_STATES_MAX][JOINED_STATES_MAX];
} pairs;

static uint16_t pair_number(pairs *p, uint8_t left, uint8_t right)
{
    uint16_t *number = &p->numbers[left][right];
    if (*number == NO_NUMBER && p->count < p->limit) {
        p->left[p->count] = left;
        p->right[p->count] = right;
        *number = (uint16_t)p->count++;
    }
    return *number;
}

/* Joins one rule more; false (and nothing is changed that matters) where the product has too many states. */
static bool join_next(joining *j, pairs *p, uint8_t *next, const tn_row_map *map, const tn_dfa *dfa, size_t rule)
{
    if (dfa->states > JOINED_STATES_MAX || j->word != rule / 64)
        return false;
    p->count = 0;
    memset(p->numbers, 0xff, sizeof p->numbers);
    pair_number(p, 0, 0);
    for (uint32_t s = 0; s < p->count; s++) {
        for (uint32_t row = 0; row < map->rows; row++) {
            uint8_t left = j->next[(size_t)row * JOINED_STATES_MAX + p->left[s]];
            uint16_t number = pair_number(p, left, (uint8_t)tn_dfa_read(dfa, p->right[s], map->letter[row]));
            if (number == NO_NUMBER)
                return false;
            next[(size_t)row * JOINED_STATES_MAX + s] = (uint8_t)number;
        }
    }
    uint64_t bits[JOINED_STATES_MAX];
    for (uint32_t s = 0; s < p->count; s++)
        bits[s] = j->bits[p->left[s]] | (uint64_t)dfa->accept[p->right[s]] << rule % 64;
    memcpy(j->bits, bits, sizeof bits);
    j->states = p->count;
    return true;
}

/* ---- tables */

/* Gives the joint its arrays and puts it with the others, which own what it has from here on. */
static tn_status add_table(tn_joints *joints, tn_joint *joint, size_t table_size, size_t bits_count, tn_error *error)
{
    if (!tn_array_resize(&joints->items, joints->count + 1, sizeof *joints->items)) {
        free(joint->column);
        return tn_fail_memory(error);
    }
    joint->table = malloc(table_size);
    joint->bits = calloc(bits_count, sizeof *joint->bits);
    joints->items[joints->count++] = *joint;
    return joint->table && joint->bits ? TN_OK : tn_fail_memory(error);
}

static tn_status finish_joining(tn_joints *joints, const joining *j, const tn_row_map *map, tn_error *error)
{
    tn_joint joint = {.word = j->word, .width = 1, .shift = (uint8_t)shift_for(j->states)};
    tn_status status = add_table(joints, &joint, tn_as_size(table_bytes(map, j->states)), j->states, error);
    if (status != TN_OK)
        return status;
    uint8_t *table = joint.table;
    for (uint32_t s = 0; s < UINT32_C(1) << joint.shift; s++) {
        for (uint32_t row = 0; row < map->rows; row++)
            table[((size_t)row << joint.shift) + s] = s < j->states ? j->next[(size_t)row * JOINED_STATES_MAX + s] : 0;
        table[((size_t)map->rows << joint.shift) + s] = (uint8_t)s;
    }
    memcpy(joint.bits, j->bits, j->states * sizeof *joint.bits);
    return TN_OK;
}

/* A rule alone; the last of its columns is the padding's. */
static tn_status add_alone(tn_joints *joints, const tn_row_map *map, const tn_dfa *dfa, size_t rule, tn_error *error)
{
    uint32_t columns = dfa->columns + 1;
    size_t entries = (size_t)dfa->states * columns;
    tn_joint joint = {.word = (uint32_t)(rule / 64), .width = entries <= UINT16_MAX ? 2 : 4};
    joint.column = malloc(((size_t)map->rows + 1) * sizeof *joint.column);
    tn_status status =
        joint.column ? add_table(joints, &joint, entries * joint.width, entries, error) : tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    for (uint32_t row = 0; row < map->rows; row++)
        joint.column[row] = dfa->column[map->letter[row]];
    joint.column[map->rows] = dfa->columns;
    for (size_t s = 0; s < dfa->states; s++) {
        for (size_t c = 0; c < columns; c++) {
            size_t at = s * columns + c, to = c < dfa->columns ? dfa->delta[s * dfa->columns + c] : s;
            if (joint.width == 2)
                ((uint16_t *)joint.table)[at] = (uint16_t)(to * columns);
            else
                ((uint32_t *)joint.table)[at] = (uint32_t)(to * columns);
        }
        joint.bits[s * columns] = (uint64_t)dfa->accept[s] << rule % 64;
    }
    return TN_OK;
}

static bool is_joinable(const tn_row_map *map, const tn_dfa *dfa)
{
    return map->rows <= JOINED_ROWS_MAX && dfa->states <= JOINED_STATES_MAX &&
           table_bytes(map, dfa->states) <= ALONE_BYTES_MAX;
}

/* The most states that several rules may have together; 0: they are not joined. */
static uint32_t joined_limit(const tn_row_map *map)
{
    uint32_t states = JOINED_STATES_MAX;
    while (states > 0 && table_bytes(map, states) > JOINED_BYTES_MAX)
        states /= 2;
    return states;
}

static tn_status make(tn_joints *joints, joining *j, uint8_t *spare, pairs *p, const tn_row_map *map,
                      tn_dfa *const *dfas, size_t count, const bool *taken, tn_error *error)
{
    tn_status status = TN_OK;
    p->limit = joined_limit(map);
    j->states = 0;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        if (!dfas[i] || taken[i])
            continue;
        if (!is_joinable(map, dfas[i])) {
            status = add_alone(joints, map, dfas[i], i, error);
        } else if (j->states > 0 && join_next(j, p, spare, map, dfas[i], i)) {
            uint8_t *old = j->next;
            j->next = spare;
            spare = old;
        } else {
            if (j->states > 0)
                status = finish_joining(joints, j, map, error);
            join_first(j, map, dfas[i], i);
        }
    }
    return status == TN_OK && j->states > 0 ? finish_joining(joints, j, map, error) : status;
}

tn_status tn_joints_make(tn_joints *joints, const tn_row_map *map, tn_dfa *const *dfas, size_t count, const bool *taken,
                         tn_error *error)
{
    *joints = (tn_joints){0};
    size_t size = map->rows <= JOINED_ROWS_MAX ? (size_t)map->rows * JOINED_STATES_MAX + 1 : 1;
    uint8_t *tables = malloc(2 * size);
    joining *j = malloc(sizeof *j);
    pairs *p = malloc(sizeof *p);
    tn_status status;
    if (tables && j && p) {
        j->next = tables;
        status = make(joints, j, tables + size, p, map, dfas, count, taken, error);
    } else {
        status = tn_fail_memory(error);
    }
    free(tables);
    free(j);
    free(p);
    return status;
}

void tn_joints_clear(tn_joints *joints)
{
    for (size_t i = 0; i < joints->count; i++) {
        free(joints->items[i].table);
        free(joints->items[i].column);
        free(joints->items[i].bits);
    }
    free(joints->items);
    *joints = (tn_joints){0};
}

/* ---- walking */

#define START(k)                                                                                                       \
    size_t state##k = 0;                                                                                               \
    const uint32_t *rows##k = lanes->rows + (k)*stride;
#define FINISH(k) bits[(k)*words] |= joint->bits[state##k];

static void walk_joined(const tn_joint *joint, const tn_lanes *lanes, uint64_t *bits, size_t words)
{
    const uint8_t *table = joint->table;
    size_t stride = lanes->stride;
    unsigned shift = joint->shift;
#define STEP(k) state##k = table[((size_t)rows##k[i] << shift) + state##k];
    TN_WALK_LANES(lanes, START, STEP, FINISH)
#undef STEP
}

#define DEFINE_WALK_ALONE(NAME, TYPE)                                                                                  \
    static void NAME(const tn_joint *joint, const tn_lanes *lanes, uint64_t *bits, size_t words)                       \
    {                                                                                                                  \
        const TYPE *table = joint->table;                                                                              \
        const uint32_t *column = joint->column;                                                                        \
        size_t stride = lanes->stride;                                                                                 \
        TN_WALK_LANES(lanes, START, STEP, FINISH)                                                                      \
    }
#define STEP(k) state##k = table[state##k + column[rows##k[i]]];
DEFINE_WALK_ALONE(walk_alone_16, uint16_t)
DEFINE_WALK_ALONE(walk_alone_32, uint32_t)
#undef STEP
#undef DEFINE_WALK_ALONE
#undef START
#undef FINISH

void tn_joint_walk(const tn_joint *joint, const tn_lanes *lanes, uint64_t *bits, size_t words)
{
    bits += joint->word;
    if (joint->width == 1)
        walk_joined(joint, lanes, bits, words);
    else if (joint->width == 2)
        walk_alone_16(joint, lanes, bits, words);
    else
        walk_alone_32(joint, lanes, bits, words);
}
