/* Explains a plan by the rules or the library of a file. */
#include "driver/plan/explain.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/length.h"
#include "runtime/plan/match/image_search.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/picture/draw_explain.h"
#include "runtime/plan/schema/sum.h"
#include "runtime/plan/ways/plan_ways.h"
#include "runtime/plan/ways/projected.h"

/* ---- which parts of an explanation are shown */

#define SHORT_DEPTH 4

/* A step of what is written as one, as the `not` in `a implies b`: it has no row, what is below it has. */
static bool is_step(const tn_explanation *why, const tn_why *node)
{
    const tn_parts *tree = &why->trees[node->tree];
    return tn_part_is_step(tree, node->part) && !tn_part_unwritten(tree, node->part);
}

/* Compiled to `not a or b`. */
static bool is_implies(const tn_explanation *why, const tn_why *node)
{
    if (tn_why_part(why, node)->kind != TN_PART_OR || node->first == TN_NO_WHY)
        return false;
    const tn_why *first = &why->nodes[node->first];
    return is_step(why, first) && tn_why_part(why, first)->kind == TN_PART_NOT;
}

/* In the short form: of an `or` that matched, what did; below what was not found, only what shows how far it got. */
static bool is_shown(const tn_explanation *why, const tn_why *node, bool full, unsigned depth)
{
    if (tn_part_unwritten(&why->trees[node->tree], node->part))
        return false;
    if (full || node->parent == TN_NO_WHY)
        return true;
    const tn_why *parent = &why->nodes[node->parent];
    tn_part_kind above = tn_why_part(why, parent)->kind;
    if (is_implies(why, parent) && !parent->matched)
        return true; /* both halves: the first matches, the second does not */
    if (is_step(why, parent) && above == TN_PART_NOT)
        return true; /* the first half of `implies`: where it does not match, that is why the whole does */
    if (depth > SHORT_DEPTH || (parent->matched && !node->matched && above == TN_PART_OR))
        return false;
    return node->matched || parent->parent == TN_NO_WHY || above == TN_PART_AND || above == TN_PART_NEIGHBOUR;
}

static bool explain_rows_make(const tn_explanation *why, bool full, tn_explain_rows *rows)
{
    size_t room = (size_t)why->node_count + 1;
    *rows = (tn_explain_rows){malloc(room * sizeof *rows->nodes), malloc(room * sizeof *rows->depths), 0};
    if (!rows->nodes || !rows->depths)
        return false;
    uint32_t at = 0;
    unsigned depth = 0;
    for (;;) {
        const tn_why *node = &why->nodes[at];
        bool step = is_step(why, node), shown = !step && is_shown(why, node, full, depth);
        if (shown) {
            rows->nodes[rows->count] = at;
            rows->depths[rows->count++] = depth;
        }
        if ((shown || step) && node->first != TN_NO_WHY) {
            at = node->first;
            depth += shown;
            continue;
        }
        while (at != 0 && why->nodes[at].next == TN_NO_WHY) {
            at = why->nodes[at].parent;
            depth -= !is_step(why, &why->nodes[at]);
        }
        if (at == 0)
            return true;
        at = why->nodes[at].next;
    }
}

static void explain_rows_clear(tn_explain_rows *rows)
{
    free(rows->nodes);
    free(rows->depths);
    *rows = (tn_explain_rows){0};
}

/* ---- what explanations say, in words; trays are numbered from 1 here */

#define STRETCHES_SHOWN 8u
#define LENGTH_TEXT 64

static void words_stretch(tn_stretch stretch, tn_buffer *out)
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
    words_stretch(stretch, out);
}

/* "tray 3", "trays 2-3, 5". */
static void words_stretches(const tn_explanation *why, const tn_why *node, tn_buffer *out)
{
    const tn_stretch *stretches = why->stretches + node->stretch_first;
    bool one = node->stretch_count == 1 && stretches[0].end - stretches[0].begin == 1;
    tn_buffer_printf(out, one ? "tray " : "trays ");
    for (uint32_t i = 0; i < node->stretch_count && i < STRETCHES_SHOWN; i++) {
        tn_buffer_printf(out, i ? ", " : "");
        words_stretch(stretches[i], out);
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

/* Is there a place to tell of where a node matched? An `and` of the whole plan has none but that. */
static bool words_places(const tn_explanation *why, const tn_why *node)
{
    const tn_part *part = tn_why_part(why, node);
    bool joined = part->kind == TN_PART_AND || part->kind == TN_PART_OR || part->kind == TN_PART_NOT ||
                  part->kind == TN_PART_RULE;
    bool whole = node->region.begin == 0 && node->region.end == why->length;
    return node->matched && node->stretch_count > 0 && !(joined && whole && !part->somewhere);
}

bool tn_words_side(const tn_explanation *why, const tn_sides *sides, const mpq_t value, tn_buffer *out)
{
    tn_amount_unit unit = tn_amount_unit_of(why->schema, sides->power);
    tn_buffer text = {0};
    mpq_t shown;
    mpq_init(shown);
    mpq_set(shown, value);
    if (sides->percent && sides->power == 0)
        mpz_mul_ui(mpq_numref(shown), mpq_numref(shown), 100);
    mpq_canonicalize(shown);
    bool good = tn_amount_write(unit, shown, &text);
    if (good && strchr(text.data, '/') && sides->power >= 0) { /* a fraction without an end: to six digits */
        text.size = 0;
        tn_amount_convert(unit, shown);
        good = tn_amount_write_about(unit, shown, &text);
    }
    mpq_clear(shown);
    good = good && tn_buffer_printf(out, "%s%s", text.data, sides->percent && sides->power == 0 ? " %" : "");
    free(text.data);
    return good;
}

/* "60, compared with 30 and 60", "the left side less the right side is 3 m" */
static void say_sides(const tn_explanation *why, const tn_sides *sides, tn_buffer *out)
{
    if (sides->difference)
        tn_buffer_printf(out, "the left side less the right side is ");
    tn_words_side(why, sides, sides->left, out);
    for (uint32_t i = 0; i < sides->right_count; i++) {
        tn_buffer_printf(out, i ? " and " : ", compared with ");
        tn_words_side(why, sides, sides->right[i], out);
    }
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
    else if (node->sides != TN_NO_WHY) /* they are of the whole plan */
        say_sides(why, &why->sides[node->sides], out);
    else if (!node->matched)
        say_missing(why, node, out);
    else if (part->kind == TN_PART_DISTANCE && node->stretch_count > 0)
        tn_buffer_printf(out, "some source is far enough: ");
    if (words_places(why, node) && node->number == TN_NO_NUMBER && node->sides == TN_NO_WHY)
        words_stretches(why, node, out);
    if (node->mirrored && node->parent != TN_NO_WHY && !why->nodes[node->parent].mirrored)
        tn_buffer_printf(out, "%smirrored", out->size ? ", " : "");
    if (node->cut)
        tn_buffer_printf(out, "%snot opened further", out->size ? ", " : "");
}

static void words_gap(const tn_explanation *why, uint32_t index, const tn_gap *gap, tn_buffer *out)
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

/* ---- explanations as pictures: the rows of the text, drawn */

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
                              .mark_count = words_places(why, node) ? node->stretch_count : 0,
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
    ok = ok && numbers && !evidence.failed && explain_rows_make(&rule->why, full, &rows);
    for (uint32_t i = 0; ok && i < rows.count; i++)
        ok = add_node(g, &rule->why, rows.nodes[i], rows.depths[i], prunes, numbers[rows.nodes[i]]);
    free(numbers);
    explain_rows_clear(&rows);
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

/* ---- explanations as text: a line a part, indented, + where it matches and - where it does not */

#define TEXT_WIDTH 64 /* of a part's own text; the evidence follows */

typedef struct writing {
    const tn_explanation *why;
    bool full;
    tn_buffer *out;
    bool ok;
} writing;

/* Characters, not bytes, as far as UTF-8 goes. */
static size_t width_of(const char *text)
{
    size_t width = 0;
    for (; *text; text++)
        width += ((unsigned char)*text & 0xc0) != 0x80;
    return width;
}

static void write_gaps(writing *w, uint32_t index, unsigned depth)
{
    const tn_why *node = &w->why->nodes[index];
    for (uint32_t i = 0; i < node->gap_count && (w->full || i < 4); i++) {
        tn_buffer line = {0};
        words_gap(w->why, index, &w->why->gaps[node->gap_first + i], &line);
        w->ok &= !line.failed && tn_buffer_printf(w->out, "%*s%s\n", (int)(2 * depth + 6), "", line.data);
        free(line.data);
    }
    bool vacuous = node->matched && node->gap_count == 0 && node->stretch_count > 0;
    bool missing = tn_why_part(w->why, node)->kind == TN_PART_NEAR && !node->matched && node->gap_count == 0;
    if (vacuous || missing)
        w->ok &= tn_buffer_printf(w->out, "%*sno destination anywhere\n", (int)(2 * depth + 6), "");
}

static void write_line(writing *w, const tn_why *node, unsigned depth)
{
    char text[TN_PART_TEXT_MAX];
    tn_buffer evidence = {0};
    int indent = (int)(2 * depth + 2);
    tn_part_text(&w->why->trees[node->tree], node->part, text, w->full ? sizeof text : TEXT_WIDTH);
    tn_words_evidence(w->why, node, &evidence);
    w->ok &= tn_buffer_printf(w->out, "%*s%c %s", indent, "", node->matched ? '+' : '-', text);
    if (evidence.size) {
        size_t used = width_of(text) + (size_t)indent + 2, column = 44;
        w->ok &= tn_buffer_printf(w->out, "%*s%s", used + 2 < column ? (int)(column - used) : 2, "", evidence.data);
    }
    w->ok &= tn_buffer_append(w->out, "\n", 1);
    w->ok &= !evidence.failed;
    free(evidence.data);
}

static void write_tree(writing *w)
{
    tn_explain_rows rows = {0};
    w->ok &= explain_rows_make(w->why, w->full, &rows);
    for (uint32_t i = 0; i < rows.count; i++) {
        const tn_why *node = &w->why->nodes[rows.nodes[i]];
        write_line(w, node, rows.depths[i]);
        uint32_t gaps = tn_explanation_gaps(w->why, rows.nodes[i]);
        if (gaps != TN_NO_WHY)
            write_gaps(w, gaps, rows.depths[i]);
    }
    explain_rows_clear(&rows);
}

/* Of a rule that does not match: the largest part that does. */
static void write_largest(writing *w)
{
    uint32_t largest = w->why->nodes[0].matched ? TN_NO_WHY : tn_explanation_largest(w->why);
    if (largest == TN_NO_WHY || largest == 0)
        return;
    const tn_why *node = &w->why->nodes[largest];
    char text[TN_PART_TEXT_MAX];
    tn_buffer evidence = {0};
    tn_part_text(&w->why->trees[node->tree], node->part, text, w->full ? sizeof text : TEXT_WIDTH);
    tn_words_evidence(w->why, node, &evidence);
    w->ok &= tn_buffer_printf(w->out, "  the most that matches: %s%s%s\n", text, evidence.size ? ": " : "",
                              evidence.size ? evidence.data : "");
    w->ok &= !evidence.failed;
    free(evidence.data);
}

static const char *verdict(const tn_explained_rule *rule)
{
    if (!rule->clause || rule->clause->kind == TN_CLAUSE_PRUNE)
        return rule->holds ? "matches" : "does not match";
    return rule->holds ? "is met" : "is not met";
}

static void write_beginning(writing *w, const tn_explained *explained, const tn_generated_beginning *beginning)
{
    tn_buffer words = {0};
    if (!beginning->known)
        return;
    w->ok = w->ok && tn_words_beginning(explained, beginning, &words) &&
            tn_buffer_printf(w->out, "  how far it goes: %s\n", words.data);
    free(words.data);
}

/* Whether a plan of another library lies above, and which. */
static void write_projected(writing *w, const tn_explained_rule *rule)
{
    if (rule->projected && rule->above)
        w->ok = w->ok && tn_buffer_printf(
                             w->out, "  the first plan of `%s` that is this one without its newer fields:\n    %s\n",
                             rule->projected, rule->above);
    else if (rule->projected)
        w->ok = w->ok &&
                tn_buffer_printf(w->out, "  no plan of `%s` is this one without its newer fields\n", rule->projected);
}

bool tn_explained_rule_text(const tn_explained *explained, const tn_explained_rule *rule, bool full, tn_buffer *out)
{
    writing w = {.why = &rule->why, .full = full, .out = out, .ok = true};
    w.ok &= tn_buffer_printf(out, "`%s` %s%s%s\n", rule->name, verdict(rule), *rule->doc ? ": " : "", rule->doc);
    write_tree(&w);
    write_largest(&w);
    write_projected(&w, rule);
    write_beginning(&w, explained, &rule->beginning);
    if (rule->ways)
        w.ok &= tn_buffer_printf(out, "  in how many ways: %s\n", rule->ways);
    return w.ok;
}

static bool write_near(const tn_explained *explained, tn_buffer *out)
{
    const tn_near *near = &explained->near;
    bool ok = true;
    if (near->count == 0)
        return !explained->near_known || tn_buffer_printf(out, "\nthe library holds no plan at all\n");
    ok &= tn_buffer_printf(out, "\nnearest kept plan%s, at a distance of %u:\n",
                           near->count == 1 && !near->more ? "" : "s", near->cost);
    for (size_t i = 0; ok && i < near->count; i++) {
        tn_buffer changes = {0}, line = {0};
        ok = tn_words_changes(explained, &near->plans[i], &changes) &&
             tn_plan_write_line(explained->schema, near->plans[i].trays, near->plans[i].length, &line) &&
             tn_buffer_printf(out, "  %s\n    %s\n", changes.data ? changes.data : "", line.data ? line.data : "");
        free(changes.data);
        free(line.data);
    }
    if (near->more)
        ok &= tn_buffer_printf(out, "  and others as near\n");
    return ok;
}

static bool write_verdict(const tn_explained *explained, tn_buffer *out)
{
    const char *name = tn_text(explained->opened->module, explained->library->name);
    if (explained->kept) {
        bool ok = tn_buffer_printf(out, "`%s` keeps this plan", name);
        mpz_t rank;
        mpz_init(rank);
        if (explained->automaton && tn_library_rank(explained->automaton, explained->trays, explained->length, rank)) {
            char *digits = mpz_get_str(NULL, 10, rank);
            ok &= digits && tn_buffer_printf(out, ", rank %s", digits);
            free(digits);
        }
        mpz_clear(rank);
        return ok && tn_buffer_append(out, "\n", 1);
    }
    bool ok = tn_buffer_printf(out, "`%s` drops this plan by ", name);
    const char *between = "";
    if (explained->length_drops) {
        ok &= tn_buffer_printf(out, "trays (it has %zu, and plans there have %u to %u)", explained->length,
                               explained->library->trays_min, explained->library->trays_max);
        between = ", ";
    }
    for (size_t i = 0; i < explained->count; i++) {
        if (!explained->rules[i].drops)
            continue;
        ok &= tn_buffer_printf(out, "%s%s", between, explained->rules[i].name);
        between = ", ";
    }
    return ok && tn_buffer_append(out, "\n", 1);
}

/* "`preference` is 3 of 4.5:", and each of them. */
static bool write_preferences(const tn_explained *explained, bool full, tn_buffer *out)
{
    static const tn_amount_unit plain = {0};
    mpq_t met, all;
    if (explained->preference_count == 0)
        return true;
    mpq_inits(met, all, NULL);
    tn_explained_preferred(explained, met, all);
    bool ok = tn_buffer_printf(out, "\n`%s` is ", TN_PREFERENCE_NAME) && tn_amount_write(plain, met, out) &&
              tn_buffer_printf(out, " of ") && tn_amount_write(plain, all, out) && tn_buffer_append(out, "\n", 1);
    for (size_t i = 0; ok && i < explained->preference_count; i++) {
        const tn_preference_reason *preference = &explained->preferences[i];
        writing w = {.why = &preference->why, .full = full, .out = out, .ok = true};
        mpq_set_str(met, preference->worth, 10);
        ok = tn_buffer_printf(out, "  `%s` is %s, worth ", preference->name, preference->met ? "met" : "not met") &&
             tn_amount_write(plain, met, out) &&
             tn_buffer_printf(out, "%s%s\n", *preference->doc ? ": " : "", preference->doc);
        if (ok && full)
            write_tree(&w);
        ok = ok && w.ok;
    }
    mpq_clears(met, all, NULL);
    return ok;
}

bool tn_explained_text(const tn_explained *explained, bool full, tn_buffer *out)
{
    bool ok = explained->library ? write_verdict(explained, out) : true;
    bool apart = explained->library != NULL;
    for (size_t i = 0; ok && i < explained->count; i++) {
        const tn_explained_rule *rule = &explained->rules[i];
        if (explained->library && !full && !rule->drops)
            continue;
        ok = (!apart || tn_buffer_append(out, "\n", 1)) && tn_explained_rule_text(explained, rule, full, out);
        apart = true;
    }
    return ok && write_preferences(explained, full, out) && write_near(explained, out);
}

/* ---- by the rules or the library of a file */

static tn_status explain_function(const tn_explained *explained, uint32_t function, size_t max_length, bool *holds,
                                  tn_explanation *why, tn_error *error)
{
    tn_status status =
        tn_explain(explained->schema, function, explained->trays, explained->length, max_length, why, error);
    *holds = status == TN_OK && why->nodes[0].matched;
    return status;
}

static tn_status explain_one(tn_explained *explained, tn_explained_rule *rule, uint32_t function, size_t max_length,
                             tn_error *error)
{
    return explain_function(explained, function, max_length, &rule->holds, &rule->why, error);
}

/* What a rule says of itself stands for a preference that says nothing. */
static tn_status explain_preference(tn_explained *explained, uint32_t i, size_t max_length, tn_error *error)
{
    const tn_module *module = explained->opened->module;
    const tn_library_record *library = explained->library;
    const tn_preference_record *preference = &module->PREFERENCE_records[library->preference_first + i];
    const tn_term_record *term = tn_preferred_term(module, library, i);
    tn_preference_reason *made = &explained->preferences[explained->preference_count++];
    *made = (tn_preference_reason){.name = tn_text(module, preference->name),
                                   .doc = tn_text(module, preference->doc),
                                   .worth = tn_text(module, term->factor)};
    return explain_function(explained, term->part, max_length, &made->met, &made->why, error);
}

void tn_explained_preferred(const tn_explained *explained, mpq_t met, mpq_t all)
{
    mpq_t worth;
    mpq_init(worth);
    mpq_set_ui(met, 0, 1);
    mpq_set_ui(all, 0, 1);
    for (size_t i = 0; i < explained->preference_count; i++) {
        mpq_set_str(worth, explained->preferences[i].worth, 10);
        mpq_add(all, all, worth);
        if (explained->preferences[i].met)
            mpq_add(met, met, worth);
    }
    mpq_clear(worth);
}

/* A limit leaves it open. */
static tn_status find_ways(const tn_explained *explained, const tn_clause_record *clause, size_t max_length,
                           tn_explained_rule *made, tn_error *error)
{
    tn_derivation derivation;
    tn_plan_vm *vm = NULL;
    mpz_t ways;
    mpz_init(ways);
    tn_status status = tn_derivation_read(explained->opened->module, clause->holds, &derivation, error);
    if (status == TN_OK)
        status = tn_plan_vm_new(explained->schema, max_length, &vm, error);
    if (status == TN_OK)
        status = tn_plan_ways(&derivation, vm, explained->trays, explained->length, ways, error);
    if (status == TN_OK && !(made->ways = mpz_get_str(NULL, 10, ways)))
        status = tn_fail_memory(error);
    tn_plan_vm_free(vm);
    tn_derivation_clear(&derivation);
    mpz_clear(ways);
    return status == TN_LIMIT ? TN_OK : status;
}

/* How many plans of the other library it is, likewise. */
static tn_status find_projected_ways(const tn_explained *explained, const tn_instruction *image,
                                     tn_explained_rule *made, tn_error *error)
{
    tn_projected *projected = NULL;
    mpz_t ways;
    mpz_init(ways);
    uint32_t longest = (uint32_t)explained->length;
    tn_status status = tn_projected_new(explained->schema, image, NULL, 0, longest, &projected, error);
    if (status == TN_OK)
        status = tn_projected_ways(projected, explained->trays, explained->length, ways, error);
    if (status == TN_OK && !(made->ways = mpz_get_str(NULL, 10, ways)))
        status = tn_fail_memory(error);
    tn_projected_free(projected);
    mpz_clear(ways);
    return status == TN_LIMIT ? TN_OK : status;
}

/* The first plan that is the plan with newer fields. */
static tn_status find_above(const tn_explained *explained, const tn_instruction *image, tn_explained_rule *made,
                            tn_error *error)
{
    tn_image_search *search = NULL;
    bool found = false;
    tn_buffer line = {0};
    tn_tray *newer = calloc(explained->length + 1, sizeof *newer);
    tn_status status = newer ? tn_image_search_new(explained->schema, image, &search, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_image_search_find(search, explained->trays, explained->length, &found, newer, error);
    if (status == TN_OK && found &&
        !tn_plan_write_line(tn_image_search_projection(search)->newer, newer, explained->length, &line))
        status = tn_fail_memory(error);
    if (status == TN_OK && found && !(made->above = line.data ? line.data : strdup("")))
        status = tn_fail_memory(error);
    if (status != TN_OK)
        free(line.data);
    tn_image_search_free(search);
    free(newer);
    return status;
}

/* A clause that says what plans are made of: how far one goes along with them that is not. */
static tn_status explain_made(const tn_explained *explained, const tn_clause_record *clause, size_t max_length,
                              tn_explained_rule *made, tn_error *error)
{
    const tn_module *module = explained->opened->module;
    tn_instruction image;
    tn_status status = TN_OK;
    if (tn_function_is_image(module, clause->holds, &image)) {
        made->projected = tn_text(module, module->LIBRARY_records[image.first].name);
        status = made->holds ? find_above(explained, &image, made, error) : TN_OK;
        if (status == TN_OK && made->holds)
            status = find_projected_ways(explained, &image, made, error);
    }
    if (status == TN_OK && made->holds && !made->projected)
        status = find_ways(explained, clause, max_length, made, error);
    if (status != TN_OK || !made->drops)
        return status;
    return tn_generated_beginning_find(explained->schema, clause->holds, explained->library->trays_min,
                                       explained->library->trays_max, explained->trays, explained->length,
                                       &made->beginning, error);
}

static tn_status explain_clause(tn_explained *explained, uint32_t i, size_t max_length, tn_error *error)
{
    const tn_module *module = explained->opened->module;
    const tn_clause_record *clause = &module->CLAUSE_records[explained->library->clause_first + i];
    uint32_t rule = tn_function_rule(module, clause->holds);
    tn_explained_rule *made = &explained->rules[explained->count++];
    const char *doc = tn_text(module, clause->doc);
    if (!*doc && rule != UINT32_MAX)
        doc = tn_text(module, module->RULE_records[rule].doc);
    *made = (tn_explained_rule){.name = tn_text(module, clause->name), .doc = doc, .clause = clause};
    tn_status status = explain_one(explained, made, clause->holds, max_length, error);
    made->drops = status == TN_OK && made->holds == (clause->kind == TN_CLAUSE_PRUNE);
    explained->kept = explained->kept && !made->drops;
    if (status == TN_OK && (clause->kind == TN_CLAUSE_GENERATE || clause->kind == TN_CLAUSE_ONTO))
        status = explain_made(explained, clause, max_length, made, error);
    return status;
}

tn_status tn_explained_make(tn_explained *explained, const tn_opened *opened, const tn_schema *schema,
                            const tn_library_record *library, const uint32_t *rules, size_t rule_count,
                            const tn_tray *trays, size_t length, size_t max_length, tn_error *error)
{
    size_t count = library ? library->clause_count : rule_count;
    *explained =
        (tn_explained){.opened = opened, .schema = schema, .library = library, .trays = trays, .length = length};
    uint32_t preferences = library ? library->preference_count : 0;
    explained->rules = calloc(count + 1, sizeof *explained->rules);
    explained->preferences = calloc((size_t)preferences + 1, sizeof *explained->preferences);
    if (!explained->rules || !explained->preferences)
        return tn_fail_memory(error);
    explained->length_drops = library && (length < library->trays_min || length > library->trays_max);
    explained->kept = library && !explained->length_drops;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && library && i < count; i++)
        status = explain_clause(explained, i, max_length, error);
    for (uint32_t i = 0; status == TN_OK && i < preferences; i++)
        status = explain_preference(explained, i, max_length, error);
    for (size_t i = 0; status == TN_OK && !library && i < count; i++) {
        const tn_rule_record *record = &opened->module->RULE_records[rules[i]];
        tn_explained_rule *made = &explained->rules[explained->count++];
        *made = (tn_explained_rule){.name = tn_text(opened->module, record->name),
                                    .doc = tn_text(opened->module, record->doc)};
        status = explain_one(explained, made, record->holds, max_length, error);
    }
    return status;
}

tn_status tn_explained_near(tn_explained *explained, tn_near_finder *finder, size_t most, tn_error *error)
{
    if (explained->kept)
        return TN_OK;
    tn_near_clear(&explained->near);
    tn_status status = tn_near_find(finder, explained->trays, explained->length, most, &explained->near, error);
    explained->near_known = status == TN_OK;
    return status;
}

/* Takes the plans over. */
static tn_status take_near(tn_near *near, tn_searched_plans *found, tn_error *error)
{
    near->plans = calloc(found->count + 1, sizeof *near->plans);
    if (!near->plans)
        return tn_fail_memory(error);
    for (; near->count < found->count; near->count++) {
        tn_searched_plan *plan = &found->items[near->count];
        near->plans[near->count] = (tn_near_plan){plan->trays, plan->length};
        plan->trays = NULL;
    }
    return TN_OK;
}

tn_status tn_explained_search_near(tn_explained *explained, tn_plan_search *search, size_t most, tn_error *error)
{
    tn_near *near = &explained->near;
    tn_searched_plans found = {0};
    if (explained->kept)
        return TN_OK;
    tn_near_clear(near);
    tn_status status =
        tn_plan_search_near(search, explained->trays, explained->length, most, &found, &near->cost, &near->more, error);
    if (status == TN_OK)
        status = take_near(near, &found, error);
    tn_searched_plans_clear(&found);
    if (status != TN_OK)
        tn_near_clear(near);
    explained->near_known = status == TN_OK;
    return status;
}

void tn_explained_clear(tn_explained *explained)
{
    for (size_t i = 0; i < explained->count; i++) {
        tn_explanation_clear(&explained->rules[i].why);
        tn_generated_beginning_clear(&explained->rules[i].beginning);
        free(explained->rules[i].ways);
        free(explained->rules[i].above);
    }
    for (size_t i = 0; i < explained->preference_count; i++)
        tn_explanation_clear(&explained->preferences[i].why);
    free(explained->preferences);
    free(explained->rules);
    tn_near_clear(&explained->near);
    *explained = (tn_explained){0};
}
