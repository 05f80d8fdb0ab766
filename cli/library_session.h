/* What the commands that work on one library have in common: opening it as the options say. */
#ifndef TARTAN_CLI_LIBRARY_SESSION_H
#define TARTAN_CLI_LIBRARY_SESSION_H

#include "cli/session.h"
#include "driver/library.h"

/* Opens the file and makes the chosen library ready; false where that failed (then end the session). */
bool tn_session_library(tn_session *session, const char *path, tn_ready_library *ready);

/* The same, but only the schema: for commands that match plans against the clauses. */
bool tn_session_library_schema(tn_session *session, const char *path, tn_ready_library *ready);

/* How many threads the options ask for; sets it for the library's own parallel loops too. */
int tn_session_threads(const tn_settings *settings);

/* The longest plan that the options accept. */
size_t tn_session_max_length(const tn_settings *settings);

/* A rank of the options ("" or NULL: `otherwise`). `number` is initialised. */
void tn_session_rank(const char *text, const mpz_t otherwise, mpz_t number);

#endif
