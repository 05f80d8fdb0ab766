/* The front end of a notation, TARTAN_FUZZ_NOTATION, on any text: it ends, says what is wrong, and what it accepts
 * makes a module that loads and can be listed. For notations that have no target of their own. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/compile.h"
#include "runtime/load.h"
#include "tests/fuzz/fuzz.h"

static void fail(const char *what)
{
    fprintf(stderr, "%s: %s\n", TARTAN_FUZZ_NOTATION, what);
    abort();
}

static const tn_notation *notation(void)
{
    for (size_t i = 0; i < tn_notation_count; i++)
        if (strcmp(tn_notations[i].name, TARTAN_FUZZ_NOTATION) == 0)
            return &tn_notations[i];
    fail("there is no such notation");
    return NULL;
}

/* Whatever is used is an empty text. */
static tn_status resolve(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    (void)context, (void)meant, (void)error;
    *found = (tn_input){.text = "", .size = 0, .name = request->path};
    return TN_OK;
}

static void show(tn_compilation *compilation, const tn_module *module)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return;
    tn_diagnostics_show(&compilation->diagnostics, &(tn_show_options){.colour = true}, out);
    tn_diagnostics_show(&compilation->diagnostics, &(tn_show_options){.json = true}, out);
    if (module)
        tn_module_disassemble(module, out);
    fclose(out);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    tn_compile_options options = {.resolver = {resolve, NULL}};
    tn_input input = {.text = (const char *)data, .size = size, .name = "fuzz"};
    tn_compilation compilation;
    tn_module *module = NULL;
    tn_status status = tn_compile_text(notation(), &input, &options, &compilation);
    if (status == TN_OK && tn_module_load(compilation.module, compilation.module_size, NULL, &module, NULL) != TN_OK)
        fail("the module is refused");
    if (status != TN_OK && compilation.diagnostics.error_count == 0)
        fail("failed without an error");
    show(&compilation, module);
    tn_module_free(module);
    tn_compilation_clear(&compilation);
    return 0;
}
