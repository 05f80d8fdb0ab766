/* The .solid notation: designs of clipped boxes (docs/solid-language.md): syntax tree, checking, what is emitted.
 *
 * The grammar is permissive where a mistake is better told in the words of boxes: what a box must have is checked.
 * Everything lives in the compilation's arena.
 */
#ifndef TARTAN_COMPILER_SOLID_SOLID_H
#define TARTAN_COMPILER_SOLID_SOLID_H

#include "compiler/common/expression.h"
#include "compiler/common/import.h"
#include "compiler/common/parsing.h"
#include "compiler/common/token.h"
#include "compiler/common/words.h"
#include "runtime/solid/exact.h"
#include "runtime/solid/measured.h"

/* ---- syntax */

typedef struct tn_solid_text {
    const char *text; /* NULL: none */
    tn_span span;
} tn_solid_text;

/* A number or a length, as it was written. */
typedef struct tn_solid_number {
    tn_span digits; /* without the sign */
    tn_span span;
    bool negative;
    bool is_length;
    int64_t nanometres; /* of a length */
} tn_solid_number;

typedef struct tn_solid_vector {
    tn_solid_number at[3];
    tn_span span;
} tn_solid_vector;

typedef enum tn_solid_part_kind {
    TN_SOLID_AT,
    TN_SOLID_SIZE,
    TN_SOLID_FROM,
    TN_SOLID_CLIP_NORMAL, /* a: the normal; b: the point it goes through */
    TN_SOLID_CLIP_ANGLES, /* numbers: planedist, angle1, angle2 */
    TN_SOLID_RIGID,
    TN_SOLID_PART_COUNT
} tn_solid_part_kind;

typedef struct tn_solid_part {
    tn_solid_part_kind kind;
    tn_span span;
    tn_solid_vector a, b;
    struct tn_solid_part *next;
} tn_solid_part;

/* One of a list: of expressions, of axes, of genes. */
typedef struct tn_solid_entry {
    tn_span span;
    tn_expression *expression;
    const char *words; /* of what is measured: the expression as it is laid out, set by tn_solid_name_measures */
    tn_solid_number number;
    uint32_t axis;
    struct tn_solid_entry *next;
} tn_solid_entry;

typedef struct tn_solid_entries {
    tn_solid_entry *first, *last;
} tn_solid_entries;

typedef enum tn_solid_statement {
    /* each once in a design */
    TN_SOLID_SETS_SYMMETRY,
    TN_SOLID_SETS_FLAT,
    TN_SOLID_SETS_NOCLIP,
    TN_SOLID_SETS_PENETRATION,
    TN_SOLID_SETS_UNIT,
    TN_SOLID_SETS_MODEL,
    TN_SOLID_SETTING_COUNT,
    /* as many as one likes */
    TN_SOLID_BOX = TN_SOLID_SETTING_COUNT,
    TN_SOLID_GENES,
    TN_SOLID_ASKS,
    TN_SOLID_REQUIRES,
    TN_SOLID_AIMS,
} tn_solid_statement;

typedef struct tn_solid_item {
    tn_solid_statement kind;
    tn_span span;
    tn_solid_text name, doc;
    tn_solid_part *parts;      /* of a box, genes or goal: the last first */
    tn_solid_entries entries;  /* axes, genes, expressions */
    tn_solid_number number[2]; /* depth of `flat`, the two of `unit`; target and weight of a goal */
    tn_span given[2];          /* of a goal: where target and weight are, empty where they are not */
    bool damaged;              /* something of it was complained of */
    struct tn_solid_item *next;
} tn_solid_item;

typedef struct tn_solid_design {
    tn_solid_text name, doc, base;
    tn_span span;
    tn_solid_item *first, *last;
    struct tn_solid_design *next;
} tn_solid_design;

typedef struct tn_solid_use {
    tn_solid_text path;
    tn_use *use;
    struct tn_solid_use *next;
} tn_solid_use;

typedef struct tn_solid_file {
    tn_solid_design *first, *last;
    struct {
        tn_solid_use *first, *last;
    } uses;
    bool damaged;
} tn_solid_file;

/* Parses the source as a .solid file. NULL if out of memory; errors are in the diagnostics. */
tn_solid_file *tn_parse_solid(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens);

void *tn_solid_lexer_new(tn_parsing *parse);
void tn_solid_lexer_free(void *scanner);

/* Constructors; out of memory is the arena's to remember. */
tn_solid_item *tn_solid_item_new(tn_parsing *parse, tn_solid_statement kind, tn_span span);
tn_solid_part *tn_solid_part_new(tn_parsing *parse, tn_solid_part_kind kind, tn_span span, tn_solid_part *before);
tn_solid_entry *tn_solid_entry_new(tn_parsing *parse, tn_span span);
tn_solid_entries tn_solid_entries_add(tn_solid_entries list, tn_solid_entry *entry);
tn_solid_design *tn_solid_design_new(tn_parsing *parse);
void tn_solid_add_item(tn_solid_design *design, tn_solid_item *item);
void tn_solid_add_design(tn_parsing *parse, tn_solid_design *design);
void tn_solid_add_use(tn_parsing *parse, tn_solid_text path);

/* ---- meaning */

typedef struct tn_checked_box {
    const tn_solid_item *item;
    tn_box_record record; /* but for its texts */
    struct tn_checked_box *next;
} tn_checked_box;

typedef struct tn_checked_solid {
    const tn_solid_design *design;
    struct tn_checked_solid *base; /* whose boxes and conditions come first, or NULL */
    tn_checked_box *first, *last;  /* its own */
    bool anew;                     /* those of its base are among them, since its settings change them */
    uint32_t box_count;            /* with those of its base */
    uint32_t flags, model;
    double depth;
    tn_face_unit unit;                                     /* what faces are whole numbers of; 0 / 0 without one */
    const tn_solid_item *settings[TN_SOLID_SETTING_COUNT]; /* its own, or its base's */
    bool imported;
    bool wrong; /* something of it was complained of */
    struct tn_checked_solid *next;
} tn_checked_solid;

typedef struct tn_checked_solids {
    tn_checked_solid *first, *last;
} tn_checked_solids;

/* Checks the designs of all units. False if there were errors. */
bool tn_check_solids(tn_arena *arena, tn_diagnostics *diagnostics, const tn_imports *imports,
                     tn_checked_solids *solids);

/* The boxes of one design: their faces and planes. */
typedef struct tn_solid_check {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    tn_checked_solid *solid;
    bool damaged; /* statements of the file are missing because of errors already reported */
} tn_solid_check;

void tn_check_box(tn_solid_check *check, const tn_solid_item *item);
void tn_check_genes(tn_solid_check *check, const tn_solid_item *item);

/* The value of a number in units of the design, rounded once; wrong ones are reported, and 0. */
double tn_solid_value(tn_solid_check *check, const tn_solid_number *number);

/* A face: as it is written, and where the grid of `unit` puts it, each rounded once. */
typedef struct tn_solid_place {
    double written, at;
} tn_solid_place;

/* The face that a number says; wrong ones are reported, and 0. */
void tn_solid_corner(tn_solid_check *check, const tn_solid_number *number, tn_solid_place *face);

/* a + b * weight / 2 with weight -1, 0 or 1, worked out exactly; a: NULL for 0. False if it cannot be held. */
bool tn_solid_face(tn_solid_check *check, const tn_solid_number *a, const tn_solid_number *b, int weight,
                   tn_solid_place *face);

/* What expressions of designs speak of. */
extern const tn_expression_scope tn_solid_scope;

/* A goal's target (which is 0) or weight (1): a plain number; `otherwise` where it is not written. */
double tn_solid_goal_number(const tn_sources *sources, const tn_solid_item *item, int which, double otherwise);

/* Gives each expression that is measured its words, which are its name where it is printed: with the blanks of the
 * layout, so that a name does not hang on how the file is laid out. Out of memory is the arena's to remember. */
void tn_solid_name_measures(tn_arena *arena, const tn_source *source, const tn_tokens *tokens, tn_solid_file *file);

/* Does a requirement, of which nothing is wrong, hold of every design, or of none? */
typedef enum tn_solid_answer { TN_SOLID_DEPENDS, TN_SOLID_ALWAYS, TN_SOLID_NEVER } tn_solid_answer;

/* ---- words: sets of the places of words.def, as TN_SOLID_AT(BOX) | TN_SOLID_AT(GENES) */

enum tn_solid_word_place {
#define PLACE(ID, BLOCK, HEADS, WHERE) TN_SOLID_WORD_PLACE_##ID,
#include "compiler/solid/words.def"
    TN_SOLID_WORD_PLACE_COUNT
};
_Static_assert(TN_SOLID_WORD_PLACE_COUNT < 64, "a set of places has a bit for each");
#define TN_SOLID_AT(ID) (UINT64_C(1) << TN_SOLID_WORD_PLACE_##ID)

extern const tn_vocabulary tn_solid_words;

#endif
