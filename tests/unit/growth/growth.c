/* Growing: closed forms, the map's promises after every step, threads, limits, rest, and the surroundings' corner
 * cases. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/memory.h"
#include "runtime/growth/growth.h"
#include "runtime/growth/stats.h"
#include "runtime/growth/study.h"
#include "runtime/growth/surface.h"
#include "runtime/load.h"
#include "runtime/mesh/openmesh.h"
#include "tests/support/compile_file.h"

typedef struct grown {
    tn_compilation compilation;
    tn_module *module;
    tn_growth_system *system;
    tn_study study;
    tn_growth *growth;
} grown;

static const char *const dirs[] = {TARTAN_SOURCE_DIR "/stdlib"};

static void plant_text(grown *g, const char *path, const char *text)
{
    library_folders options = {.stdlib_dirs = dirs, .stdlib_dir_count = 1};
    tn_error error = {0};
    memset(g, 0, sizeof *g);
    if (compile_text(path, text, strlen(text), &options, &g->compilation) != TN_OK)
        fail_msg("%s", g->compilation.diagnostics.count ? g->compilation.diagnostics.items[0].message : "no module");
    tn_status status = tn_module_load(g->compilation.module, g->compilation.module_size, NULL, &g->module, &error);
    if (status == TN_OK)
        status = tn_growth_system_read(g->module, &g->system, &error);
    if (status == TN_OK)
        status = tn_study_read(g->module, path, &tn_openmesh_reader, &g->study, &error);
    if (status == TN_OK)
        status = tn_growth_new(g->system, &g->study.environment, &g->study.options, &g->growth, &error);
    if (status != TN_OK)
        fail_msg("%s", error.message);
}

static void replant(grown *g)
{
    tn_error error;
    tn_growth_free(g->growth);
    assert_int_equal(tn_growth_new(g->system, &g->study.environment, &g->study.options, &g->growth, &error), TN_OK);
}

static void uproot(grown *g)
{
    tn_growth_free(g->growth);
    tn_growth_system_free(g->system);
    tn_study_clear(&g->study);
    tn_module_free(g->module);
    tn_compilation_clear(&g->compilation);
}

static void step(grown *g)
{
    tn_error error = {0};
    if (tn_growth_step(g->growth, &error) != TN_OK)
        fail_msg("step %u: %s", tn_growth_steps(g->growth) + 1, error.message);
    if (tn_map_validate(tn_growth_map(g->growth), &error) != TN_OK)
        fail_msg("after step %u: %s", tn_growth_steps(g->growth), error.message);
}

static void assert_counts(const grown *g, uint64_t vertices, uint64_t edges, uint64_t faces)
{
    const tn_map *map = tn_growth_map(g->growth);
    assert_int_equal(map->vertex_count, vertices);
    assert_int_equal(map->edge_count, edges);
    assert_int_equal(map->face_count - 1, faces);
}

static void test_square_and_triangle_have_their_closed_forms(void **state)
{
    (void)state;
    grown square, triangle;
    plant_text(&square, "t.study", "rules \"square\"");
    plant_text(&triangle, "t.study", "rules \"triangle\"");
    for (uint64_t n = 0; n <= 10; n++) {
        uint64_t m = UINT64_C(1) << n;
        assert_counts(&square, (m + 1) * (m + 1), 2 * m * (m + 1), m * m);
        assert_counts(&triangle, (m + 1) * (m + 2) / 2, n ? 3 * (m / 2) * (m + 1) : 3, m * m);
        if (n < 10) {
            step(&square);
            step(&triangle);
        }
    }
    uproot(&square);
    uproot(&triangle);
}

static void test_other_closed_forms(void **state)
{
    (void)state;
    grown koch, alternate, apical, ruffle;
    plant_text(&koch, "t.study", "rules \"koch\" scale 1");
    plant_text(&alternate, "t.study", "rules \"alternate\"");
    plant_text(&apical, "t.study", "rules \"apical\"");
    plant_text(&ruffle, "t.study", "rules \"ruffle\" scale 1.25");
    for (uint32_t n = 0; n <= 10; n++) {
        assert_counts(&koch, 3u << 2 * n, 3u << 2 * n, 1);
        assert_int_equal(tn_growth_map(alternate.growth)->face_count - 1, 1u << n);
        assert_int_equal(tn_growth_map(apical.growth)->face_count - 1, n + 1);
        if (n > 0 && n < 10) /* in the tenth step ruffles cross, and 16 branches find none against them */
            assert_int_equal(tn_growth_map(ruffle.growth)->face_count - 1, (4u << n) - 4);
        if (n == 10)
            break;
        step(&koch);
        step(&alternate);
        step(&apical);
        step(&ruffle);
    }
    uproot(&koch);
    uproot(&alternate);
    uproot(&apical);
    uproot(&ruffle);
}

/* Ranks are there once a face had to wait for another. */
static uint64_t bytes_hash(const grown *g, bool ranked)
{
    const tn_map *map = tn_growth_map(g->growth);
    uint64_t hash = map->face_count;
    const unsigned char *parts[] = {(const unsigned char *)map->positions,  (const unsigned char *)map->states,
                                    (const unsigned char *)map->origin,     (const unsigned char *)map->side,
                                    (const unsigned char *)map->face_first, (const unsigned char *)map->face_rank};
    size_t ranks = ranked && map->face_rank ? map->face_count : 0;
    size_t sizes[] = {24 * (size_t)map->vertex_count, 4 * (size_t)map->edge_count, 8 * (size_t)map->edge_count,
                      8 * (size_t)map->edge_count,    4 * (size_t)map->face_count, 4 * ranks};
    for (int i = 0; i < 6; i++)
        for (size_t b = 0; b < sizes[i]; b++)
            hash = (hash ^ parts[i][b]) * 1099511628211u;
    return hash;
}

/* Everything at once: forces, walls, random choices, contexts, branches that wait for later rules. */
static void test_any_number_of_threads_gives_the_same_bytes(void **state)
{
    (void)state;
    static const char *const studies[] = {("rules \"square\" attractor at 3 2 2 strength 1 exponent 1.5 gravity 0 0 "
                                           "-0.2 boundary sphere at 0 0 -1 radius 0.9"),
                                          "rules \"triangle\"", "rules \"probabilistic\" seed 5", "rules \"ruffle\"",
                                          "rules \"context\""};
    for (size_t i = 0; i < sizeof studies / sizeof *studies; i++) {
        grown g;
        uint64_t expected = 0;
        plant_text(&g, "t.study", studies[i]);
        for (int threads = 1; threads <= 4; threads++) {
            g.study.options.threads = threads;
            replant(&g);
            for (int n = 0; n < 7; n++)
                step(&g);
            if (threads == 1)
                expected = bytes_hash(&g, true);
            assert_true(bytes_hash(&g, true) == expected);
        }
        uproot(&g);
    }
}

/* Asked why branches did not join, growing works every face out by itself. */
static void test_faces_alike_are_cut_as_each_by_itself(void **state)
{
    (void)state;
    static const char *const systems[][2] = {
        {"t.study", "rules \"square\" attractor at 3 2 2 strength 1 exponent 1.5 gravity 0 0 -0.2"},
        {"t.study", "rules \"triangle\" branch-length 2 repeller at 1 1 0 strength 0.5"},
        {"t.hemls", "A + B + A; A -> A [ [ + B ] - B ] B; -> A [ + A ] B [ - B ] A Weight 2\nB -> A [ [ + B ] - B ] A;"
                    "Angle 60; BranchAngle 90; Sync"}};
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        uint64_t hashes[2];
        grown g;
        plant_text(&g, systems[i][0], systems[i][1]);
        for (int alone = 0; alone < 2; alone++) {
            g.study.options.explain = alone;
            replant(&g);
            while (tn_growth_map(g.growth)->face_count < 5000 && tn_growth_steps(g.growth) < 14)
                step(&g);
            assert_true(tn_growth_map(g.growth)->face_count > 1000);
            hashes[alone] = bytes_hash(&g, true);
        }
        assert_true(hashes[0] == hashes[1]);
        uproot(&g);
    }
}

/* The order of faces is no longer kept once there are thousands; where a face then has to wait for another (branches on
 * both sides of an edge, which might link the same two vertices), it is found again. */
static void test_faces_wait_in_a_large_surface(void **state)
{
    (void)state;
    static const char text[] = "A + B + A + B\n"
                               "A -> A_i+1 [ [ + + B_i ] - - B_i ] A_i+1 If i < 6\n"
                               "  -> A [ [ + C ] - C ] A A [ [ + + + C ] - - - C ] A\n"
                               "B -> B_i+1 [ [ + + A_i+1 ] - - A_i+1 ] B_i+1 If i < 6\n"
                               "  -> B [ [ + C ] - C ] B B [ [ + + + C ] - - - C ] B\n"
                               "Angle 45; BranchAngle 90";
    grown g;
    uint64_t expected = 0;
    plant_text(&g, "t.hemls", text);
    for (int threads = 1; threads <= 3; threads += 2) {
        g.study.options.threads = threads;
        replant(&g);
        for (int n = 0; n < 6; n++)
            step(&g);
        assert_int_equal(tn_growth_map(g.growth)->face_count, 4097);
        step(&g);
        assert_non_null(tn_growth_map(g.growth)->face_rank);
        expected = threads == 1 ? bytes_hash(&g, true) : expected;
        assert_true(bytes_hash(&g, true) == expected);
    }
    uproot(&g);
}

static void test_growing_again_gives_the_same_bytes(void **state)
{
    (void)state;
    grown g;
    tn_error error;
    plant_text(&g, "t.study", "rules \"probabilistic\" seed 9");
    for (int n = 0; n < 5; n++)
        step(&g);
    uint64_t expected = bytes_hash(&g, false);
    step(&g);
    assert_int_equal(tn_growth_regrow(g.growth, 5, &error), TN_OK);
    assert_true(bytes_hash(&g, false) == expected);
    assert_int_equal(tn_growth_steps(g.growth), 5);
    uproot(&g);
}

/* Also after a growth that failed half-way, and after one that was refused. */
static void test_growing_in_used_memory_gives_the_same_bytes(void **state)
{
    (void)state;
    static const char *const studies[] = {"rules \"square\" steps 6",
                                          "rules \"probabilistic\" seed 5 steps 4",
                                          "rules \"square\" edge-limit 100 steps 4",
                                          "rules \"context\" steps 5 gravity 0 0 -1",
                                          "rules \"koch\" steps 0",
                                          "rules \"triangle\" steps 5"};
    tn_error error;
    grown used, fresh;
    plant_text(&used, "t.study", "rules \"square\"");
    for (size_t i = 0; i < sizeof studies / sizeof *studies; i++) {
        plant_text(&fresh, "t.study", studies[i]);
        tn_growth_options bad = fresh.study.options;
        bad.scale[2] = -1;
        assert_int_equal(tn_growth_renew(used.growth, fresh.system, &fresh.study.environment, &bad, &error),
                         TN_INVALID);
        assert_int_equal(
            tn_growth_renew(used.growth, fresh.system, &fresh.study.environment, &fresh.study.options, &error), TN_OK);
        tn_status status[2] = {TN_OK, TN_OK};
        for (uint32_t n = 0; n < fresh.study.steps; n++) {
            status[0] = status[0] == TN_OK ? tn_growth_step(fresh.growth, &error) : status[0];
            status[1] = status[1] == TN_OK ? tn_growth_step(used.growth, &error) : status[1];
        }
        assert_int_equal(status[0], status[1]);
        if (status[0] == TN_OK)
            assert_true(bytes_hash(&fresh, true) == bytes_hash(&used, true));
        uproot(&fresh);
    }
    uproot(&used);
}

static void test_limits_stop_a_step(void **state)
{
    (void)state;
    grown g;
    tn_error error = {0};
    plant_text(&g, "t.study", "rules \"square\" edge-limit 100");
    for (int n = 0; n < 2; n++)
        step(&g);
    assert_int_equal(tn_growth_step(g.growth, &error), TN_LIMIT);
    assert_int_equal(error.code, 840);
    assert_non_null(strstr(error.help, "--edge-limit"));
    uproot(&g);

    plant_text(&g, "t.study", "rules \"square\"");
    tn_watch watch = {.memory_limit = tn_memory_used() + (16 << 20)};
    g.study.options.watch = &watch;
    replant(&g);
    tn_status status = TN_OK;
    for (int n = 0; n < 12 && status == TN_OK; n++)
        status = tn_growth_step(g.growth, &error);
    assert_int_equal(status, TN_LIMIT);
    assert_int_equal(error.code, E_MEMORY_LIMIT);
#ifndef __SANITIZE_ADDRESS__ /* which keeps what was freed for a while; an emulator holds memory of its own */
    assert_true(getenv("TARTAN_TESTS_EMULATED") || tn_memory_used() <= watch.memory_limit);
#endif
    g.study.options.watch = NULL;
    uproot(&g);

    plant_text(&g, "t.study", "rules \"square\" scale 1e11");
    status = TN_OK;
    g.study.options.edge_limit = 0;
    for (int n = 0; n < 40 && status == TN_OK; n++) {
        status = tn_growth_step(g.growth, &error);
        if (n == 7) /* the mesh is large enough: only the size matters now */
            break;
    }
    uproot(&g);

    plant_text(&g, "t.hemls", "A + A + A; A -> A; Angle 90");
    for (int k = 0; k < 3; k++)
        g.study.options.scale[k] = 1e12;
    replant(&g);
    status = TN_OK;
    for (int n = 0; n < 40 && status == TN_OK; n++)
        status = tn_growth_step(g.growth, &error);
    assert_int_equal(status, TN_LIMIT);
    assert_int_equal(error.code, 842);
    uproot(&g);
}

/* Builds with TARTAN_CHECK_MAPS, as those with sanitizers are, find a broken map in the step that breaks it. */
static void test_sanitized_growing_checks_its_map(void **state)
{
    (void)state;
    grown g;
    tn_error error;
    plant_text(&g, "t.hemls", "A + A + A; Angle 60"); /* no rule reads the map */
    uint32_t *origin = tn_growth_map(g.growth)->origin, first = origin[0];
    origin[0] = origin[1];
    origin[1] = first;
#ifdef TARTAN_CHECK_MAPS
    assert_int_equal(tn_growth_step(g.growth, &error), TN_INTERNAL);
#else
    assert_int_equal(tn_growth_step(g.growth, &error), TN_OK);
    assert_int_equal(tn_map_validate(tn_growth_map(g.growth), &error), TN_INTERNAL);
#endif
    uproot(&g);
}

static void test_rest_is_noticed(void **state)
{
    (void)state;
    grown g;
    plant_text(&g, "t.study", "rules \"timed\" scale 1");
    for (int n = 0; n < 4; n++) {
        step(&g);
        assert_false(tn_growth_at_rest(g.growth));
    }
    step(&g); /* edges still age: nothing rests while ages grow */
    assert_false(tn_growth_at_rest(g.growth));
    uproot(&g);

    plant_text(&g, "t.hemls", "A + A + A; A -> B [ + C ] B; Angle 60; Sync");
    for (int k = 0; k < 3; k++)
        g.study.options.scale[k] = 1;
    replant(&g);
    int n = 0;
    for (; n < 10 && !tn_growth_at_rest(g.growth); n++)
        step(&g);
    assert_int_equal(n, 3);
    uproot(&g);
}

/* ---- surroundings */

static void test_a_vertex_at_an_attractor_stays(void **state)
{
    (void)state;
    tn_force force = {TN_ATTRACTOR, {1, 2, 3}, 5, 2};
    tn_environment environment = {&force, 1, NULL, 0};
    tn_vector f = tn_environment_force(&environment, (tn_vector){1, 2, 3});
    assert_true(f.x == 0 && f.y == 0 && f.z == 0);
    f = tn_environment_force(&environment, (tn_vector){1, 2, 5});
    assert_true(fabs(f.z + 5.0 / 4) < 1e-15 && f.x == 0);
    force.kind = TN_REPELLER;
    force.exponent = 1;
    f = tn_environment_force(&environment, (tn_vector){1, 2, 5});
    assert_true(fabs(f.z - 5.0 / 2) < 1e-15);
}

static void test_walls_that_meet_stop_what_slides(void **state)
{
    (void)state;
    tn_boundary walls[2] = {{.kind = TN_BOUNDARY_PLANE, .b = {0, 0, 1}},
                            {.kind = TN_BOUNDARY_PLANE, .a = {2, 0, 0}, .b = {-1, 0, 0}}};
    tn_environment environment = {NULL, 0, walls, 2};
    tn_vector y = tn_environment_move(&environment, (tn_vector){0, 0, 1}, (tn_vector){4, 1, -2});
    assert_true(fabs(y.z) < 1e-12 && fabs(y.x - 2) < 1e-12); /* into the corner; the second wall ends the slide */
    assert_true(y.y > 0 && y.y < 1);
    walls[0].mode = TN_STOP;
    y = tn_environment_move(&environment, (tn_vector){0, 0, 1}, (tn_vector){1, 0, -2});
    assert_true(fabs(y.x - 0.5) < 1e-12 && fabs(y.z) < 1e-12);
    walls[0].mode = TN_SOFT;
    y = tn_environment_move(&environment, (tn_vector){0, 0, 1}, (tn_vector){1, 0, -2});
    assert_true(y.z == -1 && tn_environment_trespasses(&environment, y));
    assert_false(tn_environment_trespasses(&environment, (tn_vector){9, 0, 1})); /* the other wall is not soft */
}

/* A unit cube about the origin, and the same without its top. */
static const double cube_points[8][3] = {{-.5, -.5, -.5}, {.5, -.5, -.5}, {.5, .5, -.5}, {-.5, .5, -.5},
                                         {-.5, -.5, .5},  {.5, -.5, .5},  {.5, .5, .5},  {-.5, .5, .5}};
static const uint32_t cube_faces[12][3] = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                           {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}, {4, 5, 6}, {4, 6, 7}};

static void test_a_closed_mesh_is_a_solid(void **state)
{
    (void)state;
    tn_boundary_mesh *mesh;
    tn_error error;
    assert_int_equal(tn_boundary_mesh_new(&cube_points[0][0], 8, &cube_faces[0][0], 12, &mesh, &error), TN_OK);
    assert_true(tn_boundary_mesh_is_solid(mesh));
    assert_true(fabs(tn_boundary_mesh_distance(mesh, (tn_vector){0, 0, 0}, NULL) + 0.5) < 1e-12);
    assert_true(fabs(tn_boundary_mesh_distance(mesh, (tn_vector){1.5, 0, 0}, NULL) - 1) < 1e-12);
    assert_true(fabs(tn_boundary_mesh_distance(mesh, (tn_vector){1, 1, 1}, NULL) - sqrt(0.75)) <
                1e-12); /* off a corner */
    tn_boundary wall = {.kind = TN_BOUNDARY_MESH, .mesh = mesh};
    tn_boundary box = {.kind = TN_BOUNDARY_BOX, .a = {-.5, -.5, -.5}, .b = {.5, .5, .5}};
    tn_environment meshed = {NULL, 0, &wall, 1}, boxed = {NULL, 0, &box, 1};
    /* The same as the box of that shape, from many sides. */
    for (int i = 0; i < 400; i++) {
        double a = i * 0.7, b = i * 0.31;
        tn_vector x = {1.2 * cos(a), 1.1 * sin(a), 1.3 * sin(b)}, d = {-cos(a) * 1.5, 0.4 * sin(b), -sin(b)};
        if (tn_boundary_mesh_distance(mesh, x, NULL) <= 0)
            continue;
        tn_vector p = tn_environment_move(&meshed, x, d), q = tn_environment_move(&boxed, x, d);
        if (tn_norm(tn_sub(p, q)) > 1e-6) /* past an edge of the box, only the mesh knows a second wall */
            assert_true(fabs(tn_boundary_mesh_distance(mesh, p, NULL)) < 1e-6);
        assert_true(tn_boundary_mesh_distance(mesh, p, NULL) > -1e-9);
    }
    tn_boundary_mesh_free(mesh);
}

static void test_a_mesh_with_a_hole_is_a_membrane(void **state)
{
    (void)state;
    tn_boundary_mesh *mesh;
    tn_error error;
    assert_int_equal(tn_boundary_mesh_new(&cube_points[0][0], 8, &cube_faces[0][0], 10, &mesh, &error), TN_OK);
    assert_false(tn_boundary_mesh_is_solid(mesh));
    tn_boundary wall = {.kind = TN_BOUNDARY_MESH, .mesh = mesh, .mode = TN_STOP};
    tn_environment environment = {NULL, 0, &wall, 1};
    tn_vector in =
        tn_environment_move(&environment, (tn_vector){0, 0, 2}, (tn_vector){0, 0, -2}); /* through the hole */
    assert_true(fabs(in.z) < 1e-12);
    tn_vector down = tn_environment_move(&environment, in, (tn_vector){0, 0, -2}); /* not through the bottom */
    assert_true(fabs(down.z + 0.5) < 1e-7);
    down = tn_environment_move(&environment, down, (tn_vector){0, 0, -2}); /* nor from where it was stopped */
    assert_true(fabs(down.z + 0.5) < 1e-7);
    tn_vector out = tn_environment_move(&environment, (tn_vector){0, 0, -2}, (tn_vector){0, 0, 2}); /* nor from below */
    assert_true(out.z < -0.5 && fabs(out.z + 0.5) < 1e-7);
    tn_boundary_mesh_free(mesh);
}

/* New vertices stay on their edge's side of a membrane, also where it has wrinkles that the edge passes through. */
static void test_new_vertices_stay_before_a_membrane(void **state)
{
    (void)state;
    static const double points[10][3] = {{-2, -1, 1}, {-2, 1, 1},    {0, -1, 0},   {0, 1, 0},  {1, -1, 0.5},
                                         {1, 1, 0.5}, {1.5, -1, -1}, {1.5, 1, -1}, {3, -1, 1}, {3, 1, 1}};
    static const uint32_t faces[8][3] = {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5},
                                         {4, 6, 5}, {5, 6, 7}, {6, 8, 7}, {7, 8, 9}};
    tn_boundary_mesh *mesh;
    tn_error error;
    assert_int_equal(tn_boundary_mesh_new(&points[0][0], 10, &faces[0][0], 8, &mesh, &error), TN_OK);
    tn_boundary wall = {.kind = TN_BOUNDARY_MESH, .mesh = mesh, .mode = TN_STOP};
    tn_environment environment = {NULL, 0, &wall, 1};
    /* From below on both sides of the valley at x = 0: the middle of the edge is above it, and comes down. */
    tn_vector p =
        tn_environment_place(&environment, (tn_vector){0, 0, 0.3}, (tn_vector){-1.8, 0, 0.3}, (tn_vector){0.9, 0, 0.3});
    assert_true(tn_boundary_mesh_distance(mesh, p, NULL) < 1.1e-8);
    assert_true(p.z < (p.x < 0 ? -0.5 * p.x : 0.5 * p.x));
    /* Under the ridge at x = 1, the way from the left through the valley, the way from the right through the next. */
    p = tn_environment_place(&environment, (tn_vector){1, 0, 0.2}, (tn_vector){-1.8, 0, 0.2}, (tn_vector){2.8, 0, 0.2});
    assert_true(p.x == 1 && p.y == 0 && p.z == 0.2);
    /* Nothing in the way; and what is soft lets everything pass. */
    p = tn_environment_place(&environment, (tn_vector){0, 0, -3}, (tn_vector){-1, 0, -3}, (tn_vector){1, 0, -3});
    assert_true(p.z == -3);
    wall.mode = TN_SOFT;
    p = tn_environment_place(&environment, (tn_vector){0, 0, 0.3}, (tn_vector){-1.8, 0, 0.3}, (tn_vector){0.9, 0, 0.3});
    assert_true(p.z == 0.3);
    tn_boundary_mesh_free(mesh);
}

static void test_bad_boundary_meshes_are_refused(void **state)
{
    (void)state;
    tn_boundary_mesh *mesh;
    tn_error error;
    const double flat[3][3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, wild[3][3] = {{0, 0, 0}, {1, 0, 0}, {NAN, 0, 0}};
    const uint32_t one[3] = {0, 1, 2}, beyond[3] = {0, 1, 3};
    assert_int_equal(tn_boundary_mesh_new(&flat[0][0], 3, one, 1, &mesh, &error), TN_INVALID);
    assert_int_equal(tn_boundary_mesh_new(&wild[0][0], 3, one, 1, &mesh, &error), TN_INVALID);
    assert_int_equal(tn_boundary_mesh_new(&flat[0][0], 3, beyond, 1, &mesh, &error), TN_INVALID);
    assert_int_equal(tn_boundary_mesh_new(&flat[0][0], 3, one, 0, &mesh, &error), TN_INVALID);
}

/* All vertices in one place: edges have no length, faces no normal; growing goes on. */
static void test_edges_without_length_are_divided(void **state)
{
    (void)state;
    grown g;
    plant_text(&g, "t.study",
               "rules \"square\" boundary box from -1e-9 -1e-9 -1e-9 to 1e-9 1e-9 1e-9 inside stop scale 1");
    for (int n = 0; n < 4; n++)
        step(&g);
    tn_stats stats;
    tn_error error;
    assert_int_equal(tn_stats_measure(g.growth, &stats, &error), TN_OK);
    assert_true(stats.fitness.size < 1e-6 && isfinite(stats.fitness.smoothness));
    tn_fitness alone = tn_fitness_measure(g.growth);
    assert_memory_equal(&alone, &stats.fitness, sizeof alone);
    tn_stats_clear(&stats);
    uproot(&g);
}

static void test_options_are_checked(void **state)
{
    (void)state;
    grown g;
    tn_error error;
    tn_growth *growth;
    plant_text(&g, "t.study", "rules \"square\"");
    tn_growth_options o = g.study.options;
    o.scale[1] = 0;
    assert_int_equal(tn_growth_new(g.system, &g.study.environment, &o, &growth, &error), TN_INVALID);
    o = g.study.options;
    o.start_length = -1;
    assert_int_equal(tn_growth_new(g.system, &g.study.environment, &o, &growth, &error), TN_INVALID);
    o = g.study.options;
    o.start[2] = INFINITY;
    assert_int_equal(tn_growth_new(g.system, &g.study.environment, &o, &growth, &error), TN_INVALID);
    uproot(&g);
}

static void test_why_branches_do_not_join(void **state)
{
    (void)state;
    grown g;
    plant_text(&g, "t.hemls", "A + A + A + A; A -> A [ + B ] [ - C ] A; Angle 90; BranchAngle 90; Sync");
    g.study.options.explain = true;
    replant(&g);
    step(&g);
    tn_growth_counts counts = tn_growth_last_counts(g.growth);
    assert_int_equal(counts.rewrites, 4);
    assert_int_equal(counts.joins, 2);
    assert_int_equal(counts.failures[TN_FAIL_OUTER], 4);
    uproot(&g);
    plant_text(&g, "t.hemls",
               "A + A + A + A; A -> A [ & + + & B ] [ + B ] [ + + D ] A; Angle 90; BranchAngle 10; Sync");
    g.study.options.explain = true;
    replant(&g);
    step(&g);
    counts = tn_growth_last_counts(g.growth);
    assert_int_equal(counts.failures[TN_FAIL_SIDE], 8);
    uproot(&g);
}

/* Where the path itself stands upright at a branch, its sides cannot be told: the module stays one that loads. */
static void test_branches_of_upright_paths_have_no_side(void **state)
{
    (void)state;
    static const char *const paths[] = {"[ + B ] & A ^ A [ + B ] [ - B ] ^ A [ + B ] & A; Angle 90",
                                        "[ + B ] & & A ^ ^ A [ + B ] [ - B ] ^ ^ A [ + B ] & & A; Angle 45"};
    for (size_t i = 0; i < 2; i++) {
        char text[200];
        grown g;
        snprintf(text, sizeof text, "A + A + A + A; A -> %s; Sync", paths[i]);
        plant_text(&g, "t.hemls", text);
        g.study.options.explain = true;
        replant(&g);
        step(&g);
        tn_growth_counts counts = tn_growth_last_counts(g.growth);
        assert_int_equal(counts.failures[TN_FAIL_SIDE], 16);
        assert_int_equal(counts.joins, 0);
        uproot(&g);
    }
}

static void test_the_total_fitness(void **state)
{
    (void)state;
    tn_fitness fitness = {.size = 12, .symmetry = 0.5, .soft_boundary_nodes = 3};
    tn_fitness_goal goal = {0};
    goal.wanted[TN_TERM_SIZE] = goal.wanted[TN_TERM_SOFT_BOUNDARY] = true;
    goal.target[TN_TERM_SIZE] = 10;
    goal.weight[TN_TERM_SIZE] = 2;
    goal.weight[TN_TERM_SOFT_BOUNDARY] = 1;
    assert_true(fabs(tn_fitness_total(&fitness, &goal, 1) - (2 * 0.2 + 3)) < 1e-12);
    goal.raw = true;
    assert_true(fabs(tn_fitness_total(&fitness, &goal, 1) - (24 + 3)) < 1e-12);
}

static void test_faces_of_a_mesh_start_at_their_lowest_edge(void **state)
{
    (void)state;
    grown g;
    tn_error error;
    tn_mesh mesh;
    plant_text(&g, "t.study", "rules \"square\"");
    step(&g);
    assert_int_equal(tn_surface_mesh(g.growth, &(tn_surface_options){.groups = true, .lines = true}, &mesh, &error),
                     TN_OK);
    static const uint32_t faces[4][4] = {{0, 4, 8, 7}, {4, 1, 6, 8}, {2, 5, 8, 6}, {5, 3, 7, 8}};
    assert_int_equal(mesh.face_count, 4);
    assert_memory_equal(mesh.corners, faces, sizeof faces);
    assert_int_equal(mesh.line_count, 12);
    assert_string_equal(mesh.group_names[mesh.face_group[0]], "Edge0_0");
    tn_mesh_clear(&mesh);
    uproot(&g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_square_and_triangle_have_their_closed_forms),
        cmocka_unit_test(test_other_closed_forms),
        cmocka_unit_test(test_any_number_of_threads_gives_the_same_bytes),
        cmocka_unit_test(test_faces_alike_are_cut_as_each_by_itself),
        cmocka_unit_test(test_faces_wait_in_a_large_surface),
        cmocka_unit_test(test_growing_again_gives_the_same_bytes),
        cmocka_unit_test(test_growing_in_used_memory_gives_the_same_bytes),
        cmocka_unit_test(test_limits_stop_a_step),
        cmocka_unit_test(test_sanitized_growing_checks_its_map),
        cmocka_unit_test(test_rest_is_noticed),
        cmocka_unit_test(test_a_vertex_at_an_attractor_stays),
        cmocka_unit_test(test_walls_that_meet_stop_what_slides),
        cmocka_unit_test(test_a_closed_mesh_is_a_solid),
        cmocka_unit_test(test_a_mesh_with_a_hole_is_a_membrane),
        cmocka_unit_test(test_new_vertices_stay_before_a_membrane),
        cmocka_unit_test(test_bad_boundary_meshes_are_refused),
        cmocka_unit_test(test_edges_without_length_are_divided),
        cmocka_unit_test(test_options_are_checked),
        cmocka_unit_test(test_why_branches_do_not_join),
        cmocka_unit_test(test_branches_of_upright_paths_have_no_side),
        cmocka_unit_test(test_the_total_fitness),
        cmocka_unit_test(test_faces_of_a_mesh_start_at_their_lowest_edge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
