// PCRE2 with its just-in-time compiler: the ten expressions one by one, and joined into one: bench_pcre2 FOLDER
#define PCRE2_CODE_UNIT_WIDTH 8
#include "expressions.h"

#include <pcre2.h>

static pcre2_code *compile(const std::string &expression)
{
    int code;
    size_t at;
    pcre2_code *compiled = pcre2_compile((PCRE2_SPTR)expression.data(), expression.size(), PCRE2_DOLLAR_ENDONLY, &code, &at, nullptr);
    if (!compiled || pcre2_jit_compile(compiled, PCRE2_JIT_COMPLETE) != 0)
        peer_stop("pcre2", "cannot compile " + expression);
    return compiled;
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    Peer peer = peer_read(argv[1]);
    std::vector<pcre2_code *> ten;
    for (const std::string &expression : expressions())
        ten.push_back(compile(expression));
    pcre2_code *joined = compile(alternation());
    pcre2_match_data *data = pcre2_match_data_create(1, nullptr);
    auto matches = [&](pcre2_code *code, const std::string &plan) {
        int found = pcre2_jit_match(code, (PCRE2_SPTR)plan.data(), plan.size(), 0, 0, data, nullptr);
        if (found < PCRE2_ERROR_NOMATCH)
            peer_stop("pcre2", "matching failed");
        return found >= 0;
    };
    peer_run("all", "pcre2", peer, [&](const std::string &plan) {
        unsigned long mask = 0;
        for (size_t i = 0; i < ten.size(); i++)
            mask |= (unsigned long)matches(ten[i], plan) << i;
        return mask;
    });
    peer_run("any", "pcre2", peer, [&](const std::string &plan) { return (unsigned long)matches(joined, plan); });
    for (pcre2_code *code : ten)
        pcre2_code_free(code);
    pcre2_code_free(joined);
    pcre2_match_data_free(data);
}
