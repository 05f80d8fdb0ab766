/* Growing surfaces: the parts of the question, and what its command needs of it. */
#ifndef TARTAN_ASK_GROWTH_GROW_H
#define TARTAN_ASK_GROWTH_GROW_H

#include "ask/session/questions.h"
#include "ask/session/session.h"
#include "runtime/base/formats.h"
#include "runtime/growth/picture/draw.h"
#include "runtime/growth/stats.h"
#include "runtime/growth/study.h"

/* Which formats the words of grow_request.format mean; TN_FILE_OTHER: none. */
enum { TN_GROW_FORMAT_COUNT = 11 };
extern const tn_file_format tn_grow_formats[TN_GROW_FORMAT_COUNT];

enum { TN_OVERLAY_MAX = 32 }; /* steps over one another */

/* Does the request make sense? Otherwise TN_INVALID, which is said. No file needs to be open. output: what the file is
 * called, or NULL. */
tn_status tn_grow_request_fits(tn_session *session, const tn_grow_request *request, const char *output);

/* The study that the statements are, which uses the file of that path (`rules`: it holds a rewrite system, otherwise it
 * is a study); *text (malloc) is NULL if there are no statements. TN_MEMORY. */
tn_status tn_grow_study_text(const tn_grow_statements *said, const char *path, bool rules, char **text, size_t *size,
                             tn_error *error);

/* What texts about steps are made of (grown_steps.shown), and whose names the steps borrow. While a surface grows,
 * session.so_far is told a `grown` after the seed and after each step, before and behind what is done with it, whose
 * `stats` have this also if no steps are measured. */
typedef struct tn_grown_shown {
    tn_growth_system *system;
    tn_study study;
    bool complete;   /* all steps are there */
    tn_stats *stats; /* [count] of the steps, if these are measured */
    size_t count, room;
} tn_grown_shown;

/* A surface that grows. */
typedef struct tn_growing {
    tn_session *session;
    const tn_grow_request *request;
    tn_file_format format; /* TN_FILE_OTHER: nothing is made */
    tn_growth *growth;
    tn_grown *grown;       /* the answer so far */
    tn_grown_shown *shown; /* of the answer */
} tn_growing;

/* ---- steps */

/* ---- files */

/* Adds the growth as it stands, a mesh or a picture, to the files. name: of one of several, or NULL. */
tn_status tn_grown_write(const tn_growing *g, const char *name, tn_error *error);

/* Adds a picture of all views on one sheet; of what was gathered of several steps; of the surface from all around. */
tn_status tn_grown_sheet(const tn_growing *g, tn_view *const *views, size_t count, tn_error *error);
tn_status tn_grown_overlay(const tn_growing *g, tn_display_list *display, tn_error *error);
tn_status tn_grown_turn(const tn_growing *g, tn_error *error);

tn_camera tn_grown_camera(const tn_growing *g);

/* Are surroundings drawn? If it is not said: if there are any. */
bool tn_grown_surrounded(const tn_growing *g);

#endif
