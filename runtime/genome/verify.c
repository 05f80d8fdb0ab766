/* The settings of an evolution: each of its row's kind and range, each once, and nothing between them that a study
 * would be refused for. */
#include "runtime/module/verify.h"
#include "runtime/genome/settings.h"

tn_status tn_verify_settings(const tn_module *module, tn_error *error)
{
    for (size_t i = 0; i < module->SETTING_count; i++) {
        const tn_setting_record *record = &module->SETTING_records[i];
        bool ascends = i == 0 || module->SETTING_records[i - 1].setting < record->setting;
        tn_setting_value value = {.written = record->written,
                                  .choice = record->choice,
                                  .first = record->first,
                                  .second = record->second,
                                  .text = tn_text(module, record->text)};
        if (record->setting >= TN_SETTING_COUNT || !ascends || !tn_setting_fits((tn_setting)record->setting, &value))
            return tn_fail(error, TN_INVALID, E_REFUSED_MODULE,
                           "the module is refused: setting %zu is unknown, out of order or out of range", i);
    }
    if (module->SETTING_count == 0)
        return TN_OK;
    tn_evolution_study study;
    tn_setting_fault faults[TN_SETTING_FAULTS_MAX];
    tn_evolution_study_of(module, &study);
    if (tn_evolution_study_faults(&study, faults) > 0)
        return tn_fail(error, TN_INVALID, E_REFUSED_MODULE, "the module is refused: %s", faults[0].message);
    if (module->GRAMMAR_count != 1)
        return tn_fail(error, TN_INVALID, E_REFUSED_MODULE,
                       "the module is refused: an evolution needs one grammar, not %zu", module->GRAMMAR_count);
    return TN_OK;
}
