// The layout is the one that vdb_file.cpp, read_vdb.cpp and vdb_values.cpp read; see there for its source. It is
// written here and not by the OpenVDB library because linking that adds 32 ms to every start of the program and 28 MB
// to its memory. The tests hold the files against what the library reads.
#include "volume/write_vdb.h"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <bit>
#include <map>
#include <stdexcept>
#include <vector>

#include "volume/half.h"
#include "volume/vdb_file.h"
#include "volume/vdb_leaves.h"

namespace brume {
namespace {

class ByteWriter {
 public:
  template <class T>
  void put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put_bytes(std::string_view bytes) { bytes_ += bytes; }
  // A 32-bit length and as many characters.
  void put_string(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
  }
  void replace(std::uint64_t at, std::string_view bytes) { bytes_.replace(at, bytes.size(), bytes); }
  std::uint64_t position() const { return bytes_.size(); }
  std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
};

template <class T>
std::string_view bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

// A leaf: 512 values, z fastest as the format has them, and which of them are not 0.
struct Leaf {
  std::array<float, brick_voxels> values;
  std::array<std::uint64_t, 8> active{};
};

Leaf make_leaf(const BrickGrid& grid, std::uint32_t first_word) {
  Leaf leaf;
  for (std::uint32_t i = 0; i < brick_voxels; ++i) {
    const std::uint32_t x = i >> 6, y = (i >> 3) & 7, z = i & 7;
    leaf.values[i] = std::bit_cast<float>(grid.words[first_word + z * 64 + y * 8 + x]);
    if (leaf.values[i] != 0) leaf.active[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  return leaf;
}

// The bricks that are not empty as the format's tree: children by their number in a node of 16^3 leaves, in one of 32^3
// such nodes, in the root. A number counts z fastest, so that the maps have the file's order.
using LowerNode = std::map<std::uint32_t, std::uint32_t>;  // to the brick's first word
using UpperNode = std::map<std::uint32_t, LowerNode>;
using Root = std::map<std::array<int, 3>, UpperNode>;  // by the first voxel

Root make_tree(const BrickGrid& grid) {
  const auto number = [](std::array<int, 3> place, int shift, int log2_edge) {
    std::uint32_t n = 0;
    for (const int p : place) n = (n << log2_edge) | (static_cast<std::uint32_t>(p >> shift) & ((1u << log2_edge) - 1));
    return n;
  };
  Root root;
  std::size_t row = static_cast<std::size_t>(grid.bricks[0] + 2),
              layer = row * static_cast<std::size_t>(grid.bricks[1] + 2);
  for (int z = 0; z < grid.bricks[2]; ++z)
    for (int y = 0; y < grid.bricks[1]; ++y)
      for (int x = 0; x < grid.bricks[0]; ++x) {
        const BrickEntry entry = grid.entry(static_cast<std::size_t>(z + 1) * layer +
                                            static_cast<std::size_t>(y + 1) * row + static_cast<std::size_t>(x + 1));
        if (entry.first_word == 0) continue;
        const std::array<int, 3> brick{x, y, z};
        UpperNode& upper = root[{x >> 9 << 12, y >> 9 << 12, z >> 9 << 12}];
        upper[number(brick, 4, 5)][number(brick, 0, 4)] = entry.first_word;
      }
  return root;
}

// A block of values: its packed size, then the data; a size below 0 is minus that of data that did not get smaller.
void put_packed(ByteWriter& out, std::string_view raw) {
  uLongf size = compressBound(static_cast<uLong>(raw.size()));
  std::string packed(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(raw.data()),
               static_cast<uLong>(raw.size())) != Z_OK)
    throw std::bad_alloc();  // its only reason, in a buffer of that size
  const bool smaller = size < raw.size();
  out.put(smaller ? static_cast<std::int64_t>(size) : -static_cast<std::int64_t>(raw.size()));
  out.put_bytes(smaller ? std::string_view(packed).substr(0, size) : raw);
}

constexpr std::uint8_t inactive_are_background = 0;

// The nodes of the tree without the leaves' values. A node's own values are all inactive, and left out.
template <std::size_t log2_edge, class Children>
void put_node_head(ByteWriter& out, const Children& children, bool half) {
  std::array<std::uint64_t, (std::size_t{1} << (3 * log2_edge)) / 64> child{}, active{};
  for (const auto& [number, below] : children) child[number / 64] |= std::uint64_t{1} << (number % 64);
  out.put(child);
  out.put(active);
  out.put(inactive_are_background);
  if (!half) put_packed(out, {});  // no block at all where values are halves
}

void put_topology(ByteWriter& out, const BrickGrid& grid, const Root& root, bool half) {
  out.put(std::uint32_t{1});  // buffers a leaf
  out.put(0.0f);              // background
  out.put(std::uint32_t{0});  // tiles of the root
  out.put(static_cast<std::uint32_t>(root.size()));
  for (const auto& [origin, upper] : root) {
    out.put(origin);
    put_node_head<5>(out, upper, half);
    for (const auto& [upper_number, lower] : upper) {
      put_node_head<4>(out, lower, half);
      for (const auto& [number, first_word] : lower) out.put(make_leaf(grid, first_word).active);
    }
  }
}

void put_leaf_values(ByteWriter& out, const Leaf& leaf, bool half) {
  out.put(leaf.active);
  out.put(inactive_are_background);
  ByteWriter values;
  for (const float value : leaf.values) {
    if (value == 0) continue;
    if (half)
      values.put(float_to_half(value));
    else
      values.put(value);
  }
  if (values.position() > 0 || !half) put_packed(out, values.bytes());
}

// The first voxel of a leaf, from its number in the lower node and that node's in the upper one, which begins at
// `origin`.
std::array<std::int64_t, 3> leaf_origin(const std::array<int, 3>& origin, std::uint32_t upper, std::uint32_t lower) {
  const auto at = [&](std::size_t axis, int shift) {
    return std::int64_t{origin[axis]} + 128 * ((upper >> (5 * shift)) & 31) + 8 * ((lower >> (4 * shift)) & 15);
  };
  return {at(0, 2), at(1, 1), at(2, 0)};
}

ActiveVoxels find_active(const BrickGrid& grid, const Root& root) {
  ActiveVoxels active;
  for (const auto& [origin, upper] : root)
    for (const auto& [upper_number, lower] : upper)
      for (const auto& [number, first_word] : lower)
        active.add_leaf(leaf_origin(origin, upper_number, number), make_leaf(grid, first_word).active);
  return active;
}

void put_entry(ByteWriter& out, std::string_view name, std::string_view type, std::string_view value) {
  out.put_string(name);
  out.put_string(type);
  out.put_string(value);
}

void put_metadata(ByteWriter& out, const VolumeGrid& grid, const ActiveVoxels& active, bool half) {
  const auto corner = [](const std::array<std::int64_t, 3>& voxel) {
    return std::array{static_cast<std::int32_t>(voxel[0]), static_cast<std::int32_t>(voxel[1]),
                      static_cast<std::int32_t>(voxel[2])};
  };
  const bool any = active.count > 0;
  out.put(std::uint32_t{any ? 6u : 3u});
  put_entry(out, "class", "string", "fog volume");
  if (any) {
    put_entry(out, "file_bbox_max", "vec3i", bytes_of(corner(active.box.hi)));
    put_entry(out, "file_bbox_min", "vec3i", bytes_of(corner(active.box.lo)));
    put_entry(out, "file_voxel_count", "int64", bytes_of(active.count));
  }
  put_entry(out, "is_saved_as_half_float", "bool", bytes_of(half));
  put_entry(out, "name", "string", grid.name);
}

// A matrix for row vectors: the translation is the last row. The file's lattice has values at its integers, ours in the
// middle of voxels.
void put_transform(ByteWriter& out, const Transform& world_from_index) {
  const Transform world_from_lattice = world_from_index * translate({0.5, 0.5, 0.5});
  out.put_string("AffineMap");
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 3; ++column) out.put(world_from_lattice.m[column][row]);
    out.put(row == 3 ? 1.0 : 0.0);
  }
}

// The descriptor, with the positions of what follows it, and the grid itself.
void put_grid(ByteWriter& out, const VolumeGrid& grid, bool half) {
  out.put_string(grid.name);
  out.put_string(half ? "Tree_float_5_4_3_HalfFloat" : "Tree_float_5_4_3");
  out.put_string("");  // shares no other grid's tree
  const std::uint64_t positions_at = out.position();
  std::array<std::uint64_t, 3> positions{};  // of the grid, of its leaves' values, of its end
  out.put(positions);

  const Root root = make_tree(grid.bricks);
  positions[0] = out.position();
  out.put(std::uint32_t{vdb_zip | vdb_active_mask});
  put_metadata(out, grid, find_active(grid.bricks, root), half);
  put_transform(out, grid.medium_from_index);
  put_topology(out, grid.bricks, root, half);
  positions[1] = out.position();
  for (const auto& [origin, upper] : root)
    for (const auto& [upper_number, lower] : upper)
      for (const auto& [number, first_word] : lower) put_leaf_values(out, make_leaf(grid.bricks, first_word), half);
  positions[2] = out.position();
  out.replace(positions_at, bytes_of(positions));
}

// An identifier in the form of a UUID that follows from what the file holds (FNV-1a, from two starts), so that equal
// files are equal to the last byte.
std::string identifier(std::string_view bytes) {
  std::uint64_t a = 0xcbf29ce484222325, b = 0x84222325cbf29ce4;
  for (const char c : bytes) {
    a = (a ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    b = (b ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  return fmt::format("{:08x}-{:04x}-8{:03x}-8{:03x}-{:012x}", a >> 32, (a >> 16) & 0xffff, a & 0xfff, b >> 52,
                     b & 0xffffffffffff);
}

}  // namespace

std::string encode_vdb(std::span<const VolumeGrid> grids, bool half, const std::string& creator) {
  for (const VolumeGrid& grid : grids)
    if (grid.bricks.storage != Storage::f32) throw std::invalid_argument("only grids of floats are written");
  ByteWriter out;
  out.put(vdb_magic);
  out.put(newest_vdb_version);
  out.put(std::array<std::uint32_t, 2>{10, 0});  // the version of the OpenVDB library that writes such files
  out.put(true);                                 // grids have their positions
  const std::uint64_t identifier_at = out.position();
  out.put_bytes(std::string(36, '0'));
  out.put(std::uint32_t{1});
  put_entry(out, "creator", "string", creator);
  out.put(static_cast<std::uint32_t>(grids.size()));
  for (const VolumeGrid& grid : grids) put_grid(out, grid, half);
  out.replace(identifier_at, identifier(out.bytes()));
  return std::move(out.bytes());
}

}  // namespace brume
