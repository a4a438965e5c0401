// Times the kernels' look-ups and steps, one vector in flight, for the scalar build and for the lanes on each
// instruction set of the machine. "each" is the time of one look-up, or of one cell or point of one ray. Small grids
// lie in the first-level cache; the large ones, 256^3 voxels, do not, and look-ups fall anywhere in them.
#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/kernel_loops.h"
#include "lanes/instruction_set.h"
#include "volume/brick_borders.h"
#include "volume/kernel_view.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/kernels.cpp"
#include <hwy/foreach_target.h>

#include "lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brume {
namespace HWY_NAMESPACE {

inline float lane_sum(F x) { return hn::GetLane(hn::SumOfLanes(float_tag, x.v)); }

#include "bench/kernel_loops.inl"

float run_lanes(Loop loop, const BenchGrid& grid, const BenchRays& rays) { return run_loop(loop, grid, rays); }

}  // namespace HWY_NAMESPACE
}  // namespace brume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brume {
namespace kernel {

inline int lane_count() { return 1; }
inline F load_lanes(const float* address) { return *address; }
inline float lane_sum(F x) { return x; }

#include "bench/kernel_loops.inl"

}  // namespace kernel

HWY_EXPORT(run_lanes);

namespace {

struct Grid {
  int edge;
  Storage storage;
  bool bordered;
  auto operator<=>(const Grid&) const = default;  // NOLINT(modernize-use-nullptr): of generated code
};

// Noise, made when first asked for.
const BrickGrid& noise_grid(Grid of) {
  static std::map<Grid, BrickGrid> grids;
  const auto found = grids.find(of);
  if (found != grids.end()) return found->second;
  const auto edge = static_cast<std::size_t>(of.edge);
  std::vector<float> values(edge * edge * edge);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = kernel::random_uniform(1, 0, static_cast<std::uint32_t>(i), 0);
  BrickGrid grid = make_brick_grid({of.edge, of.edge, of.edge}, values, of.storage);
  return grids.emplace(of, of.bordered ? add_borders(std::move(grid), 1) : std::move(grid)).first->second;
}

// Rays that begin in the middle half of a grid along each axis and stay in it for half its edge.
std::vector<float> make_rays(int count, int edge) {
  std::vector<float> data;
  for (std::uint32_t i = 0; i < 6; ++i)
    for (int n = 0; n < count; ++n) {
      const float u = kernel::random_uniform(2, 0, static_cast<std::uint32_t>(n), i);
      data.push_back(i < 3 ? (0.25f + 0.5f * u) * static_cast<float>(edge) : u - 0.5f);
    }
  return data;
}

void time_loop(benchmark::State& state, Loop loop, Grid of, const std::string& set) {
  const bool scalar = set == "build";
  if (!scalar) use_instruction_set(set);
  const kernel::BrickGrid grid = kernel_view(noise_grid(of));
  const BenchGrid words{grid.table, grid.bricks, grid.table_x, grid.table_xy, grid.bits, grid.bordered};
  const bool one_each = loop == Loop::nearest || loop == Loop::linear;
  const int count = of.edge < 64 || !one_each ? 1024 : 1 << 18;
  const std::vector<float> data = make_rays(count, of.edge);
  const BenchRays rays{data.data(), count, static_cast<float>(of.edge) / (2 * bench_steps)};
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(scalar ? kernel::run_loop(loop, words, rays)
                                    : HWY_DYNAMIC_DISPATCH(run_lanes)(loop, words, rays));
  const double items = static_cast<double>(state.iterations()) * count * (one_each ? 1 : bench_steps);
  state.SetItemsProcessed(static_cast<std::int64_t>(items));
  state.counters["each"] = benchmark::Counter(items, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void register_loop(const std::string& name, Loop loop, Grid of) {
  std::vector<std::string> sets{"build"};
  for (const InstructionSet& set : available_instruction_sets()) sets.insert(sets.begin() + 1, std::string(set.name));
  for (const std::string& set : sets) {
    const std::string title = name + "/" + (set == "build" ? "scalar build" : "lanes " + set);
    benchmark::RegisterBenchmark(title.c_str(), [=](benchmark::State& state) {
      time_loop(state, loop, of, set);
    })->MinTime(0.1);
  }
}

}  // namespace
}  // namespace brume

int main(int argc, char** argv) {
  using namespace brume;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  using std::pair;
  for (const auto& [loop_name, loop] :
       {pair{"nearest", Loop::nearest}, pair{"linear", Loop::linear}, pair{"march linear", Loop::march}})
    for (const auto& [size_name, edge] : {pair{"small", 16}, pair{"large", 256}})
      for (const auto& [bits_name, storage] :
           {pair{"8 bits", Storage::u8}, pair{"16 bits", Storage::u16}, pair{"32 bits", Storage::f32}})
        register_loop(std::string(loop_name) + "/" + size_name + "/" + bits_name, loop,
                      {edge, storage, loop != Loop::nearest});
  register_loop("dda step", Loop::dda, {16, Storage::u16, false});
  benchmark::RunSpecifiedBenchmarks();
}
#endif
