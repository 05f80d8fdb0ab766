/* The signs of rules: words over boxes, arrows, walls, tags. */
#include <stdio.h>
#include <string.h>

#include "runtime/draw/type.h"
#include "runtime/plan/picture/draw_rule_data.h"

/* ---- words */

static const char *sign_of(tn_part_kind kind)
{
    switch (kind) {
    case TN_PART_WHERE:
        return "where";
    case TN_PART_AND:
        return "and";
    case TN_PART_OR:
        return "or";
    case TN_PART_NOT:
        return "not";
    case TN_PART_MANY:
        return "one or more, each:";
    default:
        return "";
    }
}

/* The condition as its author wrote it, after the last comma: "n >= 2" rather than "not n < 2". */
static bool own_condition(const tn_rule_picture *p, uint32_t part, char condition[TN_CONDITION_TEXT_MAX])
{
    char text[TN_PART_TEXT_MAX];
    tn_part_text(&p->parts, part, text, sizeof text);
    const char *comma = strrchr(text, ',');
    size_t length = strlen(text);
    if (!comma || text[length - 1] != ')' || length >= sizeof text - 8)
        return false;
    snprintf(condition, TN_CONDITION_TEXT_MAX, "%.*s", (int)(text + length - 1 - (comma + 2)), comma + 2);
    return true;
}

/* Does the part deny that something lies otherwise: is it `every a beside b`? */
static bool is_every(const tn_rule_picture *p, const tn_part *it)
{
    tn_part_kind below = it->child_count == 1 ? tn_rule_part(p, it->first)->kind : TN_PART_KIND_COUNT;
    return it->kind == TN_PART_NOT && (below == TN_PART_NEAR || below == TN_PART_FAR) &&
           tn_part_is_step(&p->parts, it->first);
}

/* The words between source and destination, as they are written: "within 12m of". */
static void near_words(const tn_rule_picture *p, const tn_part *it, char words[TN_RULE_WORDS_MAX])
{
    const tn_module *module = p->schema->module;
    const tn_part *source = tn_rule_part(p, it->first), *destination = tn_rule_part(p, source->next);
    const tn_source_map_record *from = tn_module_place(module, source->root),
                               *to = tn_module_place(module, destination->root);
    snprintf(words, TN_RULE_WORDS_MAX, "%s", tn_part_word(it->kind));
    if (!from || !to || from->file != to->file || from->end >= to->begin)
        return;
    char text[TN_RULE_WORDS_MAX];
    tn_source_text(module, from->file, from->end, to->begin, text, sizeof text);
    size_t begin = strspn(text, " )"), size = strlen(text);
    while (size > begin && strchr(" (", text[size - 1]))
        size--;
    if (size > begin)
        snprintf(words, TN_RULE_WORDS_MAX, "%.*s", (int)(size - begin), text + begin);
}

bool tn_rule_is_gap(const tn_rule_picture *p, uint32_t part)
{
    char words[TN_RULE_WORDS_MAX];
    for (;; part = tn_rule_part(p, part)->first) {
        const tn_part *it = tn_rule_part(p, part);
        if (it->kind == TN_PART_NEAR || it->kind == TN_PART_FAR) {
            near_words(p, it, words);
            return strcmp(words, "to") == 0;
        }
        bool steps = it->kind == TN_PART_NOT || it->kind == TN_PART_AND || it->kind == TN_PART_OR;
        if (!steps || it->first == TN_NO_PART || !tn_part_is_step(&p->parts, it->first))
            return false;
    }
}

void tn_draw_rule_words(const tn_rule_picture *p, uint32_t part, char words[TN_RULE_WORDS_MAX])
{
    const tn_part *it = tn_rule_part(p, part);
    const tn_module *module = p->schema->module;
    char condition[TN_CONDITION_TEXT_MAX];
    snprintf(words, TN_RULE_WORDS_MAX, "%s", is_every(p, it) ? "every" : sign_of(it->kind));
    if (it->kind == TN_PART_NEAR || it->kind == TN_PART_FAR)
        near_words(p, it, words);
    if (it->kind != TN_PART_QUANTITY && it->kind != TN_PART_SUM && it->kind != TN_PART_OCCURRENCES)
        return;
    bool own = own_condition(p, part, condition);
    if (!own)
        tn_condition_text(module, it->condition, condition);
    if (it->kind == TN_PART_SUM && !own) /* `total`, which has its bounds in its own words */
        tn_part_text(&p->parts, part, words, TN_RULE_WORDS_MAX);
    else if (it->kind == TN_PART_SUM)
        snprintf(words, TN_RULE_WORDS_MAX, "\xce\xa3 %.60s: %s", tn_text(module, module->FIELD_records[it->field].name),
                 condition);
    else
        snprintf(words, TN_RULE_WORDS_MAX, "%s%s", it->kind == TN_PART_OCCURRENCES ? "places: " : "", condition);
}

/* ---- lines */

void tn_draw_rule_box(cairo_t *context, double x, double y, tn_size s)
{
    cairo_rectangle(context, x, y, s.width, s.height);
    cairo_set_line_width(context, 0.9);
    cairo_stroke(context);
}

void tn_draw_rule_dashes(cairo_t *context, double x1, double y1, double x2, double y2)
{
    static const double dashes[] = {4, 3};
    cairo_save(context);
    cairo_set_dash(context, dashes, 2, 0);
    cairo_move_to(context, x1, y1);
    cairo_line_to(context, x2, y2);
    cairo_set_line_width(context, 0.6);
    cairo_stroke(context);
    cairo_restore(context);
}

/* A head at (x, y) that points to the left or right. */
static void arrow_head(cairo_t *context, double x, double y, double direction)
{
    cairo_move_to(context, x, y);
    cairo_line_to(context, x - direction * 5, y - 2.6);
    cairo_line_to(context, x - direction * 5, y + 2.6);
    cairo_close_path(context);
    cairo_fill(context);
}

void tn_draw_rule_arrow(cairo_t *context, double from, double to, double y)
{
    cairo_move_to(context, from, y);
    cairo_line_to(context, to, y);
    cairo_set_line_width(context, 0.8);
    cairo_stroke(context);
    arrow_head(context, to, y, to > from ? 1 : -1);
}

void tn_draw_neighbour_sign(cairo_t *context, double x, double y)
{
    cairo_rectangle(context, x, y, 5, 7.5);
    cairo_rectangle(context, x + 5, y, 5, 7.5);
    cairo_set_line_width(context, 0.9);
    cairo_stroke(context);
}

void tn_draw_symmetric_sign(cairo_t *context, double x, double y)
{
    tn_type_face(context, TN_RULE_SIGN_SIZE, true);
    tn_type_line(context, x + 2, y + 9.5, TN_ALIGN_LEFT, "or");
    tn_draw_rule_arrow(context, x + 7, x + 15, y);
    tn_draw_rule_arrow(context, x + 7, x - 1, y);
}

void tn_draw_plan_end(cairo_t *context, double x, double y, double height, bool left)
{
    double wall = left ? x + TN_RULE_END_WIDTH - 2 : x + 2, out = left ? -5 : 5;
    cairo_move_to(context, wall, y);
    cairo_line_to(context, wall, y + height);
    cairo_set_line_width(context, 2.2);
    cairo_stroke(context);
    for (double at = y + 3; at < y + height - 1; at += 5) {
        cairo_move_to(context, wall, at);
        cairo_line_to(context, wall + out, at + 4);
    }
    cairo_set_line_width(context, 0.5);
    cairo_stroke(context);
}

void tn_draw_check_mark(cairo_t *context, double x, double y)
{
    cairo_move_to(context, x - 4, y + 3);
    cairo_line_to(context, x - 1, y + 6.5);
    cairo_line_to(context, x + 5, y - 1);
    cairo_set_line_width(context, 1.4);
    cairo_stroke(context);
}

void tn_draw_tag(cairo_t *context, const char *name, double x, double y, tn_size s)
{
    double r = 6;
    cairo_new_sub_path(context);
    cairo_arc(context, x + s.width - 2 - r, y + 2 + r, r, -1.5707963, 0);
    cairo_arc(context, x + s.width - 2 - r, y + s.height - 2 - r, r, 0, 1.5707963);
    cairo_arc(context, x + 2 + r, y + s.height - 2 - r, r, 1.5707963, 3.1415927);
    cairo_arc(context, x + 2 + r, y + 2 + r, r, 3.1415927, 4.712389);
    cairo_close_path(context);
    cairo_set_line_width(context, 0.9);
    cairo_stroke(context);
    tn_type_face(context, TN_RULE_SIGN_SIZE, true);
    tn_type_line(context, x + s.width / 2, y + s.height / 2 + 3, TN_ALIGN_CENTRE, name);
}

void tn_draw_optional(cairo_t *context, double x, double y, tn_size s)
{
    static const double dashes[] = {2, 2};
    cairo_save(context);
    cairo_set_dash(context, dashes, 2, 0);
    cairo_rectangle(context, x + 1, y + 1, s.width - 2, s.height - 2);
    cairo_set_line_width(context, 0.8);
    cairo_stroke(context);
    cairo_restore(context);
    tn_type_face(context, TN_RULE_SIGN_SIZE - 1.5, false);
    tn_type_line(context, x + s.width / 2, y + 9, TN_ALIGN_CENTRE, "or none");
}
