/* Builds a module's bytes: the one writer of the format that module.h describes.
 *
 * A builder belongs to one thread; free it with tn_builder_free. The functions that add
 * return the new record's index (or the string's offset). Out of memory is remembered and
 * reported by tn_builder_finish, so that the calls in between need no checks.
 */
#ifndef TARTAN_MODULE_BUILDER_H
#define TARTAN_MODULE_BUILDER_H

#include "runtime/module/module.h"
#include "runtime/module/opcodes.h"

typedef struct tn_builder tn_builder;

tn_builder *tn_builder_new(void); /* NULL if out of memory */
void tn_builder_free(tn_builder *builder);

/* Interns a text (equal texts share an offset). NULL is the empty string. */
tn_string tn_builder_string(tn_builder *builder, const char *text);
tn_string tn_builder_string_n(tn_builder *builder, const char *text, size_t length);

/* Appends a record: tn_builder_add_SCHEMA(builder, &(tn_schema_record){...}) and so on. */
#define SECTION(NAME, NUMBER, TYPE, FIELDS) uint32_t tn_builder_add_##NAME(tn_builder *builder, const TYPE *record);
#include "runtime/module/records.def"

/* Changes a record that was added before. */
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    void tn_builder_set_##NAME(tn_builder *builder, uint32_t index, const TYPE *record);
#include "runtime/module/records.def"

/* How many records a section has so far. */
size_t tn_builder_count(const tn_builder *builder, tn_section section);

/* Appends an instruction; operands that its row does not name are ignored. Returns its code offset. */
uint32_t tn_builder_emit(tn_builder *builder, tn_opcode opcode, int64_t first, int64_t second);

/* Where the next instruction will be. */
uint32_t tn_builder_offset(const tn_builder *builder);

/* The finished module, in memory that the caller frees with free(). The builder may not be used after. */
tn_status tn_builder_finish(tn_builder *builder, uint8_t **bytes, size_t *size, tn_error *error);

/* Puts the right hash into a module's header (after a test changed its bytes). */
void tn_module_rehash(uint8_t *bytes, size_t size);

#endif
