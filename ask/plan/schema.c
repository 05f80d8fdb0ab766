/* schema: what a file of rules has. */
#include <stdlib.h>

#include "ask/plan/weights.h"
#include "ask/session/questions.h"
#include "compiler/plan/syntax/program.h"
#include "runtime/house/measure/measure.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/named.h"

typedef struct showing {
    const tn_opened *opened;
    const tn_module *module;
    tn_shown_file *file;
    bool used;
} showing;

static bool is_shown(const showing *s, uint32_t flags)
{
    return s->used || !(flags & TN_IMPORTED);
}

/* What an author says of something, if anything. */
static void set_doc(const showing *s, tn_string doc, bool *has, const char **to)
{
    *to = tn_text(s->module, doc);
    *has = **to != '\0';
}

/* ---- schemas */

static void set_value(const showing *s, const tn_field_record *field, const tn_value_record *from, tn_shown_value *to)
{
    bool measured = field->kind == TN_FIELD_LENGTH || (field->kind == TN_FIELD_ZONE && from->length > 0);
    to->name = tn_text(s->module, from->name);
    to->spelling = tn_text(s->module, from->spelling);
    set_doc(s, from->doc, &to->has_doc, &to->doc);
    to->has_nanometres = measured;
    to->nanometres = from->length;
    to->has_role = from->role != TN_FILL_NONE;
    to->role = tn_names_FILL_ROLE[from->role];
}

static tn_status set_field(const showing *s, const tn_field_record *from, tn_shown_field *to, tn_error *error)
{
    to->name = tn_text(s->module, from->name);
    set_doc(s, from->doc, &to->has_doc, &to->doc);
    to->kind = tn_names_FIELD_KIND[from->kind];
    to->has_role = from->role != TN_ROLE_NONE;
    to->role = tn_names_FIELD_ROLE[from->role];
    to->said_by = tn_text(s->module, from->said_by);
    to->has_said_by = *to->said_by != '\0';
    tn_status status = TN_NEW_LIST(shown_value, to->values, from->value_count, error);
    for (uint32_t i = 0; status == TN_OK && i < from->value_count; i++)
        set_value(s, from, &s->module->VALUE_records[from->value_first + i], &to->values.items[i]);
    return status;
}

/* As its author wrote it, on one line (malloc); NULL: not known, or out of memory. */
static char *source_of(const showing *s, uint32_t file, uint32_t begin, uint32_t end)
{
    const tn_sources *sources = &s->opened->compilation.sources;
    if (file >= sources->count || begin > end || end > sources->files[file].size)
        return NULL;
    const char *text = sources->files[file].text;
    char *line = malloc((size_t)(end - begin) + 1);
    size_t size = 0;
    for (uint32_t i = begin; line && i < end; i++) {
        bool blank = text[i] == ' ' || text[i] == '\n' || text[i] == '\r' || text[i] == '\t';
        if (!blank)
            line[size++] = text[i];
        else if (size > 0 && line[size - 1] != ' ')
            line[size++] = ' ';
    }
    if (line)
        line[size] = '\0';
    return line;
}

static tn_status set_forbidden(const showing *s, const tn_schema_record *from, tn_shown_schema *to, tn_error *error)
{
    const tn_sources *sources = &s->opened->compilation.sources;
    const tn_spec_record *before = NULL;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < from->forbid_count; i++) {
        const tn_spec_record *spec = &s->module->SPEC_records[from->forbid_first + i];
        bool known = spec->file < sources->count && spec->begin < sources->files[spec->file].size;
        bool again = before && before->file == spec->file && before->begin == spec->begin; /* a line may be several */
        before = spec;
        if (!known || again)
            continue;
        char first = sources->files[spec->file].text[spec->begin];
        if (first == 's' || first == 'S') /* `schema ... of LIBRARY`: it stands for no plan */
            continue;
        bool only = first == 'o' || first == 'O';
        uint32_t word = only ? sizeof "only" - 1 : sizeof "forbid" - 1; /* which the stretch begins with */
        status = tn_owneds_add(only ? &to->only : &to->forbidden,
                               source_of(s, spec->file, spec->begin + word, spec->end), error);
    }
    return status;
}

/* ---- trays that stand for plans */

static bool has_bit(const tn_module *module, const tn_spec_record *spec, uint32_t bit)
{
    return (uint64_t)module->MASK_records[spec->mask_first + bit / 64].bits >> (bit % 64) & 1;
}

/* What the trays have in the fields that measures and rules say: "6m corner". */
static char *said_of(const tn_module *module, const tn_schema_record *schema, const tn_spec_record *spec)
{
    const tn_field_record *fields = &module->FIELD_records[schema->field_first];
    tn_buffer text = {0};
    bool good = tn_buffer_append(&text, "", 1);
    text.size = 0;
    for (uint32_t f = 0; f < schema->field_count && good; f++)
        for (uint32_t v = 0; *tn_text(module, fields[f].said_by) && v < fields[f].value_count && good; v++) {
            uint32_t value = fields[f].value_first + v;
            if (has_bit(module, spec, value - fields->value_first))
                good = tn_buffer_printf(&text, "%s%s", text.size ? " " : "",
                                        tn_text(module, module->VALUE_records[value].spelling));
        }
    if (good)
        return text.data;
    free(text.data);
    return NULL;
}

static tn_status set_tray_plans(const showing *s, const tn_schema_record *from, tn_shown_schema *to, tn_error *error)
{
    if (from->of == TN_NO_RECORD)
        return TN_OK;
    to->has_library = to->has_tray_plans = true;
    to->library = tn_text(s->module, s->module->LIBRARY_records[from->of].name);
    tn_status status = TN_NEW_LIST(shown_tray, to->tray_plans, from->tray_plans_count, error);
    for (uint32_t i = 0; status == TN_OK && i < from->tray_plans_count; i++) {
        const tn_tray_plans_record *record = &s->module->TRAY_PLANS_records[from->tray_plans_first + i];
        tn_shown_tray *tray = &to->tray_plans.items[i];
        mpz_set_str(tray->plans, tn_text(s->module, record->plans), 10);
        tray->tray = said_of(s->module, from, &s->module->SPEC_records[record->spec]);
        status = tray->tray ? TN_OK : tn_fail_memory(error);
    }
    return status;
}

static tn_status set_schema(const showing *s, uint32_t index, tn_shown_schema *to, tn_error *error)
{
    const tn_schema_record *from = &s->module->SCHEMA_records[index];
    tn_schema *schema = NULL;
    tn_status status = tn_schema_new(s->module, index, 0, &schema, error);
    if (status != TN_OK)
        return status;
    to->name = tn_text(s->module, from->name);
    set_doc(s, from->doc, &to->has_doc, &to->doc);
    to->trays = schema->tray_count;
    to->combinations = schema->code_count;
    tn_schema_free(schema);
    status = TN_NEW_LIST(shown_field, to->fields, from->field_count, error);
    for (uint32_t i = 0; status == TN_OK && i < from->field_count; i++)
        status = set_field(s, &s->module->FIELD_records[from->field_first + i], &to->fields.items[i], error);
    if (status == TN_OK)
        status = set_forbidden(s, from, to, error);
    return status == TN_OK ? set_tray_plans(s, from, to, error) : status;
}

static tn_status show_schemas(const showing *s, tn_error *error)
{
    uint32_t count = s->module->SCHEMA_count;
    tn_status status = TN_NEW_LIST(shown_schema, s->file->schemas, count, error);
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        status = set_schema(s, i, &s->file->schemas.items[i], error);
    return status;
}

static const char *schema_name(const showing *s, uint32_t schema)
{
    return tn_text(s->module, s->module->SCHEMA_records[schema].name);
}

static const char *form_name(const showing *s, uint32_t form)
{
    return tn_text(s->module, s->module->FORM_records[form].name);
}

/* ---- rules */

/* One of plans has a schema, one of houses a form; the other is NULL. */
static tn_status add_rule(const showing *s, tn_string name, tn_string doc, const char *schema, const char *form,
                          tn_error *error)
{
    tn_shown_rule *to = TN_ADD(shown_rule, s->file->rules, error);
    if (!to)
        return TN_MEMORY;
    to->name = tn_text(s->module, name);
    set_doc(s, doc, &to->has_doc, &to->doc);
    to->has_schema = schema != NULL;
    to->schema = schema;
    to->has_form = form != NULL;
    to->form = form;
    return TN_OK;
}

static tn_status show_rules(const showing *s, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < s->module->RULE_count; i++) {
        const tn_rule_record *from = &s->module->RULE_records[i];
        if (is_shown(s, from->flags))
            status = add_rule(s, from->name, from->doc, schema_name(s, from->schema), NULL, error);
    }
    for (uint32_t i = 0; status == TN_OK && i < s->module->HOUSE_RULE_count; i++) {
        const tn_house_rule_record *from = &s->module->HOUSE_RULE_records[i];
        if (is_shown(s, from->flags))
            status = add_rule(s, from->name, from->doc, NULL, form_name(s, from->form), error);
    }
    return status;
}

/* ---- libraries */

static void set_clause(const showing *s, tn_string name, tn_string doc, uint32_t kind, tn_shown_clause *to)
{
    to->name = tn_text(s->module, name);
    set_doc(s, doc, &to->has_doc, &to->doc);
    to->kind = tn_names_CLAUSE_KIND[kind];
}

static tn_status set_weights(const showing *s, const tn_library_record *from, tn_shown_library *to, tn_error *error)
{
    to->has_weights = from->weight_count > 0;
    tn_status status = TN_NEW_LIST(shown_weight, to->weights, from->weight_count, error);
    for (uint32_t i = 0; status == TN_OK && i < from->weight_count; i++) {
        const tn_weight_record *weight = &s->module->WEIGHT_records[from->weight_first + i];
        to->weights.items[i].name = tn_text(s->module, weight->name);
        mpq_set_str(to->weights.items[i].weight, tn_text(s->module, weight->factor), 10);
        if (!(to->weights.items[i].shown = tn_weight_text(to->weights.items[i].weight)))
            status = tn_fail_memory(error);
    }
    return status;
}

static tn_status set_preferences(const showing *s, const tn_library_record *from, tn_shown_library *to, tn_error *error)
{
    to->has_preferences = from->preference_count > 0;
    tn_status status = TN_NEW_LIST(shown_preference, to->preferences, from->preference_count, error);
    for (uint32_t i = 0; status == TN_OK && i < from->preference_count; i++) {
        const tn_preference_record *preference = &s->module->PREFERENCE_records[from->preference_first + i];
        const tn_sum_record *sum = &s->module->SUM_records[preference->sum];
        tn_shown_preference *shown = &to->preferences.items[i];
        shown->name = tn_text(s->module, preference->name);
        set_doc(s, preference->doc, &shown->has_doc, &shown->doc);
        mpq_set_str(shown->worth, tn_text(s->module, s->module->TERM_records[sum->term_first + i].factor), 10);
        if (!(shown->shown = tn_weight_text(shown->worth)))
            status = tn_fail_memory(error);
    }
    return status == TN_OK ? set_weights(s, from, to, error) : status;
}

static tn_status set_library(const showing *s, const tn_library_record *from, tn_shown_library *to, tn_error *error)
{
    to->name = tn_text(s->module, from->name);
    set_doc(s, from->doc, &to->has_doc, &to->doc);
    to->has_schema = to->has_trays = true;
    to->schema = schema_name(s, from->schema);
    to->trays = (tn_tray_bounds){from->trays_min, from->trays_max};
    tn_status status = TN_NEW_LIST(shown_clause, to->clauses, from->clause_count, error);
    for (uint32_t i = 0; status == TN_OK && i < from->clause_count; i++) {
        const tn_clause_record *clause = &s->module->CLAUSE_records[from->clause_first + i];
        set_clause(s, clause->name, clause->doc, clause->kind, &to->clauses.items[i]);
    }
    return status == TN_OK ? set_preferences(s, from, to, error) : status;
}

static tn_status set_house_library(const showing *s, const tn_house_library_record *from, tn_shown_library *to,
                                   tn_error *error)
{
    to->name = tn_text(s->module, from->name);
    set_doc(s, from->doc, &to->has_doc, &to->doc);
    to->has_plans = to->has_form = true;
    to->plans = tn_text(s->module, s->module->LIBRARY_records[from->plans].name);
    to->form = form_name(s, from->form);
    tn_status status = TN_NEW_LIST(shown_clause, to->clauses, from->clause_count, error);
    for (uint32_t i = 0; status == TN_OK && i < from->clause_count; i++) {
        const tn_house_clause_record *clause = &s->module->HOUSE_CLAUSE_records[from->clause_first + i];
        set_clause(s, clause->name, clause->doc, clause->kind, &to->clauses.items[i]);
    }
    return status;
}

static tn_status show_libraries(const showing *s, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < s->module->LIBRARY_count; i++) {
        const tn_library_record *from = &s->module->LIBRARY_records[i];
        if (!is_shown(s, from->flags))
            continue;
        tn_shown_library *to = TN_ADD(shown_library, s->file->libraries, error);
        status = to ? set_library(s, from, to, error) : TN_MEMORY;
    }
    for (uint32_t i = 0; status == TN_OK && i < s->module->HOUSE_LIBRARY_count; i++) {
        const tn_house_library_record *from = &s->module->HOUSE_LIBRARY_records[i];
        if (!is_shown(s, from->flags))
            continue;
        tn_shown_library *to = TN_ADD(shown_library, s->file->libraries, error);
        status = to ? set_house_library(s, from, to, error) : TN_MEMORY;
    }
    return status;
}

/* ---- measures */

/* What the values are in: the lengths of the schema decide. */
typedef struct valued {
    uint32_t schema;
    int power; /* of a length */
} valued;

static tn_status set_unit(const showing *s, valued of, tn_shown_measure *to, tn_error *error)
{
    tn_schema *made = NULL;
    tn_status status = tn_schema_new(s->module, of.schema, 0, &made, error);
    if (status == TN_OK)
        to->unit = tn_amount_unit_name(tn_amount_unit_of(made, of.power));
    tn_schema_free(made);
    return status;
}

/* As add_rule. */
static tn_status add_measure(const showing *s, tn_string name, tn_string doc, const char *schema, const char *form,
                             valued of, tn_error *error)
{
    tn_shown_measure *to = TN_ADD(shown_measure, s->file->measures, error);
    if (!to)
        return TN_MEMORY;
    to->name = tn_text(s->module, name);
    set_doc(s, doc, &to->has_doc, &to->doc);
    to->has_schema = schema != NULL;
    to->schema = schema;
    to->has_form = form != NULL;
    to->form = form;
    return set_unit(s, of, to, error);
}

static tn_status show_measures(const showing *s, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < s->module->MEASURE_count; i++) {
        const tn_measure_record *from = &s->module->MEASURE_records[i];
        if (is_shown(s, from->flags))
            status = add_measure(s, from->name, from->doc, schema_name(s, from->schema), NULL,
                                 (valued){from->schema, tn_named_measure_power(s->module, i)}, error);
    }
    for (uint32_t i = 0; status == TN_OK && i < s->module->HOUSE_MEASURE_count; i++) {
        const tn_house_measure_record *from = &s->module->HOUSE_MEASURE_records[i];
        uint32_t schema = s->module->FORM_records[from->form].schema;
        if (is_shown(s, from->flags))
            status = add_measure(s, from->name, from->doc, NULL, form_name(s, from->form),
                                 (valued){schema, (int)s->module->SUM_records[from->sum].power}, error);
    }
    return status;
}

/* ---- params */

static tn_status set_param(const tn_program_param *from, tn_shown_param *to, tn_error *error)
{
    to->name = from->name;
    to->has_doc = from->doc != NULL;
    to->doc = from->doc;
    to->value = from->value;
    to->has_least = to->has_most = from->least != NULL;
    to->least = from->least;
    to->most = from->most;
    to->has_words = from->word_count > 0;
    to->words.items = calloc(from->word_count + 1, sizeof *to->words.items);
    if (!to->words.items)
        return tn_fail_memory(error);
    for (size_t i = 0; i < from->word_count; i++)
        to->words.items[to->words.count++] = from->words[i];
    return TN_OK;
}

static tn_status show_params(const showing *s, tn_error *error)
{
    const tn_program *program = s->opened->compilation.program;
    tn_status status = TN_OK;
    for (size_t i = 0; program && status == TN_OK && i < program->param_count; i++) {
        if (program->params[i].imported && !s->used)
            continue;
        tn_shown_param *to = TN_ADD(shown_param, s->file->params, error);
        s->file->has_params = true;
        status = to ? set_param(&program->params[i], to, error) : TN_MEMORY;
    }
    return status;
}

/* ---- asked */

tn_status tn_ask_schema(tn_session *session, const tn_schema_request *request, tn_reply *answer)
{
    const tn_module *module = session->opened->module;
    tn_error error;
    *answer = (tn_reply){0};
    if (module->SCHEMA_count == 0)
        return tn_session_refuse(session, NULL, "%.200s has no schema: only rules about plans have one",
                                 session->opened->path);
    tn_status status = tn_reply_new(&tn_message_shown_file, answer, &error);
    const showing s = {session->opened, module, answer->value, request->used};
    if (status == TN_OK)
        status = show_schemas(&s, &error);
    if (status == TN_OK)
        status = show_rules(&s, &error);
    if (status == TN_OK)
        status = show_libraries(&s, &error);
    if (status == TN_OK)
        status = show_measures(&s, &error);
    if (status == TN_OK)
        status = show_params(&s, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}
