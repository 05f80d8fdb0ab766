/* The turtle draws a successor once, when the file is compiled ("Genr8", 4.4; docs/growth.md 1.2): the result is a
 * constant template in the frame of the replaced edge. Turns as in ABOP: `+` turns the heading towards the left, `&`
 * down, `\` rolls the left side down; `-`, `^`, `/` undo them. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "compiler/hemls/hemls.h"
#include "runtime/base/numeric.h"

typedef struct vector {
    double x, y, z;
} vector;

typedef struct frame {
    vector heading, left, up;
} frame;

static vector combine(vector a, double s, vector b, double t)
{
    return (vector){a.x * s + b.x * t, a.y * s + b.y * t, a.z * s + b.z * t};
}

static double product(vector a, vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double length(vector a)
{
    return sqrt(product(a, a));
}

static frame turned(frame f, char sign, double angle)
{
    double c = tn_cos_degrees(angle), s = tn_sin_degrees(angle);
    if (sign == '-' || sign == '^' || sign == '/')
        s = -s;
    if (sign == '+' || sign == '-')
        return (frame){combine(f.heading, c, f.left, s), combine(f.heading, -s, f.left, c), f.up};
    if (sign == '&' || sign == '^')
        return (frame){combine(f.heading, c, f.up, -s), f.left, combine(f.heading, s, f.up, c)};
    return (frame){f.heading, combine(f.left, c, f.up, -s), combine(f.left, s, f.up, c)};
}

/* ---- drawing */

typedef struct level {
    frame frame;
    const tn_hemls_symbol *tilde; /* one that waited when it opened: it counts inside and after */
    bool drew, holds;             /* an edge of its own; a bracket that draws one */
    const tn_hemls_symbol *open;
} level;

typedef struct turtle {
    tn_diagnostics *diagnostics;
    tn_checked_template *template;
    double angle;
    frame frame;
    vector at;                    /* end of the path so far */
    const tn_hemls_symbol *tilde; /* waiting for its edge */
    level *stack;
    uint32_t depth;
    bool failed;
} turtle;

__attribute__((format(printf, 4, 5))) static tn_diagnostic *complain(turtle *t, tn_code code, tn_span span,
                                                                     const char *format, ...)
{
    char text[200];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    t->failed = true;
    return tn_report(t->diagnostics, code, span, "%s", text);
}

/* Is the innermost bracket closed by something behind this symbol? */
static bool is_closed(const tn_hemls_symbol *symbol)
{
    uint32_t depth = 1;
    for (symbol = symbol->next; symbol && depth > 0; symbol = symbol->next)
        depth += (symbol->kind == TN_HEMLS_OPEN) - (symbol->kind == TN_HEMLS_CLOSE);
    return depth == 0;
}

static void complain_of_open_bracket(turtle *t)
{
    tn_diagnostic *d = complain(t, E_BRACKETS, t->stack[t->depth - 1].open->span, "this `[` is never closed");
    tn_help(t->diagnostics, d, "close the branch with `]` after its edge, as in `[ + A ]`");
}

static void draw_branch(turtle *t, const tn_hemls_symbol *edge)
{
    level *inner = &t->stack[t->depth - 1];
    if (inner->drew) {
        tn_diagnostic *d = complain(t, E_BRANCH_OF_SEVERAL, edge->span, "a branch draws one edge only");
        tn_note(t->diagnostics, d, &inner->open->span, "the bracket that it stands in");
        tn_help(t->diagnostics, d, "give each branch its own bracket, as in `[ [ + %s ] - %s ]`", edge->name,
                edge->name);
        return;
    }
    tn_checked_branch *branch = &t->template->branches[t->template->branch_count++];
    *branch = (tn_checked_branch){
        .at = t->template->segment_count, .number = edge->number, .age = edge->age, .reversed = t->tilde != NULL};
    branch->direction[0] = t->frame.heading.x;
    branch->direction[1] = t->frame.heading.y;
    branch->direction[2] = t->frame.heading.z;
    inner->drew = true;
}

static void draw_edge(turtle *t, const tn_hemls_symbol *edge)
{
    if (t->depth > 0 && t->stack[t->depth - 1].drew && !is_closed(edge)) { /* its end was forgotten behind its edge */
        complain_of_open_bracket(t);
        t->frame = t->stack[--t->depth].frame;
    }
    if (t->depth > 0) {
        draw_branch(t, edge);
    } else {
        t->at = combine(t->at, 1, t->frame.heading, 1);
        tn_checked_segment *segment = &t->template->segments[t->template->segment_count++];
        *segment = (tn_checked_segment){
            .number = edge->number, .age = edge->age, .reversed = t->tilde != NULL, .end = {t->at.x, t->at.y, t->at.z}};
    }
    t->tilde = NULL;
}

static void open_bracket(turtle *t, const tn_hemls_symbol *symbol)
{
    if (t->depth > 0 && t->stack[t->depth - 1].drew) {
        tn_diagnostic *d = complain(t, E_BRANCH_OF_SEVERAL, symbol->span,
                                    "a branch draws one edge only, and this bracket has drawn it");
        tn_help(t->diagnostics, d, "close the bracket before the next branch opens");
    }
    t->stack[t->depth++] = (level){t->frame, t->tilde, false, false, symbol};
}

static void close_bracket(turtle *t, const tn_hemls_symbol *symbol)
{
    if (t->depth == 0) {
        tn_diagnostic *d = complain(t, E_BRACKETS, symbol->span, "this `]` closes nothing");
        tn_help(t->diagnostics, d, "leave it out, or open the branch with `[`");
        return;
    }
    level *inner = &t->stack[--t->depth];
    if (t->depth > 0)
        t->stack[t->depth - 1].holds |= inner->drew || inner->holds;
    if (!inner->drew && !inner->holds) {
        tn_span span = tn_span_join(inner->open->span, symbol->span);
        tn_diagnostic *d = complain(t, E_EMPTY_BRANCH, span, "this branch draws no edge");
        tn_help(t->diagnostics, d, "a branch turns and draws one edge, as in `[ + A ]`; leave an empty one out");
    }
    if (t->tilde && t->tilde != inner->tilde) {
        tn_diagnostic *d = complain(t, E_DANGLING_TILDE, t->tilde->span, "no edge follows this `~` in its bracket");
        tn_help(t->diagnostics, d, "`~` turns round the next edge that is drawn; leave it out or move it");
    }
    t->frame = inner->frame;
    t->tilde = inner->tilde;
}

static void read_symbol(turtle *t, const tn_hemls_symbol *symbol)
{
    switch (symbol->kind) {
    case TN_HEMLS_EDGE:
        draw_edge(t, symbol);
        break;
    case TN_HEMLS_TURN:
        t->frame = turned(t->frame, symbol->sign, t->angle);
        break;
    case TN_HEMLS_TILDE:
        t->tilde = t->tilde ? NULL : symbol;
        break;
    case TN_HEMLS_OPEN:
        open_bracket(t, symbol);
        break;
    case TN_HEMLS_CLOSE:
        close_bracket(t, symbol);
        break;
    default: {
        tn_diagnostic *d = complain(t, E_MISPLACED_SYMBOL, symbol->span, "`%c` does not belong in a successor",
                                    symbol->kind == TN_HEMLS_LESS ? '<' : '>');
        tn_help(t->diagnostics, d, "contexts stand before `->`; a condition on the age is written `If i < 3`");
    }
    }
}

/* ---- what has to hold in the end */

static bool is_back(const frame *f)
{
    vector x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    return length(combine(f->heading, 1, x, -1)) <= 1e-9 && length(combine(f->left, 1, y, -1)) <= 1e-9 &&
           length(combine(f->up, 1, z, -1)) <= 1e-9;
}

/* The turns that would bring the turtle back where one kind of turn is out of balance, for a suggestion. */
static const char *missing_turn(const tn_hemls_symbols *symbols, int *count)
{
    static const char signs[] = "+-&^\\/";
    int balance[3] = {0, 0, 0}, depth = 0;
    for (const tn_hemls_symbol *s = symbols->first; s; s = s->next) {
        depth += s->kind == TN_HEMLS_OPEN ? 1 : s->kind == TN_HEMLS_CLOSE ? -1 : 0;
        for (int i = 0; i < 6 && s->kind == TN_HEMLS_TURN && depth == 0; i++)
            if (s->sign == signs[i])
                balance[i / 2] += i % 2 ? -1 : 1;
    }
    static const char *const undo[] = {"-", "+", "^", "&", "/", "\\"};
    for (int i = 0; i < 3; i++) {
        if (balance[i] != 0) {
            *count = balance[i] > 0 ? balance[i] : -balance[i];
            return undo[2 * i + (balance[i] < 0)];
        }
    }
    return NULL;
}

static void check_end(turtle *t, const tn_hemls_symbols *symbols, tn_span span)
{
    if (t->depth > 0) {
        complain_of_open_bracket(t);
        return;
    }
    if (t->tilde) {
        tn_diagnostic *d = complain(t, E_DANGLING_TILDE, t->tilde->span, "no edge follows this `~`");
        tn_help(t->diagnostics, d, "`~` turns round the next edge that is drawn; leave it out or move it");
    }
    if (t->template->segment_count == 0) {
        tn_diagnostic *d = complain(t, E_NO_PATH, span, "this successor draws no edge outside its branches");
        tn_help(t->diagnostics, d, "what replaces an edge has to lead from its start to its end: `A -> A [ + B ] A`");
        return;
    }
    if (!t->failed && !is_back(&t->frame)) {
        int count = 0;
        const char *turn = missing_turn(symbols, &count);
        tn_diagnostic *d =
            complain(t, E_TURTLE_ASTRAY, span, "the turtle does not end in the direction that it started in");
        if (turn)
            tn_help(t->diagnostics, d, "every turn has to be undone: add %d `%s` at the end", count, turn);
        else
            tn_help(t->diagnostics, d, "undo turns in the opposite order: `+ & A ^ -`, not `+ & A - ^`");
    }
}

/* ---- into the edge's own frame */

/* The least rotation that takes the unit vector c to x, as rows. */
static void rotation_to_x(vector c, vector rows[3])
{
    double d = c.x, s = sqrt(c.y * c.y + c.z * c.z);
    rows[0] = (vector){1, 0, 0};
    rows[1] = (vector){0, 1, 0};
    rows[2] = (vector){0, 0, 1};
    if (d > 1 - 1e-15)
        return;
    if (d < -1 + 1e-15) {
        rows[0].x = rows[1].y = -1;
        return;
    }
    double y = c.z / s, z = -c.y / s, t = 1 - d; /* axis c x (1,0,0) = (0, cz, -cy) */
    rows[0] = (vector){d, -s * z, s * y};
    rows[1] = (vector){s * z, t * y * y + d, t * y * z};
    rows[2] = (vector){-s * y, t * y * z, t * z * z + d};
}

static vector rotate(const vector rows[3], const double v[3])
{
    vector a = {v[0], v[1], v[2]};
    return (vector){product(rows[0], a), product(rows[1], a), product(rows[2], a)};
}

/* The path from (0,0,0) to (1,0,0); where it ends where it starts, equal parts of the edge. */
static void fit(turtle *t)
{
    tn_checked_template *template = t->template;
    uint32_t count = template->segment_count;
    double chord = length(t->at);
    vector rows[3];
    rotation_to_x(chord < 1e-9 ? (vector){1, 0, 0} : combine(t->at, 1 / chord, t->at, 0), rows);
    for (uint32_t j = 0; j < count; j++) {
        double *end = template->segments[j].end;
        vector p = chord < 1e-9 ? (vector){(double)(j + 1) / count, 0, 0} : rotate(rows, end);
        double s = chord < 1e-9 ? 1 : 1 / chord;
        end[0] = p.x * s;
        end[1] = p.y * s;
        end[2] = p.z * s;
    }
    double *last = template->segments[count - 1].end;
    last[0] = 1;
    last[1] = last[2] = 0;
    for (uint32_t b = 0; b < template->branch_count; b++) {
        vector d = rotate(rows, template->branches[b].direction);
        template->branches[b].direction[0] = d.x;
        template->branches[b].direction[1] = d.y;
        template->branches[b].direction[2] = d.z;
    }
}

/* Grows with the angle from a to b, counter-clockwise about z: 0 along a, 2 against it, below 4. Equal directions are
 * equal in spite of rounding. */
static double turn_between(vector a, vector b)
{
    double scale = sqrt((a.x * a.x + a.y * a.y) * (b.x * b.x + b.y * b.y));
    double sine = (a.x * b.y - a.y * b.x) / scale, cosine = (a.x * b.x + a.y * b.y) / scale;
    if (fabs(sine) < 1e-9)
        return cosine > 0 ? 0 : 2;
    double turn = sine > 0 ? 1 - cosine : 3 + cosine;
    return rint(turn * 1e10) / 1e10;
}

static vector point(const tn_checked_template *template, uint32_t j)
{
    if (j == 0)
        return (vector){0, 0, 0};
    const double *end = template->segments[j - 1].end;
    return (vector){end[0], end[1], end[2]};
}

static bool is_upright(vector a)
{
    return a.x * a.x + a.y * a.y < 1e-18;
}

/* Which side of the path a branch leaves on, from directions projected on the plane of the surface. Where one of them
 * stands straight out of the surface nothing tells the sides apart: the branch belongs to no region. */
static void classify(const tn_checked_template *template, tn_checked_branch *branch)
{
    vector d = {branch->direction[0], branch->direction[1], 0}, out, back;
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

bool tn_hemls_draw(tn_arena *arena, tn_diagnostics *diagnostics, const tn_hemls_symbols *symbols, tn_span span,
                   double angle, tn_checked_template *template)
{
    size_t edges = 0, brackets = 0;
    for (const tn_hemls_symbol *s = symbols->first; s; s = s->next) {
        edges += s->kind == TN_HEMLS_EDGE;
        brackets += s->kind == TN_HEMLS_OPEN;
    }
    if (edges > TN_TEMPLATE_ITEMS_MAX || brackets > TN_TEMPLATE_ITEMS_MAX) {
        tn_diagnostic *d = tn_report(diagnostics, E_TOO_MANY, span,
                                     "this successor has more edges than the limit of %u", TN_TEMPLATE_ITEMS_MAX);
        tn_help(diagnostics, d, "spread it over several rules");
        return false;
    }
    turtle t = {
        .diagnostics = diagnostics, .template = template, .angle = angle, .frame = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    *template = (tn_checked_template){.span = span};
    template->segments = TN_NEW_ARRAY(arena, tn_checked_segment, edges + 1);
    template->branches = TN_NEW_ARRAY(arena, tn_checked_branch, edges + 1);
    t.stack = TN_NEW_ARRAY(arena, level, brackets + 1);
    if (!template->segments || !template->branches || !t.stack)
        return false;
    for (const tn_hemls_symbol *s = symbols->first; s && !t.failed; s = s->next)
        read_symbol(&t, s);
    if (!t.failed)
        check_end(&t, symbols, span);
    if (t.failed)
        return false;
    fit(&t);
    for (uint32_t b = 0; b < template->branch_count; b++)
        classify(template, &template->branches[b]);
    return true;
}
