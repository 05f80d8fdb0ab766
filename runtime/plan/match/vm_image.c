/* Projections, interpreted: the newer plans above a plan are tried one after another. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/match/vm_data.h"

/* What the interpreter needs to ask of a projection: its trays, and an interpreter of the newer plans. */
struct vm_image {
    int64_t library, schema; /* the instruction's */
    tn_projection *projection;
    tn_classes *newer;
    tn_plan_vm *vm;
    uint32_t *seen; /* [classes] */
    uint32_t stamp;
    tn_key trays;    /* newer trays above each place, one of each class, one list behind the other */
    size_t *first;   /* [room + 1]: where the lists begin */
    size_t *at;      /* [room]: the tray of each list that is tried */
    tn_tray *tried;  /* [room] */
    size_t capacity; /* room + 1, of all three */
};

static void image_free(vm_image *image)
{
    if (!image)
        return;
    tn_plan_vm_free(image->vm);
    tn_classes_free(image->newer);
    tn_projection_free(image->projection);
    free(image->seen);
    free(image->trays.data);
    free(image->first);
    free(image->at);
    free(image->tried);
    free(image);
}

void tn_plan_vm_free_images(tn_plan_vm *vm)
{
    for (size_t i = 0; i < vm->image_count; i++)
        image_free(vm->images[i]);
    free(vm->images);
}

static tn_status image_new(const tn_plan_vm *vm, const tn_instruction *op, vm_image **out, tn_error *error)
{
    vm_image *image = calloc(1, sizeof *image);
    if (!image)
        return tn_fail_memory(error);
    image->library = op->first;
    image->schema = op->second;
    tn_status status = tn_projection_new(vm->schema, op, &image->projection, error);
    if (status == TN_OK)
        status = tn_classes_above(image->projection, &image->newer, error);
    if (status == TN_OK)
        status = tn_plan_vm_new(image->projection->newer, vm->max_length, &image->vm, error);
    if (status == TN_OK && !(image->seen = calloc((size_t)image->newer->count + 1, sizeof *image->seen)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        *out = image;
    else
        image_free(image);
    return status;
}

/* That of an instruction, made now or before. */
static tn_status image_of(tn_plan_vm *vm, const tn_instruction *op, vm_image **image, tn_error *error)
{
    for (size_t i = 0; i < vm->image_count; i++) {
        *image = vm->images[i];
        if ((*image)->library == op->first && (*image)->schema == op->second)
            return TN_OK;
    }
    if (!tn_array_reserve(&vm->images, &vm->image_capacity, vm->image_count, 1, sizeof(vm_image *)))
        return tn_fail_memory(error);
    tn_status status = image_new(vm, op, image, error);
    if (status == TN_OK)
        vm->images[vm->image_count++] = *image;
    return status;
}

static bool make_room(vm_image *image, size_t length)
{
    if (length < image->capacity)
        return true;
    size_t capacity = tn_array_larger(image->capacity, length + 1, TN_ARRAY_FIRST);
    bool ok = tn_array_resize(&image->first, capacity, sizeof *image->first) &&
              tn_array_resize(&image->at, capacity, sizeof *image->at) &&
              tn_array_resize(&image->tried, capacity, sizeof *image->tried);
    image->capacity = ok ? capacity : image->capacity;
    return ok;
}

/* Lists the newer trays above each place; *none: above one there is none. */
static bool list_trays(vm_image *image, const tn_plan_vm *vm, bool reversed, bool *none)
{
    *none = false;
    image->trays.size = 0;
    image->first[0] = 0;
    for (size_t k = 0; k < vm->length; k++) {
        tn_tray tray = vm->trays[reversed ? vm->length - 1 - k : k];
        if (++image->stamp == 0) { /* after 2^32 lists the stamps start again */
            memset(image->seen, 0, image->newer->count * sizeof *image->seen);
            image->stamp = 1;
        }
        if (!tn_projection_list(image->projection, image->newer->of_tray, tray, image->seen, image->stamp,
                                &image->trays))
            return false;
        image->at[k] = image->first[k];
        image->first[k + 1] = image->trays.size;
        *none |= image->first[k] == image->first[k + 1];
    }
    return true;
}

/* Does the plan that is tried meet the library's clauses? */
static tn_status try_plan(vm_image *image, size_t length, bool *meets, tn_error *error)
{
    for (size_t k = 0; k < length; k++)
        image->tried[k] = image->trays.data[image->at[k]];
    tn_status status = tn_plan_vm_plan(image->vm, image->tried, length, error);
    *meets = true;
    for (uint32_t i = 0; status == TN_OK && *meets && i < image->projection->library->clause_count; i++) {
        const tn_clause_record *clause = tn_projection_clause(image->projection, i);
        image->vm->tries_limit = image->vm->tries; /* each clause has what the others leave */
        status = tn_plan_vm_holds(image->vm, clause->holds, meets, error);
        *meets = *meets != (clause->kind == TN_CLAUSE_PRUNE);
    }
    return status;
}

/* The next plan in order; false: that was the last. */
static bool next_plan(vm_image *image, size_t length)
{
    for (size_t k = length; k-- > 0;) {
        if (++image->at[k] < image->first[k + 1])
            return true;
        image->at[k] = image->first[k];
    }
    return false;
}

static tn_status too_many(const tn_plan_vm *vm, const vm_image *image, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_MATCHING_WORK,
            "looking for a plan of `%.80s` that is this plan of %zu trays without its newer fields takes more than the "
            "limit of %u plans",
            tn_text(vm->module, image->projection->library->name), vm->length, TN_VM_TRIES_MAX);
    tn_error_help(error, "match shorter plans, or by automata (--engine=dfa), which list none");
    return TN_LIMIT;
}

/* Tries are counted for all libraries above one another together. */
static tn_status try_all(tn_plan_vm *vm, vm_image *image, bool *found, tn_error *error)
{
    do {
        if (vm->tries == 0)
            return too_many(vm, image, error);
        vm->tries--;
        image->vm->tries = vm->tries;
        tn_status status = try_plan(image, vm->length, found, error);
        vm->tries = image->vm->tries;
        if (status != TN_OK)
            return status;
    } while (!*found && next_plan(image, vm->length));
    return TN_OK;
}

tn_status tn_plan_vm_image(tn_plan_vm *vm, const tn_instruction *op, bool reversed, bool *found, tn_error *error)
{
    vm_image *image = NULL;
    bool none = false;
    *found = false;
    tn_status status = image_of(vm, op, &image, error);
    if (status != TN_OK)
        return status;
    if (!make_room(image, vm->length) || !list_trays(image, vm, reversed, &none))
        return tn_fail_memory(error);
    return none ? TN_OK : try_all(vm, image, found, error);
}
