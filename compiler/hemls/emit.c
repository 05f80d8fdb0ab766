/* Writes a checked rewrite system as code: its seed, each successor, and a guard for each rule. */
#include "compiler/hemls/hemls.h"
#include "runtime/base/bytes.h"

static uint32_t label_index(const tn_checked_growth *growth, uint32_t number)
{
    uint32_t index = 0;
    for (const tn_checked_label *label = growth->labels; label && label->number != number; label = label->next)
        index++;
    return index;
}

/* ---- functions */

/* One begins here, made of this stretch of the source. */
static tn_function_record begin(tn_builder *builder, tn_function_kind kind, tn_span span)
{
    uint32_t offset = tn_builder_offset(builder);
    tn_builder_add_SOURCE_MAP(builder, &(tn_source_map_record){offset, span.file, span.begin, span.end});
    return (tn_function_record){.kind = kind, .code_begin = offset};
}

static uint32_t end(tn_builder *builder, tn_function_record *function, tn_opcode last)
{
    tn_builder_emit(builder, last, 0, 0);
    function->code_end = tn_builder_offset(builder);
    return tn_builder_add_FUNCTION(builder, function);
}

static void emit_number(tn_builder *builder, tn_opcode opcode, double number)
{
    tn_builder_emit(builder, opcode, (int64_t)tn_bits_of(number), 0);
}

static uint32_t emit_seed(tn_builder *builder, const tn_checked_growth *growth)
{
    tn_function_record function = begin(builder, TN_FUNCTION_SEED, growth->axiom_span);
    for (uint32_t i = 0; i < growth->axiom_count; i++) {
        if (growth->axiom_reversed[i])
            tn_builder_emit(builder, TN_OP_FLIP, 0, 0);
        tn_builder_emit(builder, TN_OP_DRAW, label_index(growth, growth->axiom[i]), TN_AGE_ZERO);
    }
    return end(builder, &function, TN_OP_LAND);
}

/* Two `~` on end are none. Turns are not put together: two by 60 degrees end in other last digits than one by 120. */
static uint32_t emit_successor(tn_builder *builder, const tn_checked_growth *growth,
                               const tn_checked_successor *successor)
{
    tn_function_record function = begin(builder, TN_FUNCTION_SUCCESSOR, successor->span);
    function.stack_max = successor->depth;
    for (const tn_hemls_symbol *s = successor->symbols->first; s; s = s->next) {
        if (s->kind == TN_HEMLS_TILDE && s->next && s->next->kind == TN_HEMLS_TILDE) {
            s = s->next;
            continue;
        }
        tn_instruction move = tn_hemls_move(s, growth->angle);
        if (move.opcode == TN_OP_DRAW)
            move.first = label_index(growth, s->number);
        tn_builder_emit(builder, move.opcode, move.first, move.second);
    }
    return end(builder, &function, TN_OP_LAND);
}

/* ---- guards */

static double total_weight(const tn_checked_rewrite *rule)
{
    double total = 0;
    for (const tn_checked_alternative *a = rule->alternatives; a; a = a->next)
        total += a->choice.value;
    return total;
}

static void emit_test(tn_builder *builder, const tn_checked_rewrite *rule, const tn_checked_alternative *a)
{
    static const tn_opcode ages[TN_COMPARISON_COUNT] = {
        [TN_AGE_BELOW] = TN_OP_YOUNGER, [TN_AGE_ABOVE] = TN_OP_OLDER, [TN_AGE_EQUALS] = TN_OP_AGED};
    if (a->choice.comparison != TN_ALWAYS)
        emit_number(builder, ages[a->choice.comparison], a->choice.value);
    else if (tn_rewrite_by_chance(rule) && a->next) /* the last takes what is left */
        emit_number(builder, TN_OP_WEIGHT, a->choice.value);
}

/* Whether an alternative can be taken: where ages decide, those behind one without a condition never are. */
static bool is_last(const tn_checked_rewrite *rule, const tn_checked_alternative *a)
{
    return !a->next || (!tn_rewrite_by_chance(rule) && a->choice.comparison == TN_ALWAYS);
}

static uint32_t emit_guard(tn_builder *builder, const tn_checked_growth *growth, tn_checked_rewrite *rule)
{
    for (tn_checked_alternative *a = rule->alternatives; a; a = is_last(rule, a) ? NULL : a->next)
        a->function = emit_successor(builder, growth, &a->successor);
    tn_function_record function = begin(builder, TN_FUNCTION_GUARD, rule->span);
    for (uint32_t i = 0; i < rule->number_count; i++)
        tn_builder_emit(builder, TN_OP_LABEL, label_index(growth, rule->numbers[i]), 0);
    if (rule->left != TN_NO_LABEL)
        tn_builder_emit(builder, TN_OP_BEHIND, label_index(growth, rule->left), 0);
    if (rule->right != TN_NO_LABEL)
        tn_builder_emit(builder, TN_OP_AHEAD, label_index(growth, rule->right), 0);
    if (tn_rewrite_by_chance(rule))
        emit_number(builder, TN_OP_CHANCE, total_weight(rule));
    for (const tn_checked_alternative *a = rule->alternatives; a; a = is_last(rule, a) ? NULL : a->next) {
        emit_test(builder, rule, a);
        tn_builder_emit(builder, TN_OP_REPLACE, a->function, 0);
    }
    return end(builder, &function, TN_OP_PASS);
}

static void emit_group(tn_builder *builder, const tn_checked_growth *growth, const tn_checked_group *group)
{
    uint32_t first = (uint32_t)tn_builder_count(builder, TN_SECTION_REWRITE_RULE);
    for (tn_checked_rewrite *rule = group->rules; rule; rule = rule->next_in_group) {
        tn_rewrite_rule_record record = {emit_guard(builder, growth, rule), rule->span.file, rule->span.begin,
                                         rule->span.end};
        tn_builder_add_REWRITE_RULE(builder, &record);
    }
    tn_builder_add_REWRITE_GROUP(builder, &(tn_rewrite_group_record){first, group->rule_count});
}

void tn_emit_growth(tn_builder *builder, const tn_checked_growth *growth)
{
    for (const tn_checked_label *label = growth->labels; label; label = label->next)
        tn_builder_add_EDGE_LABEL(builder,
                                  &(tn_edge_label_record){tn_builder_string(builder, label->name), label->number});
    tn_growth_record record = {.name = tn_builder_string(builder, growth->name),
                               .branch_angle = growth->branch_angle,
                               .flags = (growth->sync ? TN_GROWTH_SYNC : 0) | (growth->even ? TN_GROWTH_EVEN : 0),
                               .seed = emit_seed(builder, growth),
                               .file = growth->span.file,
                               .begin = growth->span.begin,
                               .end = growth->span.end};
    tn_builder_add_GROWTH(builder, &record);
    for (const tn_checked_group *group = growth->groups; group; group = group->next)
        emit_group(builder, growth, group);
}
