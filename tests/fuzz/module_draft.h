/* A module taken apart into records and instructions, so that it can be changed and written back.
 *
 * What a change makes necessary elsewhere is done here, by the rows of records.def and operands.def: references to
 * records that move are set, runs grow and shrink, places of the source map stay with their instructions. So most
 * changed modules still verify. A draft owns its memory and borrows the module.
 */
#ifndef TARTAN_TESTS_FUZZ_MODULE_DRAFT_H
#define TARTAN_TESTS_FUZZ_MODULE_DRAFT_H

#include "runtime/module/code.h"
#include "runtime/module/records.h"

typedef struct draft_instruction {
    uint8_t opcode;
    bool mapped; /* it has a place in the source */
    tn_source_map_record place;
    int64_t first, second; /* of a body: how many instructions it has */
} draft_instruction;

typedef struct draft_code {
    draft_instruction *items;
    size_t count, capacity;
} draft_code;

typedef struct draft_table {
    tn_section_info info;
    char *records;    /* as in a tn_module */
    draft_code *code; /* of each record, or all empty */
    size_t count, capacity;
    bool has_code;
} draft_table;

typedef struct draft {
    const tn_module *module;
    draft_table tables[TN_SECTION_COUNT]; /* none of the strings, the code and the map */
    char *strings;
    size_t strings_size;
    bool keep_stack; /* write stack_max as it is, not as the code needs it */
    bool failed;     /* out of memory */
} draft;

/* Takes a verified module apart. false where out of memory. Clear in any case. */
bool draft_read(const tn_module *module, draft *d);
void draft_clear(draft *d);

/* Writes a module with the right hash; the caller frees *bytes. false where it cannot be written. */
bool draft_write(draft *d, uint8_t **bytes, size_t *size);

static inline char *draft_record(const draft *d, tn_section section, size_t index)
{
    return d->tables[section].records + index * d->tables[section].info.size;
}

void draft_set_whole(void *record, const tn_member *member, int64_t value);
void draft_set_real(void *record, const tn_member *member, double value);

/* A text of the draft, and a new one. What an instruction had as a number, before its opcode was changed, is none: then
 * the first. */
static inline const char *draft_text(const draft *d, int64_t string)
{
    return d->strings + (string >= 0 && (size_t)string < d->strings_size ? string : 0);
}
tn_string draft_add_text(draft *d, const char *text, size_t size);

/* Removes a record, or puts a copy of it behind it; and so what its runs hold. */
void draft_remove(draft *d, tn_section section, size_t index);
void draft_double(draft *d, tn_section section, size_t index);

/* Puts an instruction before `at`, or removes it; bodies around it grow and shrink. */
void draft_insert_code(draft *d, draft_code *code, size_t at, draft_instruction instruction);
void draft_remove_code(draft_code *code, size_t at);

#endif
