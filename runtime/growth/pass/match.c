/* Which template replaces each edge. Labels and contexts are those of the pass's start. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/growth/pass/pass.h"
#include "runtime/growth/pass/rows.h"

/* ==== surveys a map before a pass: each edge side's vertex and face, each face's normal */

#define AHEAD 80u /* darts */
/* What the darts that are AHEAD of first .. end will need lies all over memory: asked for now, it is there in time.
 * Always inlined: a call that only asks is taken for one without effect. */
static inline __attribute__((always_inline)) void ask_ahead(const tn_map *map, const tn_edge_side *sides,
                                                            uint32_t first, uint32_t end)
{
    if (2 * map->edge_count - end < AHEAD)
        return;
    for (size_t d = (size_t)first + AHEAD; d < (size_t)end + AHEAD; d++) {
        __builtin_prefetch(map->positions + 3 * (size_t)map->origin[d]);
        __builtin_prefetch(sides + map->side[d], 1);
    }
}

/* Where the faces begin .. end - 1 have their darts. `sides` and `darts` are nobody else's, so that nothing has to be
 * read twice. */
static void note_sides(const tn_map *map, uint32_t begin, uint32_t end, tn_edge_side *restrict sides,
                       uint32_t *restrict darts)
{
    const uint32_t *first = map->face_first, *origin = map->origin, *side = map->side;
    for (uint32_t f = begin; f < end; f++) {
        ask_ahead(map, sides, first[f], first[f + 1]);
        for (uint32_t d = first[f]; d < first[f + 1]; d++)
            sides[side[d]] = (tn_edge_side){origin[d], f};
        for (uint32_t d = first[f]; darts && d < first[f + 1]; d++)
            darts[side[d]] = d;
    }
}

static void survey_chunk(void *context, uint32_t chunk)
{
    tn_pass *pass = context;
    uint32_t faces = pass->old->face_count, begin = chunk * TN_CHUNK_FACES;
    uint32_t end = faces - begin < TN_CHUNK_FACES ? faces : begin + TN_CHUNK_FACES;
    tn_normals normals;
    tn_normals_start(&normals, pass->old, pass->normal);
    if (chunk == 0)
        tn_vector_put(pass->normal + 3 * TN_OUTER_FACE, (tn_vector){0, 0, 0});
    for (uint32_t some = begin; some < end; some += TN_ROW) {
        uint32_t last = end - some < TN_ROW ? end : some + TN_ROW;
        note_sides(pass->old, some, last, pass->sides, pass->dart);
        for (uint32_t f = some == TN_OUTER_FACE ? 1 : some; f < last; f++)
            tn_normals_add(&normals, f);
    }
    tn_normals_finish(&normals);
}

bool tn_pass_reserve_aims(tn_pass *pass, uint64_t count)
{
    tn_growth_workspace *space = &pass->growth->space;
    uint64_t sides =
        (2 * (uint64_t)pass->old->edge_count + 7) & ~(uint64_t)7; /* so that no aim is in two cache lines */
    tn_pages *pages = &space->darts[!space->current];
    if (!tn_pages_reserve(pages, sides * sizeof *pass->sides + count * sizeof *pass->aims))
        return false;
    pass->sides = pages->data;
    pass->aims = (tn_aim *)(pass->sides + sides);
    return true;
}

tn_status tn_pass_survey(tn_pass *pass, tn_error *error)
{
    const tn_map *map = pass->old;
    uint64_t normals = 3 * (uint64_t)map->face_count, darts = pass->walks_vertices ? 2 * (uint64_t)map->edge_count : 0;
    tn_pages *space = &pass->growth->space.survey;
    if (!tn_pass_reserve_aims(pass, 0) ||
        !tn_pages_reserve(space, normals * sizeof *pass->normal + darts * sizeof *pass->dart))
        return tn_fail_memory(error);
    pass->normal = space->data;
    if (pass->walks_vertices)
        pass->dart = (uint32_t *)(pass->normal + normals);
    uint32_t chunks = (map->face_count + TN_CHUNK_FACES - 1) / TN_CHUNK_FACES;
    return tn_crew_share(tn_pass_crew(pass), chunks, survey_chunk, pass, error);
}

#define NEEDS_DRAW (TN_NO_TEMPLATE - 1)

/* For each vertex, the context labels of its edges: a bit in `once` where an edge has it, in `twice` where two have. */
typedef struct contexts {
    uint32_t *bit_of; /* [label] or TN_NONE */
    uint32_t words;   /* of 64 bits, for each vertex; 0: no rule has a context */
    uint64_t *once, *twice;
} contexts;

static void clear_contexts(contexts *around)
{
    free(around->bit_of);
    free(around->once);
}

static uint32_t number_context_labels(const tn_pass *pass, uint32_t *bit_of)
{
    const tn_growth_system *system = pass->growth->system;
    uint32_t bits = 0;
    for (uint32_t g = pass->group_first; g < pass->group_last; g++) {
        for (uint32_t r = 0; r < system->groups[g].rule_count; r++) {
            uint32_t labels[2] = {system->groups[g].rules[r].left, system->groups[g].rules[r].right};
            for (int i = 0; i < 2; i++)
                if (labels[i] != TN_NO_LABEL && bit_of[labels[i]] == TN_NONE)
                    bit_of[labels[i]] = bits++;
        }
    }
    return bits;
}

static tn_status find_contexts(const tn_pass *pass, contexts *around, tn_error *error)
{
    const tn_map *map = pass->old;
    uint32_t labels = pass->growth->system->label_count;
    *around = (contexts){0};
    around->bit_of = malloc(labels * sizeof *around->bit_of);
    if (!around->bit_of)
        return tn_fail_memory(error);
    memset(around->bit_of, 0xff, labels * sizeof *around->bit_of);
    uint32_t bits = number_context_labels(pass, around->bit_of);
    if (bits == 0)
        return TN_OK;
    around->words = (bits + 63) / 64;
    size_t size = (size_t)map->vertex_count * around->words;
    around->once = calloc(2 * size, sizeof *around->once);
    if (!around->once)
        return tn_fail_memory(error);
    around->twice = around->once + size;
    for (size_t side = 0; side < 2 * (size_t)map->edge_count; side++) {
        uint32_t bit = around->bit_of[tn_state_label(map->states[side / 2])];
        if (bit == TN_NONE)
            continue;
        size_t word = (size_t)pass->sides[side].origin * around->words + bit / 64;
        uint64_t mask = (uint64_t)1 << bit % 64;
        around->twice[word] |= around->once[word] & mask;
        around->once[word] |= mask;
    }
    return TN_OK;
}

/* Does another edge than one of label `own` have `label` at `vertex`? */
static bool has_context(const contexts *around, uint32_t vertex, uint32_t label, uint32_t own)
{
    uint32_t bit = around->bit_of[label];
    size_t word = (size_t)vertex * around->words + bit / 64;
    const uint64_t *which = label == own ? around->twice : around->once;
    return which[word] >> bit % 64 & 1;
}

static bool holds(const tn_alternative *alternative, int32_t age)
{
    switch (alternative->comparison) {
    case TN_AGE_BELOW:
        return age < alternative->bound;
    case TN_AGE_ABOVE:
        return age > alternative->bound;
    case TN_AGE_EQUALS:
        return age == alternative->bound;
    default:
        return true;
    }
}

/* The alternative that the next random number falls on. */
static uint16_t draw(const tn_growth *growth, const tn_growth_rule *rule, uint64_t ordinal)
{
    uint64_t bits = tn_mix64(growth->options.seed + ordinal * 0x9e3779b97f4a7c15u);
    double u = (double)(bits >> 11) * 0x1p-53 * rule->total, below = 0;
    for (uint32_t i = 0; i < rule->alternative_count; i++) {
        below += rule->alternatives[i].weight;
        if (u < below)
            return (uint16_t)rule->alternatives[i].template;
    }
    return (uint16_t)rule->alternatives[rule->alternative_count - 1].template;
}

/* The most specific rule whose context is there and of which an alternative applies. `ordinal` numbers the next draw;
 * NULL: a choice that needs one is NEEDS_DRAW. */
static uint16_t select_template(const tn_pass *pass, const contexts *around, const tn_growth_group *group,
                                uint32_t edge, uint64_t *ordinal)
{
    const tn_edge_state state = pass->old->states[edge];
    uint32_t own = tn_state_label(state);
    int32_t age = tn_state_age(state);
    for (uint32_t r = 0; r < group->rule_count; r++) {
        const tn_growth_rule *rule = &group->rules[r];
        if (rule->left != TN_NO_LABEL && !has_context(around, pass->sides[2 * (size_t)edge].origin, rule->left, own))
            continue;
        if (rule->right != TN_NO_LABEL &&
            !has_context(around, pass->sides[2 * (size_t)edge + 1].origin, rule->right, own))
            continue;
        if (rule->alternative_count == 1 || rule->conditional) {
            for (uint32_t i = 0; i < rule->alternative_count; i++)
                if (holds(&rule->alternatives[i], age))
                    return (uint16_t)rule->alternatives[i].template;
            continue;
        }
        if (rule->total <= 0)
            continue;
        if (!ordinal)
            return NEEDS_DRAW;
        return draw(pass->growth, rule, (*ordinal)++);
    }
    return TN_NO_TEMPLATE;
}

/* ---- predecessors of one edge each: every edge on its own */

/* The group of this pass that rewrites edges of a state, or TN_NONE. */
static uint32_t group_of(const tn_pass *pass, tn_edge_state state)
{
    uint32_t group = state & TN_STATE_FRESH ? TN_NONE : pass->growth->group_of[tn_state_label(state)];
    return group >= pass->group_first && group < pass->group_last ? group : TN_NONE;
}

typedef struct single_match {
    tn_pass *pass;
    const contexts *around;
    uint64_t *ordinals; /* of the next draw: by chunk, then group; NULL: no draws yet */
} single_match;

static void match_chunk(void *context, uint32_t chunk)
{
    const single_match *match = context;
    tn_pass *pass = match->pass;
    const tn_map *map = pass->old;
    uint64_t *ordinals =
        match->ordinals ? match->ordinals + (size_t)chunk * (pass->group_last - pass->group_first) : NULL;
    uint32_t begin = chunk * TN_CHUNK_EDGES;
    uint32_t end = map->edge_count - begin < TN_CHUNK_EDGES ? map->edge_count : begin + TN_CHUNK_EDGES;
    for (uint32_t e = begin; e < end; e++) {
        uint32_t g = group_of(pass, map->states[e]);
        if (g == TN_NONE) {
            pass->choice[e] = TN_NO_TEMPLATE;
            continue;
        }
        uint64_t *ordinal = ordinals ? &ordinals[g - pass->group_first] : NULL;
        pass->choice[e] = select_template(pass, match->around, &pass->growth->system->groups[g], e, ordinal);
    }
}

/* How many draws each group needs in each chunk, turned into the number of each one's first: groups in order, then
 * edges. */
static tn_status number_draws(tn_pass *pass, uint32_t chunks, uint64_t **ordinals, tn_error *error)
{
    const tn_map *map = pass->old;
    uint32_t groups = pass->group_last - pass->group_first;
    uint64_t *first = calloc((size_t)chunks * groups, sizeof *first);
    if (!first)
        return tn_fail_memory(error);
    for (uint32_t e = 0; e < map->edge_count; e++)
        if (pass->choice[e] == NEEDS_DRAW)
            first[(size_t)(e / TN_CHUNK_EDGES) * groups + group_of(pass, map->states[e]) - pass->group_first]++;
    for (uint32_t g = 0; g < groups; g++) {
        for (uint32_t c = 0; c < chunks; c++) {
            uint64_t here = first[(size_t)c * groups + g];
            first[(size_t)c * groups + g] = pass->growth->draws;
            pass->growth->draws += here;
        }
    }
    *ordinals = first;
    return TN_OK;
}

/* The template of every edge of a label, where neither context, age nor chance has a say; false if one has. */
static bool find_plain(tn_pass *pass)
{
    const tn_growth_system *system = pass->growth->system;
    uint16_t *template_of = pass->growth->template_of;
    memset(template_of, 0xff, system->label_count * sizeof *template_of);
    for (uint32_t g = pass->group_first; g < pass->group_last; g++) {
        const tn_growth_group *group = &system->groups[g];
        const tn_growth_rule *rule = &group->rules[0];
        if (group->rule_count == 0 || rule->left != TN_NO_LABEL || rule->right != TN_NO_LABEL ||
            rule->alternatives[0].comparison != TN_ALWAYS || (rule->alternative_count > 1 && !rule->conditional))
            return false;
        template_of[group->labels[0]] = (uint16_t)rule->alternatives[0].template;
    }
    pass->template_of = template_of;
    return true;
}

static tn_status match_singly(tn_pass *pass, const contexts *around, tn_error *error)
{
    uint32_t chunks = (pass->old->edge_count + TN_CHUNK_EDGES - 1) / TN_CHUNK_EDGES;
    single_match match = {pass, around, NULL};
    tn_status status = tn_crew_share(tn_pass_crew(pass), chunks, match_chunk, &match, error);
    if (status != TN_OK || !pass->growth->weighted)
        return status;
    status = number_draws(pass, chunks, &match.ordinals, error);
    if (status == TN_OK)
        status = tn_crew_share(tn_pass_crew(pass), chunks, match_chunk, &match, error);
    free(match.ordinals);
    return status;
}

/* ---- predecessors of several edges: a chain, head to tail through vertices of two edges, replaced as one */

typedef struct chain_search {
    tn_pass *pass;
    const contexts *around;
    uint32_t *degree; /* [vertex] */
    uint8_t *taken;   /* [edge] */
    uint32_t *size;   /* [face] edges it has, as replacements are made */
    uint32_t *chain;  /* edges of the one looked at */
    size_t capacity;  /* of the list */
} chain_search;

/* The edge that leaves `vertex` (which two edges share), or TN_NONE if it arrives there. */
static uint32_t next_in_chain(const tn_pass *pass, uint32_t edge)
{
    const tn_map *map = pass->old;
    uint32_t d = pass->dart[2 * (size_t)edge], f = pass->sides[2 * (size_t)edge].face,
             next = d + 1 == map->face_first[f + 1] ? map->face_first[f] : d + 1;
    return map->side[next] & 1 ? TN_NONE : map->side[next] / 2;
}

static bool find_chain(chain_search *search, const tn_growth_group *group, uint32_t edge)
{
    const tn_pass *pass = search->pass;
    search->chain[0] = edge;
    for (uint32_t i = 0; i < group->label_count; i++) {
        uint32_t e = search->chain[i];
        tn_edge_state state = pass->old->states[e];
        if (tn_state_label(state) != group->labels[i] || state & TN_STATE_FRESH || search->taken[e])
            return false;
        if (i + 1 == group->label_count)
            return pass->sides[2 * (size_t)edge].origin != pass->sides[2 * (size_t)e + 1].origin;
        if (search->degree[pass->sides[2 * (size_t)e + 1].origin] != 2)
            return false;
        uint32_t next = next_in_chain(pass, e);
        if (next == TN_NONE)
            return false;
        for (uint32_t j = 0; j <= i; j++)
            if (search->chain[j] == next)
                return false;
        search->chain[i + 1] = next;
    }
    return false;
}

static tn_status add_replacement(chain_search *search, uint32_t length, uint16_t template, tn_error *error)
{
    tn_pass *pass = search->pass;
    if (!tn_array_reserve(&pass->list, &search->capacity, pass->list_count, 1, sizeof *pass->list))
        return tn_fail_memory(error);
    pass->list[pass->list_count++] =
        (tn_edge_replacement){search->chain[0], search->chain[length - 1], length, template};
    return TN_OK;
}

/* A face keeps at least three edges: shortenings that would leave fewer are refused, in the order of the replacements.
 */
static void refuse_small_faces(chain_search *search)
{
    tn_pass *pass = search->pass;
    size_t kept = 0;
    for (size_t i = 0; i < pass->list_count; i++) {
        tn_edge_replacement *one = &pass->list[i];
        uint32_t left = pass->sides[2 * (size_t)one->first].face, right = pass->sides[2 * (size_t)one->last + 1].face;
        uint32_t pieces = pass->growth->system->templates[one->template].segment_count;
        if (one->length > pieces) {
            uint32_t loss = one->length - pieces;
            if (search->size[left] < loss + 3 || search->size[right] < loss + 3) {
                pass->growth->counts.refused++;
                continue;
            }
        }
        search->size[left] += pieces - one->length;
        search->size[right] += pieces - one->length;
        pass->list[kept++] = *one;
    }
    pass->list_count = kept;
}

static tn_status match_group(chain_search *search, const tn_growth_group *group, tn_error *error)
{
    tn_pass *pass = search->pass;
    for (uint32_t e = 0; e < pass->old->edge_count; e++) {
        if (!find_chain(search, group, e))
            continue;
        uint16_t template = select_template(pass, search->around, group, e, &pass->growth->draws);
        if (template == TN_NO_TEMPLATE)
            continue;
        for (uint32_t i = 0; i < group->label_count; i++)
            search->taken[search->chain[i]] = 1;
        tn_status status = add_replacement(search, group->label_count, template, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status match_chains(tn_pass *pass, const contexts *around, tn_error *error)
{
    const tn_map *map = pass->old;
    const tn_growth_system *system = pass->growth->system;
    uint32_t longest = 1;
    for (uint32_t g = pass->group_first; g < pass->group_last; g++)
        if (system->groups[g].label_count > longest)
            longest = system->groups[g].label_count;
    chain_search search = {.pass = pass, .around = around};
    search.degree = calloc(map->vertex_count, sizeof *search.degree);
    search.taken = calloc(map->edge_count, 1);
    search.size = malloc(map->face_count * sizeof *search.size);
    search.chain = malloc(longest * sizeof *search.chain);
    pass->list = malloc(64 * sizeof *pass->list);
    search.capacity = 64;
    tn_status status = TN_OK;
    if (!search.degree || !search.taken || !search.size || !search.chain || !pass->list) {
        status = tn_fail_memory(error);
    } else {
        for (size_t side = 0; side < 2 * (size_t)map->edge_count; side++)
            search.degree[pass->sides[side].origin]++;
        for (uint32_t f = 0; f < map->face_count; f++)
            search.size[f] = tn_face_size(map, f);
        for (uint32_t g = pass->group_first; g < pass->group_last && status == TN_OK; g++)
            status = match_group(&search, &system->groups[g], error);
        if (status == TN_OK)
            refuse_small_faces(&search);
    }
    free(search.degree);
    free(search.taken);
    free(search.size);
    free(search.chain);
    return status;
}

static bool has_chains(const tn_pass *pass)
{
    for (uint32_t g = pass->group_first; g < pass->group_last; g++)
        if (pass->growth->system->groups[g].label_count > 1)
            return true;
    return false;
}

tn_status tn_pass_match(tn_pass *pass, tn_error *error)
{
    contexts around;
    tn_status status = find_contexts(pass, &around, error);
    if (status == TN_OK && has_chains(pass)) {
        status = match_chains(pass, &around, error);
    } else if (status == TN_OK && !find_plain(pass)) {
        tn_pages *choices = &pass->growth->space.choices;
        if (tn_pages_reserve(choices, (uint64_t)pass->old->edge_count * sizeof *pass->choice)) {
            pass->choice = choices->data;
            status = match_singly(pass, &around, error);
        } else {
            status = tn_fail_memory(error);
        }
    }
    clear_contexts(&around);
    return status;
}
