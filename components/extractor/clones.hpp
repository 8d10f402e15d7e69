// Functions compiled twice on x86-64, for any processor and for those with 256-bit vectors; the loader
// chooses. Only for code whose result does not depend on the width of a vector: integers, or floats side by
// side (products and sums are never fused anywhere, see the compiler's options).
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define OMMA_CLONES __attribute__((target_clones("default", "avx2")))
#else
#define OMMA_CLONES
#endif
