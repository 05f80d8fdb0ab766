/* Writes what an edit does to a library as tables. */
#include "cli/plan/diff_text.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "driver/open/digits.h"

enum { REMOVED, ADDED, KEPT, KINDS };
static const char *const kinds[KINDS] = {"removed", "added", "kept"};

static mpz_srcptr count_of(const tn_compared_counts *counts, int kind)
{
    return kind == REMOVED ? counts->removed : kind == ADDED ? counts->added : counts->kept;
}

static void write_number(const mpz_t number, int width, FILE *out)
{
    char *text = tn_digits(number, true);
    fprintf(out, "  %*s", width, text ? text : "?");
    free(text);
}

static void write_counts(const tn_compared_counts *counts, const int *widths, FILE *out)
{
    for (int i = 0; i < KINDS; i++)
        write_number(count_of(counts, i), widths[i], out);
    fputc('\n', out);
}

static void write_lengths(const tn_compared *c, FILE *out)
{
    int widths[KINDS];
    fprintf(out, "%8s", "trays");
    for (int i = 0; i < KINDS; i++) {
        widths[i] = tn_digits_width(count_of(&c->total, i), kinds[i]);
        fprintf(out, "  %*s", widths[i], kinds[i]);
    }
    fputc('\n', out);
    for (size_t i = 0; i < c->by_length.count; i++) {
        fprintf(out, "%8" PRIu64, c->by_length.items[i].length);
        write_counts(&c->by_length.items[i].counts, widths, out);
    }
    fprintf(out, "%8s", "total");
    write_counts(&c->total, widths, out);
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static void write_clauses(const tn_compared *c, FILE *out)
{
    int names = (int)strlen("clause"), removes = (int)strlen("removes"), adds = (int)strlen("adds");
    for (size_t i = 0; i < c->clauses.count; i++) {
        const tn_compared_clause *clause = &c->clauses.items[i];
        names = larger(names, (int)strlen(clause->name));
        removes = larger(removes, tn_digits_width(clause->removes, "removes"));
        adds = larger(adds, tn_digits_width(clause->adds, "adds"));
    }
    if (c->clauses.count > 0)
        fprintf(out, "\n%-*s  %-7s  %*s  %*s\n", names, "clause", "is", removes, "removes", adds, "adds");
    for (size_t i = 0; i < c->clauses.count; i++) {
        const tn_compared_clause *clause = &c->clauses.items[i];
        fprintf(out, "%-*s  %-7s", names, clause->name, clause->change);
        write_number(clause->removes, removes, out);
        write_number(clause->adds, adds, out);
        fputc('\n', out);
    }
}

/* ---- weights and preferences */

static void write_leanings(const char *kind, const tn_compared_weight *items, size_t count, FILE *out)
{
    int names = (int)strlen(kind);
    for (size_t i = 0; i < count; i++)
        names = larger(names, (int)strlen(items[i].name));
    if (count > 0)
        fprintf(out, "\n%-*s  %-7s  before  after\n", names, kind, "is");
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%-*s  %-7s  %6s  %5s\n", names, items[i].name, items[i].change,
                items[i].has_before ? items[i].shown_before : "-", items[i].has_after ? items[i].shown_after : "-");
}

/* ---- measures */

enum { NUMBERS = 3, CELL_SIZE = 256 };
static const char *const numbers[NUMBERS] = {"least", "mean", "most"};

/* "115.2 m2 -> 118.8 m2", or one of them if both are the same. */
static void make_cell(const tn_compared_measure *m, int number, char *cell)
{
    const char *before = m->before.shown.items[number], *after = m->after.shown.items[number];
    if (strcmp(before, after) == 0)
        snprintf(cell, CELL_SIZE, "%s", before);
    else
        snprintf(cell, CELL_SIZE, "%s -> %s", before, after);
}

static int cell_width(const tn_compared *c, int number)
{
    char cell[CELL_SIZE];
    int width = (int)strlen(numbers[number]);
    for (size_t i = 0; i < c->measures.count; i++) {
        make_cell(&c->measures.items[i], number, cell);
        width = larger(width, (int)strlen(cell));
    }
    return width;
}

static void write_measures(const tn_compared *c, FILE *out)
{
    int names = (int)strlen("measure"), widths[NUMBERS];
    char cell[CELL_SIZE];
    if (c->measures.count == 0)
        return;
    for (size_t i = 0; i < c->measures.count; i++)
        names = larger(names, (int)strlen(c->measures.items[i].name));
    fprintf(out, "\n%-*s", names, "measure");
    for (int n = 0; n < NUMBERS; n++) {
        widths[n] = cell_width(c, n);
        fprintf(out, "  %*s", widths[n], numbers[n]);
    }
    fputc('\n', out);
    for (size_t i = 0; i < c->measures.count; i++) {
        fprintf(out, "%-*s", names, c->measures.items[i].name);
        for (int n = 0; n < NUMBERS; n++) {
            make_cell(&c->measures.items[i], n, cell);
            fprintf(out, "  %*s", widths[n], cell);
        }
        fputc('\n', out);
    }
}

/* ---- examples */

static void write_plans(const char *kind, const tn_ranked_line *plans, size_t count, FILE *out)
{
    if (count > 0)
        fprintf(out, "\n%s, the first%s:\n", kind, count == 1 ? "" : " and some at random");
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s\n", plans[i].plan);
}

static void write_houses(const char *kind, const char *clause, const tn_owneds *houses, FILE *out)
{
    if (houses->count > 0)
        fprintf(out, "\n%s by %s, some of them:\n", kind, clause);
    for (size_t i = 0; i < houses->count; i++)
        fprintf(out, "%s\n", houses->items[i]);
}

void tn_diff_text(const tn_compared *c, FILE *out)
{
    bool same = mpz_sgn(c->total.removed) == 0 && mpz_sgn(c->total.added) == 0;
    const char *what = c->has_plans ? "plans" : "houses";
    fprintf(out, "%s of %s, ", c->before.library, c->before.file);
    if (strcmp(c->before.library, c->after.library) != 0)
        fprintf(out, "%s of ", c->after.library);
    fprintf(out, "%s: %s%s\n\n", c->after.file, same ? "the same " : "what changes", same ? what : "");
    write_lengths(c, out);
    write_clauses(c, out);
    write_leanings("preference", c->preferences.items, c->preferences.count, out);
    write_leanings("weight", c->weights.items, c->weights.count, out);
    write_measures(c, out);
    write_plans(kinds[REMOVED], c->plans.removed.items, c->plans.removed.count, out);
    write_plans(kinds[ADDED], c->plans.added.items, c->plans.added.count, out);
    write_plans(kinds[KEPT], c->plans.kept.items, c->plans.kept.count, out);
    for (size_t i = 0; i < c->clauses.count; i++) {
        const tn_compared_clause *clause = &c->clauses.items[i];
        write_houses(kinds[REMOVED], clause->name, &clause->houses.removed, out);
        write_houses(kinds[ADDED], clause->name, &clause->houses.added, out);
    }
}
