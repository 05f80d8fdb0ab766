/* Out of memory where two libraries of houses are compared: together, one by one, on other plans and in another form.
 * Each of our allocations fails once, and then all from there on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ask/house/compared.h"
#include "ask/plan/diff.h"
#include "runtime/house/rule/stages.h"
#include "tests/support/same_or_memory.h"
#include "tests/support/test_house.h"

#define SCHEMA(LENGTHS) "schema hut { width role length = " LENGTHS " zone body role band = room(10') }\n"
#define FORM(FACES)                                                                                                    \
    "form huts of hut {\n"                                                                                             \
    "  storey ground 9' wall 6\" partition 4\" floor 10\" roof 8\"\n"                                                  \
    "  option body roof = gable(9:12) | vault(3')\n"                                                                   \
    "  function bed at cell(body)\n"                                                                                   \
    "  opening window wide 3' high 4' sill 2'8\"\n"                                                                    \
    "  opening door wide 2'8\" high 6'8\" clear 2' passage\n"                                                          \
    "  face cell(bed) beside cell(bed) = door\n"                                                                       \
    "  face cell(bed) outside front = " FACES "\n"                                                                     \
    "}\n"
#define PLANS(CLAUSES) "library rows using hut { trays 1..2 " CLAUSES "}\n"
/* The form of a test has two libraries. */
#define HOUSES(CLAUSES) "library all from rows in huts { " CLAUSES "}\nlibrary same from rows in huts { }\n"
#define VAULT "prune option(body roof vault) as round "
#define DARK "prune room(bed, not by window) as dark "

static const struct {
    const char *old, *new;
} pairs[] = {
    /* together, with other plans */
    {SCHEMA("8' | 10'") FORM("window | wall") PLANS("") HOUSES(VAULT),
     SCHEMA("8' | 10'") FORM("window | wall") PLANS("prune tray(8') as small ") HOUSES(VAULT DARK)},
    /* one by one: another clause */
    {SCHEMA("8' | 10'") FORM("window | wall") PLANS("") HOUSES(VAULT),
     SCHEMA("8' | 10'") FORM("window | wall") PLANS("") HOUSES(DARK)},
    /* one by one: another form, and trays by other numbers */
    {SCHEMA("8' | 10'") FORM("window | wall") PLANS("prune tray(8') as small ") HOUSES(VAULT),
     SCHEMA("10' | 8'") FORM("wall | door") PLANS("prune tray(8') as small ") HOUSES(VAULT)},
};

typedef struct compared_pair {
    test_house houses[2];
    tn_library *plans[2];
    bool *walking[2]; /* as tn_numbered_open finds them */
} compared_pair;

static tn_status compare(void *context, tn_buffer *out, tn_error *error)
{
    static const tn_compared_options options = {.shown = 2, .seed = 1, .one_by_one = 1000};
    compared_pair *pair = context;
    const tn_diff_request request = {.before = "old.plan"};
    tn_compared_houses c = {0};
    tn_compared answer;
    tn_opened opened_file = {.path = "new.plan"};
    tn_session session = {.opened = &opened_file};
    tn_message_init(&tn_message_compared, &answer);
    tn_status status = TN_OK;
    for (int i = 0; i < 2; i++) {
        test_house *one = &pair->houses[i];
        const tn_numbered opened = {
            .session = &session, .schema = one->schema, .form = one->form, .walking = pair->walking[i]};
        tn_numbered_other(&opened, one->module, one->all, pair->plans[i], &c.sides[i].n);
    }
    if (status == TN_OK)
        status = tn_houses_compare(&c, &options, error);
    if (status == TN_OK)
        status = tn_diff_houses_answer(&request, &c, &answer, error);
    if (status == TN_OK) {
        tn_json json = tn_json_text(out, TN_JSON_TIGHT);
        tn_message_write(&tn_message_compared, &answer, NULL, &json);
    }
    if (status == TN_OK && out->failed)
        status = tn_fail_memory(error);
    tn_message_clear(&tn_message_compared, &answer);
    tn_houses_compare_clear(&c);
    tn_numbered_other_close(&c.sides[0].n);
    tn_numbered_other_close(&c.sides[1].n);
    return status;
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    static const tn_library_options options = {0};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        compared_pair pair = {0};
        for (int k = 0; k < 2; k++) {
            test_house *one = &pair.houses[k];
            tn_error error = {0};
            test_house_compile(one, k ? pairs[i].new : pairs[i].old);
            test_ok(tn_library_new(one->schema, one->all->plans, &options, &pair.plans[k], &error), &error);
            test_ok(tn_functions_walking(one->module, &pair.walking[k], &error), &error);
        }
        same_or_memory(compare, &pair, 40);
        for (int k = 0; k < 2; k++) {
            tn_library_free(pair.plans[k]);
            free(pair.walking[k]);
            test_house_clear(&pair.houses[k]);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_may_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
