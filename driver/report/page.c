/* Writes what pages have in common. */
#include "driver/report/page.h"

#include <stdlib.h>
#include <string.h>

#include "driver/open/open.h"
#include "runtime/base/utf8.h"

static const char style[] =
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
    ".figures{font-size:15px;margin:.6rem 0}.figures td.number,.figures "
    "th:nth-child(n+3){text-align:right;white-space:nowrap}\n"
    ".words td,.words th{text-align:left}.words .number{text-align:right;white-space:nowrap}.words .first "
    "td{border-top:1px solid #ddd}\n"
    ".swatch{display:inline-block;width:.8em;height:.8em}\n"
    ".bill td,.bill th{padding:.1rem .5rem}.bill td:first-child,.bill th:first-child,.compared "
    "th:first-child{text-align:left}.compared th:first-child{white-space:nowrap}\n"
    ".house h4{margin:.8rem 0 .2rem}.compared{font-size:14px}.compared td{max-width:24rem}\n"
    ".compared .differs td,.compared .differs th{background:#fdf3d8}.compared tr:not(.differs) td{color:#666}\n"
    ".side{display:flex;flex-wrap:wrap;gap:0 3rem;align-items:flex-start}\n"
    "#sheet{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(32rem,100%),1fr));gap:.8rem}\n"
    ".plan{border:1px solid #ddd;border-radius:6px;padding:.6rem;overflow:hidden;min-width:0}.plan p{margin:.2rem 0}\n"
    ".plan.dropped{border-left:5px solid #b33;grid-column:1/-1}.plan.kept{border-left:5px solid #373}\n"
    ".plan pre{font-size:12px}\n"
    ".best{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(24rem,100%),1fr));gap:.8rem}.best "
    "p{margin:.2rem 0}\n"
    ".controls{position:sticky;top:0;background:#fff;padding:.5rem 0}input,select{font:inherit;max-width:100%}\n"
    "[hidden]{display:none}\n</style>\n";

/* ---- texts */

bool tn_page_html(const tn_page *page, const char *html)
{
    return tn_buffer_append(page->text, html, strlen(html));
}

bool tn_page_text_part(const tn_page *page, const char *text, size_t size)
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
        written = entity ? tn_page_html(page, entity) : tn_buffer_append(page->text, text + i, step);
    }
    return written;
}

bool tn_page_text(const tn_page *page, const char *text)
{
    return tn_page_text_part(page, text, strlen(text));
}

bool tn_page_prose(const tn_page *page, const char *text)
{
    bool good = true;
    while (good && *text) {
        const char *open = strchr(text, '`'), *close = open ? strchr(open + 1, '`') : NULL;
        if (!close)
            return tn_page_text(page, text);
        good = tn_page_text_part(page, text, (size_t)(open - text)) && tn_page_html(page, "<code>") &&
               tn_page_text_part(page, open + 1, (size_t)(close - open - 1)) && tn_page_html(page, "</code>");
        text = close + 1;
    }
    return good;
}

/* ---- pictures */

tn_picture tn_page_next_picture(tn_page *page)
{
    return (tn_picture){.number = page->pictures++};
}

tn_status tn_page_put_picture(const tn_page *page, tn_picture *picture, const char *description, tn_status drawn)
{
    tn_status status = drawn;
    if (status == TN_OK)
        status = tn_page_written(page, tn_page_html(page, "<figure role=\"img\" aria-label=\"") &&
                                           tn_page_text(page, description) && tn_page_html(page, "\">\n") &&
                                           tn_buffer_append(page->text, picture->element, picture->size) &&
                                           tn_page_html(page, "</figure>\n"));
    free(picture->element);
    return status;
}

/* ---- head and foot */

bool tn_page_begin(const tn_page *page, const char *title, const char *doc)
{
    return tn_page_html(page, "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>") &&
           tn_page_text(page, title) && tn_page_html(page, "</title>\n") && tn_page_html(page, style) &&
           tn_page_html(page, "<h1>") && tn_page_text(page, title) && tn_page_html(page, "</h1>\n<p>") &&
           tn_page_text(page, doc) && tn_page_html(page, "</p>\n");
}

bool tn_page_params(const tn_page *page, const tn_opened *opened)
{
    char params[TN_PARAMS_TEXT_MAX];
    tn_opened_params_text(opened, params, sizeof params);
    return !params[0] || (tn_page_html(page, "<p>With <code>") && tn_page_text(page, params) &&
                          tn_page_html(page, "</code>, which <code>--set</code> says.</p>\n"));
}

bool tn_page_version(const tn_page *page, const tn_module *module)
{
    return tn_page_text(page, module->PRODUCER_count ? tn_text(module, module->PRODUCER_records[0].version) : "");
}

/* ---- findings */

/* "houses.plan:12: " */
static bool put_place(const tn_page *page, tn_opened *opened, bool has_span, tn_span span)
{
    if (!has_span)
        return true;
    tn_place where = tn_sources_place(&opened->compilation.sources, span);
    const char *slash = strrchr(where.path, '/');
    return tn_page_text(page, slash ? slash + 1 : where.path) &&
           tn_buffer_printf(page->text, ":%u: ", (unsigned)where.line);
}

/* A finding with its notes: what checking says at the terminal. */
bool tn_page_finding(const tn_page *page, tn_opened *opened, const tn_diagnostic *item)
{
    char code[8] = "";
    if (item->code != TN_CODE_NONE)
        tn_code_name(item->code, code);
    bool good = tn_page_html(page, "<div class=\"card\"><p>") && put_place(page, opened, item->has_span, item->span) &&
                (!*code || (tn_page_text(page, code) && tn_page_html(page, ": "))) &&
                tn_page_prose(page, item->message) && tn_page_html(page, "</p>\n");
    for (size_t n = 0; good && n < item->note_count; n++)
        good = tn_page_html(page, "<p class=\"quiet\">") &&
               put_place(page, opened, item->notes[n].has_span, item->notes[n].span) &&
               tn_page_prose(page, item->notes[n].text ? item->notes[n].text : "") && tn_page_html(page, "</p>\n");
    if (good && item->help)
        good = tn_page_html(page, "<p>") && tn_page_prose(page, item->help) && tn_page_html(page, "</p>\n");
    return good && tn_page_html(page, "</div>\n");
}

/* The warnings of checking, and its notes but for limits. */
bool tn_page_findings(const tn_page *page, tn_opened *opened)
{
    tn_diagnostics *found = &opened->compilation.diagnostics;
    bool good = tn_page_html(page, "<h2 id=\"findings\">Warnings</h2>\n"), any = false;
    tn_diagnostics_sort(found);
    for (size_t i = 0; good && i < found->count; i++) {
        const tn_diagnostic *item = &found->items[i];
        if ((item->severity != TN_WARNING && item->severity != TN_NOTE) || item->limit || !item->message)
            continue;
        good = tn_page_finding(page, opened, item);
        any = true;
    }
    return good && (any || tn_page_html(page, "<p class=\"quiet\"><code>tartan check</code> has no warnings.</p>\n"));
}

/* ---- limits */

/* Has an earlier limit the same place? Then it has the same cause. */
static bool is_told(const tn_diagnostics *found, size_t i)
{
    const tn_diagnostic *item = &found->items[i];
    for (size_t k = 0; k < i; k++) {
        const tn_diagnostic *other = &found->items[k];
        if (other->limit && other->has_span && item->has_span &&
            memcmp(&other->span, &item->span, sizeof item->span) == 0)
            return true;
    }
    return false;
}

static bool put_limit(const tn_page *page, tn_opened *opened, const tn_diagnostic *item)
{
    bool good = tn_page_html(page, "<li>") && put_place(page, opened, item->has_span, item->span) &&
                tn_page_prose(page, item->message);
    for (size_t n = 0; good && n < item->note_count; n++)
        good =
            tn_page_html(page, n ? ", " : " (") && tn_page_prose(page, item->notes[n].text ? item->notes[n].text : "");
    good = good && (item->note_count == 0 || tn_page_html(page, ")"));
    if (good && item->help)
        good = tn_page_html(page, "<br><span class=\"quiet\">") && tn_page_prose(page, item->help) &&
               tn_page_html(page, "</span>");
    return good && tn_page_html(page, "</li>\n");
}

static bool begin_limits(const tn_page *page, bool *begun)
{
    bool first = !*begun;
    *begun = true;
    return !first || tn_page_html(page, "<h2 id=\"limits\">What was not found out</h2>\n<ul>\n");
}

bool tn_page_limits(const tn_page *page, tn_opened *opened, const tn_buffer *more, size_t more_count)
{
    tn_diagnostics *found = &opened->compilation.diagnostics;
    bool good = true, any = false;
    tn_diagnostics_sort(found);
    for (size_t i = 0; good && i < found->count; i++) {
        const tn_diagnostic *item = &found->items[i];
        if (!item->limit || !item->message || is_told(found, i))
            continue;
        good = begin_limits(page, &any) && put_limit(page, opened, item);
    }
    for (size_t i = 0; good && i < more_count; i++)
        good =
            more[i].size == 0 || (begin_limits(page, &any) && tn_page_html(page, "<li>") &&
                                  tn_page_text_part(page, more[i].data, more[i].size) && tn_page_html(page, "</li>\n"));
    return good && (!any || tn_page_html(page, "</ul>\n"));
}
