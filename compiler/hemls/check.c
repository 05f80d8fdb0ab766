/* Finds out what a HEMLS file means: numbers edges, reads seed and predecessors, checks successors, groups rules. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/hemls/hemls.h"

typedef struct check {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    const tn_hemls_file *file;
    tn_checked_growth *growth;
    const tn_hemls_symbol *letter, *numbered; /* the first of each kind */
    uint32_t letters[26];                     /* numbers plus one, by first appearance */
    uint32_t letter_count;
    const tn_hemls_line *seed, *angle, *branch_angle, *sync, *even;
    tn_checked_rewrite *rules, *last_rule;
    uint32_t rule_count, successor_count;
    bool mixed; /* was reported */
} check;

/* ---- edges */

static tn_checked_label *find_label(check *c, uint32_t number, const char *name)
{
    tn_checked_label **at = &c->growth->labels;
    while (*at && (*at)->number < number)
        at = &(*at)->next;
    if (*at && (*at)->number == number)
        return *at;
    tn_checked_label *label = TN_NEW(c->arena, tn_checked_label);
    if (!label)
        return NULL;
    label->number = number;
    label->name = name;
    label->next = *at;
    *at = label;
    c->growth->label_count++;
    return label;
}

/* Letters are numbered in the order in which the file first names them. */
static void number_edge(check *c, tn_hemls_symbol *edge)
{
    if (edge->broken)
        return;
    const tn_hemls_symbol **first = edge->letter ? &c->letter : &c->numbered;
    if (!*first)
        *first = edge;
    if (c->letter && c->numbered && !c->mixed) {
        c->mixed = true;
        tn_diagnostic *d =
            tn_report(c->diagnostics, E_MIXED_NAMES, edge->span, "`%s` mixes letters and numbered edges", edge->name);
        tn_note(c->diagnostics, d, edge->letter ? &c->numbered->span : &c->letter->span, "the other kind is here");
        tn_help(c->diagnostics, d, "name all edges by letters (`A`) or all by numbers (`Edge0`)");
    }
    if (edge->letter) {
        uint32_t *number = &c->letters[edge->name[0] - 'A'];
        if (*number == 0)
            *number = ++c->letter_count;
        edge->number = *number - 1;
    }
    if (c->growth->label_count < TN_LABELS_MAX)
        find_label(c, edge->number, edge->name);
}

static void number_symbols(check *c, const tn_hemls_symbols *symbols)
{
    for (tn_hemls_symbol *s = symbols->first; s; s = s->next)
        if (s->kind == TN_HEMLS_EDGE)
            number_edge(c, s);
}

static void number_edges(check *c)
{
    for (const tn_hemls_line *line = c->file->first; line; line = line->next) {
        number_symbols(c, &line->symbols);
        for (const tn_hemls_alternative *a = line->alternatives.first; a; a = a->next)
            number_symbols(c, &a->symbols);
    }
    if (c->growth->label_count == TN_LABELS_MAX)
        tn_report(c->diagnostics, E_TOO_MANY, c->file->first->span, "this file names more edges than the limit of %u",
                  TN_LABELS_MAX - 1);
}

static void made(check *c, uint32_t number)
{
    for (tn_checked_label *label = c->growth->labels; label; label = label->next)
        if (label->number == number)
            label->made = true;
}

/* ---- settings */

static void set_once(check *c, const tn_hemls_line **setting, const tn_hemls_line *line, const char *name)
{
    if (!*setting) {
        *setting = line;
        return;
    }
    tn_diagnostic *d = tn_report(c->diagnostics, E_SET_TWICE, line->span, "%s is there twice", name);
    tn_note(c->diagnostics, d, &(*setting)->span, "the first is here");
    tn_help(c->diagnostics, d, "leave one of them out");
}

static double angle_of(check *c, const tn_hemls_line *line, double otherwise)
{
    if (!line)
        return otherwise;
    if (line->number > 360) {
        tn_diagnostic *d =
            tn_report(c->diagnostics, E_ANGLE_RANGE, line->span, "an angle lies between 0 and 360 degrees");
        tn_help(c->diagnostics, d, "usual ones are 30, 45, 60 and 90");
    }
    return line->number;
}

static void read_settings(check *c)
{
    for (const tn_hemls_line *line = c->file->first; line; line = line->next) {
        if (line->kind == TN_HEMLS_ANGLE)
            set_once(c, &c->angle, line, "Angle");
        else if (line->kind == TN_HEMLS_BRANCH_ANGLE)
            set_once(c, &c->branch_angle, line, "BranchAngle");
        else if (line->kind == TN_HEMLS_SYNC)
            set_once(c, &c->sync, line, "Sync");
        else if (line->kind == TN_HEMLS_EVEN)
            set_once(c, &c->even, line, "Even");
    }
    if (!c->angle && !c->file->damaged && c->file->first) {
        tn_diagnostic *d = tn_report(c->diagnostics, E_NO_ANGLE, c->file->last->span,
                                     "the file does not say by what Angle the turtle turns");
        tn_help(c->diagnostics, d, "add a line such as `Angle 90`");
    }
    c->growth->angle = angle_of(c, c->angle, 90);
    c->growth->branch_angle = angle_of(c, c->branch_angle, 30); /* Genr8's own */
    c->growth->sync = c->sync != NULL;
    c->growth->even = c->even != NULL;
}

/* ---- the seed */

static void bad_seed(check *c, const tn_hemls_symbol *symbol, const char *why)
{
    tn_diagnostic *d = tn_report(c->diagnostics, E_BAD_SEED, symbol->span, "%s", why);
    tn_help(c->diagnostics, d, "the first line is the seed: edges with `+` between them, as in `A + B + A + B`");
}

static void read_seed_symbol(check *c, const tn_hemls_symbol *s, bool *wants_edge, const tn_hemls_symbol **tilde)
{
    tn_checked_growth *growth = c->growth;
    if (s->kind == TN_HEMLS_TILDE) {
        *tilde = *tilde ? NULL : s;
    } else if (s->kind == TN_HEMLS_TURN && s->sign == '+') {
        if (*wants_edge)
            bad_seed(c, s, "an edge is missing before this `+`");
        *wants_edge = true;
    } else if (s->kind == TN_HEMLS_EDGE) {
        if (!*wants_edge)
            bad_seed(c, s, "a `+` is missing before this edge");
        if (s->age != TN_AGE_ZERO) {
            tn_diagnostic *d = tn_report(c->diagnostics, E_MISPLACED_AGE, s->span,
                                         "the edges of a seed are new: they have no other age");
            tn_help(c->diagnostics, d, "write `%s`", s->name);
        }
        growth->axiom[growth->axiom_count] = s->number;
        growth->axiom_reversed[growth->axiom_count++] = *tilde != NULL;
        made(c, s->number);
        *wants_edge = false;
        *tilde = NULL;
    } else {
        bad_seed(c, s, "a seed has only edges, `+` and `~`");
    }
}

static void read_seed(check *c)
{
    const tn_hemls_line *line = c->seed;
    size_t count = 0;
    for (const tn_hemls_symbol *s = line->symbols.first; s; s = s->next)
        count += s->kind == TN_HEMLS_EDGE;
    c->growth->axiom_span = line->span;
    c->growth->axiom = TN_NEW_ARRAY(c->arena, uint32_t, count + 1);
    c->growth->axiom_reversed = TN_NEW_ARRAY(c->arena, bool, count + 1);
    if (!c->growth->axiom || !c->growth->axiom_reversed)
        return;
    size_t errors = c->diagnostics->error_count;
    bool wants_edge = true;
    const tn_hemls_symbol *tilde = NULL;
    for (const tn_hemls_symbol *s = line->symbols.first; s; s = s->next)
        read_seed_symbol(c, s, &wants_edge, &tilde);
    if (tilde) {
        tn_diagnostic *d = tn_report(c->diagnostics, E_DANGLING_TILDE, tilde->span, "no edge follows this `~`");
        tn_help(c->diagnostics, d, "`~` turns round the next edge; leave it out or move it");
    }
    if (c->diagnostics->error_count > errors)
        return;
    if (wants_edge)
        bad_seed(c, line->symbols.last, "an edge is missing after this");
    else if (c->growth->axiom_count < 3) {
        tn_diagnostic *d =
            tn_report(c->diagnostics, E_SEED_TOO_SHORT, line->span,
                      "a seed is a polygon: it has at least three edges, not %u", c->growth->axiom_count);
        tn_help(c->diagnostics, d, "`A + A + A` is a triangle");
    } else if (c->growth->axiom_count > TN_AXIOM_MAX) {
        tn_report(c->diagnostics, E_TOO_MANY, line->span, "this seed has more edges than the limit of %u",
                  TN_AXIOM_MAX);
    }
}

/* A word that is no edge, alone on its line: that was reported, and what it is meant to be is no seed. */
static bool is_unknown_word(const tn_hemls_line *line)
{
    const tn_hemls_symbol *only = line->symbols.first;
    return only && !only->next && only->broken;
}

static void find_seed(check *c)
{
    for (const tn_hemls_line *line = c->file->first; line; line = line->next) {
        if (line->kind != TN_HEMLS_AXIOM || is_unknown_word(line))
            continue;
        if (c->seed || line != c->file->first) {
            tn_diagnostic *d = tn_report(c->diagnostics, c->seed ? E_TWO_SEEDS : E_BAD_SEED, line->span,
                                         c->seed ? "this line has no `->`, and the seed is there already"
                                                 : "the seed has to be the first line");
            tn_help(c->diagnostics, d,
                    c->seed ? "a rule is written `A -> A B`" : "move it above the rules and settings");
        }
        c->seed = c->seed ? c->seed : line;
    }
    if (c->seed) {
        read_seed(c);
    } else if (!c->file->damaged) {
        tn_span span = c->file->first ? c->file->first->span : (tn_span){c->growth->span.file, 0, 0};
        tn_diagnostic *d = tn_report(c->diagnostics, E_BAD_SEED, span, "the file has no seed");
        tn_help(c->diagnostics, d, "the first line is the seed: edges with `+` between them, as in `A + B + A + B`");
    }
}

/* ---- rules */

static bool bad_predecessor(check *c, tn_span span, const char *why)
{
    tn_diagnostic *d = tn_report(c->diagnostics, E_BAD_PREDECESSOR, span, "%s", why);
    tn_help(c->diagnostics, d,
            "before `->` stands an edge (`A`), a chain (`A B`), or an edge with its context (`A < B > C`)");
    return false;
}

static bool check_age(check *c, const tn_hemls_symbol *s, bool may_name)
{
    if (s->age == TN_AGE_ZERO || (s->age == TN_AGE_KEEP && may_name))
        return true;
    tn_diagnostic *d = tn_report(c->diagnostics, E_MISPLACED_AGE, s->span, "an age does not belong here");
    tn_help(c->diagnostics, d, "write `%s`; successors say what becomes of the age, and `If i < 3` asks for it",
            s->name);
    return false;
}

/* A, A B ..., L < A, A > R or L < A > R. */
static bool read_predecessor(check *c, const tn_hemls_line *line, tn_checked_rewrite *rule)
{
    const tn_hemls_symbol *less = NULL, *greater = NULL;
    size_t edges = 0;
    for (const tn_hemls_symbol *s = line->symbols.first; s; s = s->next) {
        if (s->kind == TN_HEMLS_EDGE) {
            edges++;
        } else if (s->kind == TN_HEMLS_LESS || s->kind == TN_HEMLS_GREATER) {
            const tn_hemls_symbol **side = s->kind == TN_HEMLS_LESS ? &less : &greater;
            if (*side || (s->kind == TN_HEMLS_LESS && greater))
                return bad_predecessor(c, s->span, "a context is written `A < B > C`");
            *side = s;
        } else {
            return bad_predecessor(c, s->span, "turns, brackets and `~` do not belong before `->`");
        }
    }
    const tn_hemls_symbol *first = line->symbols.first, *last = line->symbols.last;
    size_t contexts = (less != NULL) + (greater != NULL);
    if ((less && (first->next != less || less == last)) || (greater && (greater->next != last || greater == first)) ||
        edges <= contexts)
        return bad_predecessor(c, line->span, "a context is one edge on its side of `<` or `>`");
    if (contexts > 0 && edges != contexts + 1)
        return bad_predecessor(c, line->span, "a chain of edges cannot have a context");
    if (edges > TN_CHAIN_MAX)
        return bad_predecessor(c, line->span, "a chain has 64 edges at most");
    rule->left = less ? first->number : TN_NO_LABEL;
    rule->right = greater ? last->number : TN_NO_LABEL;
    rule->numbers = TN_NEW_ARRAY(c->arena, uint32_t, edges);
    if (!rule->numbers)
        return false;
    bool fine = true;
    for (const tn_hemls_symbol *s = first; s; s = s->next) {
        bool context = (less && s == first) || (greater && s == last);
        if (s->kind != TN_HEMLS_EDGE)
            continue;
        fine = check_age(c, s, !context) && fine;
        if (!context)
            rule->numbers[rule->number_count++] = s->number;
    }
    return fine;
}

static void read_alternatives(check *c, const tn_hemls_line *line, tn_checked_rewrite *rule)
{
    tn_checked_alternative **at = &rule->alternatives;
    double weight = 0;
    const tn_hemls_choice *choice = NULL;
    for (const tn_hemls_alternative *a = line->alternatives.first; a; a = a->next) {
        tn_checked_alternative *one = TN_NEW(c->arena, tn_checked_alternative);
        if (!one)
            return;
        one->successor = (tn_checked_successor){.symbols = &a->symbols, .span = a->span};
        tn_hemls_check_successor(c->arena, c->diagnostics, c->growth->angle, &one->successor);
        for (const tn_hemls_symbol *s = a->symbols.first; s; s = s->next)
            if (s->kind == TN_HEMLS_EDGE)
                made(c, s->number);
        one->choice = a->choice;
        *at = one;
        at = &one->next;
        rule->alternative_count++;
        c->successor_count++;
        rule->conditional |= a->choice.comparison != TN_ALWAYS;
        weight += a->choice.value;
        if (a->choice.weighted)
            choice = &a->choice;
    }
    if (choice && !rule->conditional && weight <= 0) {
        tn_diagnostic *d = tn_report(c->diagnostics, W_NEVER_FIRES, choice->span, "this rule is never applied");
        tn_help(c->diagnostics, d, "all its weights are 0: give one of them a larger one");
    } else if (choice && (rule->conditional || rule->alternative_count == 1)) {
        tn_diagnostic *d = tn_report(c->diagnostics, W_IGNORED_CHOICE, choice->span, "this weight has no effect");
        tn_help(c->diagnostics, d,
                rule->conditional ? "where a rule has conditions, the first that holds decides"
                                  : "weights choose between several `->` of one rule");
    }
}

static void read_rule(check *c, const tn_hemls_line *line)
{
    tn_checked_rewrite *rule = TN_NEW(c->arena, tn_checked_rewrite);
    if (!rule)
        return;
    rule->span = line->span;
    bool fine = read_predecessor(c, line, rule);
    read_alternatives(c, line, rule);
    if (!fine)
        return;
    if (c->last_rule)
        c->last_rule->next = rule;
    else
        c->rules = rule;
    c->last_rule = rule;
    c->rule_count++;
}

/* ---- groups */

static uint32_t contexts_of(const tn_checked_rewrite *rule)
{
    return (uint32_t)(rule->left != TN_NO_LABEL) + (rule->right != TN_NO_LABEL);
}

static bool same_predecessor(const tn_checked_rewrite *a, const tn_checked_rewrite *b)
{
    return a->number_count == b->number_count &&
           memcmp(a->numbers, b->numbers, a->number_count * sizeof *a->numbers) == 0;
}

static bool always_applies(const tn_checked_rewrite *rule)
{
    double weight = 0;
    for (const tn_checked_alternative *a = rule->alternatives; a; a = a->next) {
        if (a->choice.comparison != TN_ALWAYS)
            continue;
        weight += a->choice.value;
        if (rule->alternative_count == 1)
            return true;
    }
    return !rule->conditional && weight > 0;
}

static void insert_rule(check *c, tn_checked_group *group, tn_checked_rewrite *rule)
{
    tn_checked_rewrite **at = &group->rules;
    for (; *at && contexts_of(*at) >= contexts_of(rule); at = &(*at)->next_in_group) {
        bool covers = (*at)->left == rule->left && (*at)->right == rule->right && always_applies(*at);
        if (!covers)
            continue;
        tn_diagnostic *d = tn_report(c->diagnostics, W_NEVER_FIRES, rule->span, "this rule never comes to its turn");
        tn_note(c->diagnostics, d, &(*at)->span, "this one always applies first");
        tn_help(c->diagnostics, d,
                "for a choice between both, give them weights under one predecessor: `A -> ... Weight 1` and "
                "`-> ... Weight 1`");
        break;
    }
    while (*at && contexts_of(*at) >= contexts_of(rule))
        at = &(*at)->next_in_group;
    rule->next_in_group = *at;
    *at = rule;
    group->rule_count++;
}

static void group_rules(check *c)
{
    tn_checked_group **end = &c->growth->groups;
    for (tn_checked_rewrite *rule = c->rules; rule; rule = rule->next) {
        tn_checked_group *group = c->growth->groups;
        while (group && !same_predecessor(group->rules, rule))
            group = group->next;
        if (!group) {
            group = *end = TN_NEW(c->arena, tn_checked_group);
            if (!group)
                return;
            end = &group->next;
        }
        insert_rule(c, group, rule);
    }
}

/* ---- warnings */

static bool is_made(const check *c, uint32_t number)
{
    for (const tn_checked_label *label = c->growth->labels; label; label = label->next)
        if (label->number == number)
            return label->made;
    return false;
}

static const char *name_of(const check *c, uint32_t number)
{
    for (const tn_checked_label *label = c->growth->labels; label; label = label->next)
        if (label->number == number)
            return label->name;
    return "?";
}

static void warn_of_rule(check *c, const tn_checked_rewrite *rule)
{
    uint32_t missing = TN_NO_LABEL;
    for (uint32_t i = 0; i < rule->number_count; i++)
        if (!is_made(c, rule->numbers[i]))
            missing = rule->numbers[i];
    if (rule->left != TN_NO_LABEL && !is_made(c, rule->left))
        missing = rule->left;
    if (rule->right != TN_NO_LABEL && !is_made(c, rule->right))
        missing = rule->right;
    if (missing != TN_NO_LABEL) {
        tn_diagnostic *d = tn_report(c->diagnostics, W_NEVER_OCCURS, rule->span,
                                     "nothing ever draws the edge `%s` that this rule waits for", name_of(c, missing));
        tn_help(c->diagnostics, d, "draw it in the seed or in a successor, or leave the rule out");
    }
    if (rule->number_count == 1)
        return;
    for (const tn_checked_rewrite *other = c->rules; other != rule; other = other->next) {
        if (other->number_count != 1 || other->numbers[0] != rule->numbers[0] || contexts_of(other) ||
            !always_applies(other))
            continue;
        tn_diagnostic *d =
            tn_report(c->diagnostics, W_CHAIN_STARVES, rule->span, "this chain never finds its first edge");
        tn_note(c->diagnostics, d, &other->span, "this rule has replaced it by then");
        tn_help(c->diagnostics, d, "write the rule for the chain above the rule for the single edge");
        return;
    }
}

tn_checked_growth *tn_check_hemls(tn_arena *arena, tn_diagnostics *diagnostics, const tn_hemls_file *file,
                                  uint32_t source)
{
    check c = {.arena = arena, .diagnostics = diagnostics, .file = file, .growth = TN_NEW(arena, tn_checked_growth)};
    if (!c.growth)
        return NULL;
    size_t errors = diagnostics->error_count;
    const char *path = diagnostics->sources->files[source].path, *slash = strrchr(path, '/');
    const char *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    c.growth->name = tn_arena_copy(arena, base, dot && dot > base ? (size_t)(dot - base) : strlen(base));
    c.growth->span = (tn_span){source, 0, 0};
    if (file->first)
        c.growth->span = tn_span_join(file->first->span, file->last->span);
    number_edges(&c);
    read_settings(&c);
    find_seed(&c);
    for (const tn_hemls_line *line = file->first; line; line = line->next)
        if (line->kind == TN_HEMLS_RULE)
            read_rule(&c, line);
    if (c.successor_count > TN_TEMPLATES_MAX)
        tn_report(diagnostics, E_TOO_MANY, c.growth->span, "this file has more successors than the limit of %u",
                  TN_TEMPLATES_MAX);
    if (tn_arena_failed(arena) || diagnostics->error_count > errors || file->damaged)
        return NULL;
    group_rules(&c);
    for (const tn_checked_rewrite *rule = c.rules; rule; rule = rule->next)
        warn_of_rule(&c, rule);
    return tn_arena_failed(arena) ? NULL : c.growth;
}
