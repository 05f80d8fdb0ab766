/* What an engine finds, shown where the author wrote it: a tn_error's code offset becomes a place in the source. */
#ifndef TARTAN_DRIVER_OPEN_FINDINGS_H
#define TARTAN_DRIVER_OPEN_FINDINGS_H

#include "driver/open/open.h"

/* Adds an engine's error to the diagnostics. */
tn_diagnostic *tn_finding_error(tn_opened *opened, const tn_error *error);

/* Adds a note with the error's sentence, place and help: something to know, such as a rule that falls back to the
 * interpreter. */
tn_diagnostic *tn_finding_note(tn_opened *opened, const tn_error *error);

/* A note that something is not found out since that passes a limit; its place is `otherwise` (NULL: none) where the
 * error has none. A limit that is there already, with the same sentence at the same place, is returned: each is said
 * once. */
tn_diagnostic *tn_finding_limit(tn_opened *opened, const tn_error *error, const tn_span *otherwise);

/* The source span of the code at `offset`; false where the module does not say. */
bool tn_code_span(const tn_opened *opened, uint32_t offset, tn_span *span);

/* The same as file, line and column. */
bool tn_code_place(const tn_opened *opened, uint32_t offset, tn_place *place);

/* A note that a clause of this name is in the way of counting what it keeps out (tn_library_effect). */
tn_diagnostic *tn_finding_uncounted(tn_opened *opened, const char *clause, const tn_error *error);

#endif
