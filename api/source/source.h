/* What the files of the C interface to sources share. */
#ifndef TARTAN_API_SOURCE_SOURCE_H
#define TARTAN_API_SOURCE_SOURCE_H

#include "api/compiler/compile.h"

struct tartan_source {
    tn_opened opened;
    char *path;           /* the caller's, copied */
    tartan_module module; /* what was opened, borrowed by whoever asks */
};

/* Work on a source: it may be given up, and what it says is its own, not the source's. */
typedef struct tn_api_work {
    tartan_source *source;
    tn_watch watch;
    tn_diagnostics kept; /* the source's */
} tn_api_work;

/* Begins work with the caller's watch (may be NULL). After TARTAN_OK, end it in any case. */
tartan_status tn_api_source_begin(tartan_source *source, const tartan_watch *watch, tn_api_work *work,
                                  tartan_error *error);

/* Ends it; a status that is not TN_OK is returned with the first error that was said. */
tartan_status tn_api_source_end(tn_api_work *work, tn_status status, tartan_error *error);

#endif
