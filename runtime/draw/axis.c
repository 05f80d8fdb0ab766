/* Chooses and writes the marks of an axis. */
#include "runtime/draw/axis.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

double tn_axis_step(double range, double marks)
{
    double step = 1;
    while (step * marks < range)
        step *= 10;
    while (step / 10 * marks >= range && step > 1e-12)
        step /= 10;
    if (step / 5 * marks >= range)
        return step / 5;
    return step / 2 * marks >= range ? step / 2 : step;
}

/* How many digits after the point a multiple of the step has. */
static int decimals_of(double step)
{
    int decimals = 0;
    for (; decimals < 12 && fabs(step - floor(step + 0.5)) > 1e-6 * step; decimals++)
        step *= 10;
    return decimals;
}

void tn_axis_write(double value, double step, char *text, size_t size)
{
    char plain[400];
    int decimals = decimals_of(step);
    snprintf(plain, sizeof plain, "%.*f", decimals, fabs(value) < step / 2 ? 0 : value);
    size_t whole = strcspn(plain, "."), sign = plain[0] == '-', at = 0;
    for (size_t i = 0; plain[i] && at + 2 < size; i++) {
        if (i > sign && i < whole && (whole - i) % 3 == 0)
            text[at++] = ',';
        text[at++] = plain[i];
    }
    text[at] = '\0';
}
