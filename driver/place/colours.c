/* LDraw's common colours, as its colour table gives them (LDConfig.ldr), to the nearest of 256 steps. */
#include "driver/place/colours.h"

#include <stddef.h>

static const struct {
    int32_t number;
    uint32_t rgb;
} colours[] = {
    {0, 0x1b2a34},   {1, 0x1e5aa8},   {2, 0x00852b},   {3, 0x069d9f},   {4, 0xb40000},   {5, 0xd3359d},
    {6, 0x543324},   {7, 0x8a928d},   {8, 0x545955},   {9, 0x97cbd9},   {10, 0x58ab41},  {14, 0xfac80a},
    {15, 0xf4f4f4},  {19, 0xb0a06f},  {22, 0x671f81},  {25, 0xd67923},  {26, 0x901f76},  {27, 0xa5ca18},
    {28, 0x897d62},  {70, 0x5f3109},  {71, 0xa3a2a4},  {72, 0x646464},  {73, 0x7396c8},  {78, 0xffc995},
    {84, 0xaa7d55},  {85, 0x441a91},  {272, 0x19325a}, {288, 0x00451a}, {308, 0x352100}, {320, 0x720012},
    {326, 0xe2f99a}, {378, 0x708e7c}, {379, 0x70819a}, {484, 0x91501c},
};

void tn_ldraw_colour(int32_t number, double rgb[3])
{
    uint32_t found = 0xb8b8b8;
    for (size_t i = 0; i < sizeof colours / sizeof *colours; i++)
        if (colours[i].number == number)
            found = colours[i].rgb;
    for (int k = 0; k < 3; k++)
        rgb[k] = (found >> (16 - 8 * k) & 255) / 255.0;
}
