/* The sizes and places of a module's file that the builder and the loader share; module.h describes the format. */
#ifndef TARTAN_MODULE_LAYOUT_H
#define TARTAN_MODULE_LAYOUT_H

#include "runtime/module/module.h"

/* As PNG's: a byte that is no text, the name, and line ends that a transfer as text would change. */
#define TN_MAGIC "\x89TNB\r\n\x1a\n"

enum {
    TN_MAGIC_SIZE = 8,
    TN_HEADER_FORMAT = 8,    /* u32 */
    TN_HEADER_SECTIONS = 12, /* u32 */
    TN_HEADER_SIZE = 16,     /* u64: of the file */
    TN_HEADER_HASH = 24,     /* u64 */
    TN_HEADER_BYTES = 32,
    TN_ENTRY_NUMBER = 0, /* u32, then a u32 that is zero */
    TN_ENTRY_OFFSET = 8, /* u64 */
    TN_ENTRY_SIZE = 16,  /* u64 */
    TN_ENTRY_BYTES = 24,
    TN_CONTENTS = TN_HEADER_BYTES + TN_SECTION_COUNT * TN_ENTRY_BYTES,
};

/* Bytes of a record as stored: TN_STORED_SCHEMA and so on. */
enum {
#define TN_BYTES_STR 4
#define TN_BYTES_U32 4
#define TN_BYTES_I64 8
#define TN_BYTES_F64 8
#define F(KIND, FIELD) +TN_BYTES_##KIND
#define SECTION(NAME, NUMBER, TYPE, FIELDS) TN_STORED_##NAME = 0 FIELDS,
#include "runtime/module/records.def"
#undef SECTION
#undef F
};

/* XXH3-64 over the file with the eight bytes of the hash taken as zero; size >= TN_HEADER_BYTES. */
uint64_t tn_module_hash_bytes(const uint8_t *bytes, size_t size);

#endif
