// The ten rules as regular expressions over a byte a tray, timed with RE2: bench_re2 FOLDER (what bench_plan left there)
//
// The expressions are written by hand from the rules' meaning. Their decisions are compared with ours.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <re2/re2.h>
#include <re2/set.h>

using Tray = std::vector<std::string>; // width, height, public, great, machine, body, bay

static std::vector<Tray> trays;

// The class of the bytes of trays that are so.
static std::string set(const std::function<bool(const Tray &)> &is)
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

static std::vector<std::string> expressions()
{
    auto begins = [](const std::string &text, const char *with) { return text.rfind(with, 0) == 0; };
    auto wide = [](const Tray &t) { return t[0] == "12'"; };
    auto body = [&](const Tray &t) { return begins(t[5], "dense"); };
    auto machine = [&](const Tray &t) { return begins(t[4], "dense"); };
    auto dense = [&](const Tray &t) { return body(t) || machine(t); };
    std::string w4 = set([](const Tray &t) { return t[0] == "4'"; }), not_w4 = set([](const Tray &t) { return t[0] != "4'"; });
    std::string body_dense = set(body), empty = set([&](const Tray &t) { return !machine(t); });
    std::string no_totem = set([&](const Tray &t) { return !(wide(t) && body(t)); });
    std::string main_empty = set([&](const Tray &t) { return wide(t) && !machine(t) && !body(t); });
    std::string d = set(dense), sparse = set([&](const Tray &t) { return !dense(t); });
    std::string open12 = set([&](const Tray &t) { return wide(t) && !dense(t); });
    std::string low = set([&](const Tray &t) { return !dense(t) && t[1] == "single"; });
    std::string great = set([](const Tray &t) { return t[3] == "great"; });
    std::string pub = set([](const Tray &t) { return t[2] == "public"; }), private_ = set([](const Tray &t) { return t[2] != "public"; });
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
        "(?:^" + private_ + "*|" + pub + private_ + "{3,})" + hall + "(?:" + private_ + "*$|" + private_ + "{3,}" + pub + ")",
    };
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    std::string folder = argv[1], line;
    std::ifstream spellings(folder + "/trays.txt"), bytes(folder + "/plans.bin", std::ios::binary), masks(folder + "/mask.txt");
    while (std::getline(spellings, line)) {
        std::istringstream words(line);
        trays.emplace_back(std::istream_iterator<std::string>(words), std::istream_iterator<std::string>());
    }
    std::vector<std::string> plans;
    std::vector<unsigned long> expected;
    while (std::getline(bytes, line))
        plans.push_back(line);
    for (unsigned long mask; masks >> mask;)
        expected.push_back(mask);

    RE2::Options options;
    options.set_encoding(RE2::Options::EncodingLatin1);
    options.set_never_capture(true);
    options.set_max_mem(256 << 20);
    RE2::Set rules(options, RE2::UNANCHORED);
    std::string error;
    for (const std::string &expression : expressions()) {
        if (rules.Add(expression, &error) < 0) {
            fprintf(stderr, "bench_re2: %s\n", error.c_str());
            return 1;
        }
    }
    rules.Compile();

    std::vector<unsigned long> got(plans.size());
    std::vector<double> times;
    for (int run = 0; run < 7; run++) {
        auto start = std::chrono::steady_clock::now();
        std::vector<int> matched;
        for (size_t i = 0; i < plans.size(); i++) {
            matched.clear();
            rules.Match(plans[i], &matched);
            unsigned long mask = 0;
            for (int rule : matched)
                mask |= 1ul << rule;
            got[i] = mask;
        }
        times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    if (got != expected) {
        fprintf(stderr, "bench_re2: the expressions decide differently\n");
        return 1;
    }
    std::sort(times.begin(), times.end());
    printf("re2 %.9f %zu\n", times[times.size() / 2] / plans.size(), plans.size());
}
