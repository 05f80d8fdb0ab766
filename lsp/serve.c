/* Serves an exchange on a pair of streams. */
#include <fcntl.h>
#include <unistd.h>

#include "lsp/background.h"
#include "lsp/exchange.h"
#include "lsp/lsp.h"
#include "lsp/wire.h"

#define REVIEW_SECONDS 60.0 /* after which rules are looked at no longer */

typedef struct server {
    tn_wire wire;
    tn_exchange *exchange;
    tn_background *background; /* at work on a review, or NULL */
    int wake[2];               /* the pipe by which it says that it is done: a byte each time */
    bool ended;                /* there is no more input */
} server;

/* ---- the background */

/* On the thread of the review. */
static void wake(void *context)
{
    const server *s = context;
    (void)!write(s->wake[1], "", 1);
}

static void end_background(server *s)
{
    tn_review *review = tn_background_join(s->background);
    s->background = NULL;
    tn_exchange_reviewed(s->exchange, review);
}

static void take_background(server *s)
{
    char said;
    (void)!read(s->wake[0], &said, 1);
    if (s->background && tn_background_ended(s->background))
        end_background(s);
}

static void begin_background(server *s)
{
    tn_review *review = tn_exchange_review(s->exchange);
    if (!review)
        return;
    s->background = tn_background_start(review, REVIEW_SECONDS, wake, s);
    if (!s->background) {
        tn_review_cancel(review);
        tn_exchange_reviewed(s->exchange, review);
    }
}

/* ---- the loop */

static void take_message(server *s)
{
    json_t *message;
    tn_wire_result result = tn_wire_read(&s->wire, &message);
    if (result == TN_WIRE_END) {
        s->ended = true;
    } else if (result == TN_WIRE_MALFORMED) {
        tn_exchange_malformed(s->exchange, s->wire.problem);
    } else {
        tn_exchange_take(s->exchange, message);
        json_decref(message);
    }
}

static void send_all(server *s)
{
    for (json_t *message; (message = tn_exchange_next(s->exchange));)
        tn_wire_send(&s->wire, message);
}

/* What comes next; what is to be done while nothing comes is done before it is waited for. */
static tn_wire_event wait(server *s)
{
    tn_wire_event event = tn_wire_wait(&s->wire, s->wake[0], 0);
    if (event != TN_WIRE_TIME)
        return event;
    tn_exchange_work(s->exchange);
    begin_background(s);
    send_all(s);
    return tn_wire_wait(&s->wire, s->wake[0], tn_exchange_patience(s->exchange));
}

static void loop(server *s)
{
    while (!s->ended && !tn_exchange_ended(s->exchange) && !tn_exchange_failed(s->exchange) && !s->wire.failed) {
        tn_wire_event event = wait(s);
        if (event == TN_WIRE_INPUT)
            take_message(s);
        else if (event == TN_WIRE_WOKEN)
            take_background(s);
        send_all(s);
    }
    tn_exchange_cancel(s->exchange);
    if (s->background)
        end_background(s);
}

static tn_status how_it_ended(const server *s, tn_error *error)
{
    if (tn_exchange_failed(s->exchange))
        return tn_fail_memory(error);
    if (s->wire.failed)
        return ferror(s->wire.output)
                   ? tn_fail(error, TN_IO, E_CANNOT_WRITE, "the client does not read what it is sent")
                   : tn_fail_memory(error);
    if (!tn_exchange_shut_down(s->exchange))
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the client went away without `shutdown`");
    return TN_OK;
}

tn_status tn_lsp_serve(int input, FILE *output, tn_error *error)
{
    server s = {.wire = {.input = input, .output = output}};
    if (pipe2(s.wake, O_CLOEXEC | O_NONBLOCK) != 0)
        return tn_fail_memory(error);
    tn_status status = tn_exchange_new(NULL, &s.exchange, error);
    if (status == TN_OK) {
        loop(&s);
        status = how_it_ended(&s, error);
    }
    tn_exchange_free(s.exchange);
    tn_wire_clear(&s.wire);
    close(s.wake[0]);
    close(s.wake[1]);
    return status;
}
