/* Makes the small automata of marked words, and those that products of them give. */
#include "runtime/automata/marked.h"

#include <string.h>

/* ---- small automata written out: columns are 0 (other letters), 1 (letters that `chosen` names, or NULL) and the
 * marker */

typedef struct tn_small_row {
    uint8_t other, chosen, marker, accepts;
} tn_small_row;

/* Those below are minimal: only where letters lack can states become alike. */
static bool has_all_letters(const tn_marked *marked, const uint8_t *chosen)
{
    return marked->letters > 1 && (!chosen || memchr(chosen, true, marked->letters - 1));
}

static tn_status small(const tn_marked *marked, const tn_small_row *rows, uint32_t states, const uint8_t *chosen,
                       tn_dfa **out, tn_error *error)
{
    tn_dfa *dfa = tn_dfa_new(marked->letters, 3, states);
    if (!dfa)
        return tn_fail_memory(error);
    for (uint32_t l = 0; l + 1 < marked->letters; l++)
        dfa->column[l] = chosen && chosen[l];
    dfa->column[marked->letters - 1] = 2;
    for (uint32_t s = 0; s < states; s++) {
        dfa->delta[(size_t)s * 3] = rows[s].other;
        dfa->delta[(size_t)s * 3 + 1] = rows[s].chosen;
        dfa->delta[(size_t)s * 3 + 2] = rows[s].marker;
        dfa->accept[s] = rows[s].accepts;
    }
    tn_status status = (has_all_letters(marked, chosen) ? tn_dfa_tidy : tn_dfa_minimise)(dfa, 0, out, error);
    tn_dfa_free(dfa);
    return status;
}

tn_status tn_marked_make(tn_marked *marked, uint32_t letters, tn_bounds *bounds, tn_error *error)
{
    *marked = (tn_marked){.letters = letters + 1, .bounds = bounds};
    static const tn_small_row all[] = {{0, 0, 1, 0}, {1, 1, 2, 0}, {2, 2, 3, 1}, {3, 3, 3, 0}};
    static const tn_small_row nonempty[] = {{0, 0, 1, 0}, {2, 2, 4, 0}, {2, 2, 3, 0}, {3, 3, 4, 1}, {4, 4, 4, 0}};
    static const tn_small_row empty[] = {{0, 0, 1, 0}, {3, 3, 2, 0}, {2, 2, 3, 1}, {3, 3, 3, 0}};
    static const tn_small_row single[] = {{0, 0, 1, 0}, {2, 2, 4, 0}, {4, 4, 3, 0}, {3, 3, 4, 1}, {4, 4, 4, 0}};
    static const tn_small_row beginning[] = {{3, 3, 1, 0}, {1, 1, 2, 0}, {2, 2, 3, 1}, {3, 3, 3, 0}};
    static const tn_small_row end[] = {{0, 0, 1, 0}, {1, 1, 2, 0}, {3, 3, 3, 1}, {3, 3, 3, 0}};
    tn_status status = small(marked, all, 4, NULL, &marked->all, error);
    if (status == TN_OK)
        status = small(marked, nonempty, 5, NULL, &marked->nonempty, error);
    if (status == TN_OK)
        status = small(marked, empty, 4, NULL, &marked->empty, error);
    if (status == TN_OK)
        status = small(marked, single, 5, NULL, &marked->single, error);
    if (status == TN_OK)
        status = small(marked, beginning, 4, NULL, &marked->beginning, error);
    if (status == TN_OK)
        status = small(marked, end, 4, NULL, &marked->end, error);
    return status;
}

void tn_marked_clear(tn_marked *marked)
{
    tn_dfa_free(marked->all);
    tn_dfa_free(marked->nonempty);
    tn_dfa_free(marked->empty);
    tn_dfa_free(marked->single);
    tn_dfa_free(marked->beginning);
    tn_dfa_free(marked->end);
    *marked = (tn_marked){0};
}

tn_status tn_marked_letter(const tn_marked *marked, const uint8_t *chosen, tn_dfa **out, tn_error *error)
{
    static const tn_small_row rows[] = {{0, 0, 1, 0}, {4, 2, 4, 0}, {4, 4, 3, 0}, {3, 3, 4, 1}, {4, 4, 4, 0}};
    return small(marked, rows, 5, chosen, out, error);
}

tn_status tn_marked_not(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error)
{
    return tn_dfa_product(marked->all, a, TN_DFA_MINUS, "not", marked->bounds, out, error);
}

tn_status tn_marked_many(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error)
{
    tn_dfa *outside = NULL, *found = NULL;
    tn_status status = tn_dfa_product(marked->single, a, TN_DFA_MINUS, "many", marked->bounds, &outside, error);
    if (status == TN_OK)
        status = tn_marked_somewhere(marked, outside, &found, error);
    if (status == TN_OK)
        status = tn_dfa_product(marked->nonempty, found, TN_DFA_MINUS, "many", marked->bounds, out, error);
    tn_dfa_free(outside);
    tn_dfa_free(found);
    return status;
}

tn_status tn_marked_whole(const tn_marked *marked, const tn_dfa *a, tn_dfa **out, tn_error *error)
{
    uint32_t marker = marked->letters - 1;
    tn_dfa *plain = tn_dfa_new(marker, a->columns, a->states);
    if (!plain)
        return tn_fail_memory(error);
    memcpy(plain->column, a->column, marker * sizeof *plain->column);
    memcpy(plain->delta, a->delta, (size_t)a->states * a->columns * sizeof *plain->delta);
    for (uint32_t s = 0; s < a->states; s++)
        plain->accept[s] = a->accept[tn_dfa_read(a, s, marker)];
    tn_status status = tn_dfa_minimise(plain, tn_dfa_read(a, 0, marker), out, error);
    tn_dfa_free(plain);
    return status;
}

tn_status tn_marked_words(const tn_marked *marked, const tn_dfa *words, tn_dfa **out, tn_error *error)
{
    uint32_t columns = words->columns + 1, begin = 0, end = words->states + 1, dead = end + 1; /* 1 on: their states */
    tn_dfa *dfa = tn_dfa_new(marked->letters, columns, words->states + 3);
    if (!dfa)
        return tn_fail_memory(error);
    memcpy(dfa->column, words->column, words->letters * sizeof *dfa->column);
    dfa->column[marked->letters - 1] = words->columns;
    for (uint32_t s = 0; s < dfa->states; s++) {
        uint32_t *row = dfa->delta + (size_t)s * columns;
        bool inside = s > begin && s < end;
        for (uint32_t c = 0; c < words->columns; c++)
            row[c] = inside ? words->delta[(size_t)(s - 1) * words->columns + c] + 1 : dead;
        row[words->columns] = s == begin ? 1 : inside && words->accept[s - 1] ? end : dead;
    }
    dfa->accept[end] = 1;
    tn_status status = tn_dfa_minimise(dfa, 0, out, error);
    tn_dfa_free(dfa);
    return status;
}
