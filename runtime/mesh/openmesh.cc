/* OpenMesh behind its C face: files, smoothing, subdividing, decimating. */
extern "C" {
#include "runtime/base/file.h"
#include "runtime/mesh/obj_lines.h"
#include "runtime/mesh/openmesh.h"
}

#include <fcntl.h>
#include <strings.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Decimater/Observer.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

namespace
{

struct traits : OpenMesh::DefaultTraits {
    typedef OpenMesh::Vec3d Point;
    typedef OpenMesh::Vec3d Normal;
};
typedef OpenMesh::PolyMesh_ArrayKernelT<traits> poly_mesh;
typedef OpenMesh::TriMesh_ArrayKernelT<traits> tri_mesh;

/* OpenMesh reports on a stream of its own; while this lives, nobody sees it. */
class silence
{
  public:
    silence()
    {
        omerr().disable();
        omout().disable();
        omlog().disable();
    }
    ~silence()
    {
        omerr().enable();
        omout().enable();
        omlog().enable();
    }
};

OpenMesh::Vec3d placed(const double *p, bool y_up)
{
    return y_up ? OpenMesh::Vec3d(p[0], p[2], -p[1]) : OpenMesh::Vec3d(p[0], p[1], p[2]);
}

template <class mesh_type> bool into(const tn_mesh *from, bool y_up, mesh_type &to)
{
    std::vector<typename mesh_type::VertexHandle> vertices, face;
    vertices.reserve(from->vertex_count);
    to.reserve(from->vertex_count, from->face_first[from->face_count], from->face_count);
    for (size_t v = 0; v < from->vertex_count; v++)
        vertices.push_back(to.add_vertex(placed(from->positions + 3 * v, y_up)));
    for (size_t f = 0; f < from->face_count; f++) {
        face.clear();
        for (uint32_t c = from->face_first[f]; c < from->face_first[f + 1]; c++)
            face.push_back(vertices[from->corners[c]]);
        if (!to.add_face(face).is_valid())
            return false; /* not a surface there: an edge with a third face, or a face turned the wrong way */
    }
    return true;
}

/* Each face with vertices of its own: all that an STL file tells, and what OpenMesh takes of any mesh. */
template <class mesh_type> void into_apart(const tn_mesh *from, bool y_up, mesh_type &to)
{
    std::vector<typename mesh_type::VertexHandle> face;
    for (size_t f = 0; f < from->face_count; f++) {
        face.clear();
        for (uint32_t c = from->face_first[f]; c < from->face_first[f + 1]; c++)
            face.push_back(to.add_vertex(placed(from->positions + 3 * (size_t)from->corners[c], y_up)));
        to.add_face(face);
    }
}

template <class mesh_type> tn_status out_of(const mesh_type &from, tn_mesh *to, tn_error *error)
{
    size_t corners = 0, v = 0, f = 0;
    for (auto face : from.faces())
        corners += from.valence(face);
    tn_status status = tn_mesh_new(from.n_vertices(), from.n_faces(), corners, to, error);
    if (status != TN_OK)
        return status;
    for (auto vertex : from.vertices()) {
        const auto &p = from.point(vertex);
        for (int k = 0; k < 3; k++)
            to->positions[3 * v + k] = p[k];
        v++;
    }
    uint32_t c = 0;
    for (auto face : from.faces()) {
        to->face_first[f++] = c;
        for (auto corner : from.fv_range(face))
            to->corners[c++] = static_cast<uint32_t>(corner.idx());
    }
    to->face_first[f] = c;
    return TN_OK;
}

/* Ends a decimation that nobody waits for any more. */
class patience : public OpenMesh::Decimater::Observer {
public:
    explicit patience(const tn_mesh *mesh) : Observer(1000), mesh(mesh) {}
    void notify(size_t) override { stopped = tn_mesh_check(mesh, nullptr) != TN_OK; }
    bool abort() const override { return stopped; }

private:
    const tn_mesh *mesh;
    bool stopped = false;
};

/* Errors by quadrics; of equal ones, as they all are within a plane, short sides go first, so that no slivers are left
 * that nothing can be done with later. */
class short_first : public OpenMesh::Decimater::ModQuadricT<tri_mesh>
{
  public:
    typedef OpenMesh::Decimater::ModHandleT<short_first> Handle;

    explicit short_first(tri_mesh &mesh) : ModQuadricT(mesh)
    {
        double area = 0;
        for (auto face : mesh.faces())
            area += mesh.calc_sector_area(mesh.halfedge_handle(face));
        weight = SHARE * area / static_cast<double>(std::max<size_t>(mesh.n_faces(), 1));
    }

    float collapse_priority(const CollapseInfo &c) override
    {
        float error = ModQuadricT::collapse_priority(c);
        return error < 0 ? error : error + static_cast<float>(weight * (c.p1 - c.p0).sqrnorm());
    }

  private:
    static constexpr double SHARE = 1e-6; /* of a triangle that is as far off as a side is long */
    double weight;                        /* an error is an area times the square of a distance */
};

/* Refuses collapses that fold a surface. Errors of quadrics see only how far planes are: within a plane, and where
 * triangles have next to no area, all of them are 0, whichever way round a triangle lies. */
class no_folds : public OpenMesh::Decimater::ModBaseT<tri_mesh>
{
  public:
    explicit no_folds(tri_mesh &mesh) : ModBaseT(mesh, true)
    {
        mesh.add_property(facing);
    }
    ~no_folds() override
    {
        mesh().remove_property(facing);
    }
    typedef OpenMesh::Decimater::ModHandleT<no_folds> Handle;

    void initialize() override
    {
        for (auto face : mesh().faces())
            mesh().property(facing, face) = first_facing(face);
    }

    float collapse_priority(const CollapseInfo &c) override
    {
        for (auto face : mesh().vf_range(c.v0))
            if (face != c.fl && face != c.fr && !stays(face, c))
                return ILLEGAL_COLLAPSE;
        return keeps_rim(c) ? LEGAL_COLLAPSE : ILLEGAL_COLLAPSE;
    }

    void postprocess_collapse(const CollapseInfo &c) override
    {
        for (auto face : mesh().vf_range(c.v1)) {
            triangle now = measure(face);
            if (now.height() >= slim)
                mesh().property(facing, face) = now.normal.normalized();
        }
    }

  private:
    typedef tri_mesh::Point point;
    OpenMesh::FPropHandleT<point> facing; /* the normal of each triangle when it last had a certain one */

    static constexpr double turn = 0.5;      /* cosine of how far a triangle may turn from that */
    static constexpr double slim = 0.01;     /* a triangle is at least this high, as a share of its longest side */
    static constexpr double straight = 0.97; /* cosine of how much a rim may bend where a vertex of it goes */

    struct triangle {
        point normal; /* twice its area long */
        double longest;
        double height() const
        {
            return longest > 0 ? normal.norm() / (longest * longest) : 0;
        }
    };

    static triangle measure(const point &a, const point &b, const point &c)
    {
        double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        return {OpenMesh::cross(b - a, c - a), longest};
    }

    /* With one of its corners elsewhere. */
    triangle measure(tri_mesh::FaceHandle face, tri_mesh::VertexHandle moved, const point &to)
    {
        point at[3];
        int i = 0;
        for (auto corner : mesh().fv_range(face))
            at[i++] = corner == moved ? to : mesh().point(corner);
        return measure(at[0], at[1], at[2]);
    }

    triangle measure(tri_mesh::FaceHandle face)
    {
        return measure(face, tri_mesh::VertexHandle(), point());
    }

    /* Triangles that are lines say nothing: they look as their neighbours do. */
    point first_facing(tri_mesh::FaceHandle face)
    {
        triangle own = measure(face);
        if (own.height() < slim)
            for (auto beside : mesh().ff_range(face))
                own.normal += measure(beside).normal;
        double length = own.normal.norm();
        return length > 0 ? own.normal / length : point(0, 0, 0);
    }

    bool stays(tri_mesh::FaceHandle face, const CollapseInfo &c)
    {
        triangle before = measure(face), after = measure(face, c.v0, c.p1);
        double length = after.normal.norm();
        return after.height() >= std::min(slim, before.height()) && length > 0 &&
               OpenMesh::dot(after.normal, mesh().property(facing, face)) >= turn * length;
    }

    /* A vertex of a rim leaves it only where it is about straight. */
    bool keeps_rim(const CollapseInfo &c)
    {
        for (auto out : mesh().voh_range(c.v0)) {
            auto before = mesh().opposite_halfedge_handle(out);
            bool rim = mesh().is_boundary(out) || mesh().is_boundary(before);
            tri_mesh::VertexHandle other = mesh().to_vertex_handle(out);
            if (!rim || other == c.v1)
                continue;
            point one = c.p0 - mesh().point(other), next = c.p1 - c.p0;
            if (OpenMesh::dot(one, next) < straight * one.norm() * next.norm())
                return false;
        }
        return true;
    }
};

bool all_triangles(const tn_mesh *mesh)
{
    for (size_t f = 0; f < mesh->face_count; f++)
        if (mesh->face_first[f + 1] - mesh->face_first[f] != 3)
            return false;
    return true;
}

tn_status no_surface(tn_error *error)
{
    tn_fail(error, TN_INVALID, E_MESH_NO_SURFACE, "the mesh is not a surface: some edge has more than two faces");
    tn_error_help(error, "OBJ, PLY and STL files take such meshes as they are; what reworks a mesh does not");
    return TN_INVALID;
}

/* Runs what may throw; C code gets a status instead. */
template <class action> tn_status guarded(tn_error *error, action what)
{
    try {
        silence quiet;
        return what();
    } catch (const std::bad_alloc &) {
        return tn_fail_memory(error);
    } catch (const std::exception &problem) {
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the mesh library gives up: %s", problem.what());
    }
}

/* Puts a result in the place of what it was made from. */
template <class mesh_type> tn_status replace(const mesh_type &from, tn_mesh *mesh, tn_error *error)
{
    tn_mesh made = {};
    tn_status status = out_of(from, &made, error);
    if (status != TN_OK)
        return status;
    made.watch = mesh->watch;
    tn_mesh_clear(mesh);
    *mesh = made;
    return TN_OK;
}

template <class mesh_type, class subdivider> tn_status subdivide(tn_mesh *mesh, unsigned rounds, tn_error *error)
{
    mesh_type m;
    if (!into(mesh, false, m))
        return no_surface(error);
    subdivider tool;
    if (!tool.attach(m))
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the mesh cannot be subdivided");
    tn_status status = TN_OK;
    for (unsigned round = 0; status == TN_OK && round < rounds; round++) {
        tool(1);
        status = tn_mesh_check(mesh, error);
    }
    tool.detach();
    return status == TN_OK ? replace(m, mesh, error) : status;
}

bool is_obj(const char *path)
{
    const char *dot = std::strrchr(path, '.');
    return dot && strcasecmp(dot, ".obj") == 0;
}

} // namespace

extern "C" tn_status tn_openmesh_read(const char *path, tn_mesh *mesh, tn_error *error)
{
    *mesh = tn_mesh{};
    return guarded(error, [&] {
        poly_mesh m;
        OpenMesh::IO::Options options;
        int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* for its state alone */
        tn_file_state before = tn_file_state_of(file);
        tn_status same = is_obj(path) ? tn_obj_check(path, error) : TN_OK;
        bool read = same == TN_OK && OpenMesh::IO::read_mesh(m, path, options);
        if (same == TN_OK)
            same = tn_file_state_same(&before, file, path, error);
        if (file >= 0)
            close(file);
        if (same != TN_OK)
            return same;
        if (!read) {
            tn_fail(error, TN_IO, E_CANNOT_READ, "cannot read a mesh from %s", path);
            tn_error_help(error,
                          "OBJ, PLY, STL, OFF and OM files can be read; see that it is there and is one of these");
            return TN_IO;
        }
        tn_status status = out_of(m, mesh, error);
        if (status == TN_OK)
            status = tn_mesh_weld(mesh, error);
        if (status == TN_OK && mesh->face_count == 0) {
            tn_fail(error, TN_INVALID, TN_CODE_NONE, "there are no faces in %s", path);
            status = TN_INVALID;
        }
        if (status != TN_OK)
            tn_mesh_clear(mesh);
        return status;
    });
}

extern "C" tn_status tn_openmesh_write(const tn_mesh *mesh, tn_file_format format, bool y_up, unsigned char **bytes,
                                       size_t *size, tn_error *error)
{
    *bytes = nullptr;
    *size = 0;
    return guarded(error, [&] {
        poly_mesh m;
        bool surface = into(mesh, y_up, m);
        if (!surface && format != TN_FILE_STL)
            return no_surface(error);
        if (!surface) {
            m.clear();
            into_apart(mesh, y_up, m);
        }
        OpenMesh::IO::Options options;
        if (format != TN_FILE_OFF)
            options += OpenMesh::IO::Options::Binary;
        std::ostringstream out(std::ios::binary);
        if (format == TN_FILE_OFF)
            out.precision(17);
        if (format == TN_FILE_STL)
            m.triangulate();
        const std::string extension = std::string(".") + tn_file_format_word(format);
        if (!OpenMesh::IO::write_mesh(m, out, extension, options, 17))
            return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the mesh library cannot write this mesh");
        const std::string text = out.str();
        *bytes = static_cast<unsigned char *>(std::malloc(text.size() + 1));
        if (!*bytes)
            return tn_fail_memory(error);
        std::memcpy(*bytes, text.data(), text.size());
        *size = text.size();
        return TN_OK;
    });
}

extern "C" tn_status tn_openmesh_smooth(tn_mesh *mesh, unsigned iterations, tn_error *error)
{
    return guarded(error, [&] {
        tri_mesh m;
        tn_mesh triangles = {};
        tn_status status =
            tn_mesh_new(mesh->vertex_count, mesh->face_count, mesh->face_first[mesh->face_count], &triangles, error);
        if (status != TN_OK)
            return status;
        std::memcpy(triangles.positions, mesh->positions, 3 * mesh->vertex_count * sizeof *mesh->positions);
        std::memcpy(triangles.face_first, mesh->face_first, (mesh->face_count + 1) * sizeof *mesh->face_first);
        std::memcpy(triangles.corners, mesh->corners, mesh->face_first[mesh->face_count] * sizeof *mesh->corners);
        status = tn_mesh_triangulate(&triangles, error);
        bool surface = status == TN_OK && into(&triangles, false, m);
        tn_mesh_clear(&triangles);
        if (status != TN_OK)
            return status;
        if (!surface)
            return no_surface(error);
        typedef OpenMesh::Smoother::JacobiLaplaceSmootherT<tri_mesh> smoother;
        smoother tool(m);
        tool.initialize(smoother::Tangential_and_Normal, smoother::C1);
        for (unsigned i = 0; i < iterations; i++) {
            tool.smooth(1);
            status = tn_mesh_check(mesh, error);
            if (status != TN_OK)
                return status;
        }
        for (auto vertex : m.vertices()) {
            const auto &p = m.point(vertex);
            for (int k = 0; k < 3; k++)
                mesh->positions[3 * static_cast<size_t>(vertex.idx()) + k] = p[k];
        }
        return TN_OK;
    });
}

extern "C" tn_status tn_openmesh_subdivide(tn_mesh *mesh, unsigned rounds, tn_error *error)
{
    return guarded(error, [&] {
        if (all_triangles(mesh))
            return subdivide<tri_mesh, OpenMesh::Subdivider::Uniform::LoopT<tri_mesh, double>>(mesh, rounds, error);
        return subdivide<poly_mesh, OpenMesh::Subdivider::Uniform::CatmullClarkT<poly_mesh, double>>(mesh, rounds,
                                                                                                     error);
    });
}

extern "C" tn_status tn_openmesh_decimate(tn_mesh *mesh, size_t faces, tn_error *error)
{
    tn_status status = tn_mesh_triangulate(mesh, error);
    if (status != TN_OK)
        return status;
    return guarded(error, [&] {
        tri_mesh m;
        if (!into(mesh, false, m))
            return no_surface(error);
        OpenMesh::Decimater::DecimaterT<tri_mesh> tool(m);
        short_first::Handle quadric;
        no_folds::Handle folds;
        tool.add(quadric);
        tool.module(quadric).unset_max_err();
        tool.add(folds);
        if (!tool.initialize())
            return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the mesh cannot be decimated");
        patience waits(mesh);
        tool.set_observer(&waits);
        tool.decimate_to_faces(0, faces);
        status = tn_mesh_check(mesh, error);
        if (status != TN_OK)
            return status;
        m.garbage_collection();
        return replace(m, mesh, error);
    });
}

static tn_status read_mesh(void *, const char *path, tn_mesh *mesh, tn_error *error)
{
    return tn_openmesh_read(path, mesh, error);
}

const tn_mesh_reader tn_openmesh_reader = {read_mesh, nullptr};
