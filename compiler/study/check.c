/* What a study means: settings once and in range, boundaries that have a shape and leave a surface a place, terms that
 * exist. */
#include <math.h>
#include <string.h>

#include "compiler/common/diagnostic.h"
#include "compiler/study/study.h"

/* ---- finds boundaries that leave a surface no place: of two that it has to keep to, no point is allowed by both */

#define LOOKED_AT 1000u /* boundaries: of more, those behind are not compared */

/* What a boundary allows: a side of a plane, or what is inside or outside of a sphere or box. */
typedef struct region {
    uint32_t kind; /* tn_boundary_kind */
    bool inside;
    double a[3], b[3], radius; /* plane: a point, its normal; box: its corners; sphere: its centre */
} region;

/* False of a mesh, which is not known yet, and of a soft boundary, which may be passed. */
static bool region_of(const tn_study_item *item, region *r)
{
    *r = (region){.kind = item->which,
                  .a = {item->a.x, item->a.y, item->a.z},
                  .b = {item->b.x, item->b.y, item->b.z},
                  .radius = item->b.x};
    for (const tn_study_part *part = item->parts; part; part = part->next) {
        if (part->kind == TN_PART_MODE && part->value == TN_SOFT)
            return false;
        r->inside |= part->kind == TN_PART_SIDE && part->value > 0;
    }
    return item->which != TN_BOUNDARY_MESH;
}

static double dot(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

static double distance(const double x[3], const double y[3])
{
    const double d[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
    return sqrt(dot(d, d));
}

/* The box's point that is nearest to x, or farthest from it. */
static void box_point(const region *box, const double x[3], bool farthest, double point[3])
{
    for (int k = 0; k < 3; k++) {
        bool high = x[k] - box->a[k] < box->b[k] - x[k];
        point[k] = farthest ? (high ? box->b[k] : box->a[k]) : fmin(fmax(x[k], box->a[k]), box->b[k]);
    }
}

/* How high the region's highest point lies above the plane, in lengths of its normal. */
static double height(const region *plane, const region *of)
{
    double size = sqrt(dot(plane->b, plane->b)), point[3];
    for (int k = 0; k < 3; k++)
        point[k] = (of->kind == TN_BOUNDARY_SPHERE ? of->a[k] : plane->b[k] > 0 ? of->b[k] : of->a[k]) - plane->a[k];
    return dot(point, plane->b) / size + (of->kind == TN_BOUNDARY_SPHERE ? of->radius : 0);
}

/* Two planes that face each other with their backs, with room between them. */
static bool backs_apart(const region *a, const region *b)
{
    double sizes = sqrt(dot(a->b, a->b) * dot(b->b, b->b));
    const double between[3] = {b->a[0] - a->a[0], b->a[1] - a->a[1], b->a[2] - a->a[2]};
    return dot(a->b, b->b) <= -sizes * (1 - 1e-12) && dot(between, a->b) < 0;
}

static bool insides_apart(const region *a, const region *b)
{
    double point[3];
    if (a->kind == TN_BOUNDARY_BOX && b->kind == TN_BOUNDARY_BOX) {
        for (int k = 0; k < 3; k++)
            if (a->b[k] < b->a[k] || b->b[k] < a->a[k])
                return true;
        return false;
    }
    if (a->kind == TN_BOUNDARY_SPHERE && b->kind == TN_BOUNDARY_SPHERE)
        return distance(a->a, b->a) > a->radius + b->radius;
    const region *box = a->kind == TN_BOUNDARY_BOX ? a : b, *sphere = box == a ? b : a;
    box_point(box, sphere->a, false, point);
    return distance(point, sphere->a) > sphere->radius;
}

/* Does the obstacle hold all of what is inside the other? */
static bool swallows(const region *obstacle, const region *within)
{
    double point[3];
    if (obstacle->kind == TN_BOUNDARY_SPHERE) {
        if (within->kind == TN_BOUNDARY_SPHERE)
            return distance(obstacle->a, within->a) + within->radius < obstacle->radius;
        box_point(within, obstacle->a, true, point);
        return distance(point, obstacle->a) < obstacle->radius;
    }
    for (int k = 0; k < 3; k++) {
        bool ball = within->kind == TN_BOUNDARY_SPHERE;
        double low = ball ? within->a[k] - within->radius : within->a[k],
               high = ball ? within->a[k] + within->radius : within->b[k];
        if (!(low > obstacle->a[k] && high < obstacle->b[k]))
            return false;
    }
    return true;
}

/* Is no point allowed by both? */
static bool are_apart(const region *a, const region *b)
{
    bool flat_a = a->kind == TN_BOUNDARY_PLANE, flat_b = b->kind == TN_BOUNDARY_PLANE;
    if (flat_a && flat_b)
        return backs_apart(a, b);
    if (flat_a || flat_b) {
        const region *plane = flat_a ? a : b, *other = flat_a ? b : a;
        return other->inside && height(plane, other) < 0;
    }
    if (a->inside && b->inside)
        return insides_apart(a, b);
    return a->inside != b->inside && swallows(a->inside ? b : a, a->inside ? a : b);
}

/* Reports boundaries that no point keeps to at once. Meshes are not looked at. */
static void check_boundaries(tn_diagnostics *diagnostics, const tn_study_item *const *boundaries, uint32_t count)
{
    region later, earlier;
    if (count > LOOKED_AT)
        count = LOOKED_AT;
    for (uint32_t i = 1; i < count; i++)
        for (uint32_t k = 0; k < i && region_of(boundaries[i], &later); k++) {
            if (!region_of(boundaries[k], &earlier) || !are_apart(&later, &earlier))
                continue;
            tn_diagnostic *d = tn_report(diagnostics, E_BAD_BOUNDARY, boundaries[i]->span,
                                         "no point is allowed by this boundary and by another one, too");
            tn_note(diagnostics, d, &boundaries[k]->span, "the other is here");
            tn_help(diagnostics, d,
                    "a surface keeps to all boundaries at once; where it may be inside of either, name one closed mesh "
                    "of both, which `tartan mesh` makes of a field");
            break;
        }
}

/* ---- what a study means: settings once and in range, boundaries that have a shape, terms that exist */

const tn_expression_scope tn_study_scope = {
    .names = tn_names_MEASURED,
    .count = TN_MEASURED_COUNT,
    .words = TN_WORDS_PLAIN,
    .what = "term",
    .examples = {"undulation", "undulation, size", "undulation, size, faces"},
    .split = "make two fitness terms of it: they are added up",
    .unknown = E_UNKNOWN_TERM,
    .wrong = E_MEASURE,
    .vocabulary = &tn_study_words,
    .places = TN_STUDY_AT(TERM),
};

typedef struct check {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    tn_checked_study *study;
    const tn_study_item *here[TN_STUDY_SETTING_COUNT]; /* of the file at hand */
} check;

static const char *const setting_names[TN_STUDY_SETTING_COUNT] = {
    "title",  "rules",        "steps",         "scale",      "start",        "start-length",
    "seed",   "branch-angle", "branch-length", "edge-limit", "fixed-centre", "fixed-perimeter",
    "facing", "mirror",       "fitness raw",   "sun",        "distance-to"};

static void out_of_range(check *c, tn_span span, const char *what, const char *help)
{
    tn_diagnostic *d = tn_report(c->diagnostics, E_SETTING_RANGE, span, "%s", what);
    tn_help(c->diagnostics, d, "%s", help);
}

/* Between what a setting's number lies. Those without a row are held otherwise, or not at all. */
typedef struct range {
    double least, most;
    bool whole;
    const char *what, *help;
} range;

static const range ranges[TN_STUDY_SETTING_COUNT] = {
    [TN_STUDY_STEPS] = {0, TN_STEPS_MAX, true, "steps are a whole number, 100,000 at most",
                        "most surfaces are grown in 4 to 8 steps"},
    [TN_STUDY_BRANCH_ANGLE] = {0, 360, false, "an angle lies between 0 and 360 degrees",
                               "usual ones are 30, 45, 60 and 90"},
    [TN_STUDY_BRANCH_LENGTH] = {0, INFINITY, false, "a branch length is not below 0",
                                "leave it out for branches of any length"},
    [TN_STUDY_EDGE_LIMIT] = {3, INFINITY, true, "an edge limit is a whole number of at least 3",
                             "write how many edges a surface may have"},
};

static void check_range(check *c, const tn_study_item *item)
{
    const range *r = &ranges[item->kind];
    double n = item->number.value;
    tn_range_note(c->diagnostics, item->number.span, r->least, r->most);
    if (!(n >= r->least && n <= r->most) || (r->whole && n != floor(n)))
        out_of_range(c, item->number.span, r->what, r->help);
}

static void check_setting(check *c, const tn_study_item *item)
{
    double n = item->number.value;
    if (ranges[item->kind].what)
        check_range(c, item);
    switch (item->kind) {
    case TN_STUDY_SCALE:
        if (!(item->a.x > 0 && item->a.y > 0 && item->a.z > 0))
            out_of_range(c, item->a.span, "a scale is above 0",
                         "1 keeps the size, 1.5 grows by half in each step, 0.8 shrinks");
        break;
    case TN_STUDY_START_LENGTH:
        if (!(n > 0))
            out_of_range(c, item->number.span, "the start length is above 0",
                         "it is the side of the seed, in model units");
        break;
    case TN_STUDY_SEED:
        tn_range_note_whole64(c->diagnostics, item->number.span);
        if (n < 0)
            out_of_range(c, item->number.span, "a seed is a whole number",
                         "any from 0 to 18446744073709551615 will do, such as 7");
        break;
    case TN_STUDY_SUN:
        if (!(item->a.x * item->a.x + item->a.y * item->a.y + item->a.z * item->a.z > 1e-24))
            out_of_range(c, item->a.span, "the sun has no direction",
                         "write where it stands, seen from the surface: `sun 1 -1 2`; `sun 0 0 1` is overhead");
        break;
    case TN_STUDY_DISTANCE_TO:
        if (item->text && item->text[0] == '\0')
            out_of_range(c, item->text_span, "the mesh has no name",
                         "name a file that OpenMesh reads: OBJ, PLY, STL, OFF or OM");
        break;
    default:
        break;
    }
}

static void take_setting(check *c, const tn_study_item *item)
{
    const tn_study_item *first = c->here[item->kind];
    if (first) {
        tn_diagnostic *d =
            tn_report(c->diagnostics, E_STUDY_TWICE, item->span, "`%s` is there twice", setting_names[item->kind]);
        tn_note(c->diagnostics, d, &first->span, "the first is here");
        tn_help(c->diagnostics, d, "leave one of them out");
    }
    check_setting(c, item);
    c->here[item->kind] = item;
    c->study->settings[item->kind] = item;
}

/* Each part once. */
static void check_parts(check *c, const tn_study_item *item)
{
    static const char *const names[TN_STUDY_PART_COUNT] = {
        "strength", "exponent", "inside or outside", "slide, stop or soft", "target", "weight"};
    const tn_study_part *seen[TN_STUDY_PART_COUNT] = {NULL};
    for (const tn_study_part *part = item->parts; part; part = part->next) {
        if (seen[part->kind]) {
            tn_diagnostic *d = tn_report(c->diagnostics, E_STUDY_TWICE, seen[part->kind]->span, "`%s` is there twice",
                                         names[part->kind]);
            tn_note(c->diagnostics, d, &part->span, "the first is here");
            tn_help(c->diagnostics, d, "leave one of them out");
        }
        seen[part->kind] = part;
        if (part->kind == TN_PART_WEIGHT)
            tn_range_note(c->diagnostics, part->span, 0, INFINITY);
        if (part->kind == TN_PART_WEIGHT && part->value < 0)
            out_of_range(c, part->span, "a weight is not below 0", "a larger weight makes a term count for more");
    }
    if (seen[TN_PART_SIDE] && item->which == TN_BOUNDARY_PLANE) {
        tn_diagnostic *d = tn_report(c->diagnostics, E_BAD_BOUNDARY, seen[TN_PART_SIDE]->span, "a plane has no inside");
        tn_help(c->diagnostics, d,
                "the surface stays on the side that the normal points to; turn the normal round for the other");
    }
}

static void check_boundary(check *c, const tn_study_item *item)
{
    const tn_study_vector *a = &item->a, *b = &item->b;
    const char *what = NULL, *help = NULL;
    if (item->which == TN_BOUNDARY_BOX && !(a->x < b->x && a->y < b->y && a->z < b->z)) {
        what = "this box has no inside";
        help = "write the low corner after `from` and the high one after `to`, each coordinate larger";
    } else if (item->which == TN_BOUNDARY_SPHERE && !(b->x > 0)) {
        what = "this sphere has no inside";
        help = "a radius is above 0";
    } else if (item->which == TN_BOUNDARY_PLANE && !(b->x * b->x + b->y * b->y + b->z * b->z > 1e-24)) {
        what = "this plane has no direction";
        help = "the normal is the direction in which the surface may grow: `normal 0 0 1`";
    } else if (item->which == TN_BOUNDARY_MESH && item->text && item->text[0] == '\0') {
        what = "the mesh has no name";
        help = "name a file that OpenMesh reads: OBJ, PLY, STL, OFF or OM";
    }
    if (!what)
        return;
    tn_diagnostic *d = tn_report(c->diagnostics, E_BAD_BOUNDARY, item->span, "%s", what);
    tn_help(c->diagnostics, d, "%s", help);
}

uint32_t tn_study_term(const char *name)
{
    uint32_t term = 0;
    while (term < TN_MEASURED_COUNT && strcmp(tn_names_MEASURED[term], name) != 0)
        term++;
    return term;
}

static void goal_twice(check *c, const tn_study_item *item)
{
    for (uint32_t i = 0; i < c->study->goal_count; i++) {
        const tn_study_item *other = c->study->goals[i];
        if (strcmp(other->text, item->text) != 0 || other->span.file != item->span.file)
            continue;
        tn_diagnostic *d =
            tn_report(c->diagnostics, E_STUDY_TWICE, item->span, "the term `%s` is given twice", item->text);
        tn_note(c->diagnostics, d, &other->span, "the first is here");
        tn_help(c->diagnostics, d, "leave one of them out");
    }
}

static void unknown_term(check *c, const tn_study_item *item)
{
    static const char *const raw = "raw";
    tn_diagnostic *d =
        tn_report(c->diagnostics, E_UNKNOWN_TERM, item->text_span, "there is no fitness term `%s`", item->text);
    const char *near = tn_nearest(item->text, tn_names_MEASURED, TN_MEASURED_COUNT);
    if (!near)
        near = tn_nearest(item->text, &raw, 1);
    if (near)
        tn_help(c->diagnostics, d, "did you mean `%s`?", near);
    else
        tn_help(c->diagnostics, d,
                "docs/growth.md lists the terms, as size, undulation and area; others are made of them: "
                "`fitness %.60s = undulation / size`",
                item->text);
}

static void check_expression(check *c, const tn_study_item *item)
{
    tn_expression_check(c->diagnostics, &tn_study_scope, item->expression);
    if (strlen(item->text) > TN_NAME_MAX)
        tn_report(c->diagnostics, E_MEASURE, item->text_span, "a term's name has at most %u bytes", TN_NAME_MAX);
    /* a goal's own name hides a term of that name */
    if (tn_study_term(item->text) < TN_MEASURED_COUNT || !tn_expression_reserves(&tn_study_scope, item->text))
        return;
    tn_diagnostic *d =
        tn_report(c->diagnostics, E_MEASURE, item->text_span, "`%s` is a name that expressions use", item->text);
    tn_help(c->diagnostics, d, "give this one another name, as `my-%s`", item->text);
}

/* Is it a term, or a name for an expression? */
static bool check_goal(check *c, const tn_study_item *item)
{
    if (!item->text)
        return false;
    if (item->expression)
        check_expression(c, item);
    else if (tn_study_term(item->text) == TN_MEASURED_COUNT) {
        unknown_term(c, item);
        return false;
    }
    goal_twice(c, item);
    return true;
}

/* A goal of the using file stands instead of one of the same term that it took over. */
static void take_goal(check *c, const tn_study_item *item)
{
    if (!check_goal(c, item))
        return;
    uint32_t i = 0;
    while (i < c->study->goal_count && strcmp(c->study->goals[i]->text, item->text) != 0)
        i++;
    c->study->goals[i] = item;
    c->study->goal_count += i == c->study->goal_count;
}

static void take_requirement(check *c, const tn_study_item *item)
{
    tn_expression *condition = item->expression;
    if (!condition)
        return;
    tn_expression_check(c->diagnostics, &tn_study_scope, condition);
    if (condition->depth <= TN_NESTING_MAX && !tn_expression_is_condition(condition)) {
        tn_diagnostic *d = tn_report(c->diagnostics, E_MEASURE, condition->span, "this is no condition");
        tn_help(c->diagnostics, d, "compare it with something, as in `require crossings = 0`");
    }
    c->study->requirements[c->study->requirement_count++] = item;
}

static void take_item(check *c, const tn_study_item *item)
{
    check_parts(c, item);
    switch (item->kind) {
    case TN_STUDY_USE:
        break;
    case TN_STUDY_FORCE:
        c->study->forces[c->study->force_count++] = item;
        break;
    case TN_STUDY_BOUNDARY:
        check_boundary(c, item);
        c->study->boundaries[c->study->boundary_count++] = item;
        break;
    case TN_STUDY_GOAL:
        take_goal(c, item);
        break;
    case TN_STUDY_REQUIREMENT:
        take_requirement(c, item);
        break;
    default:
        take_setting(c, item);
        break;
    }
}

/* NULL if it is the rewrite system. */
static const tn_study_file *study_of(const tn_imports *imports, size_t unit)
{
    return strcmp(imports->units[unit]->extension, ".hemls") == 0 ? NULL : imports->units[unit]->tree;
}

static bool make_lists(check *c, const tn_imports *imports)
{
    size_t count = TN_FITNESS_TERM_COUNT;
    for (size_t u = 0; u < imports->count; u++) {
        const tn_study_file *file = study_of(imports, u);
        for (const tn_study_item *item = file ? file->first : NULL; item; item = item->next)
            count++;
    }
    c->study->forces = TN_NEW_ARRAY(c->arena, const tn_study_item *, count);
    c->study->boundaries = TN_NEW_ARRAY(c->arena, const tn_study_item *, count);
    c->study->goals = TN_NEW_ARRAY(c->arena, const tn_study_item *, count);
    c->study->requirements = TN_NEW_ARRAY(c->arena, const tn_study_item *, count);
    return c->study->forces && c->study->boundaries && c->study->goals && c->study->requirements;
}

/* The first place where an expression asks for a distance. */
static const tn_expression *distance_in(const tn_expression *expression)
{
    if (expression->op == TN_OP_TERM && expression->name && strcmp(expression->name, "distance-to") == 0)
        return expression;
    const tn_expression *found = NULL;
    for (const tn_expression *operand = expression->first; operand && !found; operand = operand->next)
        found = distance_in(operand);
    return found;
}

/* A distance needs a mesh. */
static void check_target(check *c, const tn_study_item *item)
{
    const tn_expression *found = item->expression ? distance_in(item->expression) : NULL;
    bool plain = !item->expression && item->text && tn_study_term(item->text) == TN_MEASURED_DISTANCE_TO;
    if (c->study->settings[TN_STUDY_DISTANCE_TO] || (!found && !plain))
        return;
    tn_diagnostic *d = tn_report(c->diagnostics, E_NO_TARGET, found ? found->span : item->text_span,
                                 "the study does not say what the distance is to");
    tn_help(c->diagnostics, d, "name a mesh in a line of its own: `distance-to \"hull.obj\"`");
}

static void check_whole(check *c, const tn_imports *imports, bool damaged)
{
    const tn_checked_study *study = c->study;
    if (!study->settings[TN_STUDY_RULES] && !damaged && !imports->units[imports->count - 1]->incomplete) {
        tn_diagnostic *d =
            tn_report(c->diagnostics, E_NO_RULES, study->span, "this study does not say which rules grow");
        tn_help(c->diagnostics, d, "add a line such as `rules \"square\"` or `rules \"mine.hemls\"`");
    }
    for (uint32_t i = 0; i < study->goal_count; i++)
        check_target(c, study->goals[i]);
    for (uint32_t i = 0; i < study->requirement_count; i++)
        check_target(c, study->requirements[i]);
    if (study->force_count > TN_SURROUNDINGS_MAX || study->boundary_count > TN_SURROUNDINGS_MAX)
        tn_report(c->diagnostics, E_TOO_MANY, study->span,
                  "this study has more forces or boundaries than the limit of %u", TN_SURROUNDINGS_MAX);
    else if (c->diagnostics->error_count == 0)
        check_boundaries(c->diagnostics, study->boundaries, study->boundary_count);
    if (study->goal_count > TN_EXPRESSIONS_MAX || study->requirement_count > TN_EXPRESSIONS_MAX)
        tn_report(c->diagnostics, E_TOO_MANY, study->span,
                  "this study has more goals or requirements than the limit of %u", TN_EXPRESSIONS_MAX);
}

bool tn_check_study(tn_arena *arena, tn_diagnostics *diagnostics, const tn_imports *imports, tn_checked_study *study)
{
    check c = {.arena = arena, .diagnostics = diagnostics, .study = study};
    size_t errors = diagnostics->error_count;
    bool damaged = false;
    *study = (tn_checked_study){0};
    if (!make_lists(&c, imports))
        return false;
    for (size_t u = 0; u < imports->count; u++) {
        const tn_study_file *file = study_of(imports, u);
        if (!file)
            continue;
        memset(c.here, 0, sizeof c.here);
        damaged |= file->damaged;
        study->span = (tn_span){imports->units[u]->file, 0, 0};
        if (file->first)
            study->span = tn_span_join(file->first->span, file->last->span);
        for (const tn_study_item *item = file->first; item; item = item->next)
            take_item(&c, item);
    }
    check_whole(&c, imports, damaged);
    return !damaged && diagnostics->error_count == errors && !tn_arena_failed(arena);
}
