/* Finds the plans of a library that are nearest to a plan. */
#include "runtime/plan/library/near.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/library/near_data.h"
#include "runtime/plan/match/lower.h"

#define COMBINE_DEFAULT 4000u   /* edges: about a millisecond of combining */
#define COMBINE_MOST (1u << 20) /* edges: half a second */
#define PATIENCE_DEFAULT 50000u
#define EDGES_PER_NODE 16u
#define CELLS_MAX (64u << 20) /* of a band: plans of thousands of trays */

/* ---- a library made ready */

/* Inserts a clause into those with fewer states. */
static void insert(tn_near_finder *finder, tn_dfa *clause)
{
    size_t i = finder->clause_count++;
    for (; i > 0 && finder->clauses[i - 1]->states > clause->states; i--)
        finder->clauses[i] = finder->clauses[i - 1];
    finder->clauses[i] = clause;
}

static tn_status lower_clause(tn_near_finder *finder, tn_lowering *lowering, const tn_clause_record *clause,
                              tn_error *error)
{
    tn_dfa *matched = NULL, *lets_in = NULL;
    tn_status status = tn_lower(lowering, clause->holds, &matched, error);
    if (status == TN_OK && clause->kind == TN_CLAUSE_PRUNE)
        status = tn_dfa_complement(matched, &lets_in, error);
    else if (status == TN_OK)
        lets_in = tn_dfa_share(matched);
    tn_dfa_free(matched);
    if (status == TN_OK)
        insert(finder, lets_in);
    return status;
}

static tn_status lower_clauses(tn_near_finder *finder, uint32_t max_states, tn_error *error)
{
    const tn_module *module = finder->schema->module;
    const tn_clause_record *clauses = module->CLAUSE_records + finder->record->clause_first;
    size_t count = finder->record->clause_count;
    uint32_t *functions = calloc(count + 1, sizeof *functions);
    tn_lowering *lowering = NULL;
    finder->clauses = calloc(count + 2, sizeof *finder->clauses);
    tn_status status = functions && finder->clauses ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        functions[i] = clauses[i].holds;
    if (status == TN_OK)
        status = tn_classes_new(finder->schema, functions, count, &finder->classes, error);
    if (status == TN_OK)
        status = tn_lowering_new(finder->classes, max_states, &lowering, error);
    if (status == TN_OK)
        tn_lowering_within(lowering, finder->record->trays_max);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = lower_clause(finder, lowering, &clauses[i], error);
    if (status == TN_OK && count == 0) { /* any plan of the library's lengths */
        status = tn_dfa_constant(finder->classes->count, true, &finder->clauses[0], error);
        finder->clause_count = status == TN_OK;
    }
    tn_lowering_free(lowering);
    free(functions);
    return status;
}

tn_status tn_near_finder_new(const tn_schema *schema, uint32_t index, const tn_near_options *options,
                             tn_near_finder **finder, tn_error *error)
{
    tn_status status = tn_schema_listed(schema, "finding nearest plans goes", error);
    if (status != TN_OK)
        return status;
    tn_near_finder *made = calloc(1, sizeof *made);
    if (!made)
        return tn_fail_memory(error);
    made->schema = schema;
    made->record = &schema->module->LIBRARY_records[index];
    made->combine = options && options->combine ? options->combine : COMBINE_DEFAULT;
    made->patience = options && options->patience ? options->patience : PATIENCE_DEFAULT;
    uint32_t max_states = options && options->max_states ? options->max_states : TN_STATES_DEFAULT;
    status = lower_clauses(made, max_states, error);
    if (status == TN_OK)
        status = tn_near_combine(made, error);
    if (status == TN_OK)
        *finder = made;
    else
        tn_near_finder_free(made);
    return status;
}

uint32_t tn_tray_distance(const tn_schema *schema, tn_tray a, tn_tray b)
{
    uint32_t distance = 0;
    for (uint32_t f = 0; f < schema->field_count; f++)
        distance += tn_tray_value(schema, a, f) != tn_tray_value(schema, b, f);
    return distance;
}

/* ---- what changing trays costs */

static void change_row(const tn_near_search *s, uint32_t read, uint32_t *row)
{
    const tn_near_finder *finder = s->finder;
    memset(row, 0xff, finder->joints * sizeof *row);
    for (tn_tray t = 0; t < s->finder->schema->tray_count; t++) {
        uint32_t *least = &row[finder->joint_of[finder->classes->of_tray[t]]];
        uint32_t distance = tn_tray_distance(finder->schema, s->trays[read], t);
        *least = distance < *least ? distance : *least;
    }
}

/* The joint columns of each column of the first part, sorted by what changing to them costs. */
static void sort_row(const tn_near_finder *finder, const uint32_t *change, uint32_t *order)
{
    uint32_t columns = finder->parts[0].live->columns;
    for (uint32_t c = 0; c < columns; c++) {
        uint32_t begin = finder->joint_first[c];
        for (uint32_t j = begin; j < finder->joint_first[c + 1]; j++) {
            uint32_t at = j;
            for (; at > begin && change[order[at - 1]] > change[j]; at--)
                order[at] = order[at - 1];
            order[at] = j;
        }
    }
}

static tn_status make_changes(tn_near_search *s)
{
    size_t joints = s->finder->joints, rows = (size_t)s->band.length;
    free(s->change);
    free(s->by_cost);
    s->change = tn_array_new(tn_size_of(rows, joints) + 1, sizeof *s->change);
    s->by_cost = tn_array_new(tn_size_of(rows + 1, joints) + 1, sizeof *s->by_cost);
    if (!s->change || !s->by_cost)
        return tn_fail_memory(s->error);
    for (uint32_t i = 0; i < s->band.length; i++) {
        uint32_t *row = s->change + i * joints, same = 0;
        while (s->trays[same] != s->trays[i])
            same++;
        if (same < i)
            memcpy(row, s->change + same * joints, joints * sizeof *row);
        else
            change_row(s, i, row);
        sort_row(s->finder, row, s->by_cost + i * joints);
    }
    for (uint32_t j = 0; j < joints; j++) /* past the plan's end every tray is an added one */
        s->by_cost[rows * joints + j] = j;
    return TN_OK;
}

/* ---- nodes and edges */

static tn_status add_node(tn_near_search *s, uint32_t number, uint32_t tuple, size_t cell)
{
    if (!tn_array_reserve_from(&s->nodes, &s->node_capacity, 1024, number, 1, sizeof *s->nodes))
        return tn_fail_memory(s->error);
    s->nodes[number] = (tn_near_node){.tuple = tuple, .cell = (uint32_t)cell, .cost = TN_FAR, .next = s->first[cell]};
    s->first[cell] = number;
    return TN_OK;
}

static tn_status add_edge(tn_near_search *s, uint32_t from, uint32_t to, uint32_t cost)
{
    if (!tn_array_reserve_from(&s->edges, &s->edge_capacity, 4096, s->edge_count, 1, sizeof *s->edges))
        return tn_fail_memory(s->error);
    s->edges[s->edge_count++] = (tn_near_edge){from, to, cost};
    return TN_OK;
}

static tn_status too_many(const tn_near_search *s)
{
    return tn_fail(s->error, TN_LIMIT, E_MATCHING_WORK,
                   "the search for the nearest kept plan visits more than the limit of %u places", TN_NEAR_NODES_MAX);
}

/* More nodes or edges than may be: TN_LIMIT. */
static tn_status check_room(const tn_near_search *s)
{
    uint32_t most = s->finder->combined ? TN_NEAR_NODES_MAX : s->finder->patience;
    if (s->numbers.count <= most && s->edge_count <= (size_t)EDGES_PER_NODE * most)
        return TN_OK;
    return too_many(s);
}

/* The least that is still to come, as far as the parts know one by one. */
static uint32_t to_come(const tn_near_search *s, const uint32_t *states, uint32_t read, uint32_t written, size_t cell)
{
    const tn_near_finder *finder = s->finder;
    uint32_t most = tn_near_to_come(&s->band, read, written);
    for (size_t k = 0; k < finder->part_count; k++) {
        const tn_near_part *part = &finder->parts[k];
        if (part->togo && part->togo[cell * part->live->states + states[k]] > most)
            most = part->togo[cell * part->live->states + states[k]];
    }
    return most;
}

/* From node `from` (TN_FAR: the start) to a tuple in a cell, at such a cost from the start. */
static tn_status reach(tn_near_search *s, uint32_t from, const uint32_t *states, uint32_t read, uint32_t written,
                       uint32_t cost, uint32_t step)
{
    size_t cell = tn_near_cell(&s->band, read, written);
    if (cell == SIZE_MAX)
        return TN_OK;
    uint32_t rest = to_come(s, states, read, written, cell);
    if (rest == TN_FAR)
        return TN_OK;
    if (cost + rest > s->limit) {
        s->beyond = cost + rest < s->beyond ? cost + rest : s->beyond;
        return TN_OK;
    }
    uint32_t tuple = tn_intern(&s->tuples, states, s->finder->part_count), before = s->numbers.count;
    uint32_t number = tuple == UINT32_MAX ? UINT32_MAX : tn_number(&s->numbers, tn_near_key(s, tuple, cell));
    if (number == UINT32_MAX)
        return tn_fail_memory(s->error);
    tn_status status = check_room(s);
    if (status == TN_OK && number == before)
        status = add_node(s, number, tuple, cell);
    if (status == TN_OK && cost < s->nodes[number].cost)
        s->nodes[number].cost = cost;
    return status == TN_OK && from != TN_FAR ? add_edge(s, from, number, step) : status;
}

/* The states after a tray of a joint column; false where some part has no way on. */
static bool follow(const tn_near_finder *finder, const uint32_t *states, uint32_t joint, uint32_t *next)
{
    const uint32_t *labels = finder->joint_label + joint * finder->part_count;
    for (size_t k = 0; k < finder->part_count; k++) {
        const tn_near_part *part = &finder->parts[k];
        next[k] = part->delta[(size_t)states[k] * part->live->columns + labels[k]];
        if (next[k] == TN_NO_STATE)
            return false;
    }
    return true;
}

/* Goes on from a node in every way. `states` and `next` have room for a tuple. */
static tn_status expand(tn_near_search *s, uint32_t number, uint32_t read, uint32_t written, uint32_t *states,
                        uint32_t *next)
{
    const tn_near_finder *finder = s->finder;
    const tn_sparse *live = finder->parts[0].live;
    uint32_t cost = s->nodes[number].cost, fields = s->band.fields, joints = finder->joints;
    bool reads = read < s->band.length;
    size_t size;
    tn_status status = TN_OK;
    memcpy(states, tn_interned(&s->tuples, s->nodes[number].tuple, &size), finder->part_count * sizeof *states);
    if (reads)
        status = reach(s, number, states, read + 1, written, cost + fields, fields);
    const uint32_t *change = reads ? s->change + (size_t)read * joints : NULL;
    const uint32_t *order = s->by_cost + (size_t)read * joints;
    for (size_t e = live->first[states[0]]; status == TN_OK && e < live->first[states[0] + 1]; e++) {
        uint32_t end = finder->joint_first[live->label[e] + 1];
        for (uint32_t i = finder->joint_first[live->label[e]]; status == TN_OK && i < end; i++) {
            uint32_t joint = order[i];
            bool dear = !reads || cost + change[joint] > s->limit;
            if (dear && cost + fields > s->limit) {
                uint32_t least = reads && change[joint] < fields ? change[joint] : fields;
                s->beyond = cost + least < s->beyond ? cost + least : s->beyond;
                break; /* those after it cost no less */
            }
            if (!follow(finder, states, joint, next))
                continue;
            if (reads)
                status = reach(s, number, next, read + 1, written + 1, cost + change[joint], change[joint]);
            if (status == TN_OK)
                status = reach(s, number, next, read, written + 1, cost + fields, fields);
        }
    }
    return status;
}

/* ---- sweeping: cell after cell, each after those that lead to it */

static void forget(tn_near_search *s)
{
    tn_interner_clear(&s->tuples);
    tn_numbering_clear(&s->numbers);
    s->edge_count = 0;
    s->best = s->beyond = TN_FAR;
    memset(s->first, 0xff, tn_near_cells(&s->band) * sizeof *s->first); /* TN_FAR */
}

static bool is_goal(const tn_near_search *s, const tn_near_node *node, uint32_t read, uint32_t written)
{
    size_t size;
    const uint32_t *states = tn_interned(&s->tuples, node->tuple, &size);
    bool accepts = read == s->band.length && written >= s->band.min;
    for (size_t k = 0; accepts && k < s->finder->part_count; k++)
        accepts = s->finder->parts[k].live->accept[states[k]];
    return accepts;
}

static tn_status sweep_cell(tn_near_search *s, uint32_t read, uint32_t written, uint32_t *states, uint32_t *next)
{
    tn_status status = TN_OK;
    size_t cell = tn_near_cell(&s->band, read, written);
    for (uint32_t n = s->first[cell]; status == TN_OK && n != TN_FAR; n = s->nodes[n].next) {
        if (is_goal(s, &s->nodes[n], read, written) && s->nodes[n].cost < s->best)
            s->best = s->nodes[n].cost;
        status = expand(s, n, read, written, states, next);
    }
    return status;
}

/* Reaches every node through which a path of at most the limit may go. */
static tn_status sweep(tn_near_search *s)
{
    size_t parts = s->finder->part_count;
    uint32_t *states = calloc(2 * parts + 1, sizeof *states);
    if (!states)
        return tn_fail_memory(s->error);
    forget(s);
    tn_status status = reach(s, TN_FAR, states, 0, 0, 0, 0);
    for (uint32_t read = 0; read <= s->band.length; read++) {
        uint32_t low = read > s->band.width ? read - s->band.width : 0, high = read + s->band.width;
        for (uint32_t written = low; status == TN_OK && written <= high && written <= s->band.max; written++)
            status = sweep_cell(s, read, written, states, states + parts);
    }
    free(states);
    return status;
}

/* The shortest path within the band, by raising the limit to the shortest that was left out. */
static tn_status search_band(tn_near_search *s)
{
    if (tn_near_cells(&s->band) > CELLS_MAX)
        return too_many(s);
    free(s->first);
    s->first = malloc(tn_near_cells(&s->band) * sizeof *s->first);
    if (!s->first)
        return tn_fail_memory(s->error);
    tn_status status = tn_near_lead(s->finder, &s->band, s->change, s->error);
    s->limit = 0;
    do {
        if (status == TN_OK)
            status = sweep(s);
        s->limit = s->beyond;
    } while (status == TN_OK && s->best == TN_FAR && s->beyond != TN_FAR);
    return status;
}

static bool lets_nothing_in(const tn_near_finder *finder)
{
    for (size_t k = 0; k < finder->part_count; k++)
        if (finder->parts[k].live->states == 0)
            return true;
    return finder->record->trays_min > finder->record->trays_max;
}

/* In bands that grow until a path out of the band would cost more. */
static tn_status search_all(tn_near_search *s)
{
    tn_near_band *band = &s->band;
    uint32_t widest = band->length > band->max ? band->length : band->max;
    uint32_t width = band->length < band->min ? band->min - band->length : 0;
    width = band->length > band->max ? band->length - band->max : width;
    s->best = TN_FAR;
    if (lets_nothing_in(s->finder))
        return TN_OK;
    for (tn_status status = make_changes(s);; width = 2 * width + 1) {
        band->width = width < widest ? width : widest;
        if (status == TN_OK)
            status = search_band(s);
        if (status != TN_OK || band->width == widest ||
            (s->best != TN_FAR && s->best < (uint64_t)band->fields * (band->width + 1)))
            return status;
    }
}

static void search_clear(tn_near_search *s)
{
    tn_interner_clear(&s->tuples);
    tn_numbering_clear(&s->numbers);
    free(s->change);
    free(s->by_cost);
    free(s->nodes);
    free(s->edges);
    free(s->first);
}

tn_status tn_near_find(tn_near_finder *finder, const tn_tray *trays, size_t length, size_t most, tn_near *near,
                       tn_error *error)
{
    *near = (tn_near){0};
    tn_near_search s = {.finder = finder,
                        .trays = trays,
                        .band = {.length = (uint32_t)length,
                                 .min = finder->record->trays_min,
                                 .max = finder->record->trays_max,
                                 .fields = finder->schema->field_count},
                        .error = error};
    tn_status status = search_all(&s);
    while (status == TN_LIMIT && !finder->combined && finder->combine < COMBINE_MOST) {
        finder->combine *= 8;
        status = tn_near_combine(finder, error);
        if (status == TN_OK && finder->combine >= COMBINE_MOST)
            finder->combined = true; /* as far as it goes */
        if (status == TN_OK)
            status = search_all(&s);
    }
    if (status == TN_OK && s.best != TN_FAR) {
        near->cost = s.best;
        status = tn_near_collect(&s, most, near);
    }
    search_clear(&s);
    return status;
}

void tn_near_clear(tn_near *near)
{
    for (size_t i = 0; i < near->count; i++)
        free(near->plans[i].trays);
    free(near->plans);
    *near = (tn_near){0};
}
