/* Writes the report of a kit: the page, and its kinds of connectors. */
#include "driver/report/kit_report.h"

#include <inttypes.h>
#include <string.h>

#include "driver/report/kit_data.h"
#include "runtime/geometry/mesh.h"
#include "runtime/place/model/rules.h"

/* ---- what the parts of the page share */

bool tn_kit_report_type(const tn_kit_reporting *r, uint32_t type)
{
    unsigned char rgb[3];
    tn_group_colour(type, rgb);
    return tn_buffer_printf(r->page.text, "<span class=\"swatch\" style=\"background:#%02x%02x%02x\"></span> ",
                            (unsigned)rgb[0], (unsigned)rgb[1], (unsigned)rgb[2]) &&
           tn_page_text(&r->page, tn_text(r->module, r->module->CONNECTOR_TYPE_records[type].name));
}

bool tn_kit_report_source(const tn_kit_reporting *r, uint32_t file, uint32_t begin, uint32_t end)
{
    const char *text = tn_text(r->module, r->module->SOURCE_records[file].text);
    return tn_page_text_part(&r->page, text + begin, end - begin);
}

/* ---- kinds of connectors */

static bool put_type(const tn_kit_reporting *r, uint32_t type)
{
    static const char *const alike[] = {"", "none", "2 of 4", "", "all"};
    const tn_connector_type_record *record = &r->module->CONNECTOR_TYPE_records[type];
    uint32_t count = 0;
    for (uint32_t i = 0; i < r->module->PART_CONNECTOR_count; i++)
        count += r->module->PART_CONNECTOR_records[i].type == type;
    return tn_page_html(&r->page, "<tr><td>") && tn_kit_report_type(r, type) && tn_page_html(&r->page, "</td><td>") &&
           tn_kit_report_type(r, record->joins) &&
           tn_buffer_printf(r->page.text, "</td><td>%s</td><td>%u</td></tr>\n",
                            record->turns <= 4 ? alike[record->turns] : "", (unsigned)count);
}

static bool put_types(const tn_kit_reporting *r)
{
    const uint32_t count = r->module->CONNECTOR_TYPE_count;
    bool good = tn_page_html(&r->page, "<h2 id=\"connectors\">Connectors</h2>\n");
    if (count == 0)
        return good && tn_page_html(&r->page, "<p class=\"quiet\">The kit has no connectors: its parts join "
                                              "nothing.</p>\n");
    good =
        good && tn_page_html(&r->page, "<table class=\"words\"><tr><th>kind</th><th>joins</th><th>quarter turns that "
                                       "are alike</th><th>connectors of all parts</th></tr>\n");
    for (uint32_t i = 0; good && i < count; i++)
        good = put_type(r, i);
    return good && tn_page_html(&r->page, "</table>\n");
}

/* ---- the page */

static const char *plural(uint32_t count)
{
    return count == 1 ? "" : "s";
}

static bool put_head(const tn_kit_reporting *r)
{
    const tn_module *module = r->module;
    const tn_kit_record *kit = &module->KIT_records[0];
    const char *slash = strrchr(r->opened->path, '/');
    const uint32_t parts = module->KIT_PART_count, types = module->CONNECTOR_TYPE_count,
                   models = module->KIT_MODEL_count;
    char doc[200];
    snprintf(doc, sizeof doc, "A kit with %u part%s, %u kind%s of connectors and %u model%s.", (unsigned)parts,
             plural(parts), (unsigned)types, plural(types), (unsigned)models, plural(models));
    return tn_page_begin(&r->page, tn_text(module, kit->name), doc) && tn_page_html(&r->page, "<p class=\"quiet\">") &&
           tn_page_text(&r->page, slash ? slash + 1 : r->opened->path) &&
           tn_buffer_printf(r->page.text,
                            "; a cell is %.10g x %.10g x %.10g LDU (wide, high, deep); parts %s. Lengths are in LDU, "
                            "which is 0.4 mm, and y points up.</p>\n",
                            r->unit[0], r->unit[1], r->unit[2],
                            kit->turns == 24 ? "turn any of 24 ways" : "stay upright") &&
           tn_page_html(&r->page, "<nav><a href=\"#models\">Models</a> <a href=\"#connectors\">Connectors</a> <a "
                                  "href=\"#rules\">Rules</a> <a href=\"#parts\">Parts</a> <a "
                                  "href=\"#findings\">Warnings</a></nav>\n");
}

static bool put_foot(const tn_kit_reporting *r)
{
    const tn_module *module = r->module;
    return tn_buffer_printf(r->page.text, "<p class=\"quiet\">rules %016" PRIx64 ", seed %u, ",
                            module->PRODUCER_count ? (uint64_t)module->PRODUCER_records[0].sources_hash : 0,
                            (unsigned)r->options.seed) &&
           tn_page_version(&r->page, module) && tn_page_html(&r->page, "</p>\n</html>\n");
}

static tn_kit_report_options with_defaults(const tn_kit_report_options *options)
{
    tn_kit_report_options o = *options;
    o.pictures = o.pictures ? o.pictures : TN_KIT_REPORT_PICTURES;
    o.part_limit = o.part_limit ? o.part_limit : TN_KIT_REPORT_PARTS;
    o.step_limit = o.step_limit ? o.step_limit : TN_KIT_REPORT_STEPS;
    o.search_limit = o.search_limit ? o.search_limit : TN_KIT_REPORT_SEARCH;
    return o;
}

tn_status tn_kit_report_page(tn_opened *opened, const tn_kit_report_options *options, tn_buffer *page,
                             tn_kit_report_tally *tally, tn_error *error)
{
    tn_kit_reporting r = {.opened = opened,
                          .module = opened->module,
                          .options = with_defaults(options),
                          .tally = tally,
                          .page = {.text = page, .error = error}};
    *tally = (tn_kit_report_tally){.models = opened->module->KIT_MODEL_count};
    tn_place_unit(r.module, r.unit);
    tn_status status = tn_page_written(&r.page, put_head(&r));
    if (status == TN_OK)
        status = tn_kit_report_models(&r);
    if (status == TN_OK)
        status = tn_page_written(&r.page, put_types(&r));
    if (status == TN_OK)
        status = tn_kit_report_rules(&r);
    if (status == TN_OK)
        status = tn_kit_report_parts(&r);
    return status == TN_OK ? tn_page_written(&r.page, tn_page_findings(&r.page, opened) && put_foot(&r)) : status;
}
