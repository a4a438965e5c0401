// The directory of a .vdb file: its header, and of each grid where it is, what it is and how it is placed.
//
// The file is read here and not by the OpenVDB library because the library trusts what it reads: sizes in a damaged
// file make it write beyond its buffers. The layout follows K. Museth, "VDB: High-Resolution Sparse Volumes with
// Dynamic Topology", ACM Transactions on Graphics 32(3), 2013, and what OpenVDB 3 to 10 write (file versions 222 to
// 224); the tests read back what the library wrote.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/geometry.h"
#include "volume/byte_reader.h"

namespace brume {

struct VdbGrid {
  std::string name;  // "density", or "density[1]" where several grids have one name
  std::string type;  // "Tree_float_5_4_3"
  bool half = false;
  std::string instance_parent;  // unique name of the grid whose tree this one shares, or ""
  std::string unique_name;
  std::uint64_t position = 0;  // of the grid's data

  std::uint32_t compression = 0;                             // bits of VdbCompression
  std::map<std::string, std::string, std::less<>> metadata;  // values as raw bytes
  std::string map_type;
  bool affine = false;
  Transform world_from_lattice;     // where affine
  std::uint64_t tree_position = 0;  // of the tree, where the grid has its own
};

constexpr std::uint64_t vdb_magic = 0x56444220;  // " BDV", with which a file begins
constexpr std::uint32_t newest_vdb_version = 224;

enum VdbCompression : std::uint32_t { vdb_zip = 1, vdb_active_mask = 2, vdb_blosc = 4 };

// The grids of a file in its order. Throws InputError.
std::vector<VdbGrid> read_vdb_directory(ByteReader& reader);

}  // namespace brume
