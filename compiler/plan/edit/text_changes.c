#include "compiler/plan/edit/text_changes.h"

#include <stdlib.h>
#include <string.h>

void tn_text_change_add(tn_text_changes *changes, tn_text_stretch replaced, const char *insert, tn_text_stretch put)
{
    char *copy = strdup(insert);
    if (!copy || changes->count == TN_TEXT_CHANGES_MAX) {
        free(copy);
        changes->failed = true;
        return;
    }
    size_t at = changes->count++; /* kept in the order of the text */
    for (; at > 0 && changes->items[at - 1].begin > replaced.begin; at--)
        changes->items[at] = changes->items[at - 1];
    changes->items[at] = (tn_text_change){replaced.begin, replaced.end, copy, put};
}

void tn_text_changes_clear(tn_text_changes *changes)
{
    for (size_t i = 0; i < changes->count; i++)
        free(changes->items[i].insert);
    *changes = (tn_text_changes){0};
}

/* ---- comments */

static bool is_inside(tn_span comment, uint32_t begin, uint32_t end)
{
    return begin <= comment.begin && comment.end <= end;
}

static bool is_lost(const tn_text_changes *changes, tn_span comment)
{
    for (size_t i = 0; i < changes->count; i++)
        if (is_inside(comment, changes->items[i].begin, changes->items[i].end))
            return !is_inside(comment, changes->moved.begin, changes->moved.end);
    return false;
}

/* What stands before the rule on its line: blanks, unless something else begins there. */
static tn_text_stretch line_before(const tn_rule_tree *tree)
{
    uint32_t begin = tree->rule->top.node.span.begin, at = begin;
    while (at > 0 && tree->text->text[at - 1] != '\n')
        at--;
    return (tn_text_stretch){at, begin};
}

/* NULL: only the size is asked for. */
static size_t put(tn_buffer *to, const char *text, size_t size)
{
    if (to)
        tn_buffer_append(to, text, size);
    return size;
}

/* The lost comments, each on a line of its own, as they are put before the rule. How many bytes they are. */
static size_t write_lost(const tn_text_changes *changes, const tn_rule_tree *tree, tn_buffer *to)
{
    const tn_rule_text *text = tree->text;
    tn_text_stretch line = line_before(tree);
    size_t blanks = strspn(text->text + line.begin, " \t"), size = 0;
    bool alone = blanks >= line.end - line.begin;
    for (size_t i = 0; i < text->comment_count; i++) {
        tn_span comment = text->comments[i].span;
        if (!is_lost(changes, comment))
            continue;
        if (size == 0 && !alone)
            size += put(to, "\n", 1);
        size += put(to, text->text + comment.begin, comment.end - comment.begin);
        size += put(to, "\n", 1);
        if (alone)
            size += put(to, text->text + line.begin, line.end - line.begin);
    }
    return size;
}

/* ---- the changed text */

tn_status tn_text_changes_make(const tn_text_changes *changes, const tn_rule_tree *tree, tn_buffer *text,
                               tn_error *error)
{
    const char *old = tree->text->text;
    uint32_t at = tree->rule->top.node.span.begin;
    tn_buffer_append(text, old, at);
    write_lost(changes, tree, text);
    for (size_t i = 0; i < changes->count; i++) {
        const tn_text_change *change = &changes->items[i];
        tn_buffer_append(text, old + at, change->begin - at);
        tn_buffer_append(text, change->insert, strlen(change->insert));
        at = change->end;
    }
    tn_buffer_append(text, old + at, tree->text->size - at);
    return text->failed || changes->failed ? tn_fail_memory(error) : TN_OK;
}

/* How many bytes of comments come before the rule. */
static int64_t lost_size(const tn_text_changes *changes, const tn_rule_tree *tree)
{
    return (int64_t)write_lost(changes, tree, NULL);
}

/* How much longer the text becomes by a change. */
static int64_t growth(const tn_text_change *change)
{
    return (int64_t)strlen(change->insert) - (change->end - change->begin);
}

tn_text_stretch tn_text_changes_map(const tn_text_changes *changes, const tn_rule_tree *tree, tn_text_stretch stretch)
{
    int64_t lost = lost_size(changes, tree), begin = stretch.begin + lost, end = stretch.end + lost;
    for (size_t i = 0; i < changes->count; i++) {
        begin += changes->items[i].begin < stretch.begin ? growth(&changes->items[i]) : 0;
        end += changes->items[i].begin <= stretch.end ? growth(&changes->items[i]) : 0;
    }
    return (tn_text_stretch){(uint32_t)begin, (uint32_t)end};
}

tn_text_stretch tn_text_changes_shift(const tn_text_changes *changes, const tn_rule_tree *tree, tn_text_stretch stretch)
{
    int64_t begin = stretch.begin + lost_size(changes, tree);
    for (size_t i = 0; i < changes->count; i++)
        begin += changes->items[i].end <= stretch.begin ? growth(&changes->items[i]) : 0;
    return (tn_text_stretch){(uint32_t)begin, (uint32_t)(begin + stretch.end - stretch.begin)};
}

bool tn_text_changes_put(const tn_text_changes *changes, const tn_rule_tree *tree, tn_text_stretch *put)
{
    int64_t more = lost_size(changes, tree);
    for (size_t i = 0; i < changes->count; i++) {
        const tn_text_change *change = &changes->items[i];
        if (change->put.end > change->put.begin) {
            int64_t at = change->begin + more;
            *put = (tn_text_stretch){(uint32_t)(at + change->put.begin), (uint32_t)(at + change->put.end)};
            return true;
        }
        more += growth(change);
    }
    return false;
}
