/* Reads the pattern of an open plan: runs of written trays, and the trays of the schema by what they fit. */
#include <stdlib.h>

#include "runtime/plan/match/vm.h"
#include "runtime/plan/measure/complete_data.h"

static bool is_gap(const tn_open_plan *open, size_t i)
{
    return open->functions ? open->functions[i] == TN_NO_RECORD : open->trays[i].gap;
}

static tn_status read_pattern(tn_completer *c, const tn_open_plan *open, tn_error *error)
{
    bool gap = false;
    for (size_t i = 0; i < open->count; i++) {
        if (is_gap(open, i)) {
            gap = true;
            c->gap_first |= c->items == 0;
            continue;
        }
        if (c->items == TN_PATTERN_MAX) {
            tn_fail(error, TN_LIMIT, E_TOO_MANY, "an open plan has more than %u written trays", TN_PATTERN_MAX);
            tn_error_help(error, "write `...` for some of them");
            return TN_LIMIT;
        }
        if (c->items == 0 || gap)
            c->segments[c->segment_count++] = (tn_open_segment){.first = c->items, .floats = gap};
        c->segments[c->segment_count - 1].count++;
        c->segment_of[c->items++] = c->segment_count - 1;
        gap = false;
    }
    c->gap_last = gap;
    if (!gap && c->segment_count > 0) /* bound to the end: there is one place for it */
        c->segments[c->segment_count - 1].floats = false;
    return TN_OK;
}

bool tn_completer_gap_before(const tn_completer *c, uint32_t item)
{
    uint32_t s = c->segment_of[item];
    return c->segments[s].first == item && (s > 0 || c->gap_first);
}

static void take_fits(tn_completer *c, const tn_open_plan *open)
{
    uint32_t item = 0;
    for (size_t i = 0; i < open->count; i++) {
        if (open->trays[i].gap)
            continue;
        for (tn_tray t = 0; t < c->library->schema->tray_count; t++)
            c->fits[t] |= !open->trays[i].fits || open->trays[i].fits[t] ? UINT64_C(1) << item : 0;
        item++;
    }
}

static tn_status judge_fits(tn_completer *c, const tn_open_plan *open, tn_error *error)
{
    const tn_schema *schema = c->library->schema;
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
            c->fits[t] |= status == TN_OK && in ? UINT64_C(1) << item : 0;
            item++;
        }
    }
    tn_plan_vm_free(vm);
    return status;
}

static tn_status find_fits(tn_completer *c, const tn_open_plan *open, tn_error *error)
{
    c->fits = calloc((size_t)c->library->schema->tray_count + 1, sizeof *c->fits);
    if (!c->fits)
        return tn_fail_memory(error);
    if (open->functions)
        return judge_fits(c, open, error);
    take_fits(c, open);
    return TN_OK;
}

/* Trays that differ here lead to different states, or weigh differently. */
static uint32_t letter_apart(const tn_completer *c, tn_tray t)
{
    return c->weighed ? tn_weighed_letter(c->weighed, t) : c->library->tray_column[t];
}

static tn_status make_letters(tn_completer *c, tn_error *error)
{
    uint32_t trays = c->library->schema->tray_count;
    tn_numbering fits = {0}, pairs = {0};
    c->letter_of = calloc((size_t)trays + 1, sizeof *c->letter_of);
    bool ok = c->letter_of != NULL;
    for (tn_tray t = 0; ok && t < trays; t++) {
        uint32_t fit = tn_number(&fits, c->fits[t]);
        c->letter_of[t] = fit == UINT32_MAX ? fit : tn_number(&pairs, (uint64_t)letter_apart(c, t) << 32 | fit);
        ok = c->letter_of[t] != UINT32_MAX;
    }
    c->letters = pairs.count;
    tn_numbering_clear(&fits);
    tn_numbering_clear(&pairs);
    c->first = ok ? calloc((size_t)c->letters + 1, sizeof *c->first) : NULL;
    c->size = ok ? calloc((size_t)c->letters + 1, sizeof *c->size) : NULL;
    if (!c->first || !c->size)
        return tn_fail_memory(error);
    for (tn_tray t = trays; t-- > 0;) {
        c->first[c->letter_of[t]] = t;
        c->size[c->letter_of[t]]++;
    }
    return TN_OK;
}

void tn_completer_clear_pattern(tn_completer *c)
{
    free(c->fits);
    free(c->letter_of);
    free(c->first);
    free(c->size);
}

tn_status tn_completer_read(tn_completer *c, const tn_open_plan *open, tn_error *error)
{
    tn_status status = read_pattern(c, open, error);
    if (status == TN_OK)
        status = find_fits(c, open, error);
    return status == TN_OK ? make_letters(c, error) : status;
}
