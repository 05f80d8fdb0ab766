/* House lines of a small form from any bytes: what is read can be written, and reads back as the same house. The houses
 * on its plan are counted, ranked and changed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/house/house.h"
#include "runtime/load.h"
#include "tests/fuzz/engines_house.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/compile_file.h"

enum { TRAYS = 12 };

static void stop(const char *why)
{
    fprintf(stderr, "%s\n", why);
    abort();
}

/* A form of cottages without ways, compiled when it is first asked for. */
static const tn_house_form *cottages(void)
{
    static tn_compilation compilation;
    static tn_module *module;
    static tn_schema *schema;
    static tn_house_form form;
    if (schema)
        return &form;
    if (compile_file(TARTAN_SOURCE_DIR "/tests/cli/files/cabins.plan", &(library_folders){0}, &compilation) != TN_OK ||
        tn_module_load(compilation.module, compilation.module_size, NULL, &module, NULL) != TN_OK ||
        tn_schema_new(module, module->FORM_records[0].schema, 0, &schema, NULL) != TN_OK)
        stop("tests/cli/files/cabins.plan does not compile");
    tn_form_ready(module, 0, schema, &form);
    return &form;
}

static void write(const tn_house *house, tn_buffer *line)
{
    tn_buffer members = {0};
    tn_json json = tn_json_text(&members, TN_JSON_TIGHT);
    if (tn_house_write(house, line, NULL) != TN_OK || tn_house_write_members(house, &json, NULL) != TN_OK)
        stop("a house that was read cannot be written");
    free(members.data);
}

static void round_trip(const tn_house *house)
{
    tn_buffer first = {0}, second = {0};
    tn_house again = {0};
    tn_error error;
    write(house, &first);
    if (tn_house_read(house->form, first.data, first.size, TRAYS, &again, &error) != TN_OK)
        stop(error.message);
    write(&again, &second);
    if (first.size != second.size || memcmp(first.data, second.data, first.size) != 0)
        stop("a house reads back as another");
    tn_house_clear(&again);
    free(first.data);
    free(second.data);
}

/* The last library of the file is of the form. */
static void use(const tn_house *house)
{
    const tn_module *module = house->form->module;
    round_trip(house);
    fuzz_houses_on(house->form, &module->HOUSE_LIBRARY_records[module->HOUSE_LIBRARY_count - 1], NULL, house->trays,
                   house->length);
}

typedef tn_status reader(const tn_house_form *form, const char *line, size_t size, size_t max_trays, tn_house *house,
                         tn_error *error);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static reader *const readers[] = {tn_house_read, tn_house_read_open};
    if (memchr(data, '\n', size))
        return 0; /* a line holds none */
    for (size_t i = 0; i < 2; i++) {
        tn_house house = {0};
        tn_error error = {0};
        tn_status status = readers[i](cottages(), (const char *)data, size, TRAYS, &house, &error);
        if (status == TN_OK)
            use(&house);
        else if (error.status != status || error.message[0] == '\0')
            stop("a line is refused without a reason");
        tn_house_clear(&house);
    }
    return 0;
}
