/* Whole numbers of 128 bits, which gcc and clang have as an extension. */
#ifndef TARTAN_BASE_INT128_H
#define TARTAN_BASE_INT128_H

__extension__ typedef __int128 tn_int128;
__extension__ typedef unsigned __int128 tn_uint128;

#endif
