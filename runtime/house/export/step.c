/* Writes instances of STEP text, identifiers and simple shapes. */
#include "runtime/house/export/step.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/base/utf8.h"

void tn_stepfile_clear(tn_stepfile *step)
{
    free(step->text.data);
    free(step->ids.taken);
    *step = (tn_stepfile){0};
}

/* What an instance begins with, and most have room in. */
enum { INSTANCE_ROOM = 400 };

static void put_number(tn_buffer *text, const char *before, unsigned number)
{
    char digits[12];
    size_t size = sizeof digits, length = strlen(before);
    do
        digits[--size] = (char)('0' + number % 10);
    while (number /= 10);
    tn_buffer_append(text, before, length);
    tn_buffer_append(text, digits + size, sizeof digits - size);
}

unsigned tn_stepfile_add(tn_stepfile *step, const char *format, ...)
{
    va_list args, again;
    tn_buffer *text = &step->text;
    put_number(text, "#", ++step->last);
    tn_buffer_append(text, "=", 1);
    if (!tn_buffer_reserve(text, INSTANCE_ROOM))
        return step->last;
    va_start(args, format);
    va_copy(again, args);
    int size = vsnprintf(text->data + text->size, INSTANCE_ROOM, format, args);
    if (size >= INSTANCE_ROOM && tn_buffer_reserve(text, (size_t)size))
        vsnprintf(text->data + text->size, (size_t)size + 1, format, again);
    va_end(again);
    va_end(args);
    text->size += size >= 0 && !text->failed ? (size_t)size : 0;
    text->failed |= size < 0;
    tn_buffer_append(text, ";\n", 2);
    return step->last;
}

/* ---- numbers */

#define FOOT_NM 304800000.0
#define SQUARE_FOOT_M2 0.09290304
#define CUBIC_FOOT_M3 0.028316846592

/* `number` is in units of the last of the digits after the point. */
static tn_stepfile_number decimal(double number, int digits)
{
    tn_stepfile_number to;
    char written[40];
    long long rounded = llround(number);
    unsigned long long left = rounded < 0 ? 0ULL - (unsigned long long)rounded : (unsigned long long)rounded;
    size_t at = sizeof written, end;
    for (int i = 0; i < digits || left; i++) {
        if (i == digits)
            written[--at] = '.';
        written[--at] = (char)('0' + left % 10);
        left /= 10;
    }
    if (at + (size_t)digits == sizeof written) { /* below 1 */
        written[--at] = '.';
        written[--at] = '0';
    }
    for (end = sizeof written; written[end - 1] == '0';)
        end--;
    size_t size = end - at, sign = rounded < 0;
    to.text[0] = '-';
    memcpy(to.text + sign, written + at, size);
    to.text[sign + size] = '\0';
    return to;
}

tn_stepfile_number tn_stepfile_real(double number, int digits)
{
    double scale = 1;
    for (int i = 0; i < digits; i++)
        scale *= 10;
    return decimal(number * scale, digits);
}

tn_stepfile_number tn_stepfile_length(const tn_stepfile *step, double nanometres)
{
    return step->feet ? decimal(nanometres * (1e12 / FOOT_NM), 12) : decimal(nanometres * 1e3, 9);
}

tn_stepfile_number tn_stepfile_area(const tn_stepfile *step, double square_metres)
{
    return tn_stepfile_real(step->feet ? square_metres / SQUARE_FOOT_M2 : square_metres, 6);
}

tn_stepfile_number tn_stepfile_volume(const tn_stepfile *step, double cubic_metres)
{
    return tn_stepfile_real(step->feet ? cubic_metres / CUBIC_FOOT_M3 : cubic_metres, 9);
}

/* ---- identifiers */

/* Where a hash is, or would be, in the table. */
static size_t slot_of(const tn_stepfile_ids *ids, uint64_t hash)
{
    size_t at = (size_t)hash & (ids->room - 1);
    while (ids->taken[at] != 0 && ids->taken[at] != hash)
        at = (at + 1) & (ids->room - 1);
    return at;
}

static bool grow_ids(tn_stepfile_ids *ids)
{
    tn_stepfile_ids wider = {.room = ids->room ? 2 * ids->room : 1024, .count = ids->count};
    wider.taken = calloc(wider.room, sizeof *wider.taken);
    if (!wider.taken)
        return false;
    for (size_t i = 0; i < ids->room; i++)
        if (ids->taken[i])
            wider.taken[slot_of(&wider, ids->taken[i])] = ids->taken[i];
    free(ids->taken);
    *ids = wider;
    return true;
}

/* False: it was taken before. */
static bool take_id(tn_stepfile *step, uint64_t hash)
{
    tn_stepfile_ids *ids = &step->ids;
    if (2 * ids->count >= ids->room && !grow_ids(ids)) {
        step->text.failed = true;
        return true;
    }
    size_t at = slot_of(ids, hash);
    if (ids->taken[at])
        return false;
    ids->taken[at] = hash;
    ids->count++;
    return true;
}

enum { KEY_ROOM = 1200 };

/* The alphabet and the order of bits are those of buildingSMART's compressed GUIDs. */
tn_stepfile_id tn_stepfile_guid(tn_stepfile *step, const char *key, ...)
{
    static const char digits[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
    char part[KEY_ROOM];
    tn_stepfile_id id;
    va_list args;
    va_start(args, key);
    int written = vsnprintf(part, sizeof part, key, args);
    va_end(args);
    size_t size = written < KEY_ROOM ? (size_t)(written < 0 ? 0 : written) : sizeof part - 1;
    XXH128_hash_t hash = XXH3_128bits_withSeed(part, size, step->seed);
    for (uint64_t number = 1; !take_id(step, hash.low64 | 1); number++)
        hash = XXH3_128bits_withSeed(part, size, step->seed + number);
    uint64_t high = hash.high64, low = hash.low64;
    for (int i = 21; i >= 0; i--) {
        id.text[i] = digits[low & 63];
        low = low >> 6 | high << 58;
        high >>= 6;
    }
    id.text[22] = '\0';
    return id;
}

/* ---- texts */

/* A text as it is encoded (ISO 10303-21, 6.4.3). open: the digits of a character in the run of hexadecimal ones at
 * hand, 0 outside of one. */
typedef struct encoding {
    char *to;
    size_t size;
    int open;
} encoding;

enum {
    CHARACTER_ROOM = 24, /* a run closed, another opened with one character and closed, a zero byte */
    MOST_OF_BYTE = 12    /* a byte that is no character is a run of one: \X2\FFFD\X0\ */
};

/* Ends a run, begins another, or goes on. */
static void turn(encoding *e, int digits)
{
    if (e->open == digits)
        return;
    e->size += (size_t)sprintf(e->to + e->size, "%s%s", e->open ? "\\X0\\" : "",
                               digits == 4   ? "\\X2\\"
                               : digits == 8 ? "\\X4\\"
                                             : "");
    e->open = digits;
}

static void encode_character(encoding *e, uint32_t character)
{
    if (character >= ' ' && character <= '~') {
        turn(e, 0);
        if (character == '\'' || character == '\\')
            e->to[e->size++] = (char)character;
        e->to[e->size++] = (char)character;
    } else {
        turn(e, character > UINT16_MAX ? 8 : 4);
        e->size += (size_t)sprintf(e->to + e->size, "%0*" PRIX32, e->open, character);
    }
}

/* As many whole characters as there is room for, and a zero byte; returns the length. */
static size_t encode_text(const char *text, size_t room, char *to)
{
    encoding e = {to, 0, 0};
    for (size_t left = strlen(text), step; left && e.size + CHARACTER_ROOM <= room; text += step, left -= step)
        encode_character(&e, tn_utf8_read(text, left, &step));
    turn(&e, 0);
    to[e.size] = '\0';
    return e.size;
}

tn_stepfile_name tn_stepfile_text(const char *text)
{
    tn_stepfile_name name;
    encode_text(text, sizeof name.text, name.text);
    return name;
}

bool tn_stepfile_put_text(tn_buffer *to, const char *text)
{
    size_t room = MOST_OF_BYTE * strlen(text) + CHARACTER_ROOM;
    if (!tn_buffer_reserve(to, room))
        return false;
    to->size += encode_text(text, room, to->data + to->size);
    return true;
}

/* ---- lists */

void tn_stepfile_list_add(tn_stepfile_list *list, unsigned instance)
{
    put_number(&list->text, list->count++ ? ",#" : "(#", instance);
}

const char *tn_stepfile_list_text(tn_stepfile_list *list)
{
    if (list->count)
        tn_buffer_append(&list->text, ")", 2);
    return list->count && !list->text.failed ? list->text.data : NULL;
}

void tn_stepfile_list_clear(tn_stepfile_list *list)
{
    free(list->text.data);
    *list = (tn_stepfile_list){0};
}

/* ---- shapes */

static unsigned put_point_at(tn_stepfile *step, double x, double y, double z)
{
    return tn_stepfile_add(step, "IFCCARTESIANPOINT((%s,%s,%s))", tn_stepfile_length(step, x).text,
                           tn_stepfile_length(step, y).text, tn_stepfile_length(step, z).text);
}

unsigned tn_stepfile_placement(tn_stepfile *step, unsigned within, double x, double y, double z)
{
    unsigned axes = step->axes;
    if (x != 0 || y != 0 || z != 0)
        axes = tn_stepfile_add(step, "IFCAXIS2PLACEMENT3D(#%u,$,$)", put_point_at(step, x, y, z));
    if (within == 0)
        return tn_stepfile_add(step, "IFCLOCALPLACEMENT($,#%u)", axes);
    return tn_stepfile_add(step, "IFCLOCALPLACEMENT(#%u,#%u)", within, axes);
}

unsigned tn_stepfile_turned(tn_stepfile *step, unsigned within, double x, double y, double z, int turns)
{
    unsigned point = put_point_at(step, x, y, z);
    unsigned axes = turns == 0
                        ? tn_stepfile_add(step, "IFCAXIS2PLACEMENT3D(#%u,$,$)", point)
                        : tn_stepfile_add(step, "IFCAXIS2PLACEMENT3D(#%u,#%u,#%u)", point, step->z, step->along[turns]);
    return tn_stepfile_add(step, "IFCLOCALPLACEMENT(#%u,#%u)", within, axes);
}

static unsigned styled(tn_stepfile *step, unsigned solid)
{
    if (step->style)
        tn_stepfile_add(step, "IFCSTYLEDITEM(#%u,(#%u),$)", solid, step->style);
    return solid;
}

unsigned tn_stepfile_extruded(tn_stepfile *step, unsigned profile, double from, double high)
{
    unsigned axes = step->axes;
    if (from != 0)
        axes = tn_stepfile_add(step, "IFCAXIS2PLACEMENT3D(#%u,$,$)", put_point_at(step, 0, 0, from));
    return styled(step, tn_stepfile_add(step, "IFCEXTRUDEDAREASOLID(#%u,#%u,#%u,%s)", profile, axes, step->z,
                                        tn_stepfile_length(step, high).text));
}

unsigned tn_stepfile_solid(tn_stepfile *step, const double low[3], const double high[3])
{
    unsigned middle =
        tn_stepfile_add(step, "IFCCARTESIANPOINT((%s,%s))", tn_stepfile_length(step, (low[0] + high[0]) / 2).text,
                        tn_stepfile_length(step, (low[1] + high[1]) / 2).text);
    unsigned flat = tn_stepfile_add(step, "IFCAXIS2PLACEMENT2D(#%u,$)", middle);
    unsigned profile = tn_stepfile_add(step, "IFCRECTANGLEPROFILEDEF(.AREA.,$,#%u,%s,%s)", flat,
                                       tn_stepfile_length(step, high[0] - low[0]).text,
                                       tn_stepfile_length(step, high[1] - low[1]).text);
    return tn_stepfile_extruded(step, profile, low[2], high[2] - low[2]);
}

unsigned tn_stepfile_ring(tn_stepfile *step, const double (*corners)[2], size_t count, bool back)
{
    tn_stepfile_list points = {0};
    for (size_t i = 0; i < count; i++) {
        const double *corner = corners[back ? count - 1 - i : i];
        tn_stepfile_list_add(&points, tn_stepfile_add(step, "IFCCARTESIANPOINT((%s,%s))",
                                                      tn_stepfile_length(step, corner[0]).text,
                                                      tn_stepfile_length(step, corner[1]).text));
    }
    tn_stepfile_list_add(&points, step->last + 1 - (unsigned)count); /* the first again */
    const char *list = tn_stepfile_list_text(&points);
    unsigned line = tn_stepfile_add(step, "IFCPOLYLINE(%s)", list ? list : "()");
    step->text.failed |= !list;
    tn_stepfile_list_clear(&points);
    return line;
}

unsigned tn_stepfile_curve(tn_stepfile *step, const double (*points)[2], size_t count)
{
    tn_buffer text = {0};
    for (size_t i = 0; i < count; i++)
        tn_buffer_printf(&text, "%s(%s,%s)", i ? "," : "", tn_stepfile_length(step, points[i][0]).text,
                         tn_stepfile_length(step, points[i][1]).text);
    unsigned list = tn_stepfile_add(step, "IFCCARTESIANPOINTLIST2D((%s))", text.data ? text.data : "");
    step->text.failed |= text.failed;
    free(text.data);
    return tn_stepfile_add(step, "IFCINDEXEDPOLYCURVE(#%u,$,.F.)", list);
}

unsigned tn_stepfile_body(tn_stepfile *step, const char *kind, const char *solids)
{
    return tn_stepfile_add(step, "IFCSHAPEREPRESENTATION(#%u,'Body','%s',%s)", step->context, kind, solids);
}

unsigned tn_stepfile_shape(tn_stepfile *step, unsigned body, unsigned other)
{
    return other ? tn_stepfile_add(step, "IFCPRODUCTDEFINITIONSHAPE($,$,(#%u,#%u))", other, body)
                 : tn_stepfile_add(step, "IFCPRODUCTDEFINITIONSHAPE($,$,(#%u))", body);
}

/* The points of a prism, and the number of each among them: where it is not solid, both of a corner are one. */
typedef struct prism_points {
    unsigned low[TN_FACET_CORNERS], high[TN_FACET_CORNERS], count;
    tn_buffer text;
} prism_points;

static unsigned put_point(const tn_stepfile *step, prism_points *points, const tn_block_corner *corner, double z)
{
    tn_buffer_printf(&points->text, "%s(%s,%s,%s)", points->count ? "," : "", tn_stepfile_length(step, corner->x).text,
                     tn_stepfile_length(step, corner->y).text, tn_stepfile_length(step, z).text);
    return ++points->count;
}

/* Adds a face without the points that follow themselves, if it has an area. */
static void put_face(tn_stepfile *step, const unsigned *ring, size_t count, tn_stepfile_list *faces)
{
    char text[12 * TN_FACET_CORNERS] = "";
    size_t size = 0, kept = 0;
    for (size_t i = 0; i < count; i++)
        if (ring[i] != ring[(i + 1) % count]) {
            size += (size_t)snprintf(text + size, sizeof text - size, "%s%u", kept ? "," : "", ring[i]);
            kept++;
        }
    if (kept >= 3)
        tn_stepfile_list_add(faces, tn_stepfile_add(step, "IFCINDEXEDPOLYGONALFACE((%s))", text));
}

unsigned tn_stepfile_prism(tn_stepfile *step, const tn_block_corner *corners, size_t count)
{
    prism_points points = {.count = 0};
    tn_stepfile_list faces = {0};
    unsigned bottom[TN_FACET_CORNERS] = {0};
    for (size_t i = 0; i < count; i++) {
        const tn_block_corner *corner = &corners[i];
        points.low[i] = put_point(step, &points, corner, corner->low);
        points.high[i] = corner->high > corner->low ? put_point(step, &points, corner, corner->high) : points.low[i];
        bottom[count - 1 - i] = points.low[i];
    }
    unsigned at = tn_stepfile_add(step, "IFCCARTESIANPOINTLIST3D((%s))", points.text.data ? points.text.data : "");
    put_face(step, bottom, count, &faces);
    put_face(step, points.high, count, &faces);
    for (size_t i = 0; i < count; i++) {
        size_t next = (i + 1) % count;
        const unsigned side[4] = {points.low[i], points.low[next], points.high[next], points.high[i]};
        put_face(step, side, 4, &faces);
    }
    const char *list = tn_stepfile_list_text(&faces);
    unsigned solid = tn_stepfile_add(step, "IFCPOLYGONALFACESET(#%u,.T.,%s,$)", at, list ? list : "()");
    step->text.failed |= points.text.failed || faces.text.failed;
    free(points.text.data);
    tn_stepfile_list_clear(&faces);
    return styled(step, solid);
}
