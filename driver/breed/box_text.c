/* Reads boxes that are written as text. */
#include "driver/breed/box_text.h"

#include <math.h>
#include <stdio.h>

#include "runtime/module/values.h"

bool tn_study_box(const char *text, double low[3], double high[3])
{
    int end = 0;
    int read = sscanf(text, " ( %lf , %lf , %lf ) .. ( %lf , %lf , %lf ) %n", &low[0], &low[1], &low[2], &high[0],
                      &high[1], &high[2], &end);
    bool well = read == 6 && end && !text[end];
    for (int k = 0; k < 3 && well; k++)
        well = fabs(low[k]) <= TN_COORDINATE_MAX && fabs(high[k]) <= TN_COORDINATE_MAX && low[k] < high[k];
    return well;
}
