/* Checks what .kit files mean: names once, then parts, rules, models and tests. */
#include <string.h>

#include "compiler/kit/kit.h"

/* Puts a definition under its name; false if that has one already. */
static bool define(tn_kit *kit, tn_names *names, const tn_kit_node *node, const char *what, void *value)
{
    const tn_kit_text *name = &node->name;
    if (!name->text || !value)
        return false;
    if (strlen(name->text) == 0 || strlen(name->text) > TN_NAME_MAX) {
        tn_diagnostic *d =
            tn_report(kit->diagnostics, E_KIT_TWICE, name->span, "a name has from 1 to %d bytes", TN_NAME_MAX);
        tn_help(kit->diagnostics, d, "write a shorter one, or any");
        return false;
    }
    if (!tn_names_get(names, name->text)) {
        tn_names_put(names, name->text, value);
        return true;
    }
    tn_diagnostic *d =
        tn_report(kit->diagnostics, E_KIT_TWICE, name->span, "%s `%.100s` is there twice", what, name->text);
    if (names != &kit->lengths) { /* all but lengths begin with their node */
        const tn_kit_node *const *first = tn_names_get(names, name->text);
        tn_note(kit->diagnostics, d, &(*first)->name.span, "the first is here");
    }
    tn_help(kit->diagnostics, d, "give one of them another name");
    return false;
}

/* All turns take a cell to a cell only where it is a cube. */
static void take_turns(tn_kit *kit, const tn_kit_node *node)
{
    int64_t turns = TN_UPRIGHT_TURNS;
    if (tn_kit_given(&node->count[0]) && !tn_kit_whole(kit, &node->count[0], 4, 24, "a number of turns", &turns))
        return;
    bool cube = kit->unit[0] == kit->unit[1] && kit->unit[0] == kit->unit[2];
    if (turns == TN_UPRIGHT_TURNS || (turns == TN_TURNS && cube)) {
        kit->turns = (uint32_t)turns;
        return;
    }
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_TURNS, node->count[0].span, "%s",
                                 turns == TN_TURNS ? "all turns need a cell that is a cube" : "turns are 4 or 24");
    tn_help(kit->diagnostics, d, "4 about the vertical, or 24 where a cell is a cube: `unit 2 x 2 x 2 turns 24;`");
    kit->damaged = true;
}

/* A wrong unit is said once: no length can be laid on cells that nobody knows. */
static void take_unit(tn_kit *kit, const tn_kit_node *node)
{
    int64_t unit[3];
    bool good = true;
    for (int k = 0; k < 3; k++) {
        if (!tn_kit_measure(kit, &node->size[k], &unit[k])) {
            good = false;
        } else if (unit[k] <= 0) {
            tn_diagnostic *d =
                tn_report(kit->diagnostics, E_KIT_UNIT, node->size[k].span, "a cell has an extent above 0");
            tn_help(kit->diagnostics, d, "write `unit 10 x 8 x 10;`");
            good = false;
        }
    }
    kit->damaged |= !good;
    if (!good)
        return;
    memcpy(kit->unit, unit, sizeof unit);
    kit->unit_node = node;
    take_turns(kit, node);
    if (kit->unit[0] == kit->unit[2])
        return;
    tn_diagnostic *d =
        tn_report(kit->diagnostics, E_KIT_UNIT, node->span, "a cell is as deep as it is wide: parts are turned");
    tn_help(kit->diagnostics, d, "write the same first and last: `unit 10 x 8 x 10;`");
}

static void take_length(tn_kit *kit, const tn_kit_node *node)
{
    int64_t *value = TN_NEW(kit->arena, int64_t);
    if (value && tn_kit_measure(kit, &node->size[0], value))
        define(kit, &kit->lengths, node, "the length", value);
    else
        kit->names_lost = true;
}

static void take_type(tn_kit *kit, const tn_kit_node *node)
{
    int64_t turns = 4;
    tn_kit_type *type = TN_NEW(kit->arena, tn_kit_type);
    if (!type || !define(kit, &kit->types, node, "the connector", type))
        return;
    type->node = node;
    type->index = kit->type_list.last ? kit->type_list.last->index + 1 : 0;
    if (tn_kit_given(&node->count[0]) && tn_kit_whole(kit, &node->count[0], 1, 4, "a symmetry", &turns) && turns == 3) {
        tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_NUMBER, node->count[0].span, "turns are 1, 2 or 4");
        tn_help(kit->diagnostics, d, "4 where every quarter turn is alike, 2 where half a turn is, else 1");
        turns = 1;
    }
    type->turns = (uint32_t)turns;
    if (tn_kit_given(&node->size[0]))
        tn_kit_measure(kit, &node->size[0], &type->every);
    TN_CHAIN(&kit->type_list, type);
}

static void take_part(tn_kit *kit, const tn_kit_node *node)
{
    tn_kit_part *part = TN_NEW(kit->arena, tn_kit_part);
    if (!part || !define(kit, &kit->parts, node, "the part", part))
        return;
    part->node = node;
    part->index = kit->part_count;
    if (kit->part_count++ == TN_KIT_PARTS_MAX) {
        tn_diagnostic *d =
            tn_report(kit->diagnostics, E_KIT_TOO_MANY, node->span, "a kit has at most %d parts", TN_KIT_PARTS_MAX);
        tn_help(kit->diagnostics, d, "leave some out");
    }
    TN_CHAIN(&kit->part_list, part);
}

static void take_model(tn_kit *kit, const tn_kit_node *node)
{
    tn_kit_model *model = TN_NEW(kit->arena, tn_kit_model);
    if (!model || !define(kit, &kit->models, node, "the model", model))
        return;
    model->node = node;
    model->colour = 1;
    TN_CHAIN(&kit->model_list, model);
}

static void take_rule(tn_kit *kit, const tn_kit_node *node)
{
    tn_kit_rule *rule = TN_NEW(kit->arena, tn_kit_rule);
    if (!rule || !define(kit, &kit->rules, node, "the rule", rule))
        return;
    rule->node = node;
    TN_CHAIN(&kit->rule_list, rule);
}

static void take_space(tn_kit *kit, const tn_kit_node *node)
{
    tn_kit_space *space = TN_NEW(kit->arena, tn_kit_space);
    if (!space)
        return;
    space->node = node;
    define(kit, &kit->spaces, node, "the space", space);
}

/* Models of a file that is used are its own affair. */
static void take(tn_kit *kit, const tn_kit_node *node, bool imported)
{
    switch (node->kind) {
    case TN_KIT_UNIT:
        take_unit(kit, node);
        break;
    case TN_KIT_LENGTH:
        take_length(kit, node);
        break;
    case TN_KIT_CONNECTOR:
        take_type(kit, node);
        break;
    case TN_KIT_PART:
        take_part(kit, node);
        break;
    case TN_KIT_SPACE:
        take_space(kit, node);
        break;
    case TN_KIT_RULE:
        take_rule(kit, node);
        break;
    case TN_KIT_MODEL:
        if (!imported)
            take_model(kit, node);
        break;
    default:
        break;
    }
}

static void find_partners(tn_kit *kit)
{
    for (tn_kit_type *type = kit->type_list.first; type; type = type->next) {
        const tn_kit_text *other = &type->node->other;
        type->joins = tn_names_get(&kit->types, other->text);
        if (type->joins)
            continue;
        type->joins = type;
        tn_kit_unknown(kit, &kit->types, "connector", other->span, other->text,
                       "tell it as well: `connector tube joins stud;`");
    }
}

static bool has_cells(tn_kit *kit, const tn_imports *imports)
{
    if (kit->unit_node || kit->damaged || (!kit->part_list.first && !kit->model_list.first))
        return kit->unit_node != NULL;
    tn_diagnostic *d =
        tn_report(kit->diagnostics, E_KIT_UNIT, (tn_span){imports->units[imports->count - 1]->file, 0, 0},
                  "this kit does not say how large a cell is");
    tn_help(kit->diagnostics, d, "write `unit 10 x 8 x 10;`, or `use \"bricks\";`, which says so");
    return false;
}

static void check_all(tn_kit *kit, const tn_kit_file *own)
{
    for (tn_kit_part *part = kit->part_list.first; part; part = part->next)
        tn_kit_check_part(kit, part);
    for (const tn_kit_rule *rule = kit->rule_list.first; rule && !tn_arena_failed(kit->arena); rule = rule->next)
        tn_kit_check_rule(kit, rule);
    for (tn_kit_model *model = kit->model_list.first; model; model = model->next)
        tn_kit_check_model(kit, model);
    kit->voxels_placed = kit->voxels_count;
    for (const tn_kit_node *node = own->first; node; node = node->next) {
        if (node->kind == TN_KIT_TEST)
            tn_kit_check_test(kit, node);
        else if (node->kind == TN_KIT_SPACE && node->inner.first)
            tn_kit_check_space(kit, node->inner.first);
    }
}

/* ---- rules that nothing uses */

typedef struct used_rules {
    tn_kit_rule *first, *last;
} used_rules;

static void use_rule(const tn_kit *kit, used_rules *used, const char *name)
{
    tn_kit_rule *rule = tn_names_get(&kit->rules, name);
    if (!rule || rule->used)
        return;
    rule->used = true;
    if (used->last)
        used->last->next_used = rule;
    else
        used->first = rule;
    used->last = rule;
}

/* Those that go on at what an alternative places. */
static void use_next_rules(const tn_kit *kit, used_rules *used, const tn_kit_node *alternative)
{
    for (const tn_kit_node *one = alternative->inner.first; one; one = one->next) {
        if (one->kind == TN_KIT_PLACES)
            use_next_rules(kit, used, one);
        for (const tn_kit_node *named = one->outer.first; one->kind == TN_KIT_PLACED && named; named = named->next)
            use_rule(kit, used, named->name.text);
    }
}

/* A file without models is made to be used by others. */
static void warn_of_unused(const tn_kit *kit, const tn_kit_file *own)
{
    used_rules used = {0};
    for (const tn_kit_model *model = kit->model_list.first; model; model = model->next)
        for (const tn_kit_node *node = model->node->inner.first; node; node = node->next)
            if (node->kind == TN_KIT_START || node->kind == TN_KIT_STANDS)
                use_rule(kit, &used, node->other.text);
    for (const tn_kit_rule *rule = used.first; rule; rule = rule->next_used)
        for (const tn_kit_node *one = rule->node->inner.first; one; one = one->next)
            use_next_rules(kit, &used, one);
    for (const tn_kit_node *node = own->first; kit->model_list.first && node; node = node->next) {
        const tn_kit_rule *rule = node->kind == TN_KIT_RULE ? tn_names_get(&kit->rules, node->name.text) : NULL;
        if (!rule || rule->used)
            continue;
        tn_diagnostic *d = tn_report(kit->diagnostics, W_KIT_UNUSED_RULE, node->name.span,
                                     "no model comes to rule %.100s", node->name.text);
        tn_help(kit->diagnostics, d,
                "a rule is named by a model's `start ... by %.60s`, or goes on at a part: `with %.60s`",
                node->name.text, node->name.text);
    }
}

bool tn_check_kit(tn_kit *kit, const tn_imports *imports)
{
    tn_names *tables[] = {&kit->lengths, &kit->types, &kit->parts, &kit->spaces, &kit->rules, &kit->models};
    size_t errors = kit->diagnostics->error_count;
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
        tables[i]->arena = kit->arena;
    for (size_t u = 0; u < imports->count; u++) {
        const tn_kit_file *file = imports->units[u]->tree;
        kit->damaged |= file->damaged;
        kit->names_lost |= file->damaged;
        for (const tn_kit_node *node = file->first; node; node = node->next)
            take(kit, node, u + 1 < imports->count);
    }
    const tn_kit_file *own = imports->units[imports->count - 1]->tree;
    find_partners(kit);
    if (has_cells(kit, imports))
        check_all(kit, own);
    if (!own->first && !kit->damaged && kit->diagnostics->error_count == errors) {
        tn_diagnostic *d =
            tn_report(kit->diagnostics, E_KIT_EMPTY, (tn_span){imports->units[imports->count - 1]->file, 0, 0},
                      "there is nothing in this kit");
        tn_help(kit->diagnostics, d, "begin with `use \"bricks\";`, a rule and a model");
    }
    if (!kit->damaged && kit->diagnostics->error_count == errors)
        warn_of_unused(kit, own);
    return !kit->damaged && kit->diagnostics->error_count == errors && !tn_arena_failed(kit->arena);
}
