/* Works out faces that are alike only once. */
#include "runtime/growth/join/pattern.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

/* ==== cuts a face into loops along its joined branches */

void tn_cuts_clear(tn_cuts *cuts)
{
    free(cuts->items);
    free(cuts->origins);
    free(cuts->sides);
    free(cuts->loops);
    free(cuts->joins);
    free(cuts->waiting);
    *cuts = (tn_cuts){0};
}

void tn_cuts_empty(tn_cuts *cuts)
{
    cuts->count = cuts->dart_count = cuts->loop_count = cuts->join_count = cuts->waiting_count = 0;
}

/* One more than is needed, so that there is an array to point into where nothing is. */
static bool make_room(tn_cuts *cuts, const tn_loop *loop, bool waiting)
{
    size_t joins = loop->join_count + 1, origin_room = cuts->dart_room;
    return tn_array_reserve(&cuts->items, &cuts->room, cuts->count, 1, sizeof *cuts->items) &&
           tn_array_reserve(&cuts->origins, &origin_room, cuts->dart_count, loop->item_count, sizeof *cuts->origins) &&
           tn_array_reserve(&cuts->sides, &cuts->dart_room, cuts->dart_count, loop->item_count, sizeof *cuts->sides) &&
           tn_array_reserve(&cuts->loops, &cuts->loop_room, cuts->loop_count, joins, sizeof *cuts->loops) &&
           tn_array_reserve(&cuts->joins, &cuts->join_room, cuts->join_count, joins, sizeof *cuts->joins) &&
           (!waiting || tn_array_reserve(&cuts->waiting, &cuts->waiting_room, cuts->waiting_count,
                                         loop->branch_count + 1, sizeof *cuts->waiting));
}

/* Branches met after a loop's last dart lie in the corner before its first: they come first. */
static void turn_waiting(tn_cut_waiting *list, uint32_t count, uint32_t first_dart, uint32_t end_dart)
{
    uint32_t tail = 0;
    while (tail < count && list[count - 1 - tail].dart == end_dart)
        tail++;
    for (uint32_t i = 0; i < tail; i++) {
        tn_cut_waiting last = list[count - 1];
        memmove(list + 1, list, (count - 1) * sizeof *list);
        last.dart = first_dart;
        list[0] = last;
    }
}

/* Writes the loop that item `start` lies on. A branch that joined is the dart towards its partner, after which the loop
 * goes on behind the partner. */
static void write_loop(tn_cuts *cuts, tn_cut *cut, tn_loop *loop, uint32_t start, bool waiting)
{
    uint32_t *origins = cuts->origins + cut->dart_first, *sides = cuts->sides + cut->dart_first;
    tn_cut_waiting *list = waiting ? cuts->waiting + cut->waiting_first : NULL;
    uint32_t first = cut->dart_count, before = cut->waiting_count, i = start;
    do {
        tn_loop_item *item = &loop->items[i];
        tn_loop_branch *branch = item->is_branch ? &loop->branches[item->value] : NULL;
        uint32_t next = i;
        if (!branch || branch->partner >= 0) {
            item->seen = true;
            origins[cut->dart_count] = item->vertex;
            sides[cut->dart_count] = branch ? TN_NONE : item->value;
            if (branch) {
                branch->dart = cut->dart_count;
                next = loop->branches[branch->partner].item;
            }
            cut->dart_count++;
        } else if (waiting) {
            list[cut->waiting_count++] = (tn_cut_waiting){item->value, cut->loop_count, cut->dart_count};
        }
        i = next + 1 == loop->item_count ? 0 : next + 1;
    } while (i != start);
    if (cut->waiting_count > before)
        turn_waiting(list + before, cut->waiting_count - before, first, cut->dart_count);
    cuts->loops[cut->loop_first + cut->loop_count++] = (tn_cut_loop){cut->dart_count, loop->items[start].region};
}

bool tn_cuts_add(tn_cuts *cuts, tn_loop *loop, bool waiting)
{
    if (!make_room(cuts, loop, waiting))
        return false;
    tn_cut *cut = &cuts->items[cuts->count++];
    *cut = (tn_cut){cuts->dart_count, cuts->loop_count, cuts->join_count, cuts->waiting_count, 0, 0, 0, 0};
    for (uint32_t i = 0; i < loop->item_count; i++) {
        const tn_loop_item *item = &loop->items[i];
        if (!item->seen && (!item->is_branch || loop->branches[item->value].partner >= 0))
            write_loop(cuts, cut, loop, i, waiting);
    }
    for (uint32_t i = 0; i < loop->join_count; i++) {
        const tn_loop_branch *one = &loop->branches[loop->joins[i].start], *other = &loop->branches[loop->joins[i].end];
        cuts->joins[cut->join_first + cut->join_count++] =
            (tn_cut_join){one->id, other->id, one->dart, other->dart, one->reversed != other->reversed, false, 0};
    }
    cuts->dart_count += cut->dart_count;
    cuts->loop_count += cut->loop_count;
    cuts->join_count += cut->join_count;
    cuts->waiting_count += cut->waiting_count;
    return true;
}

/* ---- references */

typedef struct table {
    const tn_pass *pass;
    uint32_t first, size; /* darts of the face */
} table;

/* The pieces that a dart's edge became; 0 if it is kept. */
static uint32_t pieces_of(const table *face, uint32_t dart)
{
    const tn_record *record = &face->pass->records[face->pass->old->side[face->first + dart] / 2];
    return tn_is_kept(record) ? 0 : face->pass->growth->system->templates[record->template].segment_count;
}

static uint32_t refer_to_vertex(const table *face, uint32_t vertex)
{
    uint32_t bases[TN_BASES];
    for (uint32_t i = 0; i < face->size; i++) {
        tn_dart_bases(face->pass, face->first + i, bases);
        if (bases[TN_BASE_ORIGIN] == vertex)
            return tn_refer(i, TN_BASE_ORIGIN, 0);
        uint32_t pieces = pieces_of(face, i), more = vertex - bases[TN_BASE_VERTEX];
        if (pieces > 0 && more < pieces - 1)
            return tn_refer(i, TN_BASE_VERTEX, more);
    }
    return 0;
}

static uint32_t refer_to_side(const table *face, uint32_t side)
{
    uint32_t bases[TN_BASES];
    for (uint32_t i = 0; i < face->size; i++) {
        tn_dart_bases(face->pass, face->first + i, bases);
        uint32_t pieces = pieces_of(face, i), more = side - bases[TN_BASE_SIDE];
        if (pieces ? more < 2 * pieces : more == 0)
            return tn_refer(i, TN_BASE_SIDE, more);
    }
    return 0;
}

/* Returns what the template says of the branch, too. */
static const tn_template_branch *refer_to_branch(const table *face, uint32_t *id)
{
    for (uint32_t i = 0; i < face->size; i++) {
        const tn_record *record = &face->pass->records[face->pass->old->side[face->first + i] / 2];
        if (tn_is_kept(record))
            continue;
        const tn_template *template = face->pass->growth->shapes[record->template].template;
        uint32_t more = *id - record->branch;
        if (more >= template->branch_count)
            continue;
        *id = tn_refer(i, TN_BASE_BRANCH, more);
        return &template->branches[more];
    }
    return NULL;
}

static void refer_to_joint(const table *face, tn_cut_join *join)
{
    const tn_template_branch *one = refer_to_branch(face, &join->one), *other = refer_to_branch(face, &join->other);
    join->aged = one->age != TN_AGE_ZERO || other->age != TN_AGE_ZERO;
    join->state = tn_state(one->label, 0, false);
}

/* Turns the last cut that was added, made of this face's loop, into one of references. */
static void cuts_refer(tn_cuts *cuts, const tn_pass *pass, uint32_t face, const tn_loop *loop)
{
    const tn_cut *cut = &cuts->items[cuts->count - 1];
    table of = {pass, pass->old->face_first[face], tn_face_size(pass->old, face)};
    for (size_t d = cut->dart_first; d < cut->dart_first + cut->dart_count; d++) {
        cuts->origins[d] = refer_to_vertex(&of, cuts->origins[d]);
        cuts->sides[d] = cuts->sides[d] == TN_NONE ? 0 : refer_to_side(&of, cuts->sides[d]);
    }
    for (size_t j = cut->join_first; j < cut->join_first + cut->join_count; j++)
        refer_to_joint(&of, &cuts->joins[j]);
    for (size_t w = cut->waiting_first; w < cut->waiting_first + cut->waiting_count; w++) {
        cuts->waiting[w].branch = loop->branches[cuts->waiting[w].branch].id;
        refer_to_branch(&of, &cuts->waiting[w].branch);
    }
}

#define BRANCHES 32u
#define PAIRS 32u
#define CANDIDATES 7u   /* pairs that may join in one face where their order matters: a byte each names them in a key */
#define PATTERNS 1024u  /* past it, faces are worked out by themselves */
#define VARIANTS 65536u /* likewise */
#define TEMPLATES 32767u /* that a code can name; systems of more have no patterns */
#define CODES 4u         /* in a word */
#define CODE_WORDS (TN_PATTERN_DARTS / CODES)
#define ORDERED ((uint64_t)1 << 63)
#define FLIPPED 0x40u /* in an ordered key: the pair's second branch is the lower one */
#define CLOSE 1e-5f   /* to a right answer's border: many times what rounding to float could change */

typedef struct pattern_branch {
    uint32_t dart; /* of the face */
    uint32_t index, point;
    const tn_template_branch *is;
    bool against;
} pattern_branch;

/* Two branches of one label, at vertices that nothing links. */
typedef struct pattern_pair {
    pattern_branch a, b;
    uint32_t against; /* the pairs that it excludes: a bit each */
} pattern_pair;

typedef struct tn_pattern {
    uint64_t codes[CODE_WORDS]; /* 16 bits for each dart: 0: kept; otherwise 1 + 2 * template + against */
    uint32_t size;
    bool unusual;      /* to be worked out by themselves */
    uint32_t last_cut; /* of the variant met last */
    uint64_t last_key;
    uint32_t pair_count;
    pattern_pair pairs[PAIRS];
} tn_pattern;

/* Which pairs join. Where no two exclude one another, its key has a bit for each; otherwise they are named in their
 * order, nearest first, a byte each: 1 + the pair's index, FLIPPED. */
typedef struct tn_variant {
    uint64_t key;
    uint32_t pattern, cut;
} tn_variant;

typedef struct candidate {
    double distance;
    uint32_t low, high; /* ids */
    uint8_t name;
} candidate;

/* A face as it is looked at. */
typedef struct view {
    const tn_pass *pass;
    uint32_t first, size; /* its darts */
    uint64_t codes[CODE_WORDS];
    uint32_t branches[TN_PATTERN_DARTS]; /* [dart] its edge's first */
} view;

void tn_patterns_clear(tn_patterns *patterns)
{
    free(patterns->items);
    free(patterns->variants);
    tn_hash_clear(&patterns->table);
    tn_cuts_clear(&patterns->cuts);
    *patterns = (tn_patterns){0};
}

void tn_patterns_forget(tn_patterns *patterns)
{
    patterns->count = patterns->variant_count = 0;
    tn_hash_forget(&patterns->table);
    tn_cuts_empty(&patterns->cuts);
}

static inline void look(const tn_pass *pass, uint32_t face, view *seen)
{
    const uint32_t *sides = pass->old->side + pass->old->face_first[face];
    uint32_t size = tn_face_size(pass->old, face);
    seen->pass = pass;
    seen->first = pass->old->face_first[face];
    seen->size = size;
    for (uint32_t first = 0; first < size; first += CODES) {
        uint32_t end = size - first < CODES ? size : first + CODES;
        uint64_t word = 0;
        for (uint32_t i = first; i < end; i++) {
            const tn_record *record = &pass->records[sides[i] / 2];
            uint32_t code = tn_is_kept(record) ? 0 : 1 + 2 * (uint32_t)record->template + (sides[i] & 1);
            seen->branches[i] = record->branch;
            word |= (uint64_t)code << 16 * (i - first);
        }
        seen->codes[first / CODES] = word;
    }
}

static uint32_t code_at(const tn_pattern *pattern, uint32_t dart)
{
    return pattern->codes[dart / CODES] >> 16 * (dart % CODES) & 0xffff;
}

/* ---- the pattern of a face */

static inline uint64_t hash_of(const uint64_t *codes, uint32_t size)
{
    uint64_t hash = size;
    for (uint32_t i = 0; i * CODES < size; i++)
        hash = (hash ^ codes[i]) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 32;
}

static inline bool same_codes(const uint64_t *a, const uint64_t *b, uint32_t size)
{
    for (uint32_t i = 0; i * CODES < size; i++)
        if (a[i] != b[i])
            return false;
    return true;
}

typedef struct wanted_pattern {
    const tn_patterns *patterns;
    const uint64_t *codes;
    uint32_t size;
} wanted_pattern;

static bool is_wanted(const void *context, uint32_t number)
{
    const wanted_pattern *w = context;
    const tn_pattern *one = &w->patterns->items[number];
    return one->size == w->size && same_codes(one->codes, w->codes, w->size);
}

/* The branches that lie in such a face, as its loop meets them; false if it is unusual. */
static bool list_branches(const tn_pass *pass, const tn_pattern *pattern, pattern_branch *list, uint32_t *count)
{
    *count = 0;
    for (uint32_t i = 0; i < pattern->size; i++) {
        uint32_t code = code_at(pattern, i);
        if (code == TN_CODE_NONE)
            continue;
        const tn_shape *shape = &pass->growth->shapes[(code - 1) / 2];
        bool against = (code - 1) & 1;
        const tn_walk *walk = against ? shape->right : shape->left;
        for (uint32_t w = 0; w < (against ? shape->right_count : shape->left_count); w++) {
            if (!walk[w].branch)
                continue;
            if (*count == BRANCHES || walk[w].at == 0 || walk[w].at == shape->template->segment_count)
                return false;
            list[(*count)++] =
                (pattern_branch){i, walk[w].index, walk[w].at, &shape->template->branches[walk[w].index], against};
        }
    }
    return true;
}

static bool same_vertex(const pattern_branch *a, const pattern_branch *b)
{
    return a->dart == b->dart && a->point == b->point;
}

/* Pairs exclude one another where they share a branch, link the same vertices, or cross. Branches are told apart by
 * their places on the loop, which are ascending. */
static bool exclude(const pattern_pair *p, const pattern_pair *q)
{
    bool shared = p->a.is == q->a.is && p->a.dart == q->a.dart;
    shared |= p->a.is == q->b.is && p->a.dart == q->b.dart;
    shared |= p->b.is == q->a.is && p->b.dart == q->a.dart;
    shared |= p->b.is == q->b.is && p->b.dart == q->b.dart;
    return shared || (same_vertex(&p->a, &q->a) && same_vertex(&p->b, &q->b)) ||
           (same_vertex(&p->a, &q->b) && same_vertex(&p->b, &q->a));
}

/* Branches a < b and c < d, by their places on the loop. */
static bool cross(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    return (a < c && c < b && b < d) || (c < a && a < d && d < b);
}

static void add_pairs(const tn_pass *pass, tn_pattern *pattern)
{
    pattern_branch list[BRANCHES];
    uint32_t count, places[PAIRS][2];
    pattern->unusual = !list_branches(pass, pattern, list, &count);
    for (uint32_t i = 0; i < count && !pattern->unusual; i++) {
        for (uint32_t j = i + 1; j < count; j++) {
            const pattern_branch *x = &list[i], *y = &list[j];
            bool near = x->dart == y->dart && x->point <= y->point + 1 && y->point <= x->point + 1;
            if (near || x->is->label != y->is->label)
                continue;
            if (pattern->pair_count == PAIRS) {
                pattern->unusual = true;
                break;
            }
            pattern_pair *pair = &pattern->pairs[pattern->pair_count];
            *pair = (pattern_pair){.a = *x, .b = *y};
            for (uint32_t p = 0; p < pattern->pair_count; p++) {
                if (!exclude(&pattern->pairs[p], pair) && !cross(places[p][0], places[p][1], i, j))
                    continue;
                pair->against |= 1u << p;
                pattern->pairs[p].against |= 1u << pattern->pair_count;
            }
            places[pattern->pair_count][0] = i;
            places[pattern->pair_count++][1] = j;
        }
    }
}

/* The face's pattern; NULL if there are too many. The first of its kind is added. False: out of memory. */
static bool find_pattern(tn_patterns *patterns, const view *seen, tn_pattern **found)
{
    *found = NULL;
    uint64_t hash = hash_of(seen->codes, seen->size);
    wanted_pattern wanted = {patterns, seen->codes, seen->size};
    uint32_t number = tn_hash_find(&patterns->table, hash, is_wanted, &wanted);
    if (number != TN_HASH_NONE) {
        *found = &patterns->items[number];
        return true;
    }
    if (patterns->count == PATTERNS)
        return true;
    number = (uint32_t)patterns->count;
    if (!tn_array_reserve(&patterns->items, &patterns->room, patterns->count, 1, sizeof *patterns->items) ||
        tn_hash_enter(&patterns->table, hash, is_wanted, &wanted, &number, NULL) != TN_OK)
        return false;
    tn_pattern *added = &patterns->items[patterns->count++];
    memset(added, 0, sizeof *added);
    added->size = seen->size;
    memcpy(added->codes, seen->codes, (seen->size + CODES - 1) / CODES * sizeof *seen->codes);
    add_pairs(seen->pass, added);
    *found = added;
    return true;
}

/* ---- the pairs that may join */

static tn_vector exact_direction(const view *seen, const pattern_branch *branch)
{
    uint32_t edge = seen->pass->old->side[seen->first + branch->dart] / 2;
    tn_vector heading, up;
    double length;
    tn_pass_frame(seen->pass, edge, edge, &heading, &up, &length);
    return tn_branch_direction(heading, up, branch->is);
}

static inline const tn_record *record_of(const view *seen, uint32_t dart)
{
    return &seen->pass->records[seen->pass->old->side[seen->first + dart] / 2];
}

static inline uint32_t id_of(const view *seen, uint32_t dart, uint32_t index)
{
    return seen->branches[dart] + index;
}

static inline const tn_aim *aim_of(const view *seen, const pattern_branch *branch)
{
    return &seen->pass->aims[id_of(seen, branch->dart, branch->index) - seen->pass->branch_first];
}

static inline bool oppose(const view *seen, const pattern_pair *pair)
{
    const float *a = aim_of(seen, &pair->a)->direction, *b = aim_of(seen, &pair->b)->direction;
    float beyond = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - (float)seen->pass->growth->branch_cosine;
    if (beyond < -CLOSE || beyond > CLOSE)
        return beyond < 0;
    return tn_branches_oppose(seen->pass->growth, exact_direction(seen, &pair->a), exact_direction(seen, &pair->b));
}

/* The pairs whose directions are opposed, a bit each, and those that they exclude; false if another face might join
 * the same vertices, so that this one has to be worked out by itself. */
static bool find_opposed(const tn_pattern *pattern, const view *seen, uint32_t *opposed, uint32_t *excluded)
{
    *opposed = *excluded = 0;
    for (uint32_t p = 0; p < pattern->pair_count; p++) {
        const pattern_pair *pair = &pattern->pairs[p];
        if (!oppose(seen, pair))
            continue;
        uint32_t other = aim_of(seen, &pair->a)->beyond;
        if (other == aim_of(seen, &pair->b)->beyond && other != TN_OUTER_FACE)
            return false;
        *opposed |= 1u << p;
        *excluded |= pair->against;
    }
    return true;
}

static tn_vector place_of(const view *seen, const pattern_branch *branch)
{
    const tn_pass *pass = seen->pass;
    uint32_t vertex = record_of(seen, branch->dart)->vertex + branch->point - 1;
    return tn_vector_at(pass->new->positions + 3 * (size_t)vertex);
}

static bool measure(const view *seen, const pattern_pair *pair, uint32_t index, candidate *one)
{
    uint32_t x = id_of(seen, pair->a.dart, pair->a.index);
    uint32_t y = id_of(seen, pair->b.dart, pair->b.index);
    *one = x < y ? (candidate){0, x, y, (uint8_t)(1 + index)} : (candidate){0, y, x, (uint8_t)((1 + index) | FLIPPED)};
    return tn_branches_measure(seen->pass->growth, exact_direction(seen, &pair->a), place_of(seen, &pair->a),
                               exact_direction(seen, &pair->b), place_of(seen, &pair->b),
                               &one->distance) == TN_JOIN_FAILURE_COUNT;
}

static bool comes_before(const candidate *a, const candidate *b)
{
    if (a->distance != b->distance)
        return a->distance < b->distance;
    return a->low != b->low ? a->low < b->low : a->high < b->high;
}

/* The key of opposed pairs in their order; false if they are too many. */
static bool order(const tn_pattern *pattern, const view *seen, uint32_t opposed, uint64_t *key)
{
    candidate list[CANDIDATES], one;
    uint32_t count = 0;
    for (uint32_t p = 0; p < pattern->pair_count; p++) {
        if (!(opposed >> p & 1) || !measure(seen, &pattern->pairs[p], p, &one))
            continue;
        if (count == CANDIDATES)
            return false;
        uint32_t j = count++;
        for (; j > 0 && comes_before(&one, &list[j - 1]); j--)
            list[j] = list[j - 1];
        list[j] = one;
    }
    *key = ORDERED;
    for (uint32_t i = 0; i < count; i++)
        *key |= (uint64_t)list[i].name << 8 * i;
    return true;
}

/* ---- the cut */

static bool find_variant(const tn_patterns *patterns, uint32_t pattern, uint64_t key, size_t *at)
{
    size_t low = 0, high = patterns->variant_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        const tn_variant *one = &patterns->variants[middle];
        if (one->pattern < pattern || (one->pattern == pattern && one->key < key))
            low = middle + 1;
        else
            high = middle;
    }
    *at = low;
    return low < patterns->variant_count && patterns->variants[low].pattern == pattern &&
           patterns->variants[low].key == key;
}

/* Works the face out, and keeps the cut for others like it. */
static bool add_variant(tn_patterns *patterns, const tn_pass *pass, uint32_t face, tn_loop *loop, tn_variant variant,
                        size_t at)
{
    if (!tn_array_reserve(&patterns->variants, &patterns->variant_room, patterns->variant_count, 1,
                          sizeof *patterns->variants) ||
        !tn_loop_expand(loop, pass, face, true) ||
        tn_loop_join_branches(loop, pass, face, NULL) != TN_JOINED || /* never later: nothing is shared */
        !tn_cuts_add(&patterns->cuts, loop, true))
        return false;
    cuts_refer(&patterns->cuts, pass, face, loop);
    variant.cut = (uint32_t)patterns->cuts.count - 1;
    memmove(patterns->variants + at + 1, patterns->variants + at,
            (patterns->variant_count - at) * sizeof *patterns->variants);
    patterns->variants[at] = variant;
    patterns->variant_count++;
    return true;
}

static bool find_cut(tn_patterns *patterns, const tn_pass *pass, uint32_t face, tn_loop *loop, tn_pattern *pattern,
                     uint64_t key, uint32_t *cut)
{
    size_t at;
    uint32_t index = (uint32_t)(pattern - patterns->items);
    if (!find_variant(patterns, index, key, &at)) {
        if (patterns->variant_count == VARIANTS)
            return true;
        if (!add_variant(patterns, pass, face, loop, (tn_variant){key, index, 0}, at))
            return false;
    }
    pattern->last_key = key;
    pattern->last_cut = *cut = patterns->variants[at].cut;
    return true;
}

static tn_edge_state aged_state(const tn_pass *pass, const tn_cut_join *join, const view *seen)
{
    const tn_record *one = record_of(seen, tn_reference_dart(join->one));
    const tn_record *other = record_of(seen, tn_reference_dart(join->other));
    const tn_template_branch *a = &pass->growth->system->templates[one->template].branches[join->one & 0xffff];
    const tn_template_branch *b = &pass->growth->system->templates[other->template].branches[join->other & 0xffff];
    int32_t age = tn_changed_age(a->age, one->age), other_age = tn_changed_age(b->age, other->age);
    return tn_state(a->label, age > other_age ? age : other_age, false);
}

static void note_joins(const tn_pass *pass, const tn_cuts *cuts, const tn_cut *cut, const view *seen)
{
    const tn_cut_join *join = cuts->joins + cut->join_first, *end = join + cut->join_count;
    for (; join < end; join++) {
        uint32_t one = id_of(seen, tn_reference_dart(join->one), join->one & 0xffff);
        uint32_t other = id_of(seen, tn_reference_dart(join->other), join->other & 0xffff);
        pass->joints[one < other ? one : other] = join->aged ? aged_state(pass, join, seen) : join->state;
    }
}

bool tn_patterns_decide(tn_patterns *patterns, const tn_pass *pass, uint32_t face, tn_loop *loop, uint32_t *cut)
{
    const tn_growth *growth = pass->growth;
    view seen;
    tn_pattern *pattern;
    uint32_t opposed, excluded;
    *cut = TN_NONE;
    if (growth->system->template_count > TEMPLATES)
        return true;
    look(pass, face, &seen);
    if (!find_pattern(patterns, &seen, &pattern))
        return false;
    if (!pattern || pattern->unusual || !find_opposed(pattern, &seen, &opposed, &excluded))
        return true;
    /* The order matters where pairs exclude one another, and to the ranks of the faces that they make. */
    uint64_t key = (uint64_t)opposed + 1; /* not 0, which no variant has */
    bool measured = growth->options.facing || growth->options.branch_length >= 0;
    if (opposed && (growth->ranked || measured || opposed & excluded) && !order(pattern, &seen, opposed, &key))
        return true;
    if (pattern->last_key == key)
        *cut = pattern->last_cut;
    else if (!find_cut(patterns, pass, face, loop, pattern, key, cut))
        return false;
    if (*cut != TN_NONE)
        note_joins(pass, &patterns->cuts, &patterns->cuts.items[*cut], &seen);
    return true;
}
