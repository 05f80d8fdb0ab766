#include "runtime/plan/rules.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/plan/classes.h"
#include "runtime/plan/lower.h"
#include "runtime/plan/vm.h"

/* One rule's automaton packed for walking. States are premultiplied: a state is the index of its row in `table`, so
 * that a tray costs two loads and an addition. Everything is in the narrowest of 8, 16 and 32 bits that holds it. */
typedef struct tn_packed {
    uint8_t width; /* bytes of a table entry: 1, 2 or 4; 0: the reference engine decides */
    uint32_t states;
    uint32_t columns;
    void *map;       /* [classes]: column */
    void *table;     /* [states][columns]: row index of the next state */
    uint8_t *accept; /* [states * columns]: at row indices */
} tn_packed;

struct tn_rules {
    const tn_schema *schema;
    tn_classes *classes; /* NULL where no rule has an automaton */
    size_t count;
    size_t fallen; /* rules that the reference engine decides */
    size_t max_length;
    uint32_t *functions;
    tn_packed *packed;
    tn_error **fallbacks; /* [count]: NULL, or why */
};

struct tn_matcher {
    const tn_rules *rules;
    tn_plan_vm *vm; /* NULL where no rule needs it */
    uint32_t *plan; /* the plan in classes */
    size_t capacity;
};

/* ---- packing */

static uint8_t packed_width(const tn_dfa *dfa)
{
    uint64_t rows = (uint64_t)dfa->states * dfa->columns;
    return rows <= UINT8_MAX + 1 ? 1 : rows <= UINT16_MAX + 1 ? 2 : 4;
}

static void store(void *array, uint8_t width, size_t index, uint32_t value)
{
    if (width == 1)
        ((uint8_t *)array)[index] = (uint8_t)value;
    else if (width == 2)
        ((uint16_t *)array)[index] = (uint16_t)value;
    else
        ((uint32_t *)array)[index] = value;
}

static tn_status pack(const tn_dfa *dfa, tn_packed *packed, tn_error *error)
{
    size_t transitions = (size_t)dfa->states * dfa->columns;
    packed->states = dfa->states;
    packed->columns = dfa->columns;
    packed->width = packed_width(dfa);
    packed->map = malloc(((size_t)dfa->letters + 1) * packed->width);
    packed->table = malloc((transitions + 1) * packed->width);
    packed->accept = calloc(transitions + 1, 1);
    if (!packed->map || !packed->table || !packed->accept)
        return tn_fail_memory(error);
    for (uint32_t l = 0; l < dfa->letters; l++)
        store(packed->map, packed->width, l, dfa->column[l]);
    for (size_t i = 0; i < transitions; i++)
        store(packed->table, packed->width, i, dfa->delta[i] * dfa->columns);
    for (uint32_t s = 0; s < dfa->states; s++)
        packed->accept[(size_t)s * dfa->columns] = dfa->accept[s];
    return TN_OK;
}

/* ---- making */

static tn_status fall_back(tn_rules *rules, size_t i, const tn_error *why, tn_error *error)
{
    rules->fallbacks[i] = malloc(sizeof **rules->fallbacks);
    if (!rules->fallbacks[i])
        return tn_fail_memory(error);
    *rules->fallbacks[i] = *why;
    rules->fallen++;
    return TN_OK;
}

static tn_status lower_rules(tn_rules *rules, tn_lowering *lowering, tn_engine engine, tn_error *error)
{
    for (size_t i = 0; i < rules->count; i++) {
        tn_dfa *dfa = NULL;
        tn_error why;
        tn_status status = tn_lower(lowering, rules->functions[i], &dfa, &why);
        if (status == TN_OK)
            status = pack(dfa, &rules->packed[i], error);
        else if (status == TN_LIMIT && engine == TN_ENGINE_AUTO)
            status = fall_back(rules, i, &why, error);
        else if (error)
            *error = why;
        tn_dfa_free(dfa);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status compile(tn_rules *rules, const tn_rules_options *options, tn_error *error)
{
    if (options->engine == TN_ENGINE_VM) {
        rules->fallen = rules->count;
        return TN_OK;
    }
    tn_status status = tn_classes_new(rules->schema, rules->functions, rules->count, &rules->classes, error);
    if (status != TN_OK)
        return status;
    tn_lowering *lowering = NULL;
    status = tn_lowering_new(rules->classes, options->max_states, &lowering, error);
    if (status == TN_OK)
        status = lower_rules(rules, lowering, options->engine, error);
    tn_lowering_free(lowering);
    return status;
}

tn_status tn_rules_new(const tn_schema *schema, const uint32_t *functions, size_t count,
                       const tn_rules_options *options, tn_rules **out, tn_error *error)
{
    static const tn_rules_options defaults = {.engine = TN_ENGINE_AUTO};
    tn_rules *rules = calloc(1, sizeof *rules);
    if (!rules)
        return tn_fail_memory(error);
    options = options ? options : &defaults;
    rules->schema = schema;
    rules->max_length = options->max_length;
    rules->functions = calloc(count + 1, sizeof *rules->functions);
    rules->packed = calloc(count + 1, sizeof *rules->packed);
    rules->fallbacks = calloc(count + 1, sizeof *rules->fallbacks);
    tn_status status = TN_OK;
    if (!rules->functions || !rules->packed || !rules->fallbacks) {
        status = tn_fail_memory(error);
    } else {
        rules->count = count;
        if (count > 0)
            memcpy(rules->functions, functions, count * sizeof *functions);
        status = compile(rules, options, error);
    }
    if (status != TN_OK) {
        tn_rules_free(rules);
        return status;
    }
    *out = rules;
    return TN_OK;
}

void tn_rules_free(tn_rules *rules)
{
    if (!rules)
        return;
    for (size_t i = 0; i < rules->count; i++) {
        free(rules->packed[i].map);
        free(rules->packed[i].table);
        free(rules->packed[i].accept);
        free(rules->fallbacks[i]);
    }
    free(rules->packed);
    free(rules->fallbacks);
    free(rules->functions);
    tn_classes_free(rules->classes);
    free(rules);
}

size_t tn_rules_count(const tn_rules *rules)
{
    return rules->count;
}

uint32_t tn_rules_states(const tn_rules *rules, size_t i)
{
    return rules->packed[i].states;
}

const tn_error *tn_rules_fallback(const tn_rules *rules, size_t i)
{
    return rules->fallbacks[i];
}

/* ---- matching */

tn_status tn_matcher_new(const tn_rules *rules, tn_matcher **out, tn_error *error)
{
    tn_matcher *matcher = calloc(1, sizeof *matcher);
    if (!matcher)
        return tn_fail_memory(error);
    matcher->rules = rules;
    if (rules->fallen > 0) {
        tn_status status = tn_plan_vm_new(rules->schema, rules->max_length, &matcher->vm, error);
        if (status != TN_OK) {
            free(matcher);
            return status;
        }
    }
    *out = matcher;
    return TN_OK;
}

void tn_matcher_free(tn_matcher *matcher)
{
    if (!matcher)
        return;
    tn_plan_vm_free(matcher->vm);
    free(matcher->plan);
    free(matcher);
}

#define DEFINE_WALK(NAME, TYPE)                                                                                        \
    static bool NAME(const tn_packed *packed, const uint32_t *plan, size_t length)                                     \
    {                                                                                                                  \
        const TYPE *map = packed->map, *table = packed->table;                                                         \
        size_t row = 0;                                                                                                \
        for (size_t i = 0; i < length; i++)                                                                            \
            row = table[row + map[plan[i]]];                                                                           \
        return packed->accept[row];                                                                                    \
    }
DEFINE_WALK(walk_8, uint8_t)
DEFINE_WALK(walk_16, uint16_t)
DEFINE_WALK(walk_32, uint32_t)
#undef DEFINE_WALK

static tn_status match_one(const tn_matcher *matcher, size_t i, size_t length, bool *matches, tn_error *error)
{
    const tn_packed *packed = &matcher->rules->packed[i];
    switch (packed->width) {
    case 1:
        *matches = walk_8(packed, matcher->plan, length);
        return TN_OK;
    case 2:
        *matches = walk_16(packed, matcher->plan, length);
        return TN_OK;
    case 4:
        *matches = walk_32(packed, matcher->plan, length);
        return TN_OK;
    default:
        return tn_plan_vm_holds(matcher->vm, matcher->rules->functions[i], matches, error);
    }
}

/* The plan in classes; room grows to the longest plan seen. */
static tn_status read_plan(tn_matcher *matcher, const tn_tray *trays, size_t length, tn_error *error)
{
    if (length > matcher->capacity) {
        size_t capacity = length + length / 2 + 64;
        uint32_t *plan = realloc(matcher->plan, capacity * sizeof *plan);
        if (!plan)
            return tn_fail_memory(error);
        matcher->plan = plan;
        matcher->capacity = capacity;
    }
    const uint32_t *classes = matcher->rules->classes->of_tray;
    for (size_t i = 0; i < length; i++)
        matcher->plan[i] = classes[trays[i]];
    return TN_OK;
}

tn_status tn_match(tn_matcher *matcher, const tn_tray *trays, size_t length, uint64_t *bits, tn_error *error)
{
    const tn_rules *rules = matcher->rules;
    tn_status status = TN_OK;
    if (rules->classes)
        status = read_plan(matcher, trays, length, error);
    if (status == TN_OK && rules->fallen > 0)
        status = tn_plan_vm_plan(matcher->vm, trays, length, error);
    memset(bits, 0, (rules->count + 63) / 64 * sizeof *bits);
    for (size_t i = 0; status == TN_OK && i < rules->count; i++) {
        bool matches = false;
        status = match_one(matcher, i, length, &matches, error);
        bits[i / 64] |= (uint64_t)matches << (i % 64);
    }
    return status;
}
