/* Compares two texts line by line and prints what differs. */
#include "cli/common/line_diff.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum {
    CONTEXT = 3,
    TABLE_MAX = 1 << 24, /* cells of the table of common lines; past it the stretch is shown as replaced whole */
};

typedef struct line {
    const char *text;
    size_t size; /* without its line end */
} line;

typedef struct line_list {
    line *items;
    size_t count;
    bool open; /* the last has no line end */
} line_list;

/* One line of the result: ' ', '-' or '+'. */
typedef struct change {
    char sign;
    line line;
    bool open;
} change;

static bool split(const char *text, line_list *lines)
{
    size_t count = 1;
    for (const char *at = text; *at; at++)
        count += *at == '\n';
    *lines = (line_list){.items = calloc(count, sizeof *lines->items)};
    if (!lines->items)
        return false;
    while (*text) {
        size_t size = strcspn(text, "\n");
        lines->items[lines->count++] = (line){text, size};
        lines->open = text[size] == '\0';
        text += size + !lines->open;
    }
    return true;
}

static bool same(const line_list *a, size_t i, const line_list *b, size_t k)
{
    bool open_a = a->open && i + 1 == a->count, open_b = b->open && k + 1 == b->count;
    return a->items[i].size == b->items[k].size && open_a == open_b &&
           memcmp(a->items[i].text, b->items[k].text, a->items[i].size) == 0;
}

static void add(change *changes, size_t *count, char sign, const line_list *from, size_t i)
{
    changes[(*count)++] = (change){sign, from->items[i], from->open && i + 1 == from->count};
}

/* Lengths of the longest common subsequences of the rests from (i, k) on; NULL where that would be too large. */
static uint32_t *common_table(const line_list *a, const line_list *b, size_t first, size_t a_end, size_t b_end)
{
    size_t rows = a_end - first + 1, columns = b_end - first + 1;
    if (rows > TABLE_MAX / columns)
        return NULL;
    uint32_t *table = calloc(rows * columns, sizeof *table);
    for (size_t i = rows - 1; table && i-- > 0;)
        for (size_t k = columns - 1; k-- > 0;) {
            uint32_t below = table[(i + 1) * columns + k], right = table[i * columns + k + 1];
            table[i * columns + k] = same(a, first + i, b, first + k) ? table[(i + 1) * columns + k + 1] + 1
                                     : below > right                  ? below
                                                                      : right;
        }
    return table;
}

static size_t compare(const line_list *a, const line_list *b, change *changes)
{
    size_t first = 0, a_end = a->count, b_end = b->count, count = 0;
    while (first < a_end && first < b_end && same(a, first, b, first))
        add(changes, &count, ' ', a, first++);
    while (a_end > first && b_end > first && same(a, a_end - 1, b, b_end - 1)) {
        a_end--;
        b_end--;
    }
    uint32_t *table = common_table(a, b, first, a_end, b_end);
    size_t i = first, k = first, columns = b_end - first + 1;
    while (i < a_end || k < b_end) {
        const uint32_t *cell = table ? &table[(i - first) * columns + (k - first)] : NULL;
        if (cell && i < a_end && k < b_end && same(a, i, b, k)) {
            add(changes, &count, ' ', a, i++);
            k++;
        } else if (i < a_end && (!cell || k == b_end || cell[columns] >= cell[1])) {
            add(changes, &count, '-', a, i++);
        } else {
            add(changes, &count, '+', b, k++);
        }
    }
    free(table);
    while (a_end < a->count)
        add(changes, &count, ' ', a, a_end++);
    return count;
}

/* The end of the hunk whose first change is at `i`: after the context of its last change. */
static size_t hunk_end(const change *changes, size_t count, size_t i)
{
    size_t last = i;
    for (size_t k = i; k < count && k <= last + 2 * CONTEXT + 1; k++)
        if (changes[k].sign != ' ')
            last = k;
    return last + CONTEXT + 1 < count ? last + CONTEXT + 1 : count;
}

static void write_hunk(const change *changes, size_t begin, size_t end, size_t old_line, size_t new_line, FILE *out)
{
    size_t old_count = 0, new_count = 0;
    for (size_t i = begin; i < end; i++) {
        old_count += changes[i].sign != '+';
        new_count += changes[i].sign != '-';
    }
    fprintf(out, "@@ -%zu,%zu +%zu,%zu @@\n", old_line + (old_count > 0), old_count, new_line + (new_count > 0),
            new_count);
    for (size_t i = begin; i < end; i++) {
        fprintf(out, "%c%.*s\n", changes[i].sign, (int)changes[i].line.size, changes[i].line.text);
        if (changes[i].open)
            fputs("\\ No newline at end of file\n", out);
    }
}

static void write_changes(const char *path, const char *how, const change *changes, size_t count, FILE *out)
{
    size_t old_line = 0, new_line = 0, done = 0;
    bool headed = false;
    for (size_t i = 0; i < count; i++) {
        if (changes[i].sign == ' ')
            continue;
        if (!headed)
            fprintf(out, "--- %s\n+++ %s (%s)\n", path, path, how);
        headed = true;
        size_t begin = i - done > CONTEXT ? i - CONTEXT : done, end = hunk_end(changes, count, i);
        for (; done < begin; done++) { /* all of these are unchanged */
            old_line++;
            new_line++;
        }
        write_hunk(changes, begin, end, old_line, new_line, out);
        for (; done < end; done++) {
            old_line += changes[done].sign != '+';
            new_line += changes[done].sign != '-';
        }
        i = end - 1;
    }
}

bool tn_line_diff(const char *path, const char *how, const char *old_text, const char *new_text, FILE *out)
{
    line_list a = {0}, b = {0};
    change *changes = NULL;
    bool done = split(old_text, &a) && split(new_text, &b);
    if (done)
        changes = calloc(a.count + b.count + 1, sizeof *changes);
    done = done && changes;
    if (done)
        write_changes(path, how, changes, compare(&a, &b, changes), out);
    free(a.items);
    free(b.items);
    free(changes);
    return done;
}
