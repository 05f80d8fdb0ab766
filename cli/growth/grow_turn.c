/* tartan grow --turn: a surface seen from all around, as pictures or as one that moves. */
#include <stdlib.h>
#include <string.h>

#include "cli/growth/grow.h"
#include "runtime/base/file.h"
#include "runtime/scene/apng.h"

enum { TURN_TIME = 4000, SLOWEST = 1000 }; /* thousandths of a second: a whole turn, and the longest for one picture */

static tn_status take_view(const tn_growth *growth, const tn_camera *camera, bool surrounded, tn_view **view,
                           tn_error *error)
{
    tn_sight sight = {0};
    tn_status status = tn_growth_sight_add(growth, &sight, error);
    if (status == TN_OK && surrounded)
        status = tn_growth_sight_surround(growth, &sight, error);
    sight.turns = true;
    if (status == TN_OK)
        status = tn_view_take(&sight, camera, view, error);
    tn_sight_clear(&sight);
    return status;
}

static tn_status draw_frame(tn_job *job, const tn_growth *growth, const tn_study *study, uint64_t frame, tn_picture *to,
                            tn_error *error)
{
    const tn_grow_settings *settings = tn_grow_settings_of(job);
    tn_camera camera = tn_grow_camera(settings);
    camera.azimuth += 360.0 * (double)frame / (double)settings->turn.value;
    tn_view *view = NULL;
    tn_view_options options = {.title = settings->title ? settings->title : study->title,
                               .scaled = true,
                               .fades = true,
                               .dpi = (uint32_t)settings->dpi.value,
                               .legend = tn_growth_legend(tn_growth_rules(growth))};
    tn_status status = take_view(growth, &camera, tn_grow_surrounded(settings, study), &view, error);
    if (status == TN_OK)
        status = tn_views_draw(&view, 1, &options, to, error);
    tn_view_free(view);
    return status;
}

/* DIR/turn-000.png, DIR/turn-001.png and so on. */
static tn_status draw_files(tn_job *job, const tn_growth *growth, const tn_study *study, const char *dir,
                            tn_error *error)
{
    tn_status status = tn_folder_make(dir, error);
    for (uint64_t i = 0; i < tn_grow_settings_of(job)->turn.value && status == TN_OK; i++) {
        char *path = NULL;
        if (asprintf(&path, "%s/turn-%03u.png", dir, (unsigned)i) < 0)
            return tn_fail_memory(error);
        status = draw_frame(job, growth, study, i, &(tn_picture){.path = path, .format = TN_CANVAS_PNG}, error);
        free(path);
    }
    return status;
}

static tn_status draw_moving(tn_job *job, const tn_growth *growth, const tn_study *study, const char *path,
                             tn_error *error)
{
    size_t count = (size_t)tn_grow_settings_of(job)->turn.value;
    unsigned delay = TURN_TIME / (unsigned)count;
    tn_output output;
    tn_picture *frames = calloc(count, sizeof *frames);
    tn_status status = frames ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        frames[i].format = TN_CANVAS_PNG;
        status = draw_frame(job, growth, study, i, &frames[i], error);
    }
    if (status == TN_OK)
        status = tn_output_open(path, &output, error);
    if (status == TN_OK) {
        status = tn_apng_write(frames, count, delay < SLOWEST ? delay : SLOWEST, output.stream, error);
        if (status == TN_OK)
            tn_job_commit(job, &output);
        else
            tn_output_discard(&output);
    }
    for (size_t i = 0; i < count && frames; i++)
        free(frames[i].element);
    free(frames);
    return status;
}

void tn_grow_turn(tn_job *job, const tn_growth *growth, const tn_study *study, tn_file_format format)
{
    const char *path = tn_grow_settings_of(job)->output;
    tn_error error;
    tn_status status = format == TN_FILE_PNG ? draw_moving(job, growth, study, path, &error)
                                             : draw_files(job, growth, study, path, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
}
