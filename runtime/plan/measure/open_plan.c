/* Reads open plans, and places their written trays. */
#include "runtime/plan/measure/open_plan.h"

#include <stdlib.h>

#include "runtime/plan/match/vm.h"

/* ---- reading a pattern */

static bool is_gap(const tn_open_plan *open, size_t i)
{
    return open->functions ? open->functions[i] == TN_NO_RECORD : open->trays[i].gap;
}

static tn_status read_pattern(tn_open_pattern *p, const tn_open_plan *open, tn_error *error)
{
    bool gap = false;
    for (size_t i = 0; i < open->count; i++) {
        if (is_gap(open, i)) {
            gap = true;
            p->gap_first |= p->items == 0;
            continue;
        }
        if (p->items == TN_PATTERN_MAX) {
            tn_fail(error, TN_LIMIT, E_TOO_MANY, "an open plan has more than %u written trays", TN_PATTERN_MAX);
            tn_error_help(error, "write `...` for some of them");
            return TN_LIMIT;
        }
        if (p->items == 0 || gap)
            p->segments[p->segment_count++] = (tn_open_segment){.first = p->items, .floats = gap};
        p->segments[p->segment_count - 1].count++;
        p->segment_of[p->items++] = p->segment_count - 1;
        gap = false;
    }
    p->gap_last = gap;
    if (!gap && p->segment_count > 0) /* bound to the end: there is one place for it */
        p->segments[p->segment_count - 1].floats = false;
    return TN_OK;
}

static void take_fits(tn_open_pattern *p, const tn_open_plan *open)
{
    uint32_t item = 0;
    for (size_t i = 0; i < open->count; i++) {
        if (open->trays[i].gap)
            continue;
        for (tn_tray t = 0; t < p->schema->tray_count; t++)
            p->fits[t] |= !open->trays[i].fits || open->trays[i].fits[t] ? UINT64_C(1) << item : 0;
        item++;
    }
}

static tn_status judge_fits(tn_open_pattern *p, const tn_open_plan *open, tn_error *error)
{
    const tn_schema *schema = p->schema;
    tn_plan_vm *vm = NULL;
    tn_status status = tn_plan_vm_new(schema, 1, &vm, error);
    for (tn_tray t = 0; status == TN_OK && t < schema->tray_count; t++) {
        uint32_t item = 0;
        status = tn_plan_vm_plan(vm, &t, 1, error);
        for (size_t i = 0; status == TN_OK && i < open->count; i++) {
            bool in;
            if (is_gap(open, i))
                continue;
            status = tn_plan_vm_relation(vm, open->functions[i], 0, 1, &in, error);
            p->fits[t] |= status == TN_OK && in ? UINT64_C(1) << item : 0;
            item++;
        }
    }
    tn_plan_vm_free(vm);
    return status;
}

static tn_status find_fits(tn_open_pattern *p, const tn_open_plan *open, tn_error *error)
{
    p->fits = calloc((size_t)p->schema->tray_count + 1, sizeof *p->fits);
    if (!p->fits)
        return tn_fail_memory(error);
    if (open->functions)
        return judge_fits(p, open, error);
    take_fits(p, open);
    return TN_OK;
}

tn_status tn_open_pattern_read(tn_open_pattern *p, const tn_schema *schema, const tn_open_plan *open, tn_error *error)
{
    *p = (tn_open_pattern){.schema = schema};
    tn_status status = tn_schema_listed(schema, "completing an open plan goes", error);
    if (status == TN_OK)
        status = read_pattern(p, open, error);
    return status == TN_OK ? find_fits(p, open, error) : status;
}

void tn_open_pattern_clear(tn_open_pattern *p)
{
    free(p->fits);
    *p = (tn_open_pattern){0};
}

/* ---- placing its trays */

/* Is there a gap before the written tray? */
static bool gap_before(const tn_open_pattern *p, uint32_t item)
{
    uint32_t s = p->segment_of[item];
    return p->segments[s].first == item && (s > 0 || p->gap_first);
}

tn_open_machine tn_open_start(const tn_open_pattern *p)
{
    return (tn_open_machine){0, p->items == 0 ? p->gap_last : p->gap_first, 0};
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

static tn_open_machine next_item(const tn_open_pattern *p, uint32_t placed, uint64_t earlier)
{
    bool last = placed == p->items, ends = last || p->segment_of[placed] != p->segment_of[placed - 1];
    return (tn_open_machine){placed, last ? p->gap_last : gap_before(p, placed), ends ? 0 : earlier};
}

size_t tn_open_ways(const tn_open_pattern *p, tn_open_machine m, uint64_t fits, tn_open_way ways[2])
{
    size_t count = 0;
    if (m.placed == p->items) {
        ways[0] = (tn_open_way){m, false};
        return m.gap;
    }
    const tn_open_segment *s = &p->segments[p->segment_of[m.placed]];
    bool meets = fits >> m.placed & 1, starts = s->first == m.placed;
    uint64_t after = 0;
    if (s->floats && !advance(s, fits, m.earlier, &after))
        return 0;
    if (meets)
        ways[count++] = (tn_open_way){next_item(p, m.placed + 1, after), true};
    if (!m.gap || !starts || (s->floats && meets && s->count == 1))
        return count;
    if (s->floats && meets)
        after |= 1;
    ways[count++] = (tn_open_way){{m.placed, true, after}, false};
    return count;
}
