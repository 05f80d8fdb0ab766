/* Gives the files that a question makes to their taker, or puts them into the answer. */
#include "ask/session/made.h"

#include <stdlib.h>
#include <string.h>

tn_status tn_making_begin(tn_making *making, tn_session *session, tn_file_format format, const char *name,
                          tn_made_file *to, tn_error *error)
{
    *making = (tn_making){.taker = session->files, .lends = session->bytes, .to = to, .format = format};
    to->format = format == TN_FILE_OTHER ? "text" : tn_file_format_word(format);
    to->has_name = name != NULL;
    to->name = name ? strdup(name) : NULL;
    if (name && !to->name)
        return tn_fail_memory(error);
    if (making->taker)
        return making->taker->opens(making->taker->context, name, &making->stream, error);
    making->stream = open_memstream(&making->bytes, &making->size);
    return making->stream ? TN_OK : tn_fail_memory(error);
}

/* Takes the bytes, which a zero follows. */
static tn_status put_content(tn_making *making, tn_error *error)
{
    tn_made_file *to = making->to;
    bool text = making->format == TN_FILE_OTHER || tn_file_format_is_text(making->format);
    if (!text && making->lends)
        return making->lends->take(making->lends->context, to, (const uint8_t *)making->bytes, making->size, error);
    to->has_text = text;
    to->has_base64 = !text;
    if (to->has_text)
        to->text = making->bytes;
    else
        to->base64 = (tn_bytes){(uint8_t *)making->bytes, making->size};
    making->bytes = NULL;
    return TN_OK;
}

tn_status tn_making_end(tn_making *making, tn_status status, tn_error *error)
{
    tn_error ending;
    if (making->taker) {
        tn_status ended = making->taker->closes(making->taker->context, status == TN_OK, &ending);
        if (status == TN_OK && ended != TN_OK)
            *error = ending;
        return status == TN_OK ? ended : status;
    }
    if (fclose(making->stream) != 0 && status == TN_OK)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = put_content(making, error);
    free(making->bytes);
    return status;
}

/* ---- pictures */

tn_picture tn_picture_asked(tn_file_format format)
{
    return (tn_picture){.format = format == TN_FILE_PNG   ? TN_CANVAS_PNG
                                  : format == TN_FILE_PDF ? TN_CANVAS_PDF
                                  : format == TN_FILE_DXF ? TN_CANVAS_DXF
                                                          : TN_CANVAS_SVG};
}

tn_status tn_made_picture(tn_session *session, tn_picture *drawn, tn_file_format format, const char *name,
                          tn_made_file *to, tn_error *error)
{
    tn_making making;
    tn_status status = tn_making_begin(&making, session, format, name, to, error);
    if (status == TN_OK) {
        fwrite(drawn->element, 1, drawn->size, making.stream); /* what fails shows when the file is closed */
        status = tn_making_end(&making, TN_OK, error);
    }
    free(drawn->element);
    *drawn = (tn_picture){0};
    return status;
}

tn_status tn_picture_give(tn_session *session, tn_file_format format, tn_picture *drawn, tn_status status,
                          tn_error *error, tn_list *files)
{
    tn_made_file *file = status == TN_OK ? tn_message_add(&tn_message_made_file, files, error) : NULL;
    if (file) {
        status = tn_made_picture(session, drawn, format, NULL, file, error);
        return status == TN_OK ? TN_OK : tn_session_fail(session, error);
    }
    free(drawn->element);
    *drawn = (tn_picture){0};
    return tn_session_fail(session, error);
}

static tn_file_format format_of(const tn_answer_picture *asked)
{
    static const tn_file_format formats[] = {TN_FILE_OTHER, TN_FILE_SVG, TN_FILE_PNG, TN_FILE_PDF};
    return formats[asked->picture];
}

tn_picture tn_answer_picture_begin(const tn_answer_picture *asked)
{
    tn_picture to = tn_picture_asked(format_of(asked));
    to.dpi = (uint32_t)asked->dpi;
    return to;
}

tn_status tn_answer_picture_give(tn_session *session, const tn_answer_picture *asked, tn_picture *drawn,
                                 tn_status status, tn_error *error, tn_list *files, bool *has)
{
    *has = !session->files;
    return tn_picture_give(session, format_of(asked), drawn, status, error, files);
}
