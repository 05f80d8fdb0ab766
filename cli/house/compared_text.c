/* Writes what an edit does to a library of houses, as text and as JSON. */
#include "cli/house/compared.h"

#include <stdlib.h>
#include <string.h>

#include "driver/open/digits.h"
#include "runtime/base/integers.h"

static const char *const change_words[] = {
    [TN_CLAUSE_CHANGED] = "changed", [TN_CLAUSE_ADDED] = "added", [TN_CLAUSE_REMOVED] = "removed"};
static const char *const ways[] = {"removed", "added"};

enum { REMOVED, ADDED, KEPT, COLUMNS };
static const char *const columns[COLUMNS] = {"removed", "added", "kept"};

/* The counts of a length, or (`to` beyond) of lengths [from, to). */
static void sum_row(const tn_compared_houses *c, uint32_t from, uint32_t to, mpz_t *row)
{
    for (int i = 0; i < COLUMNS; i++)
        mpz_set_ui(row[i], 0);
    for (uint32_t k = from; k < to; k++) {
        mpz_add(row[REMOVED], row[REMOVED], c->before[k]);
        mpz_add(row[ADDED], row[ADDED], c->after[k]);
        mpz_add(row[KEPT], row[KEPT], c->kept[k]);
    }
    mpz_sub(row[REMOVED], row[REMOVED], row[KEPT]);
    mpz_sub(row[ADDED], row[ADDED], row[KEPT]);
}

static const char *library_of(const tn_compared_side *side)
{
    return tn_text(side->n.form.module, side->n.record->name);
}

/* ---- text */

static bool put_number(tn_buffer *out, const mpz_t number, int width)
{
    char *text = tn_digits(number, true);
    bool put = text && tn_buffer_printf(out, "  %*s", width, text);
    free(text);
    return put;
}

static bool put_counts(const tn_compared_houses *c, mpz_t *row, tn_buffer *out)
{
    uint32_t count = c->high - c->low + 1;
    int widths[COLUMNS];
    sum_row(c, 0, count, row);
    bool good = tn_buffer_printf(out, "%8s", "trays");
    for (int i = 0; i < COLUMNS; i++) {
        widths[i] = tn_digits_width(row[i], columns[i]);
        good = good && tn_buffer_printf(out, "  %*s", widths[i], columns[i]);
    }
    for (uint32_t k = 0; good && k <= count; k++) {
        bool all = k == count;
        sum_row(c, all ? 0 : k, all ? count : k + 1, row);
        good = all ? tn_buffer_printf(out, "\n%8s", "total") : tn_buffer_printf(out, "\n%8u", c->low + k);
        for (int i = 0; good && i < COLUMNS; i++)
            good = put_number(out, row[i], widths[i]);
    }
    return good && tn_buffer_printf(out, "\n");
}

static bool put_edits(const tn_compared_houses *c, tn_buffer *out)
{
    int name = (int)strlen("clause"), widths[2] = {(int)strlen("removes"), (int)strlen("adds")};
    if (c->edit_count == 0)
        return true;
    for (size_t i = 0; i < c->edit_count; i++) {
        int wide[] = {tn_digits_width(c->edits[i].houses[0], "removes"),
                      tn_digits_width(c->edits[i].houses[1], "adds")};
        name = (int)strlen(c->edits[i].name) > name ? (int)strlen(c->edits[i].name) : name;
        for (int k = 0; k < 2; k++)
            widths[k] = wide[k] > widths[k] ? wide[k] : widths[k];
    }
    bool good = tn_buffer_printf(out, "\n%-*s  %-7s  %*s  %*s\n", name, "clause", "is", widths[0], "removes", widths[1],
                                 "adds");
    for (size_t i = 0; good && i < c->edit_count; i++)
        good = tn_buffer_printf(out, "%-*s  %-7s", name, c->edits[i].name, change_words[c->edits[i].change]) &&
               put_number(out, c->edits[i].houses[0], widths[0]) && put_number(out, c->edits[i].houses[1], widths[1]) &&
               tn_buffer_printf(out, "\n");
    return good;
}

static bool put_examples(const tn_house_edit *edit, tn_buffer *out)
{
    bool good = true;
    for (int which = 0; good && which < 2; which++) {
        if (edit->example_count[which] > 0)
            good = tn_buffer_printf(out, "\n%s by %s, some of them:\n", ways[which], edit->name);
        for (size_t i = 0; good && i < edit->example_count[which]; i++)
            good = tn_buffer_printf(out, "%s\n", edit->examples[which][i]);
    }
    return good;
}

static bool put_text(const tn_compared_houses *c, mpz_t *row, tn_buffer *out)
{
    const char *names[] = {library_of(&c->sides[0]), library_of(&c->sides[1])};
    sum_row(c, 0, c->high - c->low + 1, row);
    bool same = mpz_sgn(row[REMOVED]) == 0 && mpz_sgn(row[ADDED]) == 0;
    bool good = tn_buffer_printf(out, "%s of %s, ", names[0], c->sides[0].path);
    if (good && strcmp(names[0], names[1]) != 0)
        good = tn_buffer_printf(out, "%s of ", names[1]);
    good = good && tn_buffer_printf(out, "%s: %s\n\n", c->sides[1].path, same ? "the same houses" : "what changes") &&
           put_counts(c, row, out) && put_edits(c, out);
    for (size_t i = 0; good && i < c->edit_count; i++)
        good = put_examples(&c->edits[i], out);
    return good;
}

/* ---- JSON */

static void put_row(const tn_compared_houses *c, uint32_t from, uint32_t to, mpz_t *row, tn_json *json)
{
    sum_row(c, from, to, row);
    for (int i = 0; i < COLUMNS; i++)
        tn_json_digits(json, columns[i], row[i]);
}

static void lengths_json(const tn_compared_houses *c, mpz_t *row, tn_json *json)
{
    tn_json_object(json, "total");
    put_row(c, 0, c->high - c->low + 1, row, json);
    tn_json_object_end(json);
    tn_json_list(json, "by_length");
    for (uint32_t k = 0; k <= c->high - c->low; k++) {
        tn_json_object(json, NULL);
        put_row(c, k, k + 1, row, json);
        tn_json_count(json, "length", c->low + k);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static void edit_json(const tn_house_edit *edit, tn_json *json)
{
    tn_json_object(json, NULL);
    tn_json_string(json, "name", edit->name);
    tn_json_string(json, "change", change_words[edit->change]);
    tn_json_digits(json, "removes", edit->houses[0]);
    tn_json_digits(json, "adds", edit->houses[1]);
    tn_json_object(json, "houses");
    for (int which = 0; which < 2; which++) {
        tn_json_list(json, ways[which]);
        for (size_t i = 0; i < edit->example_count[which]; i++)
            tn_json_string(json, NULL, edit->examples[which][i]);
        tn_json_list_end(json);
    }
    tn_json_object_end(json);
    tn_json_object_end(json);
}

static bool put_json(const tn_compared_houses *c, mpz_t *row, tn_buffer *out)
{
    static const char *const keys[] = {"before", "after"};
    tn_json json = tn_json_text(out, TN_JSON_LINES);
    tn_json_object(&json, NULL);
    for (int i = 0; i < 2; i++) {
        tn_json_object(&json, keys[i]);
        tn_json_string(&json, "file", c->sides[i].path);
        tn_json_string(&json, "library", library_of(&c->sides[i]));
        tn_json_object_end(&json);
    }
    lengths_json(c, row, &json);
    tn_json_list(&json, "clauses");
    for (size_t i = 0; i < c->edit_count; i++)
        edit_json(&c->edits[i], &json);
    tn_json_list_end(&json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
    return !out->failed;
}

tn_status tn_compared_write(const tn_compared_houses *c, bool json, tn_buffer *out, tn_error *error)
{
    mpz_t *row = tn_integers_new(COLUMNS);
    bool good = row && (json ? put_json : put_text)(c, row, out);
    tn_integers_free(row, COLUMNS);
    return good ? TN_OK : tn_fail_memory(error);
}
