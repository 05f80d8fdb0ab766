#include "studio/server/question_queue.h"

#include <stdlib.h>
#include <string.h>

typedef struct entry {
    struct entry *next;
    json_t *message;
    size_t size;
} entry;

struct tn_question_queue {
    entry *first, **last; /* that wait */
    entry *work;          /* at work, or NULL */
    bool unwanted;
    entry *ended, **last_ended; /* to be answered so */
    size_t size;
};

tn_question_queue *tn_question_queue_new(void)
{
    tn_question_queue *queue = calloc(1, sizeof *queue);
    if (queue) {
        queue->last = &queue->first;
        queue->last_ended = &queue->ended;
    }
    return queue;
}

static void free_entry(entry *e)
{
    if (e)
        json_decref(e->message);
    free(e);
}

static void free_entries(entry *first)
{
    while (first) {
        entry *next = first->next;
        free_entry(first);
        first = next;
    }
}

void tn_question_queue_free(tn_question_queue *queue)
{
    if (!queue)
        return;
    free_entries(queue->first);
    free_entries(queue->ended);
    free_entry(queue->work);
    free(queue);
}

static const char *text_of(const json_t *message, const char *name)
{
    const char *text = json_string_value(json_object_get(json_object_get(message, "params"), name));
    return text ? text : "";
}

static const char *method_of(const json_t *message)
{
    const char *method = json_string_value(json_object_get(message, "method"));
    return method ? method : "";
}

static bool is_question(const json_t *message)
{
    return json_object_get(message, "id") != NULL;
}

/* Does the newer one take the place of the older one? */
static bool same_question(const json_t *older, const json_t *newer)
{
    return is_question(older) && is_question(newer) && strcmp(method_of(older), method_of(newer)) == 0 &&
           strcmp(text_of(older, "uri"), text_of(newer, "uri")) == 0 &&
           strcmp(text_of(older, "subject"), text_of(newer, "subject")) == 0;
}

/* Is it the question that the cancelling message names? */
static bool is_named(const json_t *question, const json_t *cancelling)
{
    const json_t *id = json_object_get(json_object_get(cancelling, "params"), "id");
    return id && is_question(question) && json_equal(json_object_get(question, "id"), id);
}

typedef bool concerns(const json_t *question, const json_t *message);

static void end_those(tn_question_queue *queue, concerns *concerned, const json_t *message)
{
    queue->unwanted = queue->unwanted || (queue->work && concerned(queue->work->message, message));
    for (entry **at = &queue->first; *at;) {
        entry *e = *at;
        if (!concerned(e->message, message)) {
            at = &e->next;
            continue;
        }
        *at = e->next;
        if (queue->last == &e->next)
            queue->last = at;
        queue->size -= e->size;
        e->next = NULL;
        *queue->last_ended = e;
        queue->last_ended = &e->next;
    }
}

bool tn_question_queue_put(tn_question_queue *queue, json_t *message, size_t size)
{
    if (strcmp(method_of(message), "$/cancelRequest") == 0) {
        end_those(queue, is_named, message);
        json_decref(message);
        return true;
    }
    entry *e = malloc(sizeof *e);
    if (!e) {
        json_decref(message);
        return false;
    }
    end_those(queue, same_question, message);
    *e = (entry){NULL, message, size};
    *queue->last = e;
    queue->last = &e->next;
    queue->size += size;
    return true;
}

const json_t *tn_question_queue_next(tn_question_queue *queue)
{
    entry *e = queue->first;
    if (!e || queue->work)
        return NULL;
    queue->first = e->next;
    if (!queue->first)
        queue->last = &queue->first;
    queue->size -= e->size;
    queue->work = e;
    queue->unwanted = false;
    return e->message;
}

bool tn_question_queue_unwanted(const tn_question_queue *queue)
{
    return queue->unwanted;
}

static json_t *cancelled(const json_t *question)
{
    return json_pack("{s:s,s:O,s:{s:i,s:s}}", "jsonrpc", "2.0", "id", json_object_get(question, "id"), "error", "code",
                     TN_CANCELLED, "message", "nobody waits for the answer any more");
}

json_t *tn_question_queue_done(tn_question_queue *queue)
{
    json_t *answer = queue->work && queue->unwanted ? cancelled(queue->work->message) : NULL;
    free_entry(queue->work);
    queue->work = NULL;
    queue->unwanted = false;
    return answer;
}

json_t *tn_question_queue_ended(tn_question_queue *queue)
{
    entry *e = queue->ended;
    if (!e)
        return NULL;
    queue->ended = e->next;
    if (!queue->ended)
        queue->last_ended = &queue->ended;
    json_t *answer = cancelled(e->message);
    free_entry(e);
    return answer;
}

size_t tn_question_queue_size(const tn_question_queue *queue)
{
    return queue->size;
}
