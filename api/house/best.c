/* The C interface to the best houses of a library by measures. */
#include "runtime/house/count/houses.h"

#include <stdlib.h>

#include "api/house/houses.h"
#include "driver/plan/library.h"
#include "runtime/house/rank/rank.h"
#include "runtime/plan/measure/amount.h"

/* The measures made ready, what was found by them, and where the houses go. */
typedef struct search {
    tn_numbered *n;
    tn_house_weights *weights[TN_WEIGHED_MAX];
    tn_house_measures measures;
    tn_amount_unit units[TN_WEIGHED_MAX];
    tn_houses *houses;
    int64_t values[TN_WEIGHED_MAX]; /* of the point at hand */
    tartan_houses *made;
    size_t wanted;
} search;

/* What is wrong is said. */
static tn_status find_measures(search *s, const tartan_wish *wishes)
{
    tn_numbered *n = s->n;
    const tn_module *module = n->form.module;
    tn_error error;
    for (uint32_t k = 0; k < s->measures.count; k++) {
        uint32_t measure;
        tn_status status = tn_house_measure_choose(n->session->opened, wishes[k].measure, n->record->form, &measure);
        if (status != TN_OK)
            return status;
        tn_house_measured of = tn_house_measured_of(module, measure);
        if (tn_house_weights_new(&n->form, of, &s->weights[k], &error) != TN_OK)
            return tn_session_fail(n->session, &error);
        s->units[k] = tn_amount_unit_of(n->schema, module->SUM_records[of.sum].power);
        s->measures.of[k] = s->weights[k];
        s->measures.most[k] = wishes[k].most;
    }
    return TN_OK;
}

static tn_status write_values(const search *s, tn_api_listed *item, tn_error *error)
{
    bool written = true;
    mpq_t value;
    mpq_init(value);
    for (uint32_t k = 0; written && k < s->measures.count; k++) {
        tn_buffer text = {0};
        mpq_set_si(value, s->values[k], 1);
        mpq_mul(value, value, s->weights[k]->shown);
        written = tn_amount_write_exact(s->units[k], value, &text);
        item->values[k] = text.data;
    }
    mpq_clear(value);
    return written ? TN_OK : tn_fail_memory(error);
}

static tn_status add_best(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    search *s = context;
    tn_api_listed *added;
    tn_status status = tn_numbered_judge(s->n, house, error);
    if (status == TN_OK)
        status = tn_api_houses_add(s->made, house, &added, error);
    *stop = s->made->count == s->wanted;
    return status == TN_OK ? write_values(s, added, error) : status;
}

static tn_status find_houses(search *s, const tn_plan *on, tn_error *error)
{
    tn_numbered *n = s->n;
    mpz_t count;
    tn_houses_what what = {.measures = &s->measures, .aim = TN_HOUSES_LEAST, .wanted = s->wanted};
    if (on) {
        what.only = on->trays;
        what.length = (uint32_t)on->length;
    }
    tn_status status = tn_numbered_of(n, &what, &s->houses, error);
    mpz_init(count);
    for (size_t i = 0; status == TN_OK && s->made->count < s->wanted && i < tn_houses_points(s->houses); i++) {
        tn_houses_point(s->houses, i, s->values, count);
        status = tn_houses_point_each(s->houses, i, TN_ALIKE_NOTHING, add_best, s, error);
    }
    mpz_clear(count);
    return status;
}

/* What is wrong is said. */
static tn_status find_best(search *s, const tartan_on_plan *plan, const tartan_wish *wishes)
{
    tn_error error;
    const tn_plan *of;
    tn_status status = find_measures(s, wishes);
    if (status != TN_OK)
        return status;
    status = tn_api_houses_on(s->made->library, plan, &of, &error);
    if (status == TN_OK && s->wanted > 0)
        status = find_houses(s, of, &error);
    tn_houses_free(s->houses);
    return status == TN_OK ? TN_OK : tn_session_fail(s->n->session, &error);
}

static tartan_status check_wishes(const tartan_wish *wishes, size_t count, tartan_error *error)
{
    if (count == 0 || count > TN_WEIGHED_MAX)
        return tn_api_refuse(error, TARTAN_INVALID, "%zu wishes are given, and 1 to %d are needed", count,
                             TN_WEIGHED_MAX);
    for (size_t i = 0; i < count; i++)
        if (!wishes || !wishes[i].measure)
            return tn_api_missing(error, "measure");
    return TARTAN_OK;
}

tartan_status tartan_house_best(tartan_house_library *library, const tartan_on_plan *plan, const tartan_wish *wishes,
                                size_t wish_count, size_t count, const tartan_watch *watch, tartan_houses **houses,
                                tartan_error *error)
{
    if (!houses)
        return tn_api_missing(error, "room for the houses");
    if (count > TARTAN_HOUSES_MAX)
        return tn_api_refuse(error, TARTAN_LIMIT, "a list has at most %d houses", TARTAN_HOUSES_MAX);
    tartan_status status = check_wishes(wishes, wish_count, error);
    if (status == TARTAN_OK)
        status = tn_api_houses_begin(library, watch, error);
    if (status != TARTAN_OK)
        return status;
    search s = {.n = &library->numbered,
                .measures = {.count = (uint32_t)wish_count},
                .made = tn_api_houses_new(library),
                .wanted = count};
    if (!s.made) {
        tn_error found;
        return tn_api_houses_end(library, tn_fail_memory(&found), &found, error);
    }
    s.made->wishes = (uint32_t)wish_count;
    status = tn_api_houses_said(library, find_best(&s, plan, wishes), error);
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        tn_house_weights_free(s.weights[k]);
    return tn_api_houses_give(s.made, status, houses);
}
