/* The compact protocol of Thrift, in which Parquet writes what it says about its pages: as much of it as Parquet uses.
 *
 * A struct is a row of fields, each with its number and type, and a zero byte. Numbers take 7 bits a byte, those with
 * a sign folded so that small ones are short.
 */
#ifndef TARTAN_DRIVER_PARQUET_THRIFT_H
#define TARTAN_DRIVER_PARQUET_THRIFT_H

#include "runtime/plan/text/text.h"

enum tn_thrift_type {
    TN_THRIFT_STOP = 0,
    TN_THRIFT_TRUE = 1,
    TN_THRIFT_FALSE = 2,
    TN_THRIFT_BYTE = 3,
    TN_THRIFT_I16 = 4,
    TN_THRIFT_I32 = 5,
    TN_THRIFT_I64 = 6,
    TN_THRIFT_DOUBLE = 7,
    TN_THRIFT_BINARY = 8,
    TN_THRIFT_LIST = 9,
    TN_THRIFT_SET = 10,
    TN_THRIFT_MAP = 11,
    TN_THRIFT_STRUCT = 12
};

enum { TN_THRIFT_DEPTH = 8 }; /* structs within structs that we write */

/* ---- writing: where memory runs out, out->failed is set */

typedef struct tn_thrift_out {
    tn_buffer *out;
    int last[TN_THRIFT_DEPTH]; /* the number of the field written last, of each struct that is open */
    unsigned depth;
} tn_thrift_out;

static inline tn_thrift_out tn_thrift_to(tn_buffer *out)
{
    return (tn_thrift_out){.out = out};
}

void tn_thrift_number(tn_thrift_out *t, int field, enum tn_thrift_type type, int64_t value);
void tn_thrift_flag(tn_thrift_out *t, int field, bool value);
void tn_thrift_bytes(tn_thrift_out *t, int field, const void *bytes, size_t size);
void tn_thrift_text(tn_thrift_out *t, int field, const char *text);
void tn_thrift_begin(tn_thrift_out *t, int field);                                        /* a struct in a field */
void tn_thrift_list(tn_thrift_out *t, int field, enum tn_thrift_type type, size_t count); /* its elements follow */

/* Elements of a list. */
void tn_thrift_element(tn_thrift_out *t); /* begins a struct */
void tn_thrift_element_number(tn_thrift_out *t, int64_t value);
void tn_thrift_element_text(tn_thrift_out *t, const char *text);

/* Ends the struct that was begun last, or the outermost. */
void tn_thrift_end(tn_thrift_out *t);

/* A number of 7 bits a byte, without a sign. */
void tn_varint_write(tn_buffer *out, uint64_t value);

/* ---- reading: what is not as it should be sets `bad`, and all that follows is 0 or empty */

typedef struct tn_thrift_in {
    const uint8_t *at, *end;
    bool bad;
} tn_thrift_in;

/* A struct being read: begin with {0}. */
typedef struct tn_thrift_field {
    int number;
    enum tn_thrift_type type;
} tn_thrift_field;

typedef struct tn_thrift_string {
    const uint8_t *bytes;
    size_t size;
} tn_thrift_string;

/* The next field of the struct that *field was read last of; false at its end, or where the bytes are bad. */
bool tn_thrift_next(tn_thrift_in *in, tn_thrift_field *field);

/* The value of a field, or an element of a list, of any whole type; `bad` where the type is another. */
int64_t tn_thrift_read_number(tn_thrift_in *in, enum tn_thrift_type type);
tn_thrift_string tn_thrift_read_bytes(tn_thrift_in *in, enum tn_thrift_type type);

/* The size of a list whose elements should be of that type; at most as many as there are bytes left. */
size_t tn_thrift_read_list(tn_thrift_in *in, enum tn_thrift_type type, enum tn_thrift_type element);

/* Passes over a value. */
void tn_thrift_skip(tn_thrift_in *in, enum tn_thrift_type type);

/* A number of 7 bits a byte; `bad` past 64 bits. */
uint64_t tn_varint_read(tn_thrift_in *in);

/* A number with a sign, as the compact protocol folds it. */
static inline int64_t tn_unfold(uint64_t value)
{
    return (int64_t)(value >> 1) ^ -(int64_t)(value & 1);
}

static inline uint64_t tn_fold(int64_t value)
{
    return (uint64_t)value << 1 ^ (uint64_t)(value >> 63);
}

#endif
