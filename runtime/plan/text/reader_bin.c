/* Packed plans: a header, then for each plan its length (LEB128) and its trays. */
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/plan/text/pack.h"
#include "runtime/plan/text/reader.h"

static const uint8_t *input(const tn_plan_reader *reader)
{
    return (const uint8_t *)reader->data + reader->begin;
}

/* The path stands in the message where the error has no line. */
static tn_status damaged(const tn_plan_reader *reader, const char *what, tn_error *error)
{
    bool opening = reader->line == 0;
    tn_fail(error, TN_INVALID, E_PLAN_FILE, "%s%sthe packed plans are damaged: %s", opening ? reader->path : "",
            opening ? ": " : "", what);
    tn_error_help(error, "make the file again from its library, or get another copy of it");
    return TN_INVALID;
}

/* Drops `count` bytes of input, which may be more than fit in memory. */
static tn_status skip(tn_plan_reader *reader, uint64_t count, tn_error *error)
{
    while (count > 0) {
        tn_status status = tn_reader_fill(reader, 1, error);
        if (status != TN_OK)
            return status;
        uint64_t here = reader->end - reader->begin;
        if (here == 0)
            return damaged(reader, "the file ends too soon", error);
        here = here < count ? here : count;
        reader->begin += (size_t)here;
        count -= here;
    }
    return TN_OK;
}

tn_status tn_reader_bin_open(tn_plan_reader *reader, tn_error *error)
{
    if (reader->end - reader->begin < TN_PACK_HEADER)
        return damaged(reader, "the header is cut off", error);
    const uint8_t *header = input(reader);
    uint64_t version = tn_get_u32(header + 8), tray_bytes = tn_get_u32(header + 12);
    uint64_t schema_hash = tn_get_u64(header + 16), metadata = tn_get_u64(header + 24);
    if (version != TN_PACK_VERSION)
        return tn_fail(error, TN_INVALID, E_PLAN_FILE, "%s: packed plans of version %llu, and only version %u is known",
                       reader->path, (unsigned long long)version, TN_PACK_VERSION);
    if (schema_hash != tn_pack_schema_hash(reader->schema) || tray_bytes != tn_pack_tray_bytes(reader->schema)) {
        tn_fail(error, TN_INVALID, E_PLAN_FILE, "%s: these packed plans were made with another schema than %.80s",
                reader->path, tn_text(reader->schema->module, reader->schema->record->name));
        tn_error_help(error, "name the rule file that they were made with");
        return TN_INVALID;
    }
    reader->tray_bytes = (unsigned)tray_bytes;
    reader->begin += TN_PACK_HEADER;
    return skip(reader, metadata, error);
}

static tn_status read_length(tn_plan_reader *reader, uint64_t *length, tn_error *error)
{
    *length = 0;
    for (unsigned shift = 0;; shift += 7) {
        tn_status status = tn_reader_fill(reader, 1, error);
        if (status != TN_OK)
            return status;
        if (reader->begin == reader->end)
            return damaged(reader, "the file ends too soon", error);
        uint8_t byte = *input(reader);
        reader->begin++;
        if (shift > 28)
            return damaged(reader, "a plan's length is out of range", error);
        *length |= (uint64_t)(byte & 0x7f) << shift;
        if (!(byte & 0x80))
            return TN_OK;
    }
}

tn_status tn_reader_bin_step(tn_plan_reader *reader, tn_error *error)
{
    uint64_t length;
    tn_status status = read_length(reader, &length, error);
    return status == TN_OK ? skip(reader, length * reader->tray_bytes, error) : status;
}

tn_status tn_reader_bin_next(tn_plan_reader *reader, bool *found, tn_error *error)
{
    tn_status status = tn_reader_fill(reader, 1, error);
    *found = status == TN_OK && reader->begin < reader->end;
    if (!*found)
        return status;
    reader->line++;
    uint64_t length;
    status = read_length(reader, &length, error);
    if (status != TN_OK)
        return status;
    if (length > reader->max_length) {
        status = skip(reader, length * reader->tray_bytes, error);
        return status == TN_OK ? tn_reader_too_long(reader, length, error) : status;
    }
    size_t bytes = tn_size_of((size_t)length, reader->tray_bytes);
    status = tn_reader_fill(reader, bytes, error);
    if (status != TN_OK)
        return status;
    if (reader->end - reader->begin < bytes)
        return damaged(reader, "the file ends too soon", error);
    if (!tn_plan_reserve(&reader->plan, (size_t)length))
        return tn_fail_memory(error);
    reader->plan.length = (size_t)length;
    const uint8_t *packed = input(reader);
    reader->begin += bytes;
    return tn_unpack_trays(reader->schema, packed, (size_t)length, reader->plan.trays)
               ? TN_OK
               : damaged(reader, "this one holds a tray that the schema does not have", error);
}
