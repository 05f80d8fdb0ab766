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

tn_stepfile_name tn_stepfile_text(const char *text)
{
    tn_stepfile_name name;
    size_t size = 0;
    for (; *text && size + 2 < sizeof name.text; text++) {
        if (*text == '\'' || *text == '\\')
            name.text[size++] = *text;
        name.text[size++] = (char)(*text >= ' ' && *text <= '~' ? *text : '?');
    }
    name.text[size] = '\0';
    return name;
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

unsigned tn_stepfile_shape(tn_stepfile *step, const char *solids)
{
    unsigned shape = tn_stepfile_add(step, "IFCSHAPEREPRESENTATION(#%u,'Body','SweptSolid',%s)", step->context,
                                     solids ? solids : "()");
    return tn_stepfile_add(step, "IFCPRODUCTDEFINITIONSHAPE($,$,(#%u))", shape);
}

unsigned tn_stepfile_box(tn_stepfile *step, double wide, double deep, double high)
{
    char list[16];
    const double low[3] = {0, 0, 0}, top[3] = {wide, deep, high};
    snprintf(list, sizeof list, "(#%u)", tn_stepfile_solid(step, low, top));
    return tn_stepfile_shape(step, list);
}
