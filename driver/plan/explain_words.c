/* What explanations say, in words. Trays are numbered from 1 here. */
#include <inttypes.h>
#include <stdlib.h>

#include "driver/plan/explain.h"
#include "runtime/base/array.h"
#include "runtime/base/length_style.h"

#define STRETCHES_SHOWN 8u
#define LENGTH_TEXT 64

void tn_words_stretch(tn_stretch stretch, tn_buffer *out)
{
    if (stretch.end - stretch.begin == 1)
        tn_buffer_printf(out, "%" PRIu32, stretch.begin + 1);
    else
        tn_buffer_printf(out, "%" PRIu32 "-%" PRIu32, stretch.begin + 1, stretch.end);
}

/* "tray 3" or "trays 2-3". */
static void named_stretch(tn_stretch stretch, tn_buffer *out)
{
    tn_buffer_printf(out, stretch.end - stretch.begin == 1 ? "tray " : "trays ");
    tn_words_stretch(stretch, out);
}

void tn_words_stretches(const tn_explanation *why, const tn_why *node, tn_buffer *out)
{
    const tn_stretch *stretches = why->stretches + node->stretch_first;
    bool one = node->stretch_count == 1 && stretches[0].end - stretches[0].begin == 1;
    tn_buffer_printf(out, one ? "tray " : "trays ");
    for (uint32_t i = 0; i < node->stretch_count && i < STRETCHES_SHOWN; i++) {
        tn_buffer_printf(out, i ? ", " : "");
        tn_words_stretch(stretches[i], out);
    }
    if (node->stretch_count > STRETCHES_SHOWN)
        tn_buffer_printf(out, " and %" PRIu32 " more", node->stretch_count - STRETCHES_SHOWN);
}

void tn_words_wrong(const tn_explanation *why, const tn_why *node, tn_buffer *out)
{
    const tn_schema *schema = why->schema;
    tn_tray tray = why->trays[node->closest];
    uint64_t wrong = tn_spec_failing(schema, tn_why_part(why, node)->spec, tray);
    const char *between = "";
    for (uint32_t f = 0; f < schema->field_count && f < 64; f++) {
        if (!(wrong >> f & 1))
            continue;
        const char *name = tn_text(schema->module, schema->fields[f].name);
        const char *value = tn_text(schema->module, tn_tray_value_record(schema, tray, f)->spelling);
        if (schema->fields[f].kind == TN_FIELD_FLAG)
            tn_buffer_printf(out, "%s%s%s", between, tn_tray_value(schema, tray, f) ? "" : "not ", name);
        else
            tn_buffer_printf(out, "%s%s %s", between, name, value);
        between = ", ";
    }
}

/* A number of what the separator or the node counts: "3 counted", "12' in all". */
static void say_number(const tn_explanation *why, const tn_part *part, int64_t number, tn_buffer *out)
{
    const tn_schema *schema = why->schema;
    if (part->kind != TN_PART_SUM) {
        tn_buffer_printf(out, "%" PRId64 " counted", number);
        return;
    }
    char text[LENGTH_TEXT];
    const tn_value_record *value =
        &schema->module->VALUE_records[schema->module->FIELD_records[part->field].value_first];
    uint32_t field = part->field - schema->record->field_first;
    for (uint32_t v = 0; v < schema->fields[field].value_count && value->length == 0; v++)
        value++;
    const char *spelling =
        tn_text(schema->module, *tn_text(schema->module, value->measure) ? value->measure : value->name);
    tn_length_write_style(number, tn_length_style_of(spelling), text, sizeof text);
    tn_buffer_printf(out, "%s in all", text);
}

static void say_run(const tn_explanation *why, const tn_why *node, tn_buffer *out)
{
    const tn_part *part = tn_why_part(why, node);
    if (node->run_count == part->child_count) {
        bool first = part->beginning && (node->mirrored ? node->run.end != why->length : node->run.begin != 0);
        named_stretch(node->run, out);
        tn_buffer_printf(out, " would do, but not at the plan's %s", first != node->mirrored ? "beginning" : "end");
        return;
    }
    if (node->run_count == 1)
        tn_buffer_printf(out, "only part %" PRIu32 " of %" PRIu32 " found: ", node->run_first + 1, part->child_count);
    else
        tn_buffer_printf(out,
                         "only parts %" PRIu32 "-%" PRIu32 " of %" PRIu32 " found side by side: ", node->run_first + 1,
                         node->run_first + node->run_count, part->child_count);
    named_stretch(node->run, out);
}

static void say_missing(const tn_explanation *why, const tn_why *node, tn_buffer *out)
{
    switch (tn_why_part(why, node)->kind) {
    case TN_PART_TRAY:
        if (node->closest == TN_NO_WHY) {
            tn_buffer_printf(out, "none");
            return;
        }
        tn_buffer_printf(out, "none; closest is tray %" PRIu32 ": ", node->closest + 1);
        tn_words_wrong(why, node, out);
        return;
    case TN_PART_NEIGHBOUR:
        if (node->run_count)
            say_run(why, node, out);
        return;
    case TN_PART_DISTANCE:
        tn_buffer_printf(out, "no source is far enough from every destination; one would do");
        return;
    default:
        return;
    }
}

bool tn_words_places(const tn_explanation *why, const tn_why *node)
{
    const tn_part *part = tn_why_part(why, node);
    bool joined = part->kind == TN_PART_AND || part->kind == TN_PART_OR || part->kind == TN_PART_NOT ||
                  part->kind == TN_PART_RULE;
    bool whole = node->region.begin == 0 && node->region.end == why->length;
    return node->matched && node->stretch_count > 0 && !(joined && whole && !part->somewhere);
}

void tn_words_evidence(const tn_explanation *why, const tn_why *node, tn_buffer *out)
{
    const tn_part *part = tn_why_part(why, node);
    if (node->absent) {
        tn_buffer_printf(out, "left out");
        return;
    }
    if (node->number != TN_NO_NUMBER)
        say_number(why, part, node->number, out);
    else if (!node->matched)
        say_missing(why, node, out);
    else if (part->kind == TN_PART_DISTANCE && node->stretch_count > 0)
        tn_buffer_printf(out, "some source is far enough: ");
    if (tn_words_places(why, node) && node->number == TN_NO_NUMBER)
        tn_words_stretches(why, node, out);
    if (node->mirrored && node->parent != TN_NO_WHY && !why->nodes[node->parent].mirrored)
        tn_buffer_printf(out, "%smirrored", out->size ? ", " : "");
    if (node->cut)
        tn_buffer_printf(out, "%snot opened further", out->size ? ", " : "");
}

void tn_words_gap(const tn_explanation *why, uint32_t index, const tn_gap *gap, tn_buffer *out)
{
    static const char *const verdicts[] = {
        [TN_GAP_GOOD] = "", [TN_GAP_TOO_NEAR] = ": too near", [TN_GAP_TOO_FAR] = ": too far"};
    const tn_why *node = &why->nodes[index];
    named_stretch(gap->source, out);
    tn_buffer_printf(out, " to ");
    named_stretch(gap->destination, out);
    if (gap->between.begin == gap->between.end) {
        tn_buffer_printf(out, ": nothing between");
    } else {
        tn_buffer_printf(out, ": ");
        named_stretch(gap->between, out);
        tn_buffer_printf(out, " between");
    }
    const tn_parts *tree = &why->trees[node->tree];
    const tn_part *separator = &tree->parts[tree->parts[tree->parts[tree->parts[node->part].first].next].next];
    if (gap->number != TN_NO_NUMBER && separator->kind != TN_PART_RULE) {
        tn_buffer_printf(out, ", ");
        say_number(why, separator, gap->number, out);
    }
    tn_buffer_printf(out, "%s", verdicts[tn_explanation_gap(why, index, gap)]);
}

/* ---- changes */

static void say_change(const tn_schema *schema, size_t place, tn_tray from, tn_tray to, tn_buffer *out)
{
    bool said = false;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        if (tn_tray_value(schema, from, f) == tn_tray_value(schema, to, f))
            continue;
        const char *name = tn_text(schema->module, schema->fields[f].name);
        if (said)
            tn_buffer_printf(out, ", ");
        else
            tn_buffer_printf(out, "%stray %zu: ", out->size ? "; " : "", place + 1);
        said = true;
        if (schema->fields[f].kind == TN_FIELD_FLAG)
            tn_buffer_printf(out, "%s%s", tn_tray_value(schema, to, f) ? "" : "not ", name);
        else
            tn_buffer_printf(out, "%s %s for %s", name,
                             tn_text(schema->module, tn_tray_value_record(schema, to, f)->spelling),
                             tn_text(schema->module, tn_tray_value_record(schema, from, f)->spelling));
    }
}

/* The usual table of edit distances, then a way back through it that changes rather than adds. */
bool tn_words_changes(const tn_explained *explained, const tn_near_plan *plan, tn_buffer *out)
{
    const tn_schema *schema = explained->schema;
    size_t n = explained->length, m = plan->length, width = m + 1;
    uint32_t fields = schema->field_count;
    uint32_t *cost = calloc(tn_size_of(n + 1, width), sizeof *cost);
    if (!cost)
        return false;
    for (size_t i = n + 1; i-- > 0;) {
        for (size_t j = m + 1; j-- > 0;) {
            uint32_t best = i == n && j == m ? 0 : UINT32_MAX, *at = &cost[i * width + j];
            if (i < n && j < m)
                best = at[width + 1] + tn_tray_distance(schema, explained->trays[i], plan->trays[j]);
            if (i < n && at[width] + fields < best)
                best = at[width] + fields;
            if (j < m && at[1] + fields < best)
                best = at[1] + fields;
            *at = best;
        }
    }
    for (size_t i = 0, j = 0; i < n || j < m;) {
        const uint32_t *at = &cost[i * width + j];
        if (i < n && j < m && *at == at[width + 1] + tn_tray_distance(schema, explained->trays[i], plan->trays[j])) {
            say_change(schema, i, explained->trays[i], plan->trays[j], out);
            i++;
            j++;
        } else if (i < n && *at == at[width] + fields) {
            tn_buffer_printf(out, "%stray %zu left out", out->size ? "; " : "", ++i);
        } else {
            tn_buffer_printf(out, "%sa tray added %s %zu", out->size ? "; " : "", i ? "after" : "before", i ? i : 1);
            j++;
        }
    }
    free(cost);
    return !out->failed;
}

/* ---- how far a plan goes along with what is generated */

enum { FOLLOWS_SHOWN = 4 };

bool tn_words_beginning(const tn_explained *explained, const tn_generated_beginning *beginning, tn_buffer *out)
{
    const tn_schema *schema = explained->schema;
    tn_buffer line = {0};
    bool nothing = beginning->count == 0 && !beginning->may_end, ok = true;
    if (nothing)
        return tn_buffer_printf(out, "no plan is so made that has as many trays as plans of this library have");
    if (beginning->length == 0)
        ok = tn_buffer_printf(out, "not its first tray; there may come ");
    else if (beginning->length == explained->length)
        ok = tn_buffer_printf(out, "to its end, and it cannot end there; then may come ");
    else
        ok = beginning->length == 1
                 ? tn_buffer_printf(out, "its first tray is as in some plan that is so made; then may come ")
                 : tn_buffer_printf(out, "its first %u trays are as in some plan that is so made; then may come ",
                                    beginning->length);
    uint32_t shown = 0;
    for (tn_tray t = 0; ok && t < schema->tray_count && shown < FOLLOWS_SHOWN; t++) {
        if (!beginning->follows[t])
            continue;
        line.size = 0;
        ok = tn_plan_write_line(schema, &t, 1, &line) &&
             tn_buffer_printf(out, "%s`%s`", shown == 0 ? "" : ", ", line.data);
        shown++;
    }
    if (ok && beginning->count > shown)
        ok = tn_buffer_printf(out, " or %u others", beginning->count - shown);
    if (ok && beginning->may_end)
        ok = tn_buffer_printf(out, "%sthe plan's end", beginning->count > 0 ? ", or " : "");
    free(line.data);
    return ok;
}
