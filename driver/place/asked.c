/* Compiles the conditions of a command line, and holds models to them. */
#include "driver/place/asked.h"

#include <stdlib.h>
#include <string.h>

#include "compiler/compile.h"
#include "runtime/module/code.h"
#include "runtime/number/run.h"

tn_status tn_kit_ask(const char *option, const char *text, const char *const *parts, size_t part_count,
                     tn_opened *asked)
{
    static const char *const none[] = {""};
    const tn_questions questions = {.parts = part_count ? parts : none, .part_count = part_count};
    const tn_input input = {.text = text, .size = strlen(text), .name = option};
    const tn_compile_options options = {.questions = &questions};
    return tn_open_text(tn_notation_of("conditions.kit", "", 0), &input, &options, asked);
}

void tn_kit_ask_failed(tn_opened *opened, tn_opened *asked)
{
    const tn_sources *from = &asked->compilation.sources;
    tn_sources *to = &opened->compilation.sources;
    uint32_t first = (uint32_t)to->count, file;
    tn_error error;
    for (size_t i = 0; i < from->count; i++) {
        const tn_source *text = &from->files[i];
        if (tn_sources_add(to, text->path, text->text, text->size, &file, &error) != TN_OK) {
            tn_report_error(&opened->compilation.diagnostics, &error, NULL, NULL, 0);
            return;
        }
    }
    tn_diagnostics_clear(&opened->compilation.diagnostics);
    tn_diagnostics_move(&asked->compilation.diagnostics, &opened->compilation.diagnostics, first);
}

/* The conditions count parts in an order of their own. */
static void count_parts(const tn_module *module, const tn_placed_model *model, tn_placed_measures *measured)
{
    for (uint32_t c = 0; c < module->COUNTED_count && c < TN_KIT_COUNTED_MAX; c++) {
        const char *part = tn_text(module, module->COUNTED_records[c].part);
        measured->terms[TN_PLACED_COUNTED + c] = 0;
        for (size_t i = 0; i < model->count; i++)
            measured->terms[TN_PLACED_COUNTED + c] += strcmp(model->parts[i].name, part) == 0;
    }
}

/* Where condition i was written. */
static tn_span span_of(const tn_module *module, uint32_t i)
{
    const tn_source_map_record *place = tn_module_place(module, module->FUNCTION_records[i].code_begin);
    return place ? (tn_span){place->file, place->begin, place->end} : (tn_span){0};
}

tn_status tn_kit_hold(tn_opened *opened, tn_opened *asked, const tn_placed_model *model,
                      const tn_placed_measures *measured)
{
    tn_placed_measures own = *measured; /* borrows all but the counts */
    const tn_source *text = &asked->compilation.sources.files[0];
    uint32_t file;
    tn_error error;
    tn_status status = tn_sources_add(&opened->compilation.sources, text->path, text->text, text->size, &file, &error);
    if (status != TN_OK) {
        tn_report_error(&opened->compilation.diagnostics, &error, NULL, NULL, 0);
        return status;
    }
    count_parts(asked->module, model, &own);
    for (uint32_t i = 0; i < asked->module->FUNCTION_count; i++) {
        const tn_span span = span_of(asked->module, i);
        const tn_kit_condition_record condition = {
            .holds = i, .file = file, .begin = span.begin, .end = span.end, .violation = TN_NO_RECORD};
        if (tn_kit_condition_holds(asked->module, i, &own))
            continue;
        tn_kit_report_unmet(opened, asked->module, &condition, NULL, &own, false);
        status = TN_INVALID;
    }
    return status;
}

/* ---- fitness */

/* Deriving tells how many parts of which names there are, and nothing else. */
static bool is_told(uint32_t term)
{
    return term == TN_PLACED_ELEMENTS || term >= TN_PLACED_COUNTED;
}

static tn_status check_terms(tn_opened *asked)
{
    const tn_module *module = asked->module;
    const tn_function_record *f = &module->FUNCTION_records[0];
    const tn_span span = span_of(module, 0);
    tn_diagnostics *list = &asked->compilation.diagnostics;
    tn_instruction i;
    for (uint32_t offset = f->code_begin; offset < f->code_end; offset += i.length) {
        i = tn_code_read(module->code, offset);
        if (i.opcode != TN_OP_TERM || is_told((uint32_t)i.first))
            continue;
        tn_diagnostic *d =
            tn_report(list, E_PLACE_VALUE, span, "a connection grammar does not tell `%s` while it grows",
                      tn_placed_terms[i.first]);
        tn_help(list, d, "a fitness is made of `elements` and `count(PART)`");
        return TN_INVALID;
    }
    if (module->FUNCTION_count == 1)
        return TN_OK;
    tn_help(
        list,
        tn_report(list, E_PLACE_VALUE, span, "a fitness is one expression, not %u", (unsigned)module->FUNCTION_count),
        "join comparisons by `and`");
    return TN_INVALID;
}

tn_status tn_place_fitness_make(const tn_place_rules *rules, const char *text, tn_place_fitness *fitness)
{
    size_t count = 0;
    const char **parts = calloc((size_t)rules->step_count + 1, sizeof *parts);
    *fitness = (tn_place_fitness){.seen = 0};
    for (uint32_t i = 0; parts && i < rules->step_count; i++)
        if (rules->steps[i].kind == TN_STEP_PART)
            parts[count++] = rules->steps[i].text;
    tn_status status = parts ? tn_kit_ask("--fitness", text, parts, count, &fitness->asked) : TN_MEMORY;
    free(parts);
    return status == TN_OK ? check_terms(&fitness->asked) : status;
}

void tn_place_fitness_clear(tn_place_fitness *fitness)
{
    tn_close(&fitness->asked);
}

static void tally(const tn_module *module, const char *part, double by, double terms[TN_PLACED_TERM_COUNT])
{
    terms[TN_PLACED_ELEMENTS] += by;
    for (uint32_t c = 0; c < module->COUNTED_count && c < TN_KIT_COUNTED_MAX; c++)
        if (strcmp(tn_text(module, module->COUNTED_records[c].part), part) == 0)
            terms[TN_PLACED_COUNTED + c] += by;
}

double tn_place_fitness_value(tn_place_fitness *fitness, const tn_placed_model *model, const char *const *ahead,
                              size_t ahead_count)
{
    const tn_module *module = fitness->asked.module;
    for (; fitness->seen < model->count; fitness->seen++)
        tally(module, model->parts[fitness->seen].name, 1, fitness->terms);
    for (size_t i = 0; i < ahead_count; i++)
        tally(module, ahead[i], 1, fitness->terms);
    double value = tn_number_run(module->code, module->FUNCTION_records[0].code_begin, fitness->terms);
    for (size_t i = 0; i < ahead_count; i++)
        tally(module, ahead[i], -1, fitness->terms);
    return value;
}
