/* Inside of tn_plan_scanner, for the parsers of plan lines and of JSON lines. */
#ifndef TARTAN_PLAN_TEXT_SCANNER_H
#define TARTAN_PLAN_TEXT_SCANNER_H

#include "runtime/plan/schema/value.h"
#include "runtime/plan/text/text.h"

/* Longer texts of trays are read value by value each time. */
#define TN_TRAY_TEXT_MAX 240

typedef struct tn_known_tray {
    uint64_t hash;
    uint32_t size;
    tn_tray tray;
} tn_known_tray;

struct tn_plan_scanner {
    const tn_schema *schema;
    uint8_t *values;        /* one per field: of the tray in hand */
    bool *given;            /* one per field: has JSON given it? */
    tn_buffer rank;         /* of the JSON plan read last: what its "rank" says, or empty */
    tn_buffer unescaped[3]; /* texts that JSON writes with escapes */
    /* Trays by the text that wrote them, in the order in which they were met, so that the few that most plans are made
     * of are side by side and stay in the nearest cache; without `known` nothing is remembered. Where there is no room
     * for more, all are forgotten. */
    tn_known_tray *known;
    char (*texts)[TN_TRAY_TEXT_MAX];
    uint32_t known_count, known_max;
    uint32_t *places; /* by the text's hash, or the next that is free: its number from 1 */
    size_t place_mask;
};

/* The tray that this text wrote before, or TN_NO_TRAY; *hash is then for tn_scanner_learn. */
tn_tray tn_scanner_recall(const tn_plan_scanner *scanner, const char *text, size_t size, uint64_t *hash);
void tn_scanner_learn(tn_plan_scanner *scanner, const char *text, size_t size, uint64_t hash, tn_tray tray);

/* Appends a tray to the plan; E0805 past max_trays, at `place`. */
tn_status tn_scanner_add(tn_plan *plan, tn_tray tray, size_t max_trays, const tn_word *place, tn_error *error);

/* What the two parsers do for a scanner, which need not remember. */
tn_status tn_scanner_line(tn_plan_scanner *scanner, const char *line, size_t length, size_t max_trays, tn_plan *plan,
                          tn_error *error);
tn_status tn_scanner_json(tn_plan_scanner *scanner, const char *text, size_t length, size_t max_trays, tn_plan *plan,
                          tn_error *error);

#endif
