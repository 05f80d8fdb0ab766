/* Compiles the form of test_house.h. */
#include "tests/support/test_house.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/load.h"

static const char text[] =
    "schema hut {\n"
    "  width role length = 8' | 10'\n"
    "  zone body role band = room(10', 12')\n"
    "  zone bay role band = empty role absent | open(4')\n"
    "}\n"
    "form huts of hut {\n"
    "  storey ground 9'\n"
    "  storey loft 8'\n"
    "  wall outside 6\" { boards 1\", studs 5\" }\n  partition 4\" { lining 1\", studs 2\", lining 1\" }\n"
    "  floor 10\" { floor 1\", joists 9\" }\n  roof 8\" { tiles 1\", rafters 7\" }\n"
    "  option body storeys = 1 | 2\n"
    "  option body roof = gable(9:12) | shed(back, 3:12) | vault(3')\n"
    "  option bay storeys = 1\n"
    "  option cladding = shingle | board\n"
    "  function living at cell(body, ground)\n"
    "  function bed at cell(body)\n"
    "  function stair at cell(body)\n"
    "  function seat at cell(bay)\n"
    "  opening door wide 2'8\" high 6'8\" clear 2' passage\n"
    "  opening window wide 3' high 4' sill 2'8\"\n"
    "  face cell(stair) under cell(stair) = stair\n"
    "  face cell(living) beside cell(living) = open | door\n"
    "  face cell(seat) beside cell(any) = open\n"
    "  face cell(body) beside cell(body) = door\n"
    "  face cell(bed) outside front = window | wall\n"
    "  face cell(seat) outside front = window | wall\n"
    "  tile cot for bed { against wall or window wide 7'..12' item cot left 1'..right 1', back 0..6', up 0..2' }\n"
    "}\n"
    "library rows using hut { trays 1..3 }\n"
    "library all from rows in huts { }\n"
    "library some from rows in huts {\n"
    "  require cell(bed)\n"
    "  require quantity(cell(living), n < 3) and not cell(stair, ground) or cell(loft)\n"
    "  prune room(bed, not by window) as dark\n"
    "  prune apart(cell(bed), from cell(living)) as far\n"
    "  prune touch(cell(living), cell(stair) by door) as blocked\n"
    "  prune option(body roof vault) as round\n"
    "  prune sum(area of cell(bed), a < 90sf)\n"
    "}\n"
    "measure rooms = 3 * quantity(cell(bed)) - quantity(room(living)) + quantity(tray(10'))\n"
    "measure floor = sum(area of cell(any))\n";

void test_house_make(test_house *made)
{
    test_house_compile(made, text);
}

void test_house_compile(test_house *made, const char *written)
{
    static const char path[] = "huts.plan";
    tn_error error = {0};
    tn_input input = {.text = written, .size = strlen(written), .name = path};
    tn_compile_options options = {0};
    *made = (test_house){0};
    tn_status status =
        tn_compile_text(tn_notation_or_first(path, written, input.size), &input, &options, &made->compilation);
    for (size_t i = 0; i < made->compilation.diagnostics.count; i++)
        if (status != TN_OK)
            fprintf(stderr, "%s\n%s", made->compilation.diagnostics.items[i].message, written);
    assert_int_equal(status, TN_OK);
    assert_int_equal(
        tn_module_load(made->compilation.module, made->compilation.module_size, NULL, &made->module, &error), TN_OK);
    assert_int_equal(tn_schema_new(made->module, made->module->FORM_records[0].schema, 0, &made->schema, &error),
                     TN_OK);
    tn_form_ready(made->module, 0, made->schema, &made->form);
    assert_int_equal(made->module->HOUSE_LIBRARY_count, 2);
    made->all = &made->module->HOUSE_LIBRARY_records[0];
    made->some = &made->module->HOUSE_LIBRARY_records[1];
}

void test_house_clear(test_house *made)
{
    tn_schema_free(made->schema);
    tn_module_free(made->module);
    tn_compilation_clear(&made->compilation);
}

tn_plan test_house_plan(const test_house *made, const char *line)
{
    tn_plan plan = {0};
    tn_error error = {0};
    assert_int_equal(tn_plan_parse_line(made->schema, line, strlen(line), 8, &plan, &error), TN_OK);
    return plan;
}
