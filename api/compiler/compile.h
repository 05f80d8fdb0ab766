/* What the files of the C interface to rule files share: opening one with its source. */
#ifndef TARTAN_API_COMPILER_COMPILE_H
#define TARTAN_API_COMPILER_COMPILE_H

#include "api/base/api.h"
#include "driver/open/open.h"

/* Are the texts there of which the options have so many? */
tartan_status tn_api_compile_texts(const tartan_compile_options *options, tartan_error *error);

/* As tartan_compile_text and tartan_compile_file, and keeps what was opened. Close it in any case. `asking` (may be
 * NULL): what is asked beyond what a .plan file says. */
tartan_status tn_api_open(const char *path, const char *text, size_t size, const tartan_compile_options *options,
                          const tn_questions *asking, tn_opened *opened, tartan_error *error);

/* The same of a study that uses a text, and has it whatever the file system or the resolver of the options has by that
 * name. */
tartan_status tn_api_open_study(const char *name, const char *text, size_t size, const tartan_compile_options *options,
                                const tn_input *used, tn_opened *opened, tartan_error *error);

tartan_status tn_api_open_file(const char *path, const tartan_compile_options *options, const tn_questions *asking,
                               tn_opened *opened, tartan_error *error);

/* Everything that there is to say, to the caller's function (may be NULL). */
void tn_api_report(tn_diagnostics *diagnostics, tartan_report *report, void *context);

/* What made the work fail, in one sentence: the first error, or why the watch (which may be NULL) ended it.
 * Returns the status. */
tartan_status tn_api_first_error(const tn_diagnostics *diagnostics, tn_status status, const tn_watch *watch,
                                 tartan_error *error);

#endif
