/* Joining the branches of one face: asking each for its nearest partner gives what looking at all pairs gives. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/random.h"
#include "runtime/growth/join/join.h"
#include "runtime/math/elementary.h"

enum { BRANCHES = 240, ITEMS = 2 * BRANCHES + 1 };

/* A face made up, without a map around it: its branches leave new vertices. The edges have a face each beyond them, or
 * share a few. */
typedef struct scene {
    tn_growth growth;
    tn_pass pass;
    tn_loop loop;
    uint64_t seed, draws;
} scene;

static uint32_t draw(scene *s, uint32_t below)
{
    return (uint32_t)(tn_random64(s->seed, 0, s->draws++) % below);
}

static tn_vector some_direction(scene *s, uint32_t kind)
{
    static const tn_vector straight[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
    if (kind == 0)
        return straight[draw(s, 5)];
    double angle = draw(s, 3600) / 10.0, up = kind == 1 ? 0 : draw(s, 100) / 100.0 - 0.5;
    return tn_normalised((tn_vector){tn_cos_degrees(angle), tn_sin_degrees(angle), up});
}

/* Places on a coarse grid make many equal distances, and vertices with several branches; a number is drawn for each. */
static void fill(scene *s, uint32_t count, uint32_t grid, uint32_t kind)
{
    uint32_t ids[BRANCHES], labels = 1 + draw(s, 3), beyonds = draw(s, 2) ? 8 : 100000;
    s->loop.branch_count = count;
    s->loop.item_count = 0;
    for (uint32_t i = 0; i < count; i++)
        ids[i] = i;
    for (uint32_t i = count; i-- > 1;) {
        uint32_t j = draw(s, i + 1), swap = ids[i];
        ids[i] = ids[j];
        ids[j] = swap;
    }
    uint32_t vertex = 10;
    if (draw(s, 2))
        s->loop.items[s->loop.item_count++] = (tn_loop_item){.vertex = vertex};
    for (uint32_t i = 0; i < count; i++) {
        tn_loop_branch *branch = &s->loop.branches[i];
        bool again = i > 0 && draw(s, 4) == 0; /* at the vertex of the one before */
        vertex += !again;
        *branch = (tn_loop_branch){.direction = some_direction(s, kind),
                                   .at = {draw(s, grid), draw(s, grid), draw(s, 3)},
                                   .id = ids[i],
                                   .label = draw(s, labels),
                                   .item = s->loop.item_count,
                                   .partner = -1,
                                   .edge = i / 4,
                                   .point = 1 + i % 4,
                                   .beyond = 1 + draw(s, beyonds),
                                   .reversed = draw(s, 4) == 0};
        if (again)
            branch->at = branch[-1].at;
        s->loop.items[s->loop.item_count++] = (tn_loop_item){.vertex = vertex, .value = i, .is_branch = true};
        if (draw(s, 2))
            s->loop.items[s->loop.item_count++] = (tn_loop_item){.vertex = vertex, .value = i};
    }
}

static void start_scene(scene *s, uint64_t seed)
{
    static const double angles[] = {30, 60, 90, 150, 180};
    *s = (scene){.seed = seed};
    s->growth.options = tn_growth_options_default();
    s->growth.options.branch_angle = angles[draw(s, 5)];
    s->growth.branch_cosine = 1e-9 - tn_cos_degrees(s->growth.options.branch_angle);
    s->growth.length = 1.5;
    s->growth.options.facing = draw(s, 4) == 0;
    s->growth.options.branch_length = draw(s, 3) == 0 ? 1.0 + draw(s, 5) : -1;
    s->pass.growth = &s->growth;
    s->loop.items = calloc(ITEMS, sizeof *s->loop.items);
    s->loop.branches = calloc(BRANCHES, sizeof *s->loop.branches);
    s->loop.item_room = ITEMS;
    s->loop.branch_room = BRANCHES;
}

/* The joins undone. */
static void undo(tn_loop *loop)
{
    for (uint32_t i = 0; i < loop->branch_count; i++)
        loop->branches[i].partner = -1;
    for (uint32_t i = 0; i < loop->item_count; i++)
        loop->items[i].region = 0;
    loop->join_count = loop->candidate_count = 0;
}

/* ---- the definition, as plainly as it can be said: of all pairs that may join the first, again and again */

static bool joined_already(const tn_loop *loop, uint32_t u, uint32_t v)
{
    for (uint32_t i = 0; i < loop->branch_count; i++) {
        const tn_loop_branch *branch = &loop->branches[i];
        if (branch->partner >= 0 && loop->items[branch->item].vertex == u &&
            loop->items[loop->branches[branch->partner].item].vertex == v)
            return true;
    }
    return false;
}

static bool may_join(const scene *s, uint32_t i, uint32_t j, bool refused[BRANCHES][BRANCHES], double *distance)
{
    const tn_loop *loop = &s->loop;
    const tn_loop_branch *a = &loop->branches[i], *b = &loop->branches[j];
    const tn_loop_item *x = &loop->items[a->item], *y = &loop->items[b->item];
    bool neighbours = a->edge == b->edge && abs((int)a->point - (int)b->point) == 1;
    return a->partner < 0 && b->partner < 0 && a->label == b->label && x->region == y->region &&
           x->vertex != y->vertex && !neighbours && !refused[i][j] && !joined_already(loop, x->vertex, y->vertex) &&
           tn_branches_compare(&s->growth, a, b, distance) == TN_JOIN_FAILURE_COUNT;
}

static bool find_first(const scene *s, bool refused[BRANCHES][BRANCHES], tn_candidate *first)
{
    bool found = false;
    for (uint32_t i = 0; i < s->loop.branch_count; i++)
        for (uint32_t j = 0; j < s->loop.branch_count; j++) {
            tn_candidate pair = {.low = i, .high = j};
            if (s->loop.branches[i].id < s->loop.branches[j].id && may_join(s, i, j, refused, &pair.distance) &&
                (!found || tn_candidate_before(&s->loop, &pair, first))) {
                *first = pair;
                found = true;
            }
        }
    return found;
}

/* Joins that pair; what lies after its start up to its end becomes a region. */
static void join(scene *s, const tn_candidate *pair)
{
    tn_loop *loop = &s->loop;
    tn_loop_branch *low = &loop->branches[pair->low], *high = &loop->branches[pair->high];
    bool turned = low->reversed && !high->reversed;
    uint32_t start = (turned ? high : low)->item, end = (turned ? low : high)->item;
    uint32_t region = loop->items[start].region;
    low->partner = (int32_t)pair->high;
    high->partner = (int32_t)pair->low;
    loop->join_count++;
    for (uint32_t i = (start + 1) % loop->item_count;; i = (i + 1) % loop->item_count) {
        if (loop->items[i].region == region)
            loop->items[i].region = loop->join_count;
        if (i == end)
            break;
    }
}

static tn_join_outcome join_plainly(scene *s, tn_pair_set *taken)
{
    static bool refused[BRANCHES][BRANCHES];
    memset(refused, 0, sizeof refused);
    tn_candidate pair = {0};
    while (find_first(s, refused, &pair)) {
        const tn_loop_branch *a = &s->loop.branches[pair.low], *b = &s->loop.branches[pair.high];
        uint32_t u = s->loop.items[a->item].vertex, v = s->loop.items[b->item].vertex;
        if (a->beyond == b->beyond && !taken)
            return TN_JOIN_LATER;
        if (a->beyond == b->beyond && tn_pair_set_has(taken, u, v)) {
            refused[pair.low][pair.high] = true;
            continue;
        }
        if (a->beyond == b->beyond)
            assert_true(tn_pair_set_add(taken, u, v));
        join(s, &pair);
    }
    return TN_JOINED;
}

/* ---- comparing */

typedef struct result {
    tn_join_outcome outcome;
    uint32_t joins;
    int32_t partners[BRANCHES];
    uint32_t regions[ITEMS];
    size_t taken;
} result;

typedef tn_join_outcome (*way)(scene *s, tn_pair_set *taken);

static tn_join_outcome join_few(scene *s, tn_pair_set *taken)
{
    return tn_loop_join_few(&s->loop, &s->pass, 1, taken);
}

static tn_join_outcome join_many(scene *s, tn_pair_set *taken)
{
    return tn_loop_join_many(&s->loop, &s->pass, 1, taken);
}

/* `waiting`: the face may have to wait for others; else it is asked in order, and some pairs were taken by others. */
static void run(scene *s, way how, bool waiting, result *got)
{
    tn_pair_set taken = {0};
    undo(&s->loop);
    for (uint32_t v = 10; v < 60; v++)
        assert_true(tn_pair_set_add(&taken, v, v + 20));
    memset(got, 0, sizeof *got);
    got->outcome = how(s, waiting ? NULL : &taken);
    got->taken = taken.count;
    tn_pair_set_clear(&taken);
    if (got->outcome != TN_JOINED)
        return;
    got->joins = s->loop.join_count;
    for (uint32_t i = 0; i < s->loop.branch_count; i++)
        got->partners[i] = s->loop.branches[i].partner;
    for (uint32_t i = 0; i < s->loop.item_count; i++)
        got->regions[i] = s->loop.items[i].region;
}

static void test_all_ways_agree(void **state)
{
    (void)state;
    uint32_t joins = 0, later = 0;
    for (uint64_t seed = 1; seed <= 150; seed++) {
        scene s;
        result plain, few, many;
        start_scene(&s, seed);
        fill(&s, seed % 10 ? 2 + draw(&s, 60) : BRANCHES, seed % 3 ? 6 : 40, draw(&s, 3));
        for (int waiting = 0; waiting < 2; waiting++) {
            run(&s, join_plainly, waiting, &plain);
            run(&s, join_few, waiting, &few);
            run(&s, join_many, waiting, &many);
            assert_memory_equal(&plain, &few, sizeof plain);
            assert_memory_equal(&plain, &many, sizeof plain);
            joins += plain.joins;
            later += plain.outcome == TN_JOIN_LATER;
        }
        tn_loop_clear(&s.loop);
    }
    assert_true(joins > 1000);
    assert_true(later > 10);
}

/* ---- why branches did not join */

static tn_join_failure furthest(const scene *s, uint32_t i)
{
    tn_join_failure most = TN_FAIL_LABEL;
    const tn_loop_branch *a = &s->loop.branches[i];
    for (uint32_t j = 0; j < s->loop.branch_count; j++) {
        const tn_loop_branch *b = &s->loop.branches[j];
        double distance;
        if (i == j || a->label != b->label)
            continue;
        tn_join_failure how = TN_FAIL_ADJACENT;
        if (s->loop.items[a->item].vertex != s->loop.items[b->item].vertex) {
            how = tn_branches_compare(&s->growth, a, b, &distance);
            bool taken = b->partner >= 0 || s->loop.items[a->item].region != s->loop.items[b->item].region;
            if (how == TN_JOIN_FAILURE_COUNT)
                how = taken ? TN_FAIL_TAKEN : TN_FAIL_ADJACENT;
        }
        most = how > most ? how : most;
    }
    return most;
}

static void test_reasons(void **state)
{
    (void)state;
    uint64_t all[TN_JOIN_FAILURE_COUNT] = {0};
    for (uint64_t seed = 1; seed <= 200; seed++) {
        scene s;
        result got;
        uint64_t expected[TN_JOIN_FAILURE_COUNT] = {0}, counted[TN_JOIN_FAILURE_COUNT] = {0};
        start_scene(&s, seed);
        fill(&s, 1 + draw(&s, seed % 4 ? 8 : BRANCHES), 20, draw(&s, 3));
        run(&s, join_many, false, &got);
        for (uint32_t i = 0; i < s.loop.branch_count; i++)
            if (s.loop.branches[i].partner < 0)
                expected[furthest(&s, i)]++;
        assert_true(tn_loop_explain(&s.loop, &s.pass, counted));
        assert_memory_equal(expected, counted, sizeof expected);
        for (int k = 0; k < TN_JOIN_FAILURE_COUNT; k++)
            all[k] += counted[k];
        tn_loop_clear(&s.loop);
    }
    for (int k = TN_FAIL_LABEL; k < TN_JOIN_FAILURE_COUNT; k++)
        assert_true(all[k] > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_ways_agree),
        cmocka_unit_test(test_reasons),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
