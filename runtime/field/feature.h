/* Where a sharp edge or corner of a form runs through a loop of vertices: the point nearest to their tangent planes.
 * Source: Kobbelt, Botsch, Schwanecke, Seidel, "Feature Sensitive Surface Extraction from Volume Data", 2001. */
#ifndef TARTAN_FIELD_FEATURE_H
#define TARTAN_FIELD_FEATURE_H

#include <stdbool.h>
#include <stdint.h>

/* Do two of the unit normals differ by more than 30 degrees? False where one of them is zero: there none is known. */
bool tn_feature_is_sharp(const double (*normals)[3], uint32_t count);

/* The point of the box nearest to the planes through these places; along directions that the planes say little about
 * (singular values below 0.1 of the largest) it stays at the places' mean. count: 1 or more. */
void tn_feature_point(const double (*places)[3], const double (*normals)[3], uint32_t count, const double low[3],
                      const double high[3], double point[3]);

#endif
