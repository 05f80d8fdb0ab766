/* Looks at rules in a thread. */
#include "lsp/background.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { THREAD_STACK = 8 << 20 };

struct tn_background {
    pthread_t thread;
    tn_review *review;
    double seconds;
    void (*ended)(void *context);
    void *context;
    atomic_bool is_over;
};

static void *run(void *context)
{
    tn_background *b = context;
    tn_review_run(b->review, b->seconds);
    b->is_over = true;
    b->ended(b->context);
    return NULL;
}

static bool start_thread(tn_background *b)
{
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, THREAD_STACK);
    bool started = pthread_create(&b->thread, &attributes, run, b) == 0;
    pthread_attr_destroy(&attributes);
    return started;
}

tn_background *tn_background_start(tn_review *review, double seconds, void (*ended)(void *context), void *context)
{
    tn_background *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    b->review = review;
    b->seconds = seconds;
    b->ended = ended;
    b->context = context;
    if (start_thread(b))
        return b;
    free(b);
    return NULL;
}

bool tn_background_ended(tn_background *background)
{
    return background->is_over;
}

tn_review *tn_background_join(tn_background *background)
{
    tn_review *review = background->review;
    pthread_join(background->thread, NULL);
    free(background);
    return review;
}
