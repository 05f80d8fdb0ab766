/* Holds a count to the houses themselves: builds for tests do so wherever there are few (TARTAN_CHECK_COUNTS). */
#include "runtime/house/count/data.h"
#include "runtime/house/rule/asked.h"

typedef struct recounting {
    const tn_houses *houses;
    tn_house_rules *rules;
    uint64_t kept, dropped; /* dropped: by the interpreter of rules */
} recounting;

static tn_status recount_house(void *context, const tn_house *house, bool *stop, tn_error *error)
{
    (void)stop;
    recounting *r = context;
    bool kept = false;
    tn_status status = tn_house_rules_start(r->rules, house, error);
    if (status == TN_OK)
        status = tn_house_rules_keep(r->rules, r->houses->library, &kept, error);
    r->kept += status == TN_OK && kept;
    r->dropped += status == TN_OK && !kept;
    return status;
}

static tn_status recount_plans(recounting *r, tn_house_variants *variants, tn_error *error)
{
    const tn_houses *h = r->houses;
    const tn_tray *trays;
    uint32_t length;
    tn_cursor *cursor = NULL;
    mpz_t from, to;
    mpz_inits(from, to, NULL);
    tn_library_kept(h->plans, TN_ALL_LENGTHS, to);
    tn_status status = h->only ? tn_house_variants_each(variants, h->only, h->low, from, recount_house, r, error)
                               : tn_cursor_new(h->plans, from, to, &cursor, error);
    while (status == TN_OK && cursor && tn_cursor_next(cursor, &trays, &length))
        status = tn_house_variants_each(variants, trays, length, from, recount_house, r, error);
    tn_cursor_free(cursor);
    mpz_clears(from, to, NULL);
    return status;
}

static bool few_plans(const tn_houses *h, uint64_t most)
{
    mpz_t plans;
    mpz_init(plans);
    tn_library_kept(h->plans, TN_ALL_LENGTHS, plans);
    bool few = h->only || mpz_cmp_ui(plans, most) <= 0;
    mpz_clear(plans);
    return few;
}

static tn_status compare(const recounting *r, uint64_t counted, tn_error *error)
{
    const tn_module *module = r->houses->form->module;
    if (r->kept == counted && r->dropped == 0)
        return TN_OK;
    return tn_fail(error, TN_INTERNAL, TN_CODE_NONE,
                   "%llu houses of `%.80s` were counted, and %llu are there when they are gone through (%llu more are "
                   "kept out by its rules): please report this with the file",
                   (unsigned long long)counted, tn_text(module, r->houses->library->name), (unsigned long long)r->kept,
                   (unsigned long long)r->dropped);
}

tn_status tn_houses_recount(const tn_houses *houses, uint64_t most, tn_error *error)
{
    recounting r = {.houses = houses};
    tn_house_variants *variants = NULL;
    mpz_t counted;
    mpz_init(counted);
    tn_houses_count(houses, TN_ALL_LENGTHS, counted);
    bool few = mpz_cmp_ui(counted, most) <= 0 && few_plans(houses, most);
    tn_status status = few ? tn_house_rules_new(houses->form, 0, &r.rules, error) : TN_OK;
    if (few && status == TN_OK)
        status = tn_house_variants_new(houses->form, houses->library, 0, &variants, error);
    if (few && status == TN_OK)
        status = recount_plans(&r, variants, error);
    if (few && status == TN_OK)
        status = compare(&r, mpz_get_ui(counted), error);
    else if (status == TN_LIMIT)
        status = TN_OK; /* more work than one wants */
    tn_house_variants_free(variants);
    tn_house_rules_free(r.rules);
    mpz_clear(counted);
    return status;
}
