/* Each case below is one line of the equations in docs/plan-language.md, written as a search over (i, j). */
#include <string.h>

#include "tests/support/test_rule.h"

static bool whole(test_brute *brute, const test_rule *rule, bool reversed, uint32_t i, uint32_t j);
static bool holds(test_brute *brute, const test_rule *rule, bool reversed, uint32_t i, uint32_t j);

bool test_condition_holds(const test_condition *condition, int64_t n)
{
    switch (condition->opcode) {
    case TN_OP_LESS:
        return n < condition->first;
    case TN_OP_EQUAL:
        return n == condition->first;
    case TN_OP_GREATER:
        return n > condition->first;
    case TN_OP_WITHIN:
        return condition->first <= n && n <= condition->second;
    case TN_OP_REMAINDER:
        return n % condition->first == condition->second;
    case TN_OP_BOTH:
        return test_condition_holds(condition->parts[0], n) && test_condition_holds(condition->parts[1], n);
    case TN_OP_EITHER:
        return test_condition_holds(condition->parts[0], n) || test_condition_holds(condition->parts[1], n);
    default:
        return !test_condition_holds(condition->parts[0], n);
    }
}

static const uint8_t *tray(const test_brute *brute, bool reversed, uint32_t k)
{
    return brute->plan->values[reversed ? brute->plan->length - 1 - k : k];
}

static bool tray_meets(const test_brute *brute, const test_rule *rule, bool reversed, uint32_t k)
{
    for (uint32_t f = 0; f < brute->schema->field_count; f++) {
        if (!(rule->mask >> test_schema_bit(brute->schema, f, tray(brute, reversed, k)[f]) & 1))
            return false;
    }
    return true;
}

/* exists i = c0 < c1 < ... < cn = j with M(pk, c(k-1), ck); an optional part may be left out */
static bool parts(test_brute *brute, const test_rule *rule, bool reversed, uint32_t part, uint32_t i, uint32_t j)
{
    if (part == rule->part_count || part == TEST_PARTS_MAX)
        return i == j;
    if (rule->optional[part] && parts(brute, rule, reversed, part + 1, i, j))
        return true;
    for (uint32_t c = i + 1; c <= j; c++) {
        if (whole(brute, rule->parts[part], reversed, i, c) && parts(brute, rule, reversed, part + 1, c, j))
            return true;
    }
    return false;
}

static int64_t counted(test_brute *brute, const test_rule *rule, bool reversed, uint32_t i, uint32_t j)
{
    int64_t n = 0;
    for (uint32_t k = i; k < j; k++) {
        bool counts = false;
        uint32_t last = rule->kind == TEST_OCCURRENCES ? j : k + 1;
        for (uint32_t b = k + 1; b <= last; b++)
            counts = counts || whole(brute, rule->parts[0], reversed, k, b);
        if (counts && rule->kind == TEST_SUM)
            n += brute->schema->fields[rule->field].values[tray(brute, reversed, k)[rule->field]].length;
        else
            n += counts;
    }
    return n;
}

static bool distant(test_brute *brute, const test_rule *rule, bool reversed, uint32_t i, uint32_t j)
{
    if (i >= j || !whole(brute, rule->parts[0], reversed, i, j))
        return false;
    for (uint32_t a = 0; a < brute->plan->length; a++) {
        for (uint32_t b = a + 1; b <= brute->plan->length; b++) {
            if (!whole(brute, rule->parts[1], reversed, a, b))
                continue;
            uint32_t from = b <= i ? b : j <= a ? j : i;
            uint32_t to = b <= i ? i : j <= a ? a : i;
            if (!whole(brute, rule->parts[2], reversed, from, to))
                return false;
        }
    }
    return true;
}

static bool every_single(test_brute *brute, const test_rule *rule, bool reversed, uint32_t i, uint32_t j)
{
    for (uint32_t k = i; k < j; k++) {
        if (!whole(brute, rule->parts[0], reversed, k, k + 1))
            return false;
    }
    return i < j;
}

static bool decide_whole(test_brute *brute, const test_rule *rule, bool reversed, uint32_t i, uint32_t j)
{
    uint32_t n = brute->plan->length;
    switch (rule->kind) {
    case TEST_TRAY:
        return j == i + 1 && tray_meets(brute, rule, reversed, i);
    case TEST_AND:
        return whole(brute, rule->parts[0], reversed, i, j) && whole(brute, rule->parts[1], reversed, i, j);
    case TEST_OR:
        return whole(brute, rule->parts[0], reversed, i, j) || whole(brute, rule->parts[1], reversed, i, j);
    case TEST_NOT:
        return !holds(brute, rule->parts[0], reversed, i, j);
    case TEST_NEIGHBOUR:
        return (!rule->beginning || i == 0) && (!rule->end || j == n) && parts(brute, rule, reversed, 0, i, j);
    case TEST_SYMMETRIC:
        return whole(brute, rule->parts[0], reversed, i, j) || whole(brute, rule->parts[0], !reversed, n - j, n - i);
    case TEST_QUANTITY:
    case TEST_SUM:
    case TEST_OCCURRENCES:
        return test_condition_holds(rule->condition, counted(brute, rule, reversed, i, j));
    case TEST_MANY:
        return every_single(brute, rule, reversed, i, j);
    case TEST_DISTANCE:
        return distant(brute, rule, reversed, i, j);
    }
    return false;
}

static bool decide_holds(test_brute *brute, const test_rule *rule, bool reversed, uint32_t i, uint32_t j)
{
    switch (rule->kind) {
    case TEST_AND:
        return holds(brute, rule->parts[0], reversed, i, j) && holds(brute, rule->parts[1], reversed, i, j);
    case TEST_OR:
        return holds(brute, rule->parts[0], reversed, i, j) || holds(brute, rule->parts[1], reversed, i, j);
    case TEST_NOT:
        return !holds(brute, rule->parts[0], reversed, i, j);
    case TEST_QUANTITY:
    case TEST_SUM:
    case TEST_OCCURRENCES:
        return whole(brute, rule, reversed, i, j);
    default:
        break;
    }
    for (uint32_t a = i; a < j; a++) {
        for (uint32_t b = a + 1; b <= j; b++) {
            if (whole(brute, rule, reversed, a, b))
                return true;
        }
    }
    return false;
}

static int8_t *place(test_brute *brute, uint32_t node, uint32_t judgement, bool reversed, uint32_t i, uint32_t j)
{
    size_t side = brute->plan->length + 1u;
    return &brute->memo[((((size_t)node * 2 + judgement) * 2 + reversed) * side + i) * side + j];
}

static bool whole(test_brute *brute, const test_rule *rule, bool reversed, uint32_t i, uint32_t j)
{
    int8_t *memo = place(brute, rule->id, 0, reversed, i, j);
    if (*memo == 0)
        *memo = decide_whole(brute, rule, reversed, i, j) ? 2 : 1;
    return *memo == 2;
}

static bool holds(test_brute *brute, const test_rule *rule, bool reversed, uint32_t i, uint32_t j)
{
    int8_t *memo = place(brute, rule->id, 1, reversed, i, j);
    if (*memo == 0)
        *memo = decide_holds(brute, rule, reversed, i, j) ? 2 : 1;
    return *memo == 2;
}

void test_brute_start(test_brute *brute, const test_schema *schema, const test_plan *plan)
{
    brute->schema = schema;
    brute->plan = plan;
    memset(brute->memo, 0, (size_t)TEST_NODES_MAX * 4 * (plan->length + 1u) * (plan->length + 1u));
}

bool test_brute_whole(test_brute *brute, const test_rule *rule, uint32_t i, uint32_t j)
{
    return whole(brute, rule, false, i, j);
}

bool test_brute_holds(test_brute *brute, const test_rule *rule, uint32_t i, uint32_t j)
{
    return holds(brute, rule, false, i, j);
}
