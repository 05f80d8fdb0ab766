/* Boxes as a study's settings write them. */
#ifndef TARTAN_DRIVER_BREED_BOX_TEXT_H
#define TARTAN_DRIVER_BREED_BOX_TEXT_H

#include <stdbool.h>

/* Reads "(-7, -7, -7)..(7, 7, 7)": the low corner and the high one, each coordinate larger. */
bool tn_study_box(const char *text, double low[3], double high[3]);

#endif
