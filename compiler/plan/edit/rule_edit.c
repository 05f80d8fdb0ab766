#include "compiler/plan/edit/rule_edit.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/plan/edit/rule_layout.h"
#include "compiler/plan/edit/text_changes.h"
#include "runtime/base/nearest.h"

/* One edit on the way. */
typedef struct editing {
    const tn_rule_tree *tree;
    const tn_rule_edit *edit;
    tn_rule_part part; /* that it is about */
    tn_text_changes changes;
    tn_text_stretch about; /* of the old text: where it is what the edit was about afterwards */
    tn_binding binds;      /* of `with` */
    char *with;            /* owned */
    char *why;
} editing;

__attribute__((format(printf, 2, 3))) static void refuse(editing *e, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(e->why, TN_WHY_MAX, format, args);
    va_end(args);
}

static bool is_of_word(char byte)
{
    return isalnum((unsigned char)byte) || (unsigned char)byte >= 0x80 || (byte && strchr("_-.'\"%", byte));
}

/* Adds a change, with blanks where words would else come to stand together: the parenthesis of `not(a)` may go. */
static void add_change(editing *e, tn_text_stretch replaced, const char *insert, tn_text_stretch put)
{
    const tn_rule_text *text = e->tree->text;
    size_t size = strlen(insert);
    tn_buffer apart = {0};
    bool word_before = replaced.begin > 0 && is_of_word(text->text[replaced.begin - 1]),
         word_behind = replaced.end < text->size && is_of_word(text->text[replaced.end]),
         first = word_before && (size > 0 ? is_of_word(*insert) : word_behind && replaced.begin < replaced.end),
         last = size > 0 && word_behind && is_of_word(insert[size - 1]);
    tn_buffer_printf(&apart, "%s%s%s", first ? " " : "", insert, last ? " " : "");
    if (first && put.end > 0)
        put = (tn_text_stretch){put.begin + 1, put.end + 1};
    e->changes.failed |= apart.failed;
    if (!apart.failed)
        tn_text_change_add(&e->changes, replaced, apart.data, put);
    free(apart.data);
}

static void change(editing *e, uint32_t begin, uint32_t end, const char *insert)
{
    add_change(e, (tn_text_stretch){begin, end}, insert, (tn_text_stretch){0});
}

/* ---- parentheses */

static bool has_parentheses(const tn_rule_part *part)
{
    return part->own.begin != part->outer.begin;
}

/* Puts the stretch into parentheses if what `binds` so stands where what it stands in `needs` more. */
static void enclose(editing *e, tn_text_stretch stretch, tn_binding binds, tn_binding needs)
{
    if (binds >= needs)
        return;
    change(e, stretch.begin, stretch.begin, "(");
    change(e, stretch.end, stretch.end, ")");
}

static void enclose_part(editing *e, const tn_rule_part *part, tn_binding needs)
{
    if (!has_parentheses(part))
        enclose(e, part->own, part->binds, needs);
}

/* `with` as it stands where so much is needed (malloc); NULL: out of memory. */
static char *enclosed(const editing *e, tn_binding needs)
{
    tn_buffer text = {0};
    tn_buffer_printf(&text, e->binds < needs ? "(%s)" : "%s", e->with);
    return text.data;
}

/* Puts before, `with` and behind into the text at one place: it is what the edit is about. */
static void put(editing *e, uint32_t begin, uint32_t end, const char *before, const char *behind, tn_binding needs)
{
    tn_buffer text = {0};
    char *with = enclosed(e, needs);
    bool good = with && tn_buffer_printf(&text, "%s%s%s", before, with, behind);
    uint32_t from = (uint32_t)strlen(before);
    if (good)
        add_change(e, (tn_text_stretch){begin, end}, text.data, (tn_text_stretch){from, from + (uint32_t)strlen(with)});
    e->changes.failed |= !good;
    free(with);
    free(text.data);
}

/* ---- items of trays */

static const tn_ast_item *item_of(editing *e)
{
    uint32_t count = 0;
    if (e->part.kind != TN_RULE_PART_TRAY) {
        refuse(e, "only a tray has items");
        return NULL;
    }
    for (TN_EACH(const tn_ast_item, it, e->part.expr->items))
        if (count++ == e->edit->item)
            return it;
    refuse(e, "the tray has %u item%s", count, count == 1 ? "" : "s");
    return NULL;
}

static void set_item(editing *e)
{
    const tn_ast_item *item = item_of(e);
    if (item)
        change(e, item->node.span.begin, item->node.span.end, e->with);
}

/* With the comma before it, or, of the first, the one behind it. */
static void clear_item(editing *e)
{
    const tn_ast_item *item = item_of(e), *before = NULL;
    if (!item)
        return;
    for (TN_EACH(const tn_ast_item, it, e->part.expr->items)) {
        if (it == item)
            break;
        before = it;
    }
    const tn_ast_node *behind = item->node.next;
    if (before)
        change(e, before->node.span.end, item->node.span.end, "");
    else if (behind)
        change(e, item->node.span.begin, behind->span.begin, "");
    else
        change(e, e->part.own.begin, e->part.own.end, "any");
}

static void add_item(editing *e)
{
    const tn_rule_part *part = &e->part;
    uint32_t item = e->edit->item;
    const tn_ast_node *before = NULL, *behind = part->expr->items.first;
    for (; behind && item > 0; item--) {
        before = behind;
        behind = behind->next;
    }
    if (part->kind == TN_RULE_PART_ANY)
        put(e, part->own.begin, part->own.end, "tray(", ")", TN_BINDS_NOTHING);
    else if (part->kind != TN_RULE_PART_TRAY)
        refuse(e, "only a tray has items");
    else if (behind)
        put(e, behind->span.begin, behind->span.begin, "", ", ", TN_BINDS_NOTHING);
    else if (before)
        put(e, before->span.end, before->span.end, ", ", "", TN_BINDS_NOTHING);
    else
        put(e, part->own.end - 1, part->own.end - 1, "", "", TN_BINDS_NOTHING);
}

/* ---- boxes */

/* What each box puts before and behind its part, and how tightly the part has to hold together in it. */
static const struct box {
    const char *before, *behind;
    tn_binding binds, holds;
} boxes[] = {{"not ", "", TN_BINDS_NOT, TN_BINDS_NOT},
             {"symmetric ", "", TN_BINDS_PRIMARY, TN_BINDS_PRIMARY},
             {"quantity(", ", n >= 1)", TN_BINDS_PRIMARY, TN_BINDS_NOTHING},
             {"occurrences(", ", n >= 1)", TN_BINDS_PRIMARY, TN_BINDS_NOTHING},
             {"many(", ")", TN_BINDS_PRIMARY, TN_BINDS_NOTHING},
             {"neighbour(", ")", TN_BINDS_PRIMARY, TN_BINDS_NOTHING},
             {"optional(", ")", TN_BINDS_PRIMARY, TN_BINDS_NOTHING},
             {"distance(from ", ", to any, by quantity(any, n >= 1))", TN_BINDS_PRIMARY, TN_BINDS_NOTHING}};

const char *const tn_rule_wraps[] = {"not",       "symmetric", "quantity", "occurrences", "many",
                                     "neighbour", "optional",  "distance", NULL};

static bool is_of_row(tn_rule_part_kind kind)
{
    return kind == TN_RULE_PART_BEGINNING || kind == TN_RULE_PART_END || kind == TN_RULE_PART_GAP;
}

static void put_box(editing *e, const struct box *box, tn_text_stretch outer)
{
    change(e, outer.begin, outer.begin, box->before);
    enclose_part(e, &e->part, box->holds);
    change(e, outer.end, outer.end, box->behind);
}

/* The parentheses that are there become those of the box: `(a or b)`, `many(a or b)`. */
static void put_call(editing *e, const char *word, const char *behind, tn_text_stretch outer)
{
    char text[40];
    snprintf(text, sizeof text, "%.*s", (int)strlen(behind) - 1, behind);
    change(e, outer.begin, outer.begin, word);
    change(e, outer.end - 1, outer.end - 1, text);
}

static void wrap(editing *e)
{
    tn_binding needs = tn_rule_part_needs(e->tree, e->edit->part);
    size_t i = 0;
    while (tn_rule_wraps[i] && strcmp(tn_rule_wraps[i], e->edit->by) != 0)
        i++;
    if (!tn_rule_wraps[i]) {
        char all[160];
        tn_word_list(tn_rule_wraps, i, all, sizeof all);
        refuse(e, "there is no box `%.60s`: the boxes are %s", e->edit->by, all);
        return;
    }
    if (is_of_row(e->part.kind)) {
        refuse(e, "`%s` stands in a row by itself, and in no box",
               e->part.kind == TN_RULE_PART_GAP ? "..." : tn_rule_part_word(e->part.kind));
        return;
    }
    const struct box *box = &boxes[i];
    tn_text_stretch outer = e->part.outer;
    bool inside = box->binds < needs;
    if (inside)
        change(e, outer.begin, outer.begin, "(");
    if (has_parentheses(&e->part) && strcmp(box->before + strlen(tn_rule_wraps[i]), "(") == 0)
        put_call(e, tn_rule_wraps[i], box->behind, outer);
    else
        put_box(e, box, outer);
    if (inside)
        change(e, outer.end, outer.end, ")");
}

/* Takes away all of a part but one of those in it. */
static void keep_only(editing *e, const tn_rule_part *box, const tn_rule_part *kept)
{
    change(e, box->outer.begin, kept->outer.begin, "");
    if (!has_parentheses(kept))
        enclose(e, kept->outer, kept->binds, tn_rule_part_needs(e->tree, (uint32_t)(box - e->tree->parts)));
    change(e, kept->outer.end, box->outer.end, "");
}

static const char GAP_ALONE[] = "`...` can only stand in a row of neighbours";

/* Does the part stand in a row of neighbours? */
static bool in_neighbour(const editing *e)
{
    uint32_t parent = e->part.parent;
    return parent != TN_NO_RULE_PART && e->tree->parts[parent].kind == TN_RULE_PART_NEIGHBOUR;
}

static uint32_t part_at(const editing *e)
{
    return e->edit->at == TN_NO_RULE_PART ? e->part.last : tn_rule_part_child(e->tree, e->edit->part, e->edit->at);
}

static void unwrap(editing *e)
{
    if (e->part.count == 0) {
        refuse(e, "there is nothing in it that could stay");
        return;
    }
    uint32_t kept = part_at(e);
    if (kept == TN_NO_RULE_PART)
        refuse(e, "it has %u part%s", e->part.count, e->part.count == 1 ? "" : "s");
    else if (e->tree->parts[kept].kind == TN_RULE_PART_GAP && !in_neighbour(e))
        refuse(e, "%s", GAP_ALONE);
    else
        keep_only(e, &e->tree->parts[e->edit->part], &e->tree->parts[kept]);
}

/* ---- rows and places */

static const char *separator(tn_rule_part_kind row)
{
    return row == TN_RULE_PART_AND ? " and " : row == TN_RULE_PART_OR ? " or " : ", ";
}

/* `with` becomes the index-th of a row's parts. */
static void insert_into(editing *e, const tn_rule_part *row, uint32_t index)
{
    const tn_rule_part *parts = e->tree->parts;
    uint32_t self = (uint32_t)(row - parts), behind = tn_rule_part_child(e->tree, self, index);
    const char *between = separator(row->kind);
    tn_binding needs = tn_rule_part_holds(row->kind);
    uint32_t at = behind == TN_NO_RULE_PART ? parts[row->last].outer.end : parts[behind].outer.begin;
    bool last = behind == TN_NO_RULE_PART;
    put(e, at, at, last ? between : "", last ? "" : between, needs);
}

/* Has `with` all that the edit needs? `neighbours`: it comes to stand in a row of them. */
static bool is_given(editing *e, bool neighbours)
{
    if (!e->with)
        refuse(e, "say what is put there: a text, or a part of the rule");
    else if (!neighbours && strcmp(e->with, "...") == 0)
        refuse(e, "%s", GAP_ALONE);
    return !*e->why;
}

/* Between the ends of the plan that a row of neighbours has, unless it is an end that is put there. */
static uint32_t inside_ends(const editing *e)
{
    const tn_rule_part *parts = e->tree->parts;
    bool end = strcmp(e->with, "end") == 0, beginning = strcmp(e->with, "beginning") == 0;
    uint32_t least = !beginning && parts[e->part.first].kind == TN_RULE_PART_BEGINNING ? 1 : 0,
             most = e->part.count - (!end && parts[e->part.last].kind == TN_RULE_PART_END ? 1 : 0), at = e->edit->at;
    return at > most ? most : at < least ? least : at;
}

static void insert(editing *e)
{
    if (!is_given(e, e->part.kind == TN_RULE_PART_NEIGHBOUR))
        return;
    if (tn_rule_part_form_of(e->part.kind) == TN_RULE_PART_ROW) {
        insert_into(e, &e->tree->parts[e->edit->part], inside_ends(e));
        return;
    }
    uint32_t place = e->part.count ? part_at(e) : TN_NO_RULE_PART;
    if (place == TN_NO_RULE_PART && e->part.count)
        refuse(e, "it has %u place%s", e->part.count, e->part.count == 1 ? "" : "s");
    else if (place == TN_NO_RULE_PART)
        refuse(e, "it has no places for parts; put something beside it, or in its place");
    else if (e->edit->from == place)
        refuse(e, "it is there already");
    else if (e->edit->from != TN_NO_RULE_PART && tn_rule_part_within(e->tree, e->edit->from, place))
        refuse(e, "it stands in what it would replace: unwrap that, so that only this stays");
    if (*e->why)
        return;
    const tn_rule_part *old = &e->tree->parts[place];
    put(e, old->outer.begin, old->outer.end, "", "", tn_rule_part_holds(e->part.kind));
}

static void join(editing *e)
{
    const tn_rule_part *parts = e->tree->parts, *part = &parts[e->edit->part];
    bool both = strcmp(e->edit->by, "and") == 0, either = strcmp(e->edit->by, "or") == 0;
    tn_rule_part_kind kind = both ? TN_RULE_PART_AND : TN_RULE_PART_OR;
    const tn_rule_part *parent = part->parent == TN_NO_RULE_PART ? NULL : &parts[part->parent];
    if (!both && !either) {
        refuse(e, "parts are joined by `and` or by `or`");
        return;
    }
    if (!is_given(e, false))
        return;
    if (e->edit->from != TN_NO_RULE_PART && is_of_row(parts[e->edit->from].kind)) {
        refuse(e, "what stands in a row of neighbours by itself can only be moved there");
        return;
    }
    if (parent && parent->kind == kind) {
        insert_into(e, parent, part->index + (e->edit->before ? 0 : 1));
        return;
    }
    if (part->kind == kind) {
        insert_into(e, part, e->edit->before ? 0 : part->count);
        return;
    }
    tn_binding binds = both ? TN_BINDS_AND : TN_BINDS_OR, holds = tn_rule_part_holds(kind),
               needs = tn_rule_part_needs(e->tree, e->edit->part);
    uint32_t at = e->edit->before ? part->outer.begin : part->outer.end;
    if (binds < needs)
        change(e, part->outer.begin, part->outer.begin, "(");
    if (e->edit->before)
        put(e, at, at, "", separator(kind), holds);
    enclose_part(e, part, holds);
    if (!e->edit->before)
        put(e, at, at, separator(kind), "", holds);
    if (binds < needs)
        change(e, part->outer.end, part->outer.end, ")");
}

static void remove_part(editing *e)
{
    const tn_rule_part *parts = e->tree->parts, *part = &parts[e->edit->part];
    const tn_rule_part *parent = part->parent == TN_NO_RULE_PART ? NULL : &parts[part->parent];
    bool row = parent && tn_rule_part_form_of(parent->kind) == TN_RULE_PART_ROW && parent->count > 1;
    e->about = parent ? parent->outer : part->outer;
    if (!row) {
        change(e, part->outer.begin, part->outer.end, "any");
        e->about = part->outer;
    } else if (parent->count == 2 && parent->kind != TN_RULE_PART_NEIGHBOUR) {
        keep_only(e, parent, &parts[part->index ? parent->first : parent->last]);
    } else if (part->index > 0) {
        uint32_t before = tn_rule_part_child(e->tree, part->parent, part->index - 1);
        change(e, parts[before].outer.end, part->outer.end, "");
    } else {
        change(e, part->outer.begin, parts[part->next].outer.begin, "");
    }
}

/* ---- what is written */

static void set_condition(editing *e)
{
    tn_text_stretch condition = tn_rule_part_condition(e->tree, e->edit->part);
    if (condition.end == 0)
        refuse(e, "only what is counted or added up has a condition");
    else
        change(e, condition.begin, condition.end, e->with);
}

static void set_text(editing *e)
{
    if (is_given(e, in_neighbour(e)))
        put(e, e->part.outer.begin, e->part.outer.end, "", "", tn_rule_part_needs(e->tree, e->edit->part));
}

static void (*const operations[TN_RULE_OPERATIONS])(editing *) = {
    [TN_RULE_SET] = set_item,  [TN_RULE_CLEAR] = clear_item,   [TN_RULE_ADD] = add_item,
    [TN_RULE_WRAP] = wrap,     [TN_RULE_UNWRAP] = unwrap,      [TN_RULE_JOIN] = join,
    [TN_RULE_INSERT] = insert, [TN_RULE_REMOVE] = remove_part, [TN_RULE_CONDITION] = set_condition,
    [TN_RULE_TEXT] = set_text,
};

/* ---- one edit of a tree */

static tn_given_kind given_as(tn_rule_operation operation)
{
    return operation == TN_RULE_CONDITION                         ? TN_GIVEN_CONDITION
           : operation == TN_RULE_SET || operation == TN_RULE_ADD ? TN_GIVEN_ITEM
                                                                  : TN_GIVEN_PART;
}

/* `with`: the text that is given, or that of the part which is moved. */
static tn_status take_with(editing *e, tn_error *error)
{
    const tn_rule_edit *edit = e->edit;
    if (edit->from != TN_NO_RULE_PART) {
        const tn_rule_part *from = &e->tree->parts[edit->from];
        e->binds = from->binds;
        e->with = strndup(e->tree->text->text + from->own.begin, from->own.end - from->own.begin);
        return e->with ? TN_OK : tn_fail_memory(error);
    }
    if (!edit->text)
        return TN_OK;
    tn_status status = tn_given_text_check(given_as(edit->operation), edit->text, &e->binds, e->why, error);
    e->with = strdup(edit->text);
    return status == TN_OK && !e->with ? tn_fail_memory(error) : status;
}

/* Changes the text, or says why not. */
static tn_status change_text(editing *e, tn_buffer *text, tn_text_stretch *about, tn_error *error)
{
    tn_status status = take_with(e, error);
    if (status != TN_OK || *e->why)
        return status;
    bool written = e->edit->operation == TN_RULE_SET || e->edit->operation == TN_RULE_ADD ||
                   e->edit->operation == TN_RULE_CONDITION;
    if (written && !e->with)
        refuse(e, "say what is written there");
    else
        operations[e->edit->operation](e);
    if (*e->why)
        return TN_OK;
    if (!tn_text_changes_put(&e->changes, e->tree, about))
        *about = tn_text_changes_map(&e->changes, e->tree, e->about);
    return tn_text_changes_make(&e->changes, e->tree, text, error);
}

/* What stands in a row may stand where it does, if it did so before. */
static const char *misplaced(const tn_rule_tree *tree)
{
    for (uint32_t i = 0; i < tree->count; i++) {
        const tn_rule_part *part = &tree->parts[i];
        if (!is_of_row(part->kind))
            continue;
        bool row = part->parent != TN_NO_RULE_PART && tree->parts[part->parent].kind == TN_RULE_PART_NEIGHBOUR;
        if (part->kind == TN_RULE_PART_BEGINNING && !(row && part->index == 0))
            return "`beginning` can only stand first in a row of neighbours";
        if (part->kind == TN_RULE_PART_END && !(row && part->next == TN_NO_RULE_PART))
            return "`end` can only stand last in a row of neighbours";
        if (!row)
            return "`...` can only stand in a row of neighbours";
    }
    return NULL;
}

/* Reads the changed text and finds the rule in it, which `why` says if that is not possible. */
static tn_status read_changed(const tn_buffer *text, const char *rule, tn_rule_text *read, tn_rule_tree *tree,
                              char *why, tn_error *error)
{
    tn_status status = tn_rule_text_read(text->data, text->size, read, error);
    const tn_ast_rule *found = status == TN_OK && read->parses ? tn_rule_text_find(read, rule) : NULL;
    if (status != TN_OK)
        return status;
    if (found)
        return tn_rule_tree_make(read, found, tree, error);
    snprintf(why, TN_WHY_MAX, "the rule could not be read afterwards: %.300s",
             read->mistake ? read->mistake : "it is not there");
    return TN_OK;
}

/* Takes away what was moved from where it was. */
static tn_status take_away(const tn_rule_tree *tree, tn_text_stretch moved, tn_buffer *text, tn_text_stretch *about,
                           char *why, tn_error *error)
{
    const tn_rule_edit removal = {
        .operation = TN_RULE_REMOVE, .part = tn_rule_part_placed(tree, moved), .from = TN_NO_RULE_PART};
    if (removal.part == TN_NO_RULE_PART) {
        snprintf(why, TN_WHY_MAX, "it cannot be moved there");
        return TN_OK;
    }
    editing e = {.tree = tree, .edit = &removal, .part = tree->parts[removal.part], .why = why};
    e.changes.moved = e.part.own;
    remove_part(&e);
    *about = tn_text_changes_shift(&e.changes, tree, *about);
    tn_status status = tn_text_changes_make(&e.changes, tree, text, error);
    tn_text_changes_clear(&e.changes);
    return status;
}

/* The second half of moving: the part stands where it was dropped, and where it was. */
static tn_status finish_move(const char *rule, tn_text_stretch moved, tn_buffer *text, tn_text_stretch *about,
                             char *why, tn_error *error)
{
    tn_rule_text read = {0};
    tn_rule_tree tree = {0};
    tn_buffer made = {0};
    tn_status status = read_changed(text, rule, &read, &tree, why, error);
    if (status == TN_OK && !*why)
        status = take_away(&tree, moved, &made, about, why, error);
    tn_rule_tree_clear(&tree);
    tn_rule_text_clear(&read);
    free(text->data);
    *text = made;
    return status;
}

/* ---- asked */

/* Do the parts that the edit names exist, and can the one be moved to the other? */
static bool names_parts(const tn_rule_tree *tree, const tn_rule_edit *edit, char *why)
{
    bool moves = edit->from != TN_NO_RULE_PART;
    if (edit->part >= tree->count || (moves && edit->from >= tree->count))
        snprintf(why, TN_WHY_MAX, "the rule has the parts 0 to %u", tree->count - 1);
    else if (moves && edit->operation != TN_RULE_INSERT && edit->operation != TN_RULE_JOIN)
        snprintf(why, TN_WHY_MAX, "a part is moved by `insert` or `join`");
    else if (moves && tn_rule_part_within(tree, edit->part, edit->from))
        snprintf(why, TN_WHY_MAX, "a part cannot be put into itself");
    return !*why;
}

/* The smallest part of the changed rule at the place, the place being told by the tokens that it holds: laying out does
 * not change them. */
static uint32_t part_about(const tn_rule_tree *tree, size_t first, size_t last)
{
    const tn_rule_text *text = tree->text;
    tn_text_stretch place = {text->tokens[first].span.begin, text->tokens[last > first ? last - 1 : first].span.end};
    uint32_t part = tn_rule_part_around(tree, place);
    return part == TN_NO_RULE_PART ? 0 : part;
}

/* Says what became of the text, and of what the edit was about. */
static tn_status finish(const tn_rule_text *old, const char *rule, tn_buffer *text, tn_text_stretch about,
                        tn_rule_edited *made, tn_error *error)
{
    tn_rule_text read = {0};
    tn_rule_tree tree = {0};
    size_t first = 0, last = 0;
    tn_status status = read_changed(text, rule, &read, &tree, made->why, error);
    const char *wrong = status == TN_OK && !*made->why ? misplaced(&tree) : NULL;
    if (wrong)
        snprintf(made->why, TN_WHY_MAX, "%s", wrong);
    bool good = status == TN_OK && !*made->why;
    if (good) {
        first = tn_rule_text_token(&read, about.begin);
        last = tn_rule_text_token(&read, about.end);
    }
    tn_rule_tree_clear(&tree);
    tn_rule_text_clear(&read);
    if (!good)
        return status;
    status = tn_rule_lay_out(old->text, old->size, rule, text, error);
    if (status == TN_OK)
        status = read_changed(text, rule, &read, &tree, made->why, error);
    if (status == TN_OK && !*made->why)
        made->part = part_about(&tree, first, last);
    tn_rule_tree_clear(&tree);
    tn_rule_text_clear(&read);
    return status;
}

/* Do its lines end with carriage returns, too? The first tells. */
static bool has_carriage_returns(const char *text, size_t size)
{
    const char *line = memchr(text, '\n', size);
    return line && line > text && line[-1] == '\r';
}

/* Lines whose ends are those of the text that they come into. */
static void put_lines(tn_buffer *to, const char *text, size_t size, bool carriage_returns)
{
    tn_buffer_append(to, "", 0);
    for (size_t i = 0; i < size; i++) {
        if (carriage_returns && text[i] == '\n' && (i == 0 || text[i - 1] != '\r'))
            tn_buffer_append(to, "\r", 1);
        tn_buffer_append(to, text + i, 1);
    }
}

/* What of the old text became what: all between what both begin and end with. */
static tn_status compare(const char *old, size_t size, const tn_buffer *text, tn_rule_edited *made, tn_error *error)
{
    size_t begin = 0, end = 0, least = size < text->size ? size : text->size;
    while (begin < least && old[begin] == text->data[begin])
        begin++;
    while (end < least - begin && old[size - 1 - end] == text->data[text->size - 1 - end])
        end++;
    while (begin > 0 && ((unsigned char)old[begin] & 0xC0) == 0x80) /* whole characters */
        begin--;
    while (end > 0 && ((unsigned char)old[size - end] & 0xC0) == 0x80)
        end--;
    if (begin > 0 && old[begin - 1] == '\r') /* and whole ends of lines */
        begin--;
    if (end > 0 && end < size - begin && old[size - end - 1] == '\r')
        end--;
    made->changed = (tn_text_stretch){(uint32_t)begin, (uint32_t)(size - end)};
    tn_buffer insert = {0}, whole = {0};
    put_lines(&insert, text->data + begin, text->size - end - begin, has_carriage_returns(old, size));
    tn_buffer_append(&whole, old, begin);
    tn_buffer_append(&whole, insert.data, insert.size);
    tn_buffer_append(&whole, old + size - end, end);
    made->insert = insert.data;
    made->text = whole.data;
    made->size = whole.size;
    return insert.failed || whole.failed ? tn_fail_memory(error) : TN_OK;
}

static tn_status edit_tree(const tn_rule_tree *tree, const char *rule, const tn_rule_edit *edit, tn_rule_edited *made,
                           tn_error *error)
{
    tn_buffer text = {0};
    tn_text_stretch about = {0};
    if (!names_parts(tree, edit, made->why))
        return TN_OK;
    editing e = {.tree = tree, .edit = edit, .part = tree->parts[edit->part], .why = made->why};
    e.about = e.part.outer;
    tn_status status = change_text(&e, &text, &about, error);
    if (status == TN_OK && !*made->why && edit->from != TN_NO_RULE_PART) {
        tn_text_stretch moved = tn_text_changes_shift(&e.changes, tree, tree->parts[edit->from].own);
        status = finish_move(rule, moved, &text, &about, made->why, error);
    }
    if (status == TN_OK && !*made->why)
        status = finish(tree->text, rule, &text, about, made, error);
    if (status == TN_OK && !*made->why)
        status = compare(tree->text->text, tree->text->size, &text, made, error);
    tn_text_changes_clear(&e.changes);
    free(e.with);
    free(text.data);
    return status;
}

tn_status tn_rule_edit_make(const char *text, size_t size, const char *rule, const tn_rule_edit *edit,
                            tn_rule_edited *made, tn_error *error)
{
    tn_rule_text read = {0};
    tn_rule_tree tree = {0};
    *made = (tn_rule_edited){0};
    tn_status status = tn_rule_text_read(text, size, &read, error);
    const tn_ast_rule *found = status == TN_OK && read.parses ? tn_rule_text_find(&read, rule) : NULL;
    if (status == TN_OK && !found)
        snprintf(made->why, TN_WHY_MAX, read.parses ? "there is no rule `%.60s` in the text" : "the text has mistakes",
                 rule);
    if (found)
        status = tn_rule_tree_make(&read, found, &tree, error);
    if (found && status == TN_OK)
        status = edit_tree(&tree, rule, edit, made, error);
    tn_rule_tree_clear(&tree);
    tn_rule_text_clear(&read);
    return status;
}

/* ---- a new rule */

/* The item that the byte is in or behind, or NULL. */
static const tn_ast_top *item_before(const tn_rule_text *text, size_t offset)
{
    const tn_ast_top *found = NULL;
    for (TN_EACH(const tn_ast_top, item, text->tree->items))
        if (item->node.span.begin <= offset)
            found = item;
    return found;
}

/* The schema that the rule before it names: the new one is about the same trays. NULL: it names none. */
static const char *schema_of(const tn_ast_top *item)
{
    const tn_ast_rule *rule = item && item->kind == TN_ITEM_RULE ? (const tn_ast_rule *)item : NULL;
    return rule && rule->using ? rule->using->text : NULL;
}

/* Behind the comment that stands on the same line. */
static uint32_t end_of_line(const tn_rule_text *text, uint32_t end)
{
    for (size_t i = 0; i < text->comment_count; i++) {
        tn_span comment = text->comments[i].span;
        if (comment.begin >= end && !memchr(text->text + end, '\n', comment.begin - end) &&
            strspn(text->text + end, " \t") >= comment.begin - end)
            return comment.end;
    }
    return end;
}

static tn_status write_new(const tn_rule_text *text, const char *name, const tn_ast_top *before, tn_buffer *to,
                           tn_error *error)
{
    uint32_t at = end_of_line(text, before ? before->node.span.end : (uint32_t)text->size);
    const char *schema = schema_of(before);
    bool first = strspn(text->text, " \t\r\n") >= at, line = at > 0 && text->text[at - 1] == '\n';
    tn_buffer_append(to, text->text, at);
    tn_buffer_printf(to, "%srule %s%s%s =\n  any%s",
                     first  ? ""
                     : line ? "\n"
                            : "\n\n",
                     name, schema ? " using " : "", schema ? schema : "", at == text->size ? "\n" : "");
    tn_buffer_append(to, text->text + at, text->size - at);
    return to->failed ? tn_fail_memory(error) : TN_OK;
}

tn_status tn_rule_new_make(const char *text, size_t size, const char *name, size_t offset, tn_rule_edited *made,
                           tn_error *error)
{
    tn_rule_text read = {0};
    tn_buffer changed = {0};
    tn_binding binds;
    *made = (tn_rule_edited){0};
    tn_status status = tn_given_text_check(TN_GIVEN_NAME, name, &binds, made->why, error);
    if (status == TN_OK && !*made->why)
        status = tn_rule_text_read(text, size, &read, error);
    if (status == TN_OK && !*made->why && !read.parses)
        snprintf(made->why, TN_WHY_MAX, "the text has mistakes");
    if (status == TN_OK && !*made->why && tn_rule_text_find(&read, name))
        snprintf(made->why, TN_WHY_MAX, "there is a rule `%.60s` already", name);
    if (status == TN_OK && !*made->why)
        status = write_new(&read, name, item_before(&read, offset), &changed, error);
    if (status == TN_OK && !*made->why)
        status = compare(read.text, read.size, &changed, made, error);
    tn_rule_text_clear(&read);
    free(changed.data);
    return status;
}

void tn_rule_edited_clear(tn_rule_edited *made)
{
    free(made->insert);
    free(made->text);
    *made = (tn_rule_edited){0};
}
