/* The .field notation: implicit surfaces as expressions (docs/field-language.md): syntax tree, checking, what is
 * emitted.
 *
 * A file is a list of statements, or one bare expression. Everything lives in the compilation's arena.
 */
#ifndef TARTAN_COMPILER_FIELD_FIELD_H
#define TARTAN_COMPILER_FIELD_FIELD_H

#include "compiler/common/expression.h"
#include "compiler/common/import.h"
#include "compiler/common/layout.h"
#include "compiler/common/parsing.h"
#include "compiler/common/token.h"
#include "compiler/common/words.h"
#include "runtime/base/hash_table.h"

typedef enum tn_field_statement { TN_FIELD_LET, TN_FIELD_FUNCTION, TN_FIELD_SURFACE } tn_field_statement;

typedef struct tn_field_text {
    const char *text;
    tn_span span;
} tn_field_text;

typedef struct tn_field_parameter {
    tn_field_text name;
    struct tn_field_parameter *next;
} tn_field_parameter;

typedef struct tn_field_parameters {
    tn_field_parameter *first, *last;
    uint32_t count;
} tn_field_parameters;

typedef enum tn_field_state { TN_FIELD_NEW, TN_FIELD_OPEN, TN_FIELD_DONE, TN_FIELD_WRONG } tn_field_state;

/* What a name stands for. */
typedef struct tn_field_definition {
    tn_field_statement kind;
    tn_field_text name;
    const char *doc; /* or NULL */
    tn_field_parameters parameters;
    tn_expression *body;
    tn_span span;
    uint32_t unit; /* index among the imported */
    bool used;
    tn_field_state state; /* of looking for circles */
    struct tn_field_definition *next;
} tn_field_definition;

typedef enum tn_field_setting_kind {
    TN_FIELD_BOX,
    TN_FIELD_GRID,
    TN_FIELD_UNIT,
    TN_FIELD_SETTING_COUNT
} tn_field_setting_kind;

typedef struct tn_field_setting {
    tn_field_setting_kind kind;
    tn_span span;
    tn_expression *corners; /* of a box: its operands are the six numbers */
    tn_decimal number;
    tn_field_text word;
} tn_field_setting;

typedef struct tn_field_use {
    tn_field_text path;
    struct tn_field_use *next;
} tn_field_use;

typedef struct tn_field_file {
    tn_field_definition *first, *last;
    struct {
        tn_field_use *first, *last;
    } uses;
    size_t use_count;
    tn_field_setting *settings[TN_FIELD_SETTING_COUNT]; /* NULL: not given */
    bool damaged;
} tn_field_file;

/* Parses the source as a .field file. NULL if out of memory; errors are in the diagnostics. */
tn_field_file *tn_parse_field(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens);

/* The lexer, for its parser: NULL if out of memory. */
void *tn_field_lexer_new(tn_parsing *parse);
void tn_field_lexer_free(void *scanner);

/* Constructors; out of memory is the arena's to remember. */
tn_field_parameters tn_field_parameter_add(tn_parsing *parse, tn_field_parameters list, tn_field_text name);
void tn_field_define(tn_parsing *parse, tn_field_statement kind, tn_span span, tn_field_text name, const char *doc,
                     tn_field_parameters parameters, tn_expression *body);
void tn_field_add_use(tn_parsing *parse, tn_field_text path);
void tn_field_set(tn_parsing *parse, tn_field_setting setting);
void tn_field_add_bare(tn_parsing *parse, tn_expression *body);

/* The name of the function that places a surface elsewhere: no other can be called so, being a word of the language. */
#define TN_FIELD_AT_NAME "at"

/* ---- meaning */

typedef struct tn_checked_fields {
    tn_field_definition **definitions; /* of all files; expressions refer to them by their index */
    uint32_t definition_count;
    const tn_field_file *file; /* that is compiled */
    uint32_t unit;
} tn_checked_fields;

/* Looks all names up and says what is wrong; the resolver (NULL: none) is asked for the library's shapes. False where
 * out of memory. Afterwards, where there were no errors, of each expression `op` is: TN_OP_COORDINATE (of which `term`
 * is the axis), TN_OP_TERM (of which it is the parameter), TN_OPCODE_COUNT (the definition; or of `at` none),
 * TN_OP_MESH_DISTANCE, an operation's or TN_OP_NUMBER. */
bool tn_check_field(tn_arena *arena, tn_diagnostics *diagnostics, const tn_imports *imports,
                    const tn_resolver *resolver, tn_checked_fields *checked);

bool tn_field_is_at(const tn_expression *e);

/* ---- what expressions become */

#define TN_FIELD_NODES_MAX 100000u  /* of one field, after sharing */
#define TN_FIELD_STEPS_MAX 2000000u /* of making them */
#define TN_FIELD_EXPAND_MAX 2000u   /* expressions one inside another, functions expanded */

/* A shared part of an expanded expression: operands come before what is made of them. */
typedef struct tn_field_node {
    tn_opcode op; /* TN_OP_NUMBER, TN_OP_COORDINATE, TN_OP_MESH_DISTANCE or an operation's */
    uint32_t in[TN_ARITY_MAX];
    uint32_t index; /* which coordinate, which mesh */
    double number;
} tn_field_node;

typedef struct tn_field_nodes {
    tn_arena *arena;
    const tn_checked_fields *checked;
    tn_field_node *items;
    uint32_t count, capacity;
    tn_hash_table index; /* by what they are; in the arena */
    uint64_t steps;
    const char *const *mesh_paths; /* that distances are measured from, each once */
    uint32_t mesh_count;
    enum { TN_FIELD_FITS, TN_FIELD_TOO_LARGE, TN_FIELD_TOO_DEEP } fits;
} tn_field_nodes;

/* Functions, surfaces and constants put in their places; equal parts once, numbers computed. Returns the node of the
 * expression; what `fits` says comes first. */
uint32_t tn_field_expand(tn_field_nodes *nodes, const tn_expression *expression);

/* TN_OK, TN_INVALID (in the diagnostics) or TN_MEMORY. */
tn_status tn_emit_field(tn_builder *builder, tn_arena *arena, tn_diagnostics *diagnostics,
                        const tn_checked_fields *checked, tn_error *error);

/* ---- words: sets of the places of words.def, as TN_FIELD_AT(FORMULA) */

enum tn_field_word_place {
#define PLACE(ID, BLOCK, HEADS, WHERE) TN_FIELD_WORD_PLACE_##ID,
#include "compiler/field/words.def"
    TN_FIELD_WORD_PLACE_COUNT
};
_Static_assert(TN_FIELD_WORD_PLACE_COUNT < 64, "a set of places has a bit for each");
#define TN_FIELD_AT(ID) (UINT64_C(1) << TN_FIELD_WORD_PLACE_##ID)

extern const tn_vocabulary tn_field_words;

#endif
