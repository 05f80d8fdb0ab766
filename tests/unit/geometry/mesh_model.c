/* Trees of parts: siblings have different names, faces are put in the order of their groups, and what is written of a
 * part in a GLB and an OBJ. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "runtime/base/random.h"
#include "runtime/geometry/write.h"

static tn_error error;

static uint32_t node(tn_mesh_model *model, uint32_t parent, const char *name)
{
    uint32_t made;
    assert_int_equal(tn_mesh_model_node(model, parent, name, &made, &error), TN_OK);
    return made;
}

static void test_names(void **state)
{
    (void)state;
    tn_mesh_model model = {0};
    assert_int_equal(node(&model, 0, "house"), 0);
    uint32_t room = node(&model, 0, "room");
    node(&model, room, "window");
    node(&model, room, "window-2");
    assert_string_equal(model.nodes[node(&model, room, "window")].name, "window-3");
    uint32_t other = node(&model, 0, "room");
    assert_string_equal(model.nodes[other].name, "room-2");
    assert_string_equal(model.nodes[node(&model, other, "window")].name, "window");
    assert_string_equal(model.nodes[node(&model, 0, "house")].name, "house"); /* it is no sibling of the whole */
    tn_mesh_model_clear(&model);
}

/* Triangles of random groups; the first corner of each is its number. */
static void make_triangles(size_t count, uint32_t groups, tn_mesh *mesh)
{
    assert_int_equal(tn_mesh_new(count, count, 3 * count, mesh, &error), TN_OK);
    mesh->group_count = groups;
    mesh->face_group = calloc(count, sizeof *mesh->face_group);
    assert_non_null(mesh->face_group);
    for (size_t i = 0; i < count; i++) {
        mesh->face_first[i] = (uint32_t)(3 * i);
        for (size_t k = 0; k < 3; k++) {
            mesh->corners[3 * i + k] = (uint32_t)((i + k) % count);
            mesh->positions[3 * i + k] = (double)(i * (k + 1));
        }
        mesh->face_group[i] = (uint32_t)(tn_random64(1, i, 0) % groups);
    }
    mesh->face_first[count] = (uint32_t)(3 * count);
}

static void test_order(void **state)
{
    (void)state;
    tn_mesh mesh;
    make_triangles(500, 7, &mesh);
    uint32_t was[500];
    memcpy(was, mesh.face_group, sizeof was);
    assert_int_equal(tn_mesh_sort_faces(&mesh, &error), TN_OK);
    for (size_t f = 0; f < 500; f++) {
        uint32_t number = mesh.corners[3 * f];
        assert_int_equal(mesh.face_group[f], was[number]);
        assert_int_equal(mesh.corners[3 * f + 2], (number + 2) % 500);
        if (f > 0) /* those of a group stay in their order */
            assert_true(mesh.face_group[f - 1] < mesh.face_group[f] ||
                        (mesh.face_group[f - 1] == mesh.face_group[f] && mesh.corners[3 * f - 3] < number));
    }
    tn_mesh_clear(&mesh);
}

static char *written(const tn_mesh *mesh, const tn_mesh_style *style,
                     tn_status write(const tn_mesh *, const tn_mesh_style *, FILE *, tn_error *), size_t *size)
{
    char *bytes;
    FILE *out = open_memstream(&bytes, size);
    assert_non_null(out);
    assert_int_equal(write(mesh, style, out, &error), TN_OK);
    assert_int_equal(fclose(out), 0);
    return bytes;
}

static void test_files(void **state)
{
    (void)state;
    tn_mesh mesh;
    tn_mesh_model model = {0};
    uint32_t material;
    size_t size;
    make_triangles(40, 3, &mesh);
    assert_int_equal(tn_mesh_sort_faces(&mesh, &error), TN_OK);
    node(&model, 0, "all");
    uint32_t top = node(&model, 0, "first floor"), empty = node(&model, top, "empty");
    assert_int_equal(empty, 2);
    const unsigned char red[3] = {255, 0, 0};
    assert_int_equal(tn_mesh_model_material(&model, "a wall", red, 1, &material, &error), TN_OK);
    assert_int_equal(tn_mesh_model_material(&model, "glass", red, 0.25, &material, &error), TN_OK);
    const tn_mesh_piece pieces[] = {{1, 0}, {3, 0}, {3, 1}};
    node(&model, top, "\xC3\xBC\"");
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(tn_mesh_model_piece(&model, pieces[i], &error), TN_OK);
    const tn_mesh_style style = {.model = &model, .mtl = "some file.mtl", .normals = true};
    char *obj = written(&mesh, &style, tn_mesh_write_obj, &size),
         *glb = written(&mesh, &style, tn_mesh_write_glb, &size);
    assert_non_null(strstr(obj, "\nmtllib some file.mtl\n"));
    assert_non_null(strstr(obj, "\no first_floor\ng first_floor\nusemtl a_wall\nf "));
    assert_non_null(strstr(obj, "\no first_floor/\xC3\xBC\"\ng first_floor \xC3\xBC\"\nusemtl a_wall\nf "));
    assert_non_null(strstr(obj, "\nusemtl glass\nf "));
    assert_non_null(strstr(glb + 20, "{\"name\":\"first floor\",\"mesh\":0,\"children\":[2,3]},{\"name\":\"empty\"},"
                                     "{\"name\":\"\xC3\xBC\\\"\",\"mesh\":1}"));
    assert_non_null(strstr(glb + 20, "\"NORMAL\":3},\"indices\":6,\"material\":1}"));
    free(obj);
    free(glb);
    tn_mesh_model_clear(&model);
    tn_mesh_clear(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_names), cmocka_unit_test(test_order),
                                       cmocka_unit_test(test_files)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
