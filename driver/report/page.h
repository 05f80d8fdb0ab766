/* A page of HTML under way, which needs nothing else: texts, pictures, and what checking found. */
#ifndef TARTAN_DRIVER_REPORT_PAGE_H
#define TARTAN_DRIVER_REPORT_PAGE_H

#include "driver/open/open.h"
#include "runtime/base/picture.h"
#include "runtime/plan/text/text.h"

typedef struct tn_page {
    tn_buffer *text;
    unsigned pictures; /* so far */
    tn_error *error;
} tn_page;

/* Functions that return bool are false where memory ran out. This is TN_OK, or out of memory. */
static inline tn_status tn_page_written(const tn_page *page, bool good)
{
    return good ? TN_OK : tn_fail_memory(page->error);
}

/* Up to the title and a sentence below it, in the style of all pages; and the version that made the module. */
bool tn_page_begin(const tn_page *page, const char *title, const char *doc);
/* The values that the params of the file were given, if any were. */
bool tn_page_params(const tn_page *page, const tn_opened *opened);
bool tn_page_version(const tn_page *page, const tn_module *module);

/* HTML as it is, and a text with &, <, > and quotes written for HTML. */
bool tn_page_html(const tn_page *page, const char *html);
bool tn_page_text(const tn_page *page, const char *text);
bool tn_page_text_part(const tn_page *page, const char *text, size_t size);

/* A sentence in which what stands between backticks is code. */
bool tn_page_prose(const tn_page *page, const char *text);

/* Where the next picture goes. */
tn_picture tn_page_next_picture(tn_page *page);

/* Puts a drawn picture into the page, and frees it. Pass on the status of the drawing. */
tn_status tn_page_put_picture(const tn_page *page, tn_picture *picture, const char *description, tn_status drawn);

/* A finding with its notes: what checking says at the terminal. */
bool tn_page_finding(const tn_page *page, tn_opened *opened, const tn_diagnostic *item);

/* The warnings of checking, and its notes but for limits. */
bool tn_page_findings(const tn_page *page, tn_opened *opened);

/* What was not found out, below everything else: each limit that checking met, once, and what else there is to say of
 * limits, a line each (an empty one is none). */
bool tn_page_limits(const tn_page *page, tn_opened *opened, const tn_buffer *more, size_t more_count);

#endif
