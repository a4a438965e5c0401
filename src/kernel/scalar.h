// The scalar build of the kernel files: namespace brume::kernel, F = float. The definition that the SIMD and
// GLSL builds are tested against, and the one that host code calls.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace brume::kernel {

using F = float;
using I = std::int32_t;
using U = std::uint32_t;
using B = bool;
using uint = std::uint32_t;
using Words = const std::uint32_t*;

#define KERNEL inline
#define INOUT(T) T&

inline F select(B m, F a, F b) { return m ? a : b; }
inline I select(B m, I a, I b) { return m ? a : b; }
inline U select(B m, U a, U b) { return m ? a : b; }
inline B both(B a, B b) { return a && b; }
inline B either(B a, B b) { return a || b; }
inline B negate(B a) { return !a; }

inline F abs(F x) { return std::fabs(x); }
inline F min(F a, F b) { return b < a ? b : a; }
inline F max(F a, F b) { return a < b ? b : a; }
inline I min(I a, I b) { return b < a ? b : a; }
inline I max(I a, I b) { return a < b ? b : a; }
inline F sqrt(F x) { return std::sqrt(x); }
inline F floor(F x) { return std::floor(x); }
// Fused where the target has the instruction; a call into the C library's software fma would cost more than it
// is worth, and the kernels' error bounds hold without the fusion.
inline F fma(F a, F b, F c) {
#ifdef __FMA__
  return std::fma(a, b, c);
#else
  return a * b + c;
#endif
}

inline I to_int(F x) { return static_cast<I>(x); }
inline I floor_to_int(F x) {
  const I truncated = static_cast<I>(x);
  return truncated - static_cast<I>(static_cast<F>(truncated) > x);
}
inline I round_to_int(F x) { return static_cast<I>(std::nearbyint(x)); }
inline F to_float(I x) { return static_cast<F>(x); }
inline U as_uint(I x) { return static_cast<U>(x); }
inline I as_int(U x) { return static_cast<I>(x); }
inline U float_bits(F x) { return std::bit_cast<U>(x); }
inline F bits_float(U x) { return std::bit_cast<F>(x); }
inline U shift_right_by(U x, U bits) { return x >> bits; }
inline U load_u32(Words words, I index) { return words[index]; }
inline U load_u32(Words words, U index) { return words[index]; }
inline void load_u32_pair(Words words, U index, INOUT(U) first, INOUT(U) second) {
  first = words[index];
  second = words[index + 1];
}

#include "kernel/vector.inl"

#include "kernel/all.inl"

#undef KERNEL
#undef INOUT

}  // namespace brume::kernel
