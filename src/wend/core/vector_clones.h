// Compiling a function for several vector widths.
#pragma once

/// Before the definition of a function whose loops vectorize: it is compiled for the basic x86-64 and for AVX2, and the
/// program takes what the machine has. Without fused operations (cmake/WendTargets.cmake) results are the same, bit for
/// bit. Where compiler or platform do not offer this, there is one version; thread-sanitized programs cannot start with
/// more. Who compiles for one target defines it as nothing.
#ifndef WEND_VECTOR_CLONES
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__)
#define WEND_VECTOR_CLONES __attribute__((target_clones("default", "avx2")))
#else
#define WEND_VECTOR_CLONES
#endif
#endif
