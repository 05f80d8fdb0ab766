/* MT19937, from the definition in Matsumoto and Nishimura, "Mersenne Twister" (1998). */
#include "runtime/place/mersenne.h"

enum { SIZE = 624, MIDDLE = 397 };

void tn_mersenne_seed(tn_mersenne *generator, uint32_t seed)
{
    uint32_t *s = generator->state;
    s[0] = seed;
    for (uint32_t i = 1; i < SIZE; i++)
        s[i] = 1812433253u * (s[i - 1] ^ s[i - 1] >> 30) + i;
    generator->next = SIZE;
}

static void twist(tn_mersenne *generator)
{
    uint32_t *s = generator->state;
    for (uint32_t i = 0; i < SIZE; i++) {
        uint32_t y = (s[i] & 0x80000000u) | (s[(i + 1) % SIZE] & 0x7fffffffu);
        s[i] = s[(i + MIDDLE) % SIZE] ^ y >> 1 ^ (y & 1 ? 0x9908b0dfu : 0);
    }
    generator->next = 0;
}

static uint32_t draw_word(tn_mersenne *generator)
{
    if (generator->next == SIZE)
        twist(generator);
    uint32_t y = generator->state[generator->next++];
    y ^= y >> 11;
    y ^= y << 7 & 0x9d2c5680u;
    y ^= y << 15 & 0xefc60000u;
    return y ^ y >> 18;
}

double tn_mersenne_draw(tn_mersenne *generator)
{
    uint32_t a = draw_word(generator) >> 5, b = draw_word(generator) >> 6;
    return (a * 67108864.0 + b) / 9007199254740992.0;
}
