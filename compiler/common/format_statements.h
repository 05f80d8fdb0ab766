/* Laying out notations whose statements end with `;` and stand in blocks: a statement a line; one that is too long goes
 * on where its next part begins. */
#ifndef TARTAN_COMPILER_COMMON_FORMAT_STATEMENTS_H
#define TARTAN_COMPILER_COMMON_FORMAT_STATEMENTS_H

#include "compiler/common/format_tokens.h"

/* What a notation says of its tokens. */
typedef struct tn_statement_format {
    tn_format_gap_before *gap_before;
    bool (*at_part)(const tn_format *format, size_t i); /* may the statement go on in a new line here? */
    bool (*ends)(const tn_format *format, size_t i);    /* `;`, or a brace of a block of statements */
} tn_statement_format;

/* A minus that stands before what it turns round, not between two. */
bool tn_format_is_minus_sign(const tn_format *format, size_t i);

void tn_format_statements(tn_format *format, const tn_statement_format *how);

#endif
