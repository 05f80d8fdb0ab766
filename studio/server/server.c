#include "studio/server/server.h"

#include <errno.h>
#include <netinet/in.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "studio/server/server_parts.h"

enum {
    CONNECTIONS_MAX = 512,  /* windows, and those that ask for files or say nothing */
    HEADERS_MAX = 16 << 10, /* bytes; browsers send the cookies of every server of this machine */
    REQUEST_SECONDS = 5,    /* in which a request is to have come */
    PATIENCE = 2,           /* seconds for windows to end */
};

static const struct lws_protocols protocols[] = {
    {"http", tn_http_callback, sizeof(tn_http_answer), 0, 0, NULL, 0},
    {TN_SUBPROTOCOL, tn_socket_callback, sizeof(tn_socket), TN_PIECE_MAX, 0, NULL, 0},
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
