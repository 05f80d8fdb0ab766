/* Out of memory in what an author asks for: explanations, coverage, reports, exports and pictures of rules. Each of our
 * allocations fails once, and then all from there on. What fails must say so and leave nothing behind; what does not
 * fail must be what it is with memory enough. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "driver/house/analysis.h"
#include "driver/report/report.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/picture/draw_rule.h"
#include "runtime/plan/text/export_prolog.h"
#include "runtime/plan/text/export_regex.h"
#include "tests/support/same_or_memory.h"
#include "tests/support/test_schema.h"

static const char text[] =
    "schema row { width role length = 1m | 2m height role level = low | high door = flag\n"
    "  zone wall role band = brick(300mm) role solid | none role absent }\n"
    "rule pair \"two doors\" = neighbour(tray(door), optional(tray(2m)), tray(door))\n"
    "rule ends = symmetric neighbour(beginning, tray(wall none)) and quantity(tray(door), n >= 1)\n"
    "rule far = distance(from tray(high), to tray(door), by sum(width of any, w > 1m))\n"
    "library rows { trays 2..3 total width <= 5m require quantity(tray(high), n >= 1) prune pair, ends, far\n"
    "  prune not tray(door) and pair as odd \"it cannot be\" }\n"
    "test pair { match [door | door] reject [1m] }\n"
    "test rows { keep [1m | high door] drop [door | door] by pair }\n";

static const char cabins[] =
    "schema bay { width role length = 3m | 4m zone body role band = room(4m) role void }\n"
    "form cabin of bay { storey low 3m storey high 2800mm wall 200mm partition 100mm floor 300mm roof 200mm\n"
    "  option body storeys = 1 | 2 option body roof = flat | gable(9:12) option colour = red | blue\n"
    "  forbid option(colour red) and option(body storeys 2) void cell(high, 3m) no cell(low, area < 10m2)\n"
    "  function live at cell(low) function sleep at cell(body)\n"
    "  opening door wide 900mm high 2m clear 1m passage opening pane wide 1m high 1m sill 1m glazed\n"
    "  face cell(live) beside cell(sleep) = door | wall  face cell(any) outside = pane | wall\n"
    "  tile bed for sleep { item bed left 0..1m, back 0..2m, up 0..500mm } }\n"
    "library bays using bay { trays 1..2 }\n"
    "rule dark \"no light\" = room(sleep, not by pane)\n"
    "library cabins from bays in cabin { require cell(live) and not tray(3m) prune dark }\n"
    "test dark { match [4m ; 1 flat red ; sleep ; wall wall wall wall] }\n"
    "test cabins { keep [4m ; 1 flat blue ; live ; pane wall wall wall] drop [4m ; 1 flat blue ; sleep] }\n";

/* Clauses that change nothing, and that contradict one another; values that no house has; rules that are equal. */
static const char idle[] =
    "schema bay { width role length = 3m | 4m zone body role band = room(4m) role void }\n"
    "form cabin of bay { storey low 3m wall 200mm partition 100mm floor 300mm roof 200mm\n"
    "  option body roof = flat | gable(9:12) function live at cell(body) function sleep at cell(body)\n"
    "  opening door wide 900mm high 2m passage face cell(any) beside cell(any) = door | wall }\n"
    "library bays using bay { trays 1..2 }\n"
    "rule beds = cell(sleep) rule slept = quantity(cell(sleep), n >= 1) rule more = quantity(cell(sleep), n > 1)\n"
    "library some from bays in cabin { require option(body roof flat), beds prune not slept }\n"
    "library none from bays in cabin { require more prune slept, cell(live) as live }\n";

static const tn_tray dropped[] = {3, 2, 3, 0, 5, 5};

/* The file, opened with memory enough. */
typedef struct opened_rows {
    tn_opened opened;
    tn_ready_library ready;
    tn_plan_analyses analyses;
    tn_covered covered;
} opened_rows;

static tn_status explain(void *context, tn_buffer *out, tn_error *error)
{
    opened_rows *rows = context;
    tn_explained explained;
    tn_near_finder *finder = NULL;
    tn_picture picture = {.number = 1};
    tn_status status = tn_explained_make(&explained, &rows->opened, rows->ready.schema, rows->ready.record, NULL, 0,
                                         dropped, 6, 100, error);
    if (status == TN_OK)
        status = tn_near_finder_new(rows->ready.schema, rows->ready.index, NULL, &finder, error);
    if (status == TN_OK)
        status = tn_explained_near(&explained, finder, 3, error);
    explained.automaton = rows->ready.library;
    if (status == TN_OK && !(tn_explained_text(&explained, false, out) && tn_explained_text(&explained, true, out)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_explained_draw(&explained, true, &picture, error);
    if (status == TN_OK && !tn_buffer_append(out, picture.element, picture.size))
        status = tn_fail_memory(error);
    free(picture.element);
    tn_near_finder_free(finder);
    tn_explained_clear(&explained);
    return status;
}

static tn_status cover(void *context, tn_buffer *out, tn_error *error)
{
    opened_rows *rows = context;
    const tn_coverage_options options = {.imported = true};
    tn_covered covered;
    tn_status status = tn_coverage_measure(&rows->opened, &options, &covered);
    if (status == TN_MEMORY)
        tn_fail_memory(error);
    if (status == TN_OK && !tn_covered_text(&covered, out))
        status = tn_fail_memory(error);
    tn_covered_clear(&covered);
    return status;
}

static tn_status analyse_houses(void *context, tn_buffer *out, tn_error *error)
{
    opened_rows *rows = context;
    tn_diagnostics *list = &rows->opened.compilation.diagnostics;
    tn_diagnostics_clear(list);
    tn_status status = tn_house_analyse(&rows->opened, 0);
    if (status == TN_MEMORY || list->failed)
        return tn_fail_memory(error);
    for (size_t i = 0; i < list->count; i++) {
        const tn_diagnostic *d = &list->items[i];
        tn_buffer_printf(out, "%s %s", d->message, d->help ? d->help : "");
        for (size_t k = 0; k < d->note_count; k++)
            tn_buffer_printf(out, " %s", d->notes[k].text);
    }
    return out->failed ? tn_fail_memory(error) : TN_OK;
}

static tn_status report(void *context, tn_buffer *out, tn_error *error)
{
    opened_rows *rows = context;
    const tn_report_options options = {.samples = 1, .seed = 3};
    return tn_report_page(&rows->opened, &rows->ready, &rows->analyses, &rows->covered, &options, out, error);
}

static tn_status draw(void *context, tn_buffer *out, tn_error *error)
{
    opened_rows *rows = context;
    tn_picture picture = {.number = 1};
    tn_drawn_rule rules[3];
    for (uint32_t i = 0; i < 3; i++)
        rules[i] = tn_drawn_rule_of(rows->opened.module, i);
    tn_status status = tn_rules_draw(rows->ready.schema, rules, 3, &picture, error);
    if (status == TN_OK && !tn_buffer_append(out, picture.element, picture.size))
        status = tn_fail_memory(error);
    free(picture.element);
    return status;
}

static tn_status export(void *context, tn_buffer *out, tn_error *error)
{
    opened_rows *rows = context;
    const tn_module *module = rows->opened.module;
    tn_classes *classes = NULL;
    tn_lowering *lowering = NULL;
    tn_dfa *dfa = NULL;
    tn_status status = tn_export_prolog(rows->ready.schema, &(tn_prolog_options){.fetch = true}, out, error);
    if (status == TN_OK)
        status = tn_classes_new(rows->ready.schema, &module->RULE_records[1].holds, 1, &classes, error);
    if (status == TN_OK)
        status = tn_lowering_new(classes, 0, &lowering, error);
    if (status == TN_OK)
        status = tn_lower(lowering, module->RULE_records[1].holds, &dfa, error);
    if (status == TN_OK)
        status = tn_export_regex(dfa, out, error);
    if (status == TN_OK)
        status = tn_regex_legend(dfa, classes, out, error);
    if (status == TN_OK && !tn_regex_plan(dfa, classes, dropped, 6, out))
        status = tn_fail_memory(error);
    tn_dfa_free(dfa);
    tn_lowering_free(lowering);
    tn_classes_free(classes);
    return status;
}

static void explaining(void **state)
{
    same_or_memory(explain, *state, 16);
}

static void covering(void **state)
{
    same_or_memory(cover, *state, 10);
}

/* Of rules about houses and of a form. */
static void covering_houses(void **state)
{
    opened_rows rows = {0};
    (void)state;
    if (tn_open_bytes("cabins.plan", (const uint8_t *)cabins, strlen(cabins), false, &rows.opened) != TN_OK)
        fail_msg("%s", rows.opened.compilation.diagnostics.items[0].message);
    same_or_memory(cover, &rows, 10);
    tn_close(&rows.opened);
}

static void analysing_houses(void **state)
{
    opened_rows rows = {0};
    (void)state;
    if (tn_open_bytes("idle.plan", (const uint8_t *)idle, strlen(idle), false, &rows.opened) != TN_OK)
        fail_msg("%s", rows.opened.compilation.diagnostics.items[0].message);
    same_or_memory(analyse_houses, &rows, 16);
    tn_close(&rows.opened);
}

static void reporting(void **state)
{
    same_or_memory(report, *state, 6);
}

static void drawing(void **state)
{
    same_or_memory(draw, *state, 30);
}

static void exporting(void **state)
{
    same_or_memory(export, *state, 30);
}

static int open_rows(void **state)
{
    static const tn_library_options options = {0};
    static const tn_coverage_options coverage = {.imported = true};
    opened_rows *rows = calloc(1, sizeof *rows);
    assert_non_null(rows);
    *state = rows;
    if (tn_open_bytes("rows.plan", (const uint8_t *)text, strlen(text), false, &rows->opened) != TN_OK ||
        tn_library_ready(&rows->opened, NULL, &options, &rows->ready) != TN_OK ||
        tn_plan_analyse(&rows->opened, NULL, &rows->analyses) != TN_OK ||
        tn_coverage_measure(&rows->opened, &coverage, &rows->covered) != TN_OK)
        fail_msg("%s", rows->opened.compilation.diagnostics.items[0].message);
    return 0;
}

static int close_rows(void **state)
{
    opened_rows *rows = *state;
    tn_covered_clear(&rows->covered);
    tn_plan_analyses_free(&rows->analyses);
    tn_library_close(&rows->ready);
    tn_close(&rows->opened);
    free(rows);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(explaining),      cmocka_unit_test(covering),
                                       cmocka_unit_test(covering_houses), cmocka_unit_test(analysing_houses),
                                       cmocka_unit_test(reporting),       cmocka_unit_test(drawing),
                                       cmocka_unit_test(exporting)};
    return cmocka_run_group_tests(tests, open_rows, close_rows);
}
