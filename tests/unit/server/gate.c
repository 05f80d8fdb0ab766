/* Who is let in. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "studio/server/gate.h"

static tn_gate open_gate(unsigned port)
{
    tn_gate gate;
    tn_error error;
    assert_int_equal(tn_gate_new(&gate, &error), TN_OK);
    tn_gate_serve(&gate, port);
    return gate;
}

static void makes_secrets(void **state)
{
    (void)state;
    tn_gate one = open_gate(1234), other = open_gate(1234);
    assert_int_equal(strlen(one.token), TN_SECRET_DIGITS);
    assert_int_equal(strspn(one.token, "0123456789abcdef"), TN_SECRET_DIGITS);
    assert_string_not_equal(one.token, other.token);
    assert_string_not_equal(one.token, one.key);
    assert_string_not_equal(one.key, other.key);
}

static void knows_its_host(void **state)
{
    (void)state;
    tn_gate gate = open_gate(1234), web = open_gate(80);
    assert_true(tn_gate_host(&gate, "127.0.0.1:1234") && tn_gate_host(&gate, "[::1]:1234"));
    const char *others[] = {"",
                            "127.0.0.1",
                            "127.0.0.1:123",
                            "127.0.0.1:12345",
                            "localhost:1234",
                            "127.0.0.1:1234,127.0.0.1:1234",
                            "127.0.0.1.example:1234",
                            "[::1]",
                            " 127.0.0.1:1234",
                            "127.0.0.1:1234 ",
                            "::1:1234"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_false(tn_gate_host(&gate, others[i]));
    assert_true(tn_gate_host(&web, "127.0.0.1") && tn_gate_host(&web, "[::1]"));
    assert_false(tn_gate_host(&web, "127.0.0.1:80"));
    tn_gate none;
    tn_error error;
    assert_int_equal(tn_gate_new(&none, &error), TN_OK);
    assert_false(tn_gate_host(&none, "")); /* before the port is known there is no host */
}

static void knows_its_origin(void **state)
{
    (void)state;
    assert_true(tn_gate_origin("127.0.0.1:1234", "http://127.0.0.1:1234"));
    const char *others[] = {"",
                            "null",
                            "http://",
                            "https://127.0.0.1:1234",
                            "http://127.0.0.1:1234/",
                            "http://127.0.0.1:12345",
                            "http://[::1]:1234",
                            "HTTP://127.0.0.1:1234",
                            "127.0.0.1:1234"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_false(tn_gate_origin("127.0.0.1:1234", others[i]));
}

/* `@` in the list is the token. */
static bool offers(const tn_gate *gate, const char *list)
{
    char text[200] = "";
    size_t size = 0;
    for (; *list; list++)
        size += (size_t)snprintf(text + size, sizeof text - size, "%.*s", *list == '@' ? TN_SECRET_DIGITS : 1,
                                 *list == '@' ? gate->token : list);
    return tn_gate_protocols(gate, text);
}

static void wants_the_token(void **state)
{
    (void)state;
    tn_gate gate = open_gate(1234);
    assert_true(offers(&gate, "tartan.1, token.@"));
    assert_true(offers(&gate, "tartan.1,token.@"));
    assert_true(offers(&gate, "  tartan.1 \t,\ttoken.@ "));
    const char *others[] = {"",
                            ",",
                            "tartan.1",
                            "tartan.1,",
                            "tartan.1, token.",
                            "token.@",
                            "token.@, tartan.1",

                            "tartan.1, token.@, more",
                            "tartan.1, token.@0",
                            "tartan.1, token.0@",
                            "tartan.1, Token.@",
                            "tartan.1 token.@",
                            "tartan.1, , token.@",
                            "tartan.10, token.@",
                            "tartan.1, token.00000000000000000000000000000000",
                            "tartan.1, token.0123456789abcdef0123456789abcde"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_false(offers(&gate, others[i]));
    for (size_t i = 0; i < TN_SECRET_DIGITS; i++) { /* each digit counts */
        tn_gate other = gate;
        other.token[i] = gate.token[i] == '0' ? '1' : '0';
        char list[100];
        snprintf(list, sizeof list, "tartan.1, token.%s", other.token);
        assert_false(tn_gate_protocols(&gate, list));
    }
}

static void gives_the_key_once(void **state)
{
    (void)state;
    tn_gate gate = open_gate(1234);
    char path[TN_SECRET_DIGITS + 2];
    assert_false(tn_gate_key(&gate, "/") || tn_gate_key(&gate, "") || tn_gate_key(&gate, gate.key));
    snprintf(path, sizeof path, "/%s", gate.token);
    assert_false(tn_gate_key(&gate, path));
    snprintf(path, sizeof path, "/%s", gate.key);
    assert_true(tn_gate_key(&gate, path));
    assert_false(tn_gate_key(&gate, path));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(makes_secrets), cmocka_unit_test(knows_its_host),
                                       cmocka_unit_test(knows_its_origin), cmocka_unit_test(wants_the_token),
                                       cmocka_unit_test(gives_the_key_once)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
