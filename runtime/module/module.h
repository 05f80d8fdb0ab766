/* A module: what the compiler makes of a set of source files and what the engines run.
 *
 * On disk (.tnb): a 32-byte header (layout.h: magic, format version, number of sections, file size, hash), a table of
 * the sections that are not empty, each {u16 number, u16 bytes of a record, u32 records}, and these sections one after
 * another. All little-endian; places are offsets, never pointers. Section 0 is the strings (UTF-8, each ended by a zero
 * byte; offset 0 is the empty string), section 1 the code; the others hold records (records.def). Numbers ascend. The
 * hash is XXH3-64 over the file with the hash taken as 0.
 *
 * An unknown section is refused: it was made by a newer Tartan. A record that ends before its row does is one that an
 * older Tartan wrote: the fields that it lacks take the row's defaults. One that is longer is refused as newer.
 *
 * Loading (runtime/load.h) copies what it is given, decodes it, and verifies everything that running relies on
 * (verify.h), so that engines need no guards. A loaded module is immutable and may be shared between threads. It owns
 * everything reached through it; nothing reached through it may be used after tn_module_free.
 */
#ifndef TARTAN_MODULE_MODULE_H
#define TARTAN_MODULE_MODULE_H

#include "runtime/base/watch.h"
#include "runtime/module/opcodes.h"
#include "runtime/module/values.h"

#define TN_MODULE_FORMAT 2u

typedef uint32_t tn_string; /* an offset into the strings */

/* One struct for each section of records.def, with its fields in the order written there. */
#define STR(FIELD) tn_string FIELD;
#define NAME(FIELD, MOST) tn_string FIELD;
#define NAME_OR_NONE(FIELD, MOST) tn_string FIELD;
#define U32(FIELD, LOW, HIGH) uint32_t FIELD;
#define I64(FIELD, LOW, HIGH) int64_t FIELD;
#define F64(FIELD, LOW, HIGH) double FIELD;
#define BITS(FIELD) int64_t FIELD;
#define ENUM(FIELD, OF) uint32_t FIELD;
#define FLAGS(FIELD, MASK, WORDS) uint32_t FIELD;
#define REF(FIELD, OF) uint32_t FIELD;
#define REF_OR_NONE(FIELD, OF) uint32_t FIELD;
#define REF_AT_TIMES(FIELD, OF) uint32_t FIELD;
#define RUN(FIELD, OF, LOW, HIGH) uint32_t FIELD##_first, FIELD##_count;
#define SLICE(FIELD, OF) uint32_t FIELD##_first, FIELD##_count;
#define CODE(FIELD) uint32_t FIELD##_begin, FIELD##_end;
#define PLACE() uint32_t file, begin, end;
#define DEFAULT(FIELD, VALUE)
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    typedef struct TYPE {                                                                                              \
        FIELDS                                                                                                         \
    } TYPE;
#include "runtime/module/records.def"

/* The sections by their place in the table. TN_SECTION_NAME_NUMBER is what the file calls one. */
typedef enum tn_section {
    TN_SECTION_STRINGS,
    TN_SECTION_CODE,
#define SECTION(NAME, NUMBER, TYPE, FIELDS) TN_SECTION_##NAME,
#include "runtime/module/records.def"
    TN_SECTION_COUNT
} tn_section;

/* A section's records, or the bytes of the strings or the code. */
typedef struct tn_table {
    const void *records;
    size_t count;
} tn_table;

/* The module's contents: for each section an array of its records and their number, under its name and once more in a
 * table for what works on sections of any kind. Read-only to everybody but the loader. */
typedef struct tn_module {
    const char *strings;
    size_t strings_size;
    const uint8_t *code;
    size_t code_size;
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    const TYPE *NAME##_records;                                                                                        \
    size_t NAME##_count;
#include "runtime/module/records.def"
    tn_table tables[TN_SECTION_COUNT];
    uint64_t hash; /* the file's */
    /* Set by the owner, or NULL: long work on the module's rules gives up (TN_STOPPED) once this says so. */
    tn_watch *watch;
} tn_module;

#define TN_STACK_MAX 65536u /* values on a function's stack: engines set aside room for them */

/* Bounds that loading enforces. tn_module_limits_default() gives the defaults. */
typedef struct tn_module_limits {
    size_t bytes;   /* of the file: 256 MiB */
    size_t records; /* in any one section: 1,000,000; never more than 2^32 - 2 */
    size_t stack;   /* of any one function: 4,096; never more than TN_STACK_MAX */
} tn_module_limits;

tn_module_limits tn_module_limits_default(void);

/* Does this look like a module (its first bytes), as opposed to a source text? */
bool tn_module_has_magic(const void *bytes, size_t size);

/* The hash of a file: XXH3-64 over it with the eight bytes of the hash taken as zero; at least a header long. */
uint64_t tn_module_hash_bytes(const uint8_t *bytes, size_t size);

void tn_module_free(tn_module *module);

/* The text of a string; valid while the module is. */
static inline const char *tn_text(const tn_module *module, tn_string string)
{
    return module->strings + string;
}

/* Does a module hold a grammar that genomes are mapped through? */
static inline bool tn_module_has_grammar(const tn_module *module)
{
    return module->GRAMMAR_count > 0 && module->GRAMMAR_records[0].dialect != TN_DIALECT_PLACE;
}

#endif
