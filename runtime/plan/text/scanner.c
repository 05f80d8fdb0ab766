/* Scans the text of plans. */
#include "runtime/plan/text/scanner.h"

#include <stdlib.h>
#include <string.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/plan/text/pack.h"

/* Texts remembered: twice as many as trays, for those that are written in two ways. */
#define KNOWN_MIN 256u
#define KNOWN_MAX 16384u

tn_tray tn_scanner_recall(const tn_plan_scanner *scanner, const char *text, size_t size, uint64_t *hash)
{
    *hash = 0;
    if (!scanner->known || size == 0 || size > TN_TRAY_TEXT_MAX)
        return TN_NO_TRAY;
    *hash = XXH3_64bits(text, size);
    for (size_t place = (size_t)*hash;; place++) {
        uint32_t number = scanner->places[place & scanner->place_mask];
        if (number == 0)
            return TN_NO_TRAY;
        const tn_known_tray *known = &scanner->known[number - 1];
        if (known->hash == *hash && known->size == size && memcmp(scanner->texts[number - 1], text, size) == 0)
            return known->tray;
    }
}

void tn_scanner_learn(tn_plan_scanner *scanner, const char *text, size_t size, uint64_t hash, tn_tray tray)
{
    if (!scanner->known || size == 0 || size > TN_TRAY_TEXT_MAX)
        return;
    if (scanner->known_count == scanner->known_max) { /* begin again */
        memset(scanner->places, 0, (scanner->place_mask + 1) * sizeof *scanner->places);
        scanner->known_count = 0;
    }
    uint32_t number = scanner->known_count++;
    scanner->known[number] = (tn_known_tray){.hash = hash, .size = (uint32_t)size, .tray = tray};
    memcpy(scanner->texts[number], text, size);
    size_t place = (size_t)hash;
    while (scanner->places[place & scanner->place_mask])
        place++;
    scanner->places[place & scanner->place_mask] = number + 1;
}

tn_status tn_scanner_add(tn_plan *plan, tn_tray tray, size_t max_trays, const tn_word *place, tn_error *error)
{
    if (plan->length >= max_trays) {
        tn_fail(error, TN_LIMIT, E_PLAN_TOO_LONG, "the plan has more trays than the limit of %zu", max_trays);
        tn_error_help(error, "--max-length raises the limit");
        tn_error_place(error, 0, place->column, place->column + place->extent);
        return TN_LIMIT;
    }
    if (plan->length == plan->capacity && !tn_plan_reserve(plan, plan->length + 16))
        return tn_fail_memory(error);
    plan->trays[plan->length++] = tray;
    return TN_OK;
}

static void clear(tn_plan_scanner *scanner)
{
    free(scanner->values);
    free(scanner->given);
    free(scanner->rank.data);
    for (size_t i = 0; i < sizeof scanner->unescaped / sizeof *scanner->unescaped; i++)
        free(scanner->unescaped[i].data);
    free(scanner->known);
    free(scanner->texts);
    free(scanner->places);
}

static bool start(tn_plan_scanner *scanner, const tn_schema *schema)
{
    *scanner = (tn_plan_scanner){.schema = schema};
    scanner->values = malloc(schema->field_count + 1u);
    scanner->given = malloc((schema->field_count + 1u) * sizeof *scanner->given);
    return scanner->values && scanner->given;
}

tn_status tn_plan_scanner_new(const tn_schema *schema, tn_plan_scanner **out, tn_error *error)
{
    *out = NULL;
    tn_plan_scanner *scanner = malloc(sizeof *scanner);
    if (!scanner)
        return tn_fail_memory(error);
    bool ready = start(scanner, schema);
    uint32_t count = schema->tray_count < KNOWN_MAX / 2 ? schema->tray_count * 2 : KNOWN_MAX;
    scanner->known_max = count > KNOWN_MIN ? count : KNOWN_MIN;
    size_t places = 4 * KNOWN_MIN;
    while (places < 4 * (size_t)scanner->known_max)
        places *= 2;
    scanner->place_mask = places - 1;
    scanner->known = malloc(scanner->known_max * sizeof *scanner->known);
    scanner->texts = malloc(scanner->known_max * sizeof *scanner->texts);
    scanner->places = calloc(places, sizeof *scanner->places);
    if (!ready || !scanner->known || !scanner->texts || !scanner->places) {
        tn_plan_scanner_free(scanner);
        return tn_fail_memory(error);
    }
    *out = scanner;
    return TN_OK;
}

void tn_plan_scanner_free(tn_plan_scanner *scanner)
{
    if (!scanner)
        return;
    clear(scanner);
    free(scanner);
}

tn_status tn_plan_scan_line(tn_plan_scanner *scanner, const char *line, size_t length, size_t max_trays, tn_plan *plan,
                            tn_error *error)
{
    return tn_scanner_line(scanner, line, length, max_trays, plan, error);
}

tn_status tn_plan_scan_json(tn_plan_scanner *scanner, const char *text, size_t length, size_t max_trays, tn_plan *plan,
                            tn_error *error)
{
    return tn_scanner_json(scanner, text, length, max_trays, plan, error);
}

tn_status tn_plan_parse_line(const tn_schema *schema, const char *line, size_t length, size_t max_trays, tn_plan *plan,
                             tn_error *error)
{
    tn_plan_scanner scanner;
    tn_status status = start(&scanner, schema) ? tn_scanner_line(&scanner, line, length, max_trays, plan, error)
                                               : tn_fail_memory(error);
    clear(&scanner);
    return status;
}

tn_status tn_plan_parse_json(const tn_schema *schema, const char *text, size_t length, size_t max_trays, tn_plan *plan,
                             tn_error *error)
{
    tn_plan_scanner scanner;
    tn_status status = start(&scanner, schema) ? tn_scanner_json(&scanner, text, length, max_trays, plan, error)
                                               : tn_fail_memory(error);
    clear(&scanner);
    return status;
}
