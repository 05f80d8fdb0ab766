/* Reads how rules derive from their parts. */
#include "runtime/plan/ways/derivation.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/module/code.h"
#include "runtime/plan/match/parts.h"

static tn_status foreign(uint32_t offset, tn_error *error)
{
    tn_status status = tn_fail(error, TN_INVALID, E_REFUSED_MODULE, "this is not what the compiler makes of a rule");
    if (error)
        error->code_offset = offset;
    return status;
}

/* The rule of a function, which is read later if it is new. */
static tn_status find_rule(tn_derivation *d, uint32_t function, uint32_t *rule, tn_error *error)
{
    for (*rule = 0; *rule < d->rule_count; ++*rule)
        if (d->rules[*rule].function == function)
            return TN_OK;
    if (!tn_array_reserve(&d->rules, &d->rule_room, d->rule_count, 1, sizeof *d->rules))
        return tn_fail_memory(error);
    d->rules[d->rule_count++] = (tn_derived_rule){.function = function};
    return TN_OK;
}

/* What a symmetric mirrors: the function that is named in it, or one of its own, whose parts stand for it. */
static uint32_t mirrored(const tn_derivation *d, uint32_t function, const tn_part *part)
{
    for (uint32_t f = 0; f < d->module->FUNCTION_count; f++) {
        const tn_function_record *record = &d->module->FUNCTION_records[f];
        if (part->root >= record->code_begin && part->root < record->code_end)
            return f == function ? part->function : f;
    }
    return part->function;
}

static tn_derived_kind kind_of(const tn_derivation *d, const tn_part *part)
{
    if (part->somewhere || part->once)
        return TN_DERIVED_FACT;
    switch (part->kind) {
    case TN_PART_RULE:
        return tn_function_is_whole(&d->module->FUNCTION_records[part->function]) ? TN_DERIVED_CALL : TN_DERIVED_FACT;
    case TN_PART_OR:
        return TN_DERIVED_OR;
    case TN_PART_AND:
        return TN_DERIVED_AND;
    case TN_PART_NEIGHBOUR:
        return TN_DERIVED_NEIGHBOUR;
    case TN_PART_REPEAT:
        return TN_DERIVED_REPEAT;
    case TN_PART_SYMMETRIC:
        return TN_DERIVED_SYMMETRIC;
    default:
        return TN_DERIVED_FACT;
    }
}

/* Code of a part that is asked somewhere goes on by the instruction that says so. */
static uint32_t code_end(const tn_derivation *d, const tn_part *part)
{
    return part->code_end + (part->somewhere ? tn_code_read(d->module->code, part->code_end).length : 0);
}

static tn_status add_node(tn_derivation *d, uint32_t function, const tn_parts *parts, uint32_t p, tn_error *error)
{
    const tn_part *part = &parts->parts[p];
    tn_derived node = {.kind = kind_of(d, part),
                       .first = TN_NOT_DERIVED,
                       .next = TN_NOT_DERIVED,
                       .again = part->again,
                       .optional = part->optional,
                       .beginning = part->beginning,
                       .end = part->end,
                       .least = part->least,
                       .most = part->most,
                       .code_begin = part->code_begin,
                       .code_end = code_end(d, part)};
    tn_status status = TN_OK;
    if (node.kind == TN_DERIVED_CALL)
        status = find_rule(d, part->function, &node.rule, error);
    if (node.kind == TN_DERIVED_SYMMETRIC)
        status = find_rule(d, mirrored(d, function, &parts->parts[part->first]), &node.rule, error);
    if (status != TN_OK)
        return status;
    if (!tn_array_reserve(&d->nodes, &d->node_room, d->node_count, 1, sizeof *d->nodes))
        return tn_fail_memory(error);
    d->nodes[d->node_count++] = node;
    return TN_OK;
}

static bool has_children(tn_derived_kind kind)
{
    return kind == TN_DERIVED_OR || kind == TN_DERIVED_AND || kind == TN_DERIVED_NEIGHBOUR || kind == TN_DERIVED_REPEAT;
}

/* Parts become nodes, each before its children; what is below a fact is left out. */
static tn_status add_nodes(tn_derivation *d, uint32_t function, const tn_parts *parts, tn_error *error)
{
    uint32_t *part_of = malloc(((size_t)parts->count + 1) * sizeof *part_of), first = d->node_count;
    if (!part_of)
        return tn_fail_memory(error);
    part_of[0] = 0;
    tn_status status = add_node(d, function, parts, 0, error);
    for (uint32_t n = first; status == TN_OK && n < d->node_count; n++) {
        uint32_t last = TN_NOT_DERIVED;
        if (!has_children(d->nodes[n].kind))
            continue;
        for (uint32_t p = parts->parts[part_of[n - first]].first; status == TN_OK && p != TN_NO_PART;
             p = parts->parts[p].next) {
            uint32_t made = d->node_count;
            part_of[made - first] = p;
            status = add_node(d, function, parts, p, error);
            *(last == TN_NOT_DERIVED ? &d->nodes[n].first : &d->nodes[last].next) = made;
            last = made;
            d->nodes[n].count++;
        }
        if (status == TN_OK && last == TN_NOT_DERIVED)
            status = foreign(parts->parts[part_of[n - first]].root, error);
    }
    free(part_of);
    return status;
}

static tn_status read_rule(tn_derivation *d, uint32_t rule, tn_error *error)
{
    uint32_t function = d->rules[rule].function;
    tn_parts parts;
    tn_status status = tn_parts_read(d->module, function, &parts, error);
    d->rules[rule].first = d->node_count;
    if (status == TN_OK)
        status = add_nodes(d, function, &parts, error);
    d->rules[rule].end = d->node_count;
    tn_parts_clear(&parts);
    return status;
}

static int compare_rules(const void *left, const void *right)
{
    const tn_derived_rule *a = left, *b = right;
    return (a->function > b->function) - (a->function < b->function);
}

/* Rules are met from the root on; what they call has lower numbers. */
static tn_status sort_rules(tn_derivation *d, uint32_t root, tn_error *error)
{
    uint32_t *met = malloc(((size_t)d->rule_count + 1) * sizeof *met);
    if (!met)
        return tn_fail_memory(error);
    for (uint32_t r = 0; r < d->rule_count; r++)
        met[r] = d->rules[r].function;
    qsort(d->rules, d->rule_count, sizeof *d->rules, compare_rules);
    tn_derived_rule wanted;
    for (uint32_t n = 0; n < d->node_count; n++) {
        tn_derived *node = &d->nodes[n];
        if (node->kind != TN_DERIVED_CALL && node->kind != TN_DERIVED_SYMMETRIC)
            continue;
        wanted.function = met[node->rule];
        const tn_derived_rule *found = bsearch(&wanted, d->rules, d->rule_count, sizeof *d->rules, compare_rules);
        node->rule = (uint32_t)(found - d->rules);
    }
    wanted.function = root;
    const tn_derived_rule *found = bsearch(&wanted, d->rules, d->rule_count, sizeof *d->rules, compare_rules);
    d->root = (uint32_t)(found - d->rules);
    free(met);
    return TN_OK;
}

/* Joins the circles of the rules from one to another, which call each other. */
static void join_circles(tn_derivation *d, uint32_t a, uint32_t b)
{
    uint32_t from = a < b ? a : b, to = a < b ? b : a;
    uint32_t first = d->rules[from].circle_first, end = d->rules[to].circle_end;
    for (uint32_t r = first; r < end; r++) {
        d->rules[r].circle = true;
        d->rules[r].circle_first = first;
        d->rules[r].circle_end = end;
    }
}

static tn_status find_circles(tn_derivation *d, tn_error *error)
{
    for (uint32_t r = 0; r < d->rule_count; r++) {
        d->rules[r].circle_first = r;
        d->rules[r].circle_end = r + 1;
    }
    for (uint32_t r = 0; r < d->rule_count; r++)
        for (uint32_t n = d->rules[r].first; n < d->rules[r].end; n++)
            if (d->nodes[n].kind == TN_DERIVED_CALL && d->nodes[n].again)
                join_circles(d, r, d->nodes[n].rule);
    for (uint32_t r = 0; r < d->rule_count; r++)
        for (uint32_t n = d->rules[r].first; n < d->rules[r].end; n++) {
            const tn_derived *node = &d->nodes[n];
            bool calls = node->kind == TN_DERIVED_CALL || node->kind == TN_DERIVED_SYMMETRIC;
            if (calls && !node->again && node->rule >= d->rules[r].circle_first)
                return foreign(node->code_begin, error);
        }
    return TN_OK;
}

tn_status tn_derivation_read(const tn_module *module, uint32_t function, tn_derivation *d, tn_error *error)
{
    *d = (tn_derivation){.module = module};
    tn_status status = find_rule(d, function, &d->root, error);
    for (uint32_t r = 0; status == TN_OK && r < d->rule_count; r++)
        status = read_rule(d, r, error);
    if (status == TN_OK)
        status = sort_rules(d, function, error);
    return status == TN_OK ? find_circles(d, error) : status;
}

static bool need(uint8_t *needed, uint32_t rule, uint32_t side)
{
    bool news = !needed[rule * TN_SIDES + side];
    needed[rule * TN_SIDES + side] = 1;
    return news;
}

static bool need_callees(const tn_derivation *d, uint8_t *needed, uint32_t rule, uint32_t side)
{
    bool news = false;
    for (uint32_t n = d->rules[rule].first; n < d->rules[rule].end; n++) {
        const tn_derived *node = &d->nodes[n];
        if (node->kind == TN_DERIVED_CALL || node->kind == TN_DERIVED_SYMMETRIC)
            news |= need(needed, node->rule, side);
        if (node->kind == TN_DERIVED_SYMMETRIC)
            news |= need(needed, node->rule, !side);
    }
    return news;
}

/* Callers come behind what they call, but in circles. */
void tn_derivation_needed(const tn_derivation *d, uint8_t *needed)
{
    bool news = need(needed, d->root, TN_SIDE_WRITTEN);
    while (news) {
        news = false;
        for (uint32_t r = d->rule_count; r-- > 0;)
            for (uint32_t side = 0; side < TN_SIDES; side++)
                if (needed[r * TN_SIDES + side])
                    news |= need_callees(d, needed, r, side);
    }
}

void tn_derivation_clear(tn_derivation *d)
{
    free(d->nodes);
    free(d->rules);
    *d = (tn_derivation){0};
}
