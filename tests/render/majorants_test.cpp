// Majorants bound the densities that are looked up, in every storage of a grid: where one does not, renderers count it.
#include <gtest/gtest.h>

#include <bit>
#include <cstdio>

#include "compile/compile.h"
#include "kernel/scalar.h"
#include "lanes/instruction_set.h"
#include "render/backend.h"
#include "render/scenes.h"
#include "render/track.h"
#include "sanitized.h"

namespace brume {
namespace {

float noise(std::uint32_t i, std::uint32_t k) { return kernel::random_uniform(77, 1, i, k); }

// A cube of noise with holes, in 8, 16 or 32 bits, or a cloud.
CompiledScene volume(int bits, bool linear, bool is_cloud = false) {
  constexpr int edge = 32;
  std::vector<float> density(std::size_t{edge} * edge * edge);
  for (std::uint32_t i = 0; i < density.size(); ++i)
    density[i] = std::max(0.0f, 2 * noise(i / 7, 0) - 1) * (0.5f + noise(i, 1));
  SceneDescription s = needle_scene({0, 0, -3});
  s.camera.fov = 40;
  s.film.width = s.film.height = 64;
  s.media = {grid_medium("grid", {-1, -1, -1}, {1, 1, 1}, {edge, edge, edge}, density, 0.1f, 4)};
  if (is_cloud) s.media[0].kind = ProceduralMedium{usual_procedural(ProceduralName::cloud, 64, 2)};
  s.media[0].storage_bits = bits;
  s.media[0].linear_interpolation = linear;
  s.shapes = {free_volume("grid")};
  s.lights = {sky(1)};
  std::vector<Diagnostic> warnings;
  return compile(s, 2, warnings);
}

void lower_majorants(CompiledScene& scene, float factor) {
  scene.grids[0].max_density *= factor;
  for (std::uint32_t& word : scene.grids[0].majorants)
    word = std::bit_cast<std::uint32_t>(factor * std::bit_cast<float>(word));
}

std::int64_t violations(CompiledScene& scene, CompiledIntegrator::Kind integrator) {
  scene.integrator.kind = integrator;
  const auto backend = make_cpu_backend();
  backend->prepare(scene);
  Film film(scene.width, scene.height);
  backend->render(0, 16, 2, film, [](double) { return true; });
  return backend->counts().majorant_violations;
}

TEST(Majorants, ViolationsAreCountedAndThereAreNone) {
  using Kind = CompiledIntegrator::Kind;
  for (const bool linear : {false, true})
    for (const int bits : {8, 16, 32})
      for (const Kind integrator : {Kind::reference, Kind::volpath}) {
        CompiledScene scene = volume(bits, linear);
        EXPECT_EQ(violations(scene, integrator), 0) << bits << linear;
        lower_majorants(scene, 0.9f);
        EXPECT_GT(violations(scene, integrator), 0) << bits << linear;
      }
}

constexpr std::uint32_t tracks = 1u << 14;

// Transmittance tracking along straight lines through the cube, so that no track ends before its majorants do.
void fill(TrackTasks& tasks, const CompiledGrid& grid, std::uint32_t round) {
  tasks.make_room(tracks);
  tasks.count = tracks;
  const TrackColumns& c = tasks.columns;
  for (std::uint32_t i = 0; i < tracks; ++i) {
    const std::uint32_t along = i % 3;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const float lo = grid.bounds_lo[axis], edge = grid.bounds_hi[axis] - lo;
      c.entry[axis][i] = axis == along ? lo : lo + edge * kernel::random_uniform(5, round, i, axis);
      c.direction[axis][i] = axis == along ? 1 : 0;
    }
    c.length[i] = grid.bounds_hi[along] - grid.bounds_lo[along];
    c.key[i] = round;
    c.pixel[i] = i;
    c.sample[i] = 0;
    c.hero[i] = 0;
  }
}

struct Storage {
  const char* name;
  int bits;
  bool linear, is_cloud;
};
constexpr Storage storages[] = {{"8 bits, nearest", 8, false, false},
                                {"8 bits, linear", 8, true, false},
                                {"16 bits, nearest", 16, false, false},
                                {"16 bits, linear", 16, true, false},
                                {"32 bits, nearest", 32, false, false},
                                {"32 bits, linear", 32, true, false},
                                {"cloud", 16, true, true}};

TrackCounts track(const CompiledScene& scene, std::int64_t look_ups) {
  CompiledMedium medium = scene.media[0];
  medium.sigma_t = constant_spectrum(40);  // look-ups, not light, are what this is about
  const TrackedGrid grid(scene.grids[0], medium);
  TrackTasks tasks;
  TrackCounts counts;
  for (std::uint32_t round = 0; counts.look_ups < look_ups; ++round) {
    tasks.count = 0;
    fill(tasks, scene.grids[0], round);
    track_transmittance(grid, tasks, counts);
  }
  return counts;
}

// No violation among `look_ups` look-ups on each instruction set, of all storages together. The twin: bounds that are
// too low by a twentieth, which are too low in few places.
void expect_no_violations(std::int64_t look_ups) {
  for (const InstructionSet& set : available_instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set.name));
    TrackCounts total;
    for (const Storage& storage : storages) {
      CompiledScene scene = volume(storage.bits, storage.linear, storage.is_cloud);
      const TrackCounts counts = track(scene, look_ups / static_cast<std::int64_t>(std::size(storages)) + 1);
      EXPECT_EQ(counts.majorant_violations, 0) << storage.name;
      total.look_ups += counts.look_ups;
      total.majorant_violations += counts.majorant_violations;
      lower_majorants(scene, 0.95f);
      EXPECT_GT(track(scene, 1).majorant_violations, 0) << storage.name;
    }
    std::printf("%s: %lld look-ups, %lld violations\n", set.title.data(), static_cast<long long>(total.look_ups),
                static_cast<long long>(total.majorant_violations));
    EXPECT_GE(total.look_ups, look_ups);
  }
  use_instruction_set("");
}

TEST(Majorants, BoundTenMillionLookUps) { expect_no_violations(sanitized ? 100'000 : 10'000'000); }
TEST(NightlyMajorants, BoundABillionLookUps) { expect_no_violations(1'000'000'000); }

}  // namespace
}  // namespace brume
