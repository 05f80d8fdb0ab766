/* Would a test of a file come out otherwise if its rules were changed? Asked of the interpreter, which runs what the
 * change has changed, and takes from before what it has not.
 *
 * A tn_noticing borrows the opened file and the schema.
 */
#ifndef TARTAN_DRIVER_COVERAGE_NOTICING_H
#define TARTAN_DRIVER_COVERAGE_NOTICING_H

#include "driver/open/open.h"
#include "runtime/plan/schema/schema.h"

typedef struct tn_noticing tn_noticing;

/* Runs the tests of rules and libraries of a schema, and those of measures and houses. */
tn_status tn_noticing_new(tn_opened *opened, const tn_schema *schema, tn_noticing **noticing, tn_error *error);
void tn_noticing_free(tn_noticing *noticing);

/* Opens the changed file once more, with the values that its test of a number gives params. */
typedef struct tn_reopen {
    tn_status (*open)(void *context, size_t test, tn_opened *opened);
    void *context;
} tn_reopen;

/* *notices: does a case come out otherwise in the changed file? `changed` is its schema. What its tests report goes to
 * the diagnostics of the changed file. */
tn_status tn_noticing_ask(const tn_noticing *noticing, tn_opened *changed_file, const tn_schema *changed,
                          const tn_reopen *reopen, bool *notices, tn_error *error);

#endif
