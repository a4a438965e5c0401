// The reader of .vol, Mitsuba's dense grids:
//
//   byte 0   "VOL", then the version, 3
//   byte 4   int32 encoding of the values: 1 float, 2 half, 3 bytes whose 0 to 255 stand for 0 to 1, 4 directions
//   byte 8   int32 nx, ny, nz and the number of channels
//   byte 24  six floats: the lower, then the upper corner of the box that the nx x ny x nz cells fill
//   byte 48  the values, those of a cell side by side; x fastest, then y, then z
//
// A value is that of its cell's middle, and outside the box there is nothing.
// Source: the plugin gridvolume of the documentation of Mitsuba 0.6 and Mitsuba 3.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "volume/byte_reader.h"
#include "volume/density_check.h"
#include "volume/formats.h"
#include "volume/half.h"

namespace brume {
namespace {

constexpr const char* grid_name = "density";  // the format has no names

enum class Encoding : std::int32_t { float32 = 1, float16 = 2, uint8 = 3, directions = 4 };

struct VolFile {
  Encoding encoding{};
  std::array<int, 3> voxels{};
  int channels = 0;
  Box3 box;
  std::string_view values;

  std::size_t bytes_per_value() const {
    return encoding == Encoding::float32 ? 4 : encoding == Encoding::float16 ? 2 : 1;
  }
  std::size_t cells() const {
    return static_cast<std::size_t>(voxels[0]) * static_cast<std::size_t>(voxels[1]) *
           static_cast<std::size_t>(voxels[2]);
  }
};

std::string type_name(const VolFile& vol) {
  constexpr std::array names{"float", "half", "uint8", "directions"};
  const std::string name = names[static_cast<std::size_t>(vol.encoding) - 1];
  return vol.channels == 1 ? name : fmt::format("{} x {}", name, vol.channels);
}

std::string why_not_renderable(const VolFile& vol) {
  if (vol.encoding == Encoding::directions) return "it holds directions, not densities";
  if (vol.channels == 1) return "";
  return fmt::format("not a density: it has {} values a voxel, where a density has one", vol.channels);
}

Encoding read_encoding(ByteReader& reader) {
  const auto encoding = reader.get<std::int32_t>();
  if (encoding < 1 || encoding > 4)
    reader.fail(fmt::format("unknown encoding {}; 1 (float), 2 (half) and 3 (bytes) can be read", encoding));
  return static_cast<Encoding>(encoding);
}

Box3 read_box(ByteReader& reader) {
  Box3 box;
  for (int axis = 0; axis < 3; ++axis) box.lo[axis] = static_cast<double>(reader.get<float>());
  for (int axis = 0; axis < 3; ++axis) box.hi[axis] = static_cast<double>(reader.get<float>());
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(box.lo[axis]) || !std::isfinite(box.hi[axis]) || !(box.lo[axis] < box.hi[axis]))
      reader.fail(fmt::format("its box goes from {} to {} along {}; the second must be greater", box.lo[axis],
                              box.hi[axis], "xyz"[axis]));
  return box;
}

// All that the header tells, held against the size of the file.
VolFile read_header(const std::string& file, std::string_view bytes) {
  ByteReader reader(file, bytes);
  if (bytes.size() < 4 || reader.take(3) != "VOL")
    reader.fail("not a .vol file of Mitsuba: it does not begin with VOL");
  if (const int version = reader.get<std::uint8_t>(); version != 3)
    reader.fail(fmt::format("version {} of the format; only version 3 can be read", version));
  VolFile vol;
  vol.encoding = read_encoding(reader);
  for (int& n : vol.voxels) n = reader.get<std::int32_t>();
  vol.channels = reader.get<std::int32_t>();
  vol.box = read_box(reader);
  vol.values = reader.take(bytes.size() - reader.position());
  double expected = static_cast<double>(vol.bytes_per_value());
  for (const int n : {vol.voxels[0], vol.voxels[1], vol.voxels[2], vol.channels}) {
    if (n < 1)
      reader.fail(fmt::format("{} x {} x {} voxels of {} values: each must be at least 1", vol.voxels[0], vol.voxels[1],
                              vol.voxels[2], vol.channels));
    expected *= n;
  }
  if (expected != static_cast<double>(vol.values.size()))
    reader.fail(fmt::format("{} x {} x {} voxels of type {} are {:.0f} bytes, but the file has {} after its header",
                            vol.voxels[0], vol.voxels[1], vol.voxels[2], type_name(vol), expected, vol.values.size()));
  return vol;
}

// Of a file with one channel.
float value_at(const VolFile& vol, std::size_t cell) {
  const char* at = vol.values.data() + cell * vol.bytes_per_value();
  float value = 0;
  std::uint16_t half = 0;
  switch (vol.encoding) {
    case Encoding::float32:
      std::memcpy(&value, at, sizeof value);
      return value;
    case Encoding::float16:
      std::memcpy(&half, at, sizeof half);
      return half_to_float(half);
    default:
      return static_cast<float>(static_cast<unsigned char>(*at)) / 255;
  }
}

BrickGrid read_bricks(const VolFile& vol, Storage storage, DensityCheck& check) {
  BrickGridBuilder builder(vol.voxels, storage);
  std::array<float, brick_voxels> brick;
  const auto read_brick = [&](int bx, int by, int bz) {
    brick.fill(0);
    for (int z = 8 * bz; z < std::min(8 * bz + 8, vol.voxels[2]); ++z)
      for (int y = 8 * by; y < std::min(8 * by + 8, vol.voxels[1]); ++y)
        for (int x = 8 * bx; x < std::min(8 * bx + 8, vol.voxels[0]); ++x) {
          const std::size_t row =
              static_cast<std::size_t>(z) * static_cast<std::size_t>(vol.voxels[1]) + static_cast<std::size_t>(y);
          const float value =
              value_at(vol, row * static_cast<std::size_t>(vol.voxels[0]) + static_cast<std::size_t>(x));
          brick[static_cast<std::size_t>((z & 7) * 64 + (y & 7) * 8 + (x & 7))] = check.checked(value, {x, y, z});
        }
    if (!check.failed()) builder.set_brick({bx, by, bz}, brick);
  };
  for (int bz = 0; 8 * bz < vol.voxels[2]; ++bz)
    for (int by = 0; 8 * by < vol.voxels[1]; ++by)
      for (int bx = 0; 8 * bx < vol.voxels[0]; ++bx) read_brick(bx, by, bz);
  return builder.finish();
}

Transform world_from_index(const VolFile& vol) {
  const Vector3 size = vol.box.hi - vol.box.lo;
  return translate(vol.box.lo) * scale({size.x / vol.voxels[0], size.y / vol.voxels[1], size.z / vol.voxels[2]});
}

}  // namespace

std::vector<GridInfo> list_vol(const std::string& file, std::string_view bytes) {
  const VolFile vol = read_header(file, bytes);
  VolumeGrid placed;  // for its voxel_size only
  placed.medium_from_index = world_from_index(vol);
  GridInfo info;
  info.name = grid_name;
  info.type = type_name(vol);
  info.grid_class = "dense grid";
  info.voxels = vol.voxels;
  info.active_voxels = static_cast<std::int64_t>(vol.cells());
  info.voxel_size = voxel_size(placed);
  info.bounds = vol.box;
  info.note = why_not_renderable(vol);
  info.renderable = info.note.empty();
  return {info};
}

VolumeGrid read_vol(const std::string& file, std::string_view bytes, std::size_t, GridReading reading) {
  const VolFile vol = read_header(file, bytes);
  VolumeGrid grid;
  grid.name = grid_name;
  DensityCheck check(reading.bad_values);
  try {
    grid.bricks = read_bricks(vol, reading.storage, check);
  } catch (const std::length_error& error) {
    throw InputError(file, error.what());
  }
  grid.warning = check.finish(file, grid_name);
  grid.medium_from_index = world_from_index(vol);
  grid.support = Support::cut;
  return grid;
}

}  // namespace brume
