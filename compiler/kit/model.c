/* What models and tests of kits ask for: a space that has an end, where to start, and conditions; how they are searched
 * for; and models that are named, whose parts stand where a file has them. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/common/limits.h"
#include "compiler/kit/kit.h"
#include "runtime/place/cells.h"
#include "runtime/place/read.h"

/* ==== what models of kits say of how they are searched for: an objective, a way of searching, images, a stock */

/* Says that a line is there twice; false if it is the first. */
static bool is_twice(tn_kit *kit, const tn_kit_node *first, const tn_kit_node *node, const char *word, const char *help)
{
    if (!first)
        return false;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_TWICE, node->span, "%s is there twice", word);
    tn_note(kit->diagnostics, d, &first->span, "the first is here");
    tn_help(kit->diagnostics, d, "%s", help);
    return true;
}

static void check_objective(tn_kit *kit, tn_kit_model *model, const tn_kit_node *node)
{
    if (is_twice(kit, model->objective, node, "what is to be small or large",
                 "write one sum: `minimize elements + 10 * cuts;`"))
        return;
    model->objective = node;
    tn_kit_check_conditions(kit, node);
}

/* ---- searching */

static const struct {
    const char *word, *what;
    tn_kit_search search;
    int64_t most; /* of its amount; 0: it has none */
} ways[] = {
    {"greedy", "", TN_SEARCH_GREEDY, 0},
    {"beam", "how many plans are kept", TN_SEARCH_BEAM, TN_BEAM_MAX},
    {"anneal", "how many rounds there are", TN_SEARCH_ANNEAL, TN_SEARCH_MAX},
    {"exact", "", TN_SEARCH_EXACT, 0},
};
enum { WAYS = sizeof ways / sizeof *ways };

static void check_way(tn_kit *kit, tn_kit_model *model, const tn_kit_node *node)
{
    const char *words[WAYS];
    size_t way = 0;
    if (is_twice(kit, model->searches, node, "`search`", "leave one out"))
        return;
    model->searches = node;
    if (!node->name.text)
        return;
    while (way < WAYS && strcmp(ways[way].word, node->name.text) != 0)
        way++;
    for (size_t i = 0; i < WAYS; i++)
        words[i] = ways[i].word;
    if (way == WAYS) {
        const char *near = tn_nearest(node->name.text, words, WAYS);
        tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_SEARCH, node->name.span,
                                     "there is no way of searching called `%.100s`", node->name.text);
        if (near)
            tn_suggest(kit->diagnostics, d, "%s", near);
        else
            tn_help(kit->diagnostics, d, "there is: greedy, beam, anneal, exact");
        return;
    }
    bool given = tn_kit_given(&node->count[0]);
    model->search = ways[way].search;
    if (given && ways[way].most > 0) {
        tn_kit_whole(kit, &node->count[0], 1, ways[way].most, "an amount", &model->amount);
    } else if (given != (ways[way].most > 0)) {
        tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_SEARCH, node->span, "`search %s` %s a number", words[way],
                                     given ? "does not take" : "lacks");
        if (given)
            tn_help(kit->diagnostics, d, "write `search %s;`", words[way]);
        else
            tn_help(kit->diagnostics, d, "write %s: `search %s %s;`", ways[way].what, words[way],
                    ways[way].search == TN_SEARCH_BEAM ? "50" : "10000");
    }
}

/* ---- images */

static void check_symmetry(tn_kit *kit, tn_kit_model *model, const tn_kit_node *node)
{
    if (is_twice(kit, model->repeats, node, "`symmetry`", "leave one out"))
        return;
    model->repeats = node;
    if (tn_kit_given(&node->count[0])) {
        int64_t turns;
        if (tn_kit_whole(kit, &node->count[0], 2, 4, "a symmetry", &turns) && turns != 3) {
            model->symmetry = turns == 2 ? TN_SYMMETRY_TURN_2 : TN_SYMMETRY_TURN_4;
            return;
        }
    } else if (node->name.text && strcmp(node->name.text, "mirror") == 0 && node->other.text &&
               (strcmp(node->other.text, "x") == 0 || strcmp(node->other.text, "z") == 0)) {
        model->symmetry = *node->other.text == 'x' ? TN_SYMMETRY_MIRROR_X : TN_SYMMETRY_MIRROR_Z;
        return;
    }
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_SEARCH, node->span, "there is no such symmetry");
    tn_help(kit->diagnostics, d, "there is: symmetry turn 2, turn 4, mirror x, mirror z");
}

/* ---- orders */

static void check_order(tn_kit *kit, tn_kit_model *model, const tn_kit_node *node)
{
    static const char *const words[] = {"depth", "breadth"};
    if (is_twice(kit, model->orders, node, "`order`", "leave one out"))
        return;
    model->orders = node;
    if (!node->name.text)
        return;
    model->breadth = strcmp(node->name.text, words[1]) == 0;
    if (model->breadth || strcmp(node->name.text, words[0]) == 0)
        return;
    tn_diagnostic *d =
        tn_report(kit->diagnostics, E_KIT_ORDER, node->name.span, "there is no order `%.100s`", node->name.text);
    const char *near = tn_nearest(node->name.text, words, 2);
    if (near)
        tn_suggest(kit->diagnostics, d, "%s", near);
    else
        tn_help(kit->diagnostics, d, "there is: order depth, order breadth");
}

static void check_steps(tn_kit *kit, tn_kit_model *model, const tn_kit_node *node)
{
    static const char *const words[] = {"part", "layer"};
    if (is_twice(kit, model->divides, node, "`steps`", "leave one out"))
        return;
    model->divides = node;
    model->steps = TN_STEPS_PARTS;
    model->step_parts = 1;
    if (tn_kit_given(&node->count[0])) {
        tn_kit_whole(kit, &node->count[0], 1, TN_STEP_PARTS_MAX, "a step", &model->step_parts);
        return;
    }
    if (!node->name.text || strcmp(node->name.text, words[0]) == 0)
        return;
    model->steps = TN_STEPS_LAYERS;
    if (strcmp(node->name.text, words[1]) == 0)
        return;
    tn_diagnostic *d =
        tn_report(kit->diagnostics, E_KIT_ORDER, node->name.span, "there are no steps `%.100s`", node->name.text);
    const char *near = tn_nearest(node->name.text, words, 2);
    if (near)
        tn_suggest(kit->diagnostics, d, "%s", near);
    else
        tn_help(kit->diagnostics, d, "there is: steps part, steps layer, steps 5");
}

/* ---- stock */

static void check_stocked(tn_kit *kit, const tn_kit_node *stocks, const tn_kit_node *node)
{
    int64_t most;
    if (!tn_names_get(&kit->parts, node->name.text)) {
        tn_kit_unknown(kit, &kit->parts, "part", node->name.span, node->name.text,
                       "parts are told by `part 3005 { ... }`, or in a file that is used");
    }
    for (const tn_kit_node *other = stocks->inner.first; other != node; other = other->next)
        if (strcmp(other->name.text, node->name.text) == 0)
            is_twice(kit, other, node, "the stock of this part", "leave one out");
    tn_kit_whole(kit, &node->count[0], 0, UINT32_MAX, "a stock", &most);
}

static void check_stock(tn_kit *kit, tn_kit_model *model, const tn_kit_node *node)
{
    if (is_twice(kit, model->stocks, node, "`stock`", "join the two by a comma: `stock 3001 <= 20, 3004 <= 5;`"))
        return;
    model->stocks = node;
    for (const tn_kit_node *one = node->inner.first; one; one = one->next)
        if (one->name.text)
            check_stocked(kit, node, one);
}

static void kit_check_search(tn_kit *kit, tn_kit_model *model, const tn_kit_node *node)
{
    switch (node->kind) {
    case TN_KIT_MINIMIZES:
    case TN_KIT_MAXIMIZES:
        check_objective(kit, model, node);
        break;
    case TN_KIT_SEARCHES:
        check_way(kit, model, node);
        break;
    case TN_KIT_REPEATS:
        check_symmetry(kit, model, node);
        break;
    case TN_KIT_ORDERS:
        check_order(kit, model, node);
        break;
    case TN_KIT_STEPS:
        check_steps(kit, model, node);
        break;
    default:
        check_stock(kit, model, node);
        break;
    }
}

/* Placing greedily finds one model: there is none to choose from. */
static void kit_check_searches(tn_kit *kit, const tn_kit_model *model)
{
    if (!model->objective || model->searches)
        return;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_SEARCH, model->objective->span,
                                 "this needs a search: one model alone is neither small nor large");
    tn_help(kit->diagnostics, d, "add `search beam 50;` or `search anneal 10000;`");
}

/* ==== models that a kit names: their parts are those of the kit, and stand where the file has them */

static void cannot_stand(tn_kit *kit, const tn_kit_node *node, const char *part, const char *what, const char *help)
{
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_STANDS, node->doc.span, "part %.100s of `%.200s` %s", part,
                                 node->doc.text, what);
    tn_help(kit->diagnostics, d, "%s", help);
}

/* The first part that cannot be placed is said; so a file of another kit is not complained of a thousand times. */
static bool is_right(tn_kit *kit, const tn_kit_node *node, const tn_ldraw *ldraw)
{
    if (ldraw->tilted)
        cannot_stand(kit, node, ldraw->first_tilted, "is turned in a way in which this kit turns no part",
                     "leave it out of the file");
    else if (ldraw->beside)
        cannot_stand(kit, node, ldraw->first_beside, "lies beside the cells of the kit",
                     "move it onto them, or use a kit with smaller cells");
    else if (ldraw->model.count > TN_KIT_STANDS_MAX)
        cannot_stand(kit, node, ldraw->model.parts[TN_KIT_STANDS_MAX].name, "is one too many",
                     "at most 100,000 parts of a file can stand");
    else
        return true;
    return false;
}

static const tn_kit_part *part_of(tn_kit *kit, const tn_kit_node *node, const char *name)
{
    const tn_kit_part *part = tn_names_get(&kit->parts, name);
    for (const tn_kit_part *other = kit->part_list.first; other && !part; other = other->next)
        if (strcasecmp(other->node->name.text, name) == 0)
            part = other; /* names of LDraw files are the same in capitals or not */
    if (part)
        return part;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_STANDS, node->doc.span,
                                 "`%.200s` has the part %.100s, which is none of this kit's", node->doc.text, name);
    tn_kit_suggest(kit, d, &kit->parts, name, "add it to the kit by `part`, or leave it out of the file");
    return NULL;
}

tn_cell_box tn_kit_box_of(const tn_kit_stands *one, uint32_t index)
{
    const tn_frame frame = {.at = {one->at[0], one->at[1], one->at[2]}, .heading = one->heading};
    const tn_kit_box *box = &one->part->boxes[index];
    tn_step step = {.kind = TN_STEP_BLOCK};
    memcpy(step.a, box->low, sizeof step.a);
    memcpy(step.b, box->high, sizeof step.b);
    return tn_frame_box(&frame, &step);
}

/* Parts of a file may not be in each other's way. */
static bool has_room(tn_kit *kit, const tn_kit_node *node, const tn_kit_stands *one, tn_cells *cells)
{
    tn_error error;
    for (uint32_t i = 0; i < one->part->box_count; i++) {
        tn_cell_box box = tn_kit_box_of(one, i);
        if (tn_cells_any(cells, &box)) {
            cannot_stand(kit, node, one->part->node->name.text, "overlaps another",
                         "`tartan inspect` shows where; move one of them, or leave it out");
            return false;
        }
        if (tn_cells_fill(cells, &box, &error) != TN_OK) {
            kit->out_of_memory = true;
            return false;
        }
    }
    return true;
}

static void take_parts(tn_kit *kit, const tn_kit_node *node, const tn_ldraw *ldraw, tn_kit_parts *parts)
{
    tn_kit_parts taken = {.node = NULL};
    tn_cells *cells = tn_cells_new(NULL);
    bool right = cells != NULL;
    kit->out_of_memory |= !cells;
    for (size_t i = 0; i < ldraw->model.count && right; i++) {
        const tn_placed_part *from = &ldraw->model.parts[i];
        const tn_kit_part *part = part_of(kit, node, from->name);
        tn_kit_stands *one = part ? TN_NEW(kit->arena, tn_kit_stands) : NULL;
        right = one != NULL;
        if (!one)
            break;
        one->part = part;
        memcpy(one->at, from->frame.at, sizeof one->at);
        one->heading = from->frame.heading;
        one->colour = from->frame.colour;
        right = has_room(kit, node, one, cells);
        TN_CHAIN(&taken, one);
    }
    tn_cells_free(cells);
    if (!right)
        return;
    parts->first = taken.first;
    parts->last = taken.last;
}

/* Where files beside a model are looked for. */
typedef struct model_place {
    const tn_attachments *attachments;
    const char *path; /* of the model */
} model_place;

/* What cannot be had is no file: then the name is that of a part. */
static tn_status find_beside(void *context, const char *name, uint8_t **bytes, size_t *size, tn_error *error)
{
    const model_place *place = context;
    const tn_request request = {name, "", place->path};
    tn_status status = place->attachments->bytes(place->attachments->context, &request, bytes, size, error);
    return status == TN_MEMORY ? status : TN_OK;
}

/* The path of the model that a kit names. */
static const char *model_path(tn_kit *kit, const tn_request *request)
{
    const char *slash = request->path[0] == '/' ? NULL : strrchr(request->user, '/');
    size_t folder = slash ? (size_t)(slash + 1 - request->user) : 0, size = strlen(request->path) + 1;
    char *path = TN_NEW_ARRAY(kit->arena, char, folder + size);
    if (!path)
        return request->path; /* the arena remembers */
    memcpy(path, request->user, folder);
    memcpy(path + folder, request->path, size);
    return path;
}

static void read_parts(tn_kit *kit, const tn_kit_node *node, tn_kit_parts *parts)
{
    uint8_t *bytes = NULL;
    size_t size = 0;
    tn_ldraw ldraw = {0};
    tn_error error = {0};
    const tn_request request = tn_kit_request(kit, node);
    model_place place = {kit->attachments, model_path(kit, &request)};
    double unit[3];
    for (int k = 0; k < 3; k++)
        unit[k] = (double)kit->unit[k] / 1e6;
    tn_status status = kit->attachments->bytes(kit->attachments->context, &request, &bytes, &size, &error);
    if (status == TN_OK)
        status = tn_ldraw_read((const char *)bytes, size, unit, kit->turns, &(tn_ldraw_files){find_beside, &place},
                               &ldraw, &error);
    free(bytes);
    if (status == TN_OK && ldraw.model.count + ldraw.tilted + ldraw.beside == 0)
        status = tn_fail(&error, TN_INVALID, TN_CODE_NONE, "it has no parts");
    if (status != TN_OK)
        tn_kit_file_failed(kit, node, status, &error);
    else if (is_right(kit, node, &ldraw))
        take_parts(kit, node, &ldraw, parts);
    tn_ldraw_clear(&ldraw);
}

const tn_kit_parts *tn_kit_parts_of_file(tn_kit *kit, const tn_kit_node *node)
{
    tn_kit_parts *parts = kit->file_list.first;
    tn_error error;
    while (parts && parts->node != node)
        parts = parts->next;
    if (parts)
        return parts;
    parts = TN_NEW(kit->arena, tn_kit_parts);
    if (!parts)
        return NULL;
    parts->node = node;
    TN_CHAIN(&kit->file_list, parts);
    if (kit->attachments->bytes) {
        read_parts(kit, node, parts);
    } else {
        tn_fail(&error, TN_INVALID, TN_CODE_NONE, "no files can be read here");
        tn_kit_file_failed(kit, node, TN_INVALID, &error);
    }
    return parts;
}

/* ==== what models and tests of kits ask for: a space that has an end, where to start, and conditions */

const tn_expression_scope tn_kit_scope = {
    .names = tn_placed_terms,
    .count = TN_PLACED_X,
    .words = TN_WORDS_PLAIN,
    .what = "term",
    .examples = {"fill", "width, height", "width, height, depth"},
    .split = "write several: they are joined by a comma",
    .unknown = E_KIT_TERM,
    .wrong = E_KIT_EXPRESSION,
    .vocabulary = &tn_kit_words,
    .places = TN_KIT_AT(CONDITION) | TN_KIT_AT(EXPECTATION),
};

/* ---- conditions */

static uint32_t slot_of(tn_kit *kit, const tn_expression *e)
{
    uint32_t slot = 0;
    if (!tn_names_get(&kit->parts, e->name)) {
        tn_kit_unknown(kit, &kit->parts, "part", e->name_span, e->name,
                       "parts are told by `part 3005 { ... }`, or in a file that is used");
        return 0;
    }
    while (slot < kit->counted_count && strcmp(kit->counted[slot], e->name) != 0)
        slot++;
    if (slot == TN_KIT_COUNTED_MAX) {
        tn_diagnostic *d =
            tn_report(kit->diagnostics, E_KIT_TOO_MANY, e->span, "more than %u parts are counted", TN_KIT_COUNTED_MAX);
        tn_help(kit->diagnostics, d, "count fewer of them in this kit");
        return 0;
    }
    if (slot == kit->counted_count)
        kit->counted[kit->counted_count++] = e->name;
    return slot;
}

/* Counts of parts are terms that the scope does not name: they are numbers while the rest is checked. */
static void take_counts(tn_kit *kit, tn_expression *e)
{
    for (tn_expression *operand = e->first; operand; operand = operand->next)
        take_counts(kit, operand);
    if (e->op != TN_OP_PART)
        return;
    e->term = TN_PLACED_COUNTED + slot_of(kit, e);
    e->op = TN_OP_NUMBER;
}

static void give_counts(tn_expression *e)
{
    for (tn_expression *operand = e->first; operand; operand = operand->next)
        give_counts(operand);
    if (e->op == TN_OP_NUMBER && e->name)
        e->op = TN_OP_TERM;
}

void tn_kit_check_conditions(tn_kit *kit, const tn_kit_node *node)
{
    for (const tn_kit_node *condition = node->inner.first; condition; condition = condition->next) {
        tn_expression *e = condition->expression;
        if (!e)
            continue;
        if (e->depth <= TN_NESTING_MAX)
            take_counts(kit, e);
        tn_expression_check(kit->diagnostics, &tn_kit_scope, e);
        if (e->depth <= TN_NESTING_MAX)
            give_counts(e);
    }
}

/* ---- models */

static void lacks(tn_kit *kit, const tn_kit_model *model, const char *what, const char *help)
{
    if (kit->damaged)
        return;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_MODEL, model->node->name.span, "model %.100s %s",
                                 model->node->name.text, what);
    tn_help(kit->diagnostics, d, "%s", help);
}

static void check_inside(tn_kit *kit, tn_kit_model *model)
{
    const tn_kit_node *space = model->inside->inner.first;
    if (!space)
        return;
    model->region = tn_kit_check_space(kit, space);
    if (!model->region.inside)
        return;
    if (model->region.endless) {
        tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_SPACE, space->span, "this space has no end");
        tn_help(kit->diagnostics, d, "what is `not` inside goes on for ever: write `box(...) and not ...`");
        model->region.inside = NULL;
        return;
    }
    for (int k = 0; k < 3; k++) {
        double unit = (double)kit->unit[k] / 1e6;
        if (model->region.low[k] / unit > -TN_PLACE_FAR && model->region.high[k] / unit < TN_PLACE_FAR)
            continue;
        tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_SPACE, space->span, "this space reaches too far");
        tn_help(kit->diagnostics, d, "it goes at most %d cells from the origin", TN_PLACE_FAR);
        model->region.inside = NULL;
        return;
    }
}

/* What stands is placed as it is: nothing looks for its place. */
static void check_stands(tn_kit *kit, const tn_kit_model *model, const tn_kit_node *node)
{
    tn_kit_parts_of_file(kit, node);
    if (!tn_names_get(&kit->rules, node->other.text)) {
        tn_kit_unknown(kit, &kit->rules, "rule", node->other.span, node->other.text,
                       "write `rule wall at stud, tube = 3001 | 3003;`");
    }
    if (!model->repeats)
        return;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_STANDS, node->span,
                                 "parts that stand have no images: this model has a symmetry");
    tn_note(kit->diagnostics, d, &model->repeats->span, "it is here");
    tn_help(kit->diagnostics, d, "leave out `symmetry`, or start at connectors");
}

/* How far the place of a start is turned about its connector's axis. */
bool tn_kit_start_turn(tn_kit *kit, const tn_kit_node *start, uint32_t *turns)
{
    int64_t count = 0;
    tn_axis axis = TN_AXIS_UP;
    *turns = 0;
    if (!tn_kit_given(&start->count[0]) || !tn_kit_whole(kit, &start->count[0], 0, 3, "a turn", &count))
        return true;
    *turns = (uint32_t)count;
    if (!start->doc.text || !tn_kit_axis(kit, &start->doc, &axis))
        return true;
    return kit->turns == TN_TURNS || axis <= TN_AXIS_DOWN || count == 0;
}

static void check_start(tn_kit *kit, const tn_kit_node *node)
{
    tn_kit_type *type = tn_names_get(&kit->types, node->name.text);
    tn_kit_rule *rule = tn_names_get(&kit->rules, node->other.text);
    tn_axis axis;
    int64_t at;
    int32_t cells;
    uint32_t turns;
    if (!type) {
        tn_kit_unknown(kit, &kit->types, "connector", node->name.span, node->name.text,
                       "a model starts at a connector that is thought to be there: `start stud at (0, 0, 0) by wall;`");
    }
    if (node->doc.text && tn_kit_axis(kit, &node->doc, &axis) && !tn_kit_start_turn(kit, node, &turns)) {
        tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_TURNS, node->count[0].span,
                                     "parts stay upright, and cannot be turned about an axis that lies");
        tn_note(kit->diagnostics, d, kit->unit_node ? &kit->unit_node->span : NULL, "the unit says so");
        tn_help(kit->diagnostics, d, "leave out `turn`, or write `unit 2 x 2 x 2 turns 24;`");
    } else if (!node->doc.text) {
        tn_kit_start_turn(kit, node, &turns);
    }
    for (int k = 0; k < 3; k++)
        if (tn_kit_measure(kit, &node->at.at[k], &at))
            tn_kit_cells(kit, node->at.at[k].span, at, k, 1, "the model starts at", &cells);
    if (!rule) {
        tn_kit_unknown(kit, &kit->rules, "rule", node->other.span, node->other.text,
                       "write `rule wall at stud, tube = 3001 | 3003;`");
    } else if (type && !tn_kit_rule_takes(rule, type)) {
        tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_MODEL, node->other.span, "rule %.100s is not at %.100s",
                                     node->other.text, node->name.text);
        tn_note(kit->diagnostics, d, &rule->node->name.span, "it says here where it is");
        tn_help(kit->diagnostics, d, "add the connector to the rule, or start at another");
    }
}

void tn_kit_check_model(tn_kit *kit, tn_kit_model *model)
{
    bool starts = false;
    for (const tn_kit_node *node = model->node->inner.first; node; node = node->next) {
        if (node->kind == TN_KIT_INSIDE && model->inside) {
            tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_TWICE, node->span, "`inside` is there twice");
            tn_note(kit->diagnostics, d, &model->inside->span, "the first is here");
            tn_help(kit->diagnostics, d, "join the two by `and` or `or`");
        } else if (node->kind == TN_KIT_INSIDE) {
            model->inside = node;
        } else if (node->kind == TN_KIT_START) {
            starts = true;
            check_start(kit, node);
        } else if (node->kind == TN_KIT_STANDS) {
            starts = true; /* it is looked at once the search is known */
        } else if (node->kind == TN_KIT_COLOUR) {
            tn_kit_whole(kit, &node->count[0], 0, TN_PLACE_COLOUR_MAX, "a colour", &model->colour);
        } else if (node->kind == TN_KIT_REQUIRES) {
            tn_kit_check_conditions(kit, node);
        } else {
            kit_check_search(kit, model, node);
        }
    }
    if (model->inside)
        check_inside(kit, model);
    else
        lacks(kit, model, "does not say what it is inside of",
              "write a space that has an end: `inside box(8 studs, 4 bricks, 8 studs);`");
    if (!starts)
        lacks(kit, model, "starts nowhere",
              "write a connector, where it is, and a rule: `start stud at (0, 0, 0) by wall;`");
    kit_check_searches(kit, model);
    for (const tn_kit_node *node = model->node->inner.first; node; node = node->next)
        if (node->kind == TN_KIT_STANDS)
            check_stands(kit, model, node);
}

void tn_kit_check_test(tn_kit *kit, const tn_kit_node *test)
{
    if (!tn_names_get(&kit->models, test->name.text)) {
        tn_kit_unknown(kit, &kit->models, "model", test->name.span, test->name.text,
                       "a test is called by the model that it is about, in the same file");
    }
    tn_kit_check_conditions(kit, test);
}
