/* The C interface to one house: its line, its plan and its numbers. */
#include "api/house/house.h"

#include "ask/house/typed.h"

#include <stdlib.h>
#include <string.h>

/* A house under its public type, which takes it over in any case. */
static tartan_status give_house(tartan_house_library *library, tn_house *house, tartan_house **given,
                                tartan_error *error)
{
    tartan_house *made = malloc(sizeof *made);
    if (!made) {
        tn_house_clear(house);
        return tn_api_memory(error);
    }
    *made = (tartan_house){.library = library, .house = *house};
    *given = made;
    return TARTAN_OK;
}

tartan_status tartan_house_read(tartan_house_library *library, const char *line, size_t size, tartan_house **house,
                                tartan_error *error)
{
    tn_error found = {0};
    tn_house read = {0};
    tn_typed_told told;
    tn_first_mistake first = {0};
    if (!library || !house || (size > 0 && !line))
        return tn_api_missing(error, !library ? "library of houses" : house ? "line" : "room for the house");
    const tn_numbered *n = &library->numbered;
    const tn_typed_among among = {.form = &n->form,
                                  .form_number = n->record->form,
                                  .library = n->record,
                                  .plans = n->plans,
                                  .options = {.max_states = n->max_states},
                                  .max_length = TN_HOUSE_TRAYS_DEFAULT,
                                  .kept = true};
    tn_status status =
        tn_typed_find(&among, size > 0 ? line : "", size, tn_keep_first_mistake, &first, &read, &told, &found);
    tn_typed_told_clear(&told);
    if (first.any)
        found = first.error;
    if (status == TN_OK)
        return give_house(library, &read, house, error);
    tn_house_clear(&read);
    return tn_api_fail(&found, error);
}

void tartan_house_free(tartan_house *house)
{
    if (!house)
        return;
    tn_house_clear(&house->house);
    free(house);
}

tartan_status tartan_house_write(const tartan_house *house, char **line, tartan_error *error)
{
    tn_buffer text = {0};
    tn_error found;
    if (!house || !line)
        return tn_api_missing(error, house ? "room for the line" : "house");
    tn_status status = tn_house_write(&house->house, &text, &found);
    if (status == TN_OK && text.failed)
        status = tn_fail_memory(&found);
    if (status != TN_OK) {
        free(text.data);
        return tn_api_fail(&found, error);
    }
    *line = text.data;
    return TARTAN_OK;
}

const uint32_t *tartan_house_plan(const tartan_house *house, size_t *length)
{
    *length = house->house.length;
    return house->house.trays;
}

/* ---- numbers */

/* With the # that a rank among all houses has. */
static char *with_sign(const char *number)
{
    char *text = malloc(strlen(number) + 2);
    if (text)
        sprintf(text, "%s%s", number[0] == '#' ? "" : "#", number);
    return text;
}

tartan_status tartan_house_unrank(tartan_house_library *library, const char *number, const tartan_watch *watch,
                                  tartan_house **house, tartan_error *error)
{
    tn_error found = {0};
    tn_house made = {0};
    if (!number || !house)
        return tn_api_missing(error, number ? "room for the house" : "number");
    tartan_status status = tn_api_houses_begin(library, watch, error);
    if (status != TARTAN_OK)
        return status;
    char *text = with_sign(number);
    tn_status read = text ? tn_numbered_house(&library->numbered, text, &made, &found) : tn_fail_memory(&found);
    free(text);
    status = tn_api_houses_end(library, read, &found, error);
    if (status == TARTAN_OK)
        return give_house(library, &made, house, error);
    tn_house_clear(&made);
    return status;
}

tartan_status tartan_house_rank(const tartan_house *house, const tartan_watch *watch, char **rank, tartan_error *error)
{
    tn_error found;
    mpz_t number;
    if (!house || !rank)
        return tn_api_missing(error, house ? "room for the rank" : "house");
    tartan_status status = tn_api_houses_begin(house->library, watch, error);
    if (status != TARTAN_OK)
        return status;
    mpz_init(number);
    tn_status ranked = tn_numbered_rank(&house->library->numbered, &house->house, number, &found);
    status = tn_api_houses_end(house->library, ranked, &found, error);
    if (status == TARTAN_OK)
        status = tn_api_decimal(number, rank, error);
    mpz_clear(number);
    return status;
}

tartan_status tartan_house_number(const tartan_house *house, const tartan_watch *watch, char **number,
                                  tartan_error *error)
{
    tn_error found;
    mpz_t plan, variant;
    if (!house || !number)
        return tn_api_missing(error, house ? "room for the number" : "house");
    tartan_status status = tn_api_houses_begin(house->library, watch, error);
    if (status != TARTAN_OK)
        return status;
    mpz_inits(plan, variant, NULL);
    tn_buffer text = {0};
    tn_status named = tn_numbered_name(&house->library->numbered, &house->house, plan, variant, &found);
    char *first = named == TN_OK ? mpz_get_str(NULL, 10, plan) : NULL;
    char *second = named == TN_OK ? mpz_get_str(NULL, 10, variant) : NULL;
    if (named == TN_OK && !(first && second && tn_buffer_printf(&text, "%s:%s", first, second)))
        named = tn_fail_memory(&found);
    free(first);
    free(second);
    mpz_clears(plan, variant, NULL);
    status = tn_api_houses_end(house->library, named, &found, error);
    if (status == TARTAN_OK)
        *number = text.data;
    else
        free(text.data);
    return status;
}
