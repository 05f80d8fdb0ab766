/* What texts of a study's settings mean: files beside it, and boxes. */
#ifndef TARTAN_DRIVER_BREED_BESIDE_H
#define TARTAN_DRIVER_BREED_BESIDE_H

#include <stdbool.h>

/* A path that a study names lies relative to the study. The caller frees it; NULL where out of memory. */
char *tn_study_beside(const char *study, const char *path);

/* Reads "(-7, -7, -7)..(7, 7, 7)": the low corner and the high one, each coordinate larger. */
bool tn_study_box(const char *text, double low[3], double high[3]);

#endif
