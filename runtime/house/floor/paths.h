/* The shortest ways over the free floor of a cell between points of it: lines from point to point, which turn only at
 * corners of what is in the way, of the clear rectangle and of gates. A line within the free floor is as long as its
 * root, rounded up to a nanometre; a way is the sum of its lines. So the answers are exact.
 */
#ifndef TARTAN_HOUSE_FLOOR_PATHS_H
#define TARTAN_HOUSE_FLOOR_PATHS_H

#include "runtime/house/floor/floor.h"

#define TN_NO_PATH INT64_MAX

/* points: the ends, then the corners. Owns its arrays. */
typedef struct tn_floor_paths {
    tn_point *points;
    size_t end_count, count;
    int64_t *lengths; /* [ends][points] TN_NO_PATH: no way leads there */
    uint32_t *before; /* [ends][points] the point that the way from the end comes by last */
} tn_floor_paths;

/* The ways between the ends. No way leads to an end where nobody can stand, or from it. TN_MEMORY. Clear it in any
 * case. */
tn_status tn_floor_paths_find(const tn_floor *floor, const tn_point *ends, size_t count, tn_floor_paths *paths,
                              tn_error *error);
void tn_floor_paths_clear(tn_floor_paths *paths);

static inline int64_t tn_floor_path(const tn_floor_paths *paths, size_t from, size_t to)
{
    return paths->lengths[from * paths->count + to];
}

/* The points of the way from one end to another that there is, these included. to: room for paths->count of them.
 * Returns how many. */
size_t tn_floor_path_points(const tn_floor_paths *paths, size_t from, size_t to, tn_point *points);

#endif
