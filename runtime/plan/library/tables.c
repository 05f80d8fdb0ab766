/* The tables that a library is counted, ranked and enumerated with. */
#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/base/memory.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/library/library_data.h"

#define PASSED_ENTRIES_MAX (UINT64_C(1) << 22) /* 16 MB of marks at most */

static tn_status pass_table(const tn_library *library, uint64_t bytes, uint32_t length, tn_error *error)
{
    if (bytes <= library->max_table)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_TABLE_TOO_LARGE,
            "the table of counts passes the limit of %llu bytes at plans of %u trays (%u states)",
            (unsigned long long)library->max_table, length, library->kept->states);
    tn_error_help(error, "give fewer trays with --trays, or leave out rules that multiply the states");
    return TN_LIMIT;
}

/* What the rows to come will take, said before they are made. */
static tn_status check_rows(const tn_library *library, uint64_t bytes, uint32_t left, tn_error *error)
{
    uint64_t coming = tn_count_to_come(library->rows[left / 2].limbs, library->rows[left].limbs, left, library->max);
    uint64_t rows = coming > UINT64_MAX / 4 / library->kept->states ? UINT64_MAX / 4 : coming * library->kept->states;
    char needed[32], limit[32], what[64];
    tn_memory_write(bytes + rows, needed);
    tn_memory_write(library->max_table, limit);
    if (bytes + rows > library->max_table) {
        tn_fail(error, TN_LIMIT, E_TABLE_TOO_LARGE,
                "the table of counts for plans of up to %u trays would take about %s (%u states); the limit is %s",
                library->max, needed, library->kept->states, limit);
        tn_error_help(error, "give fewer trays with --trays, or leave out rules that multiply the states");
        return TN_LIMIT;
    }
    snprintf(what, sizeof what, "the table of counts for plans of up to %u trays", library->max);
    tn_status status = tn_watch_room(library->schema->module->watch, rows + 2 * coming, what, error); /* and totals */
    if (status == TN_LIMIT)
        tn_error_help(error, "give fewer trays with --trays, or raise the limit with --memory-limit");
    return status;
}

static tn_status fill_rows(tn_library *library, const tn_edges *edges, tn_error *error)
{
    uint64_t bytes = (uint64_t)library->kept->states * library->kept->columns * sizeof *library->kept->delta;
    for (uint32_t left = 0; left <= library->max; left++) {
        tn_count_row *row = &library->rows[left];
        tn_status status = left ? tn_count_row_next(edges, row - 1, row, error) : tn_count_row_first(edges, row, error);
        bytes += tn_count_row_bytes(edges, row) + edges->states * sizeof(double);
        if (status == TN_OK)
            status = pass_table(library, bytes, left, error);
        if (status == TN_OK && left < library->max && tn_count_forecasts(left))
            status = check_rows(library, bytes, left, error);
        if (status == TN_OK)
            status = tn_watch_check(library->schema->module->watch, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static bool is_zero(const mp_limb_t *value, size_t limbs)
{
    while (limbs > 0 && value[limbs - 1] == 0)
        limbs--;
    return limbs == 0;
}

/* What the other tables say of a row. */
static void note_row(tn_library *library, uint32_t left)
{
    const tn_count_row *row = &library->rows[left];
    for (uint32_t s = 0; s < library->kept->states; s++) {
        const mp_limb_t *value = tn_count_row_at(row, s);
        if (is_zero(value, row->limbs))
            continue;
        mpz_t count;
        mpz_roinit_n(count, value, (mp_size_t)row->limbs);
        library->nearly[(size_t)left * library->kept->states + s] = tn_nearly(count, row->limbs);
        library->alive[(size_t)left * library->alive_words + s / 64] |= UINT64_C(1) << (s % 64);
    }
}

static tn_status make_rows(tn_library *library, tn_error *error)
{
    uint64_t *weights = NULL;
    tn_edges edges = {0};
    size_t lengths = (size_t)library->max + 1;
    uint32_t states = library->kept->states;
    library->alive_words = states / 64 + 1;
    library->rows = calloc(lengths, sizeof *library->rows);
    library->alive = calloc(tn_size_of(lengths, library->alive_words), sizeof *library->alive);
    library->nearly = calloc(tn_size_of(lengths, states), sizeof *library->nearly);
    library->hash_room = tn_array_new(tn_library_hash_words(library), sizeof *library->hash_room);
    if (!library->hash_room || !library->rows || !library->alive || !library->nearly)
        return tn_fail_memory(error);
    tn_status status = tn_column_weights(library->classes->size, library->classes->count, library->kept->column,
                                         library->kept->columns, &weights, error);
    if (status == TN_OK)
        status = tn_edges_of(&edges, library->kept, weights, error);
    if (status == TN_OK)
        status = fill_rows(library, &edges, error);
    for (uint32_t left = 0; status == TN_OK && left <= library->max; left++)
        note_row(library, left);
    tn_edges_clear(&edges);
    free(weights);
    return status;
}

/* How many plans of so many trays there are, from the rows. */
static void add_totals(tn_library *library)
{
    for (uint32_t length = library->min; length <= library->max; length++)
        tn_count_row_add(&library->rows[length], 0, 1, library->before[length + 1]);
}

/* The same of what the automaton and the clause that it leaves out keep. */
static tn_status count_apart(tn_library *library, tn_error *error)
{
    tn_bounds bounds = tn_library_bounds(library);
    mpz_t *kept = tn_integers_new((size_t)library->max + 1);
    if (!kept)
        return tn_fail_memory(error);
    tn_status status = tn_count_both_lengths(library->live, library->clauses[library->apart],
                                             tn_library_keeping(library, library->apart), library->classes->size,
                                             library->max, "library", &bounds, kept, error);
    for (uint32_t length = library->min; status == TN_OK && length <= library->max; length++)
        mpz_set(library->before[length + 1], kept[length]);
    tn_integers_free(kept, (size_t)library->max + 1);
    return status;
}

static tn_status make_totals(tn_library *library, tn_error *error)
{
    size_t lengths = (size_t)library->max + 1;
    tn_status status = TN_OK;
    library->generated = tn_integers_new(lengths);
    library->before = tn_integers_new(lengths + 1);
    if (!library->generated || !library->before)
        return tn_fail_memory(error);
    if (library->apart == SIZE_MAX)
        add_totals(library);
    else
        status = count_apart(library, error);
    if (status != TN_OK)
        return status;
    for (uint32_t length = 0; length < lengths; length++)
        mpz_add(library->before[length + 1], library->before[length + 1], library->before[length]);
    return tn_count_lengths(library->generator, library->classes->size, library->max, library->generated,
                            library->schema->module->watch, error);
}

/* Of trays that are listed: marks how many trays of each column have passed, every so many trays. */
static tn_status make_passed(tn_library *library, tn_error *error)
{
    uint32_t trays = library->schema->tray_count, columns = library->kept->columns;
    library->stride = 1;
    while (((uint64_t)trays / library->stride + 2) * columns > PASSED_ENTRIES_MAX)
        library->stride *= 2;
    library->tray_column = calloc((size_t)trays + 1, sizeof *library->tray_column);
    library->passed = calloc(tn_size_of((size_t)trays / library->stride + 2, columns) + 1, sizeof *library->passed);
    uint32_t *count = calloc((size_t)columns + 1, sizeof *count);
    bool ok = library->tray_column && library->passed && count;
    for (tn_tray t = 0; ok && t <= trays; t++) {
        for (uint32_t c = 0; t % library->stride == 0 && c < columns; c++)
            library->passed[(size_t)(t / library->stride) * columns + c] = count[c];
        if (t == trays)
            break;
        library->tray_column[t] = library->kept->column[library->classes->of_tray[t]];
        count[library->tray_column[t]]++;
    }
    free(count);
    return ok ? TN_OK : tn_fail_memory(error);
}

/* Where runs of trays of one column end, so that the cursor steps over a dead run at once. */
static tn_status make_runs(tn_library *library, tn_error *error)
{
    uint32_t trays = library->schema->tray_count;
    library->run_end = calloc((size_t)trays + 1, sizeof *library->run_end);
    if (!library->run_end)
        return tn_fail_memory(error);
    for (tn_tray t = trays; t-- > 0;) {
        bool same = t + 1 < trays && library->tray_column[t] == library->tray_column[t + 1];
        library->run_end[t] = same ? library->run_end[t + 1] : t + 1;
    }
    return TN_OK;
}

tn_status tn_library_tables(tn_library *library, tn_error *error)
{
    if (library->apart != SIZE_MAX)
        return make_totals(library, error);
    tn_status status = make_rows(library, error);
    if (status == TN_OK)
        status = make_totals(library, error);
    if (status == TN_OK && !library->schema->legal)
        status = make_passed(library, error);
    if (status == TN_OK && !library->schema->legal)
        status = make_runs(library, error);
    return status;
}

/* ---- counts */

void tn_library_kept(const tn_library *library, uint32_t length, mpz_t count)
{
    if (length == TN_ALL_LENGTHS)
        mpz_set(count, library->before[library->max + 1]);
    else if (length < library->min || length > library->max)
        mpz_set_ui(count, 0);
    else
        mpz_sub(count, library->before[length + 1], library->before[length]);
}

tn_status tn_library_generated(const tn_library *library, uint32_t length, mpz_t count, tn_error *error)
{
    (void)error;
    mpz_set_ui(count, 0);
    for (uint32_t n = library->min; n <= library->max; n++)
        if (length == TN_ALL_LENGTHS || length == n)
            mpz_add(count, count, library->generated[n]);
    return TN_OK;
}
