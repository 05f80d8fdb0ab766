/* Colours are few: they are looked for one after the other. */
#include "driver/place/groups.h"

#include <stdlib.h>

#include "runtime/base/array.h"

static bool group_of(tn_colour_groups *list, int32_t colour, uint32_t *group)
{
    for (*group = 0; *group < list->count; ++*group)
        if (list->items[*group] == colour)
            return true;
    if (!tn_array_reserve(&list->items, &list->capacity, list->count, 1, sizeof *list->items))
        return false;
    list->items[list->count++] = colour;
    return true;
}

tn_status tn_colour_groups_add(tn_colour_groups *list, const tn_placed_model *model, uint32_t **groups, tn_error *error)
{
    *groups = malloc((model->count + 1) * sizeof **groups);
    for (size_t i = 0; *groups && i < model->count; i++)
        if (!group_of(list, model->parts[i].frame.colour, &(*groups)[i]))
            return tn_fail_memory(error);
    return *groups ? TN_OK : tn_fail_memory(error);
}
