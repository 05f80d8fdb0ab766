/* Reads a rewrite system from a module's code: the turtle draws each successor, guards become rules. */
#include "runtime/growth/model/system.h"

#include <math.h>
#include <stdlib.h>

#include "runtime/math/elementary.h"

/* ==== the turtle of rewrite systems. Turns as in ABOP (P. Prusinkiewicz, A. Lindenmayer: "The Algorithmic Beauty of
 * Plants"): TURN turns the heading towards the left, PITCH down, ROLL rolls the left side down */

static tn_vector combine(tn_vector a, double s, tn_vector b, double t)
{
    return (tn_vector){a.x * s + b.x * t, a.y * s + b.y * t, a.z * s + b.z * t};
}

/* ---- moves */

/* The sine of a negative angle is that of the angle with the other sign, also where that is zero: so that a turn to the
 * right undoes one to the left in every bit that can be undone. */
static void find_angle(tn_turtle *t, double degrees)
{
    if (degrees == t->degrees && signbit(degrees) == signbit(t->degrees))
        return;
    double sine = tn_sin_degrees(fabs(degrees));
    t->degrees = degrees;
    t->cosine = tn_cos_degrees(fabs(degrees));
    t->sine = signbit(degrees) ? -sine : sine;
}

static void turn(tn_turtle *t, tn_opcode axis, double degrees)
{
    find_angle(t, degrees);
    double c = t->cosine, s = t->sine;
    tn_turtle_frame f = t->frame;
    if (axis == TN_OP_TURN)
        t->frame = (tn_turtle_frame){combine(f.heading, c, f.left, s), combine(f.heading, -s, f.left, c), f.up};
    else if (axis == TN_OP_PITCH)
        t->frame = (tn_turtle_frame){combine(f.heading, c, f.up, -s), f.left, combine(f.heading, s, f.up, c)};
    else
        t->frame = (tn_turtle_frame){f.heading, combine(f.left, c, f.up, -s), combine(f.left, s, f.up, c)};
}

static void note_branch(tn_turtle *t, uint32_t label, uint8_t age)
{
    if (t->branches) {
        tn_template_branch *branch = &t->branches[t->branch_count];
        *branch = (tn_template_branch){.at = t->edge_count, .label = label, .age = age, .reversed = t->flip != 0};
        tn_vector_put(branch->direction, t->frame.heading);
    }
    t->branch_count++;
}

static void note_edge(tn_turtle *t, uint32_t label, uint8_t age)
{
    t->at = combine(t->at, 1, t->frame.heading, 1);
    if (t->segments) {
        tn_template_segment *segment = &t->segments[t->edge_count];
        *segment = (tn_template_segment){.label = label, .age = age, .reversed = t->flip != 0};
        tn_vector_put(segment->end, t->at);
    }
    t->edge_count++;
}

static unsigned draw(tn_turtle *t, uint32_t label, uint8_t age)
{
    if (t->edge_count + t->branch_count == TN_TEMPLATE_ITEMS_MAX)
        return TN_TURTLE_CROWDED;
    if (t->depth == 0) {
        note_edge(t, label, age);
    } else {
        tn_turtle_level *inner = &t->levels[t->depth - 1];
        if (inner->drew)
            return TN_TURTLE_FULL;
        note_branch(t, label, age);
        inner->drew = true;
    }
    t->flip = 0;
    return 0;
}

static unsigned open_bracket(tn_turtle *t)
{
    if (t->depth > 0 && t->levels[t->depth - 1].drew)
        return TN_TURTLE_FULL;
    if (t->brackets == TN_TEMPLATE_ITEMS_MAX)
        return TN_TURTLE_CROWDED;
    t->brackets++;
    t->levels[t->depth++] = (tn_turtle_level){t->frame, t->flip, false, false};
    return 0;
}

static unsigned close_bracket(tn_turtle *t)
{
    if (t->depth == 0)
        return TN_TURTLE_UNOPENED;
    const tn_turtle_level *inner = &t->levels[--t->depth];
    bool draws = inner->drew || inner->holds;
    unsigned wrong = draws ? 0 : TN_TURTLE_EMPTY;
    if (t->depth > 0)
        t->levels[t->depth - 1].holds |= draws;
    if (t->flip && t->flip != inner->flip)
        wrong |= TN_TURTLE_UNFLIPPED;
    t->frame = inner->frame;
    t->flip = inner->flip;
    return wrong;
}

static bool is_back(const tn_turtle_frame *f)
{
    tn_vector x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    return tn_norm(tn_sub(f->heading, x)) <= 1e-9 && tn_norm(tn_sub(f->left, y)) <= 1e-9 &&
           tn_norm(tn_sub(f->up, z)) <= 1e-9;
}

static unsigned land(const tn_turtle *t)
{
    if (t->depth > 0)
        return TN_TURTLE_UNCLOSED;
    unsigned wrong = (t->flip ? TN_TURTLE_UNFLIPPED : 0) | (t->edge_count == 0 ? TN_TURTLE_NO_PATH : 0);
    return wrong || is_back(&t->frame) ? wrong : TN_TURTLE_ASTRAY;
}

void tn_turtle_start(tn_turtle *turtle, tn_turtle_level *levels)
{
    *turtle = (tn_turtle){.frame = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .cosine = 1, .levels = levels};
}

unsigned tn_turtle_move(tn_turtle *turtle, const tn_instruction *move)
{
    switch (move->opcode) {
    case TN_OP_DRAW:
        return draw(turtle, (uint32_t)move->first, (uint8_t)move->second);
    case TN_OP_FLIP:
        turtle->flips++;
        turtle->flip = turtle->flip ? 0 : turtle->flips;
        return 0;
    case TN_OP_TURN:
    case TN_OP_PITCH:
    case TN_OP_ROLL:
        turn(turtle, move->opcode, tn_double_of((uint64_t)move->first));
        return 0;
    case TN_OP_OPEN:
        return open_bracket(turtle);
    case TN_OP_CLOSE:
        return close_bracket(turtle);
    case TN_OP_LAND:
        return land(turtle);
    default:
        return TN_TURTLE_NO_MOVE;
    }
}

/* ---- into the edge's own frame */

/* The least rotation that takes the unit tn_vector c to x, as rows. */
static void rotation_to_x(tn_vector c, tn_vector rows[3])
{
    double d = c.x, s = sqrt(c.y * c.y + c.z * c.z);
    rows[0] = (tn_vector){1, 0, 0};
    rows[1] = (tn_vector){0, 1, 0};
    rows[2] = (tn_vector){0, 0, 1};
    if (d > 1 - 1e-15)
        return;
    if (d < -1 + 1e-15) {
        rows[0].x = rows[1].y = -1;
        return;
    }
    double y = c.z / s, z = -c.y / s, t = 1 - d; /* axis c x (1,0,0) = (0, cz, -cy) */
    rows[0] = (tn_vector){d, -s * z, s * y};
    rows[1] = (tn_vector){s * z, t * y * y + d, t * y * z};
    rows[2] = (tn_vector){-s * y, t * y * z, t * z * z + d};
}

static tn_vector rotate(const tn_vector rows[3], const double v[3])
{
    tn_vector a = tn_vector_at(v);
    return (tn_vector){tn_dot(rows[0], a), tn_dot(rows[1], a), tn_dot(rows[2], a)};
}

/* The path from (0,0,0) to (1,0,0); where it ends where it starts, equal parts of the edge. */
static void fit(const tn_turtle *t)
{
    uint32_t count = t->edge_count;
    double chord = tn_norm(t->at);
    tn_vector rows[3];
    rotation_to_x(chord < 1e-9 ? (tn_vector){1, 0, 0} : tn_scale(t->at, 1 / chord), rows);
    for (uint32_t j = 0; j < count; j++) {
        double *end = t->segments[j].end;
        tn_vector p = chord < 1e-9 ? (tn_vector){(double)(j + 1) / count, 0, 0} : rotate(rows, end);
        tn_vector_put(end, tn_scale(p, chord < 1e-9 ? 1 : 1 / chord));
    }
    tn_vector_put(t->segments[count - 1].end, (tn_vector){1, 0, 0});
    for (uint32_t b = 0; b < t->branch_count; b++)
        tn_vector_put(t->branches[b].direction, rotate(rows, t->branches[b].direction));
}

/* Grows with the angle from a to b, counter-clockwise about z: 0 along a, 2 against it, below 4. Equal directions are
 * equal in spite of rounding. */
static double turn_between(tn_vector a, tn_vector b)
{
    double scale = sqrt((a.x * a.x + a.y * a.y) * (b.x * b.x + b.y * b.y));
    double sine = (a.x * b.y - a.y * b.x) / scale, cosine = (a.x * b.x + a.y * b.y) / scale;
    if (fabs(sine) < 1e-9)
        return cosine > 0 ? 0 : 2;
    double turn = sine > 0 ? 1 - cosine : 3 + cosine;
    return rint(turn * 1e10) / 1e10;
}

static tn_vector point(const tn_template *template, uint32_t j)
{
    if (j == 0)
        return (tn_vector){0, 0, 0};
    return tn_vector_at(template->segments[j - 1].end);
}

static bool is_upright(tn_vector a)
{
    return a.x * a.x + a.y * a.y < 1e-18;
}

/* Which side of the path a branch leaves on, from directions projected on the plane of the surface. Where one of them
 * stands straight out of the surface nothing tells the sides apart: the branch belongs to no region. */
static void classify(const tn_template *template, tn_template_branch *branch)
{
    tn_vector d = {branch->direction[0], branch->direction[1], 0}, out, back;
    branch->side = TN_SIDE_NONE;
    if (branch->at < template->segment_count)
        out = combine(point(template, branch->at + 1), 1, point(template, branch->at), -1);
    if (branch->at > 0)
        back = combine(point(template, branch->at - 1), 1, point(template, branch->at), -1);
    if (branch->at == template->segment_count)
        out = combine(back, -1, back, 0);
    else if (branch->at == 0)
        back = combine(out, -1, out, 0);
    if (is_upright(d) || is_upright(out) || is_upright(back))
        return;
    double turn = turn_between(out, d), behind = turn_between(out, back);
    if (turn == 0 || turn_between(back, d) == 0)
        return;
    branch->turn = turn;
    branch->side = turn < behind ? TN_SIDE_LEFT : TN_SIDE_RIGHT;
}

tn_template tn_turtle_draw(const tn_module *module, uint32_t successor, tn_turtle_level *levels,
                           tn_template_segment *segments, tn_template_branch *branches)
{
    const tn_function_record *function = &module->FUNCTION_records[successor];
    tn_turtle turtle;
    tn_turtle_start(&turtle, levels);
    turtle.segments = segments;
    turtle.branches = branches;
    for (uint32_t offset = function->code_begin; offset < function->code_end;) {
        tn_instruction move = tn_code_read(module->code, offset);
        tn_turtle_move(&turtle, &move);
        offset += move.length;
    }
    fit(&turtle);
    tn_template template = {segments, branches, turtle.edge_count, turtle.branch_count};
    for (uint32_t b = 0; b < turtle.branch_count; b++)
        classify(&template, &branches[b]);
    return template;
}

/* ==== reads a rewrite system from a module's code: the turtle draws each successor, guards become rules */

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
