/* Libraries of houses through the C interface: counting, numbers, lists, meshes and files; cancelling, threads and
 * misuse. tests/cli/house_interface.sh holds the answers to those of the commands. */
#include "include/tartan/tartan.h"
#include "tests/support/huts.h"

#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char text[] = TEST_HUTS "library all \"every hut\" from rows in huts { }\n"
                                     "library round from rows in huts { require option(body roof vault) }\n"
                                     "measure long = sum(width)\n"
                                     "measure price = sum(cost)\n"
                                     "measure beds = quantity(cell(bed))\n";
static const char hut[] = "8' room:10' ; vault(3') ; bed ; window";

static tartan_module *compile(void)
{
    tartan_module *module = NULL;
    tartan_error error;
    if (tartan_compile_text("hut.plan", text, sizeof text - 1, NULL, &module, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    return module;
}

static tartan_house_library *open_library(const tartan_module *module, const char *name)
{
    tartan_house_library *library = NULL;
    tartan_house_library_options options = tartan_house_library_options_init();
    tartan_error error;
    options.name = name;
    if (tartan_house_library_open(module, &options, NULL, &library, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    return library;
}

static void counts(tartan_house_library *library, uint32_t length, const char *wanted)
{
    char *count = NULL;
    tartan_error error;
    if (tartan_house_library_count(library, length, NULL, &count, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    assert_string_equal(count, wanted);
    tartan_text_free(count);
}

static tartan_house *read_house(tartan_house_library *library, const char *line)
{
    tartan_house *house = NULL;
    tartan_error error;
    if (tartan_house_read(library, line, strlen(line), &house, &error) != TARTAN_OK)
        fail_msg("%s", error.message);
    return house;
}

/* One bay has 2 roofs and 2 fronts, two bays 2 roofs and 4. */
static void counts_houses(void **state)
{
    (void)state;
    tartan_module *module = compile();
    assert_int_equal(tartan_module_house_library_count(module), 2);
    assert_string_equal(tartan_module_house_library_name(module, 0), "all");
    assert_string_equal(tartan_module_house_library_doc(module, 0), "every hut");
    assert_null(tartan_module_house_library_name(module, 2));
    assert_null(tartan_module_house_library_doc(module, 2));
    tartan_house_library *all = open_library(module, "all"), *round = open_library(module, "round");
    assert_string_equal(tartan_house_library_name(round), "round");
    assert_string_equal(tartan_schema_name(tartan_house_library_schema(all)), "hut");
    counts(all, TARTAN_ANY_LENGTH, "40");
    counts(all, 1, "8");
    counts(all, 2, "32");
    counts(all, 0, "0");
    counts(all, 3, "0");
    counts(round, TARTAN_ANY_LENGTH, "20");
    const uint32_t trays[] = {0, 1};
    char *count = NULL;
    tartan_error error;
    tartan_on_plan plan = {trays, 2};
    assert_int_equal(tartan_house_library_count_on(round, &plan, NULL, &count, &error), TARTAN_OK);
    assert_string_equal(count, "4");
    tartan_text_free(count);
    assert_string_equal(tartan_house_library_unit(all, "long"), "ft");
    assert_string_equal(tartan_house_library_unit(all, "beds"), "");
    assert_null(tartan_house_library_unit(all, "bed"));
    assert_null(tartan_house_library_unit(all, NULL));
    tartan_house_library_free(all);
    tartan_house_library_free(round);
    tartan_module_free(module);
}

/* Each rank, its house, and back. */
static void numbers_houses(void **state)
{
    (void)state;
    tartan_module *module = compile();
    tartan_house_library *library = open_library(module, "all");
    tartan_error error;
    for (unsigned rank = 0; rank < 40; rank++) {
        char digits[8], *line = NULL, *number = NULL, *again = NULL;
        tartan_house *house = NULL, *same = NULL;
        size_t length;
        snprintf(digits, sizeof digits, "%u", rank);
        assert_int_equal(tartan_house_unrank(library, digits, NULL, &house, &error), TARTAN_OK);
        assert_int_equal(tartan_house_write(house, &line, &error), TARTAN_OK);
        same = read_house(library, line);
        assert_int_equal(tartan_house_number(same, NULL, &number, &error), TARTAN_OK);
        tartan_house_free(house);
        assert_int_equal(tartan_house_unrank(library, number, NULL, &house, &error), TARTAN_OK);
        assert_int_equal(tartan_house_rank(house, NULL, &again, &error), TARTAN_OK);
        assert_string_equal(again, digits);
        assert_in_range(tartan_house_plan(house, &length)[0], 0, 1);
        assert_int_equal(length, rank < 8 ? 1 : 2);
        tartan_house_free(same);
        tartan_house_free(house);
        tartan_text_free(line);
        tartan_text_free(number);
        tartan_text_free(again);
    }
    tartan_house *house = NULL;
    static const char *const wrong[] = {"40", "#40", "0:4", "6:0", "", "#", "x", "0:", "-1", ":"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        error = (tartan_error){0};
        assert_int_equal(tartan_house_unrank(library, wrong[i], NULL, &house, &error), TARTAN_INVALID);
        assert_true(error.message[0] != '\0');
        assert_null(house);
    }
    tartan_house_library_free(library);
    tartan_module_free(module);
}

static void draws_and_finds(void **state)
{
    (void)state;
    tartan_module *module = compile();
    tartan_house_library *library = open_library(module, "all");
    tartan_error error;
    tartan_houses *houses = NULL;
    assert_int_equal(tartan_house_sample(library, NULL, 5, 100, NULL, &houses, &error), TARTAN_OK);
    assert_int_equal(tartan_houses_count(houses), 40);
    assert_non_null(tartan_houses_house(houses, 39));
    assert_null(tartan_houses_house(houses, 40));
    assert_null(tartan_houses_value(houses, 0, 0));
    assert_null(tartan_houses_change(houses, 0));
    tartan_houses_free(houses);
    const uint32_t trays[] = {1};
    const tartan_on_plan plan = {trays, 1};
    assert_int_equal(tartan_house_sample(library, &plan, 5, 3, NULL, &houses, &error), TARTAN_OK);
    assert_int_equal(tartan_houses_count(houses), 3);
    tartan_houses_free(houses);

    const tartan_wish wishes[] = {{"beds", true}, {"long", false}};
    assert_int_equal(tartan_house_best(library, NULL, wishes, 2, 9, NULL, &houses, &error), TARTAN_OK);
    assert_int_equal(tartan_houses_count(houses), 9);
    assert_string_equal(tartan_houses_value(houses, 0, 0), "2");
    assert_string_equal(tartan_houses_value(houses, 7, 1), "16");
    assert_string_equal(tartan_houses_value(houses, 8, 1), "18");
    assert_null(tartan_houses_value(houses, 0, 2));
    assert_null(tartan_houses_value(houses, 9, 0));
    tartan_houses_free(houses);
    assert_int_equal(tartan_house_best(library, &plan, wishes, 1, 0, NULL, &houses, &error), TARTAN_OK);
    assert_int_equal(tartan_houses_count(houses), 0);
    tartan_houses_free(houses);

    tartan_house *house = read_house(library, hut);
    assert_int_equal(tartan_house_variants(house, NULL, NULL, &houses, &error), TARTAN_OK);
    assert_int_equal(tartan_houses_count(houses), 2);
    const tartan_house_change *change = tartan_houses_change(houses, 1);
    assert_int_equal(tartan_houses_change(houses, 0)->kind, TARTAN_CHANGE_SECTION);
    assert_int_equal(change->kind, TARTAN_CHANGE_FACE);
    assert_non_null(strstr(change->where, "1.body.ground"));
    assert_string_equal(change->from, "window");
    assert_string_equal(change->to, "wall");
    assert_null(tartan_houses_change(houses, 2));
    tartan_houses_free(houses);
    assert_int_equal(tartan_house_variants(house, "1.body.ground", NULL, &houses, &error), TARTAN_OK);
    assert_int_equal(tartan_houses_count(houses), 1);
    tartan_houses_free(houses);
    houses = NULL;
    assert_int_equal(tartan_house_variants(house, "2.body.ground", NULL, &houses, &error), TARTAN_INVALID);
    assert_null(houses);
    tartan_house_free(house);
    tartan_house_library_free(library);
    tartan_module_free(module);
}

/* The hut is 8' wide and 10' deep between the middles of its walls, which are 6" thick. */
static void makes_meshes(void **state)
{
    (void)state;
    tartan_module *module = compile();
    tartan_house_library *library = open_library(module, "all");
    tartan_house *house = read_house(library, hut);
    tartan_mesh *mesh = NULL;
    tartan_error error;
    size_t vertices, faces;
    const uint32_t *corners;
    double low = 0, high = 0;
    assert_int_equal(tartan_house_mesh(house, NULL, &mesh, &error), TARTAN_OK);
    const double *p = tartan_mesh_positions(mesh, &vertices);
    const uint32_t *first = tartan_mesh_faces(mesh, &corners, &faces), *groups = tartan_mesh_face_groups(mesh);
    assert_true(vertices > 20 && faces > 40);
    assert_int_equal(first[faces], 3 * faces);
    for (size_t v = 0; v < vertices; v++) {
        low = fmin(low, p[3 * v]);
        high = fmax(high, p[3 * v]);
    }
    assert_true(fabs(high - low - 8.5 * 0.3048) < 1e-9);
    uint32_t count = tartan_mesh_group_count(mesh), brick = count - 1;
    bool found = false;
    assert_string_equal(tartan_mesh_group_name(mesh, brick), "brick");
    for (size_t f = 0; f < faces; f++) {
        assert_true(groups[f] < count);
        found |= groups[f] == brick;
    }
    assert_true(found);
    tartan_mesh_free(mesh);
    tartan_house_free(house);
    tartan_house_library_free(library);
    tartan_module_free(module);
}

static void begins(const tartan_house *house, tartan_house_format format, const char *beginning)
{
    void *bytes = NULL;
    size_t size = 0;
    tartan_error error;
    if (tartan_house_file(house, format, NULL, NULL, &bytes, &size, &error) != TARTAN_OK)
        fail_msg("format %d: %s", (int)format, error.message);
    assert_true(size > strlen(beginning));
    assert_memory_equal(bytes, beginning, strlen(beginning));
    tartan_bytes_free(bytes);
}

static void writes_files(void **state)
{
    (void)state;
    static const char *const beginnings[] = {"{\n  \"house\"", "function", "part",  "",        "ply\n", "glTF",
                                             "ISO-10303-21",   "",         "<?xml", "\x89PNG", "%PDF",   "newmtl "};
    tartan_module *module = compile();
    tartan_house_library *library = open_library(module, "all");
    tartan_house *house = read_house(library, hut);
    for (int format = TARTAN_HOUSE_JSON; format <= TARTAN_HOUSE_MTL; format++)
        begins(house, (tartan_house_format)format, beginnings[format]);
    tartan_house_drawing drawing = tartan_house_drawing_init();
    const char *views[] = {"plan:ground", "axonometric"};
    void *bytes = NULL;
    size_t size = 0;
    tartan_error error;
    drawing.title = "A hut";
    drawing.views = views;
    drawing.view_count = 2;
    drawing.bare = drawing.camera = true;
    drawing.azimuth = 20;
    drawing.scale = 100;
    assert_int_equal(tartan_house_file(house, TARTAN_HOUSE_SVG, &drawing, NULL, &bytes, &size, &error), TARTAN_OK);
    tartan_bytes_free(bytes);
    bytes = NULL;
    views[0] = "plan:attic";
    assert_int_equal(tartan_house_file(house, TARTAN_HOUSE_DXF, &drawing, NULL, &bytes, &size, &error), TARTAN_INVALID);
    assert_string_equal(error.help, "its storeys are ground");
    views[0] = NULL;
    assert_int_equal(tartan_house_file(house, TARTAN_HOUSE_SVG, &drawing, NULL, &bytes, &size, &error), TARTAN_INVALID);
    views[0] = "sheet";
    drawing.azimuth = NAN;
    assert_int_equal(tartan_house_file(house, TARTAN_HOUSE_SVG, &drawing, NULL, &bytes, &size, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_file(house, (tartan_house_format)99, NULL, NULL, &bytes, &size, &error),
                     TARTAN_INVALID);
    assert_null(bytes);
    tartan_house_free(house);
    tartan_house_library_free(library);
    tartan_module_free(module);
}

/* ---- cancelling */

static bool refuse(void *context, double done, double total)
{
    (void)context, (void)done, (void)total;
    return false;
}

/* What was given up is done when it is asked for again. */
static void stops(void **state)
{
    (void)state;
    tartan_module *module = compile();
    tartan_house_library *library = open_library(module, "all");
    tartan_house *house = read_house(library, hut);
    tartan_watch watch = tartan_watch_init();
    tartan_mesh *mesh = NULL;
    tartan_houses *houses = NULL;
    void *bytes = NULL;
    size_t size;
    tartan_error error;
    const tartan_wish wish = {"price", false};
    watch.go_on = refuse;
    assert_int_equal(tartan_house_mesh(house, &watch, &mesh, &error), TARTAN_STOPPED);
    assert_int_equal(tartan_house_file(house, TARTAN_HOUSE_IFC, NULL, &watch, &bytes, &size, &error), TARTAN_STOPPED);
    assert_int_equal(tartan_house_best(library, NULL, &wish, 1, 3, &watch, &houses, &error), TARTAN_STOPPED);
    assert_null(mesh);
    assert_null(houses);
    assert_null(bytes);
    counts(library, TARTAN_ANY_LENGTH, "40");
    assert_int_equal(tartan_house_best(library, NULL, &wish, 1, 3, NULL, &houses, &error), TARTAN_OK);
    tartan_houses_free(houses);
    tartan_house_free(house);
    tartan_house_library_free(library);
    tartan_module_free(module);
}

/* ---- threads */

/* What a thread finds out, through a library of its own of a module that others have, too. */
typedef struct thread_of_houses {
    pthread_t thread;
    const tartan_module *module;
    size_t size; /* of a drawing; 0 if a call failed */
} thread_of_houses;

static void *ask_all(void *context)
{
    thread_of_houses *own = context;
    const tartan_module *module = own->module;
    tartan_house_library *library = NULL;
    tartan_house_library_options options = tartan_house_library_options_init();
    tartan_house *house = NULL;
    tartan_houses *houses = NULL;
    tartan_mesh *mesh = NULL;
    char *rank = NULL;
    void *bytes = NULL;
    size_t size = 0;
    const tartan_wish wish = {"price", true};
    options.name = "all";
    bool ok = tartan_house_library_open(module, &options, NULL, &library, NULL) == TARTAN_OK &&
              tartan_house_read(library, hut, sizeof hut - 1, &house, NULL) == TARTAN_OK &&
              tartan_house_rank(house, NULL, &rank, NULL) == TARTAN_OK &&
              tartan_house_mesh(house, NULL, &mesh, NULL) == TARTAN_OK &&
              tartan_house_file(house, TARTAN_HOUSE_SVG, NULL, NULL, &bytes, &size, NULL) == TARTAN_OK &&
              tartan_house_best(library, NULL, &wish, 1, 5, NULL, &houses, NULL) == TARTAN_OK;
    tartan_houses_free(houses);
    tartan_mesh_free(mesh);
    tartan_bytes_free(bytes);
    tartan_text_free(rank);
    tartan_house_free(house);
    tartan_house_library_free(library);
    own->size = ok ? size : 0;
    return NULL;
}

static void works_in_threads(void **state)
{
    (void)state;
    enum { THREADS = 4 };
    tartan_module *module = compile();
    thread_of_houses threads[THREADS] = {0};
    for (int i = 0; i < THREADS; i++) {
        threads[i].module = module;
        assert_int_equal(pthread_create(&threads[i].thread, NULL, ask_all, &threads[i]), 0);
    }
    for (int i = 0; i < THREADS; i++)
        pthread_join(threads[i].thread, NULL);
    for (int i = 0; i < THREADS; i++)
        assert_true(threads[i].size > 1000 && threads[i].size == threads[0].size);
    tartan_module_free(module);
}

/* ---- misuse */

static void refuses_wrong_libraries(void **state)
{
    (void)state;
    tartan_module *module = compile();
    tartan_house_library *library = NULL;
    tartan_house_library_options options = tartan_house_library_options_init();
    tartan_error error;
    assert_int_equal(tartan_house_library_open(NULL, NULL, NULL, &library, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_library_open(module, NULL, NULL, NULL, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_library_open(module, NULL, NULL, &library, &error), TARTAN_INVALID);
    assert_string_equal(error.message, "the module has several libraries of houses");
    options.name = "al";
    assert_int_equal(tartan_house_library_open(module, &options, NULL, &library, &error), TARTAN_INVALID);
    assert_string_equal(error.message, "the module has no library of houses `al`");
    assert_string_equal(error.help, "did you mean `all`?");
    options.name = "rows";
    assert_int_equal(tartan_house_library_open(module, &options, NULL, &library, &error), TARTAN_INVALID);
    options.name = "all";
    options.size = 0;
    assert_int_equal(tartan_house_library_open(module, &options, NULL, &library, &error), TARTAN_INVALID);
    assert_null(library);
    options.size = sizeof options;
    options.max_states = 1;
    const tartan_wish wish = {"long", true};
    tartan_houses *houses = NULL;
    assert_int_equal(tartan_house_library_open(module, &options, NULL, &library, &error), TARTAN_OK);
    assert_int_equal(tartan_house_best(library, NULL, &wish, 1, 1, NULL, &houses, &error), TARTAN_LIMIT);
    assert_int_equal(error.code, 1640);
    assert_null(houses);
    tartan_house_library_free(library);
    tartan_house_library_free(NULL);
    tartan_module_free(module);
}

static void refuses_wrong_plans(tartan_house_library *library)
{
    tartan_error error;
    char *count = NULL;
    tartan_houses *houses = NULL;
    const uint32_t trays[] = {0, 1, 0}, unknown[] = {2};
    const tartan_wish wish = {"long", true}, nameless = {NULL, true}, none = {"lon", true};
    const tartan_on_plan wrong[] = {{trays, 3}, {unknown, 1}, {NULL, 1}, {NULL, 0}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(tartan_house_library_count_on(library, &wrong[i], NULL, &count, &error), TARTAN_INVALID);
        assert_int_equal(tartan_house_sample(library, &wrong[i], 1, 1, NULL, &houses, &error), TARTAN_INVALID);
        assert_int_equal(tartan_house_best(library, &wrong[i], &wish, 1, 1, NULL, &houses, &error), TARTAN_INVALID);
    }
    assert_int_equal(tartan_house_library_count_on(library, NULL, NULL, &count, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_sample(library, NULL, 1, SIZE_MAX, NULL, &houses, &error), TARTAN_LIMIT);
    assert_int_equal(tartan_house_sample(library, NULL, 1, 1, NULL, NULL, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_best(library, NULL, &wish, 1, SIZE_MAX, NULL, &houses, &error), TARTAN_LIMIT);
    assert_int_equal(tartan_house_best(library, NULL, &wish, 0, 1, NULL, &houses, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_best(library, NULL, &wish, 4, 1, NULL, &houses, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_best(library, NULL, NULL, 1, 1, NULL, &houses, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_best(library, NULL, &nameless, 1, 1, NULL, &houses, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_best(library, NULL, &none, 1, 1, NULL, &houses, &error), TARTAN_INVALID);
    assert_string_equal(error.help, "did you mean `long`?");
    assert_null(count);
    assert_null(houses);
}

static void refuses_wrong_houses(void **state)
{
    (void)state;
    tartan_module *module = compile();
    tartan_house_library *library = open_library(module, "round");
    tartan_error error;
    tartan_house *house = NULL;
    tartan_houses *houses = NULL;
    tartan_mesh *mesh = NULL;
    char *line = NULL;
    void *bytes = NULL;
    size_t size;
    refuses_wrong_plans(library);
    assert_int_equal(tartan_house_read(NULL, hut, 1, &house, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_read(library, NULL, 1, &house, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_read(library, NULL, 0, &house, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_read(library, hut, 3, &house, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_read(library, "8' room:10' ; dome", 18, &house, &error), TARTAN_INVALID);
    assert_int_equal(error.column, 15);
    assert_int_equal(tartan_house_read(library, "8' room:10' ; _ ; - ; dome", 26, &house, &error), TARTAN_INVALID);
    assert_int_equal(error.column, 23);
    assert_int_equal(tartan_house_read(library, "8' room:10' ; _", 15, &house, &error), TARTAN_OK);
    assert_int_equal(tartan_house_write(house, &line, &error), TARTAN_OK);
    assert_string_equal(line, "8' room:10' ; vault(3') ; bed ; window ; -");
    tartan_text_free(line);
    tartan_house_free(house);
    house = NULL;
    line = NULL;
    assert_int_equal(tartan_house_unrank(library, NULL, NULL, &house, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_unrank(NULL, "0", NULL, &house, &error), TARTAN_INVALID);
    assert_null(house);
    assert_int_equal(tartan_house_write(NULL, &line, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_rank(NULL, NULL, &line, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_number(NULL, NULL, &line, NULL), TARTAN_INVALID);
    assert_int_equal(tartan_house_variants(NULL, NULL, NULL, &houses, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_mesh(NULL, NULL, &mesh, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_file(NULL, TARTAN_HOUSE_IFC, NULL, NULL, &bytes, &size, &error), TARTAN_INVALID);
    house = read_house(library, "8' room:10' ; gable(9:12) ; bed ; window"); /* of the form alone */
    assert_int_equal(tartan_house_rank(house, NULL, &line, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_number(house, NULL, &line, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_variants(house, NULL, NULL, &houses, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_file(house, TARTAN_HOUSE_IFC, NULL, NULL, NULL, &size, &error), TARTAN_INVALID);
    assert_int_equal(tartan_house_mesh(house, NULL, NULL, &error), TARTAN_INVALID);
    assert_null(line);
    assert_null(houses);
    begins(house, TARTAN_HOUSE_IFC, "ISO-10303-21");
    tartan_house_free(house);
    tartan_house_free(NULL);
    tartan_houses_free(NULL);
    tartan_house_library_free(library);
    tartan_module_free(module);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counts_houses),        cmocka_unit_test(numbers_houses),
        cmocka_unit_test(draws_and_finds),      cmocka_unit_test(makes_meshes),
        cmocka_unit_test(writes_files),         cmocka_unit_test(stops),
        cmocka_unit_test(works_in_threads),     cmocka_unit_test(refuses_wrong_libraries),
        cmocka_unit_test(refuses_wrong_houses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
