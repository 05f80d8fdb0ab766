/* Puts the files of a run into its folder, or gives them away. */
#include "driver/breed/run_files.h"

#include <stdlib.h>

static char *path_of(const char *dir, const char *name)
{
    char *path = NULL;
    return asprintf(&path, "%s/%s", dir, name) < 0 ? NULL : path;
}

tn_status tn_run_file_begin(const char *dir, const tn_run_files *files, const char *name, tn_run_file *file,
                            tn_error *error)
{
    *file = (tn_run_file){.files = files};
    if (files)
        return files->opens(files->context, name, &file->stream, error);
    char *path = path_of(dir, name);
    tn_status status = path ? tn_output_open(path, &file->output, error) : tn_fail_memory(error);
    file->stream = status == TN_OK ? file->output.stream : NULL;
    free(path);
    return status;
}

tn_status tn_run_file_end(tn_run_file *file, tn_status status, tn_error *error)
{
    if (file->files)
        return file->files->closes(file->files->context, status, error);
    if (status == TN_OK)
        return tn_output_commit(&file->output, error);
    tn_output_discard(&file->output);
    return status;
}

tn_status tn_run_picture_begin(const char *dir, const tn_run_files *files, const char *name, tn_run_picture *picture,
                               tn_error *error)
{
    *picture = (tn_run_picture){.files = files, .name = name};
    if (files)
        return tn_canvas_format_of(name, &picture->to.format, error);
    picture->path = path_of(dir, name);
    picture->to.path = picture->path;
    return picture->path ? TN_OK : tn_fail_memory(error);
}

tn_status tn_run_picture_end(tn_run_picture *picture, tn_status status, tn_error *error)
{
    tn_run_file file;
    if (status == TN_OK && picture->files) {
        status = tn_run_file_begin(NULL, picture->files, picture->name, &file, error);
        if (status == TN_OK) {
            fwrite(picture->to.element, 1, picture->to.size, file.stream); /* what fails shows when it is ended */
            status = tn_run_file_end(&file, TN_OK, error);
        }
    }
    free(picture->to.element);
    free(picture->path);
    *picture = (tn_run_picture){0};
    return status;
}
