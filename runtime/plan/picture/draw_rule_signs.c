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

void tn_draw_rule_box(tn_paint *paint, double x, double y, tn_size s)
{
    tn_paint_rectangle(paint, x, y, s.width, s.height);
    tn_paint_line_width(paint, 0.9);
    tn_paint_stroke(paint);
}

void tn_draw_rule_dashes(tn_paint *paint, double x1, double y1, double x2, double y2)
{
    static const double dashes[] = {4, 3};
    tn_paint_save(paint);
    tn_paint_dash(paint, dashes, 2, 0);
    tn_paint_move_to(paint, x1, y1);
    tn_paint_line_to(paint, x2, y2);
    tn_paint_line_width(paint, 0.6);
    tn_paint_stroke(paint);
    tn_paint_restore(paint);
}

/* A head at (x, y) that points to the left or right. */
static void arrow_head(tn_paint *paint, double x, double y, double direction)
{
    tn_paint_move_to(paint, x, y);
    tn_paint_line_to(paint, x - direction * 5, y - 2.6);
    tn_paint_line_to(paint, x - direction * 5, y + 2.6);
    tn_paint_close_path(paint);
    tn_paint_fill(paint);
}

void tn_draw_rule_arrow(tn_paint *paint, double from, double to, double y)
{
    tn_paint_move_to(paint, from, y);
    tn_paint_line_to(paint, to, y);
    tn_paint_line_width(paint, 0.8);
    tn_paint_stroke(paint);
    arrow_head(paint, to, y, to > from ? 1 : -1);
}

void tn_draw_neighbour_sign(tn_paint *paint, double x, double y)
{
    tn_paint_rectangle(paint, x, y, 5, 7.5);
    tn_paint_rectangle(paint, x + 5, y, 5, 7.5);
    tn_paint_line_width(paint, 0.9);
    tn_paint_stroke(paint);
}

void tn_draw_symmetric_sign(tn_paint *paint, double x, double y)
{
    tn_paint_face(paint, TN_RULE_SIGN_SIZE, true);
    tn_type_line(paint, x + 2, y + 9.5, TN_ALIGN_LEFT, "or");
    tn_draw_rule_arrow(paint, x + 7, x + 15, y);
    tn_draw_rule_arrow(paint, x + 7, x - 1, y);
}

void tn_draw_plan_end(tn_paint *paint, double x, double y, double height, bool left)
{
    double wall = left ? x + TN_RULE_END_WIDTH - 2 : x + 2, out = left ? -5 : 5;
    tn_paint_move_to(paint, wall, y);
    tn_paint_line_to(paint, wall, y + height);
    tn_paint_line_width(paint, 2.2);
    tn_paint_stroke(paint);
    for (double at = y + 3; at < y + height - 1; at += 5) {
        tn_paint_move_to(paint, wall, at);
        tn_paint_line_to(paint, wall + out, at + 4);
    }
    tn_paint_line_width(paint, 0.5);
    tn_paint_stroke(paint);
}

void tn_draw_check_mark(tn_paint *paint, double x, double y)
{
    tn_paint_move_to(paint, x - 4, y + 3);
    tn_paint_line_to(paint, x - 1, y + 6.5);
    tn_paint_line_to(paint, x + 5, y - 1);
    tn_paint_line_width(paint, 1.4);
    tn_paint_stroke(paint);
}

void tn_draw_tag(tn_paint *paint, const char *name, double x, double y, tn_size s)
{
    double r = 6;
    tn_paint_new_sub_path(paint);
    tn_paint_arc(paint, x + s.width - 2 - r, y + 2 + r, r, -1.5707963, 0);
    tn_paint_arc(paint, x + s.width - 2 - r, y + s.height - 2 - r, r, 0, 1.5707963);
    tn_paint_arc(paint, x + 2 + r, y + s.height - 2 - r, r, 1.5707963, 3.1415927);
    tn_paint_arc(paint, x + 2 + r, y + 2 + r, r, 3.1415927, 4.712389);
    tn_paint_close_path(paint);
    tn_paint_line_width(paint, 0.9);
    tn_paint_stroke(paint);
    tn_paint_face(paint, TN_RULE_SIGN_SIZE, true);
    tn_type_line(paint, x + s.width / 2, y + s.height / 2 + 3, TN_ALIGN_CENTRE, name);
}

void tn_draw_optional(tn_paint *paint, double x, double y, tn_size s)
{
    static const double dashes[] = {2, 2};
    tn_paint_save(paint);
    tn_paint_dash(paint, dashes, 2, 0);
    tn_paint_rectangle(paint, x + 1, y + 1, s.width - 2, s.height - 2);
    tn_paint_line_width(paint, 0.8);
    tn_paint_stroke(paint);
    tn_paint_restore(paint);
    tn_paint_face(paint, TN_RULE_SIGN_SIZE - 1.5, false);
    tn_type_line(paint, x + s.width / 2, y + 9, TN_ALIGN_CENTRE, "or none");
}
