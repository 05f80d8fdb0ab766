/* The hash of what a library means: the schema as plans are written in it, the lengths, and the set of plans kept.
 *
 * The set is hashed by a polynomial with a term for each plan: the product of variables, one for each tray and number
 * of trays to come. Different sets are different polynomials, of a degree of at most the plans' length, and such differ
 * at a random point but for (length / modulus) of all points (Schwartz 1980, Zippel 1979). The value at two fixed,
 * random-looking points modulo 2^61 - 1 is found like a count, over any automaton of the library: neither the wording
 * nor the order of the rules shows, nor how the automaton was built. Weights, of libraries that have any, go in as they
 * are written: in any order, but other words for the same trays are another weight. So does, of trays that stand for
 * plans, for how many each does. Where trays are not listed, a tray's variable is a product of one for each of its
 * values, which a diagram adds up for many trays at once. All numbers go into the hash in little-endian. */
#include <stdlib.h>
#include <string.h>

#define XXH_INLINE_ALL
#include "runtime/base/random.h"
#include "runtime/plan/library/hash_text.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/match/same.h"
#include "runtime/plan/schema/sum.h"

__extension__ typedef unsigned __int128 wide;

#define PRIME ((UINT64_C(1) << 61) - 1)
#define POINTS 2
#define SUMMANDS_MAX 32 /* products of numbers below PRIME that a wide one holds, with room */

static void add_number(XXH3_state_t *hash, uint64_t number)
{
    uint8_t bytes[8];
    for (int i = 0; i < 8; i++)
        bytes[i] = (uint8_t)(number >> (8 * i));
    XXH3_128bits_update(hash, bytes, sizeof bytes);
}

static void add_text(XXH3_state_t *hash, const tn_module *module, tn_string text)
{
    const char *bytes = tn_text(module, text);
    add_number(hash, strlen(bytes));
    XXH3_128bits_update(hash, bytes, strlen(bytes));
}

static void add_schema(XXH3_state_t *hash, const tn_schema *schema)
{
    add_number(hash, schema->field_count);
    for (uint32_t f = 0; f < schema->field_count; f++) {
        add_text(hash, schema->module, schema->fields[f].name);
        add_number(hash, schema->fields[f].kind);
        add_number(hash, schema->fields[f].value_count);
        for (uint32_t v = schema->value_start[f]; v < schema->value_start[f + 1]; v++) {
            add_text(hash, schema->module, schema->values[v].spelling);
            add_number(hash, (uint64_t)schema->values[v].length);
        }
    }
    add_number(hash, schema->tray_count);
    if (schema->legal) {
        for (size_t i = 0; i < schema->legal->nodes.words_used; i++)
            add_number(hash, schema->legal->nodes.words[i]);
        return;
    }
    XXH3_128bits_update(hash, schema->tray_values, (size_t)schema->tray_count * schema->field_count);
    for (tn_tray t = 0; tn_schema_of_plans(schema) && t < schema->tray_count; t++)
        add_text(hash, schema->module, schema->module->TRAY_PLANS_records[schema->tray_plans[t]].plans);
}

static uint64_t reduce(wide number)
{
    uint64_t low = (uint64_t)number & PRIME;
    wide high = number >> 61; /* below 2^67 */
    uint64_t sum = low + ((uint64_t)high & PRIME) + (uint64_t)(high >> 61);
    sum = (sum & PRIME) + (sum >> 61);
    return sum >= PRIME ? sum - PRIME : sum;
}

/* Where trays are not listed: values behind those of add_plans, one for each label below each node, and one for each
 * letter. */
static uint64_t *class_room(const tn_library *library)
{
    return library->hash_room + library->kept->columns + 2 * (uint64_t)library->kept->states;
}

uint64_t tn_library_hash_words(const tn_library *library)
{
    uint64_t words = library->kept->columns + 2 * (uint64_t)library->kept->states + 1;
    if (!library->schema->legal)
        return words;
    const tn_labelling *kinds = tn_kinds_of(&library->classes->kinds);
    return words + kinds->below_first[kinds->nodes.count] + kinds->labels;
}

/* Adds to each letter's sum what stands below a value: `variable` times what is below what follows it. */
static void weigh_below(const tn_labelling *kinds, const uint64_t *below, uint32_t follow, bool last, uint64_t variable,
                        uint64_t *sums)
{
    if (last) {
        sums[follow] = (sums[follow] + variable) % PRIME;
        return;
    }
    for (size_t k = kinds->below_first[follow]; k < kinds->below_first[follow + 1]; k++) {
        uint64_t *sum = &sums[kinds->below[k].label];
        *sum = reduce((wide)below[k] * variable + *sum);
    }
}

/* The same as weigh_columns, where trays are not listed. */
static void weigh_classes(const tn_library *library, unsigned point, uint32_t left, uint64_t *weights)
{
    const tn_labelling *kinds = tn_kinds_of(&library->classes->kinds);
    uint64_t *below = class_room(library), *sums = below + kinds->below_first[kinds->nodes.count];
    memset(sums, 0, kinds->labels * sizeof *sums);
    for (uint32_t n = 0; n < kinds->nodes.count; n++) {
        const uint32_t *follow = tn_labelling_follow(kinds, n);
        uint32_t field = follow[-1];
        for (uint32_t v = 0; v < kinds->values[field]; v++)
            if (follow[v] != TN_UNLABELLED)
                weigh_below(kinds, below, follow[v], field + 1 == kinds->fields,
                            tn_random64(point, left, (uint64_t)field << 32 | v) % PRIME, sums);
        for (size_t k = kinds->below_first[n]; k < kinds->below_first[n + 1]; k++) {
            below[k] = sums[kinds->below[k].label];
            sums[kinds->below[k].label] = 0;
        }
    }
    for (size_t k = kinds->below_first[kinds->root]; k < kinds->below_first[kinds->root + 1]; k++) {
        uint64_t *weight = &weights[library->kept->column[kinds->below[k].label]];
        *weight = (*weight + below[k]) % PRIME;
    }
}

/* weights := the sum of the variables of each column's trays, with `left` trays to come. */
static void weigh_columns(const tn_library *library, unsigned point, uint32_t left, uint64_t *weights)
{
    memset(weights, 0, library->kept->columns * sizeof *weights);
    if (library->schema->legal) {
        weigh_classes(library, point, left, weights);
        return;
    }
    for (tn_tray t = 0; t < library->schema->tray_count; t++) {
        uint64_t *weight = &weights[library->tray_column[t]];
        *weight = (*weight + tn_random64(point, left, t) % PRIME) % PRIME;
    }
}

/* The value of what is kept from a state with one tray more than `values` are for. */
static uint64_t value_of(const tn_library *library, uint32_t state, const uint64_t *weights, const uint64_t *values)
{
    const tn_sparse *live = library->live;
    wide sum = 0;
    size_t summands = 0;
    for (size_t e = live->first[state]; e < live->first[state + 1]; e++) {
        sum += (wide)weights[live->label[e]] * values[live->target[e]];
        if (++summands % SUMMANDS_MAX == 0)
            sum = reduce(sum);
    }
    return reduce(sum);
}

/* Adds the value of the plans of each length. */
static void add_plans(XXH3_state_t *hash, const tn_library *library, unsigned point)
{
    uint64_t *weights = library->hash_room, *values = weights + library->kept->columns;
    uint64_t *next = values + library->kept->states;
    uint32_t states = library->live->states;
    for (uint32_t s = 0; s < states; s++)
        values[s] = library->live->accept[s];
    for (uint32_t length = 0;; length++) {
        if (length >= library->min)
            add_number(hash, states > 0 ? values[0] : 0);
        if (length >= library->max)
            return;
        weigh_columns(library, point, length, weights);
        for (uint32_t s = 0; s < states; s++)
            next[s] = tn_library_alive(library, length + 1, s) ? value_of(library, s, weights, values) : 0;
        uint64_t *swap = values;
        values = next;
        next = swap;
    }
}

/* Adds a weight, or a preference, to the others, in whatever order they come: a number and the function of what it is
 * about. */
static tn_status add_leaning(tn_library *library, tn_section kind, tn_string number, uint32_t function, tn_error *error)
{
    const tn_module *module = library->schema->module;
    uint64_t code[2];
    XXH3_state_t hash;
    tn_status status = tn_code_hash(module, function, code, error);
    if (status != TN_OK)
        return status;
    XXH3_128bits_reset(&hash);
    add_number(&hash, kind);
    add_text(&hash, module, number);
    add_number(&hash, code[0]);
    add_number(&hash, code[1]);
    XXH128_hash_t found = XXH3_128bits_digest(&hash);
    library->leanings[0] += found.low64;
    library->leanings[1] += found.high64;
    return TN_OK;
}

tn_status tn_library_hash_leanings(tn_library *library, tn_error *error)
{
    const tn_library_record *record = library->record;
    const tn_module *module = library->schema->module;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < record->weight_count; i++) {
        const tn_weight_record *weight = &module->WEIGHT_records[record->weight_first + i];
        const tn_sum_record *sum = &module->SUM_records[weight->sum];
        status =
            add_leaning(library, TN_SECTION_WEIGHT, weight->factor, module->TERM_records[sum->term_first].part, error);
    }
    for (uint32_t i = 0; status == TN_OK && i < record->preference_count; i++) {
        const tn_term_record *term = tn_preferred_term(module, record, i);
        status = add_leaning(library, TN_SECTION_PREFERENCE, term->factor, term->part, error);
    }
    return status;
}

void tn_library_hash(const tn_library *library, char hex[33])
{
    XXH3_state_t hash;
    XXH3_128bits_reset(&hash);
    add_schema(&hash, library->schema);
    add_number(&hash, library->min);
    add_number(&hash, library->max);
    pthread_mutex_lock(&library->late->lock);
    for (unsigned point = 0; point < POINTS; point++)
        add_plans(&hash, library, point);
    pthread_mutex_unlock(&library->late->lock);
    if (library->record && library->record->weight_count + library->record->preference_count > 0) {
        add_number(&hash, library->leanings[0]);
        add_number(&hash, library->leanings[1]);
    }
    tn_hash_text(XXH3_128bits_digest(&hash), hex);
}
