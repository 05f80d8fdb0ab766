/* Houses in a program of its own: counts the cottages of the standard library, takes the one whose bedrooms are
 * largest, says what else it could be, and writes it as a building model, a mesh and a sheet of drawings.
 *
 *   cc houses.c $(pkg-config --cflags --libs tartan) -o houses
 *   ./houses cottages.plan $(pkg-config --variable=stdlibdir tartan) cottage
 */
#include <stdio.h>

#include <tartan/tartan.h>

static tartan_status compile(const char *path, const char *stdlib, tartan_module **module, tartan_error *error)
{
    const char *folders[] = {stdlib};
    tartan_compile_options options = tartan_compile_options_init();
    options.folders = folders;
    options.folder_count = 1;
    return tartan_compile_file(path, &options, module, error);
}

static tartan_status count(tartan_house_library *library, tartan_error *error)
{
    char *text = NULL;
    tartan_status status = tartan_house_library_count(library, TARTAN_ANY_LENGTH, NULL, &text, error);
    if (status == TARTAN_OK)
        printf("%s houses\n", text);
    tartan_text_free(text);
    return status;
}

/* Each change of one choice, with the number of the house that it makes. */
static tartan_status vary(const tartan_house *house, tartan_error *error)
{
    tartan_houses *others = NULL;
    tartan_status status = tartan_house_variants(house, NULL, NULL, &others, error);
    for (size_t i = 0; status == TARTAN_OK && i < tartan_houses_count(others); i++) {
        const tartan_house_change *change = tartan_houses_change(others, i);
        char *number = NULL;
        status = tartan_house_number(tartan_houses_house(others, i), NULL, &number, error);
        if (status == TARTAN_OK)
            printf("  %s: %s instead of %s is house %s\n", change->where, change->to, change->from, number);
        tartan_text_free(number);
    }
    tartan_houses_free(others);
    return status;
}

/* NAME.ifc, NAME.glb and NAME.svg */
static tartan_status write(const tartan_house *house, const char *name, tartan_error *error)
{
    static const struct {
        tartan_house_format format;
        const char *ending;
    } files[] = {{TARTAN_HOUSE_IFC, "ifc"}, {TARTAN_HOUSE_GLB, "glb"}, {TARTAN_HOUSE_SVG, "svg"}};
    tartan_house_drawing drawing = tartan_house_drawing_init();
    drawing.title = "A cottage";
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char path[512];
        void *bytes = NULL;
        size_t size = 0;
        tartan_status status = tartan_house_file(house, files[i].format, &drawing, NULL, &bytes, &size, error);
        if (status != TARTAN_OK)
            return status;
        snprintf(path, sizeof path, "%s.%s", name, files[i].ending);
        FILE *out = fopen(path, "wb");
        int ok = out && fwrite(bytes, 1, size, out) == size;
        ok = out && fclose(out) == 0 && ok;
        tartan_bytes_free(bytes);
        if (!ok) {
            snprintf(error->message, sizeof error->message, "%.300s cannot be written", path);
            return TARTAN_IO;
        }
    }
    return TARTAN_OK;
}

static tartan_status show_best(tartan_house_library *library, const char *name, tartan_error *error)
{
    const tartan_wish wish = {"beds", true};
    tartan_houses *houses = NULL;
    char *line = NULL;
    tartan_status status = tartan_house_best(library, NULL, &wish, 1, 1, NULL, &houses, error);
    if (status == TARTAN_OK && tartan_houses_count(houses) > 0) {
        const tartan_house *house = tartan_houses_house(houses, 0);
        status = tartan_house_write(house, &line, error);
        if (status == TARTAN_OK)
            printf("largest bedrooms, %s %s:\n%s\n", tartan_houses_value(houses, 0, 0),
                   tartan_house_library_unit(library, "beds"), line);
        if (status == TARTAN_OK)
            status = vary(house, error);
        if (status == TARTAN_OK)
            status = write(house, name, error);
    }
    tartan_text_free(line);
    tartan_houses_free(houses);
    return status;
}

int main(int argc, char **argv)
{
    tartan_error error = {.message = "usage: houses FILE.plan STDLIB NAME"};
    tartan_module *module = NULL;
    tartan_house_library *library = NULL;
    tartan_house_library_options options = tartan_house_library_options_init();
    options.name = "cottages";
    tartan_status status = argc == 4 ? compile(argv[1], argv[2], &module, &error) : TARTAN_INVALID;
    if (status == TARTAN_OK)
        status = tartan_house_library_open(module, &options, NULL, &library, &error);
    if (status == TARTAN_OK)
        status = count(library, &error);
    if (status == TARTAN_OK)
        status = show_best(library, argv[3], &error);
    if (status != TARTAN_OK)
        fprintf(stderr, "houses: %s\n", error.message);
    tartan_house_library_free(library);
    tartan_module_free(module);
    return status != TARTAN_OK;
}
