/* Out of memory where forms are asked about behind the C interface: each allocation fails once, and then all from there
 * on. A question says so, or does without one, and leaves nothing behind. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "include/tartan/tartan.h"
#include "tests/support/fail_each.h"

static tn_status ask_of(const char *path, const char *text, const char *question, const char *const *requests,
                        size_t count)
{
    tartan_session *session = NULL;
    tartan_error error = {0};
    tartan_status status = tartan_session_open(path, text, strlen(text), NULL, &session, &error);
    for (size_t i = 0; status == TARTAN_OK && i < count; i++) {
        char *answer = NULL;
        status = tartan_ask(session, question, requests[i], NULL, NULL, NULL, &answer, &error);
        assert_true(!answer == (status != TARTAN_OK));
        tartan_text_free(answer);
    }
    tartan_session_free(session);
    return (tn_status)status;
}

#define ASKING(NAME, PATH, TEXT, QUESTION, ...)                                                                        \
    static tn_status NAME(void)                                                                                        \
    {                                                                                                                  \
        static const char *const requests[] = {__VA_ARGS__};                                                           \
        return ask_of(PATH, TEXT, QUESTION, requests, sizeof requests / sizeof *requests);                             \
    }

ASKING(mesh_field, "ball.field", "surface ball = x*x + y*y + z*z - 1 grid 5\n", "mesh",
       "{\"format\": \"obj\", \"stats\": true, \"normals\": true, \"threads\": 1}",
       "{\"bounds\": true, \"thickness\": true, \"sharp\": true, \"threads\": 1}",
       "{\"points\": [[0, 0, 0], [1, 2, 3]]}")
ASKING(
    mesh_solid, "pair.solid",
    "solid pair {\n  symmetry x;\n  box low from (1, 0, 0) to (3, 2, 2);\n  box high from (2, 1, 0) to (4, 3, 2);\n}\n",
    "mesh", "{\"format\": \"scad\", \"stats\": true}", "{\"format\": \"glb\"}", "{}")

ASKING(grow, "leaf.hemls", "A + A + A\nA -> A [+ A] ~ A\nAngle 60\n", "grow", "{\"steps\": 2}",
       "{\"steps\": 1, \"format\": \"obj\", \"stats\": true, \"explain\": true, \"each_step\": true}",
       "{\"steps\": 1, \"format\": \"ply\", \"scale\": \"1.5\", \"overlay\": []}")

ASKING(explain_solid, "pair.solid",
       "solid pair {\n  box low from (0, 0, 0) to (2, 2, 2);\n  box high from (1, 1, 0) to (3, 3, 2);\n}\n", "explain",
       "{}")

ASKING(slice_field, "ball.field", "surface ball = x*x + y*y + z*z - 1 grid 5\n", "slice",
       "{\"layer\": 0.5, \"format\": \"cli\", \"each\": true, \"threads\": 1}", "{\"layer\": 1, \"threads\": 1}")
ASKING(slice_solid, "pair.solid", "solid pair {\n  box low from (0, 0, 0) to (2, 2, 2);\n}\n", "slice",
       "{\"layer\": 1, \"format\": \"dxf\"}")

ASKING(house, "hut.plan",
       "schema row { bay = 4m  zone rooms = room(4m) }\n"
       "form cells of row {\n  storey ground 3m\n  wall 300mm\n  partition 100mm\n  floor 250mm\n  roof 200mm\n"
       "  function bedroom at cell(rooms)\n  face cell(any) outside = wall\n}\n",
       "house",
       "{\"house\": \"4m room:4m\", \"files\": [\"json\", \"csv\", \"parts.csv\", \"obj\", \"mtl\", \"glb\", \"ifc\", \"dxf\"]}",
       "{\"house\": \"4m room:4m | 4m room:4m\"}")

static void test_explain_solid(void **state)
{
    (void)state;
    fail_each(explain_solid, false);
}

static void test_grow(void **state)
{
    (void)state;
    fail_each(grow, false);
}

static void test_mesh_field(void **state)
{
    (void)state;
    fail_each(mesh_field, false);
}

static void test_mesh_solid(void **state)
{
    (void)state;
    fail_each(mesh_solid, false);
}

static void test_slice_field(void **state)
{
    (void)state;
    fail_each(slice_field, false);
}

static void test_slice_solid(void **state)
{
    (void)state;
    fail_each(slice_solid, false);
}

static void test_house(void **state)
{
    (void)state;
    fail_each(house, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_slice_field), cmocka_unit_test(test_slice_solid),
                                       cmocka_unit_test(test_house),       cmocka_unit_test(test_explain_solid),
                                       cmocka_unit_test(test_grow),        cmocka_unit_test(test_mesh_field),
                                       cmocka_unit_test(test_mesh_solid)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
