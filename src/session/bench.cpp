#include "brume/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <thread>

#include "base/parallel.h"
#include "compile/compile.h"
#include "lanes/instruction_set.h"
#include "render/density.h"
#include "session/errors.h"
#include "session/furnace.h"
#include "session/instruction_set_choice.h"
#include "session/version.h"
#include "volume/procedural.h"
#include "volume/resample.h"

namespace brume {

namespace {

constexpr int rounds = 5;

// How often run() counts up what it returns, a second of CPU time; the best round, since what else the machine does can
// only slow one down.
template <class Run>
double rate_of(double seconds, Run&& run) {
  double best = 0;
  for (int round = 0; round < rounds; ++round) {
    std::int64_t done = 0;
    const std::clock_t begin = std::clock();
    double used = 0;
    do {
      done += run();
      used = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    } while (used * rounds < seconds);
    best = std::max(best, static_cast<double>(done) / used);
  }
  return best;
}

float random_number(std::uint32_t ray, std::uint32_t number) { return kernel::random_uniform(1, 0, ray, number); }

// The stream alone: stretches of paths in a furnace, as many at a time as a worker of volpath has.
double tracking_rate(const CompiledScene& scene, double seconds) {
  constexpr int until_settled = 16, waves = 64;
  FurnacePaths paths(scene);
  for (int i = 0; i < until_settled; ++i) paths.advance();
  std::vector<TrackTasks> stretches(waves);
  for (TrackTasks& wave : stretches) {
    paths.append_stretches(wave);
    paths.advance();
  }
  const TrackedGrid grid(scene.grids.front(), scene.media.front());
  return rate_of(seconds, [&] {
    TrackCounts counts;
    for (TrackTasks& wave : stretches) track_collisions(grid, wave, counts);
    return counts.steps + counts.look_ups;
  });
}

// Straight through a volume.
double marching_rate(const CompiledGrid& grid, double seconds) {
  DensityStretches stretches;
  DensityQuadrature quadrature;
  quadrature.step = 1;
  quadrature.enough = far_away;
  const auto extent = [&](std::size_t axis) { return grid.bounds_hi[axis] - grid.bounds_lo[axis]; };
  for (std::uint32_t ray = 0; ray < 4096; ++ray) {
    const auto place = [&](std::size_t axis) {
      return grid.bounds_lo[axis] + extent(axis) * (0.1f + 0.8f * random_number(ray, static_cast<std::uint32_t>(axis)));
    };
    stretches.add({place(0), place(1), grid.bounds_lo[2] + 0.5f}, {0, 0, 1}, extent(2) - 1, ray);
  }
  const auto look_ups = static_cast<std::int64_t>(4096 * std::ceil(extent(2) - 1));
  std::vector<float> integral;
  return rate_of(seconds, [&] {
    DensityStretches copy = stretches;
    integrate_density(grid.view(), quadrature, copy, integral);
    return look_ups;
  });
}

// A height field of waves, and rays that come down on it from all around.
double surface_ray_rate(double seconds) {
  constexpr int edge = 257;
  TriangleMeshShape mesh;
  for (int j = 0; j < edge; ++j)
    for (int i = 0; i < edge; ++i) {
      const double x = 2.0 * i / (edge - 1) - 1, z = 2.0 * j / (edge - 1) - 1;
      mesh.positions.push_back({x, 0.05 * std::sin(20 * x) * std::cos(17 * z), z});
    }
  for (std::uint32_t j = 0; j + 1 < edge; ++j)
    for (std::uint32_t i = 0; i + 1 < edge; ++i) {
      const std::uint32_t a = j * edge + i, b = a + 1, c = a + edge, d = c + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({b, d, c});
    }
  SceneDescription description;
  description.shapes.emplace_back().kind = std::move(mesh);
  std::vector<Diagnostic> warnings;
  const CompiledScene scene = compile(description, 1, warnings);
  const Intersector intersector(scene);
  std::uint32_t next = 0;
  return rate_of(seconds, [&] {
    constexpr int count = 4096;
    for (int i = 0; i < count; ++i, ++next) {
      const auto in = [&](std::uint32_t number) { return 2 * random_number(next % 65536, number) - 1; };
      const kernel::vec3 from(in(0), 1, in(1)), to(in(2), 0, in(3));
      SurfaceHit hit;
      intersector.nearest_surface({from, normalize(to - from), far_away}, hit);
    }
    return std::int64_t{count};
  });
}

}  // namespace

std::string bench_machine() {
  std::string model = "unknown processor";
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (const std::size_t colon = line.find(": "); line.starts_with("model name") && colon != std::string::npos) {
      model = line.substr(colon + 2);
      break;
    }
  const unsigned cores = std::thread::hardware_concurrency();
  return fmt::format("{}, {} core{}, {}", model, cores, cores == 1 ? "" : "s", software_name());
}

void bench(const BenchOptions& options, const std::function<void(const BenchResult&)>& on_result) {
  with_public_errors([&] {
    apply_instruction_set_choice();
    const InstructionSet best = current_instruction_set();
    const auto measure = [&](const std::string& name, VolumeGrid grid, const std::vector<InstructionSet>& sets) {
      const std::string storage = fmt::format("{} bits", static_cast<int>(grid.bricks.storage));
      const CompiledGrid marched = compile_grid(grid, true, BrickLayout::bordered, thread_count(options.threads));
      const CompiledScene scene = furnace_scene(std::move(grid), options.threads);
      for (const InstructionSet& set : sets) {
        use_instruction_set(set.name);
        const auto result = [&](const char* measured, const char* unit, double rate) {
          on_result({measured, unit, name, storage, std::string(set.title), rate});
        };
        result("tracking", "events", tracking_rate(scene, options.seconds));
        FurnacePaths paths(scene);
        result("paths", "events", rate_of(options.seconds, [&] { return paths.advance(); }));
        result("marching", "look-ups", marching_rate(marched, options.seconds));
      }
      use_instruction_set(best.name);
    };
    // One volume, resampled: to make each anew would take longer than to measure them.
    VolumeGrid ball;
    if (!options.sizes.empty()) ball = noise_ball(std::min(options.sizes[0], 256), Storage::f32, options.threads);
    for (std::size_t i = 0; i < options.sizes.size(); ++i)
      for (const Storage storage : {Storage::u8, Storage::u16, Storage::f32})
        if (i == 0 || storage == Storage::u16) {
          const int size = options.sizes[i];
          measure(std::to_string(size), resample(ball, {size, size, size}, storage, options.threads),
                  i == 0 ? available_instruction_sets() : std::vector{best});
        }
    for (const int size : options.sparse_sizes)
      measure(fmt::format("{} sparse", size), scattered_puffs(size, Storage::u16), {best});
    on_result({"surface rays", "rays", "", "", "", surface_ray_rate(options.seconds)});
  });
}

}  // namespace brume
