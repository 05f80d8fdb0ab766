/* Answers what floor_oracle.py asks of cells. A line of the input is numbers: the way, the clear rectangle, then
 * obstacles, keeps, passages, leaves, landings and what is in the air, each list after its length. A passage is its
 * side, its kind, from, to. A line of the output: the parts; those that each passage and landing touches; keeps;
 * leaves; ways; fits; how long the shortest ways are from the middle of each passage and landing to that of each. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/house/floor/floor.h"
#include "runtime/house/floor/paths.h"

enum { MOST = 64 };

static int64_t number(void)
{
    int64_t value;
    if (scanf("%" SCNd64, &value) != 1)
        exit(1);
    return value;
}

static tn_rectangle rectangle(void)
{
    tn_rectangle r;
    r.x0 = number();
    r.x1 = number();
    r.y0 = number();
    r.y1 = number();
    return r;
}

static size_t length(void)
{
    int64_t count = number();
    if (count < 0 || count > MOST)
        exit(1);
    return (size_t)count;
}

static size_t rectangles(tn_rectangle list[MOST])
{
    size_t count = length();
    for (size_t i = 0; i < count; i++)
        list[i] = rectangle();
    return count;
}

static size_t passages(tn_passage list[MOST])
{
    size_t count = length();
    for (size_t i = 0; i < count; i++) {
        list[i].side = (tn_house_side)number();
        list[i].kind = (tn_passage_kind)number();
        list[i].from = number();
        list[i].to = number();
    }
    return count;
}

static void write_flags(const bool *flags, size_t count)
{
    for (size_t i = 0; i < count; i++)
        printf("%d", flags[i]);
}

static void write_answer(const tn_floor *floor, const tn_floor_answer *answer)
{
    printf("%u;", answer->parts);
    for (size_t i = 0; i < floor->passage_count + floor->landing_count; i++) {
        for (uint32_t part = 0; part < answer->parts; part++)
            if (answer->joined[i * answer->words + part / 64] >> part % 64 & 1)
                printf("%u ", part);
        printf("/");
    }
    printf(";");
    write_flags(answer->keeps, floor->keep_count);
    printf(";");
    write_flags(answer->leaves, floor->leaf_count);
    printf(";%d;%d;", answer->ways, answer->fits);
}

/* False: out of memory, or what is found twice is not the same. */
static bool write_paths(const tn_floor *floor)
{
    tn_point ends[2 * MOST];
    tn_floor_paths paths;
    tn_error error;
    size_t count = 0;
    for (size_t i = 0; i < floor->passage_count; i++) {
        tn_rectangle at = tn_floor_points(floor, &floor->passages[i]);
        ends[count++] = tn_rectangle_middle(&at);
    }
    for (size_t i = 0; i < floor->landing_count; i++)
        ends[count++] = tn_rectangle_middle(&floor->landings[i]);
    bool ok = tn_floor_paths_find(floor, ends, count, &paths, &error) == TN_OK;
    for (size_t i = 0; ok && i < count * count; i++) {
        int64_t length = tn_floor_path(&paths, i / count, i % count);
        ok = length == tn_floor_path(&paths, i % count, i / count);
        if (length == TN_NO_PATH)
            printf("- ");
        else
            printf("%" PRId64 " ", length);
    }
    printf("\n");
    tn_floor_paths_clear(&paths);
    return ok;
}

int main(void)
{
    tn_rectangle obstacles[MOST], keeps[MOST], leaves[MOST], landings[MOST], in_air[MOST];
    tn_passage ways_in[MOST];
    int64_t way;
    while (scanf("%" SCNd64, &way) == 1) {
        tn_floor floor = {.way = way,
                          .obstacles = obstacles,
                          .keeps = keeps,
                          .leaves = leaves,
                          .landings = landings,
                          .in_air = in_air,
                          .passages = ways_in};
        tn_floor_answer answer;
        tn_error error;
        bool fits;
        floor.clear = rectangle();
        floor.obstacle_count = rectangles(obstacles);
        floor.keep_count = rectangles(keeps);
        floor.passage_count = passages(ways_in);
        floor.leaf_count = rectangles(leaves);
        floor.landing_count = rectangles(landings);
        floor.in_air_count = rectangles(in_air);
        if (tn_floor_ask(&floor, &answer, &error) != TN_OK || tn_floor_fits(&floor, &fits, &error) != TN_OK ||
            fits != answer.fits || (answer.fault == TN_FLOOR_FITS) != fits)
            return 1;
        write_answer(&floor, &answer);
        if (!write_paths(&floor))
            return 1;
        tn_floor_answer_clear(&answer);
    }
    return 0;
}
