/* The plans of a range of ranks as the text of a file, made by several threads.
 *
 * The range is divided into blocks of ranks. Each is walked by a cursor of its own into a text of its own; while the
 * next blocks are made, one thread puts the last ones, in their order. So the text is the same with any number of
 * threads. The first blocks are small, that whoever reads along has not to wait. */
#ifndef TARTAN_PLAN_LIBRARY_LISTING_H
#define TARTAN_PLAN_LIBRARY_LISTING_H

#include "runtime/base/buffer.h"
#include "runtime/base/crew.h"
#include "runtime/plan/library/library.h"

typedef struct tn_plan_listing {
    const tn_library *library;
    mpz_srcptr from, to;
    unsigned threads; /* 0: as many as there are processors */
    tn_watch *watch;  /* can end it (TN_STOPPED), or NULL */

    /* Appends a plan to a text; `room` is empty memory for it. Called by several threads. false: out of memory. */
    bool (*append)(void *context, const mpz_t rank, const tn_tray *trays, uint32_t length, tn_buffer *text,
                   tn_buffer *room);
    /* Takes the text of the next plans. By one thread at a time. */
    tn_status (*put)(void *context, const tn_buffer *text, uint64_t plans, tn_error *error);
    void *context;
} tn_plan_listing;

tn_status tn_library_list(const tn_plan_listing *listing, tn_error *error);

#endif
