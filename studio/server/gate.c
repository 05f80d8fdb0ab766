#include "studio/server/gate.h"

#include <stdio.h>
#include <string.h>
#include <sys/random.h>

static bool make_secret(char secret[TN_SECRET_DIGITS + 1])
{
    unsigned char bytes[TN_SECRET_DIGITS / 2];
    if (getrandom(bytes, sizeof bytes, 0) != (ssize_t)sizeof bytes)
        return false;
    for (size_t i = 0; i < sizeof bytes; i++)
        snprintf(secret + 2 * i, 3, "%02x", bytes[i]);
    return true;
}

tn_status tn_gate_new(tn_gate *gate, tn_error *error)
{
    *gate = (tn_gate){0};
    return make_secret(gate->token) && make_secret(gate->key)
               ? TN_OK
               : tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "the system has no random bytes for a secret");
}

/* Browsers leave out the port that http has anyway. */
void tn_gate_serve(tn_gate *gate, unsigned port)
{
    static const char *const names[] = {"127.0.0.1", "[::1]"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        snprintf(gate->hosts[i], sizeof gate->hosts[i], port == 80 ? "%s" : "%s:%u", names[i], port);
}

bool tn_gate_host(const tn_gate *gate, const char *host)
{
    return host[0] && (strcmp(host, gate->hosts[0]) == 0 || strcmp(host, gate->hosts[1]) == 0);
}

bool tn_gate_origin(const char *host, const char *origin)
{
    static const char scheme[] = "http://";
    return strncmp(origin, scheme, strlen(scheme)) == 0 && strcmp(origin + strlen(scheme), host) == 0;
}

/* How long that takes says nothing about the secret. */
static bool same_secret(const char *secret, const char *said)
{
    volatile unsigned char differ = 0;
    for (size_t i = 0; i < TN_SECRET_DIGITS; i++)
        differ |= (unsigned char)(secret[i] ^ said[i]);
    return differ == 0;
}

/* The next of the words between commas, without the blanks around it; false at the end. */
static bool next_word(const char **list, const char **word, size_t *length)
{
    if (!**list)
        return false;
    *word = *list + strspn(*list, " \t");
    size_t all = strcspn(*word, ",");
    *list = *word + all + ((*word)[all] == ',');
    while (all > 0 && ((*word)[all - 1] == ' ' || (*word)[all - 1] == '\t'))
        all--;
    *length = all;
    return true;
}

bool tn_gate_protocols(const tn_gate *gate, const char *list)
{
    static const char before[] = "token.";
    const char *word;
    size_t length;
    if (!next_word(&list, &word, &length) || length != strlen(TN_SUBPROTOCOL) ||
        memcmp(word, TN_SUBPROTOCOL, length) != 0)
        return false;
    if (!next_word(&list, &word, &length) || length != strlen(before) + TN_SECRET_DIGITS ||
        memcmp(word, before, strlen(before)) != 0)
        return false;
    return same_secret(gate->token, word + strlen(before)) && !*list;
}

bool tn_gate_key(tn_gate *gate, const char *path)
{
    if (!gate->key[0] || strlen(path) != 1 + TN_SECRET_DIGITS || path[0] != '/' || !same_secret(gate->key, path + 1))
        return false;
    gate->key[0] = '\0';
    return true;
}
