/* Pages: the parts of a file of Parquet that are compressed, each with a head before it. */
#ifndef TARTAN_DRIVER_PARQUET_PAGE_H
#define TARTAN_DRIVER_PARQUET_PAGE_H

#include "driver/parquet/thrift.h"

/* The numbers of the Parquet format that we write or read (the format's specification, parquet.thrift). */

#define TN_PARQUET_MAGIC "PAR1" /* the first and the last four bytes */
#define TN_PARQUET_TAIL 8u      /* bytes behind the footer: its size and the magic */

enum tn_parquet_type {
    TN_PARQUET_INT32 = 1,
    TN_PARQUET_INT64 = 2,
    TN_PARQUET_DOUBLE = 5,
    TN_PARQUET_TEXT = 6,
    TN_PARQUET_FIXED = 7
};

enum tn_parquet_repetition { TN_PARQUET_REQUIRED = 0, TN_PARQUET_OPTIONAL = 1, TN_PARQUET_REPEATED = 2 };

enum tn_parquet_converted { TN_CONVERTED_UTF8 = 0, TN_CONVERTED_LIST = 3, TN_CONVERTED_DECIMAL = 5 };

/* Numbers of the union LogicalType's members. */
enum tn_parquet_logical { TN_LOGICAL_STRING = 1, TN_LOGICAL_LIST = 3, TN_LOGICAL_DECIMAL = 5 };

enum tn_parquet_page { TN_PAGE_DATA = 0, TN_PAGE_DICTIONARY = 2, TN_PAGE_DATA_V2 = 3 };

enum tn_parquet_codec { TN_CODEC_NONE = 0, TN_CODEC_ZSTD = 6 };

enum tn_parquet_encoding {
    TN_ENCODING_PLAIN = 0,
    TN_ENCODING_PLAIN_DICTIONARY = 2, /* as RLE_DICTIONARY, by older writers */
    TN_ENCODING_RLE = 3,
    TN_ENCODING_DELTA = 5, /* DELTA_BINARY_PACKED */
    TN_ENCODING_RLE_DICTIONARY = 8
};

/* ---- writing */

/* What compresses pages by zstd. */
typedef struct tn_page_packer {
    void *context;
    tn_buffer packed;
} tn_page_packer;

tn_status tn_page_packer_new(tn_page_packer *packer, tn_error *error);
void tn_page_packer_free(tn_page_packer *packer);

/* A page: how its values are encoded, and how many there are (of a list, places: a list without elements is one). */
typedef struct tn_page_kind {
    enum tn_parquet_page page;
    enum tn_parquet_encoding encoding;
    size_t values;
} tn_page_kind;

/* Appends the page, compressed. *loose grows by its size before that. False where out of memory. */
bool tn_page_write(tn_page_packer *packer, tn_page_kind kind, const tn_buffer *body, tn_buffer *out, uint64_t *loose);

/* ---- reading */

/* What the head of a page says. */
typedef struct tn_page_head {
    int64_t page, encoding;
    int64_t values;
    int64_t size, packed; /* bytes, before and after compression */
    int64_t levels[2];    /* pages of the second version: bytes of the levels of repetition and definition */
    bool packs;           /* is it compressed, where the column is? */
    bool has_values;      /* is all of that there? */
} tn_page_head;

/* Reads the head; false where it cannot be. in->at is then behind it. */
bool tn_page_head_read(tn_thrift_in *in, tn_page_head *head);

/* What undoes the compression of pages. */
typedef struct tn_page_unpacker {
    void *context;
} tn_page_unpacker;

tn_status tn_page_unpacker_new(tn_page_unpacker *unpacker, tn_error *error);
void tn_page_unpacker_free(tn_page_unpacker *unpacker);

/* Undoes it; false where that does not give `size` bytes exactly. */
bool tn_page_unpack(tn_page_unpacker *unpacker, const uint8_t *packed, size_t packed_size, uint8_t *bytes, size_t size);

#endif
