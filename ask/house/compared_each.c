/* Compares two libraries of houses on the plans that both have, one house after another: each of one library is asked
 * about by its line in the other. */
#include "ask/house/compared.h"

#include <inttypes.h>
#include <stdlib.h>

#include "runtime/base/integers.h"
#include "runtime/house/house.h"
#include "runtime/module/same.h"

/* One way: the houses of `from`, asked about in the other library. */
typedef struct tn_compared_way {
    tn_compared_houses *c;
    const tn_compared_options *options;
    int from;
    tn_house_rules *rules; /* of the other */
    tn_house_edit *form;   /* or NULL */
    uint64_t *left;        /* houses that may still be compared */
    tn_buffer line;
    mpz_t on_both; /* houses of `from` on plans of both */
} tn_compared_way;

static const tn_numbered *other_of(const tn_compared_way *w)
{
    return &w->c->sides[1 - w->from].n;
}

static tn_status blame(const tn_compared_way *w, tn_house_edit *edit, const tn_house *house, tn_error *error)
{
    mpz_add_ui(edit->houses[w->from], edit->houses[w->from], 1);
    return edit->example_count[w->from] <= w->options->shown ? tn_edit_example(edit, w->from, house, error) : TN_OK;
}

/* Blames the clauses that keep it out; where the libraries share them, the form. Is it kept? */
static tn_status judge(const tn_compared_way *w, const tn_house *house, const tn_house *there, bool *kept,
                       tn_error *error)
{
    tn_compared_houses *c = w->c;
    bool blamed = false, drops;
    tn_status status = tn_house_rules_start(w->rules, there, error);
    if (status == TN_OK)
        status = tn_house_rules_keep(w->rules, other_of(w)->record, kept, error);
    for (size_t i = 0; status == TN_OK && !*kept && i < c->edit_count; i++) {
        uint32_t clause = c->edits[i].clause[1 - w->from];
        if (clause == TN_NO_RECORD)
            continue;
        status = tn_house_rules_drop(w->rules, other_of(w)->record, clause, &drops, error);
        if (status == TN_OK && drops)
            status = blame(w, &c->edits[i], house, error);
        blamed = blamed || drops;
    }
    return status == TN_OK && !*kept && !blamed && w->form ? blame(w, w->form, house, error) : status;
}

static tn_status too_many(const tn_compared_options *options, tn_error *error)
{
    tn_status status =
        tn_fail(error, TN_LIMIT, E_COMPARED,
                "the libraries have more than %" PRIu64 " houses to be compared one by one", options->one_by_one);
    tn_error_help(error,
                  "give fewer trays with --trays, or raise the limit with --max-houses; where only clauses come or "
                  "only clauses go, houses are counted together");
    return status;
}

static tn_status compare_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    tn_compared_way *w = context;
    tn_house there;
    bool kept = false;
    *stop = false;
    if ((*w->left)-- == 0)
        return too_many(w->options, error);
    w->line.size = 0;
    mpz_add_ui(w->on_both, w->on_both, 1);
    tn_status status = tn_house_write(house, &w->line, error);
    if (status != TN_OK)
        return status;
    status = tn_house_read(&other_of(w)->form, w->line.data, w->line.size, house->length, &there, error);
    if (status == TN_OK)
        status = judge(w, house, &there, &kept, error);
    else if (status == TN_INVALID && w->form) /* it is no house of the other form */
        status = blame(w, w->form, house, error);
    if (kept && w->from == 0)
        mpz_add_ui(w->c->kept[house->length - w->c->low], w->c->kept[house->length - w->c->low], 1);
    tn_house_clear(&there);
    return status;
}

/* map: NULL, or which tray of the plan's library each tray is. */
static tn_status compare_plan(tn_compared_way *w, const tn_tray *trays, uint32_t length, const tn_tray *map,
                              tn_error *error)
{
    tn_tray *own = malloc(((size_t)length + 1) * sizeof *own);
    mpz_t first;
    if (!own)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < length; i++)
        own[i] = map ? map[trays[i]] : trays[i];
    mpz_init(first);
    tn_status status = tn_watch_check(w->c->sides[w->from].n.form.module->watch, error);
    if (status == TN_OK)
        status = tn_numbered_each(&w->c->sides[w->from].n, own, length, first, compare_house, w, error);
    mpz_clear(first);
    free(own);
    return status;
}

static tn_status compare_plans(tn_compared_way *w, const tn_tray *map, tn_error *error)
{
    const tn_library *plans = tn_library_diff_part(w->c->plans, TN_DIFF_KEPT);
    const tn_tray *trays;
    uint32_t length;
    tn_cursor *cursor = NULL;
    mpz_t from, to;
    mpz_inits(from, to, NULL);
    tn_library_kept(plans, TN_ALL_LENGTHS, to);
    tn_status status = tn_cursor_new(plans, from, to, &cursor, error);
    while (status == TN_OK && tn_cursor_next(cursor, &trays, &length))
        status = compare_plan(w, trays, length, map, error);
    tn_cursor_free(cursor);
    mpz_clears(from, to, NULL);
    return status;
}

/* Does each tray have one number in both? */
static bool is_same_schema(const tn_compared_houses *c)
{
    const tn_numbered *old = &c->sides[0].n, *new = &c->sides[1].n;
    return tn_records_same(old->form.module, old->form.record->schema, new->form.module, new->form.record->schema,
                           TN_SECTION_SCHEMA);
}

/* What the plans remove or add: houses on plans that the other library does not have. New plans whose trays have other
 * numbers are counted without examples. */
static tn_status count_plans(const tn_compared_way *w, tn_error *error)
{
    tn_house_edit *plans = tn_compared_edit(w->c, "plans");
    mpz_t *all = w->from ? w->c->after : w->c->before;
    if (!plans)
        return TN_OK;
    if (w->from == 0 || is_same_schema(w->c))
        return tn_compared_own_plans(w->c, w->from, plans, w->options, error);
    for (uint32_t i = 0; i <= w->c->high - w->c->low; i++)
        mpz_add(plans->houses[w->from], plans->houses[w->from], all[i]);
    mpz_sub(plans->houses[w->from], plans->houses[w->from], w->on_both);
    return TN_OK;
}

static tn_status compare_way(tn_compared_houses *c, int from, const tn_compared_options *options, const tn_tray *map,
                             uint64_t *left, tn_error *error)
{
    tn_compared_way w = {.c = c, .options = options, .from = from, .form = tn_compared_edit(c, "form"), .left = left};
    mpz_init(w.on_both);
    tn_status status = tn_house_rules_new(&other_of(&w)->form, c->high, &w.rules, error);
    if (status == TN_OK)
        status = compare_plans(&w, map, error);
    if (status == TN_OK)
        status = count_plans(&w, error);
    tn_house_rules_free(w.rules);
    free(w.line.data);
    mpz_clear(w.on_both);
    return status;
}

/* As far as that is known before: of the old houses, and of the new ones where the plans are the same. */
static tn_status check_number(const tn_compared_houses *c, const tn_compared_options *options, tn_error *error)
{
    const tn_numbered *n = &c->sides[0].n;
    size_t lengths = (size_t)c->high - c->low + 1;
    mpz_t *old = tn_integers_new(lengths), sum;
    tn_numbered both = {0};
    if (!old)
        return tn_fail_memory(error);
    mpz_init(sum);
    tn_numbered_other(n, n->form.module, n->record, tn_library_diff_part(c->plans, TN_DIFF_KEPT), &both);
    tn_status status = tn_numbered_lengths(&both, c->low, c->high, old, error);
    for (size_t i = 0; i < lengths; i++) {
        mpz_add(sum, sum, old[i]);
        if (!tn_compared_other_plans(c))
            mpz_add(sum, sum, c->after[i]);
    }
    if (status == TN_OK && mpz_cmp_ui(sum, options->one_by_one) > 0)
        status = too_many(options, error);
    tn_numbered_other_close(&both);
    tn_integers_free(old, lengths);
    mpz_clear(sum);
    return status;
}

tn_status tn_compare_each(tn_compared_houses *c, const tn_compared_options *options, tn_error *error)
{
    uint64_t left = options->one_by_one;
    tn_tray *map = NULL;
    tn_status status = check_number(c, options, error);
    if (status == TN_OK)
        status = tn_tray_map(c->sides[0].n.schema, c->sides[1].n.schema, &map, error);
    if (status == TN_OK)
        status = compare_way(c, 0, options, NULL, &left, error);
    if (status == TN_OK)
        status = compare_way(c, 1, options, map, &left, error);
    free(map);
    return status;
}
