/* The machine that places the written trays of an open plan.
 *
 * It guesses where a run of written trays after a gap starts, and remembers the runs that started earlier: none of them
 * may come to its end, so that the guess is the leftmost. Each plan is then read in one way only. */
#include "runtime/plan/measure/complete_data.h"

tn_machine tn_machine_start(const tn_completer *c)
{
    return (tn_machine){0, c->items == 0 ? c->gap_last : c->gap_first, 0};
}

/* The runs that started earlier, after a tray; false where one comes to its end. */
static bool advance(const tn_open_segment *s, uint64_t fits, uint64_t earlier, uint64_t *after)
{
    *after = 0;
    for (uint32_t k = 0; k < s->count; k++) {
        if (!(earlier >> k & 1) || !(fits >> (s->first + k + 1) & 1))
            continue;
        if (k + 2 == s->count)
            return false;
        *after |= UINT64_C(1) << (k + 1);
    }
    return true;
}

static tn_machine next_item(const tn_completer *c, uint32_t placed, uint64_t earlier)
{
    bool last = placed == c->items, ends = last || c->segment_of[placed] != c->segment_of[placed - 1];
    return (tn_machine){placed, last ? c->gap_last : tn_completer_gap_before(c, placed), ends ? 0 : earlier};
}

size_t tn_machine_ways(const tn_completer *c, tn_machine m, uint64_t fits, tn_machine_way ways[2])
{
    size_t count = 0;
    if (m.placed == c->items) {
        ways[0] = (tn_machine_way){m, false};
        return m.gap;
    }
    const tn_open_segment *s = &c->segments[c->segment_of[m.placed]];
    bool meets = fits >> m.placed & 1, starts = s->first == m.placed;
    uint64_t after = 0;
    if (s->floats && !advance(s, fits, m.earlier, &after))
        return 0;
    if (meets)
        ways[count++] = (tn_machine_way){next_item(c, m.placed + 1, after), true};
    if (!m.gap || !starts || (s->floats && meets && s->count == 1))
        return count;
    if (s->floats && meets)
        after |= 1;
    ways[count++] = (tn_machine_way){{m.placed, true, after}, false};
    return count;
}
