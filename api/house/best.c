/* The C interface to the best houses of a library by measures. */
#include <stdlib.h>

#include "api/house/houses.h"
#include "ask/house/ordered.h"
#include "runtime/plan/measure/amount.h"

/* The houses in order, and where the best of them go. */
typedef struct search {
    tn_ordered_houses by;
    tartan_houses *made;
    size_t wanted;
} search;

static tn_status write_values(const search *s, tn_api_listed *item, tn_error *error)
{
    bool written = true;
    mpq_t value;
    mpq_init(value);
    for (uint32_t k = 0; written && k < s->by.measures.count; k++) {
        tn_buffer text = {0};
        tn_ordered_value(&s->by, k, value);
        written = tn_amount_write_exact(s->by.units[k], value, &text);
        item->values[k] = text.data;
    }
    mpq_clear(value);
    return written ? TN_OK : tn_fail_memory(error);
}

static tn_status add_best(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    search *s = context;
    tn_api_listed *added;
    tn_status status = tn_numbered_judge(s->by.n, house, error);
    if (status == TN_OK)
        status = tn_api_houses_add(s->made, house, &added, error);
    *stop = s->made->count == s->wanted;
    return status == TN_OK ? write_values(s, added, error) : status;
}

static tn_status find_houses(search *s, tn_error *error)
{
    tn_status status = tn_ordered_find(&s->by, TN_HOUSES_LEAST, s->wanted, error);
    for (size_t i = 0; status == TN_OK && s->made->count < s->wanted && i < tn_ordered_points(&s->by); i++) {
        tn_ordered_come(&s->by, i);
        status = tn_ordered_each(&s->by, TN_ALIKE_NOTHING, add_best, s, error);
    }
    return status;
}

/* What is wrong is said. */
static tn_status find_best(search *s, const tartan_on_plan *plan, const tartan_wish *wishes, uint32_t count)
{
    tartan_house_library *library = s->made->library;
    tn_numbered *n = &library->numbered;
    tn_ordered_wish by[TN_WEIGHED_MAX];
    tn_error error;
    const tn_plan *on;
    if (tn_api_houses_on(library, plan, &on, &error) != TN_OK)
        return tn_session_fail(n->session, &error);
    for (uint32_t k = 0; k < count; k++)
        by[k] = (tn_ordered_wish){wishes[k].measure, wishes[k].most};
    tn_status status = tn_ordered_begin(&s->by, n, on, by, count);
    if (status == TN_OK && s->wanted > 0) {
        status = find_houses(s, &error);
        if (status != TN_OK)
            tn_session_fail(n->session, &error);
    }
    tn_ordered_clear(&s->by);
    return status;
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
    search s = {.made = tn_api_houses_new(library), .wanted = count};
    if (!s.made) {
        tn_error found;
        return tn_api_houses_end(library, tn_fail_memory(&found), &found, error);
    }
    s.made->wishes = (uint32_t)wish_count;
    status = tn_api_houses_said(library, find_best(&s, plan, wishes, (uint32_t)wish_count), error);
    return tn_api_houses_give(s.made, status, houses);
}
