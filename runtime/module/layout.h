/* The sizes and places of a module's file that the builder and the loader share; module.h describes the format. */
#ifndef TARTAN_MODULE_LAYOUT_H
#define TARTAN_MODULE_LAYOUT_H

/* As PNG's: a byte that is no text, the name, and line ends that a transfer as text would change. */
#define TN_MAGIC "\x89TNB\r\n\x1a\n"

enum {
    TN_MAGIC_SIZE = 8,
    TN_HEADER_FORMAT = 8,    /* u32 */
    TN_HEADER_SECTIONS = 12, /* u32: that are not empty */
    TN_HEADER_SIZE = 16,     /* u64: of the file */
    TN_HEADER_HASH = 24,     /* u64 */
    TN_HEADER_BYTES = 32,
    TN_ENTRY_NUMBER = 0, /* u16 */
    TN_ENTRY_STORED = 2, /* u16: bytes of a record; 1 of the strings and the code */
    TN_ENTRY_COUNT = 4,  /* u32: of records; not 0 */
    TN_ENTRY_BYTES = 8,
};

#endif
