/* A window of a browser: what came on its socket, and what goes back. Two threads of its own answer, so that a question
 * that takes long holds up neither the other windows nor the errors that follow typing:
 *
 *   texts      the language server (lsp/exchange.h), and the files of the folder
 *   questions  the desk (studio/desk/desk.h), which is told of every change of a text, too
 *
 * A window is freed when the socket and both threads have left it. */
#ifndef TARTAN_STUDIO_SERVER_WINDOW_H
#define TARTAN_STUDIO_SERVER_WINDOW_H

#include <pthread.h>

#include "studio/server/folder.h"
#include "studio/server/outbox.h"

enum {
    TN_WINDOWS_MAX = 64,
    TN_UNTAKEN_MAX = 8 << 20,      /* bytes of messages that wait for a thread */
    TN_QUESTION_SECONDS_MAX = 120, /* that a question may take */
};

/* What all windows share. */
typedef struct tn_windows {
    tn_studio_folder *folder; /* borrowed, as what follows */
    const char *open;         /* the file that the command line named, or NULL */
    uint64_t memory_limit;    /* of the process, for each question; 0: none */
    pthread_mutex_t lock;
    pthread_cond_t left; /* by a window */
    size_t count;
} tn_windows;

void tn_windows_begin(tn_windows *windows, tn_studio_folder *folder, const char *open, uint64_t memory_limit);

/* Waits until every window is left, so many seconds at most. False: some are not, and nothing may be freed. */
bool tn_windows_end(tn_windows *windows, unsigned seconds);

/* Are there as many as there may be? Those count too that were closed but are still at work. */
bool tn_windows_full(tn_windows *windows);

typedef struct tn_window tn_window;

/* `woken` is called, by any thread, when there is something to be sent, or the window is over. NULL: out of memory or
 * threads. */
tn_window *tn_window_open(tn_windows *windows, void (*woken)(void *context), void *context);

/* Takes a message as it came. False: the window sends more than is answered, or leaves too much unread. */
bool tn_window_take(tn_window *window, const char *text, size_t size);

/* What is to be sent. */
tn_outbox *tn_window_outbox(tn_window *window);

/* Has it said `exit`, or is there no memory for its answers? */
bool tn_window_over(tn_window *window);

/* The socket is closed: what is at work ends soon. */
void tn_window_leave(tn_window *window);

#endif
