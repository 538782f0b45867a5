/* Rejects compilers that do not follow IEEE 754. Every file includes this header: the error bounds
 * need infinities, NaN, signed zeros and sums in the order of the text. Contraction of a * b + c is
 * switched off by -ffp-contract=off (configure, Makevars.win, tools/library.sh) and here, where the
 * compiler knows the pragma. */
#ifndef ROT_IEEE_H
#define ROT_IEEE_H

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) ||           \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) ||                               \
    defined(__NO_SIGNED_ZEROS__) || defined(_M_FP_FAST)
#error "rotdyn needs IEEE 754 arithmetic: compile without -Ofast, -ffast-math and what they imply"
#endif

/* Extended precision rounds twice: error-free sums and products are wrong in it. Refused are 2 (x87
 * registers have it) and -1 (unknown); 0, 1 and 16 leave double as it is. */
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 1 &&        \
    __FLT_EVAL_METHOD__ != 16
#error "rotdyn needs double precision: on i386 compile with -msse2 -mfpmath=sse"
#endif

#if defined(__clang__) || defined(_MSC_VER)
#pragma STDC FP_CONTRACT OFF
#endif

#endif
