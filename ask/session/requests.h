/* The questions as functions, and their requests and answers as structs: what requests.def says. */
#ifndef TARTAN_ASK_SESSION_REQUESTS_H
#define TARTAN_ASK_SESSION_REQUESTS_H

#include "ask/session/message.h"

struct tn_session;

/* The most bins that values are put into. */
#define TN_BINS_MAX 100000u

/* The most plans or houses of an answer, and how many of an enumeration are unless more are asked for. */
#define TN_ROWS_MAX 1000000u
#define TN_ROWS_DEFAULT 1000u

/* How many of the best are found unless more are asked for. */
#define TN_BEST_DEFAULT 10u

/* How many of what an edit does are shown, and at most; how many houses are compared one by one, which takes some
 * minutes. */
#define TN_DIFF_SHOWN 3u
#define TN_DIFF_SHOWN_MAX 1000u
#define TN_DIFF_HOUSES UINT64_C(1000000)

/* The most plans that are drawn from a library. */
#define TN_DRAW_SAMPLE_MAX 50000000u

/* The most plans, or houses, of a page. */
#define TN_REPORTED_MAX 2000u

/* The most of the nearest plans that are looked for, and how many are unless more are asked for. */
#define TN_NEAREST_MAX 1000u
#define TN_NEAREST_DEFAULT 3u

#define TN_TYPE_TEXT const char *
#define TN_TYPE_OWNED char *
#define TN_TYPE_TEXTS tn_texts
#define TN_TYPE_OWNEDS tn_owneds
#define TN_TYPE_FLAG bool
#define TN_TYPE_COUNT uint64_t
#define TN_TYPE_COUNTS tn_counts
#define TN_TYPE_WHOLE int64_t
#define TN_TYPE_REAL double
#define TN_TYPE_BIG mpz_t
#define TN_TYPE_EXACT mpq_t
#define TN_TYPE_EXACTS tn_exacts
#define TN_TYPE_TRAYS char *
#define TN_TYPE_BOXED tn_boxed
#define TN_TYPE_BYTES tn_bytes

#define TN_OF_NESTED(OF, NAME) tn_##OF NAME;
#define TN_OF_PART(OF, NAME) tn_##OF NAME;
#define TN_OF_WRITTEN(OF, NAME) char *NAME;
#define TN_OF_LIST(OF, NAME)                                                                                           \
    struct {                                                                                                           \
        tn_##OF *items;                                                                                                \
        size_t count;                                                                                                  \
    } NAME;
#define TN_OF_MAP(OF, NAME) TN_OF_LIST(OF, NAME)

#define TN_HAS_PRESENT(NAME)
#define TN_HAS_UNSAID(NAME)
#define TN_HAS_DEFAULTED(NAME)
#define TN_HAS_OPTIONAL(NAME) bool has_##NAME;
#define TN_HAS_SOMETIMES(NAME) bool has_##NAME;
#define TN_HAS_NULLABLE(NAME) bool has_##NAME;

/* The structs, and how each is described. */
#define TN_MESSAGE(NAME, DOC) typedef struct tn_##NAME tn_##NAME;
#include "ask/session/requests.def"

#define TN_MESSAGE(NAME, DOC) struct tn_##NAME {
#define TN_FIELD(OWNER, PRESENCE, KIND, NAME, UNIT, DOC) TN_HAS_##PRESENCE(NAME) TN_TYPE_##KIND NAME;
#define TN_NUMBER(OWNER, PRESENCE, NAME, LEAST, MOST, UNIT, DOC) TN_HAS_##PRESENCE(NAME) uint64_t NAME;
#define TN_CHOICE(OWNER, NAME, WORDS, DOC) unsigned NAME;
#define TN_OF(OWNER, PRESENCE, KIND, OF, NAME, DOC) TN_HAS_##PRESENCE(NAME) TN_OF_##KIND(OF, NAME)
#define TN_END(NAME)                                                                                                   \
    }                                                                                                                  \
    ;                                                                                                                  \
    extern const tn_message tn_message_##NAME;
#include "ask/session/requests.def"

/* `count` messages of a type in a list that a message has; one more of them (tn_message_add). */
#define TN_NEW_LIST(OF, LIST, COUNT, ERROR) tn_message_list(&tn_message_##OF, (COUNT), (tn_list *)&(LIST), (ERROR))
#define TN_ADD(OF, LIST, ERROR) ((tn_##OF *)tn_message_add(&tn_message_##OF, (tn_list *)&(LIST), (ERROR)))

/* An answer: a message of one of the types that its question may be answered with. */
typedef struct tn_reply {
    const tn_message *message; /* NULL: there is none */
    void *value;               /* owned */
} tn_reply;

/* An empty message of the type as the answer. */
tn_status tn_reply_new(const tn_message *message, tn_reply *answer, tn_error *error);
void tn_reply_clear(tn_reply *answer);

/* How its JSON is laid out. */
tn_json_layout tn_reply_layout(const tn_reply *answer);

/* The answer as that type, or NULL if it is of another one. */
#define TN_REPLY(NAME, ANSWER)                                                                                         \
    ((ANSWER)->message == &tn_message_##NAME ? (tn_##NAME *)(ANSWER)->value : (tn_##NAME *)NULL)

/* All messages, in the order of the table. */
extern const tn_message *const tn_messages[];
extern const size_t tn_message_count;

/* The message of that name; NULL if there is none. */
const tn_message *tn_message_named(const char *name);

#endif
