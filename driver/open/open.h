/* From a path to a module ready to run: a rule file is compiled, a module is loaded; which of the two it is, its first
 * bytes say. Either way the sources are at hand, so that whatever an engine finds can be shown in the author's own
 * words.
 *
 * A tn_opened owns everything reached through it. Close it in any case, also after a failure.
 */
#ifndef TARTAN_DRIVER_OPEN_OPEN_H
#define TARTAN_DRIVER_OPEN_OPEN_H

#include "compiler/common/compilation.h"
#include "compiler/compile.h"
#include "runtime/module/module.h"

/* Files that rule files name and that are no rule files: a kit's meshes, pictures and models. */

/* Reads them from where they lie, beside the file that names them. For several threads at once. */
extern const tn_attachments tn_file_attachments;

typedef struct tn_opened {
    const char *path;           /* borrowed */
    tn_compilation compilation; /* sources and diagnostics always; program and bytes only where compiled */
    tn_module *module;          /* NULL where opening failed */
    bool compiled;
    const struct tn_mesh_reader *meshes; /* reads the meshes that the rules name; NULL: they are files */
} tn_opened;

/* Opens the file at `path` ("-": standard input); a name that no file has, without folder and extension, means a file
 * of the standard library. The diagnostics of `opened` say what is wrong. TN_INVALID where the
 * rules or the module are, TN_IO where the file cannot be read, TN_LIMIT, TN_MEMORY. */
tn_status tn_open(const char *path, bool warnings_are_errors, tn_opened *opened);

/* The same, with what the command line asks of a .plan file, or NULL, and the values that it gives to the file's
 * params. A module takes neither. */
tn_status tn_open_asking(const char *path, bool warnings_are_errors, const tn_questions *questions,
                         tn_param_values params, tn_opened *opened);
/* Opens files that are one text together, in this order (tn_front.joins); one alone is opened by tn_open. Otherwise as
 * there. */
tn_status tn_open_joined(const char *const *paths, size_t count, bool warnings_are_errors, tn_param_values params,
                         tn_opened *opened);

/* Is a file of this name one of those that may be several? */
bool tn_path_joins(const char *path);

/* The same from bytes in memory, which would lie at `path`: that says the notation, and where relative imports start.
 */
tn_status tn_open_bytes(const char *path, const uint8_t *bytes, size_t size, bool warnings_are_errors,
                        tn_opened *opened);

/* The same of a text, with what is asked of it. */
tn_status tn_open_source(const char *path, const char *text, size_t size, const tn_questions *questions,
                         tn_param_values params, tn_opened *opened);

/* Compiles a text that the caller has, and makes its module ready to run. */
tn_status tn_open_text(const tn_notation *notation, const tn_input *input, const tn_compile_options *options,
                       tn_opened *opened);

/* Opens a text that would lie at a path, as another file was opened: what it uses is found where that file's is.
 * questions: what is asked of it, or NULL. The opened text borrows the path. Close it in any case. */
typedef struct tn_text_opener {
    tn_status (*open)(void *context, const char *path, const char *text, size_t size, const tn_questions *questions,
                      tn_opened *opened);
    void *context;
} tn_text_opener;

/* Where a file lacks what a command is about: which commands take what it does hold, as a help; `otherwise` where it
 * holds nothing of another kind than plan rules. */
typedef struct tn_help_text {
    char text[320];
} tn_help_text;

tn_help_text tn_opened_help(const tn_opened *opened, const char *otherwise);

/* What is wrong in a file that could not be opened, the first of it, in a sentence. */
const char *tn_first_error(const tn_opened *opened);

/* Puts that into an error, with the status of opening, which is returned. */
tn_status tn_open_error(const tn_opened *opened, tn_status status, tn_error *error);

/* Who reads the meshes that the rules name. */
const struct tn_mesh_reader *tn_opened_meshes(const tn_opened *opened);

void tn_close(tn_opened *opened);

/* Opens a file once more, from the texts that were opened before, with something changed in its syntax trees: what it
 * would mean if it were written otherwise. Nothing is read from a disk.
 */

/* Called for the tree of each text, those that others use first; main: it is the file itself. What is added to a tree
 * lives in the arena. */
typedef void tn_change_tree(void *context, tn_arena *arena, void *tree, bool main);

/* Of a .plan file that was compiled; its params keep their values. `change` may be NULL. test: the params have the
 * values that the file's test of this number, from 1, says; 0: none. Close it in any case, and before the other one. */
tn_status tn_open_again(const tn_opened *opened, tn_change_tree *change, void *context, size_t test, tn_opened *again);

/* The values that the params of a .plan file or module were given, which borrow its sources. Free the items. TN_MEMORY,
 * else TN_OK. */
tn_status tn_opened_params(const tn_opened *opened, tn_param_values *params);

/* The same in words, "lot=9m, side=right"; empty where there are none, and cut off where there is no room. */
#define TN_PARAMS_TEXT_MAX 1000u
void tn_opened_params_text(const tn_opened *opened, char *text, size_t size);

/* ---- what an engine finds, shown where the author wrote it */

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
