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

static void write_lines(tn_job *job, const tn_probe *probe, const char *path, FILE *in)
{
    char line[1000];
    double place[3], gradient[3];
    tn_file_state before = tn_file_state_of(fileno(in));
    tn_error error;
    for (size_t number = 1; fgets(line, sizeof line, in); number++) {
        if (tn_interrupt_check(&error) != TN_OK) {
            tn_job_fail(job, &error);
            return;
        }
        if (line[strspn(line, " \t\r\n")] == '\0')
            continue;
        if (!read_place(line, place)) {
            if (tn_file_state_same(&before, fileno(in), path, &error) == TN_OK) {
                tn_fail(&error, TN_INVALID, E_EXPRESSION, "line %zu of %.200s is not three numbers", number, path);
                tn_error_help(&error, "write x, y and z with blanks between them");
            }
            tn_job_fail(job, &error);
            return;
        }
        double value = tn_probe_at(probe, place, gradient);
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

void tn_mesh_write_points(tn_job *job, const tn_mesh_request *request, const char *path)
{
    tn_probe probe;
    bool standard = strcmp(path, "-") == 0;
    if (tn_job_answered(job, tn_probe_open(&job->session, request, &probe))) {
        FILE *in = standard ? stdin : tn_file_stream(path);
        tn_error error;
        if (in) {
            write_lines(job, &probe, path, in);
        } else {
            tn_cannot_read(path, errno, &error);
            tn_job_fail(job, &error);
        }
        if (in && !standard)
            fclose(in);
    }
    tn_probe_close(&probe);
}
