/* The codes of errors and warnings, and what each means. */
#ifndef TARTAN_CLI_SOURCE_CODES_H
#define TARTAN_CLI_SOURCE_CODES_H

#include <stdint.h>

#include "runtime/base/buffer.h"

typedef struct tn_code_row {
    uint32_t code;
    const char *summary;
} tn_code_row;

const tn_code_row *tn_code_rows(size_t *count);

/* NULL if there is none. */
const tn_code_row *tn_code_row_of(uint32_t code);

/* What `tartan explain-code` prints: the summary, what is said of wrong files, how a warning is turned off. */
void tn_code_explain(const tn_code_row *row, tn_buffer *text);

#endif
