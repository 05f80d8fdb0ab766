/* Makes boxes of their genes. */
#include "runtime/solid/genes.h"

#include <math.h>

void tn_box_of_genes(const double genes[TN_BOX_GENES], uint32_t flags, double depth, tn_solid_box *box)
{
    bool flat = flags & TN_SOLID_FLAT;
    *box = (tn_solid_box){.distance = genes[6], .clipped = !(flags & TN_SOLID_NOCLIP)};
    for (int k = 0; k < 3; k++) {
        double centre = nearbyint(genes[k] * TN_GENE_STEPS), half = nearbyint(fabs(genes[3 + k]) * TN_GENE_STEPS / 2);
        box->low[k] = (centre - half) / TN_GENE_STEPS; /* one rounding: numerator and steps are whole */
        box->high[k] = (centre + half) / TN_GENE_STEPS;
    }
    if (flat) {
        box->low[2] = -depth / 2;
        box->high[2] = depth / 2;
    }
    for (int k = 0; k < 3; k++)
        box->void_ |= !(box->high[k] > box->low[k]);
    tn_normal_of_angles(flat ? 90 : genes[7], genes[8], box->normal);
}
