/* Counts the houses of a library, all together or plan by plan: by length, by section, and what clauses keep out. */
#include <stdlib.h>
#include <string.h>

#include "cli/house/numbered_parts.h"
#include "runtime/base/integers.h"
#include "runtime/base/json.h"

/* What was counted. */
typedef struct house_tally {
    bool each;         /* the plans were gone through */
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

/* ---- plan by plan */

static tn_status tally_plan(tn_numbered *n, const tn_tray *trays, uint32_t length, house_tally *tally, tn_error *error)
{
    section_tally sections = {n, tally};
    mpz_t before;
    mpz_init_set(before, tally->houses);
    tn_status status = tn_house_variants_sections(n->variants, trays, length, tally_section, &sections, error);
    mpz_add_ui(tally->plans, tally->plans, 1);
    if (mpz_cmp(before, tally->houses) != 0)
        mpz_add_ui(tally->with.plans, tally->with.plans, 1);
    mpz_sub(before, tally->houses, before);
    if (length >= tally->low && length <= tally->high)
        mpz_add(tally->lengths[length - tally->low], tally->lengths[length - tally->low], before);
    mpz_clear(before);
    return status;
}

static tn_status tally_next(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                            tn_error *error)
{
    (void)stop;
    return tally_plan(n, trays, length, context, error);
}

/* ---- all together */

/* Plans, sections and functions that have a house. To count them may take too much where houses can be counted. */
static tn_status tally_with(tn_houses *all, house_tally *tally, tn_error *error)
{
    tn_status status = tally->with_wanted ? tn_houses_project(all, &tally->with, error) : TN_LIMIT;
    tally->with_unsaid = status == TN_LIMIT;
    return status == TN_LIMIT ? TN_OK : status;
}

static tn_status tally_together(const tn_numbered *n, tn_houses *all, house_tally *tally, tn_error *error)
{
    uint32_t shapes[TN_CHOICES_MAX] = {0};
    mpz_t houses;
    mpz_init(houses);
    tally->each = false;
    tn_houses_faced(all, tally->faced);
    tally->faced_unsaid = !tn_houses_faced_known(all);
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
    return tally_with(all, tally, error);
}

/* Plan by plan, each in so many steps (0: the usual limit). */
static tn_status tally_each(tn_numbered *n, const tn_plan *plan, uint64_t work, house_tally *tally, tn_error *error)
{
    tn_house_variants *variants = n->variants;
    tn_status status = work > 0 ? tn_house_variants_new(&n->form, n->record, work, &n->variants, error) : TN_OK;
    tally->each = true;
    if (status == TN_OK && plan)
        status = tally_plan(n, plan->trays, (uint32_t)plan->length, tally, error);
    else if (status == TN_OK)
        status = tn_numbered_plans(n, tally_next, tally, error);
    if (n->variants != variants)
        tn_house_variants_free(n->variants);
    n->variants = variants;
    return status;
}

static tn_status count_together(tn_numbered *n, const tn_plan *plan, house_tally *tally, tn_error *error)
{
    tn_houses *houses = NULL;
    if (!plan) {
        tn_status status = tn_numbered_all(n, error);
        tn_library_kept(n->plans, TN_ALL_LENGTHS, tally->plans);
        return status == TN_OK ? tally_together(n, n->all, tally, error) : status;
    }
    const tn_houses_what what = {.only = plan->trays, .length = (uint32_t)plan->length};
    tn_status status = tn_numbered_of(n, &what, &houses, error);
    mpz_set_ui(tally->plans, 1);
    if (status == TN_OK)
        status = tally_together(n, houses, tally, error);
    tn_houses_free(houses);
    return status;
}

static tn_status tally_afresh(const tn_numbered *n, house_tally *tally, tn_error *error)
{
    bool wanted = tally->with_wanted;
    tally_free(n, tally);
    bool ok = tally_new(n, tally);
    tally->with_wanted = wanted;
    return ok ? TN_OK : tn_fail_memory(error);
}

/* The steps in which a plan is gone through quickly. */
static uint64_t quick_steps(const tn_numbered *n, const tn_plan *plan)
{
    enum { QUICK = 50000, QUICK_ALONE = 300000 };
    mpz_t plans;
    mpz_init(plans);
    tn_library_kept(n->plans, TN_ALL_LENGTHS, plans);
    uint64_t steps = plan || mpz_cmp_ui(plans, 1) <= 0 ? QUICK_ALONE : QUICK;
    mpz_clear(plans);
    return steps;
}

/* Few plans are gone through, unless one of them takes long; else all are counted together, if that can be done. */
static tn_status tally_all(tn_numbered *n, const tn_plan *plan, house_tally *tally, tn_error *error)
{
    tn_status status = TN_LIMIT;
    if (plan || tn_numbered_few(n))
        status = tally_each(n, plan, quick_steps(n, plan), tally, error);
    if (status != TN_LIMIT)
        return status;
    status = tally_afresh(n, tally, error);
    if (status == TN_OK)
        status = count_together(n, plan, tally, error);
    if (status != TN_LIMIT || (!plan && !tn_numbered_countable(n)))
        return status;
    const tn_error together = *error;
    status = tally_afresh(n, tally, error);
    if (status == TN_OK)
        status = tally_each(n, plan, 0, tally, error);
    if (status == TN_LIMIT && !plan) /* what keeps all plans from being counted says more than what one of them takes */
        *error = together;
    return status;
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

/* ---- what clauses keep out */

/* The houses on the plan, or on all plans, that some of the clauses keep: those of another module's record. states:
 * NULL, or what counting them took, 0 where the plans were gone through. */
static tn_status count_by(const tn_numbered *n, const tn_module *module, const tn_house_library_record *clauses,
                          const tn_plan *plan, mpz_t houses, uint64_t *states, tn_error *error)
{
    tn_numbered some;
    house_tally tally;
    tn_status status = tn_numbered_other(n, module, clauses, n->plans, &some, error);
    if (!tally_new(&some, &tally) && status == TN_OK)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tally_all(&some, plan, &tally, error);
    mpz_set(houses, tally.houses);
    if (states)
        *states = tally.each ? 0 : tally.states;
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
    tn_module module = *n->form.module; /* but for the clauses it is the same */
    tn_house_library_record some = *n->record;
    tn_status status = others ? TN_OK : tn_fail_memory(error);
    module.HOUSE_CLAUSE_records = others;
    module.HOUSE_CLAUSE_count = count;
    some.clause_first = 0;
    some.clause_count = count - (count > 0);
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        for (uint32_t k = 0; k < count; k++)
            if (k != i)
                others[k - (k > i)] = clauses[k];
        status = count_by(n, &module, &some, plan, tally->alone[i], NULL, error);
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

/* ---- writing */

enum { LABEL_WIDTH = 24, COUNT_WIDTH = 24 };

static size_t widest(size_t width, const char *name)
{
    size_t size = strlen(name) + 3; /* indented by two, and a blank after it */
    return size > width ? size : width;
}

/* Of the labels of the text: of the values and the clauses that are counted each, or more. */
static int label_width(const tn_numbered *n)
{
    const tn_module *module = n->form.module;
    size_t width = LABEL_WIDTH;
    for (uint32_t i = 0; i < n->form.record->choice_count; i++) {
        const tn_choice_record *choice = tn_form_choice(&n->form, i);
        for (uint32_t k = 0; k < choice->shape_count && choice->shape_count > 1; k++)
            width = widest(width, tn_text(module, module->SHAPE_records[choice->shape_first + k].spelling));
    }
    for (uint32_t i = 0; i < n->record->clause_count; i++)
        width = widest(width, tn_text(module, module->HOUSE_CLAUSE_records[n->record->clause_first + i].name));
    return (int)width;
}

static void write_lengths(const tn_numbered *n, const house_tally *tally, FILE *out)
{
    int labels = label_width(n);
    for (uint32_t i = 0; i <= tally->high - tally->low; i++) {
        if (mpz_sgn(tally->lengths[i]) == 0)
            continue;
        char label[40];
        snprintf(label, sizeof label, "  of %u tray%s", tally->low + i, tally->low + i == 1 ? "" : "s");
        gmp_fprintf(out, "%-*s%Zd\n", labels, label, tally->lengths[i]);
    }
}

/* Choices that leave nothing to choose are left out. */
static void write_sections(const tn_numbered *n, const house_tally *tally, FILE *out)
{
    int labels = label_width(n);
    const tn_module *module = n->form.module;
    const mpz_t *value = (const mpz_t *)tally->values;
    for (uint32_t i = 0; i < n->form.record->choice_count; i++) {
        const tn_choice_record *choice = tn_form_choice(&n->form, i);
        if (choice->shape_count > 1)
            fprintf(out, "%s\n", tn_text(module, choice->name));
        for (uint32_t k = 0; k < choice->shape_count; k++, value++) {
            const char *name = tn_text(module, module->SHAPE_records[choice->shape_first + k].spelling);
            if (choice->shape_count > 1)
                gmp_fprintf(out, "  %-*s %Zd\n", labels - 3, name, *value);
        }
    }
}

/* States, where all was counted with them. */
static bool knows_states(const tn_numbered *n, const house_tally *tally)
{
    bool known = !tally->each;
    for (uint32_t i = 0; known && i <= n->record->clause_count; i++)
        known = tally->asking[i] > 0;
    return known;
}

static void write_states(const tn_numbered *n, const house_tally *tally, FILE *out)
{
    int labels = label_width(n);
    const tn_module *module = n->form.module;
    const tn_house_clause_record *clauses = module->HOUSE_CLAUSE_records + n->record->clause_first;
    uint32_t count = n->record->clause_count;
    fprintf(out, "%-*s%s\n  %-*s%llu\n", labels, "clause by itself", "states", labels - 2, "none",
            (unsigned long long)tally->asking[count]);
    for (uint32_t i = 0; i < count; i++)
        fprintf(out, "  %-*s %llu\n", labels - 3, tn_text(module, clauses[i].name),
                (unsigned long long)tally->asking[i]);
    fprintf(out, "  %-*s%llu\n", labels - 2, "all of them", (unsigned long long)tally->states);
}

static void write_clauses(const tn_numbered *n, const house_tally *tally, FILE *out)
{
    int labels = label_width(n);
    const tn_module *module = n->form.module;
    const tn_house_clause_record *clauses = module->HOUSE_CLAUSE_records + n->record->clause_first;
    mpz_srcptr allowed = tally->kept_out[n->record->clause_count];
    gmp_fprintf(out, "%-*s%Zd\n%-*s%-*s%s\n", labels, "without clauses", allowed, labels, "clause", COUNT_WIDTH,
                "keeps out", "only by it");
    for (uint32_t i = 0; i < n->record->clause_count; i++)
        gmp_fprintf(out, "  %-*s %-*Zd %Zd\n", labels - 3, tn_text(module, clauses[i].name), COUNT_WIDTH - 1,
                    tally->kept_out[i], tally->alone[i]);
    if (knows_states(n, tally))
        write_states(n, tally, out);
}

static void write_text(const tn_numbered *n, const house_tally *tally, FILE *out)
{
    int labels = label_width(n);
    gmp_fprintf(out, "%-*s%Zd\n", labels, "plans", tally->plans);
    if (!tally->with_unsaid)
        gmp_fprintf(out, "%-*s%Zd\n%-*s%Zd\n%-*s%Zd\n", labels, "with a house", tally->with.plans, labels,
                    "with sections", tally->with.sections, labels, "with functions", tally->with.functions);
    if (!tally->faced_unsaid)
        gmp_fprintf(out, "%-*s%Zd\n", labels, "with openings", tally->faced);
    gmp_fprintf(out, "%-*s%Zd\n", labels, "houses", tally->houses);
    write_lengths(n, tally, out);
    write_sections(n, tally, out);
    if (tally->kept_out)
        write_clauses(n, tally, out);
}

/* ---- as JSON */

static void lengths_json(const house_tally *tally, tn_json *json)
{
    tn_json_object(json, "by_length");
    for (uint32_t i = 0; i <= tally->high - tally->low; i++) {
        char length[16];
        snprintf(length, sizeof length, "%u", tally->low + i);
        if (mpz_sgn(tally->lengths[i]) != 0)
            tn_json_digits(json, length, tally->lengths[i]);
    }
    tn_json_object_end(json);
}

static void sections_json(const tn_numbered *n, const house_tally *tally, tn_json *json)
{
    const tn_module *module = n->form.module;
    const mpz_t *value = (const mpz_t *)tally->values;
    tn_json_object(json, "by_section");
    for (uint32_t i = 0; i < n->form.record->choice_count; i++) {
        const tn_choice_record *choice = tn_form_choice(&n->form, i);
        tn_json_object(json, tn_text(module, choice->name));
        for (uint32_t k = 0; k < choice->shape_count; k++, value++)
            tn_json_digits(json, tn_text(module, module->SHAPE_records[choice->shape_first + k].spelling), *value);
        tn_json_object_end(json);
    }
    tn_json_object_end(json);
}

static void states_json(const tn_numbered *n, const house_tally *tally, tn_json *json)
{
    const tn_house_clause_record *clauses = n->form.module->HOUSE_CLAUSE_records + n->record->clause_first;
    tn_json_count(json, "states_of_none", tally->asking[n->record->clause_count]);
    tn_json_object(json, "states_of");
    for (uint32_t i = 0; i < n->record->clause_count; i++)
        tn_json_count(json, tn_text(n->form.module, clauses[i].name), tally->asking[i]);
    tn_json_object_end(json);
}

static void clauses_json(const tn_numbered *n, const house_tally *tally, tn_json *json)
{
    const tn_house_clause_record *clauses = n->form.module->HOUSE_CLAUSE_records + n->record->clause_first;
    tn_json_digits(json, "without_clauses", tally->kept_out[n->record->clause_count]);
    for (int alone = 0; alone < 2; alone++) {
        tn_json_object(json, alone ? "only" : "kept_out");
        for (uint32_t i = 0; i < n->record->clause_count; i++)
            tn_json_digits(json, tn_text(n->form.module, clauses[i].name), (alone ? tally->alone : tally->kept_out)[i]);
        tn_json_object_end(json);
    }
    if (knows_states(n, tally))
        states_json(n, tally, json);
}

static void write_json(const tn_numbered *n, const house_tally *tally, FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    tn_json_string(&json, "library", tn_text(n->form.module, n->record->name));
    tn_json_digits(&json, "plans", tally->plans);
    if (!tally->with_unsaid) {
        tn_json_digits(&json, "plans_with_houses", tally->with.plans);
        tn_json_digits(&json, "with_sections", tally->with.sections);
        tn_json_digits(&json, "zoned", tally->with.functions);
    }
    if (!tally->each)
        tn_json_count(&json, "states", tally->states);
    if (!tally->faced_unsaid)
        tn_json_digits(&json, "faced", tally->faced);
    tn_json_digits(&json, "houses", tally->houses);
    lengths_json(tally, &json);
    sections_json(n, tally, &json);
    if (tally->kept_out)
        clauses_json(n, tally, &json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

/* ---- the command */

static tn_status count_houses(tn_numbered *n, const char *text, bool clauses, size_t max_length, house_tally *tally,
                              tn_error *error)
{
    tn_plan plan = {0};
    tn_status status = text ? tn_numbered_plan(n, text, max_length, &plan, error) : TN_OK;
    tally->with_wanted = true;
    if (status == TN_OK)
        status = tally_all(n, text ? &plan : NULL, tally, error);
    if (status == TN_OK && clauses)
        status = tally_clauses(n, text ? &plan : NULL, tally, error);
    free(plan.trays);
    return status;
}

void tn_job_count_houses(tn_job *job, const tn_house_settings *settings, const tn_house_counting *counting)
{
    tn_numbered n;
    house_tally tally = {0};
    tn_error error = {0};
    tn_output out;
    if (!tn_numbered_open(&n, job, settings)) {
        tn_numbered_close(&n);
        return;
    }
    if (counting->by) {
        tn_numbered_count_by(&n, settings, counting);
        tn_numbered_close(&n);
        return;
    }
    tn_status status = tally_new(&n, &tally) ? TN_OK : tn_fail_memory(&error);
    if (status == TN_OK)
        status = count_houses(&n, counting->plan, counting->clauses, settings->max_length, &tally, &error);
    if (status != TN_OK) {
        tn_numbered_bad_text(job, &error, "PLAN", counting->plan ? counting->plan : "");
    } else if (tn_job_output(job, counting->output, &out)) {
        if (counting->json)
            write_json(&n, &tally, out.stream);
        else
            write_text(&n, &tally, out.stream);
        tn_job_commit(job, &out);
        if (mpz_sgn(tally.houses) == 0 && !counting->clauses)
            tn_numbered_say_few(&n, counting->plan != NULL, 0, 1);
    }
    tally_free(&n, &tally);
    tn_numbered_close(&n);
}
