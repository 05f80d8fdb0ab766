/* The plans or houses that a question finds: given one after another to whoever takes them, or put into the answer. */
#ifndef TARTAN_ASK_PLAN_FOUND_H
#define TARTAN_ASK_PLAN_FOUND_H

#include "ask/plan/ways.h"
#include "ask/session/session.h"
#include "runtime/house/house_names.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/weighed.h"

struct tn_numbered;
/* The measures of a library that a request goes by. */
typedef struct tn_wishes {
    uint32_t count;
    const char *names[TN_WEIGHED_MAX];
    bool most[TN_WEIGHED_MAX];
    tn_amount_unit units[TN_WEIGHED_MAX];
    uint32_t measures[TN_WEIGHED_MAX]; /* of plans: runtime/plan/measure/named.h */
} tn_wishes;

/* A plan or a house. All is borrowed until the next is found, but a house may be taken: then an empty one is left. */
typedef struct tn_found_one {
    mpz_srcptr rank; /* of a plan in its library; of a house among those that are asked for; NULL: not known */
    const tn_tray *trays;
    uint32_t length;
    tn_house *house;    /* NULL: it is a plan */
    mpz_srcptr variant; /* of a house: its number among those on its plan; NULL: not known */
    mpz_srcptr ways;    /* of a plan: in how many it is derived, if that was asked for; or NULL */
    const char *row;    /* of a row of plans (plan_rows.h): its line; or NULL: it is none */
    const char *plans;  /* and its plans, a member of JSON */
    mpq_t *values;      /* of the measures that were asked for, in nanometres to their power; or NULL */
} tn_found_one;

/* What is found: plans of a library, or houses. */
typedef struct tn_found_of {
    const tn_ready_library *plans;
    const struct tn_numbered *houses;
    const tn_wishes *wishes; /* the measures that were asked for, or NULL */
    mpz_ptr from;            /* of an enumeration: the first rank, which `begins` may raise; or NULL */
    mpz_srcptr to;           /* one past its last rank; or NULL */
    uint64_t before;         /* how many of its limit `begins` has already */
    bool ways;               /* of each plan are told, too */
    mpz_srcptr rows;         /* rows of plans are found, so many in all; or NULL */
    bool unranked;           /* ranks are not known */
    mpq_srcptr weight;       /* of a sample that is drawn by weights: of all plans; or NULL */
} tn_found_of;

/* Whoever takes what is found (tn_session.taker). Each says whether the question goes on; if it does not, it ends well,
 * and whoever said so knows why. */
typedef struct tn_taker {
    bool (*begins)(void *context, tn_found_of *of); /* before the first; may be NULL */
    bool (*takes)(void *context, const tn_found_one *found);
    /* Takes all plans of a library from one rank to before another by itself, on so many threads; NULL: it takes each.
     * *ended: it has enough. */
    tn_status (*lists)(void *context, const tn_library *library, mpz_srcptr from, mpz_srcptr to, unsigned threads,
                       bool *ended, tn_error *error);
    void *context;
} tn_taker;

/* The plans or houses of one question. */
typedef struct tn_finds {
    tn_session *session;
    tn_found_of *of;
    tn_reply *answer;
    bool lines;    /* of plans in the answer */
    bool ended;    /* by the taker */
    bool has_ways; /* `ways` is open: `of` tells them */
    tn_ways_of_plans ways;
} tn_finds;

/* An empty answer, and the taker begins. Ends with TN_OK also if it takes nothing: look at `ended`. */
tn_status tn_finds_begin(tn_finds *finds, tn_error *error);

/* TN_STOPPED if the taker has enough: then `ended` is set. */
tn_status tn_finds_give(tn_finds *finds, const tn_found_one *found, tn_error *error);

/* Can it be given plans of ranks that follow one another, all together? After the taker has begun. */
bool tn_finds_lists(const tn_finds *finds);

/* Gives the plans of these ranks; as tn_finds_give. */
tn_status tn_finds_list(tn_finds *finds, mpz_srcptr from, mpz_srcptr to, unsigned threads, tn_error *error);

/* What the question comes to after that status, which is said. */
tn_status tn_finds_end(tn_finds *finds, tn_status status, const tn_error *error);

/* A plan and a house as answers have them, to be freed: the line, and the members of JSON that a message says
 * (plan_members, house_members). `line` or `members` may be NULL: not wanted. */
tn_status tn_found_plan_texts(const tn_schema *schema, const tn_tray *trays, uint32_t length, char **line,
                              char **members, tn_error *error);
tn_status tn_found_house_texts(const tn_house *house, char **line, char **members, tn_error *error);

#endif
