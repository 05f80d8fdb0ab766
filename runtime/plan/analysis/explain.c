/* Explains why a rule matches a plan or does not. */
#include "runtime/plan/analysis/explain.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/module/code.h"
#include "runtime/plan/match/image_search.h"
#include "runtime/plan/match/relation.h"
#include "runtime/plan/match/vm.h"

typedef struct tn_explaining {
    tn_explanation *result;
    tn_plan_vm *vm;
    uint64_t ***relations; /* [tree][part * 2 + mirrored]: in places of the plan as it is, or NULL */
    uint64_t bytes;        /* of the relations */
    size_t words;          /* of a row */
    unsigned depth;
    tn_error *error;
} tn_explaining;

/* A part of a tree, read in a direction. */
typedef struct tn_reader_of {
    uint32_t tree, part;
    bool mirrored;
} tn_reader_of;

static inline const tn_part *tn_part_of(const tn_explaining *e, tn_reader_of who)
{
    return &e->result->trees[who.tree].parts[who.part];
}

static inline tn_reader_of tn_child(tn_reader_of who, uint32_t child)
{
    return (tn_reader_of){who.tree, child, who.mirrored};
}

static inline bool tn_in(const tn_explaining *e, const uint64_t *relation, tn_stretch s)
{
    return tn_relation_row_has(relation + s.begin * e->words, s.end);
}

tn_status tn_explain_stretch(tn_explaining *e, uint32_t node, tn_stretch stretch); /* adds one where it matched */

/* How a part is asked for. */
typedef enum tn_asked {
    TN_ASKED_AS_WRITTEN, /* somewhere in the region where the code says so, otherwise of the region as a whole */
    TN_ASKED_SOMEWHERE,
    TN_ASKED_SINGLES, /* the single trays that it matches */
    TN_ASKED_STARTS,  /* the places that it matches from */
} tn_asked;

static tn_status explain_relation(tn_explaining *e, tn_reader_of who, const uint64_t **relation);
static tn_status explain_gap(tn_explaining *e, uint32_t node, tn_gap gap);
static tn_status explain_part(tn_explaining *e, tn_reader_of who, tn_stretch region, tn_asked asked, uint32_t parent,
                              uint32_t *node);
static tn_status explain_number(tn_explaining *e, tn_reader_of who, tn_stretch region, int64_t *number);

/* ---- neighbours */

/* A neighbour's parts from left to right on the plan as it is: mirrored, they lie the other way round. */
typedef struct row_of_parts {
    tn_reader_of *who;
    const uint64_t **relation;
    uint32_t count;
} row_of_parts;

static void row_clear(row_of_parts *row)
{
    free(row->who);
    free(row->relation);
}

static tn_status row_make(tn_explaining *e, tn_reader_of neighbour, row_of_parts *row)
{
    const tn_part *part = tn_part_of(e, neighbour);
    *row = (row_of_parts){malloc((part->child_count + 1) * sizeof *row->who),
                          malloc((part->child_count + 1) * sizeof *row->relation), part->child_count};
    if (!row->who || !row->relation)
        return tn_fail_memory(e->error);
    uint32_t child = part->first;
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < row->count; k++) {
        uint32_t at = neighbour.mirrored ? row->count - 1 - k : k;
        row->who[at] = tn_child(neighbour, child);
        child = tn_part_of(e, row->who[at])->next;
        status = explain_relation(e, row->who[at], &row->relation[at]);
    }
    return status;
}

static bool is_optional(const tn_explaining *e, const row_of_parts *row, uint32_t k)
{
    return tn_part_of(e, row->who[k])->optional;
}

/* The first end at or after `from` such that part k matches [i, end) and the parts after it can go on from there. */
static uint32_t next_cut(const tn_explaining *e, const row_of_parts *row, const uint8_t *fits, uint32_t k, uint32_t i,
                         uint32_t places)
{
    const uint64_t *bits = row->relation[k] + i * e->words;
    for (size_t end = tn_relation_row_next(bits, i + 1, e->words); end != TN_NO_BIT;
         end = tn_relation_row_next(bits, end + 1, e->words))
        if (fits[(size_t)(k + 1) * places + end])
            return (uint32_t)end;
    return UINT32_MAX;
}

/* fits[k][i]: can the parts first + k .. last - 1 fill [i, end)? */
static void fill(const tn_explaining *e, const row_of_parts *row, uint32_t first, uint32_t last, uint32_t end,
                 uint8_t *fits)
{
    uint32_t places = e->result->length + 1;
    fits[(size_t)last * places + end] = 1;
    for (uint32_t k = last; k-- > first;)
        for (uint32_t i = 0; i <= end; i++)
            fits[(size_t)k * places + i] = next_cut(e, row, fits, k, i, places) != UINT32_MAX ||
                                           (is_optional(e, row, k) && fits[(size_t)(k + 1) * places + i]);
}

/* ---- the parts below a neighbour */
static tn_status explain_neighbour(tn_explaining *e, tn_reader_of who, uint32_t node, tn_stretch stretch)
{
    row_of_parts row;
    tn_status status = row_make(e, who, &row);
    uint32_t places = e->result->length + 1, at = stretch.begin;
    uint8_t *fits = calloc(((size_t)row.count + 1) * places, 1);
    if (status == TN_OK && !fits)
        status = tn_fail_memory(e->error);
    if (status == TN_OK)
        fill(e, &row, 0, row.count, stretch.end, fits);
    for (uint32_t k = 0; status == TN_OK && k < row.count; k++) {
        uint32_t end = next_cut(e, &row, fits, k, at, places), made;
        if (end == UINT32_MAX) { /* left out */
            status = explain_part(e, row.who[k], (tn_stretch){at, at}, TN_ASKED_AS_WRITTEN, node, &made);
            if (status == TN_OK) {
                e->result->nodes[made].absent = true;
                e->result->nodes[made].matched = true;
            }
            continue;
        }
        status = explain_part(e, row.who[k], (tn_stretch){at, end}, TN_ASKED_AS_WRITTEN, node, &made);
        at = end;
    }
    free(fits);
    row_clear(&row);
    return status;
}

/* How many parts from `first` on fit side by side from place i, and where they can end. */
static uint32_t run_from(const tn_explaining *e, const row_of_parts *row, uint32_t first, uint32_t i, uint32_t limit,
                         uint8_t *now, uint8_t *next, uint32_t *end)
{
    uint32_t places = e->result->length + 1, length = 0;
    memset(now, 0, places);
    now[i] = 1;
    *end = i;
    for (uint32_t k = first; k < row->count; k++) {
        bool any = false;
        uint32_t reached = 0;
        memset(next, 0, places);
        for (uint32_t p = i; p <= limit; p++) {
            if (!now[p])
                continue;
            const uint64_t *bits = row->relation[k] + p * e->words;
            for (size_t to = tn_relation_row_next(bits, p + 1, e->words); to != TN_NO_BIT && to <= limit;
                 to = tn_relation_row_next(bits, to + 1, e->words)) {
                reached = any ? reached : (uint32_t)to;
                any = true;
                next[to] = 1;
            }
        }
        if (!any)
            break;
        memcpy(now, next, places);
        *end = reached;
        length++;
    }
    return length;
}

/* The longest run, the leftmost of several. */
static void find_run(tn_explaining *e, const row_of_parts *row, uint32_t node, bool mirrored, uint8_t *room)
{
    tn_why *why = &e->result->nodes[node];
    uint32_t places = e->result->length + 1;
    for (uint32_t first = 0; first < row->count; first++) {
        for (uint32_t i = why->region.begin; i < why->region.end; i++) {
            uint32_t end, length = run_from(e, row, first, i, why->region.end, room, room + places, &end);
            if (length <= why->run_count)
                continue;
            why->run_count = length;
            why->run_first = mirrored ? row->count - first - length : first;
            why->run = (tn_stretch){i, end};
        }
    }
}

static tn_status explain_no_neighbour(tn_explaining *e, tn_reader_of who, uint32_t node)
{
    row_of_parts row;
    tn_status status = row_make(e, who, &row);
    uint8_t *room = malloc(2 * ((size_t)e->result->length + 1));
    if (status == TN_OK && !room)
        status = tn_fail_memory(e->error);
    if (status == TN_OK)
        find_run(e, &row, node, who.mirrored, room);
    tn_stretch region = e->result->nodes[node].region;
    for (uint32_t k = 0; status == TN_OK && k < row.count; k++) {
        uint32_t made;
        status = explain_part(e, row.who[k], region, TN_ASKED_SOMEWHERE, node, &made);
    }
    free(room);
    row_clear(&row);
    return status;
}

/* ---- what is repeated */

/* The first end behind `at` of a stretch of the relation from which `left` more lead on to the end (fits[n][i]: n of
 * them fill [i, end)). */
static uint32_t next_repeat(const tn_explaining *e, const uint64_t *relation, const uint8_t *fits, uint32_t left,
                            uint32_t at, uint32_t places)
{
    const uint64_t *bits = relation + at * e->words;
    size_t end = tn_relation_row_next(bits, at + 1, e->words);
    while (end != TN_NO_BIT && !fits[(size_t)left * places + end])
        end = end + 1 < places ? tn_relation_row_next(bits, end + 1, e->words) : TN_NO_BIT;
    return end == TN_NO_BIT ? UINT32_MAX : (uint32_t)end;
}

/* As few as fill it, from the left each as short as it can be. */
static tn_status explain_repeat(tn_explaining *e, tn_reader_of who, uint32_t node, tn_stretch stretch)
{
    const tn_part *part = tn_part_of(e, who);
    tn_reader_of each = tn_child(who, part->first);
    uint32_t least = part->least, places = e->result->length + 1, most = stretch.end - stretch.begin, count = 0;
    const uint64_t *relation;
    tn_status status = explain_relation(e, each, &relation);
    uint8_t *fits = calloc((size_t)most + 1, places);
    if (status == TN_OK && !fits)
        status = tn_fail_memory(e->error);
    if (status == TN_OK)
        fits[stretch.end] = 1;
    while (status == TN_OK && count < most && !(count >= least && fits[(size_t)count * places + stretch.begin])) {
        for (uint32_t i = stretch.begin; i < stretch.end; i++)
            fits[((size_t)count + 1) * places + i] = next_repeat(e, relation, fits, count, i, places) != UINT32_MAX;
        count++;
    }
    for (uint32_t at = stretch.begin; status == TN_OK && count > 0;) {
        uint32_t end = next_repeat(e, relation, fits, --count, at, places), made;
        status =
            end == UINT32_MAX ? TN_OK : explain_part(e, each, (tn_stretch){at, end}, TN_ASKED_AS_WRITTEN, node, &made);
        at = end;
    }
    free(fits);
    return status;
}

/* ---- distances, and what lies around */

#define GAPS_MAX 64u /* shown of one distance */

typedef struct looking {
    tn_explaining *e;
    tn_reader_of separator;
    const uint64_t *source, *destination, *between;
    uint32_t node;
    bool near;     /* is one destination whose gap fits enough? */
    bool overlaps; /* do destinations that share a tray with the source count? */
} looking;

/* What separates a source and a destination: nothing, at the source's start, where they overlap (M of `distance`). */
static tn_stretch between(tn_stretch source, tn_stretch destination)
{
    if (destination.end <= source.begin)
        return (tn_stretch){destination.end, source.begin};
    if (source.end <= destination.begin)
        return (tn_stretch){source.end, destination.begin};
    return (tn_stretch){source.begin, source.begin};
}

static tn_status add_gap(const looking *l, tn_stretch source, tn_stretch destination)
{
    tn_gap gap = {.source = source, .destination = destination, .between = between(source, destination)};
    if (l->e->result->nodes[l->node].gap_count >= GAPS_MAX)
        return TN_OK;
    gap.fits = tn_in(l->e, l->between, gap.between);
    tn_status status = explain_number(l->e, l->separator, gap.between, &gap.number);
    return status == TN_OK ? explain_gap(l->e, l->node, gap) : status;
}

static bool overlap(tn_stretch a, tn_stretch b)
{
    return a.begin < b.end && b.begin < a.end;
}

/* Of a source: the first destination whose gap decides; or, where none does, the nearest on either side. */
static tn_status look_from(const looking *l, tn_stretch source)
{
    uint32_t length = l->e->result->length;
    tn_stretch left = {0, 0}, right = {0, 0};
    for (uint32_t a = 0; a < length; a++) {
        const uint64_t *row = l->destination + a * l->e->words;
        for (size_t b = tn_relation_row_next(row, a + 1, l->e->words); b != TN_NO_BIT;
             b = tn_relation_row_next(row, b + 1, l->e->words)) {
            tn_stretch destination = {a, (uint32_t)b};
            if (!l->overlaps && overlap(source, destination))
                continue;
            if (tn_in(l->e, l->between, between(source, destination)) == l->near)
                return add_gap(l, source, destination);
            if (destination.end <= source.begin && (left.end == 0 || destination.end > left.end))
                left = destination;
            if (destination.begin >= source.end && right.end == 0)
                right = destination;
        }
    }
    tn_status status = left.end ? add_gap(l, source, left) : TN_OK;
    return status == TN_OK && right.end ? add_gap(l, source, right) : status;
}

static tn_status explain_distance(tn_explaining *e, tn_reader_of who, uint32_t node, tn_stretch stretch)
{
    const tn_part *part = tn_part_of(e, who);
    tn_reader_of source = tn_child(who, part->first);
    tn_reader_of destination = tn_child(who, tn_part_of(e, source)->next);
    looking l = {.e = e,
                 .separator = tn_child(who, tn_part_of(e, destination)->next),
                 .node = node,
                 .near = part->kind == TN_PART_NEAR,
                 .overlaps = part->kind == TN_PART_DISTANCE};
    tn_status status = explain_relation(e, source, &l.source);
    if (status == TN_OK)
        status = explain_relation(e, destination, &l.destination);
    if (status == TN_OK)
        status = explain_relation(e, l.separator, &l.between);
    if (status != TN_OK)
        return status;
    bool matched = e->result->nodes[node].matched;
    uint32_t made;
    status = explain_part(e, source, stretch, matched ? TN_ASKED_AS_WRITTEN : TN_ASKED_SOMEWHERE, node, &made);
    tn_stretch plan = {0, e->result->length};
    uint32_t targets;
    if (status == TN_OK)
        status = explain_part(e, destination, plan, TN_ASKED_SOMEWHERE, node, &targets);
    if (status != TN_OK || matched)
        return status == TN_OK ? look_from(&l, stretch) : status;
    tn_why found = e->result->nodes[made];
    for (uint32_t i = 0; status == TN_OK && i < found.stretch_count; i++)
        status = look_from(&l, e->result->stretches[found.stretch_first + i]);
    return status;
}

#define RELATION_BYTES_MAX (UINT64_C(1) << 30)

/* ---- memory */

tn_status tn_explain_stretch(tn_explaining *e, uint32_t node, tn_stretch stretch)
{
    tn_explanation *result = e->result;
    if (!tn_array_reserve_from(&result->stretches, &result->stretch_capacity, 16, result->stretch_count, 1,
                               sizeof *result->stretches))
        return tn_fail_memory(e->error);
    tn_why *why = &result->nodes[node];
    if (why->stretch_count == 0)
        why->stretch_first = result->stretch_count;
    why->stretch_count++;
    result->stretches[result->stretch_count++] = stretch;
    return TN_OK;
}

static tn_status explain_gap(tn_explaining *e, uint32_t node, tn_gap gap)
{
    tn_explanation *result = e->result;
    if (!tn_array_reserve_from(&result->gaps, &result->gap_capacity, 16, result->gap_count, 1, sizeof *result->gaps))
        return tn_fail_memory(e->error);
    tn_why *why = &result->nodes[node];
    if (why->gap_count == 0)
        why->gap_first = result->gap_count;
    why->gap_count++;
    result->gaps[result->gap_count++] = gap;
    return TN_OK;
}

static tn_status add_node(tn_explaining *e, tn_reader_of who, tn_stretch region, uint32_t parent, uint32_t *node)
{
    tn_explanation *result = e->result;
    if (!tn_array_reserve_from(&result->nodes, &result->node_capacity, 16, result->node_count, 1,
                               sizeof *result->nodes))
        return tn_fail_memory(e->error);
    *node = result->node_count++;
    result->nodes[*node] = (tn_why){.tree = who.tree,
                                    .part = who.part,
                                    .mirrored = who.mirrored,
                                    .region = region,
                                    .number = TN_NO_NUMBER,
                                    .closest = TN_NO_WHY,
                                    .sides = TN_NO_WHY,
                                    .parent = parent,
                                    .first = TN_NO_WHY,
                                    .next = TN_NO_WHY};
    if (parent == TN_NO_WHY)
        return TN_OK;
    uint32_t *link = &result->nodes[parent].first;
    while (*link != TN_NO_WHY)
        link = &result->nodes[*link].next;
    *link = *node;
    return TN_OK;
}

/* The tree of a function, read once. */
static tn_status explain_tree(tn_explaining *e, uint32_t function, uint32_t *tree)
{
    tn_explanation *result = e->result;
    for (*tree = 0; *tree < result->tree_count; ++*tree)
        if (result->functions[*tree] == function)
            return TN_OK;
    if (result->tree_count == result->tree_capacity) {
        size_t capacity = tn_array_larger(result->tree_capacity, 0, 8);
        if (!tn_array_resize(&result->trees, capacity, sizeof *result->trees) ||
            !tn_array_resize(&result->functions, capacity, sizeof *result->functions) ||
            !tn_array_resize(&e->relations, capacity, sizeof *e->relations))
            return tn_fail_memory(e->error);
        result->tree_capacity = capacity;
    }
    tn_parts parts;
    tn_status status = tn_parts_read(result->schema->module, function, &parts, e->error);
    uint64_t **room = status == TN_OK ? calloc(2 * (size_t)parts.count, sizeof *room) : NULL;
    if (!room) {
        tn_parts_clear(&parts);
        return status == TN_OK ? tn_fail_memory(e->error) : status;
    }
    result->trees[result->tree_count] = parts;
    result->functions[result->tree_count] = function;
    e->relations[result->tree_count++] = room;
    return TN_OK;
}

/* Copies a relation, turned round where it is of the reversed plan. */
static tn_status keep_relation(tn_explaining *e, const uint64_t *from, bool mirrored, uint64_t **kept)
{
    size_t trays = e->result->length, bytes = (trays + 1) * e->words * sizeof(uint64_t);
    if (bytes > RELATION_BYTES_MAX - e->bytes)
        return tn_fail(e->error, TN_LIMIT, E_MATCHING_MEMORY,
                       "explaining a plan of %zu trays needs more memory than the limit of %llu bytes", trays,
                       (unsigned long long)RELATION_BYTES_MAX);
    *kept = malloc(bytes);
    if (!*kept)
        return tn_fail_memory(e->error);
    e->bytes += bytes;
    if (mirrored)
        tn_relation_turn(*kept, from, trays, e->words);
    else
        memcpy(*kept, from, bytes);
    return TN_OK;
}

/* That a plan of another library lies above: not by the interpreter, which tries plans one by one. */
static tn_status image_relation(tn_explaining *e, const tn_part *part, uint64_t **kept)
{
    const tn_explanation *result = e->result;
    tn_instruction image = tn_code_read(result->schema->module->code, part->root);
    tn_image_search *search = NULL;
    bool found = false;
    e->words = result->length / 64 + 1;
    uint64_t *relation = calloc((size_t)result->length + 1, e->words * sizeof *relation);
    tn_status status =
        relation ? tn_image_search_new(result->schema, &image, &search, e->error) : tn_fail_memory(e->error);
    if (status == TN_OK)
        status = tn_image_search_find(search, result->trays, result->length, &found, NULL, e->error);
    if (status == TN_OK && found)
        tn_relation_row_set(relation, result->length);
    if (status == TN_OK)
        status = keep_relation(e, relation, false, kept);
    tn_image_search_free(search);
    free(relation);
    return status;
}

/* The relation M of a part (H for parts judged as a region), found once. */
static tn_status explain_relation(tn_explaining *e, tn_reader_of who, const uint64_t **relation)
{
    uint64_t **kept = &e->relations[who.tree][2 * (size_t)who.part + who.mirrored];
    tn_status status = TN_OK;
    if (!*kept) {
        const tn_part *part = tn_part_of(e, who);
        const uint64_t *found = NULL;
        if (part->kind == TN_PART_IMAGE) {
            status = image_relation(e, part, kept);
            *relation = *kept;
            return status;
        }
        status = tn_plan_vm_term(e->vm, part->code_begin, part->code_end, who.mirrored, &found, &e->words, e->error);
        if (status == TN_OK)
            status = keep_relation(e, found, who.mirrored, kept);
    }
    *relation = *kept;
    return status;
}

/* ---- where a part matches */

/* The stretches within a region that hold no shorter one. */
static tn_status add_shortest(tn_explaining *e, const uint64_t *relation, tn_stretch region, uint32_t node)
{
    size_t least = SIZE_MAX; /* the first end of those that start later */
    uint32_t first = e->result->stretch_count;
    tn_status status = TN_OK;
    for (uint32_t i = region.end; status == TN_OK && i-- > region.begin;) {
        size_t end = tn_relation_row_next(relation + i * e->words, i + 1, e->words);
        if (end == TN_NO_BIT || end > region.end || end >= least)
            continue;
        least = end;
        status = tn_explain_stretch(e, node, (tn_stretch){i, (uint32_t)end});
    }
    uint32_t last = e->result->stretch_count;
    for (; last > first + 1; first++) { /* they were found from the right */
        tn_stretch swapped = e->result->stretches[first];
        e->result->stretches[first] = e->result->stretches[--last];
        e->result->stretches[last] = swapped;
    }
    return status;
}

/* The shortest stretch from place k on; mirrored, up to and with place k. False where there is none in the region. */
static bool occurrence(const tn_explaining *e, const uint64_t *relation, tn_stretch region, bool mirrored, uint32_t k,
                       tn_stretch *found)
{
    size_t end = mirrored ? TN_NO_BIT : tn_relation_row_next(relation + k * e->words, k + 1, e->words);
    *found = (tn_stretch){k, (uint32_t)end};
    for (uint32_t i = k + 1; mirrored && i-- > region.begin;) {
        *found = (tn_stretch){i, k + 1};
        if (tn_in(e, relation, *found))
            return true;
    }
    return end != TN_NO_BIT && end <= region.end;
}

static tn_status add_starts(tn_explaining *e, const uint64_t *relation, tn_stretch region, bool mirrored, uint32_t node)
{
    tn_status status = TN_OK;
    tn_stretch found;
    for (uint32_t k = region.begin; status == TN_OK && k < region.end; k++)
        if (occurrence(e, relation, region, mirrored, k, &found))
            status = tn_explain_stretch(e, node, found);
    return status;
}

static tn_status add_singles(tn_explaining *e, const uint64_t *relation, tn_stretch region, uint32_t node)
{
    tn_status status = TN_OK;
    for (uint32_t i = region.begin; status == TN_OK && i < region.end; i++)
        if (tn_relation_single(relation, i, e->words))
            status = tn_explain_stretch(e, node, (tn_stretch){i, i + 1});
    return status;
}

static tn_status find(tn_explaining *e, tn_reader_of who, tn_asked asked, uint32_t node)
{
    const uint64_t *relation;
    tn_status status = explain_relation(e, who, &relation);
    if (status != TN_OK)
        return status;
    tn_stretch region = e->result->nodes[node].region;
    if (asked == TN_ASKED_AS_WRITTEN && tn_part_of(e, who)->somewhere)
        asked = TN_ASKED_SOMEWHERE;
    e->result->nodes[node].whole = asked == TN_ASKED_AS_WRITTEN;
    switch (asked) {
    case TN_ASKED_SOMEWHERE:
        status = add_shortest(e, relation, region, node);
        break;
    case TN_ASKED_SINGLES:
        status = add_singles(e, relation, region, node);
        break;
    case TN_ASKED_STARTS:
        status = add_starts(e, relation, region, who.mirrored, node);
        break;
    case TN_ASKED_AS_WRITTEN:
        if (tn_in(e, relation, region)) {
            e->result->nodes[node].matched = true;
            return region.begin < region.end ? tn_explain_stretch(e, node, region) : TN_OK;
        }
        break;
    }
    e->result->nodes[node].matched = e->result->nodes[node].stretch_count > 0;
    return status;
}

/* ---- numbers */

static tn_status sum_of(tn_explaining *e, tn_reader_of who, tn_stretch region, int64_t *number)
{
    const tn_schema *schema = e->result->schema;
    const tn_part *part = tn_part_of(e, who);
    const uint64_t *relation;
    tn_status status = explain_relation(e, tn_child(who, part->first), &relation);
    *number = 0;
    for (uint32_t k = region.begin; status == TN_OK && k < region.end; k++) {
        tn_stretch found;
        if (part->kind == TN_PART_OCCURRENCES) {
            *number += occurrence(e, relation, region, who.mirrored, k, &found);
        } else if (tn_relation_single(relation, k, e->words)) {
            uint32_t field = part->field - schema->record->field_first;
            int64_t more =
                part->kind == TN_PART_SUM ? tn_tray_value_record(schema, e->result->trays[k], field)->length : 1;
            if (__builtin_add_overflow(*number, more, number))
                *number = INT64_MAX;
        }
    }
    return status;
}

/* What a quantity, sum or occurrences counts in a stretch; TN_NO_NUMBER for other parts. */
static tn_status explain_number(tn_explaining *e, tn_reader_of who, tn_stretch region, int64_t *number)
{
    *number = TN_NO_NUMBER;
    while (tn_part_of(e, who)->kind == TN_PART_RULE) { /* a separator by its name */
        tn_status status = explain_tree(e, tn_part_of(e, who)->function, &who.tree);
        if (status != TN_OK)
            return status;
        who.part = 0;
    }
    tn_part_kind kind = tn_part_of(e, who)->kind;
    if (kind != TN_PART_QUANTITY && kind != TN_PART_SUM && kind != TN_PART_OCCURRENCES)
        return TN_OK;
    return sum_of(e, who, region, number);
}

/* What both sides come to, of a comparison of the whole plan. */
static tn_status explain_comparison(tn_explaining *e, tn_reader_of who, uint32_t node)
{
    tn_explanation *result = e->result;
    tn_stretch region = result->nodes[node].region;
    if (region.begin != 0 || region.end != result->length || who.mirrored)
        return TN_OK;
    if (!tn_array_reserve_from(&result->sides, &result->sides_capacity, 8, result->sides_count, 1,
                               sizeof *result->sides))
        return tn_fail_memory(e->error);
    tn_sides *sides = &result->sides[result->sides_count];
    tn_sides_init(sides);
    tn_status status = tn_explain_sides(e->vm, &result->trees[who.tree], who.part, sides, e->error);
    if (status != TN_OK || (sides->right_count == 0 && !sides->difference))
        tn_sides_clear(sides);
    else
        result->nodes[node].sides = result->sides_count++;
    return status;
}

/* ---- what lies below a part */

static tn_status explain_children(tn_explaining *e, tn_reader_of who, tn_stretch region, tn_asked asked, uint32_t node)
{
    tn_status status = TN_OK;
    uint32_t child = tn_part_of(e, who)->first;
    while (status == TN_OK && child != TN_NO_PART) {
        uint32_t made;
        status = explain_part(e, tn_child(who, child), region, asked, node, &made);
        child = e->result->trees[who.tree].parts[child].next;
    }
    return status;
}

static tn_status explain_rule(tn_explaining *e, tn_reader_of who, tn_stretch region, tn_asked asked, uint32_t node)
{
    uint32_t made;
    tn_reader_of body = {.mirrored = who.mirrored};
    tn_status status = explain_tree(e, tn_part_of(e, who)->function, &body.tree);
    if (status != TN_OK)
        return status;
    return explain_part(e, body, region, asked, node, &made);
}

/* The half that matched is shown, or else both. */
static tn_status explain_symmetric(tn_explaining *e, tn_reader_of who, tn_stretch region, tn_asked asked, uint32_t node)
{
    const uint64_t *relation;
    uint32_t made;
    bool matched = e->result->nodes[node].matched;
    tn_reader_of half = tn_child(who, tn_part_of(e, who)->first);
    tn_status status = explain_relation(e, half, &relation);
    if (status == TN_OK && (!matched || tn_in(e, relation, region)))
        status = explain_part(e, half, region, asked, node, &made);
    if (status != TN_OK || (matched && tn_in(e, relation, region)))
        return status;
    half.mirrored = !half.mirrored;
    return explain_part(e, half, region, asked, node, &made);
}

/* What the stretch is; and what else it is to be, on the first that is so. */
static tn_status explain_where(tn_explaining *e, tn_reader_of who, tn_stretch at, uint32_t node)
{
    bool matched = e->result->nodes[node].matched;
    tn_reader_of first = tn_child(who, tn_part_of(e, who)->first);
    tn_reader_of second = tn_child(who, tn_part_of(e, first)->next);
    uint32_t found, made;
    tn_status status = explain_part(e, first, at, matched ? TN_ASKED_AS_WRITTEN : TN_ASKED_SOMEWHERE, node, &found);
    if (status != TN_OK)
        return status;
    const tn_why *why = &e->result->nodes[found];
    if (!matched && why->stretch_count > 0)
        at = e->result->stretches[why->stretch_first];
    return matched || why->stretch_count > 0 ? explain_part(e, second, at, TN_ASKED_AS_WRITTEN, node, &made) : TN_OK;
}

static void find_closest(tn_explaining *e, tn_reader_of who, uint32_t node)
{
    tn_why *why = &e->result->nodes[node];
    const tn_part *part = tn_part_of(e, who);
    int fewest = 65;
    for (uint32_t k = why->region.begin; k < why->region.end; k++) {
        int wrong = __builtin_popcountll(tn_spec_failing(e->result->schema, part->spec, e->result->trays[k]));
        if (wrong >= fewest || wrong == 0)
            continue;
        fewest = wrong;
        why->closest = k;
    }
}

/* The parts below a node, on the stretch where it matched first, or on its whole region. */
static tn_status explain_below(tn_explaining *e, tn_reader_of who, uint32_t node)
{
    tn_why why = e->result->nodes[node];
    const tn_part *part = tn_part_of(e, who);
    tn_stretch at = why.stretch_count ? e->result->stretches[why.stretch_first] : why.region;
    tn_asked asked = why.matched ? TN_ASKED_AS_WRITTEN : TN_ASKED_SOMEWHERE;
    tn_asked same = why.matched || why.whole ? TN_ASKED_AS_WRITTEN : TN_ASKED_SOMEWHERE;
    uint32_t made;
    switch (part->kind) {
    case TN_PART_TRAY:
        if (!why.matched)
            find_closest(e, who, node);
        return TN_OK;
    case TN_PART_RULE: /* one that uses itself is opened on its own stretch alone: elsewhere it would go on for ever */
        return part->again && !(why.matched && why.whole) ? TN_OK : explain_rule(e, who, at, same, node);
    case TN_PART_AND:
    case TN_PART_OR:
        return explain_children(e, who, at, same, node);
    case TN_PART_NOT:
        return explain_children(e, who, at, TN_ASKED_AS_WRITTEN, node);
    case TN_PART_SYMMETRIC:
        return explain_symmetric(e, who, at, asked, node);
    case TN_PART_NEIGHBOUR:
        return why.matched ? explain_neighbour(e, who, node, at) : explain_no_neighbour(e, who, node);
    case TN_PART_QUANTITY:
    case TN_PART_SUM:
    case TN_PART_OCCURRENCES: {
        tn_status status = explain_number(e, who, at, &why.number);
        e->result->nodes[node].number = why.number;
        if (status != TN_OK)
            return status;
        return explain_part(e, tn_child(who, part->first), at,
                            part->kind == TN_PART_OCCURRENCES ? TN_ASKED_STARTS : TN_ASKED_SINGLES, node, &made);
    }
    case TN_PART_MANY:
        return explain_part(e, tn_child(who, part->first), at, TN_ASKED_SINGLES, node, &made);
    case TN_PART_REPEAT:
        return why.matched ? explain_repeat(e, who, node, at)
                           : explain_part(e, tn_child(who, part->first), at, TN_ASKED_SOMEWHERE, node, &made);
    case TN_PART_DISTANCE:
    case TN_PART_NEAR:
    case TN_PART_FAR:
        return explain_distance(e, who, node, at);
    case TN_PART_WHERE:
        return explain_where(e, who, at, node);
    case TN_PART_COMPARISON:
        return explain_comparison(e, who, node);
    case TN_PART_IMAGE:
    case TN_PART_HOUSE: /* in no rule about plans */
    case TN_PART_KIND_COUNT:
        break;
    }
    return TN_OK;
}

/* Adds a node for a part, under `parent` (TN_NO_WHY: the root), with everything below it. *node: its index. */
static tn_status explain_part(tn_explaining *e, tn_reader_of who, tn_stretch region, tn_asked asked, uint32_t parent,
                              uint32_t *node)
{
    tn_status status = tn_watch_check(e->result->schema->module->watch, e->error);
    if (status == TN_OK)
        status = add_node(e, who, region, parent, node);
    if (status == TN_OK)
        status = find(e, who, asked, *node);
    if (status != TN_OK)
        return status;
    tn_part_kind kind = tn_part_of(e, who)->kind;
    if (kind != TN_PART_TRAY && (e->result->node_count > TN_EXPLAIN_NODES_MAX || e->depth > TN_EXPLAIN_DEPTH_MAX)) {
        e->result->nodes[*node].cut = true;
        return TN_OK;
    }
    e->depth++;
    status = explain_below(e, who, *node);
    e->depth--;
    return status;
}

/* ---- the public face */

static void finish(tn_explaining *e)
{
    for (uint32_t t = 0; t < e->result->tree_count; t++) {
        for (size_t i = 0; i < 2 * (size_t)e->result->trees[t].count; i++)
            free(e->relations[t][i]);
        free(e->relations[t]);
    }
    free(e->relations);
    tn_plan_vm_free(e->vm);
}

tn_status tn_explain(const tn_schema *schema, uint32_t function, const tn_tray *trays, size_t length, size_t max_length,
                     tn_explanation *explanation, tn_error *error)
{
    *explanation = (tn_explanation){.schema = schema, .trays = trays, .length = (uint32_t)length};
    tn_explaining e = {.result = explanation, .error = error};
    uint32_t tree, root;
    tn_status status = tn_plan_vm_new(schema, max_length ? max_length : TN_EXPLAIN_LENGTH_DEFAULT, &e.vm, error);
    if (status == TN_OK)
        status = tn_plan_vm_plan(e.vm, trays, length, error);
    if (status == TN_OK)
        status = explain_tree(&e, function, &tree);
    if (status == TN_OK)
        status = explain_part(&e, (tn_reader_of){0}, (tn_stretch){0, (uint32_t)length}, TN_ASKED_AS_WRITTEN, TN_NO_WHY,
                              &root);
    finish(&e);
    return status;
}

void tn_explanation_clear(tn_explanation *explanation)
{
    for (uint32_t t = 0; t < explanation->tree_count; t++)
        tn_parts_clear(&explanation->trees[t]);
    free(explanation->trees);
    free(explanation->functions);
    free(explanation->nodes);
    free(explanation->stretches);
    free(explanation->gaps);
    for (uint32_t i = 0; i < explanation->sides_count; i++)
        tn_sides_clear(&explanation->sides[i]);
    free(explanation->sides);
    *explanation = (tn_explanation){0};
}

static bool under_not(const tn_explanation *explanation, uint32_t node)
{
    for (; node != TN_NO_WHY; node = explanation->nodes[node].parent)
        if (tn_why_part(explanation, &explanation->nodes[node])->kind == TN_PART_NOT)
            return true;
    return false;
}

/* How much of a node matched. */
static uint32_t matched_size(const tn_explanation *explanation, const tn_why *why)
{
    const tn_parts *tree = &explanation->trees[why->tree];
    if (why->matched)
        return why->absent ? 0 : tn_part_size(tree, why->part);
    uint32_t child = tree->parts[why->part].first, size = 0;
    for (uint32_t k = 0; k < why->run_first + why->run_count; k++, child = tree->parts[child].next)
        size += k < why->run_first ? 0 : tn_part_size(tree, child);
    return size;
}

uint32_t tn_explanation_largest(const tn_explanation *explanation)
{
    uint32_t best = TN_NO_WHY, most = 0;
    for (uint32_t i = 0; i < explanation->node_count; i++) {
        uint32_t size = matched_size(explanation, &explanation->nodes[i]);
        const tn_why *why = &explanation->nodes[i];
        if (size <= most || under_not(explanation, i) || tn_part_is_step(&explanation->trees[why->tree], why->part))
            continue;
        best = i;
        most = size;
    }
    return best;
}

uint64_t tn_spec_failing(const tn_schema *schema, uint32_t spec, tn_tray tray)
{
    uint64_t failing = 0;
    for (uint32_t f = 0; f < schema->field_count && f < 64; f++) {
        uint32_t bit = schema->value_start[f] + tn_tray_value(schema, tray, f);
        if (!(tn_spec_word(schema->module, spec, bit / 64) >> (bit % 64) & 1))
            failing |= UINT64_C(1) << f;
    }
    return failing;
}

uint32_t tn_explanation_gaps(const tn_explanation *explanation, uint32_t node)
{
    const tn_why *why = &explanation->nodes[node];
    const tn_parts *tree = &explanation->trees[why->tree];
    tn_part_kind kind = tree->parts[why->part].kind;
    if (kind == TN_PART_NOT && why->first != TN_NO_WHY && tn_part_is_step(tree, explanation->nodes[why->first].part)) {
        node = why->first; /* `every a beside b` denies that one is not */
        kind = tn_why_part(explanation, &explanation->nodes[node])->kind;
        return kind == TN_PART_NEAR || kind == TN_PART_FAR ? node : TN_NO_WHY;
    }
    return kind == TN_PART_DISTANCE || kind == TN_PART_NEAR || kind == TN_PART_FAR ? node : TN_NO_WHY;
}

tn_gap_verdict tn_explanation_gap(const tn_explanation *explanation, uint32_t node, const tn_gap *gap)
{
    const tn_why *why = &explanation->nodes[node];
    const tn_parts *tree = &explanation->trees[why->tree];
    tn_part_kind kind = tree->parts[why->part].kind;
    bool denied =
        kind != TN_PART_DISTANCE && tn_part_is_step(tree, why->part); /* then a gap that fits is what is wrong */
    if (gap->fits != denied)
        return TN_GAP_GOOD;
    return (kind == TN_PART_NEAR) != denied ? TN_GAP_TOO_FAR : TN_GAP_TOO_NEAR;
}
