/* Packed plans: a tray is its number, in as few bytes as the schema's largest needs, little-endian. */
#ifndef TARTAN_PLAN_TEXT_PACK_H
#define TARTAN_PLAN_TEXT_PACK_H

#include "runtime/plan/text/text.h"

#define TN_PACK_MAGIC "TARTANPL" /* first bytes of a packed file */
#define TN_PACK_VERSION 1u
#define TN_PACK_HEADER                                                                                                 \
    32u /* bytes before the metadata: magic, u32 version, u32 bytes a tray, u64 schema hash, u64 metadata size */

/* 1 to 4. */
unsigned tn_pack_tray_bytes(const tn_schema *schema);

/* Hash of what gives tray numbers their meaning: fields, values and which trays are legal. Equal on every machine. */
uint64_t tn_pack_schema_hash(const tn_schema *schema);

/* Appends the trays. false where out of memory. */
bool tn_pack_trays(const tn_schema *schema, const tn_tray *trays, size_t length, tn_buffer *out);

/* Reads `length` trays from length * tray_bytes bytes; false where a number is no tray of the schema. `trays` has room.
 */
bool tn_unpack_trays(const tn_schema *schema, const uint8_t *bytes, size_t length, tn_tray *trays);

/* Room for `length` trays in a plan; false where out of memory. */
bool tn_plan_reserve(tn_plan *plan, size_t length);

#endif
