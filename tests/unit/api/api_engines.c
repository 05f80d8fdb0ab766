/* Fields, placing, mesh readers and runs through the C interface: results, cancelling, and misuse. */
#include "include/tartan/tartan.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "runtime/genome/store/run_store.h"

static const char field_text[] = "surface ball = x*x + y*y + z*z - 1\n"
                                 "surface cut = x*x + y*y + z*z - 9\n"
                                 "surface holes = sqrt(0 - x) + y - 1\n"
                                 "box (-2, -2, -2)..(2, 2, 2)\n"
                                 "grid 20\n";

static const char wall[] = "Wall -> 'PlaceBoundingBox(20,12,1)' '(' 'Move(1,9,0)' Brick 'Move(8,0,0)' Brick ')'\n"
                           "Brick -> 'FillRect(4,3,2)' 'SetColor(4)' 'Place(3004)'\n";

static tartan_module *compile(const char *path, const char *text)
{
    tartan_module *module = NULL;
    tartan_error error;
    if (tartan_compile_text(path, text, strlen(text), NULL, &module, &error) != TARTAN_OK)
        fail_msg("%s: %s", path, error.message);
    return module;
}

static bool refuse(void *context, double done, double total)
{
    (void)done, (void)total;
    ++*(unsigned *)context;
    return false;
}

static tartan_watch refusing(unsigned *asked)
{
    tartan_watch watch = tartan_watch_init();
    *asked = 0;
    watch.go_on = refuse;
    watch.context = asked;
    return watch;
}

/* ---- fields */

static void meshes_a_ball(void **state)
{
    (void)state;
    tartan_module *module = compile("ball.field", field_text);
    tartan_field_options options = tartan_field_options_init();
    tartan_field_findings findings = tartan_field_findings_init();
    tartan_mesh *mesh = NULL;
    tartan_error error;
    size_t vertices;
    assert_int_equal(tartan_module_surface_count(module), 3);
    assert_string_equal(tartan_module_surface_name(module, 1), "cut");
    assert_null(tartan_module_surface_name(module, 3));
    options.surface = "ball";
    options.samples = 30;
    assert_int_equal(tartan_field_mesh(module, &options, NULL, &mesh, &findings, &error), TARTAN_OK);
    const double *p = tartan_mesh_positions(mesh, &vertices);
    assert_true(vertices > 500);
    for (size_t v = 0; v < vertices; v++)
        assert_true(fabs(p[3 * v] * p[3 * v] + p[3 * v + 1] * p[3 * v + 1] + p[3 * v + 2] * p[3 * v + 2] - 1) < 1e-6);
    assert_true(findings.inside && findings.outside && findings.cut == 0 && findings.jumps == 0);
    assert_true(fabs(findings.spacing - 4.0 / 29) < 1e-12);
    tartan_mesh_free(mesh);
    options.surface = "cut";
    assert_int_equal(tartan_field_mesh(module, &options, NULL, &mesh, &findings, &error), TARTAN_OK);
    assert_int_equal(findings.cut,
                     TARTAN_LOW_X | TARTAN_HIGH_X | TARTAN_LOW_Y | TARTAN_HIGH_Y | TARTAN_LOW_Z | TARTAN_HIGH_Z);
    tartan_mesh_free(mesh);
    options.surface = NULL; /* the last */
    assert_int_equal(tartan_field_mesh(module, &options, NULL, &mesh, &findings, &error), TARTAN_OK);
    assert_true(findings.no_values > 0 && findings.no_value[0] > 0);
    tartan_mesh_free(mesh);
    tartan_module_free(module);
}

/* How far a ball of radius 1 reaches in a GLB file, which is in metres, where the file's first line says its unit. */
static double reach_in_glb(const char *unit)
{
    static const char max[] = "\"max\":[";
    char text[sizeof field_text + 32];
    snprintf(text, sizeof text, "%s%s", unit, field_text);
    tartan_module *module = compile("ball.field", text);
    tartan_field_options options = tartan_field_options_init();
    tartan_mesh *mesh = NULL;
    void *bytes = NULL;
    size_t size = 0;
    tartan_error error;
    options.surface = "ball";
    assert_int_equal(tartan_field_mesh(module, &options, NULL, &mesh, NULL, &error), TARTAN_OK);
    assert_int_equal(tartan_mesh_write(mesh, TARTAN_GLB, NULL, NULL, &bytes, &size, &error), TARTAN_OK);
    const char *at = memmem(bytes, size, max, strlen(max));
    assert_non_null(at);
    double reach = strtod(at + strlen(max), NULL);
    free(bytes);
    tartan_mesh_free(mesh);
    tartan_module_free(module);
    return reach;
}

static bool goes_on(void *context, double done, double total)
{
    (void)done;
    (void)total;
    ++*(unsigned *)context;
    return true;
}

/* What functions left on the stack is there no more. */
static void fill_stack(void)
{
    volatile unsigned char filled[1 << 16];
    for (size_t i = 0; i < sizeof filled; i++)
        filled[i] = 1;
}

/* Who waited for a mesh to be made is not asked when it is written, cut or drawn. */
static void meshes_outlive_watches(void **state)
{
    (void)state;
    unsigned asked = 0;
    tartan_module *module = compile("ball.field", field_text);
    tartan_field_options options = tartan_field_options_init();
    tartan_watch *watch = malloc(sizeof *watch);
    tartan_mesh *mesh = NULL;
    tartan_error error;
    assert_non_null(watch);
    *watch = tartan_watch_init();
    watch->go_on = goes_on;
    watch->context = &asked;
    options.surface = "ball";
    assert_int_equal(tartan_field_mesh(module, &options, watch, &mesh, NULL, &error), TARTAN_OK);
    memset(watch, 0x55, sizeof *watch);
    free(watch);
    fill_stack();
    assert_true(asked > 0);
    asked = 0;
    for (int format = TARTAN_GLB; format <= TARTAN_STL; format++) {
        void *bytes = NULL;
        size_t size;
        if (format == TARTAN_DXF)
            continue;
        if (tartan_mesh_write(mesh, (tartan_mesh_format)format, NULL, NULL, &bytes, &size, &error) != TARTAN_OK)
            fail_msg("format %d: %s", format, error.message);
        tartan_bytes_free(bytes);
    }
    assert_int_equal(asked, 0);
    tartan_mesh_free(mesh);
    tartan_module_free(module);
}

static void draws_meshes(void **state)
{
    (void)state;
    static const double corners[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const uint32_t first[] = {0, 4}, square[] = {0, 1, 2, 3};
    tartan_growth_drawing drawing = tartan_growth_drawing_init();
    tartan_mesh *mesh = NULL;
    void *bytes = NULL;
    size_t size = 0;
    tartan_error error;
    unsigned asked;
    assert_int_equal(tartan_mesh_new(corners, 4, first, square, 1, &mesh, &error), TARTAN_OK);
    drawing.title = "a square";
    assert_int_equal(tartan_mesh_draw(mesh, TARTAN_SVG, &drawing, NULL, &bytes, &size, &error), TARTAN_OK);
    assert_non_null(memmem(bytes, size, "a square", 8));
    tartan_bytes_free(bytes);
    drawing.camera = true;
    drawing.elevation = 91;
    assert_int_equal(tartan_mesh_draw(mesh, TARTAN_SVG, &drawing, NULL, &bytes, &size, &error), TARTAN_INVALID);
    assert_int_equal(tartan_mesh_draw(NULL, TARTAN_SVG, NULL, NULL, &bytes, &size, &error), TARTAN_INVALID);
    assert_int_equal(tartan_mesh_draw(mesh, (tartan_picture_format)9, NULL, NULL, &bytes, &size, &error),
                     TARTAN_INVALID);
    tartan_watch watch = refusing(&asked);
    assert_int_equal(tartan_mesh_draw(mesh, TARTAN_SVG, NULL, &watch, &bytes, &size, &error), TARTAN_STOPPED);
    tartan_mesh_free(mesh);
}

static void writes_metres(void **state)
{
    (void)state;
    double plain = reach_in_glb("");
    assert_true(plain > 0.9 && plain < 1.1);
    assert_true(fabs(reach_in_glb("unit m\n") - plain) < 1e-6);
    assert_true(fabs(reach_in_glb("unit mm\n") - plain / 1000) < 1e-9);
    assert_true(fabs(reach_in_glb("unit ft\n") - plain * 0.3048) < 1e-6);
}

static void refuses_wrong_fields(void **state)
{
    (void)state;
    tartan_module *module = compile("ball.field", field_text), *other = compile("wall.pcfg", wall);
    tartan_field_options options = tartan_field_options_init();
    tartan_mesh *mesh = NULL;
    tartan_error error;
    unsigned asked;
    tartan_watch watch = refusing(&asked);
    options.surface = "bal";
    assert_int_equal(tartan_field_mesh(module, &options, NULL, &mesh, NULL, &error), TARTAN_INVALID);
    assert_string_equal(error.help, "did you mean `ball`?");
    options.surface = "ball";
    options.samples = 1;
    assert_int_equal(tartan_field_mesh(module, &options, NULL, &mesh, NULL, &error), TARTAN_INVALID);
    options.samples = 8192;
    assert_int_equal(tartan_field_mesh(module, &options, NULL, &mesh, NULL, &error), TARTAN_LIMIT);
    options.samples = 100;
    options.triangle_limit = 10;
    assert_int_equal(tartan_field_mesh(module, &options, NULL, &mesh, NULL, &error), TARTAN_LIMIT);
    assert_int_equal(tartan_field_mesh(other, NULL, NULL, &mesh, NULL, &error), TARTAN_INVALID);
    assert_int_equal(tartan_field_mesh(NULL, NULL, NULL, &mesh, NULL, &error), TARTAN_INVALID);
    assert_int_equal(tartan_field_mesh(module, NULL, NULL, NULL, NULL, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_field_mesh(module, &(tartan_field_options){0}, NULL, &mesh, NULL, &error), TARTAN_INVALID);
    assert_string_equal(error.help, "begin with tartan_field_options_init()");
    assert_int_equal(tartan_field_mesh(module, NULL, NULL, &mesh, &(tartan_field_findings){0}, &error), TARTAN_INVALID);
    assert_int_equal(tartan_field_mesh(module, NULL, &watch, &mesh, NULL, &error), TARTAN_STOPPED);
    assert_true(asked > 0);
    assert_null(mesh);
    tartan_module_free(module);
    tartan_module_free(other);
}

/* ---- meshes that a module names */

static unsigned read_count;

static tartan_status read_box(const char *path, tartan_mesh **mesh, tartan_error *error)
{
    static const double p[] = {-9, -9, -9, 9, -9, -9, 9, 9, -9, -9, 9, -9, -9, -9, 9, 9, -9, 9, 9, 9, 9, -9, 9, 9};
    static const uint32_t first[] = {0, 4, 8, 12, 16, 20, 24};
    static const uint32_t corners[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
    read_count++;
    return strstr(path, "wrong") ? TARTAN_OK : tartan_mesh_new(p, 8, first, corners, 6, mesh, error);
}

static tartan_status give_square(void *context, const tartan_use *use, tartan_text *found, tartan_error *error)
{
    (void)context, (void)use, (void)error;
    static const char square[] = "A + A + A + A\nA -> A\nAngle 90\n";
    found->text = square;
    found->size = sizeof square - 1;
    return TARTAN_OK;
}

/* The file must be there; what is in it, the reader says. */
static void meshes_are_read_by_the_callers_function(void **state)
{
    (void)state;
    static const char study[] = "rules \"square.hemls\"\nboundary mesh \"room.obj\" inside\n";
    char folder[] = "/tmp/tartan-api-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/room.obj", folder);
    fclose(fopen(path, "w"));
    tartan_error error;
    tartan_growth *growth = NULL;
    tartan_growth_options options = tartan_growth_options_init();
    tartan_compile_options compiling = tartan_compile_options_init();
    compiling.resolve = give_square;
    tartan_module *module = NULL;
    if (tartan_compile_text("x.study", study, sizeof study - 1, &compiling, &module, &error) != TARTAN_OK)
        fail_msg("%s %s", error.message, error.help);
    assert_int_equal(tartan_growth_options_of(module, &options, &error), TARTAN_OK); /* needs no reader */
    options.folder = folder;
    assert_int_equal(tartan_growth_new(module, &options, &growth, &error), TARTAN_INVALID);
    assert_string_equal(error.help, "set read_mesh to tartan_mesh_read, of libtartan-mesh");
    options.read_mesh = read_box;
    if (tartan_growth_new(module, &options, &growth, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    assert_int_equal(read_count, 1);
    tartan_growth_free(growth);
    tartan_module_free(module);
    unlink(path);
    rmdir(folder);
}

/* ---- placing */

static void places_bricks(void **state)
{
    (void)state;
    tartan_module *module = compile("wall.pcfg", wall);
    tartan_placement *placement = NULL;
    tartan_placement_counts counts = tartan_placement_counts_init();
    tartan_error error;
    size_t count, size;
    char *text = NULL;
    assert_true(tartan_module_has_places(module) && !tartan_module_has_grammar(module));
    if (tartan_place(module, NULL, NULL, &placement, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    const tartan_placed_part *parts = tartan_placement_parts(placement, &count);
    assert_int_equal(count, 2);
    assert_string_equal(parts[1].name, "3004");
    assert_int_equal(parts[0].colour, 4);
    assert_int_equal(parts[1].at[0] - parts[0].at[0], 8);
    assert_int_equal(tartan_placement_count(placement, &counts, &error), TARTAN_OK);
    assert_int_equal(counts.parts, 2);
    assert_true(counts.cells > 0 && counts.bounds > 0);
    assert_int_equal(tartan_placement_ldraw(placement, &text, &size, &error), TARTAN_OK);
    assert_int_equal(strlen(text), size);
    assert_non_null(strstr(text, "3004.dat"));
    tartan_text_free(text);
    assert_int_equal(tartan_placement_list(placement, &text, &size, &error), TARTAN_OK);
    assert_string_equal(text, "part,colour,number\n3004,4,2\n");
    tartan_text_free(text);
    tartan_placement_free(placement);
    tartan_module_free(module);
}

static void refuses_wrong_placing(void **state)
{
    (void)state;
    static const char endless[] = "Wall -> 'Place(1)' 'Move(1,0,0)' Wall\nWall ->\n",
                      full[] = "Wall -> 'FillRect(2,2,2)' 'Place(1)' 'FillRect(2,2,2)'\n";
    tartan_module *module = compile("wall.pcfg", wall), *field = compile("ball.field", field_text),
                  *runs_on = compile("endless.pcfg", endless), *no_room = compile("full.pcfg", full);
    tartan_placement *placement = NULL;
    tartan_place_options options = tartan_place_options_init();
    tartan_error error;
    unsigned asked;
    tartan_watch watch = refusing(&asked);
    options.part_limit = 1;
    assert_int_equal(tartan_place(module, &options, NULL, &placement, &error), TARTAN_LIMIT);
    assert_int_equal(tartan_place(field, NULL, NULL, &placement, &error), TARTAN_INVALID);
    assert_int_equal(tartan_place(no_room, NULL, NULL, &placement, &error), TARTAN_INVALID);
    assert_int_equal(error.code, 1310);
    assert_int_equal(tartan_place(NULL, NULL, NULL, &placement, &error), TARTAN_INVALID);
    assert_int_equal(tartan_place(module, NULL, NULL, NULL, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_place(module, &(tartan_place_options){0}, NULL, &placement, &error), TARTAN_INVALID);
    assert_int_equal(tartan_place(runs_on, NULL, &watch, &placement, &error), TARTAN_STOPPED);
    assert_true(asked > 0);
    assert_int_equal(tartan_placement_count(NULL, NULL, &error), TARTAN_INVALID);
    assert_int_equal(tartan_placement_ldraw(NULL, NULL, NULL, &error), TARTAN_INVALID);
    assert_null(placement);
    tartan_placement_free(NULL);
    tartan_module_free(module);
    tartan_module_free(field);
    tartan_module_free(runs_on);
    tartan_module_free(no_room);
}

/* ---- runs */

static void reads_a_run(void **state)
{
    (void)state;
    char folder[] = "/tmp/tartan-run-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/run.sqlite", folder);
    tn_run_store *store = NULL;
    tartan_run *run = NULL;
    tartan_error error;
    char *text = NULL;
    assert_int_equal(tartan_run_open(path, &run, &error), TARTAN_IO);
    assert_int_equal(tn_run_store_create(path, false, &store, NULL), TN_OK);
    const char *const keys[] = {"study", "objectives"}, *const values[] = {"evolution { }", "2"};
    assert_int_equal(tn_run_store_put_meta(store, keys, values, 2, NULL), TN_OK);
    tn_run_store_free(store);
    if (tartan_run_open(path, &run, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    assert_int_equal(tartan_run_generations(run) + tartan_run_event_count(run), 0);
    assert_int_equal(tartan_run_objectives(run), 2);
    assert_int_equal(tartan_run_text(run, "study", &text, &error), TARTAN_OK);
    assert_string_equal(text, "evolution { }");
    tartan_text_free(text);
    assert_int_equal(tartan_run_text(run, "nothing", &text, &error), TARTAN_OK);
    assert_null(text);
    tartan_generation generation = tartan_generation_init();
    tartan_run_event event = tartan_run_event_init();
    assert_int_equal(tartan_run_generation(run, 0, &generation, &error), TARTAN_INVALID);
    assert_int_equal(tartan_run_event_at(run, 0, &event, &error), TARTAN_INVALID);
    assert_int_equal(tartan_run_open(NULL, &run, &error), TARTAN_INVALID);
    tartan_run_free(run);
    FILE *other = fopen(path, "w");
    fputs("no database", other);
    fclose(other);
    run = NULL;
    assert_int_equal(tartan_run_open(path, &run, &error), TARTAN_INVALID);
    assert_null(run);
    tartan_run_free(NULL);
    unlink(path);
    rmdir(folder);
}

/* ---- everything else that may be given up */

static void files_and_pictures_can_be_stopped(void **state)
{
    (void)state;
    tartan_module *field = compile("ball.field", field_text), *grammar = compile("d.bnf", "<n> ::= <n><n> | 1\n"),
                  *square = compile("square.hemls", "A + A + A + A\nA -> A\nAngle 90\n");
    tartan_mesh *mesh = NULL;
    tartan_grammar *g = NULL;
    tartan_growth *growth = NULL;
    tartan_field_options options = tartan_field_options_init();
    tartan_error error;
    void *bytes = NULL;
    uint64_t *codons = NULL;
    size_t size = 0;
    unsigned asked;
    char ones[201];
    memset(ones, '1', sizeof ones - 1);
    options.surface = "ball";
    assert_int_equal(tartan_field_mesh(field, &options, NULL, &mesh, NULL, NULL), TARTAN_OK);
    for (int format = TARTAN_OBJ; format <= TARTAN_OM; format++) {
        tartan_watch watch = refusing(&asked);
        if (format != TARTAN_DXF)
            assert_int_equal(tartan_mesh_write(mesh, (tartan_mesh_format)format, NULL, &watch, &bytes, &size, &error),
                             TARTAN_STOPPED);
    }
    assert_int_equal(tartan_grammar_new(grammar, &g, NULL), TARTAN_OK);
    tartan_watch watch = refusing(&asked);
    assert_int_equal(tartan_invert(g, ones, 200, 0, &watch, &codons, &size, &error), TARTAN_STOPPED);
    assert_int_equal(tartan_growth_new(square, NULL, &growth, NULL), TARTAN_OK);
    watch = refusing(&asked);
    assert_int_equal(tartan_growth_draw(growth, TARTAN_SVG, NULL, &watch, &bytes, &size, &error), TARTAN_STOPPED);
    assert_string_equal(error.message, "stopped before it was done");
    assert_null(bytes);
    assert_null(codons);
    assert_int_equal(tartan_growth_draw(growth, TARTAN_SVG, NULL, NULL, &bytes, &size, &error), TARTAN_OK);
    tartan_bytes_free(bytes);
    tartan_growth_free(growth);
    tartan_grammar_free(g);
    tartan_mesh_free(mesh);
    tartan_module_free(field);
    tartan_module_free(grammar);
    tartan_module_free(square);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_a_ball),        cmocka_unit_test(meshes_outlive_watches),
        cmocka_unit_test(draws_meshes),         cmocka_unit_test(writes_metres),
        cmocka_unit_test(refuses_wrong_fields), cmocka_unit_test(meshes_are_read_by_the_callers_function),
        cmocka_unit_test(places_bricks),        cmocka_unit_test(refuses_wrong_placing),
        cmocka_unit_test(reads_a_run),          cmocka_unit_test(files_and_pictures_can_be_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
