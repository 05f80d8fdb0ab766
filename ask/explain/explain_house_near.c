/* Looks for kept houses near to one that is dropped: by one change, or by the changes that a beam search finds, whose
 * houses are those that the fewest clauses drop. */
#include <stdlib.h>
#include <string.h>

#include "ask/explain/explain.h"
#include "driver/house/change_text.h"

enum { NEAREST_MAX = 5 };

/* ---- one change */

typedef struct nearing {
    tn_house_explaining *e;
    tn_explained_house *explained;
} nearing;

static tn_status set_words(const tn_change_words *w, char **where, char **from, char **to, tn_error *error)
{
    *where = strdup(w->where);
    *from = strdup(w->from);
    *to = strdup(w->to);
    return *where && *from && *to ? TN_OK : tn_fail_memory(error);
}

static tn_status see_near(void *context, const tn_house_change *change, const tn_house *changed, tn_error *error)
{
    nearing *n = context;
    tn_change_words w;
    tn_buffer line = {0};
    if (n->explained->nearest.count == NEAREST_MAX) {
        n->explained->more++;
        return TN_OK;
    }
    tn_nearest_house *near = TN_ADD(nearest_house, n->explained->nearest, error);
    if (!near)
        return TN_MEMORY;
    tn_change_text(&n->e->house, change, &w);
    near->has_where = near->has_from = near->has_to = true;
    tn_status status = set_words(&w, &near->where, &near->from, &near->to, error);
    if (status == TN_OK)
        status = tn_house_write(changed, &line, error);
    near->house = line.data;
    return status;
}

/* ---- several changes */

enum {
    BEAM = 16,
    DEPTH = 8,
    NODES = 1 + BEAM * DEPTH,
    TRIED_MAX = 400000 /* cells of houses that are looked at: about a second */
};

/* A house that was come to by changes. */
typedef struct near_node {
    char *line;
    size_t dropping, parent; /* clauses that drop it */
    size_t sections;         /* of the changes that lead to it, those of its section, which change much besides */
    tn_change_words words;   /* of the change from its parent */
} near_node;

/* Houses with as many changes as the level are nodes [first, count): the best so far, the best first. */
typedef struct beam {
    tn_house_explaining *e;
    const tn_house *from;
    bool few_sections; /* of nodes that as many clauses drop, those with fewer changes of the section are better */
    size_t parent, first, count, tried;
    near_node nodes[NODES];
} beam;

static tn_status count_dropping(tn_house_explaining *e, const tn_house *house, size_t *count, tn_error *error)
{
    tn_status status = tn_house_rules_start(e->judge.rules, house, error);
    *count = 0;
    for (uint32_t i = 0; status == TN_OK && i < e->library->clause_count; i++) {
        bool drops = false;
        status = tn_house_rules_drop(e->judge.rules, e->library, i, &drops, error);
        *count += drops;
    }
    return status;
}

static bool is_met(const beam *b, const char *line)
{
    for (size_t i = 0; i < b->count; i++)
        if (strcmp(b->nodes[i].line, line) == 0)
            return true;
    return false;
}

/* Did a change on the way to the node, that node's included, choose the same thing? */
static bool is_chosen(const beam *b, size_t node, const char *where)
{
    for (; node != 0; node = b->nodes[node].parent)
        if (strcmp(b->nodes[node].words.where, where) == 0)
            return true;
    return false;
}

static bool is_better(const beam *b, const near_node *node, const near_node *other)
{
    return node->dropping != other->dropping ? node->dropping < other->dropping
                                             : b->few_sections && node->sections < other->sections;
}

/* Takes the node into its level, if it is among the best there; else it is freed. */
static void insert(beam *b, const near_node *node)
{
    size_t at = b->count;
    while (at > b->first && is_better(b, node, &b->nodes[at - 1]))
        at--;
    if (at == b->first + BEAM) {
        free(node->line);
        return;
    }
    if (b->count == b->first + BEAM)
        free(b->nodes[--b->count].line);
    memmove(&b->nodes[at + 1], &b->nodes[at], (b->count - at) * sizeof *b->nodes);
    b->nodes[at] = *node;
    b->count++;
}

static tn_status see_change(void *context, const tn_house_change *change, const tn_house *changed, tn_error *error)
{
    beam *b = context;
    near_node node = {.parent = b->parent};
    tn_buffer line = {0};
    b->tried += changed->cell_count;
    tn_change_text(b->from, change, &node.words);
    if (is_chosen(b, b->parent, node.words.where))
        return TN_OK;
    tn_status status = count_dropping(b->e, changed, &node.dropping, error);
    bool full = b->count == b->first + BEAM;
    node.sections = b->nodes[b->parent].sections + (change->kind == TN_CHANGE_SECTION);
    if (status != TN_OK || (full && !is_better(b, &node, &b->nodes[b->count - 1])))
        return status;
    status = tn_house_write(changed, &line, error);
    if (status != TN_OK || is_met(b, line.data)) {
        free(line.data);
        return status;
    }
    node.line = line.data;
    insert(b, &node);
    return TN_OK;
}

static tn_status try_changes(beam *b, const tn_house *from, size_t parent, tn_error *error)
{
    b->from = from;
    b->parent = parent;
    return tn_house_changes(from, b->e->judge.rules, NULL, TN_NO_CELL, see_change, b, error);
}

/* Node 0 is the house that is explained. It may have cells in which no tile stands, so that its line cannot be read. */
static tn_status expand(beam *b, size_t parent, tn_error *error)
{
    const char *line = b->nodes[parent].line;
    tn_house from = {0};
    if (parent == 0)
        return try_changes(b, &b->e->house, parent, error);
    tn_status status = tn_house_read_open(&b->e->judge.form, line, strlen(line), b->e->house.length, &from, error);
    if (status == TN_OK)
        status = try_changes(b, &from, parent, error);
    tn_house_clear(&from);
    return status;
}

/* The changes that lead to a node, the first first. */
static tn_status add_steps(const beam *b, size_t node, tn_nearest_house *near, tn_error *error)
{
    if (b->nodes[node].parent != 0) {
        tn_status status = add_steps(b, b->nodes[node].parent, near, error);
        if (status != TN_OK)
            return status;
    }
    tn_house_step *step = TN_ADD(house_step, near->changes, error);
    return step ? set_words(&b->nodes[node].words, &step->where, &step->from, &step->to, error) : TN_MEMORY;
}

/* *depth: how many changes lead to the kept house that is found first in its level, or 0. */
static tn_status search(beam *b, int *depth, tn_error *error)
{
    tn_status status = TN_OK;
    size_t level = 0, end = 1;     /* the nodes that are expanded now */
    b->nodes[0].line = strdup(""); /* a way back to it would be no shorter */
    if (!b->nodes[0].line)
        return tn_fail_memory(error);
    b->count = 1;
    for (int d = 1; status == TN_OK && *depth == 0 && d <= DEPTH && level < end; d++) {
        b->first = b->count;
        for (size_t i = level; status == TN_OK && i < end && b->tried < TRIED_MAX; i++)
            status = expand(b, i, error);
        level = b->first;
        end = b->count;
        if (status == TN_OK && end > level && b->nodes[level].dropping == 0)
            *depth = d;
    }
    return status;
}

static tn_status add_found(const beam *b, tn_explained_house *explained, tn_error *error)
{
    tn_nearest_house *near = TN_ADD(nearest_house, explained->nearest, error);
    if (!near)
        return TN_MEMORY;
    near->has_changes = true;
    near->house = strdup(b->nodes[b->first].line);
    return near->house ? add_steps(b, b->first, near, error) : tn_fail_memory(error);
}

static void clear_beam(beam *b)
{
    for (size_t i = 0; i < b->count; i++)
        free(b->nodes[i].line);
}

/* Some houses are found sooner where the section is left alone, others where it is changed first: both are tried. */
static tn_status find_several(tn_house_explaining *e, tn_explained_house *explained, tn_error *error)
{
    beam *both = calloc(2, sizeof *both);
    int depth[2] = {0};
    tn_status status = both ? TN_OK : tn_fail_memory(error);
    for (int i = 0; status == TN_OK && i < 2; i++) {
        both[i].e = e;
        both[i].few_sections = i == 0;
        status = search(&both[i], &depth[i], error);
    }
    bool second = depth[0] == 0 || (depth[1] > 0 && depth[1] < depth[0]);
    if (status == TN_OK && (depth[0] > 0 || depth[1] > 0))
        status = add_found(&both[second], explained, error);
    for (int i = 0; both && i < 2; i++)
        clear_beam(&both[i]);
    free(both);
    return status;
}

tn_status tn_explain_nearest(tn_house_explaining *e, tn_explained_house *explained, tn_error *error)
{
    nearing n = {e, explained};
    tn_status status = tn_house_changes(&e->house, e->judge.rules, e->library, TN_NO_CELL, see_near, &n, error);
    return status == TN_OK && explained->nearest.count == 0 ? find_several(e, explained, error) : status;
}
