#include "cli/common/interrupt.h"

#include <signal.h>

/* The one mutable global of the program: a signal handler can reach nothing else. */
static volatile sig_atomic_t interrupted;

static void note(int signal_number)
{
    (void)signal_number;
    interrupted = 1;
}

static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};

void tn_interrupt_watch(void)
{
    struct sigaction action = {.sa_handler = note,
                               .sa_flags = (int)(SA_RESETHAND | SA_RESTART)}; /* no write cut short */
    struct sigaction before;
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(numbers[i], &action, NULL);
}

void tn_interrupt_asking(bool asking)
{
    struct sigaction action;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        if (sigaction(numbers[i], NULL, &action) != 0 || action.sa_handler != note)
            continue;
        action.sa_flags = (int)(asking ? SA_RESETHAND : SA_RESETHAND | SA_RESTART);
        sigaction(numbers[i], &action, NULL);
    }
}

bool tn_interrupted(void)
{
    return interrupted != 0;
}
