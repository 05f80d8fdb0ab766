/* Finds which parts of a kit, and which space, are asked about. */
#include "ask/place/kit.h"

#include <stdlib.h>

#include "driver/place/kit.h"
#include "runtime/place/joints.h"

tn_status tn_kit_none_asked(tn_session *session, const tn_kit_asked *asked)
{
    const char *option = asked->parts        ? "parts"
                         : asked->fixed      ? "fixed"
                         : asked->inside     ? "inside"
                         : asked->part.count ? "part"
                                             : NULL;
    return option ? tn_session_refuse(session, NULL, "--%s is about a kit, and %.200s is none", option,
                                      session->opened->path)
                  : TN_OK;
}

static tn_status unknown_part(tn_session *session, const char *name)
{
    const tn_module *module = session->opened->module;
    tn_error error;
    tn_fail(&error, TN_INVALID, E_KIT_UNKNOWN, "the kit has no part `%.100s`", name);
    tn_error_help(&error, "--part takes the name of one of its parts, such as %.100s",
                  tn_text(module, module->KIT_PART_records[0].name));
    return tn_session_fail(session, &error);
}

/* *wanted: NULL if none is named, so that all are. */
static tn_status choose_parts(tn_session *session, const tn_kit_asked *asked, bool **wanted)
{
    const tn_module *module = session->opened->module;
    tn_error error;
    if (asked->part.count == 0)
        return TN_OK;
    bool *chosen = calloc((size_t)module->KIT_PART_count + 1, sizeof *chosen);
    if (!chosen) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    for (size_t i = 0; i < asked->part.count; i++) {
        const tn_kit_part_record *part = tn_kit_part_named(module, asked->part.items[i]);
        if (!part) {
            free(chosen);
            return unknown_part(session, asked->part.items[i]);
        }
        chosen[part - module->KIT_PART_records] = true;
    }
    *wanted = chosen;
    return TN_OK;
}

tn_status tn_kit_asked_parts(tn_session *session, const tn_kit_asked *asked, bool **wanted)
{
    tn_error error;
    *wanted = NULL;
    if (asked->parts == 0)
        return tn_session_refuse(session, "say how many: --parts 3",
                                 "of a kit, buildings of so many parts are counted");
    if (asked->parts > TN_COUNT_PARTS_MAX)
        return tn_session_refuse(session, NULL, "buildings have at most %d parts here", TN_COUNT_PARTS_MAX);
    if (asked->inside && asked->fixed)
        return tn_session_refuse(
            session, NULL,
            "--fixed and --inside do not go together: inside of a space each building counts where it stands");
    if (session->opened->module->KIT_PART_count > 0)
        return choose_parts(session, asked, wanted);
    tn_fail(&error, TN_INVALID, E_KIT_UNKNOWN, "the kit has no parts to count buildings of");
    tn_error_help(&error, "tell them by `part 3005 { ... }`, or `use \"bricks\";`");
    return tn_session_fail(session, &error);
}

tn_status tn_kit_asked_space(tn_session *session, const char *name, tn_place_rules *rules)
{
    tn_error error;
    uint32_t model;
    tn_status status = tn_kit_choose(session->opened, name, &model);
    if (status != TN_OK)
        return status;
    status = tn_place_rules_of_model(session->opened->module, model, rules, &error);
    if (status == TN_OK)
        return TN_OK;
    tn_place_rules_clear(rules);
    return tn_session_fail(session, &error);
}
