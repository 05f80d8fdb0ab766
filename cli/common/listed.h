/* Commands that list what a file has: one question about the file, whose answer is written as text or as JSON. */
#ifndef TARTAN_CLI_COMMON_LISTED_H
#define TARTAN_CLI_COMMON_LISTED_H

#include "cli/common/job.h"

/* What their options set: --used also lists what the files have that the file uses, --json writes JSON. */
typedef struct tn_listed_settings {
    tn_settings common;
    bool used, json;
} tn_listed_settings;

/* What one of them asks, and how it writes the answer as text. */
typedef struct tn_listed {
    tn_status (*ask)(tn_session *session, bool used, tn_reply *answer);
    void (*write)(const void *answer, FILE *out);
} tn_listed;

/* Runs the command on its one operand, and returns the exit code. The settings are a tn_listed_settings. */
int tn_listed_run(const tn_listed *listed, const tn_settings *settings);

/* What a number or one of several words may be: " in 1..4", " from 1", ", one of left, right"; of all that is NULL or
 * none, nothing. */
void tn_listed_write_values(const char *least, const char *most, const char *const *words, size_t count, FILE *out);

/* What the author says of it, NULL or empty if nothing, and the end of the line. */
void tn_listed_write_doc(const char *doc, FILE *out);

#endif
