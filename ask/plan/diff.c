/* diff: what an edit does to a library. */
#include "ask/plan/diff.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/house/compared.h"
#include "ask/plan/draw.h"
#include "ask/plan/found.h"
#include "ask/plan/searched.h"
#include "ask/plan/weights.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "driver/open/digits.h"
#include "runtime/plan/match/same.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/moments.h"
#include "runtime/plan/measure/named.h"

/* ---- what an edit does to a library of houses */

/* What is removed, added and kept of one length. */
static void count_houses_of_length(const tn_compared_houses *c, size_t k, tn_compared_counts *counts)
{
    mpz_set(counts->kept, c->kept[k]);
    mpz_sub(counts->removed, c->before[k], c->kept[k]);
    mpz_sub(counts->added, c->after[k], c->kept[k]);
}

static tn_status set_house_counts(const tn_compared_houses *c, tn_compared *to, tn_error *error)
{
    tn_status status = TN_NEW_LIST(compared_length, to->by_length, (size_t)c->high - c->low + 1, error);
    for (size_t k = 0; status == TN_OK && k < to->by_length.count; k++) {
        tn_compared_counts *counts = &to->by_length.items[k].counts;
        to->by_length.items[k].length = c->low + k;
        count_houses_of_length(c, k, counts);
        mpz_add(to->total.removed, to->total.removed, counts->removed);
        mpz_add(to->total.added, to->total.added, counts->added);
        mpz_add(to->total.kept, to->total.kept, counts->kept);
    }
    return status;
}

/* Takes over the examples. */
static tn_status set_edit(tn_house_edit *edit, tn_compared_clause *to, tn_error *error)
{
    tn_owneds *const lists[2] = {&to->houses.removed, &to->houses.added};
    tn_status status = TN_OK;
    to->name = edit->name;
    to->change = tn_change_word(edit->change);
    to->has_houses = true;
    mpz_set(to->removes, edit->houses[0]);
    mpz_set(to->adds, edit->houses[1]);
    for (int which = 0; which < 2; which++)
        for (size_t i = 0; status == TN_OK && i < edit->example_count[which]; i++) {
            status = tn_owneds_add(lists[which], edit->examples[which][i], error);
            edit->examples[which][i] = NULL;
        }
    return status;
}

tn_status tn_diff_houses_answer(const tn_diff_request *request, tn_compared_houses *c, tn_compared *to, tn_error *error)
{
    const tn_numbered *before = &c->sides[0].n, *after = &c->sides[1].n;
    to->before = (tn_compared_library){request->before, tn_text(before->form.module, before->record->name)};
    to->after = (tn_compared_library){after->session->opened->path, tn_text(after->form.module, after->record->name)};
    tn_status status = set_house_counts(c, to, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(compared_clause, to->clauses, c->edit_count, error);
    for (size_t i = 0; status == TN_OK && i < c->edit_count; i++)
        status = set_edit(&c->edits[i], &to->clauses.items[i], error);
    return status;
}

static tn_status compare_all_houses(tn_session *session, const tn_diff_request *r, tn_compared_houses *c,
                                    tn_reply *answer)
{
    const tn_compared_options options = {.shown = r->has_sample ? (size_t)r->sample : TN_DIFF_SHOWN,
                                         .seed = r->seed,
                                         .one_by_one =
                                             r->subject.has_max_houses ? r->subject.max_houses : TN_DIFF_HOUSES};
    tn_error error;
    tn_status status = tn_houses_compare(c, &options, &error);
    if (status == TN_OK)
        status = tn_reply_new(&tn_message_compared, answer, &error);
    if (status == TN_OK)
        status = tn_diff_houses_answer(r, c, answer->value, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

tn_status tn_diff_houses(tn_session *session, tn_session *other, const tn_diff_request *request, tn_reply *answer)
{
    const tn_house_settings settings = tn_asked_houses(&request->subject);
    tn_compared_houses c = {0};
    tn_status status = tn_numbered_open(&c.sides[0].n, other, &settings);
    if (status == TN_OK)
        status = tn_numbered_open(&c.sides[1].n, session, &settings);
    c.sides[0].n.by_plan = c.sides[1].n.by_plan = true;
    if (status == TN_OK)
        status = compare_all_houses(session, request, &c, answer);
    tn_houses_compare_clear(&c);
    tn_numbered_close(&c.sides[0].n);
    tn_numbered_close(&c.sides[1].n);
    return status;
}

/* ---- diff */

/* What a library weighs or prefers: each with its number, and a hash of what it is about. */
typedef struct leaning {
    const char *name, *number;
    uint64_t about[2];
    bool met; /* has it been compared? */
} leaning;

typedef struct weights_side {
    leaning *items;
    uint32_t count;
} weights_side;

/* Where differences go: the list of the answer. */
typedef struct telling {
    tn_list *list;
    tn_error *error;
    bool any;
} telling;

static bool make_room(weights_side *s, uint32_t count)
{
    *s = (weights_side){.items = calloc((size_t)count + 1, sizeof *s->items), .count = count};
    return s->items != NULL;
}

static tn_status read_weights(const tn_module *module, const tn_library_record *library, weights_side *s,
                              tn_error *error)
{
    tn_status status = make_room(s, library->weight_count) ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < s->count; i++) {
        const tn_weight_record *weight = &module->WEIGHT_records[library->weight_first + i];
        s->items[i].name = tn_text(module, weight->name);
        s->items[i].number = tn_text(module, weight->factor);
        status = tn_code_hash(module, module->TERM_records[module->SUM_records[weight->sum].term_first].part,
                              s->items[i].about, error);
    }
    return status;
}

static tn_status read_preferences(const tn_module *module, const tn_library_record *library, weights_side *s,
                                  tn_error *error)
{
    tn_status status = make_room(s, library->preference_count) ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < s->count; i++) {
        const tn_preference_record *preference = &module->PREFERENCE_records[library->preference_first + i];
        const tn_term_record *term = &module->TERM_records[module->SUM_records[preference->sum].term_first + i];
        s->items[i].name = tn_text(module, preference->name);
        s->items[i].number = tn_text(module, term->factor);
        status = tn_code_hash(module, term->part, s->items[i].about, error);
    }
    return status;
}

/* before, after: or NULL. */
static tn_status tell(telling *t, const leaning *before, const leaning *after)
{
    tn_clause_change change = before && after ? TN_CLAUSE_CHANGED : after ? TN_CLAUSE_ADDED : TN_CLAUSE_REMOVED;
    tn_compared_weight *to = tn_message_add(&tn_message_compared_weight, t->list, t->error);
    if (!to)
        return TN_MEMORY;
    t->any = true;
    to->name = (after ? after : before)->name;
    to->change = tn_change_word(change);
    to->has_before = before != NULL;
    to->has_after = after != NULL;
    if (before) {
        mpq_set_str(to->before, before->number, 10);
        to->shown_before = tn_weight_text(to->before);
    }
    if (after) {
        mpq_set_str(to->after, after->number, 10);
        to->shown_after = tn_weight_text(to->after);
    }
    bool shown = (to->shown_before || !before) && (to->shown_after || !after);
    return shown ? TN_OK : tn_fail_memory(t->error);
}

/* Pairs those about the same: first those of the same number too, which did not change. */
static tn_status pair(weights_side *sides, bool same_number, telling *t)
{
    tn_status status = TN_OK;
    for (leaning *b = sides[0].items; status == TN_OK && b < sides[0].items + sides[0].count; b++)
        for (leaning *a = sides[1].items; status == TN_OK && !b->met && a < sides[1].items + sides[1].count; a++) {
            bool same = strcmp(b->number, a->number) == 0;
            if (a->met || memcmp(b->about, a->about, sizeof b->about) != 0 || same != same_number)
                continue;
            b->met = a->met = true;
            if (!same)
                status = tell(t, b, a);
        }
    return status;
}

static tn_status tell_all(weights_side *sides, telling *t)
{
    tn_status status = pair(sides, true, t);
    if (status == TN_OK)
        status = pair(sides, false, t);
    for (uint32_t b = 0; status == TN_OK && b < sides[0].count; b++)
        if (!sides[0].items[b].met)
            status = tell(t, &sides[0].items[b], NULL);
    for (uint32_t a = 0; status == TN_OK && a < sides[1].count; a++)
        if (!sides[1].items[a].met)
            status = tell(t, NULL, &sides[1].items[a]);
    return status;
}

/* read: read_weights or read_preferences. */
static tn_status
compare_weights(const tn_ready_library *const ready[2],
                tn_status (*read)(const tn_module *, const tn_library_record *, weights_side *, tn_error *), telling *t)
{
    weights_side sides[2] = {0};
    tn_status status = TN_OK;
    for (int i = 0; status == TN_OK && i < 2; i++)
        status = read(ready[i]->schema->module, ready[i]->record, &sides[i], t->error);
    if (status == TN_OK)
        status = tell_all(sides, t);
    free(sides[0].items);
    free(sides[1].items);
    return status;
}

tn_status tn_diff_leanings(const tn_ready_library *before, const tn_ready_library *after, tn_compared *compared,
                           tn_error *error)
{
    const tn_ready_library *const ready[2] = {before, after};
    telling weights = {(tn_list *)&compared->weights, error, false},
            preferences = {(tn_list *)&compared->preferences, error, false};
    tn_status status = compare_weights(ready, read_weights, &weights);
    if (status == TN_OK)
        status = compare_weights(ready, read_preferences, &preferences);
    compared->has_weights = weights.any;
    compared->has_preferences = preferences.any;
    return status;
}

/* ---- compares the measures of two libraries */

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

const char *tn_change_word(tn_clause_change change)
{
    static const char *const words[] = {
        [TN_CLAUSE_CHANGED] = "changed", [TN_CLAUSE_ADDED] = "added", [TN_CLAUSE_REMOVED] = "removed"};
    return words[change];
}

/* ---- which plans to show */

static void free_diff(void *made)
{
    tn_plan_diff *d = made;
    for (int part = 0; part < TN_DIFF_PARTS; part++) {
        for (size_t i = 0; i < d->samples[part].room; i++)
            mpz_clear(d->samples[part].ranks[i]);
        free(d->samples[part].ranks);
    }
    tn_library_diff_free(d->diff);
    free(d);
}

static tn_status take(const tn_library *library, size_t wanted, uint64_t seed, tn_diff_sample *sample, tn_error *error)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    size_t most = mpz_cmp_ui(kept, wanted) < 0 ? (size_t)mpz_get_ui(kept) : wanted, found = 0;
    bool any = mpz_sgn(kept) > 0;
    mpz_clear(kept);
    sample->ranks = malloc((most + 2) * sizeof *sample->ranks);
    if (!sample->ranks)
        return tn_fail_memory(error);
    for (; sample->room <= most; sample->room++)
        mpz_init(sample->ranks[sample->room]);
    if (!any)
        return TN_OK;
    tn_status status = tn_library_sample(library, seed, TN_ALL_LENGTHS, most, sample->ranks + 1, &found, error);
    if (status != TN_OK)
        return status;
    sample->count = found + 1;
    if (found > 0 && mpz_sgn(sample->ranks[1]) == 0) { /* the first was drawn, too */
        for (size_t i = 1; i < found; i++)
            mpz_set(sample->ranks[i], sample->ranks[i + 1]);
        sample->count--;
    }
    return TN_OK;
}

tn_status tn_plan_diff_at(const tn_plan_diff *d, tn_diff_part part, const mpz_t rank, tn_tray *trays, uint32_t *length,
                          mpz_t own, tn_error *error)
{
    if (!tn_library_unrank(tn_library_diff_part(d->diff, part), rank, trays, length))
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a rank is not in the difference");
    return tn_library_diff_rank(d->diff, part, trays, *length, own, error);
}

/* ---- the answer */

static void count_length(const tn_plan_diff *d, uint32_t length, tn_compared_counts *counts)
{
    mpz_ptr const to[TN_DIFF_PARTS] = {counts->removed, counts->added, counts->kept};
    for (int part = 0; part < TN_DIFF_PARTS; part++)
        tn_library_kept(tn_library_diff_part(d->diff, (tn_diff_part)part), length, to[part]);
}

static tn_status set_counts(const tn_plan_diff *d, tn_compared *to, tn_error *error)
{
    const tn_library *any = tn_library_diff_part(d->diff, TN_DIFF_KEPT);
    uint32_t low = tn_library_min(any), high = tn_library_max(any);
    count_length(d, TN_ALL_LENGTHS, &to->total);
    tn_status status = TN_NEW_LIST(compared_length, to->by_length, high < low ? 0 : (size_t)high - low + 1, error);
    for (size_t i = 0; status == TN_OK && i < to->by_length.count; i++) {
        to->by_length.items[i].length = low + i;
        count_length(d, low + (uint32_t)i, &to->by_length.items[i].counts);
    }
    return status;
}

static const char *clause_name(const tn_module *const modules[2], const tn_changed_clause *clause)
{
    if (clause->lengths)
        return "trays";
    int side = clause->after != UINT32_MAX;
    return tn_text(modules[side], modules[side]->CLAUSE_records[side ? clause->after : clause->before].name);
}

static tn_status set_clauses(const tn_plan_diff *d, const tn_module *const modules[2], tn_compared *to, tn_error *error)
{
    size_t count = tn_library_diff_clauses(d->diff);
    tn_status status = TN_NEW_LIST(compared_clause, to->clauses, count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        const tn_changed_clause *from = tn_library_diff_clause(d->diff, i);
        tn_compared_clause *clause = &to->clauses.items[i];
        clause->name = clause_name(modules, from);
        clause->change = tn_change_word(from->change);
        mpz_set(clause->removes, from->removes);
        mpz_set(clause->adds, from->adds);
    }
    return status;
}

static tn_status set_plan(const tn_plan_diff *d, tn_diff_part part, const mpz_t rank, tn_ranked_line *to,
                          tn_error *error)
{
    const tn_library *library = tn_library_diff_part(d->diff, part);
    tn_tray *trays = malloc(((size_t)tn_library_max(library) + 1) * sizeof *trays);
    uint32_t length = 0;
    tn_status status = trays ? tn_plan_diff_at(d, part, rank, trays, &length, to->rank, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_found_plan_texts(tn_library_schema(library), trays, length, &to->plan, NULL, error);
    free(trays);
    return status;
}

static tn_status set_plans(tn_plan_diff *d, size_t count, uint64_t seed, tn_compared_plans *to, tn_error *error)
{
    tn_list *const lists[TN_DIFF_PARTS] = {(tn_list *)&to->removed, (tn_list *)&to->added, (tn_list *)&to->kept};
    tn_status status = TN_OK;
    for (int part = 0; status == TN_OK && part < TN_DIFF_PARTS; part++) {
        const tn_diff_sample *sample = &d->samples[part];
        status = take(tn_library_diff_part(d->diff, (tn_diff_part)part), count, seed, &d->samples[part], error);
        if (status == TN_OK)
            status = tn_message_list(&tn_message_ranked_line, sample->count, lists[part], error);
        for (size_t i = 0; status == TN_OK && i < sample->count; i++)
            status = set_plan(d, (tn_diff_part)part, sample->ranks[i], (tn_ranked_line *)lists[part]->items + i, error);
    }
    return status;
}

typedef struct comparing {
    tn_session *session, *other;
    const tn_diff_request *request;
    const tn_ready_library *before, *after;
} comparing;

/* ---- the picture: removed plans, added ones, kept ones, each under a heading */

enum { NOTE_SIZE = 400 };
static const char *const part_names[TN_DIFF_PARTS] = {"removed", "added", "kept"};

/* Its rank in its library stands under a plan: a removed one's in the library before, the others' in that after. */
static tn_status add_plan(const tn_plan_diff *d, tn_diff_part part, const mpz_t rank, const char *heading,
                          tn_plan_sheet *s, tn_error *error)
{
    const tn_library *library = tn_library_diff_part(d->diff, part);
    tn_tray *trays = malloc(((size_t)tn_library_max(library) + 1) * sizeof *trays);
    uint32_t length = 0;
    mpz_t own;
    if (!trays)
        return tn_fail_memory(error);
    mpz_init(own);
    tn_status status = tn_plan_diff_at(d, part, rank, trays, &length, own, error);
    if (status == TN_OK)
        status = tn_sheet_add(s, trays, length, mpz_get_str(NULL, 10, own), heading, NULL, error);
    mpz_clear(own);
    free(trays);
    return status;
}

static void describe(const tn_plan_diff *d, tn_diff_part part, char *note)
{
    mpz_t count;
    mpz_init(count);
    tn_library_kept(tn_library_diff_part(d->diff, part), TN_ALL_LENGTHS, count);
    char *digits = tn_digits(count, true);
    snprintf(note, NOTE_SIZE, "%s: %zu of %s plans", part_names[part], d->samples[part].count, digits ? digits : "?");
    free(digits);
    mpz_clear(count);
}

/* headings: of the three parts. */
static tn_status collect(const tn_plan_diff *d, char headings[TN_DIFF_PARTS][NOTE_SIZE], tn_plan_sheet *s,
                         tn_error *error)
{
    tn_status status = TN_OK;
    for (int part = 0; part < TN_DIFF_PARTS; part++)
        for (size_t i = 0; status == TN_OK && i < d->samples[part].count; i++)
            status = add_plan(d, (tn_diff_part)part, d->samples[part].ranks[i], i ? NULL : headings[part], s, error);
    return status;
}

static tn_status draw_sheet(const tn_compared *compared, const tn_diff_request *request, tn_picture *to,
                            tn_error *error)
{
    const tn_plan_diff *d = compared->shown.value;
    char headings[TN_DIFF_PARTS][NOTE_SIZE], made_of[NOTE_SIZE], title[NOTE_SIZE];
    const char *lines[TN_DIFF_PARTS + 1] = {headings[0], headings[1], headings[2], made_of};
    tn_plan_sheet s = {0};
    for (int part = 0; part < TN_DIFF_PARTS; part++)
        describe(d, (tn_diff_part)part, headings[part]);
    tn_status status = collect(d, headings, &s, error);
    snprintf(made_of, NOTE_SIZE, "%.160s to %.160s, seed %" PRIu64, compared->before.file, compared->after.file,
             request->seed);
    snprintf(title, sizeof title, "%.160s: what changes", compared->after.library);
    tn_draw_options drawing = {.title = request->title ? request->title : title,
                               .number_name = "rank",
                               .notes = lines,
                               .note_count = TN_DIFF_PARTS + 1};
    if (status == TN_OK)
        status = tn_plans_draw(tn_library_schema(tn_library_diff_part(d->diff, TN_DIFF_KEPT)), s.plans, s.count,
                               &drawing, to, error);
    tn_sheet_clear(&s);
    return status;
}

static tn_status draw(const comparing *c, tn_compared *compared)
{
    const tn_answer_picture *asked = &c->request->drawn;
    tn_picture to = tn_answer_picture_begin(asked);
    tn_error error;
    tn_status status = draw_sheet(compared, c->request, &to, &error);
    return tn_answer_picture_give(c->session, asked, &to, status, &error, (tn_list *)&compared->files,
                                  &compared->has_files);
}

/* ---- asked */

static tn_status compare(const comparing *c, tn_plan_diff *d, tn_compared *to, tn_error *error)
{
    const tn_diff_request *r = c->request;
    const tn_module *const modules[2] = {c->before->schema->module, c->after->schema->module};
    tn_status status = tn_library_diff_new(c->before->library, c->after->library, (uint32_t)r->subject.max_states, NULL,
                                           &d->diff, error);
    if (status != TN_OK)
        error->code_offset = TN_NO_OFFSET;
    to->before = (tn_compared_library){r->before, tn_text(modules[0], c->before->record->name)};
    to->after = (tn_compared_library){c->session->opened->path, tn_text(modules[1], c->after->record->name)};
    to->has_measures = to->has_plans = true;
    if (status == TN_OK && !r->no_measures)
        status = tn_diff_measures(c->session, c->before, c->after, to, error);
    if (status == TN_OK)
        status = tn_diff_leanings(c->before, c->after, to, error);
    if (status == TN_OK)
        status = set_counts(d, to, error);
    if (status == TN_OK)
        status = set_clauses(d, modules, to, error);
    return status == TN_OK ? set_plans(d, r->has_sample ? (size_t)r->sample : TN_DIFF_SHOWN, r->seed, &to->plans, error)
                           : status;
}

/* Both libraries have automata; *over: comparing them passes a limit of states, and *limit says which. */
static tn_status compare_exactly(const comparing *c, bool *over, tn_error *limit, tn_reply *answer)
{
    tn_status status = tn_reply_new(&tn_message_compared, answer, limit);
    if (status == TN_OK) {
        tn_compared *to = answer->value;
        tn_plan_diff *d = calloc(1, sizeof *d);
        to->shown = (tn_boxed){d, free_diff};
        status = d ? compare(c, d, to, limit) : tn_fail_memory(limit);
    }
    *over = status == TN_LIMIT && limit->code == E_TOO_MANY_STATES && tn_plan_search_is_there();
    return status == TN_OK || *over ? status : tn_session_fail(c->session, limit);
}

/* ---- libraries that are searched */

/* The first plans that one library keeps and the other does not. */
static tn_status find_only(const comparing *c, const tn_ready_library *one, const tn_ready_library *other,
                           tn_compared_found *to, tn_error *error)
{
    const tn_diff_request *r = c->request;
    const tn_search_options options = tn_asked_search(&r->subject, &r->search);
    tn_searched_lines lines = {.schema = one->schema,
                               .lines = &to->plans,
                               .most = 1 + (r->has_sample ? (size_t)r->sample : TN_DIFF_SHOWN),
                               .notes_limit = true};
    tn_field_map map = {0};
    tn_tray *trays = NULL;
    tn_plan_search *search = NULL, *without = NULL;
    tn_status status = tn_tray_map(one->schema, other->schema, &trays, error);
    if (status == TN_OK)
        status = tn_field_map_make(one->schema, other->schema, &map, error);
    if (status == TN_OK)
        status = tn_plan_search_new(one->schema, one->index, &options, &search, error);
    if (status == TN_OK)
        status = tn_plan_search_new(other->schema, other->index, &options, &without, error);
    const tn_search_other left_out = {without, map.fields, map.values, trays};
    if (status == TN_OK) {
        tn_plan_search_leave_out(search, &left_out);
        status = tn_searched_list(c->session, search, &lines, error);
        to->more = lines.more;
    }
    tn_plan_search_free(search);
    tn_plan_search_free(without);
    tn_field_map_clear(&map);
    free(trays);
    return status;
}

static tn_status compare_searched(const comparing *c, const tn_error *limit, tn_reply *answer)
{
    tn_error error;
    if (tn_answer_has_picture(&c->request->drawn))
        return tn_session_refuse(c->session, "leave out the picture, or give fewer trays with --trays",
                                 "what changes is drawn with its counts, and libraries that are searched have none");
    tn_searched_note(c->session, limit);
    tn_status status = tn_reply_new(&tn_message_compared_searched, answer, &error);
    if (status != TN_OK)
        return tn_session_fail(c->session, &error);
    tn_compared_searched *to = answer->value;
    to->before = (tn_compared_library){c->request->before, tn_text(c->before->schema->module, c->before->record->name)};
    to->after =
        (tn_compared_library){c->session->opened->path, tn_text(c->after->schema->module, c->after->record->name)};
    tn_session_begins(c->session, "looking for plans that differ");
    status = find_only(c, c->before, c->after, &to->removed, &error);
    if (status == TN_OK)
        status = find_only(c, c->after, c->before, &to->added, &error);
    tn_session_ends(c->session);
    if (status == TN_OK)
        return TN_OK;
    error.code_offset = TN_NO_OFFSET;
    return tn_session_fail(c->session, &error);
}

static tn_status diff_plans(comparing *c, tn_reply *answer)
{
    const tn_library_asked *asked = &c->request->subject;
    tn_error limits[2];
    bool over = false;
    tn_status status = tn_session_searched(c->other, asked, false, &c->before, &limits[0]);
    if (status == TN_OK)
        status = tn_session_searched(c->session, asked, false, &c->after, &limits[1]);
    if (status != TN_OK)
        return status;
    if (!c->before->library || !c->after->library)
        return compare_searched(c, &limits[c->before->library != NULL], answer);
    status = compare_exactly(c, &over, &limits[0], answer);
    if (!over)
        return status;
    tn_reply_clear(answer);
    return compare_searched(c, &limits[0], answer);
}

tn_status tn_ask_diff(tn_session *session, const tn_diff_request *request, tn_reply *answer)
{
    comparing c = {.session = session, .request = request};
    *answer = (tn_reply){0};
    if (!session->other)
        return tn_session_refuse(session, NULL, "no other file can be opened here");
    tn_status status = session->other(session->other_context, request->before, &c.other);
    if (status != TN_OK)
        return status;
    bool houses = tn_session_of_houses(session, &request->subject) || tn_session_of_houses(c.other, &request->subject);
    bool drawn = tn_answer_has_picture(&request->drawn);
    if (houses)
        return drawn ? tn_session_refuse(session, "leave out -o; `tartan house` draws a house by its line",
                                         "houses that are compared are not drawn")
                     : tn_diff_houses(session, c.other, request, answer);
    status = diff_plans(&c, answer);
    return status == TN_OK && drawn ? draw(&c, answer->value) : status;
}
