/* Pictures of plans and rules in a build without the part `draw`: there are none. */
#include "runtime/base/part.h"
#include "runtime/plan/picture/draw.h"
#include "runtime/plan/picture/draw_explain.h"
#include "runtime/plan/picture/draw_open.h"
#include "runtime/plan/picture/draw_rule.h"

tn_status tn_plans_draw(const tn_schema *schema, const tn_drawn_plan *plans, size_t count,
                        const tn_draw_options *options, tn_picture *to, tn_error *error)
{
    (void)schema, (void)plans, (void)count, (void)options, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing plans", error);
}

tn_drawn_rule tn_drawn_rule_of(const tn_module *module, uint32_t rule)
{
    (void)module, (void)rule;
    return (tn_drawn_rule){"", "", 0};
}

tn_status tn_rules_draw(const tn_schema *schema, const tn_drawn_rule *rules, size_t count, tn_picture *to,
                        tn_error *error)
{
    (void)schema, (void)rules, (void)count, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing rules", error);
}

tn_status tn_reasons_draw(const tn_schema *schema, const tn_drawn_reasons *drawn, tn_picture *to, tn_error *error)
{
    (void)schema, (void)drawn, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing an explanation", error);
}

tn_status tn_open_plan_draw(const tn_schema *schema, const tn_drawn_open *open, tn_picture *to, tn_error *error)
{
    (void)schema, (void)open, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing an open plan", error);
}
