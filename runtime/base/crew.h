/* A few threads that share a loop.
 *
 * The thread that asks works along, and waits only for those that took a part: on a busy machine, helpers that get no
 * processor hold nobody up. Which thread does which item never matters to results: items are independent.
 */
#ifndef TARTAN_BASE_CREW_H
#define TARTAN_BASE_CREW_H

#include "runtime/base/watch.h"

typedef struct tn_crew tn_crew;

/* A crew of `threads` in all, the asking one counted (0: as many as there are processors). They are made when there is
 * work for them; where threads cannot be had, it is smaller. Work ends early once `watch` (borrowed, or NULL) says so.
 * NULL if out of memory. */
tn_crew *tn_crew_new(unsigned threads, tn_watch *watch);
void tn_crew_free(tn_crew *crew);

/* Whose wish ends work from now on. */
void tn_crew_watch(tn_crew *crew, tn_watch *watch);

/* The number that it may have, so that each can have memory of its own. */
unsigned tn_crew_threads(const tn_crew *crew);

/* One item of the work; `thread` is below the crew's number, and no two items are done at once under the same. */
typedef tn_status tn_crew_work(void *context, unsigned thread, size_t item, tn_error *error);

/* Does items 0 to count - 1, `chunk` of them at a time. The error is that of the lowest item that failed; all items are
 * done in any case, but for TN_STOPPED: then some are not. */
tn_status tn_crew_run(tn_crew *crew, size_t count, size_t chunk, tn_crew_work *work, void *context, tn_error *error);

/* The same for pieces of work that cannot fail, one at a time. TN_OK or TN_STOPPED. */
typedef void tn_crew_piece(void *context, uint32_t piece);
tn_status tn_crew_share(tn_crew *crew, uint32_t count, tn_crew_piece *work, void *context, tn_error *error);

/* As many as there are processors to run on. */
unsigned tn_crew_default(void);

#endif
