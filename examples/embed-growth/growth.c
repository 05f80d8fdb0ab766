/* A program of its own that grows a surface: it compiles a growth study, puts a sphere of its own around the surface,
 * grows it step by step, and writes the mesh and a picture.
 *
 *   cc growth.c $(pkg-config --cflags --libs tartan) -o growth
 *   ./growth dome.study dome.obj dome.svg
 */
#include <stdio.h>
#include <stdlib.h>

#include <tartan/tartan.h>

static void show(void *context, const tartan_diagnostic *d)
{
    (void)context;
    fprintf(stderr, "%s:%zu:%zu: %s\n", d->path ? d->path : "?", d->line, d->column, d->message);
}

/* Comes some times a second while Tartan works; false would end the work. */
static bool go_on(void *context, double done, double total)
{
    (void)context;
    fprintf(stderr, "\rstep %.0f of %.0f", done, total);
    return true;
}

static tartan_status write_file(const char *path, const void *bytes, size_t size, tartan_error *error)
{
    FILE *out = fopen(path, "wb");
    bool written = out && fwrite(bytes, 1, size, out) == size;
    if ((out && fclose(out) != 0) || !written) {
        snprintf(error->message, sizeof error->message, "%s cannot be written", path);
        return error->status = TARTAN_IO;
    }
    return TARTAN_OK;
}

/* What has grown, by its numbers and by the arrays that a renderer takes. */
static void describe(const tartan_measures *m, const tartan_mesh *mesh)
{
    size_t vertices = 0, faces = 0;
    const double *positions = tartan_mesh_positions(mesh, &vertices);
    const uint32_t *corners = NULL, *first = tartan_mesh_faces(mesh, &corners, &faces);
    double highest = 0;
    for (size_t v = 0; v < vertices; v++)
        highest = positions[3 * v + 2] > highest ? positions[3 * v + 2] : highest;
    printf("step %u: %llu vertices, %llu edges, %llu faces\n", (unsigned)m->step, (unsigned long long)m->vertices,
           (unsigned long long)m->edges, (unsigned long long)m->faces);
    printf("the highest vertex is at %.3f; the first face has %u corners and begins at vertex %u\n", highest,
           (unsigned)(first[1] - first[0]), (unsigned)corners[first[0]]);
}

static tartan_status save(tartan_growth *growth, const tartan_mesh *mesh, char **paths, tartan_error *error)
{
    void *bytes = NULL;
    size_t size = 0;
    tartan_status status = tartan_mesh_write(mesh, TARTAN_OBJ, NULL, NULL, &bytes, &size, error);
    if (status == TARTAN_OK)
        status = write_file(paths[0], bytes, size, error);
    tartan_bytes_free(bytes);
    bytes = NULL;
    if (status == TARTAN_OK)
        status = tartan_growth_draw(growth, TARTAN_SVG, NULL, NULL, &bytes, &size, error);
    if (status == TARTAN_OK)
        status = write_file(paths[1], bytes, size, error);
    tartan_bytes_free(bytes);
    return status;
}

static tartan_status grow(const tartan_module *module, char **paths, tartan_error *error)
{
    tartan_growth_options options = tartan_growth_options_init();
    tartan_growth *growth = NULL;
    tartan_mesh *mesh = NULL;
    tartan_measures measures = tartan_measures_init();
    tartan_boundary sphere = {.kind = TARTAN_SPHERE, .mode = TARTAN_SLIDE, .inside = true, .radius = 2.5};
    tartan_watch watch = tartan_watch_init();

    watch.go_on = go_on;

    /* What the study says, but for the sphere, which is ours. */
    tartan_status status = tartan_growth_options_of(module, &options, error);
    options.boundaries = &sphere;
    options.boundary_count = 1;
    if (status == TARTAN_OK)
        status = tartan_growth_new(module, &options, &growth, error);
    if (status == TARTAN_OK)
        status = tartan_growth_grow(growth, options.steps, &watch, error);
    fputs("\n", stderr);
    if (status == TARTAN_OK)
        status = tartan_growth_measure(growth, &measures, error);
    if (status == TARTAN_OK)
        status = tartan_growth_mesh(growth, NULL, &mesh, error);
    if (status == TARTAN_OK) {
        describe(&measures, mesh);
        status = save(growth, mesh, paths, error);
    }
    tartan_mesh_free(mesh);
    tartan_growth_free(growth);
    return status;
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: %s RULES MESH.obj PICTURE.svg\n", argv[0]);
        return 2;
    }
    tartan_error error;
    tartan_module *module = NULL;
    tartan_compile_options options = tartan_compile_options_init();
    options.report = show;
    tartan_status status = tartan_compile_file(argv[1], &options, &module, &error);
    if (status == TARTAN_OK)
        status = grow(module, argv + 2, &error);
    if (status != TARTAN_OK)
        fprintf(stderr, "%s: %s\n", argv[0], error.message);
    tartan_module_free(module);
    return status != TARTAN_OK;
}
