/* The parts of a kit's report: a card for each, with its picture and its connectors. */
#include <string.h>

#include "driver/place/shape.h"
#include "driver/report/kit_data.h"

static const char *const axes[TN_AXIS_COUNT] = {
    [TN_AXIS_UP] = "up",       [TN_AXIS_DOWN] = "down",   [TN_AXIS_LEFT] = "left",
    [TN_AXIS_RIGHT] = "right", [TN_AXIS_FRONT] = "front", [TN_AXIS_BACK] = "back"};

static const tn_part_connector_record *connector(const tn_kit_reporting *r, const tn_kit_part_record *part, uint32_t i)
{
    return &r->module->PART_CONNECTOR_records[part->connector_first + i];
}

/* ---- size */

static bool put_size(const tn_kit_reporting *r, const tn_kit_part_record *part)
{
    if (part->box_count == 0)
        return tn_page_html(&r->page, "<p>fills nothing");
    const tn_part_box_record *box = &r->module->PART_BOX_records[part->box_first];
    int64_t low[3] = {box->low_x, box->low_y, box->low_z}, high[3] = {box->high_x, box->high_y, box->high_z};
    for (uint32_t b = 1; b < part->box_count; b++) {
        const int64_t lows[3] = {box[b].low_x, box[b].low_y, box[b].low_z};
        const int64_t highs[3] = {box[b].high_x, box[b].high_y, box[b].high_z};
        for (int k = 0; k < 3; k++) {
            low[k] = lows[k] < low[k] ? lows[k] : low[k];
            high[k] = highs[k] > high[k] ? highs[k] : high[k];
        }
    }
    bool good = tn_buffer_printf(r->page.text, "<p>%lld x %lld x %lld cells (%.10g x %.10g x %.10g LDU)",
                                 (long long)(high[0] - low[0]), (long long)(high[1] - low[1]),
                                 (long long)(high[2] - low[2]), r->unit[0] * (double)(high[0] - low[0]),
                                 r->unit[1] * (double)(high[1] - low[1]), r->unit[2] * (double)(high[2] - low[2]));
    return good && (part->box_count == 1 ||
                    tn_buffer_printf(r->page.text, ", of which it fills %u boxes", (unsigned)part->box_count));
}

/* ---- connectors */

static bool is_alike(const tn_part_connector_record *a, const tn_part_connector_record *b)
{
    return a->type == b->type && a->axis == b->axis;
}

/* A length of so many cells: 0 is never -0. */
static double length(double unit, int64_t cells)
{
    return cells ? unit * (double)cells : 0;
}

/* A row for all connectors of a kind and direction, from the first of them. */
static bool put_row(const tn_kit_reporting *r, const tn_kit_part_record *part, uint32_t first)
{
    const tn_part_connector_record *one = connector(r, part, first);
    uint32_t count = 0;
    for (uint32_t i = first; i < part->connector_count; i++)
        count += is_alike(one, connector(r, part, i));
    bool good = tn_page_html(&r->page, "<tr><td>") && tn_kit_report_type(r, one->type) &&
                tn_buffer_printf(r->page.text, "</td><td>%s</td><td>%u</td><td>", axes[one->axis], (unsigned)count);
    for (uint32_t i = first; good && i < part->connector_count; i++) {
        const tn_part_connector_record *at = connector(r, part, i);
        if (is_alike(one, at))
            good = tn_buffer_printf(r->page.text, "%s(%.10g, %.10g, %.10g)", i == first ? "" : " ",
                                    length(r->unit[0], at->x), length(r->unit[1], -at->y), length(r->unit[2], at->z));
    }
    return good && tn_page_html(&r->page, "</td></tr>\n");
}

static bool put_connectors(const tn_kit_reporting *r, const tn_kit_part_record *part)
{
    if (part->connector_count == 0)
        return tn_page_html(&r->page, "<p class=\"quiet\">It has no connectors.</p>\n");
    bool good =
        tn_page_html(&r->page, "<table class=\"words\"><tr><th>connector</th><th>points</th><th></th><th>at</th>"
                               "</tr>\n");
    for (uint32_t i = 0; good && i < part->connector_count; i++) {
        uint32_t before = 0;
        while (before < i && !is_alike(connector(r, part, before), connector(r, part, i)))
            before++;
        good = before < i || put_row(r, part, i);
    }
    return good && tn_page_html(&r->page, "</table>\n");
}

/* ---- cards */

static bool put_title(const tn_kit_reporting *r, uint32_t index)
{
    const tn_kit_part_record *part = &r->module->KIT_PART_records[index];
    return tn_buffer_printf(r->page.text, "<section class=\"card\" id=\"part-%u\"><h3>", (unsigned)index) &&
           tn_page_text(&r->page, tn_text(r->module, part->name)) && tn_page_html(&r->page, " <small>") &&
           tn_page_text(&r->page, tn_text(r->module, part->title)) && tn_page_html(&r->page, "</small></h3>\n");
}

static bool put_figures(const tn_kit_reporting *r, const tn_kit_part_record *part)
{
    return put_size(r, part) && (part->mass == 0 || tn_buffer_printf(r->page.text, "; mass %.10g", part->mass)) &&
           (part->price == 0 || tn_buffer_printf(r->page.text, "; price %.10g", part->price)) &&
           tn_page_html(&r->page, "</p>\n");
}

static tn_status put_picture(tn_kit_reporting *r, uint32_t index)
{
    const tn_kit_part_record *part = &r->module->KIT_PART_records[index];
    if (part->box_count == 0 || index >= r->options.pictures)
        return TN_OK;
    tn_picture picture = tn_page_next_picture(&r->page);
    picture.watch = r->options.watch;
    tn_status status = tn_kit_part_draw(r->module, index, &picture, r->page.error);
    return tn_page_put_picture(&r->page, &picture, tn_text(r->module, part->name), status);
}

static tn_status put_part(tn_kit_reporting *r, uint32_t index)
{
    const tn_kit_part_record *part = &r->module->KIT_PART_records[index];
    if (r->options.watch && tn_watch_check(r->options.watch, r->page.error) != TN_OK)
        return TN_STOPPED;
    tn_status status = tn_page_written(&r->page, put_title(r, index));
    if (status == TN_OK)
        status = put_picture(r, index);
    if (status == TN_OK)
        status = tn_page_written(&r->page, put_figures(r, part) && put_connectors(r, part) &&
                                               tn_page_html(&r->page, "</section>\n"));
    return status;
}

static bool put_intro(const tn_kit_reporting *r)
{
    const uint32_t count = r->module->KIT_PART_count;
    bool good =
        tn_page_html(&r->page, "<h2 id=\"parts\">Parts</h2>\n<p class=\"quiet\">A stud stands for each connector, "
                               "in the colour of its kind and the direction in which it points.");
    if (good && count > r->options.pictures)
        good = tn_buffer_printf(r->page.text,
                                " The first %zu of %u parts have pictures; <code>--pictures %u</code> "
                                "draws them all.",
                                r->options.pictures, (unsigned)count, (unsigned)count);
    return good && tn_page_html(&r->page, "</p>\n<div class=\"best\">\n");
}

tn_status tn_kit_report_parts(tn_kit_reporting *r)
{
    tn_status status = tn_page_written(&r->page, put_intro(r));
    for (uint32_t i = 0; status == TN_OK && i < r->module->KIT_PART_count; i++)
        status = put_part(r, i);
    return status == TN_OK ? tn_page_written(&r->page, tn_page_html(&r->page, "</div>\n")) : status;
}
