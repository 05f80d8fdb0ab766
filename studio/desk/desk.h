/* Questions about texts that a page has open, as messages of JSON-RPC: what the studio asks beside the language server.
 *
 * A desk is told of texts by the same notifications as the language server (textDocument/didOpen, didChange, didClose,
 * and workspace/didChangeWatchedFiles for files that are not open). `tartan/NAME` asks the question NAME of
 * docs/requests.md about one of them:
 *
 *   params  {"uri", "version", "request": {...}}; "set": ["lot=12m"] gives params of the file other values, and
 *           "texts": {"before.plan": "..."} are files that only this request names
 *   result  {"uri", "version", "answer": {...}, "notes": [{"severity", "code", "message", "help"?, "path"?, "line"?,
 *           "column"?}]}; with "bytes": [numbers] if files went apart
 *   error   -32601 no such question, -32602 the request makes no sense, -32800 ended by the watch, -32801 the text has
 *           another version, -32803 it failed; "data" has "code", "help", and the notes as above
 *
 * With "binary": true in its params, files of the answer that are no text (meshes as glb or stl, pictures in pixels)
 * are not in it as base64, but messages of bytes that go before it, in the order of its files; "bytes" has their
 * numbers. Such a message is, in little endian:
 *
 *   0  its number, 32 bits: from 1, each but once
 *   4  the size of the file, 32 bits
 *   8  the file
 *
 * A mesh is a .glb, which is made for this: behind a part of JSON, which says how many vertices, faces and groups there
 * are, of what colours, and where, stand the places and normals of the vertices as 32-bit floats and the corners of the
 * triangles as 32-bit indices, group by group. All of them begin at multiples of 4 bytes of the message: arrays of them
 * can be looked at where they are. A file of more than TN_DESK_BYTES_MAX is refused (E0804).
 *
 * `tartan/stdlib` {"name"?} gives the names of the standard library's files, or the text of one.
 *
 * Questions that read or write folders of runs are not answered here. A desk belongs to one thread at a time. */
#ifndef TARTAN_STUDIO_DESK_H
#define TARTAN_STUDIO_DESK_H

#include <jansson.h>

#include "driver/open/served.h"
#include "include/tartan/base.h"

enum { TN_DESK_BYTES_MAX = 64 << 20 };

typedef struct tn_desk tn_desk;

/* `served` (borrowed, to stay): whose files there are besides the texts. TN_MEMORY; free the desk in any case. */
tn_status tn_desk_new(const tn_served *served, tn_desk **desk, tn_error *error);
void tn_desk_free(tn_desk *desk);

/* Takes a message, which stays the caller's. *response is the text of the answer to a request, to be freed with free();
 * NULL after a notification. `watch` (may be NULL) ends what takes long. TN_MEMORY: there was no memory, not even to
 * say so. */
tn_status tn_desk_take(tn_desk *desk, const json_t *message, const tartan_watch *watch, char **response);

/* The next message of bytes that goes before the response of the last tn_desk_take, to be freed with free(); NULL: no
 * more. What is not asked for is forgotten by the next tn_desk_take. */
uint8_t *tn_desk_bytes(tn_desk *desk, size_t *size);

#endif
