/* Lists of houses, for the files of the C interface to houses. */
#ifndef TARTAN_API_HOUSE_HOUSES_H
#define TARTAN_API_HOUSE_HOUSES_H

#include "api/house/house.h"
#include "driver/house/change_text.h"
#include "runtime/plan/measure/weighed.h"

/* Of the best: its values by the wishes, as texts. Of variants: the change, whose texts are the words. */
typedef struct tn_api_listed {
    tartan_house house;
    char *values[TN_WEIGHED_MAX];
    tartan_house_change change;
    tn_change_words words;
} tn_api_listed;

struct tartan_houses {
    tartan_house_library *library;
    tn_api_listed *items;
    size_t count, room;
    uint32_t wishes; /* 0 but for the best */
    bool changed;    /* variants */
};

/* An empty list; NULL: out of memory. */
tartan_houses *tn_api_houses_new(tartan_house_library *library);

/* Adds a house, of which a copy is taken; *added is the list's until another one is added. */
tn_status tn_api_houses_add(tartan_houses *houses, const tn_house *house, tn_api_listed **added, tn_error *error);

/* Gives the list to the caller after that status, or frees it. Returns the status. */
tartan_status tn_api_houses_give(tartan_houses *made, tartan_status status, tartan_houses **houses);

#endif
