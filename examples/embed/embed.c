/* A program of its own that uses Tartan: compiles rules, says which of them match the plans of a list, and asks a
 * library for plans.
 *
 *   cc embed.c $(pkg-config --cflags --libs tartan) -o embed
 *   ./embed narrow.plan $(pkg-config --variable=stdlibdir tartan) <plans.txt
 */
#include <stdio.h>
#include <string.h>

#include <tartan/tartan.h>

enum { TRAYS_MAX = 64 };

static void show(void *context, const tartan_diagnostic *d)
{
    static const char *const severities[] = {"note", "warning", "error"};
    fprintf(context, "%s:%zu:%zu: %s: %s\n", d->path ? d->path : "?", d->line, d->column, severities[d->severity],
            d->message);
    if (d->help)
        fprintf(context, "    help: %s\n", d->help);
}

/* Says which rules match each plan line of the standard input. */
static tartan_status match_lines(const tartan_module *module, tartan_error *error)
{
    tartan_rules *rules = NULL;
    tartan_matcher *matcher = NULL;
    tartan_status status = tartan_rules_new(module, NULL, 0, NULL, &rules, error);
    if (status == TARTAN_OK)
        status = tartan_matcher_new(rules, &matcher, error);
    char line[4096];
    while (status == TARTAN_OK && fgets(line, sizeof line, stdin)) {
        uint32_t trays[TRAYS_MAX];
        uint64_t bits[16] = {0}; /* room for 1,024 rules */
        size_t length, size = strcspn(line, "\n");
        status = tartan_plan_read(tartan_rules_schema(rules), line, size, trays, TRAYS_MAX, &length, error);
        if (status == TARTAN_OK && tartan_rules_words(rules) <= 16)
            status = tartan_match(matcher, trays, length, bits, error);
        for (size_t i = 0; status == TARTAN_OK && i < tartan_rules_count(rules); i++)
            if (bits[i / 64] >> i % 64 & 1)
                printf("%s matches %.*s\n", tartan_rules_name(rules, i), (int)size, line);
    }
    tartan_matcher_free(matcher);
    tartan_rules_free(rules);
    return status;
}

/* Counts a library and draws three of its plans. */
static tartan_status sample(const tartan_module *module, tartan_error *error)
{
    tartan_library *library = NULL;
    tartan_plans *plans = NULL;
    char *count = NULL;
    tartan_status status = tartan_library_open(module, NULL, NULL, &library, error);
    if (status == TARTAN_OK)
        status = tartan_library_count(library, TARTAN_ANY_LENGTH, &count, error);
    if (status == TARTAN_OK)
        status = tartan_library_sample(library, 1, TARTAN_ANY_LENGTH, 3, &plans, error);
    if (status == TARTAN_OK)
        printf("%s plans, three of them:\n", count);
    const uint32_t *trays;
    size_t length;
    while (status == TARTAN_OK && tartan_plans_next(plans, &trays, &length)) {
        char *line;
        status = tartan_plan_write(tartan_library_schema(library), trays, length, &line, error);
        if (status == TARTAN_OK) {
            printf("  %s\n", line);
            tartan_text_free(line);
        }
    }
    tartan_text_free(count);
    tartan_plans_free(plans);
    tartan_library_free(library);
    return status;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: %s RULES.plan STDLIB <PLANS\n", argv[0]);
        return 2;
    }
    tartan_error error;
    tartan_module *module = NULL;
    const char *folders[] = {argv[2]};
    tartan_compile_options options = tartan_compile_options_init();
    options.report = show;
    options.report_context = stderr;
    options.folders = folders;
    options.folder_count = 1;
    tartan_status status = tartan_compile_file(argv[1], &options, &module, &error);
    if (status == TARTAN_OK)
        status = match_lines(module, &error);
    if (status == TARTAN_OK)
        status = sample(module, &error);
    if (status != TARTAN_OK)
        fprintf(stderr, "%s: %s\n", argv[0], error.message);
    tartan_module_free(module);
    return status != TARTAN_OK;
}
