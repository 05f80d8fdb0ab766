/* What each engine does, run on a module from anywhere within small limits: the functions of the column `fuzz` of
 * runtime/engines.def. Together they do what every command does with a module. A run that breaks a promise of its
 * engine aborts; one that ends with an error has done right.
 */
#ifndef TARTAN_TESTS_FUZZ_ENGINES_H
#define TARTAN_TESTS_FUZZ_ENGINES_H

#include "runtime/module/module.h"

#define ENGINE(NAME, FUZZ) void FUZZ(const tn_module *module);
#include "runtime/engines.def"

/* Lists the module and runs every engine on it. */
void fuzz_engines(const tn_module *module);

/* Says what promise is broken, and aborts. */
_Noreturn void fuzz_broken(const char *promise);

/* A file for pictures, whose name has this extension: of this process alone, which removes it. Since pictures go
 * through files, only one module in some is drawn: is this one? */
#define FUZZ_PATH_MAX 128
void fuzz_picture_path(char path[FUZZ_PATH_MAX], const char *extension);
bool fuzz_draws(const tn_module *module);

#endif
