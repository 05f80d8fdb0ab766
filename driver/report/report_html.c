/* The parts of a report that are HTML and nothing else. */
#include "driver/report/report_data.h"

#include <stdlib.h>

#include "driver/open/digits.h"
#include "runtime/base/utf8.h"
#include "runtime/plan/picture/draw_explain.h"

const char tn_report_head[] =
    "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<style>\n"
    "body{font:15px/1.45 'DejaVu Sans',Verdana,system-ui,sans-serif;margin:2rem auto;max-width:72rem;padding:0 1rem;"
    "color:#222;background:#fff}\n"
    "h1{margin-bottom:0}h2{margin-top:2.5rem;border-bottom:1px solid #ccc}nav a{margin-right:1rem}\n"
    "a{color:#2a5599}svg{max-width:100%;height:auto}figure{margin:.5rem 0;overflow-x:auto}\n"
    ".plan.dropped svg,.chart svg,.card>details>figure svg{min-width:38rem}small{font-weight:normal;color:#666}\n"
    "pre{background:#f6f6f3;padding:.6rem;white-space:pre-wrap;overflow-wrap:anywhere;font-size:13px}\n"
    "code{background:#f6f6f3;padding:0 .2rem;font-size:13px;overflow-wrap:anywhere}\n"
    ".line{font:12px/1.4 monospace;color:#666;overflow-wrap:anywhere}\n"
    ".card{border:1px solid #ddd;border-radius:6px;padding:.8rem 1rem;margin:.8rem 0}\n"
    ".card h3{margin:0}.quiet{color:#666}.card p{margin:.4rem 0}\n"
    "details{margin:.4rem 0}summary{cursor:pointer;color:#2a5599}\n"
    "table{border-collapse:collapse;font-size:13px}td,th{text-align:right;padding:.1rem .6rem;vertical-align:top}\n"
    ".parts td:first-child,.parts th:first-child{text-align:left;overflow-wrap:anywhere}\n"
    "#sheet{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(32rem,100%),1fr));gap:.8rem}\n"
    ".plan{border:1px solid #ddd;border-radius:6px;padding:.6rem;overflow:hidden;min-width:0}.plan p{margin:.2rem 0}\n"
    ".plan.dropped{border-left:5px solid #b33;grid-column:1/-1}.plan.kept{border-left:5px solid #373}\n"
    ".plan pre{font-size:12px}\n"
    ".best{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(24rem,100%),1fr));gap:.8rem}.best "
    "p{margin:.2rem 0}\n"
    ".controls{position:sticky;top:0;background:#fff;padding:.5rem 0}input,select{font:inherit;max-width:100%}\n"
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

/* ---- texts and numbers */

bool tn_report_html(const tn_reporting *r, const char *html)
{
    return tn_buffer_append(r->page, html, strlen(html));
}

bool tn_report_text_part(const tn_reporting *r, const char *text, size_t size)
{
    bool written = true;
    for (size_t i = 0, step; written && i < size; i += step) {
        char escape[8];
        uint32_t character = tn_utf8_read(text + i, size - i, &step);
        const char *entity = text[i] == '&'   ? "&amp;"
                             : text[i] == '<' ? "&lt;"
                             : text[i] == '>' ? "&gt;"
                             : text[i] == '"' ? "&quot;"
                                              : NULL;
        if (!entity && tn_character_hidden(character) && character != '\n' && character != '\t') {
            tn_character_escape(character, escape);
            entity = escape;
        }
        written = entity ? tn_report_html(r, entity) : tn_buffer_append(r->page, text + i, step);
    }
    return written;
}

bool tn_report_text(const tn_reporting *r, const char *text)
{
    return tn_report_text_part(r, text, strlen(text));
}

bool tn_report_prose(const tn_reporting *r, const char *text)
{
    bool good = true;
    while (good && *text) {
        const char *open = strchr(text, '`'), *close = open ? strchr(open + 1, '`') : NULL;
        if (!close)
            return tn_report_text(r, text);
        good = tn_report_text_part(r, text, (size_t)(open - text)) && tn_report_html(r, "<code>") &&
               tn_report_text_part(r, open + 1, (size_t)(close - open - 1)) && tn_report_html(r, "</code>");
        text = close + 1;
    }
    return good;
}

bool tn_report_number(const tn_reporting *r, const mpz_t number)
{
    char *digits = tn_digits(number, true);
    bool written = digits && tn_report_html(r, digits);
    free(digits);
    return written;
}

/* In thousandths of a per cent, rounded down; then as many of its digits as count. */
bool tn_report_share(const tn_reporting *r, const mpz_t part, const mpz_t whole)
{
    if (mpz_sgn(part) == 0 || mpz_sgn(whole) == 0)
        return tn_report_html(r, "0 %");
    if (mpz_cmp(part, whole) == 0)
        return tn_report_html(r, "100 %");
    mpz_t share;
    mpz_init(share);
    mpz_mul_ui(share, part, 100000);
    mpz_fdiv_q(share, share, whole);
    unsigned long thousandths = mpz_get_ui(share);
    mpz_clear(share);
    if (thousandths == 0)
        return tn_report_html(r, "less than 0.001 %");
    if (thousandths < 1000)
        return tn_buffer_printf(r->page, "0.%03lu %%", thousandths);
    return tn_buffer_printf(r->page, "%lu.%lu %%", thousandths / 1000, thousandths % 1000 / 100);
}

bool tn_report_plan(const tn_reporting *r, const tn_tray *trays, size_t length)
{
    tn_buffer line = {0};
    bool written = tn_plan_write_line(r->ready->schema, trays, length, &line) &&
                   tn_report_text_part(r, line.data ? line.data : "", line.size);
    free(line.data);
    return written;
}

/* ---- pictures */

tn_picture tn_report_next_picture(tn_reporting *r)
{
    return (tn_picture){.number = r->pictures++};
}

tn_status tn_report_put_picture(const tn_reporting *r, tn_picture *picture, const char *description, tn_status drawn)
{
    tn_status status = drawn;
    if (status == TN_OK)
        status = tn_report_written(r, tn_report_html(r, "<figure role=\"img\" aria-label=\"") &&
                                          tn_report_text(r, description) && tn_report_html(r, "\">\n") &&
                                          tn_buffer_append(r->page, picture->element, picture->size) &&
                                          tn_report_html(r, "</figure>\n"));
    free(picture->element);
    return status;
}

tn_status tn_report_put_explained(tn_reporting *r, const tn_explained *explained, const char *description)
{
    tn_picture picture = tn_report_next_picture(r);
    tn_status status = tn_explained_draw(explained, false, &picture, r->error);
    return tn_report_put_picture(r, &picture, description, status);
}

/* ---- plans */

tn_status tn_report_put_plan(tn_reporting *r, const tn_tray *trays, size_t length, const char *description)
{
    tn_picture picture = tn_report_next_picture(r);
    const tn_drawn_reasons drawn = {.plan = {.trays = trays, .length = length}};
    tn_status status = tn_reasons_draw(r->ready->schema, &drawn, &picture, r->error);
    return tn_report_put_picture(r, &picture, description, status);
}

/* ---- the chart */

enum { BAR_HEIGHT = 12, BAR_ROW = 34, BAR_LEFT = 70, BAR_WIDTH = 560, DIGIT_WIDTH = 8 };

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

static bool write_bar(const tn_reporting *r, const mpz_t count, unsigned long most, size_t y, const char *colour)
{
    unsigned long width = mpz_sgn(count) > 0 ? 2 + magnitude(count) * BAR_WIDTH / (most ? most : 1) : 0;
    return tn_buffer_printf(r->page, "<rect x=\"%d\" y=\"%zu\" width=\"%lu\" height=\"%d\" fill=\"%s\"/>", BAR_LEFT, y,
                            width, BAR_HEIGHT, colour) &&
           tn_buffer_printf(r->page, "<text x=\"%lu\" y=\"%zu\">", BAR_LEFT + width + 6, y + BAR_HEIGHT - 2) &&
           tn_report_number(r, count) && tn_buffer_printf(r->page, "</text>\n");
}

bool tn_report_chart(const tn_reporting *r, uint32_t low, const mpz_t *generated, const mpz_t *kept, size_t count)
{
    unsigned long most = 0;
    for (size_t i = 0; i < count; i++)
        most = magnitude(generated[i]) > most ? magnitude(generated[i]) : most;
    size_t digits = most / 1000 + 1, width = BAR_LEFT + BAR_WIDTH + DIGIT_WIDTH * (digits + digits / 3 + 1);
    bool written =
        tn_buffer_printf(r->page,
                         "<figure class=\"chart\"><svg width=\"%zu\" viewBox=\"0 0 %zu %zu\" font-size=\"12\" "
                         "font-family=\"sans-serif\" role=\"img\" "
                         "aria-label=\"plans by length\">\n",
                         width, width, count * BAR_ROW + 10);
    for (size_t i = 0; written && i < count; i++) {
        size_t y = i * BAR_ROW + 4;
        written = tn_buffer_printf(r->page, "<text x=\"0\" y=\"%zu\">%zu trays</text>", y + BAR_HEIGHT + 4, low + i) &&
                  write_bar(r, generated[i], most, y, "#c9c4b8") &&
                  write_bar(r, kept[i], most, y + BAR_HEIGHT + 1, "#5a7d4f");
    }
    return written &&
           tn_buffer_printf(r->page, "</svg></figure>\n<p class=\"quiet\">grey: generated; green: kept. The scale is "
                                     "logarithmic.</p>\n");
}
