/* Lists a module and runs the engines on it, each by its row; and the small engines' own functions. */
#include "tests/fuzz/engines.h"

#include <stdlib.h>

#include "runtime/base/memory.h"
#include "runtime/load.h"
#include "runtime/number/run.h"
#include "runtime/place/count/count.h"
#include "runtime/place/measure.h"
#include "runtime/place/search/search.h"
#include "runtime/solid/measure.h"
#include "tests/fuzz/grow.h"

enum { DRAWN_ONE_IN = 8 };

bool fuzz_draws(const tn_module *module)
{
    return module->hash % DRAWN_ONE_IN == 0;
}

void fuzz_drawn(tn_picture *picture)
{
    free(picture->element);
    *picture = (tn_picture){0};
}

void fuzz_number(const tn_module *module)
{
    static const double terms[TN_MEASURED_COUNT] = {1, -2, 0, 1e300, 0.5};
    for (size_t i = 0; i < module->FUNCTION_count; i++)
        if (module->FUNCTION_records[i].kind == TN_FUNCTION_MEASURE)
            tn_number_run(module->code, module->FUNCTION_records[i].code_begin, terms);
}

void fuzz_growth(const tn_module *module)
{
    grow_module(module);
}

/* What was placed of a kit is measured, and its conditions are asked. */
static void fuzz_measures(const tn_module *module, const tn_place_rules *rules, const tn_placed_model *model)
{
    tn_watch watch;
    tn_placed_measures measured;
    tn_watch_begin(&watch, NULL, NULL);
    watch.memory_limit = tn_memory_used() + (64 << 20);
    const tn_kit_model_record *space = rules->space;
    if (space && (double)(space->high_x - space->low_x) * (double)(space->high_y - space->low_y) *
                         (double)(space->high_z - space->low_z) >
                     1e6)
        space = NULL; /* its cells take long to count */
    if (tn_placed_measure(module, space, model, &watch, &measured, NULL) == TN_OK)
        for (uint32_t i = 0; i < module->KIT_CONDITION_count; i++)
            tn_kit_condition_holds(module, module->KIT_CONDITION_records[i].holds, &measured);
    tn_placed_measures_clear(&measured);
}

static tn_status make_rules(const tn_module *module, tn_place_rules *rules)
{
    return module->KIT_MODEL_count ? tn_place_rules_of_model(module, 0, rules, NULL)
                                   : tn_place_rules_make(module, rules, NULL);
}

/* Buildings of a few parts of a kit: both ways of splitting the work come to the same. */
static void fuzz_count(const tn_module *module)
{
    const tn_place_rules rules = {.module = module};
    for (uint32_t parts = 1; module->KIT_PART_count > 0 && module->KIT_PART_count < 4 && parts < 3; parts++) {
        tn_building_counts counts[2];
        tn_watch watch;
        tn_watch_begin(&watch, NULL, NULL);
        watch.memory_limit = tn_memory_used() + (64 << 20);
        tn_status status = tn_count_buildings(&rules, NULL, parts, false, 1, &watch, &counts[0], NULL);
        if (status == TN_OK && tn_count_buildings(&rules, NULL, parts, true, 2, &watch, &counts[1], NULL) == TN_OK &&
            counts[0].fixed != counts[1].fixed)
            fuzz_broken("one thread counts as many buildings as two");
    }
}

/* Every model of a kit is searched for, as far as a few models go. */
static void fuzz_search(const tn_module *module)
{
    for (uint32_t i = 0; i < module->KIT_MODEL_count; i++) {
        tn_place_rules rules;
        tn_placed_model model;
        tn_watch watch;
        if (tn_place_rules_of_model(module, i, &rules, NULL) != TN_OK)
            return;
        tn_watch_begin(&watch, NULL, NULL);
        watch.memory_limit = tn_memory_used() + (64 << 20);
        const tn_kit_model_record *space = rules.space;
        double cells = (double)(space->high_x - space->low_x) * (double)(space->high_y - space->low_y) *
                       (double)(space->high_z - space->low_z);
        if (cells < 1e6) { /* more take long to count */
            tn_place_options options = {.part_limit = 30, .search_limit = 20, .threads = 1, .watch = &watch};
            tn_place_search(&rules, &options, &model, NULL);
            tn_placed_model_clear(&model);
        }
        tn_place_rules_clear(&rules);
    }
}

/* Small limits, and both ways of looking ahead come to the same. */
void fuzz_place(const tn_module *module)
{
    tn_place_rules rules;
    if (make_rules(module, &rules) != TN_OK)
        return;
    fuzz_search(module);
    fuzz_count(module);
    tn_placed_model models[2];
    tn_status found[2];
    for (int way = 0; way < 2; way++) {
        tn_watch watch;
        tn_watch_begin(&watch, NULL, NULL);
        watch.memory_limit = tn_memory_used() + (64 << 20);
        tn_place_options options = {.part_limit = 100,
                                    .step_limit = 1000,
                                    .frame_limit = 50,
                                    .lookahead_limit = 1000,
                                    .watch = &watch,
                                    .interpret = way == 1};
        tn_place_fault fault;
        found[way] = tn_place_derive(&rules, &options, &models[way], &fault, NULL);
    }
    if (found[0] == TN_OK && found[1] == TN_OK && models[0].count != models[1].count)
        fuzz_broken("both ways of looking ahead place as many parts");
    if (found[0] == TN_OK)
        fuzz_measures(module, &rules, &models[0]);
    for (int way = 0; way < 2; way++)
        tn_placed_model_clear(&models[way]);
    tn_place_rules_clear(&rules);
}

static void list(const tn_module *module)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return;
    tn_module_disassemble(module, out);
    for (uint32_t i = 0; i < module->RULE_count && i < 4; i++)
        tn_module_disassemble_rule(module, i, out);
    fclose(out);
    free(text);
}

void fuzz_engines(const tn_module *module)
{
    list(module);
#define ENGINE(NAME, FUZZ) FUZZ(module);
#include "runtime/engines.def"
}

/* Small designs only: the mapping, the boundary and everything that is measured. */
void fuzz_solid(const tn_module *module)
{
    enum { DESIGNS = 4, BOXES = 40 };
    for (uint32_t i = 0; i < module->SOLID_count && i < DESIGNS; i++) {
        tn_built built;
        tn_error error;
        double values[TN_SOLID_MEASURED_COUNT] = {0};
        if (module->SOLID_records[i].box_count > BOXES)
            continue;
        if (tn_built_make(module, i, 0, &built, &error) == TN_OK)
            tn_built_measure(&built, UINT64_MAX, values, &error);
        tn_built_clear(&built);
    }
}
