/* Reads the compact protocol of Thrift, from bytes of any origin. */
#include "driver/parquet/thrift.h"

#include <string.h>

/* ---- writes the compact protocol of Thrift */

enum { SHORT_LIST = 15 }; /* longer ones have their size in bytes of its own */

static void write_byte(tn_buffer *out, unsigned byte)
{
    char written = (char)byte;
    tn_buffer_append(out, &written, 1);
}

void tn_varint_write(tn_buffer *out, uint64_t value)
{
    for (; value > 0x7f; value >>= 7)
        write_byte(out, (unsigned)(value & 0x7f) | 0x80);
    write_byte(out, (unsigned)value);
}

/* Fields come in the order of their numbers, at most 15 apart. */
static void write_field(tn_thrift_out *t, int field, enum tn_thrift_type type)
{
    int *last = &t->last[t->depth];
    write_byte(t->out, (unsigned)(field - *last) << 4 | (unsigned)type);
    *last = field;
}

void tn_thrift_number(tn_thrift_out *t, int field, enum tn_thrift_type type, int64_t value)
{
    write_field(t, field, type);
    tn_varint_write(t->out, tn_fold(value));
}

void tn_thrift_flag(tn_thrift_out *t, int field, bool value)
{
    write_field(t, field, value ? TN_THRIFT_TRUE : TN_THRIFT_FALSE);
}

static void write_bytes(tn_buffer *out, const void *bytes, size_t size)
{
    tn_varint_write(out, size);
    tn_buffer_append(out, bytes, size);
}

void tn_thrift_bytes(tn_thrift_out *t, int field, const void *bytes, size_t size)
{
    write_field(t, field, TN_THRIFT_BINARY);
    write_bytes(t->out, bytes, size);
}

void tn_thrift_text(tn_thrift_out *t, int field, const char *text)
{
    tn_thrift_bytes(t, field, text, strlen(text));
}

void tn_thrift_begin(tn_thrift_out *t, int field)
{
    write_field(t, field, TN_THRIFT_STRUCT);
    tn_thrift_element(t);
}

void tn_thrift_list(tn_thrift_out *t, int field, enum tn_thrift_type type, size_t count)
{
    write_field(t, field, TN_THRIFT_LIST);
    write_byte(t->out, (unsigned)(count < SHORT_LIST ? count : SHORT_LIST) << 4 | (unsigned)type);
    if (count >= SHORT_LIST)
        tn_varint_write(t->out, count);
}

void tn_thrift_element(tn_thrift_out *t)
{
    t->last[++t->depth] = 0;
}

void tn_thrift_element_number(tn_thrift_out *t, int64_t value)
{
    tn_varint_write(t->out, tn_fold(value));
}

void tn_thrift_element_text(tn_thrift_out *t, const char *text)
{
    write_bytes(t->out, text, strlen(text));
}

void tn_thrift_end(tn_thrift_out *t)
{
    write_byte(t->out, TN_THRIFT_STOP);
    if (t->depth > 0)
        t->depth--;
}

enum { SKIPPED_DEPTH = 32 }; /* values within values that are passed over; Parquet has fewer than ten */

static unsigned read_byte(tn_thrift_in *in)
{
    if (in->at < in->end)
        return *in->at++;
    in->bad = true;
    return 0;
}

uint64_t tn_varint_read(tn_thrift_in *in)
{
    uint64_t value = 0;
    for (unsigned shift = 0; shift < 64 && !in->bad; shift += 7) {
        unsigned byte = read_byte(in);
        value |= (uint64_t)(byte & 0x7f) << shift;
        if (!(byte & 0x80))
            return value;
    }
    in->bad = true;
    return 0;
}

bool tn_thrift_next(tn_thrift_in *in, tn_thrift_field *field)
{
    unsigned byte = read_byte(in), distance = byte >> 4;
    field->type = (enum tn_thrift_type)(byte & 0xf);
    if (in->bad || field->type == TN_THRIFT_STOP)
        return false;
    int64_t number = distance > 0 ? field->number + (int64_t)distance : tn_unfold(tn_varint_read(in));
    if (number < 0 || number > INT16_MAX || field->type > TN_THRIFT_STRUCT)
        in->bad = true;
    field->number = (int)number;
    return !in->bad;
}

int64_t tn_thrift_read_number(tn_thrift_in *in, enum tn_thrift_type type)
{
    if (type == TN_THRIFT_I16 || type == TN_THRIFT_I32 || type == TN_THRIFT_I64)
        return tn_unfold(tn_varint_read(in));
    in->bad = true;
    return 0;
}

static const uint8_t *take(tn_thrift_in *in, uint64_t size)
{
    if (in->bad || size > (uint64_t)(in->end - in->at)) {
        in->bad = true;
        return NULL;
    }
    in->at += size;
    return in->at - size;
}

tn_thrift_string tn_thrift_read_bytes(tn_thrift_in *in, enum tn_thrift_type type)
{
    in->bad = in->bad || type != TN_THRIFT_BINARY;
    uint64_t size = in->bad ? 0 : tn_varint_read(in);
    const uint8_t *bytes = take(in, size);
    return bytes ? (tn_thrift_string){bytes, (size_t)size} : (tn_thrift_string){(const uint8_t *)"", 0};
}

/* The head of a list: its elements' type and their number, each of which takes a byte at least. */
static size_t read_list_head(tn_thrift_in *in, enum tn_thrift_type *element)
{
    unsigned byte = read_byte(in);
    uint64_t count = byte >> 4 == 15 ? tn_varint_read(in) : byte >> 4;
    *element = (enum tn_thrift_type)(byte & 0xf);
    if (count > (uint64_t)(in->end - in->at))
        in->bad = true;
    return in->bad ? 0 : (size_t)count;
}

size_t tn_thrift_read_list(tn_thrift_in *in, enum tn_thrift_type type, enum tn_thrift_type element)
{
    enum tn_thrift_type found;
    in->bad = in->bad || type != TN_THRIFT_LIST;
    size_t count = in->bad ? 0 : read_list_head(in, &found);
    in->bad = in->bad || (count > 0 && found != element);
    return in->bad ? 0 : count;
}

/* ---- what is not wanted */

static void skip_value(tn_thrift_in *in, enum tn_thrift_type type, unsigned depth);

static void skip_list(tn_thrift_in *in, unsigned depth)
{
    enum tn_thrift_type element;
    size_t count = read_list_head(in, &element);
    for (size_t i = 0; i < count && !in->bad; i++) {
        if (element == TN_THRIFT_TRUE || element == TN_THRIFT_FALSE)
            read_byte(in); /* in a list a flag has a byte */
        else
            skip_value(in, element, depth);
    }
}

static void skip_map(tn_thrift_in *in, unsigned depth)
{
    uint64_t count = tn_varint_read(in);
    unsigned types = count > 0 ? read_byte(in) : 0;
    for (; count > 0 && !in->bad; count--) {
        skip_value(in, (enum tn_thrift_type)(types >> 4), depth);
        skip_value(in, (enum tn_thrift_type)(types & 0xf), depth);
    }
}

static void skip_struct(tn_thrift_in *in, unsigned depth)
{
    tn_thrift_field field = {0};
    while (tn_thrift_next(in, &field))
        skip_value(in, field.type, depth);
}

static void skip_value(tn_thrift_in *in, enum tn_thrift_type type, unsigned depth)
{
    if (depth >= SKIPPED_DEPTH)
        in->bad = true;
    if (in->bad)
        return;
    switch (type) {
    case TN_THRIFT_TRUE:
    case TN_THRIFT_FALSE:
        return;
    case TN_THRIFT_BYTE:
        take(in, 1);
        return;
    case TN_THRIFT_I16:
    case TN_THRIFT_I32:
    case TN_THRIFT_I64:
        tn_varint_read(in);
        return;
    case TN_THRIFT_DOUBLE:
        take(in, 8);
        return;
    case TN_THRIFT_BINARY:
        tn_thrift_read_bytes(in, type);
        return;
    case TN_THRIFT_LIST:
    case TN_THRIFT_SET:
        skip_list(in, depth + 1);
        return;
    case TN_THRIFT_MAP:
        skip_map(in, depth + 1);
        return;
    case TN_THRIFT_STRUCT:
        skip_struct(in, depth + 1);
        return;
    default:
        in->bad = true;
    }
}

void tn_thrift_skip(tn_thrift_in *in, enum tn_thrift_type type)
{
    skip_value(in, type, 0);
}
