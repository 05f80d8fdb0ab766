/* Places a rule file through the C interface, as a program outside would: place_interface STDLIB SEED MODEL FILE [LIMIT]
 * Prints the LDraw file, then the list of parts; where that fails, the number of the diagnostic, and ends with 1. MODEL may be
 * empty; LIMIT is that of a search. tests/cli/place_interface.sh holds this to what the command writes. */
#include "include/tartan/tartan.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static tartan_status compile(const char *path, const char *stdlib, tartan_module **module, tartan_error *error)
{
    const char *folders[] = {stdlib};
    tartan_compile_options options = tartan_compile_options_init();
    options.folders = folders;
    options.folder_count = 1;
    return tartan_compile_file(path, &options, module, error);
}

/* The parts that a caller sees are those that the text has, one line each. */
static bool parts_are_written(const tartan_placement *placement, const char *text)
{
    size_t count, lines = 0;
    tartan_placement_parts(placement, &count);
    for (const char *c = text; *c; c++)
        lines += *c == '1' && (c == text || c[-1] == '\n');
    return lines == count;
}

static tartan_status print(const tartan_placement *placement, tartan_error *error)
{
    char *model = NULL, *list = NULL;
    size_t size;
    tartan_status status = tartan_placement_ldraw(placement, &model, &size, error);
    if (status == TARTAN_OK)
        status = tartan_placement_list(placement, &list, &size, error);
    if (status == TARTAN_OK && !parts_are_written(placement, model)) {
        fputs("place_interface: the LDraw file has other parts than tartan_placement_parts\n", stderr);
        status = TARTAN_INTERNAL;
    }
    if (status == TARTAN_OK)
        printf("%s%s", model, list);
    tartan_text_free(model);
    tartan_text_free(list);
    return status;
}

int main(int argc, char **argv)
{
    tartan_error error = {0};
    tartan_module *module = NULL;
    tartan_placement *placement = NULL;
    if (argc != 5 && argc != 6) {
        fputs("usage: place_interface STDLIB SEED MODEL FILE [LIMIT]\n", stderr);
        return 2;
    }
    tartan_place_options options = tartan_place_options_init();
    options.seed = (uint32_t)strtoul(argv[2], NULL, 10);
    options.model = argv[3][0] ? argv[3] : NULL;
    options.search_limit = argc == 6 ? strtoull(argv[5], NULL, 10) : 0;
    tartan_status status = compile(argv[4], argv[1], &module, &error);
    if (status == TARTAN_OK)
        status = tartan_place(module, &options, NULL, &placement, &error);
    tartan_error ignored = {0};
    if (placement)
        status = print(placement, &ignored) == TARTAN_OK ? status : TARTAN_INTERNAL;
    if (status != TARTAN_OK)
        printf("E%04" PRIu32 "\n", error.code);
    tartan_placement_free(placement);
    tartan_module_free(module);
    return status == TARTAN_OK ? 0 : 1;
}
