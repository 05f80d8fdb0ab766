/* What more processors could gain for fields, computed: field_parts FILE.tnb SAMPLES PROCESSORS RUNS
 *
 * Meshes each surface of the module in one thread, and measures every piece of work that a crew would share. Then it
 * deals the pieces out as a crew does: each to the processor that is free first, a phase after the other. So it prints
 * name, seconds of one thread, seconds outside the phases, and seconds of that many processors, medians of RUNS. Not in
 * the last number: waking threads, and what memory they share. */
#include "bench/field_mesh.h"
#include "runtime/base/crew.h"

enum { RUNS_MAX = 101, PROCESSORS_MAX = 64 };

/* Of one mesh, added up over its phases. */
typedef struct phases {
    unsigned processors;
    double work, longest; /* seconds of all pieces, and of the processor that has the most in each phase */
} phases;

static phases now;

/* The linker puts this in the place of tn_crew_run. */
tn_status __wrap_tn_crew_run(tn_crew *crew, size_t count, size_t chunk, tn_crew_work *work, void *context,
                             tn_error *error);

tn_status __wrap_tn_crew_run(tn_crew *crew, size_t count, size_t chunk, tn_crew_work *work, void *context,
                             tn_error *error)
{
    double busy[PROCESSORS_MAX] = {0}, longest = 0;
    (void)crew;
    for (size_t begin = 0; begin < count; begin += chunk) {
        unsigned first_free = 0;
        double begun = seconds(CLOCK_THREAD_CPUTIME_ID);
        for (size_t item = begin; item < count && item < begin + chunk; item++) {
            tn_status status = work(context, 0, item, error);
            if (status != TN_OK)
                return status;
        }
        double took = seconds(CLOCK_THREAD_CPUTIME_ID) - begun;
        for (unsigned p = 1; p < now.processors; p++)
            first_free = busy[p] < busy[first_free] ? p : first_free;
        busy[first_free] += took;
        longest = busy[first_free] > longest ? busy[first_free] : longest;
        now.work += took;
    }
    now.longest += longest;
    return TN_OK;
}

int main(int argc, char **argv)
{
    if (argc != 5)
        stop("usage: field_parts FILE.tnb SAMPLES PROCESSORS RUNS");
    tn_module *module = load_module(argv[1]);
    uint32_t samples = (uint32_t)atoi(argv[2]);
    unsigned processors = (unsigned)atoi(argv[3]);
    int runs = atoi(argv[4]) < RUNS_MAX ? atoi(argv[4]) : RUNS_MAX;
    if (runs < 1 || samples < 2 || processors < 1 || processors > PROCESSORS_MAX)
        stop("give a grid, processors and how many runs");
    for (uint32_t s = 0; s < module->SURFACE_count; s++) {
        double one[RUNS_MAX], serial[RUNS_MAX], several[RUNS_MAX];
        size_t faces;
        for (int i = 0; i < runs; i++) {
            now = (phases){.processors = processors};
            one[i] = mesh_once(module, s, samples, processors, CLOCK_THREAD_CPUTIME_ID, &faces);
            serial[i] = one[i] - now.work;
            several[i] = serial[i] + now.longest;
        }
        printf("%s %.6f %.6f %.6f\n", tn_text(module, module->SURFACE_records[s].name), median(one, runs),
               median(serial, runs), median(several, runs));
    }
    tn_module_free(module);
    return 0;
}
