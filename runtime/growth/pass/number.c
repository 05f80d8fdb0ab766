/* The numbers of joined edges: behind all others, in the order of their lower branches' numbers. */
#include <stdlib.h>

#include "runtime/growth/pass/pass.h"

typedef struct numbering {
    const tn_pass *pass;
    uint32_t *first; /* [chunk] its first joined edge */
} numbering;

static uint32_t joints_end(const tn_pass *pass, uint32_t chunk)
{
    uint32_t numbers = pass->branch_first + pass->branch_count, begin = chunk * TN_CHUNK_EDGES;
    return numbers - begin < TN_CHUNK_EDGES ? numbers : begin + TN_CHUNK_EDGES;
}

static void count_joints(void *context, uint32_t chunk)
{
    const numbering *n = context;
    uint32_t count = 0;
    for (uint32_t b = chunk * TN_CHUNK_EDGES, end = joints_end(n->pass, chunk); b < end; b++)
        count += n->pass->joints[b] != TN_NONE;
    n->first[chunk + 1] = count;
}

static void number_chunk(void *context, uint32_t chunk)
{
    const numbering *n = context;
    uint32_t *joints = n->pass->joints, edge = n->first[chunk];
    for (uint32_t b = chunk * TN_CHUNK_EDGES, end = joints_end(n->pass, chunk); b < end; b++) {
        if (joints[b] == TN_NONE)
            continue;
        n->pass->new->states[edge] = joints[b];
        joints[b] = edge++;
    }
}

tn_status tn_pass_number_joints(const tn_pass *pass, tn_error *error)
{
    uint32_t numbers = pass->branch_first + pass->branch_count;
    uint32_t chunks = (numbers + TN_CHUNK_EDGES - 1) / TN_CHUNK_EDGES;
    numbering n = {pass, calloc(chunks + 1, sizeof *n.first)};
    if (!n.first)
        return tn_fail_memory(error);
    tn_status status = tn_crew_share(tn_pass_crew(pass), chunks, count_joints, &n, error);
    n.first[0] = pass->edges;
    for (uint32_t c = 0; c < chunks && status == TN_OK; c++)
        n.first[c + 1] += n.first[c];
    if (status == TN_OK)
        status = tn_crew_share(tn_pass_crew(pass), chunks, number_chunk, &n, error);
    free(n.first);
    return status;
}
