/* The language server: the Language Server Protocol (version 3.17) over a pair of streams, for editors.
 *
 * One thread reads messages and answers them in order. What was typed is compiled when an answer needs it or when no
 * message waits, whichever is first: so a burst of keystrokes costs one compilation. What takes longer is done by a
 * second thread when typing pauses (background.h). Texts that editors have open stand
 * in for the files on the disk, also where another file uses them. Nothing that a client sends ends the server but
 * `exit`.
 */
#ifndef TARTAN_LSP_LSP_H
#define TARTAN_LSP_LSP_H

#include <stdio.h>

#include "runtime/base/error.h"

/* Serves until `exit` or the end of input. TN_INVALID where the client left without `shutdown`, TN_IO where nothing can
 * be written, TN_MEMORY. */
tn_status tn_lsp_serve(int input, FILE *output, tn_error *error);

#endif
