#include "bench_command.h"

#include <cstdio>

#include "brume/brume.h"
#include "command_line.h"

namespace {

const char* const help_text =
    R"(Usage: brume bench [options]     how fast this machine is at what rendering is made of

  --json          one JSON object instead of a table
  --size N        voxels along the sides of a ball of noise, a tenth of it in use, 8 to
                  2048; may be repeated. Default: 256 and 512. The first is measured with
                  every instruction set and storage, the others with the best set and 16
                  bits a voxel. The ball is made with at most 256 voxels and enlarged beyond
  --sparse N      voxels along the sides of a volume of scattered puffs, a tenth of it in
                  use, 8 to 2048; may be repeated. Default: 1024. Where one of --size and
                  --sparse is given, the other has no default
  --time SECONDS  for each line, default 0.5; the best of five rounds is shown
  --nthreads N    to make the volumes with, default 0: one per core. One thread is measured.

  paths         from collision to collision in a volume of optical depth 100, albedo 1 and
                g = 0.85; an event is a step through a cell of majorants or a look-up of
                the density
  tracking      the same events, where nothing but the collisions is searched for
  marching      look-ups with linear interpolation along straight rays
  surface rays  single rays against 130,000 triangles

  brume bench --size 128 --time 0.2)";

struct Arguments {
  brume::BenchOptions options;
  bool json = false, help = false;
};

std::vector<int> parse_sizes(const char* option, const std::vector<std::string>& texts) {
  std::vector<int> sizes;
  for (const std::string& text : texts) sizes.push_back(static_cast<int>(parse_number(option, text, 8, 2048)));
  return sizes;
}

Arguments parse_arguments(const std::vector<std::string>& given) {
  Arguments a;
  std::vector<std::string> sizes, sparse_sizes;
  std::string seconds, threads;
  CommandLine line;
  line.flag("-h,--help", a.help);
  line.flag("--json", a.json);
  line.options("--size", sizes);
  line.options("--sparse", sparse_sizes);
  line.option("--time", seconds);
  line.option("--nthreads", threads);
  line.parse(given);
  if (a.help) return a;
  if (!sizes.empty() || !sparse_sizes.empty()) {
    a.options.sizes = parse_sizes("--size", sizes);
    a.options.sparse_sizes = parse_sizes("--sparse", sparse_sizes);
  }
  if (!seconds.empty()) a.options.seconds = parse_seconds("--time", seconds);
  if (!threads.empty()) a.options.threads = static_cast<int>(parse_number("--nthreads", threads, 0, 4096));
  return a;
}

const char* or_dash(const std::string& text) { return text.empty() ? "-" : text.c_str(); }

void show_table(const brume::BenchOptions& options) {
  std::printf("%s, one thread\n\n", brume::bench_machine().c_str());
  std::puts("| measured | volume | storage | instruction set | millions a second |");
  std::puts("|---|---|---|---|---|");
  brume::bench(options, [](const brume::BenchResult& r) {
    std::printf("| %s, %s | %s | %s | %s | %.1f |\n", r.measured.c_str(), r.unit.c_str(), or_dash(r.grid),
                or_dash(r.storage), or_dash(r.instruction_set), 1e-6 * r.per_second);
    std::fflush(stdout);
  });
}

// The strings have no characters that JSON would want escaped.
void show_json(const brume::BenchOptions& options) {
  std::printf("{\"machine\": \"%s\", \"results\": [", brume::bench_machine().c_str());
  bool first = true;
  brume::bench(options, [&](const brume::BenchResult& r) {
    std::printf(
        "%s\n  {\"measured\": \"%s\", \"unit\": \"%s\", \"volume\": \"%s\", \"storage\": \"%s\", "
        "\"instruction_set\": \"%s\", \"per_second\": %.6g}",
        first ? "" : ",", r.measured.c_str(), r.unit.c_str(), r.grid.c_str(), r.storage.c_str(),
        r.instruction_set.c_str(), r.per_second);
    first = false;
  });
  std::puts("\n]}");
}

}  // namespace

int bench_command(const std::vector<std::string>& arguments) {
  const Arguments a = parse_arguments(arguments);
  if (a.help)
    std::puts(help_text);
  else if (a.json)
    show_json(a.options);
  else
    show_table(a.options);
  return 0;
}
