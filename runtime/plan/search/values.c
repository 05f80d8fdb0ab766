/* The values of a measure on plans that are searched. */
#include <stdlib.h>

#include "runtime/plan/search/search_data.h"

tn_status tn_search_values_new(tn_search_values *v, tn_plan_search *search, uint32_t sum, bool most, tn_error *error)
{
    *v = (tn_search_values){.search = search, .index = sum, .most = most};
    return tn_sum_new(search->schema, sum, &v->sum, error);
}

void tn_search_values_clear(tn_search_values *v)
{
    tn_adder_clear(&v->values);
    tn_sum_free(v->sum);
    free(v->gates);
    *v = (tn_search_values){0};
}

/* Without gates for values that the length's plans cannot have. */
tn_status tn_search_values_open(tn_search_values *v, tn_error *error)
{
    tn_signal has = TN_SIGNAL_TRUE;
    tn_adder_clear(&v->values);
    v->values.circuit = v->search->at.circuit;
    tn_status status = tn_unrolled_value(v->search->at.unrolled, v->sum, &v->values, &has, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0, j = v->values.sum_count; !v->most && i + 1 < j--; i++) {
        tn_adder_choice other = v->values.sums[i];
        v->values.sums[i] = v->values.sums[j];
        v->values.sums[j] = other;
    }
    tn_circuit_assert(v->search->at.circuit, has);
    free(v->gates);
    v->gates = malloc((v->values.sum_count + 1) * sizeof *v->gates);
    return v->gates ? TN_OK : tn_fail_memory(error);
}

tn_signal tn_search_values_from(tn_search_values *v, size_t from)
{
    size_t count = 0;
    for (size_t i = from; i < v->values.sum_count; i++)
        v->gates[count++] = v->values.sums[i].gate;
    return tn_circuit_any(v->search->at.circuit, v->gates, count);
}

void tn_search_value(const tn_search_values *v, size_t at, mpq_t value)
{
    mpq_set_si(value, v->values.sums[at].adds, 1);
    mpq_mul(value, value, v->sum->unit);
}

tn_status tn_search_values_find(const tn_search_values *v, size_t from, size_t *at, tn_error *error)
{
    bool has = false;
    mpq_t found, other;
    mpq_inits(found, other, NULL);
    tn_status status = tn_plan_vm_value(v->search->vm, v->index, found, &has, error);
    for (*at = from; status == TN_OK && has && *at < v->values.sum_count; ++*at) {
        tn_search_value(v, *at, other);
        if (mpq_equal(found, other))
            break;
    }
    if (status == TN_OK && (!has || *at == v->values.sum_count))
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a plan was found that has not the value that is asked for");
    mpq_clears(found, other, NULL);
    return status;
}

bool tn_search_is_better(const tn_search_values *v, const mpq_t one, const mpq_t other)
{
    int order = mpq_cmp(one, other);
    return v->most ? order > 0 : order < 0;
}

size_t tn_search_better_than(const tn_search_values *v, const mpq_t value)
{
    size_t i = 0;
    mpq_t other;
    mpq_init(other);
    for (; i < v->values.sum_count; i++) {
        tn_search_value(v, i, other);
        if (tn_search_is_better(v, other, value))
            break;
    }
    mpq_clear(other);
    return i;
}
