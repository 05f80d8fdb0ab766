/* tartan-mpi: commands that many processes do together, started by mpirun. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/job.h"
#include "cli/common/program.h"
#include "mpi/ranks.h"

static const char usage[] =
    "tartan-mpi: commands of tartan that many processes do together\n\n"
    "Usage:\n"
    "  mpirun -n N tartan-mpi shards run SET [options]\n"
    "  mpirun -n N tartan-mpi evolve STUDY.study [options]\n"
    "  tartan-mpi --help\n"
    "  tartan-mpi --version\n\n"
    "Options are those of `tartan shards run` and `tartan evolve`: `tartan help shards` lists them.\n"
    "--threads is the number of threads of each process, and 1 where it is not given.\n"
    "The results have the same bytes as those of tartan, with any number of processes.\n";

/* The command that the words name, where it is one of ours. */
static const tn_command *find_command(int count, char **words, tn_error *error)
{
    bool shards = strcmp(words[0], "shards") == 0, runs = count > 1 && strcmp(words[1], "run") == 0;
    if (strcmp(words[0], "evolve") == 0 || (shards && runs))
        return tn_command_find(words[0]);
    tn_fail(error, TN_INVALID, E_USAGE, "tartan-mpi does not know `%.60s%s%.60s`", words[0],
            shards && count > 1 ? " " : "", shards && count > 1 ? words[1] : "");
    tn_error_help(error, tn_command_find(words[0]) ? "it does `shards run` and `evolve`; `tartan` does the rest"
                                                   : "it does `shards run` and `evolve`");
    return NULL;
}

/* Do all ranks run the same program, with the same words? */
static tn_status same_program(const tn_ranks *ranks, int count, char **words, tn_error *error)
{
    char *line = NULL;
    size_t size;
    FILE *out = open_memstream(&line, &size);
    for (int i = 0; out && i < count; i++)
        fprintf(out, "%s%s", i ? " " : "", words[i]);
    if (out)
        fclose(out);
    tn_status status = tn_ranks_agree(ranks, line ? TN_OK : tn_fail_memory(error), error);
    if (status == TN_OK)
        status = tn_ranks_same(ranks, "the version of Tartan", TARTAN_VERSION, error);
    if (status == TN_OK)
        status = tn_ranks_same(ranks, "the command", line, error);
    free(line);
    return status;
}

static int run(const tn_ranks *ranks, int count, char **words)
{
    const tn_settings settings = {.diagnostics = tn_options_diagnostics(count, words), .ranks = ranks};
    tn_error error;
    const tn_command *command = NULL;
    if (same_program(ranks, count, words, &error) == TN_OK)
        command = find_command(count, words, &error);
    return command ? tn_program_run(command, count - 1, words + 1, ranks) : tn_program_refuse(&settings, &error);
}

int main(int argc, char **argv)
{
    tn_program_begin();
    if (argc < 2) {
        fputs(usage, stderr);
        return TN_EXIT_USAGE;
    }
    bool help = strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "help") == 0;
    if (help || strcmp(argv[1], "--version") == 0) {
        fputs(help ? usage : "tartan-mpi " TARTAN_VERSION "\n", stdout);
        return tn_program_printed();
    }
    const tn_ranks *ranks = tn_mpi_join();
    int exit_code = ranks ? run(ranks, argc - 1, argv + 1) : TN_EXIT_INTERNAL;
    tn_mpi_leave(ranks);
    return exit_code;
}
