/* Boxes as lists of nine genes: centre, size, and the plane that clips it by its distance from the centre and two
 * angles in degrees (Bentley, 4.2.5). */
#ifndef TARTAN_GEOMETRY_UNION_BOX_GENES_H
#define TARTAN_GEOMETRY_UNION_BOX_GENES_H

#define TN_BOX_GENES 9u

/* Centres of bred boxes are whole numbers of these parts of a unit, and sizes even ones: then faces are whole numbers
 * of them too, and the text of a design has the same faces, to the last bit. */
#define TN_GENE_STEPS 1000.0

/* The unit normal at these angles: (cos b sin a, sin b, cos b cos a). */
void tn_normal_of_angles(double a, double b, double normal[3]);

#endif
