/* Writes the rank of a house, and the house of a rank. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/house/houses.h"
#include "runtime/base/json.h"

void tn_job_rank_house(tn_job *job, const tn_house_settings *settings, const char *line, bool of_all)
{
    tn_numbered n;
    tn_error error = {0};
    tn_output out;
    mpz_t plan, variant;
    mpz_inits(plan, variant, NULL);
    if (tn_job_numbered(job, &n, settings)) {
        if (tn_numbered_name_line(&n, line, settings->max_length, of_all, plan, variant, &error) != TN_OK) {
            tn_job_bad_text(job, &error, "HOUSE", line);
        } else if (tn_job_output(job, NULL, &out)) {
            if (of_all)
                gmp_fprintf(out.stream, "#%Zd\n", variant);
            else
                gmp_fprintf(out.stream, "#%Zd:%Zd\n", plan, variant);
            tn_job_commit(job, &out);
        }
    }
    tn_numbered_close(&n);
    mpz_clears(plan, variant, NULL);
}

void tn_job_use_house(tn_job *job, const tn_house_settings *settings, const char *number, tn_house_use *use)
{
    tn_numbered n;
    tn_error error = {0};
    if (tn_job_numbered(job, &n, settings)) {
        tn_house house;
        if (tn_numbered_house(&n, number, &house, &error) == TN_OK)
            use(job, &house);
        else
            tn_job_fail(job, &error);
        tn_house_clear(&house);
    }
    tn_numbered_close(&n);
}

static tn_status append_json(const tn_house *house, tn_buffer *out, tn_error *error)
{
    tn_json json = tn_json_text(out, TN_JSON_TIGHT);
    tn_buffer line = {0};
    tn_status status = tn_house_write(house, &line, error);
    if (status == TN_OK) {
        tn_json_object(&json, NULL);
        tn_json_string(&json, "house", line.data);
        tn_plan_write_trays(house->form->schema, house->trays, house->length, &json);
        status = tn_house_write_members(house, &json, error);
        tn_json_object_end(&json);
    }
    free(line.data);
    return status;
}

static void write_house(tn_job *job, const tn_house *house, bool json)
{
    tn_buffer text = {0};
    tn_error error = {0};
    tn_output out;
    tn_status status = json ? append_json(house, &text, &error) : tn_house_write(house, &text, &error);
    if (status == TN_OK && (!tn_buffer_append(&text, "\n", 1) || text.failed))
        status = tn_fail_memory(&error);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
    } else if (tn_job_output(job, NULL, &out)) {
        fwrite(text.data, 1, text.size, out.stream);
        tn_job_commit(job, &out);
    }
    free(text.data);
}

static void write_line(tn_job *job, const tn_house *house)
{
    write_house(job, house, false);
}

static void write_json(tn_job *job, const tn_house *house)
{
    write_house(job, house, true);
}

void tn_job_unrank_house(tn_job *job, const tn_house_settings *settings, const char *number, bool json)
{
    tn_job_use_house(job, settings, number, json ? write_json : write_line);
}
