/* An engine that a build adds from outside: its records and code are read, verified and listed like those of any other,
 * by the rows of tests/toy/engine.def and the few lines of tests/toy/engine.c. And a question (requests.def,
 * question.c): it is asked by its name, with a request and an answer in JSON. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ask/session/questions.h"
#include "ask/session/requests.h"
#include "runtime/base/bytes.h"
#include "runtime/genome/settings.h"
#include "runtime/load.h"
#include "runtime/module/builder.h"
#include "runtime/module/layout.h"

static tn_status load(uint32_t start, uint32_t step, tn_opcode last, tn_module **module, tn_error *error)
{
    uint8_t *bytes;
    size_t size;
    tn_builder *builder = tn_builder_new();
    tn_builder_emit(builder, TN_OP_COUNT_UP, step, 0);
    tn_builder_emit(builder, last, 0, 0);
    tn_builder_add_COUNTER(builder, &(tn_counter_record){.name = tn_builder_string(builder, "sheep"),
                                                         .start = start,
                                                         .code_end = tn_builder_offset(builder)});
    assert_int_equal(tn_builder_finish(builder, &bytes, &size, error), TN_OK);
    tn_status status = tn_module_load(bytes, size, NULL, module, error);
    tn_builder_free(builder);
    free(bytes);
    return status;
}

/* Numbers below the rows' that no row has: of an instruction, a kind of functions, a setting. */
enum { NO_OPCODE = TN_OP_STOP - 1, NO_FUNCTION = TN_FUNCTION_COUNTER - 1, NO_SETTING = TN_SET_COUNTING - 1 };

static void refuse(uint32_t start, uint32_t step, tn_opcode last, const char *reason)
{
    tn_module *module;
    tn_error error = {0};
    assert_int_equal(load(start, step, last, &module, &error), TN_INVALID);
    if (!strstr(error.message, reason))
        fail_msg("wanted \"%s\", got \"%s\"", reason, error.message);
}

static void test_it_is_listed(void **state)
{
    (void)state;
    tn_module *module;
    tn_error error = {0};
    char *text;
    size_t size;
    if (load(3, 7, TN_OP_STOP, &module, &error) != TN_OK)
        fail_msg("%s", error.message);
    FILE *out = open_memstream(&text, &size);
    assert_true(tn_module_disassemble(module, out));
    fclose(out);
    assert_string_equal(strchr(text, '\n'), "\n"
                                            "  counter 0  name \"sheep\", start 3, code_begin 0, code_end 6\n"
                                            "       0  COUNT_UP    7\n"
                                            "       5  STOP\n");
    free(text);
    tn_module_free(module);
}

static void test_it_is_verified(void **state)
{
    (void)state;
    refuse(10, 7, TN_OP_STOP, "counter 0: start is 10; 0 to 9 are possible");
    refuse(3, 0, TN_OP_STOP, "counter 0, code offset 0: a step of nothing");
    refuse(3, 7, TN_OP_DONE, "counter 0, code offset 5: DONE does not belong in this kind of code");
    refuse(3, 7, TN_OP_COUNT_UP, "counter 0, code offset 5: ");
}

/* Puts another opcode in place of the one STOP: a builder writes none that there is not. */
static void change_stop(uint8_t *bytes, size_t size, uint8_t opcode)
{
    const uint8_t code[] = {TN_OP_COUNT_UP, 7, 0, 0, 0, TN_OP_STOP};
    uint8_t *found = memmem(bytes, size, code, sizeof code);
    assert_non_null(found);
    found[sizeof code - 1] = opcode;
    tn_put_u64(bytes + TN_HEADER_HASH, tn_module_hash_bytes(bytes, size));
}

/* Builds what was begun, with that opcode for STOP, and looks for the reason why it does not load. */
static void refuse_built(tn_builder *builder, tn_opcode stop, const char *reason)
{
    uint8_t *bytes;
    size_t size;
    tn_module *module;
    tn_error error = {0};
    tn_builder_emit(builder, TN_OP_COUNT_UP, 7, 0);
    tn_builder_emit(builder, TN_OP_STOP, 0, 0);
    tn_builder_add_COUNTER(builder, &(tn_counter_record){.name = tn_builder_string(builder, "sheep"),
                                                         .code_end = tn_builder_offset(builder)});
    assert_int_equal(tn_builder_finish(builder, &bytes, &size, &error), TN_OK);
    change_stop(bytes, size, (uint8_t)stop);
    assert_int_equal(tn_module_load(bytes, size, NULL, &module, &error), TN_INVALID);
    if (!strstr(error.message, reason))
        fail_msg("wanted \"%s\", got \"%s\"", reason, error.message);
    tn_builder_free(builder);
    free(bytes);
}

static void test_numbers_without_a_row_are_refused(void **state)
{
    (void)state;
    refuse_built(tn_builder_new(), (tn_opcode)NO_OPCODE, "counter 0, code offset 5: 239 is no opcode");

    tn_builder *builder = tn_builder_new();
    tn_builder_add_FUNCTION(builder, &(tn_function_record){.kind = NO_FUNCTION});
    refuse_built(builder, TN_OP_STOP, "function 0: kind is 19, which nothing has for its number");

    builder = tn_builder_new();
    tn_builder_add_SOURCE(builder, &(tn_source_record){0});
    tn_builder_add_SETTING(builder, &(tn_setting_record){.setting = NO_SETTING, .written = 1});
    refuse_built(builder, TN_OP_STOP, "setting 0 is unknown");
}

static tn_status ask(const char *request, tn_buffer *answer, tn_error *error)
{
    const tn_request_kind *kind;
    tn_twice_request asked;
    tn_reply reply = {0};
    json_t *json = json_loads(request, 0, NULL);
    tn_json out = tn_json_text(answer, TN_JSON_TIGHT);
    assert_int_equal(tn_request_kind_named("twice", &kind, error), TN_OK);
    assert_ptr_equal(kind->request, &tn_message_twice_request);
    tn_message_init(kind->request, &asked);
    tn_status status = tn_message_read(kind->request, json, &asked, error);
    if (status == TN_OK)
        status = kind->ask(NULL, &asked, &reply);
    if (status == TN_OK)
        tn_message_write(reply.message, reply.value, NULL, &out);
    tn_reply_clear(&reply);
    json_decref(json);
    return status;
}

static void test_it_is_asked(void **state)
{
    (void)state;
    tn_buffer answer = {0};
    tn_error error = {0};
    assert_int_equal(ask("{\"number\": 21}", &answer, &error), TN_OK);
    assert_string_equal(answer.data, "{\"number\":42}");
    assert_int_equal(ask("{\"number\": 1001}", &answer, &error), TN_INVALID);
    assert_string_equal(error.message, "`number` is from 0 to 1000, not 1001");
    assert_int_equal(ask("{\"nunber\": 3}", &answer, &error), TN_INVALID);
    assert_string_equal(error.help, "did you mean `number`?");
    free(answer.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_it_is_listed), cmocka_unit_test(test_it_is_verified),
                                       cmocka_unit_test(test_numbers_without_a_row_are_refused),
                                       cmocka_unit_test(test_it_is_asked)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
