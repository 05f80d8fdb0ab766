/* Writes a generation as a page. */
#include "driver/sheet/sheet_page.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/report/page.h"
#include "driver/sheet/sheet_script.h"

enum { ANCESTORS_MAX = 60, NARROW_MAX = 65535 };

/* ---- numbers, as the script reads them */

/* Three numbers, to so many digits. */
static void put_vector(tn_json *json, const char *key, const double v[3], int digits)
{
    tn_json_list(json, key);
    for (int k = 0; k < 3; k++)
        tn_json_rounded(json, NULL, v[k], digits);
    tn_json_list_end(json);
}

/* Little-endian, 2 bytes each or 4. */
static bool put_indices(tn_json *json, const char *key, const uint32_t *indices, size_t count, bool wide)
{
    size_t each = wide ? 4 : 2;
    uint8_t *bytes = malloc(each * count + 1);
    for (size_t i = 0; bytes && i < count; i++)
        for (size_t k = 0; k < each; k++)
            bytes[each * i + k] = (uint8_t)(indices[i] >> (8 * k));
    if (bytes)
        tn_json_base64(json, key, bytes, each * count);
    free(bytes);
    return bytes != NULL;
}

/* Each coordinate as a 65,536th of the longest side. */
static bool put_positions(tn_json *json, const tn_mesh *mesh)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, extent[3] = {0, 0, 0}, longest = 1e-300;
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        low[i % 3] = fmin(low[i % 3], mesh->positions[i]);
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        extent[i % 3] = fmax(extent[i % 3], mesh->positions[i] - low[i % 3]);
    for (int k = 0; k < 3; k++)
        longest = fmax(longest, extent[k]);
    uint8_t *bytes = malloc(6 * mesh->vertex_count + 1);
    for (size_t i = 0; bytes && i < 3 * mesh->vertex_count; i++) {
        uint32_t place = (uint32_t)lrint((mesh->positions[i] - low[i % 3]) / longest * NARROW_MAX);
        bytes[2 * i] = (uint8_t)place;
        bytes[2 * i + 1] = (uint8_t)(place >> 8);
    }
    put_vector(json, "low", low, 9);
    put_vector(json, "extent", extent, 9);
    tn_json_rounded(json, "size", longest, 9);
    if (bytes)
        tn_json_base64(json, "p", bytes, 6 * mesh->vertex_count);
    free(bytes);
    return bytes != NULL;
}

static void put_guide(tn_json *json, const tn_guides *guides, const tn_guide *g)
{
    static const char *const kinds[TN_GUIDE_KIND_COUNT] = {"attractor", "repeller", "arrow", "line", "area"};
    char label[120];
    tn_json_object(json, NULL);
    tn_json_string(json, "k", kinds[g->kind]);
    tn_json_string(json, "s", g->subject == TN_GUIDE_GROUND ? "ground" : "");
    tn_json_count(json, "d", g->dashed);
    snprintf(label, sizeof label, "%s %.4g", g->name ? g->name : "", g->value);
    if (g->name)
        tn_json_string(json, "n", label);
    tn_json_list(json, "p");
    for (uint32_t p = 0; p < g->count; p++)
        put_vector(json, NULL, guides->points[g->first + p], 5);
    tn_json_list_end(json);
    tn_json_object_end(json);
}

static tn_status put_form(const tn_run *run, const tn_individual *member, tn_json *json, tn_error *error)
{
    const tn_bred_forms *forms = &run->job->forms;
    tn_mesh mesh = {0};
    tn_guides guides = {0};
    tn_status status = forms->mesh(forms->context, member->sentence, &mesh, &guides, error);
    if (status == TN_OK)
        status = tn_mesh_triangulate(&mesh, error);
    bool wide = mesh.vertex_count > NARROW_MAX;
    tn_json_object(json, NULL);
    bool good = status == TN_OK && put_positions(json, &mesh) &&
                put_indices(json, "t", mesh.corners, 3 * mesh.face_count, wide) &&
                put_indices(json, "l", mesh.lines, 2 * mesh.line_count, wide);
    tn_json_count(json, "wide", wide);
    tn_json_list(json, "guides");
    for (size_t i = 0; i < guides.count; i++)
        put_guide(json, &guides, &guides.items[i]);
    tn_json_list_end(json);
    tn_json_object_end(json);
    tn_mesh_clear(&mesh);
    tn_guides_clear(&guides);
    return status == TN_OK && !good ? tn_fail_memory(error) : status;
}

/* ---- the page */

static bool put_parents(const tn_page *page, uint64_t id, const uint64_t parents[2])
{
    char text[160];
    if (parents[0] == TN_NO_PARENT)
        snprintf(text, sizeof text, "<li>#%" PRIu64 " has no parents</li>\n", id);
    else if (parents[1] == parents[0] || parents[1] == TN_NO_PARENT)
        snprintf(text, sizeof text, "<li>#%" PRIu64 " is of #%" PRIu64 "</li>\n", id, parents[0]);
    else
        snprintf(text, sizeof text, "<li>#%" PRIu64 " is of #%" PRIu64 " and #%" PRIu64 "</li>\n", id, parents[0],
                 parents[1]);
    return tn_page_html(page, text);
}

static bool put_script(const tn_page *page)
{
    bool good = tn_page_html(page, "<script>\n");
    for (size_t i = 0; i < sizeof tn_sheet_script / sizeof *tn_sheet_script && good; i++)
        good = tn_page_html(page, tn_sheet_script[i]);
    return good && tn_page_html(page, "</script>\n</body></html>\n");
}

/* Its parents, theirs and so on, each once. */
static bool put_ancestors(const tn_page *page, const tn_run_scores *births, const tn_individual *member)
{
    uint64_t line[ANCESTORS_MAX];
    size_t count = 1;
    bool good = true;
    line[0] = member->id;
    for (size_t i = 0; i < count && good; i++) {
        bool stored = line[i] < births->count && births->known[line[i]];
        if (i > 0 && !stored) /* a member that was just inserted is not stored yet */
            continue;
        const uint64_t *parents = i == 0 ? member->parents : births->parents[line[i]];
        good = put_parents(page, line[i], parents);
        for (int k = 0; k < 2; k++) {
            bool known = parents[k] == TN_NO_PARENT;
            for (size_t m = 0; m < count && !known; m++)
                known = line[m] == parents[k];
            if (!known && count < ANCESTORS_MAX)
                line[count++] = parents[k];
        }
    }
    return good;
}

static bool put_card(const tn_page *page, const tn_run_scores *births, const tn_individual *member, size_t i,
                     bool scored)
{
    char text[160];
    snprintf(text, sizeof text,
             "<div class=\"card form\" data-i=\"%zu\" data-number=\"%zu\"><canvas></canvas>\n<p><button>%zu</button> "
             "#%" PRIu64,
             i, i + 1, i + 1, member->id);
    bool good = tn_page_html(page, text);
    snprintf(text, sizeof text, ", score %.5g", member->score.objectives[0]);
    good = good && tn_page_html(page, scored ? text : "");
    return good && tn_page_html(page, "</p>\n<details><summary>genealogy</summary><ul>\n") &&
           put_ancestors(page, births, member) &&
           tn_page_html(page, "</ul></details>\n<details><summary>sentence</summary><pre>") &&
           tn_page_text(page, member->sentence) && tn_page_html(page, "</pre></details></div>\n");
}

static tn_status put_forms(const tn_run *run, const tn_page *page, size_t count)
{
    size_t all;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &all);
    tn_status status = tn_page_written(page, tn_page_html(page, "<script type=\"application/json\" id=\"forms\">"));
    tn_json json = tn_json_text(page->text, TN_JSON_TIGHT);
    json.layout.lines = 1;
    tn_json_list(&json, NULL);
    for (size_t i = 0; i < count && status == TN_OK; i++)
        status = put_form(run, members[i], &json, page->error);
    tn_json_list_end(&json);
    return status == TN_OK ? tn_page_written(page, tn_page_html(page, "</script>\n")) : status;
}

static bool put_cards(const tn_run *run, const tn_page *page, const tn_run_scores *births, size_t count)
{
    char title[60];
    size_t all;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &all);
    snprintf(title, sizeof title, "Generation %u", run->generations ? run->generations - 1 : 0);
    bool good =
        tn_page_begin(page, title, "Drag a form to turn them all. The numbers that you press are what to type.") &&
        tn_page_html(page, "<style>canvas{width:100%;aspect-ratio:1;touch-action:none}.chosen{background:#eef4e8}"
                           "#sheet{grid-template-columns:repeat(auto-fill,minmax(16rem,1fr))}</style>\n"
                           "<div class=\"controls\"><label>parents <input id=\"line\" size=\"40\"></label> "
                           "<label><input type=\"checkbox\" id=\"turn\"> turn</label></div>\n"
                           "<p id=\"none\" hidden>This browser cannot draw in space (WebGL 2).</p>\n"
                           "<div id=\"sheet\">\n");
    for (size_t i = 0; i < count && good; i++)
        good = put_card(page, births, members[i], i, run->job->scored || !run->job->settings.kind);
    return good && tn_page_html(page, "</div>\n");
}

static tn_status write_page(const tn_run *run, const tn_run_files *files, const tn_buffer *text, tn_error *error)
{
    tn_run_file file;
    tn_status status = tn_run_file_begin(run->dir, files, TN_SHEET_PAGE, &file, error);
    if (status != TN_OK)
        return status;
    fwrite(text->data, 1, text->size, file.stream); /* what fails shows when it is ended */
    return tn_run_file_end(&file, TN_OK, error);
}

tn_status tn_sheet_page(const tn_run *run, const tn_run_files *files, bool *written, tn_error *error)
{
    size_t all, count = 0;
    tn_buffer text = {0};
    tn_run_scores births = {0};
    const tn_page page = {.text = &text, .error = error};
    const tn_individual *const *members = tn_evolution_members(run->evolution, &all);
    while (count < all && members[count]->score.state == TN_SCORED)
        count++;
    *written = run->job->forms.mesh && count > 0;
    if (!*written)
        return TN_OK;
    tn_status status = run->store
                           ? tn_run_store_scores(run->store, tn_evaluator_numbers(&run->job->evaluator), &births, error)
                           : TN_OK;
    if (status == TN_OK)
        status = tn_page_written(&page, put_cards(run, &page, &births, count));
    if (status == TN_OK)
        status = put_forms(run, &page, count);
    if (status == TN_OK)
        status = tn_page_written(&page, put_script(&page));
    if (status == TN_OK)
        status = write_page(run, files, &text, error);
    tn_run_scores_clear(&births);
    free(text.data);
    return status;
}
