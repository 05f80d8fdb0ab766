/* Makes the syntax tree of .field files: what the parser calls. */
#include <ctype.h>
#include <string.h>

#include "compiler/field/field.h"

tn_field_parameters tn_field_parameter_add(tn_growth_parse *parse, tn_field_parameters list, tn_field_text name)
{
    tn_field_parameter *parameter = TN_NEW(parse->arena, tn_field_parameter);
    if (parameter)
        parameter->name = name;
    TN_CHAIN(&list, parameter);
    list.count++;
    return list;
}

void tn_field_define(tn_growth_parse *parse, tn_field_statement kind, tn_span span, tn_field_text name, const char *doc,
                     tn_field_parameters parameters, tn_expression *body)
{
    tn_field_file *file = parse->result;
    tn_field_definition *definition = TN_NEW(parse->arena, tn_field_definition);
    if (!definition || !body || !name.text)
        return;
    *definition = (tn_field_definition){
        .kind = kind, .name = name, .doc = doc, .parameters = parameters, .body = body, .span = span};
    TN_CHAIN(file, definition);
}

void tn_field_add_use(tn_growth_parse *parse, tn_field_text path)
{
    tn_field_file *file = parse->result;
    tn_field_use *use = TN_NEW(parse->arena, tn_field_use);
    if (!use || !path.text)
        return;
    use->path = path;
    TN_CHAIN(&file->uses, use);
    file->use_count++;
}

void tn_field_set(tn_growth_parse *parse, tn_field_setting setting)
{
    static const char *const words[] = {"box", "grid", "unit"};
    tn_field_file *file = parse->result;
    const tn_field_setting *first = file->settings[setting.kind];
    if (first) {
        tn_diagnostic *d =
            tn_report(parse->diagnostics, E_FIELD_REPEATED, setting.span, "`%s` is there twice", words[setting.kind]);
        tn_note(parse->diagnostics, d, &first->span, "the first is here");
        tn_help(parse->diagnostics, d, "a file has one, for all its surfaces: leave one of them out");
        return;
    }
    tn_field_setting *copy = TN_NEW(parse->arena, tn_field_setting);
    if (copy)
        *copy = setting;
    file->settings[setting.kind] = copy;
}

/* A file's name without folder and extension, where that can be a name; else "surface". */
static const char *stem(tn_growth_parse *parse)
{
    const char *path = parse->diagnostics->sources->files[parse->file].path, *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    size_t size = 0;
    while (isalnum((unsigned char)name[size]) || name[size] == '_')
        size++;
    if (size == 0 || isdigit((unsigned char)name[0]) || (name[size] != '.' && name[size] != '\0'))
        return "surface";
    return tn_arena_copy(parse->arena, name, size);
}

void tn_field_add_bare(tn_growth_parse *parse, tn_expression *body)
{
    if (body)
        tn_field_define(parse, TN_FIELD_SURFACE, body->span, (tn_field_text){stem(parse), body->span}, NULL,
                        (tn_field_parameters){0}, body);
}

void tn_field_lost(tn_growth_parse *parse)
{
    tn_field_file *file = parse->result;
    file->damaged = true;
}
