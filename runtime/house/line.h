/* House lines that leave values out: `_` stands for any value, a part that is `-` or missing for any values.
 *
 * A house has what is typed if its own line has the same words where the line has words. A tn_house_line borrows the
 * form and the text, and owns the rest; clear it with tn_house_line_clear.
 */
#ifndef TARTAN_HOUSE_LINE_H
#define TARTAN_HOUSE_LINE_H

#include <string.h>

#include "runtime/house/house_names.h"
#include "runtime/plan/text/text.h"

#define TN_LEFT_OUT "_"

enum { TN_LINE_PLAN, TN_LINE_SECTION, TN_LINE_FUNCTIONS, TN_LINE_FACES, TN_LINE_TILES, TN_LINE_PARTS };

/* number: how many values that are typed stand before it in the line. */
typedef struct tn_line_value {
    const char *text;
    size_t size, column; /* column: from 1, in the line */
    bool left_out;
    size_t number;
} tn_line_value;

typedef struct tn_line_part {
    tn_line_value *values;
    size_t count; /* 0: the part is left out */
} tn_line_part;

typedef struct tn_house_line {
    const tn_house_form *form;
    const char *text, *given; /* given: the JSON object that the line is from, or the line itself */
    size_t size, given_size, begin;
    tn_buffer own;
    tn_plan plan;
    tn_line_part parts[TN_LINE_PARTS]; /* but for the plan */
    size_t typed;                      /* values that are */
} tn_house_line;

/* Is told a mistake, and may change it. */
typedef tn_status tn_line_error(void *context, tn_error *error);

/* Reads a line, or a JSON object with one, and says all that is wrong with its words, each where it stands; words that
 * depend on what is left out are only held to what the form has at all. *wrong: there was a mistake, so that the line
 * is not to be used. Clear *line in any case. */
tn_status tn_house_line_read(const tn_house_form *form, const char *text, size_t size, size_t max_trays,
                             tn_line_error *said, void *context, tn_house_line *line, bool *wrong, tn_error *error);
void tn_house_line_clear(tn_house_line *line);

/* "functions" */
const char *tn_house_line_part(int part);

/* Places an error at columns of the line. */
void tn_house_line_place(const tn_house_line *line, size_t column, size_t column_end, tn_error *error);

/* What is asked of houses: the first `count` typed values; in place of the last of these `other`, unless it is NULL. */
typedef struct tn_line_asked {
    const tn_house_line *line;
    size_t count;
    const char *other;
} tn_line_asked;

/* Is value `at` of the part as is asked? */
static inline bool tn_line_allows(const tn_line_asked *asked, int part, size_t at, const char *text)
{
    const tn_line_part *p = &asked->line->parts[part];
    if (at >= p->count || p->values[at].left_out || p->values[at].number >= asked->count)
        return true;
    if (asked->other && p->values[at].number + 1 == asked->count)
        return strcmp(text, asked->other) == 0;
    return strlen(text) == p->values[at].size && memcmp(text, p->values[at].text, p->values[at].size) == 0;
}

/* Does the part have so many values, if something of it is asked? */
static inline bool tn_line_has_count(const tn_line_asked *asked, int part, size_t count)
{
    const tn_line_part *p = &asked->line->parts[part];
    for (size_t i = 0; i < p->count; i++)
        if (!p->values[i].left_out && p->values[i].number < asked->count)
            return count == p->count;
    return true;
}

#endif
