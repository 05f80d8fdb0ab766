/* Explanations as pictures: the rows of the text, drawn. */
#include <stdlib.h>
#include <string.h>

#include "driver/plan/explain.h"
#include "runtime/base/array.h"
#include "runtime/plan/picture/draw_explain.h"

typedef struct gathering {
    tn_drawn_reason *reasons;
    size_t count, capacity;
} gathering;

/* Takes over its texts. */
static bool add(gathering *g, tn_drawn_reason reason)
{
    if (!tn_array_reserve(&g->reasons, &g->capacity, g->count, 1, sizeof *g->reasons)) {
        free((char *)(uintptr_t)reason.text);
        free((char *)(uintptr_t)reason.evidence);
        return false;
    }
    g->reasons[g->count++] = reason;
    return reason.text != NULL;
}

/* A row of the rule's explanation; `number` is the node's. */
static bool add_node(gathering *g, const tn_explanation *why, uint32_t index, unsigned depth, bool drops,
                     uint32_t number)
{
    const tn_why *node = &why->nodes[index];
    char text[TN_PART_TEXT_MAX];
    tn_buffer evidence = {0};
    tn_part_text(&why->trees[node->tree], node->part, text, sizeof text);
    tn_words_evidence(why, node, &evidence);
    tn_drawn_reason reason = {.text = strdup(text),
                              .evidence = evidence.data,
                              .depth = depth + 1,
                              .matched = node->matched,
                              .drops = drops,
                              .marks = node->stretch_count ? why->stretches + node->stretch_first : NULL,
                              .mark_count = tn_words_places(why, node) ? node->stretch_count : 0,
                              .region = node->region,
                              .number = number};
    if (!node->matched && node->run_count > 0)
        reason.partly = node->run;
    if (node->closest != TN_NO_WHY)
        reason.lacking = (tn_stretch){node->closest, node->closest + 1};
    return add(g, reason) && !evidence.failed;
}

/* Numbers the nodes as an answer lists them: each before its own parts. The caller frees it; NULL: out of memory. */
static uint32_t *number_nodes(const tn_explanation *why)
{
    uint32_t *numbers = calloc((size_t)why->node_count + 1, sizeof *numbers), count = 0;
    for (uint32_t at = 0; numbers && why->node_count > 0;) {
        numbers[at] = count++;
        if (why->nodes[at].first != TN_NO_WHY) {
            at = why->nodes[at].first;
            continue;
        }
        while (at != 0 && why->nodes[at].next == TN_NO_WHY)
            at = why->nodes[at].parent;
        if (at == 0)
            break;
        at = why->nodes[at].next;
    }
    return numbers;
}

static bool add_rule(gathering *g, const tn_explained_rule *rule, uint32_t number, bool full)
{
    tn_explain_rows rows = {0};
    tn_buffer evidence = {0};
    bool prunes = rule->drops && rule->holds;
    uint32_t *numbers = number_nodes(&rule->why);
    tn_buffer_printf(&evidence, "%s", rule->doc);
    bool ok = add(g, (tn_drawn_reason){.text = strdup(rule->name),
                                       .evidence = evidence.data,
                                       .matched = rule->holds,
                                       .drops = prunes,
                                       .number = number});
    ok = ok && numbers && !evidence.failed && tn_explain_rows_make(&rule->why, full, &rows);
    for (uint32_t i = 0; ok && i < rows.count; i++)
        ok = add_node(g, &rule->why, rows.nodes[i], rows.depths[i], prunes, numbers[rows.nodes[i]]);
    free(numbers);
    tn_explain_rows_clear(&rows);
    return ok;
}

static void write_title(const tn_explained *explained, tn_buffer *title)
{
    if (!explained->library)
        return;
    tn_buffer_printf(title, "%s %s this plan", tn_text(explained->opened->module, explained->library->name),
                     explained->kept ? "keeps" : "drops");
    if (explained->length_drops)
        tn_buffer_printf(title, ": it has %zu trays, and plans there have %u to %u", explained->length,
                         explained->library->trays_min, explained->library->trays_max);
}

/* "nearest plans that are kept (there are others as near)" */
static void write_near_title(const tn_explained *explained, tn_buffer *title)
{
    tn_buffer_printf(title,
                     explained->near.count == 1 ? "the nearest plan that is kept" : "nearest plans that are kept");
    if (explained->near.more)
        tn_buffer_printf(title, " (there are others as near)");
}

/* The plans that are kept, each with how it differs. */
static bool add_near(const tn_explained *explained, tn_drawn_plan *near)
{
    bool ok = true;
    for (size_t i = 0; ok && i < explained->near.count; i++) {
        const tn_near_plan *plan = &explained->near.plans[i];
        tn_buffer changes = {0};
        ok = tn_words_changes(explained, plan, &changes);
        near[i] = (tn_drawn_plan){.trays = plan->trays, .length = plan->length, .caption = changes.data};
    }
    return ok;
}

static void gathering_clear(gathering *g)
{
    for (size_t i = 0; i < g->count; i++) {
        free((char *)(uintptr_t)g->reasons[i].text);
        free((char *)(uintptr_t)g->reasons[i].evidence);
    }
    free(g->reasons);
}

tn_status tn_explained_draw(const tn_explained *explained, bool full, tn_picture *to, tn_error *error)
{
    gathering g = {0};
    tn_buffer title = {0}, near_title = {0};
    size_t near_count = explained->near_known ? explained->near.count : 0;
    tn_drawn_plan *near = calloc(near_count + 1, sizeof *near);
    bool ok = near && (near_count == 0 || add_near(explained, near));
    write_title(explained, &title);
    write_near_title(explained, &near_title);
    for (size_t i = 0; ok && i < explained->count; i++)
        if (!explained->library || full || explained->rules[i].drops)
            ok = add_rule(&g, &explained->rules[i], (uint32_t)i, full);
    const tn_drawn_reasons drawn = {.title = title.data,
                                    .plan = {.trays = explained->trays, .length = explained->length},
                                    .reasons = g.reasons,
                                    .count = g.count,
                                    .near_title = near_title.data,
                                    .near = near,
                                    .near_count = near_count};
    tn_status status = ok && !title.failed && !near_title.failed ? tn_reasons_draw(explained->schema, &drawn, to, error)
                                                                 : tn_fail_memory(error);
    for (size_t i = 0; near && i < near_count; i++)
        free((char *)(uintptr_t)near[i].caption);
    free(near);
    gathering_clear(&g);
    free(near_title.data);
    free(title.data);
    return status;
}
