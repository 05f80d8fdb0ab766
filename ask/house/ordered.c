/* Puts houses in order by measures, in whichever way they can be. */
#include "ask/house/ordered.h"

#include "driver/plan/library.h"

tn_status tn_ordered_begin(tn_ordered_houses *o, tn_numbered *n, const tn_plan *plan, const tn_ordered_wish *wishes,
                           uint32_t count)
{
    const tn_module *module = n->form.module;
    tn_error error;
    *o = (tn_ordered_houses){.n = n, .plan = plan};
    mpz_init(o->count);
    for (uint32_t k = 0; k < count; k++) {
        uint32_t measure;
        tn_status status = tn_house_measure_choose(n->session->opened, wishes[k].measure, n->record->form, &measure);
        if (status != TN_OK)
            return status;
        tn_house_measured of = tn_house_measured_of(module, measure);
        if (tn_house_weights_new(&n->form, of, &o->weights[k], &error) != TN_OK)
            return tn_session_fail(n->session, &error);
        o->units[k] = tn_amount_unit_of(n->schema, module->SUM_records[of.sum].power);
        o->measures.of[k] = o->weights[k];
        o->measures.most[k] = wishes[k].most;
    }
    o->measures.count = count;
    return TN_OK;
}

void tn_ordered_clear(tn_ordered_houses *o)
{
    if (!o->n)
        return;
    tn_houses_free(o->houses);
    tn_walked_clear(&o->walked);
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        tn_house_weights_free(o->weights[k]);
    mpz_clear(o->count);
    *o = (tn_ordered_houses){0};
}

const char *tn_ordered_name(const tn_ordered_houses *o, uint32_t k)
{
    return tn_text(o->n->form.module, o->weights[k]->of.name);
}

/* Those that were found before stay if there are no more. */
static tn_status find_together(tn_ordered_houses *o, tn_houses_aim aim, uint64_t wanted, tn_error *error)
{
    tn_houses *found = NULL;
    tn_houses_what what = {.measures = o->measures.count ? &o->measures : NULL, .aim = aim, .wanted = wanted};
    if (o->plan) {
        what.only = o->plan->trays;
        what.length = (uint32_t)o->plan->length;
    }
    tn_status status = tn_houses_of(&o->n->form, o->n->record, o->n->plans, &what, o->n->max_states, &found, error);
    if (status != TN_OK)
        return status;
    tn_houses_free(o->houses);
    o->houses = found;
    return TN_OK;
}

tn_status tn_ordered_find(tn_ordered_houses *o, tn_houses_aim aim, uint64_t wanted, tn_error *error)
{
    if (aim == TN_HOUSES_COMPLETE && tn_walked_asked(o->n, &o->measures))
        return TN_OK; /* whoever completes plans goes through them (completed.h) */
    tn_session_begins(o->n->session, "looking for the best");
    tn_status status = o->plan && tn_walked_asked(o->n, &o->measures)
                           ? tn_walked_find(o->n, o->plan, &o->measures, aim == TN_HOUSES_FRONT, &o->walked, error)
                           : find_together(o, aim, wanted, error);
    tn_session_ends(o->n->session);
    return status;
}

size_t tn_ordered_points(const tn_ordered_houses *o)
{
    return o->houses ? tn_houses_points(o->houses) : o->walked.point_count;
}

void tn_ordered_come(tn_ordered_houses *o, size_t point)
{
    o->point = point;
    if (o->houses)
        tn_houses_point(o->houses, point, o->values, o->count);
    else
        mpz_set_ui(o->count, (unsigned long)(o->walked.points[point + 1] - o->walked.points[point]));
}

void tn_ordered_value(const tn_ordered_houses *o, uint32_t k, mpq_t value)
{
    if (!o->houses) {
        mpq_set(value, o->walked.items[o->walked.points[o->point]].values[k]);
        return;
    }
    mpq_set_si(value, o->values[k], 1);
    mpq_mul(value, value, o->weights[k]->shown);
}

tn_status tn_ordered_each(tn_ordered_houses *o, tn_house_alike alike, tn_house_each *each, void *context,
                          tn_error *error)
{
    return o->houses ? tn_houses_point_each(o->houses, o->point, alike, each, context, error)
                     : tn_walked_each(&o->walked, o->point, each, context, error);
}
