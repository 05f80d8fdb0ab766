/* Little-endian numbers in bytes, on any machine and at any alignment. */
#ifndef TARTAN_BASE_BYTES_H
#define TARTAN_BASE_BYTES_H

#include <stdint.h>

static inline uint32_t tn_get_u32(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static inline uint64_t tn_get_u64(const uint8_t *bytes)
{
    return (uint64_t)tn_get_u32(bytes) | (uint64_t)tn_get_u32(bytes + 4) << 32;
}

static inline int64_t tn_get_i64(const uint8_t *bytes)
{
    uint64_t value = tn_get_u64(bytes);
    return value <= INT64_MAX ? (int64_t)value : -(int64_t)~value - 1;
}

/* A double's IEEE 754 bits, and back. */
static inline uint64_t tn_bits_of(double value)
{
    union {
        double value;
        uint64_t bits;
    } both = {.value = value};
    return both.bits;
}

static inline double tn_double_of(uint64_t bits)
{
    union {
        uint64_t bits;
        double value;
    } both = {.bits = bits};
    return both.value;
}

/* For printing: what is no number has a sign on some machines and none on others, and is `nan` on all. */
static inline double tn_without_sign(double value)
{
    return value == value ? value : tn_double_of(0x7FF8000000000000u);
}

static inline void tn_put_u32(uint8_t *bytes, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        bytes[i] = (uint8_t)(value >> (8 * i));
}

static inline void tn_put_u64(uint8_t *bytes, uint64_t value)
{
    for (int i = 0; i < 8; i++)
        bytes[i] = (uint8_t)(value >> (8 * i));
}

#endif
