/* Makes the automaton of a projection. */
#include "runtime/plan/match/image.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/explore.h"
#include "runtime/automata/sparse.h"
#include "runtime/base/array.h"
#include "runtime/plan/match/lower.h"

/* The clauses together may have more states than one alone, as those of a library may. */
#define JOINED_STATES_DEFAULT 1000000u

/* Steps that joining them for plans of any length may take before it is tried for those that are asked about. */
#define EAGER_WORK UINT64_C(3000000)

/* ---- the library's clauses */

static tn_status name_clause(const tn_projection *projection, uint32_t i, tn_error *error)
{
    if (!error)
        return TN_LIMIT;
    tn_error inner = *error;
    const tn_module *module = projection->schema->module;
    tn_fail(error, inner.status, inner.code, "in the clause `%.60s` of `%.60s`: %.300s",
            tn_text(module, tn_projection_clause(projection, i)->name), tn_text(module, projection->library->name),
            inner.message);
    tn_error_help(error, "%s", inner.help);
    error->code_offset = inner.code_offset;
    return inner.status;
}

tn_status tn_image_clauses(const tn_projection *projection, const tn_classes *newer, const tn_image_options *options,
                           tn_dfa ***out, tn_error *error)
{
    uint32_t count = projection->library->clause_count;
    tn_lowering *lowering = NULL;
    tn_dfa **clauses = calloc((size_t)count + 1, sizeof(tn_dfa *));
    tn_status status = clauses ? tn_lowering_new(newer, options->max_states, &lowering, error) : tn_fail_memory(error);
    if (status == TN_OK && options->max_trays > 0)
        tn_lowering_within(lowering, options->max_trays);
    for (uint32_t i = 0; status == TN_OK && i < count; i++) {
        uint32_t function = tn_projection_clause(projection, i)->holds;
        status = (options->reversed ? tn_lower_reversed : tn_lower)(lowering, function, &clauses[i], error);
        if (status == TN_LIMIT)
            status = name_clause(projection, i, error);
    }
    tn_lowering_free(lowering);
    if (status == TN_OK)
        *out = clauses;
    else if (clauses)
        tn_image_clauses_free(projection, clauses);
    return status;
}

void tn_image_clauses_free(const tn_projection *projection, tn_dfa **clauses)
{
    for (uint32_t i = 0; clauses && i < projection->library->clause_count; i++)
        tn_dfa_free(clauses[i]);
    free(clauses);
}

/* ---- joined: the plans of the library */

typedef struct joining {
    const tn_projection *projection;
    const tn_classes *newer;
    tn_dfa **clauses;
    uint32_t *order; /* those with the fewest states first */
    uint32_t max_trays;
    tn_bounds bounds;
} joining;

static void find_order(const joining *j)
{
    for (uint32_t i = 0; i < j->projection->library->clause_count; i++) {
        uint32_t at = i;
        for (; at > 0 && j->clauses[j->order[at - 1]]->states > j->clauses[i]->states; at--)
            j->order[at] = j->order[at - 1];
        j->order[at] = i;
    }
}

static tn_status everything(const joining *j, bool within, tn_sparse **out, tn_error *error)
{
    uint32_t letters = j->newer->count;
    if (within)
        return tn_sparse_words(letters, 0, j->max_trays, out, error);
    tn_dfa *all = NULL;
    tn_status status = tn_dfa_constant(letters, true, &all, error);
    if (status == TN_OK)
        status = tn_sparse_make(all, 0, out, error);
    tn_dfa_free(all);
    return status;
}

/* Of any length or of at most max_trays (within), in at most `work` steps. */
static tn_status try_join(joining *j, bool within, uint64_t work, tn_sparse **out, tn_error *error)
{
    tn_bounds bounds = j->bounds;
    tn_sparse *plans = NULL;
    bounds.max_work = work < bounds.max_work ? work : bounds.max_work;
    tn_status status = everything(j, within, &plans, error);
    for (uint32_t i = 0; status == TN_OK && i < j->projection->library->clause_count; i++) {
        bool prunes = tn_projection_clause(j->projection, j->order[i])->kind == TN_CLAUSE_PRUNE;
        status = tn_sparse_apply(&plans, j->clauses[j->order[i]], prunes ? TN_DFA_MINUS : TN_DFA_AND,
                                 "library that is projected", &bounds, error);
    }
    if (status == TN_OK)
        *out = plans;
    else
        tn_sparse_free(plans);
    return status;
}

static tn_status join(joining *j, tn_sparse **out, tn_error *error)
{
    if (j->max_trays == 0)
        return try_join(j, false, UINT64_MAX, out, error);
    tn_error ignored;
    tn_status status = try_join(j, false, EAGER_WORK, out, &ignored);
    if (status == TN_LIMIT)
        return try_join(j, true, UINT64_MAX, out, error);
    if (status != TN_OK && error)
        *error = ignored;
    return status;
}

/* ---- projected: sets of their states */

typedef struct projecting {
    const tn_projection *projection;
    const tn_classes *newer;
    const tn_sparse *plans;
    tn_join join;    /* of the older classes: a column for each set of what lies above */
    uint8_t *takes;  /* [join columns][columns of plans]: does the edge lie above? */
    uint32_t *stamp; /* [states]: of the last step that met the state */
    uint32_t steps;
    uint64_t effort;
} projecting;

static bool step(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    projecting *p = context;
    const tn_sparse *plans = p->plans;
    const uint8_t *takes = p->takes + (size_t)column * plans->columns;
    if (++p->steps == 0) { /* after 2^32 steps the stamps start again */
        memset(p->stamp, 0, plans->states * sizeof *p->stamp);
        p->steps = 1;
    }
    for (size_t i = 0; i < size; i++) {
        for (size_t e = plans->first[key[i]]; e < plans->first[key[i] + 1]; e++) {
            uint32_t target = plans->target[e];
            if (!takes[plans->label[e]] || p->stamp[target] == p->steps)
                continue;
            p->stamp[target] = p->steps;
            if (!tn_key_push(next, target))
                return false;
        }
        p->effort += plans->first[key[i] + 1] - plans->first[key[i]];
    }
    if (next->size > 1)
        qsort(next->data, next->size, sizeof *next->data, tn_words_compare);
    return true;
}

static bool accepts(void *context, const uint32_t *key, size_t size)
{
    const projecting *p = context;
    for (size_t i = 0; i < size; i++)
        if (p->plans->accept[key[i]])
            return true;
    return false;
}

/* The columns of `plans` above a class, ascending. seen: [newer classes]. */
static bool columns_above(const projecting *p, tn_tray tray, uint32_t *seen, uint32_t stamp, tn_key *columns)
{
    columns->size = 0;
    if (!tn_projection_list(p->projection, p->newer->of_tray, tray, seen, stamp, columns))
        return false;
    for (size_t i = 0; i < columns->size; i++)
        columns->data[i] = p->plans->column[p->newer->of_tray[columns->data[i]]];
    if (columns->size > 1)
        qsort(columns->data, columns->size, sizeof *columns->data, tn_words_compare);
    size_t kept = 0;
    for (size_t i = 0; i < columns->size; i++)
        if (kept == 0 || columns->data[kept - 1] != columns->data[i])
            columns->data[kept++] = columns->data[i];
    columns->size = kept;
    return true;
}

/* Numbers the sets of columns above the older classes, and makes a column of each set. */
static tn_status make_columns(projecting *p, const tn_classes *classes, tn_interner *sets, uint32_t *set_of,
                              tn_error *error)
{
    uint32_t *seen = calloc((size_t)p->newer->count + 1, sizeof *seen);
    tn_key columns = {0};
    bool ok = seen != NULL;
    for (uint32_t c = 0; ok && c < classes->count; c++) {
        ok = columns_above(p, classes->representative[c], seen, c + 1, &columns);
        set_of[c] = ok ? tn_intern(sets, columns.data, columns.size) : UINT32_MAX;
        ok = set_of[c] != UINT32_MAX;
    }
    free(columns.data);
    free(seen);
    if (!ok)
        return tn_fail_memory(error);
    tn_status status = tn_join_make(&p->join, NULL, 0, classes->count, set_of, false, error);
    size_t width = p->plans->columns;
    p->takes = status == TN_OK ? calloc(tn_size_of(p->join.columns, width) + 1, 1) : NULL;
    for (uint32_t c = 0; p->takes && c < p->join.columns; c++) {
        size_t size;
        const uint32_t *set = tn_interned(sets, set_of[p->join.letter[c]], &size);
        for (size_t i = 0; i < size; i++)
            p->takes[c * width + set[i]] = 1;
    }
    return status != TN_OK || p->takes ? status : tn_fail_memory(error);
}

static tn_status project(projecting *p, const tn_classes *classes, tn_bounds *bounds, tn_dfa **out, tn_error *error)
{
    tn_interner sets = {0};
    tn_key start = {0};
    uint32_t *set_of = calloc((size_t)classes->count + 1, sizeof *set_of);
    p->stamp = calloc((size_t)p->plans->states + 1, sizeof *p->stamp);
    bool ok = set_of && p->stamp && (p->plans->states == 0 || tn_key_push(&start, 0));
    tn_status status = ok ? make_columns(p, classes, &sets, set_of, error) : tn_fail_memory(error);
    if (status == TN_OK) {
        tn_construction construction = {"projection", &p->join, p, step, accepts};
        status = tn_explore(&construction, &start, &p->effort, bounds, out, error);
    }
    tn_interner_clear(&sets);
    tn_join_clear(&p->join);
    free(p->takes);
    free(p->stamp);
    free(set_of);
    free(start.data);
    return status;
}

static uint32_t joined_states(uint32_t max_states)
{
    return max_states == 0 || max_states == TN_STATES_DEFAULT ? JOINED_STATES_DEFAULT : max_states;
}

static tn_status join_all(const tn_projection *projection, const tn_classes *newer, const tn_image_options *options,
                          tn_sparse **out, tn_error *error)
{
    joining j = {projection, newer, .max_trays = options->max_trays};
    j.bounds = tn_bounds_make(joined_states(options->max_states));
    j.bounds.watch = projection->schema->module->watch;
    j.order = calloc((size_t)projection->library->clause_count + 1, sizeof *j.order);
    tn_status status =
        j.order ? tn_image_clauses(projection, newer, options, &j.clauses, error) : tn_fail_memory(error);
    if (status == TN_OK) {
        find_order(&j);
        status = join(&j, out, error);
    }
    tn_image_clauses_free(projection, j.clauses);
    free(j.order);
    return status;
}

tn_status tn_lower_above(const tn_projection *projection, const tn_classes *newer, uint32_t max_states,
                         uint32_t max_trays, tn_sparse **out, tn_error *error)
{
    tn_image_options options = {.max_states = max_states, .max_trays = max_trays};
    return join_all(projection, newer, &options, out, error);
}

static tn_status lower(const tn_projection *projection, const tn_classes *newer, const tn_classes *classes,
                       const tn_image_options *options, tn_dfa **out, tn_error *error)
{
    tn_sparse *plans = NULL;
    tn_status status = join_all(projection, newer, options, &plans, error);
    if (status == TN_OK) { /* of a rule alone, which is to be matched, as of any rule; in a library as of its clauses */
        uint32_t states = options->max_trays > 0 ? joined_states(options->max_states) : options->max_states;
        projecting p = {projection, newer, plans, .steps = 0};
        tn_bounds bounds = tn_bounds_make(states);
        bounds.watch = projection->schema->module->watch;
        status = project(&p, classes, &bounds, out, error);
    }
    tn_sparse_free(plans);
    return status;
}

tn_status tn_image_lower(const tn_classes *classes, const tn_instruction *image, const tn_image_options *options,
                         tn_dfa **out, tn_error *error)
{
    tn_projection *projection = NULL;
    tn_classes *newer = NULL;
    tn_status status = tn_projection_new(classes->schema, image, &projection, error);
    if (status == TN_OK)
        status = tn_classes_above(projection, &newer, error);
    if (status == TN_OK)
        status = lower(projection, newer, classes, options, out, error);
    tn_classes_free(newer);
    tn_projection_free(projection);
    return status;
}
