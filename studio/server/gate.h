/* Who is let in: the address that is served, and the secret that only its reader knows.
 *
 * Every page in the person's browser can reach this port, and every program on the machine. So a socket is let in only
 * with the token, which stands in the fragment of the address that is printed; a page of another origin is refused even
 * with it; and a name that somebody made point here is not answered at all. */
#ifndef TARTAN_STUDIO_SERVER_GATE_H
#define TARTAN_STUDIO_SERVER_GATE_H

#include "runtime/base/error.h"

#define TN_SUBPROTOCOL "tartan.1"

enum { TN_SECRET_DIGITS = 32 }; /* 128 bits */

typedef struct tn_gate {
    char hosts[2][24]; /* 127.0.0.1:PORT, [::1]:PORT */
    char token[TN_SECRET_DIGITS + 1];
    char key[TN_SECRET_DIGITS + 1]; /* good for one answer, which says the token */
} tn_gate;

/* Makes the secrets. TN_INTERNAL if the system has no random bytes. */
tn_status tn_gate_new(tn_gate *gate, tn_error *error);

/* The port is known once it is open. */
void tn_gate_serve(tn_gate *gate, unsigned port);

/* Is it the value of a Host header that names us, exactly? */
bool tn_gate_host(const tn_gate *gate, const char *host);

/* Is the Origin that of pages of this host? */
bool tn_gate_origin(const char *host, const char *origin);

/* Do the subprotocols say the one that is spoken here, and then the token? */
bool tn_gate_protocols(const tn_gate *gate, const char *list);

/* Is the path that with the key? It is true once: what a browser is started with can be read by other programs, for as
 * long as it runs. */
bool tn_gate_key(tn_gate *gate, const char *path);

#endif
