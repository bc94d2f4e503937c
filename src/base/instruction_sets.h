// Functions that are compiled for several instruction sets; the loader takes that of the machine.
#pragma once

/// Stands before a function of loops over numbers, which wider registers speed up. Without
/// contractions (-ffp-contract=off) all versions have the same bits. Sanitizers are not at work yet
/// when the loader chooses: with them there is one version.
#if defined(__x86_64__) && defined(__ELF__) && !defined(DUET_ONE_INSTRUCTION_SET)
#define DUET_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define DUET_WIDE
#endif

/// The same for loops over many paths at once, which fill the registers of AVX-512, too.
#if defined(__x86_64__) && defined(__ELF__) && !defined(DUET_ONE_INSTRUCTION_SET) && \
    !defined(__clang__)
#define DUET_WIDEST __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define DUET_WIDEST DUET_WIDE
#endif

/// Stands before a loop whose steps do not depend on one another, whatever the addresses.
#if defined(__clang__)
#define DUET_LANES _Pragma("clang loop vectorize(assume_safety)")
#else
#define DUET_LANES _Pragma("GCC ivdep")
#endif
