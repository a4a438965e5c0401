// The SIMD build of the kernel files: namespace brume::HWY_NAMESPACE, F = 1, 4, 8 or 16 floats by the instruction set
// that this is being compiled for. Included from files that Highway's foreach_target.h compiles once per instruction
// set (hence the toggled guard), between HWY_BEFORE_NAMESPACE() and HWY_AFTER_NAMESPACE(). This gives the dialect its
// operators; loops belong to those who include it. Agreement with the scalar build (kernel/scalar.h, which has no fused
// multiply-add in a build for any x86-64): to the bit on one lane and SSE4. With fused multiply-adds (AVX2, AVX-512)
// integers, box_clip and the DDA to the bit; log, exp, sine, cosine and march_position 2 ulp; mean_transmittance 4 ulp;
// phase functions' values 8 ulp, their samples 6e-7; look-ups 2 ulp or 3e-7 of the largest value. Tested in
// tests/kernel/lanes_agree.cpp.
#if defined(BRUME_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BRUME_LANES_INL_H
#undef BRUME_LANES_INL_H
#else
#define BRUME_LANES_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace brume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#define KERNEL HWY_INLINE
#define INOUT(T) T&

using uint = std::uint32_t;
using Words = const std::uint32_t*;

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::ScalableTag<std::int32_t>;
using UintTag = hn::ScalableTag<std::uint32_t>;
constexpr FloatTag float_tag;
constexpr IntTag int_tag;
constexpr UintTag uint_tag;

// The number of lanes.
HWY_INLINE int lane_count() { return static_cast<int>(hn::Lanes(float_tag)); }

struct F {
  hn::Vec<FloatTag> v;
  F() = default;
  HWY_INLINE F(float x) : v(hn::Set(float_tag, x)) {}
  HWY_INLINE explicit F(hn::Vec<FloatTag> x) : v(x) {}
};
struct I {
  hn::Vec<IntTag> v;
  I() = default;
  HWY_INLINE I(std::int32_t x) : v(hn::Set(int_tag, x)) {}
  HWY_INLINE explicit I(hn::Vec<IntTag> x) : v(x) {}
};
struct U {
  hn::Vec<UintTag> v;
  U() = default;
  HWY_INLINE U(std::uint32_t x) : v(hn::Set(uint_tag, x)) {}
  HWY_INLINE explicit U(hn::Vec<UintTag> x) : v(x) {}
};
// A mask; kept as one of float lanes.
struct B {
  hn::Mask<FloatTag> m;
  B() = default;
  HWY_INLINE explicit B(hn::Mask<FloatTag> x) : m(x) {}
};

HWY_INLINE F operator+(F a, F b) { return F(hn::Add(a.v, b.v)); }
HWY_INLINE F operator-(F a, F b) { return F(hn::Sub(a.v, b.v)); }
HWY_INLINE F operator*(F a, F b) { return F(hn::Mul(a.v, b.v)); }
HWY_INLINE F operator/(F a, F b) { return F(hn::Div(a.v, b.v)); }
HWY_INLINE F operator-(F a) { return F(hn::Neg(a.v)); }
HWY_INLINE B operator<(F a, F b) { return B(hn::Lt(a.v, b.v)); }
HWY_INLINE B operator<=(F a, F b) { return B(hn::Le(a.v, b.v)); }
HWY_INLINE B operator>(F a, F b) { return B(hn::Gt(a.v, b.v)); }
HWY_INLINE B operator>=(F a, F b) { return B(hn::Ge(a.v, b.v)); }
HWY_INLINE B operator==(F a, F b) { return B(hn::Eq(a.v, b.v)); }

HWY_INLINE I operator+(I a, I b) { return I(hn::Add(a.v, b.v)); }
HWY_INLINE I operator-(I a, I b) { return I(hn::Sub(a.v, b.v)); }
HWY_INLINE I operator*(I a, I b) { return I(hn::Mul(a.v, b.v)); }
HWY_INLINE I operator&(I a, I b) { return I(hn::And(a.v, b.v)); }
HWY_INLINE I operator|(I a, I b) { return I(hn::Or(a.v, b.v)); }
HWY_INLINE I operator<<(I a, int bits) { return I(hn::ShiftLeftSame(a.v, bits)); }
HWY_INLINE I operator>>(I a, int bits) { return I(hn::ShiftRightSame(a.v, bits)); }
HWY_INLINE B operator<(I a, I b) { return B(hn::RebindMask(float_tag, hn::Lt(a.v, b.v))); }
HWY_INLINE B operator==(I a, I b) { return B(hn::RebindMask(float_tag, hn::Eq(a.v, b.v))); }

HWY_INLINE U operator+(U a, U b) { return U(hn::Add(a.v, b.v)); }
HWY_INLINE U operator-(U a, U b) { return U(hn::Sub(a.v, b.v)); }
HWY_INLINE U operator*(U a, U b) { return U(hn::Mul(a.v, b.v)); }
HWY_INLINE U operator&(U a, U b) { return U(hn::And(a.v, b.v)); }
HWY_INLINE U operator|(U a, U b) { return U(hn::Or(a.v, b.v)); }
HWY_INLINE U operator^(U a, U b) { return U(hn::Xor(a.v, b.v)); }
HWY_INLINE U operator<<(U a, int bits) { return U(hn::ShiftLeftSame(a.v, bits)); }
HWY_INLINE U operator>>(U a, int bits) { return U(hn::ShiftRightSame(a.v, bits)); }

HWY_INLINE B both(B a, B b) { return B(hn::And(a.m, b.m)); }
HWY_INLINE B either(B a, B b) { return B(hn::Or(a.m, b.m)); }
HWY_INLINE B negate(B a) { return B(hn::Not(a.m)); }
HWY_INLINE F select(B m, F a, F b) { return F(hn::IfThenElse(m.m, a.v, b.v)); }
HWY_INLINE I select(B m, I a, I b) { return I(hn::IfThenElse(hn::RebindMask(int_tag, m.m), a.v, b.v)); }
HWY_INLINE U select(B m, U a, U b) { return U(hn::IfThenElse(hn::RebindMask(uint_tag, m.m), a.v, b.v)); }

HWY_INLINE F abs(F x) { return F(hn::Abs(x.v)); }
HWY_INLINE F min(F a, F b) { return F(hn::Min(a.v, b.v)); }
HWY_INLINE F max(F a, F b) { return F(hn::Max(a.v, b.v)); }
HWY_INLINE I min(I a, I b) { return I(hn::Min(a.v, b.v)); }
HWY_INLINE I max(I a, I b) { return I(hn::Max(a.v, b.v)); }
HWY_INLINE F sqrt(F x) { return F(hn::Sqrt(x.v)); }
HWY_INLINE F floor(F x) { return F(hn::Floor(x.v)); }
HWY_INLINE F fma(F a, F b, F c) { return F(hn::MulAdd(a.v, b.v, c.v)); }

HWY_INLINE I to_int(F x) { return I(hn::ConvertTo(int_tag, x.v)); }
HWY_INLINE I round_to_int(F x) { return I(hn::NearestInt(x.v)); }
HWY_INLINE F to_float(I x) { return F(hn::ConvertTo(float_tag, x.v)); }
HWY_INLINE I floor_to_int(F x) {
  const I truncated = to_int(x);
  return select(to_float(truncated) > x, truncated - I(1), truncated);
}
HWY_INLINE U as_uint(I x) { return U(hn::BitCast(uint_tag, x.v)); }
HWY_INLINE I as_int(U x) { return I(hn::BitCast(int_tag, x.v)); }
HWY_INLINE U float_bits(F x) { return U(hn::BitCast(uint_tag, x.v)); }
HWY_INLINE F bits_float(U x) { return F(hn::BitCast(float_tag, x.v)); }
HWY_INLINE U shift_right_by(U x, U bits) { return U(hn::Shr(x.v, bits.v)); }
HWY_INLINE U load_u32(Words words, I index) { return U(hn::GatherIndex(uint_tag, words, index.v)); }
HWY_INLINE U load_u32(Words words, U index) { return load_u32(words, as_int(index)); }
// A word and the next, by one gather of 64 bits where there is one: gathers cost by the number of their loads.
HWY_INLINE void load_u32_pair(Words words, U index, U& first, U& second) {
#if HWY_TARGET <= HWY_AVX2
  const hn::ScalableTag<std::uint64_t> wide;
  const hn::RebindToSigned<decltype(wide)> wide_index;
  const hn::Half<decltype(int_tag)> half;
  const auto* base = reinterpret_cast<const std::uint64_t*>(words);
  const auto at = hn::BitCast(int_tag, index.v);
  const auto lower_offset = hn::ShiftLeft<2>(hn::PromoteTo(wide_index, hn::LowerHalf(half, at)));
  const auto upper_offset = hn::ShiftLeft<2>(hn::PromoteTo(wide_index, hn::UpperHalf(half, at)));
  const auto lower = hn::GatherOffset(wide, base, lower_offset), upper = hn::GatherOffset(wide, base, upper_offset);
  const auto low = hn::BitCast(uint_tag, lower), high = hn::BitCast(uint_tag, upper);
  first = U(hn::ConcatEven(uint_tag, high, low));
  second = U(hn::ConcatOdd(uint_tag, high, low));
#else
  first = load_u32(words, index);
  second = load_u32(words, index + U(1u));
#endif
}
// Asks for words that will be loaded, so that they are near by then.
HWY_INLINE void prefetch(Words words, U index) {
  HWY_ALIGN std::uint32_t at[HWY_MAX_BYTES / sizeof(std::uint32_t)];
  hn::Store(index.v, uint_tag, at);
  for (std::size_t lane = 0; lane < hn::Lanes(uint_tag); ++lane) __builtin_prefetch(words + at[lane]);
}

// Lanes to and from memory: lane i is at address[i]. Any address.
HWY_INLINE F load_lanes(const float* address) { return F(hn::LoadU(float_tag, address)); }
HWY_INLINE I load_lanes(const std::int32_t* address) { return I(hn::LoadU(int_tag, address)); }
HWY_INLINE U load_lanes(const std::uint32_t* address) { return U(hn::LoadU(uint_tag, address)); }
HWY_INLINE void store_lanes(F x, float* address) { hn::StoreU(x.v, float_tag, address); }
HWY_INLINE void store_lanes(I x, std::int32_t* address) { hn::StoreU(x.v, int_tag, address); }
HWY_INLINE void store_lanes(U x, std::uint32_t* address) { hn::StoreU(x.v, uint_tag, address); }
// True where any lane is set.
HWY_INLINE bool any(B m) { return !hn::AllFalse(float_tag, m.m); }
// The lane's own number: 0, 1, 2, ...
HWY_INLINE I lane_index() { return I(hn::Iota(int_tag, 0)); }

#include "kernel/vector.inl"

#include "kernel/all.inl"

#undef KERNEL
#undef INOUT

}  // namespace HWY_NAMESPACE
}  // namespace brume
HWY_AFTER_NAMESPACE();

#endif
