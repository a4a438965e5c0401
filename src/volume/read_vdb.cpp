// The reader of .vdb: a float grid's tree in two passes, nodes first, then the leaves' values, as the file has them.
#include <array>
#include <cmath>
#include <set>

#include "volume/formats.h"
#include "volume/vdb_file.h"
#include "volume/vdb_leaves.h"
#include "volume/vdb_values.h"

namespace brume {
namespace {

using Voxel = std::array<std::int64_t, 3>;

constexpr std::string_view float_tree = "Tree_float_5_4_3";  // root of 32^3 nodes of 16^3 nodes of 8^3 leaves

struct Leaf {
  Voxel origin;
  std::array<std::uint64_t, 8> active;
};

struct Tile {
  Voxel origin;
  std::int64_t edge;
  float value;
};

// A tree without its leaves' values.
struct Topology {
  std::vector<Leaf> leaves;
  std::vector<Tile> tiles;  // of value other than 0
  ActiveVoxels active;
  std::uint64_t values_position = 0;
};

class TopologyReader {
 public:
  TopologyReader(ByteReader& reader, const VdbGrid& grid) : reader_(reader), format_{grid.compression, grid.half, 0} {}

  Topology read() {
    if (reader_.get<std::uint32_t>() != 1) reader_.fail("trees with several buffers a leaf cannot be read");
    format_.background = reader_.get<float>();
    if (format_.background != 0) {
      reader_.fail(fmt::format("the density's background is {}; only 0 can be rendered", format_.background));
    }
    const auto tiles = reader_.get<std::uint32_t>(), children = reader_.get<std::uint32_t>();
    for (std::uint32_t i = 0; i < tiles; ++i) {
      const Voxel origin = root_origin();
      const auto value = reader_.get<float>();
      add_tile(origin, 4096, value, reader_.get<std::uint8_t>() != 0);
    }
    for (std::uint32_t i = 0; i < children; ++i) read_node<5>(root_origin());
    topology_.values_position = reader_.position();
    return std::move(topology_);
  }

 private:
  Voxel root_origin() {
    Voxel origin;
    for (std::int64_t& axis : origin) {
      axis = reader_.get<std::int32_t>();
      if (axis % 4096 != 0) reader_.fail("a node of the tree's root is out of place");
    }
    if (!root_origins_.insert(origin).second) reader_.fail("two nodes of the tree's root are in one place");
    return origin;
  }

  void add_tile(Voxel origin, std::int64_t edge, float value, bool active) {
    if (active) topology_.active.add_cube(origin, edge);
    if (value != 0) topology_.tiles.push_back({origin, edge, value});
  }

  // A node of 2^log2_edge children or tiles along each axis: 5 above 4 above the leaves.
  template <int log2_edge>
  void read_node(Voxel origin) {
    constexpr std::size_t count = std::size_t{1} << (3 * log2_edge);
    constexpr std::int64_t child_edge = log2_edge == 5 ? 128 : 8;
    std::array<std::uint64_t, count / 64> children, active;
    reader_.get_all(children);
    reader_.get_all(active);
    std::vector<float> values(count);
    read_vdb_values(reader_, format_, active, values);
    for (std::size_t i = 0; i < count; ++i) {
      const auto place = [&](int shift) { return static_cast<std::int64_t>((i >> shift) & ((1u << log2_edge) - 1)); };
      const Voxel at{origin[0] + place(2 * log2_edge) * child_edge, origin[1] + place(log2_edge) * child_edge,
                     origin[2] + place(0) * child_edge};
      if (((children[i / 64] >> (i % 64)) & 1) == 0) {
        add_tile(at, child_edge, values[i], ((active[i / 64] >> (i % 64)) & 1) != 0);
      } else if constexpr (log2_edge == 5) {
        read_node<4>(at);
      } else {
        Leaf& leaf = topology_.leaves.emplace_back();
        leaf.origin = at;
        reader_.get_all(leaf.active);
        topology_.active.add_leaf(at, leaf.active);
      }
    }
  }

  ByteReader& reader_;
  VdbValueFormat format_;
  Topology topology_;
  std::set<Voxel> root_origins_;
};

const VdbGrid& tree_owner(const ByteReader& reader, const std::vector<VdbGrid>& grids, const VdbGrid& grid) {
  if (grid.instance_parent.empty()) return grid;
  for (const VdbGrid& other : grids) {
    if (other.unique_name == grid.instance_parent && other.instance_parent.empty()) return other;
  }
  reader.fail(fmt::format("grid \"{}\" shares the tree of a grid that is not in the file", grid.name));
}

Topology read_topology(ByteReader& reader, const std::vector<VdbGrid>& grids, const VdbGrid& grid) {
  const VdbGrid& owner = tree_owner(reader, grids, grid);
  if (owner.type != float_tree) reader.fail(fmt::format("grid \"{}\" shares a tree of another type", grid.name));
  reader.seek(owner.tree_position);
  return TopologyReader(reader, owner).read();
}

// "float" of "Tree_float_5_4_3", "half" of the same saved as half.
std::string value_type(const VdbGrid& grid) {
  const std::size_t begin = grid.type.find('_'),
                    end = begin == std::string::npos ? begin : grid.type.find('_', begin + 1);
  if (end == std::string::npos) return grid.type;
  const std::string type = grid.type.substr(begin + 1, end - begin - 1);
  return type == "float" && grid.half ? "half" : type;
}

std::string text_metadata(const VdbGrid& grid, std::string_view name, std::string_view otherwise) {
  const auto found = grid.metadata.find(name);
  return std::string(found == grid.metadata.end() ? otherwise : std::string_view(found->second));
}

// The box and number of active voxels that the file's metadata tells of; false where it does not.
bool active_by_metadata(const VdbGrid& grid, ActiveVoxels& active) {
  const auto lo = grid.metadata.find("file_bbox_min"), hi = grid.metadata.find("file_bbox_max");
  const auto count = grid.metadata.find("file_voxel_count");
  if (lo == grid.metadata.end() || hi == grid.metadata.end() || count == grid.metadata.end()) return false;
  std::array<std::int32_t, 3> corner;
  if (lo->second.size() != sizeof corner || hi->second.size() != sizeof corner) return false;
  if (count->second.size() != sizeof active.count) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::memcpy(corner.data(), lo->second.data(), sizeof corner);
    active.box.lo[axis] = corner[axis];
    std::memcpy(corner.data(), hi->second.data(), sizeof corner);
    active.box.hi[axis] = corner[axis];
  }
  std::memcpy(&active.count, count->second.data(), sizeof active.count);
  return true;
}

std::string why_not_renderable(const VdbGrid& grid, const std::string& grid_class) {
  if (grid.type != float_tree) return fmt::format("not a density: its values are of type {}", value_type(grid));
  if (grid_class == "level set") return "a level set; convert it to a fog volume first";
  if (!grid.affine) return fmt::format("its transform is a {}; only affine ones can be rendered", grid.map_type);
  return "";
}

}  // namespace

std::vector<GridInfo> list_vdb(const std::string& file, std::string_view bytes) {
  ByteReader reader(file, bytes);
  const std::vector<VdbGrid> grids = read_vdb_directory(reader);
  std::vector<GridInfo> infos;
  for (const VdbGrid& grid : grids) {
    GridInfo info;
    info.name = grid.name;
    info.type = value_type(grid);
    info.grid_class = text_metadata(grid, "class", "unknown");
    info.note = why_not_renderable(grid, info.grid_class);
    info.renderable = info.note.empty();
    ActiveVoxels active;
    if (!active_by_metadata(grid, active) && info.renderable) active = read_topology(reader, grids, grid).active;
    describe_placement(info, active, grid.world_from_lattice);
    infos.push_back(std::move(info));
  }
  return infos;
}

VolumeGrid read_vdb(const std::string& file, std::string_view bytes, std::size_t index, GridReading reading) {
  ByteReader reader(file, bytes);
  const std::vector<VdbGrid> grids = read_vdb_directory(reader);
  const VdbGrid& grid = grids.at(index);
  const Topology topology = read_topology(reader, grids, grid);
  LeafCollector collector(file, grid.name, topology.active.box, reading, bytes.size());
  for (const Tile& tile : topology.tiles) collector.tile(tile.origin, tile.edge, tile.value);

  const VdbGrid& owner = tree_owner(reader, grids, grid);
  const VdbValueFormat format{owner.compression, owner.half, 0};
  reader.seek(topology.values_position);
  std::array<float, brick_voxels> values;
  for (const Leaf& leaf : topology.leaves) {
    reader.take(sizeof leaf.active);  // the mask once more
    read_vdb_values(reader, format, leaf.active, values);
    collector.leaf(leaf.origin, values);
  }
  return collector.finish(grid.world_from_lattice);
}

}  // namespace brume
