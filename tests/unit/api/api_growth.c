/* Growing through the C interface: results, surroundings, cancelling, files in memory, and misuse. */
#include "include/tartan/tartan.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char rules[] = "A + B + A + B\nA -> A [ [ + B ] - B ] A\nB -> B [ [ + A ] - A ] B\nAngle 90\n"
                            "BranchAngle 90\n";

static tartan_module *compile(const char *path, const char *text)
{
    tartan_module *module = NULL;
    tartan_error error;
    if (tartan_compile_text(path, text, strlen(text), NULL, &module, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    return module;
}

static tartan_growth *seed(const tartan_module *module, const tartan_growth_options *options)
{
    tartan_growth *growth = NULL;
    tartan_error error;
    if (tartan_growth_new(module, options, &growth, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    return growth;
}

static tartan_measures measured(tartan_growth *growth)
{
    tartan_measures measures = tartan_measures_init();
    tartan_error error;
    if (tartan_growth_measure(growth, &measures, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    return measures;
}

/* The square's numbers are known: 4^n faces on a grid of 2^n + 1 by 2^n + 1 vertices. */
static void grows_a_square(void **state)
{
    (void)state;
    tartan_module *module = compile("square.hemls", rules);
    assert_true(tartan_module_has_growth(module) && !tartan_module_has_grammar(module));
    tartan_growth *growth = seed(module, NULL);
    for (uint32_t step = 0; step <= 5; step++) {
        assert_int_equal(tartan_growth_grow(growth, step, NULL, NULL), TARTAN_OK);
        tartan_measures m = measured(growth);
        uint64_t side = 1u << step;
        assert_int_equal(m.step, step);
        assert_int_equal(m.faces, side * side);
        assert_int_equal(m.vertices, (side + 1) * (side + 1));
        assert_int_equal(m.edges, 2 * side * (side + 1));
        assert_true(fabs(m.extent - 2 * pow(1.5, step)) < 1e-9);
        assert_int_equal(m.crossed_faces + m.inverted_faces, 0);
        assert_false(m.has_fitness);
    }
    tartan_growth_counts counts = tartan_growth_counts_init();
    assert_int_equal(tartan_growth_last_counts(growth, &counts, NULL), TARTAN_OK);
    assert_true(counts.replaced >= 2 * 16 * 17 && counts.joined > 0);
    assert_int_equal(tartan_growth_grow(growth, 4, NULL, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_growth_restart(growth, NULL), TARTAN_OK);
    assert_int_equal(measured(growth).faces, 1);
    tartan_growth_free(growth);
    tartan_module_free(module);
}

static void gives_arrays(void **state)
{
    (void)state;
    tartan_module *module = compile("square.hemls", rules);
    tartan_growth *growth = seed(module, NULL);
    tartan_mesh *mesh = NULL, *copy = NULL;
    tartan_mesh_options options = tartan_mesh_options_init();
    options.lines = options.groups = true;
    assert_int_equal(tartan_growth_grow(growth, 3, NULL, NULL), TARTAN_OK);
    assert_int_equal(tartan_growth_mesh(growth, &options, &mesh, NULL), TARTAN_OK);
    size_t vertices, faces, lines;
    const uint32_t *corners, *first = tartan_mesh_faces(mesh, &corners, &faces);
    const double *positions = tartan_mesh_positions(mesh, &vertices);
    assert_non_null(tartan_mesh_lines(mesh, &lines));
    assert_true(vertices == 81 && faces == 64 && lines == 144 && first[64] == 256);
    for (size_t c = 0; c < first[faces]; c++)
        assert_true(corners[c] < vertices);
    assert_true(tartan_mesh_group_count(mesh) > 0 && tartan_mesh_face_groups(mesh)[0] < tartan_mesh_group_count(mesh));
    assert_non_null(tartan_mesh_group_name(mesh, 0));
    assert_null(tartan_mesh_group_name(mesh, tartan_mesh_group_count(mesh)));
    double *normals = malloc(3 * vertices * sizeof *normals);
    assert_int_equal(tartan_mesh_normals(mesh, normals, NULL), TARTAN_OK);
    assert_true(fabs(normals[2] - 1) < 1e-12); /* a flat sheet, seen from above */
    free(normals);

    assert_int_equal(tartan_mesh_new(positions, vertices, first, corners, faces, &copy, NULL), TARTAN_OK);
    assert_int_equal(tartan_mesh_triangulate(copy, NULL), TARTAN_OK);
    tartan_mesh_faces(copy, &corners, &faces);
    assert_int_equal(faces, 128);
    assert_int_equal(tartan_mesh_subdivide(copy, 1, NULL), TARTAN_OK);
    tartan_mesh_faces(copy, &corners, &faces);
    assert_int_equal(faces, 512);
    tartan_mesh_free(copy);

    tartan_statistics *statistics = NULL;
    size_t sides, ages;
    uint64_t edges = 0;
    assert_int_equal(tartan_growth_statistics(growth, &statistics, NULL), TARTAN_OK);
    assert_true(tartan_statistics_sides(statistics, &sides)->sides == 4 && sides == 1);
    const tartan_age_count *count = tartan_statistics_ages(statistics, &ages);
    for (size_t i = 0; i < ages; i++)
        edges += count[i].count;
    assert_int_equal(edges, 144);
    assert_false(tartan_statistics_expression(statistics, 0, NULL, NULL));
    tartan_statistics_free(statistics);
    tartan_mesh_free(mesh);
    tartan_growth_free(growth);
    tartan_module_free(module);
}

static void takes_what_the_study_says(void **state)
{
    (void)state;
    char text[] = "rules \"stdlib/square.hemls\"\nsteps 3\nscale 1\nstart-length 2\nseed 9\n"
                  "attractor at 0 0 3 strength 0.5 exponent 1\nfitness undulation target 2\n";
    tartan_module *module = compile("x.study", text);
    tartan_growth_options options = tartan_growth_options_init();
    assert_int_equal(tartan_growth_options_of(module, &options, NULL), TARTAN_OK);
    assert_true(options.steps == 3 && options.scale[1] == 1 && options.start_length == 2 && options.seed == 9);
    tartan_growth *pulled = seed(module, &options);
    options.bare = true;
    tartan_growth *flat = seed(module, &options);
    tartan_force same = {.kind = TARTAN_ATTRACTOR, .at = {0, 0, 3}, .strength = 0.5, .exponent = 1};
    options.forces = &same;
    options.force_count = 1;
    tartan_growth *by_hand = seed(module, &options);
    tartan_growth *all[] = {pulled, flat, by_hand};
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(tartan_growth_grow(all[i], 3, NULL, NULL), TARTAN_OK);
    tartan_measures one = measured(pulled), two = measured(by_hand), none = measured(flat);
    assert_true(none.undulation == 0);
    assert_true(none.high[2] == 0 && one.high[2] > 0.1);
    assert_true(one.has_fitness && one.fitness == fabs(one.undulation - 2) / 2);
    assert_true(one.undulation == two.undulation && one.smoothness == two.smoothness);
    for (size_t i = 0; i < 3; i++)
        tartan_growth_free(all[i]);
    tartan_module_free(module);
}

/* A box of the caller's own, as a mesh, holds the surface in as the box itself does. */
static void keeps_inside_a_solid(void **state)
{
    (void)state;
    static const double p[] = {-2, -2, -2, 2, -2, -2, 2, 2, -2, -2, 2, -2, -2, -2, 2, 2, -2, 2, 2, 2, 2, -2, 2, 2};
    static const uint32_t first[] = {0, 4, 8, 12, 16, 20, 24},
                          corners[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
    tartan_module *module = compile("square.hemls", rules);
    tartan_mesh *box = NULL;
    tartan_growth_options options = tartan_growth_options_init();
    assert_int_equal(tartan_mesh_new(p, 8, first, corners, 6, &box, NULL), TARTAN_OK);
    assert_int_equal(tartan_growth_options_of(module, &options, NULL), TARTAN_OK);
    tartan_boundary boundary = {.kind = TARTAN_SOLID, .mode = TARTAN_SLIDE, .inside = true, .mesh = box};
    options.boundaries = &boundary;
    options.boundary_count = 1;
    tartan_growth *growth = seed(module, &options);
    tartan_mesh_free(box); /* it was copied */
    assert_int_equal(tartan_growth_grow(growth, 6, NULL, NULL), TARTAN_OK);
    tartan_measures m = measured(growth);
    assert_true(m.high[0] <= 2 + 1e-9 && m.low[1] >= -2 - 1e-9 && m.extent > 7);
    tartan_growth_free(growth);
    tartan_module_free(module);
}

typedef struct patience {
    int calls, most;
    double done, total;
} patience;

static bool wait_for(void *context, double done, double total)
{
    patience *p = context;
    p->done = done;
    p->total = total;
    return ++p->calls <= p->most;
}

static void can_be_stopped(void **state)
{
    (void)state;
    tartan_module *module = compile("square.hemls", rules);
    tartan_growth *growth = seed(module, NULL), *other = seed(module, NULL);
    tartan_error error;
    patience none = {.most = 0}, some = {.most = 2};
    tartan_watch watch = tartan_watch_init();
    watch.go_on = wait_for;
    watch.context = &none;
    assert_int_equal(tartan_growth_grow(growth, 5, &watch, &error), TARTAN_STOPPED);
    assert_true(error.status == TARTAN_STOPPED && error.message[0] && none.calls == 1 && none.total == 5);
    assert_int_equal(measured(growth).faces, 1);
    /* in the middle, wherever that falls: what is left is a whole surface, and it goes on as if nothing had been */
    watch.context = &some;
    assert_int_equal(tartan_growth_grow(growth, 10, &watch, &error), TARTAN_STOPPED);
    uint32_t complete = tartan_growth_steps(growth);
    assert_true(complete < 10);
    assert_int_equal(measured(growth).faces, UINT64_C(1) << (2 * complete));
    assert_int_equal(tartan_growth_grow(growth, 10, NULL, &error), TARTAN_OK);
    assert_int_equal(tartan_growth_grow(other, 10, NULL, &error), TARTAN_OK);
    tartan_measures a = measured(growth), b = measured(other);
    assert_memory_equal(&a, &b, sizeof a);
    tartan_growth_free(growth);
    tartan_growth_free(other);
    tartan_module_free(module);
}

static void stops_at_limits(void **state)
{
    (void)state;
    tartan_module *module = compile("square.hemls", rules);
    tartan_growth_options options = tartan_growth_options_init();
    tartan_error error;
    assert_int_equal(tartan_growth_options_of(module, &options, NULL), TARTAN_OK);
    options.edge_limit = 100;
    tartan_growth *growth = seed(module, &options);
    assert_int_equal(tartan_growth_grow(growth, 9, NULL, &error), TARTAN_LIMIT);
    assert_int_equal(tartan_growth_steps(growth), 2);
    assert_int_equal(measured(growth).faces, 16);
    tartan_growth_free(growth);
    tartan_module_free(module);
}

static void writes_files_in_memory(void **state)
{
    (void)state;
    static const char *const begins[] = {"#", "ply", "glTF", "999", NULL, "OFF", NULL};
    tartan_module *module = compile("square.hemls", rules);
    tartan_growth *growth = seed(module, NULL);
    tartan_mesh *mesh = NULL;
    tartan_mesh_options options = tartan_mesh_options_init();
    tartan_mesh_style style = tartan_mesh_style_init();
    options.lines = true;
    style.note = "by the test";
    assert_int_equal(tartan_growth_grow(growth, 2, NULL, NULL), TARTAN_OK);
    assert_int_equal(tartan_growth_mesh(growth, &options, &mesh, NULL), TARTAN_OK);
    for (int format = TARTAN_OBJ; format <= TARTAN_OM; format++) {
        void *bytes = NULL;
        size_t size = 0;
        tartan_error error;
        if (tartan_mesh_write(mesh, (tartan_mesh_format)format, &style, NULL, &bytes, &size, &error) != TARTAN_OK)
            fail_msg("format %d: %s", format, error.message);
        assert_true(size > 100);
        if (begins[format] && format != TARTAN_DXF)
            assert_memory_equal(bytes, begins[format], strlen(begins[format]));
        tartan_bytes_free(bytes);
    }
    static const char *const pictures[] = {"<?xml", "\x89PNG", "%PDF"};
    for (int format = TARTAN_SVG; format <= TARTAN_PDF; format++) {
        void *bytes[2] = {NULL, NULL};
        size_t sizes[2];
        for (int i = 0; i < 2; i++)
            assert_int_equal(
                tartan_growth_draw(growth, (tartan_picture_format)format, NULL, NULL, &bytes[i], &sizes[i], NULL),
                TARTAN_OK);
        assert_memory_equal(bytes[0], pictures[format], strlen(pictures[format]));
        assert_true(sizes[0] == sizes[1] && memcmp(bytes[0], bytes[1], sizes[0]) == 0);
        tartan_bytes_free(bytes[0]);
        tartan_bytes_free(bytes[1]);
    }
    tartan_mesh_free(mesh);
    tartan_growth_free(growth);
    tartan_module_free(module);
}

static void refuses_misuse(void **state)
{
    (void)state;
    tartan_module *module = compile("square.hemls", rules), *plans = compile("x.plan", "schema box { lid = flag }\n");
    tartan_growth *growth = NULL;
    tartan_error error;
    tartan_growth_options options = {0}; /* its size is not set */
    assert_int_equal(tartan_growth_new(module, &options, &growth, &error), TARTAN_INVALID);
    assert_string_equal(error.help, "begin with tartan_growth_options_init()");
    struct {
        tartan_growth_options options;
        char more[8];
    } newer = {.options = tartan_growth_options_init()};
    assert_int_equal(tartan_growth_options_of(module, &newer.options, NULL), TARTAN_OK);
    newer.options.size = sizeof newer;
    assert_int_equal(tartan_growth_new(module, &newer.options, &growth, &error), TARTAN_OK);
    tartan_growth_free(growth);
    growth = NULL;
    newer.more[3] = 1;
    assert_int_equal(tartan_growth_new(module, &newer.options, &growth, &error), TARTAN_INVALID);
    options = tartan_growth_options_init(); /* nothing else is set */
    assert_int_equal(tartan_growth_new(module, &options, &growth, &error), TARTAN_INVALID);
    assert_int_equal(tartan_growth_options_of(module, &options, NULL), TARTAN_OK);
    options.boundary_count = 1;
    assert_int_equal(tartan_growth_new(module, &options, &growth, &error), TARTAN_INVALID);
    tartan_boundary empty = {.kind = TARTAN_SPHERE}, solid = {.kind = TARTAN_SOLID};
    options.boundaries = &empty;
    assert_int_equal(tartan_growth_new(module, &options, &growth, &error), TARTAN_INVALID);
    options.boundaries = &solid;
    assert_int_equal(tartan_growth_new(module, &options, &growth, &error), TARTAN_INVALID);
    assert_int_equal(tartan_growth_new(plans, NULL, &growth, &error), TARTAN_INVALID);
    assert_int_equal(tartan_growth_new(NULL, NULL, &growth, &error), TARTAN_INVALID);
    assert_null(growth);
    assert_int_equal(tartan_growth_grow(NULL, 1, NULL, &error), TARTAN_INVALID);
    assert_int_equal(tartan_growth_mesh(NULL, NULL, NULL, &error), TARTAN_INVALID);
    assert_int_equal(tartan_growth_measure(NULL, NULL, NULL), TARTAN_INVALID);
    growth = seed(module, NULL);
    assert_int_equal(tartan_growth_measure(growth, NULL, &error), TARTAN_INVALID);
    tartan_watch unset = {0};
    assert_int_equal(tartan_growth_grow(growth, 1, &unset, &error), TARTAN_INVALID);
    void *bytes;
    size_t size;
    assert_int_equal(tartan_growth_draw(growth, (tartan_picture_format)9, NULL, NULL, &bytes, &size, &error),
                     TARTAN_INVALID);
    tartan_growth_free(growth);

    tartan_mesh *mesh = NULL;
    static const double p[] = {0, 0, 0, 1, 0, 0, 0, NAN, 0};
    assert_int_equal(tartan_mesh_new(p, 3, (uint32_t[]){0, 3}, (uint32_t[]){0, 1, 2}, 1, &mesh, &error),
                     TARTAN_INVALID);
    assert_int_equal(tartan_mesh_new(p, 2, (uint32_t[]){0, 3}, (uint32_t[]){0, 1, 2}, 1, &mesh, &error),
                     TARTAN_INVALID);
    assert_int_equal(tartan_mesh_new(p, 2, (uint32_t[]){0, 2}, (uint32_t[]){0, 1}, 1, &mesh, &error), TARTAN_INVALID);
    assert_int_equal(tartan_mesh_read("/nowhere/x.obj", &mesh, &error), TARTAN_IO);
    assert_null(mesh);
    tartan_mesh_free(NULL);
    tartan_growth_free(NULL);
    tartan_statistics_free(NULL);
    tartan_module_free(plans);
    tartan_module_free(module);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grows_a_square),
        cmocka_unit_test(gives_arrays),
        cmocka_unit_test(takes_what_the_study_says),
        cmocka_unit_test(keeps_inside_a_solid),
        cmocka_unit_test(can_be_stopped),
        cmocka_unit_test(stops_at_limits),
        cmocka_unit_test(writes_files_in_memory),
        cmocka_unit_test(refuses_misuse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
