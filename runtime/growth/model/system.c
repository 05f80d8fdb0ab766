/* Reads a rewrite system from a module's code: the turtle draws each successor, guards become rules. */
#include "runtime/growth/model/system.h"

#include <stdlib.h>

#include "runtime/growth/model/turtle.h"

/* A system and the arrays that it reaches. */
typedef struct room {
    tn_growth_system system;
    tn_growth_label *labels;
    tn_axiom_edge *axiom;
    tn_growth_group *groups;
    uint32_t *group_labels;
    tn_growth_rule *rules;
    tn_alternative *alternatives;
    tn_template *templates;
    tn_template_segment *segments;
    tn_template_branch *branches;
    uint32_t *successors;
} room;

/* How much of each there is. */
typedef struct sizes {
    size_t axiom, labels, alternatives, templates, segments, branches;
    uint32_t levels;
} sizes;

static void free_room(room *r)
{
    free(r->labels);
    free(r->axiom);
    free(r->groups);
    free(r->group_labels);
    free(r->rules);
    free(r->alternatives);
    free(r->templates);
    free(r->segments);
    free(r->branches);
    free(r->successors);
    free(r);
}

static void count_function(const tn_module *module, const tn_function_record *function, sizes *count)
{
    uint32_t depth = 0;
    for (uint32_t offset = function->code_begin; offset < function->code_end;) {
        tn_instruction instruction = tn_code_read(module->code, offset);
        bool draws = instruction.opcode == TN_OP_DRAW, of_seed = function->kind == TN_FUNCTION_SEED;
        depth += (uint32_t)(instruction.opcode == TN_OP_OPEN) - (uint32_t)(instruction.opcode == TN_OP_CLOSE);
        count->axiom += draws && of_seed;
        count->segments += draws && !of_seed && depth == 0;
        count->branches += draws && depth > 0;
        count->labels += instruction.opcode == TN_OP_LABEL;
        count->alternatives += instruction.opcode == TN_OP_REPLACE;
        offset += instruction.length;
    }
    if (function->kind != TN_FUNCTION_SUCCESSOR)
        return;
    count->templates++;
    count->levels = function->stack_max > count->levels ? function->stack_max : count->levels;
}

static sizes count_parts(const tn_module *module)
{
    sizes count = {0};
    for (size_t i = 0; i < module->FUNCTION_count; i++) {
        uint32_t kind = module->FUNCTION_records[i].kind;
        if (kind == TN_FUNCTION_SEED || kind == TN_FUNCTION_SUCCESSOR || kind == TN_FUNCTION_GUARD)
            count_function(module, &module->FUNCTION_records[i], &count);
    }
    return count;
}

static void *array(size_t count, size_t size)
{
    return calloc(count ? count : 1, size);
}

static room *make_room(const tn_module *module, const sizes *count)
{
    room *r = calloc(1, sizeof *r);
    if (!r)
        return NULL;
    r->labels = array(module->EDGE_LABEL_count, sizeof *r->labels);
    r->axiom = array(count->axiom, sizeof *r->axiom);
    r->groups = array(module->REWRITE_GROUP_count, sizeof *r->groups);
    r->group_labels = array(count->labels, sizeof *r->group_labels);
    r->rules = array(module->REWRITE_RULE_count, sizeof *r->rules);
    r->alternatives = array(count->alternatives, sizeof *r->alternatives);
    r->templates = array(count->templates, sizeof *r->templates);
    r->segments = array(count->segments, sizeof *r->segments);
    r->branches = array(count->branches, sizeof *r->branches);
    r->successors = array(count->templates, sizeof *r->successors);
    if (r->labels && r->axiom && r->groups && r->group_labels && r->rules && r->alternatives && r->templates &&
        r->segments && r->branches && r->successors)
        return r;
    free_room(r);
    return NULL;
}

static void read_seed(const tn_module *module, room *r)
{
    const tn_function_record *seed = &module->FUNCTION_records[module->GROWTH_records[0].seed];
    uint32_t count = 0;
    bool flipped = false;
    for (uint32_t offset = seed->code_begin; offset < seed->code_end;) {
        tn_instruction move = tn_code_read(module->code, offset);
        if (move.opcode == TN_OP_DRAW)
            r->axiom[count++] = (tn_axiom_edge){(uint32_t)move.first, flipped};
        flipped = move.opcode == TN_OP_FLIP && !flipped;
        offset += move.length;
    }
    r->system.axiom = r->axiom;
    r->system.axiom_count = count;
}

static tn_status draw_templates(const tn_module *module, room *r, tn_error *error)
{
    tn_turtle_level *levels = malloc((r->system.level_count + 1) * sizeof *levels);
    if (!levels)
        return tn_fail_memory(error);
    tn_template_segment *segments = r->segments;
    tn_template_branch *branches = r->branches;
    for (uint32_t f = 0, t = 0; f < module->FUNCTION_count; f++) {
        if (module->FUNCTION_records[f].kind != TN_FUNCTION_SUCCESSOR)
            continue;
        r->successors[t] = f;
        r->templates[t] = tn_turtle_draw(module, f, levels, segments, branches);
        segments += r->templates[t].segment_count;
        branches += r->templates[t++].branch_count;
    }
    free(levels);
    return TN_OK;
}

uint32_t tn_growth_template_of(const tn_growth_system *system, uint32_t successor)
{
    uint32_t low = 0, high = system->template_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (system->successors[middle] <= successor)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* ---- guards */

/* Where the next labels and alternatives go. */
typedef struct places {
    uint32_t *label;
    tn_alternative *alternative;
} places;

static tn_comparison comparison_of(tn_opcode opcode)
{
    return opcode == TN_OP_YOUNGER ? TN_AGE_BELOW
           : opcode == TN_OP_OLDER ? TN_AGE_ABOVE
           : opcode == TN_OP_AGED  ? TN_AGE_EQUALS
                                   : TN_ALWAYS;
}

/* The rule that a guard is; its labels go to places->label, and their number is returned. */
static uint32_t read_guard(const room *r, const tn_module *module, uint32_t guard, tn_growth_rule *rule, places *to)
{
    const tn_function_record *function = &module->FUNCTION_records[guard];
    uint32_t labels = 0;
    tn_alternative next = {.comparison = TN_ALWAYS};
    *rule = (tn_growth_rule){.left = TN_NO_LABEL,
                             .right = TN_NO_LABEL,
                             .alternatives = to->alternative,
                             .conditional = true,
                             .guard = guard};
    for (uint32_t offset = function->code_begin; offset < function->code_end;) {
        tn_instruction test = tn_code_read(module->code, offset);
        offset += test.length;
        double number = tn_double_of((uint64_t)test.first);
        if (test.opcode == TN_OP_LABEL)
            to->label[labels++] = (uint32_t)test.first;
        else if (test.opcode == TN_OP_BEHIND)
            rule->left = (uint32_t)test.first;
        else if (test.opcode == TN_OP_AHEAD)
            rule->right = (uint32_t)test.first;
        else if (test.opcode == TN_OP_CHANCE)
            rule->conditional = false, rule->total = number;
        else if (test.opcode == TN_OP_WEIGHT)
            next.weight = number;
        else if (comparison_of(test.opcode) != TN_ALWAYS)
            next = (tn_alternative){.comparison = comparison_of(test.opcode), .bound = number};
        else if (test.opcode == TN_OP_REPLACE) {
            next.template = tn_growth_template_of(&r->system, (uint32_t)test.first);
            *to->alternative++ = next;
            rule->alternative_count++;
            next = (tn_alternative){.comparison = TN_ALWAYS};
        }
    }
    return labels;
}

static void read_rules(const tn_module *module, room *r)
{
    places to = {r->group_labels, r->alternatives};
    for (size_t i = 0; i < module->REWRITE_GROUP_count; i++) {
        const tn_rewrite_group_record *g = &module->REWRITE_GROUP_records[i];
        tn_growth_group *group = &r->groups[i];
        *group = (tn_growth_group){to.label, 0, r->rules + g->rule_first, g->rule_count};
        for (uint32_t k = 0; k < g->rule_count; k++)
            group->label_count = read_guard(r, module, module->REWRITE_RULE_records[g->rule_first + k].guard,
                                            &r->rules[g->rule_first + k], &to); /* of all of them the same labels */
        to.label += group->label_count;
    }
}

tn_status tn_growth_system_read(const tn_module *module, tn_growth_system **system, tn_error *error)
{
    *system = NULL;
    if (module->GROWTH_count == 0) {
        tn_fail(error, TN_INVALID, TN_CODE_NONE, "there is no rewrite system in this file");
        tn_error_help(error, "a surface grows from a .hemls file, or from a .study file that names one");
        return TN_INVALID;
    }
    sizes count = count_parts(module);
    room *r = make_room(module, &count);
    if (!r)
        return tn_fail_memory(error);
    const tn_growth_record *growth = &module->GROWTH_records[0];
    for (size_t i = 0; i < module->EDGE_LABEL_count; i++)
        r->labels[i] = (tn_growth_label){module->EDGE_LABEL_records[i].number,
                                         tn_text(module, module->EDGE_LABEL_records[i].name)};
    r->system = (tn_growth_system){.name = tn_text(module, growth->name),
                                   .labels = r->labels,
                                   .label_count = (uint32_t)module->EDGE_LABEL_count,
                                   .groups = r->groups,
                                   .group_count = (uint32_t)module->REWRITE_GROUP_count,
                                   .templates = r->templates,
                                   .template_count = (uint32_t)count.templates,
                                   .successors = r->successors,
                                   .level_count = count.levels,
                                   .module = module,
                                   .branch_angle = growth->branch_angle,
                                   .sync = growth->flags & TN_GROWTH_SYNC,
                                   .even = growth->flags & TN_GROWTH_EVEN};
    read_seed(module, r);
    tn_status status = draw_templates(module, r, error);
    if (status != TN_OK) {
        free_room(r);
        return status;
    }
    read_rules(module, r);
    *system = &r->system;
    return TN_OK;
}

void tn_growth_system_free(tn_growth_system *system)
{
    if (system)
        free_room((room *)system); /* the system is the room's first member */
}
