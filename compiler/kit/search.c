/* What models of kits say of how they are searched for: an objective, a way of searching, images, a stock. */
#include <string.h>

#include "compiler/kit/kit.h"

/* Says that a line is there twice; false where it is the first. */
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

void tn_kit_check_search(tn_kit *kit, tn_kit_model *model, const tn_kit_node *node)
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
void tn_kit_check_searches(tn_kit *kit, const tn_kit_model *model)
{
    if (!model->objective || model->searches)
        return;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_SEARCH, model->objective->span,
                                 "this needs a search: one model alone is neither small nor large");
    tn_help(kit->diagnostics, d, "add `search beam 50;` or `search anneal 10000;`");
}
