/* What a run's scores depend on besides its study and grammar: data, examples, first genomes, a growth study with its
 * rules and meshes. It is kept as text, a line each: a hash of the contents, and a name for people. The owner frees the
 * text. */
#ifndef TARTAN_DRIVER_BREED_INPUTS_H
#define TARTAN_DRIVER_BREED_INPUTS_H

#include "driver/open/open.h"

/* Adds a line: "0123456789abcdef fit data.csv". */
tn_status tn_inputs_add(char **inputs, const char *kind, const char *name, const void *bytes, size_t size,
                        tn_error *error);

/* The same of a file, if it is one that can be read again; of anything else, such as a pipe, nothing. */
tn_status tn_inputs_add_file(char **inputs, const char *kind, const char *path, tn_error *error);

/* A line for each source of a module, but for the one numbered `skipped` (UINT32_MAX: none). */
tn_status tn_inputs_add_sources(char **inputs, const char *kind, const tn_module *module, uint32_t skipped,
                                tn_error *error);

/* The name in the first line that is not in both, without its hash; empty where both are the same. */
void tn_inputs_difference(const char *before, const char *now, char *name, size_t size);

/* Reads a change of a goal, " target 3 weight 2", in any order; false where it says anything else. */
bool tn_wish_read(const char *text, double *target, double *weight);

#endif
