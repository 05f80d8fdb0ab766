/* Scores what stands in a world by the conditions and the objective of its model. */
#include "runtime/place/search/score.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/module/code.h"
#include "runtime/number/run.h"

/* ---- which terms a function reads */

/* The numbers of parts of each kind tell these. */
static bool is_plain(int64_t term)
{
    return term == TN_PLACED_ELEMENTS || term == TN_PLACED_CELLS || term == TN_PLACED_FILL || term == TN_PLACED_MASS ||
           term == TN_PLACED_PRICE || term >= TN_PLACED_COUNTED;
}

static bool reads_plain_terms(const tn_module *module, uint32_t function)
{
    const tn_function_record *f = &module->FUNCTION_records[function];
    tn_instruction i;
    for (uint32_t offset = f->code_begin; offset < f->code_end; offset += i.length) {
        i = tn_code_read(module->code, offset);
        if (i.opcode == TN_OP_TERM && !is_plain(i.first))
            return false;
    }
    return true;
}

/* One such term and nothing else: more parts never make it smaller. */
static bool rises(const tn_module *module, const tn_kit_model_record *model)
{
    if (model->objective == TN_NO_RECORD || model->flags & TN_KIT_MAXIMIZE ||
        !reads_plain_terms(module, model->objective))
        return false;
    const tn_function_record *f = &module->FUNCTION_records[model->objective];
    tn_instruction i = tn_code_read(module->code, f->code_begin);
    uint32_t next = f->code_begin + i.length;
    return i.opcode == TN_OP_TERM && next + tn_code_read(module->code, next).length >= f->code_end;
}

tn_status tn_scorer_make(const tn_site_choices *choices, uint64_t inside, tn_watch *watch, tn_scorer *scorer,
                         tn_error *error)
{
    const tn_module *module = choices->rules->module;
    *scorer = (tn_scorer){.choices = choices,
                          .inside = inside,
                          .rises = rises(module, choices->rules->space),
                          .watch = watch,
                          .cells = calloc((size_t)choices->kind_count + 1, sizeof *scorer->cells)};
    if (!scorer->cells)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < choices->kind_count; i++) {
        for (uint32_t b = 0; b < choices->kinds[i].record->box_count; b++) {
            const tn_cell_box *box = &choices->kinds[i].boxes[0][b];
            scorer->cells[i] += (uint64_t)(box->high[0] - box->low[0]) * (uint64_t)(box->high[1] - box->low[1]) *
                                (uint64_t)(box->high[2] - box->low[2]);
        }
    }
    return TN_OK;
}

void tn_scorer_clear(tn_scorer *scorer)
{
    free(scorer->cells);
    tn_placed_model_clear(&scorer->model);
    *scorer = (tn_scorer){0};
}

/* ---- scoring */

static void set_plain_terms(tn_scorer *s, const tn_world *world)
{
    uint64_t elements = 0, cells = 0;
    for (uint32_t i = 0; i < s->choices->kind_count; i++) {
        elements += world->used[i];
        cells += world->used[i] * s->cells[i];
    }
    s->terms[TN_PLACED_ELEMENTS] = (double)elements;
    s->terms[TN_PLACED_CELLS] = (double)cells;
    s->terms[TN_PLACED_FILL] = s->inside ? (double)cells / (double)s->inside : 0;
    tn_placed_sums(s->choices->rules->module, world->used, s->terms);
}

/* A sum over the requirements that can be told; *all: these were all. */
static double sum_violations(const tn_module *module, const tn_kit_model_record *model, const double *terms,
                             bool plain_only, bool *all)
{
    double sum = 0;
    *all = true;
    for (uint32_t i = 0; i < model->condition_count; i++) {
        const tn_kit_condition_record *condition = &module->KIT_CONDITION_records[model->condition_first + i];
        if (condition->flags & TN_CONDITION_TEST || condition->violation == TN_NO_RECORD)
            continue;
        if (plain_only && !reads_plain_terms(module, condition->violation))
            *all = false;
        else
            sum += tn_number_run(module->code, module->FUNCTION_records[condition->violation].code_begin, terms);
    }
    return isnan(sum) ? INFINITY : sum;
}

static double value_of(const tn_module *module, const tn_kit_model_record *model, const double *terms)
{
    if (model->objective == TN_NO_RECORD)
        return 0;
    double value = tn_number_run(module->code, module->FUNCTION_records[model->objective].code_begin, terms);
    return isnan(value) ? INFINITY : model->flags & TN_KIT_MAXIMIZE ? -value : value;
}

static bool tells_value(const tn_module *module, const tn_kit_model_record *model)
{
    return model->objective == TN_NO_RECORD || reads_plain_terms(module, model->objective);
}

tn_model_score tn_score_terms(const tn_module *module, const tn_kit_model_record *model, const double *terms)
{
    bool all;
    double violation = sum_violations(module, model, terms, false, &all);
    return (tn_model_score){violation, value_of(module, model, terms)};
}

tn_status tn_score_world(tn_scorer *s, const tn_world *world, const tn_model_score *bar, tn_model_score *score,
                         tn_error *error)
{
    const tn_module *module = s->choices->rules->module;
    const tn_kit_model_record *model = s->choices->rules->space;
    tn_placed_measures measures;
    bool all, valued = tells_value(module, model);
    set_plain_terms(s, world);
    score->violation = sum_violations(module, model, s->terms, true, &all);
    score->value = valued ? value_of(module, model, s->terms) : -INFINITY;
    if (all && valued)
        return TN_OK;
    if (bar && tn_score_compare(score, bar) > 0) {
        score->violation = INFINITY;
        return TN_OK;
    }
    tn_status status = tn_standing_model(s->choices, &world->plan, &s->model, error);
    if (status != TN_OK)
        return status;
    status = tn_placed_measure_inside(module, s->inside, &s->model, s->watch, &measures, error);
    if (status == TN_OK)
        *score = tn_score_terms(module, model, measures.terms);
    tn_placed_measures_clear(&measures);
    return status;
}

double tn_score_value(tn_scorer *s, const tn_world *world)
{
    set_plain_terms(s, world);
    return value_of(s->choices->rules->module, s->choices->rules->space, s->terms);
}

int tn_score_compare(const tn_model_score *a, const tn_model_score *b)
{
    if (a->violation != b->violation)
        return a->violation < b->violation ? -1 : 1;
    return (a->value > b->value) - (a->value < b->value);
}
