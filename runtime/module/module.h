/* A module: what the compiler makes of a set of source files and what the engines run.
 *
 * On disk (.tnb): a 32-byte header (layout.h: magic, format version, number of sections, file size,
 * hash), a table of sections {u32 number, u32 zero, u64 offset, u64 size}, the sections.
 * All little-endian; places are offsets, never pointers. Section 0 is the strings (UTF-8,
 * each ended by a zero byte; offset 0 is the empty string), section 1 the code; the others
 * hold records (records.def). The hash is XXH3-64 over the file with the hash taken as 0.
 *
 * tn_module_load copies what it is given, decodes it, and verifies everything that running
 * relies on (verify.h), so that engines need no guards. A loaded module is immutable and may
 * be shared between threads. It owns everything reached through it; nothing reached through
 * it may be used after tn_module_free.
 */
#ifndef TARTAN_MODULE_MODULE_H
#define TARTAN_MODULE_MODULE_H

#include "runtime/base/error.h"

#define TN_MODULE_FORMAT 1u

typedef enum tn_field_kind {
    TN_FIELD_LENGTH, /* alternatives, each a length */
    TN_FIELD_CHOICE, /* alternatives, each a name */
    TN_FIELD_FLAG,   /* two values: unset, then set */
    TN_FIELD_ZONE,   /* alternatives, each a fill with a depth (or none) */
    TN_FIELD_KIND_COUNT
} tn_field_kind;

/* What a field means to a drawing; nothing else looks at it. */
typedef enum tn_field_role {
    TN_ROLE_NONE,
    TN_ROLE_LENGTH, /* the tray's extent along the row */
    TN_ROLE_LEVEL,  /* the n-th value has n levels */
    TN_ROLE_PUBLIC_END,
    TN_ROLE_GREAT_HALL,
    TN_ROLE_BAND, /* a zone drawn as a band; bands lie in schema order, top to bottom */
    TN_FIELD_ROLE_COUNT
} tn_field_role;

typedef enum tn_fill_role {
    TN_FILL_NONE,
    TN_FILL_SOLID,
    TN_FILL_VOID,
    TN_FILL_ABSENT,
    TN_FILL_ROLE_COUNT
} tn_fill_role;

typedef enum tn_function_kind {
    TN_FUNCTION_WHOLE,     /* judgement M: the stretch taken whole */
    TN_FUNCTION_HOLDS,     /* judgement H: somewhere in the region */
    TN_FUNCTION_CONDITION, /* a condition on a number */
    TN_FUNCTION_MEASURE,   /* a fitness expression */
    TN_FUNCTION_KIND_COUNT
} tn_function_kind;

typedef enum tn_clause_kind {
    TN_CLAUSE_REQUIRE,
    TN_CLAUSE_TOTAL,
    TN_CLAUSE_PRUNE,
    TN_CLAUSE_KIND_COUNT
} tn_clause_kind;

/* How a .bnf file is read and its genomes mapped (docs/genome-language.md). */
typedef enum tn_dialect { TN_DIALECT_GE, TN_DIALECT_GENR8, TN_DIALECT_COUNT } tn_dialect;

/* What becomes of edge types that a genr8 sentence leaves without a rule. */
typedef enum tn_repair { TN_REPAIR_GENOME, TN_REPAIR_IDENTITY, TN_REPAIR_OFF, TN_REPAIR_COUNT } tn_repair;

#define TN_EDGE_LETTERS 3u /* EdgeX, EdgeY, EdgeZ */
#define TN_GROUP_DEPTH 64u /* how deep { } and [ ] may nest in a production */

/* Flags of grammars. */
#define TN_SKIP_SINGLE 1u /* a rule with one alternative reads no codon */

#define TN_NO_RECORD UINT32_MAX

/* Flags of rules and libraries. */
#define TN_IMPORTED 1u /* from a file that the named file uses, not from the named file itself */

typedef uint32_t tn_string; /* an offset into the strings */

/* One struct for each section of records.def, with its fields in the order written there. */
#define TN_TYPE_STR tn_string
#define TN_TYPE_U32 uint32_t
#define TN_TYPE_I64 int64_t
#define TN_TYPE_F64 double
#define F(KIND, FIELD) TN_TYPE_##KIND FIELD;
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    typedef struct TYPE {                                                                                              \
        FIELDS                                                                                                         \
    } TYPE;
#include "runtime/module/records.def"
#undef SECTION
#undef F

typedef enum tn_section {
    TN_SECTION_STRINGS = 0,
    TN_SECTION_CODE = 1,
#define SECTION(NAME, NUMBER, TYPE, FIELDS) TN_SECTION_##NAME = NUMBER,
#include "runtime/module/records.def"
#undef SECTION
    TN_SECTION_COUNT
} tn_section;

/* The module's contents: for each section an array of its records and their number.
 * Read-only to everybody but the loader and the builder. */
typedef struct tn_module {
    const char *strings;
    size_t strings_size;
    const uint8_t *code;
    size_t code_size;
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    const TYPE *NAME##_records;                                                                                        \
    size_t NAME##_count;
#include "runtime/module/records.def"
#undef SECTION
    uint64_t hash; /* the file's */
    /* Set by the owner, or NULL: long work on the module's rules gives up (TN_STOPPED) once this is true. */
    const _Atomic bool *stop;
} tn_module;

/* Bounds that every module keeps; the compiler reports what passes them in a source (E0811, E0812). */
#define TN_FIELDS_MAX 64u    /* fields of a schema */
#define TN_VALUES_MAX 255u   /* values of a field: engines number them in a byte */
#define TN_NAME_MAX 255u     /* bytes of a name */
#define TN_SPELLING_MAX 511u /* bytes of what is made of names: "fill:depth", a clause's "rule.2" */

#define TN_STACK_MAX 65536u /* values on a function's stack: engines set aside room for them */

/* Bounds that loading enforces. tn_module_limits_default() gives the defaults. */
typedef struct tn_module_limits {
    size_t bytes;   /* of the file: 256 MiB */
    size_t records; /* in any one section: 1,000,000; never more than 2^32 - 2 */
    size_t stack;   /* of any one function: 4,096; never more than TN_STACK_MAX */
} tn_module_limits;

tn_module_limits tn_module_limits_default(void);

/* Loads and verifies a module. `limits` may be NULL (defaults). On success the caller owns *module. */
tn_status tn_module_load(const void *bytes, size_t size, const tn_module_limits *limits, tn_module **module,
                         tn_error *error);

/* Does this look like a module (its first bytes), as opposed to a source text? */
bool tn_module_has_magic(const void *bytes, size_t size);

void tn_module_free(tn_module *module);

/* The text of a string; valid while the module is. */
static inline const char *tn_text(const tn_module *module, tn_string string)
{
    return module->strings + string;
}

/* The source place of the instruction at `offset` of the code section: its own, or that of the nearest instruction
 * before it in the same function that has one; NULL where there is none. */
const tn_map_record *tn_module_place(const tn_module *module, uint32_t offset);

#endif
