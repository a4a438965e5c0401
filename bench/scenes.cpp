// How fast the text of scenes is read: grids of densities as exporters write them, in bytes of text a second, on one
// thread. Long digits are what a float needs to be told from its neighbours; short ones, with many zeros, are smoke.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>

#include "kernel/scalar.h"
#include "scene/read_scene.h"

namespace brume {
namespace {

constexpr int long_edge = 260, short_edge = 420, mesh_edge = 2000;

// The text of a uniformgrid of edge^3 numbers, 20 a line.
template <class Number>
std::string grid_text(int edge, Number&& append_number) {
  std::string text = fmt::format(
      "WorldBegin\nMakeNamedMedium \"m\" \"string type\" \"uniformgrid\" \"integer nx\" {0} \"integer ny\" {0} "
      "\"integer nz\" {0} \"float density\" [",
      edge);
  const auto count = static_cast<std::uint32_t>(edge * edge * edge);
  for (std::uint32_t i = 0; i < count; ++i) {
    text += i % 20 == 0 ? '\n' : ' ';
    append_number(text, i);
  }
  return text + "\n]\n";
}

void append_long(std::string& text, std::uint32_t i) {
  fmt::format_to(std::back_inserter(text), "{}", 10 * kernel::random_uniform(1, 0, i, 0));
}
void append_short(std::string& text, std::uint32_t i) {
  const float v = kernel::random_uniform(1, 0, i / 64, 0);
  if (v < 0.6f)
    text += '0';
  else
    fmt::format_to(std::back_inserter(text), "{:.4g}", kernel::random_uniform(1, 0, i, 1));
}

// A mesh of mesh_edge^2 points and twice as many triangles.
std::string mesh_text() {
  std::string text = "WorldBegin\nShape \"trianglemesh\" \"point3 P\" [";
  const auto n = static_cast<std::uint32_t>(mesh_edge);
  for (std::uint32_t i = 0; i < n * n; ++i)
    fmt::format_to(std::back_inserter(text), "\n{} {} {:.6f}", i % n, i / n, kernel::random_uniform(1, 0, i, 0));
  text += "\n] \"integer indices\" [";
  for (std::uint32_t i = 0; i + n + 1 < n * n; ++i)
    fmt::format_to(std::back_inserter(text), "\n{} {} {} {} {} {}", i, i + 1, i + n, i + n, i + 1, i + n + 1);
  return text + "\n]\n";
}

void read(benchmark::State& state, std::string (*make_text)()) {
  const std::string text = make_text();
  std::vector<Diagnostic> warnings;
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(read_scene_text(text, "bench.pbrt", "", warnings).media.size());
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
  state.counters["MB"] = static_cast<double>(text.size()) * 1e-6;
}

void read_long_grid(benchmark::State& state) {
  read(state, [] { return grid_text(long_edge, append_long); });
}
void read_short_grid(benchmark::State& state) {
  read(state, [] { return grid_text(short_edge, append_short); });
}
void read_mesh(benchmark::State& state) { read(state, mesh_text); }

BENCHMARK(read_long_grid)->Name("uniformgrid, long numbers")->Unit(benchmark::kMillisecond);
BENCHMARK(read_short_grid)->Name("uniformgrid, short numbers")->Unit(benchmark::kMillisecond);
BENCHMARK(read_mesh)->Name("trianglemesh")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace brume

BENCHMARK_MAIN();
