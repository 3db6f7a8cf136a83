/* One hash for each stage of a frame, equal on every target: 64-bit FNV-1a over a canonical dump, little-endian.
 *
 *     warp     the rectangle of the light's plane that the map covers (gn_rectangle: cosine, sine, low, size), then,
 *              row by row, where each texel lies (gn_texel_place: x, y); 32 bits each
 *
 *     layers   the first layer's rows from the top, then the second's, each texel in GN_DEPTH_BITS / 8 bytes; a layer
 *              that does not exist counts as zeros
 *
 *     map      the rows of the resolved map
 *
 *     silhouettes  the cells of the silhouette map, or the texels of the crossing map, one byte each
 *
 *     mask     the rows of the image, one byte a pixel
 *
 *     colour   the rows of the image, three bytes a pixel: r, g, b (GN_RGB888); for GN_RGB565 two
 *
 * Rows are whole, whatever the regions were. Freestanding: no libc, for the host and for firmware.
 */
#ifndef STAGE_HASH_H
#define STAGE_HASH_H

#include <stdint.h>

typedef uint64_t stage_hash;

static inline stage_hash stage_hash_init(void)
{
    return UINT64_C(0xcbf29ce484222325);
}

static inline stage_hash stage_hash_u8(stage_hash hash, uint8_t value)
{
    return (hash ^ value) * UINT64_C(0x100000001b3);
}

static inline stage_hash stage_hash_u16(stage_hash hash, uint16_t value)
{
    return stage_hash_u8(stage_hash_u8(hash, (uint8_t)(value & 255)), (uint8_t)(value >> 8));
}

static inline stage_hash stage_hash_u32(stage_hash hash, uint32_t value)
{
    return stage_hash_u16(stage_hash_u16(hash, (uint16_t)(value & 65535)), (uint16_t)(value >> 16));
}

/* Sixteen hexadecimal digits and a zero byte, for consoles without printf. */
static inline void stage_hash_text(stage_hash hash, char text[17])
{
    for (int i = 0; i < 16; i++)
        text[i] = "0123456789abcdef"[hash >> (60 - 4 * i) & 15];
    text[16] = 0;
}

#endif
