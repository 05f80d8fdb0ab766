/* Decimated meshes: closed, nothing folded over or turned inwards, about the area and volume that they had; open ones
 * keep their rim. */
#include <math.h>

#include "runtime/base/error.h"
#include "runtime/geometry/measure.h"
#include "runtime/mesh/openmesh.h"
#include "tests/unit/field/support.h"

typedef struct form {
    const char *text;
    size_t least; /* triangles that still tell the form */
    double share; /* of volume and area that may be lost with four times as many */
} form;

static const form forms[] = {
    {"surface s = max(max(abs(x) - 3, abs(y) - 2), abs(z) - 4) grid 40", 12, 0.02},
    {"surface s = max(max(abs(x) - 6, abs(y) - 5), abs(z) - 0.4) grid 40", 12, 0.05},
    {"surface s = max(max(abs(x) - 6, abs(y) - 0.3), abs(z) - 0.4) grid 60", 12, 0.09},
    {"surface s = max(max(max(abs(x) - 4, abs(y) - 4), abs(z) - 3), 2 - max(abs(x), abs(y))) grid 36", 64, 0.03},
    {"surface s = max(max(max(abs(x) - 4, abs(y) - 4), abs(z) - 2), 2.5 - sqrt(x*x + y*y)) grid 40", 250, 0.04},
    {"surface s = max(max(abs(x + 0.3*y) - 3, abs(y - 0.2*z) - 2), abs(z + 0.5*x) - 3) grid 40", 12, 0.05},
    {"surface s = min(max(max(abs(x) - 5, abs(y) - 1), abs(z) - 1), max(max(abs(x) - 1, abs(y) - 5), abs(z) - 1.5)) "
     "grid 36",
     60, 0.05},
    {"surface s = sqrt(x*x + y*y + z*z) - 5 grid 36", 300, 0.04},
    {"surface s = sqrt(square(sqrt(x*x + y*y) - 4) + z*z) - 1.6 grid 36", 500, 0.05},
    {"surface s = max(sqrt(x*x + y*y) - 3, abs(z) - 5) grid 36", 150, 0.05},
};
enum { FORMS = sizeof forms / sizeof *forms };

/* Triangles that look against the field: it is smaller before them than behind, by more than it is on a cut-off edge.
 */
static size_t count_turned(const tn_field *field, const tn_mesh *mesh, double step)
{
    double *kept = calloc(field->kept + 1, sizeof *kept);
    size_t turned = 0;
    assert_non_null(kept);
    for (size_t f = 0; f < mesh->face_count; f++) {
        tn_vector at[3], middle = {0, 0, 0};
        double values[2];
        for (int k = 0; k < 3; k++) {
            at[k] = tn_vector_at(mesh->positions + 3 * (size_t)mesh->corners[3 * f + (size_t)k]);
            middle = tn_along(middle, at[k], 1.0 / 3);
        }
        tn_vector normal = tn_normalised(tn_cross(tn_sub(at[1], at[0]), tn_sub(at[2], at[0])));
        for (int k = 0; k < 2; k++) {
            tn_vector p = tn_along(middle, normal, k ? step : -step);
            values[k] =
                tn_number_run_at(field->module->code, field->code, (double[]){p.x, p.y, p.z}, &field->distances, kept);
        }
        turned += !(values[1] > values[0] - 1.2 * step);
    }
    free(kept);
    return turned;
}

static tn_mesh_measures measure(const tn_mesh *mesh)
{
    tn_mesh_measures m;
    tn_error error;
    assert_int_equal(tn_mesh_measure(mesh, 0, &m, &error), TN_OK);
    return m;
}

/* False in a build without the part `mesh`, which cannot decimate. */
static bool decimate(tn_mesh *mesh, size_t faces)
{
    tn_error error = {0};
    tn_status status = tn_openmesh_decimate(mesh, faces, &error);
    if (status != TN_OK && error.code == E_PART_ABSENT)
        return false;
    assert_int_equal(status, TN_OK);
    return true;
}

static bool near(double a, double b, double share)
{
    return fabs(a - b) <= share * b;
}

static void check(const form *f, const tn_field *field, bool sharp)
{
    tn_field_grid grid = tn_field_grid_of(field, 0);
    tn_contour contour;
    tn_error error;
    assert_int_equal(
        tn_contour_new(field, &grid, &(tn_contour_options){.threads = 2, .sharp = sharp}, &contour, &error), TN_OK);
    tn_mesh_measures before = measure(&contour.mesh);
    size_t turned_before = count_turned(field, &contour.mesh, contour.spacing / 8);
    const size_t targets[] = {contour.mesh.face_count / 2, contour.mesh.face_count / 8, 20 * f->least, 4 * f->least,
                              f->least};
    tn_mesh mesh;
    assert_int_equal(tn_mesh_copy(&contour.mesh, &mesh, &error), TN_OK);
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) { /* each goes on from the one before */
        if (targets[i] >= mesh.face_count || !decimate(&mesh, targets[i]))
            continue;
        tn_mesh_measures after = measure(&mesh);
        double share = targets[i] > f->least ? f->share : 5 * f->share;
        size_t turned = count_turned(field, &mesh, contour.spacing / 8);
        check_manifold(&mesh);
        bool good = turned <= turned_before && after.parts == before.parts && after.euler == before.euler &&
                    mesh.face_count <= targets[i] + targets[i] / 4 + 16 && near(after.area, before.area, share) &&
                    near(after.volume, before.volume, share);
        if (!good)
            fail_msg("%s\n%s to %zu: %zu triangles of %zu, %zu turned, area %g of %g, volume %g of %g", f->text,
                     sharp ? "sharp" : "plain", targets[i], mesh.face_count, contour.mesh.face_count, turned,
                     after.area, before.area, after.volume, before.volume);
    }
    tn_mesh_clear(&mesh);
    tn_contour_clear(&contour);
}

static void test_closed(void **state)
{
    (void)state;
    for (int i = 0; i < FORMS; i++) {
        tn_module *module = compile(forms[i].text);
        tn_field field;
        tn_error error;
        assert_int_equal(tn_field_read(module, 0, NULL, &field, &error), TN_OK);
        for (int sharp = 0; sharp < 2; sharp++)
            check(&forms[i], &field, sharp);
        tn_field_clear(&field);
        tn_module_free(module);
    }
}

/* The sides of triangles that no other triangle has: how long they are together. */
static double rim_of(const tn_mesh *mesh)
{
    size_t count = 3 * mesh->face_count;
    side *sides = calloc(count + 1, sizeof *sides);
    double length = 0;
    assert_non_null(sides);
    for (size_t i = 0; i < count; i++)
        sides[i] = (side){mesh->corners[i], mesh->corners[i % 3 == 2 ? i - 2 : i + 1]};
    qsort(sides, count, sizeof *sides, by_ends);
    for (size_t i = 0; i < count; i++) {
        side other = {sides[i].to, sides[i].from};
        if (!bsearch(&other, sides, count, sizeof other, by_ends))
            length += tn_norm(tn_sub(tn_vector_at(mesh->positions + 3 * (size_t)sides[i].from),
                                     tn_vector_at(mesh->positions + 3 * (size_t)sides[i].to)));
    }
    free(sides);
    return length;
}

/* A sheet with corners in its rim, and a pipe, both ended by the box. */
static void test_open(void **state)
{
    (void)state;
    static const char *const texts[] = {"surface s = z - 0.3*y grid 40", "surface s = x*x + y*y - 9 grid 40",
                                        "surface s = z - 0.2*sin(x) grid 40"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        tn_module *module = compile(texts[i]);
        tn_field field;
        tn_contour c;
        tn_error error;
        assert_int_equal(tn_field_read(module, 0, NULL, &field, &error), TN_OK);
        tn_field_grid grid = tn_field_grid_of(&field, 0);
        assert_int_equal(tn_contour_new(&field, &grid, &(tn_contour_options){.open = true}, &c, &error), TN_OK);
        double rim = rim_of(&c.mesh), area = measure(&c.mesh).area;
        if (decimate(&c.mesh, 200)) {
            assert_int_equal(count_turned(&field, &c.mesh, c.spacing / 8), 0);
            if (!near(rim_of(&c.mesh), rim, 0.02) || !near(measure(&c.mesh).area, area, 0.02))
                fail_msg("%s: the rim is %g of %g, the area %g of %g", texts[i], rim_of(&c.mesh), rim,
                         measure(&c.mesh).area, area);
        }
        tn_contour_clear(&c);
        tn_field_clear(&field);
        tn_module_free(module);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_closed), cmocka_unit_test(test_open)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
