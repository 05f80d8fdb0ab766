/* Compares two libraries. */
#include "runtime/plan/library/diff.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/plan/library/library_data.h"

struct tn_library_diff {
    const tn_library *sides[2]; /* before, after */
    tn_tray *map;               /* [trays]: the tray of `after` that a tray of `before` is; NULL: the same */
    tn_classes *classes;        /* trays that neither library tells apart */
    uint32_t max_states;
    tn_watch *watch; /* while it is made */
    tn_sparse *parts[TN_DIFF_PARTS];
    tn_library *libraries[TN_DIFF_PARTS];
    tn_dfa **clauses[2]; /* of each side, over the joint classes */
    tn_changed_clause *changes;
    size_t change_count;
};

static size_t clause_count(const tn_library_diff *d, int side)
{
    return d->sides[side]->record->clause_count;
}

static const tn_clause_record *clause(const tn_library_diff *d, int side, size_t i)
{
    return &d->sides[side]->schema->module->CLAUSE_records[d->sides[side]->record->clause_first + i];
}

static const char *clause_name(const tn_library_diff *d, int side, size_t i)
{
    return tn_text(d->sides[side]->schema->module, clause(d, side, i)->name);
}

static tn_tray tray_after(const tn_library_diff *d, tn_tray tray)
{
    return d->map ? d->map[tray] : tray;
}

/* ---- one alphabet for both */

/* The same where trays are not listed, and have the same numbers. */
static tn_status refine_classes(const tn_library_diff *d, tn_classes **out, tn_error *error)
{
    tn_status status = tn_classes_new(d->sides[0]->schema, NULL, 0, out, error);
    for (int side = 0; status == TN_OK && side < 2; side++)
        status = tn_classes_refine(*out, d->sides[side]->classes, error);
    return status;
}

static tn_status join_classes(const tn_library_diff *d, tn_classes **out, tn_error *error)
{
    const tn_schema *schema = d->sides[0]->schema;
    if (!d->map)
        return refine_classes(d, out, error);
    tn_classes *classes = calloc(1, sizeof *classes);
    tn_numbering pairs = {0};
    if (!classes)
        return tn_fail_memory(error);
    classes->schema = schema;
    classes->of_tray = calloc((size_t)schema->tray_count + 1, sizeof *classes->of_tray);
    classes->representative = calloc((size_t)schema->tray_count + 1, sizeof *classes->representative);
    classes->size = calloc((size_t)schema->tray_count + 1, sizeof *classes->size);
    bool ok = classes->of_tray && classes->representative && classes->size;
    for (tn_tray t = 0; ok && t < schema->tray_count; t++) {
        uint32_t before = d->sides[0]->classes->of_tray[t], after = d->sides[1]->classes->of_tray[d->map[t]];
        uint32_t pair = tn_number(&pairs, (uint64_t)before << 32 | after);
        ok = pair != UINT32_MAX;
        if (!ok)
            break;
        if (classes->size[pair]++ == 0)
            classes->representative[pair] = t;
        classes->of_tray[t] = pair;
    }
    classes->count = pairs.count;
    tn_numbering_clear(&pairs);
    *out = classes;
    if (ok)
        return TN_OK;
    tn_classes_free(classes);
    *out = NULL;
    return tn_fail_memory(error);
}

/* An automaton of one side's classes over the joint ones. */
static tn_status reletter(const tn_library_diff *d, int side, const tn_dfa *dfa, tn_dfa **out, tn_error *error)
{
    const tn_classes *own = d->sides[side]->classes;
    tn_dfa *joint = tn_dfa_new(d->classes->count, dfa->columns, dfa->states);
    if (!joint)
        return tn_fail_memory(error);
    for (uint32_t l = 0; l < joint->letters; l++) {
        tn_tray tray = d->classes->representative[l];
        joint->column[l] = dfa->column[tn_class_of(own, side ? tray_after(d, tray) : tray)];
    }
    memcpy(joint->delta, dfa->delta, (size_t)dfa->states * dfa->columns * sizeof *dfa->delta);
    memcpy(joint->accept, dfa->accept, dfa->states);
    tn_status status =
        tn_dfa_minimise(joint, 0, out, error); /* canonical: the map may have changed the letters' order */
    tn_dfa_free(joint);
    return status;
}

/* Plans of min to max trays. */
static tn_status of_lengths(const tn_library_diff *d, uint32_t min, uint32_t max, tn_dfa **out, tn_error *error)
{
    uint32_t states = max >= min ? max + 2 : 1;
    tn_dfa *dfa = tn_dfa_new(d->classes->count, 1, states);
    if (!dfa)
        return tn_fail_memory(error);
    for (uint32_t s = 0; s < states; s++) {
        dfa->delta[s] = s + 1 < states ? s + 1 : s;
        dfa->accept[s] = s >= min && s <= max;
    }
    *out = dfa;
    return TN_OK;
}

/* ---- the three sets */

static bool same_lengths(const tn_library_diff *d)
{
    return d->sides[0]->min == d->sides[1]->min && d->sides[0]->max == d->sides[1]->max;
}

static tn_status combine(const tn_library_diff *d, const tn_sparse *a, const tn_dfa *b, tn_dfa_operation operation,
                         tn_sparse **out, tn_error *error)
{
    tn_bounds bounds = tn_bounds_make(d->max_states);
    bounds.watch = d->watch;
    tn_status status = tn_sparse_copy(a, out, error);
    return status == TN_OK ? tn_sparse_apply(out, b, operation, "comparison", &bounds, error) : status;
}

/* A side's plans, of its own lengths only where the two sides' differ. */
static tn_status side_plans(const tn_library_diff *d, int side, tn_sparse **sparse, tn_dfa **complete, tn_error *error)
{
    tn_dfa *lengths = NULL;
    tn_bounds bounds = tn_bounds_make(d->max_states);
    tn_status status =
        tn_library_reletter(d->sides[side], d->sides[side]->live, d->classes, side ? d->map : NULL, sparse, error);
    if (status == TN_OK && !same_lengths(d)) {
        status = of_lengths(d, d->sides[side]->min, d->sides[side]->max, &lengths, error);
        if (status == TN_OK)
            status = tn_sparse_apply(sparse, lengths, TN_DFA_AND, "comparison", &bounds, error);
    }
    tn_dfa_free(lengths);
    return status == TN_OK ? tn_sparse_fill(*sparse, complete, error) : status;
}

static tn_status make_library(tn_library_diff *d, tn_diff_part part, tn_error *error)
{
    const tn_library *a = d->sides[0], *b = d->sides[1];
    tn_classes *classes = NULL;
    tn_status status = join_classes(d, &classes, error);
    if (status != TN_OK)
        return status;
    uint32_t min = a->min < b->min ? a->min : b->min, max = a->max > b->max ? a->max : b->max;
    return tn_library_of(classes, d->parts[part], min, max, a->max_table, &d->libraries[part], error);
}

static tn_status make_parts(tn_library_diff *d, tn_error *error)
{
    tn_sparse *sparse[2] = {NULL};
    tn_dfa *complete[2] = {NULL};
    tn_status status = TN_OK;
    for (int side = 0; status == TN_OK && side < 2; side++)
        status = side_plans(d, side, &sparse[side], &complete[side], error);
    if (status == TN_OK)
        status = combine(d, sparse[0], complete[1], TN_DFA_MINUS, &d->parts[TN_DIFF_REMOVED], error);
    if (status == TN_OK)
        status = combine(d, sparse[1], complete[0], TN_DFA_MINUS, &d->parts[TN_DIFF_ADDED], error);
    if (status == TN_OK)
        status = combine(d, sparse[0], complete[1], TN_DFA_AND, &d->parts[TN_DIFF_KEPT], error);
    for (int part = 0; status == TN_OK && part < TN_DIFF_PARTS; part++)
        status = make_library(d, (tn_diff_part)part, error);
    for (int side = 0; side < 2; side++) {
        tn_sparse_free(sparse[side]);
        tn_dfa_free(complete[side]);
    }
    return status;
}

/* ---- clauses */

static tn_status reletter_clauses(tn_library_diff *d, int side, tn_error *error)
{
    size_t count = clause_count(d, side);
    d->clauses[side] = calloc(count + 1, sizeof *d->clauses[side]);
    if (!d->clauses[side])
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = reletter(d, side, d->sides[side]->clauses[i], &d->clauses[side][i], error);
    return status;
}

static bool same_meaning(const tn_library_diff *d, size_t i, size_t j)
{
    return (clause(d, 0, i)->kind == TN_CLAUSE_PRUNE) == (clause(d, 1, j)->kind == TN_CLAUSE_PRUNE) &&
           tn_dfa_equal(d->clauses[0][i], d->clauses[1][j]);
}

/* Pairs up clauses: first those that are the same, then those of one name. pair[0][i]: the clause of the new side that
 * clause i of the old one is paired with, or SIZE_MAX; pair[1] the other way round. */
static void pair_up(const tn_library_diff *d, size_t *const pair[2])
{
    for (int pass = 0; pass < 3; pass++) {
        for (size_t i = 0; i < clause_count(d, 0); i++) {
            for (size_t j = 0; pair[0][i] == SIZE_MAX && j < clause_count(d, 1); j++) {
                const char *before = clause_name(d, 0, i), *after = clause_name(d, 1, j);
                bool one_name = strcmp(before, after) == 0, unnamed = strchr(before, '@') && strchr(after, '@');
                bool fits = pass == 0   ? one_name && same_meaning(d, i, j)
                            : pass == 1 ? unnamed && same_meaning(d, i, j)
                                        : one_name;
                if (!fits || pair[1][j] != SIZE_MAX)
                    continue;
                pair[0][i] = j;
                pair[1][j] = i;
            }
        }
    }
}

/* Of the plans of a part, those that a clause keeps out. */
static tn_status count_out(const tn_library_diff *d, tn_diff_part part, int side, size_t i, mpz_t count,
                           tn_error *error)
{
    tn_bounds bounds = tn_bounds_make(d->max_states);
    tn_dfa_operation operation = clause(d, side, i)->kind == TN_CLAUSE_PRUNE ? TN_DFA_AND : TN_DFA_MINUS;
    return tn_count_both(d->parts[part], d->clauses[side][i], operation, d->classes->size, d->libraries[part]->min,
                         d->libraries[part]->max, "comparison", &bounds, count, error);
}

static tn_changed_clause *add_change(tn_library_diff *d, tn_clause_change change)
{
    tn_changed_clause *added = &d->changes[d->change_count++];
    *added = (tn_changed_clause){.change = change, .before = UINT32_MAX, .after = UINT32_MAX};
    mpz_inits(added->removes, added->adds, NULL);
    return added;
}

static tn_status report_clause(tn_library_diff *d, size_t i, size_t j, tn_error *error)
{
    tn_changed_clause *change = add_change(d, i == SIZE_MAX   ? TN_CLAUSE_ADDED
                                              : j == SIZE_MAX ? TN_CLAUSE_REMOVED
                                                              : TN_CLAUSE_CHANGED);
    tn_status status = TN_OK;
    if (j != SIZE_MAX) {
        change->after = (uint32_t)(d->sides[1]->record->clause_first + j);
        status = count_out(d, TN_DIFF_REMOVED, 1, j, change->removes, error);
    }
    if (i != SIZE_MAX && status == TN_OK) {
        change->before = (uint32_t)(d->sides[0]->record->clause_first + i);
        status = count_out(d, TN_DIFF_ADDED, 0, i, change->adds, error);
    }
    return status;
}

/* How many plans of a part have a number of trays that a side does not have. */
static void count_lengths_out(const tn_library_diff *d, tn_diff_part part, int side, mpz_t count)
{
    const tn_library *library = d->libraries[part];
    mpz_t of_length;
    mpz_init(of_length);
    for (uint32_t n = library->min; n <= library->max; n++) {
        if (n >= d->sides[side]->min && n <= d->sides[side]->max)
            continue;
        tn_library_kept(library, n, of_length);
        mpz_add(count, count, of_length);
    }
    mpz_clear(of_length);
}

/* Old clauses in their order (changed or removed), then added ones. */
static tn_status report_clauses(tn_library_diff *d, size_t *const pair[2], tn_error *error)
{
    tn_status status = TN_OK;
    if (!same_lengths(d)) {
        tn_changed_clause *change = add_change(d, TN_CLAUSE_CHANGED);
        change->lengths = true;
        count_lengths_out(d, TN_DIFF_REMOVED, 1, change->removes);
        count_lengths_out(d, TN_DIFF_ADDED, 0, change->adds);
    }
    for (size_t i = 0; status == TN_OK && i < clause_count(d, 0); i++)
        if (pair[0][i] == SIZE_MAX || !same_meaning(d, i, pair[0][i]))
            status = report_clause(d, i, pair[0][i], error);
    for (size_t j = 0; status == TN_OK && j < clause_count(d, 1); j++)
        if (pair[1][j] == SIZE_MAX)
            status = report_clause(d, SIZE_MAX, j, error);
    return status;
}

static tn_status compare_clauses(tn_library_diff *d, tn_error *error)
{
    size_t *pair[2] = {NULL};
    d->changes = calloc(clause_count(d, 0) + clause_count(d, 1) + 1, sizeof *d->changes);
    tn_status status = d->changes ? TN_OK : tn_fail_memory(error);
    for (int side = 0; status == TN_OK && side < 2; side++) {
        pair[side] = malloc((clause_count(d, side) + 1) * sizeof *pair[side]);
        status = pair[side] ? reletter_clauses(d, side, error) : tn_fail_memory(error);
        for (size_t i = 0; pair[side] && i < clause_count(d, side); i++)
            pair[side][i] = SIZE_MAX;
    }
    if (status == TN_OK) {
        pair_up(d, pair);
        status = report_clauses(d, pair, error);
    }
    free(pair[0]);
    free(pair[1]);
    return status;
}

/* ---- making */

tn_status tn_library_diff_new(const tn_library *before, const tn_library *after, uint32_t max_states, tn_watch *watch,
                              tn_library_diff **out, tn_error *error)
{
    tn_library_diff *d = calloc(1, sizeof *d);
    if (!d)
        return tn_fail_memory(error);
    d->sides[0] = before;
    d->sides[1] = after;
    d->max_states = max_states ? max_states : TN_LIBRARY_STATES_DEFAULT;
    d->watch = watch;
    tn_status status = tn_tray_map(before->schema, after->schema, &d->map, error);
    if (status == TN_OK)
        status = join_classes(d, &d->classes, error);
    if (status == TN_OK)
        status = make_parts(d, error);
    if (status == TN_OK)
        status = compare_clauses(d, error);
    if (status != TN_OK) {
        tn_library_diff_free(d);
        return status;
    }
    d->watch = NULL;
    *out = d;
    return TN_OK;
}

void tn_library_diff_free(tn_library_diff *d)
{
    if (!d)
        return;
    for (int part = 0; part < TN_DIFF_PARTS; part++) {
        tn_sparse_free(d->parts[part]);
        tn_library_free(d->libraries[part]);
    }
    for (int side = 0; side < 2; side++) {
        for (size_t i = 0; d->clauses[side] && i < clause_count(d, side); i++)
            tn_dfa_free(d->clauses[side][i]);
        free(d->clauses[side]);
    }
    for (size_t i = 0; i < d->change_count; i++)
        mpz_clears(d->changes[i].removes, d->changes[i].adds, NULL);
    free(d->changes);
    tn_classes_free(d->classes);
    free(d->map);
    free(d);
}

const tn_library *tn_library_diff_part(const tn_library_diff *diff, tn_diff_part part)
{
    return diff->libraries[part];
}

tn_status tn_library_diff_rank(const tn_library_diff *diff, tn_diff_part part, const tn_tray *trays, size_t length,
                               mpz_t rank, tn_error *error)
{
    int side = part != TN_DIFF_REMOVED;
    tn_tray *own = malloc((length + 1) * sizeof *own);
    if (!own)
        return tn_fail_memory(error);
    for (size_t i = 0; i < length; i++)
        own[i] = side ? tray_after(diff, trays[i]) : trays[i];
    bool there = tn_library_rank(diff->sides[side], own, length, rank);
    free(own);
    return there ? TN_OK : tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a plan of the difference is not in its library");
}

size_t tn_library_diff_clauses(const tn_library_diff *diff)
{
    return diff->change_count;
}

const tn_changed_clause *tn_library_diff_clause(const tn_library_diff *diff, size_t i)
{
    return &diff->changes[i];
}
