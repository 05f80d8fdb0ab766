/* The automata that the search for near plans walks, and what each of them says is still to come. */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/library/near_data.h"

#include "runtime/base/array.h"

#define LEAD_WORK 8000000u /* steps that finding out what is to come may take for one part */
#define COMBINE_WORK 40u   /* steps an edge of what is combined */

/* ---- combining */

static void parts_clear(tn_near_finder *finder)
{
    for (size_t i = 0; i < finder->part_count; i++) {
        tn_sparse_free(finder->parts[i].live);
        free(finder->parts[i].delta);
        free(finder->parts[i].togo);
    }
    free(finder->parts);
    free(finder->joint_of);
    free(finder->joint_label);
    free(finder->joint_first);
    finder->parts = NULL;
    finder->part_count = 0;
    finder->joint_of = finder->joint_label = finder->joint_first = NULL;
}

void tn_near_finder_free(tn_near_finder *finder)
{
    if (!finder)
        return;
    parts_clear(finder);
    for (size_t i = 0; finder->clauses && i < finder->clause_count; i++)
        tn_dfa_free(finder->clauses[i]);
    free(finder->clauses);
    tn_classes_free(finder->classes);
    free(finder);
}

/* *live := *live and the clause, if that is little work. */
static tn_status join(const tn_near_finder *finder, const tn_dfa *clause, tn_sparse **live, tn_error *error)
{
    tn_bounds bounds = {.max_states = (uint32_t)finder->combine,
                        .max_transitions = finder->combine,
                        .max_words = finder->combine,
                        .max_work = COMBINE_WORK * finder->combine};
    tn_sparse *product = NULL, *small = NULL;
    tn_status status = tn_sparse_product(*live, clause, TN_DFA_AND, "library", &bounds, &product, error);
    if (status == TN_OK)
        status = tn_sparse_minimise(product, &small, error);
    tn_sparse_free(product);
    if (status != TN_OK)
        return status;
    tn_sparse_free(*live);
    *live = small;
    return TN_OK;
}

static tn_status finish_part(tn_near_part *part, tn_error *error)
{
    const tn_sparse *live = part->live;
    size_t entries = (size_t)live->states * live->columns;
    part->delta = malloc((entries + 1) * sizeof *part->delta);
    if (!part->delta)
        return tn_fail_memory(error);
    memset(part->delta, 0xff, entries * sizeof *part->delta); /* TN_NO_STATE */
    for (uint32_t q = 0; q < live->states; q++)
        for (size_t e = live->first[q]; e < live->first[q + 1]; e++)
            part->delta[(size_t)q * live->columns + live->label[e]] = live->target[e];
    return TN_OK;
}

/* Each clause goes into the part at hand, or begins another one. */
static tn_status make_parts(tn_near_finder *finder, tn_error *error)
{
    tn_error full;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < finder->clause_count; i++) {
        if (finder->part_count > 0) {
            status = join(finder, finder->clauses[i], &finder->parts[finder->part_count - 1].live, &full);
            if (status == TN_OK)
                continue;
            if (status != TN_LIMIT) {
                if (error)
                    *error = full;
                return status;
            }
        }
        status = tn_sparse_make(finder->clauses[i], 0, &finder->parts[finder->part_count++].live, error);
    }
    for (size_t k = 0; status == TN_OK && k < finder->part_count; k++)
        status = finish_part(&finder->parts[k], error);
    finder->combined = finder->part_count == 1;
    return status;
}

/* ---- joint columns */

/* Numbers the classes by their columns, in order of appearance; then renumbers them by their column in the first. */
static tn_status number_joints(tn_near_finder *finder, tn_interner *interner, tn_error *error)
{
    size_t parts = finder->part_count;
    uint32_t classes = finder->classes->count, columns = finder->parts[0].live->columns;
    uint32_t *labels = malloc((parts + 1) * sizeof *labels), *place = NULL;
    bool ok = labels != NULL;
    for (uint32_t c = 0; ok && c < classes; c++) {
        for (size_t k = 0; k < parts; k++)
            labels[k] = finder->parts[k].live->column[c];
        finder->joint_of[c] = tn_intern(interner, labels, parts);
        ok = finder->joint_of[c] != UINT32_MAX;
    }
    finder->joints = interner->count;
    finder->joint_label = tn_array_new(tn_size_of(finder->joints, parts) + 1, sizeof *finder->joint_label);
    finder->joint_first = calloc((size_t)columns + 2, sizeof *finder->joint_first);
    place = malloc(((size_t)finder->joints + 1) * sizeof *place);
    ok = ok && finder->joint_label && finder->joint_first && place;
    size_t size;
    for (uint32_t j = 0; ok && j < finder->joints; j++)
        finder->joint_first[tn_interned(interner, j, &size)[0] + 1]++;
    for (uint32_t column = 0; ok && column < columns; column++)
        finder->joint_first[column + 1] += finder->joint_first[column];
    for (uint32_t j = 0; ok && j < finder->joints; j++) {
        const uint32_t *its = tn_interned(interner, j, &size);
        place[j] = finder->joint_first[its[0]]++;
        memcpy(finder->joint_label + place[j] * parts, its, parts * sizeof *its);
    }
    for (uint32_t column = columns; ok && column > 0; column--)
        finder->joint_first[column] = finder->joint_first[column - 1];
    if (ok)
        finder->joint_first[0] = 0;
    for (uint32_t c = 0; ok && c < classes; c++)
        finder->joint_of[c] = place[finder->joint_of[c]];
    free(labels);
    free(place);
    return ok ? TN_OK : tn_fail_memory(error);
}

static tn_status make_joints(tn_near_finder *finder, tn_error *error)
{
    tn_interner interner = {0};
    finder->joint_of = malloc(((size_t)finder->classes->count + 1) * sizeof *finder->joint_of);
    tn_status status = finder->joint_of ? number_joints(finder, &interner, error) : tn_fail_memory(error);
    tn_interner_clear(&interner);
    return status;
}

tn_status tn_near_combine(tn_near_finder *finder, tn_error *error)
{
    parts_clear(finder);
    finder->parts = calloc(finder->clause_count + 1, sizeof *finder->parts);
    if (!finder->parts)
        return tn_fail_memory(error);
    tn_status status = make_parts(finder, error);
    return status == TN_OK ? make_joints(finder, error) : status;
}

/* ---- what is to come */

uint32_t tn_near_to_come(const tn_near_band *band, uint32_t read, uint32_t written)
{
    uint32_t left = band->length - read, high = band->max - written;
    uint32_t low = written < band->min ? band->min - written : 0;
    uint32_t trays = left < low ? low - left : left > high ? left - high : 0;
    return trays * band->fields;
}

/* The change to each column of a part: the least of its joint columns. */
static void part_change(const tn_near_finder *finder, size_t k, const uint32_t *joint_change, uint32_t *change)
{
    memset(change, 0xff, finder->parts[k].live->columns * sizeof *change);
    for (uint32_t j = 0; j < finder->joints; j++) {
        uint32_t *least = &change[finder->joint_label[j * finder->part_count + k]];
        *least = joint_change[j] < *least ? joint_change[j] : *least;
    }
}

static uint32_t less(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static uint32_t and_then(uint32_t cost, uint32_t togo)
{
    return togo == TN_FAR ? TN_FAR : cost + togo;
}

/* Fills one cell from those that come after it. */
static void lead_cell(tn_near_part *part, const tn_near_band *band, const uint32_t *change, uint32_t read,
                      uint32_t written)
{
    const tn_sparse *live = part->live;
    size_t n = live->states;
    size_t left_out = tn_near_cell(band, read + 1, written), added = tn_near_cell(band, read, written + 1),
           changed = tn_near_cell(band, read + 1, written + 1);
    uint32_t *here = part->togo + tn_near_cell(band, read, written) * n;
    const uint32_t *without = left_out != SIZE_MAX ? part->togo + left_out * n : NULL;
    const uint32_t *more = added != SIZE_MAX ? part->togo + added * n : NULL;
    const uint32_t *other = changed != SIZE_MAX ? part->togo + changed * n : NULL;
    for (size_t q = 0; q < n; q++) {
        uint32_t best = read == band->length && written >= band->min && live->accept[q] ? 0 : TN_FAR;
        if (without)
            best = less(best, and_then(band->fields, without[q]));
        for (size_t e = live->first[q]; e < live->first[q + 1]; e++) {
            if (more)
                best = less(best, and_then(band->fields, more[live->target[e]]));
            if (other)
                best = less(best, and_then(change[live->label[e]], other[live->target[e]]));
        }
        here[q] = best;
    }
}

static tn_status lead_part(tn_near_finder *finder, size_t k, const tn_near_band *band, const uint32_t *change,
                           tn_error *error)
{
    tn_near_part *part = &finder->parts[k];
    size_t cells = tn_near_cells(band), n = part->live->states;
    free(part->togo);
    part->togo = NULL;
    if (cells > LEAD_WORK / (part->live->first[n] + n + 1))
        return TN_OK;
    part->togo = tn_array_new(tn_size_of(cells, n) + 1, sizeof *part->togo);
    uint32_t *own = malloc(((size_t)part->live->columns + 1) * sizeof *own);
    if (!part->togo || !own) {
        free(own);
        return tn_fail_memory(error);
    }
    memset(part->togo, 0xff, cells * n * sizeof *part->togo); /* TN_FAR */
    for (uint32_t read = band->length + 1; read-- > 0;) {
        if (read < band->length)
            part_change(finder, k, change + (size_t)read * finder->joints, own);
        uint32_t low = read > band->width ? read - band->width : 0;
        uint32_t high = less(band->max, read + band->width);
        for (uint32_t written = high + 1; written-- > low;)
            lead_cell(part, band, own, read, written);
    }
    free(own);
    return TN_OK;
}

tn_status tn_near_lead(tn_near_finder *finder, const tn_near_band *band, const uint32_t *change, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t k = 0; status == TN_OK && k < finder->part_count; k++)
        status = lead_part(finder, k, band, change, error);
    return status;
}
