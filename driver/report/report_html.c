/* The parts of a report that are HTML and nothing else. */
#include "driver/report/report_data.h"

#include <stdlib.h>

#include "driver/open/digits.h"
#include "runtime/plan/picture/draw_explain.h"

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

/* ---- numbers and plans */

bool tn_report_number(const tn_reporting *r, const mpz_t number)
{
    char *digits = tn_digits(number, true);
    bool written = digits && tn_page_html(&r->page, digits);
    free(digits);
    return written;
}

/* In thousandths of a per cent, rounded down; then as many of its digits as count. */
bool tn_report_share(const tn_reporting *r, const mpz_t part, const mpz_t whole)
{
    if (mpz_sgn(part) == 0 || mpz_sgn(whole) == 0)
        return tn_page_html(&r->page, "0 %");
    if (mpz_cmp(part, whole) == 0)
        return tn_page_html(&r->page, "100 %");
    mpz_t share;
    mpz_init(share);
    mpz_mul_ui(share, part, 100000);
    mpz_fdiv_q(share, share, whole);
    unsigned thousandths = (unsigned)mpz_get_ui(share);
    mpz_clear(share);
    if (thousandths == 0)
        return tn_page_html(&r->page, "less than 0.001 %");
    if (thousandths < 1000)
        return tn_buffer_printf(r->page.text, "0.%03u %%", thousandths);
    return tn_buffer_printf(r->page.text, "%u.%u %%", thousandths / 1000, thousandths % 1000 / 100);
}

bool tn_report_plan(const tn_reporting *r, const tn_tray *trays, size_t length)
{
    tn_buffer line = {0};
    bool written = tn_plan_write_line(r->ready->schema, trays, length, &line) &&
                   tn_page_text_part(&r->page, line.data ? line.data : "", line.size);
    free(line.data);
    return written;
}

/* ---- pictures */

tn_status tn_report_put_explained(tn_reporting *r, const tn_explained *explained, const char *description)
{
    tn_picture picture = tn_page_next_picture(&r->page);
    tn_status status = tn_explained_draw(explained, false, &picture, r->page.error);
    return tn_page_put_picture(&r->page, &picture, description, status);
}

/* ---- plans */

tn_status tn_report_put_plan(tn_reporting *r, const tn_tray *trays, size_t length, const char *description)
{
    tn_picture picture = tn_page_next_picture(&r->page);
    const tn_drawn_reasons drawn = {.plan = {.trays = trays, .length = length}};
    tn_status status = tn_reasons_draw(r->ready->schema, &drawn, &picture, r->page.error);
    return tn_page_put_picture(&r->page, &picture, description, status);
}

/* ---- the chart */

enum { BAR_HEIGHT = 12, BAR_ROW = 34, BAR_LEFT = 70, BAR_WIDTH = 560, DIGIT_WIDTH = 8 };

/* The logarithm of a count in thousandths of its base ten, straight between powers of ten: exact on every machine. */
static size_t magnitude(const mpz_t count)
{
    char *digits = mpz_get_str(NULL, 10, count);
    size_t result = 0;
    if (digits && mpz_sgn(count) > 0) {
        char lead[5] = "0000";
        size_t size = strlen(digits);
        memcpy(lead, digits, size < 4 ? size : 4);
        result = 1000 * (size - 1) + (strtoul(lead, NULL, 10) - 1000) / 9;
    }
    free(digits);
    return result;
}

static bool write_bar(const tn_reporting *r, const mpz_t count, size_t most, size_t y, const char *colour)
{
    size_t width = mpz_sgn(count) > 0 ? 2 + magnitude(count) * BAR_WIDTH / (most ? most : 1) : 0;
    return tn_buffer_printf(r->page.text, "<rect x=\"%d\" y=\"%zu\" width=\"%zu\" height=\"%d\" fill=\"%s\"/>",
                            BAR_LEFT, y, width, BAR_HEIGHT, colour) &&
           tn_buffer_printf(r->page.text, "<text x=\"%zu\" y=\"%zu\">", BAR_LEFT + width + 6, y + BAR_HEIGHT - 2) &&
           tn_report_number(r, count) && tn_buffer_printf(r->page.text, "</text>\n");
}

bool tn_report_chart(const tn_reporting *r, uint32_t low, const mpz_t *generated, const mpz_t *kept, size_t count)
{
    size_t most = 0;
    for (size_t i = 0; i < count; i++)
        most = magnitude(generated[i]) > most ? magnitude(generated[i]) : most;
    size_t digits = most / 1000 + 1, width = BAR_LEFT + BAR_WIDTH + DIGIT_WIDTH * (digits + digits / 3 + 1);
    bool written =
        tn_buffer_printf(r->page.text,
                         "<figure class=\"chart\"><svg width=\"%zu\" viewBox=\"0 0 %zu %zu\" font-size=\"12\" "
                         "font-family=\"sans-serif\" role=\"img\" "
                         "aria-label=\"plans by length\">\n",
                         width, width, count * BAR_ROW + 10);
    for (size_t i = 0; written && i < count; i++) {
        size_t y = i * BAR_ROW + 4;
        written =
            tn_buffer_printf(r->page.text, "<text x=\"0\" y=\"%zu\">%zu trays</text>", y + BAR_HEIGHT + 4, low + i) &&
            write_bar(r, generated[i], most, y, "#c9c4b8") &&
            write_bar(r, kept[i], most, y + BAR_HEIGHT + 1, "#5a7d4f");
    }
    return written && tn_buffer_printf(r->page.text,
                                       "</svg></figure>\n<p class=\"quiet\">grey: generated; green: kept. The scale is "
                                       "logarithmic.</p>\n");
}
