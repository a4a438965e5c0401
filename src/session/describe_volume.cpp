#include <fmt/format.h>

#include <algorithm>

#include "base/diagnostics.h"
#include "scene/messages.h"
#include "session/describe_file.h"
#include "session/grid_extent.h"
#include "volume/read_volume.h"

namespace brume {

namespace {

std::string text(const Vector3& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); }

// The bricks of a grid take the same number of words for each bit of a voxel; the table has the same size always.
std::string memory(const BrickGrid& grid, int bits) {
  const double table = static_cast<double>(grid.table.size()), words = static_cast<double>(grid.words.size());
  return fmt::format("{:.4g}", 4e-6 * (table + words * bits / static_cast<int>(grid.storage)));
}

// What its voxels say.
std::string describe_densities(const VolumeGrid& grid) {
  const BrickGrid& bricks = grid.bricks;
  double in_array = 1, in_box = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    in_array *= bricks.voxels[axis];
    in_box *= bricks.voxels[axis] - grid.first_voxel[axis];
  }
  std::string lines =
      fmt::format("    densities from {:.4g} to {:.4g}, mean {:.4g}; {:.3g} % of the voxels are above 0\n",
                  smallest_density(grid), bricks.max_value, bricks.mean_value * in_array / in_box,
                  100 * static_cast<double>(bricks.nonzero_voxels) / in_box);
  lines += fmt::format("    memory: {} MB with 8 bits a voxel, {} with 16, {} with 32\n", memory(bricks, 8),
                       memory(bricks, 16), memory(bricks, 32));
  if (!(bricks.max_value > 0)) return lines;
  const Vector3 edge = voxel_size(grid);
  double deepest = 0;
  for (int axis = 0; axis < 3; ++axis) deepest = std::max(deepest, densest_row(grid, axis) * edge[axis]);
  lines += fmt::format(
      "    where sigma_a + sigma_s is 1: mean free path {:.4g} at the greatest density, optical depth "
      "{:.4g} along\n    the densest row of voxels, which \"scale\" {:.4g} would bring to 10\n",
      1 / static_cast<double>(bricks.max_value), deepest, 10 / deepest);
  return lines;
}

}  // namespace

FileDescription describe_volume(const std::string& path) {
  const std::vector<GridInfo> grids = list_grids(path);
  std::vector<std::string> faults;
  std::string lines = fmt::format("{}: {} grid{}\n", path, grids.size(), grids.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const GridInfo& grid = grids[i];
    lines +=
        fmt::format("  {}: {}, {}{}\n", grid.name.empty() ? "(no name)" : printable(grid.name), printable(grid.type),
                    printable(grid.grid_class), grid.renderable ? "" : "; cannot be rendered");
    const auto& n = grid.voxels;
    const auto& first = grid.first_voxel;
    lines += fmt::format("    {} x {} x {} voxels, {} active, each {:.6g} x {:.6g} x {:.6g}\n", n[0], n[1], n[2],
                         grid.active_voxels, grid.voxel_size.x, grid.voxel_size.y, grid.voxel_size.z);
    if (n[0] > 0)
      lines += fmt::format("    index ({}, {}, {}) to ({}, {}, {}), bounds {} to {}\n", first[0], first[1], first[2],
                           first[0] + n[0] - 1, first[1] + n[1] - 1, first[2] + n[2] - 1, text(grid.bounds.lo),
                           text(grid.bounds.hi));
    if (!grid.note.empty()) lines += fmt::format("    {}\n", grid.note);
    if (!grid.renderable) continue;
    try {
      lines += describe_densities(read_volume(path, i, Storage::u16));
    } catch (const InputError& e) {
      lines += fmt::format("    cannot be rendered: {}\n", e.diagnostics().front().message);
      faults.emplace_back(e.what());
    }
  }
  return {lines, faults};
}

}  // namespace brume
