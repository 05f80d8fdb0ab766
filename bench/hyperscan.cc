// Hyperscan: the ten expressions as one database, each reported once a plan, or the first only: bench_hyperscan FOLDER
#include "expressions.h"

#include <hs/hs.h>

static int collect(unsigned id, unsigned long long, unsigned long long, unsigned, void *mask)
{
    *(unsigned long *)mask |= 1ul << id;
    return 0;
}

static int first(unsigned, unsigned long long, unsigned long long, unsigned, void *mask)
{
    *(unsigned long *)mask = 1;
    return 1;
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    Peer peer = peer_read(argv[1]);
    std::vector<std::string> texts = expressions();
    std::vector<const char *> patterns;
    std::vector<unsigned> flags, ids;
    for (const std::string &text : texts) {
        ids.push_back((unsigned)patterns.size());
        patterns.push_back(text.c_str());
        flags.push_back(HS_FLAG_SINGLEMATCH | HS_FLAG_ALLOWEMPTY);
    }
    hs_database_t *database;
    hs_compile_error_t *error;
    hs_scratch_t *scratch = nullptr;
    if (hs_compile_multi(patterns.data(), flags.data(), ids.data(), (unsigned)ids.size(), HS_MODE_BLOCK, nullptr, &database, &error) != HS_SUCCESS)
        peer_stop("hyperscan", error->message);
    if (hs_alloc_scratch(database, &scratch) != HS_SUCCESS)
        peer_stop("hyperscan", "out of memory");
    auto scan = [&](const std::string &plan, match_event_handler handler) {
        unsigned long mask = 0;
        hs_error_t result = hs_scan(database, plan.data(), (unsigned)plan.size(), 0, scratch, handler, &mask);
        if (result != HS_SUCCESS && result != HS_SCAN_TERMINATED)
            peer_stop("hyperscan", "scanning failed");
        return mask;
    };
    peer_run("all", "hyperscan", peer, [&](const std::string &plan) { return scan(plan, collect); });
    peer_run("any", "hyperscan", peer, [&](const std::string &plan) { return scan(plan, first); });
    hs_free_scratch(scratch);
    hs_free_database(database);
}
