/* Schemas of libraries, `schema T of L { ... }`: what their trays are is known only once the plans of L are counted.
 *
 * The compiler never runs a rule. So it compiles the text first without such schemas and all that is about them, and
 * hands that module to its caller, who counts (tn_census_taker); then it compiles the text as it stands. A library of
 * such a schema can be what another one is made of: they are counted one after another. */
#ifndef TARTAN_COMPILER_PLAN_ROWS_H
#define TARTAN_COMPILER_PLAN_ROWS_H

#include "compiler/common/import.h"

/* Compiles the input of a compilation that was started. */
typedef tn_status tn_rows_compile(tn_compilation *compilation, const tn_compile_options *options, tn_error *error);

/* Finds the census of each schema of a library in the trees, as far as it can be known; what is wrong is left for the
 * check to report. Trees are read again for each by `compile`. */
tn_status tn_rows_count(tn_compilation *compilation, const tn_compile_options *options, const tn_imports *imports,
                        tn_rows_compile *compile, tn_error *error);

#endif
