/* Holds lines of houses against each other, part by part. */
#include "ask/house/diverse.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/house.h"
#include "runtime/house/line.h"

/* ---- the best */

void tn_lines_taken_clear(tn_lines_taken *taken)
{
    for (size_t i = 0; i < taken->count; i++)
        free(taken->items[i]);
    free(taken->items);
    *taken = (tn_lines_taken){0};
}

/* How much of a line says what houses that are so alike have in common. */
static size_t common_part(const char *line, tn_house_alike alike)
{
    const char *at = line;
    for (int part = 0; part <= (int)alike && at; part++) {
        const char *end = strchr(at, ';');
        at = end ? end + 1 : NULL;
    }
    return at ? (size_t)(at - line) : strlen(line);
}

tn_status tn_lines_take(tn_lines_taken *taken, const tn_house *house, tn_house_alike alike, bool *differs,
                        tn_error *error)
{
    tn_buffer line = {0};
    tn_status status = tn_house_write(house, &line, error);
    size_t size = status == TN_OK ? common_part(line.data, alike) : 0;
    *differs = status == TN_OK;
    for (size_t i = 0; *differs && i < taken->count; i++)
        *differs = common_part(taken->items[i], alike) != size || memcmp(taken->items[i], line.data, size) != 0;
    if (*differs && !tn_array_reserve(&taken->items, &taken->room, taken->count, 1, sizeof *taken->items))
        status = tn_fail_memory(error);
    if (status == TN_OK && *differs)
        taken->items[taken->count++] = line.data;
    else
        free(line.data);
    return status;
}

/* ---- of those that were drawn */

enum { PROGRAMME = TN_LINE_PARTS, DISTANCES };

/* In the order in which people see it: places in a distance. */
static const int seen[DISTANCES] = {TN_LINE_PLAN,      TN_LINE_SECTION, PROGRAMME,
                                    TN_LINE_FUNCTIONS, TN_LINE_FACES,   TN_LINE_TILES};

typedef struct distance {
    size_t by[DISTANCES];
} distance;

static int compare(const distance *a, const distance *b)
{
    for (int i = 0; i < DISTANCES; i++)
        if (a->by[i] != b->by[i])
            return a->by[i] < b->by[i] ? -1 : 1;
    return 0;
}

typedef struct word {
    const char *text;
    size_t size;
} word;

/* A line as its words; bars are none. */
typedef struct worded {
    word *words;                     /* of all parts; owned */
    size_t first[TN_LINE_PARTS + 1]; /* of each part */
    word *functions;                 /* those of that part, sorted; owned */
} worded;

static int compare_words(const void *a, const void *b)
{
    const word *p = a, *q = b;
    size_t size = p->size < q->size ? p->size : q->size;
    int by = memcmp(p->text, q->text, size);
    return by != 0 ? by : (p->size > q->size) - (p->size < q->size);
}

static void take_words(const char *line, worded *w)
{
    size_t count = 0;
    int part = 0;
    for (const char *c = line; *c;) {
        size_t size = strcspn(c, " ;|");
        if (*c == ';' && part + 1 < TN_LINE_PARTS)
            w->first[++part] = count;
        if (size > 0)
            w->words[count++] = (word){c, size};
        c += size > 0 ? size : 1;
    }
    while (part < TN_LINE_PARTS)
        w->first[++part] = count;
}

static tn_status split(const char *line, worded *w, tn_error *error)
{
    size_t most = strlen(line) / 2 + 2;
    w->words = malloc(most * sizeof *w->words);
    w->functions = malloc(most * sizeof *w->functions);
    if (!w->words || !w->functions)
        return tn_fail_memory(error);
    take_words(line, w);
    size_t first = w->first[TN_LINE_FUNCTIONS], count = w->first[TN_LINE_FUNCTIONS + 1] - first;
    if (count > 0) {
        memcpy(w->functions, w->words + first, count * sizeof *w->functions);
        qsort(w->functions, count, sizeof *w->functions, compare_words);
    }
    return TN_OK;
}

static size_t part_size(const worded *w, int part)
{
    return w->first[part + 1] - w->first[part];
}

static size_t differing(const worded *a, const worded *b, int part)
{
    size_t p = part_size(a, part), q = part_size(b, part), both = p < q ? p : q, count = (p > q ? p : q) - both;
    for (size_t i = 0; i < both; i++)
        count += compare_words(&a->words[a->first[part] + i], &b->words[b->first[part] + i]) != 0;
    return count;
}

/* How many functions only one of the two has, each as often as it has it. */
static size_t unlike_functions(const worded *a, const worded *b)
{
    size_t p = part_size(a, TN_LINE_FUNCTIONS), q = part_size(b, TN_LINE_FUNCTIONS), i = 0, k = 0, both = 0;
    while (i < p && k < q) {
        int by = compare_words(&a->functions[i], &b->functions[k]);
        both += by == 0;
        i += by <= 0;
        k += by >= 0;
    }
    return p + q - 2 * both;
}

static distance between(const worded *a, const worded *b)
{
    distance d;
    for (int i = 0; i < DISTANCES; i++)
        d.by[i] = seen[i] == PROGRAMME ? unlike_functions(a, b) : differing(a, b, seen[i]);
    return d;
}

/* least: of each line, its distance from the nearest that was chosen. */
static void choose(const worded *words, size_t count, size_t first, size_t wanted, distance *least, bool *chosen)
{
    memset(least, 0xff, count * sizeof *least);
    for (size_t taken = first, number = 0; number < wanted; number++) {
        size_t next = count;
        chosen[taken] = true;
        for (size_t i = 0; i < count; i++) {
            distance d = between(&words[i], &words[taken]);
            if (compare(&d, &least[i]) < 0)
                least[i] = d;
            if (!chosen[i] && (next == count || compare(&least[i], &least[next]) > 0))
                next = i;
        }
        if (next == count)
            return;
        taken = next;
    }
}

tn_status tn_lines_choose(const char *const *lines, size_t count, size_t first, size_t wanted, bool *chosen,
                          tn_error *error)
{
    worded *words = calloc(count + 1, sizeof *words);
    distance *least = malloc((count + 1) * sizeof *least);
    tn_status status = words && least ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = split(lines[i], &words[i], error);
    if (status == TN_OK && count > 0)
        choose(words, count, first, wanted, least, chosen);
    for (size_t i = 0; words && i < count; i++) {
        free(words[i].words);
        free(words[i].functions);
    }
    free(words);
    free(least);
    return status;
}
