/* Adds up how likely the plans of a library are, backwards over its layers of states (walk.h). */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/number/rational.h"
#include "runtime/plan/match/summing.h"
#include "runtime/plan/match/vm.h"
#include "runtime/plan/measure/likelihood_data.h"

/* ---- weights */

static const tn_weight_record *weight_of(const tn_likelihood *l, uint32_t i)
{
    return &l->library->schema->module->WEIGHT_records[l->library->record->weight_first + i];
}

static const tn_term_record *term_of(const tn_likelihood *l, const tn_weight_record *weight)
{
    const tn_module *module = l->library->schema->module;
    return &module->TERM_records[module->SUM_records[weight->sum].term_first];
}

static void read_factor(const tn_likelihood *l, const tn_weight_record *weight, mpq_t factor)
{
    tn_rational_read(tn_text(l->library->schema->module, weight->factor), factor);
}

static tn_status too_many_around(tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY, "more than %d weights of the library look at the trays around a tray",
            TN_WEIGHED_MAX);
    tn_error_help(error, "leave some out, or draw each plan as likely as each with --uniform");
    return TN_LIMIT;
}

/* Which weights a tray decides alone, and which look around: of these the sums. */
typedef struct sorting {
    uint32_t alone_count, around_count;
    uint32_t *alone, *sums; /* [weights]: indices of those alone, and their sums */
    uint32_t around[TN_WEIGHED_MAX];
    const char *names[TN_WEIGHED_MAX];
} sorting;

static tn_status sort_weights(tn_likelihood *l, sorting *s, tn_error *error)
{
    const tn_module *module = l->library->schema->module;
    uint32_t count = l->library->record->weight_count;
    uint8_t *known = calloc(module->FUNCTION_count + 1, 1);
    s->alone = calloc((size_t)count + 1, sizeof *s->alone);
    s->sums = calloc((size_t)count + 1, sizeof *s->sums);
    tn_status status = known && s->alone && s->sums ? TN_OK : tn_fail_memory(error);
    mpq_t factor;
    mpq_init(factor);
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        const tn_weight_record *weight = weight_of(l, i);
        if (tn_summing_is_local(module, term_of(l, weight)->part, known)) {
            s->sums[s->alone_count] = weight->sum;
            s->alone[s->alone_count++] = i;
        } else if (s->around_count == TN_WEIGHED_MAX) {
            status = too_many_around(error);
        } else {
            read_factor(l, weight, factor);
            mpz_set(l->up[s->around_count], mpq_numref(factor));
            mpz_set(l->down[s->around_count], mpq_denref(factor));
            s->names[s->around_count] = tn_text(module, weight->name);
            s->around[s->around_count++] = weight->sum;
        }
    }
    mpq_clear(factor);
    free(known);
    return status;
}

/* weights[class]: the product of the weights of such a tray. */
static tn_status weigh_classes(const tn_likelihood *l, const sorting *s, mpq_t *weights, tn_error *error)
{
    tn_plan_vm *vm = NULL;
    mpq_t factor;
    mpq_init(factor);
    tn_status status = tn_plan_vm_new(l->library->schema, 1, &vm, error);
    for (uint32_t c = 0; status == TN_OK && c < l->classes->count; c++) {
        tn_tray tray = l->classes->representative[c];
        mpq_set_ui(weights[c], 1, 1);
        status = tn_plan_vm_plan(vm, &tray, 1, error);
        for (uint32_t i = 0; status == TN_OK && i < s->alone_count; i++) {
            const tn_weight_record *weight = weight_of(l, s->alone[i]);
            bool in = false;
            status = tn_plan_vm_relation(vm, term_of(l, weight)->part, 0, 1, &in, error);
            if (!in)
                continue;
            read_factor(l, weight, factor);
            mpq_mul(weights[c], weights[c], factor);
        }
    }
    tn_plan_vm_free(vm);
    mpq_clear(factor);
    return status;
}

static tn_status make_alone(tn_likelihood *l, const sorting *s, tn_error *error)
{
    tn_status status = tn_classes_with_sums(l->library->schema, NULL, 0, s->sums, s->alone_count, &l->classes, error);
    if (status != TN_OK)
        return status;
    uint32_t count = l->classes->count;
    mpq_t *weights = calloc((size_t)count + 1, sizeof *weights);
    l->alone = tn_integers_new(count);
    for (uint32_t c = 0; weights && c < count; c++)
        mpq_init(weights[c]);
    status = weights && l->alone ? weigh_classes(l, s, weights, error) : tn_fail_memory(error);
    for (uint32_t c = 0; status == TN_OK && c < count; c++)
        mpz_lcm(l->common, l->common, mpq_denref(weights[c]));
    for (uint32_t c = 0; status == TN_OK && c < count; c++) {
        mpz_divexact(l->alone[c], l->common, mpq_denref(weights[c]));
        mpz_mul(l->alone[c], l->alone[c], mpq_numref(weights[c]));
    }
    for (uint32_t c = 0; weights && c < count; c++)
        mpq_clear(weights[c]);
    free(weights);
    return status;
}

static tn_status make_weights(tn_likelihood *l, tn_error *error)
{
    sorting s = {0};
    tn_status status = sort_weights(l, &s, error);
    if (status == TN_OK)
        status = make_alone(l, &s, error);
    l->around = s.around_count;
    if (status == TN_OK)
        status = tn_weighed_of_sums(l->library, s.around, s.names, s.around_count, &l->weighed, error);
    free(s.alone);
    free(s.sums);
    return status;
}

/* ---- letters */

static tn_status make_letters(tn_likelihood *l, tn_error *error)
{
    uint32_t letters = tn_weighed_letters(l->weighed), trays = l->library->schema->tray_count;
    l->letter_first = calloc((size_t)letters + 2, sizeof *l->letter_first);
    l->trays = calloc((size_t)trays + 1, sizeof *l->trays);
    l->before = tn_integers_new(trays);
    l->letter = tn_integers_new(letters);
    if (!l->letter_first || !l->trays || !l->before || !l->letter)
        return tn_fail_memory(error);
    for (tn_tray t = 0; t < trays; t++)
        l->letter_first[tn_weighed_letter(l->weighed, t) + 2]++;
    for (uint32_t i = 2; i <= letters; i++)
        l->letter_first[i] += l->letter_first[i - 1];
    for (tn_tray t = 0; t < trays; t++) {
        uint32_t letter = tn_weighed_letter(l->weighed, t), at = l->letter_first[letter + 1]++;
        l->trays[at] = t;
        mpz_set(l->before[at], l->letter[letter]);
        mpz_add(l->letter[letter], l->letter[letter], tn_likely_alone(l, t));
    }
    return TN_OK;
}

/* ---- states and edges */

static tn_status add_factor(tn_likelihood *l, const int64_t *gain, tn_error *error)
{
    if (!tn_array_reserve(&l->factors, &l->factor_room, l->factor_count, 1, sizeof *l->factors))
        return tn_fail_memory(error);
    tn_likely_factor *factor = &l->factors[l->factor_count++];
    mpz_t power;
    mpz_init(power);
    memcpy(factor->gain, gain, sizeof factor->gain);
    mpz_init_set_ui(factor->up, 1);
    mpz_init_set_ui(factor->down, 1);
    for (uint32_t k = 0; k < l->around; k++) {
        mpz_pow_ui(power, l->up[k], (uint64_t)gain[k]);
        mpz_mul(factor->up, factor->up, power);
        mpz_pow_ui(power, l->down[k], (uint64_t)gain[k]);
        mpz_mul(factor->down, factor->down, power);
    }
    mpz_clear(power);
    return TN_OK;
}

/* The factor of what has become certain; there are few. */
static tn_status find_factor(tn_likelihood *l, const int64_t *gain, uint32_t *number, tn_error *error)
{
    for (size_t i = 0; i < l->factor_count; i++)
        if (memcmp(l->factors[i].gain, gain, sizeof l->factors[i].gain) == 0) {
            *number = (uint32_t)i;
            return TN_OK;
        }
    *number = (uint32_t)l->factor_count;
    return add_factor(l, gain, error);
}

static tn_status reach(tn_likelihood *l, uint32_t target, uint32_t depth, tn_error *error)
{
    if (target < l->states)
        return TN_OK;
    if (!tn_array_reserve(&l->depth, &l->depth_room, l->states, 1, sizeof *l->depth))
        return tn_fail_memory(error);
    l->depth[l->states++] = depth; /* states are numbered as they are met, and met in order of depth */
    return TN_OK;
}

static tn_status add_edges(tn_likelihood *l, uint32_t state, tn_error *error)
{
    tn_status status = tn_weighed_check(l->weighed, error);
    for (uint32_t letter = 0; status == TN_OK && letter < tn_weighed_letters(l->weighed); letter++) {
        tn_likely_edge edge = {.letter = letter};
        int64_t gain[TN_WEIGHED_MAX];
        status = tn_weighed_step(l->weighed, state, letter, &edge.target, gain, error);
        if (status != TN_OK || edge.target == UINT32_MAX)
            continue;
        status = find_factor(l, gain, &edge.factor, error);
        if (status == TN_OK)
            status = reach(l, edge.target, l->depth[state] + 1, error);
        if (status == TN_OK && !tn_array_reserve(&l->edges, &l->edge_room, l->edge_count, 1, sizeof *l->edges))
            status = tn_fail_memory(error);
        if (status == TN_OK)
            l->edges[l->edge_count++] = edge;
    }
    return status;
}

static tn_status make_edges(tn_likelihood *l, tn_error *error)
{
    static const int64_t none[TN_WEIGHED_MAX] = {0};
    size_t room = 0;
    tn_status status = add_factor(l, none, error);
    if (status == TN_OK)
        status = reach(l, 0, 0, error);
    for (uint32_t s = 0; status == TN_OK && s < l->states; s++) {
        if (!tn_array_reserve(&l->first, &room, s, 2, sizeof *l->first))
            return tn_fail_memory(error);
        l->first[s] = l->edge_count;
        if (l->depth[s] < l->library->max)
            status = add_edges(l, s, error);
        l->first[s + 1] = l->edge_count;
    }
    return status;
}

/* ---- masses */

typedef struct adding {
    const tn_likelihood *likelihood;
    mpz_t part;
} adding;

static bool starts(void *context, uint32_t layer)
{
    (void)context, (void)layer;
    return true;
}

static tn_status edges_of(void *context, uint32_t layer, uint32_t state, tn_walk_seen *seen, void *walk,
                          tn_error *error)
{
    const tn_likelihood *l = context;
    uint32_t left = l->library->max - layer;
    tn_status status = TN_OK;
    for (size_t e = l->first[state]; status == TN_OK && e < l->first[state + 1]; e++)
        if (tn_weighed_alive(l->weighed, left - 1, l->edges[e].target))
            status = seen(walk, l->edges[e].target, &l->edges[e], error);
    return status;
}

static void no_mass(const void *context, void *mass)
{
    (void)context;
    mpz_init(mass);
}

static void clear_mass(void *mass)
{
    mpz_clear(mass);
}

/* What a plan is worth that ends in the state. */
static tn_status end_mass(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    const adding *a = context;
    const tn_likelihood *l = a->likelihood;
    mpz_ptr mass = element;
    if (layer < l->library->max)
        return state == 0 ? tn_weighed_check(l->weighed, error) : TN_OK;
    mpz_t power;
    mpz_init(power);
    mpz_set_ui(mass, tn_weighed_alive(l->weighed, 0, state) ? 1 : 0);
    for (uint32_t k = 0; k < l->around && mpz_sgn(mass) > 0; k++) {
        uint64_t rest = (uint64_t)tn_weighed_rest(l->weighed, state, k);
        mpz_pow_ui(power, l->up[k], rest);
        mpz_mul(mass, mass, power);
        mpz_pow_ui(power, l->down[k], l->library->max - rest);
        mpz_mul(mass, mass, power);
    }
    mpz_clear(power);
    return TN_OK;
}

static tn_status add_mass(void *context, void *mass, const void *element, const tn_walk_edge *edge, tn_error *error)
{
    adding *a = context;
    const tn_likely_edge *label = edge->label;
    (void)error;
    mpz_set(a->part, element);
    tn_likely_apply(a->likelihood, label->factor, a->part);
    mpz_addmul(mass, a->part, a->likelihood->letter[label->letter]);
    return TN_OK;
}

static const tn_walk_graph likely_graph = {starts, edges_of};
TN_WALK_ALGEBRA(mass_algebra, no_mass, clear_mass, end_mass, add_mass, NULL);

/* Bits of the largest mass, and a few more. */
static uint64_t bits_of(const tn_likelihood *l)
{
    mpz_t all;
    mpz_init(all);
    for (uint32_t i = 0; i < tn_weighed_letters(l->weighed); i++)
        mpz_add(all, all, l->letter[i]);
    uint64_t bits = mpz_sizeinbase(all, 2);
    mpz_clear(all);
    for (uint32_t k = 0; k < l->around; k++)
        bits += mpz_sizeinbase(l->up[k], 2) + mpz_sizeinbase(l->down[k], 2);
    return bits * l->library->max + 64;
}

static tn_status make_masses(tn_likelihood *l, tn_error *error)
{
    uint32_t max = l->library->max;
    uint64_t each =
        sizeof(mpz_t) + 16 + bits_of(l) / 16; /* they grow with the trays to come: half as large in the mean */
    uint64_t cells = (uint64_t)(max + 1) * l->states;
    uint64_t bytes = cells > UINT64_MAX / 4 / each ? UINT64_MAX / 4 : cells * each;
    tn_status status = tn_watch_room(l->library->schema->module->watch, bytes, "adding up the weights", error);
    if (status == TN_LIMIT)
        tn_error_help(error, "give fewer trays with --trays, or raise the limit with --memory-limit");
    adding a = {.likelihood = l};
    mpz_init(a.part);
    if (status == TN_OK)
        status = tn_walk_begin(&l->walk, max, true, error);
    for (uint32_t n = 0, count = 0; status == TN_OK && n <= max; n++) {
        while (count < l->states && l->depth[count] <= n)
            count++;
        status = tn_walk_fill(&l->walk, n, count, error);
    }
    if (status == TN_OK)
        status = tn_walk_backward(&l->walk, &likely_graph, l, &mass_algebra, &a, sizeof(mpz_t), error);
    mpz_clear(a.part);
    return status;
}

void tn_likely_scale(const tn_likelihood *l, uint32_t length, mpz_t scale)
{
    mpz_pow_ui(scale, l->common, l->library->max - length);
}

static tn_status make_lengths(tn_likelihood *l, tn_error *error)
{
    uint32_t max = l->library->max;
    mpz_t scale;
    mpz_init(scale);
    l->lengths = tn_integers_new((size_t)max + 2);
    for (uint32_t n = 0; l->lengths && n <= max; n++) {
        mpz_set(l->lengths[n + 1], l->lengths[n]);
        tn_likely_scale(l, n, scale);
        if (n >= l->library->min)
            mpz_addmul(l->lengths[n + 1], tn_likely_mass(l, n, 0), scale);
    }
    mpz_pow_ui(l->scale, l->common, max);
    for (uint32_t k = 0; k < l->around; k++) {
        mpz_pow_ui(scale, l->down[k], max);
        mpz_mul(l->scale, l->scale, scale);
    }
    mpz_clear(scale);
    return l->lengths ? TN_OK : tn_fail_memory(error);
}

/* ---- all of it */

tn_status tn_likelihood_new(const tn_library *library, tn_likelihood **out, tn_error *error)
{
    tn_likelihood *l = calloc(1, sizeof *l);
    if (!l)
        return tn_fail_memory(error);
    l->library = library;
    mpz_init_set_ui(l->common, 1);
    mpz_init(l->scale);
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        mpz_inits(l->up[k], l->down[k], NULL);
    tn_status (*const steps[])(tn_likelihood *, tn_error *) = {make_weights, make_letters, make_edges, make_masses,
                                                               make_lengths};
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < sizeof steps / sizeof *steps; i++)
        status = steps[i](l, error);
    if (status == TN_OK)
        *out = l;
    else
        tn_likelihood_free(l);
    return status;
}

void tn_likelihood_free(tn_likelihood *l)
{
    if (!l)
        return;
    tn_walk_clear(&l->walk, NULL, &mass_algebra);
    tn_integers_free(l->lengths, (size_t)l->library->max + 2);
    tn_integers_free(l->alone, l->classes ? l->classes->count : 0);
    tn_integers_free(l->before, l->library->schema->tray_count);
    tn_integers_free(l->letter, l->weighed ? tn_weighed_letters(l->weighed) : 0);
    for (size_t i = 0; i < l->factor_count; i++)
        mpz_clears(l->factors[i].up, l->factors[i].down, NULL);
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        mpz_clears(l->up[k], l->down[k], NULL);
    mpz_clears(l->common, l->scale, NULL);
    free(l->factors);
    free(l->letter_first);
    free(l->trays);
    free(l->first);
    free(l->edges);
    free(l->depth);
    tn_classes_free(l->classes);
    tn_weighed_free(l->weighed);
    free(l);
}

void tn_likelihood_total(const tn_likelihood *l, uint32_t length, mpq_t total)
{
    const tn_library *library = l->library;
    mpq_set_ui(total, 0, 1);
    if (length == TN_ALL_LENGTHS && library->min <= library->max)
        mpz_set(mpq_numref(total), l->lengths[library->max + 1]);
    else if (length >= library->min && length <= library->max)
        mpz_sub(mpq_numref(total), l->lengths[length + 1], l->lengths[length]);
    mpz_set(mpq_denref(total), l->scale);
    mpq_canonicalize(total);
}
