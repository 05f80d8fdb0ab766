/* Compares the measures of two libraries. */
#include "ask/plan/diff.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/moments.h"
#include "runtime/plan/measure/named.h"

/* ---- one side */

/* For people, in the order of the answer. The mean is rounded. */
static tn_status show(const tn_measure_moments *m, tn_amount_unit unit, tn_measured_side *side, tn_error *error)
{
    tn_buffer least = {0}, mean = {0}, most = {0};
    bool none = mpz_sgn(m->plans) == 0;
    bool ok = none ? tn_buffer_printf(&least, "-") && tn_buffer_printf(&mean, "-") && tn_buffer_printf(&most, "-")
                   : tn_amount_write(unit, m->least, &least) && tn_amount_write_about(unit, side->mean, &mean) &&
                         tn_amount_write(unit, m->most, &most);
    char *const texts[] = {least.data, mean.data, most.data};
    tn_status status = ok ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) { /* which takes each of them */
        tn_status added = tn_owneds_add(&side->shown, texts[i], error);
        status = status == TN_OK ? added : status;
    }
    return status;
}

static tn_status set_side(const tn_measure_moments *m, tn_amount_unit unit, tn_measured_side *side, tn_error *error)
{
    side->has_least = side->has_mean = side->has_most = mpz_sgn(m->plans) > 0;
    mpq_set(side->least, m->least);
    mpq_set(side->mean, m->mean);
    mpq_set(side->most, m->most);
    tn_amount_convert(unit, side->least);
    tn_amount_convert(unit, side->mean);
    tn_amount_convert(unit, side->most);
    return show(m, unit, side, error);
}

static tn_status find_side(const tn_ready_library *ready, uint32_t measure, const char **unit_name,
                           tn_measured_side *side, tn_error *error)
{
    const tn_module *module = ready->schema->module;
    tn_weighed *weighed = NULL;
    tn_measure_moments moments;
    tn_amount_unit unit = tn_amount_unit_of(ready->schema, tn_named_measure_power(module, measure));
    *unit_name = tn_amount_unit_name(unit);
    tn_measure_moments_init(&moments);
    tn_status status = tn_weighed_new(ready->library, &measure, 1, &weighed, error);
    if (status == TN_OK)
        status = tn_measure_moments_find(&moments, weighed, error);
    if (status == TN_OK)
        status = set_side(&moments, unit, side, error);
    tn_weighed_free(weighed);
    tn_measure_moments_clear(&moments);
    return status;
}

/* ---- both */

static tn_status add_measure(tn_session *session, const tn_ready_library *const sides[2], const uint32_t measures[2],
                             tn_compared *compared, tn_error *error)
{
    const tn_module *module = sides[0]->schema->module;
    const char *unit_after;
    tn_compared_measure *to = TN_ADD(compared_measure, compared->measures, error);
    if (!to)
        return TN_MEMORY;
    to->name = tn_named_measure(module, measures[0]);
    tn_status status = find_side(sides[0], measures[0], &to->unit, &to->before, error);
    if (status == TN_OK)
        status = find_side(sides[1], measures[1], &unit_after, &to->after, error);
    if (status != TN_LIMIT)
        return status;
    tn_session_note(session, "the measure `%s` is not compared: %s", to->name, error->message);
    tn_message_clear(&tn_message_compared_measure, to);
    compared->measures.count--;
    return TN_OK;
}

tn_status tn_diff_measures(tn_session *session, const tn_ready_library *before, const tn_ready_library *after,
                           tn_compared *compared, tn_error *error)
{
    const tn_ready_library *const sides[2] = {before, after};
    const tn_module *module = before->schema->module;
    tn_status status = TN_OK;
    for (uint32_t i = TN_NO_RECORD; status == TN_OK && tn_named_measure_next(module, before->record, &i);) {
        const uint32_t measures[2] = {
            i, tn_named_measure_find(after->schema->module, after->record, tn_named_measure(module, i))};
        if (measures[1] != TN_NO_RECORD)
            status = add_measure(session, sides, measures, compared, error);
    }
    return status;
}
