/* Finds where the walls of a storey end, and how thick the post there is. */
#include <stdlib.h>
#include <string.h>

#include "runtime/house/house.h"

static int compare(const void *a, const void *b)
{
    const tn_post *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return (p->y > q->y) - (p->y < q->y);
}

/* Ends at one point become one. Faces go by trays, so that a new one belongs near the last. */
static void add_end(tn_posts *posts, const tn_post *end)
{
    size_t at = posts->count;
    while (at > 0 && compare(&posts->items[at - 1], end) > 0)
        at--;
    tn_post *last = at > 0 ? &posts->items[at - 1] : NULL;
    if (!last || compare(last, end) != 0) {
        memmove(&posts->items[at + 1], &posts->items[at], (posts->count - at) * sizeof *posts->items);
        posts->items[at] = *end;
        posts->count++;
        return;
    }
    last->thick_x = end->thick_x > last->thick_x ? end->thick_x : last->thick_x;
    last->thick_y = end->thick_y > last->thick_y ? end->thick_y : last->thick_y;
}

/* At both ends of a side that is open to the weather stands a post, as thick as a wall. */
static tn_post end_of(const tn_house *house, const tn_face *face)
{
    int64_t thick = tn_face_thickness(house, face), wall = house->form->record->wall;
    bool in_y = face->at.x0 == face->at.x1, open = tn_face_is_open_side(house, face);
    return (tn_post){face->at.x0, face->at.y0, open ? wall : in_y ? thick : 0, open ? wall : in_y ? 0 : thick};
}

static void add_near(tn_posts *posts, const tn_rectangle *near, const tn_post *end)
{
    if (!near || (end->x >= near->x0 && end->x <= near->x1 && end->y >= near->y0 && end->y <= near->y1))
        add_end(posts, end);
}

static bool is_apart(const tn_rectangle *a, const tn_rectangle *b)
{
    return a->x0 > b->x1 || b->x0 > a->x1 || a->y0 > b->y1 || b->y0 > a->y1;
}

tn_status tn_house_posts(const tn_house *house, uint32_t storey, const tn_rectangle *near, tn_posts *posts,
                         tn_error *error)
{
    *posts = (tn_posts){.items = malloc((2 * house->face_count + 1) * sizeof *posts->items)};
    if (!posts->items)
        return tn_fail_memory(error);
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->storey != storey || face->relation == TN_FACE_UNDER || (near && is_apart(&face->at, near)))
            continue;
        tn_post end = end_of(house, face);
        if (end.thick_x == 0 && end.thick_y == 0)
            continue;
        add_near(posts, near, &end);
        end.x = face->at.x1;
        end.y = face->at.y1;
        add_near(posts, near, &end);
    }
    return TN_OK;
}

const tn_post *tn_posts_find(const tn_posts *posts, int64_t x, int64_t y)
{
    tn_post key = {.x = x, .y = y};
    return posts->count ? bsearch(&key, posts->items, posts->count, sizeof *posts->items, compare) : NULL;
}
