// The reader of .nvdb: walks NanoVDB's tree in its buffer, after checking that each node lies in it.
#include <nanovdb/NanoVDB.h>

#include <array>
#include <set>

#include "volume/formats.h"
#include "volume/nvdb_file.h"
#include "volume/vdb_leaves.h"

namespace brume {
namespace {

using Voxel = std::array<std::int64_t, 3>;

// A checked view of a grid's buffer: its tree's nodes by their byte offsets, which the file gives and which can be
// wrong.
template <class BuildT>
class NvdbTree {
 public:
  using Root = typename nanovdb::NanoRoot<BuildT>::DataType;
  using Upper = typename nanovdb::NanoUpper<BuildT>::DataType;
  using Lower = typename nanovdb::NanoLower<BuildT>::DataType;
  using Leaf = typename nanovdb::NanoLeaf<BuildT>::DataType;

  NvdbTree(const ByteReader& reader, const std::vector<NvdbBlock>& buffer, std::uint64_t size)
      : reader_(reader), bytes_(reinterpret_cast<const char*>(buffer.data())), size_(size) {
    constexpr std::uint64_t tree_offset = sizeof(nanovdb::GridData);
    const auto& tree = node<nanovdb::TreeData<3>>(tree_offset);
    root_offset_ = tree_offset + tree.mNodeOffset[3];
    const auto& root = node<Root>(root_offset_);
    const std::uint64_t table = root.mTableSize * std::uint64_t{sizeof(typename Root::Tile)};
    if (table > size_ - root_offset_ - sizeof(Root)) fail();
    if (root.mBackground != 0) {
      reader_.fail(fmt::format("the density's background is {}; only 0 can be rendered", root.mBackground));
    }
  }

  // Calls tile(origin, edge, value, active) and leaf(origin, node) for all there are.
  template <class TileVisitor, class LeafVisitor>
  void walk(const TileVisitor& tile, const LeafVisitor& leaf) {
    visited_bytes_ = 0;
    std::set<std::uint64_t> keys;
    const auto& root = node<Root>(root_offset_);
    for (std::uint32_t i = 0; i < root.mTableSize; ++i) {
      const typename Root::Tile& entry = *root.tile(i);
      if (!keys.insert(entry.key).second) reader_.fail("two nodes of the tree's root are in one place");
      const Voxel origin = origin_of(entry.key);
      if (entry.child == 0) {
        tile(origin, 4096, entry.value, entry.state != 0);
      } else {
        walk_node<Upper>(child_offset(root_offset_, entry.child), origin, tile, leaf);
      }
    }
  }

 private:
  [[noreturn]] void fail() const { reader_.fail("the tree refers to a node outside of the grid's data"); }

  template <class Node>
  const Node& node(std::uint64_t offset) const {
    if (offset % NANOVDB_DATA_ALIGNMENT != 0 || size_ < sizeof(Node) || offset > size_ - sizeof(Node)) fail();
    return *reinterpret_cast<const Node*>(bytes_ + offset);
  }

  static std::uint64_t child_offset(std::uint64_t parent, std::int64_t relative) {
    return parent + static_cast<std::uint64_t>(relative);  // wraps where negative
  }

  // A root key holds the upper 20 bits of x, y and z in 21 bits each.
  static Voxel origin_of(std::uint64_t key) {
    const auto axis = [&](int shift) {
      return std::int64_t{static_cast<std::int32_t>(static_cast<std::uint32_t>((key >> shift) & 0xfffffu) << 12)};
    };
    return {axis(42), axis(21), axis(0)};
  }

  // Nodes do not overlap, so that all visits together cannot touch more bytes than there are: children that share a
  // node would otherwise make a small file a huge grid.
  void count_visit(std::uint64_t bytes) {
    visited_bytes_ += bytes;
    if (visited_bytes_ > size_) reader_.fail("nodes of the tree share their data");
  }

  // A node of children or tiles: Upper has 32^3, Lower 16^3.
  template <class Node, class TileVisitor, class LeafVisitor>
  void walk_node(std::uint64_t offset, Voxel origin, const TileVisitor& tile, const LeafVisitor& leaf) {
    constexpr bool upper = std::is_same_v<Node, Upper>;
    constexpr int log2_edge = upper ? 5 : 4;
    constexpr std::int64_t child_edge = upper ? 128 : 8;
    count_visit(sizeof(Node));
    const auto& parent = node<Node>(offset);
    for (std::uint32_t i = 0; i < (1u << (3 * log2_edge)); ++i) {
      const auto place = [&](int shift) { return std::int64_t{(i >> shift) & ((1u << log2_edge) - 1)}; };
      const Voxel at{origin[0] + place(2 * log2_edge) * child_edge, origin[1] + place(log2_edge) * child_edge,
                     origin[2] + place(0) * child_edge};
      if (!parent.mChildMask.isOn(i)) {
        tile(at, child_edge, parent.mTable[i].value, parent.mValueMask.isOn(i));
      } else if constexpr (upper) {
        walk_node<Lower>(child_offset(offset, parent.mTable[i].child), at, tile, leaf);
      } else {
        walk_leaf(child_offset(offset, parent.mTable[i].child), at, leaf);
      }
    }
  }

  template <class LeafVisitor>
  void walk_leaf(std::uint64_t offset, Voxel origin, const LeafVisitor& leaf) {
    const auto& found = node<Leaf>(offset);
    std::uint64_t bytes = sizeof(Leaf);
    if constexpr (std::is_same_v<BuildT, nanovdb::FpN>) {  // its codes follow, of 1, 2, 4, 8 or 16 bits
      if (found.bitWidth() > 16) reader_.fail("a leaf has values of an unknown width");
      bytes = found.memUsage();
      if (bytes > size_ - offset) fail();
    }
    count_visit(bytes);
    leaf(origin, found);
  }

  const ByteReader& reader_;
  const char* bytes_;
  std::uint64_t size_;
  std::uint64_t root_offset_ = 0;
  std::uint64_t visited_bytes_ = 0;
};

Transform world_from_lattice(const nanovdb::Map& map) {
  Transform t;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) t.m[row][column] = map.mMatD[3 * row + column];
    t.m[row][3] = map.mVecD[row];
  }
  return t;
}

template <class BuildT>
VolumeGrid read_tree(const ByteReader& reader, const NvdbGrid& grid, GridReading reading) {
  const nanovdb::GridData data = read_nvdb_grid_data(reader, grid);
  const std::vector<NvdbBlock> buffer = read_nvdb_buffer(reader, grid);
  NvdbTree<BuildT> tree(reader, buffer, grid.memory_size);
  using Leaf = typename NvdbTree<BuildT>::Leaf;

  ActiveVoxels active;
  tree.walk(
      [&](Voxel origin, std::int64_t edge, float, bool is_active) {
        if (is_active) active.add_cube(origin, edge);
      },
      [&](Voxel origin, const Leaf& leaf) {
        std::array<std::uint64_t, 8> mask;
        static_assert(sizeof mask == sizeof leaf.mValueMask);
        std::memcpy(mask.data(), static_cast<const void*>(&leaf.mValueMask), sizeof mask);
        active.add_leaf(origin, mask);
      });

  LeafCollector collector(reader.file(), grid.name, active.box, reading, reader.size());
  std::array<float, brick_voxels> values;
  tree.walk([&](Voxel origin, std::int64_t edge, float value, bool) { collector.tile(origin, edge, value); },
            [&](Voxel origin, const Leaf& leaf) {
              for (std::uint32_t i = 0; i < brick_voxels; ++i) values[i] = leaf.getValue(i);
              collector.leaf(origin, values);
            });
  return collector.finish(world_from_lattice(data.mMap));
}

std::string type_name(nanovdb::GridType type) {
  switch (type) {
    case nanovdb::GridType::Fp4:
      return "fp4";
    case nanovdb::GridType::Fp8:
      return "fp8";
    case nanovdb::GridType::Fp16:
      return "fp16";
    case nanovdb::GridType::FpN:
      return "fpn";
    default:
      break;
  }
  if (type < nanovdb::GridType::End) return nanovdb::toStr(type);
  return fmt::format("type {}", static_cast<std::uint32_t>(type));
}

std::string class_name(nanovdb::GridClass grid_class) {
  switch (grid_class) {
    case nanovdb::GridClass::Unknown:
      return "unknown";
    case nanovdb::GridClass::LevelSet:
      return "level set";
    case nanovdb::GridClass::FogVolume:
      return "fog volume";
    case nanovdb::GridClass::Staggered:
      return "staggered";
    default:
      break;
  }
  if (grid_class < nanovdb::GridClass::End) return nanovdb::toStr(grid_class);
  return fmt::format("class {}", static_cast<std::uint32_t>(grid_class));
}

using TreeReader = VolumeGrid (*)(const ByteReader&, const NvdbGrid&, GridReading);

// Null for a type that is no scalar float.
TreeReader reader_of(nanovdb::GridType type) {
  switch (type) {
    case nanovdb::GridType::Float:
      return read_tree<float>;
    case nanovdb::GridType::Fp4:
      return read_tree<nanovdb::Fp4>;
    case nanovdb::GridType::Fp8:
      return read_tree<nanovdb::Fp8>;
    case nanovdb::GridType::Fp16:
      return read_tree<nanovdb::Fp16>;
    case nanovdb::GridType::FpN:
      return read_tree<nanovdb::FpN>;
    default:
      return nullptr;
  }
}

}  // namespace

std::vector<GridInfo> list_nvdb(const std::string& file, std::string_view bytes) {
  ByteReader reader(file, bytes);
  std::vector<GridInfo> infos;
  for (const NvdbGrid& grid : read_nvdb_directory(reader)) {
    GridInfo info;
    info.name = grid.name;
    info.type = type_name(grid.type);
    info.grid_class = class_name(grid.grid_class);
    if (reader_of(grid.type) == nullptr) {
      info.note = fmt::format("not a density: its values are of type {}", info.type);
    } else if (grid.grid_class == nanovdb::GridClass::LevelSet) {
      info.note = "a level set; convert it to a fog volume first";
    }
    info.renderable = info.note.empty();
    describe_placement(info, grid.active, world_from_lattice(read_nvdb_grid_data(reader, grid).mMap));
    infos.push_back(std::move(info));
  }
  return infos;
}

VolumeGrid read_nvdb(const std::string& file, std::string_view bytes, std::size_t index, GridReading reading) {
  ByteReader reader(file, bytes);
  const NvdbGrid grid = read_nvdb_directory(reader).at(index);
  return reader_of(grid.type)(reader, grid, reading);
}

}  // namespace brume
