#include "volume/vdb_leaves.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "base/diagnostics.h"

namespace brume {
namespace {

using Voxel = std::array<std::int64_t, 3>;

std::int64_t round_down_to_brick(std::int64_t i) { return i & ~std::int64_t{7}; }

Voxel array_origin(const VoxelBox& active) {
  return {round_down_to_brick(active.lo[0]), round_down_to_brick(active.lo[1]), round_down_to_brick(active.lo[2])};
}

BrickGridBuilder make_builder(const std::string& file, const std::string& grid_name, const VoxelBox& active,
                              Storage storage, std::size_t file_bytes) {
  const Voxel origin = array_origin(active);
  std::array<int, 3> voxels{};
  double table_words = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (active.lo[axis] > active.hi[axis]) {
      throw InputError(file, fmt::format("grid \"{}\" is empty: it has no active voxels", grid_name));
    }
    const std::int64_t extent = active.hi[axis] - origin[axis] + 1;
    const std::int64_t bricks = (extent - 1) / brick_edge + 1;
    table_words *= static_cast<double>(bricks + 2);
    voxels[axis] = static_cast<int>(std::min<std::int64_t>(extent, std::numeric_limits<int>::max()));
  }
  const double allowed =
      std::min(static_cast<double>(max_table_words / 2), 0x1p22 + 64 * static_cast<double>(file_bytes));
  if (table_words > allowed) {
    throw InputError(file, fmt::format("grid \"{}\" spans {} x {} x {} voxels, too many for a file of {} bytes",
                                       grid_name, voxels[0], voxels[1], voxels[2], file_bytes));
  }
  return {voxels, storage};
}

}  // namespace

void ActiveVoxels::add_cube(Voxel origin, std::int64_t edge) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.lo[axis] = std::min(box.lo[axis], origin[axis]);
    box.hi[axis] = std::max(box.hi[axis], origin[axis] + edge - 1);
  }
  count += edge * edge * edge;
}

void ActiveVoxels::add_leaf(Voxel origin, std::span<const std::uint64_t, 8> mask) {
  std::uint64_t any = 0;  // a layer of constant x is a word, of 8 rows of constant y of 8 bits
  for (std::size_t x = 0; x < 8; ++x) {
    if (mask[x] == 0) continue;
    any |= mask[x];
    count += std::popcount(mask[x]);
    box.lo[0] = std::min(box.lo[0], origin[0] + static_cast<int>(x));
    box.hi[0] = std::max(box.hi[0], origin[0] + static_cast<int>(x));
  }
  if (any == 0) return;
  box.lo[1] = std::min(box.lo[1], origin[1] + std::countr_zero(any) / 8);
  box.hi[1] = std::max(box.hi[1], origin[1] + 7 - std::countl_zero(any) / 8);
  std::uint64_t row = any | (any >> 32);
  row |= row >> 16;
  row = (row | (row >> 8)) & 0xff;
  box.lo[2] = std::min(box.lo[2], origin[2] + std::countr_zero(row));
  box.hi[2] = std::max(box.hi[2], origin[2] + 63 - std::countl_zero(row));
}

void describe_placement(GridInfo& info, const ActiveVoxels& active, const Transform& world_from_lattice) {
  info.active_voxels = active.count;
  VolumeGrid placed;  // for its voxel_size only
  placed.medium_from_index = world_from_lattice;
  info.voxel_size = voxel_size(placed);
  Box3 box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (active.box.lo[a] > active.box.hi[a]) return;
    const double voxels = static_cast<double>(active.box.hi[a]) - static_cast<double>(active.box.lo[a]) + 1;
    info.first_voxel[a] = active.box.lo[a];
    info.voxels[a] = static_cast<int>(std::min(voxels, 2147483647.0));
    box.lo[axis] = static_cast<double>(active.box.lo[a]) - 0.5;
    box.hi[axis] = static_cast<double>(active.box.hi[a]) + 0.5;
  }
  info.bounds = bounds(world_from_lattice, box);
}

LeafCollector::LeafCollector(const std::string& file, const std::string& grid_name, const VoxelBox& active,
                             GridReading reading, std::size_t file_bytes)
    : file_(file),
      grid_name_(grid_name),
      active_(active),
      origin_(array_origin(active)),
      builder_(make_builder(file, grid_name, active, reading.storage, file_bytes)),
      check_(reading.bad_values) {}

void LeafCollector::leaf(Voxel origin, std::span<const float, brick_voxels> values) {
  std::array<std::int64_t, 3> begin{}, end{};  // of the leaf's part that is in the active box
  for (std::size_t axis = 0; axis < 3; ++axis) {
    begin[axis] = std::max<std::int64_t>(0, active_.lo[axis] - origin[axis]);
    end[axis] = std::min<std::int64_t>(8, active_.hi[axis] - origin[axis] + 1);
    if (begin[axis] >= end[axis]) return;
  }
  std::array<float, brick_voxels> brick{};
  for (std::int64_t x = begin[0]; x < end[0]; ++x) {
    for (std::int64_t y = begin[1]; y < end[1]; ++y) {
      for (std::int64_t z = begin[2]; z < end[2]; ++z) {
        brick[static_cast<std::size_t>(z * 64 + y * 8 + x)] = check_.checked(
            values[static_cast<std::size_t>(x * 64 + y * 8 + z)], {origin[0] + x, origin[1] + y, origin[2] + z});
      }
    }
  }
  if (check_.failed()) return;
  with_length_checked([&] { builder_.set_brick(brick_at(origin), brick); });
}

void LeafCollector::tile(Voxel origin, std::int64_t edge, float value) {
  if (value == 0) return;
  Voxel begin{}, end{};  // the tile's part that is in the active box
  for (std::size_t axis = 0; axis < 3; ++axis) {
    begin[axis] = std::max(origin[axis], active_.lo[axis]);
    end[axis] = std::min(origin[axis] + edge, active_.hi[axis] + 1);
    if (begin[axis] >= end[axis]) return;
  }
  value = check_.checked(value, begin, (end[0] - begin[0]) * (end[1] - begin[1]) * (end[2] - begin[2]));
  if (value == 0 || check_.failed()) return;
  std::array<float, brick_voxels> values;
  values.fill(value);
  Voxel brick;
  for (brick[2] = round_down_to_brick(begin[2]); brick[2] < end[2]; brick[2] += 8) {
    for (brick[1] = round_down_to_brick(begin[1]); brick[1] < end[1]; brick[1] += 8) {
      for (brick[0] = round_down_to_brick(begin[0]); brick[0] < end[0]; brick[0] += 8) {
        bool whole = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          whole = whole && brick[axis] >= begin[axis] && brick[axis] + 8 <= end[axis];
        }
        if (whole) {
          with_length_checked([&] { builder_.set_constant_brick(brick_at(brick), value); });
        } else {
          leaf(brick, values);
        }
      }
    }
  }
}

std::array<int, 3> LeafCollector::brick_at(Voxel origin) const {
  const auto brick = [&](std::size_t axis) { return static_cast<int>((origin[axis] - origin_[axis]) / brick_edge); };
  return {brick(0), brick(1), brick(2)};
}

template <class Set>
void LeafCollector::with_length_checked(const Set& set) {
  try {
    set();
  } catch (const std::length_error& error) {
    throw InputError(file_, fmt::format("grid \"{}\": {}", grid_name_, error.what()));
  }
}

VolumeGrid LeafCollector::finish(const Transform& world_from_lattice) {
  VolumeGrid grid;
  grid.warning = check_.finish(file_, grid_name_);
  for (const auto& row : world_from_lattice.m) {
    for (const double element : row) {
      if (!std::isfinite(element)) {
        throw InputError(file_, fmt::format("grid \"{}\": its transform is not finite", grid_name_));
      }
    }
  }
  if (const double volume = world_from_lattice.determinant(); !(std::fabs(volume) > 0) || !std::isfinite(1 / volume)) {
    throw InputError(file_, fmt::format("grid \"{}\": its transform cannot be inverted", grid_name_));
  }
  grid.name = grid_name_;
  grid.bricks = builder_.finish();
  Vector3 shift;  // a value sits at its integer coordinate there, at the middle of its voxel here
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    shift[axis] = static_cast<double>(origin_[a]) - 0.5;
    grid.first_voxel[a] = static_cast<int>(active_.lo[a] - origin_[a]);
  }
  grid.medium_from_index = world_from_lattice * translate(shift);
  grid.support = Support::fade;
  return grid;
}

}  // namespace brume
