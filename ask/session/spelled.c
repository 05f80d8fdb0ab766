/* Reads plans as people write them. */
#include "ask/session/spelled.h"

#include <stdlib.h>
#include <string.h>

#include "compiler/plan/syntax/program.h"
#include "driver/open/digits.h"
#include "runtime/base/array.h"
#include "runtime/plan/match/vm.h"
#include "runtime/plan/schema/value.h"

/* What is read, and what it is read for. */
typedef struct reader {
    tn_session *session;
    const tn_schema *schema;
    const char *text, *name;
} reader;

static tn_diagnostics *said(const reader *r)
{
    return &r->session->opened->compilation.diagnostics;
}

static tn_status out_of_memory(const reader *r)
{
    tn_error error;
    tn_fail_memory(&error);
    return tn_session_fail(r->session, &error);
}

/* ---- the file once more, with the plan */

/* The file that the session has was compiled of its first source. TN_INVALID: something is wrong with the plan. All
 * else that can happen is said. */
static tn_status compile(const reader *r, const tn_questions *questions, tn_opened *opened)
{
    const tn_source *main = &r->session->opened->compilation.sources.files[0];
    return tn_session_open_text(r->session, main->text, main->size, questions, opened);
}

static const char *schema_name(const reader *r)
{
    return tn_text(r->schema->module, r->schema->record->name);
}

static tn_status compile_pattern(const reader *r, const char *pattern, tn_opened *opened)
{
    const tn_questions questions = {.schema = schema_name(r), .pattern = pattern, .plan_name = r->name};
    return compile(r, &questions, opened);
}

static tn_status compile_literal(const reader *r, const char *literal, tn_opened *opened)
{
    const tn_questions questions = {.schema = schema_name(r), .plan = literal, .plan_name = r->name};
    return compile(r, &questions, opened);
}

static void move_span(tn_span *span, uint32_t from, uint32_t to)
{
    span->file = span->file == from ? to : span->file;
}

/* Says what is wrong with the text, which is the last source of what could not be opened; the others are, in their
 * order, the first of the session's. */
static tn_status say_errors(const reader *r, tn_opened *opened)
{
    tn_compilation *to = &r->session->opened->compilation;
    tn_diagnostics *list = &opened->compilation.diagnostics;
    uint32_t own = (uint32_t)opened->compilation.sources.count - 1, file;
    const tn_source *source = &opened->compilation.sources.files[own];
    tn_error error;
    if (tn_sources_add(&to->sources, source->path, source->text, source->size, &file, &error) != TN_OK)
        return tn_session_fail(r->session, &error);
    tn_diagnostics_keep_errors(list);
    for (size_t i = 0; i < list->count; i++) {
        tn_diagnostic *item = &list->items[i];
        move_span(&item->span, own, file);
        for (size_t n = 0; n < item->note_count; n++)
            move_span(&item->notes[n].span, own, file);
    }
    tn_diagnostics_move(list, &to->diagnostics, 0);
    return TN_INVALID;
}

/* ---- one plan in brackets */

static tn_status take_literal(const reader *r, const tn_opened *opened, size_t max_length, tn_spelled *spelled)
{
    const tn_program *program = opened->compilation.program;
    size_t length = program->plan_length;
    if (length > max_length) {
        tn_error error;
        tn_fail(&error, TN_LIMIT, E_PLAN_TOO_LONG, "the plan has more trays than the limit of %zu", max_length);
        tn_error_help(&error, "--max-length raises the limit");
        return tn_session_fail(r->session, &error);
    }
    spelled->plan = (tn_plan){.trays = malloc((length + 1) * sizeof(tn_tray)), .length = length, .capacity = length};
    if (!spelled->plan.trays)
        return out_of_memory(r);
    for (size_t i = 0; i < length; i++)
        spelled->plan.trays[i] = tn_schema_tray(r->schema, program->plan + i * r->schema->field_count);
    spelled->one = spelled->in_brackets = true;
    return TN_OK;
}

/* ---- open plans */

static tn_status judge_part(const reader *r, tn_plan_vm *vm, tn_tray tray, tn_spelled *spelled, tn_error *error)
{
    tn_status status = tn_plan_vm_plan(vm, &tray, 1, error);
    for (size_t i = 0; status == TN_OK && i < spelled->count; i++)
        if (spelled->functions[i] != TN_NO_RECORD)
            status = tn_plan_vm_relation(vm, spelled->functions[i], 0, 1,
                                         &spelled->fits[i * r->schema->tray_count + tray], error);
    return status;
}

static tn_status judge_parts(const reader *r, tn_spelled *spelled, tn_error *error)
{
    tn_plan_vm *vm = NULL;
    tn_status status = tn_schema_listed(r->schema, "an open plan goes", error);
    if (status != TN_OK)
        return status;
    spelled->fits = calloc(tn_size_of(spelled->count, r->schema->tray_count) + 1, sizeof *spelled->fits);
    if (!spelled->fits)
        return tn_fail_memory(error);
    status = tn_plan_vm_new(spelled->schema, 1, &vm, error);
    for (tn_tray tray = 0; status == TN_OK && tray < r->schema->tray_count; tray++)
        status = judge_part(r, vm, tray, spelled, error);
    tn_plan_vm_free(vm);
    return status;
}

static tn_status find_schema(const reader *r, tn_spelled *spelled, tn_error *error)
{
    const tn_module *module = spelled->opened.module;
    for (uint32_t i = 0; i < module->SCHEMA_count; i++)
        if (strcmp(tn_text(module, module->SCHEMA_records[i].name), schema_name(r)) == 0)
            return tn_schema_new(module, i, 0, &spelled->schema, error);
    return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "the schema of a plan is not found again");
}

/* Of `opened` in what is read, whose pattern has its functions. */
static tn_status take_pattern(const reader *r, tn_spelled *spelled)
{
    const tn_program *program = spelled->opened.compilation.program;
    tn_error error;
    spelled->count = program->pattern_count;
    spelled->functions = program->pattern;
    tn_status status = find_schema(r, spelled, &error);
    if (status == TN_OK)
        status = judge_parts(r, spelled, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(r->session, &error);
}

/* ---- which spelling it is */

/* What is behind the blanks and the word `plan`; *named: it stands there. */
static const char *behind_plan(const char *text, bool *named)
{
    text += strspn(text, " \t");
    *named = strncmp(text, "plan", 4) == 0 && text[4 + strspn(text + 4, " \t")] == '[';
    return *named ? text + 4 + strspn(text + 4, " \t") : text;
}

/* The text with blanks for the brackets and what is before them, so that places in it stay (malloc). */
static char *without_brackets(const char *text)
{
    bool named;
    char *bare = strdup(text), *last = bare ? strrchr(bare, ']') : NULL;
    if (!bare)
        return NULL;
    memset(bare, ' ', (size_t)(behind_plan(text, &named) - text) + 1);
    if (last && last[1 + strspn(last + 1, " \t\r\n")] == '\0')
        *last = ' ';
    return bare;
}

/* Does it have what only an open plan has? */
static bool looks_open(const char *text)
{
    return strchr(text, '?') || strstr(text, "...") || strstr(text, "tray(") || strstr(text, "plan [");
}

/* Does it have what only a plan line has: `-` for a flag, or a fill and its depth? */
static bool looks_like_line(const char *text)
{
    for (const char *at = text; *at; at++) {
        bool alone = (at == text || strchr(" |", at[-1])) && (!at[1] || strchr(" |", at[1]));
        if ((*at == '-' && alone) || *at == ':')
            return true;
    }
    return false;
}

/* ---- read */

static bool is_json(const char *text)
{
    return text[strspn(text, " ")] == '{';
}

/* A line or JSON. TN_INVALID, with the error, where it is none. */
static tn_status read_as_line(const reader *r, size_t max_length, tn_plan *plan, tn_error *error)
{
    size_t size = strlen(r->text);
    return is_json(r->text) ? tn_plan_parse_json(r->schema, r->text, size, max_length, plan, error)
                            : tn_plan_parse_line(r->schema, r->text, size, max_length, plan, error);
}

static tn_status say_line(const reader *r, tn_error *error)
{
    tn_error_place(error, 1, error->column, error->column_end);
    tn_report_error(said(r), error, r->name, r->text, strlen(r->text));
    return error->status;
}

static tn_status refuse_module(const reader *r)
{
    tn_diagnostic *d = tn_report_bare(said(r), TN_ERROR, E_PLAN_SYNTAX,
                                      "%s is a module: it reads plan lines, and neither open plans nor brackets",
                                      r->session->opened->path);
    tn_help(said(r), d, "name the rule file that it was built from, or write every value of each tray");
    return TN_INVALID;
}

/* Is there a part in which no tray can stand? */
static bool is_void(const reader *r, const tn_spelled *w)
{
    for (size_t i = 0; i < w->count; i++) {
        const bool *fits = w->fits + i * r->schema->tray_count;
        if (w->functions[i] != TN_NO_RECORD && !memchr(fits, true, r->schema->tray_count * sizeof *fits))
            return true;
    }
    return false;
}

/* In brackets: one plan if it can be, else an open one. */
static tn_status read_brackets(const reader *r, const char *literal, bool named, size_t max_length, tn_spelled *spelled)
{
    tn_opened first = {0};
    char *bare = without_brackets(r->text);
    if (!bare)
        return out_of_memory(r);
    tn_status status = named ? TN_INVALID : compile_literal(r, literal, &first);
    if (status == TN_OK) {
        status = take_literal(r, &first, max_length, spelled);
    } else if (status == TN_INVALID) {
        bool open = named || looks_open(r->text), closed = strchr(literal, ']') != NULL;
        status = open || closed ? compile_pattern(r, bare, &spelled->opened) : TN_INVALID;
        if (status == TN_OK)
            status = take_pattern(r, spelled);
        if (status == TN_INVALID || (status == TN_OK && !open && is_void(r, spelled)))
            status = say_errors(r, open ? &spelled->opened : &first);
    }
    tn_close(&first);
    free(bare);
    return status;
}

/* As a line it has an error: it is an open plan if it can be. */
static tn_status read_open(const reader *r, tn_error *line, bool open_first, tn_spelled *spelled)
{
    tn_status status = compile_pattern(r, r->text, &spelled->opened);
    bool open = looks_open(r->text) || strchr(r->text, ']') || (open_first && !looks_like_line(r->text));
    if (status == TN_OK)
        status = take_pattern(r, spelled);
    if (status == TN_INVALID && open)
        return say_errors(r, &spelled->opened);
    return status == TN_INVALID || (status == TN_OK && !open && is_void(r, spelled)) ? say_line(r, line) : status;
}

static tn_status read(const reader *r, size_t max_length, bool open_first, tn_spelled *spelled)
{
    bool named;
    tn_error error;
    const char *bare = behind_plan(r->text, &named);
    tn_status status = read_as_line(r, max_length, &spelled->plan, &error);
    spelled->one = status == TN_OK;
    if (status == TN_OK)
        return TN_OK;
    if (status != TN_INVALID || is_json(r->text))
        return say_line(r, &error);
    if (!r->session->opened->compiled)
        return *bare == '[' || looks_open(r->text) || open_first ? refuse_module(r) : say_line(r, &error);
    return *bare == '[' ? read_brackets(r, bare, named, max_length, spelled)
                        : read_open(r, &error, open_first, spelled);
}

tn_status tn_spelled_read(tn_session *session, const tn_schema *schema, const char *text, const char *name,
                          size_t max_length, bool open_first, tn_spelled *spelled)
{
    const reader r = {session, schema, text, name};
    *spelled = (tn_spelled){0};
    return read(&r, max_length, open_first, spelled);
}

void tn_spelled_clear(tn_spelled *spelled)
{
    tn_schema_free(spelled->schema);
    tn_close(&spelled->opened);
    free(spelled->fits);
    free(spelled->plan.trays);
    *spelled = (tn_spelled){0};
}

/* ---- one plan as an open plan */

/* The values of a tray, each behind its field's name. */
static void write_tray(const tn_schema *schema, tn_tray tray, tn_buffer *out)
{
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const tn_value_record *value = tn_tray_value_record(schema, tray, f);
        const char *field = tn_text(schema->module, schema->fields[f].name), *spelling;
        tn_buffer_printf(out, f ? ", " : "");
        if (schema->fields[f].kind == TN_FIELD_FLAG) {
            tn_buffer_printf(out, "%s%s", tn_tray_value(schema, tray, f) ? "" : "not ", field);
            continue;
        }
        tn_buffer_printf(out, "%s ", field);
        for (spelling = tn_text(schema->module, value->spelling); *spelling; spelling++)
            tn_buffer_append(out, *spelling == ':' ? " " : spelling, 1);
    }
}

tn_status tn_spelled_open(tn_session *session, const tn_schema *schema, const char *name, tn_spelled *spelled)
{
    const reader r = {session, schema, "", name};
    tn_buffer text = {0};
    if (!spelled->one || spelled->plan.length == 0)
        return TN_OK;
    for (size_t i = 0; i < spelled->plan.length; i++) {
        tn_buffer_printf(&text, i ? " | " : "");
        write_tray(schema, spelled->plan.trays[i], &text);
    }
    tn_status status = text.failed ? out_of_memory(&r) : compile_pattern(&r, text.data, &spelled->opened);
    free(text.data);
    if (status == TN_OK)
        return take_pattern(&r, spelled);
    return status == TN_INVALID ? say_errors(&r, &spelled->opened) : status;
}

/* ---- an open plan where one plan is wanted */

static const bool *fits_of(const tn_spelled *w, const tn_schema *schema, size_t part)
{
    return w->fits + part * schema->tray_count;
}

/* The first tray from `from` on that fits, or TN_NO_TRAY. */
static tn_tray next_fit(const tn_spelled *w, const tn_schema *schema, size_t part, tn_tray from)
{
    const bool *fits = fits_of(w, schema, part);
    for (tn_tray tray = from; tray < schema->tray_count; tray++)
        if (fits[tray])
            return tray;
    return TN_NO_TRAY;
}

/* The first plan, by number of trays and then tray by tray: the gaps are empty. TN_INVALID, and said, if no tray fits
 * somewhere. */
static tn_status find_first(const reader *r, const tn_spelled *w, tn_plan *plan)
{
    *plan = (tn_plan){.trays = malloc((w->count + 1) * sizeof(tn_tray))};
    if (!plan->trays)
        return out_of_memory(r);
    for (size_t i = 0; i < w->count; i++) {
        if (w->functions[i] == TN_NO_RECORD)
            continue;
        tn_tray tray = next_fit(w, r->schema, i, 0);
        if (tray == TN_NO_TRAY) {
            tn_error error;
            tn_fail(&error, TN_INVALID, E_PLAN_FORBIDDEN, "no tray of schema `%.60s` is as tray %zu is written",
                    schema_name(r), plan->length + 1);
            tn_error_help(&error, "`tartan schema` lists the values of each field, and what is forbidden");
            tn_error_place(&error, 0, 1, strlen(r->text) + 1);
            return say_line(r, &error);
        }
        plan->trays[plan->length++] = tray;
    }
    return TN_OK;
}

/* Is plan `a` before plan `b` of as many trays? */
static bool is_before(const tn_tray *a, const tn_tray *b, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (a[i] != b[i])
            return a[i] < b[i];
    return false;
}

/* The first plan with one tray more, which stands in a gap: of all gaps the one that makes it first. */
static void add_tray(const tn_spelled *w, const tn_plan *first, tn_tray *trays, tn_tray *tried)
{
    size_t at = 0;
    bool any = false;
    for (size_t i = 0; i < w->count; i++) {
        if (w->functions[i] != TN_NO_RECORD) {
            at++;
            continue;
        }
        memcpy(tried, first->trays, at * sizeof *tried);
        tried[at] = 0;
        memcpy(tried + at + 1, first->trays + at, (first->length - at) * sizeof *tried);
        if (!any || is_before(tried, trays, first->length + 1))
            memcpy(trays, tried, (first->length + 1) * sizeof *trays);
        any = true;
    }
}

/* The plan after the first one, of those with as many trays: false if there is none. */
static bool find_next(const tn_spelled *w, const tn_schema *schema, const tn_plan *first, tn_tray *trays)
{
    size_t at = first->length;
    memcpy(trays, first->trays, first->length * sizeof *trays);
    for (size_t i = w->count; i-- > 0;) {
        if (w->functions[i] == TN_NO_RECORD)
            continue;
        tn_tray next = next_fit(w, schema, i, first->trays[--at] + 1);
        if (next == TN_NO_TRAY)
            continue;
        trays[at] = next;
        return true;
    }
    return false;
}

static bool has_gap(const tn_spelled *w)
{
    for (size_t i = 0; i < w->count; i++)
        if (w->functions[i] == TN_NO_RECORD)
            return true;
    return false;
}

static void count_plans(const tn_spelled *w, const tn_schema *schema, mpz_t plans)
{
    mpz_set_ui(plans, 1);
    for (size_t i = 0; i < w->count; i++) {
        uint64_t fit = 0;
        for (tn_tray tray = 0; tray < schema->tray_count; tray++)
            fit += fits_of(w, schema, i)[tray];
        mpz_mul_ui(plans, plans, fit);
    }
}

/* The same text in brackets, if it is a plan so (malloc). */
static char *in_brackets(const reader *r)
{
    tn_buffer text = {0};
    tn_opened opened = {0};
    bool named;
    tn_buffer_printf(&text, "[%s]", r->text);
    bool plan = !text.failed && *behind_plan(r->text, &named) != '[' && compile_literal(r, text.data, &opened) == TN_OK;
    tn_close(&opened);
    if (plan)
        return text.data;
    free(text.data);
    return NULL;
}

static void note_plan(const reader *r, tn_diagnostic *d, const char *which, const tn_tray *trays, size_t length)
{
    tn_buffer line = {0};
    if (tn_plan_write_line(r->schema, trays, length, &line))
        tn_note(said(r), d, NULL, "the %s is: %s", which, line.size ? line.data : "the plan of no trays");
    free(line.data);
}

static void help_several(const reader *r, tn_diagnostic *d)
{
    char fields[200];
    char *literal = in_brackets(r);
    if (literal)
        tn_help(said(r), d,
                "`%s` is one plan: what is left out has the schema's first value; `tartan complete` answers about all "
                "of them",
                literal);
    else
        tn_help(said(r), d, "write a value for each field (%s); `tartan complete` answers about all of them",
                tn_value_fields(r->schema, fields, sizeof fields));
    free(literal);
}

/* second: of so many trays. */
static tn_status say_several(const reader *r, const tn_spelled *w, const tn_plan *first, const tn_tray *second,
                             size_t length)
{
    tn_error error;
    mpz_t plans;
    mpz_init(plans);
    count_plans(w, r->schema, plans);
    char *digits = tn_digits(plans, true);
    mpz_clear(plans);
    if (!digits)
        return out_of_memory(r);
    if (has_gap(w))
        tn_fail(&error, TN_INVALID, E_PLAN_SEVERAL,
                "this open plan stands for plans of any number of trays, and one is wanted");
    else
        tn_fail(&error, TN_INVALID, E_PLAN_SEVERAL,
                "this open plan stands for %.120s plans of schema `%.60s`, and one is wanted", digits, schema_name(r));
    free(digits);
    tn_error_place(&error, 1, 1, strlen(r->text) + 1);
    tn_diagnostic *d = tn_report_error(said(r), &error, r->name, r->text, strlen(r->text));
    note_plan(r, d, "first", first->trays, first->length);
    note_plan(r, d, "second", second, length);
    help_several(r, d);
    return TN_INVALID;
}

/* `second` and `tried` have room for a tray more than `first` has. */
static tn_status settle(const reader *r, const tn_spelled *w, const tn_plan *first, tn_tray *second, tn_tray *tried)
{
    if (find_next(w, r->schema, first, second))
        return say_several(r, w, first, second, first->length);
    if (!has_gap(w))
        return TN_OK;
    add_tray(w, first, second, tried);
    return say_several(r, w, first, second, first->length + 1);
}

tn_status tn_spelled_settle(tn_session *session, const tn_schema *schema, const char *text, const char *name,
                            tn_spelled *spelled)
{
    const reader r = {session, schema, text, name};
    if (spelled->one)
        return TN_OK;
    tn_plan first;
    tn_status status = find_first(&r, spelled, &first);
    tn_tray *others = calloc(2 * (spelled->count + 2), sizeof *others);
    if (status == TN_OK && !others)
        status = out_of_memory(&r);
    if (status == TN_OK)
        status = settle(&r, spelled, &first, others, others + spelled->count + 2);
    free(others);
    free(spelled->plan.trays);
    spelled->plan = first;
    spelled->one = status == TN_OK;
    return status;
}

tn_status tn_session_plan(tn_session *session, const tn_schema *schema, const char *text, size_t max_length,
                          tn_plan *plan)
{
    tn_spelled spelled;
    tn_status status = tn_spelled_read(session, schema, text, "PLAN", max_length, false, &spelled);
    if (status == TN_OK)
        status = tn_spelled_settle(session, schema, text, "PLAN", &spelled);
    *plan = spelled.plan;
    spelled.plan = (tn_plan){0};
    tn_spelled_clear(&spelled);
    return status;
}
