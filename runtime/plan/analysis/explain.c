/* Explains why a rule matches a plan or does not. */
#include "runtime/plan/analysis/explain.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/plan/analysis/explain_data.h"

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

tn_status tn_explain_gap(tn_explaining *e, uint32_t node, tn_gap gap)
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

tn_status tn_explain_tree(tn_explaining *e, uint32_t function, uint32_t *tree)
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

tn_status tn_explain_relation(tn_explaining *e, tn_reader_of who, const uint64_t **relation)
{
    uint64_t **kept = &e->relations[who.tree][2 * (size_t)who.part + who.mirrored];
    tn_status status = TN_OK;
    if (!*kept) {
        const tn_part *part = tn_part_of(e, who);
        const uint64_t *found = NULL;
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
    tn_status status = tn_explain_relation(e, who, &relation);
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
    tn_status status = tn_explain_relation(e, tn_child(who, part->first), &relation);
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

tn_status tn_explain_number(tn_explaining *e, tn_reader_of who, tn_stretch region, int64_t *number)
{
    *number = TN_NO_NUMBER;
    while (tn_part_of(e, who)->kind == TN_PART_RULE) { /* a separator by its name */
        tn_status status = tn_explain_tree(e, tn_part_of(e, who)->function, &who.tree);
        if (status != TN_OK)
            return status;
        who.part = 0;
    }
    tn_part_kind kind = tn_part_of(e, who)->kind;
    if (kind != TN_PART_QUANTITY && kind != TN_PART_SUM && kind != TN_PART_OCCURRENCES)
        return TN_OK;
    return sum_of(e, who, region, number);
}

/* ---- what lies below a part */

static tn_status explain_children(tn_explaining *e, tn_reader_of who, tn_stretch region, tn_asked asked, uint32_t node)
{
    tn_status status = TN_OK;
    uint32_t child = tn_part_of(e, who)->first;
    while (status == TN_OK && child != TN_NO_PART) {
        uint32_t made;
        status = tn_explain_part(e, tn_child(who, child), region, asked, node, &made);
        child = e->result->trees[who.tree].parts[child].next;
    }
    return status;
}

static tn_status explain_rule(tn_explaining *e, tn_reader_of who, tn_stretch region, tn_asked asked, uint32_t node)
{
    uint32_t made;
    tn_reader_of body = {.mirrored = who.mirrored};
    tn_status status = tn_explain_tree(e, tn_part_of(e, who)->function, &body.tree);
    if (status != TN_OK)
        return status;
    return tn_explain_part(e, body, region, asked, node, &made);
}

/* The half that matched is shown, or else both. */
static tn_status explain_symmetric(tn_explaining *e, tn_reader_of who, tn_stretch region, tn_asked asked, uint32_t node)
{
    const uint64_t *relation;
    uint32_t made;
    bool matched = e->result->nodes[node].matched;
    tn_reader_of half = tn_child(who, tn_part_of(e, who)->first);
    tn_status status = tn_explain_relation(e, half, &relation);
    if (status == TN_OK && (!matched || tn_in(e, relation, region)))
        status = tn_explain_part(e, half, region, asked, node, &made);
    if (status != TN_OK || (matched && tn_in(e, relation, region)))
        return status;
    half.mirrored = !half.mirrored;
    return tn_explain_part(e, half, region, asked, node, &made);
}

/* What the stretch is; and what else it is to be, on the first that is so. */
static tn_status explain_where(tn_explaining *e, tn_reader_of who, tn_stretch at, uint32_t node)
{
    bool matched = e->result->nodes[node].matched;
    tn_reader_of first = tn_child(who, tn_part_of(e, who)->first);
    tn_reader_of second = tn_child(who, tn_part_of(e, first)->next);
    uint32_t found, made;
    tn_status status = tn_explain_part(e, first, at, matched ? TN_ASKED_AS_WRITTEN : TN_ASKED_SOMEWHERE, node, &found);
    if (status != TN_OK)
        return status;
    const tn_why *why = &e->result->nodes[found];
    if (!matched && why->stretch_count > 0)
        at = e->result->stretches[why->stretch_first];
    return matched || why->stretch_count > 0 ? tn_explain_part(e, second, at, TN_ASKED_AS_WRITTEN, node, &made) : TN_OK;
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
        return why.matched ? tn_explain_neighbour(e, who, node, at) : tn_explain_no_neighbour(e, who, node);
    case TN_PART_QUANTITY:
    case TN_PART_SUM:
    case TN_PART_OCCURRENCES: {
        tn_status status = tn_explain_number(e, who, at, &why.number);
        e->result->nodes[node].number = why.number;
        if (status != TN_OK)
            return status;
        return tn_explain_part(e, tn_child(who, part->first), at,
                               part->kind == TN_PART_OCCURRENCES ? TN_ASKED_STARTS : TN_ASKED_SINGLES, node, &made);
    }
    case TN_PART_MANY:
        return tn_explain_part(e, tn_child(who, part->first), at, TN_ASKED_SINGLES, node, &made);
    case TN_PART_REPEAT:
        return why.matched ? tn_explain_repeat(e, who, node, at)
                           : tn_explain_part(e, tn_child(who, part->first), at, TN_ASKED_SOMEWHERE, node, &made);
    case TN_PART_DISTANCE:
    case TN_PART_NEAR:
    case TN_PART_FAR:
        return tn_explain_distance(e, who, node, at);
    case TN_PART_WHERE:
        return explain_where(e, who, at, node);
    case TN_PART_COMPARISON:
    case TN_PART_HOUSE: /* in no rule about plans */
    case TN_PART_KIND_COUNT:
        break;
    }
    return TN_OK;
}

tn_status tn_explain_part(tn_explaining *e, tn_reader_of who, tn_stretch region, tn_asked asked, uint32_t parent,
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
        status = tn_explain_tree(&e, function, &tree);
    if (status == TN_OK)
        status = tn_explain_part(&e, (tn_reader_of){0}, (tn_stretch){0, (uint32_t)length}, TN_ASKED_AS_WRITTEN,
                                 TN_NO_WHY, &root);
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
