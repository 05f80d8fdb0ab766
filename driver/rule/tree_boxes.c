#include "driver/rule/tree_boxes.h"

#include <stdlib.h>
#include <string.h>

#include "driver/rule/tray_fields.h"
#include "runtime/base/buffer.h"

typedef struct making {
    const tn_rule_tree *tree;
    const tn_module *module;
    uint32_t file;
    tn_rule_boxes *boxes;
    tn_error *error;
} making;

static const tn_rule_box plain = {.number = TN_NO_BOX_NUMBER,
                                  .spec = UINT32_MAX,
                                  .beginning_number = TN_NO_BOX_NUMBER,
                                  .end_number = TN_NO_BOX_NUMBER};

static tn_status add_parts(making *m, uint32_t part, uint32_t box);
static tn_status add_part(making *m, uint32_t number, uint32_t parent);

/* ---- words */

/* A stretch of the text, blanks and line ends as one blank each, without comments. */
static void write_text(const making *m, uint32_t begin, uint32_t end, tn_buffer *to)
{
    const tn_rule_text *text = m->tree->text;
    size_t comment = 0;
    size_t used = to->size;
    bool blank = false;
    for (uint32_t i = begin; i < end; i++) {
        while (comment < text->comment_count && text->comments[comment].span.end <= i)
            comment++;
        bool commented = comment < text->comment_count && text->comments[comment].span.begin <= i;
        if (commented || strchr(" \t\r\n", text->text[i])) {
            blank = true;
            continue;
        }
        if (blank && to->size > used)
            tn_buffer_append(to, " ", 1);
        blank = false;
        tn_buffer_append(to, &text->text[i], 1);
    }
}

static void write_condition(const making *m, const tn_rule_part *part, tn_buffer *to)
{
    tn_span span = part->expr->condition->node.span;
    if (part->kind == TN_RULE_PART_OCCURRENCES)
        tn_buffer_printf(to, "places: ");
    if (part->kind == TN_RULE_PART_SUM) {
        tn_span figure = part->expr->figure->node.span;
        tn_buffer_printf(to, "\xce\xa3 ");
        write_text(m, figure.begin, figure.end, to);
        tn_buffer_printf(to, ": ");
    }
    write_text(m, span.begin, span.end, to);
}

/* The words between the parts of a relation: "within 12m of". */
static void write_relation(const making *m, const tn_rule_part *part, tn_buffer *to)
{
    const tn_rule_part *parts = m->tree->parts;
    write_text(m, parts[part->first].outer.end, parts[part->last].outer.begin, to);
}

/* "some a, b in width:" */
static void write_quantifier(const tn_rule_part *part, tn_buffer *to)
{
    const char *between = " ";
    tn_buffer_printf(to, "%s", part->kind == TN_RULE_PART_SOME ? "some" : "every");
    for (TN_EACH(const tn_ast_word, word, part->expr->names)) {
        tn_buffer_printf(to, "%s%s", between, word->text);
        between = ", ";
    }
    tn_buffer_printf(to, " in %s:", part->expr->name->text);
}

/* The items of a tray, a line each. */
static void write_items(const making *m, const tn_rule_part *part, tn_buffer *to)
{
    for (TN_EACH(const tn_ast_item, item, part->expr->items)) {
        tn_buffer line = {0};
        write_text(m, item->node.span.begin, item->node.span.end, &line);
        tn_buffer_printf(to, "%s%s", to->size ? "\n" : "", line.data ? line.data : "");
        free(line.data);
    }
}

static void write_words(const making *m, const tn_rule_part *part, tn_buffer *to)
{
    switch (part->kind) {
    case TN_RULE_PART_MANY:
    case TN_RULE_PART_GAP:
        tn_buffer_printf(to, "one or more, each:");
        break;
    case TN_RULE_PART_AND:
    case TN_RULE_PART_OR:
    case TN_RULE_PART_NOT:
    case TN_RULE_PART_WHERE:
    case TN_RULE_PART_IMPLIES:
    case TN_RULE_PART_EVERY:
        tn_buffer_printf(to, "%s", tn_rule_part_word(part->kind));
        break;
    case TN_RULE_PART_EVERY_NEAR:
        tn_buffer_printf(to, "every");
        break;
    case TN_RULE_PART_NEAR:
        write_relation(m, part, to);
        break;
    case TN_RULE_PART_CALL:
        tn_buffer_printf(to, "%s", part->expr->name->text);
        break;
    case TN_RULE_PART_SOME:
    case TN_RULE_PART_EACH:
        write_quantifier(part, to);
        break;
    case TN_RULE_PART_QUANTITY:
    case TN_RULE_PART_OCCURRENCES:
    case TN_RULE_PART_SUM:
        write_condition(m, part, to);
        break;
    case TN_RULE_PART_NAME:
    case TN_RULE_PART_TEXT:
        write_text(m, part->own.begin, part->own.end, to);
        break;
    default:
        break;
    }
}

/* ---- boxes */

static tn_status add_box(making *m, uint32_t parent, tn_rule_box box, const tn_buffer *words, uint32_t *added)
{
    if (words && words->failed)
        return tn_fail_memory(m->error);
    return tn_rule_box_add(m->boxes, parent, box, words && words->data ? words->data : "", added, m->error);
}

/* A tray as its symbol, or, if words that a quantifier binds leave open what it is, as its words. */
static tn_status add_tray(making *m, uint32_t number, uint32_t parent, tn_rule_box box)
{
    const tn_rule_part *part = &m->tree->parts[number];
    tn_buffer words = {0};
    uint32_t added;
    box.spec = tn_tray_spec(m->module, m->file, part->own);
    box.kind = box.spec == UINT32_MAX ? TN_BOX_LABEL : TN_BOX_TRAY;
    if (box.kind == TN_BOX_LABEL)
        write_items(m, part, &words);
    tn_status status = add_box(m, parent, box, &words, &added);
    free(words.data);
    return status;
}

/* `...`: one or more trays of any kind, or none. It is one part. */
static tn_status add_gap(making *m, uint32_t number, uint32_t parent, tn_rule_box box)
{
    const tn_rule_part *part = &m->tree->parts[number];
    tn_buffer words = {0};
    uint32_t added, inside;
    tn_rule_box any = plain;
    write_words(m, part, &words);
    box.kind = TN_BOX_ROW;
    box.framed = box.optional = box.alone = true;
    any.spec = tn_tray_spec(m->module, m->file, part->own);
    any.kind = any.spec == UINT32_MAX ? TN_BOX_LABEL : TN_BOX_TRAY;
    tn_status status = add_box(m, parent, box, &words, &added);
    if (status == TN_OK)
        status = add_box(m, added, any, NULL, &inside);
    free(words.data);
    return status;
}

/* `every a beside b` is `every` around the relation. */
static tn_status add_every_near(making *m, uint32_t number, uint32_t parent, tn_rule_box box)
{
    const tn_rule_part *part = &m->tree->parts[number];
    tn_buffer every = {0}, relation = {0};
    tn_rule_box near = plain;
    uint32_t added, inside;
    write_words(m, part, &every);
    write_relation(m, part, &relation);
    box.kind = near.kind = TN_BOX_ROW;
    box.framed = box.alone = near.framed = true;
    tn_status status = add_box(m, parent, box, &every, &added);
    if (status == TN_OK)
        status = add_box(m, added, near, &relation, &inside);
    if (status == TN_OK)
        status = add_parts(m, number, inside);
    free(every.data);
    free(relation.data);
    return status;
}

/* The ends of the plan are walls of the row, and boxes of their own nowhere. */
static void tie_ends(const making *m, uint32_t number, tn_rule_box *box)
{
    uint32_t trays = 0;
    for (uint32_t child = m->tree->parts[number].first; child != TN_NO_RULE_PART; child = m->tree->parts[child].next) {
        tn_rule_part_kind kind = m->tree->parts[child].kind;
        if (kind == TN_RULE_PART_BEGINNING) {
            box->beginning = true;
            box->beginning_number = child;
        } else if (kind == TN_RULE_PART_END) {
            box->end = true;
            box->end_number = child;
        } else {
            trays++;
        }
    }
    box->alone = trays == 1;
}

static tn_rule_box_kind kind_of(tn_rule_part_kind kind)
{
    switch (kind) {
    case TN_RULE_PART_NAME:
    case TN_RULE_PART_TEXT:
        return TN_BOX_TAG;
    case TN_RULE_PART_OR:
        return TN_BOX_STACK;
    case TN_RULE_PART_NEIGHBOUR:
        return TN_BOX_NEIGHBOUR;
    case TN_RULE_PART_SYMMETRIC:
        return TN_BOX_SYMMETRIC;
    case TN_RULE_PART_DISTANCE:
        return TN_BOX_DISTANCE;
    default:
        return TN_BOX_ROW;
    }
}

static bool is_separator(const making *m, uint32_t number)
{
    const tn_rule_part *part = &m->tree->parts[number];
    return part->parent != TN_NO_RULE_PART && m->tree->parts[part->parent].kind == TN_RULE_PART_DISTANCE &&
           part->index == 2 && kind_of(part->kind) != TN_BOX_TAG;
}

static tn_status add_framed(making *m, uint32_t number, uint32_t parent, tn_rule_box box)
{
    const tn_rule_part *part = &m->tree->parts[number];
    tn_buffer words = {0};
    uint32_t added;
    bool inside = part->kind == TN_RULE_PART_NEIGHBOUR && part->parent != TN_NO_RULE_PART;
    box.kind = kind_of(part->kind);
    box.separator = is_separator(m, number);
    box.framed = box.kind != TN_BOX_TAG && !box.separator && !inside && part->kind != TN_RULE_PART_OPTIONAL;
    box.optional = part->kind == TN_RULE_PART_OPTIONAL;
    box.centred =
        part->kind == TN_RULE_PART_QUANTITY || part->kind == TN_RULE_PART_OCCURRENCES || part->kind == TN_RULE_PART_SUM;
    box.alone = part->count == 1;
    if (part->kind == TN_RULE_PART_NEIGHBOUR)
        tie_ends(m, number, &box);
    write_words(m, part, &words);
    tn_status status = add_box(m, parent, box, &words, &added);
    free(words.data);
    return status == TN_OK && box.kind != TN_BOX_TAG ? add_parts(m, number, added) : status;
}

static tn_status add_part(making *m, uint32_t number, uint32_t parent)
{
    tn_rule_box box = plain;
    box.number = number;
    switch (m->tree->parts[number].kind) {
    case TN_RULE_PART_TRAY:
    case TN_RULE_PART_ANY:
        box.separator = is_separator(m, number);
        return add_tray(m, number, parent, box);
    case TN_RULE_PART_GAP:
        return add_gap(m, number, parent, box);
    case TN_RULE_PART_EVERY_NEAR:
        return add_every_near(m, number, parent, box);
    default:
        return add_framed(m, number, parent, box);
    }
}

static tn_status add_parts(making *m, uint32_t part, uint32_t box)
{
    tn_status status = TN_OK;
    for (uint32_t child = m->tree->parts[part].first; status == TN_OK && child != TN_NO_RULE_PART;
         child = m->tree->parts[child].next) {
        tn_rule_part_kind kind = m->tree->parts[child].kind;
        if (kind != TN_RULE_PART_BEGINNING && kind != TN_RULE_PART_END)
            status = add_part(m, child, box);
    }
    return status;
}

tn_status tn_tree_boxes(const tn_rule_tree *tree, const tn_module *module, uint32_t file, tn_rule_boxes *boxes,
                        tn_error *error)
{
    making m = {tree, module, file, boxes, error};
    *boxes = (tn_rule_boxes){0};
    return add_part(&m, 0, TN_NO_BOX);
}
