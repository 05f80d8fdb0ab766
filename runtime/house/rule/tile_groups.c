/* Counts combinations of tiles by their groups. */
#include "runtime/house/rule/tile_groups.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/base/integers.h"

tn_status tn_tile_groups_begin(tn_tile_groups *g, size_t cells, tn_error *error)
{
    *g = (tn_tile_groups){.cells = cells,
                          .group = calloc(cells + 1, sizeof *g->group),
                          .counts = calloc(cells + 1, sizeof *g->counts),
                          .sizes = calloc(cells + 1, sizeof *g->sizes),
                          .ahead = calloc(cells + 1, sizeof *g->ahead),
                          .states = calloc(cells + 1, sizeof *g->states)};
    return g->group && g->counts && g->sizes && g->ahead && g->states ? TN_OK : tn_fail_memory(error);
}

void tn_tile_groups_clear(tn_tile_groups *g)
{
    for (size_t i = 0; g->group && g->sizes && i < g->cells; i++) {
        free(g->group[i]);
        free(g->sizes[i]);
    }
    for (size_t i = 0; g->ahead && g->states && i <= g->cells; i++)
        tn_integers_free(g->ahead[i], g->states[i]);
    free(g->group);
    free(g->counts);
    free(g->sizes);
    free(g->ahead);
    free(g->states);
    *g = (tn_tile_groups){0};
}

tn_status tn_tile_groups_add(tn_tile_groups *g, size_t cell, const uint64_t *numbers, size_t tiles, tn_error *error)
{
    g->group[cell] = tn_array_new(tiles, sizeof **g->group);
    g->sizes[cell] = calloc(tiles, sizeof **g->sizes);
    if (!g->group[cell] || !g->sizes[cell])
        return tn_fail_memory(error);
    for (size_t i = 0; i < tiles; i++) {
        size_t like = 0;
        while (numbers[like] != numbers[i])
            like++;
        g->group[cell][i] = like < i ? g->group[cell][like] : (uint32_t)g->counts[cell]++;
        g->sizes[cell][g->group[cell][i]]++;
    }
    return TN_OK;
}

/* ---- all combinations */

static tn_status too_many(tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_VARIANTS,
            "what stands in the rooms of a house makes its walks differ in more than %u ways", TN_TILE_STATES_MAX);
    tn_error_help(error, "ask about houses with fewer rooms that one walks through, or with fewer tiles for these");
    return TN_LIMIT;
}

static tn_status make_states(tn_tile_groups *g, tn_error *error)
{
    size_t states = 1;
    for (size_t i = 0; i <= g->cells; i++) {
        if (states > TN_TILE_STATES_MAX)
            return too_many(error);
        g->ahead[i] = tn_integers_new(states);
        if (!g->ahead[i])
            return tn_fail_memory(error);
        g->states[i] = states;
        states = i < g->cells ? tn_size_of(states, g->counts[i]) : states;
    }
    return TN_OK;
}

/* The first tile of each group of a state behind the last cell. */
static void set_tiles(const tn_tile_groups *g, size_t state, size_t *tiles)
{
    for (size_t i = g->cells; i-- > 0; state /= g->counts[i]) {
        uint32_t group = (uint32_t)(state % g->counts[i]);
        tiles[i] = 0;
        while (g->group[i][tiles[i]] != group)
            tiles[i]++;
    }
}

/* From the last cell backwards: each tile of a group goes on as the others do. */
static void add_up(tn_tile_groups *g)
{
    for (size_t i = g->cells; i-- > 0;)
        for (size_t state = 0; state < g->states[i]; state++)
            for (size_t k = 0; k < g->counts[i]; k++)
                mpz_addmul_ui(g->ahead[i][state], g->ahead[i + 1][state * g->counts[i] + k], g->sizes[i][k]);
}

tn_status tn_tile_groups_ask(tn_tile_groups *g, tn_tiles_asked *ask, void *context, tn_error *error)
{
    size_t *tiles = tn_array_new((uint64_t)g->cells + 1, sizeof *tiles);
    tn_status status = tiles ? make_states(g, error) : tn_fail_memory(error);
    for (size_t state = 0; status == TN_OK && state < g->states[g->cells]; state++) {
        bool kept = false;
        set_tiles(g, state, tiles);
        status = ask(context, tiles, &kept, error);
        mpz_set_ui(g->ahead[g->cells][state], status == TN_OK && kept);
        g->asked++;
    }
    if (status == TN_OK)
        add_up(g);
    free(tiles);
    return status;
}
