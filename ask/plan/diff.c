/* diff: what an edit does to a library. */
#include "ask/plan/diff.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/plan/found.h"
#include "ask/plan/sheet.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "driver/open/digits.h"

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

static tn_status diff_plans(comparing *c, tn_reply *answer)
{
    tn_error error;
    tn_status status = tn_session_library(c->other, &c->request->subject, &c->before);
    if (status == TN_OK)
        status = tn_session_library(c->session, &c->request->subject, &c->after);
    if (status != TN_OK)
        return status;
    status = tn_reply_new(&tn_message_compared, answer, &error);
    if (status == TN_OK) {
        tn_compared *to = answer->value;
        tn_plan_diff *d = calloc(1, sizeof *d);
        to->shown = (tn_boxed){d, free_diff};
        status = d ? compare(c, d, to, &error) : tn_fail_memory(&error);
    }
    return status == TN_OK ? TN_OK : tn_session_fail(c->session, &error);
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
