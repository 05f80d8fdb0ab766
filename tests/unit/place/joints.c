/* Joints, pieces, cuts and balance of placed models, against answers that are known. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/open/open.h"
#include "runtime/place/measure.h"

static const char kit[] =
    "unit 10 x 8 x 10;\n"
    "connector stud joins tube every 20;\nconnector tube joins stud every 20;\nconnector clip joins clip;\n"
    "part two { fill 40 x 24 x 20; studs up 2 x 1; tubes down 2 x 1 at (0, -24, 0); mass 2; price 3;\n"
    "  clip right at (20, -8, 0); clip left at (-20, -8, 0); }\n"
    "part one { fill 20 x 24 x 20; stud up; tube down at (0, -24, 0); mass 1; }\n";

static tn_opened opened;

static int open_kit(void **state)
{
    (void)state;
    return tn_open_bytes("own.kit", (const uint8_t *)kit, sizeof kit - 1, true, &opened) == TN_OK ? 0 : -1;
}

static int close_kit(void **state)
{
    (void)state;
    tn_close(&opened);
    return 0;
}

static tn_placed_measures measure(tn_placed_part *parts, size_t count)
{
    tn_placed_model model = {.parts = parts, .count = count};
    tn_placed_measures measured;
    assert_int_equal(tn_placed_measure(opened.module, NULL, &model, NULL, &measured, NULL), TN_OK);
    return measured;
}

/* A bridge of three over two posts: the middle one is held by both others. */
static void pieces_and_cuts(void **state)
{
    (void)state;
    tn_placed_part parts[] = {{{{0, -3, 0}, 0, 1}, "two"}, {{{8, -3, 0}, 2, 1}, "two"},  {{{2, -6, 0}, 0, 1}, "two"},
                              {{{6, -6, 0}, 0, 4}, "two"}, {{{40, -9, 0}, 1, 4}, "one"}, {{{40, -6, 0}, 0, 4}, "hat"}};
    tn_placed_measures m = measure(parts, 6);
    assert_int_equal(m.joints.unknown, 1);
    assert_int_equal(m.joints.joint_count, 3); /* two tubes, and the clips of parts 2 and 3 */
    assert_int_equal(m.joints.link_count, 3);
    assert_int_equal(m.joints.component_count, 3);
    assert_int_equal(m.joints.cut_count, 2);
    assert_true(m.joints.cut[2] && m.joints.cut[3] && !m.joints.cut[0]);
    assert_true(m.terms[TN_PLACED_FLOATING] == 2 && m.floating[4] && m.floating[5] && !m.floating[3]);
    assert_true(m.terms[TN_PLACED_OPEN] == 4 * 6 + 2 - 2 * 3);
    assert_true(m.terms[TN_PLACED_ELEMENTS] == 6 && m.terms[TN_PLACED_COLOURS] == 2);
    assert_true(m.terms[TN_PLACED_MASS] == 9 && m.terms[TN_PLACED_PRICE] == 12);
    assert_true(m.terms[TN_PLACED_CELLS] == 4 * 24 + 12 && m.terms[TN_PLACED_OVERLAPS] == 0);
    assert_true(m.terms[TN_PLACED_WIDTH] == 10 * 43 && m.terms[TN_PLACED_HEIGHT] == 9 * 8 &&
                m.terms[TN_PLACED_DEPTH] == 20);
    tn_placed_measures_clear(&m);
}

static void overlaps(void **state)
{
    (void)state;
    tn_placed_part parts[] = {{{{0, 0, 0}, 0, 1}, "two"}, {{{1, 2, 0}, 1, 1}, "one"}, {{{3, 0, 0}, 0, 1}, "one"}};
    tn_placed_measures m = measure(parts, 3);
    assert_true(m.terms[TN_PLACED_OVERLAPS] == 1 && m.overlaps[1] && !m.overlaps[2]);
    tn_placed_measures_clear(&m);
}

/* A brick on its side of a post: its middle is 10 LDU past the foot's middle, whose edge is 10 away. */
static void balance(void **state)
{
    (void)state;
    tn_placed_part parts[] = {{{{0, 0, 0}, 0, 1}, "one"}, {{{1, -3, 0}, 0, 1}, "two"}};
    tn_placed_measures m = measure(parts, 2);
    assert_true(m.terms[TN_PLACED_BALANCE] > 10 - 20.0 / 3 - 1e-9 && m.terms[TN_PLACED_BALANCE] < 10 - 20.0 / 3 + 1e-9);
    tn_placed_measures_clear(&m);
    parts[1].frame.at[0] = 2; /* half of it joins nothing: only its middle counts */
    m = measure(parts, 2);
    assert_true(m.terms[TN_PLACED_BALANCE] < 0);
    tn_placed_measures_clear(&m);
    m = measure(parts, 0);
    assert_true(m.terms[TN_PLACED_BALANCE] == 0 && m.terms[TN_PLACED_COMPONENTS] == 0 &&
                m.terms[TN_PLACED_HEIGHT] == 0);
    tn_placed_measures_clear(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pieces_and_cuts), cmocka_unit_test(overlaps),
                                       cmocka_unit_test(balance)};
    return cmocka_run_group_tests_name("joints", tests, open_kit, close_kit);
}
