// check_transmittance FILE...: tracking against exact optical depths, on 1,000 rays through each grid of volume files,
// in every storage. Both the estimate of ratio tracking and the share of a split track that passes have the expectation
// e^(-depth); z-scores of blocks of rays judge their means. Prints a line for each grid; exit code 1 where one fails.
// An extinction 2 % off, judged from the same estimates, must fail, so that a check that sees nothing does not pass.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <string>

#include "base/diagnostics.h"
#include "compile/compile.h"
#include "intersect/intersector.h"
#include "render/density.h"
#include "render/track.h"
#include "volume/read_volume.h"

namespace brume {
namespace {

constexpr std::size_t ray_count = 1000, block_rays = 10;
constexpr std::uint32_t copies = 100, passes = 15;  // of estimates of each ray
constexpr double fault = 1.02;                      // of the twin's extinction

float uniform(std::uint32_t a, std::uint32_t b, std::uint32_t c) { return kernel::random_uniform(31, a, b, c); }

struct Rays {
  DensityStretches stretches;  // a world unit is a voxel
  std::vector<float> depths;   // at extinction 1
  void add(const DensityStretches& from, std::size_t i, float depth) {
    const DensityStretches& f = from;
    stretches.add({f.entry_x[i], f.entry_y[i], f.entry_z[i]}, {f.direction_x[i], f.direction_y[i], f.direction_z[i]},
                  f.length[i], 0);
    depths.push_back(depth);
  }
};

// The line through a random point of the grid's bounds in a random direction, from side to side.
void add_chord(const CompiledGrid& grid, std::uint32_t number, DensityStretches& stretches) {
  const float z = 2 * uniform(1, number, 0) - 1, turn = 6.2831853f * uniform(1, number, 1);
  const float across = std::sqrt(1 - z * z);
  const float direction[3] = {across * std::cos(turn), across * std::sin(turn), z};
  float point[3], begin = -far_away, end = far_away;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const float lo = grid.bounds_lo[axis], hi = grid.bounds_hi[axis], d = direction[axis];
    point[axis] = lo + (hi - lo) * uniform(2, number, axis);
    if (d == 0) continue;
    begin = std::max(begin, std::min((lo - point[axis]) / d, (hi - point[axis]) / d));
    end = std::min(end, std::max((lo - point[axis]) / d, (hi - point[axis]) / d));
  }
  float entry[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
    entry[axis] = std::clamp(point[axis] + begin * direction[axis], grid.bounds_lo[axis], grid.bounds_hi[axis]);
  stretches.add({entry[0], entry[1], entry[2]}, {direction[0], direction[1], direction[2]}, end - begin, number);
}

// Those that meet any density, up to ray_count; a grid that is almost empty has fewer.
Rays draw_rays(const CompiledGrid& grid) {
  Rays rays;
  for (std::uint32_t number = 0; number < 100 * ray_count && rays.depths.size() < ray_count;) {
    DensityStretches drawn;
    for (std::size_t i = 0; i < ray_count; ++i) add_chord(grid, number++, drawn);
    DensityQuadrature exact;
    exact.dda = true;
    exact.enough = far_away;
    std::vector<float> depths;
    DensityStretches padded = drawn;
    integrate_density(grid.view(), exact, padded, depths);
    for (std::size_t i = 0; i < ray_count && rays.depths.size() < ray_count; ++i)
      if (depths[i] > 0) rays.add(drawn, i, depths[i]);
  }
  return rays;
}

// Sums of a ray's estimates and of their squares.
struct Estimates {
  double sum = 0, squares = 0;
  void add(double value) {
    sum += value;
    squares += value * value;
  }
};

struct Scores {
  double mean = 0, deviation = 0;
  int blocks = 0;
  bool agree() const {
    return blocks > 0 && std::abs(mean) <= 4 / std::sqrt(blocks) &&
           std::abs(deviation - 1) <= 4 / std::sqrt(2.0 * blocks);
  }
  double standard_errors() const { return std::abs(mean) * std::sqrt(blocks); }
};

// Of the blocks' means against e^(-sigma depth).
Scores score(std::span<const Estimates> estimates, std::span<const float> depths, double sigma) {
  constexpr double n = copies * passes;
  Scores scores;
  double sum = 0, squares = 0;
  for (std::size_t first = 0; first + block_rays <= estimates.size(); first += block_rays) {
    double difference = 0, variance = 0;
    for (std::size_t i = first; i < first + block_rays; ++i) {
      const double mean = estimates[i].sum / n;
      difference += mean - std::exp(-sigma * static_cast<double>(depths[i]));
      variance += (estimates[i].squares / n - mean * mean) / (n - 1);
    }
    if (!(variance > 0)) continue;
    const double z = difference / std::sqrt(variance);
    sum += z;
    squares += z * z;
    ++scores.blocks;
  }
  scores.mean = sum / scores.blocks;
  scores.deviation = std::sqrt(std::max(0.0, squares - sum * scores.mean) / (scores.blocks - 1));
  return scores;
}

// One track along each ray for each of the copies of a pass, with the random numbers of `key`.
TrackTasks make_tasks(const DensityStretches& rays, std::uint32_t pass, std::uint32_t key) {
  TrackTasks tasks;
  tasks.make_room(copies * static_cast<std::uint32_t>(rays.size()));
  const TrackColumns& c = tasks.columns;
  for (std::uint32_t copy = pass * copies; copy < (pass + 1) * copies; ++copy)
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const std::uint32_t at = tasks.count++;
      const float entry[] = {rays.entry_x[i], rays.entry_y[i], rays.entry_z[i]};
      const float direction[] = {rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        c.entry[axis][at] = entry[axis];
        c.direction[axis][at] = direction[axis];
      }
      c.length[at] = rays.length[i];
      c.key[at] = key;
      c.pixel[at] = static_cast<std::uint32_t>(i);
      c.sample[at] = copy;
      c.hero[at] = 0;
      c.optical_depth[at] = -kernel::log_natural(1 - uniform(key, static_cast<std::uint32_t>(i), copy));
    }
  return tasks;
}

// Prints what was found, and returns whether the grid passes.
bool check(const std::string& name, VolumeGrid volume) {
  const int bits = static_cast<int>(volume.bricks.storage);
  const CompiledGrid grid = compile_grid(std::move(volume), true, BrickLayout::plain, 1);
  const Rays rays = draw_rays(grid);
  if (rays.depths.size() < ray_count) {
    std::printf("%s: FAILS: few rays meet any density\n", name.c_str());
    return false;
  }
  std::vector<float> sorted = rays.depths;
  std::ranges::nth_element(sorted, sorted.begin() + ray_count / 2);
  CompiledMedium medium;
  medium.sigma_t = constant_spectrum(1 / sorted[ray_count / 2]);
  const TrackedGrid tracked(grid, medium);
  const auto sigma = static_cast<double>(medium.sigma_t[0]);

  std::vector<Estimates> ratio(ray_count), split(ray_count);
  TrackCounts counts;
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    TrackTasks tasks = make_tasks(rays.stretches, pass, 3);
    track_transmittance(tracked, tasks, counts);
    for (std::uint32_t i = 0; i < tasks.count; ++i)
      ratio[i % ray_count].add(static_cast<double>(tasks.columns.result[i]));
    tasks = make_tasks(rays.stretches, pass, 4);
    track_split(tracked, tasks, counts);
    for (std::uint32_t i = 0; i < tasks.count; ++i)
      split[i % ray_count].add(static_cast<double>(tasks.columns.weight[0][i]));
  }
  bool passes_all = counts.majorant_violations == 0;
  std::printf("%s, %d bits:", name.c_str(), bits);
  for (const auto& [title, estimates] : {std::pair{"ratio", &ratio}, std::pair{"split", &split}}) {
    const Scores scores = score(*estimates, rays.depths, sigma);
    const Scores twin = score(*estimates, rays.depths, fault * sigma);
    std::printf(" %s z %+.3f +- %.3f of %d blocks (twin %.0f standard errors);", title, scores.mean, scores.deviation,
                scores.blocks, twin.standard_errors());
    passes_all = passes_all && scores.agree() && twin.standard_errors() > 8;
  }
  std::printf(" %lld violations: %s\n", static_cast<long long>(counts.majorant_violations),
              passes_all ? "agrees" : "FAILS");
  return passes_all;
}

// All scalar fog grids of a file.
bool check_file(const std::string& path) {
  bool passes_all = true;
  for (const GridInfo& info : list_grids(path)) {
    const std::string name = path.substr(path.rfind('/') + 1) + " " + info.name;
    if (!info.renderable) {
      std::printf("%s: skipped: %s\n", name.c_str(), info.note.c_str());
      continue;
    }
    for (const Storage storage : {Storage::u8, Storage::u16, Storage::f32})
      passes_all = check(name, read_volume(path, info.name, storage)) && passes_all;
  }
  return passes_all;
}

}  // namespace
}  // namespace brume

int main(int argc, char** argv) {
  bool passes_all = true;
  for (int i = 1; i < argc; ++i) try {
      passes_all = brume::check_file(argv[i]) && passes_all;
    } catch (const brume::InputError& e) {
      for (const brume::Diagnostic& d : e.diagnostics()) std::printf("%s: FAILS: %s\n", argv[i], d.message.c_str());
      passes_all = false;
    }
  return passes_all && argc > 1 ? 0 : 1;
}
