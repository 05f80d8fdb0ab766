/* Answers of a program that scores, of any bytes: reading ends; what is understood is numbers or a reason, and what is
 * shown of it can be shown. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/program/external.h"
#include "tests/fuzz/fuzz.h"

static void fail(const char *what)
{
    fprintf(stderr, "answer: %s\n", what);
    abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    size_t count = size ? data[0] % TN_OBJECTIVES_MAX + 1 : 1;
    const char *line = size ? (const char *)data + 1 : "";
    tn_answer answer;
    tn_answer_read(line, size ? size - 1 : 0, count, &answer);
    bool refused = answer.refusal[0] != '\0';
    if (!answer.understood && !refused)
        fail("neither understood nor refused");
    for (size_t i = 0; i < count && !refused; i++)
        if (!isfinite(answer.values[i]))
            fail("a number that is none");
    if (strlen(answer.refusal) >= sizeof answer.refusal)
        fail("a reason without an end");
    for (const char *at = answer.refusal; *at; at++)
        if ((unsigned char)*at < ' ')
            fail("a reason that upsets a terminal");
    return 0;
}
