/* Part files of LDraw libraries, of any bytes: reading ends and says what is wrong; a file that only contains a part is
 * that part; and a kit that has it as a part is compiled to a module that loads, or is refused.
 *
 * An input is one or several files: a line `0 FILE NAME` begins the next one. The first is the part, and lies beside
 * the kit; the others are the library. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/compile.h"
#include "runtime/load.h"
#include "runtime/place/part_file.h"
#include "tests/fuzz/fuzz.h"

#define PART "part.dat"
#define AROUND "around.dat"
static const char around[] = "1 16 0 0 0 1 0 0 0 1 0 0 0 1 " PART "\n", heading[] = "\n0 FILE ";

typedef struct input {
    const char *bytes;
    size_t size;
} input;

static void fail(const char *what)
{
    fprintf(stderr, "part: %s\n", what);
    abort();
}

/* ---- the files of an input */

/* Where the next heading is, from a place on; the end where there is none. */
static size_t next_heading(const input *all, size_t from)
{
    const char *found = memmem(all->bytes + from, all->size - from, heading, sizeof heading - 1);
    return found ? (size_t)(found - all->bytes) : all->size;
}

/* The text of a file of the library. */
static bool find_file(const input *all, const char *name, input *found)
{
    size_t length = strlen(name);
    for (size_t at = next_heading(all, 0); at < all->size; at = next_heading(all, at + 1)) {
        size_t named = at + sizeof heading - 1, text = named + length + 1;
        if (text > all->size || memcmp(all->bytes + named, name, length) != 0 || all->bytes[text - 1] != '\n')
            continue;
        size_t end = next_heading(all, text - 1); /* before the text where a heading is its first line */
        *found = (input){all->bytes + text, end > text ? end - text : 0};
        return true;
    }
    return false;
}

static tn_status give(const input *file, uint8_t **bytes, size_t *size, tn_error *error)
{
    *size = file->size;
    *bytes = malloc(file->size + 1);
    if (!*bytes)
        return tn_fail_memory(error);
    memcpy(*bytes, file->bytes, file->size);
    return TN_OK;
}

static tn_status read_library(void *context, const char *name, uint8_t **bytes, size_t *size, tn_error *error)
{
    const input *all = context;
    input file = {all->bytes, next_heading(all, 0)};
    if (strcmp(name, AROUND) == 0)
        file = (input){around, sizeof around - 1};
    else if (strcmp(name, PART) != 0 && !find_file(all, name, &file))
        return tn_fail(error, TN_IO, E_CANNOT_READ, "there is no such file");
    return give(&file, bytes, size, error);
}

/* ---- the reader alone */

static bool is_same(double one, double other)
{
    return one == other || (one != one && other != other);
}

static void compare(const tn_part_file *one, const tn_part_file *other)
{
    if (one->stud_count != other->stud_count || one->tilted != other->tilted)
        fail("a file around the part has another number of studs");
    for (int k = 0; k < 3; k++)
        if (!is_same(one->low[k], other->low[k]) || !is_same(one->high[k], other->high[k]))
            fail("a file around the part has another size");
    for (size_t i = 0; i < one->stud_count; i++) {
        const tn_part_stud *a = &one->studs[i], *b = &other->studs[i];
        if (a->axis >= TN_AXIS_COUNT || a->axis != b->axis || a->kind != b->kind || !is_same(a->at[0], b->at[0]) ||
            !is_same(a->at[1], b->at[1]) || !is_same(a->at[2], b->at[2]))
            fail("a file around the part has another stud");
    }
}

/* Only a limit may keep a file around the part from being read. Gives how reading ended. */
static tn_status read_alone(input *all)
{
    const tn_part_library library = {read_library, all};
    tn_part_file part, outer;
    tn_error error = {0};
    tn_status status = tn_part_file_read(&library, PART, &part, &error);
    if (status != TN_OK && error.message[0] == '\0')
        fail("failed without an error");
    if (status == TN_OK) {
        tn_status again = tn_part_file_read(&library, AROUND, &outer, &error);
        if (again == TN_OK)
            compare(&part, &outer);
        else if (again != TN_LIMIT && again != TN_MEMORY)
            fail("a file around the part is refused");
        tn_part_file_clear(&outer);
    }
    tn_part_file_clear(&part);
    return status;
}

/* ---- as a part of a kit */

static tn_status give_bytes(void *context, const tn_request *request, uint8_t **bytes, size_t *size, tn_error *error)
{
    if (request->extension[0] == '\0' && strcmp(request->path, PART) != 0)
        return tn_fail(error, TN_IO, E_CANNOT_READ, "there is no such file");
    return read_library(context, request->path, bytes, size, error);
}

static void compile(input *all, const char *text)
{
    const tn_compile_options options = {.attachments = {.bytes = give_bytes, .context = all}};
    const tn_input kit = {.text = text, .size = strlen(text), .name = "fuzz.kit"};
    tn_compilation compilation;
    tn_module *module = NULL;
    tn_error error;
    tn_status status = tn_compile_text(TN_NOTATION(kit), &kit, &options, &compilation);
    if (status == TN_OK && tn_module_load(compilation.module, compilation.module_size, NULL, &module, &error) != TN_OK)
        fail(error.message);
    if (status != TN_OK && status != TN_MEMORY && compilation.diagnostics.error_count == 0)
        fail("a kit is refused without an error");
    tn_module_free(module);
    tn_compilation_clear(&compilation);
}

#define KIT(UNIT, BODY)                                                                                                \
    UNIT "connector stud joins tube every 20;\nconnector tube joins stud every 20;\n"                                  \
         "part one from ldraw \"" PART "\"" BODY "rule wall at stud, tube = one;\n"                                    \
         "model wall { inside box(200, 240, 200); start stud at (0, 0, 0) by wall; }\n"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input all = {(const char *)data, size};
    if (read_alone(&all) == TN_LIMIT) /* a million lines are read once */
        return 0;
    compile(&all, KIT("unit 10 x 8 x 10;\n", ";\n"));
    compile(&all, KIT("unit 2 x 2 x 2 turns 24;\n", "{ fill 20 x 24 x 20; }\n"));
    return 0;
}
