/* Explanations as JSON. */
#include <stdlib.h>

#include "driver/plan/explain.h"

static void stretch_json(tn_json *json, const char *key, tn_stretch stretch)
{
    tn_json_list(json, key);
    tn_json_count(json, NULL, (uint64_t)stretch.begin + 1);
    tn_json_count(json, NULL, stretch.end);
    tn_json_list_end(json);
}

/* The words of a buffer, which is freed; null where there are none. */
static void words_json(tn_json *json, const char *key, tn_buffer *words)
{
    json->text->failed |= words->failed;
    tn_json_string(json, key, words->data);
    free(words->data);
}

static void gap_json(tn_json *json, const tn_gap *gap)
{
    tn_json_object(json, NULL);
    stretch_json(json, "source", gap->source);
    stretch_json(json, "destination", gap->destination);
    if (gap->between.begin < gap->between.end)
        stretch_json(json, "between", gap->between);
    else
        tn_json_null(json, "between");
    if (gap->number == TN_NO_NUMBER)
        tn_json_null(json, "number");
    else
        tn_json_whole(json, "number", gap->number);
    tn_json_bool(json, "fits", gap->fits);
    tn_json_object_end(json);
}

static void place_json(tn_json *json, const tn_explained *explained, const tn_part *part)
{
    tn_place place;
    if (!tn_code_place(explained->opened, part->root, &place))
        return;
    const tn_json_place begin = {.file = place.path, .line = place.line, .column = place.column};
    tn_json_place_begin(json, &begin);
}

static void run_json(tn_json *json, const tn_why *node)
{
    tn_json_object(json, "run");
    tn_json_count(json, "first", (uint64_t)node->run_first + 1);
    tn_json_count(json, "parts", node->run_count);
    stretch_json(json, "trays", node->run);
    tn_json_object_end(json);
}

static void closest_json(tn_json *json, const tn_explanation *why, const tn_why *node)
{
    tn_buffer wrong = {0};
    tn_json_object(json, "closest");
    tn_json_count(json, "tray", (uint64_t)node->closest + 1);
    tn_words_wrong(why, node, &wrong);
    words_json(json, "wrong", &wrong);
    tn_json_object_end(json);
}

/* What is said of a node, members of the object that is open. */
static void node_json(tn_json *json, const tn_explained *explained, const tn_explanation *why, uint32_t index)
{
    const tn_why *node = &why->nodes[index];
    const tn_part *part = tn_why_part(why, node);
    char text[TN_PART_TEXT_MAX];
    tn_buffer evidence = {0};
    tn_part_text(&why->trees[node->tree], node->part, text, sizeof text);
    tn_json_string(json, "kind", tn_part_word(part->kind));
    tn_json_string(json, "text", text);
    place_json(json, explained, part);
    tn_json_bool(json, "matched", node->matched);
    tn_json_list(json, "trays");
    for (uint32_t i = 0; i < node->stretch_count; i++)
        stretch_json(json, NULL, why->stretches[node->stretch_first + i]);
    tn_json_list_end(json);
    tn_words_evidence(why, node, &evidence);
    words_json(json, "evidence", &evidence);
    if (node->mirrored)
        tn_json_bool(json, "mirrored", true);
    if (node->absent)
        tn_json_bool(json, "left_out", true);
    if (node->cut)
        tn_json_bool(json, "cut", true);
    if (node->number != TN_NO_NUMBER)
        tn_json_whole(json, part->kind == TN_PART_SUM ? "nanometres" : "count", node->number);
    if (node->run_count > 0)
        run_json(json, node);
    if (node->closest != TN_NO_WHY)
        closest_json(json, why, node);
    if (part->kind != TN_PART_DISTANCE)
        return;
    tn_json_list(json, "gaps");
    for (uint32_t i = 0; i < node->gap_count; i++)
        gap_json(json, &why->gaps[node->gap_first + i]);
    tn_json_list_end(json);
}

/* A node with those below it; trees are TN_EXPLAIN_DEPTH_MAX deep at most. */
static void tree_json(tn_json *json, const char *key, const tn_explained *explained, const tn_explanation *why,
                      uint32_t index)
{
    tn_json_object(json, key);
    node_json(json, explained, why, index);
    tn_json_list(json, "parts");
    for (uint32_t child = why->nodes[index].first; child != TN_NO_WHY; child = why->nodes[child].next)
        tree_json(json, NULL, explained, why, child);
    tn_json_list_end(json);
    tn_json_object_end(json);
}

static void rule_json(tn_json *json, const tn_explained *explained, const tn_explained_rule *rule)
{
    static const char *const kinds[] = {"require", "total", "prune"};
    tn_json_object(json, NULL);
    tn_json_string(json, "name", rule->name);
    tn_json_string(json, "doc", *rule->doc ? rule->doc : NULL);
    tn_json_string(json, "kind", rule->clause ? kinds[rule->clause->kind] : "rule");
    tn_json_bool(json, "matches", rule->holds);
    if (rule->clause)
        tn_json_bool(json, "drops", rule->drops);
    tree_json(json, "why", explained, &rule->why, 0);
    uint32_t largest = rule->holds ? TN_NO_WHY : tn_explanation_largest(&rule->why);
    if (largest == TN_NO_WHY) {
        tn_json_null(json, "largest");
    } else {
        tn_json_object(json, "largest");
        node_json(json, explained, &rule->why, largest);
        tn_json_object_end(json);
    }
    tn_json_object_end(json);
}

static void plan_json(tn_json *json, const tn_schema *schema, const tn_tray *trays, size_t length)
{
    tn_buffer line = {0};
    tn_plan_write_line(schema, trays, length, &line);
    words_json(json, "plan", &line);
}

/* null for a plan that is not in the library. */
static void rank_json(tn_json *json, const tn_explained *explained, const tn_tray *trays, size_t length)
{
    mpz_t rank;
    mpz_init(rank);
    if (explained->automaton && tn_library_rank(explained->automaton, trays, length, rank))
        tn_json_digits(json, "rank", rank);
    else
        tn_json_null(json, "rank");
    mpz_clear(rank);
}

static void near_json(tn_json *json, const tn_explained *explained)
{
    tn_json_list(json, "nearest");
    for (size_t i = 0; i < explained->near.count; i++) {
        const tn_near_plan *plan = &explained->near.plans[i];
        tn_buffer changes = {0};
        tn_json_object(json, NULL);
        plan_json(json, explained->schema, plan->trays, plan->length);
        rank_json(json, explained, plan->trays, plan->length);
        tn_words_changes(explained, plan, &changes);
        words_json(json, "changes", &changes);
        tn_json_object_end(json);
    }
    tn_json_list_end(json);
}

static void library_json(tn_json *json, const tn_explained *explained)
{
    tn_json_string(json, "library", tn_text(explained->opened->module, explained->library->name));
    tn_json_bool(json, "kept", explained->kept);
    rank_json(json, explained, explained->trays, explained->length);
    tn_json_bool(json, "too_short_or_long", explained->length_drops);
    if (explained->near.count)
        tn_json_count(json, "distance", explained->near.cost);
    else
        tn_json_null(json, "distance");
    near_json(json, explained);
    tn_json_bool(json, "more", explained->near.more);
}

bool tn_explained_json(const tn_explained *explained, tn_buffer *out)
{
    tn_json json = tn_json_text(out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    plan_json(&json, explained->schema, explained->trays, explained->length);
    if (explained->library)
        library_json(&json, explained);
    tn_json_list(&json, explained->library ? "clauses" : "rules");
    for (size_t i = 0; i < explained->count; i++)
        rule_json(&json, explained, &explained->rules[i]);
    tn_json_list_end(&json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
    return !out->failed;
}
