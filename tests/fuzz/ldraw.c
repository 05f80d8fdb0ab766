/* Models as LDraw files, of any bytes: reading ends, and what was read is written and read back as the same model. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/place/read.h"
#include "runtime/place/write.h"
#include "tests/fuzz/fuzz.h"

static void fail(const char *what)
{
    fprintf(stderr, "ldraw: %s\n", what);
    abort();
}

static void compare(const tn_placed_model *one, const tn_placed_model *other)
{
    if (one->count != other->count)
        fail("reading back gives another number of parts");
    for (size_t i = 0; i < one->count; i++)
        if (memcmp(&one->parts[i].frame, &other->parts[i].frame, sizeof one->parts[i].frame) != 0 ||
            strcmp(one->parts[i].name, other->parts[i].name) != 0)
            fail("reading back gives another part");
}

/* Names that a file of ours would not give back: with an r, which connection grammars lose, or a new ending. */
static bool is_plain(const tn_placed_model *model)
{
    for (size_t i = 0; i < model->count; i++) {
        const char *name = model->parts[i].name;
        if (strpbrk(name, "r.") || *name == '\0' || strpbrk(name, "\r\v\f"))
            return false;
    }
    return true;
}

static void write_and_read(const tn_placed_model *model, const double unit[3])
{
    char *text = NULL;
    size_t size;
    tn_ldraw again;
    tn_error error;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return;
    tn_place_write_ldraw(NULL, model, NULL, out);
    fclose(out);
    if (tn_ldraw_read(text, size, unit, 24, NULL, &again, &error) != TN_OK)
        fail("what was written cannot be read");
    compare(model, &again.model);
    tn_ldraw_clear(&again);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const double unit[3] = {10, 8, 10}; /* of files without a kit */
    tn_ldraw ldraw;
    tn_error error = {0};
    tn_status status = tn_ldraw_read((const char *)data, size, unit, 24, NULL, &ldraw, &error);
    if (status != TN_OK && error.message[0] == '\0')
        fail("failed without an error");
    if (status == TN_OK && ldraw.model.count < 10000 && is_plain(&ldraw.model))
        write_and_read(&ldraw.model, unit);
    tn_ldraw_clear(&ldraw);
    return 0;
}
