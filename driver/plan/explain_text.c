/* Explanations as text: a line a part, indented, + where it matches and - where it does not. */
#include <stdlib.h>
#include <string.h>

#include "driver/plan/explain.h"
#include "runtime/plan/measure/amount.h"

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
        tn_words_gap(w->why, index, &w->why->gaps[node->gap_first + i], &line);
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
    w->ok &= tn_explain_rows_make(w->why, w->full, &rows);
    for (uint32_t i = 0; i < rows.count; i++) {
        const tn_why *node = &w->why->nodes[rows.nodes[i]];
        write_line(w, node, rows.depths[i]);
        uint32_t gaps = tn_explanation_gaps(w->why, rows.nodes[i]);
        if (gaps != TN_NO_WHY)
            write_gaps(w, gaps, rows.depths[i]);
    }
    tn_explain_rows_clear(&rows);
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

bool tn_explained_rule_text(const tn_explained *explained, const tn_explained_rule *rule, bool full, tn_buffer *out)
{
    writing w = {.why = &rule->why, .full = full, .out = out, .ok = true};
    w.ok &= tn_buffer_printf(out, "`%s` %s%s%s\n", rule->name, verdict(rule), *rule->doc ? ": " : "", rule->doc);
    write_tree(&w);
    write_largest(&w);
    write_beginning(&w, explained, &rule->beginning);
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
