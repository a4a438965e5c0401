// .vol files for the tests, in memory.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace brume {

// The value of a cell: whole numbers that differ along each axis. Encoding 2 has 1024 more, whose halves are their bits
// plus 0x6400, and encoding 3 stands for a 255th.
inline int vol_value(int x, int y, int z) { return 1 + x + 10 * y + 3 * z; }

// A file of 1 (float), 2 (half) or 3 (bytes), in the box from (-1, 0, 2) to (1, 3, 4).
inline std::string make_vol(int encoding, std::array<int, 3> voxels, int channels) {
  std::string bytes = "VOL\x03";
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(encoding);
  put(voxels);
  put(channels);
  put(std::array<float, 6>{-1, 0, 2, 1, 3, 4});
  for (int z = 0; z < voxels[2]; ++z)
    for (int y = 0; y < voxels[1]; ++y)
      for (int x = 0; x < voxels[0]; ++x)
        for (int channel = 0; channel < channels; ++channel) {
          const int value = vol_value(x, y, z);
          if (encoding == 1) put(static_cast<float>(value));
          if (encoding == 2) put(static_cast<std::uint16_t>(0x6400 + value));
          if (encoding == 3) put(static_cast<std::uint8_t>(value));
        }
  return bytes;
}

}  // namespace brume
