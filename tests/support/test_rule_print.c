#include "tests/support/test_rule.h"

static void print_condition(const test_condition *condition, FILE *out)
{
    long long first = (long long)condition->first, second = (long long)condition->second;
    switch (condition->opcode) {
    case TN_OP_LESS:
        fprintf(out, "n < %lld", first);
        return;
    case TN_OP_EQUAL:
        fprintf(out, "n = %lld", first);
        return;
    case TN_OP_GREATER:
        fprintf(out, "n > %lld", first);
        return;
    case TN_OP_WITHIN:
        fprintf(out, "n in %lld..%lld", first, second);
        return;
    case TN_OP_REMAINDER:
        fprintf(out, "n mod %lld = %lld", first, second);
        return;
    case TN_OP_NEITHER:
        fprintf(out, "not (");
        break;
    default:
        fprintf(out, "((");
        print_condition(condition->parts[1], out);
        fprintf(out, condition->opcode == TN_OP_BOTH ? ") and " : ") or ");
    }
    print_condition(condition->parts[0], out);
    fprintf(out, ")");
}

static void print_mask(const test_schema *schema, uint64_t mask, FILE *out)
{
    fprintf(out, "tray(");
    uint32_t bit = 0;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const test_field *field = &schema->fields[f];
        uint64_t allowed = mask >> bit & ((UINT64_C(1) << field->value_count) - 1);
        bit += field->value_count;
        if (allowed + 1 == UINT64_C(1) << field->value_count)
            continue;
        fprintf(out, "%s:", field->name);
        for (uint32_t v = 0; v < field->value_count; v++)
            fprintf(out, "%s%s", allowed >> v & 1 ? " " : "", allowed >> v & 1 ? field->values[v].spelling : "");
        fprintf(out, "; ");
    }
    fprintf(out, ")");
}

void test_rule_print(const test_schema *schema, const test_rule *rule, FILE *out)
{
    static const char *const names[] = {"tray",     "and", "or",          "not",  "neighbour", "symmetric",
                                        "quantity", "sum", "occurrences", "many", "distance"};
    if (rule->kind == TEST_TRAY) {
        print_mask(schema, rule->mask, out);
        return;
    }
    fprintf(out, "%s(%s", names[rule->kind], rule->beginning ? "beginning, " : "");
    if (rule->kind == TEST_SUM)
        fprintf(out, "%s of ", schema->fields[rule->field].name);
    for (uint32_t i = 0; i < rule->part_count; i++) {
        fprintf(out, "%s%s", i > 0 ? ", " : "", rule->optional[i] ? "optional " : "");
        test_rule_print(schema, rule->parts[i], out);
    }
    if (rule->condition) {
        fprintf(out, ", ");
        print_condition(rule->condition, out);
    }
    fprintf(out, "%s)", rule->end ? ", end" : "");
}
