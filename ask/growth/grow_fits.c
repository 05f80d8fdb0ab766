/* Which requests to grow make sense: what says something about some formats only, and what draws or writes in ways that
 * exclude each other. */
#include <stdio.h>

#include "ask/growth/grow.h"

const tn_file_format tn_grow_formats[TN_GROW_FORMAT_COUNT] = {TN_FILE_OTHER, TN_FILE_OBJ, TN_FILE_PLY, TN_FILE_STL,
                                                              TN_FILE_OFF,   TN_FILE_OM,  TN_FILE_GLB, TN_FILE_DXF,
                                                              TN_FILE_SVG,   TN_FILE_PNG, TN_FILE_PDF};

enum { MESH = 1, SURFACE = 2, LINES = 4, NORMALS = 8, GROUPS = 16, AXIS = 32, PICTURE = 64 };

static const unsigned format_can[TN_FILE_FORMATS + 1] = {
    [TN_FILE_OBJ] = MESH | SURFACE | LINES | NORMALS | GROUPS | AXIS,
    [TN_FILE_PLY] = MESH | SURFACE | LINES | NORMALS | GROUPS | AXIS,
    [TN_FILE_STL] = MESH | SURFACE | AXIS,
    [TN_FILE_OFF] = MESH | SURFACE | AXIS,
    [TN_FILE_OM] = MESH | SURFACE | AXIS,
    [TN_FILE_GLB] = MESH | SURFACE | NORMALS | GROUPS,
    [TN_FILE_DXF] = MESH | LINES | GROUPS | AXIS,
    [TN_FILE_SVG] = PICTURE,
    [TN_FILE_PNG] = PICTURE,
    [TN_FILE_PDF] = PICTURE,
};

/* Used with another format they would do nothing. */
static tn_status check_uses(tn_session *session, const tn_grow_request *r)
{
    static const char surface[] = "write a surface: .obj, .ply, .stl, .off, .om or .glb",
                      picture[] = "write a picture: .svg, .png or .pdf";
    const tn_grow_picture *p = &r->picture;
    const struct {
        bool given;
        unsigned needs;
        const char *name, *help;
    } uses[] = {
        {r->rework.has_subdivide, SURFACE, "subdivide", surface},
        {r->rework.has_decimate, SURFACE, "decimate", surface},
        {r->rework.has_smooth, MESH, "smooth", "write a mesh: .obj, .ply, .stl, .off, .om, .glb or .dxf"},
        {r->triangulate, SURFACE, "triangulate", surface},
        {r->lines, LINES, "lines", "only .obj, .ply and .dxf hold lines"},
        {r->normals, NORMALS, "normals", "only .obj, .ply and .glb hold normals of vertices"},
        {r->groups, GROUPS, "groups", "only .obj, .ply, .glb and .dxf hold groups"},
        {r->up != 0, AXIS, "up", "a .glb has y up always; a picture is turned with --azimuth and --elevation"},
        {p->has_azimuth, PICTURE, "azimuth", picture},
        {p->has_elevation, PICTURE, "elevation", picture},
        {p->has_width, PICTURE, "width", picture},
        {p->has_columns, PICTURE, "columns", "write a --sheet: .svg, .png or .pdf"},
        {p->has_dpi, PICTURE, "dpi", "write a picture: .png"},
        {p->surroundings != 0, PICTURE, "surroundings", picture},
        {r->has_turn, PICTURE, "turn", "name a folder, as -o turn, or one moving picture, as -o turn.png"},
        {p->title != NULL, PICTURE, "title", picture},
        {r->sheet, PICTURE, "sheet", picture},
        {r->overlay.count > 0, PICTURE, "overlay", picture},
        {r->each_step, PICTURE | MESH, "each-step", "name one with -o"},
    };
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++) {
        if (!uses[i].given || (format_can[tn_grow_formats[r->format]] & uses[i].needs))
            continue;
        return r->format
                   ? tn_session_refuse(session, uses[i].help, "--%s does nothing for this kind of file", uses[i].name)
                   : tn_session_refuse(session, "name one with -o", "--%s does nothing without a file", uses[i].name);
    }
    return TN_OK;
}

static tn_status check_turn(tn_session *session, const tn_grow_request *r, const char *output)
{
    if (!r->has_turn && r->moving)
        return tn_session_refuse(session, "say of how many pictures: `turn`", "what moves is a turn");
    if (!r->has_turn)
        return TN_OK;
    if (tn_grow_formats[r->format] != TN_FILE_PNG)
        return tn_session_refuse(session, "name a folder, as -o turn, or one moving picture, as -o turn.png",
                                 "--turn writes PNG pictures, and %s is none",
                                 output ? output : tn_file_format_word(tn_grow_formats[r->format]));
    if (r->sheet || r->overlay.count > 0 || r->each_step)
        return tn_session_refuse(session, NULL,
                                 "--turn shows the last step: leave --sheet, --overlay and --each-step out");
    return TN_OK;
}

static tn_status check_overlay(tn_session *session, const tn_grow_request *r)
{
    bool fits = r->overlay.count <= TN_OVERLAY_MAX;
    for (size_t i = 0; fits && i < r->overlay.count; i++)
        fits = r->overlay.items[i] <= TN_STEPS_MAX;
    if (!fits)
        return tn_session_refuse(session, "for example --overlay 1,3,5", "--overlay takes up to %d steps",
                                 TN_OVERLAY_MAX);
    if (r->overlay.count > 0 && (r->sheet || r->each_step))
        return tn_session_refuse(session, NULL, "--overlay draws one picture: leave --sheet and --each-step out");
    return TN_OK;
}

tn_status tn_grow_request_fits(tn_session *session, const tn_grow_request *r, const char *output)
{
    tn_status status = check_uses(session, r);
    if (status == TN_OK && (r->rework.has_subdivide || r->rework.has_decimate) && (r->lines || r->groups))
        status = tn_session_refuse(session, "leave one or the other out",
                                   "--subdivide and --decimate make new faces, which have no edges of the rules: "
                                   "--lines and --groups have nothing to show");
    if (status == TN_OK)
        status = check_turn(session, r, output);
    if (status == TN_OK)
        status = check_overlay(session, r);
    if (status == TN_OK && r->sheet && r->each_step)
        status = tn_session_refuse(session, NULL, "a --sheet has every step already: leave --each-step out");
    return status;
}
