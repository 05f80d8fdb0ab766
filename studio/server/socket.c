/* The sockets of windows. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "studio/server/server_parts.h"

enum { MESSAGE_MAX = 4 << 20 };

static int close_for(struct lws *wsi, enum lws_close_status status, const char *why)
{
    unsigned char reason[124];
    size_t size = strlen(why) < sizeof reason - 1 ? strlen(why) : sizeof reason - 1;
    memcpy(reason, why, size);
    lws_close_reason(wsi, status, reason, size);
    return -1;
}

/* On any thread; libwebsockets has this one call for that. */
static void wake(void *context)
{
    lws_cancel_service(context);
}

static int begin(struct lws *wsi, tn_socket *socket)
{
    *socket = (tn_socket){0};
    socket->window = tn_window_open(&tn_server_of(wsi)->windows, wake, lws_get_context(wsi));
    if (!socket->window)
        return close_for(wsi, LWS_CLOSE_STATUS_UNEXPECTED_CONDITION, "there is not enough memory for a window");
    lws_set_timer_usecs(wsi, LWS_USEC_PER_SEC);
    return 0;
}

static int receive(struct lws *wsi, tn_socket *socket, const void *bytes, size_t size)
{
    if (lws_frame_is_binary(wsi))
        return close_for(wsi, LWS_CLOSE_STATUS_UNACCEPTABLE_OPCODE, "messages are text");
    if (socket->size + size > MESSAGE_MAX)
        return close_for(wsi, LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE, "a message is larger than 4 MiB");
    if (!tn_array_reserve(&socket->part, &socket->capacity, socket->size, size + 1, 1))
        return close_for(wsi, LWS_CLOSE_STATUS_UNEXPECTED_CONDITION, "there is not enough memory for a message");
    memcpy(socket->part + socket->size, bytes, size);
    socket->size += size;
    if (!lws_is_final_fragment(wsi) || lws_remaining_packet_payload(wsi) > 0)
        return 0;
    bool taken = tn_window_take(socket->window, socket->part, socket->size);
    free(socket->part);
    socket->part = NULL;
    socket->size = socket->capacity = 0;
    return taken ? 0 : close_for(wsi, LWS_CLOSE_STATUS_POLICY_VIOLATION, "more is asked than is read");
}

/* One piece each time the network has room. */
static int send_piece(struct lws *wsi, tn_socket *socket)
{
    unsigned char bytes[LWS_PRE + TN_PIECE_MAX];
    tn_outbox *outbox = tn_window_outbox(socket->window);
    tn_outbox_piece piece = tn_outbox_take(outbox, bytes + LWS_PRE);
    if (piece.size > 0) {
        int how = lws_write_ws_flags(piece.binary ? LWS_WRITE_BINARY : LWS_WRITE_TEXT, piece.first, piece.last);
        if (lws_write(wsi, bytes + LWS_PRE, piece.size, (enum lws_write_protocol)how) < (int)piece.size)
            return -1;
    }
    if (tn_outbox_waits(outbox))
        lws_callback_on_writable(wsi);
    else if (tn_window_over(socket->window))
        return close_for(wsi, LWS_CLOSE_STATUS_NORMAL, "");
    return 0;
}

static int look(struct lws *wsi, tn_socket *socket)
{
    if (tn_outbox_stuck(tn_window_outbox(socket->window)))
        return -1;
    lws_set_timer_usecs(wsi, LWS_USEC_PER_SEC);
    return 0;
}

static void end(tn_socket *socket)
{
    tn_window_leave(socket->window);
    free(socket->part);
    *socket = (tn_socket){0};
}

static int take_event(struct lws *wsi, enum lws_callback_reasons reason, tn_socket *socket, const void *in, size_t size)
{
    switch (reason) {
    case LWS_CALLBACK_RECEIVE:
        return receive(wsi, socket, in, size);
    case LWS_CALLBACK_SERVER_WRITEABLE:
        return send_piece(wsi, socket);
    case LWS_CALLBACK_TIMER:
        return look(wsi, socket);
    case LWS_CALLBACK_CLOSED: /* comes for sockets, too, that were refused: those have no window */
        end(socket);
        return 0;
    default:
        return 0;
    }
}

int tn_socket_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in, size_t size)
{
    tn_socket *socket = user;
    if (reason == LWS_CALLBACK_ESTABLISHED)
        return begin(wsi, socket);
    if (reason == LWS_CALLBACK_EVENT_WAIT_CANCELLED) {
        const struct lws_vhost *host = lws_get_vhost(wsi);
        lws_callback_on_writable_all_protocol_vhost(host, lws_get_protocol(wsi));
        return 0;
    }
    return socket && socket->window ? take_event(wsi, reason, socket, in, size) : 0;
}
