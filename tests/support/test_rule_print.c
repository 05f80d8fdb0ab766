#include "tests/support/test_rule.h"

/* A constant: a count, or (unit) a length in millimetres, which six places hold exactly. */
static void print_constant(int64_t value, bool lengths, FILE *out)
{
    long long magnitude = (long long)(value < 0 ? -value : value);
    fprintf(out, "%s", value < 0 ? "-" : "");
    if (lengths)
        fprintf(out, "%lld.%06lldmm", magnitude / 1000000, magnitude % 1000000);
    else
        fprintf(out, "%lld", magnitude);
}

static void print_condition(const test_condition *condition, bool lengths, FILE *out)
{
    switch (condition->opcode) {
    case TN_OP_LESS:
    case TN_OP_EQUAL:
    case TN_OP_GREATER:
        fprintf(out, "n %s ", condition->opcode == TN_OP_LESS ? "<" : condition->opcode == TN_OP_EQUAL ? "=" : ">");
        print_constant(condition->first, lengths, out);
        return;
    case TN_OP_WITHIN:
        fprintf(out, "n in ");
        print_constant(condition->first, lengths, out);
        fprintf(out, "..");
        print_constant(condition->second, lengths, out);
        return;
    case TN_OP_REMAINDER:
        fprintf(out, "n mod ");
        print_constant(condition->first, lengths, out);
        fprintf(out, " = ");
        print_constant(condition->second, lengths, out);
        return;
    case TN_OP_NEITHER:
        fprintf(out, "not (");
        break;
    default:
        fprintf(out, "((");
        print_condition(condition->parts[1], lengths, out);
        fprintf(out, condition->opcode == TN_OP_BOTH ? ") and " : ") or ");
    }
    print_condition(condition->parts[0], lengths, out);
    fprintf(out, ")");
}

static void print_value(const test_field *field, uint32_t value, FILE *out)
{
    const test_value *v = &field->values[value];
    if (field->kind == TN_FIELD_FLAG)
        fprintf(out, "%s%s", value == 0 ? "not " : "", field->name);
    else
        fprintf(out, "%s %s%s%s", field->name, v->name, v->measure[0] ? " " : "", v->measure);
}

static bool print_item(const test_field *field, uint64_t allowed, bool first, FILE *out)
{
    if (allowed + 1 == UINT64_C(1) << field->value_count)
        return false;
    fprintf(out, "%s", first ? "" : ", ");
    bool more = false;
    for (uint32_t v = 0; v < field->value_count; v++) {
        if (!(allowed >> v & 1))
            continue;
        fprintf(out, "%s", more ? " or " : "");
        print_value(field, v, out);
        more = true;
    }
    return true;
}

void test_mask_print(const test_schema *schema, uint64_t mask, FILE *out)
{
    uint32_t bit = 0;
    for (uint32_t f = 0; f < schema->field_count; bit += schema->fields[f++].value_count) {
        if ((mask >> bit & ((UINT64_C(1) << schema->fields[f].value_count) - 1)) != 0)
            continue;
        fprintf(out, "(any and not any)"); /* a specifier that no tray meets cannot be written as one */
        return;
    }
    bool first = true;
    bit = 0;
    fprintf(out, "tray(");
    for (uint32_t f = 0; f < schema->field_count; bit += schema->fields[f++].value_count)
        first &= !print_item(&schema->fields[f], mask >> bit & ((UINT64_C(1) << schema->fields[f].value_count) - 1),
                             first, out);
    fprintf(out, ")");
}

static void print_joined(const test_schema *schema, const test_rule *rule, FILE *out)
{
    fprintf(out, "(");
    for (uint32_t i = 0; i < rule->part_count; i++) {
        fprintf(out, "%s", i == 0 ? "" : rule->kind == TEST_AND ? " and " : " or ");
        test_rule_print(schema, rule->parts[i], out);
    }
    fprintf(out, ")");
}

static void print_distance(const test_schema *schema, const test_rule *rule, FILE *out)
{
    static const char *const words[] = {"distance(from ", ", to ", ", by "};
    for (uint32_t i = 0; i < 3; i++) {
        fprintf(out, "%s", words[i]);
        test_rule_print(schema, rule->parts[i], out);
    }
    fprintf(out, ")");
}

void test_rule_print(const test_schema *schema, const test_rule *rule, FILE *out)
{
    static const char *const names[] = {[TEST_NOT] = "not ",
                                        [TEST_NEIGHBOUR] = "neighbour(",
                                        [TEST_SYMMETRIC] = "symmetric ",
                                        [TEST_QUANTITY] = "quantity(",
                                        [TEST_SUM] = "sum(",
                                        [TEST_OCCURRENCES] = "occurrences(",
                                        [TEST_MANY] = "many("};
    if (rule->kind == TEST_TRAY) {
        test_mask_print(schema, rule->mask, out);
        return;
    }
    if (rule->kind == TEST_AND || rule->kind == TEST_OR) {
        print_joined(schema, rule, out);
        return;
    }
    if (rule->kind == TEST_DISTANCE) {
        print_distance(schema, rule, out);
        return;
    }
    fprintf(out, "%s%s", names[rule->kind], rule->beginning ? "beginning, " : "");
    if (rule->kind == TEST_SUM)
        fprintf(out, "%s of ", schema->fields[rule->field].name);
    for (uint32_t i = 0; i < rule->part_count; i++) {
        fprintf(out, "%s%s", i > 0 ? ", " : "", rule->optional[i] ? "optional(" : "");
        test_rule_print(schema, rule->parts[i], out);
        fprintf(out, "%s", rule->optional[i] ? ")" : "");
    }
    if (rule->condition) {
        fprintf(out, ", ");
        print_condition(rule->condition, rule->kind == TEST_SUM, out);
    }
    fprintf(out, "%s%s", rule->end ? ", end" : "", rule->kind == TEST_NOT || rule->kind == TEST_SYMMETRIC ? "" : ")");
}

void test_schema_print(const test_schema *schema, FILE *out)
{
    fprintf(out, "schema %s {\n", schema->name);
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const test_field *field = &schema->fields[f];
        fprintf(out, "  %s%s =%s", field->kind == TN_FIELD_ZONE ? "zone " : "", field->name,
                field->kind == TN_FIELD_FLAG ? " flag" : "");
        for (uint32_t v = 0; v < field->value_count && field->kind != TN_FIELD_FLAG; v++) {
            const test_value *value = &field->values[v];
            bool repeated = v > 0 && field->kind == TN_FIELD_ZONE && value->name == field->values[v - 1].name;
            bool goes_on =
                v + 1 < field->value_count && field->kind == TN_FIELD_ZONE && value->name == field->values[v + 1].name;
            if (repeated)
                fprintf(out, ", %s", value->measure);
            else
                fprintf(out, "%s %s%s%s", v > 0 ? " |" : "", value->name, value->measure[0] ? "(" : "", value->measure);
            fprintf(out, "%s", value->measure[0] && !goes_on ? ")" : "");
        }
        fprintf(out, "\n");
    }
    for (uint32_t i = 0; i < schema->forbid_count; i++) {
        fprintf(out, "  forbid ");
        test_mask_print(schema, schema->forbids[i], out);
        fprintf(out, "\n");
    }
    fprintf(out, "}\n");
}
