/* The page of a library of houses. */
#ifndef TARTAN_ASK_HOUSE_REPORTED_H
#define TARTAN_ASK_HOUSE_REPORTED_H

#include "ask/session/session.h"

typedef struct tn_reported {
    uint64_t sample, seed; /* how many houses are drawn, and which */
} tn_reported;

/* Appends the page about the library of houses that is asked about. What is wrong is said. */
tn_status tn_report_houses(tn_session *session, const tn_library_asked *asked, const tn_reported *wanted,
                           tn_buffer *page);

/* Appends the page of those houses, each by its number or its line, side by side if they are several. */
tn_status tn_report_given_houses(tn_session *session, const tn_library_asked *asked, const char *const *texts,
                                 size_t count, tn_buffer *page);

#endif
