/* Forms, checked: what their records are made of, with every name resolved. Internal to form.c and form_*.c.
 *
 * Everything lives in the compilation's arena and borrows the syntax trees.
 */
#ifndef TARTAN_COMPILER_PLAN_CHECK_FORM_H
#define TARTAN_COMPILER_PLAN_CHECK_FORM_H

#include "compiler/plan/check/check.h"
#include "compiler/plan/syntax/form_ast.h"

/* One instruction of what decides on cells or sections. */
typedef struct tn_decision_step {
    tn_opcode opcode;
    uint32_t index; /* of a field, storey, function or shape of the form; an area's test */
    tn_checked_spec *spec;
    struct tn_decision *cells; /* of a room: what each of its cells is */
    int64_t area;
    tn_span span;
} tn_decision_step;

typedef struct tn_decision {
    tn_decision_step *steps;
    size_t count, capacity;
    tn_span span;
} tn_decision;

typedef struct tn_checked_storey {
    const tn_ast_form_clause *ast;
    int64_t height;
} tn_checked_storey;

/* Its record, but for texts and places. */
typedef struct tn_checked_shape {
    const tn_ast_shape *ast;
    const char *spelling;
    tn_shape_record record;
} tn_checked_shape;

typedef struct tn_checked_choice {
    const tn_ast_form_clause *ast;
    const char *name; /* "machine storeys" */
    tn_choice_kind kind;
    uint32_t zone; /* a field, or TN_NONE */
    tn_checked_shape *shapes;
    uint32_t shape_count, shape_first; /* shape_first: of all of the form */
} tn_checked_choice;

typedef struct tn_checked_cell_rule {
    const tn_ast_form_clause *ast;
    tn_cell_rule_kind kind;
    tn_decision decision;
} tn_checked_cell_rule;

typedef struct tn_checked_opening {
    const tn_ast_form_clause *ast;
    int64_t wide, high, sill, clear;
    int64_t rise_least, rise_most, going; /* of a flight */
    tn_turn turn;
    uint32_t winders; /* of each right angle that it turns by; 0: it has landings */
    bool passage, glazed, leafless, sliding;
    const tn_ast_opening_part *near_x, *near_y; /* what says where it begins, along x and along y; or NULL */
} tn_checked_opening;

typedef struct tn_checked_face {
    const tn_ast_form_clause *ast;
    tn_decision first, second;
    uint32_t *kinds;
    uint32_t kind_count;
} tn_checked_face;

typedef struct tn_checked_tile {
    const tn_ast_form_clause *ast;
    uint32_t *purposes, *against;
    uint32_t purpose_count, against_count;
    int64_t wide[2], deep[2];
    tn_tile_box_record *boxes;        /* but for texts and places */
    const tn_ast_tile_part **box_ast; /* where each is written */
    uint32_t box_count;
    tn_symbol_line_record *lines; /* of the boxes' symbols; a box has the first of its own counted among these */
    uint32_t line_count;
} tn_checked_tile;

typedef struct tn_checked_material {
    const tn_ast_form_clause *ast;
    uint32_t colour;
    int64_t price; /* millionths */
    tn_price_unit unit;
    bool has_where;
    tn_decision where;
    uint32_t *parts;
    uint32_t part_count;
} tn_checked_material;

/* `way LENGTH for FUNCTION, ...`. */
typedef struct tn_checked_way {
    const tn_ast_form_clause *ast;
    int64_t length;
} tn_checked_way;

typedef struct tn_checked_layer {
    const tn_ast_layer *ast;
    tn_layered of;
    int64_t thick;
} tn_checked_layer;

typedef struct tn_checked_beam {
    const tn_ast_form_clause *ast;
    int64_t wide, high, span;
} tn_checked_beam;

/* part: as of a material; behind them the form's functions. */
typedef struct tn_checked_class {
    const tn_ast_class *ast;
    uint32_t part;
} tn_checked_class;

typedef struct tn_checked_classification {
    const tn_ast_form_clause *ast;
    tn_checked_class *classes; /* by ascending part */
    uint32_t class_count;
} tn_checked_classification;

typedef struct tn_checked_form {
    const tn_ast_form *ast;
    const char *name;
    size_t unit;
    tn_checked_schema *schema; /* NULL: already reported */
    bool broken;               /* the schema is not one of houses: reported; what the form says was not read */
    uint32_t spine;
    int64_t thickness[4];                                      /* wall, partition, deck, roof */
    const tn_ast_form_clause *thickness_ast[TN_LAYERED_COUNT]; /* which line says of what it consists; or NULL */
    tn_checked_layer *layers;                                  /* by what they are layers of */
    tn_checked_storey *storeys;
    tn_checked_choice *choices;
    tn_checked_cell_rule *rules; /* functions, then void, no, forbid */
    tn_checked_opening *openings;
    tn_checked_face *faces;
    tn_checked_tile *tiles;
    tn_checked_material *materials;
    tn_checked_beam *beams;
    tn_checked_classification *classifications;
    tn_checked_way *ways;  /* [functions] of each; of those that lines name: ast */
    int64_t way, headroom, guard; /* 0: nothing is asked about ways */
    const tn_ast_form_clause *way_ast, *headroom_ast, *guard_ast;
    uint32_t index, storey_first, rule_first, shape_first; /* emitted: of its records */
    tn_ast_list allow;                                     /* tn_ast_word: warnings that it does not want */
    uint32_t storey_count, choice_count, rule_count, function_count, opening_count, face_count, tile_count;
    uint32_t material_count, layer_count, beam_count, classification_count;
} tn_checked_form;

/* Of two words for one thing, those in the unit of the schema's lengths; in feet where it has none. */
const char *tn_form_in_unit(const tn_checked_form *form, const char *feet, const char *metric);

/* ---- form.c (tn_check_forms: check.h) */
/* The length that a word says, where 0 may stand without a unit; -1 where it is none: then reported. */
int64_t tn_form_length(tn_check *check, const tn_ast_word *word);
/* A line that may stand once is there twice: E1603. words, name: how it begins. */
void tn_form_twice(tn_check *check, const tn_span *span, const tn_span *first, const char *words, const char *name);
/* A name that the form does not know: E1602, with the nearest of `names`. */
void tn_form_unknown(tn_check *check, const tn_checked_form *form, const tn_ast_word *word, const char *what,
                     const char *const *names, size_t count);
uint32_t tn_form_storey(const tn_checked_form *form, const char *name);        /* TN_NONE where there is none */
uint32_t tn_form_function(const tn_checked_form *form, const char *name);      /* likewise */
uint32_t tn_form_opening_named(const tn_checked_form *form, const char *name); /* likewise */

/* ---- form_shape.c */
void tn_check_choice(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast);
bool tn_form_section(tn_check *check, const tn_checked_form *form, const tn_ast_expr *expr, tn_decision *decision);

/* ---- form_cell.c */
void tn_decision_add(tn_check *check, tn_decision *decision, tn_decision_step step);
/* `decided`: may it ask for functions and voids, which are known after `at`, `void` and `no`? False: reported. */
bool tn_form_cell(tn_check *check, const tn_checked_form *form, const tn_ast_expr *expr, bool decided,
                  tn_decision *decision);

/* One alternative of an item of `cell(...)`, without a `not` before it. context: the field of those before it. */
bool tn_form_cell_words(tn_check *check, const tn_checked_form *form, const tn_ast_word *word, tn_span span,
                        tn_item_context *context, tn_decision *decision);

/* The first word after `not`s; NULL where there is none: reported. */
const tn_ast_word *tn_form_negated(tn_check *check, const tn_ast_alternative *alternative, const char *what,
                                   bool *negated);
/* `area < 90sf` (HAS_AREA, ROOM_AREA), `cells > 1` (ROOM_CELLS), from its first word on. False: reported. */
bool tn_form_compared(tn_check *check, const tn_ast_word *word, tn_opcode opcode, tn_decision *decision);

/* The test that a sign writes. */
tn_area_test tn_form_test(tn_operator sign);

/* ---- form_room.c */
bool tn_form_room(tn_check *check, const tn_checked_form *form, const tn_ast_expr *expr, tn_decision *decision);

/* ---- house.c: what a rule asks of houses, as an instruction */
typedef struct tn_checked_ask {
    const tn_checked_form *form;
    tn_decision first, second, through; /* of one thing: first alone */
    bool has_through;
    bool to_outside; /* a walk: without a second */
    uint32_t *kinds;
    uint32_t kind_count;
    uint32_t function; /* emitted: what decides on one thing, or the MEETING record; plus one; 0: not yet */
} tn_checked_ask;

/* ---- form_face.c, form_tile.c */
void tn_check_opening(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast);
void tn_check_flight(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast);
void tn_check_face(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast);
/* Can a kind be in a face of this relation? floor, stair and flights are between cells one over another. */
bool tn_form_kind_belongs(const tn_checked_form *form, tn_face_relation relation, uint32_t kind);

/* The kind of a name; TN_NONE: reported, with those that can be in such a face (TN_FACE_RELATION_COUNT: any). */
uint32_t tn_form_kind(tn_check *check, const tn_checked_form *form, tn_face_relation relation, const tn_ast_word *word);
/* The lines `way`, `headroom` and `guard`, once openings and flights are known. */
void tn_check_ways(tn_check *check, tn_checked_form *form);
void tn_check_tile(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast);

/* How a line begins that says how thick something is: "wall outside". */
const char *tn_form_thickness_words(const tn_ast_form_clause *ast);
/* Does half of that go to each side of a plane? */
bool tn_form_is_halved(const tn_ast_form_clause *ast);
/* Says why half of a length has to be whole, and the nearest in whole 1/32" or millimetres, whose half is. */
void tn_form_help_half(tn_check *check, tn_diagnostic *d, const char *why, int64_t length, const char *spelling);

/* ---- form_material.c */
/* The lines `beam`, once layers are known, and before materials. */
void tn_check_beams(tn_check *check, tn_checked_form *form);
/* The beam of a name; TN_NONE where there is none. */
uint32_t tn_form_beam_named(const tn_checked_form *form, const char *name);
/* The name of a layer or a beam, which is a part, so that materials can be for it: E1603 if something else that they may
 * be for is called so. */
void tn_check_part_name(tn_check *check, const tn_checked_form *form, const tn_ast_word *name);
/* The layers, once everything that has a name is known, and before materials. */
void tn_check_layers(tn_check *check, tn_checked_form *form);
/* Warns of layers without a price, if others have one. */
void tn_check_layer_prices(tn_check *check, const tn_checked_form *form);
/* The first layer of a name; TN_NONE where there is none. */
uint32_t tn_form_layer_named(const tn_checked_form *form, const char *name);
/* Where the form's items are called so: the first box of that name, counted among all boxes of its tiles; TN_NONE where
 * there is none. */
uint32_t tn_form_item_named(const tn_checked_form *form, const char *name);
/* The part that a material is for, and that has this name; TN_NONE where there is none. */
uint32_t tn_form_part_named(const tn_checked_form *form, const char *name);
void tn_check_material(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast);
void tn_check_classification(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast);

#endif
