/* For tests of memory that runs out while a question is answered: include it after cmocka.h. */
#ifndef TARTAN_TESTS_ANSWER_OR_MEMORY_H
#define TARTAN_TESTS_ANSWER_OR_MEMORY_H

#include "ask/session/questions.h"
#include "driver/open/open.h"
#include "tests/support/same_or_memory.h"

typedef tn_status test_question(tn_session *session, const void *request, tn_reply *answer);

typedef struct test_asked {
    tn_opened opened;
    test_question *question;
    const void *request;
} test_asked;

static inline tn_status answer_in_json(void *context, tn_buffer *out, tn_error *error)
{
    test_asked *asked = context;
    tn_session session = {.opened = &asked->opened};
    tn_compilation *compilation = &asked->opened.compilation;
    const tn_diagnostics kept = compilation->diagnostics;
    tn_reply answer;
    tn_diagnostics_init(&compilation->diagnostics, &compilation->sources);
    tn_status status = asked->question(&session, asked->request, &answer);
    if (status == TN_OK) {
        tn_json json = tn_json_text(out, TN_JSON_TIGHT);
        tn_message_write(answer.message, answer.value, NULL, &json);
    }
    if (status == TN_MEMORY || out->failed)
        status = tn_fail_memory(error);
    tn_reply_clear(&answer);
    tn_session_forget(&session);
    tn_diagnostics_clear(&compilation->diagnostics);
    compilation->diagnostics = kept;
    return status;
}

/* Asks a file of this text with allocations that fail. step: as in same_or_memory. */
static inline void answer_or_memory(const char *path, const char *text, test_question *question, const void *request,
                                    size_t step)
{
    test_asked asked = {.question = question, .request = request};
    assert_int_equal(tn_open_bytes(path, (const uint8_t *)text, strlen(text), false, &asked.opened), TN_OK);
    same_or_memory(answer_in_json, &asked, step);
    tn_close(&asked.opened);
}

#endif
