/* Reads part files of LDraw libraries: how large a part is, and where its studs and tubes are.
 *
 * A part is made of sub-files. One whose name begins with stud is a stud, or a tube where its first line says so; a
 * part is as large as what is in all others. A tn_part_file owns its arrays; clear it in any case. */
#ifndef TARTAN_PLACE_PART_FILE_H
#define TARTAN_PLACE_PART_FILE_H

#include "runtime/base/error.h"
#include "runtime/module/values.h"

/* Gives the bytes of a file, which is called `name` in small letters, with / between folders; the reader frees them.
 * TN_IO if there is none. */
typedef struct tn_part_library {
    tn_status (*read)(void *context, const char *name, uint8_t **bytes, size_t *size, tn_error *error);
    void *context;
} tn_part_library;

typedef enum tn_part_stud_kind { TN_PART_STUD, TN_PART_TUBE, TN_PART_PIN } tn_part_stud_kind;

/* A stud points away from the part, from `at`. A tube, which is round four studs, and a pin, which is between two,
 * begin inside; `at` is their end, where they point. */
typedef struct tn_part_stud {
    double at[3]; /* LDU, y downwards */
    tn_axis axis;
    tn_part_stud_kind kind;
} tn_part_stud;

typedef struct tn_part_file {
    double low[3], high[3]; /* LDU, y downwards; low above high where there is nothing */
    tn_part_stud *studs;    /* those that point along an axis, in their order */
    size_t stud_count, stud_capacity;
    size_t tilted; /* studs that do not */
} tn_part_file;

/* TN_INVALID or TN_IO (no code) with what is wrong: a file that is missing or contains itself, a line that cannot be
 * read; TN_LIMIT if files nest deeper than 32 or have more than 1,000,000 lines together, or 4,096
 * studs. */
tn_status tn_part_file_read(const tn_part_library *library, const char *name, tn_part_file *part, tn_error *error);
void tn_part_file_clear(tn_part_file *part);

#endif
