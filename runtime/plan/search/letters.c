/* The trays of a plan as gates. */
#include "runtime/plan/search/letters.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"

static uint32_t values_of(const tn_schema *schema, uint32_t field)
{
    return schema->value_start[field + 1] - schema->value_start[field];
}

/* ---- places */

static void make_place(const tn_letters *letters, uint32_t place)
{
    const tn_schema *schema = letters->schema;
    tn_circuit *circuit = letters->circuit;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        tn_signal *up_to = letters->up_to + (size_t)place * schema->value_count + schema->value_start[f];
        tn_signal *is = letters->is + (size_t)place * schema->value_count + schema->value_start[f];
        uint32_t count = values_of(schema, f);
        for (uint32_t v = 0; v < count; v++) {
            up_to[v] = v + 1 < count ? tn_circuit_input(circuit) : TN_SIGNAL_TRUE;
            is[v] = v > 0 ? tn_circuit_and(circuit, up_to[v], tn_signal_not(up_to[v - 1])) : up_to[v];
            if (v > 0 && v + 1 < count)
                tn_circuit_assert_any(circuit, (tn_signal[]){tn_signal_not(up_to[v - 1]), up_to[v]}, 2);
        }
    }
    for (uint32_t i = 0; i < schema->record->forbid_count; i++)
        tn_circuit_assert(circuit, tn_signal_not(tn_letters_meet(letters, place, schema->record->forbid_first + i)));
}

static tn_status make_room(tn_letters *letters, tn_circuit *circuit, const tn_schema *schema, uint32_t length,
                           tn_error *error)
{
    size_t count = tn_size_of(length, schema->value_count);
    *letters = (tn_letters){.circuit = circuit, .schema = schema, .length = length};
    letters->up_to = tn_array_new((uint64_t)count + 1, sizeof *letters->up_to);
    letters->is = tn_array_new((uint64_t)count + 1, sizeof *letters->is);
    return letters->up_to && letters->is ? TN_OK : tn_fail_memory(error);
}

tn_status tn_letters_make(tn_letters *letters, tn_circuit *circuit, const tn_schema *schema, uint32_t length,
                          tn_error *error)
{
    tn_status status = make_room(letters, circuit, schema, length, error);
    for (uint32_t place = 0; status == TN_OK && place < length; place++)
        make_place(letters, place);
    return status == TN_OK ? tn_circuit_status(circuit, error) : status;
}

/* Values in the same order are the same gates, and so clauses of the same meaning are, too. */
static void map_field(const tn_letters *letters, const tn_letters *of, uint32_t place, uint32_t field, uint32_t other,
                      const uint8_t *values)
{
    const tn_schema *schema = letters->schema;
    tn_signal some[TN_FIELD_VALUES_MAX];
    tn_signal *up_to = letters->up_to + (size_t)place * schema->value_count + schema->value_start[other];
    tn_signal *is = letters->is + (size_t)place * schema->value_count + schema->value_start[other];
    uint32_t count = values_of(schema, other);
    bool in_order = true;
    for (uint32_t v = 0; v < count; v++) {
        is[values[v]] = tn_letters_is(of, place, field, v);
        in_order = in_order && values[v] == v;
    }
    for (uint32_t v = 0; v < count; v++) {
        for (uint32_t i = 0; i <= v; i++)
            some[i] = is[i];
        up_to[v] = in_order ? tn_letters_up_to(of, place, field, v) : tn_circuit_any(letters->circuit, some, v + 1);
    }
}

tn_status tn_letters_map(tn_letters *letters, const tn_letters *of, const tn_schema *schema, const uint32_t *fields,
                         const uint8_t *values, tn_error *error)
{
    tn_status status = make_room(letters, of->circuit, schema, of->length, error);
    for (uint32_t place = 0; status == TN_OK && place < of->length; place++)
        for (uint32_t f = 0; f < of->schema->field_count; f++)
            map_field(letters, of, place, f, fields[f], values + of->schema->value_start[f]);
    return status == TN_OK ? tn_circuit_status(of->circuit, error) : status;
}

void tn_letters_clear(tn_letters *letters)
{
    free(letters->up_to);
    free(letters->is);
    *letters = (tn_letters){0};
}

/* ---- what trays are */

static bool allows(const tn_module *module, uint32_t spec, uint32_t value)
{
    return tn_spec_word(module, spec, value / 64) >> (value % 64) & 1;
}

tn_signal tn_letters_meet(const tn_letters *letters, uint32_t place, uint32_t spec)
{
    const tn_schema *schema = letters->schema;
    tn_signal values[TN_FIELD_VALUES_MAX], all = TN_SIGNAL_TRUE;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        uint32_t count = values_of(schema, f), allowed = 0;
        for (uint32_t v = 0; v < count; v++)
            if (allows(schema->module, spec, schema->value_start[f] + v))
                values[allowed++] = tn_letters_is(letters, place, f, v);
        if (allowed < count)
            all = tn_circuit_and(letters->circuit, all, tn_circuit_any(letters->circuit, values, allowed));
    }
    return all;
}

tn_signal tn_letters_alike(const tn_letters *letters, uint32_t a, uint32_t b, uint32_t field)
{
    uint32_t count = values_of(letters->schema, field);
    tn_signal all = TN_SIGNAL_TRUE;
    for (uint32_t v = 0; v + 1 < count; v++) {
        tn_signal one = tn_letters_up_to(letters, a, field, v), other = tn_letters_up_to(letters, b, field, v);
        tn_signal alike = tn_circuit_choose(letters->circuit, one, other, tn_signal_not(other));
        all = tn_circuit_and(letters->circuit, all, alike);
    }
    return all;
}

static uint8_t value_at(const tn_letters *letters, uint32_t place, uint32_t field)
{
    uint32_t count = values_of(letters->schema, field), v = 0;
    while (v + 1 < count && !tn_circuit_value(letters->circuit, tn_letters_up_to(letters, place, field, v)))
        v++;
    return (uint8_t)v;
}

void tn_letters_read(const tn_letters *letters, tn_tray *trays)
{
    const tn_schema *schema = letters->schema;
    for (uint32_t place = 0; place < letters->length; place++) {
        uint8_t values[UINT8_MAX + 1] = {0};
        for (uint32_t f = 0; f < schema->field_count; f++)
            values[f] = value_at(letters, place, f);
        trays[place] = tn_schema_tray(schema, values);
    }
}

/* ---- what they count */

static int compare_counts(const void *left, const void *right)
{
    int64_t a = *(const int64_t *)left, b = *(const int64_t *)right;
    return (a > b) - (a < b);
}

static uint32_t count_number(const tn_tray_counts *counts, int64_t count)
{
    const int64_t *found = bsearch(&count, counts->counts, counts->count, sizeof *counts->counts, compare_counts);
    return (uint32_t)(found - counts->counts);
}

static bool list_counts(tn_tray_counts *counts, const tn_schema *schema, const int64_t *of_tray)
{
    counts->counts = tn_array_new((uint64_t)schema->tray_count + 1, sizeof *counts->counts);
    if (!counts->counts)
        return false;
    memcpy(counts->counts, of_tray, schema->tray_count * sizeof *of_tray);
    qsort(counts->counts, schema->tray_count, sizeof *counts->counts, compare_counts);
    for (uint32_t t = 0; t < schema->tray_count; t++)
        if (t == 0 || counts->counts[t] != counts->counts[counts->count - 1])
            counts->counts[counts->count++] = counts->counts[t];
    return true;
}

/* Groups of trays that have the values of the first fields in common: the first tray of each, and what follows. */
typedef struct tray_groups {
    uint32_t *first, *follows; /* [count] */
    uint32_t count;
} tray_groups;

/* What the groups' field leads to, from group `from` on; *to: one past the last group with the same fields before it.
 */
static bool push_field(const tn_schema *schema, const tray_groups *groups, uint32_t field, uint32_t from, uint32_t *to,
                       tn_key *key)
{
    const uint8_t *begin = schema->tray_values + (size_t)groups->first[from] * schema->field_count;
    key->size = 0;
    bool good = tn_key_push(key, field);
    for (uint32_t v = 0; good && v < values_of(schema, field); v++)
        good = tn_key_push(key, TN_NO_TRAY);
    for (*to = from; good && *to < groups->count; ++*to) {
        const uint8_t *values = schema->tray_values + (size_t)groups->first[*to] * schema->field_count;
        if (memcmp(begin, values, field) != 0)
            break;
        key->data[1 + values[field]] = groups->follows[*to];
    }
    return good;
}

/* What a field leads to always, or TN_NO_TRAY. */
static uint32_t leads_always(const tn_key *key)
{
    uint32_t one = TN_NO_TRAY;
    for (size_t i = 1; i < key->size; i++) {
        if (one != TN_NO_TRAY && key->data[i] != TN_NO_TRAY && key->data[i] != one)
            return TN_NO_TRAY;
        one = key->data[i] != TN_NO_TRAY ? key->data[i] : one;
    }
    return one;
}

/* Joins the groups that differ in a field alone. */
static bool join_field(const tn_tray_counts *counts, const tn_schema *schema, uint32_t field, tray_groups *groups,
                       tn_interner *nodes, tn_key *key)
{
    uint32_t joined = 0, end;
    for (uint32_t i = 0; i < groups->count; i = end) {
        if (!push_field(schema, groups, field, i, &end, key))
            return false;
        uint32_t follows = leads_always(key);
        if (follows == TN_NO_TRAY) {
            uint32_t node = tn_intern(nodes, key->data, key->size);
            if (node == UINT32_MAX)
                return false;
            follows = counts->count + node;
        }
        groups->first[joined] = groups->first[i];
        groups->follows[joined++] = follows;
    }
    groups->count = joined;
    return true;
}

/* From the last field to the first. */
static bool join_fields(tn_tray_counts *counts, const tn_schema *schema, const int64_t *of_tray, tray_groups *groups,
                        tn_interner *nodes)
{
    tn_key key = {0};
    groups->count = schema->tray_count;
    for (uint32_t t = 0; t < schema->tray_count; t++) {
        groups->first[t] = t;
        groups->follows[t] = count_number(counts, of_tray[t]);
    }
    bool good = true;
    for (uint32_t f = schema->field_count; good && f-- > 0;)
        good = join_field(counts, schema, f, groups, nodes, &key);
    free(key.data);
    counts->root = groups->count > 0 ? groups->follows[0] : 0;
    return good;
}

tn_status tn_tray_counts_make(tn_tray_counts *counts, const tn_schema *schema, const int64_t *of_tray, tn_error *error)
{
    tn_interner nodes = {0};
    *counts = (tn_tray_counts){0};
    tn_status status = tn_schema_listed(schema, "searching plans by sums goes", error);
    if (status != TN_OK)
        return status;
    tray_groups groups = {tn_array_new((uint64_t)schema->tray_count + 1, sizeof *groups.first),
                          tn_array_new((uint64_t)schema->tray_count + 1, sizeof *groups.follows), 0};
    bool good = groups.first && groups.follows && list_counts(counts, schema, of_tray) &&
                join_fields(counts, schema, of_tray, &groups, &nodes);
    free(groups.first);
    free(groups.follows);
    counts->nodes = nodes.words;
    counts->first = nodes.first;
    counts->node_count = nodes.count;
    nodes.words = NULL;
    nodes.first = NULL;
    tn_interner_clear(&nodes);
    return good ? TN_OK : tn_fail_memory(error);
}

void tn_tray_counts_clear(tn_tray_counts *counts)
{
    free(counts->counts);
    free(counts->nodes);
    free(counts->first);
    *counts = (tn_tray_counts){0};
}

/* Passes on by which values a node is reached to what it leads to. */
static void pass_on(const tn_letters *letters, uint32_t place, const tn_tray_counts *counts, uint32_t node,
                    tn_signal *reached)
{
    const uint32_t *words = counts->nodes + counts->first[node];
    uint32_t field = words[0], values = values_of(letters->schema, field);
    for (uint32_t v = 0; v < values; v++) {
        uint32_t to = words[1 + v];
        if (to == TN_NO_TRAY)
            continue;
        tn_signal by =
            tn_circuit_and(letters->circuit, reached[counts->count + node], tn_letters_is(letters, place, field, v));
        reached[to] = tn_circuit_or(letters->circuit, reached[to], by);
    }
}

tn_status tn_letters_count(const tn_letters *letters, uint32_t place, const tn_tray_counts *counts, tn_signal *gates,
                           tn_error *error)
{
    tn_signal *reached = calloc((size_t)counts->count + counts->node_count + 1, sizeof *reached);
    if (!reached)
        return tn_fail_memory(error);
    reached[counts->root] = TN_SIGNAL_TRUE;
    for (uint32_t node = counts->node_count; node-- > 0;)
        pass_on(letters, place, counts, node, reached);
    memcpy(gates, reached, counts->count * sizeof *gates);
    free(reached);
    return TN_OK;
}
