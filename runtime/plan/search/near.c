/* The kept plans nearest to a plan: the table of edit distances (Wagner and Fischer: The string-to-string correction
 * problem, 1974) as gates, one for each place of both plans and each cost, that so much turns the one beginning into
 * the other. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/plan/library/near.h"
#include "runtime/plan/search/search_data.h"

#define CELLS_MAX (UINT64_C(1) << 24) /* of a table */
#define UNKNOWN UINT32_MAX

/* Distances of plans of the length that is open. */
typedef struct distances {
    tn_plan_search *search;
    const tn_tray *trays;
    uint32_t length; /* of the plan */
    uint32_t fields;
    size_t cells;
    tn_signal *layers; /* [fields + 1][cells]: of the last costs: turned at that cost or a lower one */
    tn_signal *differ; /* [cells][fields + 1]: at most so many fields differ; UNKNOWN: not made yet */
} distances;

static size_t cell(const distances *d, uint32_t read, uint32_t written)
{
    return (size_t)read * (d->search->at.trays + 1) + written;
}

static void clear(distances *d)
{
    free(d->layers);
    free(d->differ);
    *d = (distances){0};
}

static tn_status begin(distances *d, tn_plan_search *search, const tn_tray *trays, size_t length, tn_error *error)
{
    uint32_t fields = search->schema->field_count;
    uint64_t cells = ((uint64_t)length + 1) * ((uint64_t)search->at.trays + 1);
    *d = (distances){.search = search, .trays = trays, .length = (uint32_t)length, .fields = fields};
    if (cells > CELLS_MAX || cells * (fields + 1) > CELLS_MAX)
        return tn_fail(error, TN_LIMIT, E_SEARCH_TOO_LARGE,
                       "the distances of plans of %u trays from one of %zu pass the limit of %llu", search->at.trays,
                       length, (unsigned long long)CELLS_MAX);
    d->cells = (size_t)cells;
    d->layers = tn_array_new(cells * (fields + 1), sizeof *d->layers);
    d->differ = tn_array_new(cells * (fields + 1), sizeof *d->differ);
    if (!d->layers || !d->differ)
        return tn_fail_memory(error);
    for (size_t i = 0; i < d->cells * (fields + 1); i++)
        d->differ[i] = UNKNOWN;
    tn_circuit_go_on(search->at.circuit);
    return TN_OK;
}

/* The gates that at most 0, 1, 2 ... fields of a tray differ from one of the plan. */
static const tn_signal *differing(distances *d, uint32_t read, uint32_t written)
{
    tn_signal *gates = d->differ + cell(d, read, written) * (d->fields + 1);
    tn_circuit *circuit = d->search->at.circuit;
    if (gates[0] != UNKNOWN)
        return gates;
    for (uint32_t n = 0; n <= d->fields; n++)
        gates[n] = TN_SIGNAL_TRUE;
    for (uint32_t f = 0; f < d->fields; f++) {
        uint32_t value = tn_tray_value(d->search->schema, d->trays[read], f);
        tn_signal same = tn_letters_is(&d->search->at.letters, written, f, value);
        for (uint32_t n = d->fields + 1; n-- > 0;)
            gates[n] = n == 0 ? tn_circuit_and(circuit, gates[0], same)
                              : tn_circuit_choose(circuit, same, gates[n], gates[n - 1]);
    }
    return gates;
}

static tn_signal *layer(const distances *d, uint32_t cost)
{
    return d->layers + (cost % (d->fields + 1)) * d->cells;
}

/* The plan's first `read` trays are turned into the first `written` ones at this cost, or a lower one. */
static tn_signal turned(distances *d, uint32_t read, uint32_t written, uint32_t cost)
{
    tn_circuit *circuit = d->search->at.circuit;
    tn_signal gate = read == 0 && written == 0 ? TN_SIGNAL_TRUE : TN_SIGNAL_FALSE;
    if (cost >= d->fields) {
        const tn_signal *before = layer(d, cost - d->fields);
        if (read > 0)
            gate = tn_circuit_or(circuit, gate, before[cell(d, read - 1, written)]);
        if (written > 0)
            gate = tn_circuit_or(circuit, gate, before[cell(d, read, written - 1)]);
    }
    for (uint32_t n = 0; read > 0 && written > 0 && n <= d->fields && n <= cost; n++) {
        tn_signal before = layer(d, cost - n)[cell(d, read - 1, written - 1)];
        if (before != TN_SIGNAL_FALSE)
            gate =
                tn_circuit_or(circuit, gate, tn_circuit_and(circuit, before, differing(d, read - 1, written - 1)[n]));
    }
    return gate;
}

/* Makes the gates of the next cost, from 0 on: *gate: the plan is no farther. */
static tn_status next_cost(distances *d, uint32_t cost, tn_signal *gate, tn_error *error)
{
    uint32_t trays = d->search->at.trays;
    tn_signal *to = layer(d, cost);
    for (uint32_t i = 0; i <= d->length; i++)
        for (uint32_t j = 0; j <= trays; j++) {
            uint64_t apart = i > j ? i - j : j - i;
            to[cell(d, i, j)] = apart * d->fields > cost ? TN_SIGNAL_FALSE : turned(d, i, j, cost);
        }
    *gate = to[cell(d, d->length, trays)];
    return tn_circuit_status(d->search->at.circuit, error);
}

tn_status tn_search_around_gate(tn_plan_search *search, const tn_search_around *around, tn_signal *gate,
                                tn_error *error)
{
    distances d;
    tn_status status = begin(&d, search, around->trays, around->length, error);
    for (uint32_t cost = 0; status == TN_OK && cost <= around->distance; cost++)
        status = next_cost(&d, cost, gate, error);
    clear(&d);
    return status;
}

/* ---- the least distance */

/* The same for one plan, the search's. */
static tn_status measure(const distances *d, uint32_t *distance, tn_error *error)
{
    const tn_plan_search *search = d->search;
    uint32_t trays = search->at.trays;
    uint32_t *costs = tn_array_new((uint64_t)trays + 1, sizeof *costs);
    if (!costs)
        return tn_fail_memory(error);
    for (uint32_t j = 0; j <= trays; j++)
        costs[j] = j * d->fields;
    for (uint32_t i = 1; i <= d->length; i++) {
        uint32_t diagonal = costs[0];
        costs[0] = i * d->fields;
        for (uint32_t j = 1; j <= trays; j++) {
            uint32_t change = diagonal + tn_tray_distance(search->schema, d->trays[i - 1], search->plan[j - 1]);
            uint32_t least = (costs[j] < costs[j - 1] ? costs[j] : costs[j - 1]) + d->fields;
            diagonal = costs[j];
            costs[j] = change < least ? change : least;
        }
    }
    *distance = costs[trays];
    free(costs);
    return TN_OK;
}

/* Lowers *distance to the least of the plans of a length. */
static tn_status nearest_of_length(distances *d, uint32_t *distance, tn_error *error)
{
    bool found = false;
    uint32_t most = UINT32_MAX;
    tn_signal gate;
    tn_status status = tn_search_find(d->search, 0, &found, error);
    if (status == TN_OK && found)
        status = measure(d, &most, error);
    if (status != TN_OK || !found)
        return status;
    *distance = most < *distance ? most : *distance;
    found = false;
    for (uint32_t cost = 0; status == TN_OK && !found && cost < *distance; cost++) {
        status = next_cost(d, cost, &gate, error);
        if (status != TN_OK || gate == TN_SIGNAL_FALSE)
            continue;
        d->search->at.assumed[0] = gate;
        status = tn_search_find(d->search, 1, &found, error);
        if (status == TN_OK && found)
            *distance = cost;
    }
    return status;
}

static tn_status look_at_length(tn_plan_search *search, const tn_tray *trays, size_t length, uint32_t other,
                                uint32_t *distance, tn_error *error)
{
    distances d;
    tn_status status = tn_search_open(search, other, true, error);
    if (status != TN_OK)
        return status;
    status = begin(&d, search, trays, length, error);
    if (status == TN_OK)
        status = nearest_of_length(&d, distance, error);
    clear(&d);
    return status;
}

/* Of all lengths, the nearest first. UINT32_MAX: there is no plan. */
static tn_status find_distance(tn_plan_search *search, const tn_tray *trays, size_t length, uint32_t *distance,
                               tn_error *error)
{
    uint32_t low = search->options.trays_min, high = search->options.trays_max, fields = search->schema->field_count;
    tn_status status = TN_OK;
    *distance = UINT32_MAX;
    uint64_t below = length > low ? length - low : 0, above = high > length ? high - length : 0;
    uint64_t last = below > above ? below : above;
    for (uint64_t apart = 0; status == TN_OK && apart <= last && apart * fields < *distance; apart++) {
        if (length >= apart + low && length - apart <= high)
            status = look_at_length(search, trays, length, (uint32_t)(length - apart), distance, error);
        if (status == TN_OK && apart > 0 && length + apart >= low && length + apart <= high)
            status = look_at_length(search, trays, length, (uint32_t)(length + apart), distance, error);
    }
    return status;
}

/* Only lengths that may be so near are looked at. */
static void look_around(tn_plan_search *search, const tn_search_around *around)
{
    tn_search_options *o = &search->options;
    uint32_t apart = around->distance / search->schema->field_count;
    uint32_t low = around->length > apart ? around->length - apart : 0;
    uint64_t high = (uint64_t)around->length + apart;
    search->around = around;
    o->trays_min = low > o->trays_min ? low : o->trays_min;
    o->trays_max = high < o->trays_max ? (uint32_t)high : o->trays_max;
    search->next_trays = o->trays_min;
    tn_search_close(search);
}

tn_status tn_plan_search_near(tn_plan_search *search, const tn_tray *trays, size_t length, size_t most,
                              tn_searched_plans *plans, uint32_t *distance, bool *more, tn_error *error)
{
    tn_search_around around = {.trays = trays, .length = (uint32_t)length};
    const tn_tray *found = trays;
    *more = false;
    tn_status status = find_distance(search, trays, length, &around.distance, error);
    *distance = around.distance;
    if (status != TN_OK || around.distance == UINT32_MAX)
        return status;
    look_around(search, &around);
    while (status == TN_OK && found && !*more) {
        uint32_t trays_found;
        status = tn_plan_search_next(search, &found, &trays_found, error);
        if (status != TN_OK || !found)
            break;
        *more = plans->count == most;
        if (!*more)
            status = tn_searched_add(plans, found, trays_found, error);
    }
    search->around = NULL;
    return status;
}
