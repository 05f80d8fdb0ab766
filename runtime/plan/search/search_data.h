/* What a tn_plan_search is made of: for the files that answer its questions. */
#ifndef TARTAN_PLAN_SEARCH_SEARCH_DATA_H
#define TARTAN_PLAN_SEARCH_SEARCH_DATA_H

#include "runtime/plan/match/vm.h"
#include "runtime/plan/search/search.h"
#include "runtime/plan/search/unroll.h"

/* Plans within a distance of a plan. */
typedef struct tn_search_around {
    const tn_tray *trays;
    uint32_t length;
    uint32_t distance;
} tn_search_around;

/* Plans of one length. */
typedef struct tn_search_length {
    bool open;
    uint32_t trays;
    tn_circuit *circuit;
    tn_letters letters;
    tn_unrolled *unrolled;
    tn_signal *keeps;   /* [clauses]: that the clause keeps the plan; true where it is judged alone */
    bool *judged;       /* [clauses]: by the interpreter alone */
    bool borrowed;      /* the circuit is another search's */
    tn_signal *assumed; /* [fixed + digits + 1]: room */
    size_t fixed;       /* so many of these are assumed besides the values before one that is looked for */
    tn_signal *differs; /* [digits + 1]: room */
} tn_search_length;

struct tn_plan_search {
    const tn_schema *schema;
    const tn_library_record *record;
    tn_search_options options;
    tn_plan_vm *vm;
    tn_search_length at;
    uint32_t next_trays; /* the length to look at next */
    tn_tray *plan;       /* [trays_max + 1]: the last one, if there is one of this length */
    bool has_plan;
    uint32_t rejected; /* plans by the interpreter, since the last one that was kept */
    /* Only plans that are so (search_data.h's gates below), or NULL: */
    const tn_open_plan *within;
    const tn_search_around *around;
    const tn_search_other *without;
};

enum { TN_SEARCH_FIXED_MAX = TN_WEIGHED_MAX + 1 };

static inline const tn_clause_record *tn_search_clause(const tn_plan_search *search, uint32_t i)
{
    return &search->schema->module->CLAUSE_records[search->record->clause_first + i];
}

/* Makes the gates of the plans of so many trays; keep: and asserts that all clauses keep them, and that they are as the
 * search is narrowed. */
tn_status tn_search_open(tn_plan_search *search, uint32_t trays, bool keep, tn_error *error);
void tn_search_close(tn_plan_search *search);

/* Is there a plan, with the first `count` of at.assumed? TN_LIMIT (E0833) if that is not found out. */
tn_status tn_search_solve(tn_plan_search *search, size_t count, bool *found, tn_error *error);

/* The same of plans that the interpreter keeps, too: the search's plan is one. */
tn_status tn_search_find(tn_plan_search *search, size_t count, bool *found, tn_error *error);

/* For who goes on without what is not found out: what it came to, *undecided instead of TN_LIMIT (E0833). Any other
 * error that was found is handed on. */
tn_status tn_search_unless_undecided(tn_status status, const tn_error *found, bool *undecided, tn_error *error);

/* TN_LIMIT (E0833), of the length that is open. */
tn_status tn_search_undecided(const tn_plan_search *search, tn_error *error);

/* No other plan is like this one, from now on. */
void tn_search_exclude(tn_plan_search *search, const tn_tray *trays);

/* The next plan of the length that is open, in the order of ranks (the first, unless has_plan), that is as the first
 * at.fixed of at.assumed say: it is the search's plan, and excluded from now on. *found: there is one. */
tn_status tn_search_next_of_length(tn_plan_search *search, bool *found, tn_error *error);

/* Keeps a copy of a plan. */
tn_status tn_searched_add(tn_searched_plans *plans, const tn_tray *trays, uint32_t length, tn_error *error);

/* Does the interpreter keep the plan? TN_INTERNAL if it does not, and every clause has its gate; TN_LIMIT (E0833) if
 * that was so of too many in a row. */
tn_status tn_search_judge(tn_plan_search *search, const tn_tray *trays, bool *keeps, tn_error *error);

/* ---- gates by which a search is narrowed, of the length that is open */

/* begins: [open->count + 1]: that the plan begins with so many parts of the open plan, whatever follows. *all: that it
 * is all of it. */
tn_status tn_search_within(tn_plan_search *search, const tn_open_plan *open, tn_signal *begins, tn_signal *all,
                           tn_error *error);

tn_status tn_search_around_gate(tn_plan_search *search, const tn_search_around *around, tn_signal *gate,
                                tn_error *error);

/* ---- values of a measure on the plans of the length that is open */

typedef struct tn_search_values {
    tn_plan_search *search;
    uint32_t index; /* of the SUM record */
    tn_sum *sum;
    bool most;       /* more of it is better */
    tn_adder values; /* all that there may be, the worst first */
    tn_signal *gates;
} tn_search_values;

/* Zero it, and clear it in any case. */
tn_status tn_search_values_new(tn_search_values *values, tn_plan_search *search, uint32_t sum, bool most,
                               tn_error *error);
void tn_search_values_clear(tn_search_values *values);

/* Makes them of the length that is open; plans without a value are left out. */
tn_status tn_search_values_open(tn_search_values *values, tn_error *error);

/* That the plan's value is one of those from `from` on. */
tn_signal tn_search_values_from(tn_search_values *values, size_t from);

/* Which of them, from `from` on, the search's plan has, as the interpreter says, which has the plan. */
tn_status tn_search_values_find(const tn_search_values *values, size_t from, size_t *at, tn_error *error);

/* In the measure's unit of nanometres to its power. */
void tn_search_value(const tn_search_values *values, size_t at, mpq_t value);
bool tn_search_is_better(const tn_search_values *values, const mpq_t one, const mpq_t other);

/* The first of them that is better than a value. */
size_t tn_search_better_than(const tn_search_values *values, const mpq_t value);

#endif
