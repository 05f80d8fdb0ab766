/* How long growing takes: growth SCENE STEPS THREADS RUNS
 *
 * Scenes: square, triangle, forces (20 attractors), boundary (inside a ball of 10,368 triangles), and curve (square,
 * each step's time by itself); and of branches in one huge face: ring (STEPS edges of the seed, a branch each) and koch
 * (one branch for each edge of the quadratic Koch curve of that many steps). Prints the median of the runs and the most
 * memory that the process had. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "bench/bench.h"
#include "compiler/compile.h"
#include "runtime/growth/growth.h"
#include "runtime/growth/study.h"
#include "runtime/load.h"
#include "runtime/math/elementary.h"

static int compare(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return *x < *y ? -1 : *x > *y;
}

static const char square[] =
    "A + B + A + B; A -> A [ [ + B ] - B ] A; B -> B [ [ + A ] - A ] B; Angle 90; BranchAngle 90";
static const char triangle[] =
    "A + B + C; A -> A [ [ [ [ + C ] + + B ] - B ] - - C ] A; B -> B [ [ [ [ + A ] + + C ] - C ] - - A ] B;"
    "C -> C [ [ [ [ + B ] + + A ] - A ] - - B ] C; Angle 60; Sync";

static const char koch[] = "A + A + A + A; A -> A [ + B ] A If i > %d\n"
                           "-> A_i+1 + A_i+1 - A_i+1 - A_i+1 + A_i+1; Angle 90; BranchAngle 30";

/* The text of a scene, which the caller frees; `steps` becomes those to take. */
static char *text_of(const char *scene, int *steps)
{
    static const char ring[] = "; A -> A [ + B ] A; Angle 90; BranchAngle 90";
    if (strcmp(scene, "koch") == 0) {
        char *text = malloc(sizeof koch + 16);
        if (text)
            snprintf(text, sizeof koch + 16, koch, *steps - 1);
        *steps += 1;
        return text;
    }
    if (strcmp(scene, "ring") != 0)
        return strdup(strcmp(scene, "triangle") == 0 ? triangle : square);
    size_t edges = (size_t)*steps;
    char *text = malloc(2 * edges + sizeof ring);
    for (size_t i = 0; text && i < edges; i++)
        memcpy(text + 2 * i, "A+", 2);
    if (text)
        memcpy(text + 2 * edges - 1, ring, sizeof ring);
    *steps = 1;
    return text;
}

enum { ATTRACTORS = 20, BANDS = 72 };

static void place_attractors(tn_force *forces)
{
    for (int i = 0; i < ATTRACTORS; i++)
        forces[i] = (tn_force){TN_ATTRACTOR, {80 * tn_cos(i), 80 * tn_sin(i), 20 + i}, 2, 2};
}

/* A ball of latitudes and longitudes around the surface: about 10,000 triangles. */
static tn_boundary_mesh *make_ball(double radius)
{
    static double points[(BANDS + 1) * BANDS * 3];
    static uint32_t faces[2 * BANDS * BANDS * 3];
    size_t n = 0;
    tn_boundary_mesh *mesh = NULL;
    tn_error error;
    for (int i = 0; i <= BANDS; i++)
        for (int j = 0; j < BANDS; j++) {
            double a = 180.0 * i / BANDS - 90, b = 360.0 * j / BANDS, *p = points + 3 * (i * BANDS + j);
            p[0] = radius * tn_cos_degrees(a) * tn_cos_degrees(b);
            p[1] = radius * tn_cos_degrees(a) * tn_sin_degrees(b);
            p[2] = radius * tn_sin_degrees(a);
        }
    for (uint32_t i = 0; i < BANDS; i++)
        for (uint32_t j = 0; j < BANDS; j++) {
            uint32_t a = i * BANDS + j, b = i * BANDS + (j + 1) % BANDS,
                     corners[6] = {a, b, b + BANDS, a, b + BANDS, a + BANDS};
            memcpy(faces + n, corners, sizeof corners);
            n += 6;
        }
    if (tn_boundary_mesh_new(points, (BANDS + 1) * BANDS, faces, n / 3, &mesh, &error) != TN_OK)
        fprintf(stderr, "%s\n", error.message);
    return mesh;
}

static double grow(const tn_growth_system *system, const tn_environment *environment, const tn_growth_options *options,
                   int steps, bool curve)
{
    tn_growth *growth;
    tn_error error;
    if (tn_growth_new(system, environment, options, &growth, &error) != TN_OK)
        exit(1);
    double start = seconds(CLOCK_MONOTONIC);
    for (int i = 0; i < steps; i++) {
        double before = seconds(CLOCK_MONOTONIC);
        if (tn_growth_step(growth, &error) != TN_OK) {
            fprintf(stderr, "%s\n", error.message);
            exit(1);
        }
        const tn_map *map = tn_growth_map(growth);
        if (curve)
            printf("step %2d %9u edges %8.2f ms %6.1f ns an edge\n", i + 1, map->edge_count,
                   1e3 * (seconds(CLOCK_MONOTONIC) - before),
                   1e9 * (seconds(CLOCK_MONOTONIC) - before) / map->edge_count);
    }
    double took = seconds(CLOCK_MONOTONIC) - start;
    tn_growth_free(growth);
    return took;
}

int main(int count, char **words)
{
    if (count < 5) {
        fputs("growth SCENE STEPS THREADS RUNS\n", stderr);
        return 2;
    }
    const char *scene = words[1];
    int steps = atoi(words[2]), runs = atoi(words[4]);
    char *text = text_of(scene, &steps);
    if (!text)
        return 1;
    tn_compilation compilation;
    tn_module *module;
    tn_growth_system *system;
    tn_error error;
    tn_input input = {.text = text, .size = strlen(text), .name = scene};
    if (tn_compile_text(TN_NOTATION(hemls), &input, &(tn_compile_options){0}, &compilation) != TN_OK ||
        tn_module_load(compilation.module, compilation.module_size, NULL, &module, &error) != TN_OK ||
        tn_growth_system_read(module, &system, &error) != TN_OK)
        return 1;
    tn_growth_options options = tn_growth_options_default();
    options.threads = atoi(words[3]);
    tn_force forces[ATTRACTORS];
    tn_boundary_mesh *ball_mesh = NULL;
    tn_boundary ball = {.kind = TN_BOUNDARY_MESH, .inside = true};
    tn_environment environment = {0};
    if (strcmp(scene, "forces") == 0) {
        place_attractors(forces);
        environment = (tn_environment){forces, ATTRACTORS, NULL, 0};
    } else if (strcmp(scene, "boundary") == 0) {
        ball.mesh = ball_mesh = make_ball(30);
        environment = (tn_environment){NULL, 0, &ball, 1};
    }
    double times[64];
    runs = runs < 64 ? runs : 64;
    for (int i = 0; i < runs; i++)
        times[i] = grow(system, &environment, &options, steps, strcmp(scene, "curve") == 0);
    qsort(times, (size_t)runs, sizeof *times, compare);
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    printf("%-10s %d steps, %d threads: median %8.1f ms of %d runs, %ld MB\n", scene, steps, options.threads,
           1e3 * times[runs / 2], runs, usage.ru_maxrss / 1024);
    tn_boundary_mesh_free(ball_mesh);
    tn_growth_system_free(system);
    tn_module_free(module);
    tn_compilation_clear(&compilation);
    free(text);
    return 0;
}
