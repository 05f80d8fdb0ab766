/* A library of houses, made ready with the library of its plans: counted together or plan by plan, and houses by
 * number: `#P:V`, variant V of the plan of rank P, or `#R`, the house of rank R. */
#ifndef TARTAN_ASK_HOUSE_NUMBERED_H
#define TARTAN_ASK_HOUSE_NUMBERED_H

#include "ask/session/session.h"
#include "driver/house/judge.h"
#include "runtime/house/count/listing.h"
#include "runtime/house/house_names.h"
#include "runtime/house/rank/rank.h"
#include "runtime/plan/library/library.h"

/* What is asked of the library of houses and of its plans. */
typedef struct tn_house_settings {
    const char *library; /* NULL: the only one */
    size_t max_length;
    uint64_t max_houses; /* that are looked at one by one; 0: each question has its default */
    tn_library_options plans;
    const char *const *wheres; /* the further requirements with which the file was opened */
    size_t where_count;
} tn_house_settings;

/* The same of a request. */
tn_house_settings tn_asked_houses(const tn_library_asked *asked);

/* The houses that were asked for last by number. counted: NULL, or those on one plan alone, which is this one. */
typedef struct tn_numbered_ranked {
    const tn_houses *among;
    tn_house_ranks *ranks; /* or NULL */
    tn_houses *counted;
    tn_tray *trays;
    uint32_t length;
} tn_numbered_ranked;

typedef struct tn_numbered {
    tn_session *session;
    const tn_house_library_record *record;
    tn_schema *schema;
    tn_house_form form;
    const tn_library *plans;
    tn_library *opened;        /* the same where tn_numbered_open made it */
    tn_house_listing *listing; /* or NULL: all houses that were asked for could be counted */
    tn_house_rules *rules;     /* or NULL: no house was judged yet */
    tn_houses *all;            /* or NULL: not asked for */
    tn_numbered_ranked ranked;
    bool *walking;        /* [functions of the module] they ask for walks; of the one that was opened */
    uint32_t plans_alone; /* that were counted by themselves */
    uint32_t max_states;
    uint64_t max_houses; /* of tn_house_settings */
    bool by_plan;        /* if walks are asked for, and there are few plans, they are gone through */
    bool not_all;        /* houses were tried, but not all: it was said how many */
} tn_numbered;

/* Close it in any case. What was wrong is said. */
tn_status tn_numbered_open(tn_numbered *n, tn_session *session, const tn_house_settings *settings);

/* The same of a request, with the plan (NULL: none) that it is about: the caller frees its trays in any case, too. */
tn_status tn_numbered_open_on(tn_numbered *n, tn_session *session, const tn_library_asked *asked, const char *text,
                              tn_plan *plan);

/* Says that no library of houses has this name, with what was meant; NULL: that the file has none, or several. Returns
 * TN_INVALID. */
tn_status tn_say_no_houses(tn_session *session, const char *name);
void tn_numbered_close(tn_numbered *n);

/* Does a clause ask for walks or ways out? Then houses are counted and numbered on one plan only. */
bool tn_numbered_walks(const tn_numbered *n);

/* The same form with other clauses, in another copy of its module, or on other plans with the same trays; all are
 * borrowed. Close it in any case. */
void tn_numbered_other(const tn_numbered *n, const tn_module *module, const tn_house_library_record *record,
                       const tn_library *plans, tn_numbered *other);
void tn_numbered_other_close(tn_numbered *other);

/* How many houses are on plans of each length from low to high. */
tn_status tn_numbered_lengths(tn_numbered *n, uint32_t low, uint32_t high, mpz_t *lengths, tn_error *error);

/* How many of the houses that the form allows each clause keeps out, and how many only it; arrays of a number for each
 * clause. */
tn_status tn_numbered_clauses(tn_numbered *n, mpz_t *kept_out, mpz_t *alone, tn_error *error);

/* Counts houses together. Free them with tn_houses_free. */
tn_status tn_numbered_of(tn_numbered *n, const tn_houses_what *what, tn_houses **houses, tn_error *error);

/* The plan of a rank among these (tn_houses_find), which takes long the first time. */
tn_status tn_numbered_find(tn_numbered *n, tn_houses *among, mpz_t rank, tn_tray *trays, uint32_t *length,
                           tn_error *error);

/* All houses together, in n->all: counted now or before. TN_LIMIT (E1640) where that takes too much. */
tn_status tn_numbered_all(tn_numbered *n, tn_error *error);

/* The houses on one plan, counted tray by tray; free them with tn_houses_free. */
tn_status tn_numbered_on_plan(tn_numbered *n, const tn_tray *trays, uint32_t length, tn_houses **houses,
                              tn_error *error);

/* The houses on a plan, among these (NULL: they are counted for this plan). They are n's until it is asked for others.
 */
tn_status tn_numbered_among(tn_numbered *n, tn_houses *among, const tn_tray *trays, uint32_t length,
                            tn_plan_houses **houses, tn_error *error);
void tn_numbered_forget_ranks(tn_numbered *n);

/* How many houses are on a plan: counted tray by tray or, beyond the limits of that, by going through them. */
tn_status tn_numbered_houses_on(tn_numbered *n, const tn_tray *trays, uint32_t length, mpz_t houses, tn_error *error);

/* Calls `each` with them, in order, from that number on, until *stop. */
tn_status tn_numbered_each(tn_numbered *n, const tn_tray *trays, uint32_t length, const mpz_t from, tn_house_each *each,
                           void *context, tn_error *error);

/* Calls `each` with the houses on a plan from that rank on, until *stop: nothing if they all have lower ones. before:
 * how many houses are on the plans before; those on this plan are added. */
tn_status tn_numbered_each_from(tn_numbered *n, const tn_tray *trays, uint32_t length, const mpz_t rank, mpz_t before,
                                tn_house_each *each, void *context, tn_error *error);

/* What goes through the houses that cannot be counted tray by tray. */
tn_status tn_numbered_listing(tn_numbered *n, tn_house_listing **listing, tn_error *error);

/* The house of a number on a plan. Clear *house in any case. */
tn_status tn_numbered_at(tn_numbered *n, const tn_tray *trays, uint32_t length, const mpz_t variant, tn_house *house,
                         tn_error *error);

/* Asks the interpreter of rules whether the library keeps a house of the form. */
tn_status tn_numbered_keeps(tn_numbered *n, const tn_house *house, bool *kept, tn_error *error);

/* Asks it about a house that was found without it: before it is shown. TN_INTERNAL if the library does not keep it, as
 * the two then contradict each other. */
tn_status tn_numbered_judge(tn_numbered *n, const tn_house *house, tn_error *error);

/* The number of a house among those on its plan, which is one of the library's. TN_INVALID (E1618) where the library
 * does not keep it. */
tn_status tn_numbered_number(tn_numbered *n, const tn_house *house, mpz_t variant, tn_error *error);

/* The name #P:V of a house: the rank of its plan, and its number there. TN_INVALID (E1618) as above. */
tn_status tn_numbered_name(tn_numbered *n, const tn_house *house, mpz_t plan, mpz_t variant, tn_error *error);

/* The house that a line stands for (ask/house/typed.h), which the library has to keep if the line leaves values out.
 * What is wrong is said. Clear *house in any case. */
tn_status tn_numbered_typed(tn_numbered *n, const char *text, size_t max_length, tn_house *house);

/* Its rank among all houses of the library. TN_LIMIT where they cannot be counted together. */
tn_status tn_numbered_rank(tn_numbered *n, const tn_house *house, mpz_t rank, tn_error *error);

/* Is the text #P:V, P:V or #R? */
bool tn_is_house_number(const char *text);

/* Is it a whole number, of any size? */
bool tn_is_rank(const char *text);

/* Is the text a house line, and not a plan? */
bool tn_is_house_line(const char *text);

/* Are there so few plans that one may as well go through them? What is said of each of them is then known, too. */
#define TN_HOUSE_PLANS_FEW 1000u
bool tn_numbered_few(const tn_numbered *n);

/* A note where fewer houses were found than were wanted. */
void tn_numbered_say_few(const tn_numbered *n, bool on_plan, uint64_t found, uint64_t wanted);

/* Can one go through them at all (TN_HOUSE_PLANS_MAX)? By clauses that ask for walks only if `by_plan` says so. */
bool tn_numbered_countable(const tn_numbered *n);

/* The plan of a rank, written in so many digits; trays: room for the longest. */
tn_status tn_numbered_plan_of_rank(const tn_numbered *n, const char *digits, size_t size, tn_tray *trays,
                                   uint32_t *length, tn_error *error);

/* Room for the longest plan of the library; the caller frees it. NULL: out of memory. */
tn_tray *tn_numbered_tray_room(const tn_numbered *n, tn_error *error);

/* A plan of the library: in any spelling of one plan (ask/session/spelled.h), or #P. The caller frees its trays, also
 * after a failure, which is said. */
tn_status tn_numbered_plan(tn_numbered *n, const char *text, size_t max_length, tn_plan *plan);

/* Visits all plans of the library in order, until *stop. TN_LIMIT (E1617) where there are too many. */
#define TN_HOUSE_PLANS_MAX 1000000u
typedef tn_status tn_plan_visit(tn_numbered *n, void *context, const tn_tray *trays, uint32_t length, bool *stop,
                                tn_error *error);
tn_status tn_numbered_plans(tn_numbered *n, tn_plan_visit *visit, void *context, tn_error *error);
/* However many there are: for what stops, or shows what it has. */
tn_status tn_numbered_plans_until(tn_numbered *n, tn_plan_visit *visit, void *context, tn_error *error);

/* The same from the plan of that rank on. */
tn_status tn_numbered_plans_from(tn_numbered *n, const mpz_t first, tn_plan_visit *visit, void *context,
                                 tn_error *error);

/* The rank of the plan on which the house of that rank is, and how many houses are on plans before it; past the last
 * house, the number of plans and that of all houses. After tn_numbered_all. */
tn_status tn_numbered_locate(tn_numbered *n, const mpz_t rank, mpz_t plan, mpz_t before, tn_error *error);

/* Calls `use` with the houses from one rank on, before another, in their order. After tn_numbered_all. */
typedef tn_status tn_house_of_rank(void *context, const tn_house *house, const mpz_t rank, tn_error *error);
tn_status tn_numbered_between(tn_numbered *n, const mpz_t from, const mpz_t to, tn_house_of_rank *use, void *context,
                              tn_error *error);

/* The house of #P:V or #R. Clear *house in any case. */
tn_status tn_numbered_house(tn_numbered *n, const char *number, tn_house *house, tn_error *error);

/* What is done with a house that is drawn, of that rank: among all, or among those on the plan; variant: always among
 * those on its plan. Both are NULL if houses are tried. It may take the house, and leaves an empty one then. */
typedef tn_status tn_sampled_house(void *context, tn_house *house, const mpz_t rank, const mpz_t variant,
                                   tn_error *error);

/* Calls `use` with `wanted` different houses of the library, or of those on one plan (NULL: all plans), each drawn with
 * the same probability, in the order of their ranks; with all if there are fewer. Diverse ones are chosen among
 * twenty times as many that are drawn so, TN_DIVERSE_DRAWS at least (ask/house/diverse.h). Those of all plans whose
 * library asks for walks are tried (tried.h): each that is kept is as likely as each. */
#define TN_DIVERSE_DRAWS 200u
tn_status tn_numbered_sample(tn_numbered *n, const tn_plan *plan, size_t wanted, uint64_t seed, bool diverse,
                             tn_sampled_house *use, void *context, tn_error *error);

/* Opens the library and calls `use` with that house. What is wrong, also what `use` returns, is said. */
typedef tn_status tn_house_use(void *context, const tn_house *house, tn_error *error);
tn_status tn_session_house(tn_session *session, const tn_house_settings *settings, const char *number,
                           tn_house_use *use, void *context);

#endif
