/* Interprets a rewrite system's code for each edge: its guards to find the successor, the turtle to draw it. */

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/growth/model/system.h"
#include "runtime/growth/pass/pass.h"
#include "runtime/growth/pass/rows.h"

typedef struct interpreter {
    tn_pass *pass;
    const tn_module *module;
    /* matching */
    uint32_t *first;                      /* [vertex] where its sides begin; one more at the end */
    uint32_t *around;                     /* the sides that leave each vertex */
    uint8_t *taken;                       /* [edge] a replacement has it */
    uint32_t *size;                       /* [face] edges it has, as replacements are made */
    uint32_t chain[TN_CHAIN_MAX], length; /* the edges that the guard under way has found */
    size_t room;                          /* of the pass's list */
    /* drawing */
    tn_turtle_level *levels;
    tn_template_segment *segments;
    tn_template_branch *branches;
} interpreter;

static void clear(interpreter *in)
{
    free(in->first);
    free(in->around);
    free(in->taken);
    free(in->size);
    free(in->levels);
    free(in->segments);
    free(in->branches);
}

/* Room for the turtle. */
static tn_status begin(interpreter *in, tn_pass *pass, tn_error *error)
{
    const tn_growth_system *system = pass->growth->system;
    *in = (interpreter){.pass = pass, .module = system->module};
    in->levels = malloc((system->level_count + 1) * sizeof *in->levels);
    in->segments = malloc(TN_TEMPLATE_ITEMS_MAX * sizeof *in->segments);
    in->branches = malloc(TN_TEMPLATE_ITEMS_MAX * sizeof *in->branches);
    return in->levels && in->segments && in->branches ? TN_OK : tn_fail_memory(error);
}

static tn_template draw(const interpreter *in, uint16_t template)
{
    uint32_t successor = in->pass->growth->system->successors[template];
    return tn_turtle_draw(in->module, successor, in->levels, in->segments, in->branches);
}

/* ---- around a vertex */

static uint32_t start_of(const interpreter *in, uint32_t edge)
{
    return in->pass->sides[2 * (size_t)edge].origin;
}

static uint32_t end_of(const interpreter *in, uint32_t edge)
{
    return in->pass->sides[2 * (size_t)edge + 1].origin;
}

static tn_status look_around(interpreter *in, tn_error *error)
{
    const tn_map *map = in->pass->old;
    size_t sides = 2 * (size_t)map->edge_count;
    in->first = calloc((size_t)map->vertex_count + 2, sizeof *in->first);
    in->around = malloc(sides * sizeof *in->around);
    in->taken = calloc(map->edge_count, 1);
    in->size = malloc(map->face_count * sizeof *in->size);
    if (!in->first || !in->around || !in->taken || !in->size)
        return tn_fail_memory(error);
    for (size_t side = 0; side < sides; side++)
        in->first[in->pass->sides[side].origin + 2]++;
    for (uint32_t v = 0; v < map->vertex_count; v++)
        in->first[v + 2] += in->first[v + 1];
    for (uint32_t side = 0; side < sides; side++) /* afterwards each vertex's sides begin one place further down */
        in->around[in->first[in->pass->sides[side].origin + 1]++] = side;
    for (uint32_t f = 0; f < map->face_count; f++)
        in->size[f] = tn_face_size(map, f);
    return TN_OK;
}

/* Is there an edge of the label at the vertex, other than this one? */
static bool meets(const interpreter *in, uint32_t vertex, uint32_t label, uint32_t edge)
{
    for (uint32_t i = in->first[vertex]; i < in->first[vertex + 1]; i++) {
        uint32_t other = in->around[i] / 2;
        if (other != edge && tn_state_label(in->pass->old->states[other]) == label)
            return true;
    }
    return false;
}

/* The edge that starts where this one ends, and no other edge does; or TN_NONE. */
static uint32_t follower(const interpreter *in, uint32_t edge)
{
    uint32_t vertex = end_of(in, edge), from = in->first[vertex];
    if (in->first[vertex + 1] - from != 2)
        return TN_NONE;
    uint32_t side = in->around[from] / 2 == edge ? in->around[from + 1] : in->around[from];
    return side & 1 ? TN_NONE : side / 2;
}

/* ---- guards */

/* The next edge of the chain has this label, and nothing has replaced or drawn it in this step. */
static bool find_edge(interpreter *in, uint32_t edge, uint32_t label)
{
    uint32_t next = in->length == 0 ? edge : follower(in, in->chain[in->length - 1]);
    if (next == TN_NONE)
        return false;
    for (uint32_t i = 0; i < in->length; i++)
        if (in->chain[i] == next)
            return false;
    tn_edge_state state = in->pass->old->states[next];
    if (tn_state_label(state) != label || state & TN_STATE_FRESH || in->taken[next])
        return false;
    in->chain[in->length++] = next;
    return true;
}

/* A chain that comes back to where it starts is none. */
static bool is_open_chain(const interpreter *in)
{
    return start_of(in, in->chain[0]) != end_of(in, in->chain[in->length - 1]);
}

/* The next number of the random stream, from 0 to 1. */
static double next_random(tn_growth *growth)
{
    uint64_t bits = tn_mix64(growth->options.seed + growth->draws++ * 0x9e3779b97f4a7c15u);
    return (double)(bits >> 11) * 0x1p-53;
}

/* What chance has said so far in a guard. */
typedef struct chance {
    double drawn, below;
} chance;

/* What a test of a guard comes to. */
typedef enum outcome { GO_ON, SKIP_NEXT, DOES_NOT_APPLY, REPLACES } outcome;

static outcome run_test(interpreter *in, const tn_instruction *test, uint32_t edge, chance *luck)
{
    double number = tn_double_of((uint64_t)test->first);
    int32_t age = tn_state_age(in->pass->old->states[edge]);
    switch (test->opcode) {
    case TN_OP_LABEL:
        return find_edge(in, edge, (uint32_t)test->first) ? GO_ON : DOES_NOT_APPLY;
    case TN_OP_BEHIND:
        return meets(in, start_of(in, edge), (uint32_t)test->first, edge) ? GO_ON : DOES_NOT_APPLY;
    case TN_OP_AHEAD:
        return meets(in, end_of(in, edge), (uint32_t)test->first, edge) ? GO_ON : DOES_NOT_APPLY;
    case TN_OP_YOUNGER:
        return age < number ? GO_ON : SKIP_NEXT;
    case TN_OP_OLDER:
        return age > number ? GO_ON : SKIP_NEXT;
    case TN_OP_AGED:
        return age == number ? GO_ON : SKIP_NEXT;
    case TN_OP_CHANCE:
        if (number <= 0)
            return DOES_NOT_APPLY;
        luck->drawn = next_random(in->pass->growth) * number;
        return GO_ON;
    case TN_OP_WEIGHT:
        luck->below += number;
        return luck->drawn < luck->below ? GO_ON : SKIP_NEXT;
    case TN_OP_REPLACE:
        return REPLACES;
    default:
        return DOES_NOT_APPLY;
    }
}

/* Asks a guard of an edge. True if it gives a successor. */
static bool run_guard(interpreter *in, uint32_t guard, uint32_t edge, uint32_t *successor)
{
    const tn_function_record *function = &in->module->FUNCTION_records[guard];
    chance luck = {0, 0};
    in->length = 0;
    for (uint32_t offset = function->code_begin;;) {
        tn_instruction test = tn_code_read(in->module->code, offset);
        offset += test.length;
        if (test.opcode != TN_OP_LABEL && !is_open_chain(in))
            return false;
        outcome result = run_test(in, &test, edge, &luck);
        if (result == SKIP_NEXT)
            offset += tn_code_read(in->module->code, offset).length;
        else if (result == REPLACES)
            *successor = (uint32_t)test.first;
        if (result == DOES_NOT_APPLY || result == REPLACES)
            return result == REPLACES;
    }
}

/* ---- matching */

/* The first rule of the group that applies to the edge replaces it, and the chain that it begins. */
static tn_status match_edge(interpreter *in, const tn_growth_group *group, uint32_t edge, tn_error *error)
{
    tn_pass *pass = in->pass;
    uint32_t successor;
    uint32_t rule = 0;
    while (rule < group->rule_count && !run_guard(in, group->rules[rule].guard, edge, &successor))
        rule++;
    if (rule == group->rule_count)
        return TN_OK;
    if (!tn_array_reserve(&pass->list, &in->room, pass->list_count, 1, sizeof *pass->list))
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < in->length; i++)
        in->taken[in->chain[i]] = 1;
    uint16_t template = (uint16_t)tn_growth_template_of(pass->growth->system, successor);
    pass->list[pass->list_count++] = (tn_edge_replacement){edge, in->chain[in->length - 1], in->length, template};
    return TN_OK;
}

/* A face keeps at least three edges: shortenings that would leave fewer are refused, in the order of the replacements.
 */
static void refuse_small_faces(interpreter *in)
{
    tn_pass *pass = in->pass;
    size_t kept = 0;
    for (size_t i = 0; i < pass->list_count; i++) {
        tn_edge_replacement one = pass->list[i];
        uint32_t left = pass->sides[2 * (size_t)one.first].face, right = pass->sides[2 * (size_t)one.last + 1].face;
        int64_t gain = (int64_t)draw(in, one.template).segment_count - one.length;
        if (gain < 0 && (in->size[left] + gain < 3 || in->size[right] + gain < 3)) {
            pass->growth->counts.refused++;
            continue;
        }
        in->size[left] = (uint32_t)(in->size[left] + gain);
        in->size[right] = (uint32_t)(in->size[right] + gain);
        pass->list[kept++] = one;
    }
    pass->list_count = kept;
}

tn_status tn_interpret_match(tn_pass *pass, tn_error *error)
{
    interpreter in;
    tn_status status = begin(&in, pass, error);
    if (status == TN_OK)
        status = look_around(&in, error);
    if (status == TN_OK && !tn_array_reserve(&pass->list, &in.room, 0, 1, sizeof *pass->list))
        status = tn_fail_memory(error);
    for (uint32_t g = pass->group_first; g < pass->group_last && status == TN_OK; g++)
        for (uint32_t e = 0; e < pass->old->edge_count && status == TN_OK; e++)
            status = match_edge(&in, &pass->growth->system->groups[g], e, error);
    if (status == TN_OK)
        refuse_small_faces(&in);
    clear(&in);
    return status;
}

/* ---- rewriting */

static tn_axes frame_of(const tn_pass *pass, const tn_edge_replacement *one, tn_vector *start)
{
    tn_edge_side from = pass->sides[2 * (size_t)one->first], to = pass->sides[2 * (size_t)one->last + 1];
    *start = tn_vector_at(pass->old->positions + 3 * (size_t)from.origin);
    return tn_axes_of(*start, tn_vector_at(pass->old->positions + 3 * (size_t)to.origin),
                      tn_vector_at(pass->normal + 3 * (size_t)from.face),
                      tn_vector_at(pass->normal + 3 * (size_t)to.face), tn_vector_at(pass->growth->options.start));
}

/* A direction of the edge's frame in space. */
static tn_vector turned(const tn_axes *axes, const double direction[3])
{
    return tn_along(tn_along(tn_scale(axes->heading, direction[0]), axes->left, direction[1]), axes->up, direction[2]);
}

/* The vertices between the pieces. False if a coordinate leaves its range. */
static bool place_vertices(const tn_pass *pass, const tn_axes *axes, tn_vector start, const tn_template *drawn,
                           double *positions)
{
    for (uint32_t j = 0; j + 1 < drawn->segment_count; j++) {
        tn_vector p = tn_along(start, turned(axes, drawn->segments[j].end), axes->length);
        if (pass->growth->hard)
            p = tn_environment_place(pass->growth->environment, p, start, tn_along(start, axes->heading, axes->length));
        if (!isfinite(p.x + p.y + p.z))
            return false;
        tn_vector_put(positions + 3 * (size_t)j, p);
    }
    return true;
}

/* The pieces' labels and ages. False if an age leaves its range. */
static bool set_states(const tn_pass *pass, const tn_template *drawn, int32_t old_age, tn_edge_state *states)
{
    for (uint32_t j = 0; j < drawn->segment_count; j++) {
        int32_t age = tn_changed_age(drawn->segments[j].age, old_age);
        if (age < -TN_AGE_MAX || age > TN_AGE_MAX)
            return false;
        states[j] = tn_state(drawn->segments[j].label, age, !pass->joins_last);
    }
    return true;
}

static void aim_branches(const tn_pass *pass, const tn_edge_replacement *one, const tn_axes *axes,
                         const tn_template *drawn, tn_aim *aims)
{
    uint32_t left = pass->sides[2 * (size_t)one->first].face, right = pass->sides[2 * (size_t)one->last + 1].face;
    for (uint32_t b = 0; b < drawn->branch_count; b++) {
        tn_vector d = turned(axes, drawn->branches[b].direction);
        uint32_t beyond = drawn->branches[b].side == TN_SIDE_LEFT ? right : left;
        aims[b] = (tn_aim){{(float)d.x, (float)d.y, (float)d.z}, beyond};
    }
}

static void count(const tn_template *drawn, tn_rewrite_tally *so_far)
{
    so_far->rewrites++;
    so_far->pieces += drawn->segment_count;
    so_far->vertices += drawn->segment_count - 1;
    so_far->branches += drawn->branch_count;
}

/* Draws what replaces an edge or a chain, and puts it where the numbers say. */
static bool replace(interpreter *in, const tn_edge_replacement *one, tn_rewrite_tally *at)
{
    tn_pass *pass = in->pass;
    tn_template drawn = draw(in, one->template);
    int32_t age = tn_state_age(pass->old->states[one->first]);
    tn_vector start;
    tn_axes axes = frame_of(pass, one, &start);
    pass->records[one->first] = (tn_record){2 * (uint32_t)at->pieces, (uint32_t)at->vertices, (uint32_t)at->branches,
                                            one->template, (int16_t)age};
    aim_branches(pass, one, &axes, &drawn, pass->aims + (at->branches - pass->branch_first));
    bool fine = set_states(pass, &drawn, age, pass->new->states + at->pieces) &&
                place_vertices(pass, &axes, start, &drawn, pass->new->positions + 3 * at->vertices);
    count(&drawn, at);
    return fine;
}

static tn_status rewrite(interpreter *in, tn_error *error)
{
    tn_pass *pass = in->pass;
    uint32_t edges = pass->old->edge_count, kept = 0;
    tn_rewrite_tally total = {.kept = edges};
    for (size_t i = 0; i < pass->list_count; i++) {
        tn_template drawn = draw(in, pass->list[i].template);
        count(&drawn, &total);
        total.kept -= pass->list[i].length;
    }
    tn_status status = tn_rewrite_make_room(pass, &total, error);
    if (status != TN_OK)
        return status;
    pass->runs = malloc((edges ? edges : 1) * sizeof *pass->runs);
    if (!pass->runs)
        return tn_fail_memory(error);
    memset(pass->runs, 0xff, edges * sizeof *pass->runs);
    tn_rewrite_tally at = {.pieces = total.kept, .vertices = pass->old->vertex_count, .branches = pass->branch_first};
    for (size_t i = 0; i < pass->list_count; i++) {
        if (!replace(in, &pass->list[i], &at))
            return tn_rewrite_out_of_range(pass, error);
        tn_rewrite_along(pass, &pass->list[i]);
    }
    for (uint32_t e = 0; e < edges; e++)
        if (pass->runs[e].first == TN_NONE)
            tn_rewrite_keep(pass, e, kept++);
    pass->growth->counts.rewrites += total.rewrites;
    return TN_OK;
}

tn_status tn_interpret_rewrite(tn_pass *pass, tn_error *error)
{
    interpreter in;
    tn_status status = begin(&in, pass, error);
    if (status == TN_OK)
        status = rewrite(&in, error);
    clear(&in);
    return status;
}
