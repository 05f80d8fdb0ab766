/* Counts forwards and backwards over the library's automaton joined with the machine that places the written trays. The
 * plans in which a tray is placed are those before it times those after it. */
#include "runtime/plan/measure/complete.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/automata/walk.h"
#include "runtime/base/array.h"
#include "runtime/plan/library/library_data.h"

#define WORST INT64_MAX
#define NO_ITEM UINT32_MAX

typedef struct completer {
    const tn_library *library;
    tn_weighed *weighed; /* whose states take the place of the library's; or NULL */
    int64_t sign;        /* that makes less better */
    tn_open_pattern pattern;
    uint32_t *letter_of; /* [trays] */
    uint32_t letters;
    tn_tray *first;       /* [letters] */
    uint64_t *size;       /* [letters] */
    tn_interner states;   /* {library's state, placed, gap, earlier in two words} */
    tn_layers walk;       /* by trays before; forwards: plans until there, backwards: plans from there */
    mpz_t *placed;        /* [items][letters]: plans in which such a tray is placed there */
    int64_t *best_placed; /* the same of the measure; WORST if there is none */
} completer;

/* ---- letters: trays that lead to the same and fit the same */

/* Trays that differ here lead to different states, or weigh differently. */
static uint32_t letter_apart(const completer *c, tn_tray t)
{
    return c->weighed ? tn_weighed_letter(c->weighed, t) : c->library->tray_column[t];
}

static tn_status make_letters(completer *c, tn_error *error)
{
    uint32_t trays = c->library->schema->tray_count;
    tn_numbering fits = {0}, pairs = {0};
    c->letter_of = calloc((size_t)trays + 1, sizeof *c->letter_of);
    bool ok = c->letter_of != NULL;
    for (tn_tray t = 0; ok && t < trays; t++) {
        uint32_t fit = tn_number(&fits, c->pattern.fits[t]);
        c->letter_of[t] = fit == UINT32_MAX ? fit : tn_number(&pairs, (uint64_t)letter_apart(c, t) << 32 | fit);
        ok = c->letter_of[t] != UINT32_MAX;
    }
    c->letters = pairs.count;
    tn_numbering_clear(&fits);
    tn_numbering_clear(&pairs);
    c->first = ok ? calloc((size_t)c->letters + 1, sizeof *c->first) : NULL;
    c->size = ok ? calloc((size_t)c->letters + 1, sizeof *c->size) : NULL;
    if (!c->first || !c->size)
        return tn_fail_memory(error);
    for (tn_tray t = trays; t-- > 0;) {
        c->first[c->letter_of[t]] = t;
        c->size[c->letter_of[t]]++;
    }
    return TN_OK;
}

/* ---- the graph */

static uint32_t intern(completer *c, uint32_t state, tn_open_machine m)
{
    uint32_t key[] = {state, m.placed, m.gap, (uint32_t)m.earlier, (uint32_t)(m.earlier >> 32)};
    return tn_intern(&c->states, key, sizeof key / sizeof *key);
}

static tn_open_machine machine_of(const completer *c, uint32_t joint, uint32_t *state)
{
    size_t size;
    const uint32_t *key = tn_interned(&c->states, joint, &size);
    *state = key[0];
    return (tn_open_machine){key[1], key[2], (uint64_t)key[4] << 32 | key[3]};
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
    tn_open_machine m = machine_of(c, joint, &state);
    return n >= c->library->min && m.placed == c->pattern.items && is_alive(c, 0, state);
}

/* By a tray of the letter. */
typedef struct step {
    uint32_t letter;
    uint32_t item; /* the written tray that it is, or NO_ITEM */
    int64_t gain;  /* of the measure, with the sign that makes less better */
} step;

/* Where a letter leads after n trays; *to: UINT32_MAX if nothing that is kept follows. */
static tn_status follow(completer *c, uint32_t n, uint32_t state, uint32_t letter, uint32_t *to, int64_t *gain,
                        tn_error *error)
{
    int64_t gains[TN_WEIGHED_MAX] = {0};
    tn_status status = TN_OK;
    if (c->weighed)
        status = tn_weighed_step(c->weighed, state, tn_weighed_letter(c->weighed, c->first[letter]), to, gains, error);
    else
        *to = tn_library_step(c->library, state, c->first[letter]);
    *gain = c->sign * gains[0];
    if (status == TN_OK && *to != UINT32_MAX && !leads_on(c, n + 1, *to))
        *to = UINT32_MAX;
    return status;
}

static tn_status edges(void *context, uint32_t layer, uint32_t joint, tn_walk_seen *seen, void *walk, tn_error *error)
{
    completer *c = context;
    uint32_t state, to;
    tn_open_machine m = machine_of(c, joint, &state);
    tn_status status = TN_OK;
    for (uint32_t l = 0; status == TN_OK && l < c->letters; l++) {
        tn_open_way ways[2];
        step s = {.letter = l};
        status = follow(c, layer, state, l, &to, &s.gain, error);
        size_t count =
            status == TN_OK && to != UINT32_MAX ? tn_open_ways(&c->pattern, m, c->pattern.fits[c->first[l]], ways) : 0;
        for (size_t w = 0; status == TN_OK && w < count; w++) {
            uint32_t next = intern(c, to, ways[w].to);
            s.item = ways[w].places ? m.placed : NO_ITEM;
            status = next == UINT32_MAX ? tn_fail_memory(error) : seen(walk, next, &s, error);
        }
    }
    return status;
}

static const tn_walk_graph open_graph = {tn_walk_starts_first, edges};

/* ---- the algebra: how many plans, and the best of them */

typedef struct plans {
    mpz_t count;
    int64_t best; /* WORST: none has a value */
} plans;

static void plans_init(const void *context, void *element)
{
    plans *p = element;
    (void)context;
    mpz_init(p->count);
    p->best = WORST;
}

static void plans_clear(void *element)
{
    plans *p = element;
    mpz_clear(p->count);
}

static void take_better(int64_t *best, int64_t value)
{
    *best = value < *best ? value : *best;
}

static tn_status begin(void *context, uint32_t layer, uint32_t joint, void *element, tn_error *error)
{
    const completer *c = context;
    plans *start = element;
    (void)layer, (void)joint, (void)error;
    mpz_set_ui(start->count, 1);
    if (c->weighed)
        start->best = c->sign * tn_weighed_start(c->weighed, 0);
    return TN_OK;
}

/* Not every state leads to a plan that the pattern fits, or ends one with a value: such have no best. */
static tn_status extend(void *context, void *sum, const void *element, const tn_walk_edge *edge, tn_error *error)
{
    const completer *c = context;
    const plans *from = element;
    const step *s = edge->label;
    plans *to = sum;
    (void)error;
    mpz_addmul_ui(to->count, from->count, c->size[s->letter]);
    if (from->best != WORST)
        take_better(&to->best, s->gain + from->best);
    return TN_OK;
}

static tn_status end(void *context, uint32_t layer, uint32_t joint, void *element, tn_error *error)
{
    const completer *c = context;
    plans *ended = element;
    uint32_t state;
    (void)error;
    if (!accepts(c, layer, joint))
        return TN_OK;
    machine_of(c, joint, &state);
    mpz_set_ui(ended->count, 1);
    if (c->weighed && tn_weighed_valued(c->weighed, state))
        ended->best = c->sign * tn_weighed_rest(c->weighed, state, 0);
    return TN_OK;
}

/* Backwards, what is before the edge is known already: with each tray of the letter as the written tray that is placed
 * there are the plans before it times those after it. */
static tn_status extend_back(void *context, void *sum, const void *element, const tn_walk_edge *edge, tn_error *error)
{
    completer *c = context;
    const step *s = edge->label;
    const plans *before = tn_walk_forward_of(&c->walk, edge->layer, edge->from), *after = element;
    if (s->item != NO_ITEM) {
        size_t at = (size_t)s->item * c->letters + s->letter;
        mpz_addmul(c->placed[at], before->count, after->count);
        if (c->weighed && after->best != WORST)
            take_better(&c->best_placed[at], before->best + s->gain + after->best);
    }
    return extend(context, sum, element, edge, error);
}

TN_WALK_ALGEBRA(before_algebra, plans_init, plans_clear, begin, extend, NULL);
TN_WALK_ALGEBRA(after_algebra, plans_init, plans_clear, end, extend_back, NULL);

static const plans *plans_after(const completer *c, uint32_t layer, uint32_t place)
{
    return tn_walk_backward_of(&c->walk, layer, place);
}

static tn_status walk(completer *c, tn_error *error)
{
    if (intern(c, 0, tn_open_start(&c->pattern)) == UINT32_MAX)
        return tn_fail_memory(error);
    tn_status status = tn_walk_begin(&c->walk, c->library->max, true, error);
    if (status == TN_OK)
        status = tn_walk_forward(&c->walk, &open_graph, c, &before_algebra, c, sizeof(plans), error);
    if (status == TN_OK)
        status = tn_walk_backward(&c->walk, &open_graph, c, &after_algebra, c, sizeof(plans), error);
    return status;
}

/* ---- the answer */

static void add_values(const completer *c, tn_completions *out)
{
    const tn_schema *schema = c->library->schema;
    for (tn_tray t = 0; t < schema->tray_count; t++)
        for (uint32_t i = 0; i < c->pattern.items; i++)
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

/* An edge that is looked for: the first from which a plan can still be completed. */
typedef struct way_on {
    const completer *c;
    uint32_t to, letter;
    bool found;
} way_on;

static tn_status take_first(void *context, const tn_walk_edge *edge, tn_error *error)
{
    way_on *way = context;
    const step *s = edge->label;
    (void)error;
    if (!way->found && mpz_sgn(plans_after(way->c, edge->layer + 1, edge->to)->count) > 0)
        *way = (way_on){way->c, edge->to, s->letter, true};
    return TN_OK;
}

/* A plan is over as soon as it can be: `first` is no longer than others that begin like it. */
static tn_status find_first(completer *c, tn_completions *out, tn_error *error)
{
    uint32_t n = 0, at = 0;
    out->first = calloc((size_t)c->library->max + 1, sizeof *out->first);
    if (!out->first)
        return tn_fail_memory(error);
    for (; !accepts(c, n, tn_walk_at(&c->walk, n)->states[at]); n++) {
        way_on way = {.c = c};
        tn_status status = tn_walk_from(&c->walk, &open_graph, c, n, at, take_first, &way, error);
        if (status != TN_OK)
            return status;
        out->first[n] = c->first[way.letter];
        at = way.to;
    }
    out->first_length = n;
    return TN_OK;
}

static void clear(completer *c)
{
    tn_walk_clear(&c->walk, &before_algebra, &after_algebra);
    free(c->best_placed);
    tn_integers_free(c->placed, (size_t)c->pattern.items * c->letters);
    tn_interner_clear(&c->states);
    free(c->letter_of);
    free(c->first);
    free(c->size);
    tn_open_pattern_clear(&c->pattern);
}

static int64_t *worst_new(const completer *c, size_t count)
{
    int64_t *values = c->weighed ? tn_array_new((uint64_t)count + 1, sizeof *values) : NULL;
    for (size_t i = 0; values && i < count; i++)
        values[i] = WORST;
    return values;
}

static tn_status make_room(completer *c, tn_completions *out, tn_error *error)
{
    size_t values = (size_t)c->pattern.items * c->library->schema->value_count;
    c->best_placed = worst_new(c, tn_size_of(c->pattern.items, c->letters));
    c->placed = tn_integers_new(tn_size_of(c->pattern.items, c->letters));
    out->counts = tn_integers_new(values);
    out->best = worst_new(c, values);
    if (!c->placed || !out->counts || (c->weighed && (!c->best_placed || !out->best)))
        return tn_fail_memory(error);
    out->trays = c->pattern.items;
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
    completer c = {.library = library, .weighed = open->weighed, .sign = open->most ? -1 : 1};
    *out = (tn_completions){0};
    mpz_init(out->plans);
    tn_status status = c.weighed ? check_measure(c.weighed, error) : TN_OK;
    if (status == TN_OK)
        status = tn_open_pattern_read(&c.pattern, library->schema, open, error);
    if (status == TN_OK)
        status = make_letters(&c, error);
    if (status == TN_OK)
        status = make_room(&c, out, error);
    if (status == TN_OK && library->min <= library->max)
        status = walk(&c, error);
    if (status == TN_OK && library->min <= library->max) {
        mpz_set(out->plans, plans_after(&c, 0, 0)->count);
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
