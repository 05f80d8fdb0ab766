/* Turns the angles of a box's plane into its normal. */
#include "runtime/geometry/union/box_genes.h"

#include "runtime/numeric/numeric.h"

void tn_normal_of_angles(double a, double b, double normal[3])
{
    normal[0] = tn_cos_degrees(b) * tn_sin_degrees(a);
    normal[1] = tn_sin_degrees(b);
    normal[2] = tn_cos_degrees(b) * tn_cos_degrees(a);
}
