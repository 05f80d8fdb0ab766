/* Open plans: forward and backward counts over the library's automaton joined with a machine that places the written
 * trays (complete_machine.c). */
#include "runtime/plan/measure/complete_data.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

#define WORST INT64_MAX

typedef tn_completer completer;

/* ---- levels */

static uint32_t intern(completer *c, uint32_t state, tn_machine m)
{
    uint32_t key[] = {state, m.placed, m.gap, (uint32_t)m.earlier, (uint32_t)(m.earlier >> 32)};
    return tn_intern(&c->states, key, sizeof key / sizeof *key);
}

static tn_machine machine_of(const completer *c, uint32_t joint, uint32_t *state)
{
    size_t size;
    const uint32_t *key = tn_interned(&c->states, joint, &size);
    *state = key[0];
    return (tn_machine){key[1], key[2], (uint64_t)key[4] << 32 | key[3]};
}

static bool is_alive(const completer *c, uint32_t left, uint32_t state)
{
    return c->weighed ? tn_weighed_alive(c->weighed, left, state) : tn_library_alive(c->library, left, state);
}

static bool leads_on(const completer *c, uint32_t n, uint32_t state)
{
    uint32_t low = n < c->library->min ? c->library->min - n : 0;
    for (uint32_t left = low; left <= c->library->max - n; left++)
        if (is_alive(c, left, state))
            return true;
    return false;
}

static bool accepts(const completer *c, uint32_t n, uint32_t joint)
{
    uint32_t state;
    tn_machine m = machine_of(c, joint, &state);
    return n >= c->library->min && m.placed == c->items && is_alive(c, 0, state);
}

static int compare_numbers(const void *left, const void *right)
{
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

/* One step: a tray of the letter, from a state of level n to a joint state, and what the measure gains. */
typedef struct step {
    uint32_t n, from, to, letter;
    tn_machine m; /* before it */
    bool places;
    int64_t gain; /* with the sign that makes less better */
} step;

typedef bool take_step(completer *c, const step *s, void *context);

/* Where a letter leads; false where nothing that is kept follows, or it failed. */
static bool follow(completer *c, uint32_t n, uint32_t state, uint32_t letter, uint32_t *to, int64_t *gain)
{
    int64_t gains[TN_WEIGHED_MAX] = {0};
    *gain = 0;
    if (!c->weighed) {
        *to = tn_library_step(c->library, state, c->first[letter]);
        return leads_on(c, n + 1, *to);
    }
    c->failed =
        tn_weighed_step(c->weighed, state, tn_weighed_letter(c->weighed, c->first[letter]), to, gains, c->error);
    *gain = c->sign * gains[0];
    return c->failed == TN_OK && *to != UINT32_MAX && leads_on(c, n + 1, *to);
}

/* Calls `take` for every step from level n; false where that fails. */
static bool each_step(completer *c, uint32_t n, take_step *take, void *context)
{
    for (uint32_t i = 0; i < c->level_size[n]; i++) {
        uint32_t state, to;
        tn_machine m = machine_of(c, c->level[n][i], &state);
        for (uint32_t l = 0; l < c->letters; l++) {
            tn_machine_way ways[2];
            int64_t gain;
            size_t count = follow(c, n, state, l, &to, &gain) ? tn_machine_ways(c, m, c->fits[c->first[l]], ways) : 0;
            if (c->failed != TN_OK)
                return false;
            for (size_t w = 0; w < count; w++) {
                step s = {n, i, intern(c, to, ways[w].to), l, m, ways[w].places, gain};
                if (s.to == UINT32_MAX || !take(c, &s, context))
                    return false;
            }
        }
    }
    return true;
}

static bool collect(completer *c, const step *s, void *context)
{
    (void)c;
    return tn_number(context, s->to) != UINT32_MAX;
}

static int64_t *worst_new(const completer *c, size_t count)
{
    int64_t *values = c->weighed ? malloc((count + 1) * sizeof *values) : NULL;
    for (size_t i = 0; values && i < count; i++)
        values[i] = WORST;
    return values;
}

static bool make_level(completer *c, uint32_t n, const uint64_t *states, uint32_t count)
{
    c->level[n] = malloc(((size_t)count + 1) * sizeof **c->level);
    c->forward[n] = tn_integers_new(count);
    c->backward[n] = tn_integers_new(count);
    c->best_before[n] = worst_new(c, count);
    c->best_after[n] = worst_new(c, count);
    if (!c->level[n] || !c->forward[n] || !c->backward[n] || (c->weighed && !(c->best_before[n] && c->best_after[n])))
        return false;
    c->level_size[n] = count;
    for (uint32_t i = 0; i < count; i++)
        c->level[n][i] = (uint32_t)states[i];
    qsort(c->level[n], count, sizeof **c->level, compare_numbers);
    return true;
}

static size_t index_of(const completer *c, uint32_t n, uint32_t joint)
{
    const uint32_t *found = bsearch(&joint, c->level[n], c->level_size[n], sizeof joint, compare_numbers);
    return (size_t)(found - c->level[n]);
}

static void take_better(int64_t *best, int64_t value)
{
    *best = value < *best ? value : *best;
}

static bool add_forward(completer *c, const step *s, void *context)
{
    (void)context;
    size_t to = index_of(c, s->n + 1, s->to);
    mpz_addmul_ui(c->forward[s->n + 1][to], c->forward[s->n][s->from], c->size[s->letter]);
    if (c->weighed)
        take_better(&c->best_before[s->n + 1][to], c->best_before[s->n][s->from] + s->gain);
    return true;
}

/* Not every state of a level leads to a plan that the pattern fits: such have no best. */
static bool add_backward(completer *c, const step *s, void *context)
{
    (void)context;
    size_t to = index_of(c, s->n + 1, s->to);
    mpz_addmul_ui(c->backward[s->n][s->from], c->backward[s->n + 1][to], c->size[s->letter]);
    if (c->weighed && c->best_after[s->n + 1][to] != WORST)
        take_better(&c->best_after[s->n][s->from], s->gain + c->best_after[s->n + 1][to]);
    return true;
}

/* Each tray of the letter, as the written tray that is placed: the plans before times those after. */
static bool add_placed(completer *c, const step *s, void *context)
{
    (void)context;
    size_t to = index_of(c, s->n + 1, s->to), at = (size_t)s->m.placed * c->letters + s->letter;
    if (!s->places)
        return true;
    mpz_addmul(c->placed[at], c->forward[s->n][s->from], c->backward[s->n + 1][to]);
    if (c->weighed && c->best_after[s->n + 1][to] != WORST)
        take_better(&c->best_placed[at], c->best_before[s->n][s->from] + s->gain + c->best_after[s->n + 1][to]);
    return true;
}

static void end_plans(completer *c, uint32_t n)
{
    for (uint32_t i = 0; i < c->level_size[n]; i++) {
        uint32_t state;
        bool good = accepts(c, n, c->level[n][i]);
        machine_of(c, c->level[n][i], &state);
        mpz_set_ui(c->backward[n][i], good);
        if (c->weighed && good && tn_weighed_valued(c->weighed, state))
            c->best_after[n][i] = c->sign * tn_weighed_rest(c->weighed, state, 0);
    }
}

static tn_status walk(completer *c, tn_error *error)
{
    uint32_t max = c->library->max;
    tn_machine start = tn_machine_start(c);
    uint64_t first = intern(c, 0, start);
    bool ok = first != UINT32_MAX && make_level(c, 0, &first, 1);
    if (ok)
        mpz_set_ui(c->forward[0][0], 1);
    if (ok && c->weighed)
        c->best_before[0][0] = c->sign * tn_weighed_start(c->weighed, 0);
    for (uint32_t n = 0; ok && n < max; n++) {
        tn_numbering next = {0};
        ok = each_step(c, n, collect, &next) && make_level(c, n + 1, next.keys, next.count) &&
             each_step(c, n, add_forward, NULL);
        tn_numbering_clear(&next);
    }
    for (uint32_t n = max + 1; ok && n-- > 0;) {
        end_plans(c, n);
        ok = n == max || (each_step(c, n, add_backward, NULL) && each_step(c, n, add_placed, NULL));
    }
    return ok ? TN_OK : c->failed != TN_OK ? c->failed : tn_fail_memory(error);
}

/* ---- the answer */

static void add_values(const completer *c, tn_completions *out)
{
    const tn_schema *schema = c->library->schema;
    for (tn_tray t = 0; t < schema->tray_count; t++)
        for (uint32_t i = 0; i < c->items; i++)
            for (uint32_t f = 0; f < schema->field_count; f++) {
                size_t at = (size_t)i * out->values + schema->value_start[f] + tn_tray_value(schema, t, f),
                       placed = (size_t)i * c->letters + c->letter_of[t];
                mpz_add(out->counts[at], out->counts[at], c->placed[placed]);
                if (c->weighed)
                    take_better(&out->best[at], c->best_placed[placed]);
            }
    for (size_t i = 0; c->weighed && i < (size_t)out->trays * out->values; i++)
        out->best[i] = out->best[i] == WORST ? TN_NO_BEST : c->sign * out->best[i];
}

/* A step that is looked for: the first from state `from` of level n from which a plan can still be completed. */
typedef struct way_on {
    size_t from, to;
    uint32_t letter;
    bool found;
} way_on;

static bool take_first(completer *c, const step *s, void *context)
{
    way_on *way = context;
    if (way->found || s->from != way->from)
        return true;
    size_t to = index_of(c, s->n + 1, s->to);
    if (mpz_sgn(c->backward[s->n + 1][to]) > 0)
        *way = (way_on){way->from, to, s->letter, true};
    return true;
}

/* A plan is over as soon as it can be: `first` is no longer than others that begin like it. */
static tn_status find_first(completer *c, tn_completions *out, tn_error *error)
{
    uint32_t n = 0;
    size_t at = 0;
    out->first = calloc((size_t)c->library->max + 1, sizeof *out->first);
    if (!out->first)
        return tn_fail_memory(error);
    for (; !accepts(c, n, c->level[n][at]); n++) {
        way_on way = {.from = at};
        if (!each_step(c, n, take_first, &way) || !way.found)
            return c->failed != TN_OK ? c->failed : tn_fail_memory(error);
        out->first[n] = c->first[way.letter];
        at = way.to;
    }
    out->first_length = n;
    return TN_OK;
}

static void clear(completer *c)
{
    for (uint32_t n = 0; c->level && n <= c->library->max; n++) {
        free(c->level[n]);
        tn_integers_free(c->forward[n], c->level_size[n]);
        tn_integers_free(c->backward[n], c->level_size[n]);
        free(c->best_before[n]);
        free(c->best_after[n]);
    }
    free(c->best_before);
    free(c->best_after);
    free(c->best_placed);
    free(c->level);
    free(c->level_size);
    free(c->forward);
    free(c->backward);
    tn_integers_free(c->placed, (size_t)c->items * c->letters);
    tn_interner_clear(&c->states);
    tn_completer_clear_pattern(c);
}

static tn_status make_room(completer *c, tn_completions *out, tn_error *error)
{
    size_t levels = (size_t)c->library->max + 1, values = (size_t)c->items * c->library->schema->value_count;
    c->level_size = calloc(levels, sizeof *c->level_size);
    c->forward = calloc(levels, sizeof *c->forward);
    c->backward = calloc(levels, sizeof *c->backward);
    c->best_before = calloc(levels, sizeof *c->best_before);
    c->best_after = calloc(levels, sizeof *c->best_after);
    c->best_placed = worst_new(c, tn_size_of(c->items, c->letters));
    c->placed = tn_integers_new(tn_size_of(c->items, c->letters));
    bool ok = c->level_size && c->forward && c->backward && c->best_before && c->best_after && c->placed &&
              (c->best_placed || !c->weighed);
    c->level = ok ? calloc(levels, sizeof *c->level) : NULL;
    out->counts = tn_integers_new(values);
    out->best = worst_new(c, values);
    if (!c->level || !out->counts || (c->weighed && !out->best))
        return tn_fail_memory(error);
    out->trays = c->items;
    out->values = c->library->schema->value_count;
    return TN_OK;
}

static tn_status check_measure(const tn_weighed *weighed, tn_error *error)
{
    bool over;
    tn_weighed_sum(weighed, 0, &over);
    if (!over)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_QUOTIENT, "measure `%.60s` is a quotient, and what choices leave is told by sums",
            tn_weighed_name(weighed, 0));
    tn_error_help(error, "ask by one of its two sums");
    return TN_INVALID;
}

tn_status tn_complete(tn_completions *out, const tn_library *library, const tn_open_plan *open, tn_error *error)
{
    completer c = {.library = library, .weighed = open->weighed, .sign = open->most ? -1 : 1, .error = error};
    *out = (tn_completions){0};
    mpz_init(out->plans);
    tn_status status = c.weighed ? check_measure(c.weighed, error) : TN_OK;
    if (status == TN_OK)
        status = tn_completer_read(&c, open, error);
    if (status == TN_OK)
        status = make_room(&c, out, error);
    if (status == TN_OK && library->min <= library->max)
        status = walk(&c, error);
    if (status == TN_OK && library->min <= library->max) {
        mpz_set(out->plans, c.backward[0][0]);
        add_values(&c, out);
    }
    if (status == TN_OK && open->first && mpz_sgn(out->plans) > 0)
        status = find_first(&c, out, error);
    clear(&c);
    return status;
}

void tn_completions_clear(tn_completions *completions)
{
    tn_integers_free(completions->counts, (size_t)completions->trays * completions->values);
    free(completions->best);
    free(completions->first);
    mpz_clear(completions->plans);
    *completions = (tn_completions){0};
}
