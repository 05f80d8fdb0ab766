/* Sums of several terms, read from left to right. */
#include "runtime/plan/match/summing.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/explore.h"
#include "runtime/base/array.h"
#include "runtime/module/code.h"
#include "runtime/plan/match/vm.h"

/* ---- BELOW, ZERO, ABOVE: sums compared with 0 */

typedef struct tn_comparing {
    tn_summing summing;
    tn_opcode opcode;
    int64_t low, high; /* past these the outcome is certain */
    int64_t modulus;   /* of multiples, in steps; else 0 */
    uint64_t effort;
} tn_comparing;

/* A key is {sum so far, in two words}, then the machine's; the empty key is where a third marker leads. */
enum { LOW, HIGH, MACHINE };

static int64_t total_of(const uint32_t *key)
{
    return (int64_t)((uint64_t)key[HIGH] << 32 | key[LOW]);
}

/* The total in the form in which states keep it. */
static int64_t kept(const tn_comparing *comparing, int64_t total)
{
    if (comparing->modulus > 0) {
        total %= comparing->modulus;
        return total < 0 ? total + comparing->modulus : total;
    }
    return total > comparing->high ? comparing->high + 1 : total < comparing->low ? comparing->low - 1 : total;
}

static bool comparing_step(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    tn_comparing *comparing = context;
    bool marker = column == comparing->summing.marker;
    if (size == 0 || (marker && key[MACHINE] == 2))
        return true;
    int64_t total = total_of(key), gain;
    if (!tn_key_push(next, 0) || !tn_key_push(next, 0) ||
        !tn_summing_step(&comparing->summing, key + MACHINE, size - MACHINE, column, next, &gain))
        return false;
    if (total >= comparing->low && total <= comparing->high)
        total = kept(comparing, total + gain);
    if (comparing->modulus == 0 && next->data[MACHINE] == 2 && !comparing->summing.behind &&
        !tn_summing_waits(&comparing->summing, next->size - MACHINE)) /* only the outcome is left */
        total = (total > 0) - (total < 0);
    next->data[LOW] = (uint32_t)(uint64_t)total;
    next->data[HIGH] = (uint32_t)((uint64_t)total >> 32);
    comparing->effort = comparing->summing.effort;
    return true;
}

static bool comparing_accepts(void *context, const uint32_t *key, size_t size)
{
    const tn_comparing *comparing = context;
    if (size == 0 || key[MACHINE] != 2)
        return false;
    int64_t total = total_of(key);
    if (tn_summing_waits(&comparing->summing, size - MACHINE) && total >= comparing->low && total <= comparing->high)
        total += tn_summing_rest(&comparing->summing, key + MACHINE, size - MACHINE);
    if (comparing->modulus > 0)
        return total % comparing->modulus == 0;
    return comparing->opcode == TN_OP_BELOW ? total < 0 : comparing->opcode == TN_OP_ZERO ? total == 0 : total > 0;
}

static tn_status find_bounds(tn_comparing *comparing, uint32_t max_trays, tn_error *error)
{
    const tn_summing *summing = &comparing->summing;
    const int64_t most = INT64_MAX / 4;
    comparing->low = -most;
    comparing->high = most;
    if (comparing->modulus > 0)
        return TN_OK;
    if (max_trays == 0 && summing->most_up > 0 && summing->most_down > 0) {
        tn_fail(
            error, TN_LIMIT, E_TOO_MANY_STATES,
            "a sum that rises and falls has as many states as plans have trays, and it is not known how many that is");
        tn_error_help(error,
                      "prune or require the rule in a library: there it is looked at within the library's lengths");
        return TN_LIMIT;
    }
    comparing->high = summing->most_down == 0 ? 0 : max_trays == 0 ? most : summing->most_down * (int64_t)max_trays;
    comparing->low = summing->most_up == 0 ? 0 : max_trays == 0 ? -most : -summing->most_up * (int64_t)max_trays;
    return TN_OK;
}

/* Before everything the sum is its constant. */
static bool push_start(const tn_comparing *comparing, int64_t constant, tn_key *start)
{
    uint64_t total = (uint64_t)kept(comparing, constant);
    return tn_key_push(start, (uint32_t)total) && tn_key_push(start, (uint32_t)(total >> 32)) &&
           tn_summing_start(&comparing->summing, start);
}

tn_status tn_relate_sum(const tn_marked *marked, const tn_classes *classes, const tn_sum *sum, tn_dfa *const *parts,
                        bool reversed, const tn_instruction *compare, uint32_t max_trays, tn_dfa **out, tn_error *error)
{
    tn_comparing comparing = {.opcode = compare->opcode};
    if (compare->opcode == TN_OP_MULTIPLE)
        comparing.modulus = tn_sum_modulus(sum, compare->second);
    tn_key start = {0};
    tn_status status = tn_summing_make(&comparing.summing, sum, marked, classes, parts, reversed, error);
    if (status == TN_OK)
        status = find_bounds(&comparing, max_trays, error);
    if (status == TN_OK && !push_start(&comparing, sum->constant, &start))
        status = tn_fail_memory(error);
    if (status == TN_OK) {
        tn_construction construction = {"comparison", &comparing.summing.join, &comparing, comparing_step,
                                        comparing_accepts};
        status = tn_explore(&construction, &start, &comparing.effort, marked->bounds, out, error);
    }
    free(start.data);
    tn_summing_clear(&comparing.summing);
    return status;
}

/* A key is {phase, if the sum asks for it which trays were there (two words), thread and running set of each term, then
 * term, set and steps (two words) of each kind of place}. */
enum { PHASE, PRESENT_LOW, PRESENT_HIGH };
enum { THREAD, RUNNING, TERM_WORDS };
enum { PLACE_TERM, PLACE_SET, PLACE_LOW, PLACE_HIGH, PLACE_WORDS };

enum { UNKNOWN, LOCAL, NOT_LOCAL };

/* Does a sum count what only the trays around decide? */
static bool sum_looks_around(const tn_module *module, uint32_t index, uint8_t *known)
{
    const tn_sum_record *sum = &module->SUM_records[index];
    for (uint32_t i = 0; i < sum->term_count; i++) {
        const tn_term_record *term = &module->TERM_records[sum->term_first + i];
        if (tn_term_region(term->kind) != TN_REGION_STRETCH || !tn_summing_is_local(module, term->part, known))
            return true;
    }
    return false;
}

static bool looks_around(const tn_module *module, const tn_instruction *code, uint8_t *known)
{
    if (tn_code_compares(code->opcode))
        return sum_looks_around(module, (uint32_t)code->first, known);
    switch (code->opcode) {
    case TN_OP_BEGINNING:
    case TN_OP_END:
    case TN_OP_DISTANCE:
    case TN_OP_NEAR:
    case TN_OP_FAR:
    case TN_OP_IMAGE:
    case TN_OP_AGAIN: /* it does not, if its circle does not; that is not looked at */
        return true;
    case TN_OP_CALL:
    case TN_OP_MIRROR:
        return !tn_summing_is_local(module, (uint32_t)code->first, known);
    default:
        return false;
    }
}

/* Functions call lower ones only; a chain of calls is as deep as rules name each other. */
bool tn_summing_is_local(const tn_module *module, uint32_t function, uint8_t *known)
{
    if (known[function] != UNKNOWN)
        return known[function] == LOCAL;
    const tn_function_record *record = &module->FUNCTION_records[function];
    bool local = true;
    for (uint32_t offset = record->code_begin; local && offset < record->code_end;) {
        tn_instruction code = tn_code_read(module->code, offset);
        local = !looks_around(module, &code, known);
        offset += code.length;
    }
    known[function] = local ? LOCAL : NOT_LOCAL;
    return local;
}

/* ---- making */

/* In which phase a term's places are read. A reversed plan is read from its other end. */
static uint32_t phase_of(const tn_sum_term *term, bool reversed)
{
    if (term->region == TN_REGION_STRETCH)
        return 1;
    return (term->region == TN_REGION_BEFORE) != reversed ? 0 : 2;
}

/* What the trays of the classes decide alone. */
typedef struct tn_alone {
    int64_t *steps;    /* [3][classes] */
    uint64_t *present; /* [classes] */
} tn_alone;

static void add_alone(const tn_sum *sum, uint32_t i, const tn_classes *classes, uint32_t c, bool reversed,
                      uint64_t present, tn_alone *alone)
{
    const tn_sum_term *term = &sum->terms[i];
    if (term->kind == TN_SUM_PRESENT)
        alone->present[c] |= present;
    else
        alone->steps[(size_t)phase_of(term, reversed) * classes->count + c] +=
            tn_term_steps(term, classes->representative[c]);
}

/* What each class's tray adds by the terms that it decides alone. */
static tn_status find_alone(const tn_sum *sum, const tn_classes *classes, tn_dfa *const *parts, bool reversed,
                            tn_alone *alone, tn_error *error)
{
    tn_plan_vm *vm = NULL;
    tn_status status = tn_plan_vm_new(sum->schema, 1, &vm, error);
    for (uint32_t c = 0; status == TN_OK && c < classes->count; c++) {
        tn_tray tray = classes->representative[c];
        uint64_t present = 1;
        status = tn_plan_vm_plan(vm, &tray, 1, error);
        for (uint32_t i = 0; status == TN_OK && i < sum->count; i++) {
            bool in = false;
            if (parts[i] || tn_term_of_whole(sum->terms[i].kind))
                continue;
            status = tn_plan_vm_relation(vm, sum->terms[i].part, 0, 1, &in, error);
            if (status == TN_OK && in)
                add_alone(sum, i, classes, c, reversed, present, alone);
            if (sum->terms[i].kind == TN_SUM_PRESENT)
                present <<= 1;
        }
    }
    tn_plan_vm_free(vm);
    return status;
}

/* Numbers what tells the classes apart: *extra[class]. */
static bool number_weights(const tn_sum *sum, const tn_classes *classes, tn_dfa *const *parts, const tn_alone *alone,
                           uint32_t *extra)
{
    tn_numbering values = {0}, pairs = {0};
    bool ok = true;
    for (uint32_t c = 0; ok && c < classes->count; c++) {
        uint32_t id = tn_number(&values, alone->present[c]);
        for (uint32_t i = 0; i < 3 + sum->count && id != UINT32_MAX; i++) {
            if (i >= 3 && !parts[i - 3])
                continue;
            int64_t steps = i < 3 ? alone->steps[(size_t)i * classes->count + c]
                                  : tn_term_steps(&sum->terms[i - 3], classes->representative[c]);
            uint32_t weight = tn_number(&values, (uint64_t)steps);
            id = weight == UINT32_MAX ? weight : tn_number(&pairs, (uint64_t)id << 32 | weight);
        }
        extra[c] = id;
        ok = id != UINT32_MAX;
    }
    tn_numbering_clear(&values);
    tn_numbering_clear(&pairs);
    return ok;
}

static void note_range(int64_t weight, int64_t *up, int64_t *down)
{
    if (weight > *up)
        *up = weight;
    if (-weight > *down)
        *down = -weight;
}

static void find_range(tn_summing *summing)
{
    int64_t up = 0, down = 0;
    for (uint32_t phase = 0; phase < 3; phase++)
        for (uint32_t c = 0; c < summing->join.columns; c++)
            if (c != summing->marker)
                note_range(summing->local[(size_t)phase * summing->join.columns + c], &up, &down);
    summing->most_up = up;
    summing->most_down = down;
    for (uint32_t t = 0; t < summing->count; t++) {
        up = down = 0;
        for (uint32_t c = 0; c < summing->join.columns; c++)
            if (c != summing->marker)
                note_range(summing->terms[t].weight[c], &up, &down);
        summing->most_up += up;
        summing->most_down += down;
    }
    for (uint32_t p = 0; p < summing->present_count; p++) {
        up = down = 0;
        note_range(summing->present_steps[p], &up, &down);
        summing->most_up += up;
        summing->most_down += down;
    }
}

static tn_status add_terms(tn_summing *summing, const tn_sum *sum, const tn_classes *classes, tn_dfa *const *parts,
                           bool reversed, tn_error *error)
{
    for (uint32_t i = 0; i < sum->count; i++) {
        if (!parts[i])
            continue;
        tn_summing_term *term = &summing->terms[summing->count];
        term->phase = phase_of(&sum->terms[i], reversed);
        tn_tally tally = sum->terms[i].kind == TN_SUM_SINGLES ? TN_TALLY_SINGLES
                         : reversed                           ? TN_TALLY_ENDS
                                                              : TN_TALLY_STARTS;
        tn_status status = tn_guesses_make(&term->guesses, parts[i], tally, &summing->join, summing->count++, error);
        term->weight = calloc((size_t)summing->join.columns + 1, sizeof *term->weight);
        if (status == TN_OK && !term->weight)
            status = tn_fail_memory(error);
        if (status != TN_OK)
            return status;
        for (uint32_t c = 0; c < summing->join.columns; c++)
            if (c != summing->marker)
                term->weight[c] = tn_term_steps(&sum->terms[i], classes->representative[summing->join.letter[c]]);
    }
    return TN_OK;
}

static tn_status join(tn_summing *summing, const tn_sum *sum, const tn_marked *marked, const tn_classes *classes,
                      tn_dfa *const *parts, const tn_alone *alone, tn_error *error)
{
    uint32_t count = 0;
    uint32_t *extra = calloc(marked->letters, sizeof *extra);
    const tn_dfa **dfas = calloc((size_t)sum->count + 1, sizeof *dfas);
    bool ok = extra && dfas && number_weights(sum, classes, parts, alone, extra);
    for (uint32_t i = 0; ok && i < sum->count; i++)
        if (parts[i])
            dfas[count++] = parts[i];
    tn_status status =
        ok ? tn_join_make(&summing->join, dfas, count, marked->letters, extra, true, error) : tn_fail_memory(error);
    size_t columns = summing->join.columns;
    if (status == TN_OK) {
        summing->marker = summing->join.column[marked->letters - 1];
        summing->local = calloc(3 * columns + 1, sizeof *summing->local);
        summing->present = calloc(columns + 1, sizeof *summing->present);
        summing->terms = calloc((size_t)count + 1, sizeof *summing->terms);
        status = summing->local && summing->present && summing->terms ? TN_OK : tn_fail_memory(error);
    }
    for (uint32_t c = 0; status == TN_OK && c < columns; c++) {
        uint32_t letter = summing->join.letter[c];
        if (c == summing->marker)
            continue;
        summing->present[c] = alone->present[letter];
        for (size_t phase = 0; phase < 3; phase++)
            summing->local[phase * columns + c] = alone->steps[phase * classes->count + letter];
    }
    free(extra);
    free(dfas);
    return status;
}

static tn_status find_present(tn_summing *summing, const tn_sum *sum, bool reversed, tn_error *error)
{
    summing->present_steps = calloc(TN_PRESENT_MAX, sizeof *summing->present_steps);
    if (!summing->present_steps)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < sum->count; i++) {
        summing->behind |= phase_of(&sum->terms[i], reversed) == 2;
        if (sum->terms[i].kind != TN_SUM_PRESENT)
            continue;
        if (summing->present_count == TN_PRESENT_MAX) {
            tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES, "a sum counts more than %u values that are there or not",
                    TN_PRESENT_MAX);
            tn_error_help(error, "count the values of fewer fields, or of a field with fewer values");
            return TN_LIMIT;
        }
        summing->present_steps[summing->present_count++] = sum->terms[i].each;
    }
    return TN_OK;
}

tn_status tn_summing_make(tn_summing *summing, const tn_sum *sum, const tn_marked *marked, const tn_classes *classes,
                          tn_dfa *const *parts, bool reversed, tn_error *error)
{
    *summing = (tn_summing){0};
    tn_alone alone = {calloc(3 * (size_t)classes->count + 1, sizeof *alone.steps),
                      calloc((size_t)classes->count + 1, sizeof *alone.present)};
    tn_status status =
        alone.steps && alone.present ? find_present(summing, sum, reversed, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = find_alone(sum, classes, parts, reversed, &alone, error);
    if (status == TN_OK)
        status = join(summing, sum, marked, classes, parts, &alone, error);
    if (status == TN_OK)
        status = add_terms(summing, sum, classes, parts, reversed, error);
    if (status == TN_OK)
        find_range(summing);
    free(alone.steps);
    free(alone.present);
    return status;
}

void tn_summing_clear(tn_summing *summing)
{
    for (uint32_t t = 0; t < summing->count; t++) {
        tn_guesses_clear(&summing->terms[t].guesses);
        free(summing->terms[t].weight);
    }
    tn_join_clear(&summing->join);
    free(summing->terms);
    free(summing->local);
    free(summing->present);
    free(summing->present_steps);
    free(summing->pending);
    *summing = (tn_summing){0};
}

/* ---- places that wait */

static void add_pending(tn_summing *summing, uint32_t term, uint32_t set, int64_t steps, int64_t *gain)
{
    if (set == TN_NO_GUESSES || steps == 0)
        return;
    if (tn_guesses_certain(&summing->terms[term].guesses, set)) {
        *gain += steps;
        return;
    }
    if (!tn_array_reserve_from(&summing->pending, &summing->pending_capacity, 32, summing->pending_size, 1,
                               sizeof *summing->pending)) {
        summing->failed = true;
        return;
    }
    summing->pending[summing->pending_size++] = (tn_summing_pending){term, set, steps};
}

static int compare_pending(const void *left, const void *right)
{
    const tn_summing_pending *a = left, *b = right;
    if (a->term != b->term)
        return a->term < b->term ? -1 : 1;
    return (a->set > b->set) - (a->set < b->set);
}

static bool write_pending(tn_summing *summing, tn_key *next)
{
    tn_summing_pending *pending = summing->pending;
    if (summing->pending_size > 1)
        qsort(pending, summing->pending_size, sizeof *pending, compare_pending);
    for (size_t i = 0, j; i < summing->pending_size; i = j) {
        int64_t steps = 0;
        for (j = i; j < summing->pending_size && compare_pending(&pending[i], &pending[j]) == 0; j++)
            steps += pending[j].steps;
        if (steps == 0)
            continue;
        if (!tn_key_push(next, pending[i].term) || !tn_key_push(next, pending[i].set) ||
            !tn_key_push(next, (uint32_t)(uint64_t)steps) || !tn_key_push(next, (uint32_t)((uint64_t)steps >> 32)))
            return false;
    }
    return true;
}

static int64_t steps_of(const uint32_t *place)
{
    return (int64_t)((uint64_t)place[PLACE_HIGH] << 32 | place[PLACE_LOW]);
}

/* ---- steps */

static size_t terms_at(const tn_summing *summing)
{
    return summing->present_count ? PRESENT_HIGH + 1 : PHASE + 1;
}

static bool push_present(const tn_summing *summing, uint64_t present, tn_key *key)
{
    return summing->present_count == 0 ||
           (tn_key_push(key, (uint32_t)present) && tn_key_push(key, (uint32_t)(present >> 32)));
}

bool tn_summing_start(const tn_summing *summing, tn_key *key)
{
    bool ok = tn_key_push(key, 0) && push_present(summing, 0, key);
    for (uint32_t t = 0; t < summing->count; t++) {
        uint32_t thread = summing->terms[t].guesses.a.dead == 0 ? TN_NO_STATE : 0;
        ok = ok && tn_key_push(key, thread) && tn_key_push(key, TN_NO_GUESSES);
    }
    return ok;
}

static size_t places_at(const tn_summing *summing)
{
    return terms_at(summing) + TERM_WORDS * (size_t)summing->count;
}

bool tn_summing_waits(const tn_summing *summing, size_t size)
{
    return size > places_at(summing);
}

static bool step_marker(tn_summing *summing, const uint32_t *key, size_t size, tn_key *next, int64_t *gain)
{
    uint32_t phase = key[PHASE] + 1;
    bool ok = tn_key_push(next, phase) && push_present(summing, 0, next); /* what was there is counted */
    for (uint32_t t = 0; t < summing->count; t++) {
        bool goes_on = phase <= summing->terms[t].phase;
        uint32_t thread = goes_on ? key[terms_at(summing) + TERM_WORDS * (size_t)t + THREAD] : TN_NO_STATE;
        ok = ok && tn_key_push(next, thread) && tn_key_push(next, TN_NO_GUESSES);
    }
    for (size_t i = places_at(summing); i < size; i += PLACE_WORDS) {
        uint32_t term = key[i + PLACE_TERM];
        add_pending(summing, term, tn_guesses_ended(&summing->terms[term].guesses, key[i + PLACE_SET]),
                    steps_of(key + i), gain);
    }
    return ok;
}

/* One term after a tray of the given column: its thread, and the place that the tray makes. */
static bool step_term(tn_summing *summing, uint32_t t, uint32_t phase, const uint32_t *words, uint32_t column,
                      tn_key *next, int64_t *gain)
{
    tn_guesses *guesses = &summing->terms[t].guesses;
    uint32_t thread = words[THREAD], running = words[RUNNING];
    int64_t weight = summing->terms[t].weight[column];
    bool inside = phase == summing->terms[t].phase;
    if (inside && guesses->tally == TN_TALLY_ENDS) {
        running = tn_guesses_running(guesses, running, thread, column);
        add_pending(summing, t, tn_guesses_end_running(guesses, running), weight, gain);
    } else if (inside) {
        add_pending(summing, t, tn_guesses_new(guesses, thread, column), weight, gain);
    }
    if (thread != TN_NO_STATE)
        thread = tn_guesses_state(guesses, thread, column);
    if (thread == guesses->a.dead)
        thread = TN_NO_STATE;
    return tn_key_push(next, thread) && tn_key_push(next, running);
}

/* The trays that are there after a tray of the given column: a new one is counted once. */
static bool step_present(const tn_summing *summing, const uint32_t *key, uint32_t column, tn_key *next, int64_t *gain)
{
    if (summing->present_count == 0)
        return true;
    uint64_t was = (uint64_t)key[PRESENT_HIGH] << 32 | key[PRESENT_LOW];
    uint64_t now = key[PHASE] == 1 ? was | summing->present[column] : was;
    for (uint64_t more = now & ~was; more; more &= more - 1)
        *gain += summing->present_steps[__builtin_ctzll(more)];
    return push_present(summing, now, next);
}

bool tn_summing_step(tn_summing *summing, const uint32_t *key, size_t size, uint32_t column, tn_key *next,
                     int64_t *gain)
{
    uint32_t phase = key[PHASE];
    summing->pending_size = 0;
    *gain = 0;
    bool ok;
    if (column == summing->marker) {
        ok = step_marker(summing, key, size, next, gain);
    } else {
        *gain = phase < 3 ? summing->local[(size_t)phase * summing->join.columns + column] : 0;
        ok = tn_key_push(next, phase) && step_present(summing, key, column, next, gain);
        for (size_t i = places_at(summing); i < size; i += PLACE_WORDS) {
            tn_summing_term *term = &summing->terms[key[i + PLACE_TERM]];
            add_pending(summing, key[i + PLACE_TERM],
                        tn_guesses_read(&term->guesses, key[i + PLACE_SET], phase == term->phase, column),
                        steps_of(key + i), gain);
        }
        for (uint32_t t = 0; ok && t < summing->count; t++)
            ok = step_term(summing, t, phase, key + terms_at(summing) + TERM_WORDS * (size_t)t, column, next, gain);
    }
    uint64_t effort = 0;
    for (uint32_t t = 0; t < summing->count; t++) {
        summing->failed |= summing->terms[t].guesses.failed;
        effort += summing->terms[t].guesses.effort;
    }
    summing->effort = effort;
    return ok && write_pending(summing, next) && !summing->failed;
}

int64_t tn_summing_rest(const tn_summing *summing, const uint32_t *key, size_t size)
{
    int64_t rest = 0;
    for (size_t i = places_at(summing); i < size; i += PLACE_WORDS)
        if (tn_guesses_accept(&summing->terms[key[i + PLACE_TERM]].guesses, key[i + PLACE_SET]))
            rest += steps_of(key + i);
    return rest;
}
