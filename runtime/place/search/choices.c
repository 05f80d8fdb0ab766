/* Works out what a kit's rules may put where, and in which headings and images its parts look the same. */
#include "runtime/place/search/choices.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/place/joints.h"

/* ==== compares each part of a kit with itself turned and mirrored */

/* A box, or a connector with its type, its axis and how far it is turned about that, from the lowest cell of the part.
 */
typedef struct feature {
    int32_t what, type, axis, turn, low[3], high[3];
} feature;

static int compare(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(feature));
}

static void mirror_box(tn_cell_box *box, int axis)
{
    int k = axis == 0 ? 0 : 2;
    int32_t low = box->low[k];
    box->low[k] = -box->high[k];
    box->high[k] = -low;
}

static tn_axis mirror_axis(tn_axis at, int axis)
{
    static const tn_axis pairs[2][2] = {{TN_AXIS_LEFT, TN_AXIS_RIGHT}, {TN_AXIS_FRONT, TN_AXIS_BACK}};
    return at == pairs[axis][0] ? pairs[axis][1] : at == pairs[axis][1] ? pairs[axis][0] : at;
}

/* The part turned, and before that mirrored at x = 0 (0) or z = 0 (1) or not (-1). */
static size_t list_features(const tn_module *module, const tn_kind_of_part *kind, uint32_t heading, int mirror,
                            feature *to)
{
    const tn_kit_part_record *record = kind->record;
    const tn_frame turned = {.heading = heading};
    int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX};
    size_t count = 0;
    for (uint32_t i = 0; i < record->box_count; i++) {
        tn_cell_box box = tn_part_box_at(&module->PART_BOX_records[record->box_first + i], &(tn_frame){.heading = 0});
        if (mirror >= 0)
            mirror_box(&box, mirror);
        tn_part_box_record again = {box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2]};
        box = tn_part_box_at(&again, &turned);
        to[count] = (feature){.what = 0};
        memcpy(to[count].low, box.low, sizeof box.low);
        memcpy(to[count++].high, box.high, sizeof box.high);
        for (int k = 0; k < 3; k++)
            low[k] = box.low[k] < low[k] ? box.low[k] : low[k];
    }
    for (uint32_t i = 0; i < record->connector_count; i++) {
        const tn_part_connector_record *c = &module->PART_CONNECTOR_records[record->connector_first + i];
        tn_axis axis = mirror >= 0 ? mirror_axis((tn_axis)c->axis, mirror) : (tn_axis)c->axis;
        feature *f = &to[count++];
        *f = (feature){.what = 1, .type = (int32_t)c->type, .axis = (int32_t)tn_axis_turn(axis, heading)};
        /* what is beside the axis tells how far it is turned about it: alike are all, opposite ones, or none */
        tn_axis beside = tn_axis_beside((tn_axis)c->axis);
        beside = tn_axis_turn(mirror >= 0 ? mirror_axis(beside, mirror) : beside, heading);
        uint32_t alike = tn_connector_turns(module, c->type);
        f->turn = alike == 4 ? 0 : alike == 2 ? (int32_t)(beside / 2) : (int32_t)beside;
        const int32_t at[3] = {(int32_t)(mirror == 0 ? -c->x : c->x), (int32_t)c->y,
                               (int32_t)(mirror == 1 ? -c->z : c->z)};
        tn_turn_place(heading, at, f->low);
        memcpy(f->high, f->low, sizeof f->low);
    }
    for (size_t i = 0; i < count && record->box_count > 0; i++)
        for (int k = 0; k < 3; k++) {
            to[i].low[k] -= low[k];
            to[i].high[k] -= low[k];
        }
    qsort(to, count, sizeof *to, compare);
    return count;
}

static void set_kind_boxes(const tn_module *module, tn_kind_of_part *kind)
{
    for (uint32_t h = 0; h < 4; h++) {
        tn_cell_box all = {{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
        for (uint32_t i = 0; i < kind->record->box_count; i++) {
            const tn_part_box_record *box = &module->PART_BOX_records[kind->record->box_first + i];
            kind->boxes[h][i] = tn_part_box_at(box, &(tn_frame){.heading = h});
            tn_cell_box_widen(&all, &kind->boxes[h][i]);
        }
        kind->all[h] = kind->record->box_count ? all : (tn_cell_box){{0}, {0}};
    }
}

static tn_status set_shapes(const tn_module *module, tn_kind_of_part *kind, tn_error *error)
{
    size_t most = (size_t)kind->record->box_count + kind->record->connector_count;
    feature *plain = calloc(most + 1, sizeof *plain), *other = calloc(most + 1, sizeof *other);
    tn_status status = plain && other ? TN_OK : tn_fail_memory(error);
    uint32_t turns = tn_place_turns(module);
    for (uint32_t h = 0; status == TN_OK && h < turns; h++) {
        size_t count = list_features(module, kind, h, -1, plain);
        for (kind->shape[h] = 0; kind->shape[h] < h; kind->shape[h]++) {
            list_features(module, kind, kind->shape[h], -1, other);
            if (memcmp(plain, other, count * sizeof *plain) == 0)
                break;
        }
    }
    for (int axis = 0; status == TN_OK && axis < 2; axis++) {
        size_t count = list_features(module, kind, 0, axis, plain);
        for (kind->mirrored[axis] = 0; kind->mirrored[axis] < turns; kind->mirrored[axis]++) {
            list_features(module, kind, kind->mirrored[axis], -1, other);
            if (memcmp(plain, other, count * sizeof *plain) == 0)
                break;
        }
        if (kind->mirrored[axis] == turns)
            kind->mirrored[axis] = TN_TURNS;
    }
    free(plain);
    free(other);
    return status;
}

tn_status tn_kinds_make(tn_site_choices *choices, tn_error *error)
{
    const tn_module *module = choices->rules->module;
    size_t boxes = 0;
    choices->kind_count = module->KIT_PART_count;
    for (uint32_t i = 0; i < choices->kind_count; i++)
        boxes += 4 * (size_t)module->KIT_PART_records[i].box_count;
    choices->kinds = calloc((size_t)choices->kind_count + 1, sizeof *choices->kinds);
    choices->boxes = calloc(boxes + 1, sizeof *choices->boxes);
    if (!choices->kinds || !choices->boxes)
        return tn_fail_memory(error);
    tn_cell_box *next = choices->boxes;
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < choices->kind_count && status == TN_OK; i++) {
        tn_kind_of_part *kind = &choices->kinds[i];
        kind->record = &module->KIT_PART_records[i];
        kind->most = UINT64_MAX;
        for (int h = 0; h < 4; h++, next += kind->record->box_count)
            kind->boxes[h] = next;
        set_kind_boxes(module, kind);
        status = set_shapes(module, kind, error);
    }
    return status;
}

/* Mirrored, turned and mirrored again is a turn too; the mirrored part is one that is turned. */
static uint32_t mirror_turn(uint32_t turn, int axis)
{
    uint32_t found = 0;
    tn_axis up = mirror_axis(tn_axis_turn(TN_AXIS_UP, turn), axis);
    tn_axis right = mirror_axis(tn_axis_turn(mirror_axis(TN_AXIS_RIGHT, axis), turn), axis);
    while (tn_axis_turn(TN_AXIS_UP, found) != up || tn_axis_turn(TN_AXIS_RIGHT, found) != right)
        found++;
    return found;
}

tn_frame tn_kind_mirror(const tn_kind_of_part *kind, const tn_frame *frame, int axis)
{
    tn_frame image = *frame;
    tn_cell_box all = tn_kind_all(kind, frame->heading);
    image.heading = tn_turn_after(mirror_turn(frame->heading, axis), kind->mirrored[axis]);
    tn_cell_box turned = tn_kind_all(kind, image.heading);
    for (int k = 0; k < 3; k++) {
        all.low[k] += frame->at[k];
        all.high[k] += frame->at[k];
    }
    mirror_box(&all, axis);
    for (int k = 0; k < 3; k++)
        image.at[k] = all.low[k] - turned.low[k];
    return image;
}

/* ==== works out what a kit's rules may put where: each alternative's steps are walked once, those of symbols with a
 * single alternative in place of the symbol */

enum { DEPTH_MAX = 64, ITEMS_MAX = 1 << 22 };

tn_frame tn_frame_from(const tn_frame *base, const tn_frame *relative)
{
    tn_frame frame = {.heading = tn_turn_after(base->heading, relative->heading), .colour = relative->colour};
    tn_turn_place(base->heading, relative->at, frame.at);
    for (int k = 0; k < 3; k++)
        frame.at[k] += base->at[k];
    return frame;
}

/* ---- walking */

/* The head of one alternative: its frames, and where it is in the symbols it goes into. */
typedef struct walk {
    tn_site_choices *choices;
    tn_frame frames[DEPTH_MAX];
    struct {
        uint32_t next, end;
    } at[DEPTH_MAX];
    size_t frame_count, depth;
    uint32_t body; /* the first symbol gone into, or none */
    tn_error *error;
} walk;

static tn_status not_a_kit(tn_error *error)
{
    return tn_fail(error, TN_INVALID, E_KIT_SEARCH, "these rules are not those of a kit: they cannot be searched");
}

static tn_status too_many(tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_PLACE_LIMIT, "the rules allow more than %d choices", ITEMS_MAX);
    tn_error_help(error, "use rules with fewer parts, or place the model without a search");
    return TN_LIMIT;
}

static tn_status add_part(walk *w, const tn_frame *frame, const char *name)
{
    tn_site_choices *c = w->choices;
    const tn_kit_part_record *record = tn_kit_part_named(c->rules->module, name);
    if (!record)
        return not_a_kit(w->error);
    if (c->part_count == ITEMS_MAX)
        return too_many(w->error);
    if (!tn_array_reserve(&c->parts, &c->part_capacity, c->part_count, 1, sizeof *c->parts))
        return tn_fail_memory(w->error);
    c->parts[c->part_count++] = (tn_chosen_part){(uint32_t)(record - c->rules->module->KIT_PART_records), *frame};
    return TN_OK;
}

static tn_status add_site(walk *w, const tn_frame *frame, uint32_t symbol)
{
    tn_site_choices *c = w->choices;
    if (c->site_count == ITEMS_MAX)
        return too_many(w->error);
    if (!tn_array_reserve(&c->sites, &c->site_capacity, c->site_count, 1, sizeof *c->sites))
        return tn_fail_memory(w->error);
    c->sites[c->site_count++] = (tn_open_site){symbol, *frame};
    return TN_OK;
}

static tn_status go_into(walk *w, uint32_t alternative)
{
    const tn_place_alternative *a = &w->choices->rules->alternatives[alternative];
    if (w->depth == DEPTH_MAX)
        return not_a_kit(w->error);
    w->at[w->depth].next = a->first;
    w->at[w->depth++].end = a->first + a->count;
    return TN_OK;
}

static tn_status expand(walk *w, const tn_frame *frame, uint32_t index)
{
    const tn_place_symbol *symbol = &w->choices->rules->symbols[index];
    if (symbol->drawn)
        return not_a_kit(w->error);
    if (symbol->count > 1)
        return add_site(w, frame, index);
    w->body = w->body == UINT32_MAX ? index : w->body;
    return go_into(w, symbol->first);
}

static tn_status take_step(walk *w, const tn_step *step)
{
    tn_frame *frame = w->frame_count ? &w->frames[w->frame_count - 1] : NULL;
    if (!frame)
        return not_a_kit(w->error);
    switch (step->kind) {
    case TN_STEP_PUSH:
        if (w->frame_count == DEPTH_MAX)
            return not_a_kit(w->error);
        w->frames[w->frame_count] = *frame;
        w->frame_count++;
        return TN_OK;
    case TN_STEP_POP:
        w->frame_count--;
        return TN_OK;
    case TN_STEP_PART:
        return add_part(w, frame, step->text);
    case TN_STEP_BLOCK: /* the part that follows says the same */
        return TN_OK;
    case TN_STEP_EXPAND:
        return expand(w, frame, step->index);
    case TN_STEP_MOVE:
    case TN_STEP_TURN:
    case TN_STEP_COLOUR:
        return tn_frame_step(frame, step) ? TN_OK : not_a_kit(w->error);
    default:
        return not_a_kit(w->error);
    }
}

/* Adds the parts and sites of an alternative; colour: what the head has. */
static tn_status walk_alternative(walk *w, uint32_t alternative, int32_t colour)
{
    uint64_t taken = 0;
    w->frames[0] = (tn_frame){.colour = colour};
    w->frame_count = 1;
    w->depth = 0;
    w->body = UINT32_MAX;
    tn_status status = go_into(w, alternative);
    while (status == TN_OK && w->depth > 0) {
        if (w->at[w->depth - 1].next == w->at[w->depth - 1].end) {
            w->depth--;
            continue;
        }
        if (++taken > ITEMS_MAX)
            return not_a_kit(w->error);
        status = take_step(w, &w->choices->rules->steps[w->at[w->depth - 1].next++]);
    }
    return status;
}

/* ---- choices */

static void set_around(tn_site_choices *c, tn_site_choice *choice)
{
    for (uint32_t h = 0; h < 4; h++) {
        const tn_frame base = {.heading = h};
        tn_cell_box all = {{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
        for (uint32_t i = 0; i < choice->part_count; i++) {
            const tn_chosen_part *part = &c->parts[choice->part_first + i];
            tn_frame frame = tn_frame_from(&base, &part->frame);
            tn_cell_box all_of = tn_kind_all(&c->kinds[part->kind], frame.heading);
            tn_cell_box box = tn_box_from(&all_of, frame.at);
            tn_cell_box_widen(&all, &box);
        }
        choice->around[h] = all;
    }
}

static tn_status add_choice(walk *w, uint32_t alternative, int32_t colour)
{
    tn_site_choices *c = w->choices;
    const tn_place_alternative *a = &c->rules->alternatives[alternative];
    tn_site_choice choice = {.part_first = (uint32_t)c->part_count,
                             .site_first = (uint32_t)c->site_count,
                             .member = a->member,
                             .weight = a->weight};
    tn_status status = walk_alternative(w, alternative, colour);
    if (status != TN_OK)
        return status;
    if (c->choice_count == ITEMS_MAX)
        return too_many(w->error);
    if (!tn_array_reserve(&c->choices, &c->choice_capacity, c->choice_count, 1, sizeof *c->choices))
        return tn_fail_memory(w->error);
    choice.part_count = (uint32_t)c->part_count - choice.part_first;
    choice.site_count = (uint32_t)c->site_count - choice.site_first;
    choice.body = w->body == UINT32_MAX ? alternative : w->body;
    set_around(c, &choice);
    c->choices[c->choice_count++] = choice;
    return TN_OK;
}

/* The box that every choice fills, where each is one box; and the box around all. */
static void set_boxes(tn_site_choices *c, tn_choice_symbol *symbol)
{
    for (uint32_t h = 0; h < 4; h++) {
        tn_cell_box common = {{INT32_MIN, INT32_MIN, INT32_MIN}, {INT32_MAX, INT32_MAX, INT32_MAX}};
        tn_cell_box around = {{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
        bool solid = symbol->count > 0 && !symbol->may_stay_open;
        for (uint32_t i = 0; i < symbol->count; i++) {
            const tn_site_choice *choice = &c->choices[symbol->first + i];
            solid &= choice->part_count == 1 && c->kinds[c->parts[choice->part_first].kind].record->box_count == 1;
            tn_cell_box_widen(&around, &choice->around[h]);
            for (int k = 0; k < 3; k++) {
                common.low[k] = choice->around[h].low[k] > common.low[k] ? choice->around[h].low[k] : common.low[k];
                common.high[k] =
                    choice->around[h].high[k] < common.high[k] ? choice->around[h].high[k] : common.high[k];
            }
        }
        symbol->around[h] = around;
        symbol->common[h] = solid ? common : (tn_cell_box){{0}, {0}};
    }
}

/* The last alternative, which leaves the connector open, is no choice. */
static tn_status make_symbol(walk *w, uint32_t index, int32_t colour)
{
    tn_site_choices *c = w->choices;
    const tn_place_symbol *from = &c->rules->symbols[index];
    tn_choice_symbol *symbol = &c->symbols[index];
    tn_status status = TN_OK;
    symbol->first = (uint32_t)c->choice_count;
    if (from->count == 1 || from->drawn)
        return TN_OK;
    for (uint32_t i = 0; i + 1 < from->count && status == TN_OK; i++) {
        status = add_choice(w, from->first + i, colour);
        if (status != TN_OK)
            return status;
        const tn_site_choice *last = &c->choices[c->choice_count - 1];
        symbol->may_stay_open |= last->part_count == 0;
        c->choice_count -= last->part_count == 0;
        if (symbol->may_stay_open)
            break; /* nothing comes after what always fits */
    }
    symbol->count = (uint32_t)c->choice_count - symbol->first;
    set_boxes(c, symbol);
    return status;
}

/* ---- what may stand where */

uint64_t tn_choice_key(const tn_site_choices *choices, const tn_site_choice *choice, const tn_frame *at,
                       const int32_t from[3])
{
    uint64_t key = tn_mix64(choice->body);
    for (uint32_t i = 0; i < choice->part_count; i++) {
        const tn_chosen_part *part = &choices->parts[choice->part_first + i];
        const tn_kind_of_part *kind = &choices->kinds[part->kind];
        tn_frame frame = tn_frame_from(at, &part->frame);
        const tn_cell_box all = tn_kind_all(kind, frame.heading);
        for (int k = 0; k < 3; k++)
            key = tn_mix64(key ^ (uint32_t)(frame.at[k] + all.low[k] - from[k]));
        key = tn_mix64(key ^ ((uint64_t)part->kind << 5 | kind->shape[frame.heading]));
    }
    return key;
}

static uint64_t at_site(const tn_open_site *site, uint64_t key)
{
    key = tn_mix64(key ^ ((uint64_t)site->symbol << 5 | site->frame.heading));
    return key ? key : 1;
}

static size_t slot_of(const tn_site_choices *choices, uint64_t key)
{
    size_t slot = (size_t)key & (choices->known_size - 1);
    while (choices->known[slot] && choices->known[slot] != key)
        slot = (slot + 1) & (choices->known_size - 1);
    return slot;
}

static tn_status know_all(tn_site_choices *c, tn_error *error)
{
    uint32_t turns = tn_place_turns(c->rules->module);
    c->known_size = 64;
    while (c->known_size < 2 * (size_t)turns * c->choice_count)
        c->known_size *= 2;
    c->known = calloc(c->known_size, sizeof *c->known);
    if (!c->known)
        return tn_fail_memory(error);
    for (uint32_t s = 0; s < c->symbol_count; s++) {
        for (uint32_t i = 0; i < c->symbols[s].count; i++) {
            for (uint32_t h = 0; h < turns; h++) {
                const tn_open_site site = {s, {.heading = h}};
                uint64_t key = tn_choice_key(c, &c->choices[c->symbols[s].first + i], &site.frame, site.frame.at);
                key = at_site(&site, key);
                c->known[slot_of(c, key)] = key;
            }
        }
    }
    return TN_OK;
}

bool tn_choice_may_stand(const tn_site_choices *choices, const tn_open_site *site, const tn_site_choice *choice,
                         const tn_frame *at)
{
    uint64_t key = at_site(site, tn_choice_key(choices, choice, at, site->frame.at));
    return choices->known[slot_of(choices, key)] == key;
}

/* ---- all */

/* The start's colour is that of parts without one. */
static int32_t start_colour(const tn_place_rules *rules)
{
    const tn_place_alternative *start = &rules->alternatives[rules->symbols[rules->start].first];
    const tn_step *first = &rules->steps[start->first];
    return start->count > 0 && first->kind == TN_STEP_COLOUR ? first->a[0] : 1;
}

/* Parts that the start itself places are one more choice, which is put before all others. */
static tn_status add_standing(walk *w, size_t part_first)
{
    tn_site_choices *c = w->choices;
    tn_site_choice choice = {.part_first = (uint32_t)part_first,
                             .part_count = (uint32_t)(c->part_count - part_first),
                             .site_first = (uint32_t)c->start_first,
                             .site_count = (uint32_t)(c->site_count - c->start_first),
                             .body = UINT32_MAX};
    if (choice.part_count == 0)
        return TN_OK;
    if (!tn_array_reserve(&c->choices, &c->choice_capacity, c->choice_count, 1, sizeof *c->choices))
        return tn_fail_memory(w->error);
    set_around(c, &choice);
    c->standing = (uint32_t)c->choice_count;
    c->choices[c->choice_count++] = choice;
    return TN_OK;
}

tn_status tn_site_choices_make(const tn_place_rules *rules, tn_site_choices *choices, tn_error *error)
{
    walk w = {.choices = choices, .error = error};
    int32_t colour = start_colour(rules);
    *choices = (tn_site_choices){.rules = rules, .symbol_count = rules->symbol_count, .standing = TN_NONE_STANDS};
    choices->symbols = calloc(rules->symbol_count, sizeof *choices->symbols);
    if (!choices->symbols)
        return tn_fail_memory(error);
    tn_status status = tn_kinds_make(choices, error);
    for (uint32_t i = 0; i < rules->symbol_count && status == TN_OK; i++)
        status = make_symbol(&w, i, colour);
    choices->start_first = choices->site_count;
    size_t part_first = choices->part_count;
    if (status == TN_OK && rules->symbols[rules->start].count > 1)
        status = not_a_kit(error);
    if (status == TN_OK)
        status = walk_alternative(&w, rules->symbols[rules->start].first, colour);
    if (status == TN_OK)
        status = add_standing(&w, part_first);
    return status == TN_OK ? know_all(choices, error) : status;
}

void tn_site_choices_clear(tn_site_choices *choices)
{
    free(choices->kinds);
    free(choices->boxes);
    free(choices->symbols);
    free(choices->choices);
    free(choices->parts);
    free(choices->sites);
    free(choices->known);
    *choices = (tn_site_choices){0};
}
