/* What the names of fields mean: each is there once, is used as what it is, and none needs itself. */
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/common/names.h"
#include "compiler/field/field.h"
#include "runtime/number/run.h"

typedef struct check {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    const tn_imports *imports;
    const tn_resolver *resolver; /* NULL: none */
    tn_checked_fields *checked;
    const tn_field_definition *here; /* whose body is checked; NULL: of a box */
    uint32_t unit;
} check;

static const char *const axes[] = {"x", "y", "z"};

static int axis_named(const char *name)
{
    for (int axis = 0; axis < 3; axis++)
        if (strcmp(axes[axis], name) == 0)
            return axis;
    return -1;
}

bool tn_field_is_at(const tn_expression *e)
{
    return e->op == TN_OPCODE_COUNT && e->name && strcmp(e->name, TN_FIELD_AT_NAME) == 0;
}

/* ---- names */

static bool sees(const check *c, const tn_field_definition *definition)
{
    return tn_import_reaches(c->imports, c->unit, definition->unit);
}

static uint32_t definition_named(const check *c, const char *name)
{
    uint32_t i = 0;
    while (i < c->checked->definition_count &&
           (!sees(c, c->checked->definitions[i]) || strcmp(c->checked->definitions[i]->name.text, name) != 0))
        i++;
    return i;
}

/* The index of a parameter, or how many there are. */
static uint32_t parameter_named(const check *c, const char *name)
{
    uint32_t i = 0;
    const tn_field_parameter *p = c->here ? c->here->parameters.first : NULL;
    while (p && strcmp(p->name.text, name) != 0) {
        p = p->next;
        i++;
    }
    return i;
}

static uint32_t parameter_count(const check *c)
{
    return c->here ? c->here->parameters.count : 0;
}

/* All names that can stand here, for "did you mean". */
static const char *nearest(const check *c, const char *wrong, bool function)
{
    size_t most = c->checked->definition_count + parameter_count(c) + TN_OPERATION_COUNT + 4, count = 0;
    const char **names = TN_NEW_ARRAY(c->arena, const char *, most);
    if (!names)
        return NULL;
    if (function) {
        count = tn_function_names(TN_WORDS_FIELD, names);
        names[count++] = "distance";
    } else {
        for (const tn_field_parameter *p = c->here ? c->here->parameters.first : NULL; p; p = p->next)
            names[count++] = p->name.text;
        for (int axis = 0; axis < 3; axis++)
            names[count++] = axes[axis];
    }
    for (uint32_t i = 0; i < c->checked->definition_count; i++) {
        const tn_field_definition *d = c->checked->definitions[i];
        if (sees(c, d) && (d->kind == TN_FIELD_FUNCTION) == function)
            names[count++] = d->name.text;
    }
    return tn_nearest(wrong, names, count);
}

/* The standard library's file of shapes, which nobody has used; false if it is not there. */
static bool find_shapes(const check *c, tn_input *found)
{
    const tn_request request = {
        .path = "shapes", .extension = ".field", .user = c->diagnostics->sources->files[0].path};
    char meant[TN_MEANT_SIZE] = "";
    tn_error error;
    return c->resolver && c->resolver->resolve &&
           c->resolver->resolve(c->resolver->context, &request, found, meant, &error) == TN_OK;
}

/* The function there of that name, or of one that is near to it; NULL: none. */
static const char *shape_near(const check *c, const char *name)
{
    static const char word[] = "\nfn ";
    enum { MOST = 100 };
    const char *names[MOST];
    size_t count = 0, size = sizeof word - 1;
    tn_input found;
    if (!find_shapes(c, &found))
        return NULL;
    const char *at = found.text, *end = found.text + found.size;
    while (count < MOST && (at = memmem(at, (size_t)(end - at), word, size))) {
        at += size;
        const char *after = memchr(at, '(', (size_t)(end - at));
        names[count] = after ? tn_arena_copy(c->arena, at, (size_t)(after - at)) : NULL;
        if (!names[count])
            break;
        if (strcmp(names[count], name) == 0)
            return names[count];
        count++;
    }
    return tn_nearest(name, names, count);
}

static void unknown(check *c, const tn_expression *e, bool function)
{
    const char *what = function ? "function" : "number or surface", *near = nearest(c, e->name, function);
    const char *elsewhere = function ? tn_function_elsewhere(TN_WORDS_FIELD, e->name) : NULL;
    const char *shape = function ? shape_near(c, e->name) : NULL;
    tn_diagnostic *d = tn_report(c->diagnostics, E_FIELD_NAME, e->name_span, "there is no %s `%.100s`", what, e->name);
    if (elsewhere)
        tn_help(c->diagnostics, d, "write `%s`", elsewhere);
    else if (shape && strcmp(shape, e->name) == 0)
        tn_help(c->diagnostics, d, "add `use \"shapes\"` at the top");
    else if (near)
        tn_suggest(c->diagnostics, d, "%s", near);
    else if (shape)
        tn_help(c->diagnostics, d, "did you mean `%s`? that needs `use \"shapes\"` at the top", shape);
    else if (function)
        tn_help(c->diagnostics, d, "define it: `fn %.60s(x, y, z) = ...`; docs/field-language.md lists what there is",
                e->name);
    else
        tn_help(c->diagnostics, d, "the coordinates are x, y and z; others are defined by `let` or `surface`");
}

/* Says that a name is not used as what it is. */
static void misused(check *c, const tn_expression *e, const char *what, const char *help)
{
    tn_diagnostic *d = tn_report(c->diagnostics, E_FIELD_MISUSED, e->name_span, "`%.100s` is %s", e->name, what);
    tn_help(c->diagnostics, d, "%s", help);
}

static void check_name(check *c, tn_expression *e)
{
    uint32_t parameter = parameter_named(c, e->name), definition = definition_named(c, e->name);
    int axis = axis_named(e->name);
    if (parameter < parameter_count(c)) {
        e->term = parameter;
    } else if (axis >= 0) {
        e->op = TN_OP_COORDINATE;
        e->term = (uint32_t)axis;
    } else if (definition < c->checked->definition_count) {
        tn_field_definition *d = c->checked->definitions[definition];
        d->used = true;
        e->op = TN_OPCODE_COUNT;
        e->term = definition;
        if (d->kind == TN_FIELD_FUNCTION)
            misused(c, e, "a function", "a function is called: write its arguments in parentheses");
    } else if (tn_function_named(TN_WORDS_FIELD, e->name, strlen(e->name))) {
        misused(c, e, "a function", "a function is called: write its arguments in parentheses");
    } else {
        unknown(c, e, false);
    }
}

/* ---- calls */

static void wrong_count(check *c, const tn_expression *e, uint32_t wanted, bool more)
{
    uint32_t given = e->operand_count;
    tn_diagnostic *d = tn_report(c->diagnostics, E_FIELD_ARITY, e->span, "`%.100s` takes %s%u argument%s, not %u",
                                 e->name, more ? "at least " : "", wanted, wanted == 1 ? "" : "s", given);
    tn_help(c->diagnostics, d,
            given < wanted ? "write the others, with commas between them" : "leave out what is too many");
}

static void check_at(check *c, const tn_expression *e)
{
    if (e->operand_count == 4)
        return;
    tn_diagnostic *d =
        tn_report(c->diagnostics, E_FIELD_ARITY, e->span, "`at` takes three coordinates, not %u", e->operand_count - 1);
    tn_help(c->diagnostics, d, "write as `ball at (x - 5, y, z)`");
}

static void check_call(check *c, tn_expression *e)
{
    uint32_t definition = definition_named(c, e->name);
    const tn_operation *function = tn_function_named(TN_WORDS_FIELD, e->name, strlen(e->name));
    if (tn_field_is_at(e)) {
        check_at(c, e);
    } else if (definition < c->checked->definition_count) {
        tn_field_definition *d = c->checked->definitions[definition];
        d->used = true;
        e->term = definition;
        if (d->kind != TN_FIELD_FUNCTION)
            misused(c, e, d->kind == TN_FIELD_LET ? "a number" : "a surface",
                    d->kind == TN_FIELD_LET ? "write `*` to multiply by it"
                                            : "write `at` before the coordinates: `ball at (x - 5, y, z)`");
        else if (d->parameters.count != e->operand_count)
            wrong_count(c, e, d->parameters.count, false);
    } else if (function) {
        bool many = function->opcode == TN_OP_LEAST || function->opcode == TN_OP_MOST;
        if (many ? e->operand_count < 2 : e->operand_count != function->arity)
            wrong_count(c, e, function->arity, many);
        else
            e->op = function->opcode;
    } else if (strcmp(e->name, "distance") == 0) {
        misused(c, e, "about a mesh", "write its file: `distance(\"hull.obj\")`");
    } else if (axis_named(e->name) >= 0 || parameter_named(c, e->name) < parameter_count(c)) {
        misused(c, e, "a number", "write `*` to multiply by it");
    } else {
        unknown(c, e, true);
    }
}

/* Recursion is as deep as expressions nest: at most TN_NESTING_MAX. */
static void check_node(check *c, tn_expression *e)
{
    if (e->op == TN_OP_TERM)
        check_name(c, e);
    else if (e->op == TN_OPCODE_COUNT)
        check_call(c, e);
    for (tn_expression *operand = e->first; operand; operand = operand->next)
        check_node(c, operand);
}

static void check_expression(check *c, tn_expression *e)
{
    if (e->depth <= TN_NESTING_MAX) {
        check_node(c, e);
        return;
    }
    tn_diagnostic *d = tn_report(c->diagnostics, E_TOO_DEEP, e->span,
                                 "the expression is nested more than %u deep, which is the limit", TN_NESTING_MAX);
    tn_help(c->diagnostics, d, "define parts of it by `fn` or `surface`");
}

/* ---- definitions */

/* Does a file see both, so that the name would have two meanings? */
static const tn_field_definition *namesake(const check *c, uint32_t index)
{
    const tn_field_definition *own = c->checked->definitions[index];
    for (uint32_t i = 0; i < index; i++) {
        const tn_field_definition *other = c->checked->definitions[i];
        bool both = tn_import_reaches(c->imports, own->unit, other->unit) ||
                    (tn_import_reaches(c->imports, c->checked->unit, own->unit) &&
                     tn_import_reaches(c->imports, c->checked->unit, other->unit));
        if (both && strcmp(own->name.text, other->name.text) == 0)
            return other;
    }
    return NULL;
}

static void check_definition(check *c, uint32_t index)
{
    tn_field_definition *own = c->checked->definitions[index];
    const tn_field_definition *first = namesake(c, index);
    tn_diagnostic *d;
    tn_name_fits(c->diagnostics, own->name.text, own->name.span);
    if (first) {
        d = tn_report(c->diagnostics, E_DUPLICATE_NAME, own->name.span, "`%.100s` is defined twice", own->name.text);
        tn_note(c->diagnostics, d, &first->name.span, "the first is here");
        tn_help(c->diagnostics, d, "give one of them another name");
    }
    if (axis_named(own->name.text) >= 0) {
        d = tn_report(c->diagnostics, E_FIELD_MISUSED, own->name.span, "`%s` is a coordinate", own->name.text);
        tn_help(c->diagnostics, d, "give it another name");
    }
    if (tn_function_named(TN_WORDS_FIELD, own->name.text, strlen(own->name.text)) ||
        strcmp(own->name.text, "distance") == 0) {
        d = tn_report(c->diagnostics, W_FIELD_HIDES, own->name.span, "this hides the function `%s`", own->name.text);
        tn_help(c->diagnostics, d, "give it another name");
    }
    for (const tn_field_parameter *p = own->parameters.first; p; p = p->next)
        for (const tn_field_parameter *q = p->next; q; q = q->next)
            if (strcmp(p->name.text, q->name.text) == 0) {
                d = tn_report(c->diagnostics, E_DUPLICATE_NAME, q->name.span, "`%.100s` is a parameter twice",
                              q->name.text);
                tn_note(c->diagnostics, d, &p->name.span, "the first is here");
                tn_help(c->diagnostics, d, "give one of them another name");
            }
    c->here = own;
    c->unit = own->unit;
    check_expression(c, own->body);
}

/* ---- circles */

typedef struct circle {
    check *check;
    uint32_t depth;
} circle;

static tn_field_state follow(circle *c, tn_field_definition *definition);

static tn_field_state follow_expression(circle *c, const tn_expression *e)
{
    tn_field_state worst = TN_FIELD_DONE;
    if (e->op == TN_OPCODE_COUNT && !tn_field_is_at(e)) {
        tn_field_definition *of = c->check->checked->definitions[e->term];
        if (of->state == TN_FIELD_OPEN) {
            tn_diagnostic *d =
                tn_report(c->check->diagnostics, E_FIELD_CIRCLE, e->name_span, "`%.100s` needs itself", of->name.text);
            tn_note(c->check->diagnostics, d, &of->name.span, "it is defined here");
            tn_help(c->check->diagnostics, d, "define it without itself: fields have no recursion");
            return TN_FIELD_WRONG;
        }
        worst = follow(c, of);
    }
    for (const tn_expression *operand = e->first; operand && worst == TN_FIELD_DONE; operand = operand->next)
        worst = follow_expression(c, operand);
    return worst;
}

static tn_field_state follow(circle *c, tn_field_definition *definition)
{
    if (definition->state != TN_FIELD_NEW)
        return definition->state;
    definition->state = TN_FIELD_OPEN;
    if (++c->depth > TN_NESTING_MAX) {
        tn_diagnostic *d =
            tn_report(c->check->diagnostics, E_TOO_DEEP, definition->span,
                      "definitions need one another more than %u deep, which is the limit", TN_NESTING_MAX);
        tn_help(c->check->diagnostics, d, "write fewer of them, with longer expressions");
        definition->state = TN_FIELD_WRONG;
    } else {
        definition->state = follow_expression(c, definition->body);
    }
    c->depth--;
    return definition->state;
}

/* ---- all */

static void gather(check *c)
{
    uint32_t count = 0;
    for (size_t u = 0; u < c->imports->count; u++) {
        const tn_field_file *file = c->imports->units[u]->tree;
        for (tn_field_definition *d = file->first; d; d = d->next)
            count++;
    }
    c->checked->definitions = TN_NEW_ARRAY(c->arena, tn_field_definition *, count + 1);
    for (size_t u = 0; c->checked->definitions && u < c->imports->count; u++) {
        const tn_field_file *file = c->imports->units[u]->tree;
        for (tn_field_definition *d = file->first; d; d = d->next) {
            d->unit = (uint32_t)u;
            c->checked->definitions[c->checked->definition_count++] = d;
        }
        c->checked->file = file;
        c->checked->unit = (uint32_t)u;
    }
}

/* A library of functions need not use what it defines. */
static void warn_of_unused(const check *c)
{
    bool makes = false;
    for (const tn_field_definition *d = c->checked->file->first; d; d = d->next)
        makes = makes || d->kind == TN_FIELD_SURFACE;
    for (const tn_field_definition *d = c->checked->file->first; makes && d; d = d->next) {
        if (d->used || d->kind != TN_FIELD_LET)
            continue;
        tn_diagnostic *w = tn_report(c->diagnostics, W_FIELD_UNUSED, d->name.span, "nothing uses `%s`", d->name.text);
        tn_help(c->diagnostics, w, "leave it out");
    }
}

bool tn_check_field(tn_arena *arena, tn_diagnostics *diagnostics, const tn_imports *imports,
                    const tn_resolver *resolver, tn_checked_fields *checked)
{
    check c = {
        .arena = arena, .diagnostics = diagnostics, .imports = imports, .resolver = resolver, .checked = checked};
    *checked = (tn_checked_fields){0};
    gather(&c);
    if (tn_arena_failed(arena))
        return false;
    for (uint32_t i = 0; i < checked->definition_count; i++)
        check_definition(&c, i);
    c.here = NULL;
    c.unit = checked->unit;
    const tn_field_setting *box = checked->file->settings[TN_FIELD_BOX];
    for (tn_expression *corner = box && box->corners ? box->corners->first : NULL; corner; corner = corner->next)
        for (tn_expression *e = corner->first; e; e = e->next)
            check_expression(&c, e);
    circle circles = {.check = &c};
    for (uint32_t i = 0; i < checked->definition_count && diagnostics->error_count == 0; i++)
        follow(&circles, checked->definitions[i]);
    warn_of_unused(&c);
    return !tn_arena_failed(arena);
}
