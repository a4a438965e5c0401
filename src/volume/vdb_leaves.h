// What the readers of .vdb and .nvdb share: the tree's leaves and tiles become the bricks of a VolumeGrid.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "volume/density_check.h"
#include "volume/read_volume.h"
#include "volume/volume_grid.h"

namespace brume {

// A box of voxels of a file's integer lattice, both ends included; empty where lo > hi.
struct VoxelBox {
  std::array<std::int64_t, 3> lo, hi;
};

// The active voxels of a tree: how many, and their box.
struct ActiveVoxels {
  VoxelBox box{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
  std::int64_t count = 0;

  void add_cube(std::array<std::int64_t, 3> origin, std::int64_t edge);
  // A leaf's 512 bits, z fastest.
  void add_leaf(std::array<std::int64_t, 3> origin, std::span<const std::uint64_t, 8> mask);
};

// Fills in the size, place and number of voxels.
void describe_placement(GridInfo& info, const ActiveVoxels& active, const Transform& world_from_lattice);

// Collects one grid of values >= 0. Stored values count whether or not they are marked active, as they do in OpenVDB's
// and NanoVDB's own samplers, but only within the box of the active ones; outside it the density is 0.
class LeafCollector {
 public:
  // `file` and `grid_name` are for messages. `file_bytes` bounds the memory for bricks: 64 table words a byte of the
  // file, and 2^22 in any case. Throws InputError where the box is empty or needs more.
  LeafCollector(const std::string& file, const std::string& grid_name, const VoxelBox& active, GridReading reading,
                std::size_t file_bytes);

  // Takes the 512 values of the leaf that begins at `origin`, z fastest as these formats have them. Each leaf once.
  void leaf(std::array<std::int64_t, 3> origin, std::span<const float, brick_voxels> values);

  // Takes a cube of one value, `edge` voxels wide.
  void tile(std::array<std::int64_t, 3> origin, std::int64_t edge, float value);

  // `world_from_lattice` maps the file's integer coordinates, at which values sit, to its world.
  VolumeGrid finish(const Transform& world_from_lattice);

 private:
  std::array<int, 3> brick_at(std::array<std::int64_t, 3> origin) const;
  template <class Set>
  void with_length_checked(const Set& set);

  std::string file_, grid_name_;
  VoxelBox active_;
  std::array<std::int64_t, 3> origin_{};  // of the array: the active box's first voxel, rounded down to a multiple of 8
  BrickGridBuilder builder_;
  DensityCheck check_;
};

}  // namespace brume
