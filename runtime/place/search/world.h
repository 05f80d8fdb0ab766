/* What stands while a search goes on: what was put where, the cells that this fills, and the connectors that are open.
 *
 * A world belongs to one thread; a plan is a list of what was put, which any world can make stand. What stands in a
 * model with a symmetry has its images; a plan names what is put, without its images. */
#ifndef TARTAN_PLACE_SEARCH_WORLD_H
#define TARTAN_PLACE_SEARCH_WORLD_H

#include "runtime/place/search/choices.h"
#include "runtime/place/space.h"

enum { TN_IMAGES_MAX = 4 };

/* A choice, and the frame of the connector that it was put at. */
typedef struct tn_put {
    uint32_t choice;
    tn_frame at;
} tn_put;

/* What stands, in an order in which each hangs on something before it, and the open connectors: `open_count` of them
 * from `open_first`, of which the last comes next, or in breadth the first. open_first: 0 unless connectors were taken
 * in breadth by tn_world_next. draws: how many random choices were made. */
typedef struct tn_standing {
    tn_put *puts;
    tn_open_site *open;
    size_t put_count, put_capacity, open_first, open_count, open_capacity;
    uint64_t draws;
} tn_standing;

typedef struct tn_world {
    const tn_site_choices *choices; /* borrowed */
    tn_cells *cells;
    tn_space *space;
    tn_standing plan;
    uint64_t *used; /* [kind]: parts that stand */
    uint64_t part_count, part_limit; /* with images */
    uint64_t seed;
    bool stands_over; /* of the parts with which the model starts one lies in another */
} tn_world;

/* An empty world: of the options, seed, part_limit and watch. TN_MEMORY or TN_OK; clear it in any case. */
tn_status tn_world_make(const tn_site_choices *choices, const tn_place_options *options, tn_world *world,
                        tn_error *error);
void tn_world_clear(tn_world *world);

/* Opens the connectors at which the model starts; the first of them comes next. */
tn_status tn_world_start(tn_world *world, tn_error *error);

/* Has the choice room at a frame, with its images, and has the stock its parts? */
bool tn_world_fits(tn_world *world, uint32_t choice, const tn_frame *at);

/* The choices of a site that fit, in their order; of a draw only the one that is drawn, unless all are wanted. At most
 * `most`, for which there is room; returns how many. */
size_t tn_world_choices(tn_world *world, const tn_open_site *site, bool all, uint32_t *fitting, size_t most);

/* Takes the open connector that comes next, of which there is one, from the list. */
tn_open_site tn_world_next(tn_world *world);

/* Puts a choice that fits, and opens its connectors, the first of them before the others. */
tn_status tn_world_put(tn_world *world, uint32_t choice, const tn_frame *at, tn_error *error);

/* Takes away what was put last; open connectors stay as they are. */
void tn_world_take_last(tn_world *world);

/* Makes a plan stand in place of what does. */
tn_status tn_world_load(tn_world *world, const tn_standing *plan, tn_error *error);

/* Goes on by the first choice that fits at each open connector, until none is open. */
tn_status tn_world_grow(tn_world *world, tn_error *error);

tn_status tn_standing_copy(tn_standing *to, const tn_standing *from, tn_error *error);
void tn_standing_clear(tn_standing *plan);

/* The parts of a plan with their images, in its order; the model's arrays are kept and used again. */
tn_status tn_standing_model(const tn_site_choices *choices, const tn_standing *plan, tn_placed_model *model,
                            tn_error *error);

/* The frames of a part and its images that look different, the part's own first; returns how many. */
size_t tn_part_images(const tn_site_choices *choices, uint32_t kind, const tn_frame *frame,
                      tn_frame images[TN_IMAGES_MAX]);

#endif
