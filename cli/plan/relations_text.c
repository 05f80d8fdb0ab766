/* Prints how each two rules relate. */
#include "cli/plan/relations.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/plan/text/text.h"

/* How a relation is written: the sign in the matrix, a word, and what it means of rules, and of clauses about houses.
 */
typedef struct sign {
    char letter;
    const char *word, *meaning, *of_houses;
} sign;

static const sign signs[] = {
    [TN_RULES_UNKNOWN] = {'?', "unknown", "not analysed", "not found out"},
    [TN_RULES_EQUAL] = {'=', "equal", "the same plans", "the same houses"},
    [TN_RULES_APART] = {'/', "apart", "no plan in common", "no house in common"},
    [TN_RULES_INSIDE] = {'<', "inside", "the column's rule matches all that the row's does",
                         "the column's clause matches all that the row's does"},
    [TN_RULES_CONTAINS] = {'>', "contains", "the row's rule matches all that the column's does",
                           "the row's clause matches all that the column's does"},
    [TN_RULES_OVERLAP] = {'x', "overlap", "some plans in common", "some houses in common"},
};

static const char *const pair_keys[TN_RELATED_KINDS] = {"both", "only_a", "only_b"};

static const char *rule_name(const tn_plan_analyses *analyses, size_t a, size_t i)
{
    const tn_module *module = analyses->schemas[a]->module;
    return tn_text(module, module->RULE_records[tn_plan_analysis_rule(analyses->items[a], i)].name);
}

/* What is related: rules about plans, or clauses about houses. */
typedef struct related {
    const char **names;
    tn_rule_relation *relations; /* [count][count] */
    size_t count;
    bool houses;
} related;

static int name_width(const related *r)
{
    int width = 0;
    for (size_t i = 0; i < r->count; i++) {
        int length = (int)strlen(r->names[i]);
        width = length > width ? length : width;
    }
    return width;
}

/* Each has a number, which heads its column. */
static void write_matrix(const related *r, FILE *out)
{
    int width = name_width(r), digits = snprintf(NULL, 0, "%zu", r->count);
    size_t cells[sizeof signs / sizeof *signs] = {0};
    fprintf(out, "%*s", digits + 1 + width, "");
    for (size_t j = 0; j < r->count; j++)
        fprintf(out, " %*zu", digits, j + 1);
    fputc('\n', out);
    for (size_t i = 0; i < r->count; i++) {
        fprintf(out, "%*zu %-*s", digits, i + 1, width, r->names[i]);
        for (size_t j = 0; j < r->count; j++) {
            tn_rule_relation relation = r->relations[i * r->count + j];
            cells[relation] += i != j;
            fprintf(out, " %*c", digits, i == j ? '.' : signs[relation].letter);
        }
        fputc('\n', out);
    }
    for (size_t s = 0; s < sizeof signs / sizeof *signs; s++)
        if (cells[s]) /* inside and contains are one relation seen from both */
            fprintf(out, "%c %s: %s (%zu)\n", signs[s].letter, signs[s].word,
                    r->houses ? signs[s].of_houses : signs[s].meaning,
                    s == TN_RULES_INSIDE || s == TN_RULES_CONTAINS ? cells[s] : cells[s] / 2);
}

static tn_status write_rules(const tn_plan_analyses *analyses, size_t a, FILE *out, tn_error *error)
{
    size_t count = tn_plan_analysis_rule_count(analyses->items[a]);
    related r = {.names = malloc((count + 1) * sizeof *r.names),
                 .relations = malloc((count * count + 1) * sizeof *r.relations),
                 .count = count};
    bool made = r.names && r.relations;
    for (size_t i = 0; made && i < count; i++) {
        r.names[i] = rule_name(analyses, a, i);
        for (size_t j = 0; j < count; j++)
            r.relations[i * count + j] = i == j ? TN_RULES_EQUAL : tn_plan_analysis_relation(analyses->items[a], i, j);
    }
    if (made)
        write_matrix(&r, out);
    free(r.names);
    free(r.relations);
    return made ? TN_OK : tn_fail_memory(error);
}

static tn_status write_example(const tn_schema *schema, const char *who, const tn_shown_plan *plan, FILE *out,
                               tn_error *error)
{
    if (!plan->shown)
        return TN_OK;
    tn_buffer line = {0};
    bool ok = tn_plan_write_line(schema, plan->trays, plan->length, &line);
    if (ok)
        fprintf(out, "  %s: %s\n", who, line.data ? line.data : "");
    free(line.data);
    return ok ? TN_OK : tn_fail_memory(error);
}

static tn_status write_pair(const tn_plan_analyses *analyses, size_t a, size_t i, size_t j, FILE *out, tn_error *error)
{
    tn_shown_plan examples[3];
    char only[2][TN_NAME_MAX + 8];
    snprintf(only[0], sizeof only[0], "only %s", rule_name(analyses, a, i));
    snprintf(only[1], sizeof only[1], "only %s", rule_name(analyses, a, j));
    const char *who[3] = {"both", only[0], only[1]};
    tn_status status = tn_plan_analysis_examples(analyses->items[a], i, j, examples, error);
    fprintf(out, "\n%s, %s: %s\n", rule_name(analyses, a, i), rule_name(analyses, a, j),
            signs[tn_plan_analysis_relation(analyses->items[a], i, j)].word);
    for (int e = 0; e < 3; e++) {
        if (status == TN_OK)
            status = write_example(analyses->schemas[a], who[e], &examples[e], out, error);
        tn_shown_plan_clear(&examples[e]);
    }
    return status;
}

static tn_status write_plans(const tn_plan_analyses *analyses, const tn_relations_options *options, FILE *out,
                             tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t a = 0; status == TN_OK && a < analyses->count; a++) {
        size_t count = tn_plan_analysis_rule_count(analyses->items[a]);
        if (count == 0)
            continue;
        if (analyses->count > 1)
            fprintf(out, "%s%s\n", a ? "\n" : "",
                    tn_text(analyses->schemas[a]->module, analyses->schemas[a]->record->name));
        status = write_rules(analyses, a, out, error);
        for (size_t i = 0; options->examples && i < count; i++)
            for (size_t j = i + 1; status == TN_OK && j < count; j++)
                status = write_pair(analyses, a, i, j, out, error);
    }
    return status;
}

/* ---- houses */

static void write_house_pair(const tn_related_houses *houses, size_t i, size_t j, FILE *out)
{
    char *const *examples = &houses->examples[(i * houses->count + j) * TN_RELATED_KINDS];
    fprintf(out, "\n%s, %s: %s\n", houses->names[i], houses->names[j],
            signs[houses->relations[i * houses->count + j]].word);
    if (examples[TN_RELATED_BOTH])
        fprintf(out, "  both: %s\n", examples[TN_RELATED_BOTH]);
    if (examples[TN_RELATED_ONLY_A])
        fprintf(out, "  only %s: %s\n", houses->names[i], examples[TN_RELATED_ONLY_A]);
    if (examples[TN_RELATED_ONLY_B])
        fprintf(out, "  only %s: %s\n", houses->names[j], examples[TN_RELATED_ONLY_B]);
}

static void write_houses(const tn_related_houses *houses, const tn_relations_options *options, FILE *out)
{
    const related r = {houses->names, houses->relations, houses->count, true};
    fprintf(out, "houses that the clauses of %s match\n", houses->library);
    write_matrix(&r, out);
    for (size_t i = 0; options->examples && i < houses->count; i++)
        for (size_t j = i + 1; j < houses->count; j++)
            write_house_pair(houses, i, j, out);
}

static void house_pair_json(const tn_related_houses *houses, size_t i, size_t j, bool examples, tn_json *json)
{
    char *const *found = &houses->examples[(i * houses->count + j) * TN_RELATED_KINDS];
    tn_json_object(json, NULL);
    tn_json_string(json, "a", houses->names[i]);
    tn_json_string(json, "b", houses->names[j]);
    tn_json_string(json, "relation", signs[houses->relations[i * houses->count + j]].word);
    for (int kind = 0; examples && kind < TN_RELATED_KINDS; kind++)
        tn_json_string(json, pair_keys[kind], found[kind]);
    tn_json_object_end(json);
}

static void houses_json(const tn_related_houses *houses, bool examples, tn_json *json)
{
    tn_json_object(json, NULL);
    tn_json_string(json, "library", houses->library);
    tn_json_list(json, "clauses");
    for (size_t i = 0; i < houses->count; i++)
        tn_json_string(json, NULL, houses->names[i]);
    tn_json_list_end(json);
    tn_json_list(json, "relations");
    for (size_t i = 0; i < houses->count; i++)
        for (size_t j = i + 1; j < houses->count; j++)
            house_pair_json(houses, i, j, examples, json);
    tn_json_list_end(json);
    tn_json_object_end(json);
}

/* ---- JSON of plans */

/* null where there is no such plan. */
static void plan_json(const char *key, const tn_schema *schema, const tn_shown_plan *plan, tn_json *json)
{
    tn_buffer line = {0};
    if (plan->shown && !tn_plan_write_line(schema, plan->trays, plan->length, &line))
        json->text->failed = true;
    tn_json_string(json, key, !plan->shown ? NULL : line.data ? line.data : "");
    free(line.data);
}

static tn_status pair_json(const tn_plan_analyses *analyses, size_t a, size_t i, size_t j, bool examples, tn_json *json,
                           tn_error *error)
{
    tn_status status = TN_OK;
    tn_json_object(json, NULL);
    tn_json_string(json, "a", rule_name(analyses, a, i));
    tn_json_string(json, "b", rule_name(analyses, a, j));
    tn_json_string(json, "relation", signs[tn_plan_analysis_relation(analyses->items[a], i, j)].word);
    if (examples) {
        tn_shown_plan plans[3];
        status = tn_plan_analysis_examples(analyses->items[a], i, j, plans, error);
        for (int e = 0; e < 3; e++) {
            if (status == TN_OK)
                plan_json(pair_keys[e], analyses->schemas[a], &plans[e], json);
            tn_shown_plan_clear(&plans[e]);
        }
    }
    tn_json_object_end(json);
    return status;
}

static tn_status rules_json(const tn_plan_analyses *analyses, size_t a, bool examples, tn_json *json, tn_error *error)
{
    const tn_schema *schema = analyses->schemas[a];
    size_t count = tn_plan_analysis_rule_count(analyses->items[a]);
    tn_status status = TN_OK;
    tn_json_object(json, NULL);
    tn_json_string(json, "schema", tn_text(schema->module, schema->record->name));
    tn_json_list(json, "rules");
    for (size_t i = 0; i < count; i++)
        tn_json_string(json, NULL, rule_name(analyses, a, i));
    tn_json_list_end(json);
    tn_json_list(json, "relations");
    for (size_t i = 0; i < count; i++)
        for (size_t j = i + 1; status == TN_OK && j < count; j++)
            status = pair_json(analyses, a, i, j, examples, json, error);
    tn_json_list_end(json);
    tn_json_object_end(json);
    return status;
}

/* All of it, or nothing where it fails. */
static tn_status write_json(const tn_plan_analyses *analyses, const tn_related_houses *houses, size_t house_count,
                            const tn_relations_options *options, FILE *out, tn_error *error)
{
    tn_buffer text = {0};
    tn_json json = tn_json_text(&text, TN_JSON_LINES);
    tn_status status = TN_OK;
    tn_json_list(&json, NULL);
    for (size_t a = 0; status == TN_OK && a < analyses->count; a++)
        status = rules_json(analyses, a, options->examples, &json, error);
    for (size_t i = 0; i < house_count; i++)
        houses_json(&houses[i], options->examples, &json);
    tn_json_list_end(&json);
    tn_json_end_line(&json);
    if (status == TN_OK && text.failed)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        fwrite(text.data, 1, text.size, out);
    free(text.data);
    return status;
}

tn_status tn_relations_write(const tn_plan_analyses *analyses, const tn_related_houses *houses, size_t house_count,
                             const tn_relations_options *options, FILE *out, tn_error *error)
{
    if (options->json)
        return write_json(analyses, houses, house_count, options, out, error);
    size_t begun = 0;
    for (size_t a = 0; a < analyses->count; a++)
        begun += tn_plan_analysis_rule_count(analyses->items[a]) > 0;
    tn_status status = write_plans(analyses, options, out, error);
    for (size_t i = 0; status == TN_OK && i < house_count; i++) {
        fputs(begun++ ? "\n" : "", out);
        write_houses(&houses[i], options, out);
    }
    return status;
}
