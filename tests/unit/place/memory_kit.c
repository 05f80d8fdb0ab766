/* Compiling a kit, placing it, measuring what was placed, searching for other models and counting buildings, with each
 * allocation failing once: an error every time, and nothing left behind. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "compiler/compile.h"
#include "driver/open/open.h"
#include "runtime/geometry/mesh.h"
#include "runtime/place/count/count.h"
#include "runtime/place/measure.h"
#include "runtime/place/search/search.h"
#include "runtime/place/steps.h"
#include "tests/support/fail_each.h"

static const char kit[] =
    "unit 10 x 8 x 10;\nconnector stud joins tube every 20;\nconnector tube joins stud every 20;\n"
    "part two \"two\" { fill 40 x 24 x 20; studs up 2 x 1; tubes down 2 x 1 at (0, -24, 0); mass 2; }\n"
    "space room = box(100, 72, 60) and not sphere(20);\n"
    "rule wall at stud, tube = (two in 4 [0.5] | two [0.5]);\n"
    "model hut { inside room; start stud at (30, 0, 10) by wall; require count(two) > 0; }\n"
    "model beam { inside box(60, 48, 20); start stud at (20, 0, 0) by wall; require joints > 0; minimize elements + "
    "cuts;\n"
    "  search beam 2; stock two <= 4; }\n"
    "model turned { inside box(80, 48, 20); start stud at (10, 0, 0) by wall; minimize cuts; search anneal 1; symmetry "
    "turn 2; "
    "}\n"
    "model all { inside box(60, 48, 20); start stud at (20, 0, 0) by wall; maximize joints; search exact; }\n";

/* Searches for the other models. */
static tn_status search(const tn_module *module, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 1; i < module->KIT_MODEL_count && status == TN_OK; i++) {
        const tn_place_options options = {.threads = 1};
        tn_place_rules rules = {0};
        tn_placed_model model = {0};
        status = tn_place_rules_of_model(module, i, &rules, error);
        if (status == TN_OK)
            status = tn_place_search(&rules, &options, &model, error);
        if (status == TN_OK)
            assert_true(model.count > 0);
        tn_placed_model_clear(&model);
        tn_place_rules_clear(&rules);
    }
    return status;
}

/* Counts inside of the first model's space. */
static tn_status count_inside(const tn_module *module, tn_error *error)
{
    tn_place_rules rules = {0};
    uint64_t count = 0;
    tn_status status = tn_place_rules_of_model(module, 0, &rules, error);
    if (status == TN_OK)
        status = tn_count_inside(&rules, NULL, 2, 1, NULL, &count, error);
    if (status == TN_OK)
        assert_true(count > 0);
    tn_place_rules_clear(&rules);
    return status;
}

/* Divides what was placed into steps. */
static tn_status divide(const tn_module *module, tn_placed_model *model, tn_error *error)
{
    static const tn_steps_wish layers = {.layers = true};
    tn_placed_steps steps;
    tn_status status = tn_placed_steps_make(module, &layers, NULL, model, &steps, error);
    if (status == TN_OK)
        assert_true(steps.count > 1);
    tn_placed_steps_clear(&steps);
    return status;
}

/* TN_OK where all was done. */
static tn_status run(void)
{
    tn_opened opened;
    tn_place_rules rules = {0};
    tn_placed_model model = {0};
    tn_placed_measures measured = {0};
    tn_place_fault fault;
    tn_error error;
    tn_status status = tn_open_bytes("own.kit", (const uint8_t *)kit, sizeof kit - 1, false, &opened);
    if (status == TN_OK)
        status = tn_place_rules_of_model(opened.module, 0, &rules, &error);
    if (status == TN_OK)
        status = tn_place_derive(&rules, NULL, &model, &fault, &error);
    if (status == TN_OK)
        status = tn_placed_measure(opened.module, rules.space, &model, NULL, &measured, &error);
    if (status == TN_OK)
        assert_true(model.count > 2 &&
                    tn_kit_condition_holds(opened.module, opened.module->KIT_CONDITION_records[0].holds, &measured));
    if (status == TN_OK)
        status = search(opened.module, &error);
    tn_building_counts counts = {0};
    if (status == TN_OK)
        status =
            tn_count_buildings(&(tn_place_rules){.module = opened.module}, NULL, 2, false, 1, NULL, &counts, &error);
    if (status == TN_OK)
        assert_true(counts.buildings > 0 && counts.buildings < counts.fixed);
    if (status == TN_OK)
        status = count_inside(opened.module, &error);
    if (status == TN_OK)
        status = divide(opened.module, &model, &error);
    tn_placed_measures_clear(&measured);
    tn_placed_model_clear(&model);
    tn_place_rules_clear(&rules);
    tn_close(&opened);
    return status;
}

/* ---- files that a kit names */

/* A part of two studs, and the primitives of a stud and a tube. */
static tn_status give_part(const char *name, uint8_t **bytes, size_t *size, tn_error *error)
{
    static const char *const files[][2] = {
        {"one.dat", "0 Part\n1 16 -10 0 0 1 0 0 0 1 0 0 0 1 stud.dat\n1 16 10 0 0 1 0 0 0 1 0 0 0 1 stud.dat\n"
                    "1 16 0 4 0 1 0 0 0 -5 0 0 0 1 stud3.dat\n1 16 0 0 0 20 0 0 0 24 0 0 0 10 box.dat\n"},
        {"box.dat", "4 16 -1 0 -1 1 0 -1 1 0 1 -1 0 1\n3 16 -1 1 -1 1 1 -1 1 1 1\n"},
        {"stud.dat", "0 Stud\n"},
        {"stud3.dat", "0 Stud Tube Solid\n"}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        if (strcmp(files[i][0], name) != 0)
            continue;
        *size = strlen(files[i][1]);
        *bytes = malloc(*size);
        if (!*bytes)
            return tn_fail_memory(error);
        memcpy(*bytes, files[i][1], *size);
        return TN_OK;
    }
    return tn_fail(error, TN_IO, E_CANNOT_READ, "there is no %.60s", name);
}

static tn_status give_bytes(void *context, const tn_request *request, uint8_t **bytes, size_t *size, tn_error *error)
{
    static const char hill[] = "P5 2 1 9\n\003\011", parts[] = "1 4 0 0 0 1 0 0 0 1 0 0 0 1 two.dat\n";
    bool is_hill = strcmp(request->path, "hill.pgm") == 0;
    (void)context;
    if (strstr(request->path, ".dat"))
        return give_part(request->path, bytes, size, error);
    *size = is_hill ? sizeof hill - 1 : sizeof parts - 1;
    *bytes = malloc(*size);
    if (!*bytes)
        return tn_fail_memory(error);
    memcpy(*bytes, is_hill ? hill : parts, *size);
    return TN_OK;
}

static tn_status give_mesh(void *context, const tn_request *request, tn_mesh *mesh, tn_error *error)
{
    static const double positions[12] = {0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 9};
    static const uint32_t corners[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    (void)context, (void)request;
    tn_status status = tn_mesh_new(4, 4, 12, mesh, error);
    if (status != TN_OK)
        return status;
    memcpy(mesh->positions, positions, sizeof positions);
    memcpy(mesh->corners, corners, sizeof corners);
    for (uint32_t i = 0; i <= 4; i++)
        mesh->face_first[i] = 3 * i;
    return TN_OK;
}

/* Compiles a kit with spaces from files, and places its models. */
static tn_status run_files(void)
{
    static const char text[] =
        "unit 10 x 8 x 10;\nconnector stud joins tube every 20;\nconnector tube joins stud every 20;\n"
        "part two { fill 40 x 24 x 20; studs up 2 x 1; tubes down 2 x 1 at (0, -24, 0); }\n"
        "part one from ldraw \"one.dat\" { mass 1; }\n"
        "rule wall at stud, tube = two | one;\n"
        "model first { inside heightmap(\"hill.pgm\", 80, 72, 60) or mesh(\"m.obj\", 96) or model(\"two.ldr\") turn "
        "2;\n"
        "  start \"two.ldr\" by wall; }\n"
        "model second { inside box(80, 96, 60) or model(\"two.ldr\"); start \"two.ldr\" by wall; search anneal 3; }\n";
    const tn_input input = {.text = text, .size = sizeof text - 1, .name = "files.kit"};
    const tn_compile_options how = {.attachments = {give_bytes, give_mesh, NULL}};
    tn_opened opened;
    tn_place_rules rules = {0};
    tn_placed_model model = {0};
    tn_place_fault fault;
    tn_error error;
    tn_status status = tn_open_text(TN_NOTATION(kit), &input, &how, &opened);
    if (status == TN_OK)
        status = tn_place_rules_of_model(opened.module, 0, &rules, &error);
    if (status == TN_OK)
        status = tn_place_derive(&rules, NULL, &model, &fault, &error);
    if (status == TN_OK)
        assert_true(model.count > 0);
    tn_placed_model_clear(&model);
    tn_place_rules_clear(&rules);
    if (status == TN_OK)
        status = search(opened.module, &error);
    tn_close(&opened);
    return status;
}

static void every_allocation(void **state)
{
    (void)state;
    fail_each(run, false);
}

static void every_allocation_of_files(void **state)
{
    (void)state;
    fail_each(run_files, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation), cmocka_unit_test(every_allocation_of_files)};
    return cmocka_run_group_tests_name("memory_kit", tests, NULL, NULL);
}
