/* The language server for editors: an exchange (exchange.h) over a pair of streams. One thread reads messages and
 * answers them; a second one looks at rules when typing pauses (review.h). */
#ifndef TARTAN_LSP_SERVE_H
#define TARTAN_LSP_SERVE_H

#include <stdio.h>

#include "runtime/base/error.h"

/* Serves until `exit` or the end of input. TN_INVALID where the client left without `shutdown`, TN_IO where nothing can
 * be written, TN_MEMORY. */
tn_status tn_lsp_serve(int input, FILE *output, tn_error *error);

#endif
