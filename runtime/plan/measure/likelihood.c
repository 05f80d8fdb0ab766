/* Adds up how likely the plans of a library are, backwards over its layers of states (walk.h), and draws plans on the
 * line of their masses, without those drawn before. */
#include "runtime/plan/measure/likelihood.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/walk.h"
#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/number/rational.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/match/summing.h"
#include "runtime/plan/match/vm.h"
#include "runtime/plan/measure/weighed.h"

/* By a letter from a state. */
typedef struct tn_likely_edge {
    uint32_t letter, target;
    uint32_t factor; /* of `factors` */
} tn_likely_edge;

/* What an edge multiplies by: up / down, of the weights that have become certain there. */
typedef struct tn_likely_factor {
    int64_t gain[TN_WEIGHED_MAX];
    mpz_t up, down;
} tn_likely_factor;

struct tn_likelihood {
    const tn_library *library;
    tn_weighed *weighed;                            /* by the weights that look at the trays around, if any */
    uint32_t around;                                /* how many those are */
    mpz_t up[TN_WEIGHED_MAX], down[TN_WEIGHED_MAX]; /* the weight of each: up / down */
    tn_classes *classes;                            /* trays that the other weights take for the same */
    mpz_t *alone;                                   /* [classes]: the weight of such a tray, times `common` */
    mpz_t common;                                   /* the denominator of those */
    uint32_t *letter_first;                         /* [letters + 1]: into the next two */
    tn_tray *trays;                                 /* [trays]: letter by letter */
    mpz_t *before;                                  /* [trays]: of the trays of the letter before it */
    mpz_t *letter;                                  /* [letters]: of all its trays */
    size_t *first;                                  /* [states + 1]: into `edges` */
    tn_likely_edge *edges;
    size_t edge_count, edge_room;
    tn_likely_factor *factors;
    size_t factor_count, factor_room;
    uint32_t states;
    uint32_t *depth; /* [states]: the fewest trays that lead there */
    size_t depth_room;
    tn_layers walk; /* by trays to come; layer n has the states of a depth up to n, and masses backwards */
    mpz_t *lengths; /* [max + 2]: where the plans of a length begin on the line of all */
    mpz_t scale;    /* a mass is the weight times this, on the line of all */
};

/* The trays of a class alone. */
static mpz_srcptr mass_alone(const tn_likelihood *likelihood, tn_tray tray)
{
    return likelihood->alone[tn_class_of(likelihood->classes, tray)];
}

/* What the plans come to that go on from a state with so many trays: times the denominators of weights that look
 * around, to the power of the most trays. */
static mpz_srcptr mass_of(const tn_likelihood *likelihood, uint32_t left, uint32_t state)
{
    return tn_walk_backward_of(&likelihood->walk, likelihood->walk.last - left, state);
}

/* mass := mass * up / down, which is whole for what a plan can still become. */
static void apply_factor(const tn_likelihood *likelihood, uint32_t factor, mpz_t mass)
{
    if (factor == 0)
        return;
    mpz_mul(mass, mass, likelihood->factors[factor].up);
    mpz_divexact(mass, mass, likelihood->factors[factor].down);
}

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

/* Trays of a class then stand for the same number of plans. */
static tn_status split_by_plans(tn_likelihood *l, tn_error *error)
{
    tn_classes plans = {.schema = l->library->schema, .of_tray = l->library->schema->tray_plans};
    return tn_classes_refine(l->classes, &plans, error);
}

static void times_plans(const tn_schema *schema, tn_tray tray, mpq_t weight)
{
    mpz_t plans;
    if (!tn_schema_of_plans(schema))
        return;
    mpz_init_set_str(plans, tn_tray_plans(schema, tray), 10);
    mpz_mul(mpq_numref(weight), mpq_numref(weight), plans);
    mpq_canonicalize(weight);
    mpz_clear(plans);
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
        times_plans(l->library->schema, tray, weights[c]);
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
    if (tn_schema_of_plans(l->library->schema))
        status = split_by_plans(l, error);
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
    tn_status status = tn_schema_listed(l->library->schema, "drawing plans by weights goes", error);
    if (status != TN_OK)
        return status;
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
        mpz_add(l->letter[letter], l->letter[letter], mass_alone(l, t));
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
    apply_factor(a->likelihood, label->factor, a->part);
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

static void find_scale(const tn_likelihood *l, uint32_t length, mpz_t scale)
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
        find_scale(l, n, scale);
        if (n >= l->library->min)
            mpz_addmul(l->lengths[n + 1], mass_of(l, n, 0), scale);
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

void tn_likely_line(const tn_likelihood *l, mpz_t length, mpz_t scale)
{
    mpz_set(length, l->lengths[l->library->max + 1]);
    mpz_set(scale, l->scale);
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

/* ---- what was drawn: stretches of the line, in a tree
 *
 * A treap (Seidel, Aragon: Randomized search trees, 1996): a search tree by the stretches' places, and a heap by
 * numbers that look random. So it is low whatever is drawn. */

#define NOTHING UINT32_MAX

typedef struct stretch {
    mpz_t begin, size;
    mpz_t below; /* the sizes of this one and of those under it */
    uint32_t left, right;
} stretch;

typedef struct stretches {
    stretch *items;
    uint32_t count, root;
} stretches;

static void add_up(stretches *tree, uint32_t i)
{
    stretch *s = &tree->items[i];
    mpz_set(s->below, s->size);
    if (s->left != NOTHING)
        mpz_add(s->below, s->below, tree->items[s->left].below);
    if (s->right != NOTHING)
        mpz_add(s->below, s->below, tree->items[s->right].below);
}

/* Parts what is under `root` into those before a place and those behind it. As deep as the tree. */
static void part(stretches *tree, uint32_t root, const mpz_t place, uint32_t *left, uint32_t *right)
{
    *left = *right = NOTHING;
    if (root == NOTHING)
        return;
    stretch *s = &tree->items[root];
    if (mpz_cmp(s->begin, place) < 0) {
        *left = root;
        part(tree, s->right, place, &s->right, right);
    } else {
        *right = root;
        part(tree, s->left, place, left, &s->left);
    }
    add_up(tree, root);
}

/* Adds item i under `root`; returns the root after that. As deep as the tree. */
static uint32_t add(stretches *tree, uint32_t root, uint32_t i)
{
    if (root == NOTHING || tn_mix64(i) > tn_mix64(root)) {
        part(tree, root, tree->items[i].begin, &tree->items[i].left, &tree->items[i].right);
        add_up(tree, i);
        return i;
    }
    stretch *s = &tree->items[root];
    if (mpz_cmp(tree->items[i].begin, s->begin) < 0)
        s->left = add(tree, s->left, i);
    else
        s->right = add(tree, s->right, i);
    add_up(tree, root);
    return root;
}

/* From a place on the line without the stretches to the same place on the whole line. */
static void find(const stretches *tree, mpz_t place)
{
    mpz_t before, begin;
    mpz_inits(before, begin, NULL); /* before: the sizes of stretches before what is looked at */
    for (uint32_t i = tree->root; i != NOTHING;) {
        const stretch *s = &tree->items[i];
        mpz_sub(begin, s->begin, before);
        if (s->left != NOTHING)
            mpz_sub(begin, begin, tree->items[s->left].below);
        if (mpz_cmp(place, begin) < 0) {
            i = s->left;
            continue;
        }
        mpz_add(before, before, s->size);
        if (s->left != NOTHING)
            mpz_add(before, before, tree->items[s->left].below);
        i = s->right;
    }
    mpz_add(place, place, before);
    mpz_clears(before, begin, NULL);
}

static bool make_room(stretches *tree, size_t count)
{
    *tree = (stretches){.items = calloc(count + 1, sizeof *tree->items), .root = NOTHING};
    return tree->items != NULL;
}

static stretch *next(stretches *tree)
{
    stretch *s = &tree->items[tree->count++];
    s->left = s->right = NOTHING;
    mpz_inits(s->begin, s->size, s->below, NULL);
    return s;
}

static void clear(stretches *tree)
{
    for (uint32_t i = 0; i < tree->count; i++)
        mpz_clears(tree->items[i].begin, tree->items[i].size, tree->items[i].below, NULL);
    free(tree->items);
}

/* ---- drawing */

/* A tray of the plan: what lies before it on the line of the plans that begin alike, and what multiplies the rest. */
typedef struct step {
    mpz_t before;
    uint32_t factor;
} step;

typedef struct drawing {
    const tn_likelihood *likelihood;
    uint64_t seed, stream, words; /* words: random ones taken so far */
    mpz_t first, all;             /* the stretch of the line that is drawn on: where it begins, and its size */
    stretches drawn;
    step *steps;    /* [max + 1] */
    tn_tray *trays; /* [max + 1] */
    mpz_t mass, part, scale, place;
} drawing;

static bool drawing_make(drawing *d, size_t count)
{
    size_t trays = (size_t)d->likelihood->library->max + 1;
    mpz_inits(d->first, d->all, d->mass, d->part, d->scale, d->place, NULL);
    d->steps = calloc(trays, sizeof *d->steps);
    d->trays = calloc(trays, sizeof *d->trays);
    for (size_t i = 0; d->steps && i < trays; i++)
        mpz_init(d->steps[i].before);
    return make_room(&d->drawn, count) && d->steps && d->trays;
}

static void drawing_clear(drawing *d)
{
    for (size_t i = 0; d->steps && i <= d->likelihood->library->max; i++)
        mpz_clear(d->steps[i].before);
    mpz_clears(d->first, d->all, d->mass, d->part, d->scale, d->place, NULL);
    free(d->steps);
    free(d->trays);
    clear(&d->drawn);
}

/* d->place := a number below the bound, each as likely as each: cut to the bound's bits, and thrown away past it. */
static void draw_below(drawing *d, const mpz_t bound)
{
    size_t bits = mpz_sizeinbase(bound, 2), limbs = (bits + 63) / 64;
    do {
        mp_limb_t *words = mpz_limbs_write(d->place, (mp_size_t)limbs);
        for (size_t i = 0; i < limbs; i++)
            words[i] = tn_random64(d->seed, d->stream, d->words++);
        words[limbs - 1] >>= limbs * 64 - bits;
        mpz_limbs_finish(d->place, (mp_size_t)limbs);
    } while (mpz_cmp(d->place, bound) >= 0);
}

/* The length of the plan at d->place of the line of all, by halving. */
static uint32_t find_length(const drawing *d)
{
    const tn_likelihood *l = d->likelihood;
    uint32_t low = l->library->min, high = l->library->max + 1; /* lengths[low] <= place < lengths[high] */
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (mpz_cmp(l->lengths[middle], d->place) <= 0)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Goes by the edge in which d->place lies, on the line of the plans with `left` trays to come; d->place is then that on
 * the line of its target's. Returns the target. */
static uint32_t follow(drawing *d, uint32_t state, uint32_t left, step *to, tn_tray *tray)
{
    const tn_likelihood *l = d->likelihood;
    size_t e = l->first[state];
    mpz_set_ui(to->before, 0);
    for (;; e++) {
        const tn_likely_edge *edge = &l->edges[e];
        if (!tn_weighed_alive(l->weighed, left - 1, edge->target))
            continue;
        mpz_set(d->part, mass_of(l, left - 1, edge->target));
        apply_factor(l, edge->factor, d->part);
        mpz_mul(d->mass, d->part, l->letter[edge->letter]);
        if (mpz_cmp(d->place, d->mass) < 0)
            break;
        mpz_sub(d->place, d->place, d->mass);
        mpz_add(to->before, to->before, d->mass);
    }
    const tn_likely_edge *edge = &l->edges[e];
    uint32_t low = l->letter_first[edge->letter], high = l->letter_first[edge->letter + 1];
    mpz_fdiv_q(d->mass, d->place, d->part); /* before[low] <= mass < before[high] */
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (mpz_cmp(l->before[middle], d->mass) <= 0)
            low = middle;
        else
            high = middle;
    }
    *tray = l->trays[low];
    to->factor = edge->factor;
    mpz_submul(d->place, d->part, l->before[low]);
    mpz_addmul(to->before, d->part, l->before[low]);
    mpz_mul(d->place, d->place, l->factors[edge->factor].down);
    mpz_mul(d->mass, mass_alone(l, *tray), l->factors[edge->factor].up);
    mpz_fdiv_q(d->place, d->place, d->mass);
    return edge->target;
}

/* The plan at d->place of the line of all, and its stretch there. Returns its length. */
static uint32_t find_plan(drawing *d, stretch *found)
{
    const tn_likelihood *l = d->likelihood;
    uint32_t length = find_length(d), state = 0;
    mpz_sub(d->place, d->place, l->lengths[length]);
    find_scale(l, length, d->scale);
    mpz_fdiv_q(d->place, d->place, d->scale);
    for (uint32_t i = 0; i < length; i++)
        state = follow(d, state, length - i, &d->steps[i], &d->trays[i]);
    mpz_set_ui(found->begin, 0);
    mpz_set(found->size, mass_of(l, 0, state));
    for (uint32_t i = length; i-- > 0;) {
        mpz_srcptr alone = mass_alone(l, d->trays[i]);
        mpz_mul(found->begin, found->begin, alone);
        apply_factor(l, d->steps[i].factor, found->begin);
        mpz_add(found->begin, found->begin, d->steps[i].before);
        mpz_mul(found->size, found->size, alone);
        apply_factor(l, d->steps[i].factor, found->size);
    }
    mpz_mul(found->begin, found->begin, d->scale);
    mpz_mul(found->size, found->size, d->scale);
    mpz_add(found->begin, found->begin, l->lengths[length]);
    return length;
}

tn_status tn_likely_plan(const tn_likelihood *l, const mpz_t place, tn_tray *trays, uint32_t *length, mpz_t begin,
                         mpz_t size, tn_error *error)
{
    drawing d = {.likelihood = l};
    tn_status status = drawing_make(&d, 1) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK) {
        stretch *found = next(&d.drawn);
        mpz_set(d.place, place);
        *length = find_plan(&d, found);
        memcpy(trays, d.trays, *length * sizeof *trays);
        mpz_set(begin, found->begin);
        mpz_set(size, found->size);
    }
    drawing_clear(&d);
    return status;
}

static tn_status draw(drawing *d, mpz_t rank, tn_error *error)
{
    const tn_library *library = d->likelihood->library;
    stretch *drawn = next(&d->drawn);
    draw_below(d, d->all);
    find(&d->drawn, d->place);
    mpz_add(d->place, d->place, d->first);
    uint32_t length = find_plan(d, drawn);
    mpz_sub(drawn->begin, drawn->begin, d->first);
    mpz_sub(d->all, d->all, drawn->size);
    d->drawn.root = add(&d->drawn, d->drawn.root, d->drawn.count - 1);
    return tn_library_rank(library, d->trays, length, rank)
               ? TN_OK
               : tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a plan that was drawn is not in the library");
}

static int compare(const void *a, const void *b)
{
    mpz_srcptr x = a, y = b;
    return mpz_cmp(x, y);
}

static tn_status draw_all(const tn_likelihood *l, uint64_t seed, uint32_t length, size_t count, mpz_t *ranks,
                          tn_error *error)
{
    drawing d = {.likelihood = l, .seed = seed, .stream = length};
    tn_status status = drawing_make(&d, count) ? TN_OK : tn_fail_memory(error);
    bool one = length != TN_ALL_LENGTHS;
    if (status == TN_OK && one)
        mpz_set(d.first, l->lengths[length]);
    if (status == TN_OK)
        mpz_sub(d.all, l->lengths[one ? length + 1 : l->library->max + 1], d.first);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        status = tn_weighed_check(l->weighed, error);
        if (status == TN_OK)
            status = draw(&d, ranks[i], error);
    }
    drawing_clear(&d);
    if (status == TN_OK)
        qsort(ranks, count, sizeof *ranks, compare);
    return status;
}

tn_status tn_likelihood_sample(const tn_likelihood *l, uint64_t seed, uint32_t length, size_t count, mpz_t *ranks,
                               size_t *found, tn_error *error)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(l->library, length, kept);
    bool all = mpz_cmp_ui(kept, count) <= 0;
    mpz_clear(kept);
    if (all || count == 0)
        return tn_library_sample(l->library, seed, length, count, ranks, found, error);
    *found = count;
    return draw_all(l, seed, length, count, ranks, error);
}
