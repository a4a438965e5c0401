// Columns of rays and paths in SIMD lanes, and phase functions as types: what the files that are compiled for several
// instruction sets share. Included as lanes/lanes-inl.h is, and in its place.
#if defined(BRUME_COLUMN_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BRUME_COLUMN_LANES_INL_H
#undef BRUME_COLUMN_LANES_INL_H
#else
#define BRUME_COLUMN_LANES_INL_H
#endif

#include "lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brume {
namespace HWY_NAMESPACE {

HWY_INLINE F gather(const float* column, I index) { return F(hn::GatherIndex(float_tag, column, index.v)); }
HWY_INLINE vec3 gather3(const float* const* columns, I index) {
  return vec3(gather(columns[0], index), gather(columns[1], index), gather(columns[2], index));
}
HWY_INLINE vec3 load3(float* const* columns, std::uint32_t i) {
  return vec3(load_lanes(columns[0] + i), load_lanes(columns[1] + i), load_lanes(columns[2] + i));
}

// Stores the lanes `where`, each at its own place. (By reading and writing a whole vector: stores under a mask are slow
// on some machines.)
HWY_INLINE void put(F x, B where, float* to) { store_lanes(select(where, x, load_lanes(to)), to); }
HWY_INLINE void put(U x, B where, std::uint32_t* to) { store_lanes(select(where, x, load_lanes(to)), to); }
HWY_INLINE void put3(vec3 v, B where, float* const* columns, std::uint32_t i) {
  put(v.x, where, columns[0] + i);
  put(v.y, where, columns[1] + i);
  put(v.z, where, columns[2] + i);
}

HWY_INLINE vec3 select3(B m, vec3 a, vec3 b) {
  return vec3(select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z));
}

HWY_INLINE vec3 lanes_of(kernel::vec3 v) { return vec3(v.x, v.y, v.z); }
HWY_INLINE BrickGrid lanes_of(const kernel::BrickGrid& g) {
  return {g.table, g.bricks, g.table_x, g.table_xy, g.bits, g.bordered};
}

HWY_INLINE F row_times(const float* row, vec3 v) { return fma(row[0], v.x, fma(row[1], v.y, F(row[2]) * v.z)); }
// The image of a point.
HWY_INLINE vec3 rows_times(const float (&rows)[3][4], vec3 p) {
  return vec3(row_times(rows[0], p) + rows[0][3], row_times(rows[1], p) + rows[1][3],
              row_times(rows[2], p) + rows[2][3]);
}

HWY_INLINE PlacedGrid lanes_of(const kernel::PlacedGrid& g) {
  PlacedGrid lanes{lanes_of(g.grid), {}, {}, {}, g.linear};
  for (int i = 0; i < 12; ++i) lanes.to_own[i] = g.to_own[i];
  for (int i = 0; i < 3; ++i) lanes.lo[i] = g.lo[i], lanes.hi[i] = g.hi[i];
  return lanes;
}
HWY_INLINE EmissionField lanes_of(const kernel::EmissionField& e) {
  return {e.has_temperature, e.has_strength, lanes_of(e.temperature), lanes_of(e.strength), e.offset,
          e.scale,           e.blackbody};
}
HWY_INLINE MajorantGrid lanes_of(const kernel::MajorantGrid& g) { return {g.cells, g.row, g.layer, g.cells_per_voxel}; }

HWY_INLINE std::size_t count_lanes(B m) { return hn::CountTrue(float_tag, m.m); }
HWY_INLINE B no_lanes() { return F(0.0f) < F(0.0f); }

// The lanes of a mask as bits, the first the lowest; and back.
HWY_INLINE std::uint32_t lane_bits(B m) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(float_tag, m.m, bytes);
  return bytes[0] | (static_cast<std::uint32_t>(bytes[1]) << 8);
}
HWY_INLINE B lanes_of_bits(std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
  return B(hn::LoadMaskBits(float_tag, bytes));
}

// The lanes of a mask, packed to the front of a vector.
struct Packing {
  decltype(hn::SetTableIndices(float_tag, static_cast<const std::int32_t*>(nullptr))) order;
  std::uint32_t count;
};
HWY_INLINE Packing packing_of(B m) {
  HWY_ALIGN std::int32_t lanes[HWY_MAX_BYTES / sizeof(std::int32_t)] = {};
  std::uint32_t count = 0;
  for (std::uint32_t left = lane_bits(m); left != 0; left &= left - 1)
    lanes[count++] = static_cast<std::int32_t>(__builtin_ctz(left));
  return {hn::SetTableIndices(float_tag, lanes), count};
}

// Lane k of a mask takes number rank(k) of what follows: the opposite of packing. Lanes beyond the mask take any.
struct Spreading {
  decltype(hn::SetTableIndices(float_tag, static_cast<const std::int32_t*>(nullptr))) order;
};
HWY_INLINE Spreading spreading_of(std::uint32_t lanes) {
  HWY_ALIGN std::int32_t rank[HWY_MAX_BYTES / sizeof(std::int32_t)] = {};
  std::int32_t count = 0;
  for (std::uint32_t left = lanes; left != 0; left &= left - 1) rank[__builtin_ctz(left)] = count++;
  return {hn::SetTableIndices(float_tag, rank)};
}

// Loads values that lie one after the other, the first to the mask's first lane. Reads a whole vector.
HWY_INLINE F spread(const float* from, const Spreading& spreading) {
  return F(hn::TableLookupLanes(load_lanes(from).v, spreading.order));
}
HWY_INLINE U spread(const std::uint32_t* from, const Spreading& spreading) {
  return float_bits(spread(reinterpret_cast<const float*>(from), spreading));
}
HWY_INLINE vec3 spread3(float* const* columns, std::uint32_t i, const Spreading& spreading) {
  return vec3(spread(columns[0] + i, spreading), spread(columns[1] + i, spreading), spread(columns[2] + i, spreading));
}

// Stores the packed lanes one after the other. Writes a whole vector.
HWY_INLINE void append(F x, const Packing& packing, float* to) {
  store_lanes(F(hn::TableLookupLanes(x.v, packing.order)), to);
}
HWY_INLINE void append(U x, const Packing& packing, std::uint32_t* to) {
  append(bits_float(x), packing, reinterpret_cast<float*>(to));
}
HWY_INLINE void append3(vec3 v, const Packing& packing, float* const* columns, std::uint32_t i) {
  append(v.x, packing, columns[0] + i);
  append(v.y, packing, columns[1] + i);
  append(v.z, packing, columns[2] + i);
}

#define PHASE(name)                                                         \
  struct name##_lanes {                                                     \
    static HWY_INLINE F eval(F mu, vec4 p) { return name##_eval(mu, p); }   \
    static HWY_INLINE F sample(F u, vec4 p) { return name##_sample(u, p); } \
  };
#include "kernel/phase_list.inl"
#undef PHASE

}  // namespace HWY_NAMESPACE
}  // namespace brume
HWY_AFTER_NAMESPACE();

#endif
