/* The table of cells: each mask by itself, all pairs of neighbours, and cells with vertices anywhere on their edges, of
 * which no triangles cross. */
#include "runtime/field/contour_table.h"
#include "runtime/geometry/crossing.h"
#include "tests/unit/field/support.h"

static unsigned mask_of_edges(unsigned mask)
{
    unsigned edges = 0;
    for (unsigned e = 0; e < 12; e++)
        if ((mask >> tn_contour_edges[e][0] & 1) != (mask >> tn_contour_edges[e][1] & 1))
            edges |= 1u << e;
    return edges;
}

/* Do the two edges of the cell lie in one face? */
static bool share_face(unsigned a, unsigned b)
{
    for (unsigned axis = 0; axis < 3; axis++)
        for (unsigned high = 0; high < 2; high++) {
            bool all = true;
            for (int k = 0; k < 2; k++)
                all =
                    all && (tn_contour_edges[a][k] >> axis & 1) == high && (tn_contour_edges[b][k] >> axis & 1) == high;
            if (all)
                return true;
        }
    return false;
}

/* A side of a triangle that another triangle of the cell shares runs through the cell, not in a face; the others lie in
 * faces, where the neighbour has them the other way round (test_meshes). Every crossing edge is used. */
static void test_table(void **state)
{
    (void)state;
    for (unsigned mask = 0; mask < 256; mask++) {
        const uint8_t *row = tn_contour_table[mask];
        int seen[12][12] = {{0}};
        unsigned used = 0;
        for (unsigned t = 0; t < row[0]; t++)
            for (unsigned k = 0; k < 3; k++) {
                unsigned a = row[1 + 3 * t + k], b = row[1 + 3 * t + (k + 1) % 3];
                seen[a][b]++;
                used |= 1u << a;
            }
        assert_int_equal(used, mask_of_edges(mask));
        for (unsigned a = 0; a < 12; a++)
            for (unsigned b = 0; b < 12; b++) {
                assert_true(seen[a][b] <= 1);
                if (seen[a][b])
                    assert_true(seen[b][a] != (int)share_face(a, b));
            }
    }
}

/* The sides of a mask's triangles that lie in a face and no other triangle shares, as the cell's edges: [from][to]. */
static void sides_in_face(unsigned mask, unsigned axis, unsigned high, bool sides[12][12])
{
    const uint8_t *row = tn_contour_table[mask];
    memset(sides, 0, 12 * sizeof *sides);
    for (unsigned t = 0; t < row[0]; t++)
        for (unsigned k = 0; k < 3; k++) {
            unsigned a = row[1 + 3 * t + k], b = row[1 + 3 * t + (k + 1) % 3], both[4];
            memcpy(both,
                   (unsigned[4]){tn_contour_edges[a][0], tn_contour_edges[a][1], tn_contour_edges[b][0],
                                 tn_contour_edges[b][1]},
                   sizeof both);
            bool in = true;
            for (int i = 0; i < 4; i++)
                in = in && (both[i] >> axis & 1) == high;
            sides[a][b] = in;
        }
}

/* The edge of the cell at the same place of the other face across the axis. */
static unsigned across(unsigned edge, unsigned axis)
{
    unsigned a = tn_contour_edges[edge][0] ^ 1u << axis, b = tn_contour_edges[edge][1] ^ 1u << axis;
    for (unsigned e = 0; e < 12; e++)
        if ((tn_contour_edges[e][0] == a && tn_contour_edges[e][1] == b) ||
            (tn_contour_edges[e][0] == b && tn_contour_edges[e][1] == a))
            return e;
    fail_msg("edge %u has none across", edge);
    return 0;
}

/* Do two cells side by side along the axis agree on the corners that they share? */
static bool are_neighbours(unsigned first, unsigned second, unsigned axis)
{
    for (unsigned corner = 0; corner < 8; corner++)
        if (!(corner >> axis & 1) && (first >> (corner | 1u << axis) & 1) != (second >> corner & 1))
            return false;
    return true;
}

/* Where two cells meet, each side of the one's triangles is a side of the other's, the other way round. */
static void test_neighbours(void **state)
{
    (void)state;
    unsigned pairs = 0;
    for (unsigned axis = 0; axis < 3; axis++)
        for (unsigned first = 0; first < 256; first++)
            for (unsigned second = 0; second < 256; second++) {
                bool here[12][12], there[12][12];
                if (!are_neighbours(first, second, axis))
                    continue;
                pairs++;
                sides_in_face(first, axis, 1, here);
                sides_in_face(second, axis, 0, there);
                for (unsigned a = 0; a < 12; a++)
                    for (unsigned b = 0; b < 12; b++)
                        if (here[a][b])
                            assert_true(there[across(b, axis)][across(a, axis)]);
                        else if (there[a][b])
                            assert_true(here[across(b, axis)][across(a, axis)]);
            }
    assert_int_equal(pairs, 3 * 16 * 16 * 16);
}

/* Vertices anywhere on their edges, also as near to the corners as they get. */
static void place_vertices(dice *d, double positions[36])
{
    for (unsigned e = 0; e < 12; e++) {
        unsigned low = tn_contour_edges[e][0], along = low ^ tn_contour_edges[e][1];
        double t = between(d, 1 / 4096.0, 4095 / 4096.0);
        unsigned kind = roll(d, 4);
        t = kind == 0 ? 1 / 4096.0 : kind == 1 ? 4095 / 4096.0 : t;
        for (unsigned axis = 0; axis < 3; axis++)
            positions[3 * e + axis] = along >> axis & 1 ? t : low >> axis & 1;
    }
}

static void test_crossing(void **state)
{
    (void)state;
    dice d = {0};
    double positions[36];
    uint32_t corners[3 * TN_CELL_TRIANGLES];
    tn_mesh mesh = {.vertex_count = 12, .positions = positions, .corners = corners};
    for (unsigned mask = 0; mask < 256; mask++)
        for (unsigned trial = 0; trial < 400; trial++) {
            uint64_t crossings;
            tn_error error;
            place_vertices(&d, positions);
            mesh.face_count = tn_contour_table[mask][0];
            for (size_t i = 0; i < 3 * mesh.face_count; i++)
                corners[i] = tn_contour_table[mask][1 + i];
            assert_int_equal(tn_mesh_crossings(&mesh, &crossings, &error), TN_OK);
            if (crossings)
                fail_msg("mask %u, trial %u: triangles cross", mask, trial);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table),
        cmocka_unit_test(test_neighbours),
        cmocka_unit_test(test_crossing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
