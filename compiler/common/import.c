/* Follows `use`: asks the resolver for each text that is used, parses it, and keeps the order in which texts need each
 * other; and writes the texts into the module that is made of them. */
#include "compiler/common/import.h"

#include <stdio.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "compiler/common/limits.h"
#include "compiler/common/notation.h"
#include "runtime/base/utf8.h"

/* ==== the texts that a module was made of, and what made it, as records of the module */

void tn_emit_sources(tn_builder *builder, const tn_imports *imports, const tn_sources *sources)
{
    uint64_t hash = 0;
    for (size_t i = 0; i < sources->count; i++) {
        const tn_source *source = &sources->files[i];
        const char *path = source->path;
        for (size_t u = 0; u < imports->count; u++)
            if (imports->units[u]->file == i)
                path = imports->units[u]->recorded;
        tn_builder_add_SOURCE(builder, &(tn_source_record){tn_builder_string(builder, path),
                                                           tn_builder_string_n(builder, source->text, source->size)});
        hash = XXH3_64bits_withSeed(source->text, source->size, hash);
    }
    tn_builder_add_PRODUCER(builder,
                            &(tn_producer_record){tn_builder_string(builder, "tartan " TARTAN_VERSION), (int64_t)hash});
}

static size_t folder_size(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

const char *tn_emit_path(tn_arena *arena, const tn_sources *sources, uint32_t file, const char *path, uint32_t root)
{
    const char *user = sources->files[file].path, *whole = sources->files[root].path;
    size_t below = folder_size(whole), folder = path[0] == '/' ? 0 : folder_size(user);
    size_t name = strlen(path), skip = below <= folder && memcmp(user, whole, below) == 0 ? below : 0;
    char *resolved = tn_arena_alloc(arena, folder - skip + name + 1);
    if (!resolved)
        return path;
    memcpy(resolved, user + skip, folder - skip);
    memcpy(resolved + folder - skip, path, name + 1);
    return resolved;
}

tn_builder *tn_compilation_begin(const tn_compilation *compilation, const tn_imports *imports, tn_error *error)
{
    tn_builder *builder = tn_builder_new();
    if (builder)
        tn_emit_sources(builder, imports, &compilation->sources);
    else
        tn_fail_memory(error);
    return builder;
}

tn_status tn_compilation_finish(tn_compilation *compilation, tn_builder *builder, tn_status status, tn_error *error)
{
    if (status == TN_OK)
        status = tn_builder_finish(builder, &compilation->module, &compilation->module_size, error);
    tn_builder_free(builder);
    return status;
}

/* ==== follows `use`: asks the resolver for each text that is used, parses it, and keeps the order in which texts need
 * each other */

enum { REACH_WORDS = (TN_FILES_MAX + 63) / 64 };

typedef struct tn_importer {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    const tn_resolver *resolver;
    tn_watch *watch;
    const char *extension; /* of what is used where a `use` does not say */
    tn_parse_unit *parse;
    tn_unit *all[TN_FILES_MAX];   /* in the order they were met */
    tn_unit *chain[TN_FILES_MAX]; /* whose uses are being followed, outermost first */
    size_t all_count, chain_count;
    tn_imports *imports;
} tn_importer;

const char *tn_path_extension(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    return dot ? dot : "";
}

const char *tn_path_stem(const char *path, size_t *length)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
    *length = dot && dot > name ? (size_t)(dot - name) : strlen(name);
    while (*length > TN_NAME_MAX || (*length > 0 && ((unsigned char)name[*length] & 0xC0) == 0x80))
        (*length)--; /* not within a character */
    return name;
}

static const char *copy(tn_importer *importer, const char *text)
{
    return tn_arena_copy(importer->arena, text, strlen(text));
}

/* A path as modules hold it, in UTF-8: of bytes that are none each becomes a question mark. */
static const char *copy_path(tn_importer *importer, const char *path)
{
    size_t length = strlen(path), size;
    char *made = tn_arena_copy(importer->arena, path, length);
    for (size_t at = 0; made && at < length; at += size)
        if (tn_utf8_read(path + at, length - at, &size) == TN_REPLACEMENT && size == 1)
            made[at] = '?';
    return made;
}

/* ---- what is wrong */

/* What the resolver says about a `use` that leads nowhere. */
static void report_unresolved(tn_importer *importer, const tn_use *use, const char *meant, const tn_error *error)
{
    tn_code code = error->code == TN_CODE_NONE ? E_IMPORT_NOT_FOUND : error->code;
    tn_diagnostic *d = tn_report(importer->diagnostics, code, use->span, "%s", error->message);
    tn_help(importer->diagnostics, d, "%s", error->help[0] ? error->help : "check that it is a file that you may read");
    if (meant[0])
        tn_replace_with(importer->diagnostics, d, "\"%s\"", meant);
}

static void report_cycle(tn_importer *importer, const tn_use *use, const tn_unit *again)
{
    const tn_source *files = importer->diagnostics->sources->files;
    char text[400];
    size_t start = 0, used = 0;
    while (importer->chain[start] != again)
        start++;
    for (size_t i = start; i < importer->chain_count && used < sizeof text; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s uses ", files[importer->chain[i]->file].path);
    tn_diagnostic *d =
        tn_report(importer->diagnostics, E_IMPORT_CYCLE, use->span, "files use each other in a circle: %.*s%s",
                  (int)(used < sizeof text ? used : sizeof text - 1), text, files[again->file].path);
    tn_help(importer->diagnostics, d, "%s",
            start + 1 == importer->chain_count ? "a file need not use itself: leave this out"
                                               : "put what they share into a file of its own, which uses neither");
}

/* ---- following */

static tn_status load(tn_importer *importer, const tn_input *input, uint32_t file, const char *extension,
                      tn_unit **result);

/* Adds what a `use` led to to the sources, and follows its uses; *unit stays NULL if that fails. */
static tn_status add_unit(tn_importer *importer, const tn_use *use, const tn_input *input, tn_unit **unit)
{
    tn_error error;
    uint32_t file;
    if (importer->all_count == TN_FILES_MAX) {
        tn_diagnostic *d = tn_report(importer->diagnostics, E_TOO_MANY, use->span,
                                     "this is one file more than the limit of %u files", TN_FILES_MAX);
        tn_help(importer->diagnostics, d, "put the rules into fewer files");
        return TN_OK;
    }
    tn_status status =
        tn_sources_add(importer->diagnostics->sources, input->name, input->text, input->size, &file, &error);
    if (status == TN_OK)
        return load(importer, input, file, NULL, unit);
    if (status != TN_MEMORY)
        report_unresolved(importer, use, "", &error);
    return status == TN_MEMORY ? status : TN_OK;
}

static tn_unit *known(const tn_importer *importer, const tn_input *input)
{
    const char *identity = input->identity ? input->identity : input->name;
    for (size_t i = 0; i < importer->all_count; i++)
        if (strcmp(importer->all[i]->identity, identity) == 0)
            return importer->all[i];
    return NULL;
}

/* Asks the resolver; false if the `use` leads nowhere, which has been reported unless *status is TN_MEMORY. */
static bool resolve(tn_importer *importer, const tn_unit *unit, const tn_use *use, tn_input *input, tn_status *status)
{
    const char *extension = use->extension ? use->extension : importer->extension;
    char meant[TN_MEANT_SIZE] = "";
    tn_request request = {use->path, extension, importer->diagnostics->sources->files[unit->file].path};
    tn_error error = {0};
    *input = (tn_input){0};
    if (importer->resolver->resolve) {
        *status = importer->resolver->resolve(importer->resolver->context, &request, input, meant, &error);
    } else {
        *status = tn_fail(&error, TN_INVALID, E_IMPORT_NOT_FOUND, "there is no file `%.400s`", use->path);
        tn_error_help(&error, "this text is compiled alone, and can use no other");
    }
    if (*status != TN_OK && *status != TN_MEMORY)
        report_unresolved(importer, use, meant, &error);
    return *status == TN_OK;
}

/* Follows one `use` of a unit. */
static tn_status follow(tn_importer *importer, tn_unit *unit, tn_use *use)
{
    tn_input input;
    tn_status status;
    if (!resolve(importer, unit, use, &input, &status)) {
        unit->incomplete = true;
        return status == TN_MEMORY ? status : TN_OK;
    }
    tn_unit *used = known(importer, &input);
    if (used && used->loading) {
        report_cycle(importer, use, used);
        unit->incomplete = true;
        return TN_OK;
    }
    status = used ? TN_OK : add_unit(importer, use, &input, &used);
    if (status != TN_OK)
        return status;
    use->unit = used;
    unit->incomplete |= !used || used->incomplete;
    for (size_t i = 0; used && i < REACH_WORDS; i++)
        unit->reach[i] |= used->reach[i];
    return TN_OK;
}

/* Makes a unit of a source; NULL if out of memory. Without an extension it has its name's. */
static tn_unit *new_unit(tn_importer *importer, const tn_input *input, uint32_t file, const char *extension)
{
    tn_unit *unit = TN_NEW(importer->arena, tn_unit);
    if (!unit)
        return NULL;
    const char *name = importer->diagnostics->sources->files[file].path;
    *unit = (tn_unit){.file = file,
                      .extension = copy(importer, extension ? extension : tn_path_extension(name)),
                      .identity = copy(importer, input->identity ? input->identity : name),
                      .recorded = copy_path(importer, input->recorded ? input->recorded : name),
                      .loading = true,
                      .reach = TN_NEW_ARRAY(importer->arena, uint64_t, REACH_WORDS)};
    return unit->extension && unit->identity && unit->recorded && unit->reach ? unit : NULL;
}

/* Parses a source and follows its uses. Recursion is as deep as files nest, at most TN_FILES_MAX. */
static tn_status load(tn_importer *importer, const tn_input *input, uint32_t file, const char *extension,
                      tn_unit **result)
{
    if (tn_watch_stopped(importer->watch))
        return TN_STOPPED;
    tn_unit *unit = new_unit(importer, input, file, extension);
    if (!unit)
        return TN_MEMORY;
    importer->all[importer->all_count++] = unit;
    importer->chain[importer->chain_count++] = unit;
    tn_use *uses = NULL;
    size_t use_count = 0;
    if (!importer->parse(importer->arena, importer->diagnostics, unit, &uses, &use_count))
        return TN_MEMORY;
    unit->uses = uses;
    unit->use_count = use_count;
    for (size_t i = 0; i < use_count; i++) {
        tn_status status = follow(importer, unit, &uses[i]);
        if (status != TN_OK)
            return status;
    }
    size_t index = importer->imports->count++;
    importer->imports->units[index] = unit;
    unit->reach[index / 64] |= UINT64_C(1) << (index % 64);
    unit->loading = false;
    importer->chain_count--;
    *result = unit;
    return TN_OK;
}

tn_status tn_import_all(tn_compilation *compilation, const tn_compile_options *options, const char *extension,
                        tn_parse_unit *parse, tn_imports *imports)
{
    tn_importer *state = TN_NEW(compilation->arena, tn_importer);
    imports->units = TN_NEW_ARRAY(compilation->arena, tn_unit *, TN_FILES_MAX);
    imports->count = 0;
    if (!state || !imports->units)
        return TN_MEMORY;
    *state = (tn_importer){.arena = compilation->arena,
                           .diagnostics = &compilation->diagnostics,
                           .resolver = &options->resolver,
                           .watch = options->watch,
                           .extension = extension,
                           .parse = parse,
                           .imports = imports};
    tn_unit *unit = NULL;
    return load(state, compilation->input, 0, compilation->notation->extension, &unit);
}
