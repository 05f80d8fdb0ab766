/* Asks a question through the C interface, as a program outside would: ask_interface STDLIB FILE QUESTION REQUEST...
 * Prints the answer to each request, all asked of one session; where one fails, "error" and its sentence. */
#include "include/tartan/tartan.h"

#include <stdio.h>

int main(int argc, char **argv)
{
    tartan_error error = {0};
    tartan_session *session = NULL;
    if (argc < 5) {
        fputs("usage: ask_interface STDLIB FILE QUESTION REQUEST...\n", stderr);
        return 2;
    }
    const char *folders[] = {argv[1]};
    tartan_compile_options options = tartan_compile_options_init();
    options.folders = folders;
    options.folder_count = 1;
    if (tartan_session_open(argv[2], NULL, 0, &options, &session, &error) != TARTAN_OK) {
        printf("error %s\n", error.message);
        return 1;
    }
    folders[0] = "gone"; /* they were copied */
    for (int i = 4; i < argc; i++) {
        char *answer = NULL;
        if (tartan_ask(session, argv[3], argv[i], NULL, NULL, NULL, &answer, &error) == TARTAN_OK)
            fputs(answer, stdout);
        else
            printf("error %s\n", error.message);
        tartan_text_free(answer);
    }
    tartan_session_free(session);
    return 0;
}
