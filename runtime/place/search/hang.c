/* Goes from the connectors at which the model starts to what stands there, and on from the connectors of that. What has
 * a connector at a place is found by a hash table. */
#include "runtime/place/search/hang.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"

static size_t slot_of(const tn_hang *h, const int32_t at[3])
{
    uint64_t hash = tn_mix64((uint64_t)(uint32_t)at[0] << 32 | (uint32_t)at[1]);
    return (size_t)tn_mix64(hash ^ (uint32_t)at[2]) & (h->socket_size - 1);
}

static void add_sockets(tn_hang *h, const tn_site_choices *c, const tn_put *put, uint32_t index)
{
    const tn_module *module = c->rules->module;
    const tn_chosen_part *part = &c->parts[c->choices[put->choice].part_first]; /* that joins where it is put */
    if (put->choice == c->standing)
        return;
    const tn_kit_part_record *record = c->kinds[part->kind].record;
    tn_frame frame = tn_frame_from(&put->at, &part->frame);
    for (uint32_t i = 0; i < record->connector_count; i++) {
        const tn_part_connector_record *from = &module->PART_CONNECTOR_records[record->connector_first + i];
        const tn_frame relative = {.at = {(int32_t)from->x, (int32_t)from->y, (int32_t)from->z}};
        tn_frame at = tn_frame_from(&frame, &relative);
        size_t slot = slot_of(h, at.at);
        while (h->sockets[slot].put)
            slot = (slot + 1) & (h->socket_size - 1);
        memcpy(h->sockets[slot].at, at.at, sizeof at.at);
        h->sockets[slot].put = index + 1;
    }
}

static bool make_sockets(tn_hang *h, const tn_site_choices *c, const tn_standing *plan)
{
    size_t count = 0, size = 64;
    for (size_t i = 0; i < plan->put_count; i++)
        count += c->kinds[c->parts[c->choices[plan->puts[i].choice].part_first].kind].record->connector_count;
    while (size < 2 * count + 2)
        size *= 2;
    if (size > h->socket_size) {
        if (!tn_array_resize(&h->sockets, size, sizeof *h->sockets))
            return false;
        h->socket_size = size;
    }
    memset(h->sockets, 0, h->socket_size * sizeof *h->sockets);
    for (size_t i = 0; i < plan->put_count; i++)
        add_sockets(h, c, &plan->puts[i], (uint32_t)i);
    return true;
}

/* Room for so many puts. */
static bool make_room(tn_hang *h, size_t puts)
{
    if (puts <= h->capacity)
        return true;
    if (!tn_array_resize(&h->order, puts, sizeof *h->order) || !tn_array_resize(&h->held, puts, sizeof *h->held))
        return false;
    h->capacity = puts;
    return true;
}

static tn_status add_sites(tn_hang *h, const tn_open_site *sites, size_t count, const tn_frame *base, tn_error *error)
{
    if (!tn_array_reserve(&h->sites, &h->site_capacity, h->site_count, count, sizeof *h->sites))
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        h->sites[h->site_count++] = (tn_open_site){sites[i].symbol, tn_frame_from(base, &sites[i].frame)};
    return TN_OK;
}

/* The put that stands at a site by its rule, and was not reached before; UINT32_MAX: none. */
static uint32_t find_put(const tn_hang *h, const tn_site_choices *c, const tn_standing *plan, const tn_open_site *site)
{
    for (size_t slot = slot_of(h, site->frame.at); h->sockets[slot].put; slot = (slot + 1) & (h->socket_size - 1)) {
        uint32_t index = h->sockets[slot].put - 1;
        if (h->held[index] || memcmp(h->sockets[slot].at, site->frame.at, sizeof site->frame.at) != 0)
            continue;
        const tn_put *put = &plan->puts[index];
        if (tn_choice_may_stand(c, site, &c->choices[put->choice], &put->at))
            return index;
    }
    return UINT32_MAX;
}

static tn_status reach(tn_hang *h, const tn_site_choices *c, const tn_standing *plan, size_t *count, tn_error *error)
{
    h->site_count = *count = 0;
    tn_status status =
        add_sites(h, &c->sites[c->start_first], c->site_count - c->start_first, &(tn_frame){.heading = 0}, error);
    if (c->standing != TN_NONE_STANDS) { /* it hangs on nothing, and is the first */
        h->held[0] = true;
        h->order[(*count)++] = 0;
    }
    for (size_t next = 0; next < h->site_count && status == TN_OK; next++) {
        uint32_t index = find_put(h, c, plan, &h->sites[next]);
        if (index == UINT32_MAX)
            continue;
        const tn_put *put = &plan->puts[index];
        const tn_site_choice *choice = &c->choices[put->choice];
        h->held[index] = true;
        h->order[(*count)++] = index;
        status = add_sites(h, &c->sites[choice->site_first], choice->site_count, &put->at, error);
    }
    return status;
}

/* Opens the connectors where something may come that needs cells of the region; all of them where images or a stock
 * have effects elsewhere. */
static tn_status open_near(tn_hang *h, const tn_site_choices *c, tn_standing *plan, const tn_cell_box *region,
                           tn_error *error)
{
    const tn_kit_model_record *model = c->rules->space;
    bool anywhere = model->symmetry != TN_SYMMETRY_NONE || model->stock_count > 0;
    plan->open_count = 0;
    for (size_t i = 0; i < h->site_count; i++) {
        const tn_open_site *site = &h->sites[i];
        tn_cell_box turned = tn_cell_box_of(c->symbols[site->symbol].around, site->frame.heading);
        tn_cell_box around = tn_box_from(&turned, site->frame.at);
        bool near = c->symbols[site->symbol].count > 0;
        for (int k = 0; k < 3 && near && !anywhere; k++)
            near = around.low[k] < region->high[k] && region->low[k] < around.high[k];
        if (!near)
            continue;
        if (!tn_array_reserve(&plan->open, &plan->open_capacity, plan->open_count, 1, sizeof *plan->open))
            return tn_fail_memory(error);
        plan->open[plan->open_count++] = *site;
    }
    return TN_OK;
}

tn_status tn_hang_keep(tn_hang *h, const tn_site_choices *c, tn_standing *plan, tn_cell_box *region, tn_error *error)
{
    size_t count, old = plan->put_count;
    if (!make_sockets(h, c, plan) || !make_room(h, old + 1))
        return tn_fail_memory(error);
    memset(h->held, 0, (old + 1) * sizeof *h->held);
    tn_status status = reach(h, c, plan, &count, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < old; i++) {
        tn_cell_box turned = tn_cell_box_of(c->choices[plan->puts[i].choice].around, plan->puts[i].at.heading);
        tn_cell_box box = tn_box_from(&turned, plan->puts[i].at.at);
        if (!h->held[i])
            tn_cell_box_widen(region, &box);
    }
    if (!tn_array_reserve(&plan->puts, &plan->put_capacity, old, count, sizeof *plan->puts))
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        plan->puts[old + i] = plan->puts[h->order[i]];
    memmove(plan->puts, &plan->puts[old], count * sizeof *plan->puts);
    plan->put_count = count;
    return open_near(h, c, plan, region, error);
}

void tn_hang_clear(tn_hang *h)
{
    free(h->sockets);
    free(h->order);
    free(h->held);
    free(h->sites);
    *h = (tn_hang){0};
}
