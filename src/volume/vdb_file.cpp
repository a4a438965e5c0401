#include "volume/vdb_file.h"

#include <algorithm>
#include <array>

namespace brume {
namespace {

constexpr std::uint32_t oldest_version = 222, newest_version = newest_vdb_version;
constexpr char suffix_separator = '\x1e';  // between a grid's name and its number in a unique name

void read_header(ByteReader& reader) {
  if (reader.size() < sizeof vdb_magic || reader.get<std::uint64_t>() != vdb_magic) {
    reader.fail("not an OpenVDB file: it does not begin with the format's mark");
  }
  const auto version = reader.get<std::uint32_t>();
  if (version < oldest_version || version > newest_version) {
    reader.fail(
        fmt::format("OpenVDB file version {}; versions {} to {} can be read", version, oldest_version, newest_version));
  }
  reader.take(8);  // version of the library that wrote it
  if (reader.get<std::uint8_t>() != 1)
    reader.fail("written as a stream, without the grids' positions; save it as a file");
  reader.take(36);  // identifier
}

std::map<std::string, std::string, std::less<>> read_metadata(ByteReader& reader) {
  std::map<std::string, std::string, std::less<>> metadata;
  const auto count = reader.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::string_view name = reader.string();
    reader.string();  // type
    metadata.emplace(name, reader.string());
  }
  return metadata;
}

std::string readable_name(std::string_view unique_name) {
  const std::size_t separator = unique_name.find(suffix_separator);
  if (separator == std::string_view::npos) return std::string(unique_name);
  return fmt::format("{}[{}]", unique_name.substr(0, separator), unique_name.substr(separator + 1));
}

VdbGrid read_descriptor(ByteReader& reader) {
  VdbGrid grid;
  grid.unique_name = reader.string();
  grid.name = readable_name(grid.unique_name);
  grid.type = reader.string();
  constexpr std::string_view half_suffix = "_HalfFloat";
  if (grid.type.ends_with(half_suffix)) {
    grid.type.resize(grid.type.size() - half_suffix.size());
    grid.half = true;
  }
  grid.instance_parent = reader.string();
  grid.position = reader.get<std::uint64_t>();
  reader.take(8);  // position of the voxels, which follow the tree's nodes
  const auto end = reader.get<std::uint64_t>();
  // Each grid's own, so that no two are read from the same place.
  if (grid.position < reader.position() || grid.position > end)
    reader.fail(fmt::format("grid \"{}\" does not follow its description", grid.name));
  reader.seek(end);
  return grid;
}

// Matrices are stored row by row for row vectors, so that the translation is the last row.
Transform read_affine(ByteReader& reader) {
  std::array<std::array<double, 4>, 4> stored;
  reader.get_all(stored);
  Transform t;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) t.m[row][column] = stored[column][row];
  }
  return t;
}

Vector3 read_vector(ByteReader& reader) {
  Vector3 v;
  for (int axis = 0; axis < 3; ++axis) v[axis] = reader.get<double>();
  return v;
}

void read_map(ByteReader& reader, VdbGrid& grid) {
  constexpr std::uint64_t derived_of_scale = 4 * 3 * sizeof(double);  // voxel size, inverse scale and the like
  grid.map_type = reader.string();
  grid.affine = true;
  if (grid.map_type == "AffineMap" || grid.map_type == "UnitaryMap") {
    grid.world_from_lattice = read_affine(reader);
  } else if (grid.map_type == "ScaleMap" || grid.map_type == "UniformScaleMap") {
    grid.world_from_lattice = scale(read_vector(reader));
    reader.take(derived_of_scale);
  } else if (grid.map_type == "ScaleTranslateMap" || grid.map_type == "UniformScaleTranslateMap") {
    const Vector3 translation = read_vector(reader);
    grid.world_from_lattice = translate(translation) * scale(read_vector(reader));
    reader.take(derived_of_scale);
  } else if (grid.map_type == "TranslationMap") {
    grid.world_from_lattice = translate(read_vector(reader));
  } else {
    grid.affine = false;
  }
}

}  // namespace

std::vector<VdbGrid> read_vdb_directory(ByteReader& reader) {
  read_header(reader);
  read_metadata(reader);
  // Grids are read one by one, some of them several times.
  constexpr std::uint32_t most_grids = 1000;
  const auto count = reader.get<std::uint32_t>();
  if (count > most_grids)
    reader.fail(fmt::format("it is said to hold {} grids; at most {} are read", count, most_grids));
  std::vector<VdbGrid> grids;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t before = reader.position();
    grids.push_back(read_descriptor(reader));
    if (reader.position() <= before) reader.fail("the grids' positions run backwards");
  }
  for (VdbGrid& grid : grids) {
    reader.seek(grid.position);
    grid.compression = reader.get<std::uint32_t>();
    grid.metadata = read_metadata(reader);
    read_map(reader, grid);
    grid.tree_position = reader.position();
    const auto saved_as_half = grid.metadata.find("is_saved_as_half_float");
    grid.half = grid.half || (saved_as_half != grid.metadata.end() && saved_as_half->second == "\x01");
  }
  return grids;
}

}  // namespace brume
