/* The rows of records.def as data: what works on sections and fields of any kind goes by these. */
#ifndef TARTAN_MODULE_RECORDS_H
#define TARTAN_MODULE_RECORDS_H

#include <string.h>

#include "runtime/module/module.h"

/* What a field is; records.def says what each means. RUN, SLICE, CODE and PLACE are several fields. */
typedef enum tn_member_kind {
    TN_MEMBER_TEXT,  /* low..high bytes; low is 0 if it may be empty */
    TN_MEMBER_WHOLE, /* U32 or I64, low..high; an ENUM too, which has names */
    TN_MEMBER_REAL,  /* least..most */
    TN_MEMBER_BITS,
    TN_MEMBER_FLAGS, /* bits of high */
    TN_MEMBER_REF,
    TN_MEMBER_REF_OR_NONE,
    TN_MEMBER_REF_AT_TIMES,
    TN_MEMBER_RUN,   /* the first record; the next field is how many, low..high */
    TN_MEMBER_SLICE, /* likewise */
    TN_MEMBER_COUNT, /* of the run or slice before it */
    TN_MEMBER_CODE,  /* where it begins; the next field is where it ends */
    TN_MEMBER_CODE_END,
    TN_MEMBER_FILE, /* of a place; its begin and end follow */
    TN_MEMBER_BEGIN,
    TN_MEMBER_END
} tn_member_kind;

/* How a field is stored. */
typedef enum tn_storage { TN_STORAGE_U32, TN_STORAGE_I64, TN_STORAGE_F64 } tn_storage;

typedef struct tn_member {
    const char *name;
    tn_member_kind kind;
    tn_storage storage;
    uint16_t at;        /* its offset in the struct */
    tn_section section; /* of references, runs and slices */
    int64_t low, high;
    double least, most;
    const char *words;        /* "a|b|c": of flags, from the lowest on */
    const char *const *names; /* of an enumeration's values, by number, NULL if there is no value; or NULL */
} tn_member;

typedef struct tn_members {
    const tn_member *items;
    size_t count;
} tn_members;

typedef struct tn_section_info {
    const char *name;   /* "REWRITE_RULE" */
    uint16_t number;    /* in the file */
    uint16_t size;      /* of the struct */
    tn_members members; /* none of the strings and the code */
} tn_section_info;

/* The description of a section; the strings and the code have one too. */
tn_section_info tn_section_describe(tn_section section);

/* What one of its records is called: "rewrite rule". */
#define TN_TITLE_MAX 32
void tn_section_title(tn_section section, char title[TN_TITLE_MAX]);

/* The section that a file calls by this number; TN_SECTION_COUNT if there is none. */
tn_section tn_section_numbered(uint32_t number);

static inline uint32_t tn_storage_bytes(tn_storage storage)
{
    return storage == TN_STORAGE_U32 ? 4 : 8;
}

/* Bytes of a section's record as stored; 1 of the strings and the code. */
uint32_t tn_section_stored(tn_section section);

/* A field's value: a U32 or I64. */
static inline int64_t tn_member_whole(const void *record, const tn_member *member)
{
    const char *at = (const char *)record + member->at;
    if (member->storage == TN_STORAGE_U32) {
        uint32_t small;
        memcpy(&small, at, sizeof small);
        return small;
    }
    int64_t large;
    memcpy(&large, at, sizeof large);
    return large;
}

static inline double tn_member_real(const void *record, const tn_member *member)
{
    double value;
    memcpy(&value, (const char *)record + member->at, sizeof value);
    return value;
}

/* Records to and from the file's form. Reading takes records of `stored` bytes each, which end with a field; what they
 * lack takes its default. Writing returns the end of what was written. */
void tn_records_read(tn_section section, const uint8_t *from, size_t count, uint32_t stored, void *records);
uint8_t *tn_records_write(tn_section section, const void *records, size_t count, uint8_t *to);

/* Do the first `stored` bytes of a record end where a field ends? */
bool tn_records_fit(tn_section section, uint32_t stored);

#endif
