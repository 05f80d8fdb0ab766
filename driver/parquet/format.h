/* The numbers of the Parquet format that we write or read (the format's specification, parquet.thrift). */
#ifndef TARTAN_DRIVER_PARQUET_FORMAT_H
#define TARTAN_DRIVER_PARQUET_FORMAT_H

#define TN_PARQUET_MAGIC "PAR1" /* the first and the last four bytes */
#define TN_PARQUET_TAIL 8u      /* bytes behind the footer: its size and the magic */

enum tn_parquet_type { TN_PARQUET_INT32 = 1, TN_PARQUET_INT64 = 2, TN_PARQUET_TEXT = 6, TN_PARQUET_FIXED = 7 };

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

#endif
