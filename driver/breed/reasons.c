/* Counts why sentences could not be scored. */
#include "driver/breed/reasons.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void count_reason(tn_reasons *r, tn_score_state state, const char *text, uint64_t id)
{
    size_t at = 0;
    while (at < r->count && (r->items[at].state != state || strcmp(r->items[at].text, text) != 0))
        at++;
    if (at == TN_REASONS_MAX)
        at--;
    if (at == r->count) {
        r->items[r->count++] = (tn_reason){.state = state, .first = id};
        snprintf(r->items[at].text, sizeof r->items[at].text, "%s", text);
    }
    r->items[at].count++;
    if (id < r->items[at].first)
        r->items[at].first = id;
}

static int compare_reasons(const void *left, const void *right)
{
    const tn_reason *a = left, *b = right;
    if (a->count != b->count)
        return a->count > b->count ? -1 : 1;
    return strcmp(a->text, b->text);
}

/* The message of a member with this sentence that was evaluated in this generation, or NULL. */
static const char *known_message(const tn_individual *const *members, size_t count, const tn_individual *wanted)
{
    for (size_t i = 0; i < count; i++)
        if (members[i]->message[0] && members[i]->hash[0] == wanted->hash[0] && members[i]->hash[1] == wanted->hash[1])
            return members[i]->message;
    return NULL;
}

static tn_status reason_of(const tn_run *run, const tn_individual *member, char message[200], tn_error *error)
{
    const tn_evaluator *evaluator = &run->job->evaluator;
    tn_score score = {0};
    tn_status status = run->store ? tn_run_store_message(run->store, member->id, message, error) : TN_OK;
    if (status != TN_OK || (run->store && message[0]))
        return status;
    message[0] = '\0';
    return evaluator->evaluate(evaluator->context, 0, member->sentence, member->sentence_size, &score, message, error);
}

tn_status tn_run_reasons(const tn_run *run, tn_reasons *reasons, tn_error *error)
{
    size_t count;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    tn_status status = TN_OK;
    *reasons = (tn_reasons){0};
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        tn_score_state state = members[i]->score.state;
        char message[200];
        if (state != TN_SCORE_FAILED && state != TN_SCORE_LIMIT)
            continue;
        const char *known = known_message(members, count, members[i]);
        if (!known)
            status = reason_of(run, members[i], message, error);
        count_reason(reasons, state, known ? known : message, members[i]->id);
    }
    qsort(reasons->items, reasons->count, sizeof *reasons->items, compare_reasons);
    return status;
}
