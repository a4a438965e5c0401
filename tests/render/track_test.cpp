// Tracking against exact optical depths, on every instruction set of the machine: the mean of the estimates of
// transmittance along 1,000 rays by z-scores, and the places of collisions by Pearson's test. The faults this catches:
// a majorant that does not bound, a weight or a null collision that is left out, a tap whose mean is not the
// interpolant.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>

#include "compile/compile.h"
#include "kernel/statistics.h"
#include "lanes/instruction_set.h"
#include "render/density.h"
#include "render/scenes.h"
#include "render/track.h"

namespace brume {
namespace {

constexpr std::size_t rays = 1000;
constexpr std::array<int, 3> resolution{21, 17, 30};

float uniform(std::uint32_t a, std::uint32_t b, std::uint32_t c) { return kernel::random_uniform(77, a, b, c); }

// A grid of noise with holes, or a cloud, and the coefficients of its medium.
CompiledScene volume(int bits, bool linear, bool is_cloud = false) {
  std::vector<float> density(static_cast<std::size_t>(resolution[0] * resolution[1] * resolution[2]));
  for (std::uint32_t i = 0; i < density.size(); ++i) {
    const std::uint32_t block = i / 7;  // runs of alike values: majorants then differ from cell to cell
    density[i] = std::max(0.0f, 2 * uniform(1, block, 0) - 1) * (0.5f + uniform(2, i, 0));
  }
  SceneDescription s = needle_scene();
  s.media = {grid_medium("grid", {0, 0, 0}, {1, 1, 1}, resolution, density, 0, 1)};
  if (is_cloud) s.media[0].kind = ProceduralMedium{usual_procedural(ProceduralName::cloud, 64, 2)};
  s.media[0].storage_bits = bits;
  s.media[0].linear_interpolation = linear;
  s.shapes = {free_volume("grid")};
  std::vector<Diagnostic> warnings;
  return compile(s, 1, warnings);
}

// Stretches between random points of the bounds, some along axes; a world unit is a voxel.
DensityStretches random_stretches(const CompiledGrid& grid) {
  DensityStretches stretches;
  for (std::uint32_t i = 0; stretches.size() < rays; ++i) {
    float a[3], d[3], squared = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const float lo = grid.bounds_lo[axis], edge = grid.bounds_hi[axis] - lo;
      a[axis] = lo + edge * uniform(3, i, axis);
      d[axis] = lo + edge * uniform(4, i, axis) - a[axis];
      if (i % 5 == 1 && axis != i / 5 % 3) d[axis] = 0;
      squared += d[axis] * d[axis];
    }
    const float length = std::sqrt(squared);
    if (!(length > 1)) continue;
    stretches.add({a[0], a[1], a[2]}, {d[0] / length, d[1] / length, d[2] / length}, length, i);
  }
  return stretches;
}

std::vector<float> exact_depths(const CompiledScene& scene, DensityStretches stretches) {
  std::vector<float> depths;
  integrate_density(scene.grids[0].view(), {scene.media[0].linear, true, 0, 0, 0, 1e30f}, stretches, depths);
  return depths;
}

// `copies` tracks along each stretch, those of a stretch `rays` apart.
TrackTasks make_tasks(const DensityStretches& stretches, std::uint32_t copies, std::uint32_t hero = 0) {
  TrackTasks tasks;
  tasks.make_room(copies * static_cast<std::uint32_t>(rays));
  const TrackColumns& c = tasks.columns;
  for (std::uint32_t copy = 0; copy < copies; ++copy)
    for (std::size_t i = 0; i < rays; ++i) {
      const std::uint32_t at = tasks.count++;
      c.entry[0][at] = stretches.entry_x[i];
      c.entry[1][at] = stretches.entry_y[i];
      c.entry[2][at] = stretches.entry_z[i];
      c.direction[0][at] = stretches.direction_x[i];
      c.direction[1][at] = stretches.direction_y[i];
      c.direction[2][at] = stretches.direction_z[i];
      c.length[at] = stretches.length[i];
      c.key[at] = 5;
      c.pixel[at] = static_cast<std::uint32_t>(i);
      c.sample[at] = copy;
      c.hero[at] = hero;
      c.optical_depth[at] = -kernel::log_natural(1 - uniform(5, static_cast<std::uint32_t>(i), copy));
    }
  return tasks;
}

// Z-scores of the means of blocks of ten rays.
struct Scores {
  double mean = 0, deviation = 0;
  int blocks = 0;
  bool agree() const {
    return std::abs(mean) <= 4 / std::sqrt(blocks) && std::abs(deviation - 1) <= 4 / std::sqrt(2.0 * blocks);
  }
  double total() const { return std::abs(mean) * std::sqrt(blocks); }
};

// value(task) has the expectation e^(-sigma depth) for each of the copies of a ray.
template <class Value>
Scores score(const std::vector<float>& depths, double sigma, std::uint32_t copies, Value value) {
  double sum = 0, squares = 0;
  int blocks = 0;
  for (std::size_t first = 0; first < rays; first += 10) {
    double difference = 0, variance = 0;
    for (std::size_t i = first; i < first + 10; ++i) {
      double s = 0, s2 = 0;
      for (std::size_t copy = 0; copy < copies; ++copy) {
        const auto v = static_cast<double>(value(copy * rays + i));
        s += v;
        s2 += v * v;
      }
      const double mean = s / copies;
      difference += mean - std::exp(-sigma * static_cast<double>(depths[i]));
      variance += (s2 / copies - mean * mean) / (copies - 1);
    }
    if (!(variance > 1e-14)) continue;  // nothing but empty space
    const double z = difference / std::sqrt(variance);
    sum += z;
    squares += z * z;
    ++blocks;
  }
  const double mean = sum / blocks;
  return {mean, std::sqrt((squares / blocks - mean * mean) * blocks / (blocks - 1)), blocks};
}

TrackedGrid tracked(const CompiledScene& scene, Spectrum sigma_t) {
  CompiledMedium medium = scene.media[0];
  medium.sigma_t = sigma_t;
  return {scene.grids[0], medium};
}

constexpr std::uint32_t copies = 300;

class Track : public ::testing::Test {
 protected:
  void TearDown() override { use_instruction_set(""); }
};

Scores transmittance_scores(const CompiledScene& scene, const DensityStretches& stretches,
                            const std::vector<float>& depths, const TrackedGrid& grid, double sigma) {
  (void)scene;
  TrackTasks tasks = make_tasks(stretches, copies);
  TrackCounts counts;
  track_transmittance(grid, tasks, counts);
  EXPECT_EQ(counts.majorant_violations, 0);
  return score(depths, sigma, copies, [&](std::size_t task) { return tasks.columns.result[task]; });
}

void expect_transmittance(const CompiledScene& scene, float sigma, const std::string& name) {
  const DensityStretches stretches = random_stretches(scene.grids[0]);
  const Scores s = transmittance_scores(scene, stretches, exact_depths(scene, stretches),
                                        tracked(scene, constant_spectrum(sigma)), static_cast<double>(sigma));
  std::printf("%s: z %+.3f +- %.3f of %d blocks\n", name.c_str(), s.mean, s.deviation, s.blocks);
  EXPECT_TRUE(s.agree()) << name;
}

TEST_F(Track, TransmittanceIsThatOfTheExactOpticalDepth) {
  for (const bool linear : {false, true})
    for (const int bits : {8, 16, 32})
      expect_transmittance(volume(bits, linear), 0.3f, std::to_string(bits) + (linear ? " linear" : " nearest"));
  expect_transmittance(volume(16, true, true), 0.1f, "cloud");
}

TEST_F(Track, EveryInstructionSetTracks) {
  const CompiledScene scene = volume(16, true);
  for (const InstructionSet& set : available_instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set.name));
    expect_transmittance(scene, 0.3f, std::string(set.name));
  }
}

// Twins: an extinction that is 2 % off, bounds that are too low (which are counted, too), and the nearest voxel in
// place of a tap.
TEST_F(Track, FaultsAreRejected) {
  CompiledScene scene = volume(16, true);
  const DensityStretches stretches = random_stretches(scene.grids[0]);
  const std::vector<float> depths = exact_depths(scene, stretches);
  const TrackedGrid grid = tracked(scene, constant_spectrum(0.3f));
  EXPECT_GT(transmittance_scores(scene, stretches, depths, tracked(scene, constant_spectrum(0.306f)), 0.3).total(), 8);
  TrackedGrid nearest = grid;
  nearest.linear = false;
  EXPECT_FALSE(transmittance_scores(scene, stretches, depths, nearest, 0.3).agree());

  for (std::uint32_t& word : scene.grids[0].majorants)
    word = std::bit_cast<std::uint32_t>(0.7f * std::bit_cast<float>(word));
  TrackTasks tasks = make_tasks(stretches, copies);
  TrackCounts counts;
  track_transmittance(tracked(scene, constant_spectrum(0.3f)), tasks, counts);
  EXPECT_GT(counts.majorant_violations, 1000);
  const Scores s = score(depths, 0.3, copies, [&](std::size_t task) { return tasks.columns.result[task]; });
  EXPECT_GT(s.total(), 8);
}

// What is left of a split track is its transmittance, and the rest of it has collided up to a depth of d as often as
// light has: the mean of (1 - weight) over collisions before d is 1 - e^-d.
TEST_F(Track, SplitTracksAreWorthWhatTheyAre) {
  const CompiledScene scene = volume(16, true);
  const DensityStretches stretches = random_stretches(scene.grids[0]);
  const std::vector<float> depths = exact_depths(scene, stretches);
  const double sigma = 0.3;
  const TrackedGrid grid = tracked(scene, constant_spectrum(0.3f));
  for (const InstructionSet& set : available_instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set.name));
    TrackTasks tasks = make_tasks(stretches, copies);
    TrackCounts counts;
    track_split(grid, tasks, counts);
    EXPECT_EQ(counts.majorant_violations, 0);
    const TrackColumns& c = tasks.columns;
    const auto left = [&](std::size_t task) { return c.weight[0][task]; };
    EXPECT_TRUE(score(depths, sigma, copies, left).agree()) << set.name;
    EXPECT_GT(score(depths, 1.02 * sigma, copies, left).total(), 8);

    DensityStretches halves = stretches;
    for (float& length : halves.length) length *= 0.5f;
    const std::vector<float> half_depths = exact_depths(scene, halves);
    const auto not_in_first_half = [&](std::size_t task) {
      const bool collided = c.result[task] >= 0 && c.result[task] < 0.5f * c.length[task];
      return collided ? c.weight[0][task] : 1;
    };
    const Scores s = score(half_depths, sigma, copies, not_in_first_half);
    EXPECT_TRUE(s.agree()) << set.name << " z " << s.mean << " +- " << s.deviation;
    EXPECT_GT(score(half_depths, 1.05 * sigma, copies, not_in_first_half).total(), 8);
  }
}

// Where channels differ: transmittance in each of them, and flights that one of them steers, weighted for the others.
// Catches an extinction that is 5 % off, and flights whose null collisions weigh the same in the channels that do not
// steer: the twin gives them the weight of the one that does.
TEST_F(Track, EachChannelHasItsOwnTransmittance) {
  const CompiledScene scene = volume(16, true);
  const DensityStretches stretches = random_stretches(scene.grids[0]);
  const std::vector<float> depths = exact_depths(scene, stretches);
  const Spectrum sigma{{0.15f, 0.3f, 0.22f}};
  const TrackedGrid grid = tracked(scene, sigma);
  for (const InstructionSet& set : available_instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set.name));
    TrackCounts counts;
    TrackTasks tasks = make_tasks(stretches, copies);
    track_transmittance(grid, tasks, counts);
    const auto channel_scores = [&](const TrackTasks& t, bool is_flight, std::size_t c, double as_if) {
      return score(depths, as_if, copies, [&](std::size_t task) {
        return is_flight && t.columns.result[task] >= 0 ? 0 : t.columns.weight[c][task];
      });
    };
    for (std::size_t c = 0; c < 3; ++c) {
      const auto exact = static_cast<double>(sigma[static_cast<int>(c)]);
      EXPECT_TRUE(channel_scores(tasks, false, c, exact).agree()) << set.name << " " << c;
      EXPECT_GT(channel_scores(tasks, false, c, 1.05 * exact).total(), 8);
    }
    for (std::uint32_t hero = 0; hero < 3; ++hero) {
      TrackTasks flights = make_tasks(stretches, copies, hero);
      track_collisions(grid, flights, counts);
      for (std::size_t c = 0; c < 3; ++c) {
        const auto exact = static_cast<double>(sigma[static_cast<int>(c)]);
        const Scores s = channel_scores(flights, true, c, exact);
        EXPECT_TRUE(s.agree()) << set.name << " hero " << hero << " channel " << c << " z " << s.mean << " +- "
                               << s.deviation;
        if (c != hero) {
          EXPECT_GT(channel_scores(flights, true, hero, exact).total(), 8);
        }
      }
    }
    EXPECT_EQ(counts.majorant_violations, 0);
  }
}

// The p-value that collisions are where the exact depth says: 1 - e^(-depth) at a collision, and a number between that
// of the whole stretch and 1 where there is none, are uniform together.
double collision_p_value(const CompiledScene& scene, float sigma, float believed) {
  constexpr std::uint32_t copies_here = 200;
  DensityStretches stretches = random_stretches(scene.grids[0]);
  TrackTasks tasks = make_tasks(stretches, copies_here);
  TrackCounts counts;
  track_collisions(tracked(scene, constant_spectrum(sigma)), tasks, counts);
  EXPECT_EQ(counts.majorant_violations, 0);
  DensityStretches flights;
  for (std::uint32_t i = 0; i < tasks.count; ++i) {
    const TrackColumns& c = tasks.columns;
    flights.add({c.entry[0][i], c.entry[1][i], c.entry[2][i]},
                {c.direction[0][i], c.direction[1][i], c.direction[2][i]}, c.result[i] < 0 ? c.length[i] : c.result[i],
                0);
  }
  const std::vector<float> depths = exact_depths(scene, flights);
  std::vector<double> counts_by_bin(100), chances(100, 0.01);
  for (std::uint32_t i = 0; i < tasks.count; ++i) {
    double v = 1 - std::exp(static_cast<double>(-believed * depths[i]));
    if (tasks.columns.result[i] < 0) v += (1 - v) * static_cast<double>(uniform(6, i, 0));
    ++counts_by_bin[static_cast<std::size_t>(std::min(99.0, 100 * v))];
  }
  return chi_squared_p_value(chi_squared(counts_by_bin, chances, tasks.count), 99);
}

TEST_F(Track, CollisionsAreWhereTheExactOpticalDepthSays) {
  const double significance = sidak(0.01, 2 * 3 + 1 + static_cast<int>(available_instruction_sets().size()));
  for (const bool linear : {false, true})
    for (const int bits : {8, 16, 32})
      EXPECT_GT(collision_p_value(volume(bits, linear), 0.3f, 0.3f), significance) << bits << linear;
  EXPECT_GT(collision_p_value(volume(16, true, true), 0.1f, 0.1f), significance);
  for (const InstructionSet& set : available_instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set.name));
    EXPECT_GT(collision_p_value(volume(16, true), 0.3f, 0.3f), significance) << set.name;
  }
  use_instruction_set("");
  // The twin, 5 % off.
  EXPECT_LT(collision_p_value(volume(16, true), 0.3f, 0.315f), 1e-6);
}

// A track's result is its own, whichever tracks run beside it, and has the same bits.
TEST_F(Track, AResultDoesNotDependOnItsNeighbours) {
  const CompiledScene scene = volume(16, true);
  const DensityStretches stretches = random_stretches(scene.grids[0]);
  const TrackedGrid grid = tracked(scene, Spectrum{{0.15f, 0.3f, 0.22f}});
  for (const InstructionSet& set : available_instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set.name));
    TrackTasks all = make_tasks(stretches, 2);
    TrackCounts counts;
    track_collisions(grid, all, counts);
    for (const std::uint32_t only : {0u, 17u, 999u}) {
      TrackTasks one = make_tasks(stretches, 1);
      const TrackColumns& c = one.columns;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        c.entry[axis][0] = c.entry[axis][only];
        c.direction[axis][0] = c.direction[axis][only];
      }
      c.length[0] = c.length[only];
      c.optical_depth[0] = c.optical_depth[only];
      c.pixel[0] = c.pixel[only];
      one.count = 1;
      track_collisions(grid, one, counts);
      EXPECT_EQ(c.result[0], all.columns.result[only]) << set.name;
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(c.weight[k][0], all.columns.weight[k][only]) << set.name;
    }
  }
}

}  // namespace
}  // namespace brume
