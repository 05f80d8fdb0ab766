/* What models and tests of kits ask for: a space that has an end, where to start, and conditions. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/kit/kit.h"

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
            tn_kit_check_search(kit, model, node);
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
    tn_kit_check_searches(kit, model);
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
