/* Relations as matrices for people. */
#include "cli/plan/relations_text.h"

#include <string.h>

/* How a relation is written: the sign in the matrix, its word, and what it means of rules, and of clauses about houses.
 */
typedef struct sign {
    char letter;
    const char *word, *meaning, *of_houses;
} sign;

enum { UNKNOWN, EQUAL, APART, INSIDE, CONTAINS, OVERLAP, SIGNS };

static const sign signs[SIGNS] = {
    [UNKNOWN] = {'?', "unknown", "not analysed", "not found out"},
    [EQUAL] = {'=', "equal", "the same plans", "the same houses"},
    [APART] = {'/', "apart", "no plan in common", "no house in common"},
    [INSIDE] = {'<', "inside", "the column's rule matches all that the row's does",
                "the column's clause matches all that the row's does"},
    [CONTAINS] = {'>', "contains", "the row's rule matches all that the column's does",
                  "the row's clause matches all that the column's does"},
    [OVERLAP] = {'x', "overlap", "some plans in common", "some houses in common"},
};

static int sign_of(const char *word)
{
    for (int s = 0; s < SIGNS; s++)
        if (strcmp(signs[s].word, word) == 0)
            return s;
    return UNKNOWN;
}

static const tn_texts *names_of(const tn_related *related)
{
    return related->has_library ? &related->clauses : &related->rules;
}

/* Pairs are in the order of a row's cells behind the diagonal. */
static int relation(const tn_related *related, size_t i, size_t j)
{
    size_t count = names_of(related)->count, low = i < j ? i : j, high = i < j ? j : i;
    size_t before = low * count - low * (low + 1) / 2;
    int s = sign_of(related->relations.items[before + high - low - 1].relation);
    return i < j ? s : s == INSIDE ? CONTAINS : s == CONTAINS ? INSIDE : s;
}

static int name_width(const tn_texts *names)
{
    int width = 0;
    for (size_t i = 0; i < names->count; i++) {
        int length = (int)strlen(names->items[i]);
        width = length > width ? length : width;
    }
    return width;
}

/* Each has a number, which heads its column. */
static void write_matrix(const tn_related *related, FILE *out)
{
    const tn_texts *names = names_of(related);
    size_t count = names->count, cells[SIGNS] = {0};
    int width = name_width(names), digits = snprintf(NULL, 0, "%zu", count);
    fprintf(out, "%*s", digits + 1 + width, "");
    for (size_t j = 0; j < count; j++)
        fprintf(out, " %*zu", digits, j + 1);
    fputc('\n', out);
    for (size_t i = 0; i < count; i++) {
        fprintf(out, "%*zu %-*s", digits, i + 1, width, names->items[i]);
        for (size_t j = 0; j < count; j++) {
            int s = i == j ? EQUAL : relation(related, i, j);
            cells[s] += i != j;
            fprintf(out, " %*c", digits, i == j ? '.' : signs[s].letter);
        }
        fputc('\n', out);
    }
    for (int s = 0; s < SIGNS; s++)
        if (cells[s]) /* inside and contains are one relation seen from both */
            fprintf(out, "%c %s: %s (%zu)\n", signs[s].letter, signs[s].word,
                    related->has_library ? signs[s].of_houses : signs[s].meaning,
                    s == INSIDE || s == CONTAINS ? cells[s] : cells[s] / 2);
}

static void write_pair(const tn_related_pair *pair, FILE *out)
{
    if (!pair->has_both)
        return;
    fprintf(out, "\n%s, %s: %s\n", pair->a, pair->b, pair->relation);
    if (pair->both)
        fprintf(out, "  both: %s\n", pair->both);
    if (pair->only_a)
        fprintf(out, "  only %s: %s\n", pair->a, pair->only_a);
    if (pair->only_b)
        fprintf(out, "  only %s: %s\n", pair->b, pair->only_b);
}

void tn_relations_text(const tn_relations *relations, FILE *out)
{
    size_t schemas = 0;
    const char *between = "";
    for (size_t i = 0; i < relations->items.count; i++)
        schemas += relations->items.items[i].has_schema;
    for (size_t i = 0; i < relations->items.count; i++) {
        const tn_related *related = &relations->items.items[i];
        if (related->has_schema && related->rules.count == 0)
            continue;
        if (related->has_library)
            fprintf(out, "%shouses that the clauses of %s match\n", between, related->library);
        else if (schemas > 1)
            fprintf(out, "%s%s\n", between, related->schema);
        write_matrix(related, out);
        for (size_t k = 0; k < related->relations.count; k++)
            write_pair(&related->relations.items[k], out);
        between = "\n";
    }
}
