/* Puts the files that a question makes where -o says. */
#ifndef TARTAN_CLI_COMMON_MADE_OUTPUTS_H
#define TARTAN_CLI_COMMON_MADE_OUTPUTS_H

#include "ask/session/made.h"
#include "cli/common/job.h"

typedef struct tn_made_outputs {
    tn_job *job;
    const char *const *paths;   /* borrowed; of the files, in the order in which they are made */
    const char *const *folders; /* the folder of each that is made if it is not there; NULL: none. It may be set. */
    size_t count, next;
    bool folder;     /* the one path is a folder, and each file has a name in it; one without is index.html */
    char *in_folder; /* the path of the file that is open there; owned */
    tn_output output;
    tn_file_taker taker;
} tn_made_outputs;

/* From now on files that questions of the job's session make go there. The folder is made with its first file. */
void tn_job_files(tn_job *job, tn_made_outputs *outputs, const char *const *paths, size_t count, bool folder);

/* No longer. */
void tn_job_files_end(tn_made_outputs *outputs);

/* Which of the words of a request's `format` the name of a picture means. */
unsigned tn_picture_choice(const char *path);

/* The same of the pictures of answers: the word none, 0, if the name is none of a picture. */
unsigned tn_answer_picture_choice(const char *path);

/* Asks for a picture, and puts it there. */
void tn_job_draw(tn_job *job, const tn_draw_request *request, const char *path);

#endif
