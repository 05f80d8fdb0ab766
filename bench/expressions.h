// The ten rules of ten.plan as regular expressions over a byte a tray, and what the peers that match them have in
// common.
//
// The expressions are written by hand from the rules' meaning, within what RE2, PCRE2 and Hyperscan all understand. A
// peer is timed by peer_run, which first compares its decisions with those that bench_plan left.
#ifndef TARTAN_BENCH_EXPRESSIONS_H
#define TARTAN_BENCH_EXPRESSIONS_H

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

using Tray = std::vector<std::string>; // width, height, public, great, machine, body, bay

inline std::vector<Tray> trays;

// The class of the bytes of trays that are so.
inline std::string set(const std::function<bool(const Tray &)> &is)
{
    std::string text = "[";
    char byte[8];
    for (size_t i = 0; i < trays.size(); i++) {
        if (is(trays[i])) {
            snprintf(byte, sizeof byte, "\\x%02zx", 33 + i);
            text += byte;
        }
    }
    return text + "]";
}

inline std::vector<std::string> expressions()
{
    auto begins = [](const std::string &text, const char *with) { return text.rfind(with, 0) == 0; };
    auto wide = [](const Tray &t) { return t[0] == "12'"; };
    auto body = [&](const Tray &t) { return begins(t[5], "dense"); };
    auto machine = [&](const Tray &t) { return begins(t[4], "dense"); };
    auto dense = [&](const Tray &t) { return body(t) || machine(t); };
    std::string w4 = set([](const Tray &t) { return t[0] == "4'"; }),
                not_w4 = set([](const Tray &t) { return t[0] != "4'"; });
    std::string body_dense = set(body), empty = set([&](const Tray &t) { return !machine(t); });
    std::string no_totem = set([&](const Tray &t) { return !(wide(t) && body(t)); });
    std::string main_empty = set([&](const Tray &t) { return wide(t) && !machine(t) && !body(t); });
    std::string d = set(dense), sparse = set([&](const Tray &t) { return !dense(t); });
    std::string open12 = set([&](const Tray &t) { return wide(t) && !dense(t); });
    std::string low = set([&](const Tray &t) { return !dense(t) && t[1] == "single"; });
    std::string great = set([](const Tray &t) { return t[3] == "great"; });
    std::string pub = set([](const Tray &t) { return t[2] == "public"; }),
                private_ = set([](const Tray &t) { return t[2] != "public"; });
    std::string hall = set([](const Tray &t) { return t[3] == "great" && t[2] != "public"; });
    std::string main_machine = set([&](const Tray &t) { return wide(t) && machine(t); });
    std::string any = set([](const Tray &) { return true; });
    std::string two = sparse + "*" + open12 + sparse + "*" + open12 + sparse + "*";
    return {
        w4 + w4,
        "^" + body_dense + "|" + body_dense + "$",
        "^" + no_totem + "*" + main_empty + no_totem + "*" + main_empty + no_totem + "*$",
        "(?:^" + sparse + "*|" + d + two + ")" + low + "(?:" + sparse + "*$|" + two + d + ")",
        empty + empty + empty,
        great + body_dense + "|" + body_dense + great,
        "^" + private_ + "*$|" + pub + private_ + "*" + pub,
        any + pub + any,
        main_machine + not_w4 + "*" + main_machine,
        "(?:^" + private_ + "*|" + pub + private_ + "{3,})" + hall + "(?:" + private_ + "*$|" + private_ + "{3,}" +
            pub + ")",
    };
}

// One expression that matches where any of them does.
inline std::string alternation()
{
    std::string all;
    for (const std::string &expression : expressions())
        all += (all.empty() ? "(?:" : "|(?:") + expression + ")";
    return all;
}

struct Peer {
    std::vector<std::string> plans;
    std::vector<unsigned long> masks;
};

[[noreturn]] inline void peer_stop(const char *name, const std::string &why)
{
    fprintf(stderr, "%s: %s\n", name, why.c_str());
    exit(1);
}

// Reads what bench_plan left in the folder.
inline Peer peer_read(const std::string &folder)
{
    Peer peer;
    std::string line;
    std::ifstream spellings(folder + "/trays.txt"), bytes(folder + "/plans.bin", std::ios::binary),
        masks(folder + "/mask.txt");
    while (std::getline(spellings, line)) {
        std::istringstream words(line);
        trays.emplace_back(std::istream_iterator<std::string>(words), std::istream_iterator<std::string>());
    }
    while (std::getline(bytes, line))
        peer.plans.push_back(line);
    for (unsigned long mask; masks >> mask;)
        peer.masks.push_back(mask);
    return peer;
}

// Of this thread's own, as bench_plan counts them.
inline double seconds()
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return now.tv_sec + now.tv_nsec * 1e-9;
}

// Compares decide(plan) with our decisions (all: the bits of the rules; any: 0 or 1), then prints the median seconds a
// plan of 7 runs.
template <typename Decide> void peer_run(const char *work, const char *name, const Peer &peer, Decide decide)
{
    bool any = std::string(work) == "any";
    for (size_t i = 0; i < peer.plans.size(); i++)
        if (decide(peer.plans[i]) != (any ? peer.masks[i] != 0 : peer.masks[i]))
            peer_stop(name, "plan " + std::to_string(i) + " is decided differently");
    std::vector<double> times;
    unsigned long sum = 0;
    for (int run = 0; run < 7; run++) {
        double start = seconds();
        for (const std::string &plan : peer.plans)
            sum += decide(plan);
        times.push_back(seconds() - start);
    }
    if (sum == 1) // so that no decision can be left out
        fputs("\n", stderr);
    std::sort(times.begin(), times.end());
    printf("%s %s %.12f\n", work, name, times[times.size() / 2] / peer.plans.size());
}

#endif
