/* The page's files by HTTP, and the refusals of all that is not asked as it should be. */
#include <string.h>

#include "studio/server/server_parts.h"

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

int tn_http_refuse(struct lws *wsi, unsigned status, const char *why)
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
    return tn_gate_host(&tn_server_of(wsi)->gate, host);
}

static int refuse_host(struct lws *wsi)
{
    return tn_http_refuse(wsi, 421, "This is not the address of the studio: open the one that it printed.");
}

/* Before there is a socket. Positive: it was answered. */
static int confirm_upgrade(struct lws *wsi)
{
    tn_server *server = tn_server_of(wsi);
    char host[VALUE_ROOM], origin[VALUE_ROOM], protocols[VALUE_ROOM];
    read_header(wsi, WSI_TOKEN_ORIGIN, origin);
    read_header(wsi, WSI_TOKEN_PROTOCOL, protocols);
    int sent;
    if (!host_is_ours(wsi, host))
        sent = refuse_host(wsi);
    else if (!tn_gate_origin(host, origin) || !tn_gate_protocols(&server->gate, protocols))
        sent =
            tn_http_refuse(wsi, HTTP_STATUS_FORBIDDEN, "Only pages that know the token of this address get a socket.");
    else if (tn_windows_full(&server->windows))
        sent = tn_http_refuse(wsi, HTTP_STATUS_SERVICE_UNAVAILABLE, "Too many windows are open: close one.");
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

static int begin_file(struct lws *wsi, const tn_page_file *file, tn_http_answer *answer)
{
    bool packed = file->packed && takes_gzip(wsi);
    header h;
    *answer = (tn_http_answer){packed ? file->packed : file->bytes, packed ? file->packed_size : file->size, 0};
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
    lws_snprintf(place, sizeof place, "/#%s", tn_server_of(wsi)->gate.token);
    add(wsi, &h, "location:", place);
    return send_header(wsi, &h) ? 0 : -1;
}

static int end_answer(struct lws *wsi, int sent)
{
    return sent < 0 || lws_http_transaction_completed(wsi) ? -1 : 0;
}

static int begin_answer(struct lws *wsi, const char *path, tn_http_answer *answer)
{
    char host[VALUE_ROOM];
    if (!host_is_ours(wsi, host))
        return end_answer(wsi, refuse_host(wsi));
    if (lws_hdr_total_length(wsi, WSI_TOKEN_GET_URI) <= 0) {
        tn_http_refuse(wsi, HTTP_STATUS_METHOD_NOT_ALLOWED, "The page is only read.");
        return -1; /* what the request carries is not read */
    }
    const tn_page_file *file = find_file(path);
    if (file)
        return begin_file(wsi, file, answer);
    if (tn_gate_key(&tn_server_of(wsi)->gate, path))
        return end_answer(wsi, redirect(wsi));
    return end_answer(wsi, tn_http_refuse(wsi, HTTP_STATUS_NOT_FOUND, "The page has no such file."));
}

static int go_on(struct lws *wsi, tn_http_answer *answer)
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

int tn_http_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in, size_t size)
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
