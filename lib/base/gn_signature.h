/* 64-bit signatures of the inputs of a shadow tile, or the pixels of a screen tile [A5] [R6]. Two different inputs have
 * the same signature with probability 2^-64. Not secure against adversaries. */
#ifndef GN_SIGNATURE_H
#define GN_SIGNATURE_H

#include <stddef.h>
#include <stdint.h>

#include "base/gn_q.h"

#define GN_SIGNATURE_SEED 0x9E3779B97F4A7C15U

/* Every step is a bijection of the signature for a given word, so that a difference cancels only by chance. */
static inline uint64_t gn_signature_add_inline(uint64_t signature, uint64_t word)
{
    signature = (signature ^ word) * 0xFF51AFD7ED558CCDU;
    return signature ^ signature >> 32;
}

uint64_t gn_far_signature_add(uint64_t signature, uint64_t word);
GN_INLINE uint64_t gn_signature_add(uint64_t signature, uint64_t word)
{
    return GN_SIZE_FIRST ? gn_far_signature_add(signature, word) : gn_signature_add_inline(signature, word);
}

static inline uint64_t gn_signature_words(uint64_t signature, const int32_t *words, size_t n)
{
    for (size_t i = 0; i < n; i++) signature = gn_signature_add(signature, (uint32_t)words[i]);
    return signature;
}

#endif
