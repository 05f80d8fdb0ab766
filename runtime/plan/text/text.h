/* Plans as text: plan lines and JSON lines, in and out.
 *
 * A plan line holds trays separated by `|`, values in schema order separated by blanks, a flag as its name or `-`, a
 * zone as `fill:depth` or `fill` (then its first depth). A blank line is the empty plan; a line that starts with `#` is
 * a comment. Lengths may be written in any unit (12', 144", 3.6576m) as long as they equal one of the field's.
 */
#ifndef TARTAN_PLAN_TEXT_TEXT_H
#define TARTAN_PLAN_TEXT_TEXT_H

#include "runtime/base/json.h"
#include "runtime/plan/schema/schema.h"

/* A plan that grows; zero it to begin with, free trays with free(). */
typedef struct tn_plan {
    tn_tray *trays;
    size_t length;
    size_t capacity;
} tn_plan;

/* Parses one plan line (no newline in it) of at most max_trays trays. An error has its columns; its line is the
 * caller's to set. E0601 where it cannot be read, E0602 for a value that its field does not have, E0603 for a forbidden
 * tray, E0805 past max_trays. */
tn_status tn_plan_parse_line(const tn_schema *schema, const char *line, size_t length, size_t max_trays, tn_plan *plan,
                             tn_error *error);

/* Parses one JSON object {"trays": [{"width": "12'", "public": true, "machine": {"fill": "dense", "depth": "4'"}},
 * ...]}. A field that is left out takes its first value; a zone may be a string "dense:4'" too. Other members than
 * "trays" are skipped. Errors as above. */
tn_status tn_plan_parse_json(const tn_schema *schema, const char *text, size_t length, size_t max_trays, tn_plan *plan,
                             tn_error *error);

/* Appends the text that is member `name` of a JSON object to `out`; *column is where it begins, after its quote. Other
 * members are skipped. E0601, with its columns, where there is no such text, or no object. */
tn_status tn_json_read_text(const char *text, size_t length, const char *name, tn_buffer *out, size_t *column,
                            tn_error *error);

/* The column of an object in which `column` of such a text, which begins at column `begin`, is written: escapes take
 * more room there. A character beyond ASCII that is written as an escape counts as one column. */
size_t tn_json_read_column(const char *text, size_t length, size_t begin, size_t column);

/* The same for many plans: a scanner remembers the trays that it has read, text by text (in bounded memory), and so
 * reads most trays at a glance. It belongs to one thread and borrows the schema. */
typedef struct tn_plan_scanner tn_plan_scanner;
tn_status tn_plan_scanner_new(const tn_schema *schema, tn_plan_scanner **scanner, tn_error *error);
void tn_plan_scanner_free(tn_plan_scanner *scanner);
tn_status tn_plan_scan_line(tn_plan_scanner *scanner, const char *line, size_t length, size_t max_trays, tn_plan *plan,
                            tn_error *error);
tn_status tn_plan_scan_json(tn_plan_scanner *scanner, const char *text, size_t length, size_t max_trays, tn_plan *plan,
                            tn_error *error);

/* Appends the plan in the schema's own spelling, without a newline. false where out of memory. */
bool tn_plan_write_line(const tn_schema *schema, const tn_tray *trays, size_t length, tn_buffer *out);
bool tn_plan_write_json(const tn_schema *schema, const tn_tray *trays, size_t length,
                        tn_buffer *out); /* {"trays":[...]} */

/* The member "trays" of the object that is open: [{...}, ...]. */
void tn_plan_write_trays(const tn_schema *schema, const tn_tray *trays, size_t length, tn_json *json);

#endif
