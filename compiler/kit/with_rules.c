/* Takes rules out of the text of a kit, and puts others behind it. */
#include "compiler/kit/with_rules.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/common/names.h"
#include "compiler/kit/kit.h"

typedef struct splicing {
    tn_sources sources;
    tn_diagnostics diagnostics;
    tn_arena *arena;
    tn_names named; /* by the rules that are put in */
    const char *folder;
    FILE *out;
} splicing;

static tn_kit_file *parse(splicing *s, const char *text, size_t size, tn_error *error)
{
    uint32_t file;
    if (tn_sources_add(&s->sources, "kit", text, size, &file, error) != TN_OK)
        return NULL;
    tn_kit_file *parsed = tn_parse_kit(s->arena, &s->diagnostics, file, NULL);
    if (!parsed)
        tn_fail_memory(error);
    return parsed;
}

/* A statement's text ends behind its `;`, before which comments may stand. */
static size_t behind(const char *text, size_t end)
{
    size_t at = end;
    while (text[at] && text[at] != ';')
        at += text[at] == '#' ? strcspn(text + at, "\n") : 1;
    return text[at] ? at + 1 : end;
}

/* ---- the files that a kit names */

typedef tn_status path_visit(void *context, const tn_kit_text *path, tn_error *error);

/* Meshes, pictures and models, in the order of the text. Recursion is as deep as spaces nest. */
static tn_status each_attached(const tn_kit_node *first, path_visit *visit, void *context, tn_error *error)
{
    tn_status status = TN_OK;
    for (const tn_kit_node *node = first; node && status == TN_OK; node = node->next) {
        bool names = node->kind == TN_KIT_FILED || node->kind == TN_KIT_STANDS;
        if (names && node->doc.text)
            status = visit(context, &node->doc, error);
        if (status == TN_OK)
            status = each_attached(node->inner.first, visit, context, error);
    }
    return status;
}

/* Is it a path from the kit's folder, and not a name of the standard library? */
static bool is_beside(const char *path)
{
    return path[0] != '/' && (strchr(path, '/') || strchr(path, '.'));
}

/* A stretch of the kit's text that is being copied. */
typedef struct stretch {
    splicing *s;
    const char *text;
    size_t from, to;
} stretch;

static tn_status copy_path(void *context, const tn_kit_text *path, tn_error *error)
{
    stretch *t = context;
    (void)error;
    if (path->span.begin < t->from || path->span.end > t->to || !is_beside(path->text))
        return TN_OK;
    fwrite(t->text + t->from, 1, path->span.begin - t->from, t->s->out);
    fprintf(t->s->out, "\"%s/%s\"", t->s->folder, path->text);
    t->from = path->span.end;
    return TN_OK;
}

/* The text from `from` to `to`, where `folder` is known with whole paths. What is used stands before what is attached
 * in it: `use` may stand anywhere, but a `use` behind an attached file stays as it is. */
static void copy(splicing *s, const tn_kit_file *kit, const char *text, size_t from, size_t to)
{
    stretch t = {s, text, from, to};
    for (const tn_kit_use *use = kit->uses.first; s->folder && use; use = use->next)
        copy_path(&t, &use->path, NULL);
    if (s->folder)
        each_attached(kit->first, copy_path, &t, NULL);
    fwrite(text + t.from, 1, to - t.from, s->out);
}

static void splice(splicing *s, const tn_kit_file *kit, const char *text, const char *rules, size_t rules_size)
{
    size_t from = 0;
    for (const tn_kit_node *node = kit->first; node; node = node->next) {
        if (node->kind != TN_KIT_RULE || !tn_names_get(&s->named, node->name.text))
            continue;
        copy(s, kit, text, from, node->span.begin);
        from = behind(text, node->span.end);
    }
    copy(s, kit, text, from, strlen(text));
    fwrite(rules, 1, rules_size, s->out);
    if (rules_size == 0 || rules[rules_size - 1] != '\n')
        fputc('\n', s->out);
}

static tn_status write_spliced(splicing *s, const char *kit, const char *rules, size_t rules_size, tn_error *error)
{
    s->named = (tn_names){.arena = s->arena};
    const tn_kit_file *put_in = parse(s, rules, rules_size, error);
    const tn_kit_file *whole = put_in ? parse(s, kit, strlen(kit), error) : NULL;
    if (!whole)
        return error->status;
    for (tn_kit_node *node = put_in->first; node; node = node->next)
        if (node->kind == TN_KIT_RULE)
            tn_names_put(&s->named, node->name.text, node);
    splice(s, whole, kit, rules, rules_size);
    return tn_arena_failed(s->arena) ? tn_fail_memory(error) : TN_OK;
}

tn_status tn_kit_with_rules(const char *kit, const char *rules, size_t rules_size, const char *folder, char **text,
                            tn_error *error)
{
    splicing s = {.arena = tn_arena_new(), .folder = folder};
    size_t size;
    *text = NULL;
    tn_diagnostics_init(&s.diagnostics, &s.sources);
    s.out = s.arena ? open_memstream(text, &size) : NULL;
    tn_status status = s.out ? write_spliced(&s, kit, rules, rules_size, error) : tn_fail_memory(error);
    if (s.out && fclose(s.out) != 0 && status == TN_OK)
        status = tn_fail_memory(error);
    if (status != TN_OK) {
        free(*text);
        *text = NULL;
    }
    tn_arena_free(s.arena);
    tn_diagnostics_clear(&s.diagnostics);
    tn_sources_clear(&s.sources);
    return status;
}

/* ---- attached files */

typedef struct attached {
    tn_kit_file_visit *visit;
    void *context;
} attached;

static tn_status show_path(void *context, const tn_kit_text *path, tn_error *error)
{
    const attached *a = context;
    return a->visit(a->context, path->text, error);
}

tn_status tn_kit_attached(const char *kit, tn_kit_file_visit *visit, void *context, tn_error *error)
{
    splicing s = {.arena = tn_arena_new()};
    attached shown = {visit, context};
    tn_diagnostics_init(&s.diagnostics, &s.sources);
    const tn_kit_file *file = s.arena ? parse(&s, kit, strlen(kit), error) : NULL;
    tn_status status = file      ? each_attached(file->first, show_path, &shown, error)
                       : s.arena ? error->status
                                 : tn_fail_memory(error);
    tn_arena_free(s.arena);
    tn_diagnostics_clear(&s.diagnostics);
    tn_sources_clear(&s.sources);
    return status;
}
