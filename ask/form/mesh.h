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

/* A mesh on its way. */
typedef struct tn_meshing {
    tn_session *session;
    const tn_mesh_request *request;
    tn_file_format format; /* TN_FILE_OTHER: none is made */
    bool measures;         /* are measures asked for? */
    tn_reply *answer;
} tn_meshing;

/* What a mesh's file says beside the mesh. */
typedef struct tn_meshed_form {
    uint32_t name; /* in the module */
    tn_mesh_unit unit;
    const tn_field *field; /* whose gradient gives the normals, or NULL */
    double spacing;        /* of its grid */
} tn_meshed_form;

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

#endif
