/* What rules of kits place: an alternative stands for all placements of its first part whose connectors join. */
#include <stdlib.h>
#include <string.h>

#include "compiler/common/diagnostic.h"
#include "compiler/kit/kit.h"
#include "runtime/place/model/frame.h"

/* ---- what is alike when it is turned */

/* A box, or a connector, of an alternative that was turned. */
typedef struct feature {
    int32_t v[7];
} feature;

static int compare(const void *a, const void *b)
{
    const feature *one = a, *other = b;
    for (int i = 0; i < 7; i++)
        if (one->v[i] != other->v[i])
            return one->v[i] < other->v[i] ? -1 : 1;
    return 0;
}

static const tn_kit_part *part_of(tn_kit *kit, const tn_kit_node *placed)
{
    return tn_names_get(&kit->parts, placed->name.text);
}

bool tn_kit_offset(tn_kit *kit, const tn_kit_node *placed, int32_t at[3], uint32_t *turns)
{
    int64_t value, count = 0;
    bool right = true;
    for (int k = 0; k < 3; k++) {
        at[k] = 0;
        if (!placed->at.given)
            continue;
        right &= tn_kit_measure(kit, &placed->at.at[k], &value) &&
                 tn_kit_cells(kit, placed->at.at[k].span, k == 1 ? -value : value, k, 1, "the part lies at", &at[k]);
    }
    if (tn_kit_given(&placed->count[1]))
        right &= tn_kit_whole(kit, &placed->count[1], 0, 3, "a turn", &count);
    *turns = (uint32_t)count;
    return right;
}

static size_t count_features(tn_kit *kit, const tn_kit_node *places)
{
    size_t count = 0;
    for (const tn_kit_node *placed = places->inner.first; placed; placed = placed->next)
        count += part_of(kit, placed)->box_count + part_of(kit, placed)->joint_count;
    return count;
}

static bool joins(const tn_kit_type *a, const tn_kit_type *b)
{
    return a->joins == b || b->joins == a;
}

/* How many of the four turns a connector does not tell apart, whatever it joins. */
static uint32_t turns_alike(const tn_kit *kit, const tn_kit_type *type)
{
    uint32_t turns = type->turns;
    for (const tn_kit_type *other = kit->type_list.first; other; other = other->next)
        if (joins(type, other) && other->turns < turns)
            turns = other->turns;
    return turns;
}

static void add_feature(const tn_kit *kit, feature *to, const tn_kit_box *box, const tn_kit_joint *joint,
                        uint32_t turns, const int32_t by[3])
{
    int32_t a[3], b[3];
    const int32_t *low = joint ? joint->at : box->low, *high = joint ? joint->at : box->high;
    tn_turn_place(turns, low, a);
    tn_turn_place(turns, high, b);
    for (int k = 0; k < 3; k++) {
        to->v[1 + k] = by[k] + (a[k] < b[k] ? a[k] : b[k]);
        to->v[4 + k] = by[k] + (a[k] < b[k] ? b[k] : a[k]);
    }
    to->v[0] = -1;
    if (!joint)
        return;
    /* what is beside the axis tells how far it is turned about it: alike are all, opposite ones, or none */
    uint32_t axis = tn_axis_turn(joint->axis, turns), beside = tn_axis_turn(tn_axis_beside(joint->axis), turns),
             alike = turns_alike(kit, joint->type),
             about = alike == 4   ? 0
                     : alike == 2 ? beside / 2
                                  : beside;
    to->v[0] = (int32_t)((joint->type->index * TN_AXIS_COUNT + axis) * TN_AXIS_COUNT + about);
}

/* All features of the alternative, turned, moved so that the lowest coordinates are 0 (which were `low`), and sorted.
 */
static void list_features(tn_kit *kit, const tn_kit_node *places, uint32_t turns, feature *features, size_t count,
                          int32_t low[3])
{
    feature *next = features;
    for (const tn_kit_node *placed = places->inner.first; placed; placed = placed->next) {
        const tn_kit_part *part = part_of(kit, placed);
        int32_t at[3], by[3];
        uint32_t own;
        tn_kit_offset(kit, placed, at, &own);
        tn_turn_place(turns, at, by);
        for (uint32_t i = 0; i < part->box_count; i++)
            add_feature(kit, next++, &part->boxes[i], NULL, tn_turn_after(turns, own), by);
        for (uint32_t i = 0; i < part->joint_count; i++)
            add_feature(kit, next++, NULL, &part->joints[i], tn_turn_after(turns, own), by);
    }
    for (int k = 0; k < 3; k++) {
        low[k] = INT32_MAX;
        for (size_t i = 0; i < count; i++)
            low[k] = features[i].v[1 + k] < low[k] ? features[i].v[1 + k] : low[k];
        for (size_t i = 0; i < count; i++) {
            features[i].v[1 + k] -= low[k];
            features[i].v[4 + k] -= low[k];
        }
    }
    qsort(features, count, sizeof *features, compare);
}

/* Turned so often, the alternative is what it was, moved by this. */
typedef struct symmetry {
    bool alike[TN_TURNS];
    int32_t by[TN_TURNS][3];
} symmetry;

static symmetry find_symmetry(tn_kit *kit, const tn_kit_node *places)
{
    symmetry found = {{true}, {{0}}};
    size_t count = count_features(kit, places);
    feature *plain = TN_NEW_ARRAY(kit->arena, feature, count + 1),
            *turned = TN_NEW_ARRAY(kit->arena, feature, count + 1);
    int32_t low[3], lows[3];
    if (!plain || !turned)
        return found;
    list_features(kit, places, 0, plain, count, low);
    for (uint32_t t = 1; t < kit->turns; t++) {
        list_features(kit, places, t, turned, count, lows);
        found.alike[t] = memcmp(plain, turned, count * sizeof *plain) == 0;
        for (int k = 0; k < 3; k++)
            found.by[t][k] = lows[k] - low[k];
    }
    return found;
}

/* The same placement in the first of the turns that look alike: a turn that is alike is undone before it. */
static tn_kit_placement simplest(const symmetry *like, tn_kit_placement p)
{
    tn_kit_placement best = p;
    for (uint32_t t = 1; t < TN_TURNS; t++) {
        uint32_t before = like->alike[t] ? tn_turn_after(p.turns, tn_turn_back(t)) : best.turns;
        int32_t by[3];
        if (before >= best.turns)
            continue;
        tn_turn_place(before, like->by[t], by);
        best.turns = before;
        for (int k = 0; k < 3; k++)
            best.move[k] = p.move[k] + by[k];
    }
    return best;
}

/* ---- placements */

static const tn_axis sides[TN_KIT_SIDE_COUNT] = {TN_AXIS_UP, TN_AXIS_DOWN, TN_AXIS_RIGHT};

/* Does a connector of a part, turned so, face a connector of this side, which is looked at as tn_kit_side_of says, when
 * so many of the four quarter turns about it are alike? */
static bool faces(const tn_kit_joint *joint, tn_kit_side side, uint32_t turns, uint32_t alike)
{
    return tn_axis_turn(joint->axis, turns) == tn_axis_opposite(sides[side]) &&
           tn_turns_fit(tn_axis_turn(tn_axis_beside(joint->axis), turns), tn_axis_beside(sides[side]), alike);
}

/* The turn of a part in which its connector faces one of this side, and is not turned against it; all turns of the kit
 * where there is none. */
static uint32_t straight(const tn_kit *kit, const tn_kit_joint *joint, tn_kit_side side)
{
    uint32_t turns = 0;
    while (turns < kit->turns && !faces(joint, side, turns, 1))
        turns++;
    return turns;
}

static bool is_new(const tn_kit_placement *seen, uint32_t count, const tn_kit_placement *one)
{
    for (uint32_t i = 0; i < count; i++)
        if (seen[i].turns == one->turns && memcmp(seen[i].move, one->move, sizeof one->move) == 0)
            return false;
    return true;
}

tn_kit_placement *tn_kit_placements(tn_kit *kit, const tn_kit_node *places, const tn_kit_type *type, tn_kit_side side,
                                    uint32_t *count)
{
    const tn_kit_part *part = part_of(kit, places->inner.first);
    symmetry like = find_symmetry(kit, places);
    size_t most = kit->turns * (size_t)part->joint_count + 1;
    tn_kit_placement *all = TN_NEW_ARRAY(kit->arena, tn_kit_placement, most);
    tn_kit_placement *seen = TN_NEW_ARRAY(kit->arena, tn_kit_placement, most);
    *count = 0;
    if (!all || !seen)
        return NULL;
    for (uint32_t j = 0; j < part->joint_count; j++) {
        const tn_kit_joint *joint = &part->joints[j];
        uint32_t first = straight(kit, joint, side),
                 alike = joint->type->turns < type->turns ? joint->type->turns : type->turns;
        for (uint32_t quarters = 0; first < kit->turns && quarters < TN_UPRIGHT_TURNS; quarters++) {
            uint32_t t = tn_turn_after(quarters, first);
            if (!joins(joint->type, type) || !faces(joint, side, t, alike))
                continue;
            tn_kit_placement p = {.turns = t};
            tn_turn_place(t, joint->at, p.move);
            for (int k = 0; k < 3; k++)
                p.move[k] = -p.move[k];
            tn_kit_placement simple = simplest(&like, p);
            if (!is_new(seen, *count, &simple))
                continue;
            seen[*count] = simple;
            all[(*count)++] = p;
        }
    }
    return all;
}

/* ---- checking */

bool tn_kit_rule_takes(const tn_kit_rule *rule, const tn_kit_type *type)
{
    for (const tn_kit_node *at = rule->node->outer.first; at; at = at->next)
        if (strcmp(at->name.text, type->node->name.text) == 0)
            return true;
    return false;
}

static bool check_placed(tn_kit *kit, const tn_kit_node *placed, bool first)
{
    size_t errors = kit->diagnostics->error_count;
    int64_t colour;
    int32_t at[3];
    uint32_t turns;
    bool known = part_of(kit, placed) != NULL;
    if (!known) {
        tn_kit_unknown(kit, &kit->parts, "part", placed->name.span, placed->name.text,
                       "parts are told by `part 3005 { ... }`, or in a file that is used: `use \"bricks\";`");
    }
    for (const tn_kit_node *next = placed->outer.first; next; next = next->next) {
        if (tn_names_get(&kit->rules, next->name.text))
            continue;
        tn_kit_unknown(kit, &kit->rules, "rule", next->name.span, next->name.text,
                       "`with` names the rule that goes on at the part's connectors");
    }
    if (placed->outer.first && placed->stops) {
        tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_RULE, placed->span,
                                     "`stop` ends a branch here, and `with` continues it by a rule");
        tn_help(kit->diagnostics, d, "leave out `stop`, or `with %.60s`", placed->outer.first->name.text);
    }
    if (tn_kit_given(&placed->count[0]))
        tn_kit_whole(kit, &placed->count[0], 0, TN_PLACE_COLOUR_MAX, "a colour", &colour);
    if (first && (placed->at.given || tn_kit_given(&placed->count[1]))) {
        tn_diagnostic *d =
            tn_report(kit->diagnostics, E_KIT_RULE, placed->span, "where this part goes is found by its connectors");
        tn_help(kit->diagnostics, d,
                "leave out `at` and `turn`: only the second and later parts of an alternative in braces have them");
    }
    tn_kit_offset(kit, placed, at, &turns);
    return known && kit->diagnostics->error_count == errors; /* of names that errors took away nothing is said */
}

/* Parts of one alternative may not be in each other's way. */
static void check_overlap(tn_kit *kit, const tn_kit_node *places)
{
    size_t count = count_features(kit, places), boxes = 0;
    feature *all = TN_NEW_ARRAY(kit->arena, feature, count + 1);
    int32_t low[3];
    if (!all)
        return;
    list_features(kit, places, 0, all, count, low);
    while (boxes < count && all[boxes].v[0] < 0)
        boxes++; /* boxes come first */
    for (size_t i = 0; i < boxes; i++) {
        for (size_t j = 0; j < i; j++) {
            bool over = true;
            for (int k = 0; k < 3; k++)
                over &= all[i].v[1 + k] < all[j].v[4 + k] && all[j].v[1 + k] < all[i].v[4 + k];
            if (!over)
                continue;
            tn_diagnostic *d =
                tn_report(kit->diagnostics, E_KIT_RULE, places->span, "parts of this alternative overlap");
            tn_help(kit->diagnostics, d, "give all but the first a place that is free: `at (0, 1 brick, 0)`");
            return;
        }
    }
}

static bool joins_here(tn_kit *kit, const tn_kit_rule *rule, const tn_kit_node *placed)
{
    const tn_kit_part *part = part_of(kit, placed);
    for (uint32_t j = 0; j < part->joint_count; j++) {
        for (const tn_kit_node *at = rule->node->outer.first; at; at = at->next) {
            const tn_kit_type *type = tn_names_get(&kit->types, at->name.text);
            if (type && joins(part->joints[j].type, type))
                return true;
        }
    }
    return false;
}

static void check_places(tn_kit *kit, const tn_kit_rule *rule, const tn_kit_node *places)
{
    bool right = true;
    for (const tn_kit_node *placed = places->inner.first; placed; placed = placed->next)
        right &= check_placed(kit, placed, placed == places->inner.first);
    if (!right || !places->inner.first || tn_arena_failed(kit->arena))
        return;
    check_overlap(kit, places);
    if (kit->damaged || part_of(kit, places->inner.first)->wrong || joins_here(kit, rule, places->inner.first))
        return;
    tn_diagnostic *d = tn_report(kit->diagnostics, W_KIT_JOINS_NOTHING, places->inner.first->name.span,
                                 "part %.100s joins none of the connectors of rule %.100s",
                                 places->inner.first->name.text, rule->node->name.text);
    tn_help(kit->diagnostics, d, "it is never placed here: leave it out, or add a connector that it joins after `at`");
}

void tn_kit_check_rule(tn_kit *kit, const tn_kit_rule *rule)
{
    for (const tn_kit_node *at = rule->node->outer.first; at; at = at->next) {
        if (tn_names_get(&kit->types, at->name.text))
            continue;
        tn_kit_unknown(kit, &kit->types, "connector", at->name.span, at->name.text,
                       "a connector is told by `connector stud joins tube;`");
    }
    for (const tn_kit_node *one = rule->node->inner.first; one; one = one->next) {
        if (one->kind == TN_KIT_PLACES)
            check_places(kit, rule, one);
        double sum = 0;
        for (const tn_kit_node *drawn = one->inner.first; one->kind == TN_KIT_DRAWN && drawn; drawn = drawn->next) {
            check_places(kit, rule, drawn);
            double weight = tn_kit_number(kit, &drawn->count[0]);
            tn_range_note(kit->diagnostics, drawn->count[0].span, 0, 1);
            sum += weight;
            if (weight <= 1)
                continue;
            tn_diagnostic *d =
                tn_report(kit->diagnostics, E_KIT_NUMBER, drawn->count[0].span, "a weight is from 0 to 1");
            tn_help(kit->diagnostics, d, "weights count against each other: 3 to 1 is [0.75] and [0.25]");
        }
        if (one->kind == TN_KIT_DRAWN && !(sum > 0)) {
            tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_NUMBER, one->span, "all of these have the weight 0");
            tn_help(kit->diagnostics, d, "give one of them a weight above 0");
        }
    }
}
