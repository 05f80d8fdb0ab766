/* Compares two libraries of houses: what differs between them, how many houses each has, and which way to go from
 * there. */
#include "ask/house/compared.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"
#include "runtime/house/house.h"
#include "runtime/module/same.h"

/* ---- what differs */

static const tn_house_clause_record *clause_of(const tn_compared_side *side, uint32_t clause)
{
    return &side->n.form.module->HOUSE_CLAUSE_records[side->n.record->clause_first + clause];
}

static const char *name_of(const tn_compared_side *side, uint32_t clause)
{
    return tn_text(side->n.form.module, clause_of(side, clause)->name);
}

static bool is_same_clause(const tn_compared_side *a, uint32_t first, const tn_compared_side *b, uint32_t second)
{
    return tn_records_same(a->n.form.module, a->n.record->clause_first + first, b->n.form.module,
                           b->n.record->clause_first + second, TN_SECTION_HOUSE_CLAUSE);
}

/* Pairs the clauses that say the same. */
static tn_status find_partners(tn_compared_houses *c, tn_error *error)
{
    tn_compared_side *old = &c->sides[0], *new = &c->sides[1];
    uint32_t counts[2] = {old->n.record->clause_count, new->n.record->clause_count};
    for (int i = 0; i < 2; i++) {
        c->sides[i].partner = malloc(((size_t)counts[i] + 1) * sizeof *c->sides[i].partner);
        if (!c->sides[i].partner)
            return tn_fail_memory(error);
        for (uint32_t k = 0; k < counts[i]; k++)
            c->sides[i].partner[k] = TN_NO_RECORD;
    }
    for (uint32_t i = 0; i < counts[0]; i++)
        for (uint32_t k = 0; k < counts[1] && old->partner[i] == TN_NO_RECORD; k++)
            if (new->partner[k] == TN_NO_RECORD && is_same_clause(old, i, new, k)) {
                old->partner[i] = k;
                new->partner[k] = i;
            }
    return TN_OK;
}

/* The form is the same; its rules and openings also have the same numbers, by which other records call them. */
static bool is_same_form(const tn_compared_houses *c)
{
    const tn_house_form *old = &c->sides[0].n.form, *new = &c->sides[1].n.form;
    const tn_form_record *a = old->record, *b = new->record;
    return a->rule_first == b->rule_first && a->opening_first == b->opening_first &&
           a->choice_first == b->choice_first && a->storey_first == b->storey_first &&
           tn_records_same(old->module, c->sides[0].n.record->form, new->module, c->sides[1].n.record->form,
                           TN_SECTION_FORM);
}

static tn_house_edit *add_edit(tn_compared_houses *c, const char *name, tn_clause_change change)
{
    tn_house_edit *edit = &c->edits[c->edit_count++];
    *edit = (tn_house_edit){.name = name, .change = change, .clause = {TN_NO_RECORD, TN_NO_RECORD}};
    mpz_inits(edit->houses[0], edit->houses[1], NULL);
    return edit;
}

static tn_house_edit *find_named(const tn_compared_houses *c, const char *name)
{
    for (size_t i = 0; i < c->edit_count; i++)
        if (c->edits[i].clause[0] != TN_NO_RECORD && c->edits[i].clause[1] == TN_NO_RECORD &&
            strcmp(c->edits[i].name, name) == 0)
            return &c->edits[i];
    return NULL;
}

static void add_clauses(tn_compared_houses *c)
{
    const tn_compared_side *old = &c->sides[0], *new = &c->sides[1];
    for (uint32_t i = 0; i < old->n.record->clause_count; i++)
        if (old->partner[i] == TN_NO_RECORD)
            add_edit(c, name_of(old, i), TN_CLAUSE_REMOVED)->clause[0] = i;
    for (uint32_t i = 0; i < new->n.record->clause_count; i++) {
        if (new->partner[i] != TN_NO_RECORD)
            continue;
        tn_house_edit *edit = find_named(c, name_of(new, i));
        if (edit)
            edit->change = TN_CLAUSE_CHANGED;
        else
            edit = add_edit(c, name_of(new, i), TN_CLAUSE_ADDED);
        edit->clause[1] = i;
    }
}

static bool has_plans(const tn_compared_houses *c, tn_diff_part part)
{
    mpz_t count;
    mpz_init(count);
    tn_library_kept(tn_library_diff_part(c->plans, part), TN_ALL_LENGTHS, count);
    bool any = mpz_sgn(count) > 0;
    mpz_clear(count);
    return any;
}

bool tn_compared_other_plans(const tn_compared_houses *c)
{
    return has_plans(c, TN_DIFF_REMOVED) || has_plans(c, TN_DIFF_ADDED);
}

tn_house_edit *tn_compared_edit(const tn_compared_houses *c, const char *name)
{
    for (size_t i = 0; i < c->edit_count; i++)
        if (c->edits[i].clause[0] == TN_NO_RECORD && c->edits[i].clause[1] == TN_NO_RECORD &&
            strcmp(c->edits[i].name, name) == 0)
            return &c->edits[i];
    return NULL;
}

static tn_status find_edits(tn_compared_houses *c, tn_error *error)
{
    tn_status status = find_partners(c, error);
    if (status != TN_OK)
        return status;
    size_t most = (size_t)c->sides[0].n.record->clause_count + c->sides[1].n.record->clause_count + 2;
    c->edits = calloc(most, sizeof *c->edits);
    if (!c->edits)
        return tn_fail_memory(error);
    if (tn_compared_other_plans(c))
        add_edit(c, "plans", TN_CLAUSE_CHANGED);
    if (!is_same_form(c))
        add_edit(c, "form", TN_CLAUSE_CHANGED);
    add_clauses(c);
    return TN_OK;
}

/* ---- examples */

tn_status tn_edit_example(tn_house_edit *edit, int which, const tn_house *house, tn_error *error)
{
    tn_buffer line = {0};
    if (!tn_array_reserve(&edit->examples[which], &edit->example_room[which], edit->example_count[which], 1,
                          sizeof *edit->examples[which]))
        return tn_fail_memory(error);
    tn_status status = tn_house_write(house, &line, error);
    if (status == TN_OK)
        edit->examples[which][edit->example_count[which]++] = line.data;
    else
        free(line.data);
    return status;
}

typedef struct tn_edit_samples {
    tn_house_edit *edit;
    int which;
} tn_edit_samples;

static tn_status keep_example(void *context, tn_house *house, const mpz_t rank, const mpz_t variant, tn_error *error)
{
    const tn_edit_samples *samples = context;
    (void)variant;
    if (samples->edit->example_count[samples->which] == 1 && mpz_sgn(rank) == 0)
        return TN_OK; /* the first is there already */
    return tn_edit_example(samples->edit, samples->which, house, error);
}

tn_status tn_edit_sample(tn_house_edit *edit, int which, tn_numbered *from, const tn_compared_options *options,
                         tn_error *error)
{
    tn_edit_samples samples = {edit, which};
    tn_house first;
    if (mpz_sgn(edit->houses[which]) == 0)
        return TN_OK;
    tn_status status = tn_numbered_house(from, "#0", &first, error);
    if (status == TN_OK)
        status = tn_edit_example(edit, which, &first, error);
    tn_house_clear(&first);
    return status == TN_OK
               ? tn_numbered_sample(from, NULL, options->shown, options->seed, false, keep_example, &samples, error)
               : status;
}

/* ---- all of it */

static size_t length_count(const tn_compared_houses *c)
{
    return (size_t)c->high - c->low + 1;
}

static tn_status count_sides(tn_compared_houses *c, tn_error *error)
{
    const tn_library *const plans[] = {c->sides[0].n.plans, c->sides[1].n.plans};
    c->low = tn_library_min(plans[0]) < tn_library_min(plans[1]) ? tn_library_min(plans[0]) : tn_library_min(plans[1]);
    c->high = tn_library_max(plans[0]) > tn_library_max(plans[1]) ? tn_library_max(plans[0]) : tn_library_max(plans[1]);
    c->high = c->high < c->low ? c->low : c->high;
    c->before = tn_integers_new(length_count(c));
    c->after = tn_integers_new(length_count(c));
    c->kept = tn_integers_new(length_count(c));
    if (!c->before || !c->after || !c->kept)
        return tn_fail_memory(error);
    tn_status status = tn_numbered_lengths(&c->sides[0].n, c->low, c->high, c->before, error);
    return status == TN_OK ? tn_numbered_lengths(&c->sides[1].n, c->low, c->high, c->after, error) : status;
}

/* The side that has all clauses of the other; -1: neither. */
static int strict_side(const tn_compared_houses *c)
{
    bool more[2] = {false, false};
    for (int i = 0; i < 2; i++)
        for (uint32_t k = 0; k < c->sides[i].n.record->clause_count; k++)
            more[i] = more[i] || c->sides[i].partner[k] == TN_NO_RECORD;
    return more[0] && more[1] ? -1 : more[0] ? 0 : 1;
}

tn_status tn_houses_compare(tn_compared_houses *c, const tn_compared_options *options, tn_error *error)
{
    tn_status status =
        tn_library_diff_new(c->sides[0].n.plans, c->sides[1].n.plans, c->sides[1].n.max_states, NULL, &c->plans, error);
    if (status == TN_OK)
        status = find_edits(c, error);
    if (status == TN_OK)
        status = count_sides(c, error);
    if (status != TN_OK)
        return status;
    int strict = tn_compared_edit(c, "form") ? -1 : strict_side(c);
    return strict >= 0 ? tn_compare_together(c, strict, options, error) : tn_compare_each(c, options, error);
}

void tn_houses_compare_clear(tn_compared_houses *c)
{
    for (size_t i = 0; i < c->edit_count; i++) {
        for (int which = 0; which < 2; which++) {
            for (size_t k = 0; k < c->edits[i].example_count[which]; k++)
                free(c->edits[i].examples[which][k]);
            free(c->edits[i].examples[which]);
            mpz_clear(c->edits[i].houses[which]);
        }
    }
    free(c->edits);
    tn_integers_free(c->before, length_count(c));
    tn_integers_free(c->after, length_count(c));
    tn_integers_free(c->kept, length_count(c));
    tn_library_diff_free(c->plans);
    for (int i = 0; i < 2; i++)
        free(c->sides[i].partner);
}
