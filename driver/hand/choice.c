/* Reads and writes the parents that a person names. */
#include "driver/hand/choice.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/buffer.h"

void tn_choices_clear(tn_choices *choices)
{
    free(choices->items);
    *choices = (tn_choices){0};
}

static bool read_number(const char **at, uint64_t *number)
{
    char *end;
    if (**at < '0' || **at > '9')
        return false;
    *number = strtoull(*at, &end, 10);
    *at = end;
    return true;
}

/* A weight is above 0 and at most 1. */
static bool read_weight(const char **at, double *weight)
{
    char *end;
    if (!strchr("0123456789.", **at))
        return false;
    *weight = strtod(*at, &end);
    *at = end;
    return *weight > 0 && *weight <= 1;
}

/* One word, up to `end`. */
static bool read_word(const char *at, const char *end, tn_chosen *chosen, uint64_t *times)
{
    *chosen = (tn_chosen){.weight = 1};
    *times = 1;
    chosen->by_id = *at == '#';
    at += chosen->by_id;
    if (!read_number(&at, &chosen->number) || (!chosen->by_id && chosen->number-- == 0))
        return false;
    while (at < end) {
        char sign = *at++;
        bool read = sign == '*' ? read_number(&at, times) : sign == '@' ? read_weight(&at, &chosen->weight) : false;
        if (!read)
            return false;
    }
    return at == end && *times >= 1 && *times <= TN_CHOICE_TURNS_MAX;
}

tn_status tn_choices_read(const char *line, tn_choices *choices, char wrong[40], tn_error *error)
{
    static const char between[] = " ,\t\r\n";
    choices->count = 0;
    for (const char *at = line + strspn(line, between); *at; at += strspn(at, between)) {
        size_t size = strcspn(at, between);
        tn_chosen chosen;
        uint64_t times;
        if (!read_word(at, at + size, &chosen, &times)) {
            snprintf(wrong, 40, "%.*s", (int)(size < 39 ? size : 39), at);
            return tn_fail(error, TN_INVALID, E_NO_INDIVIDUAL, "`%s` names no parent", wrong);
        }
        if (!tn_array_reserve(&choices->items, &choices->capacity, choices->count, (size_t)times,
                              sizeof *choices->items))
            return tn_fail_memory(error);
        for (uint64_t i = 0; i < times; i++)
            choices->items[choices->count++] = chosen;
        at += size;
    }
    return TN_OK;
}

char *tn_choices_text(const tn_chosen *items, size_t count)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        char weight[TN_NUMBER_TEXT_SIZE];
        fprintf(out, "%s%s%" PRIu64, i ? " " : "", items[i].by_id ? "#" : "", items[i].number + !items[i].by_id);
        if (items[i].weight != 1)
            fprintf(out, "@%s", tn_number_text(items[i].weight, weight));
    }
    bool written = !ferror(out);
    if (fclose(out) == 0 && written)
        return text;
    free(text);
    return NULL;
}

bool tn_choices_have_ids(const char *text)
{
    return strchr(text, '#') != NULL;
}
