/* Goes through the houses on the plans that complete an open plan. */
#include "ask/house/completed.h"

#include <inttypes.h>
#include <stdlib.h>

#include "runtime/base/integers.h"

typedef struct completing {
    const tn_house_measures *measures;
    tn_open_pattern pattern;
    tn_completions *found;
    mpq_t *best; /* [choices], with a measure */
    bool *has;   /* [choices]: is there a best? */
    uint32_t plans;
    uint32_t placed[TN_PATTERN_MAX]; /* the tray of the plan that each written one is */
} completing;

static size_t choices(const completing *c)
{
    return (size_t)c->found->trays * c->found->values;
}

/* Places the written trays in the plan, from the so manyeth tray on; there is at most one way. */
static bool place(completing *c, tn_open_machine at, const tn_tray *trays, uint32_t tray, uint32_t length)
{
    tn_open_way ways[2];
    if (tray == length)
        return at.placed == c->pattern.items;
    size_t count = tn_open_ways(&c->pattern, at, c->pattern.fits[trays[tray]], ways);
    for (size_t i = 0; i < count; i++) {
        if (ways[i].places)
            c->placed[at.placed] = tray;
        if (place(c, ways[i].to, trays, tray + 1, length))
            return true;
    }
    return false;
}

static void take_best(const completing *c, size_t choice, mpq_srcptr value)
{
    int order = c->has[choice] ? mpq_cmp(value, c->best[choice]) : 0;
    if (!c->has[choice] || (c->measures->most[0] ? order > 0 : order < 0))
        mpq_set(c->best[choice], value);
    c->has[choice] = true;
}

/* best: the best value of the houses on the plan, or NULL. */
static void add_plan(const completing *c, const tn_tray *trays, const mpz_t houses, mpq_srcptr best)
{
    const tn_schema *schema = c->pattern.schema;
    mpz_add(c->found->plans, c->found->plans, houses);
    for (uint32_t t = 0; t < c->found->trays; t++)
        for (uint32_t f = 0; f < schema->field_count; f++) {
            uint32_t value = tn_tray_value(schema, trays[c->placed[t]], f);
            size_t choice = (size_t)t * c->found->values + schema->value_start[f] + value;
            mpz_add(c->found->counts[choice], c->found->counts[choice], houses);
            if (best)
                take_best(c, choice, best);
        }
}

static tn_status too_many(const char *what, uint64_t most, const char *help, tn_error *error)
{
    tn_status status = tn_fail(
        error, TN_LIMIT, E_VARIANTS,
        "walks are found house by house, and the open plan is completed by more than %" PRIu64 " %s", most, what);
    tn_error_help(error, "%s", help);
    return status;
}

/* Its houses one by one, with their values. */
static tn_status measure_plan(tn_numbered *n, const completing *c, const tn_plan *plan, tn_error *error)
{
    uint64_t most = tn_walked_most(n);
    tn_walked_houses walked;
    mpz_t houses;
    mpz_init(houses);
    tn_status status = tn_walked_find(n, plan, c->measures, false, &walked, error);
    if (status == TN_OK) {
        mpz_set_ui(houses, (unsigned long)(walked.count + walked.without));
        if (mpz_sgn(houses) > 0)
            add_plan(c, plan->trays, houses, walked.count > 0 ? walked.items[0].values[0] : NULL);
        if (mpz_cmp_ui(c->found->plans, most) > 0)
            status = too_many("houses", most, "write more of its trays, or allow more, with --max-houses N", error);
    }
    tn_walked_clear(&walked);
    mpz_clear(houses);
    return status;
}

static tn_status look_at_plan(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                              tn_error *error)
{
    completing *c = context;
    (void)stop;
    if (!place(c, tn_open_start(&c->pattern), trays, 0, length))
        return TN_OK;
    if (c->plans++ == TN_HOUSE_PLANS_FEW)
        return too_many("plans", TN_HOUSE_PLANS_FEW, "write more of its trays", error);
    if (c->measures->count > 0) {
        tn_plan plan = {.length = length, .trays = malloc(((size_t)length + 1) * sizeof *plan.trays)};
        if (!plan.trays)
            return tn_fail_memory(error);
        for (uint32_t i = 0; i < length; i++)
            plan.trays[i] = trays[i];
        tn_status status = measure_plan(n, c, &plan, error);
        free(plan.trays);
        return status;
    }
    mpz_t houses;
    mpz_init(houses);
    tn_status status = tn_numbered_houses_on(n, trays, length, houses, error);
    if (status == TN_OK)
        add_plan(c, trays, houses, NULL);
    mpz_clear(houses);
    return status;
}

static tn_status make_room(completing *c, tn_error *error)
{
    size_t count = choices(c);
    c->found->counts = tn_integers_new(count);
    if (!c->found->counts)
        return tn_fail_memory(error);
    if (c->measures->count == 0)
        return TN_OK;
    c->found->best = malloc((count + 1) * sizeof *c->found->best);
    c->has = calloc(count + 1, sizeof *c->has);
    c->best = malloc((count + 1) * sizeof *c->best);
    if (!c->found->best || !c->has || !c->best)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        mpq_init(c->best[i]);
    return TN_OK;
}

/* In steps: the greatest number that all of them are multiples of. */
static tn_status give_best(const completing *c, mpq_t step, tn_error *error)
{
    tn_status status = TN_OK;
    mpq_t part;
    mpq_init(part);
    mpq_set_ui(step, 0, 1);
    for (size_t i = 0; i < choices(c); i++) {
        mpq_abs(part, c->best[i]);
        if (c->has[i])
            tn_common_unit(step, part);
    }
    if (mpq_sgn(step) == 0)
        mpq_set_ui(step, 1, 1);
    for (size_t i = 0; status == TN_OK && i < choices(c); i++) {
        mpq_div(part, c->best[i], step);
        if (c->has[i] && !mpz_fits_slong_p(mpq_numref(part)))
            status = tn_fail(error, TN_LIMIT, E_VARIANTS, "values of this measure have no common step");
        c->found->best[i] = c->has[i] ? mpz_get_si(mpq_numref(part)) : TN_NO_BEST;
    }
    mpq_clear(part);
    return status;
}

tn_status tn_completed_walked(tn_numbered *n, const tn_house_measures *measures, const tn_open_plan *open,
                              tn_completions *found, mpq_t step, tn_error *error)
{
    completing c = {.measures = measures, .found = found};
    *found = (tn_completions){0};
    mpz_init(found->plans);
    tn_status status = tn_open_pattern_read(&c.pattern, n->schema, open, error);
    if (status == TN_OK) {
        found->trays = c.pattern.items;
        found->values = n->schema->value_count;
        status = make_room(&c, error);
    }
    tn_session_begins(n->session, "going through houses");
    if (status == TN_OK)
        status = tn_numbered_plans(n, look_at_plan, &c, error);
    tn_session_ends(n->session);
    if (status == TN_OK && measures->count > 0)
        status = give_best(&c, step, error);
    for (size_t i = 0; c.best && i < choices(&c); i++)
        mpq_clear(c.best[i]);
    free(c.best);
    free(c.has);
    tn_open_pattern_clear(&c.pattern);
    return status;
}
