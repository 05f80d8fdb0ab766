/* Tries houses: which of those that other clauses keep are kept by the ones that ask for walks, too? */
#include "ask/house/tried.h"

#include <inttypes.h>
#include <stdlib.h>

#include "runtime/house/house.h"
#include "runtime/house/rule/stages.h"

tn_status tn_tried_begin(tn_numbered *n, uint64_t most, tn_tried_houses *t, tn_error *error)
{
    uint32_t count;
    *t = (tn_tried_houses){.n = n, .most = n->max_houses > 0 ? n->max_houses : most};
    tn_status status = tn_clauses_not_walking(&n->form, n->record, &t->clauses, &count, error);
    if (status != TN_OK)
        return status;
    tn_other_clauses_set(&n->form, n->record, t->clauses, count, &t->other);
    tn_numbered_other(n, &t->other.module, &t->other.library, n->plans, &t->without);
    return TN_OK;
}

void tn_tried_clear(tn_tried_houses *t)
{
    if (t->without.session)
        tn_numbered_other_close(&t->without);
    free(t->clauses);
    *t = (tn_tried_houses){0};
}

bool tn_tried_more(const tn_tried_houses *t)
{
    return t->tried < t->most;
}

tn_status tn_tried_try(tn_tried_houses *t, const tn_house *house, bool *kept, tn_error *error)
{
    tn_house same = *house;
    same.form = &t->n->form;
    tn_status status = tn_watch_check(t->n->form.module->watch, error);
    if (status == TN_OK)
        status = tn_numbered_keeps(t->n, &same, kept, error);
    t->tried++;
    t->kept += status == TN_OK && *kept;
    return status;
}

tn_status tn_tried_end(const tn_tried_houses *t, uint64_t wanted, tn_error *error)
{
    const char *name = tn_text(t->n->form.module, t->n->record->name);
    if (t->kept > 0) {
        tn_session_note(t->n->session,
                        "%" PRIu64 " house%s of `%.80s` %s tried, and %" PRIu64 " %s kept by the clauses that ask for "
                        "walks%s: --max-houses N tries more",
                        t->tried, t->tried == 1 ? "" : "s", name, t->tried == 1 ? "was" : "were", t->kept,
                        t->kept == 1 ? "is" : "are", wanted > 0 ? ", fewer than were asked for" : "");
        return TN_OK;
    }
    tn_fail(error, TN_LIMIT, E_NONE_KEPT,
            "none of %" PRIu64 " houses of `%.80s` that were tried is kept by the clauses that ask for walks", t->tried,
            name);
    tn_error_help(error,
                  "`tartan explain FILE HOUSE` with one of them says from which cells it is too far; --max-houses "
                  "N tries more, and `tartan count` with --plan PLAN or '#P' counts those on one plan");
    return TN_LIMIT;
}
