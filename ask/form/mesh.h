/* Meshes of surfaces and of designs of boxes: the parts of the question, and what its command needs of it. */
#ifndef TARTAN_ASK_FORM_MESH_H
#define TARTAN_ASK_FORM_MESH_H

#include "ask/session/questions.h"
#include "driver/field/field.h"
#include "driver/mesh/mesh_file.h"
#include "runtime/geometry/measure.h"

/* Which formats the words of mesh_request.format mean; TN_FILE_OTHER: none. */
enum { TN_MESH_FORMAT_COUNT = 10 };
extern const tn_file_format tn_mesh_formats[TN_MESH_FORMAT_COUNT];

/* Does the request make sense for its format? Otherwise TN_INVALID, which is said. No file needs to be open. */
tn_status tn_mesh_request_fits(tn_session *session, const tn_mesh_request *request);

/* And for the file that is open? */
tn_status tn_mesh_request_check(tn_session *session, const tn_mesh_request *request);

/* A mesh on its way. */
typedef struct tn_meshing {
    tn_session *session;
    const tn_mesh_request *request;
    tn_file_format format; /* TN_FILE_OTHER: none is made */
    bool measures;         /* are measures asked for? */
    tn_reply *answer;
} tn_meshing;

/* What is done to the mesh when it is finished. */
tn_mesh_changes tn_rework_asked(const tn_mesh_rework *asked);

/* Begins the answer: its measures if they are asked for, and what they say of any mesh. *measured is NULL if they are
 * not asked for. */
tn_status tn_meshing_answer(const tn_meshing *m, const tn_mesh *mesh, const tn_mesh_measures *measures, bool closed,
                            tn_measured_mesh **measured, tn_error *error);

/* What a mesh's file says beside the mesh. */
typedef struct tn_meshed_form {
    uint32_t name; /* in the module */
    tn_mesh_unit unit;
    const tn_field *field; /* whose gradient gives the normals, or NULL */
    double spacing;        /* of its grid */
} tn_meshed_form;

/* Tells what was measured, then makes the file if one is asked for. */
tn_status tn_meshing_finish(const tn_meshing *m, tn_mesh *mesh, const tn_meshed_form *form, tn_error *error);

/* Meshes a design of boxes; what is wrong is said. */
tn_status tn_mesh_solid(const tn_meshing *m);

/* A surface that is evaluated at one place after another. Close it in any case. */
typedef struct tn_probe {
    tn_open_field open;
    double *registers;
} tn_probe;

/* Opens the surface that is asked for; what is wrong with the request is said, too. */
tn_status tn_probe_open(tn_session *session, const tn_mesh_request *request, tn_probe *probe);
void tn_probe_close(tn_probe *probe);

/* The value at a place and its gradient; neither need be finite. Below 0 is inside. */
double tn_probe_at(const tn_probe *probe, const double place[3], double gradient[3]);

/* The answer for mesh_request.points. */
tn_status tn_mesh_points(tn_session *session, const tn_mesh_request *request, tn_reply *answer);

#endif
