/* mesh, asked for places: a field, its gradient and what is inside, at each of them. */
#include <math.h>
#include <stdlib.h>

#include "ask/form/mesh.h"
#include "runtime/base/bytes.h"

tn_status tn_probe_open(tn_session *session, const tn_mesh_request *request, tn_probe *probe)
{
    tn_error error;
    *probe = (tn_probe){0};
    tn_status status = tn_mesh_request_check(session, request);
    if (status != TN_OK)
        return status;
    status = tn_open_field_of(session->opened, request->field.surface, &probe->open, &error);
    if (status == TN_OK) {
        probe->registers = calloc((size_t)probe->open.field.samples.register_count * 4 + 1, sizeof *probe->registers);
        status = probe->registers ? TN_OK : tn_fail_memory(&error);
    }
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

void tn_probe_close(tn_probe *probe)
{
    free(probe->registers);
    tn_open_field_close(&probe->open);
    *probe = (tn_probe){0};
}

double tn_probe_at(const tn_probe *probe, const double place[3], double gradient[3])
{
    const tn_field *field = &probe->open.field;
    return tn_tape_gradient(&field->samples, place, &field->distances, probe->registers, gradient);
}

static void set_point(const tn_probe *probe, const tn_space_point *at, tn_valued_point *to)
{
    const double place[3] = {at->x, at->y, at->z};
    double gradient[3];
    to->value = tn_probe_at(probe, place, gradient);
    to->has_value = isfinite(to->value);
    to->has_gradient = isfinite(gradient[0]) && isfinite(gradient[1]) && isfinite(gradient[2]);
    to->gradient =
        (tn_space_point){tn_without_sign(gradient[0]), tn_without_sign(gradient[1]), tn_without_sign(gradient[2])};
    to->inside = to->value < 0;
    to->value = tn_without_sign(to->value);
}

static tn_status set_points(const tn_probe *probe, const tn_mesh_request *request, tn_reply *answer, tn_error *error)
{
    const tn_field *field = &probe->open.field;
    tn_status status = tn_reply_new(&tn_message_valued_points, answer, error);
    tn_valued_points *points = answer->value;
    if (status == TN_OK)
        status = TN_NEW_LIST(valued_point, points->points, request->points.count, error);
    if (status != TN_OK)
        return status;
    points->surface = tn_text(field->module, field->record->name);
    for (size_t i = 0; i < request->points.count && status == TN_OK; i++) {
        if (tn_watch_stopped_at(field->module->watch, i))
            status = tn_fail_stopped(field->module->watch, error);
        else
            set_point(probe, &request->points.items[i], &points->points.items[i]);
    }
    return status;
}

tn_status tn_mesh_points(tn_session *session, const tn_mesh_request *request, tn_reply *answer)
{
    tn_probe probe;
    tn_error error;
    tn_status status = tn_probe_open(session, request, &probe);
    if (status == TN_OK) {
        status = set_points(&probe, request, answer, &error);
        if (status != TN_OK)
            tn_session_fail(session, &error);
    }
    tn_probe_close(&probe);
    return status;
}
