/* What each engine does, run on a module from anywhere within small limits: the functions of the column `fuzz` of
 * runtime/engines.def. Together they do what every command does with a module. A run that breaks a promise of its
 * engine aborts; one that ends with an error has done right.
 */
#ifndef TARTAN_TESTS_FUZZ_ENGINES_H
#define TARTAN_TESTS_FUZZ_ENGINES_H

#include <stdio.h>
#include <stdlib.h>

#include "runtime/base/picture.h"
#include "runtime/module/module.h"

#define ENGINE(NAME, FUZZ) void FUZZ(const tn_module *module);
#include "runtime/engines.def"

/* Lists the module and runs every engine on it. */
void fuzz_engines(const tn_module *module);

/* Says what promise is broken, and aborts. */
_Noreturn static inline void fuzz_broken(const char *promise)
{
    fprintf(stderr, "%s\n", promise);
    abort();
}

/* Pictures take long, so only one module in some is drawn: is this one? Throws the picture away again. */
bool fuzz_draws(const tn_module *module);
void fuzz_drawn(tn_picture *picture);

#endif
