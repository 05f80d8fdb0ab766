/* Evaluates a field at the places that the lines of a file name. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/mesh/mesh.h"
#include "runtime/base/bytes.h"
#include "runtime/base/file.h"
#include "runtime/base/file_error.h"

/* Three numbers and nothing else. The program's locale is C's. */
static bool read_place(const char *line, double place[3])
{
    for (int axis = 0; axis < 3; axis++) {
        char *end;
        line += strspn(line, " \t,");
        place[axis] = strtod(line, &end);
        if (end == line)
            return false;
        line = end;
    }
    return line[strspn(line, " \t\r\n")] == '\0';
}

static void write_lines(tn_job *job, const tn_open_field *open, FILE *in, double *registers)
{
    char line[1000];
    double place[3], gradient[3];
    const tn_field *field = &open->field;
    const char *path = tn_mesh_settings_of(job)->points;
    tn_file_state before = tn_file_state_of(fileno(in));
    tn_error error;
    for (unsigned long number = 1; fgets(line, sizeof line, in); number++) {
        if (tn_interrupt_check(&error) != TN_OK) {
            tn_job_fail(job, &error);
            return;
        }
        if (line[strspn(line, " \t\r\n")] == '\0')
            continue;
        if (!read_place(line, place)) {
            if (tn_file_state_same(&before, fileno(in), path, &error) == TN_OK) {
                tn_fail(&error, TN_INVALID, E_EXPRESSION, "line %lu of %.200s is not three numbers", number, path);
                tn_error_help(&error, "write x, y and z with blanks between them");
            }
            tn_job_fail(job, &error);
            return;
        }
        double value = tn_tape_gradient(&field->samples, place, &field->distances, registers, gradient);
        printf("%.17g %.17g %.17g %.17g %s\n", tn_without_sign(value), tn_without_sign(gradient[0]),
               tn_without_sign(gradient[1]), tn_without_sign(gradient[2]), value < 0 ? "inside" : "outside");
    }
    if (ferror(in)) {
        tn_cannot_read(path, errno, &error);
        tn_job_fail(job, &error);
    } else if (tn_file_state_same(&before, fileno(in), path, &error) != TN_OK) {
        tn_job_fail(job, &error);
    }
}

void tn_mesh_points(tn_job *job, const tn_open_field *open)
{
    const char *path = tn_mesh_settings_of(job)->points;
    bool standard = strcmp(path, "-") == 0;
    FILE *in = standard ? stdin : tn_file_stream(path);
    double *registers = calloc((size_t)open->field.samples.register_count * 4, sizeof *registers);
    tn_error error;
    if (!in) {
        tn_cannot_read(path, errno, &error);
        tn_job_fail(job, &error);
    } else if (!registers) {
        tn_fail_memory(&error);
        tn_job_fail(job, &error);
    } else {
        write_lines(job, open, in, registers);
    }
    if (in && !standard)
        fclose(in);
    free(registers);
}
