/* Counts the houses of a library, all together or plan by plan: by length, by section, and what clauses keep out. */
#include <stdlib.h>
#include <string.h>

#include "ask/house/numbered_count.h"
#include "ask/house/walked.h"
#include "runtime/base/integers.h"

/* What was counted. */
typedef struct house_tally {
    bool each;         /* the plans were counted one by one */
    bool faced_unsaid; /* houses without their tiles were not counted */
    bool with_wanted;  /* plans, sections and functions that have a house are asked for */
    bool with_unsaid;  /* but they were not counted */
    uint64_t states;
    tn_houses_projected with; /* those */
    mpz_t plans, faced, houses;
    mpz_t *lengths; /* houses on plans of each length, from the shortest */
    uint32_t low, high;
    mpz_t *values;    /* houses that have each value of each choice, choice by choice */
    mpz_t *kept_out;  /* by each clause, of the houses that the form allows; last those; NULL: not counted */
    mpz_t *alone;     /* by each clause, of those that all others keep */
    uint64_t *asking; /* [clauses + 1] states that each takes by itself, then those without any; 0: not counted so */
} house_tally;

static size_t value_count(const tn_numbered *n)
{
    size_t count = 0;
    for (uint32_t i = 0; i < n->form.record->choice_count; i++)
        count += tn_form_choice(&n->form, i)->shape_count;
    return count;
}

static bool tally_new(const tn_numbered *n, house_tally *tally)
{
    *tally = (house_tally){.low = tn_library_min(n->plans), .high = tn_library_max(n->plans)};
    tally->high = tally->high < tally->low ? tally->low : tally->high;
    tally->lengths = tn_integers_new((size_t)tally->high - tally->low + 1);
    tally->values = tn_integers_new(value_count(n));
    mpz_inits(tally->plans, tally->faced, tally->houses, NULL);
    tn_houses_projected_init(&tally->with);
    return tally->lengths && tally->values;
}

static void tally_free(const tn_numbered *n, house_tally *tally)
{
    tn_integers_free(tally->lengths, (size_t)tally->high - tally->low + 1);
    tn_integers_free(tally->values, value_count(n));
    tn_integers_free(tally->kept_out, n->record->clause_count + 1);
    tn_integers_free(tally->alone, n->record->clause_count);
    free(tally->asking);
    mpz_clears(tally->plans, tally->faced, tally->houses, NULL);
    tn_houses_projected_clear(&tally->with);
}

static tn_status tally_afresh(const tn_numbered *n, house_tally *tally, tn_error *error)
{
    bool wanted = tally->with_wanted;
    tally_free(n, tally);
    bool ok = tally_new(n, tally);
    tally->with_wanted = wanted;
    return ok ? TN_OK : tn_fail_memory(error);
}

/* ---- sections */

typedef struct section_tally {
    const tn_numbered *n;
    house_tally *tally;
} section_tally;

static void add_section(const tn_numbered *n, house_tally *tally, const uint32_t *shapes, const mpz_t houses)
{
    size_t first = 0;
    for (uint32_t i = 0; i < n->form.record->choice_count; i++) {
        mpz_add(tally->values[first + shapes[i]], tally->values[first + shapes[i]], houses);
        first += tn_form_choice(&n->form, i)->shape_count;
    }
}

static tn_status tally_section(void *context, const uint32_t *shapes, const tn_house_counts *counts, tn_error *error)
{
    const section_tally *s = context;
    (void)error;
    add_section(s->n, s->tally, shapes, counts->houses);
    mpz_add_ui(s->tally->with.sections, s->tally->with.sections, 1);
    mpz_add_ui(s->tally->with.functions, s->tally->with.functions, counts->zoned);
    mpz_add_ui(s->tally->faced, s->tally->faced, counts->faced);
    mpz_add(s->tally->houses, s->tally->houses, counts->houses);
    return TN_OK;
}

static bool next_section(const tn_numbered *n, uint32_t *shapes)
{
    for (uint32_t i = n->form.record->choice_count; i-- > 0;) {
        if (++shapes[i] < tn_form_choice(&n->form, i)->shape_count)
            return true;
        shapes[i] = 0;
    }
    return false;
}

/* ---- all together */

/* Plans, sections and functions that have a house. To count them may take too much though houses can be counted. */
static tn_status tally_with(tn_houses *all, house_tally *tally, tn_error *error)
{
    tn_status status = tally->with_wanted ? tn_houses_project(all, &tally->with, error) : TN_LIMIT;
    tally->with_unsaid = status == TN_LIMIT;
    return status == TN_LIMIT ? TN_OK : status;
}

/* Houses without their tiles, if the count does not say how many there are: gone through on few plans, if there are few
 * of them. */
typedef struct tn_going_faced {
    tn_houses *houses;
    house_tally *tally;
} tn_going_faced;

static tn_status add_faced(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                           tn_error *error)
{
    enum { FACED_MOST = 3000 };
    const tn_going_faced *g = context;
    tn_plan_houses *plan;
    uint64_t faced = 0;
    bool known = false;
    (void)n;
    tn_status status = tn_plan_houses_new(g->houses, trays, length, &plan, error);
    if (status == TN_OK)
        status = tn_plan_houses_faced(plan, FACED_MOST - mpz_get_ui(g->tally->faced), &faced, &known, error);
    tn_plan_houses_free(plan);
    mpz_add_ui(g->tally->faced, g->tally->faced, faced);
    *stop = g->tally->faced_unsaid = !known;
    return status;
}

static tn_status tally_faced(tn_numbered *n, tn_houses *all, const tn_plan *plan, house_tally *tally, tn_error *error)
{
    tn_going_faced g = {all, tally};
    bool stop;
    tally->faced_unsaid = !tn_houses_faced_known(all);
    if (!tally->faced_unsaid) {
        tn_houses_faced(all, tally->faced);
        return TN_OK;
    }
    if (!tally->with_wanted || (!plan && !tn_numbered_few(n)))
        return TN_OK;
    mpz_set_ui(tally->faced, 0);
    tally->faced_unsaid = false;
    return plan ? add_faced(n, &g, plan->trays, (uint32_t)plan->length, &stop, error)
                : tn_numbered_plans(n, add_faced, &g, error);
}

static tn_status tally_together(tn_numbered *n, tn_houses *all, const tn_plan *plan, house_tally *tally,
                                tn_error *error)
{
    uint32_t shapes[TN_CHOICES_MAX] = {0};
    mpz_t houses;
    mpz_init(houses);
    tn_houses_count(all, TN_ALL_LENGTHS, tally->houses);
    tally->states = tn_houses_states(all);
    for (uint32_t k = tally->low; k <= tally->high; k++) {
        tn_houses_count(all, k, houses);
        mpz_set(tally->lengths[k - tally->low], houses);
    }
    for (bool more = true; more; more = next_section(n, shapes)) {
        tn_houses_of_section(all, shapes, houses);
        add_section(n, tally, shapes, houses);
    }
    mpz_clear(houses);
    tn_status status = tally_faced(n, all, plan, tally, error);
    return status == TN_OK ? tally_with(all, tally, error) : status;
}

static tn_status count_together(tn_numbered *n, const tn_plan *plan, house_tally *tally, tn_error *error)
{
    tn_houses *houses = NULL;
    if (!plan) {
        tn_status status = tn_numbered_all(n, error);
        tn_library_kept(n->plans, TN_ALL_LENGTHS, tally->plans);
        return status == TN_OK ? tally_together(n, n->all, NULL, tally, error) : status;
    }
    tn_status status = tn_numbered_on_plan(n, plan->trays, (uint32_t)plan->length, &houses, error);
    mpz_set_ui(tally->plans, 1);
    if (status == TN_OK)
        status = tally_together(n, houses, plan, tally, error);
    tn_houses_free(houses);
    return status;
}

/* ---- plan by plan */

/* Gone through one by one. */
static tn_status tally_listed(tn_numbered *n, const tn_tray *trays, uint32_t length, house_tally *tally,
                              tn_error *error)
{
    section_tally sections = {n, tally};
    tn_house_listing *listing;
    mpz_set_ui(tally->plans, 1);
    tn_status status = tn_numbered_listing(n, &listing, error);
    if (status == TN_OK)
        status = tn_house_listing_sections(listing, trays, length, tally_section, &sections, error);
    mpz_set_ui(tally->with.plans, mpz_sgn(tally->houses) > 0);
    if (length >= tally->low && length <= tally->high)
        mpz_set(tally->lengths[length - tally->low], tally->houses);
    return status;
}

static void add_tally(const tn_numbered *n, house_tally *tally, const house_tally *one)
{
    tally->with_unsaid = tally->with_unsaid || one->with_unsaid;
    tally->faced_unsaid = tally->faced_unsaid || one->faced_unsaid;
    mpz_add(tally->with.plans, tally->with.plans, one->with.plans);
    mpz_add(tally->with.sections, tally->with.sections, one->with.sections);
    mpz_add(tally->with.functions, tally->with.functions, one->with.functions);
    mpz_add(tally->plans, tally->plans, one->plans);
    mpz_add(tally->faced, tally->faced, one->faced);
    mpz_add(tally->houses, tally->houses, one->houses);
    for (uint32_t k = 0; k <= tally->high - tally->low; k++)
        mpz_add(tally->lengths[k], tally->lengths[k], one->lengths[k]);
    for (size_t i = 0; i < value_count(n); i++)
        mpz_add(tally->values[i], tally->values[i], one->values[i]);
}

/* Together for this plan, or one by one if that cannot be done. */
static tn_status tally_plan(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                            tn_error *error)
{
    house_tally *tally = context, one;
    tn_plan plan = {.length = length};
    (void)stop;
    plan.trays = malloc(((size_t)length + 1) * sizeof *trays);
    tn_status status = tally_new(n, &one) && plan.trays ? TN_OK : tn_fail_memory(error);
    one.with_wanted = tally->with_wanted;
    if (status == TN_OK) {
        if (length > 0)
            memcpy(plan.trays, trays, length * sizeof *trays);
        status = count_together(n, &plan, &one, error);
    }
    if (status == TN_LIMIT) {
        status = tally_afresh(n, &one, error);
        if (status == TN_OK)
            status = tally_listed(n, trays, length, &one, error);
    }
    if (status == TN_OK)
        add_tally(n, tally, &one);
    tally_free(n, &one);
    free(plan.trays);
    return status;
}

/* All are counted together if that can be done, else the houses on each plan. */
static tn_status tally_all(tn_numbered *n, const tn_plan *plan, house_tally *tally, tn_error *error)
{
    tn_status status = count_together(n, plan, tally, error);
    if (status != TN_LIMIT || (!plan && !tn_numbered_countable(n)))
        return status;
    const tn_error together = *error;
    status = tally_afresh(n, tally, error);
    tally->each = true;
    if (status != TN_OK)
        return status;
    if (plan)
        return tally_listed(n, plan->trays, (uint32_t)plan->length, tally, error);
    status = tn_numbered_plans(n, tally_plan, tally, error);
    if (status == TN_LIMIT) /* what keeps all plans from being counted says more than what one of them takes */
        *error = together;
    return status;
}

/* States are of interest if a count takes many of them, or is of many plans. */
static bool says_states(const tn_numbered *n, const tn_plan *plan, const house_tally *tally)
{
    enum { MANY_STATES = 1000 };
    return !tally->each && (tally->states >= MANY_STATES || (!plan && !tn_numbered_few(n)));
}

tn_status tn_numbered_lengths(tn_numbered *n, uint32_t low, uint32_t high, mpz_t *lengths, tn_error *error)
{
    house_tally tally;
    tn_status status = tally_new(n, &tally) ? tally_all(n, NULL, &tally, error) : tn_fail_memory(error);
    for (uint32_t k = low; status == TN_OK && k <= high; k++) {
        bool there = k >= tally.low && k <= tally.high;
        mpz_set_ui(lengths[k - low], 0);
        if (there)
            mpz_set(lengths[k - low], tally.lengths[k - tally.low]);
    }
    tally_free(n, &tally);
    return status;
}

tn_status tn_numbered_houses(tn_numbered *n, const tn_plan *plan, mpz_t houses, tn_error *error)
{
    house_tally tally;
    tn_status status = tally_new(n, &tally) ? tally_all(n, plan, &tally, error) : tn_fail_memory(error);
    mpz_set(houses, tally.houses);
    tally_free(n, &tally);
    return status;
}

/* ---- what clauses keep out */

/* The houses on the plan, or on all plans, that some of the clauses keep: those of another module's record. states:
 * NULL, or what counting them took, 0 where the plans were gone through. */
static tn_status count_by(const tn_numbered *n, const tn_module *module, const tn_house_library_record *clauses,
                          const tn_plan *plan, mpz_t houses, uint64_t *states, tn_error *error)
{
    tn_numbered some;
    house_tally tally;
    tn_numbered_other(n, module, clauses, n->plans, &some);
    tn_status status = tally_new(&some, &tally) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = tally_all(&some, plan, &tally, error);
    mpz_set(houses, tally.houses);
    if (states)
        *states = says_states(&some, plan, &tally) ? tally.states : 0;
    tally_free(&some, &tally);
    tn_numbered_other_close(&some);
    return status;
}

/* What each clause keeps out of the houses that the form allows. */
static tn_status tally_kept_out(const tn_numbered *n, const tn_plan *plan, house_tally *tally, tn_error *error)
{
    tn_house_library_record some = *n->record;
    uint32_t count = n->record->clause_count;
    some.clause_count = 0;
    tn_status status = count_by(n, n->form.module, &some, plan, tally->kept_out[count], &tally->asking[count], error);
    some.clause_count = 1;
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        some.clause_first = n->record->clause_first + i;
        status = count_by(n, n->form.module, &some, plan, tally->kept_out[i], &tally->asking[i], error);
        mpz_sub(tally->kept_out[i], tally->kept_out[count], tally->kept_out[i]);
    }
    return status;
}

/* What each keeps out that no other does: what there would be without it, less what there is. */
static tn_status tally_alone(const tn_numbered *n, const tn_plan *plan, house_tally *tally, tn_error *error)
{
    uint32_t count = n->record->clause_count;
    const tn_house_clause_record *clauses = n->form.module->HOUSE_CLAUSE_records + n->record->clause_first;
    tn_house_clause_record *others = malloc(((size_t)count + 1) * sizeof *others);
    tn_other_clauses some;
    tn_status status = others ? TN_OK : tn_fail_memory(error);
    tn_other_clauses_set(&n->form, n->record, others, count - (count > 0), &some);
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        for (uint32_t k = 0; k < count; k++)
            if (k != i)
                others[k - (k > i)] = clauses[k];
        status = count_by(n, &some.module, &some.library, plan, tally->alone[i], NULL, error);
        mpz_sub(tally->alone[i], tally->alone[i], tally->houses);
    }
    free(others);
    return status;
}

static tn_status tally_clauses(const tn_numbered *n, const tn_plan *plan, house_tally *tally, tn_error *error)
{
    tally->kept_out = tn_integers_new(n->record->clause_count + 1);
    tally->alone = tn_integers_new(n->record->clause_count);
    tally->asking = calloc((size_t)n->record->clause_count + 1, sizeof *tally->asking);
    tn_status status = tally->kept_out && tally->alone && tally->asking ? tally_kept_out(n, plan, tally, error)
                                                                        : tn_fail_memory(error);
    return status == TN_OK ? tally_alone(n, plan, tally, error) : status;
}

tn_status tn_numbered_clauses(tn_numbered *n, mpz_t *kept_out, mpz_t *alone, tn_error *error)
{
    house_tally tally;
    tn_status status = tally_new(n, &tally) ? tally_all(n, NULL, &tally, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tally_clauses(n, NULL, &tally, error);
    for (uint32_t i = 0; status == TN_OK && i < n->record->clause_count; i++) {
        mpz_set(kept_out[i], tally.kept_out[i]);
        mpz_set(alone[i], tally.alone[i]);
    }
    tally_free(n, &tally);
    return status;
}

/* ---- the answer */

static tn_status name_of(const char *text, char **name, tn_error *error)
{
    *name = strdup(text);
    return *name ? TN_OK : tn_fail_memory(error);
}

/* So many numbers, each with a name that is not there yet. */
#define NEW_MAP(OF, LIST, COUNT, ERROR) tn_message_list(&tn_message_##OF, (COUNT), (tn_list *)&(LIST), (ERROR))

static tn_status give_lengths(const house_tally *tally, tn_counted_houses *counted, tn_error *error)
{
    size_t there = 0, next = 0;
    char length[16];
    for (uint32_t i = 0; i <= tally->high - tally->low; i++)
        there += mpz_sgn(tally->lengths[i]) != 0;
    tn_status status = NEW_MAP(named_big, counted->by_length, there, error);
    for (uint32_t i = 0; status == TN_OK && next < there; i++) {
        if (mpz_sgn(tally->lengths[i]) == 0)
            continue;
        snprintf(length, sizeof length, "%u", tally->low + i);
        mpz_set(counted->by_length.items[next].value, tally->lengths[i]);
        status = name_of(length, &counted->by_length.items[next++].name, error);
    }
    return status;
}

static tn_status give_choice(const tn_numbered *n, const tn_choice_record *choice, const mpz_t *values,
                             tn_named_bigs *given, tn_error *error)
{
    const tn_module *module = n->form.module;
    tn_status status = name_of(tn_text(module, choice->name), &given->name, error);
    if (status == TN_OK)
        status = NEW_MAP(named_big, given->values, choice->shape_count, error);
    for (uint32_t k = 0; status == TN_OK && k < choice->shape_count; k++) {
        const tn_shape_record *shape = &module->SHAPE_records[choice->shape_first + k];
        mpz_set(given->values.items[k].value, values[k]);
        status = name_of(tn_text(module, shape->spelling), &given->values.items[k].name, error);
    }
    return status;
}

static tn_status give_sections(const tn_numbered *n, const house_tally *tally, tn_counted_houses *counted,
                               tn_error *error)
{
    uint32_t count = n->form.record->choice_count;
    const mpz_t *values = (const mpz_t *)tally->values;
    tn_status status = NEW_MAP(named_bigs, counted->by_section, count, error);
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        const tn_choice_record *choice = tn_form_choice(&n->form, i);
        status = give_choice(n, choice, values, &counted->by_section.items[i], error);
        values += choice->shape_count;
    }
    return status;
}

/* Those of each clause by itself. */
static bool knows_states(const tn_numbered *n, const tn_plan *plan, const house_tally *tally)
{
    bool known = says_states(n, plan, tally);
    for (uint32_t i = 0; known && i <= n->record->clause_count; i++)
        known = tally->asking[i] > 0;
    return known;
}

static const char *clause_name(const tn_numbered *n, uint32_t i)
{
    const tn_module *module = n->form.module;
    return tn_text(module, module->HOUSE_CLAUSE_records[n->record->clause_first + i].name);
}

static tn_status give_states(const tn_numbered *n, const house_tally *tally, tn_counted_houses *counted,
                             tn_error *error)
{
    uint32_t count = n->record->clause_count;
    counted->has_states_of_none = counted->has_states_of = true;
    counted->states_of_none = tally->asking[count];
    tn_status status = NEW_MAP(named_count, counted->states_of, count, error);
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        counted->states_of.items[i].value = tally->asking[i];
        status = name_of(clause_name(n, i), &counted->states_of.items[i].name, error);
    }
    return status;
}

static tn_status give_clauses(const tn_numbered *n, const tn_plan *plan, const house_tally *tally,
                              tn_counted_houses *counted, tn_error *error)
{
    uint32_t count = n->record->clause_count;
    counted->has_without_clauses = counted->has_kept_out = counted->has_only = true;
    mpz_set(counted->without_clauses, tally->kept_out[count]);
    tn_status status = NEW_MAP(named_big, counted->kept_out, count, error);
    if (status == TN_OK)
        status = NEW_MAP(named_big, counted->only, count, error);
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        mpz_set(counted->kept_out.items[i].value, tally->kept_out[i]);
        mpz_set(counted->only.items[i].value, tally->alone[i]);
        status = name_of(clause_name(n, i), &counted->kept_out.items[i].name, error);
        if (status == TN_OK)
            status = name_of(clause_name(n, i), &counted->only.items[i].name, error);
    }
    return status == TN_OK && knows_states(n, plan, tally) ? give_states(n, tally, counted, error) : status;
}

static tn_status give(const tn_numbered *n, const tn_plan *plan, const house_tally *tally, tn_counted_houses *counted,
                      tn_error *error)
{
    counted->library = tn_text(n->form.module, n->record->name);
    mpz_set(counted->plans, tally->plans);
    mpz_set(counted->houses, tally->houses);
    counted->has_plans_with_houses = counted->has_with_sections = counted->has_zoned = !tally->with_unsaid;
    mpz_set(counted->plans_with_houses, tally->with.plans);
    mpz_set(counted->with_sections, tally->with.sections);
    mpz_set(counted->zoned, tally->with.functions);
    counted->has_states = says_states(n, plan, tally);
    counted->states = tally->states;
    counted->has_faced = !tally->faced_unsaid;
    mpz_set(counted->faced, tally->faced);
    tn_status status = give_lengths(tally, counted, error);
    if (status == TN_OK)
        status = give_sections(n, tally, counted, error);
    return status == TN_OK && tally->kept_out ? give_clauses(n, plan, tally, counted, error) : status;
}

tn_status tn_numbered_count(tn_numbered *n, const tn_plan *plan, bool clauses, tn_counted_houses *counted,
                            tn_error *error)
{
    house_tally tally;
    tn_status status = tally_new(n, &tally) ? TN_OK : tn_fail_memory(error);
    tally.with_wanted = true;
    if (status == TN_OK)
        status = tally_all(n, plan, &tally, error);
    if (status == TN_OK && clauses)
        status = tally_clauses(n, plan, &tally, error);
    if (status == TN_OK)
        status = give(n, plan, &tally, counted, error);
    tally_free(n, &tally);
    return status;
}

/* ---- by a measure */

static tn_status spread_walked(tn_numbered *n, const tn_plan *plan, const tn_house_measures *measures,
                               tn_spread *spread, tn_error *error)
{
    tn_walked_houses walked;
    tn_session_begins(n->session, "measuring houses");
    tn_status status = tn_walked_find(n, plan, measures, false, &walked, error);
    tn_session_ends(n->session);
    if (status == TN_OK)
        status = tn_walked_spread(&walked, &spread->d, error);
    tn_walked_clear(&walked);
    return status;
}

static tn_status spread_together(tn_numbered *n, const tn_houses_what *what, tn_spread *spread, tn_error *error)
{
    tn_houses *houses = NULL;
    tn_status status = tn_houses_of(&n->form, n->record, n->plans, what, n->max_states, &houses, error);
    if (status == TN_OK)
        status = tn_houses_spread(houses, &spread->d, error);
    tn_houses_free(houses);
    return status;
}

static tn_status fill_spread(tn_numbered *n, const tn_plan *plan, tn_house_measured measure, tn_spread *spread,
                             tn_error *error)
{
    tn_house_weights *weights = NULL;
    tn_status status = tn_house_weights_new(&n->form, measure, &weights, error);
    tn_house_measures measures = {.count = 1, .of = {weights}};
    tn_houses_what what = {.measures = &measures};
    if (plan) {
        what.only = plan->trays;
        what.length = (uint32_t)plan->length;
    }
    if (status == TN_OK)
        status = plan && tn_walked_asked(n, &measures) ? spread_walked(n, plan, &measures, spread, error)
                                                       : spread_together(n, &what, spread, error);
    if (status == TN_OK)
        status = tn_spread_finish(spread, error);
    tn_house_weights_free(weights);
    return status;
}

tn_status tn_numbered_spread(tn_numbered *n, const tn_plan *plan, uint32_t measure, tn_spread *spread, tn_error *error)
{
    const tn_module *module = n->form.module;
    tn_house_measured of = tn_house_measured_of(module, measure);
    tn_spread_begin(spread, n->schema, (int)module->SUM_records[of.sum].power);
    spread->library = tn_text(module, n->record->name);
    spread->name = tn_text(module, of.name);
    spread->doc = tn_text(module, of.doc);
    spread->of = "house";
    return fill_spread(n, plan, of, spread, error);
}
