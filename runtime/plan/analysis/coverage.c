/* Counts what is decided otherwise once rules say something else. */
#include "runtime/plan/analysis/coverage.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/count.h"
#include "runtime/automata/shortest.h"
#include "runtime/plan/library/alone.h"
#include "runtime/plan/library/diff.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/same.h"

#define JOINT_STATES 1000000u /* of the automata of several functions together, unless more are asked for */

#define DIFFERENCES_KEPT 64u

/* How many plans that an automaton accepts count: many changes of a rule make the same difference. */
typedef struct tn_difference {
    tn_dfa *plans;
    mpz_t count;
} tn_difference;

typedef struct tn_differences {
    tn_difference items[DIFFERENCES_KEPT];
    size_t count;
} tn_differences;

struct tn_coverage {
    const tn_schema *schema;
    const tn_library *library; /* or NULL: rules alone */
    const tn_classes *classes;
    uint32_t max, max_states;
    tn_lowering *lowering; /* of the rules as they are */
    size_t count;          /* clauses of the library */
    tn_dfa **with;         /* [count]: what they are */
    tn_dfa **without;      /* [count]: what they are changed into; NULL where that is the same */
    bool *changed;         /* [count] */
    bool *asked_of;        /* [count]: the `changed` that `gained` is of */
    tn_differences lost;   /* of the kept plans */
    tn_differences gained; /* of the plans that the unchanged clauses keep */
};

void tn_otherwise_init(tn_otherwise *otherwise)
{
    *otherwise = (tn_otherwise){.trays = NULL};
    mpz_init(otherwise->plans);
}

void tn_otherwise_clear(tn_otherwise *otherwise)
{
    mpz_clear(otherwise->plans);
    free(otherwise->trays);
}

/* ---- making */

static tn_status lowering_new(const tn_coverage *c, const tn_classes *classes, tn_lowering **lowering, tn_error *error)
{
    tn_status status = tn_lowering_new(classes, c->max_states, lowering, error);
    if (status == TN_OK)
        tn_lowering_within(*lowering, c->max);
    return status;
}

static tn_status add_clauses(tn_coverage *c, tn_error *error)
{
    c->count = c->library ? tn_library_record_of(c->library)->clause_count : 0;
    c->with = calloc(c->count + 1, sizeof *c->with);
    c->without = calloc(c->count + 1, sizeof *c->without);
    c->changed = calloc(c->count + 1, sizeof *c->changed);
    c->asked_of = calloc(c->count + 1, sizeof *c->asked_of);
    if (!c->with || !c->without || !c->changed || !c->asked_of)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < c->count; i++)
        c->with[i] = tn_dfa_share(tn_library_automaton(c->library, i));
    return TN_OK;
}

tn_status tn_coverage_new(const tn_schema *schema, const tn_library *library, const tn_classes *classes, uint32_t max,
                          uint32_t max_states, tn_coverage **coverage, tn_error *error)
{
    tn_coverage *c = calloc(1, sizeof *c);
    if (!c)
        return tn_fail_memory(error);
    *c = (tn_coverage){.schema = schema, .library = library, .classes = classes, .max = max, .max_states = max_states};
    tn_status status = add_clauses(c, error);
    if (status == TN_OK)
        status = lowering_new(c, classes, &c->lowering, error);
    if (status == TN_OK)
        *coverage = c;
    else
        tn_coverage_free(c);
    return status;
}

static void forget(tn_differences *differences)
{
    while (differences->count > 0) {
        tn_difference *last = &differences->items[--differences->count];
        tn_dfa_free(last->plans);
        mpz_clear(last->count);
    }
}

void tn_coverage_free(tn_coverage *c)
{
    if (!c)
        return;
    for (size_t i = 0; i < c->count; i++) {
        if (c->with)
            tn_dfa_free(c->with[i]);
        if (c->without)
            tn_dfa_free(c->without[i]);
    }
    forget(&c->lost);
    forget(&c->gained);
    tn_lowering_free(c->lowering);
    free(c->with);
    free(c->without);
    free(c->changed);
    free(c->asked_of);
    free(c);
}

/* ---- automata of differences */

/* *into := *into and (less, or) another. */
static tn_status join(const tn_coverage *c, tn_dfa **into, const tn_dfa *other, tn_dfa_operation operation,
                      tn_error *error)
{
    tn_bounds bounds = tn_bounds_make(c->max_states > JOINT_STATES ? c->max_states : JOINT_STATES);
    tn_dfa *joined = NULL;
    bounds.watch = c->schema->module->watch;
    tn_status status = tn_dfa_product(*into, other, operation, "difference", &bounds, &joined, error);
    if (status != TN_OK)
        return status;
    tn_dfa_free(*into);
    *into = joined;
    return TN_OK;
}

/* *into := what it accepts, or one of the two and not both. */
static tn_status add_difference(const tn_coverage *c, tn_dfa **into, tn_dfa *a, tn_dfa *b, tn_error *error)
{
    tn_dfa *only_a = tn_dfa_share(a), *only_b = tn_dfa_share(b);
    tn_status status = join(c, &only_a, b, TN_DFA_MINUS, error);
    if (status == TN_OK)
        status = join(c, &only_b, a, TN_DFA_MINUS, error);
    if (status == TN_OK)
        status = join(c, into, only_a, TN_DFA_OR, error);
    if (status == TN_OK)
        status = join(c, into, only_b, TN_DFA_OR, error);
    tn_dfa_free(only_a);
    tn_dfa_free(only_b);
    return status;
}

static bool accepts_nothing(const tn_dfa *dfa)
{
    return dfa->states == 1 && !dfa->accept[0];
}

static bool accepts(const tn_coverage *c, const tn_dfa *dfa, const tn_tray *trays, size_t length)
{
    uint32_t state = 0;
    for (size_t k = 0; k < length; k++)
        state = tn_dfa_read(dfa, state, tn_class_of(c->classes, trays[k]));
    return dfa->accept[state];
}

/* ---- rules by themselves */

static tn_status find_shortest(const tn_coverage *c, const tn_dfa *plans, tn_otherwise *otherwise, tn_error *error)
{
    tn_sparse *sparse = NULL;
    tn_key word = {0};
    tn_status status = tn_sparse_make(plans, 0, &sparse, error);
    if (status == TN_OK)
        status = tn_sparse_shortest(sparse, 1, c->max, &word, &otherwise->found, error);
    if (status == TN_OK && otherwise->found) {
        otherwise->trays = malloc((word.size + 1) * sizeof *otherwise->trays);
        otherwise->length = word.size;
        for (size_t i = 0; otherwise->trays && i < word.size; i++)
            otherwise->trays[i] = c->classes->representative[word.data[i]];
        status = otherwise->trays ? TN_OK : tn_fail_memory(error);
    }
    free(word.data);
    tn_sparse_free(sparse);
    return status;
}

static tn_status count_plans(const tn_coverage *c, const tn_dfa *plans, mpz_t count, tn_error *error)
{
    tn_bounds bounds = tn_bounds_make(JOINT_STATES);
    tn_sparse *all = NULL;
    bounds.watch = c->schema->module->watch;
    tn_status status = tn_sparse_words(c->classes->count, 1, c->max, &all, error);
    if (status == TN_OK)
        status =
            tn_count_both(all, plans, TN_DFA_AND, c->classes->size, 1, c->max, "difference", &bounds, count, error);
    tn_sparse_free(all);
    return status;
}

/* The automata of the functions: `pairs` of two each, as they are and changed. */
static tn_status lower_pairs(tn_coverage *c, tn_lowering *changed, const uint32_t *functions,
                             const uint32_t *changed_functions, size_t count, tn_dfa **pairs, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        status = tn_lower(c->lowering, functions[i], &pairs[2 * i], error);
        if (status == TN_OK)
            status = tn_lower(changed, changed_functions[i], &pairs[2 * i + 1], error);
    }
    return status;
}

static tn_status compare_pairs(const tn_coverage *c, tn_dfa *const *pairs, size_t count, bool shortest,
                               tn_otherwise *otherwise, tn_error *error)
{
    tn_dfa *plans = NULL;
    tn_status status = tn_dfa_constant(c->classes->count, false, &plans, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        if (!tn_dfa_equal(pairs[2 * i], pairs[2 * i + 1]))
            status = add_difference(c, &plans, pairs[2 * i], pairs[2 * i + 1], error);
    if (status == TN_OK)
        status = count_plans(c, plans, otherwise->plans, error);
    if (status == TN_OK && shortest && mpz_sgn(otherwise->plans) > 0)
        status = find_shortest(c, plans, otherwise, error);
    for (size_t i = count; status == TN_OK && otherwise->found && i-- > 0;) {
        bool now = accepts(c, pairs[2 * i], otherwise->trays, otherwise->length);
        if (now == accepts(c, pairs[2 * i + 1], otherwise->trays, otherwise->length))
            continue;
        otherwise->now = now;
        otherwise->rule = i;
    }
    tn_dfa_free(plans);
    return status;
}

/* A limit of these automata is raised by the same option. */
static tn_status said(tn_status status, tn_error *error)
{
    if (status == TN_LIMIT && error && !error->help[0])
        tn_error_help(error, "raise it with --max-states, or give fewer trays");
    return status;
}

tn_status tn_coverage_rules(tn_coverage *c, const uint32_t *functions, const tn_schema *changed,
                            const uint32_t *changed_functions, size_t count, bool shortest, tn_otherwise *otherwise,
                            tn_error *error)
{
    tn_classes classes = *c->classes;
    tn_lowering *lowering = NULL;
    tn_dfa **pairs = calloc(2 * count + 1, sizeof(tn_dfa *));
    if (!pairs)
        return tn_fail_memory(error);
    classes.schema = changed;
    tn_status status = lowering_new(c, &classes, &lowering, error);
    if (status == TN_OK)
        status = lower_pairs(c, lowering, functions, changed_functions, count, pairs, error);
    if (status == TN_OK)
        status = compare_pairs(c, pairs, count, shortest, otherwise, error);
    tn_lowering_free(lowering);
    for (size_t i = 0; i < 2 * count; i++)
        tn_dfa_free(pairs[i]);
    free(pairs);
    return said(status, error);
}

/* ---- a library: what the changed clauses say */

static const tn_clause_record *clause_of(const tn_coverage *c, const tn_module *module, size_t i)
{
    const tn_library_record *record = tn_library_record_of(c->library);
    return &module->CLAUSE_records[record->clause_first + i];
}

static bool prunes(const tn_coverage *c, size_t i)
{
    return clause_of(c, c->schema->module, i)->kind == TN_CLAUSE_PRUNE;
}

/* Lowers the clauses whose code is another one. *same: is there none? */
static tn_status lower_changed(tn_coverage *c, const tn_schema *changed, bool *same, tn_error *error)
{
    tn_classes classes = *c->classes;
    tn_lowering *lowering = NULL;
    classes.schema = changed;
    *same = true;
    tn_status status = lowering_new(c, &classes, &lowering, error);
    for (size_t i = 0; status == TN_OK && i < c->count; i++) {
        bool alike = true;
        tn_dfa_free(c->without[i]);
        c->without[i] = NULL;
        c->changed[i] = false;
        status = tn_functions_same(c->schema->module, clause_of(c, c->schema->module, i)->holds, changed->module,
                                   clause_of(c, changed->module, i)->holds, &alike, error);
        if (status != TN_OK || alike)
            continue;
        *same = false;
        status = tn_lower(lowering, clause_of(c, changed->module, i)->holds, &c->without[i], error);
        c->changed[i] = status == TN_OK && !tn_dfa_equal(c->with[i], c->without[i]);
    }
    tn_lowering_free(lowering);
    return status;
}

/* What the changed clauses keep. */
static tn_status keep(const tn_coverage *c, tn_dfa *const *automata, tn_dfa **kept, tn_error *error)
{
    tn_status status = tn_dfa_constant(c->classes->count, true, kept, error);
    for (size_t i = 0; status == TN_OK && i < c->count; i++)
        if (c->changed[i])
            status = join(c, kept, automata[i], prunes(c, i) ? TN_DFA_MINUS : TN_DFA_AND, error);
    return status;
}

/* The changed clause, where it is the only one; or SIZE_MAX. */
static size_t only_changed(const tn_coverage *c)
{
    size_t found = SIZE_MAX;
    for (size_t i = 0; i < c->count; i++) {
        if (!c->changed[i])
            continue;
        if (found != SIZE_MAX)
            return SIZE_MAX;
        found = i;
    }
    return found;
}

/* ---- counting */

typedef tn_status count_difference(tn_coverage *c, const tn_dfa *plans, mpz_t count, tn_error *error);

/* Kept as the clauses are. */
static tn_status count_lost(tn_coverage *c, const tn_dfa *plans, mpz_t count, tn_error *error)
{
    return tn_library_count_kept(c->library, plans, count, error);
}

/* What clause i alone keeps out, and keeps once it is changed. */
static tn_status count_alone(tn_coverage *c, size_t i, mpz_t count, tn_error *error)
{
    tn_dfa *drops = NULL;
    tn_status status = TN_OK;
    if (prunes(c, i))
        drops = tn_dfa_share(c->without[i]);
    else
        status = tn_dfa_complement(c->without[i], &drops, error);
    if (status == TN_OK)
        status = tn_library_count_alone_less(c->library, (uint32_t)i, drops, count, error);
    tn_dfa_free(drops);
    return status;
}

/* Not kept as the clauses are, and kept by all unchanged ones. What one clause keeps out and no other does is an
 * automaton of its own. */
static tn_status count_gained(tn_coverage *c, const tn_dfa *plans, mpz_t count, tn_error *error)
{
    size_t one = only_changed(c);
    tn_status status = TN_LIMIT;
    if (one != SIZE_MAX)
        status = count_alone(c, one, count, error);
    if (status == TN_LIMIT) /* or there are several, or the automaton is too large: counting makes a smaller one */
        status = tn_library_count_without(c->library, c->changed, plans, count, error);
    return status;
}

/* flips += how many plans of a difference count. */
static tn_status add_count(tn_coverage *c, tn_dfa *plans, tn_differences *kept, count_difference *how, mpz_t flips,
                           tn_error *error)
{
    mpz_t count;
    if (accepts_nothing(plans))
        return TN_OK;
    for (size_t i = 0; i < kept->count; i++)
        if (tn_dfa_equal(kept->items[i].plans, plans)) {
            mpz_add(flips, flips, kept->items[i].count);
            return TN_OK;
        }
    mpz_init(count);
    tn_status status = how(c, plans, count, error);
    if (status == TN_OK)
        mpz_add(flips, flips, count);
    if (status == TN_OK && kept->count < DIFFERENCES_KEPT) {
        tn_difference *next = &kept->items[kept->count++];
        next->plans = tn_dfa_share(plans);
        mpz_init_set(next->count, count);
    }
    mpz_clear(count);
    return status;
}

/* ---- the shortest plan */

/* Takes a plan where it is shorter than the one that was found before. */
static void take_shorter(tn_otherwise *otherwise, tn_tray *trays, size_t length, bool found, bool now)
{
    otherwise->rule = SIZE_MAX;
    if (!found || (otherwise->found && otherwise->length <= length)) {
        free(trays);
        return;
    }
    free(otherwise->trays);
    otherwise->found = true;
    otherwise->trays = trays;
    otherwise->length = length;
    otherwise->now = now;
}

static tn_status library_shortest(const tn_coverage *c, const tn_dfa *lost, const tn_dfa *gained,
                                  tn_otherwise *otherwise, tn_error *error)
{
    tn_tray *trays = NULL;
    size_t length = 0;
    bool found = false;
    tn_status status = TN_OK;
    if (!accepts_nothing(lost))
        status = tn_library_kept_shortest(c->library, lost, &trays, &length, &found, error);
    take_shorter(otherwise, trays, length, status == TN_OK && found, true);
    trays = NULL;
    found = false;
    if (status == TN_OK && !accepts_nothing(gained))
        status = tn_library_shortest_without(c->library, c->changed, gained, &trays, &length, &found, error);
    take_shorter(otherwise, trays, length, status == TN_OK && found, false);
    for (size_t i = c->count; otherwise->found && !otherwise->now && i-- > 0;)
        if (c->changed[i] && accepts(c, c->with[i], otherwise->trays, otherwise->length) == prunes(c, i))
            otherwise->rule = i;
    return status == TN_LIMIT ? TN_OK : status; /* then no plan is shown */
}

/* Plans that are kept only as the clauses are, and those that are kept only once they are changed. */
static tn_status compare_clauses(tn_coverage *c, bool shortest, tn_otherwise *otherwise, tn_error *error)
{
    tn_dfa *lost = NULL, *gained = NULL, *with = NULL;
    tn_status status = keep(c, c->with, &with, error);
    if (status == TN_OK)
        status = keep(c, c->without, &gained, error);
    if (status == TN_OK)
        lost = tn_dfa_share(with);
    if (status == TN_OK)
        status = join(c, &lost, gained, TN_DFA_MINUS, error);
    if (status == TN_OK)
        status = join(c, &gained, with, TN_DFA_MINUS, error);
    if (status == TN_OK && memcmp(c->asked_of, c->changed, c->count * sizeof *c->changed) != 0)
        forget(&c->gained);
    memcpy(c->asked_of, c->changed, c->count * sizeof *c->changed);
    if (status == TN_OK)
        status = add_count(c, lost, &c->lost, count_lost, otherwise->plans, error);
    if (status == TN_OK)
        status = add_count(c, gained, &c->gained, count_gained, otherwise->plans, error);
    if (status == TN_OK && shortest && mpz_sgn(otherwise->plans) > 0)
        status = library_shortest(c, lost, gained, otherwise, error);
    tn_dfa_free(with);
    tn_dfa_free(lost);
    tn_dfa_free(gained);
    return status;
}

/* ---- other lengths: the libraries are compared as a whole */

static tn_status take_part(const tn_library_diff *diff, tn_diff_part which, bool shortest, tn_otherwise *otherwise,
                           tn_error *error)
{
    const tn_library *part = tn_library_diff_part(diff, which);
    mpz_t count;
    mpz_init(count);
    tn_library_kept(part, TN_ALL_LENGTHS, count);
    mpz_add(otherwise->plans, otherwise->plans, count);
    bool wanted = shortest && mpz_sgn(count) > 0;
    tn_tray *trays = wanted ? malloc(((size_t)tn_library_max(part) + 1) * sizeof *trays) : NULL;
    uint32_t length = 0;
    mpz_set_ui(count, 0);
    bool found = trays && tn_library_unrank(part, count, trays, &length);
    mpz_clear(count);
    if (wanted && !trays)
        return tn_fail_memory(error);
    take_shorter(otherwise, trays, length, found, which == TN_DIFF_REMOVED);
    return TN_OK;
}

static tn_status compare_libraries(const tn_coverage *c, const tn_schema *changed, uint32_t index, bool shortest,
                                   tn_otherwise *otherwise, tn_error *error)
{
    const tn_library_options options = {.max_states = c->max_states};
    tn_library *after = NULL;
    tn_library_diff *diff = NULL;
    tn_status status = tn_library_new(changed, index, &options, &after, error);
    if (status == TN_OK)
        status = tn_library_diff_new(c->library, after, c->max_states, c->schema->module->watch, &diff, error);
    if (status == TN_OK)
        status = take_part(diff, TN_DIFF_REMOVED, shortest, otherwise, error);
    if (status == TN_OK)
        status = take_part(diff, TN_DIFF_ADDED, shortest, otherwise, error);
    tn_library_diff_free(diff);
    tn_library_free(after);
    return status;
}

/* Has the changed library other lengths? Not where they are given from without: then what the files say does not count.
 */
static bool has_other_lengths(const tn_coverage *c, const tn_library_record *now, const tn_library_record *then)
{
    bool own = tn_library_min(c->library) == now->trays_min && tn_library_max(c->library) == now->trays_max;
    return own && (now->trays_min != then->trays_min || now->trays_max != then->trays_max);
}

tn_status tn_coverage_library(tn_coverage *c, const tn_schema *changed, bool shortest, bool *same,
                              tn_otherwise *otherwise, tn_error *error)
{
    const tn_library_record *now = tn_library_record_of(c->library);
    uint32_t index = (uint32_t)(now - c->schema->module->LIBRARY_records);
    const tn_library_record *then = &changed->module->LIBRARY_records[index];
    *same = false;
    mpz_set_ui(otherwise->plans, 0);
    if (has_other_lengths(c, now, then))
        return said(compare_libraries(c, changed, index, shortest, otherwise, error), error);
    tn_status status = lower_changed(c, changed, same, error);
    if (status == TN_OK && !*same)
        status = compare_clauses(c, shortest, otherwise, error);
    return said(status, error);
}
