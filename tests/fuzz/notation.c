/* The front end of a notation, TARTAN_FUZZ_NOTATION, on any text: it ends, says what is wrong, and what it accepts
 * makes a module that loads and can be listed. For notations that have no target of their own. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/compile.h"
#include "runtime/geometry/mesh.h"
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

/* Whatever is used is an empty text, or a grammar, of which none is empty. */
static tn_status resolve(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    (void)context, (void)meant, (void)error;
    bool grammar = strcmp(request->extension, ".bnf") == 0;
    *found = (tn_input){.text = grammar ? "<s> ::= <s> <s> | a | b\n" : "", .name = request->path};
    found->size = strlen(found->text);
    return TN_OK;
}

/* What a text calls a file is the file's text. */
static tn_status give_bytes(void *context, const tn_request *request, uint8_t **bytes, size_t *size, tn_error *error)
{
    (void)context;
    *size = strlen(request->path);
    *bytes = (uint8_t *)strdup(request->path);
    return *bytes ? TN_OK : tn_fail_memory(error);
}

/* Every mesh is a tetrahedron, or three sides of one where its name says so. */
static tn_status give_mesh(void *context, const tn_request *request, tn_mesh *mesh, tn_error *error)
{
    static const double positions[4][3] = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
    static const uint32_t corners[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    size_t faces = strcmp(request->path, "open") == 0 ? 3 : 4;
    (void)context;
    tn_status status = tn_mesh_new(4, faces, 3 * faces, mesh, error);
    if (status != TN_OK)
        return status;
    memcpy(mesh->positions, positions, sizeof positions);
    memcpy(mesh->corners, corners, 3 * faces * sizeof *corners);
    for (uint32_t i = 0; i <= faces; i++)
        mesh->face_first[i] = 3 * i;
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
    tn_compile_options options = {.resolver = {resolve, NULL}, .attachments = {give_bytes, give_mesh, NULL}};
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
