/* What comparing a library before and after an edit is made of. */
#ifndef TARTAN_ASK_PLAN_DIFF_H
#define TARTAN_ASK_PLAN_DIFF_H

#include "ask/session/session.h"
#include "runtime/plan/library/diff.h"

struct tn_compared_houses;

/* Plans of one part to be shown: the first, then some drawn at random. */
typedef struct tn_diff_sample {
    mpz_t *ranks;
    size_t count, room;
} tn_diff_sample;

/* What pictures are made of (tn_compared.shown). It borrows from both sessions. */
typedef struct tn_plan_diff {
    tn_library_diff *diff;
    tn_diff_sample samples[TN_DIFF_PARTS];
} tn_plan_diff;

/* The plan of a rank of a part: its trays (room for the part's longest), and its rank in its own library. */
tn_status tn_plan_diff_at(const tn_plan_diff *diff, tn_diff_part part, const mpz_t rank, tn_tray *trays,
                          uint32_t *length, mpz_t own, tn_error *error);

/* The word of an answer for a change. */
const char *tn_change_word(tn_clause_change change);

/* How measures change that both files have. One that passes a limit is left out, with a note. */
tn_status tn_diff_measures(tn_session *session, const tn_ready_library *before, const tn_ready_library *after,
                           tn_compared *compared, tn_error *error);

/* The weights and the preferences that differ. */
tn_status tn_diff_leanings(const tn_ready_library *before, const tn_ready_library *after, tn_compared *compared,
                           tn_error *error);

/* The same question about libraries of houses. `other`: the session of the file before the edit. */
tn_status tn_diff_houses(tn_session *session, tn_session *other, const tn_diff_request *request, tn_reply *answer);

/* What was found as the answer, which takes over the examples. */
tn_status tn_diff_houses_answer(const tn_diff_request *request, struct tn_compared_houses *found, tn_compared *answer,
                                tn_error *error);

#endif
