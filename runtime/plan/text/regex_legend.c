/* Which tray is which letter of a pattern, in words that say it of each tray. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/schema/boxes.h"
#include "runtime/plan/text/export_regex.h"

/* "width 4' 8', not great": the fields that not every value is allowed of. */
static bool write_box(const tn_schema *schema, const uint64_t *box, tn_buffer *out)
{
    const char *between = "";
    bool good = true;
    for (uint32_t f = 0; good && f < schema->field_count; f++) {
        uint32_t first = schema->value_start[f], allowed = 0;
        for (uint32_t v = 0; v < schema->fields[f].value_count; v++)
            allowed += tn_box_has_value(box, first + v);
        if (allowed == schema->fields[f].value_count)
            continue;
        bool flag = schema->fields[f].kind == TN_FIELD_FLAG;
        good = tn_buffer_printf(out, "%s%s%s", between, flag && tn_box_has_value(box, first) ? "not " : "",
                                tn_text(schema->module, schema->fields[f].name));
        for (uint32_t v = 0; good && !flag && v < schema->fields[f].value_count; v++)
            if (tn_box_has_value(box, first + v))
                good = tn_buffer_printf(out, " %s", tn_text(schema->module, schema->values[first + v].spelling));
        between = ", ";
    }
    return good;
}

/* Of each field that is named, only the values that some tray of the letter has in the box: what is forbidden anyway
 * need not be said. */
static void tighten(const tn_schema *schema, const bool *in, uint64_t *box, uint64_t *seen)
{
    memset(seen, 0, schema->mask_words * sizeof *seen);
    for (tn_tray t = 0; t < schema->tray_count; t++)
        for (uint32_t w = 0; in[t] && tn_box_has(schema, box, t) && w < schema->mask_words; w++)
            seen[w] |= tn_tray_mask(schema, t)[w];
    for (uint32_t f = 0; f < schema->field_count; f++) {
        uint32_t first = schema->value_start[f], end = schema->value_start[f + 1], allowed = 0;
        for (uint32_t v = first; v < end; v++)
            allowed += tn_box_has_value(box, v);
        for (uint32_t v = first; allowed < end - first && v < end; v++)
            if (!tn_box_has_value(seen, v))
                box[v / 64] &= ~(UINT64_C(1) << (v % 64));
    }
}

/* Do the other boxes have all its trays? A box that is left out has no values at all. */
static bool is_told(const tn_schema *schema, const bool *in, const uint64_t *boxes, size_t count, size_t box)
{
    for (tn_tray t = 0; t < schema->tray_count; t++) {
        bool other = !in[t] || !tn_box_has(schema, boxes + box * schema->mask_words, t);
        for (size_t i = 0; !other && i < count; i++)
            other = i != box && tn_box_has(schema, boxes + i * schema->mask_words, t);
        if (!other)
            return false;
    }
    return true;
}

/* Makes the boxes say no more than is so; returns how many are left. */
static size_t tidy(const tn_schema *schema, const bool *in, uint64_t *boxes, size_t count, uint64_t *seen)
{
    size_t left = 0, size = schema->mask_words * sizeof *boxes;
    for (size_t i = 0; i < count; i++)
        tighten(schema, in, boxes + i * schema->mask_words, seen);
    for (size_t i = 0; i < count; i++)
        if (is_told(schema, in, boxes, count, i))
            memset(boxes + i * schema->mask_words, 0, size);
        else
            left++;
    for (size_t i = 0, at = 0; i < count && at < left; i++) {
        memset(seen, 0, size);
        if (memcmp(boxes + i * schema->mask_words, seen, size) != 0)
            memmove(boxes + at++ * schema->mask_words, boxes + i * schema->mask_words, size);
    }
    return left;
}

static tn_status write_letter(const tn_schema *schema, uint32_t letter, const bool *in, tn_buffer *out, tn_error *error)
{
    tn_tray first = TN_NO_TRAY;
    uint32_t trays = 0;
    for (tn_tray t = schema->tray_count; t-- > 0;) {
        trays += in[t];
        first = in[t] ? t : first;
    }
    uint64_t *boxes;
    size_t count;
    tn_status status = tn_tray_boxes(schema, in, &boxes, &count, error);
    if (status != TN_OK)
        return status;
    uint64_t *seen = calloc(schema->mask_words + 1, sizeof *seen);
    count = seen ? tidy(schema, in, boxes, count, seen) : 0;
    bool good = seen &&
                tn_buffer_printf(out, "# %c  %" PRIu32 " tray%s, such as ", tn_regex_letter(letter), trays,
                                 trays == 1 ? "" : "s") &&
                tn_plan_write_line(schema, &first, 1, out);
    if (trays < schema->tray_count)
        for (size_t i = 0; good && i < count; i++)
            good = tn_buffer_printf(out, i ? "\n#    or with " : "; all with ") &&
                   write_box(schema, boxes + i * schema->mask_words, out);
    good = good && tn_buffer_printf(out, "\n");
    free(seen);
    free(boxes);
    return good ? TN_OK : tn_fail_memory(error);
}

tn_status tn_regex_legend(const tn_dfa *dfa, const tn_classes *classes, tn_buffer *out, tn_error *error)
{
    const tn_schema *schema = classes->schema;
    tn_status status = tn_schema_listed(schema, "the legend of a regular expression goes", error);
    if (status != TN_OK)
        return status;
    bool *in = malloc((size_t)schema->tray_count + 1);
    status = in ? TN_OK : tn_fail_memory(error);
    for (uint32_t c = 0; status == TN_OK && c < dfa->columns; c++) {
        for (tn_tray t = 0; t < schema->tray_count; t++)
            in[t] = dfa->column[classes->of_tray[t]] == c;
        status = write_letter(schema, c, in, out, error);
    }
    free(in);
    return status;
}
