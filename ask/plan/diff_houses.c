/* What an edit does to a library of houses. */
#include <stdlib.h>

#include "ask/house/compared.h"
#include "ask/plan/diff.h"

/* What is removed, added and kept of one length. */
static void count_length(const tn_compared_houses *c, size_t k, tn_compared_counts *counts)
{
    mpz_set(counts->kept, c->kept[k]);
    mpz_sub(counts->removed, c->before[k], c->kept[k]);
    mpz_sub(counts->added, c->after[k], c->kept[k]);
}

static tn_status set_counts(const tn_compared_houses *c, tn_compared *to, tn_error *error)
{
    tn_status status = TN_NEW_LIST(compared_length, to->by_length, (size_t)c->high - c->low + 1, error);
    for (size_t k = 0; status == TN_OK && k < to->by_length.count; k++) {
        tn_compared_counts *counts = &to->by_length.items[k].counts;
        to->by_length.items[k].length = c->low + k;
        count_length(c, k, counts);
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
    tn_status status = set_counts(c, to, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(compared_clause, to->clauses, c->edit_count, error);
    for (size_t i = 0; status == TN_OK && i < c->edit_count; i++)
        status = set_edit(&c->edits[i], &to->clauses.items[i], error);
    return status;
}

static tn_status compare(tn_session *session, const tn_diff_request *r, tn_compared_houses *c, tn_reply *answer)
{
    const tn_compared_options options = {.shown = r->has_sample ? (size_t)r->sample : TN_DIFF_SHOWN,
                                         .seed = r->seed,
                                         .one_by_one = r->has_max_houses ? r->max_houses : TN_DIFF_HOUSES};
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
    if (status == TN_OK)
        status = compare(session, request, &c, answer);
    tn_houses_compare_clear(&c);
    tn_numbered_close(&c.sides[0].n);
    tn_numbered_close(&c.sides[1].n);
    return status;
}
