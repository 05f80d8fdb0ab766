#include "runtime/genome/list.h"

#include "runtime/genome/settings.h"

void tn_disassemble_settings(const tn_module *module, FILE *out)
{
    tn_evolution_study study;
    if (!tn_evolution_study_of(module, &study))
        return;
    fputs("\nevolution\n", out);
    for (tn_setting i = 0; i < TN_SETTING_COUNT; i++) {
        if (study.of[i].written == 0)
            continue;
        fputs("  ", out);
        tn_setting_write(out, i, &study.of[i]);
        fputc('\n', out);
    }
}
