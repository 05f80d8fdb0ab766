// RE2: the ten expressions one by one, as a set, and joined into one: bench_re2 FOLDER
#include "expressions.h"

#include <memory>

#include <re2/re2.h>
#include <re2/set.h>

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    Peer peer = peer_read(argv[1]);
    RE2::Options options;
    options.set_encoding(RE2::Options::EncodingLatin1);
    options.set_never_capture(true);
    options.set_max_mem(256 << 20);

    std::vector<std::unique_ptr<RE2>> ten;
    RE2::Set set(options, RE2::UNANCHORED);
    std::string error;
    for (const std::string &expression : expressions()) {
        ten.push_back(std::make_unique<RE2>(expression, options));
        if (!ten.back()->ok() || set.Add(expression, &error) < 0)
            peer_stop("re2", ten.back()->error() + error);
    }
    set.Compile();
    peer_run("all", "re2", peer, [&](const std::string &plan) {
        unsigned long mask = 0;
        for (size_t i = 0; i < ten.size(); i++)
            mask |= (unsigned long)RE2::PartialMatch(plan, *ten[i]) << i;
        return mask;
    });
    std::vector<int> matched;
    peer_run("all", "re2-set", peer, [&](const std::string &plan) {
        matched.clear();
        set.Match(plan, &matched);
        unsigned long mask = 0;
        for (int rule : matched)
            mask |= 1ul << rule;
        return mask;
    });
    RE2 joined(alternation(), options);
    peer_run("any", "re2", peer, [&](const std::string &plan) { return (unsigned long)RE2::PartialMatch(plan, joined); });
}
