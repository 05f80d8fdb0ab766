/* Models of parts, placed by the connection grammar of a .pcfg file or by a model of a .kit file: what `tartan place`
 * places. */
#ifndef TARTAN_PLACE_H
#define TARTAN_PLACE_H

#include "module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Zeros are the defaults, which are those of the command. */
typedef struct tartan_place_options {
    size_t size;
    uint32_t seed;            /* of drawn alternatives */
    uint64_t part_limit;      /* 1,000,000 */
    uint64_t step_limit;      /* 1,000,000,000 */
    uint64_t frame_limit;     /* frames that are open at a time: 1,000,000 */
    uint64_t lookahead_limit; /* steps of one look ahead: 1,000,000 */
    const char *model;        /* of a kit; NULL: its only one */
    uint64_t search_limit;    /* models that a search of a kit's model looks at or gives up: 10,000,000 */
    uint32_t threads;         /* of a search: one a processor */
} tartan_place_options;
TARTAN_SIZED(tartan_place_options)

typedef struct tartan_placed_part {
    int32_t at[3];    /* x and z in half studs (10 LDU), y in plates (8 LDU), downwards */
    uint32_t heading; /* quarter turns, 0 to 3: 1 takes (x, z) to (-z, x). Kits with all turns: up to 23, 4 a + h: h of
                         these, then up goes to axis a, and right goes right where a is up or down, else up; axes are
                         up, down, left, right, front, back */
    int32_t colour;
    const char *name; /* the placement's */
} tartan_placed_part;

typedef struct tartan_placement tartan_placement;

/* Places the parts of the module's grammar, or of one of its kit's models inside of the model's space, by the search
 * that it asks for. `options` and `watch` may be NULL. TARTAN_INVALID: the module has no such grammar or model, a part
 * has no room, nothing is placed, or what was placed does not meet what the model requires (`require`; E1316).
 * TARTAN_LIMIT: an option's. Where a search passes `search_limit` (TARTAN_LIMIT) or the watch ends it (TARTAN_STOPPED)
 * and the best model that it has looked at meets what is required, that is the placement, as `tartan place` writes it;
 * otherwise *placement stays as it is. Free it in any case. The placement borrows the module. */
TARTAN_API tartan_status tartan_place(const tartan_module *module, const tartan_place_options *options,
                                      const tartan_watch *watch, tartan_placement **placement, tartan_error *error);
TARTAN_API void tartan_placement_free(tartan_placement *placement);

/* The parts, in the order in which they were placed; where the kit's model says in which `steps` it is built, in the
 * order of building. */
TARTAN_API const tartan_placed_part *tartan_placement_parts(const tartan_placement *placement, size_t *count);

typedef struct tartan_placement_counts {
    size_t size;
    uint64_t parts, steps;
    uint64_t expansions; /* of symbols */
    uint64_t draws;      /* alternatives that were drawn */
    uint64_t tries;      /* alternatives that were looked at */
    uint64_t fallbacks;  /* last alternatives that were taken although they did not fit */
    uint64_t cells, bounds;
    uint64_t looked_at; /* models that a search looked at, which has no other counts than this and parts; or 0 */
    bool proved;        /* the rules allow no better model than the search found */
} tartan_placement_counts;
TARTAN_SIZED(tartan_placement_counts)

/* How many parts there are, and what placing them took. */
TARTAN_API tartan_status tartan_placement_count(const tartan_placement *placement, tartan_placement_counts *counts,
                                                tartan_error *error);

/* The model as an LDraw file: of a kit with how it was made, and with the model's steps. The list of its parts as CSV:
 * part,colour,number, of a kit also title, mass and price. Free with tartan_text_free. */
TARTAN_API tartan_status tartan_placement_ldraw(const tartan_placement *placement, char **text, size_t *size,
                                                tartan_error *error);
TARTAN_API tartan_status tartan_placement_list(const tartan_placement *placement, char **text, size_t *size,
                                               tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
