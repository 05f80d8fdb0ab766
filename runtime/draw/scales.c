/* Knows the sizes of paper and the usual scales of drawings, and chooses and writes the marks of an axis. */
#include "runtime/draw/scales.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* ---- knows the sizes of paper and the usual scales */

#define MM(X) ((X)*72.0 / 25.4)
#define INCH(X) ((X)*72.0)

/* ISO 216, and the US architectural sizes of ASME Y14.1; those that are chosen by themselves stand together, ascending.
 */
static const tn_paper papers[] = {
    {"a3", MM(420), MM(297)},       {"a2", MM(594), MM(420)},        {"a1", MM(841), MM(594)},
    {"arch-b", INCH(18), INCH(12)}, {"arch-c", INCH(24), INCH(18)},  {"arch-d", INCH(36), INCH(24)},
    {"a4", MM(297), MM(210)},       {"a0", MM(1189), MM(841)},       {"arch-a", INCH(12), INCH(9)},
    {"arch-e", INCH(48), INCH(36)}, {"letter", INCH(11), INCH(8.5)}, {"tabloid", INCH(17), INCH(11)},
};
enum { PAPER_COUNT = sizeof papers / sizeof *papers, CHOICES = 3 };

static const uint32_t metric_scales[] = {1, 2, 5, 10, 20, 50, 100, 200, 250, 500, 1000};

/* Inches on paper for a foot: a scale of 1:n is 12/n inches, written as a fraction. */
static const uint32_t foot_scales[] = {1, 2, 4, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 384};
static const char *const foot_names[] = {"12\"",  "6\"",   "3\"",    "1 1/2\"", "1\"",    "3/4\"",  "1/2\"",
                                         "3/8\"", "1/4\"", "3/16\"", "1/8\"",   "3/32\"", "1/16\"", "1/32\""};

tn_status tn_paper_find(const char *name, const tn_paper **paper, tn_error *error)
{
    for (size_t i = 0; i < PAPER_COUNT; i++) {
        if (strcasecmp(papers[i].name, name) == 0) {
            *paper = &papers[i];
            return TN_OK;
        }
    }
    tn_status status = tn_fail(error, TN_INVALID, E_USAGE, "there is no paper called `%.60s`", name);
    tn_error_help(error, "choose a0 to a4, arch-a to arch-e, letter or tabloid");
    return status;
}

size_t tn_paper_choices(bool metric, const tn_paper **choices)
{
    *choices = metric ? papers : papers + CHOICES;
    return CHOICES;
}

size_t tn_scale_choices(bool metric, const uint32_t **denominators)
{
    *denominators = metric ? metric_scales : foot_scales;
    return metric ? sizeof metric_scales / sizeof *metric_scales : sizeof foot_scales / sizeof *foot_scales;
}

void tn_scale_write(uint32_t denominator, bool metric, char *text, size_t size)
{
    for (size_t i = 0; !metric && i < sizeof foot_scales / sizeof *foot_scales; i++) {
        if (foot_scales[i] == denominator) {
            snprintf(text, size, "%s = 1'-0\"", foot_names[i]);
            return;
        }
    }
    snprintf(text, size, "1:%u", denominator);
}

/* ---- chooses and writes the marks of an axis */

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
