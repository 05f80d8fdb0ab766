#include "studio/server/used_files.h"

#include <stdlib.h>
#include <string.h>

void tn_used_files_begin(tn_used_files *used, tn_studio_folder *folder)
{
    *used = (tn_used_files){.folder = folder};
    pthread_mutex_init(&used->lock, NULL);
}

void tn_used_files_clear(tn_used_files *used)
{
    for (size_t i = 0; i < used->count; i++)
        free(used->files[i].name);
    pthread_mutex_destroy(&used->lock);
}

/* Files that are not there are noted, too: they may come. */
static void note(tn_used_files *used, const char *name, const tn_file_stamp *stamp)
{
    pthread_mutex_lock(&used->lock);
    size_t i = 0;
    while (i < used->count && strcmp(used->files[i].name, name) != 0)
        i++;
    char *copy = i == used->count && i < TN_USED_MAX ? strdup(name) : NULL;
    if (copy)
        used->files[used->count++] = (tn_used_file){copy, *stamp};
    pthread_mutex_unlock(&used->lock);
}

static tn_status read_noted(void *context, const char *path, uint8_t **bytes, size_t *size, tn_error *error)
{
    tn_used_files *used = context;
    const char *name = path + (path[0] == '/');
    /* before it is read: what is written meanwhile is a change */
    tn_file_stamp stamp = tn_studio_folder_stamp(used->folder, name);
    note(used, name, &stamp);
    tn_served served = tn_studio_folder_served(used->folder);
    return served.read(served.context, path, bytes, size, error);
}

static tn_status list(void *context, char ***paths, size_t *count, bool *cut_off, tn_error *error)
{
    tn_used_files *used = context;
    tn_served served = tn_studio_folder_served(used->folder);
    return served.list(served.context, paths, count, cut_off, error);
}

tn_served tn_used_files_served(tn_used_files *used)
{
    return (tn_served){.read = read_noted, .list = list, .context = used};
}

char *tn_used_files_changed(tn_used_files *used, size_t *next)
{
    char *changed = NULL;
    pthread_mutex_lock(&used->lock);
    while (!changed && *next < used->count) {
        tn_used_file *file = &used->files[(*next)++];
        tn_file_stamp stamp = tn_studio_folder_stamp(used->folder, file->name);
        if (memcmp(&stamp, &file->stamp, sizeof stamp) == 0)
            continue;
        file->stamp = stamp;
        changed = strdup(file->name);
    }
    pthread_mutex_unlock(&used->lock);
    return changed;
}

bool tn_used_files_any(tn_used_files *used)
{
    pthread_mutex_lock(&used->lock);
    bool any = used->count > 0;
    pthread_mutex_unlock(&used->lock);
    return any;
}
