/* Works out what each alternative does and where. */
#include "runtime/place/acts.h"

#include <stdlib.h>
#include <string.h>

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

/* One step of an alternative. False where it needs a frame that is not known. */
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
        return tn_heads_step(&s->heads, step);
    case TN_STEP_PUSH:
    case TN_STEP_MOVE:
    case TN_STEP_TURN:
    case TN_STEP_COLOUR:
        if (lost || !tn_heads_step(&s->heads, step))
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
    tn_heads_begin(&s->heads);
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
