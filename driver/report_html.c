/* The parts of a report that are HTML and nothing else. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "driver/report.h"
#include "runtime/vm/file.h"

enum { PICTURE_MAX = 64 << 20 };

const char tn_report_head[] =
    "<meta name=\"viewport\" content=\"width=device-width\">\n<style>\n"
    "body{font:15px/1.45 system-ui,sans-serif;margin:2rem auto;max-width:72rem;padding:0 1rem;color:#222}\n"
    "h1{margin-bottom:0}h2{margin-top:2.5rem;border-bottom:1px solid #ccc}\n"
    "pre{background:#f6f6f3;padding:.6rem;overflow:auto;font-size:13px}\n"
    ".rule{border:1px solid #ddd;border-radius:6px;padding:.8rem 1rem;margin:.8rem 0}\n"
    ".rule h3{margin:0}.rule img{max-width:100%;margin:.5rem 0}.quiet{color:#666}\n"
    "table{border-collapse:collapse}td,th{text-align:right;padding:.1rem .8rem}\n"
    "#sheet{display:grid;grid-template-columns:repeat(auto-fill,minmax(22rem,1fr));gap:.8rem}\n"
    ".plan{border:1px solid #ddd;border-radius:6px;padding:.6rem;overflow:hidden}\n"
    ".plan img{max-width:100%}.plan.dropped{border-left:5px solid #b33}.plan.kept{border-left:5px solid #373}\n"
    ".plan pre{white-space:pre-wrap;font-size:12px}.controls{position:sticky;top:0;background:#fff;padding:.5rem 0}\n"
    "[hidden]{display:none}\n</style>\n";

/* The filter is kept in the address, so that a filtered sheet can be linked to. */
const char tn_report_foot[] =
    "<script>\n"
    "'use strict';\n"
    "const words = document.getElementById('words'), which = document.getElementById('which');\n"
    "const by = document.getElementById('by'), shown = document.getElementById('shown');\n"
    "const plans = [...document.querySelectorAll('.plan')];\n"
    "function filter() {\n"
    "  const wanted = words.value.toLowerCase().split(/\\s+/).filter(Boolean);\n"
    "  let count = 0;\n"
    "  for (const plan of plans) {\n"
    "    const text = plan.textContent.toLowerCase();\n"
    "    const clauses = plan.dataset.by.split(' ');\n"
    "    const fits = wanted.every((word) => text.includes(word)) &&\n"
    "      (which.value === 'all' || plan.classList.contains(which.value)) &&\n"
    "      (by.value === '' || clauses.includes(by.value));\n"
    "    plan.hidden = !fits;\n"
    "    count += fits;\n"
    "  }\n"
    "  shown.textContent = `${count} of ${plans.length} plans`;\n"
    "}\n"
    "function change() {\n"
    "  filter();\n"
    "  history.replaceState(null, '', '#' + new URLSearchParams({words: words.value, which: which.value, by: "
    "by.value}));\n"
    "}\n"
    "const asked = new URLSearchParams(location.hash.slice(1));\n"
    "words.value = asked.get('words') || '';\n"
    "which.value = asked.get('which') || 'all';\n"
    "by.value = asked.get('by') || '';\n"
    "for (const control of [words, which, by]) control.addEventListener('input', change);\n"
    "filter();\n"
    "</script>\n";

bool tn_report_text(tn_buffer *page, const char *text, size_t size)
{
    bool written = true;
    for (size_t i = 0; written && i < size; i++) {
        const char *entity = text[i] == '&'   ? "&amp;"
                             : text[i] == '<' ? "&lt;"
                             : text[i] == '>' ? "&gt;"
                             : text[i] == '"' ? "&quot;"
                                              : NULL;
        written = entity ? tn_buffer_append(page, entity, strlen(entity)) : tn_buffer_append(page, text + i, 1);
    }
    return written;
}

static bool append_base64(tn_buffer *page, const uint8_t *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    bool written = true;
    for (size_t i = 0; written && i < size; i += 3) {
        size_t left = size - i;
        uint32_t three =
            (uint32_t)bytes[i] << 16 | (left > 1 ? (uint32_t)bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0);
        char four[4] = {digits[three >> 18], digits[three >> 12 & 63], left > 1 ? digits[three >> 6 & 63] : '=',
                        left > 2 ? digits[three & 63] : '='};
        written = tn_buffer_append(page, four, sizeof four);
    }
    return written;
}

tn_status tn_report_picture(tn_buffer *page, const char *path, const char *description, tn_error *error)
{
    uint8_t *bytes;
    size_t size;
    tn_status status = tn_file_read(path, PICTURE_MAX, &bytes, &size, error);
    unlink(path);
    if (status != TN_OK)
        return status;
    bool written = tn_buffer_printf(page, "<img alt=\"") && tn_report_text(page, description, strlen(description)) &&
                   tn_buffer_printf(page, "\" src=\"data:image/svg+xml;base64,") && append_base64(page, bytes, size) &&
                   tn_buffer_printf(page, "\">\n");
    free(bytes);
    return written ? TN_OK : tn_fail_memory(error);
}

bool tn_report_number(tn_buffer *page, const mpz_t number)
{
    char *digits = mpz_get_str(NULL, 10, number);
    size_t size = digits ? strlen(digits) : 0;
    bool written = digits != NULL;
    for (size_t i = 0; written && i < size; i++)
        written =
            (i == 0 || (size - i) % 3 != 0 || tn_buffer_append(page, ",", 1)) && tn_buffer_append(page, digits + i, 1);
    free(digits);
    return written;
}

/* ---- the chart */

enum { BAR_HEIGHT = 12, BAR_ROW = 34, BAR_LEFT = 60, BAR_WIDTH = 560, CHART_WIDTH = 860 };

/* The logarithm of a count in thousandths of its base ten, straight between powers of ten: exact on every machine. */
static unsigned long magnitude(const mpz_t count)
{
    char *digits = mpz_get_str(NULL, 10, count);
    unsigned long result = 0;
    if (digits && mpz_sgn(count) > 0) {
        char lead[5] = "0000";
        size_t size = strlen(digits);
        memcpy(lead, digits, size < 4 ? size : 4);
        result = 1000 * (size - 1) + (strtoul(lead, NULL, 10) - 1000) / 9;
    }
    free(digits);
    return result;
}

static bool write_bar(tn_buffer *page, const mpz_t count, unsigned long most, size_t y, const char *colour)
{
    unsigned long width = mpz_sgn(count) > 0 ? 2 + magnitude(count) * BAR_WIDTH / (most ? most : 1) : 0;
    return tn_buffer_printf(page, "<rect x=\"%d\" y=\"%zu\" width=\"%lu\" height=\"%d\" fill=\"%s\"/>", BAR_LEFT, y,
                            width, BAR_HEIGHT, colour) &&
           tn_buffer_printf(page, "<text x=\"%lu\" y=\"%zu\">", BAR_LEFT + width + 6, y + BAR_HEIGHT - 2) &&
           tn_report_number(page, count) && tn_buffer_printf(page, "</text>\n");
}

bool tn_report_chart(tn_buffer *page, uint32_t low, const mpz_t *generated, const mpz_t *kept, size_t count)
{
    unsigned long most = 0;
    for (size_t i = 0; i < count; i++)
        most = magnitude(generated[i]) > most ? magnitude(generated[i]) : most;
    bool written =
        tn_buffer_printf(page,
                         "<svg width=\"%d\" height=\"%zu\" font-size=\"12\" font-family=\"sans-serif\" role=\"img\" "
                         "aria-label=\"plans by length\">\n",
                         CHART_WIDTH, count * BAR_ROW + 10);
    for (size_t i = 0; written && i < count; i++) {
        size_t y = i * BAR_ROW + 4;
        written = tn_buffer_printf(page, "<text x=\"0\" y=\"%zu\">%zu trays</text>", y + BAR_HEIGHT + 4, low + i) &&
                  write_bar(page, generated[i], most, y, "#c9c4b8") &&
                  write_bar(page, kept[i], most, y + BAR_HEIGHT + 1, "#5a7d4f");
    }
    return written && tn_buffer_printf(page, "</svg>\n<p class=\"quiet\">grey: generated; green: kept. The scale is "
                                             "logarithmic.</p>\n");
}
