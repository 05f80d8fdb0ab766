/* The syntax tree of a form (docs/houses.md), and its constructors, one for each action of grammar/plan.y. As in ast.h:
 * nodes live in the parse's arena, and NULL goes in and out where something could not be made. */
#ifndef TARTAN_COMPILER_PLAN_SYNTAX_FORM_AST_H
#define TARTAN_COMPILER_PLAN_SYNTAX_FORM_AST_H

#include "compiler/plan/syntax/ast.h"
#include "runtime/module/values.h"

typedef enum tn_form_part {
    TN_PART_STOREY,
    TN_PART_SPINE,
    TN_PART_WALL,
    TN_PART_PARTITION,
    TN_PART_DECK,
    TN_PART_ROOF,
    TN_PART_SECTION,
    TN_PART_FORBID,
    TN_PART_VOID,
    TN_PART_NO,
    TN_PART_FUNCTION,
    TN_PART_OPENING,
    TN_PART_FLIGHT,
    TN_PART_FACE,
    TN_PART_TILE,
    TN_PART_MATERIAL,
    TN_PART_WAY,
    TN_PART_HEADROOM,
    TN_PART_GUARD,
    TN_PART_BEAM,
    TN_PART_CLASSIFICATION,
    TN_PART_ALLOW
} tn_form_part;

/* A value of a section: a number, or a name with what stands in parentheses. */
typedef struct tn_ast_shape {
    tn_ast_node node;
    const tn_ast_word *word;
    tn_ast_list arguments; /* tn_ast_argument */
} tn_ast_shape;

/* A name, a length, a slope `rise:run`, or a name and a length. */
typedef struct tn_ast_argument {
    tn_ast_node node;
    const tn_ast_word *word, *run; /* run: NULL where there is one word */
} tn_ast_argument;

/* `sill LENGTH`, `clear LENGTH`, `near SIDE LENGTH`, `passage`, `glazed`, `leafless` or `sliding` of an opening. */
typedef enum tn_opening_part {
    TN_OPENING_SILL,
    TN_OPENING_CLEAR,
    TN_OPENING_NEAR,
    TN_OPENING_PASSAGE,
    TN_OPENING_GLAZED,
    TN_OPENING_LEAFLESS,
    TN_OPENING_SLIDING
} tn_opening_part;
typedef struct tn_ast_opening_part {
    tn_ast_node node;
    tn_opening_part part;
    const tn_ast_word *side, *length; /* side: of `near` */
} tn_ast_opening_part;

/* A layer of a wall, partition or deck. */
typedef struct tn_ast_layer {
    tn_ast_node node;
    const tn_ast_word *name, *length;
} tn_ast_layer;

/* What a part is called in a classification. title: or NULL. */
typedef struct tn_ast_class {
    tn_ast_node node;
    const tn_ast_word *name, *code, *title;
} tn_ast_class;

/* One stretch of a tile's box: from a side so far, to a side so far. */
typedef enum tn_box_side { TN_BOX_LEFT, TN_BOX_RIGHT, TN_BOX_BACK, TN_BOX_FRONT, TN_BOX_UP } tn_box_side;
typedef struct tn_ast_reach {
    tn_ast_node node;
    tn_box_side from, to;
    const tn_ast_word *low, *high;
} tn_ast_reach;

/* A line of an item's symbol: its ends, each from a side so far and from another. */
typedef struct tn_ast_symbol_line {
    tn_ast_node node;
    tn_box_side sides[2][2];
    const tn_ast_word *lengths[2][2];
} tn_ast_symbol_line;

typedef enum tn_tile_part { TN_TILE_AGAINST, TN_TILE_WIDE, TN_TILE_DEEP, TN_TILE_ITEM, TN_TILE_KEEPS } tn_tile_part;
typedef struct tn_ast_tile_part {
    tn_ast_node node;
    tn_tile_part part;
    const tn_ast_word *name, *doc; /* of an item or what is kept free */
    const tn_ast_word *low, *high; /* wide, deep */
    tn_ast_list list;              /* against: tn_ast_word; item, keep: tn_ast_reach */
    const tn_ast_word *symbol;     /* of an item, or NULL */
    tn_ast_list lines;             /* tn_ast_symbol_line: those that it is drawn by */
} tn_ast_tile_part;

typedef struct tn_ast_form_clause {
    tn_ast_node node;
    tn_form_part part;
    const tn_ast_word *name, *doc; /* of a material, the doc is its colour; of a classification, its name */
    const tn_ast_word *detail; /* wall: `outside`, `party` or NULL; section: the word after the zone; outside: the side,
                                  or NULL; material: per what; flight: how it turns, or NULL */
    const tn_ast_word *length; /* storey, thickness, an opening's width; a material's price, or NULL */
    const tn_ast_word *high;   /* opening, beam; the most that a flight's steps rise */
    const tn_ast_word *low, *going; /* flight: the least that its steps rise, and how deep they are, or NULL; going: a
                                       beam's span */
    const tn_ast_word *winders;     /* flight: how many wedges a turn has, or NULL */
    bool outdoor;                   /* function */
    tn_face_relation relation;
    tn_ast_expr *first, *second; /* material: where it is used, or NULL */
    tn_ast_list list;  /* section: tn_ast_shape; face: kinds; tile, way: functions; material: parts; allow: codes */
    tn_ast_list parts; /* opening: tn_ast_opening_part; tile: tn_ast_tile_part; thickness: tn_ast_layer; classification: tn_ast_class */
    tn_span layered;   /* thickness: the braces with its layers; empty where there are none */
} tn_ast_form_clause;

typedef struct tn_ast_form {
    tn_ast_top top;
    const tn_ast_word *name, *doc, *schema;
    tn_ast_list clauses; /* tn_ast_form_clause */
} tn_ast_form;

void *tn_ast_form_new(tn_parse *parse, tn_span span, tn_ast_form head, tn_ast_list clauses);
void *tn_ast_form_clause_new(tn_parse *parse, tn_span span, tn_ast_form_clause clause);
void *tn_ast_shape_new(tn_parse *parse, tn_span span, const tn_ast_word *word, tn_ast_list arguments);
void *tn_ast_argument_new(tn_parse *parse, tn_span span, const tn_ast_word *word, const tn_ast_word *run);
void *tn_ast_opening_part_new(tn_parse *parse, tn_span span, tn_ast_opening_part part);
void *tn_ast_layer_new(tn_parse *parse, tn_span span, const tn_ast_word *name, const tn_ast_word *length);
void *tn_ast_class_new(tn_parse *parse, tn_span span, const tn_ast_word *name, const tn_ast_word *code,
                       const tn_ast_word *title);
void *tn_ast_reach_new(tn_parse *parse, tn_span span, tn_ast_reach reach);
void *tn_ast_symbol_line_new(tn_parse *parse, tn_span span, tn_ast_symbol_line from, tn_ast_symbol_line to);
void *tn_ast_tile_part_new(tn_parse *parse, tn_span span, tn_ast_tile_part part);

/* An alternative of `option(...)` with one more word before it; its last node is a tn_ast_shape. */
void *tn_ast_alternative_word(tn_parse *parse, tn_span span, tn_ast_word *word, void *alternative);

/* `cell(...)`, `room(...)` or `option(...)`: items are of tn_ast_item, or of tn_ast_shape alternatives. */
tn_ast_expr *tn_ast_house_leaf(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_list items);

/* `touch` or `apart`; kinds: tn_ast_word. */
tn_ast_expr *tn_ast_meeting(tn_parse *parse, tn_expr_kind kind, tn_span span, tn_ast_list parts, tn_ast_list kinds);

/* The longest or the shortest walk. to: cells, or a word as tn_ast_figure makes it; through: cells, or NULL. */
tn_ast_expr *tn_ast_walk(tn_parse *parse, tn_span span, tn_ast_extreme_kind extreme, tn_ast_expr *from,
                         tn_ast_expr *to, tn_ast_expr *through, tn_ast_list kinds);

#endif
