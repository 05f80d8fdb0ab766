/* What a build with one width of vectors gives: widths WIDTH FILE.tnb
 *
 * Prints a hash of each surface's mesh, and of each elementary function over rows of numbers. tests/CMakeLists.txt
 * builds it once for each width, whatever the processor is; tests/cli/widths.sh compares what they print. Exits with 77
 * where this processor lacks the width. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/file.h"
#include "runtime/base/random.h"
#include "runtime/field/contour.h"
#include "runtime/load.h"
#include "runtime/math/elementary.h"

enum { NUMBERS = 100000 };

static uint64_t hash(uint64_t so_far, const void *bytes, size_t size)
{
    const unsigned char *b = bytes;
    for (size_t i = 0; i < size; i++)
        so_far = (so_far ^ b[i]) * UINT64_C(0x100000001b3);
    return so_far;
}

static int fail(const char *message)
{
    fprintf(stderr, "widths: %s\n", message);
    return 1;
}

static bool has_width(const char *width)
{
#if defined(__x86_64__) && defined(__GNUC__)
    __builtin_cpu_init();
    if (strcmp(width, "avx2") == 0)
        return __builtin_cpu_supports("avx2");
    if (strcmp(width, "avx512f") == 0)
        return __builtin_cpu_supports("avx512f");
#endif
    return strcmp(width, "none") == 0;
}

static int print_meshes(const tn_module *module)
{
    for (uint32_t s = 0; s < module->SURFACE_count; s++) {
        tn_field field;
        tn_contour c;
        tn_error error;
        if (tn_field_read(module, s, NULL, &field, &error) != TN_OK)
            return fail(error.message);
        tn_field_grid grid = tn_field_grid_of(&field, 0);
        for (int sharp = 0; sharp < 2; sharp++) {
            if (tn_contour_new(&field, &grid, &(tn_contour_options){.threads = 2, .sharp = sharp}, &c, &error) != TN_OK)
                return fail(error.message);
            uint64_t h = hash(1, c.mesh.positions, 3 * c.mesh.vertex_count * sizeof *c.mesh.positions);
            h = hash(h, c.mesh.corners, 3 * c.mesh.face_count * sizeof *c.mesh.corners);
            printf("%s %zu %zu %llu %llu %llu %016llx\n", tn_text(module, module->SURFACE_records[s].name),
                   c.mesh.vertex_count, c.mesh.face_count, (unsigned long long)c.jumps, (unsigned long long)c.moved,
                   (unsigned long long)c.no_values, (unsigned long long)h);
            tn_contour_clear(&c);
        }
        tn_field_clear(&field);
    }
    return 0;
}

/* Any bits: all sizes, also those that are no number; and numbers of usual sizes. */
static void fill(double *numbers, uint64_t seed)
{
    for (uint64_t i = 0; i < NUMBERS; i++) {
        uint64_t bits = tn_random64(seed, 1, i);
        if (i % 2)
            numbers[i] = ((double)(bits >> 11) * 0x1p-53 - 0.5) * 200;
        else
            memcpy(&numbers[i], &bits, sizeof bits);
    }
}

static int print_functions(void)
{
    static const struct {
        const char *name;
        void (*row)(const double *, double *, size_t);
    } one[] = {
        {"sin", tn_sin_row}, {"cos", tn_cos_row}, {"exp", tn_exp_row}, {"log", tn_log_row}, {"tanh", tn_tanh_row}};
    static const struct {
        const char *name;
        void (*row)(const double *, const double *, double *, size_t);
    } two[] = {{"pow", tn_pow_row}, {"atan2", tn_atan2_row}};
    double *a = malloc(3 * NUMBERS * sizeof *a);
    if (!a)
        return fail("out of memory");
    double *b = a + NUMBERS, *out = b + NUMBERS;
    fill(a, 1);
    fill(b, 2);
    for (size_t i = 0; i < sizeof one / sizeof *one; i++) {
        one[i].row(a, out, NUMBERS);
        for (size_t k = 0; k < NUMBERS; k++)
            out[k] = out[k] == out[k] ? out[k] : 0; /* which of the many NaNs it is means nothing */
        printf("%s %016llx\n", one[i].name, (unsigned long long)hash(1, out, NUMBERS * sizeof *out));
    }
    for (size_t i = 0; i < sizeof two / sizeof *two; i++) {
        two[i].row(a, b, out, NUMBERS);
        for (size_t k = 0; k < NUMBERS; k++)
            out[k] = out[k] == out[k] ? out[k] : 0;
        printf("%s %016llx\n", two[i].name, (unsigned long long)hash(1, out, NUMBERS * sizeof *out));
    }
    free(a);
    return 0;
}

int main(int argc, char **argv)
{
    uint8_t *bytes;
    size_t size;
    tn_module *module;
    tn_error error;
    if (argc != 3)
        return fail("usage: widths WIDTH FILE.tnb");
    if (!has_width(argv[1]))
        return 77;
    if (tn_file_read(argv[2], tn_module_limits_default().bytes, &bytes, &size, &error) != TN_OK ||
        tn_module_load(bytes, size, NULL, &module, &error) != TN_OK)
        return fail(error.message);
    free(bytes);
    int status = print_meshes(module);
    tn_module_free(module);
    return status ? status : print_functions();
}
