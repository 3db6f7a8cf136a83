/* GN_VECTOR 1: inner loops of 16 texels or 8 pixels at a time with GNU vector extensions, on hosts with AVX2 or wider.
 * Changes speed only: tests/core/vector_test.c holds every loop against its scalar twin. Rows of the
 * map are padded, and so is the end of a region's planes: a vector may read and write back unchanged what lies beyond
 * the right end of a span, always in memory of the same worker. */
#ifndef GN_VECTOR_H
#define GN_VECTOR_H

#include "gnomon.h"

#ifndef GN_VECTOR
#if defined __GNUC__ && defined __AVX2__
#define GN_VECTOR 1
#else
#define GN_VECTOR 0
#endif
#endif

/* GN_VECTOR_16 1: the light pass, too, which works on 16 lanes of 32 bits: on halves of them it is slower than without.
 */
#ifndef GN_VECTOR_16
#if GN_VECTOR && defined __AVX512BW__
#define GN_VECTOR_16 1
#else
#define GN_VECTOR_16 0
#endif
#endif

#if GN_VECTOR
#define GN_ROW_PADDING 16 /* texels or pixels */

typedef uint16_t gn_u16x16 __attribute__((vector_size(32), aligned(2)));
typedef uint32_t gn_u32x16 __attribute__((vector_size(64), aligned(4)));
typedef uint32_t gn_u32x8 __attribute__((vector_size(32), aligned(4)));
typedef int32_t gn_i32x16 __attribute__((vector_size(64), aligned(4)));
typedef int32_t gn_i32x8 __attribute__((vector_size(32), aligned(4)));
typedef uint64_t gn_u64x8 __attribute__((vector_size(64), aligned(8)));
#if GN_DEPTH_BITS == 16
typedef gn_u16x16 gn_depthx16;
typedef int16_t gn_depth_maskx16 __attribute__((vector_size(32), aligned(2)));
#else
typedef gn_u32x16 gn_depthx16;
typedef int32_t gn_depth_maskx16 __attribute__((vector_size(64), aligned(4)));
#endif
#else
#define GN_ROW_PADDING 0
#endif

#endif
