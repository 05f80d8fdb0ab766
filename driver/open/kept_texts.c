/* Keeps the texts that were found. */
#include "driver/open/kept_texts.h"

#include <stdlib.h>
#include <string.h>

void tn_kept_begin(tn_kept_texts *kept, tn_overlay *overlay, void *context)
{
    *kept = (tn_kept_texts){.overlay = overlay, .overlay_context = context, .lock = PTHREAD_MUTEX_INITIALIZER};
}

static void free_text(tn_kept_text *text)
{
    free(text->key);
    free(text->path);
    free(text->identity);
    free(text->bytes);
    free(text);
}

void tn_kept_clear(tn_kept_texts *kept)
{
    for (tn_kept_text *text = kept->first, *next; text; text = next) {
        next = text->next;
        free_text(text);
    }
    kept->first = NULL;
    pthread_mutex_destroy(&kept->lock);
}

bool tn_kept_overlaid(const tn_kept_texts *kept, const char *path, tn_kept_text *text)
{
    return kept->overlay && kept->overlay(kept->overlay_context, path, &text->text, &text->size);
}

static tn_status add(tn_kept_texts *kept, char *key, tn_find_text *find, void *context, tn_error *error)
{
    tn_kept_text *text = calloc(1, sizeof *text);
    if (!text) {
        free(key);
        return tn_fail_memory(error);
    }
    text->key = key;
    tn_status status = find(context, text, error);
    if (status != TN_OK) {
        free_text(text);
        return status;
    }
    text->next = kept->first;
    kept->first = text;
    return TN_OK;
}

static const tn_kept_text *known(const tn_kept_texts *kept, const char *key)
{
    const tn_kept_text *text = kept->first;
    while (text && strcmp(text->key, key) != 0)
        text = text->next;
    return text;
}

tn_status tn_kept_get(tn_kept_texts *kept, char *key, tn_find_text *find, void *context, const tn_kept_text **text,
                      tn_error *error)
{
    tn_status status = TN_OK;
    pthread_mutex_lock(&kept->lock);
    *text = known(kept, key);
    if (*text) {
        free(key);
    } else {
        status = add(kept, key, find, context, error);
        *text = kept->first;
    }
    pthread_mutex_unlock(&kept->lock);
    return status;
}
