/* Finds the normals of a field's mesh by differentiation. */
#include "runtime/field/normals.h"

#include <math.h>
#include <stdlib.h>

#define LEAST 1e-9      /* of the median: there the gradient is rounding (docs/field-language.md) */
#define ON_SURFACE 0.01 /* of the spacing: how far from the surface a vertex may be */

static int compare(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

/* sizes: of the gradients; those that are no number count as 0. They are sorted. */
static double median_of(double *sizes, size_t count)
{
    qsort(sizes, count, sizeof *sizes, compare);
    return count ? sizes[count / 2] : 0;
}

double tn_field_slope(const tn_field *field, const double *vertex, double spacing, double *registers,
                      double gradient[3])
{
    double value = tn_tape_gradient(&field->samples, vertex, &field->distances, registers, gradient);
    double size = sqrt(gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2]);
    return size > 0 && size < INFINITY && fabs(value) <= ON_SURFACE * spacing * size ? size : 0;
}

tn_status tn_field_normals(const tn_field *field, const tn_mesh *mesh, double spacing, double **normals,
                           tn_error *error)
{
    size_t count = mesh->vertex_count;
    tn_status status = tn_mesh_normals(mesh, normals, error);
    if (status != TN_OK)
        return status;
    double *registers = calloc(4 * (size_t)field->samples.register_count, sizeof *registers);
    double *sizes = malloc((count + 1) * sizeof *sizes), *sorted = malloc((count + 1) * sizeof *sorted);
    double(*gradients)[3] = malloc((count + 1) * sizeof *gradients);
    bool room = registers && sizes && sorted && gradients;
    for (size_t v = 0; room && v < count; v++)
        sizes[v] = sorted[v] = tn_field_slope(field, mesh->positions + 3 * v, spacing, registers, gradients[v]);
    double least = room ? LEAST * median_of(sorted, count) : 0;
    for (size_t v = 0; room && v < count; v++)
        for (int axis = 0; axis < 3 && sizes[v] > least; axis++)
            (*normals)[3 * v + (size_t)axis] = gradients[v][axis] / sizes[v];
    free(registers);
    free(sizes);
    free(sorted);
    free(gradients);
    if (room)
        return TN_OK;
    free(*normals);
    *normals = NULL;
    return tn_fail_memory(error);
}
