/* Reads the answers of a program that scores. */
#include "driver/program/answer.h"

#include <jansson.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "runtime/base/utf8.h"

#define SHOWN 60u /* bytes of an answer that are shown */

void tn_clean_copy(char *to, size_t room, const char *text, size_t size)
{
    size_t shown = size < SHOWN ? size : SHOWN;
    FILE *out = fmemopen(to, room, "w");
    to[0] = '\0';
    if (!out)
        return; /* then nothing is shown */
    while (shown < size && shown > 0 && ((unsigned char)text[shown] & 0xC0) == 0x80)
        shown--; /* no part of a letter */
    tn_write_clean(out, text, shown);
    fputs(shown < size ? "..." : "", out);
    fclose(out);
    to[room - 1] = '\0';
}

static void refuse(tn_answer *answer, const char *line, size_t size, const char *why)
{
    char shown[TN_REFUSAL_SIZE - 80];
    tn_clean_copy(shown, sizeof shown, line, size);
    if (shown[0])
        snprintf(answer->refusal, sizeof answer->refusal, "answered `%s`, %s", shown, why);
    else
        snprintf(answer->refusal, sizeof answer->refusal, "answered with an empty line, %s", why);
}

/* False where it is neither a number nor a list of `count` of them. */
static bool take_values(const json_t *score, size_t count, double *values)
{
    if (json_is_number(score) && count == 1) {
        values[0] = json_number_value(score);
        return true;
    }
    if (!json_is_array(score) || json_array_size(score) != count)
        return false;
    for (size_t i = 0; i < count; i++) {
        const json_t *value = json_array_get(score, i);
        if (!json_is_number(value))
            return false;
        values[i] = json_number_value(value);
    }
    return true;
}

static void take_id(const json_t *json, tn_answer *answer)
{
    const json_t *id = json_object_get(json, "id");
    answer->says_id = json_is_integer(id) && json_integer_value(id) >= 0;
    if (answer->says_id)
        answer->id = (uint64_t)json_integer_value(id);
}

static void say_wanted(tn_answer *answer, const char *line, size_t size, size_t count)
{
    char why[80];
    if (count == 1)
        snprintf(why, sizeof why, "and one number is wanted");
    else
        snprintf(why, sizeof why, "and a list of %zu numbers is wanted", count);
    refuse(answer, line, size, why);
}

void tn_answer_read(const char *line, size_t size, size_t count, tn_answer *answer)
{
    json_t *json = json_loadb(line, size, JSON_DECODE_ANY | JSON_REJECT_DUPLICATES, NULL);
    *answer = (tn_answer){0};
    take_id(json, answer);
    const json_t *score = json_is_object(json) ? json_object_get(json, "score") : json;
    const char *said = json_string_value(json_object_get(json, "error"));
    bool valued = json && !said && take_values(score, count, answer->values);
    answer->understood = said || valued;
    if (!json) {
        refuse(answer, line, size, "which is not JSON");
    } else if (said) {
        char shown[TN_REFUSAL_SIZE - 40];
        tn_clean_copy(shown, sizeof shown, said, strlen(said));
        snprintf(answer->refusal, sizeof answer->refusal, "says: %s", shown);
    } else if (!valued) {
        say_wanted(answer, line, size, count);
    }
    json_decref(json);
}
