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
    *step = (tn_stepfile){0};
}

unsigned tn_stepfile_add(tn_stepfile *step, const char *format, ...)
{
    va_list args;
    char *instance = NULL;
    va_start(args, format);
    int size = vasprintf(&instance, format, args);
    va_end(args);
    if (size < 0)
        step->text.failed = true;
    else
        tn_buffer_printf(&step->text, "#%u=%s;\n", ++step->last, instance);
    if (size >= 0)
        free(instance);
    return step->last;
}

tn_stepfile_number tn_stepfile_mm(double nanometres)
{
    tn_stepfile_number number;
    snprintf(number.text, sizeof number.text, "%.9f", nanometres / 1e6);
    size_t size = strlen(number.text);
    while (number.text[size - 1] == '0')
        number.text[--size] = '\0';
    return number;
}

/* The alphabet and the order of bits are those of buildingSMART's compressed GUIDs. */
tn_stepfile_id tn_stepfile_guid(const tn_stepfile *step, const char *kind, unsigned number)
{
    static const char digits[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
    char part[160];
    tn_stepfile_id id;
    int size = snprintf(part, sizeof part, "%s %s %u", step->seed, kind, number);
    XXH128_hash_t hash = XXH3_128bits(part, size < (int)sizeof part ? (size_t)size : sizeof part - 1);
    uint64_t high = hash.high64, low = hash.low64;
    for (int i = 21; i >= 0; i--) {
        id.text[i] = digits[low & 63];
        low = low >> 6 | high << 58;
        high >>= 6;
    }
    id.text[22] = '\0';
    return id;
}

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
    tn_buffer_printf(&list->text, "%s#%u", list->count++ ? "," : "(", instance);
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

unsigned tn_stepfile_placement(tn_stepfile *step, unsigned within, double x, double y, double z)
{
    unsigned point = tn_stepfile_add(step, "IFCCARTESIANPOINT((%s,%s,%s))", tn_stepfile_mm(x).text,
                                     tn_stepfile_mm(y).text, tn_stepfile_mm(z).text);
    unsigned axes = tn_stepfile_add(step, "IFCAXIS2PLACEMENT3D(#%u,$,$)", point);
    if (within == 0)
        return tn_stepfile_add(step, "IFCLOCALPLACEMENT($,#%u)", axes);
    return tn_stepfile_add(step, "IFCLOCALPLACEMENT(#%u,#%u)", within, axes);
}

unsigned tn_stepfile_turned(tn_stepfile *step, unsigned within, double x, double y, double z, int turns)
{
    static const char *const directions[] = {"1.,0.", "0.,1.", "-1.,0.", "0.,-1."};
    unsigned point = tn_stepfile_add(step, "IFCCARTESIANPOINT((%s,%s,%s))", tn_stepfile_mm(x).text,
                                     tn_stepfile_mm(y).text, tn_stepfile_mm(z).text);
    unsigned along = tn_stepfile_add(step, "IFCDIRECTION((%s,0.))", directions[turns]);
    unsigned axes = tn_stepfile_add(step, "IFCAXIS2PLACEMENT3D(#%u,#%u,#%u)", point, step->z, along);
    return tn_stepfile_add(step, "IFCLOCALPLACEMENT(#%u,#%u)", within, axes);
}

unsigned tn_stepfile_solid(tn_stepfile *step, const double low[3], const double high[3])
{
    unsigned middle = tn_stepfile_add(step, "IFCCARTESIANPOINT((%s,%s))", tn_stepfile_mm((low[0] + high[0]) / 2).text,
                                      tn_stepfile_mm((low[1] + high[1]) / 2).text);
    unsigned flat = tn_stepfile_add(step, "IFCAXIS2PLACEMENT2D(#%u,$)", middle);
    unsigned profile = tn_stepfile_add(step, "IFCRECTANGLEPROFILEDEF(.AREA.,$,#%u,%s,%s)", flat,
                                       tn_stepfile_mm(high[0] - low[0]).text, tn_stepfile_mm(high[1] - low[1]).text);
    unsigned axes = step->axes;
    if (low[2] != 0) {
        unsigned foot = tn_stepfile_add(step, "IFCCARTESIANPOINT((0.,0.,%s))", tn_stepfile_mm(low[2]).text);
        axes = tn_stepfile_add(step, "IFCAXIS2PLACEMENT3D(#%u,$,$)", foot);
    }
    return tn_stepfile_add(step, "IFCEXTRUDEDAREASOLID(#%u,#%u,#%u,%s)", profile, axes, step->z,
                           tn_stepfile_mm(high[2] - low[2]).text);
}

static unsigned put_shape(tn_stepfile *step, const char *kind, const char *solids)
{
    unsigned shape = tn_stepfile_add(step, "IFCSHAPEREPRESENTATION(#%u,'Body','%s',%s)", step->context, kind,
                                     solids ? solids : "()");
    return tn_stepfile_add(step, "IFCPRODUCTDEFINITIONSHAPE($,$,(#%u))", shape);
}

unsigned tn_stepfile_shape(tn_stepfile *step, const char *solids)
{
    return put_shape(step, "SweptSolid", solids);
}

unsigned tn_stepfile_faceted(tn_stepfile *step, const char *solids)
{
    return put_shape(step, "Tessellation", solids);
}

/* The points of a prism, and the number of each among them: where it is not solid, both of a corner are one. */
typedef struct prism_points {
    unsigned low[TN_FACET_CORNERS], high[TN_FACET_CORNERS], count;
    tn_buffer text;
} prism_points;

static unsigned put_point(prism_points *points, const tn_block_corner *corner, double z)
{
    tn_buffer_printf(&points->text, "%s(%s,%s,%s)", points->count ? "," : "", tn_stepfile_mm(corner->x).text,
                     tn_stepfile_mm(corner->y).text, tn_stepfile_mm(z).text);
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
        points.low[i] = put_point(&points, corner, corner->low);
        points.high[i] = corner->high > corner->low ? put_point(&points, corner, corner->high) : points.low[i];
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
    return solid;
}

unsigned tn_stepfile_box(tn_stepfile *step, double wide, double deep, double high)
{
    char list[16];
    const double low[3] = {0, 0, 0}, top[3] = {wide, deep, high};
    snprintf(list, sizeof list, "(#%u)", tn_stepfile_solid(step, low, top));
    return tn_stepfile_shape(step, list);
}
