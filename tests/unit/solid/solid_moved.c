/* Designs that are moved or scaled by decimals are built alike: what ties, ties there too. Random designs with few
 * decimals, so that many centres are as far apart along two axes, and many faces meet. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/random.h"
#include "runtime/load.h"
#include "runtime/solid/measure.h"
#include "tests/support/compile_file.h"
#include "tests/support/share.h"

enum { BOXES_MAX = 7 };

/* In tenths. */
typedef struct plain_box {
    int at[3], size[3];
    bool rigid, by_corners;
} plain_box;

typedef struct plain_design {
    plain_box boxes[BOXES_MAX];
    int count;
    const char *settings;
} plain_design;

/* A number q stands for (by * q + to) tenths of `tens` tens: 1, 10, 100. */
typedef struct change {
    long by, to[3], tens;
} change;

static uint64_t seed, drawn;

static long draw(long low, long high)
{
    return low + (long)(tn_random64(23, seed, drawn++) % (uint64_t)(high - low + 1));
}

/* twice: of a number that is twice as large. */
static void put(FILE *out, const change *c, int axis, long number, bool place, bool twice)
{
    long value = c->by * number + (place ? c->to[axis] * (twice ? 2 : 1) : 0), parts = 10 * c->tens;
    long size = labs(value) * (twice ? 5 : 10); /* one more digit */
    fprintf(out, "%s%ld.%0*ld", value < 0 ? "-" : "", size / (10 * parts),
            c->tens == 1    ? 2
            : c->tens == 10 ? 3
                            : 4,
            size % (10 * parts));
}

static void put_vector(FILE *out, const change *c, const long numbers[3], bool place, bool twice)
{
    for (int k = 0; k < 3; k++) {
        fputs(k ? ", " : "(", out);
        put(out, c, k, numbers[k], place, twice);
    }
    fputs(")", out);
}

static void put_box(FILE *out, const plain_box *b, int number, const change *c)
{
    long at[3], size[3], low[3], high[3];
    for (int k = 0; k < 3; k++) {
        at[k] = b->at[k];
        size[k] = b->size[k];
        low[k] = 2 * at[k] - size[k];
        high[k] = 2 * at[k] + size[k];
    }
    fprintf(out, "  box b%d %s ", number, b->by_corners ? "from" : "at");
    put_vector(out, c, b->by_corners ? low : at, true, b->by_corners);
    fputs(b->by_corners ? " to " : " size ", out);
    put_vector(out, c, b->by_corners ? high : size, b->by_corners, b->by_corners);
    fprintf(out, "%s;\n", b->rigid ? " rigid" : "");
}

static char *text_of(const plain_design *d, const change *c)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fprintf(out, "solid s {\n  noclip;%s\n", d->settings);
    for (int i = 0; i < d->count; i++)
        put_box(out, &d->boxes[i], i, c);
    fputs("}\n", out);
    fclose(out);
    return text;
}

static void build(const char *text, tn_module **module, tn_built *built)
{
    static const library_folders none = {0};
    tn_compilation c;
    tn_error error;
    tn_diagnostics_init(&c.diagnostics, &c.sources);
    if (compile_text("t.solid", text, strlen(text), &none, &c) != TN_OK)
        fail_msg("%s\n%s", c.diagnostics.count ? c.diagnostics.items[0].message : "", text);
    assert_int_equal(tn_module_load(c.module, c.module_size, NULL, module, &error), TN_OK);
    tn_compilation_clear(&c);
    if (tn_built_make(*module, 0, 0, built, &error) != TN_OK)
        fail_msg("%s\n%s", error.message, text);
}

static bool agree(double plain, double changed, const change *c, int axis)
{
    double wanted = ((double)c->by * plain * 10 + (double)c->to[axis]) / (10 * (double)c->tens);
    return fabs(changed - wanted) < 1e-9 * (1 + fabs(wanted));
}

static void compare(const plain_design *d, const change *c)
{
    static const change same = {1, {0}, 1};
    char *texts[2] = {text_of(d, &same), text_of(d, c)};
    tn_module *modules[2];
    tn_built built[2];
    for (int i = 0; i < 2; i++)
        build(texts[i], &modules[i], &built[i]);
    const tn_design *plain = &built[0].built, *changed = &built[1].built;
    bool good = built[0].history.count == built[1].history.count;
    for (uint32_t i = 0; i < plain->box_count && good; i++) {
        const tn_solid_box *p = &plain->boxes[i], *q = &changed->boxes[i];
        good = p->void_ == q->void_;
        for (int k = 0; k < 3 && good && !p->void_; k++)
            good = agree(p->low[k], q->low[k], c, k) && agree(p->high[k], q->high[k], c, k);
    }
    if (!good)
        fail_msg("seed %llu: these are built otherwise:\n%s%s", (unsigned long long)seed, texts[0], texts[1]);
    for (int i = 0; i < 2; i++) {
        tn_built_clear(&built[i]);
        tn_module_free(modules[i]);
        free(texts[i]);
    }
}

/* reach: how far from the middle, in tenths. */
static void make(plain_design *d, const char *settings, int reach)
{
    *d = (plain_design){.count = (int)draw(2, BOXES_MAX), .settings = settings};
    for (int i = 0; i < d->count; i++) {
        plain_box *b = &d->boxes[i];
        b->rigid = draw(0, 5) == 0;
        b->by_corners = draw(0, 1);
        for (int k = 0; k < 3; k++) {
            b->at[k] = (int)draw(-reach, reach);
            b->size[k] = (int)draw(1, 2 * reach);
        }
    }
}

static void test_moved(void **state)
{
    (void)state;
    static const char *const settings[] = {"", " correct penetration;"};
    for (seed = 0; seed < (uint64_t)test_share(6000); seed++) {
        drawn = 0;
        plain_design d;
        make(&d, settings[seed % 2], seed % 3 ? 6 : 40);
        change c = {.by = 1, .tens = seed % 5 == 0 ? 10 : 1};
        c.by = c.tens * draw(1, 3) + (seed % 5 == 0 ? draw(0, 9) : 0);
        for (int k = 0; k < 3; k++)
            c.to[k] = draw(-20000, 20000);
        compare(&d, &c);
    }
}

/* Images lie across planes through the origin, so that these designs are scaled and not moved there. */
static void test_symmetric(void **state)
{
    (void)state;
    static const char *const settings[] = {" symmetry x;", " symmetry y;", " symmetry z;", " symmetry x, z;",
                                           " symmetry x, y, z; correct penetration;"};
    for (seed = 0; seed < (uint64_t)test_share(4000); seed++) {
        drawn = 0;
        plain_design d;
        make(&d, settings[seed % 5], seed % 3 ? 6 : 40);
        change c = {.by = draw(1, 9), .tens = seed % 2 ? 10 : 100};
        if (seed % 5 == 0)
            c.to[1] = draw(-2000, 2000);
        if (seed % 5 == 1)
            c.to[2] = draw(-2000, 2000);
        if (seed % 5 == 2)
            c.to[0] = draw(-2000, 2000);
        compare(&d, &c);
    }
}

/* With a unit, moved by whole numbers of it. */
static void test_unit(void **state)
{
    (void)state;
    static const struct {
        const char *setting;
        long step; /* tenths that are whole units */
    } units[] = {{" unit 1/8;", 5},  {" unit 3/10;", 3},    {" unit 1/3;", 10},    {" unit 2/7;", 20},
                 {" unit 1/10;", 1}, {" unit 1/65536;", 5}, {" unit 0.02/0.3;", 2}};
    enum { UNITS = sizeof units / sizeof *units };
    for (seed = 0; seed < (uint64_t)test_share(6000); seed++) {
        drawn = 0;
        plain_design d;
        make(&d, units[seed % UNITS].setting, 12);
        for (int i = 0; i < d.count; i++)
            for (int k = 0; k < 3; k++)
                d.boxes[i].size[k] += 10; /* so that none is lost between two faces of the grid */
        change c = {.by = 1, .tens = 1};
        for (int k = 0; k < 3; k++)
            c.to[k] = units[seed % UNITS].step * draw(-300, 300);
        compare(&d, &c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_moved), cmocka_unit_test(test_symmetric),
                                       cmocka_unit_test(test_unit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
