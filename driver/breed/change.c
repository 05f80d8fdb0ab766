/* Reads changes of runs that have begun. */
#include "driver/breed/change.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "driver/open/files.h"
#include "driver/open/open.h"
#include "driver/open/stdlib.h"
#include "runtime/base/array.h"
#include "runtime/genome/settings.h"

static bool begins_with(const char *text, const char *word)
{
    size_t length = strlen(word);
    return strncasecmp(text, word, length) == 0 && text[length] == ' ';
}

bool tn_change_varies(const char *change)
{
    return begins_with(change, "mutation") || begins_with(change, "crossover") || tn_change_resizes(change);
}

bool tn_change_resizes(const char *change)
{
    return begins_with(change, "population");
}

tn_status tn_change_population(const char *change, uint32_t *population, tn_error *error)
{
    char *end;
    const char *word = change + strlen("population"), *digits = word + strspn(word, " ");
    unsigned long long number = strtoull(digits, &end, 10);
    if (*digits >= '0' && *digits <= '9' && end[strspn(end, " ")] == '\0' && number <= TN_POPULATION_MAX) {
        *population = (uint32_t)number;
        return TN_OK;
    }
    tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "`%.100s` is no size of a population", change);
    tn_error_help(error, "write `population 30`; at most %u", TN_POPULATION_MAX);
    return TN_INVALID;
}

static bool is_force(const char *change)
{
    return begins_with(change, "attractor") || begins_with(change, "repeller");
}

bool tn_change_surrounds(const char *change)
{
    return is_force(change) || begins_with(change, "gravity") || begins_with(change, "boundary");
}

size_t tn_change_subject(const char *change)
{
    if (begins_with(change, "boundary"))
        return strlen(change);
    if (!is_force(change))
        return strcspn(change, " ");
    const char *strength = strstr(change, " strength"), *exponent = strstr(change, " exponent");
    const char *end = !strength || (exponent && exponent < strength) ? exponent : strength;
    return end ? (size_t)(end - change) : strlen(change);
}

/* ---- variation */

/* The place of a word among "a|b|c"; their number where it is none. */
static uint32_t choice_of(const char *choices, const char *word)
{
    uint32_t index = 0;
    for (const char *at = choices; *at; index++) {
        size_t size = strcspn(at, "|");
        if (size == strlen(word) && strncasecmp(at, word, size) == 0)
            return index;
        at += size + (at[size] == '|');
    }
    return index;
}

tn_status tn_change_variation(const char *change, tn_vary_options *vary, tn_error *error)
{
    bool mutates = begins_with(change, "mutation");
    const tn_setting_row *row = &tn_setting_rows[mutates ? TN_SET_MUTATION : TN_SET_CROSSOVER];
    char how[24] = "", *rest;
    double rate = 0;
    const char *words = change + strlen(row->name), *word = words + strspn(words, " ");
    size_t size = strcspn(word, " ");
    snprintf(how, sizeof how, "%.*s", (int)(size < sizeof how ? size : 0), word);
    uint32_t choice = choice_of(row->choices, how), count = mutates ? TN_MUTATE_COUNT : TN_CROSS_COUNT;
    rate = strtod(word + size, &rest);
    bool whole = mutates && choice == TN_MUTATE_GENOME;
    bool fits = rest != word + size && rest[strspn(rest, " ")] == '\0' && rate >= 0 &&
                rate <= (whole ? row->high : 1) && (!whole || rate == floor(rate));
    if (choice >= count || !fits) {
        tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "`%.100s` is not how genomes can vary", change);
        tn_error_help(error, mutates ? "write `mutation codons 0.02`, `mutation genome 2` or `mutation subtree 0.3`"
                                     : "write `crossover one-point 0.75`, `two-point 0.5` or `subtree 0.9`");
        return TN_INVALID;
    }
    if (mutates) {
        vary->mutation = (tn_mutation)choice;
        vary->mutation_rate = rate;
    } else {
        vary->crossover = (tn_crossover)choice;
        vary->crossover_rate = rate;
    }
    return TN_OK;
}

/* ---- surroundings */

static tn_status refuse(const char *change, const char *why, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "`%.100s` changes nothing that surfaces grow in%s%.200s", change,
            *why ? ": " : "", why);
    tn_error_help(error, "write `gravity 0 0 -0.2`, `attractor at 2 2 3 strength 0.5` or "
                         "`boundary sphere at 0 0 0 radius 2`; strength 0 takes a force away");
    return TN_INVALID;
}

static bool stands_for(const tn_force *new, const tn_force *old)
{
    return new->kind == old->kind && (new->kind == TN_GRAVITY || memcmp(new->at, old->at, sizeof new->at) == 0);
}

static tn_status put_force(tn_study *study, tn_force force, tn_error *error)
{
    tn_environment *environment = &study->environment;
    uint32_t kept = 0, count = environment->force_count;
    bool none =
        force.kind == TN_GRAVITY ? force.at[0] == 0 && force.at[1] == 0 && force.at[2] == 0 : force.strength == 0;
    if (!tn_array_resize(&study->forces, count + 2u, sizeof *study->forces))
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < count; i++)
        if (!stands_for(&force, &study->forces[i]))
            study->forces[kept++] = study->forces[i];
    if (!none)
        study->forces[kept++] = force;
    environment->forces = study->forces;
    environment->force_count = kept;
    return TN_OK;
}

static tn_status put_boundary(tn_study *study, tn_boundary boundary, tn_error *error)
{
    uint32_t count = study->environment.boundary_count;
    if (!tn_array_resize(&study->boundaries, count + 2u, sizeof *study->boundaries))
        return tn_fail_memory(error);
    study->environment.boundaries = study->boundaries;
    if (!tn_array_resize(&study->meshes, count + 2u, sizeof(tn_boundary_mesh *)))
        return tn_fail_memory(error);
    study->boundaries[count] = boundary;
    study->meshes[count] = NULL;
    study->environment.boundary_count = count + 1;
    return TN_OK;
}

/* The statement behind `use` of the study: its last force or boundary is what was added. */
static char *text_of(const char *change, const char *path)
{
    char *text = malloc(2 * strlen(path) + strlen(change) + 16), *to = text;
    if (!text)
        return NULL;
    to += sprintf(to, "use \"");
    for (; *path; path++) {
        if (*path == '"' || *path == '\\')
            *to++ = '\\';
        *to++ = *path;
    }
    sprintf(to, "\"\n%s\n", change);
    return text;
}

static tn_status take(const char *change, const tn_module *module, const tn_module *base, tn_study *study,
                      tn_error *error)
{
    tn_study read = {0};
    tn_status status = tn_study_read(module, NULL, NULL, &read, error);
    const tn_environment *all = &read.environment;
    bool force = module->FORCE_count == base->FORCE_count + 1,
         boundary = module->BOUNDARY_count == base->BOUNDARY_count + 1;
    if (status == TN_OK && force == boundary)
        status = refuse(change, "", error);
    else if (status == TN_OK && force)
        status = put_force(study, all->forces[all->force_count - 1], error);
    else if (status == TN_OK && all->boundaries[all->boundary_count - 1].kind == TN_BOUNDARY_MESH)
        status = refuse(change, "a mesh is named in the study itself, so that the run knows its file", error);
    else if (status == TN_OK)
        status = put_boundary(study, all->boundaries[all->boundary_count - 1], error);
    tn_study_clear(&read);
    return status;
}

tn_status tn_change_surroundings(const char *change, const char *path, const tn_module *base, tn_study *study,
                                 tn_error *error)
{
    tn_files files;
    tn_stdlib_dirs dirs;
    tn_opened opened = {0};
    char *text = text_of(change, path);
    if (!text)
        return tn_fail_memory(error);
    tn_status status = tn_stdlib_dirs_find(&dirs, error);
    tn_files_begin(&files, &dirs);
    tn_compile_options options = {.resolver = tn_files_resolver(&files)};
    tn_input input = {.text = text, .size = strlen(text), .name = "<change>"};
    if (status == TN_OK) {
        status = tn_open_text(TN_NOTATION(study), &input, &options, &opened);
        status = status == TN_OK       ? take(change, opened.module, base, study, error)
                 : status == TN_MEMORY ? tn_fail_memory(error)
                                       : refuse(change, tn_first_error(&opened), error);
        tn_close(&opened);
    }
    tn_files_clear(&files);
    tn_stdlib_dirs_clear(&dirs);
    free(text);
    return status;
}
