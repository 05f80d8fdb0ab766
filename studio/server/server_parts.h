/* What the files of the server share. */
#ifndef TARTAN_STUDIO_SERVER_SERVER_PARTS_H
#define TARTAN_STUDIO_SERVER_SERVER_PARTS_H

#include <libwebsockets.h>
#include <stdatomic.h>

#include "studio/server/gate.h"
#include "studio/server/page_files.h"
#include "studio/server/server.h"
#include "studio/server/window.h"

struct tn_server {
    struct lws_context *context;
    struct lws_vhost *hosts[2]; /* of 127.0.0.1 and of ::1; NULL if there is none */
    tn_gate gate;
    tn_windows windows;
    atomic_bool ended;
    char address[80], address_once[80];
};

/* An answer that is being sent; what a connection of the page's protocol remembers. */
typedef struct tn_http_answer {
    const unsigned char *bytes;
    size_t size, sent;
} tn_http_answer;

/* What a connection of the socket's protocol remembers. */
typedef struct tn_socket {
    tn_window *window; /* NULL: it was refused, or never began */
    char *part;        /* of a message that arrives in pieces */
    size_t size, capacity;
} tn_socket;

/* libwebsockets' callbacks of the two protocols. */
int tn_http_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in, size_t size);
int tn_socket_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in, size_t size);

/* Answers a request with a sentence; -1 if the connection is to be closed. */
int tn_http_refuse(struct lws *wsi, unsigned status, const char *why);

static inline tn_server *tn_server_of(struct lws *wsi)
{
    return lws_context_user(lws_get_context(wsi));
}

#endif
