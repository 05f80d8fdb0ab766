/* Middles and distances, in whole nanometres. */
#include "runtime/house/floor/rectangle.h"

static int64_t half_down(int64_t sum)
{
    return sum >= 0 || sum % 2 == 0 ? sum / 2 : sum / 2 - 1;
}

tn_point tn_rectangle_middle(const tn_rectangle *r)
{
    return (tn_point){half_down(r->x0 + r->x1), half_down(r->y0 + r->y1)};
}

/* It lies between the longer and both of the sides of a right angle. */
static int64_t root_between(tn_int128 square, int64_t low, int64_t high)
{
    while (low < high) {
        int64_t middle = low + (high - low) / 2;
        if ((tn_int128)middle * middle < square)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

int64_t tn_root_up(tn_int128 square)
{
    return root_between(square, 0, INT64_C(1) << 62);
}

static int64_t size_of(int64_t number)
{
    return number < 0 ? -number : number;
}

int64_t tn_distance_up(tn_point a, tn_point b)
{
    int64_t x = size_of(a.x - b.x), y = size_of(a.y - b.y);
    return root_between((tn_int128)x * x + (tn_int128)y * y, x > y ? x : y, x + y);
}
