/* What a page sends, from any bytes: a name of a file, which leads to nothing outside of the folder that is served, by
 * the kernel's resolving and step by step; offers of subprotocols, of which none has the token; and messages, which
 * change no file outside. The first byte chooses. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "studio/server/file_requests.h"
#include "studio/server/gate.h"
#include "studio/server/question_queue.h"
#include "tests/fuzz/fuzz.h"

typedef struct place {
    char top[64], in[80];
    tn_studio_folder *resolving, *walking;
} place;

static void stop(const char *what)
{
    fprintf(stderr, "served: %s\n", what);
    abort();
}

static void write_text(const char *folder, const char *name, const char *text)
{
    char path[160];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    if (!file || fputs(text, file) < 0 || fclose(file) != 0)
        stop("the folder cannot be made");
}

static void link_to(const char *folder, const char *name, const char *to)
{
    char path[160];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (symlink(to, path) != 0)
        stop("a link cannot be made");
}

static void make(place *p)
{
    char path[160];
    tn_error error;
    snprintf(p->top, sizeof p->top, "/tmp/tartan-fuzz-XXXXXX");
    if (!mkdtemp(p->top))
        stop("the folder cannot be made");
    snprintf(p->in, sizeof p->in, "%s/in", p->top);
    snprintf(path, sizeof path, "%s/a", p->in);
    if (mkdir(p->in, 0777) != 0 || mkdir(path, 0777) != 0)
        stop("the folder cannot be made");
    write_text(p->top, "b.plan", "outside");
    write_text(p->in, "b.plan", "inside");
    write_text(p->in, "a/b.plan", "inside");
    link_to(p->in, "c.plan", "../b.plan");
    link_to(p->in, "d", "..");
    link_to(p->in, "e.plan", "a/b.plan");
    if (tn_studio_folder_open(p->in, false, &p->resolving, &error) != TN_OK ||
        tn_studio_folder_open(p->in, false, &p->walking, &error) != TN_OK)
        stop(error.message);
    tn_studio_folder_walk(p->walking);
}

static void clear(place *p)
{
    char command[128];
    tn_studio_folder_close(p->resolving);
    tn_studio_folder_close(p->walking);
    snprintf(command, sizeof command, "rm -rf %s", p->top);
    if (system(command) != 0)
        stop("the folder cannot be removed");
}

static bool reads(const tn_studio_folder *folder, const char *name)
{
    uint8_t *bytes;
    size_t size;
    tn_error error;
    if (tn_studio_folder_read(folder, name, 100, &bytes, &size, &error) != TN_OK)
        return false;
    if (strcmp((const char *)bytes, "inside") != 0)
        stop("a file outside is read");
    free(bytes);
    return true;
}

static void try_name(const place *p, const char *name)
{
    /* what is found step by step has no link in it, and is found by the kernel too */
    if (reads(p->walking, name) && !reads(p->resolving, name) && !strstr(name, ".."))
        stop("only walking finds it");
}

static void try_offer(const char *text)
{
    tn_gate gate;
    tn_error error;
    if (tn_gate_new(&gate, &error) != TN_OK)
        stop(error.message);
    tn_gate_serve(&gate, 1234);
    if (tn_gate_protocols(&gate, text) || tn_gate_key(&gate, text))
        stop("somebody knows the secret");
    if (tn_gate_host(&gate, text) && strcmp(text, "127.0.0.1:1234") != 0 && strcmp(text, "[::1]:1234") != 0)
        stop("another host is ours");
}

/* As a window hands it out. */
static void try_message(const place *p, const char *text)
{
    json_t *message = json_loads(text, 0, NULL), *answer;
    const char *method = json_string_value(json_object_get(message, "method"));
    tn_file_requests requests = {.folder = p->resolving};
    size_t next = 0;
    if (method && tn_file_requests_takes(method))
        json_decref(tn_file_requests_answer(&requests, message));
    while ((answer = tn_file_requests_changed(&requests, &next)))
        json_decref(answer);
    tn_file_requests_clear(&requests);
    tn_question_queue *queue = tn_question_queue_new();
    if (!queue)
        stop("out of memory");
    for (int i = 0; i < 3 && message; i++) {
        tn_question_queue_put(queue, json_deep_copy(message), 1);
        tn_question_queue_next(queue);
    }
    json_decref(tn_question_queue_done(queue));
    while ((answer = tn_question_queue_ended(queue)))
        json_decref(answer);
    tn_question_queue_free(queue);
    json_decref(message);
    tn_file_hash outside = tn_hash_of_bytes("outside", 7);
    char path[160];
    snprintf(path, sizeof path, "%s/b.plan", p->top);
    FILE *file = fopen(path, "r");
    char found[16] = "";
    if (!file || !fgets(found, sizeof found, file) ||
        strcmp(tn_hash_of_bytes(found, strlen(found)).text, outside.text) != 0)
        stop("a file outside is changed");
    fclose(file);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size == 0)
        return 0;
    char *text = strndup((const char *)data + 1, size - 1);
    if (!text)
        return 0;
    if (data[0] == 'o') {
        try_offer(text);
    } else {
        place p;
        make(&p);
        if (data[0] == 'm')
            try_message(&p, text);
        else
            try_name(&p, text);
        clear(&p);
    }
    free(text);
    return 0;
}
