/* The engines for a page without a server: the language server and the desk, over files that the page holds. Texts go
 * in and come out as UTF-8; messages are those of the Language Server Protocol and of studio/desk/desk.h.
 *
 * A page has one of these in each of its workers. Texts that come out are freed with free(). */
#include <stdlib.h>
#include <string.h>

#include "lsp/exchange.h"
#include "runtime/base/array.h"
#include "runtime/base/memory.h"
#include "studio/desk/desk.h"

/* Half an answer's while: a review that takes longer gives up. */
#define REVIEW_SECONDS 4.0

typedef struct page_file {
    char *path, *text;
    size_t size;
} page_file;

typedef struct tn_page {
    page_file *files;
    size_t file_count, file_room;
    tn_served served;
    tn_exchange *exchange;
    tn_desk *desk;
    tartan_watch watch;
} tn_page;

/* Called from JavaScript. */
tn_page *tn_page_new(void);
void tn_page_free(tn_page *page);
int tn_page_file(tn_page *page, const char *path, const char *text);
int tn_page_take(tn_page *page, const char *message);
char *tn_page_next(tn_page *page);
int tn_page_wait(const tn_page *page);
void tn_page_work(tn_page *page);
char *tn_page_ask(tn_page *page, const char *message);
uint8_t *tn_page_bytes(tn_page *page);

/* ---- files */

static page_file *find(tn_page *page, const char *path)
{
    for (size_t i = 0; i < page->file_count; i++)
        if (strcmp(page->files[i].path, path) == 0)
            return &page->files[i];
    return NULL;
}

static tn_status read(void *context, const char *path, uint8_t **bytes, size_t *size, tn_error *error)
{
    const page_file *file = find(context, path);
    if (!file)
        return tn_fail(error, TN_IO, E_CANNOT_READ, "there is no file %.300s", path + 1);
    *bytes = malloc(file->size + 1);
    if (!*bytes)
        return tn_fail_memory(error);
    memcpy(*bytes, file->text, file->size + 1);
    *size = file->size;
    return TN_OK;
}

static tn_status list(void *context, char ***paths, size_t *count, bool *cut_off, tn_error *error)
{
    const tn_page *page = context;
    *paths = calloc(page->file_count + 1, sizeof **paths);
    *cut_off = false;
    *count = 0;
    if (!*paths)
        return tn_fail_memory(error);
    for (; *count < page->file_count; ++*count) {
        (*paths)[*count] = strdup(page->files[*count].path);
        if (!(*paths)[*count])
            return tn_fail_memory(error);
    }
    return TN_OK;
}

static void take_away(tn_page *page, page_file *file)
{
    free(file->path);
    free(file->text);
    *file = page->files[--page->file_count];
}

/* A file of that path ("/cabins.plan") has that text from now on; NULL: there is none. 0, or -1 where out of memory.
 * Texts that use it are told of it as of any file: by workspace/didChangeWatchedFiles. */
int tn_page_file(tn_page *page, const char *path, const char *text)
{
    page_file *old = find(page, path);
    if (!text) {
        if (old)
            take_away(page, old);
        return 0;
    }
    page_file file = {strdup(path), strdup(text), strlen(text)};
    if (!file.path || !file.text ||
        !tn_array_reserve(&page->files, &page->file_room, page->file_count, 1, sizeof *page->files)) {
        free(file.path);
        free(file.text);
        return -1;
    }
    old = find(page, path); /* files may have moved */
    if (old)
        take_away(page, old);
    page->files[page->file_count++] = file;
    return 0;
}

/* ---- the page */

/* NULL where out of memory. */
tn_page *tn_page_new(void)
{
    tn_error error;
    tn_page *page = calloc(1, sizeof *page);
    if (!page)
        return NULL;
    page->served = (tn_served){read, list, page};
    page->watch = tartan_watch_init();
    page->watch.memory_limit = tn_memory_used() + tn_memory_available("") / 4 * 3;
    if (tn_exchange_new(&page->served, &page->exchange, &error) != TN_OK ||
        tn_desk_new(&page->served, &page->desk, &error) != TN_OK) {
        tn_page_free(page);
        return NULL;
    }
    return page;
}

void tn_page_free(tn_page *page)
{
    if (!page)
        return;
    while (page->file_count > 0)
        take_away(page, page->files);
    tn_exchange_free(page->exchange);
    tn_desk_free(page->desk);
    free(page->files);
    free(page);
}

/* ---- the language server */

/* Takes a message. 0, or -1 if no more will be answered. */
int tn_page_take(tn_page *page, const char *message)
{
    json_error_t wrong;
    json_t *read_message = json_loads(message, JSON_REJECT_DUPLICATES, &wrong);
    if (read_message)
        tn_exchange_take(page->exchange, read_message);
    else
        tn_exchange_malformed(page->exchange, wrong.text);
    json_decref(read_message);
    return tn_exchange_ended(page->exchange) || tn_exchange_failed(page->exchange) ? -1 : 0;
}

/* The next message for the page; NULL: there is none now. */
char *tn_page_next(tn_page *page)
{
    json_t *message = tn_exchange_next(page->exchange);
    char *text = message ? json_dumps(message, JSON_COMPACT) : NULL;
    json_decref(message);
    return text;
}

/* In how many milliseconds tn_page_work is to be called if no message comes before; -1: not before one comes. */
int tn_page_wait(const tn_page *page)
{
    return tn_exchange_patience(page->exchange);
}

/* No message waits: finds out what is wrong with the texts that changed and, once typing has paused, what their rules
 * mean. There are no threads: a message that comes meanwhile waits. */
void tn_page_work(tn_page *page)
{
    tn_exchange_work(page->exchange);
    tn_review *review = tn_exchange_review(page->exchange);
    if (!review)
        return;
    tn_review_run(review, REVIEW_SECONDS);
    tn_exchange_reviewed(page->exchange, review);
}

/* ---- the desk */

/* The answer to a question; NULL after a notification, and where there was no memory for an answer. */
char *tn_page_ask(tn_page *page, const char *message)
{
    json_error_t wrong;
    char *response = NULL;
    json_t *question = json_loads(message, JSON_REJECT_DUPLICATES, &wrong);
    if (question && tn_desk_take(page->desk, question, &page->watch, &response) != TN_OK)
        response = NULL;
    json_decref(question);
    return response;
}

/* The next message of bytes that goes before that answer; it says its size (desk.h). NULL: no more. */
uint8_t *tn_page_bytes(tn_page *page)
{
    size_t size;
    return tn_desk_bytes(page->desk, &size);
}
