/* The order of the rules: what a rule names comes before it. Rules that name each other in a circle stand side by side
 * (Tarjan, Depth-first search and linear graph algorithms, 1972), and what such a rule means is the least that all of
 * them say of one another. So a rule may use itself only through words that take more where their parts do, each round
 * has to take a tray, and one of the alternatives has to end.
 */
#include "compiler/plan/check/check.h"

enum { UNSEEN, OPEN, DONE };

typedef struct order_walk {
    tn_check *check;
    tn_checked_rule **path; /* the rules whose uses are being followed */
    size_t depth;
    tn_checked_rule **open; /* the rules whose circle, if they are in one, is not complete */
    size_t open_count;
    uint32_t seen, finished;
} order_walk;

/* ---- where a rule is used */

typedef struct use_place {
    bool found;
    bool takes;                /* something beside it takes a tray */
    const tn_ast_expr *around; /* a word through which no rule may use itself, or NULL */
} use_place;

static bool is_part(const tn_ast_expr *expr)
{
    return expr->kind != TN_EXPR_OPTIONAL && expr->kind != TN_EXPR_BEGINNING && expr->kind != TN_EXPR_END;
}

/* Does a neighbour take a tray beside this part of it? */
static bool takes_beside(const tn_ast_expr *neighbour, const tn_ast_expr *part)
{
    for (TN_EACH(const tn_ast_expr, other, neighbour->parts))
        if (other != part && is_part(other))
            return true;
    return false;
}

static bool goes_through(tn_expr_kind kind)
{
    return kind == TN_EXPR_OR || kind == TN_EXPR_NEIGHBOUR || kind == TN_EXPR_OPTIONAL || kind == TN_EXPR_REPEAT;
}

static use_place find_use(const tn_ast_expr *expr, const tn_ast_expr *use)
{
    if (expr == use)
        return (use_place){.found = true};
    for (int tests = 0; tests < 2; tests++) {
        for (TN_EACH(const tn_ast_expr, part, tests ? expr->tests : expr->parts)) {
            use_place place = find_use(part, use);
            if (!place.found)
                continue;
            if (!goes_through(expr->kind))
                place.around = expr;
            place.takes |= (expr->kind == TN_EXPR_NEIGHBOUR && takes_beside(expr, part)) ||
                           (expr->kind == TN_EXPR_REPEAT && expr->least > 1);
            return place;
        }
    }
    return (use_place){0};
}

/* What is not found in the parts stands in a sum, or in what a tray is compared by. */
static use_place place_of(const tn_checked_rule *rule, size_t use)
{
    use_place place = find_use(rule->ast->body, rule->use_places[use]);
    if (!place.found || rule->is_measure)
        place.around = rule->ast->body;
    return place;
}

/* ---- circles */

typedef struct circle {
    tn_check *check;
    tn_checked_rule **members; /* in the order in which they were finished */
    size_t count;
} circle;

static bool is_member(const circle *c, const tn_checked_rule *rule)
{
    return rule->circle == c->members[0]->circle;
}

/* Which uses a circle is looked for along. */
typedef bool uses_of(const tn_checked_rule *rule, size_t use);

static bool every_use(const tn_checked_rule *rule, size_t use)
{
    (void)rule;
    (void)use;
    return true;
}

static bool takes_nothing(const tn_checked_rule *rule, size_t use)
{
    return !place_of(rule, use).takes;
}

/* The shortest way from one member to another: along each, `next_use` becomes the use that leads on. Returns its
 * length, 0 where there is none. Breadth first, from the end backwards. */
static size_t find_way(const circle *c, const tn_checked_rule *from, const tn_checked_rule *to, uses_of *counts)
{
    size_t *length = TN_NEW_ARRAY(c->check->arena, size_t, c->count);
    for (size_t round = 1; length && round <= c->count; round++)
        for (size_t m = 0; m < c->count; m++) {
            tn_checked_rule *rule = c->members[m];
            for (size_t i = 0; length[m] == 0 && i < rule->use_count; i++) {
                size_t k = 0;
                while (k < c->count && c->members[k] != rule->uses[i])
                    k++;
                bool leads = rule->uses[i] == to ? round == 1 : k < c->count && length[k] > 0 && length[k] + 1 == round;
                if (k == c->count || !leads || !counts(rule, i))
                    continue;
                rule->next_use = i;
                length[m] = round;
            }
        }
    for (size_t m = 0; length && m < c->count; m++)
        if (c->members[m] == from)
            return length[m];
    return 0;
}

/* Notes by which uses a rule comes back to itself, from one of them on. */
static void note_way(const circle *c, tn_diagnostic *d, const tn_checked_rule *rule, size_t use, uses_of *counts)
{
    enum { SHOWN = 8 };
    tn_diagnostics *diagnostics = c->check->diagnostics;
    const tn_checked_rule *first = rule, *at = rule->uses[use];
    tn_note(diagnostics, d, &rule->use_places[use]->node.span, "`%s` uses `%s` here", rule->name, at->name);
    size_t length = at == first ? 0 : find_way(c, at, first, counts);
    for (size_t i = 0; i < length && i + 1 < SHOWN; i++) {
        const tn_ast_expr *place = at->use_places[at->next_use];
        tn_note(diagnostics, d, &place->node.span, "`%s` uses `%s` here", at->name, at->uses[at->next_use]->name);
        at = at->uses[at->next_use];
    }
}

static const char *by_way(const circle *c)
{
    return c->count > 1 ? ", by way of others" : "";
}

static void report_around(const circle *c, const tn_checked_rule *rule, size_t use)
{
    tn_diagnostics *diagnostics = c->check->diagnostics;
    tn_diagnostic *d = tn_report(diagnostics, E_RULE_CYCLE, rule->ast->name->node.span, "%s `%s` uses itself%s",
                                 rule->is_measure ? "measure" : "rule", rule->name, by_way(c));
    note_way(c, d, rule, use, every_use);
    if (rule->is_measure)
        tn_help(diagnostics, d, "write out what one of them means instead of naming the other");
    else
        tn_help(diagnostics, d,
                "a rule may use itself through `or`, `neighbour`, `optional` and `repeat` alone; write out what it "
                "means here");
}

static bool report_template(const circle *c)
{
    tn_diagnostics *diagnostics = c->check->diagnostics;
    for (size_t m = 0; m < c->count; m++) {
        const tn_checked_rule *rule = c->members[m];
        if (!rule->hidden || !rule->of->is_template)
            continue;
        tn_diagnostic *d = tn_report(diagnostics, E_RULE_CYCLE, rule->ast->name->node.span, "rule `%s` uses itself%s",
                                     rule->name, by_way(c));
        for (size_t i = 0; i < rule->use_count; i++)
            if (is_member(c, rule->uses[i])) {
                note_way(c, d, rule, i, every_use);
                break;
            }
        tn_help(diagnostics, d, "a rule with parameters is written out where it is called: it cannot use itself");
        return true;
    }
    return false;
}

/* Round and round without a tray. */
static bool report_standing(const circle *c)
{
    tn_diagnostics *diagnostics = c->check->diagnostics;
    for (size_t m = 0; m < c->count; m++) {
        const tn_checked_rule *rule = c->members[m];
        for (size_t i = 0; i < rule->use_count; i++) {
            const tn_checked_rule *used = rule->uses[i];
            if (!is_member(c, used) || !takes_nothing(rule, i) ||
                (used != rule && find_way(c, used, rule, takes_nothing) == 0))
                continue;
            tn_diagnostic *d = tn_report(diagnostics, E_RULE_CYCLE, rule->ast->name->node.span,
                                         "rule `%s` uses itself, and no tray lies between", rule->name);
            note_way(c, d, rule, i, takes_nothing);
            tn_help(diagnostics, d, "each round has to take a tray: `neighbour(tray(...), %s)`", rule->name);
            return true;
        }
    }
    return false;
}

/* ---- does it come to an end? */

static bool may_end(const circle *c, const tn_ast_expr *expr)
{
    bool any = expr->kind == TN_EXPR_OR, good = !any;
    if (expr->kind == TN_EXPR_NAME)
        return !expr->rule || !is_member(c, expr->rule) || expr->rule->ends;
    if (!goes_through(expr->kind) || expr->kind == TN_EXPR_OPTIONAL)
        return true;
    for (TN_EACH(const tn_ast_expr, part, expr->parts))
        good = any ? good || may_end(c, part) : good && may_end(c, part);
    return good;
}

static bool report_endless(const circle *c)
{
    tn_diagnostics *diagnostics = c->check->diagnostics;
    for (size_t round = 0; round < c->count; round++)
        for (size_t m = 0; m < c->count; m++)
            c->members[m]->ends = may_end(c, c->members[m]->ast->body);
    for (size_t m = 0; m < c->count; m++) {
        const tn_checked_rule *rule = c->members[m];
        if (rule->ends)
            continue;
        tn_diagnostic *d = tn_report(diagnostics, E_RULE_CYCLE, rule->ast->name->node.span,
                                     "rule `%s` always needs itself, so that no row of trays is one", rule->name);
        for (size_t i = 0; i < rule->use_count; i++)
            if (is_member(c, rule->uses[i])) {
                note_way(c, d, rule, i, every_use);
                break;
            }
        tn_help(diagnostics, d, "give it an alternative that ends: `tray(...) or ...`");
        return true;
    }
    return false;
}

/* false: reported. */
static bool is_good(const circle *c)
{
    bool older = true; /* what is wrong with rules of an older schema was said there */
    for (size_t m = 0; m < c->count; m++)
        older = older && c->members[m]->hidden && !c->members[m]->of->is_template;
    for (size_t m = 0; m < c->count; m++)
        for (size_t i = 0; i < c->members[m]->use_count; i++)
            if (is_member(c, c->members[m]->uses[i]) && place_of(c->members[m], i).around) {
                if (!older)
                    report_around(c, c->members[m], i);
                return false;
            }
    return !report_template(c) && (older || (!report_standing(c) && !report_endless(c)));
}

/* A bad circle is cut open where it closes. */
static void mark_uses(const circle *c, bool good)
{
    for (size_t m = 0; m < c->count; m++) {
        tn_checked_rule *rule = c->members[m];
        for (size_t i = 0; i < rule->use_count; i++) {
            tn_checked_rule *used = rule->uses[i];
            if (!is_member(c, used))
                continue;
            rule->use_places[i]->again = good;
            if (!good && used->finished >= rule->finished)
                rule->use_places[i]->rule = NULL;
        }
        if (!good)
            rule->circle = NULL;
    }
}

void tn_check_circle(tn_checked_rule *const *members)
{
    size_t count = members[0]->circle_size;
    bool settable = false;
    for (size_t m = 0; m < count; m++) {
        members[m]->min_trays = TN_NONE;
        settable |= members[m]->settable;
        for (size_t i = 0; i < members[m]->use_count; i++)
            settable |= members[m]->uses[i]->settable;
    }
    for (size_t round = 0; round <= count; round++)
        for (size_t m = 0; m < count; m++)
            members[m]->min_trays = tn_min_trays(members[m]->ast->body);
    for (size_t m = 0; m < count; m++)
        members[m]->settable = settable;
}

/* ---- the order */

/* The rule on top of the path, and what is open above it, are complete. */
static void complete(order_walk *walk, tn_checked_rule *rule)
{
    tn_checked *result = walk->check->result;
    tn_checked_rule **members = result->order + result->ordered;
    size_t count = 0;
    do {
        tn_checked_rule *member = walk->open[--walk->open_count];
        size_t at = count++;
        for (; at > 0 && members[at - 1]->finished > member->finished; at--)
            members[at] = members[at - 1];
        members[at] = member;
        member->state = DONE;
    } while (walk->open_count > 0 && walk->open[walk->open_count - 1]->number >= rule->number);
    result->ordered += count;
    bool uses_itself = count > 1;
    for (size_t i = 0; i < rule->use_count; i++)
        uses_itself |= rule->uses[i] == rule;
    if (!uses_itself)
        return;
    circle c = {.check = walk->check, .members = members, .count = count};
    for (size_t m = 0; m < count; m++)
        members[m]->circle = members[0];
    members[0]->circle_size = count;
    mark_uses(&c, is_good(&c));
}

static void enter(order_walk *walk, tn_checked_rule *rule)
{
    rule->state = OPEN;
    rule->number = rule->lowest = ++walk->seen;
    walk->path[walk->depth++] = rule;
    walk->open[walk->open_count++] = rule;
}

static void follow(order_walk *walk, tn_checked_rule *rule)
{
    tn_checked_rule *used = rule->uses[rule->next_use++];
    if (used->state == UNSEEN)
        enter(walk, used);
    else if (used->state == OPEN && used->number < rule->lowest)
        rule->lowest = used->number;
}

static void finish(order_walk *walk, tn_checked_rule *rule)
{
    rule->finished = ++walk->finished;
    walk->depth--;
    if (rule->lowest == rule->number)
        complete(walk, rule);
    else if (rule->lowest < walk->path[walk->depth - 1]->lowest)
        walk->path[walk->depth - 1]->lowest = rule->lowest;
}

void tn_check_order(tn_check *check)
{
    tn_checked *result = check->result;
    order_walk walk = {.check = check,
                       .path = TN_NEW_ARRAY(check->arena, tn_checked_rule *, result->rule_count),
                       .open = TN_NEW_ARRAY(check->arena, tn_checked_rule *, result->rule_count)};
    if (!walk.path || !walk.open)
        return;
    for (size_t i = 0; i < result->rule_count; i++) {
        if (result->rules[i]->state != UNSEEN)
            continue;
        enter(&walk, result->rules[i]);
        while (walk.depth > 0) {
            tn_checked_rule *rule = walk.path[walk.depth - 1];
            if (rule->next_use < rule->use_count)
                follow(&walk, rule);
            else
                finish(&walk, rule);
        }
    }
}
