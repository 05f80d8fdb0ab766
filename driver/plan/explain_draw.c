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

static bool add_node(gathering *g, const tn_explanation *why, uint32_t index, unsigned depth, bool drops)
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
                              .region = node->region};
    if (!node->matched && node->run_count > 0)
        reason.partly = node->run;
    if (node->closest != TN_NO_WHY)
        reason.lacking = (tn_stretch){node->closest, node->closest + 1};
    return add(g, reason) && !evidence.failed;
}

static bool add_rule(gathering *g, const tn_explained_rule *rule, bool full)
{
    tn_explain_rows rows = {0};
    tn_buffer evidence = {0};
    bool prunes = rule->drops && rule->holds;
    tn_buffer_printf(&evidence, "%s", rule->doc);
    bool ok =
        add(g, (tn_drawn_reason){
                   .text = strdup(rule->name), .evidence = evidence.data, .matched = rule->holds, .drops = prunes});
    ok = ok && !evidence.failed && tn_explain_rows_make(&rule->why, full, &rows);
    for (uint32_t i = 0; ok && i < rows.count; i++)
        ok = add_node(g, &rule->why, rows.nodes[i], rows.depths[i], prunes);
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

tn_status tn_explained_draw(const tn_explained *explained, bool full, tn_picture *to, tn_error *error)
{
    gathering g = {0};
    tn_buffer title = {0};
    bool ok = true;
    write_title(explained, &title);
    for (size_t i = 0; ok && i < explained->count; i++)
        if (!explained->library || full || explained->rules[i].drops)
            ok = add_rule(&g, &explained->rules[i], full);
    const tn_drawn_plan plan = {.trays = explained->trays, .length = explained->length};
    tn_status status = ok && !title.failed
                           ? tn_reasons_draw(explained->schema, &plan, g.reasons, g.count, title.data, to, error)
                           : tn_fail_memory(error);
    for (size_t i = 0; i < g.count; i++) {
        free((char *)(uintptr_t)g.reasons[i].text);
        free((char *)(uintptr_t)g.reasons[i].evidence);
    }
    free(g.reasons);
    free(title.data);
    return status;
}
