/* Modules: compiled rule files, as bytes that may be kept and loaded by any machine. */
#ifndef TARTAN_MODULE_H
#define TARTAN_MODULE_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tartan_module tartan_module;

/* Loads a module from memory (copied) or from a file ("-" is standard input). A damaged one, or one of another format
 * version, is TARTAN_INVALID; one of more than 256 MiB, 1,000,000 records in a section or a stack of 4,096 in a
 * function TARTAN_LIMIT. Any bytes may be given: what does not verify never runs. */
TARTAN_API tartan_status tartan_module_load(const void *bytes, size_t size, tartan_module **module,
                                            tartan_error *error);
TARTAN_API tartan_status tartan_module_load_file(const char *path, tartan_module **module, tartan_error *error);
TARTAN_API void tartan_module_free(tartan_module *module); /* NULL is fine, as for every _free */

/* The module as it is on disk; write these bytes to a file to keep it. Borrowed. */
TARTAN_API const void *tartan_module_bytes(const tartan_module *module, size_t *size);

/* Its rules and libraries, in file order, those of imported files first. Texts are borrowed; past the end, NULL. */
TARTAN_API size_t tartan_module_rule_count(const tartan_module *module);
TARTAN_API const char *tartan_module_rule_name(const tartan_module *module, size_t i);
TARTAN_API const char *tartan_module_rule_doc(const tartan_module *module, size_t i); /* "" where it has none */
TARTAN_API size_t tartan_module_library_count(const tartan_module *module);
TARTAN_API const char *tartan_module_library_name(const tartan_module *module, size_t i);
TARTAN_API const char *tartan_module_library_doc(const tartan_module *module, size_t i);

/* Its libraries of houses (house.h), those of imported files first. */
TARTAN_API size_t tartan_module_house_library_count(const tartan_module *module);
TARTAN_API const char *tartan_module_house_library_name(const tartan_module *module, size_t i);
TARTAN_API const char *tartan_module_house_library_doc(const tartan_module *module, size_t i);

/* Its surfaces (field.h), those of imported files first. */
TARTAN_API size_t tartan_module_surface_count(const tartan_module *module);
TARTAN_API const char *tartan_module_surface_name(const tartan_module *module, size_t i);

/* What else it holds. */
TARTAN_API bool tartan_module_has_growth(const tartan_module *module); /* a surface that grows: growth.h */
TARTAN_API bool
tartan_module_has_grammar(const tartan_module *module); /* a grammar of genomes: genome.h, evolution.h */
TARTAN_API bool
tartan_module_has_places(const tartan_module *module); /* a connection grammar, or a model of a kit: place.h */
TARTAN_API bool tartan_module_has_study(const tartan_module *module); /* settings of an evolution: evolution.h */

#ifdef __cplusplus
}
#endif

#endif
