/* Explanations as JSON. */
#include <jansson.h>
#include <stdlib.h>

#include "driver/plan/explain.h"

/* Text that may be no UTF-8 (of a module made elsewhere) is null. */
static json_t *string(const char *text)
{
    json_t *made = text ? json_string(text) : NULL;
    return made ? made : json_null();
}

static json_t *stretch_json(tn_stretch stretch)
{
    return json_pack("[i,i]", (int)stretch.begin + 1, (int)stretch.end);
}

/* The words of a buffer; frees it. *ok = false where it does not have them all. */
static json_t *take(tn_buffer *words, bool *ok)
{
    json_t *made = string(words->data);
    *ok = *ok && !words->failed;
    free(words->data);
    return made;
}

static json_t *gap_json(const tn_gap *gap)
{
    json_t *made = json_object();
    json_object_set_new(made, "source", stretch_json(gap->source));
    json_object_set_new(made, "destination", stretch_json(gap->destination));
    json_object_set_new(made, "between",
                        gap->between.begin < gap->between.end ? stretch_json(gap->between) : json_null());
    json_object_set_new(made, "number", gap->number == TN_NO_NUMBER ? json_null() : json_integer(gap->number));
    json_object_set_new(made, "fits", json_boolean(gap->fits));
    return made;
}

static void set_place(json_t *made, const tn_explained *explained, const tn_explanation *why, const tn_why *node)
{
    tn_place place;
    if (!tn_code_place(explained->opened, tn_why_part(why, node)->root, &place))
        return;
    json_object_set_new(made, "file", string(place.path));
    json_object_set_new(made, "line", json_integer((json_int_t)place.line));
    json_object_set_new(made, "column", json_integer((json_int_t)place.column));
}

static json_t *node_json(const tn_explained *explained, const tn_explanation *why, uint32_t index, bool *ok)
{
    const tn_why *node = &why->nodes[index];
    const tn_part *part = tn_why_part(why, node);
    char text[TN_PART_TEXT_MAX];
    tn_buffer evidence = {0}, wrong = {0};
    json_t *made = json_object(), *trays = json_array();
    tn_part_text(&why->trees[node->tree], node->part, text, sizeof text);
    json_object_set_new(made, "kind", json_string(tn_part_word(part->kind)));
    json_object_set_new(made, "text", string(text));
    set_place(made, explained, why, node);
    json_object_set_new(made, "matched", json_boolean(node->matched));
    for (uint32_t i = 0; i < node->stretch_count; i++)
        json_array_append_new(trays, stretch_json(why->stretches[node->stretch_first + i]));
    json_object_set_new(made, "trays", trays);
    tn_words_evidence(why, node, &evidence);
    json_object_set_new(made, "evidence", take(&evidence, ok));
    if (node->mirrored)
        json_object_set_new(made, "mirrored", json_true());
    if (node->absent)
        json_object_set_new(made, "left_out", json_true());
    if (node->cut)
        json_object_set_new(made, "cut", json_true());
    if (node->number != TN_NO_NUMBER)
        json_object_set_new(made, part->kind == TN_PART_SUM ? "nanometres" : "count", json_integer(node->number));
    if (node->run_count > 0)
        json_object_set_new(made, "run",
                            json_pack("{s:i,s:i,s:o}", "first", (int)node->run_first + 1, "parts", (int)node->run_count,
                                      "trays", stretch_json(node->run)));
    if (node->closest != TN_NO_WHY) {
        tn_words_wrong(why, node, &wrong);
        json_object_set_new(made, "closest",
                            json_pack("{s:i,s:o}", "tray", (int)node->closest + 1, "wrong", take(&wrong, ok)));
    }
    if (part->kind == TN_PART_DISTANCE) {
        json_t *gaps = json_array();
        for (uint32_t i = 0; i < node->gap_count; i++)
            json_array_append_new(gaps, gap_json(&why->gaps[node->gap_first + i]));
        json_object_set_new(made, "gaps", gaps);
    }
    return made;
}

/* The tree, made from its last node backwards: every node has a lower number than what is below it. */
static json_t *tree_json(const tn_explained *explained, const tn_explanation *why, bool *ok)
{
    json_t **made = calloc((size_t)why->node_count + 1, sizeof *made);
    *ok = *ok && made;
    if (!made)
        return NULL;
    for (uint32_t i = why->node_count; i-- > 0;) {
        made[i] = node_json(explained, why, i, ok);
        json_t *parts = json_array();
        for (uint32_t child = why->nodes[i].first; child != TN_NO_WHY; child = why->nodes[child].next)
            json_array_append_new(parts, made[child]);
        json_object_set_new(made[i], "parts", parts);
    }
    json_t *root = made[0];
    free(made);
    return root;
}

static json_t *rule_json(const tn_explained *explained, const tn_explained_rule *rule, bool *ok)
{
    static const char *const kinds[] = {"require", "total", "prune"};
    json_t *made = json_object();
    json_object_set_new(made, "name", string(rule->name));
    json_object_set_new(made, "doc", *rule->doc ? string(rule->doc) : json_null());
    json_object_set_new(made, "kind", json_string(rule->clause ? kinds[rule->clause->kind] : "rule"));
    json_object_set_new(made, "matches", json_boolean(rule->holds));
    if (rule->clause)
        json_object_set_new(made, "drops", json_boolean(rule->drops));
    json_object_set_new(made, "why", tree_json(explained, &rule->why, ok));
    uint32_t largest = rule->holds ? TN_NO_WHY : tn_explanation_largest(&rule->why);
    json_object_set_new(made, "largest",
                        largest == TN_NO_WHY ? json_null() : node_json(explained, &rule->why, largest, ok));
    return made;
}

static json_t *plan_json(const tn_schema *schema, const tn_tray *trays, size_t length, bool *ok)
{
    tn_buffer line = {0};
    tn_plan_write_line(schema, trays, length, &line);
    return take(&line, ok);
}

static json_t *rank_json(const tn_explained *explained, const tn_tray *trays, size_t length)
{
    mpz_t rank;
    mpz_init(rank);
    bool known = explained->automaton && tn_library_rank(explained->automaton, trays, length, rank);
    char *digits = known ? mpz_get_str(NULL, 10, rank) : NULL;
    json_t *made = string(digits);
    free(digits);
    mpz_clear(rank);
    return made;
}

static json_t *near_json(const tn_explained *explained, bool *ok)
{
    json_t *list = json_array();
    for (size_t i = 0; i < explained->near.count; i++) {
        const tn_near_plan *plan = &explained->near.plans[i];
        tn_buffer changes = {0};
        json_t *made = json_object();
        *ok = tn_words_changes(explained, plan, &changes) && *ok;
        json_object_set_new(made, "plan", plan_json(explained->schema, plan->trays, plan->length, ok));
        json_object_set_new(made, "rank", rank_json(explained, plan->trays, plan->length));
        json_object_set_new(made, "changes", take(&changes, ok));
        json_array_append_new(list, made);
    }
    return list;
}

static void set_library(json_t *made, const tn_explained *explained, bool *ok)
{
    json_object_set_new(made, "library", string(tn_text(explained->opened->module, explained->library->name)));
    json_object_set_new(made, "kept", json_boolean(explained->kept));
    json_object_set_new(made, "rank", rank_json(explained, explained->trays, explained->length));
    json_object_set_new(made, "too_short_or_long", json_boolean(explained->length_drops));
    json_object_set_new(made, "distance", explained->near.count ? json_integer(explained->near.cost) : json_null());
    json_object_set_new(made, "nearest", near_json(explained, ok));
    json_object_set_new(made, "more", json_boolean(explained->near.more));
}

bool tn_explained_json(const tn_explained *explained, tn_buffer *out)
{
    json_t *made = json_object(), *rules = json_array();
    bool ok = true;
    json_object_set_new(made, "plan", plan_json(explained->schema, explained->trays, explained->length, &ok));
    if (explained->library)
        set_library(made, explained, &ok);
    for (size_t i = 0; i < explained->count; i++)
        json_array_append_new(rules, rule_json(explained, &explained->rules[i], &ok));
    json_object_set_new(made, explained->library ? "clauses" : "rules", rules);
    char *text = json_dumps(made, JSON_COMPACT);
    ok = ok && text && tn_buffer_printf(out, "%s\n", text);
    free(text);
    json_decref(made);
    return ok;
}
