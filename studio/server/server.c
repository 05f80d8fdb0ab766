#include "studio/server/server.h"

#include <errno.h>
#include <libwebsockets.h>
#include <netinet/in.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "runtime/base/array.h"
#include "studio/server/gate.h"
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
typedef struct http_answer {
    const unsigned char *bytes;
    size_t size, sent;
} http_answer;

/* What a connection of the socket's protocol remembers. */
typedef struct tn_socket {
    tn_window *window; /* NULL: it was refused, or never began */
    char *part;        /* of a message that arrives in pieces */
    size_t size, capacity;
} tn_socket;

static inline tn_server *server_of(struct lws *wsi)
{
    return lws_context_user(lws_get_context(wsi));
}

/* ---- the page's files by HTTP, and the refusals of all that is not asked as it should be */

enum { HEADER_ROOM = 2048, VALUE_ROOM = 256 };

/* Scripts, styles and sockets are those of this server alone, and nobody may put the page into a frame. */
static const char *const security_headers[][2] = {
    {"content-security-policy:",
     "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; connect-src 'self'; worker-src "
     "'self'; img-src data: blob:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"},
    {"x-content-type-options:", "nosniff"},
    {"referrer-policy:", "no-referrer"},
    {"cache-control:", "no-store"},
    {"cross-origin-opener-policy:", "same-origin"},
    {"cross-origin-resource-policy:", "same-origin"},
};

typedef struct header {
    unsigned char bytes[LWS_PRE + HEADER_ROOM];
    unsigned char *end;
    bool failed;
} header;

static void add(struct lws *wsi, header *h, const char *name, const char *value)
{
    h->failed = h->failed || lws_add_http_header_by_name(wsi, (const unsigned char *)name, (const unsigned char *)value,
                                                         (int)strlen(value), &h->end, h->bytes + sizeof h->bytes - 1);
}

static void begin_header(struct lws *wsi, header *h, unsigned status, const char *type, size_t size)
{
    h->end = h->bytes + LWS_PRE;
    h->failed = lws_add_http_common_headers(wsi, status, type, size, &h->end, h->bytes + sizeof h->bytes - 1) != 0;
    for (size_t i = 0; i < sizeof security_headers / sizeof *security_headers; i++)
        add(wsi, h, security_headers[i][0], security_headers[i][1]);
}

static bool send_header(struct lws *wsi, header *h)
{
    return !h->failed &&
           lws_finalize_write_http_header(wsi, h->bytes + LWS_PRE, &h->end, h->bytes + sizeof h->bytes) == 0;
}

/* Answers a request with a sentence; -1 if the connection is to be closed. */
static int http_refuse(struct lws *wsi, unsigned status, const char *why)
{
    header h;
    unsigned char body[LWS_PRE + 512];
    size_t size = strlen(why);
    begin_header(wsi, &h, status, "text/plain; charset=utf-8", size + 1);
    if (status == HTTP_STATUS_METHOD_NOT_ALLOWED)
        add(wsi, &h, "allow:", "GET");
    if (size + 2 > sizeof body - LWS_PRE || !send_header(wsi, &h))
        return -1;
    memcpy(body + LWS_PRE, why, size);
    body[LWS_PRE + size] = '\n';
    return lws_write(wsi, body + LWS_PRE, size + 1, LWS_WRITE_HTTP_FINAL) < 0 ? -1 : 0;
}

/* A header that is there once and whole; empty otherwise. */
static void read_header(struct lws *wsi, enum lws_token_indexes name, char value[VALUE_ROOM])
{
    if (lws_hdr_copy(wsi, value, VALUE_ROOM, name) <= 0)
        value[0] = '\0';
}

static bool host_is_ours(struct lws *wsi, char host[VALUE_ROOM])
{
    read_header(wsi, WSI_TOKEN_HOST, host);
    return tn_gate_host(&server_of(wsi)->gate, host);
}

static int refuse_host(struct lws *wsi)
{
    return http_refuse(wsi, 421, "This is not the address of the studio: open the one that it printed.");
}

/* Before there is a socket. Positive: it was answered. */
static int confirm_upgrade(struct lws *wsi)
{
    tn_server *server = server_of(wsi);
    char host[VALUE_ROOM], origin[VALUE_ROOM], protocols[VALUE_ROOM];
    read_header(wsi, WSI_TOKEN_ORIGIN, origin);
    read_header(wsi, WSI_TOKEN_PROTOCOL, protocols);
    int sent;
    if (!host_is_ours(wsi, host))
        sent = refuse_host(wsi);
    else if (!tn_gate_origin(host, origin) || !tn_gate_protocols(&server->gate, protocols))
        sent = http_refuse(wsi, HTTP_STATUS_FORBIDDEN, "Only pages that know the token of this address get a socket.");
    else if (tn_windows_full(&server->windows))
        sent = http_refuse(wsi, HTTP_STATUS_SERVICE_UNAVAILABLE, "Too many windows are open: close one.");
    else
        return 0;
    return sent < 0 ? -1 : 1;
}

static const tn_page_file *find_file(const char *path)
{
    for (size_t i = 0; i < tn_page_file_count; i++)
        if (strcmp(tn_page_files[i].path, path) == 0)
            return &tn_page_files[i];
    return NULL;
}

/* What browsers send; lists of preferences with a weight of 0 are not theirs. */
static bool takes_gzip(struct lws *wsi)
{
    char list[VALUE_ROOM];
    read_header(wsi, WSI_TOKEN_HTTP_ACCEPT_ENCODING, list);
    return strstr(list, "gzip") != NULL && strstr(list, "q=0") == NULL;
}

static int begin_file(struct lws *wsi, const tn_page_file *file, http_answer *answer)
{
    bool packed = file->packed && takes_gzip(wsi);
    header h;
    *answer = (http_answer){packed ? file->packed : file->bytes, packed ? file->packed_size : file->size, 0};
    begin_header(wsi, &h, HTTP_STATUS_OK, file->type, answer->size);
    if (packed)
        add(wsi, &h, "content-encoding:", "gzip");
    if (!send_header(wsi, &h))
        return -1;
    lws_callback_on_writable(wsi);
    return 0;
}

/* The address that a program was started with leads to the page, once. */
static int redirect(struct lws *wsi)
{
    char place[TN_SECRET_DIGITS + 3];
    header h;
    begin_header(wsi, &h, HTTP_STATUS_SEE_OTHER, "text/plain", 0);
    lws_snprintf(place, sizeof place, "/#%s", server_of(wsi)->gate.token);
    add(wsi, &h, "location:", place);
    return send_header(wsi, &h) ? 0 : -1;
}

static int end_answer(struct lws *wsi, int sent)
{
    return sent < 0 || lws_http_transaction_completed(wsi) ? -1 : 0;
}

static int begin_answer(struct lws *wsi, const char *path, http_answer *answer)
{
    char host[VALUE_ROOM];
    if (!host_is_ours(wsi, host))
        return end_answer(wsi, refuse_host(wsi));
    if (lws_hdr_total_length(wsi, WSI_TOKEN_GET_URI) <= 0) {
        http_refuse(wsi, HTTP_STATUS_METHOD_NOT_ALLOWED, "The page is only read.");
        return -1; /* what the request carries is not read */
    }
    const tn_page_file *file = find_file(path);
    if (file)
        return begin_file(wsi, file, answer);
    if (tn_gate_key(&server_of(wsi)->gate, path))
        return end_answer(wsi, redirect(wsi));
    return end_answer(wsi, http_refuse(wsi, HTTP_STATUS_NOT_FOUND, "The page has no such file."));
}

static int go_on(struct lws *wsi, http_answer *answer)
{
    unsigned char bytes[LWS_PRE + TN_PIECE_MAX];
    if (!answer || !answer->bytes)
        return -1;
    size_t left = answer->size - answer->sent, size = left < TN_PIECE_MAX ? left : TN_PIECE_MAX;
    memcpy(bytes + LWS_PRE, answer->bytes + answer->sent, size);
    if (lws_write(wsi, bytes + LWS_PRE, size, size == left ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP) < 0)
        return -1;
    answer->sent += size;
    if (size == left)
        return end_answer(wsi, 0);
    lws_callback_on_writable(wsi);
    return 0;
}

/* libwebsockets' callbacks of the two protocols. */
static int http_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in, size_t size)
{
    (void)size;
    switch (reason) {
    case LWS_CALLBACK_HTTP:
        return begin_answer(wsi, in, user);
    case LWS_CALLBACK_HTTP_WRITEABLE:
        return go_on(wsi, user);
    case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE:
        return confirm_upgrade(wsi);
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION: /* no socket speaks this protocol, */
    case LWS_CALLBACK_RAW_ADOPT:                  /* and nobody gets a bare connection by CONNECT */
    case LWS_CALLBACK_RAW_RX:
        return -1;
    default:
        return 0;
    }
}

/* ---- the sockets of windows */

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
    socket->window = tn_window_open(&server_of(wsi)->windows, wake, lws_get_context(wsi));
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

static int socket_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in, size_t size)
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

/* ---- the server */

enum {
    CONNECTIONS_MAX = 512,  /* windows, and those that ask for files or say nothing */
    HEADERS_MAX = 16 << 10, /* bytes; browsers send the cookies of every server of this machine */
    REQUEST_SECONDS = 5,    /* in which a request is to have come */
    PATIENCE = 2,           /* seconds for windows to end */
};

static const struct lws_protocols protocols[] = {
    {"http", http_callback, sizeof(http_answer), 0, 0, NULL, 0},
    {TN_SUBPROTOCOL, socket_callback, sizeof(tn_socket), TN_PIECE_MAX, 0, NULL, 0},
    {NULL, NULL, 0, 0, 0, NULL, 0},
};

/* ---- ports */

/* 0, or why the port cannot be had: libwebsockets does not say. */
static int try_port(unsigned port)
{
    const struct sockaddr_in address = {
        .sin_family = AF_INET, .sin_port = htons((uint16_t)port), .sin_addr = {htonl(INADDR_LOOPBACK)}};
    const int yes = 1;
    int file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (file < 0)
        return errno;
    setsockopt(file, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    int reason = bind(file, (const struct sockaddr *)&address, sizeof address) == 0 && listen(file, 1) == 0 ? 0 : errno;
    close(file);
    return reason;
}

static tn_status no_port(unsigned port, int reason, tn_error *error)
{
    if (reason == EACCES || reason == EPERM)
        tn_fail(error, TN_IO, E_PORT_TAKEN, "you have no right to the port %u", port);
    else if (port > 0)
        tn_fail(error, TN_IO, E_PORT_TAKEN, "the port %u is taken: another program has it", port);
    else
        tn_fail(error, TN_IO, E_PORT_TAKEN, "there is no free port");
    if (port > 0)
        tn_error_help(error, "name another with --port, or leave it out for a free one");
    return TN_IO;
}

static struct lws_vhost *listen_on(tn_server *server, const char *address, unsigned port)
{
    bool six = strchr(address, ':') != NULL;
    const struct lws_context_creation_info info = {
        .port = (int)port,
        .iface = address,
        .vhost_name = address,
        .protocols = protocols,
        .options = LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND |
                   (six ? LWS_SERVER_OPTION_IPV6_V6ONLY_MODIFY | LWS_SERVER_OPTION_IPV6_V6ONLY_VALUE
                        : LWS_SERVER_OPTION_DISABLE_IPV6),
        .keepalive_timeout = REQUEST_SECONDS,
        .server_string = "tartan-studio",
    };
    return lws_create_vhost(server->context, &info);
}

/* Machines without IPv6 have the first alone. */
static tn_status listen_on_all(tn_server *server, unsigned port, tn_error *error)
{
    int reason = port > 0 ? try_port(port) : 0;
    server->hosts[0] = reason ? NULL : listen_on(server, "127.0.0.1", port);
    if (!server->hosts[0])
        return no_port(port, reason, error);
    unsigned had = (unsigned)lws_get_vhost_listen_port(server->hosts[0]);
    server->hosts[1] = listen_on(server, "::1", had);
    tn_gate_serve(&server->gate, had);
    lws_snprintf(server->address, sizeof server->address, "http://%s/#%s", server->gate.hosts[0], server->gate.token);
    lws_snprintf(server->address_once, sizeof server->address_once, "http://%s/%s", server->gate.hosts[0],
                 server->gate.key);
    return TN_OK;
}

/* ---- the server */

static tn_status open_context(tn_server *server, tn_error *error)
{
    const struct lws_context_creation_info info = {
        .port = CONTEXT_PORT_NO_LISTEN,
        .options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS | LWS_SERVER_OPTION_SKIP_SERVER_CANONICAL_NAME,
        .gid = (gid_t)-1,
        .uid = (uid_t)-1,
        .user = server,
        .fd_limit_per_thread = CONNECTIONS_MAX,
        .max_http_header_data2 = HEADERS_MAX,
        .max_http_header_pool = CONNECTIONS_MAX,
        .timeout_secs = REQUEST_SECONDS,
    };
    lws_set_log_level(0, NULL); /* what it says is not for people */
    server->context = lws_create_context(&info);
    return server->context ? TN_OK : tn_fail_memory(error);
}

tn_status tn_server_new(const tn_server_options *options, tn_server **server, tn_error *error)
{
    tn_server *made = calloc(1, sizeof *made);
    *server = NULL;
    if (!made)
        return tn_fail_memory(error);
    tn_windows_begin(&made->windows, options->folder, options->open, options->memory_limit);
    tn_status status = tn_gate_new(&made->gate, error);
    if (status == TN_OK)
        status = open_context(made, error);
    if (status == TN_OK)
        status = listen_on_all(made, options->port, error);
    if (status == TN_OK)
        *server = made;
    else
        tn_server_free(made);
    return status;
}

const char *tn_server_address(const tn_server *server)
{
    return server->address;
}

const char *tn_server_address_once(const tn_server *server)
{
    return server->address_once;
}

void tn_server_run(tn_server *server)
{
    while (!server->ended && lws_service(server->context, 0) >= 0) {
    }
}

void tn_server_end(tn_server *server)
{
    server->ended = true;
    lws_cancel_service(server->context);
}

bool tn_server_free(tn_server *server)
{
    if (server->context)
        lws_context_destroy(server->context); /* which closes the sockets; their windows are left then */
    if (!tn_windows_end(&server->windows, PATIENCE))
        return false;
    free(server);
    return true;
}
