/* Counts the houses of a library layer by layer: how many choices lead to each node. */
#include "runtime/house/count/houses.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/count/data.h"
#include "runtime/house/rule/asked.h"
#include "runtime/house/rule/stages.h"

/* Adds to an error what helps. */
static tn_status too_many(const tn_houses_kind *kind, tn_error *error)
{
    const char *name = tn_frontier_largest(kind->frontier);
    if (name)
        tn_error_help(error,
                      "`%.60s` keeps most apart. Ask about fewer trays (--trays) or one plan (--plan), or allow "
                      "more (--max-states N)",
                      name);
    else
        tn_error_help(error, "ask about fewer trays (--trays) or one plan (--plan), or allow more (--max-states "
                             "N)");
    return TN_LIMIT;
}

/* The limit is of states. Nodes within a step, and what can stand between trays, take less to find: eight times as
 * many.
 */
enum { OTHERS_A_STATE = 8 };

/* others: nodes within a step that count as one state. */
static tn_status check_nodes(const tn_houses *h, const tn_houses_kind *kind, uint32_t layer, uint64_t nodes,
                             uint32_t others, tn_error *error)
{
    bool states = layer % tn_houses_stages(h, kind) == 0;
    if ((states ? nodes : nodes / others) <= h->max_states && kind->frontier->states.count <= h->max_states)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_FRONTIER, "counting these houses takes more than %u states", h->max_states);
    return too_many(kind, error);
}

tn_status tn_houses_check_interfaces(const tn_houses *h, const tn_houses_kind *kind, tn_error *error)
{
    uint64_t most = (uint64_t)OTHERS_A_STATE * h->max_states;
    if (kind->frontier->interfaces.outcomes <= most)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_FRONTIER, "these houses have more than %" PRIu64 " choices of what is between two trays",
            most);
    return too_many(kind, error);
}

/* ---- counting forwards */

/* Of a node: the choices that lead there, and those without their tiles. */
typedef struct tn_node_counts {
    mpz_t houses, faced;
} tn_node_counts;

typedef struct tn_counting_houses {
    const tn_houses *houses;
    tn_houses_kind *kind;
    uint32_t stages, layer; /* layer: 1 and the one that is gone on from; 0: none yet */
    uint64_t nodes;         /* of all layers of states so far */
    mpz_t one;
} tn_counting_houses;

static void zero_counts(const void *context, void *element)
{
    tn_node_counts *counts = element;
    (void)context;
    mpz_inits(counts->houses, counts->faced, NULL);
}

static void clear_counts(void *element)
{
    tn_node_counts *counts = element;
    mpz_clears(counts->houses, counts->faced, NULL);
}

static tn_status one_of_counts(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error)
{
    tn_node_counts *counts = element;
    (void)context;
    (void)layer;
    (void)state;
    (void)error;
    mpz_set_ui(counts->houses, 1);
    mpz_set_ui(counts->faced, 1);
    return TN_OK;
}

static void begin_layer(tn_counting_houses *c, uint32_t layer)
{
    tn_houses_layer *at = &c->kind->layers[layer];
    at->kept.all = !c->houses->measures && !c->houses->trays_matter;
    c->nodes += layer % c->stages == 0 ? at->nodes.count : 0;
    c->layer = layer + 1;
}

static tn_status add_counts(void *context, void *sum, const void *element, const tn_walk_edge *at, tn_error *error)
{
    tn_counting_houses *c = context;
    tn_node_counts *to = sum;
    const tn_node_counts *from = element;
    const tn_houses_edge *edge = at->label;
    if (c->layer != at->layer + 1)
        begin_layer(c, at->layer);
    tn_status status = check_nodes(c->houses, c->kind, at->layer + 1, c->nodes + at->to, OTHERS_A_STATE, error);
    if (status != TN_OK)
        return status;
    mpz_mul_ui(c->one, from->houses, edge->ways);
    mpz_addmul_ui(to->houses, c->one, edge->times);
    mpz_mul_ui(c->one, from->faced, edge->ways);
    mpz_addmul_ui(to->faced, c->one, edge->faced);
    return tn_houses_keep_step(c->houses, c->kind, at->layer, at->to, edge, error);
}

static tn_status end_counts(void *context, void *element, const tn_walk_edge *at, tn_error *error)
{
    const tn_counting_houses *c = context;
    const tn_node_counts *from = element;
    const tn_houses_edge *edge = at->label;
    (void)error;
    mpz_addmul_ui(c->kind->houses[at->layer / c->stages - c->houses->low], from->houses, edge->times);
    mpz_addmul_ui(c->kind->faced, from->faced, edge->faced);
    return TN_OK;
}

static const tn_walk_algebra counts = {
    .zero = zero_counts, .clear = clear_counts, .one = one_of_counts, .add = add_counts};

static tn_status count_kind(tn_houses *h, tn_houses_kind *kind, tn_error *error)
{
    tn_counting_houses c = {.houses = h, .kind = kind, .stages = tn_houses_stages(h, kind)};
    kind->houses = tn_integers_new(tn_houses_lengths(h));
    if (!kind->houses)
        return tn_fail_memory(error);
    mpz_init(c.one);
    const tn_key_question how_many = {&counts, end_counts, &c, sizeof(tn_node_counts)};
    tn_status status = tn_houses_go_forward(h, kind, &how_many, error);
    mpz_clear(c.one);
    tn_frontier_entered_forget(&kind->frontier->stages.entered);
    return status;
}

/* ---- scouting */

/* Nodes are scouted before they are counted, which takes many times as long, and what is merged in between leaves
 * fewer, but seldom half of them. So twice as many states in all, or more nodes within a step than three times as many,
 * are a count past the limit, which is said before it begins. */
enum { SCOUTED_A_STATE = 2, OTHERS_A_SCOUTED = 3 };

/* If most steps lead to nodes that are there already, these limits are far away, and so is the end: with more steps than
 * so many for each state that is allowed, it takes too long until it is known whether there are too many. Few steps are
 * always made. */
enum { STEPS_A_STATE = 12, FEW_STEPS = 1000000 };

typedef struct tn_scout {
    const tn_houses *houses;
    tn_houses_kind *kind;
    uint32_t layer; /* 1 and the one that is gone on from; 0: none yet */
    uint64_t nodes; /* of all layers of states so far */
    uint64_t steps; /* from node to node */
    bool any;       /* does a house come to its end? */
} tn_scout;

static tn_status check_steps(const tn_scout *s, tn_error *error)
{
    uint64_t most = (uint64_t)STEPS_A_STATE * s->houses->max_states;
    most = most < FEW_STEPS ? FEW_STEPS : most;
    if (s->steps <= most)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_FRONTIER, "counting these houses takes more than %" PRIu64 " steps from tray to tray",
            most);
    return too_many(s->kind, error);
}

static tn_status come_by(void *context, void *sum, const void *element, const tn_walk_edge *at, tn_error *error)
{
    tn_scout *s = context;
    (void)sum;
    (void)element;
    if (s->layer != at->layer + 1 && at->layer % tn_houses_stages(s->houses, s->kind) == 0)
        s->nodes += s->kind->layers[at->layer].nodes.count;
    s->layer = at->layer + 1;
    s->steps++;
    tn_status status = check_steps(s, error);
    if (status != TN_OK)
        return status;
    uint64_t more = (at->layer + 1) % tn_houses_stages(s->houses, s->kind) == 0 ? s->nodes / SCOUTED_A_STATE : 0;
    return check_nodes(s->houses, s->kind, at->layer + 1, more + at->to, OTHERS_A_SCOUTED, error);
}

static tn_status pass_end(void *context, void *element, const tn_walk_edge *at, tn_error *error)
{
    tn_scout *s = context;
    (void)element;
    (void)at;
    (void)error;
    s->any = true;
    return TN_OK;
}

void tn_houses_layers_clear(const tn_houses *h, tn_houses_kind *kind)
{
    for (uint32_t k = 0; kind->layers && k <= h->high * tn_houses_stages(h, kind); k++) {
        size_t lists = (size_t)kind->layers[k].nodes.count * tn_houses_lengths(h);
        tn_houses_forget_steps(kind, k);
        tn_integers_free(kind->layers[k].ahead, lists);
        for (size_t n = 0; kind->layers[k].by_tray && n < lists; n++)
            tn_integers_free(kind->layers[k].by_tray[n], h->form->schema->tray_count);
        free(kind->layers[k].by_tray);
        for (size_t n = 0; kind->layers[k].best && n < lists; n++)
            tn_value_counts_clear(&kind->layers[k].best[n]);
        free(kind->layers[k].best);
        tn_numbering_clear(&kind->layers[k].nodes);
    }
    free(kind->layers);
    kind->layers = NULL;
}

/* Goes through all states. *any: has the section houses, as far as is known? */
static tn_status walk(const tn_houses *h, tn_houses_kind *kind, bool *any, tn_error *error)
{
    static const tn_walk_algebra meeting = {.add = come_by};
    tn_scout s = {.houses = h, .kind = kind};
    tn_status status = tn_houses_go_forward(h, kind, &(tn_key_question){&meeting, pass_end, &s, 0}, error);
    tn_houses_layers_clear(h, kind);
    *any = s.any;
    return status;
}

/* Goes through all states without their tiles, so that what nothing can tell apart is merged (frontier.c); then, where
 * tiles have prices, with them, so that all costs are known. */
static tn_status scout(const tn_houses *h, tn_houses_kind *kind, const tn_frontier_trays *trays, tn_error *error)
{
    tn_frontier *frontier = kind->frontier;
    bool any = false;
    if (!frontier->tiles.any && !frontier->prices.asked)
        return TN_OK;
    frontier->scouting = true;
    tn_status status = walk(h, kind, &any, error);
    if (status == TN_OK)
        status = tn_frontier_merge(frontier, error);
    if (status == TN_OK && any && frontier->prices.asked)
        status = tn_frontier_prices_check(frontier, trays->stand, error);
    return status == TN_OK && frontier->tiles.any && frontier->prices.items ? walk(h, kind, &any, error) : status;
}

/* Goes through all states without the totals of what clauses compare, to see how much may still be added. */
static tn_status look_ahead(const tn_houses *h, tn_houses_kind *kind, tn_error *error)
{
    bool any;
    if (!tn_frontier_compares(kind->frontier))
        return TN_OK;
    tn_status status = tn_frontier_ahead_begin(kind->frontier, error);
    if (status == TN_OK)
        status = walk(h, kind, &any, error);
    if (status == TN_OK)
        tn_frontier_ahead_end(kind->frontier);
    return status;
}

/* ---- sections */

tn_houses_kind *tn_houses_kind_of(const tn_houses *h, const tn_house *section)
{
    tn_section_key key = tn_sections_key(&h->sections, section);
    for (size_t i = 0; i < h->kind_count; i++)
        if (memcmp(&h->kinds[i].key, &key, sizeof key) == 0)
            return &h->kinds[i];
    return NULL;
}

static tn_status add_kind(tn_houses *h, const tn_house *section, const tn_frontier_trays *trays, tn_error *error)
{
    tn_houses_kind *kind = tn_houses_kind_of(h, section);
    if (kind) {
        kind->sections++;
        return TN_OK;
    }
    if (!tn_array_reserve_from(&h->kinds, &h->kind_room, 4, h->kind_count, 1, sizeof *h->kinds))
        return tn_fail_memory(error);
    kind = &h->kinds[h->kind_count++];
    *kind = (tn_houses_kind){.key = tn_sections_key(&h->sections, section), .sections = 1};
    mpz_init(kind->faced);
    return tn_frontier_new(h->form, h->library, section->shapes, trays, h->low, h->high, h->measures, &h->added,
                           h->without, &kind->frontier, error);
}

/* Costs of these cannot be counted, if they have any houses. */
static bool is_doubtful(const tn_houses_kind *kind, const tn_frontier_trays *trays)
{
    tn_error error;
    return kind->frontier->prices.asked && tn_frontier_prices_check(kind->frontier, trays->stand, &error) != TN_OK;
}

/* A kind, and whether it is doubtful; how many slices it has. */
typedef struct tn_scouted {
    size_t kind;
    uint32_t slices;
    bool doubtful;
} tn_scouted;

/* The doubtful ones first, then those with more slices: if something is an error, or passes the limit, that is said
 * before all others are gone through. */
static int compare_scouted(const void *a, const void *b)
{
    const tn_scouted *p = a, *q = b;
    return p->doubtful != q->doubtful ? (q->doubtful > p->doubtful) - (q->doubtful < p->doubtful)
           : p->slices != q->slices   ? (q->slices > p->slices) - (q->slices < p->slices)
                                      : (p->kind > q->kind) - (p->kind < q->kind);
}

static tn_status scout_kinds(const tn_houses *h, const tn_frontier_trays *trays, tn_error *error)
{
    tn_scouted *order = malloc((h->kind_count + 1) * sizeof *order);
    tn_status status = order ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; order && i < h->kind_count; i++)
        order[i] = (tn_scouted){i, h->kinds[i].frontier->slices.keys.count, is_doubtful(&h->kinds[i], trays)};
    if (order && h->kind_count > 0)
        qsort(order, h->kind_count, sizeof *order, compare_scouted);
    for (size_t i = 0; status == TN_OK && i < h->kind_count; i++)
        status = scout(h, &h->kinds[order[i].kind], trays, error);
    free(order);
    return status;
}

static tn_status look_at_kind(tn_houses *h, tn_houses_kind *kind, tn_error *error)
{
    if (h->measures && !h->aimed && !h->trays_matter)
        return tn_houses_spread_kind(h, kind, error);
    tn_status status = count_kind(h, kind, error);
    return status == TN_OK && h->aimed ? tn_houses_aim_kind(h, kind, error) : status;
}

static tn_status count_sections(tn_houses *h, const tn_frontier_trays *trays, tn_error *error)
{
    tn_house section = {.form = h->form};
    tn_status status = TN_OK;
    for (bool more = true; status == TN_OK && more; more = tn_form_next_section(h->form, section.shapes))
        if (tn_house_section_stands(&section))
            status = add_kind(h, &section, trays, error);
    if (status == TN_OK)
        status = scout_kinds(h, trays, error);
    if (status == TN_OK && h->added.count > 0)
        status = tn_houses_settle(h, error);
    for (size_t i = 0; status == TN_OK && i < h->kind_count; i++) {
        status = look_ahead(h, &h->kinds[i], error);
        if (status == TN_OK)
            status = look_at_kind(h, &h->kinds[i], error);
    }
    return status;
}

/* ---- other clauses */

void tn_other_clauses_set(const tn_house_form *form, const tn_house_library_record *library,
                          const tn_house_clause_record *clauses, uint32_t count, tn_other_clauses *other)
{
    *other = (tn_other_clauses){.module = *form->module, .library = *library, .form = *form};
    other->module.HOUSE_CLAUSE_records = clauses;
    other->module.HOUSE_CLAUSE_count = count;
    other->library.clause_first = 0;
    other->library.clause_count = count;
    other->form.module = &other->module;
}

/* ---- walks */

static tn_status refuse_measure(const char *name, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_WALKS_OF_ALL,
            "`%.80s` asks how one walks through a house: houses are not put in order or spread by that all "
            "together",
            name);
    tn_error_help(error, "those on one plan are gone through: `tartan best`, `tartan pareto` and `tartan count --by` "
                         "with --plan PLAN or '#P'; `tartan sample FILE N --columns` has the values of houses of all "
                         "plans");
    return TN_LIMIT;
}

static tn_status refuse_walks(const char *name, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_WALKS_OF_ALL,
            "`%.80s` asks how one walks through a house: houses on all plans together are not counted by that", name);
    tn_error_help(error,
                  "ask about the houses on one plan (--plan PLAN or '#P'), or about one house (`tartan explain`); "
                  "`tartan sample` and `tartan enumerate` try houses of all plans");
    return TN_LIMIT;
}

tn_status tn_houses_check_walks(const tn_house_form *form, const tn_house_library_record *library,
                                const tn_house_measures *measures, tn_error *error)
{
    const tn_module *module = form->module;
    bool *walks = calloc((size_t)library->clause_count + 1, sizeof *walks);
    tn_status status = walks ? tn_clauses_walking(form, library, walks, error) : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < library->clause_count; i++)
        if (walks[i])
            status = refuse_walks(tn_text(module, module->HOUSE_CLAUSE_records[library->clause_first + i].name), error);
    free(walks);
    for (uint32_t k = 0; status == TN_OK && measures && k < measures->count; k++)
        if (tn_measure_walks(module, &measures->of[k]->of))
            status = refuse_measure(tn_text(module, measures->of[k]->of.name), error);
    return status;
}

/* ---- the whole */

/* The plans of measures are those of a library that knows what its trays add. */
static tn_status weigh_plans(tn_houses *h, tn_error *error)
{
    uint32_t sums[TN_WEIGHED_MAX];
    const char *names[TN_WEIGHED_MAX];
    for (uint32_t k = 0; k < h->measures->count; k++) {
        sums[k] = h->measures->of[k]->of.sum;
        names[k] = tn_text(tn_library_schema(h->plans)->module, h->measures->of[k]->of.name);
    }
    return tn_weighed_of_sums(h->plans, sums, names, h->measures->count, &h->weighed, error);
}

tn_status tn_houses_new(const tn_house_form *form, const tn_house_library_record *library, const tn_library *plans,
                        uint32_t max_states, tn_houses **out, tn_error *error)
{
    const tn_houses_what all = {0};
    return tn_houses_of(form, library, plans, &all, max_states, out, error);
}

enum { MANY_SLICES = 5000 };

tn_status tn_houses_of(const tn_house_form *form, const tn_house_library_record *library, const tn_library *plans,
                       const tn_houses_what *what, uint32_t max_states, tn_houses **out, tn_error *error)
{
    tn_houses *h = *out = calloc(1, sizeof *h);
    if (!h)
        return tn_fail_memory(error);
    *h = (tn_houses){.form = form,
                     .library = library,
                     .plans = plans,
                     .max_states = max_states > 0 ? max_states : TN_HOUSES_STATES_DEFAULT,
                     .low = what->only ? what->length : tn_library_min(plans),
                     .high = what->only ? what->length : tn_library_max(plans),
                     .only = what->only,
                     .measures = what->measures,
                     .many_slices = MANY_SLICES,
                     .trays_matter = what->aim == TN_HOUSES_COMPLETE,
                     .aimed = what->aim == TN_HOUSES_LEAST || what->aim == TN_HOUSES_FRONT,
                     .front = what->aim == TN_HOUSES_FRONT,
                     .wanted = what->wanted,
                     .without = what->without};
    h->high = h->high < h->low ? h->low : h->high;
    tn_houses_units_init(&h->units);
    tn_frontier_trays trays = {0};
    tn_status status = tn_houses_check_walks(form, library, what->measures, error);
    if (status == TN_OK)
        status = tn_sections_begin(form, &h->sections, error);
    if (status == TN_OK)
        status = tn_houses_find_added(h, error);
    if (status == TN_OK && h->measures)
        status = weigh_plans(h, error);
    if (status == TN_OK)
        status = tn_houses_plans_find(h, &trays, error);
    if (status == TN_OK)
        status = count_sections(h, &trays, error);
    if (status == TN_OK && h->aimed)
        status = tn_houses_aim_all(h, error);
    tn_frontier_trays_clear(&trays);
#ifdef TARTAN_CHECK_COUNTS
    if (status == TN_OK && !h->measures && !h->without)
        status = tn_houses_recount(h, TARTAN_CHECK_COUNTS, error);
#endif
    if (status != TN_OK) {
        tn_houses_free(h);
        *out = NULL;
    }
    return status;
}

void tn_houses_free(tn_houses *h)
{
    if (!h)
        return;
    for (size_t i = 0; i < h->kind_count; i++) {
        tn_houses_kind *kind = &h->kinds[i];
        tn_houses_layers_clear(h, kind);
        if (kind->houses)
            tn_integers_free(kind->houses, tn_houses_lengths(h));
        mpz_clear(kind->faced);
        for (uint32_t k = 0; k < kind->beginnings.count; k++)
            tn_integers_free(kind->by_beginning[k], h->form->schema->tray_count);
        free(kind->by_beginning);
        tn_interner_clear(&kind->beginnings);
        tn_value_counts_clear(&kind->spread);
        tn_frontier_free(kind->frontier);
    }
    tn_furnisher_free(h->furnisher);
    tn_houses_plans_clear(h);
    tn_weighed_free(h->weighed);
    tn_value_counts_clear(&h->best);
    tn_houses_units_clear(&h->units);
    tn_houses_added_clear(h);
    free(h->kinds);
    free(h);
}

tn_status tn_houses_furnisher(tn_houses *h, tn_furnisher **furnisher, tn_error *error)
{
    tn_status status = h->furnisher ? TN_OK : tn_furnisher_new(h->form, h->library, &h->furnisher, error);
    *furnisher = h->furnisher;
    return status;
}

/* ---- numbers */

void tn_houses_count(const tn_houses *h, uint32_t length, mpz_t count)
{
    mpz_set_ui(count, 0);
    for (size_t i = 0; i < h->kind_count; i++)
        for (uint32_t k = h->low; k <= h->high; k++)
            if (length == TN_ALL_LENGTHS || length == k)
                mpz_addmul_ui(count, h->kinds[i].houses[k - h->low], h->kinds[i].sections);
}

void tn_houses_faced(const tn_houses *h, mpz_t faced)
{
    mpz_set_ui(faced, 0);
    for (size_t i = 0; i < h->kind_count; i++)
        mpz_addmul_ui(faced, h->kinds[i].faced, h->kinds[i].sections);
}

bool tn_houses_faced_known(const tn_houses *h)
{
    bool known = true;
    for (size_t i = 0; i < h->kind_count; i++)
        known = known && (!h->kinds[i].frontier->prices.items || h->added.count == h->added.measures);
    return known;
}

void tn_houses_of_section(const tn_houses *h, const uint32_t *shapes, mpz_t count)
{
    tn_house section = {.form = h->form};
    memcpy(section.shapes, shapes, h->form->record->choice_count * sizeof *shapes);
    mpz_set_ui(count, 0);
    if (!tn_house_section_stands(&section))
        return;
    const tn_houses_kind *kind = tn_houses_kind_of(h, &section);
    for (uint32_t k = h->low; k <= h->high; k++)
        mpz_add(count, count, kind->houses[k - h->low]);
}

uint64_t tn_houses_states(const tn_houses *h)
{
    uint64_t states = 0;
    for (size_t i = 0; i < h->kind_count; i++)
        for (uint32_t k = 0; k <= h->high; k++)
            states += h->kinds[i].layers[k * tn_houses_stages(h, &h->kinds[i])].nodes.count;
    return states;
}

/* ==== counts are checked
 *
 * Holds a count to the houses themselves: builds for tests do so wherever there are few (TARTAN_CHECK_COUNTS). */

typedef struct recounting {
    const tn_houses *houses;
    tn_house_rules *rules;
    uint64_t kept, dropped; /* dropped: by the interpreter of rules */
} recounting;

static tn_status recount_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    (void)stop;
    recounting *r = context;
    bool kept = false;
    tn_status status = tn_house_rules_start(r->rules, house, error);
    if (status == TN_OK)
        status = tn_house_rules_keep(r->rules, r->houses->library, &kept, error);
    r->kept += status == TN_OK && kept;
    r->dropped += status == TN_OK && !kept;
    return status;
}

static tn_status recount_plans(recounting *r, tn_house_listing *listing, tn_error *error)
{
    const tn_houses *h = r->houses;
    const tn_tray *trays;
    uint32_t length;
    tn_cursor *cursor = NULL;
    mpz_t from, to;
    mpz_inits(from, to, NULL);
    if (!h->only) /* one plan needs no library */
        tn_library_kept(h->plans, TN_ALL_LENGTHS, to);
    tn_status status = h->only ? tn_house_listing_each(listing, h->only, h->low, from, recount_house, r, error)
                               : tn_cursor_new(h->plans, from, to, &cursor, error);
    while (status == TN_OK && cursor && tn_cursor_next(cursor, &trays, &length))
        status = tn_house_listing_each(listing, trays, length, from, recount_house, r, error);
    tn_cursor_free(cursor);
    mpz_clears(from, to, NULL);
    return status;
}

static bool few_plans(const tn_houses *h, uint64_t most)
{
    mpz_t plans;
    mpz_init(plans);
    if (!h->only)
        tn_library_kept(h->plans, TN_ALL_LENGTHS, plans);
    bool few = h->only || mpz_cmp_ui(plans, most) <= 0;
    mpz_clear(plans);
    return few;
}

static tn_status compare(const recounting *r, uint64_t counted, tn_error *error)
{
    const tn_module *module = r->houses->form->module;
    if (r->kept == counted && r->dropped == 0)
        return TN_OK;
    return tn_fail(error, TN_INTERNAL, TN_CODE_NONE,
                   "%llu houses of `%.80s` were counted, and %llu are there when they are gone through (%llu more are "
                   "kept out by its rules): please report this with the file",
                   (unsigned long long)counted, tn_text(module, r->houses->library->name), (unsigned long long)r->kept,
                   (unsigned long long)r->dropped);
}

tn_status tn_houses_recount(const tn_houses *houses, uint64_t most, tn_error *error)
{
    recounting r = {.houses = houses};
    tn_house_listing *listing = NULL;
    mpz_t counted;
    mpz_init(counted);
    tn_houses_count(houses, TN_ALL_LENGTHS, counted);
    bool few = mpz_cmp_ui(counted, most) <= 0 && few_plans(houses, most);
    tn_status status = few ? tn_house_rules_new(houses->form, 0, &r.rules, error) : TN_OK;
    if (few && status == TN_OK)
        status = tn_house_listing_new(houses->form, houses->library, 0, &listing, error);
    if (few && status == TN_OK)
        status = recount_plans(&r, listing, error);
    if (few && status == TN_OK)
        status = compare(&r, mpz_get_ui(counted), error);
    else if (status == TN_LIMIT)
        status = TN_OK; /* more work than one wants */
    tn_house_listing_free(listing);
    tn_house_rules_free(r.rules);
    mpz_clear(counted);
    return status;
}
