/* Out of memory in pictures of houses and in the page of a library of them: each of our allocations fails once, and
 * then all from there on. What fails says so; what does not is what it is with memory enough. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/report/house_report.h"
#include "runtime/house/picture/draw.h"
#include "tests/support/same_or_memory.h"
#include "tests/support/test_schema.h"

static const char text[] =
    "schema hut { width role length = 8' | 10' zone body role band = room(10', 12') }\n"
    "form huts \"small\" of hut {\n"
    "  storey ground 9' wall 6\" partition 4\" floor 10\" roof 8\"\n"
    "  option body storeys = 1 option body roof = gable(9:12) | vault(3')\n"
    "  function bed \"sleeps\" at cell(body)\n"
    "  opening window \"a sash\" wide 3' high 4' sill 2'8\"\n"
    "  opening door wide 2'8\" high 6'8\" clear 2' passage\n"
    "  face cell(any) beside cell(any) = door\n"
    "  face cell(bed) outside front = window | wall\n"
    "  tile cot \"<low>\" for bed { against wall item cot left 1'..right 1', back 0..6', up 0..2' }\n"
    "}\n"
    "library rows using hut { trays 1..2 }\n"
    "library all from rows in huts { prune option(body roof vault) as round \"too dear\" }\n";

static tn_opened opened;
static tn_schema *schema;
static tn_house_form form;
static tn_reported_house reported = {.name = (char[]){"#1"}};
static mpz_t counts[2];

static tn_status report(void *context, tn_buffer *out, tn_error *error)
{
    (void)context;
    const tn_house_report of = {.opened = &opened,
                                .form = &form,
                                .library = &opened.module->HOUSE_LIBRARY_records[0],
                                .low = 1,
                                .high = 2,
                                .lengths = counts,
                                .kept_out = counts,
                                .alone = counts,
                                .houses = &reported,
                                .house_count = 1,
                                .seed = 1};
    return tn_house_report_page(&of, out, error);
}

/* Appends what was drawn. */
static tn_status take(tn_status status, tn_picture *picture, tn_buffer *out, tn_error *error)
{
    if (status == TN_OK && !tn_buffer_append(out, picture->element, picture->size))
        status = tn_fail_memory(error);
    free(picture->element);
    return status;
}

static tn_status draw_sheet(void *context, tn_buffer *out, tn_error *error)
{
    (void)context;
    static const tn_aspect aspects[] = {{.kind = TN_ASPECT_PLAN},
                                        {.kind = TN_ASPECT_SECTION_X, .at = INT64_C(1200000000)},
                                        {.kind = TN_ASPECT_ELEVATION, .side = TN_HOUSE_FRONT}};
    static const char *const notes[] = {"a note"};
    const tn_house_drawing drawing = {.aspects = aspects, .count = 3, .title = "hut", .notes = notes, .note_count = 1};
    tn_picture picture = {0};
    tn_status status = tn_house_draw(&reported.house, &reported.solids, &drawing, &picture, error);
    return take(status, &picture, out, error);
}

static tn_status draw_space(void *context, tn_buffer *out, tn_error *error)
{
    (void)context;
    const tn_aspect aspect = {.kind = TN_ASPECT_AXONOMETRIC, .camera = tn_camera_default()};
    tn_picture picture = {0};
    tn_status status = tn_house_draw(&reported.house, &reported.solids,
                                     &(tn_house_drawing){.aspects = &aspect, .count = 1}, &picture, error);
    return take(status, &picture, out, error);
}

static tn_status draw_gallery(void *context, tn_buffer *out, tn_error *error)
{
    (void)context;
    const tn_pictured_house one = {&reported.house, &reported.solids, "#1", "small"};
    const tn_pictured_house both[] = {one, one};
    const tn_house_gallery gallery = {.houses = both, .count = 2, .camera = tn_camera_default(), .title = "huts"};
    tn_picture picture = {0};
    return take(tn_house_gallery_draw(&gallery, &picture, error), &picture, out, error);
}

static tn_status draw_lit(void *context, tn_buffer *out, tn_error *error)
{
    (void)context;
    static const char *const lines[] = {"cell(bed): 1.body.ground"};
    static const tn_lit lits[] = {{0, {0, 1000000000, 0, 1000000000}, TN_LIT_BESIDE},
                                  {0, {0, 0, 0, 1000000000}, TN_LIT_FAULT}};
    const tn_lit_reason reasons[] = {{"round: matches, and is pruned", false, lines, 1, lits, 2},
                                     {"square: does not match", true, NULL, 0, NULL, 0}};
    const tn_lit_house lit = {&reported.house, &reported.solids, "dropped", "a house", reasons, 2};
    tn_picture picture = {0};
    return take(tn_lit_house_draw(&lit, &picture, error), &picture, out, error);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    static const char line[] = "10' room:12' ; 1 gable(9:12) ; bed ; window ; cot.back";
    tn_error error = {0};
    if (tn_open_bytes("huts.plan", (const uint8_t *)text, strlen(text), false, &opened) != TN_OK)
        fail_msg("%s", tn_first_error(&opened));
    test_ok(tn_schema_new(opened.module, opened.module->FORM_records[0].schema, 0, &schema, &error), &error);
    tn_form_ready(opened.module, 0, schema, &form);
    test_ok(tn_house_read_open(&form, line, strlen(line), 8, &reported.house, &error), &error);
    test_ok(tn_house_solids(&reported.house, &reported.solids, &error), &error);
    mpz_init_set_ui(counts[0], 3);
    mpz_init_set_ui(counts[1], 12);
    same_or_memory(report, NULL, 40);
    same_or_memory(draw_sheet, NULL, 40);
    same_or_memory(draw_space, NULL, 40);
    same_or_memory(draw_gallery, NULL, 40);
    same_or_memory(draw_lit, NULL, 40);
    mpz_clears(counts[0], counts[1], NULL);
    tn_solids_clear(&reported.solids);
    tn_house_clear(&reported.house);
    tn_schema_free(schema);
    tn_close(&opened);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_may_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
