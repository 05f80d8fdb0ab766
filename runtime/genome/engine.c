/* Verifies and lists the settings of an evolution. */
#include "runtime/module/engine.h"
#include "runtime/genome/settings.h"

static tn_status check_setting(const tn_checker *checker, size_t index)
{
    const tn_setting_record *records = checker->module->SETTING_records, *record = &records[index];
    bool repeats = record->setting < TN_SETTING_COUNT && tn_setting_rows[record->setting].kind == TN_SETTING_EACH &&
                   index > 0 && records[index - 1].setting == record->setting;
    bool ascends = index == 0 || records[index - 1].setting < record->setting || repeats;
    tn_setting_value value = {.written = record->written,
                              .choice = record->choice,
                              .first = record->first,
                              .second = record->second,
                              .text = tn_text(checker->module, record->text)};
    bool known = record->setting < TN_SETTING_COUNT && tn_setting_rows[record->setting].name;
    if (!known || !ascends || !tn_setting_fits((tn_setting)record->setting, &value))
        return tn_refuse(checker, "setting %zu is unknown, out of order or out of range", index);
    return TN_OK;
}

/* Settings are of their row's kind and range, each there once, and nothing between them is what a study would be
 * refused for; there is one grammar. */
static tn_status verify(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (size_t i = 0; i < module->SETTING_count; i++) {
        tn_status status = check_setting(checker, i);
        if (status != TN_OK)
            return status;
    }
    if (module->SETTING_count == 0)
        return TN_OK;
    if (module->SETTING_count > TN_SETTING_COUNT + TN_EACH_MAX)
        return tn_refuse(checker, "an evolution has more settings than there are");
    tn_evolution_study study;
    tn_setting_fault faults[TN_SETTING_FAULTS_MAX];
    tn_evolution_study_of(module, &study);
    if (tn_evolution_study_faults(&study, faults) > 0)
        return tn_refuse(checker, "%s", faults[0].message);
    if (tn_evolution_study_use(&study) != TN_USE_CODONS)
        return module->GRAMMAR_count == 0 ? TN_OK : tn_refuse(checker, "an evolution of forms has no grammar");
    if (module->GRAMMAR_count != 1)
        return tn_refuse(checker, "an evolution needs one grammar, not %zu", module->GRAMMAR_count);
    if (module->GRAMMAR_records[0].dialect == TN_DIALECT_PLACE)
        return tn_refuse(checker, "an evolution needs a grammar that genomes are mapped through");
    const tn_setting_value *mapping = &study.of[TN_SET_MAPPING];
    bool independent = module->GRAMMAR_records[0].flags & TN_POSITION_INDEPENDENT;
    if (mapping->written && independent != (mapping->choice == 1))
        return tn_refuse(checker, "an evolution maps genomes otherwise than its grammar");
    return TN_OK;
}

static void list(tn_lister *lister)
{
    tn_evolution_study study;
    if (!tn_evolution_study_of(lister->module, &study))
        return;
    fputs("\nevolution\n", lister->out);
    for (tn_setting i = 0; i < TN_SETTING_COUNT; i++) {
        if (study.of[i].written == 0 || tn_setting_rows[i].kind == TN_SETTING_EACH)
            continue;
        fputs("  ", lister->out);
        tn_setting_write(lister->out, i, &study.of[i]);
        fputc('\n', lister->out);
    }
    for (uint32_t i = 0; i < study.each_count; i++) {
        fputs("  ", lister->out);
        tn_setting_write(lister->out, study.each[i].setting, &study.each[i].value);
        fputc('\n', lister->out);
    }
}

static const tn_section sections[] = {TN_SECTION_SETTING, TN_SECTION_STRINGS};

extern const tn_engine tn_engine_genome;
const tn_engine tn_engine_genome = {.name = "genome", .sections = sections, .verify = verify, .list = list};
