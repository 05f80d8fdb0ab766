/* Writes a generation as a page. */
#include "driver/sheet/sheet_page.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/report/page.h"
#include "runtime/genome/picture/sheet.h"

/* clang-format off */
static const char *const tn_sheet_script[] = {
    "'use strict';\n",
    "const D = JSON.parse(document.getElementById('forms').textContent);\n",
    "const cards = [...document.querySelectorAll('.form')], line = document.getElementById('line');\n",
    "const turn = document.getElementById('turn');\n",
    "let azimuth = -60, elevation = 30;\n",
    "const bytes = s => Uint8Array.from(atob(s), c => c.charCodeAt(0)).buffer;\n",
    "const gl = document.createElement('canvas').getContext('webgl2', {antialias: true, preserveDrawingBuffer: true});\n",
    "const vertex = `#version 300 es\n",
    "in vec3 p; uniform vec3 size, low; uniform mat3 eye; uniform float zoom; out vec3 v;\n",
    "void main() { v = eye * (p * size + low) * zoom; gl_Position = vec4(v.xy, -v.z * 0.4, 1.0); }`;\n",
    "const fragment = `#version 300 es\n",
    "precision highp float; in vec3 v; uniform float line; out vec4 colour;\n",
    "void main() {\n",
    "  if (line > 0.0) { colour = vec4(0.16, 0.2, 0.26, 1) * line; return; }\n",
    "  vec3 n = normalize(cross(dFdx(v), dFdy(v)));\n",
    "  float light = 0.45 + 0.55 * abs(dot(n, normalize(vec3(-0.45, 0.6, 0.66))));\n",
    "  colour = vec4(vec3(0.98, 0.97, 0.93) * light, 1);\n",
    "}`;\n",
    "let program, place = {};\n",
    "function prepare() {\n",
    "  program = gl.createProgram();\n",
    "  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {\n",
    "    const shader = gl.createShader(kind);\n",
    "    gl.shaderSource(shader, text);\n",
    "    gl.compileShader(shader);\n",
    "    gl.attachShader(program, shader);\n",
    "  }\n",
    "  gl.bindAttribLocation(program, 0, 'p');\n",
    "  gl.linkProgram(program);\n",
    "  gl.useProgram(program);\n",
    "  for (const name of ['size', 'low', 'eye', 'zoom', 'line']) place[name] = gl.getUniformLocation(program, name);\n",
    "  gl.enable(gl.DEPTH_TEST);\n",
    "  gl.enable(gl.POLYGON_OFFSET_FILL);\n",
    "  gl.polygonOffset(1, 1);\n",
    "  gl.clearColor(0, 0, 0, 0);\n",
    "}\n",
    "function upload(form) {\n",
    "  const fill = (target, data) => { const b = gl.createBuffer(); gl.bindBuffer(target, b); gl.bufferData(target, data, gl.STATIC_DRAW); return b; };\n",
    "  form.type = form.wide ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT;\n",
    "  form.vao = gl.createVertexArray();\n",
    "  gl.bindVertexArray(form.vao);\n",
    "  fill(gl.ARRAY_BUFFER, bytes(form.p));\n",
    "  gl.enableVertexAttribArray(0);\n",
    "  gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, true, 6, 0);\n",
    "  gl.bindVertexArray(null);\n",
    "  const t = bytes(form.t), l = bytes(form.l), each = form.wide ? 4 : 2;\n",
    "  form.triangles = fill(gl.ELEMENT_ARRAY_BUFFER, t);\n",
    "  form.lines = fill(gl.ELEMENT_ARRAY_BUFFER, l);\n",
    "  form.triangleCount = t.byteLength / each;\n",
    "  form.lineCount = l.byteLength / each;\n",
    "  form.ready = true;\n",
    "}\n",
    "/* The eye's axes, as in the pictures of sheets: right, up, towards it. */\n",
    "function axes() {\n",
    "  const a = azimuth * Math.PI / 180, e = elevation * Math.PI / 180, s = Math.sin, c = Math.cos;\n",
    "  return [[-s(a), c(a), 0], [-s(e) * c(a), -s(e) * s(a), c(e)], [c(e) * c(a), c(e) * s(a), s(e)]];\n",
    "}\n",
    "function drawForm(form, eye, side) {\n",
    "  if (!form.ready) upload(form);\n",
    "  gl.viewport(0, 0, side, side);\n",
    "  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);\n",
    "  gl.uniform3fv(place.size, [form.size, form.size, form.size]);\n",
    "  gl.uniform3fv(place.low, form.low.map((x, k) => x - form.middle[k]));\n",
    "  gl.uniformMatrix3fv(place.eye, true, eye.flat());\n",
    "  gl.uniform1f(place.zoom, 0.8 / form.radius);\n",
    "  gl.bindVertexArray(form.vao);\n",
    "  gl.uniform1f(place.line, 0);\n",
    "  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, form.triangles);\n",
    "  gl.drawElements(gl.TRIANGLES, form.triangleCount, form.type, 0);\n",
    "  if (!form.lineCount) return;\n",
    "  gl.uniform1f(place.line, Math.max(0.35, Math.min(1, 20 / Math.sqrt(form.lineCount / 2))));\n",
    "  gl.enable(gl.BLEND);\n",
    "  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);\n",
    "  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, form.lines);\n",
    "  gl.drawElements(gl.LINES, form.lineCount, form.type, 0);\n",
    "  gl.disable(gl.BLEND);\n",
    "}\n",
    "const colours = {attractor: '#1a7a38', repeller: '#c22923', arrow: '#333'};\n",
    "function drawGuides(pen, form, eye, side, below) {\n",
    "  const scale = 0.4 * side / form.radius, half = side / 2;\n",
    "  const at = p => { const d = p.map((x, k) => x - form.middle[k]);\n",
    "    const on = r => r[0] * d[0] + r[1] * d[1] + r[2] * d[2]; return [half + on(eye[0]) * scale, half - on(eye[1]) * scale]; };\n",
    "  for (const g of form.guides) {\n",
    "    if ((g.k === 'area') !== below) continue;\n",
    "    const points = g.p.map(at);\n",
    "    pen.beginPath();\n",
    "    pen.setLineDash(g.d ? [6, 5] : []);\n",
    "    if (g.k === 'area' || g.k === 'line') {\n",
    "      points.forEach((p, i) => i ? pen.lineTo(...p) : pen.moveTo(...p));\n",
    "      pen.fillStyle = g.s === 'ground' ? 'rgba(90,80,66,.12)' : 'rgba(46,92,173,.05)';\n",
    "      pen.strokeStyle = 'rgba(46,92,173,.45)';\n",
    "      if (below) pen.fill(); else pen.stroke();\n",
    "      continue;\n",
    "    }\n",
    "    pen.strokeStyle = pen.fillStyle = colours[g.k];\n",
    "    const p = points[0], q = points[points.length - 1];\n",
    "    if (g.k === 'arrow') {\n",
    "      const a = Math.atan2(q[1] - p[1], q[0] - p[0]);\n",
    "      pen.lineWidth = 2;\n",
    "      pen.moveTo(...p); pen.lineTo(...q);\n",
    "      for (const w of [-0.4, 0.4]) { pen.moveTo(...q); pen.lineTo(q[0] - 12 * Math.cos(a + w), q[1] - 12 * Math.sin(a + w)); }\n",
    "      pen.stroke();\n",
    "    } else {\n",
    "      pen.arc(p[0], p[1], 6, 0, 7);\n",
    "      pen.lineWidth = 3;\n",
    "      if (g.k === 'attractor') pen.fill(); else pen.stroke();\n",
    "    }\n",
    "    pen.lineWidth = 1;\n",
    "    pen.fillStyle = '#333';\n",
    "    if (!g.n) continue;\n",
    "    const wide = pen.measureText(g.n).width, left = p[0] + 10 + wide > side;\n",
    "    pen.textAlign = g.k === 'arrow' ? 'center' : left ? 'right' : 'left';\n",
    "    if (g.k === 'arrow') pen.fillText(g.n, Math.min(p[0], side - wide / 2 - 4), p[1] - 10);\n",
    "    else pen.fillText(g.n, left ? p[0] - 10 : p[0] + 10, p[1] + 4);\n",
    "  }\n",
    "}\n",
    "function draw(card) {\n",
    "  const form = D[card.dataset.i], canvas = card.querySelector('canvas'), pen = canvas.getContext('2d'), eye = axes();\n",
    "  const side = Math.round(canvas.clientWidth * (window.devicePixelRatio || 1));\n",
    "  if (!side) return;\n",
    "  if (canvas.width !== side) canvas.width = canvas.height = side;\n",
    "  pen.clearRect(0, 0, side, side);\n",
    "  pen.font = Math.round(side / 24) + 'px sans-serif';\n",
    "  drawGuides(pen, form, eye, side, true);\n",
    "  if (gl.canvas.width !== side) gl.canvas.width = gl.canvas.height = side;\n",
    "  drawForm(form, eye, side);\n",
    "  pen.drawImage(gl.canvas, 0, 0);\n",
    "  drawGuides(pen, form, eye, side, false);\n",
    "}\n",
    "const seen = new Set();\n",
    "let last = 0, stale = true;\n",
    "function frame(now) {\n",
    "  if (turn.checked) { azimuth += Math.min(now - last, 100) * 0.012; stale = true; }\n",
    "  last = now;\n",
    "  if (stale) seen.forEach(draw);\n",
    "  stale = false;\n",
    "  requestAnimationFrame(frame);\n",
    "}\n",
    "function begin() {\n",
    "  prepare();\n",
    "  for (const form of D) {\n",
    "    form.middle = form.low.map((x, k) => x + form.extent[k] / 2);\n",
    "    form.radius = Math.max(Math.hypot(...form.extent) / 2, 1e-9);\n",
    "  }\n",
    "  const watcher = new IntersectionObserver(list => list.forEach(e => {\n",
    "    if (e.isIntersecting) seen.add(e.target); else seen.delete(e.target);\n",
    "    stale = true;\n",
    "  }));\n",
    "  cards.forEach(card => watcher.observe(card));\n",
    "  turn.checked = !matchMedia('(prefers-reduced-motion: reduce)').matches;\n",
    "  for (const card of cards) {\n",
    "    const canvas = card.querySelector('canvas');\n",
    "    canvas.addEventListener('pointermove', e => {\n",
    "      if (!e.buttons) return;\n",
    "      azimuth -= e.movementX * 0.5;\n",
    "      elevation = Math.max(-90, Math.min(90, elevation + e.movementY * 0.5));\n",
    "      turn.checked = false;\n",
    "      stale = true;\n",
    "    });\n",
    "  }\n",
    "  addEventListener('resize', () => { stale = true; });\n",
    "  requestAnimationFrame(frame);\n",
    "}\n",
    "for (const card of cards)\n",
    "  card.querySelector('button').addEventListener('click', () => {\n",
    "    card.classList.toggle('chosen');\n",
    "    line.value = cards.filter(c => c.classList.contains('chosen')).map(c => c.dataset.number).join(' ');\n",
    "  });\n",
    "if (gl) begin(); else document.getElementById('none').hidden = false;\n",
};
/* clang-format on */

/* ---- a generation on a sheet */

#define LABEL_BYTES 64u

/* "3  #47  1.5 parent": with its id where it can be named by that later on, and whether it is a parent. */
static void write_label(const tn_run *run, size_t i, const tn_individual *member, char label[LABEL_BYTES])
{
    if (!run->job->settings.kind) {
        snprintf(label, LABEL_BYTES, "%zu   (score %.5g)", i + 1, member->score.objectives[0]);
        return;
    }
    int size = snprintf(label, LABEL_BYTES, "%zu  #%" PRIu64, i + 1, member->id);
    if (run->job->scored)
        size += snprintf(label + size, LABEL_BYTES - (size_t)size, "  %.4g", member->score.objectives[0]);
    bool parent = member->stayed || member->kind == TN_BIRTH_SEED;
    snprintf(label + size, LABEL_BYTES - (size_t)size, "%s", parent ? " parent" : "");
}

/* Forms are drawn as they are, in the members' order; those without a score come last and are not drawn. */
static tn_status draw_forms(const tn_run *run, size_t scored, tn_picture *to, tn_error *error)
{
    size_t count;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    const char **sentences = calloc(scored, sizeof *sentences), **labels = calloc(scored, sizeof *labels);
    char *text = malloc(scored * LABEL_BYTES), title[80];
    tn_status status = sentences && labels && text ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < scored; i++) {
        write_label(run, i, members[i], text + i * LABEL_BYTES);
        sentences[i] = members[i]->sentence;
        labels[i] = text + i * LABEL_BYTES;
    }
    snprintf(title, sizeof title, "generation %u", run->generations ? run->generations - 1 : 0);
    if (scored < count)
        snprintf(title + strlen(title), 40, "; %zu more have no %s", count - scored, run->job->forms.what);
    if (status == TN_OK)
        status = run->job->forms.draw(run->job->forms.context, sentences, labels, scored, title, to, error);
    free(sentences);
    free(labels);
    free(text);
    return status;
}

static size_t count_scored(const tn_run *run)
{
    size_t count, scored = 0;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    while (scored < count && members[scored]->score.state == TN_SCORED)
        scored++;
    return scored;
}

tn_status tn_run_sheet(const tn_run *run, const tn_run_files *files, char name[TN_SHEET_NAME_SIZE], tn_error *error)
{
    size_t count, scored = run->job->forms.context ? count_scored(run) : 0;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    tn_run_picture picture;
    snprintf(name, TN_SHEET_NAME_SIZE, "sheet-%04u%s", run->generations ? run->generations - 1 : 0,
             scored ? run->job->forms.picture : ".svg");
    tn_status status = tn_run_picture_begin(run->dir, files, name, &picture, error);
    if (status == TN_OK)
        status = scored ? draw_forms(run, scored, &picture.to, error)
                        : tn_sentences_draw(members, count, run->job->grammar->name, &picture.to, error);
    return tn_run_picture_end(&picture, status, error);
}

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
