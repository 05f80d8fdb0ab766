/* Works out what each alternative does and where, and what its lookahead tests. */
#include "runtime/place/acts.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

/* ---- heads that walk alike */

/* Each head begins at the origin with its turn, and with the colour TN_COLOUR_KEPT. */
static void heads_begin(tn_heads *heads)
{
    heads->depth = 0;
    for (uint32_t h = 0; h < TN_UPRIGHT_TURNS; h++)
        heads->frames[0][h] = (tn_frame){.heading = h, .colour = TN_COLOUR_KEPT};
}

/* PUSH, POP, MOVE, TURN or COLOUR; other steps lead nowhere. False: the first frame was dropped, or there is no room
 * for another, or the heads went too far. */
static bool heads_step(tn_heads *heads, const tn_step *step)
{
    tn_frame *frames = heads->frames[heads->depth];
    bool near = true;
    switch (step->kind) {
    case TN_STEP_PUSH:
        if (heads->depth + 1 == TN_HEADS_FRAMES)
            return false;
        memcpy(heads->frames[++heads->depth], frames, sizeof heads->frames[0]);
        return true;
    case TN_STEP_POP:
        return heads->depth-- > 0;
    default:
        for (uint32_t h = 0; h < TN_UPRIGHT_TURNS; h++)
            near &= tn_frame_step(&frames[h], step);
        return near;
    }
}

/* ---- works out what the lookahead of each alternative tests */

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

static void trace_step(tracer *t, const tn_step *step)
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
        t->known &= heads_step(&t->heads, step);
        break;
    }
}

static void take_alternative(tracer *t, const tn_place_alternative *alternative, uint32_t depth)
{
    for (uint32_t i = 0; i < alternative->count && t->known && !t->failed; i++) {
        const tn_step *step = &t->rules->steps[alternative->first + i];
        t->known = ++t->steps <= STEPS_MAX && depth < DEPTH_MAX;
        if (step->kind != TN_STEP_EXPAND) {
            trace_step(t, step);
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

/* Cuts the common box down to what the alternative's first test needs. False if that is nothing in common. */
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
        heads_begin(&t.heads);
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

/* ---- works out what each alternative does and where */

/* PASSES: whether symbols leave the frame as it was is found again as long as it changes, so often at most. REPLACED:
 * steps that may be surveyed again where a symbol is replaced by its acts, in all, and symbols in one another. */
enum { PASSES_MAX = 8, REPLACED_MAX = 4096, REPLACED_DEPTH_MAX = 16 };

typedef struct surveyor {
    const tn_place_rules *rules;
    const tn_traces *traces;
    tn_acts *acts;
    tn_act_list list;          /* of the alternative at hand */
    uint32_t count;            /* acts so far */
    uint32_t replaced, nested; /* steps, and symbols at hand */
    bool fresh;                /* of the next act */
    uint32_t idle;
    bool *strays;               /* [symbol]: it may leave the frame elsewhere */
    bool *expanded;             /* [symbol]: by some act of this pass */
    bool lost[TN_HEADS_FRAMES]; /* [depth]: a symbol that strays was expanded with this frame */
    tn_heads heads;
} surveyor;

static void add_act(surveyor *s, tn_step_kind kind, uint32_t index)
{
    const tn_step *step = &s->rules->steps[index];
    const tn_frame *frames = tn_heads_frames(&s->heads);
    tn_act act = {.kind = kind,
                  .step = index,
                  .symbol = step->index,
                  .depth = s->heads.depth,
                  .fresh = s->fresh,
                  .idle = s->idle,
                  .colour = frames[0].colour};
    for (uint32_t h = 0; h < TN_UPRIGHT_TURNS; h++) {
        const int32_t *at = frames[h].at;
        act.heading[h] = (uint8_t)frames[h].heading;
        act.box[h] = tn_step_has_cells(kind) ? tn_frame_box(&frames[h], step)
                                             : (tn_cell_box){{at[0], at[1], at[2]}, {at[0], at[1], at[2]}};
    }
    s->acts->acts[s->count++] = act;
    s->fresh = false;
    s->idle = 0;
}

/* Notes how far the heads are from the start, and how deep. */
static void measure(surveyor *s)
{
    const tn_frame *frame = tn_heads_frames(&s->heads);
    s->list.depth = s->heads.depth > s->list.depth ? s->heads.depth : s->list.depth;
    for (int k = 0; k < 3; k++)
        s->acts->reach = abs(frame->at[k]) > s->acts->reach ? abs(frame->at[k]) : s->acts->reach;
}

static bool take_steps(surveyor *s, const tn_place_alternative *alternative);

/* The only alternative of a symbol, where expanding it does nothing but take that; otherwise NULL. */
static const tn_place_alternative *only_alternative(const surveyor *s, const tn_place_symbol *symbol)
{
    const tn_place_alternative *only = &s->rules->alternatives[symbol->first];
    return symbol->count == 1 && !symbol->drawn && !s->traces->traces[symbol->first].bounds &&
                   s->nested < REPLACED_DEPTH_MAX && only->count <= REPLACED_MAX - s->replaced
               ? only
               : NULL;
}

static bool expand(surveyor *s, uint32_t index)
{
    uint32_t symbol = s->rules->steps[index].index;
    const tn_place_alternative *only = only_alternative(s, &s->rules->symbols[symbol]);
    if (only) {
        s->replaced += only->count;
        s->list.expansions++;
        s->idle++;
        s->nested++;
        bool known = take_steps(s, only);
        s->nested--;
        return known;
    }
    add_act(s, TN_STEP_EXPAND, index);
    s->expanded[symbol] = true;
    s->lost[s->heads.depth] = s->strays[symbol];
    return true;
}

/* One step of an alternative. False if it needs a frame that is not known. */
static bool take_step(surveyor *s, uint32_t index)
{
    const tn_step *step = &s->rules->steps[index];
    bool lost = s->lost[s->heads.depth];
    if (step->kind == TN_STEP_EXPAND)
        return !lost && expand(s, index);
    s->list.steps++;
    s->fresh = true;
    s->idle = 0;
    switch (step->kind) {
    case TN_STEP_POP:
        return heads_step(&s->heads, step);
    case TN_STEP_PUSH:
    case TN_STEP_MOVE:
    case TN_STEP_TURN:
    case TN_STEP_COLOUR:
        if (lost || !heads_step(&s->heads, step))
            return false;
        s->lost[s->heads.depth] = false;
        return true;
    default:
        if (!lost)
            add_act(s, step->kind, index);
        return !lost;
    }
}

static bool take_steps(surveyor *s, const tn_place_alternative *alternative)
{
    for (uint32_t i = alternative->first; i < alternative->first + alternative->count; i++) {
        if (!take_step(s, i))
            return false;
        measure(s);
    }
    return true;
}

static bool is_at_start(const surveyor *s)
{
    const tn_frame *frame = tn_heads_frames(&s->heads);
    return !s->lost[0] && frame->heading == 0 && frame->colour == TN_COLOUR_KEPT && frame->at[0] == 0 &&
           frame->at[1] == 0 && frame->at[2] == 0;
}

/* Lists the acts of an alternative; *strays is set where it does not come back to its start. False: not to be known. */
static bool survey(surveyor *s, uint32_t index, bool *strays)
{
    const tn_place_alternative *alternative = &s->rules->alternatives[index];
    s->list = (tn_act_list){.first = s->count};
    s->fresh = false;
    s->idle = 0;
    heads_begin(&s->heads);
    s->lost[0] = false;
    if (!take_steps(s, alternative) || s->heads.depth > 0)
        return false;
    if (s->idle > 0) /* expansions that no act behind them counts */
        add_act(s, TN_STEP_PUSH, alternative->first);
    s->list.count = s->count - s->list.first;
    s->acts->lists[index] = s->list;
    *strays |= !is_at_start(s);
    return true;
}

/* Surveys all alternatives; *changed: some symbol was found to stray that had been expanded before. */
static bool survey_all(surveyor *s, bool *changed)
{
    s->count = s->replaced = 0;
    *changed = false;
    memset(s->expanded, 0, s->rules->symbol_count);
    for (uint32_t i = 0; i < s->rules->symbol_count; i++) {
        const tn_place_symbol *symbol = &s->rules->symbols[i];
        bool strays = s->strays[i];
        for (uint32_t k = 0; k < symbol->count; k++)
            if (!survey(s, symbol->first + k, &strays))
                return false;
        *changed |= strays && !s->strays[i] && s->expanded[i];
        s->strays[i] = strays;
    }
    return true;
}

void tn_acts_clear(tn_acts *acts)
{
    free(acts->acts);
    free(acts->lists);
    *acts = (tn_acts){0};
}

tn_status tn_acts_make(const tn_place_rules *rules, const tn_traces *traces, tn_acts *acts, tn_error *error)
{
    surveyor s = {.rules = rules, .traces = traces, .acts = acts};
    *acts = (tn_acts){0};
    size_t room = (size_t)rules->step_count + rules->alternative_count + REPLACED_MAX;
    acts->acts = malloc(room * sizeof *acts->acts);
    acts->lists = calloc((size_t)rules->alternative_count + 1, sizeof *acts->lists);
    s.strays = calloc((size_t)rules->symbol_count + 1, sizeof *s.strays);
    s.expanded = calloc((size_t)rules->symbol_count + 1, sizeof *s.expanded);
    bool made = acts->acts && acts->lists && s.strays && s.expanded, changed = true;
    bool known = made;
    for (int pass = 0; known && changed; pass++)
        known = pass < PASSES_MAX && survey_all(&s, &changed);
    free(s.strays);
    free(s.expanded);
    if (!known)
        tn_acts_clear(acts);
    acts->known = known;
    return made ? TN_OK : tn_fail_memory(error);
}
