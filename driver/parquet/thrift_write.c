/* Writes the compact protocol of Thrift. */
#include <string.h>

#include "driver/parquet/thrift.h"

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
