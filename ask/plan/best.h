/* What finding the best plans or houses by measures is made of. */
#ifndef TARTAN_ASK_PLAN_BEST_H
#define TARTAN_ASK_PLAN_BEST_H

#include "ask/house/diverse.h"
#include "ask/house/numbered.h"
#include "ask/house/ordered.h"
#include "ask/plan/found.h"
#include "ask/session/spelled.h"
#include "runtime/base/picture.h"
#include "runtime/house/count/houses.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/complete.h"
#include "runtime/plan/measure/pareto.h"

/* The same, found among the measures of the library's plans. */
tn_status tn_wishes_of_plans(tn_session *session, const tn_ready_library *ready, const tn_wish *items, size_t count,
                             uint32_t least, tn_wishes *wishes);

/* Says how many plans are left out since they have no value of one of the measures. */
tn_status tn_wishes_note_none(tn_session *session, const tn_wishes *wishes, tn_weighed *weighed, tn_error *error);

/* Makes room for values of measures, in nanometres to their power; and takes it away. */
void tn_wishes_room(mpq_t values[TN_WEIGHED_MAX]);
void tn_wishes_clear(mpq_t values[TN_WEIGHED_MAX]);

/* A value for people (malloc); NULL: out of memory. */
char *tn_wish_text(const tn_wishes *wishes, uint32_t k, const mpq_t value);

/* The same with its unit as pictures have it. */
char *tn_wish_caption(const tn_wishes *wishes, uint32_t k, const mpq_t value);

/* ---- what answers carry for pictures (tn_boxed); each borrows from the session */

/* The front of a library of plans. */
typedef struct tn_plan_front {
    const tn_ready_library *ready;
    tn_wishes wishes;
    tn_weighed *weighed;
    tn_pareto_front front;
} tn_plan_front;

/* What an open plan leaves to choose. */
typedef struct tn_open_choices {
    const tn_schema *schema;
    tn_schema *own;          /* the same, of houses */
    const char *title, *doc; /* of the library */
    const char *what;        /* "plans" or "houses" */
    tn_spelled spelled;      /* the open plan as it was read, */
    tn_open_tray *trays;     /* [spelled.count]: its trays, */
    tn_open_plan open;       /* and both as completions are counted */
    tn_weighed *weighed;     /* of plans by a measure */
    tn_completions found;
    tn_wishes wishes; /* none, or one */
    mpq_t step;       /* of its measure, in nanometres to its power */
    char *why;        /* of plans, if there are none: what tn_open_why_none says, until the answer has it */
} tn_open_choices;

/* Appends why no plan of the library completes an open plan, in lines; the last has no end. */
tn_status tn_open_why_none(const tn_ready_library *ready, const tn_open_plan *open, tn_buffer *text, tn_error *error);

/* ---- houses: the measures made ready, and what was found */

typedef struct tn_houses_search {
    tn_numbered n;
    tn_wishes found; /* what is wished, with units and whole names */
    tn_plan plan;    /* if one is given */
    tn_ordered_houses by;
    uint64_t given, wanted; /* houses so far, and in all */
    bool diverse;           /* they differ as people see it */
    tn_lines_taken taken;   /* then: those given */
    uint64_t reached;       /* and: of so many houses the values are known, at least */
} tn_houses_search;

/* What is searched: the library, one plan of it or NULL, how many of the best are wanted, and by which measures. */
typedef struct tn_house_asked {
    const tn_library_asked *subject;
    const char *plan;
    uint64_t wanted;
    bool diverse; /* houses that differ as people see it (ask/house/diverse.h), the best of those */
    tn_houses_aim aim;
    const tn_wish *by;
    size_t by_count;
    uint32_t by_least; /* how many of them there have to be */
} tn_house_asked;

/* Opens the library and finds the values. What is wrong is said. End it in any case. */
tn_status tn_houses_search_begin(tn_houses_search *search, tn_session *session, const tn_house_asked *asked);
void tn_houses_search_end(tn_houses_search *search);

/* Begins a search, has `give` make the answer of it, and ends it. What is wrong is said. */
tn_status tn_houses_search_give(tn_session *session, const tn_house_asked *asked,
                                tn_status (*give)(tn_houses_search *search, tn_reply *answer), tn_reply *answer);

/* Comes to a point, and calls `each` with its houses until it stops, diverse ones only if they differ so from those
 * before. */
tn_status tn_houses_search_of_point(tn_houses_search *search, size_t point, tn_house_alike alike, tn_house_each *each,
                                    void *context, tn_error *error);

/* Calls `each` with the best houses, by value and then by rank, until it stops; of a point with those that it has. It
 * is `each` who counts them in search->given. Diverse ones: the best on each plan; if that is not enough, those whose
 * section differs from that of each before on their plan; then by functions, faces and tiles. */
tn_status tn_houses_search_each(tn_houses_search *search, tn_house_each *each, void *context, tn_error *error);

/* A choice's place in found.counts and found.best. */
static inline size_t tn_open_choice_at(const tn_open_choices *c, uint32_t tray, uint32_t field, uint32_t value)
{
    return (size_t)tray * c->found.values + c->schema->value_start[field] + value;
}

/* The best that the measure can still be with the value at that place of found.counts, for people (malloc); NULL, too,
 * if none is asked for, or the value cannot stand there. And what it is: "least cost". */
char *tn_open_best_text(const tn_open_choices *choices, size_t at);
void tn_open_best_name(const tn_open_choices *choices, char *text, size_t size);

/* Draws them. */
tn_status tn_open_choices_draw(const tn_open_choices *choices, tn_picture *to, tn_error *error);

#endif
