/* Compiles the expressions, open plans and plans that a command line gives. */
#include "compiler/plan/ask.h"

#include <string.h>

static tn_status parse(tn_arena *arena, tn_diagnostics *diagnostics, tn_sources *sources, const char *path,
                       const char *text, tn_parse_what what, tn_ast_file **tree, tn_error *error)
{
    uint32_t file;
    tn_status status = tn_sources_add(sources, path, text, strlen(text), &file, error);
    if (status != TN_OK)
        return status;
    *tree = tn_parse_plan_part(arena, diagnostics, file, what);
    return *tree ? TN_OK : tn_fail_memory(error);
}

tn_status tn_ask(tn_arena *arena, tn_diagnostics *diagnostics, tn_sources *sources, const tn_questions *questions,
                 tn_asked_for *asked, tn_error *error)
{
    tn_ast_file *tree = NULL;
    asked->library = questions->library;
    asked->wheres = TN_NEW_ARRAY(arena, tn_ast_expr *, questions->where_count);
    tn_status status = asked->wheres ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < questions->where_count; i++) {
        status = parse(arena, diagnostics, sources, "--where", questions->wheres[i], TN_PARSE_EXPRESSION, &tree, error);
        if (status == TN_OK && tree->expression)
            asked->wheres[asked->where_count++] = tree->expression;
    }
    asked->schema = questions->schema;
    if (status == TN_OK && questions->pattern) {
        status = parse(arena, diagnostics, sources, questions->plan_name, questions->pattern, TN_PARSE_PATTERN, &tree,
                       error);
        asked->pattern = status == TN_OK ? &tree->pattern : NULL;
    }
    if (status == TN_OK && questions->plan) {
        status =
            parse(arena, diagnostics, sources, questions->plan_name, questions->plan, TN_PARSE_LITERAL, &tree, error);
        asked->literal = status == TN_OK && !tree->broken ? &tree->literal : NULL;
    }
    return status;
}
