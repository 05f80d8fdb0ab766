/* Derivation trees as pictures. */
#include "runtime/genome/picture/tree_draw.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"

/* In points. */
#define MARGIN 24.0
#define LEVEL 40.0
#define LETTERING 9.0
#define LABEL_MAX 120.0
#define GAP 10.0
#define CODON_LETTERING 6.5

typedef struct drawing {
    const tn_grammar *grammar;
    const tn_event *events;
    const tn_tree *tree;
    tn_paint *paint;
    double *x, *half, *left; /* by node: centre, half of its label's width, where its room begins */
    double right;            /* where the room of what is placed so far ends */
    uint32_t last;           /* the node entered last */
    uint32_t *depth;         /* by node; UINT32_MAX if it is not drawn */
    double width;
    uint32_t deepest;
    uint32_t row; /* levels above the tree that is being placed */
} drawing;

/* A terminal of nothing but blanks is written as a grammar writes it. */
static void show_blanks(char *text, size_t size)
{
    char shown[96];
    size_t used = (size_t)snprintf(shown, sizeof shown, "\"");
    for (const char *c = text; *c && used + 4 < sizeof shown; c++)
        used += (size_t)snprintf(shown + used, sizeof shown - used, "%s",
                                 *c == '\n'   ? "\\n"
                                 : *c == '\t' ? "\\t"
                                              : " ");
    snprintf(text, size, "%s\"", shown);
}

/* What a node is called in the picture; empty for those that only say how a loop went on. */
static void label(const drawing *d, uint32_t node, char *text, size_t size)
{
    const tn_event *event = &d->events[d->tree->nodes[node].event];
    text[0] = '\0';
    if (event->kind == TN_EVENT_EXPAND)
        snprintf(text, size, "%s", tn_rule_name(d->grammar, event->symbol));
    else if (event->kind == TN_EVENT_TERMINAL)
        snprintf(text, size, "%s", d->grammar->texts + d->grammar->terminals[event->symbol].offset);
    else if (event->kind == TN_EVENT_EDGE)
        snprintf(text, size, "Edge%" PRIu64, event->value);
    else if (event->kind == TN_EVENT_REPAIR)
        snprintf(text, size, "repair of Edge%" PRIu64, event->value);
    if (text[0] && text[strspn(text, " \t\n")] == '\0')
        show_blanks(text, size);
    for (char *c = text; *c; c++)
        if (*c == '\n' || *c == '\t')
            *c = ' ';
}

static bool drawn(const drawing *d, uint32_t node)
{
    uint8_t kind = d->events[d->tree->nodes[node].event].kind;
    return kind == TN_EVENT_EXPAND || kind == TN_EVENT_TERMINAL || kind == TN_EVENT_EDGE || kind == TN_EVENT_REPAIR;
}

static double text_width(tn_paint *paint, double size, const char *text)
{
    tn_paint_face(paint, size, true);
    double width = tn_type_width(paint, text);
    return width < LABEL_MAX ? width : LABEL_MAX;
}

static void codon_text(const tn_event *event, char *text, size_t size)
{
    text[0] = '\0';
    if (event->read != TN_NO_READ)
        snprintf(text, size, "%" PRIu64 " mod %" PRIu64 " = %" PRIu64, event->codon, event->modulus, event->value);
}

/* Trees of rules that repair added stand one below the other. */
static void begin_row(drawing *d)
{
    d->width = d->right > d->width ? d->right : d->width;
    d->right = MARGIN;
    d->row = d->deepest + 1;
}

/* Leaves lie side by side; a parent is centred over its children, which are moved to the right where its own label
 * wants more room than they take. */
static void enter(void *context, uint32_t node, uint32_t depth)
{
    drawing *d = context;
    if (d->events[d->tree->nodes[node].event].kind == TN_EVENT_REPAIR)
        begin_row(d);
    depth += d->row;
    d->last = node;
    d->depth[node] = depth;
    d->left[node] = d->right;
    if (!drawn(d, node))
        return;
    char text[96];
    label(d, node, text, sizeof text);
    double width = text_width(d->paint, LETTERING, text);
    codon_text(&d->events[d->tree->nodes[node].event], text, sizeof text);
    double below = text_width(d->paint, CODON_LETTERING, text);
    d->half[node] = (width > below ? width : below) / 2;
    d->deepest = depth > d->deepest ? depth : d->deepest;
}

static void leave(void *context, uint32_t node, uint32_t depth)
{
    drawing *d = context;
    const tn_tree *tree = d->tree;
    double low = 0, high = 0;
    bool any = false;
    (void)depth;
    if (!drawn(d, node))
        return;
    for (uint32_t c = tree->nodes[node].first_child; c != TN_TREE_NONE; c = tree->nodes[c].next) {
        if (!drawn(d, c))
            continue;
        low = any ? low : d->x[c];
        high = d->x[c];
        any = true;
    }
    double shift = any ? d->left[node] + d->half[node] - (low + high) / 2 : 0;
    d->x[node] = any ? (low + high) / 2 : d->left[node] + d->half[node];
    for (uint32_t i = node; shift > 0 && i <= d->last; i++)
        d->x[i] += shift;
    double edge = d->x[node] + d->half[node] + GAP;
    d->right = shift > 0 ? d->right + shift : d->right;
    d->right = edge > d->right ? edge : d->right;
}

static void place(drawing *d)
{
    d->right = MARGIN;
    tn_tree_walk(d->tree, enter, leave, d);
    d->width = (d->right > d->width ? d->right : d->width) - GAP + MARGIN;
}

static double baseline(const drawing *d, uint32_t node)
{
    return MARGIN + LETTERING + d->depth[node] * LEVEL;
}

static void draw_node(const drawing *d, uint32_t node)
{
    const tn_tree_node *n = &d->tree->nodes[node];
    const tn_event *event = &d->events[n->event];
    char text[96];
    label(d, node, text, sizeof text);
    if (n->parent != TN_TREE_NONE) {
        tn_paint_colour(d->paint, 0.6, 0.6, 0.6);
        tn_paint_line_width(d->paint, 0.6);
        tn_paint_move_to(d->paint, d->x[n->parent], baseline(d, n->parent) + 9);
        tn_paint_line_to(d->paint, d->x[node], baseline(d, node) - LETTERING);
        tn_paint_stroke(d->paint);
    }
    bool inner = event->kind == TN_EVENT_EXPAND;
    tn_paint_colour(d->paint, inner ? 0.1 : 0, inner ? 0.2 : 0, inner ? 0.5 : 0);
    tn_paint_face(d->paint, LETTERING, !inner);
    tn_type_fit(d->paint, d->x[node], baseline(d, node), TN_ALIGN_CENTRE, LABEL_MAX, text);
    if (event->read == TN_NO_READ)
        return;
    codon_text(event, text, sizeof text);
    tn_paint_colour(d->paint, 0.45, 0.45, 0.45);
    tn_paint_face(d->paint, CODON_LETTERING, false);
    tn_type_line(d->paint, d->x[node], baseline(d, node) + 7.5, TN_ALIGN_CENTRE, text);
}

/* Labels are measured before there is a canvas, since a picture's size is wanted when it is begun. */
static tn_status lay_out(drawing *d, tn_error *error)
{
    d->paint = tn_paint_new(NULL);
    if (!d->paint)
        return tn_fail_memory(error);
    place(d);
    tn_paint_free(d->paint);
    return TN_OK;
}

static tn_status draw(drawing *d, tn_picture *to, tn_error *error)
{
    tn_canvas_format format; /* a wrong name is said before anything is laid out */
    tn_canvas *canvas = NULL;
    tn_status status = tn_picture_format(to, &format, error);
    if (status == TN_OK)
        status = lay_out(d, error);
    tn_canvas_options options = {.width = d->width > 120 ? d->width : 120,
                                 .height = 2 * MARGIN + LETTERING + 9 + d->deepest * LEVEL,
                                 .title = d->grammar->name};
    if (status == TN_OK)
        status = tn_canvas_open(to, &options, &canvas, error);
    if (status == TN_OK) {
        d->paint = tn_canvas_paint(canvas);
        for (uint32_t i = 0; i < d->tree->count && !tn_canvas_stopped(canvas); i++)
            if (drawn(d, i))
                draw_node(d, i);
        status = tn_canvas_commit(canvas, error);
    }
    tn_canvas_free(canvas);
    return status;
}

tn_status tn_tree_draw(const tn_grammar *grammar, const tn_event *events, const tn_tree *tree, tn_picture *to,
                       tn_error *error)
{
    if (tree->count > TN_TREE_DRAWN) {
        tn_fail(error, TN_LIMIT, E_TREE_TOO_LARGE, "the derivation has %zu nodes; at most %u are drawn", tree->count,
                TN_TREE_DRAWN);
        tn_error_help(error, "--tree text and --tree json have no such limit");
        return TN_LIMIT;
    }
    drawing d = {.grammar = grammar, .events = events, .tree = tree};
    d.x = calloc(tree->count + 1, sizeof *d.x);
    d.half = calloc(tree->count + 1, sizeof *d.half);
    d.left = calloc(tree->count + 1, sizeof *d.left);
    d.depth = calloc(tree->count + 1, sizeof *d.depth);
    tn_status status = d.x && d.half && d.left && d.depth ? draw(&d, to, error) : tn_fail_memory(error);
    free(d.x);
    free(d.half);
    free(d.left);
    free(d.depth);
    return status;
}
