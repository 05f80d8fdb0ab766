// The peer: what a user of OpenMesh would take to divide a square or a triangle so often: openmesh cc|loop STEPS RUNS
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sys/resource.h>
#include <vector>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

struct traits : OpenMesh::DefaultTraits {
    typedef OpenMesh::Vec3d Point;
    typedef OpenMesh::Vec3d Normal;
};
typedef OpenMesh::PolyMesh_ArrayKernelT<traits> poly_mesh;
typedef OpenMesh::TriMesh_ArrayKernelT<traits> tri_mesh;

template <class mesh_type, class subdivider> double divide(int corners, int steps, size_t *faces)
{
    static const double square[4][2] = {{-.5, -.5}, {.5, -.5}, {.5, .5}, {-.5, .5}}, triangle[3][2] = {{-.5, -.29}, {.5, -.29}, {0, .58}};
    mesh_type mesh;
    std::vector<typename mesh_type::VertexHandle> vertices;
    for (int i = 0; i < corners; i++) {
        const double *p = corners == 4 ? square[i] : triangle[i];
        vertices.push_back(mesh.add_vertex(OpenMesh::Vec3d(p[0], p[1], 0)));
    }
    mesh.add_face(vertices);
    subdivider tool;
    tool.attach(mesh);
    auto start = std::chrono::steady_clock::now();
    tool(static_cast<size_t>(steps));
    double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    tool.detach();
    *faces = mesh.n_faces();
    return took;
}

int main(int count, char **words)
{
    if (count < 4)
        return 2;
    bool loop = std::strcmp(words[1], "loop") == 0;
    int steps = std::atoi(words[2]), runs = std::atoi(words[3]);
    std::vector<double> times;
    size_t faces = 0;
    for (int i = 0; i < runs; i++)
        times.push_back(loop ? divide<tri_mesh, OpenMesh::Subdivider::Uniform::LoopT<tri_mesh, double>>(3, steps, &faces)
                             : divide<poly_mesh, OpenMesh::Subdivider::Uniform::CatmullClarkT<poly_mesh, double>>(4, steps, &faces));
    std::sort(times.begin(), times.end());
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    std::printf("OpenMesh %-13s %zu faces: median %8.1f ms of %d runs, %ld MB\n", loop ? "LoopT" : "CatmullClarkT", faces,
                1e3 * times[times.size() / 2], runs, usage.ru_maxrss / 1024);
    return 0;
}
