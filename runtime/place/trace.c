/* Works out what the lookahead of each alternative tests. */
#include "runtime/place/trace.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/place/heads.h"

enum { STEPS_MAX = 4096, DEPTH_MAX = 64 }; /* of a lookahead that is worked out beforehand */

typedef struct tracer {
    const tn_place_rules *rules;
    tn_traces *traces;
    tn_heads heads;
    uint32_t steps;
    bool known, failed;
} tracer;

void tn_traces_clear(tn_traces *traces)
{
    free(traces->traces);
    free(traces->tests);
    free(traces->common);
    *traces = (tn_traces){0};
}

static void add_test(tracer *t, const tn_step *step)
{
    tn_traces *all = t->traces;
    if (!tn_array_reserve(&all->tests, &all->test_capacity, all->test_count, 1, sizeof *all->tests)) {
        t->failed = true;
        return;
    }
    tn_trace_test *test = &all->tests[all->test_count++];
    test->filled = step->kind == TN_STEP_TOUCH;
    for (int h = 0; h < TN_UPRIGHT_TURNS; h++)
        test->box[h] = tn_frame_box(&tn_heads_frames(&t->heads)[h], step);
}

static void take_step(tracer *t, const tn_step *step)
{
    switch (step->kind) {
    case TN_STEP_BOUND_BOX:
    case TN_STEP_BOUND_BALL:
        t->known = false;
        break;
    case TN_STEP_FILL:
    case TN_STEP_BLOCK:
    case TN_STEP_TOUCH:
        add_test(t, step);
        break;
    case TN_STEP_PART:
    case TN_STEP_FILL_OVER:
        break;
    default:
        t->known &= tn_heads_step(&t->heads, step);
        break;
    }
}

static void take_alternative(tracer *t, const tn_place_alternative *alternative, uint32_t depth)
{
    for (uint32_t i = 0; i < alternative->count && t->known && !t->failed; i++) {
        const tn_step *step = &t->rules->steps[alternative->first + i];
        t->known = ++t->steps <= STEPS_MAX && depth < DEPTH_MAX;
        if (step->kind != TN_STEP_EXPAND) {
            take_step(t, step);
        } else if (t->known) {
            const tn_place_symbol *symbol = &t->rules->symbols[step->index];
            take_alternative(t, &t->rules->alternatives[symbol->first + symbol->count - 1], depth + 1);
        }
    }
}

/* Marks what a lookahead of the alternative can reach that sets bounds: found again and again until nothing changes. */
static void find_bounds(const tn_place_rules *rules, tn_traces *traces)
{
    bool changed = true;
    while (changed) {
        changed = false;
        for (uint32_t a = 0; a < rules->alternative_count; a++) {
            const tn_place_alternative *alternative = &rules->alternatives[a];
            bool bounds = false;
            for (uint32_t i = 0; i < alternative->count; i++) {
                const tn_step *step = &rules->steps[alternative->first + i];
                bounds |= step->kind == TN_STEP_BOUND_BOX || step->kind == TN_STEP_BOUND_BALL;
                if (step->kind == TN_STEP_EXPAND) {
                    const tn_place_symbol *symbol = &rules->symbols[step->index];
                    bounds |= traces->traces[symbol->first + symbol->count - 1].bounds;
                }
            }
            changed |= bounds && !traces->traces[a].bounds;
            traces->traces[a].bounds |= bounds;
        }
    }
}

/* Cuts the common box down to what the alternative's first test needs. False where that is nothing in common. */
static bool cut_common(const tn_traces *traces, uint32_t alternative, tn_common *common)
{
    const tn_trace *trace = &traces->traces[alternative];
    if (!trace->known || trace->count == 0 || traces->tests[trace->first].filled)
        return false;
    for (int h = 0; h < 4; h++) {
        const tn_cell_box *box = &traces->tests[trace->first].box[h];
        for (int k = 0; k < 3; k++) {
            if (box->low[k] > common->box[h].low[k])
                common->box[h].low[k] = box->low[k];
            if (box->high[k] < common->box[h].high[k])
                common->box[h].high[k] = box->high[k];
            if (common->box[h].low[k] >= common->box[h].high[k])
                return false;
        }
    }
    return true;
}

/* The published programs' grammars and kits have such a box nearly everywhere: the cells in front of a connector. */
static void find_common(const tn_place_rules *rules, tn_traces *traces)
{
    for (uint32_t s = 0; s < rules->symbol_count; s++) {
        const tn_place_symbol *symbol = &rules->symbols[s];
        tn_common *common = &traces->common[s];
        const tn_trace *last = &traces->traces[symbol->first + symbol->count - 1];
        common->known = symbol->count > 1 && !symbol->drawn && last->known && last->count == 0;
        for (int h = 0; h < 4; h++)
            for (int k = 0; k < 3; k++)
                common->box[h].low[k] = -INT32_MAX, common->box[h].high[k] = INT32_MAX;
        for (uint32_t i = 0; i + 1 < symbol->count && common->known; i++)
            common->known = cut_common(traces, symbol->first + i, common);
        common->traced = !symbol->drawn;
        for (uint32_t i = symbol->first; i < symbol->first + symbol->count; i++)
            common->traced &= traces->traces[i].known && rules->alternatives[i].member == 0;
    }
}

tn_status tn_traces_make(const tn_place_rules *rules, tn_traces *traces, tn_error *error)
{
    *traces = (tn_traces){0};
    traces->traces = calloc((size_t)rules->alternative_count + 1, sizeof *traces->traces);
    traces->common = calloc((size_t)rules->symbol_count + 1, sizeof *traces->common);
    if (!traces->traces || !traces->common) {
        tn_traces_clear(traces);
        return tn_fail_memory(error);
    }
    find_bounds(rules, traces);
    tracer t = {.rules = rules, .traces = traces};
    for (uint32_t a = 0; a < rules->alternative_count; a++) {
        t.known = true;
        t.steps = 0;
        tn_heads_begin(&t.heads);
        size_t first = traces->test_count;
        take_alternative(&t, &rules->alternatives[a], 0);
        if (t.failed) {
            tn_traces_clear(traces);
            return tn_fail_memory(error);
        }
        if (!t.known)
            traces->test_count = first;
        traces->traces[a].known = t.known;
        traces->traces[a].first = (uint32_t)first;
        traces->traces[a].count = (uint32_t)(traces->test_count - first);
    }
    find_common(rules, traces);
    return TN_OK;
}
