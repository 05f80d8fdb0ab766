/* The questions as functions, and their requests and answers as structs: what requests.def says. */
#ifndef TARTAN_ASK_SESSION_REQUESTS_H
#define TARTAN_ASK_SESSION_REQUESTS_H

#include <gmp.h>
#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "runtime/base/error.h"
#include "runtime/base/json.h"

/* Requests and answers as messages: structs whose members a table describes, so that one reader and one writer of JSON
 * do for all.
 *
 * requests.def has the members, and requests.h the structs that they make. A message's texts are borrowed, from the
 * request or from the file that is asked about, unless they are TN_MESSAGE_OWNED. */

typedef enum tn_message_kind {
    TN_MESSAGE_TEXT,    /* const char *, borrowed */
    TN_MESSAGE_OWNED,   /* char *, to be freed */
    TN_MESSAGE_TEXTS,   /* tn_texts */
    TN_MESSAGE_OWNEDS,  /* tn_owneds */
    TN_MESSAGE_FLAG,    /* bool */
    TN_MESSAGE_CHOICE,  /* unsigned: which of some words; the first, 0, unless it is given */
    TN_MESSAGE_COUNT,   /* uint64_t */
    TN_MESSAGE_COUNTS,  /* tn_counts */
    TN_MESSAGE_WHOLE,   /* int64_t */
    TN_MESSAGE_REAL,    /* double */
    TN_MESSAGE_BIG,     /* mpz_t; in JSON a string of digits */
    TN_MESSAGE_EXACT,   /* mpq_t; in JSON a string, "7/2" */
    TN_MESSAGE_EXACTS,  /* tn_exacts */
    TN_MESSAGE_NESTED,  /* another message */
    TN_MESSAGE_PART,    /* another message, whose members stand among this one's */
    TN_MESSAGE_LIST,    /* tn_list of messages */
    TN_MESSAGE_MAP,     /* the same; in JSON an object: of each message the first member is the key, and the second the
                           value */
    TN_MESSAGE_WRITTEN, /* char *, to be freed: members of another message, or the list that a listing is, written as
                           JSON already (never spread over lines) */
    TN_MESSAGE_TRAYS,   /* the trays of a plan, among members that are written already */
    TN_MESSAGE_BYTES,   /* tn_bytes; in JSON a string in base64 */
    TN_MESSAGE_BOXED,   /* tn_boxed: what texts and pictures are made of, and no part of JSON */
} tn_message_kind;

typedef enum tn_message_presence {
    TN_PRESENT,   /* always there; a request without it is wrong */
    TN_DEFAULTED, /* of a request: zero, NULL or none unless it is given */
    TN_OPTIONAL,  /* only if has_NAME says so */
    TN_SOMETIMES, /* of an owned text: the same, and null if it is NULL */
    TN_NULLABLE,  /* null unless has_NAME says so */
    TN_UNSAID,    /* always there, but no part of JSON */
} tn_message_presence;

typedef struct tn_texts {
    const char **items;
    size_t count;
} tn_texts;

/* What only its maker knows the type of. */
typedef struct tn_boxed {
    void *value; /* owned, or NULL */
    void (*free)(void *value);
} tn_boxed;

void tn_boxed_free(tn_boxed *boxed);

/* Texts that are freed with the message. */
typedef struct tn_owneds {
    char **items;
    size_t count;
} tn_owneds;

/* Any bytes, freed with the message. */
typedef struct tn_bytes {
    uint8_t *items;
    size_t count;
} tn_bytes;

/* Freed with the message. */
typedef struct tn_counts {
    uint64_t *items;
    size_t count;
} tn_counts;

typedef struct tn_exacts {
    mpq_t *items;
    size_t count;
} tn_exacts;

/* Of messages of one type; requests.h has a type of the same layout for each. */
typedef struct tn_list {
    void *items;
    size_t count;
} tn_list;

typedef struct tn_message_member {
    const char *name;
    tn_message_kind kind;
    tn_message_presence presence;
    size_t offset;
    size_t has;                  /* the offset of has_NAME, if it is TN_OPTIONAL, TN_SOMETIMES or TN_NULLABLE */
    const struct tn_message *of; /* of messages: their type */
    uint64_t least, most;        /* of numbers of requests; both are 0 otherwise */
    const char *words;           /* of a choice, with | between them */
    const char *unit;            /* "" if it has none */
    const char *doc;             /* one sentence */
} tn_message_member;

/* What it is in JSON. */
typedef enum tn_message_form {
    TN_MESSAGE_OBJECT,
    TN_MESSAGE_TUPLE,   /* a list of its members' values */
    TN_MESSAGE_LISTING, /* the value of its one member, a list */
} tn_message_form;

typedef struct tn_message {
    const char *name, *doc;
    tn_message_form form;
    size_t size;
    const tn_message_member *members;
    size_t member_count;
} tn_message;

/* Reads the next of the words of a choice, and goes on behind it; NULL: there is none. It ends after `size` bytes. */
const char *tn_message_word(const char **words, size_t *size);

/* Zeros and empty lists. Clear it. */
void tn_message_init(const tn_message *message, void *value);
void tn_message_clear(const tn_message *message, void *value);

/* `count` such messages in the list, which is empty. */
tn_status tn_message_list(const tn_message *message, size_t count, tn_list *list, tn_error *error);

/* One more such message at the end of a list that holds only such that were added so; NULL: out of memory. */
void *tn_message_add(const tn_message *message, tn_list *list, tn_error *error);

/* Room for `count` numbers, which are 0, in an empty list. */
tn_status tn_exacts_room(tn_exacts *exacts, size_t count, tn_error *error);

/* Takes the text (malloc) into the list, also if that fails. NULL is TN_MEMORY. */
tn_status tn_owneds_add(tn_owneds *texts, char *text, tn_error *error);

/* Writes the message in its form. */
void tn_message_write(const tn_message *message, const void *value, const char *key, tn_json *json);

/* Reads an object into a message that was initialised, and borrows its texts. TN_INVALID names what it does not know,
 * what is missing and what is of another type. */
tn_status tn_message_read(const tn_message *message, json_t *object, void *value, tn_error *error);

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
#define TN_REPORTED_HOUSES_MAX 12u /* that are side by side on a page */

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
