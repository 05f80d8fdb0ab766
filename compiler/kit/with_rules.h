/* A kit with other rules: what breeding and exporting write. */
#ifndef TARTAN_COMPILER_KIT_WITH_RULES_H
#define TARTAN_COMPILER_KIT_WITH_RULES_H

#include "runtime/base/error.h"

/* The text of a kit without the rules whose names `rules` (a text of statements) has too, and those behind it. Where
 * `folder` is not NULL, files that the kit uses by a path from there are named by their whole path. What does not parse
 * stays as it is: compiling the result says what is wrong. *text: the caller's to free. TN_MEMORY, or TN_LIMIT for
 * texts that are too long. */
tn_status tn_kit_with_rules(const char *kit, const char *rules, size_t rules_size, const char *folder, char **text,
                            tn_error *error);

/* Shows each file that a kit's text names and that is no kit (meshes, pictures, models), by its path as it is written.
 */
typedef tn_status tn_kit_file_visit(void *context, const char *path, tn_error *error);
tn_status tn_kit_attached(const char *kit, tn_kit_file_visit *visit, void *context, tn_error *error);

#endif
