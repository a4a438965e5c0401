#include "make_command.h"

#include <cstdio>

#include "brume/brume.h"
#include "command_line.h"

namespace {

const char* const help_text =
    R"(Usage: brume make KIND -o FILE.vdb [options]     make a procedural volume

  -o, --output FILE   an OpenVDB file, with a grid "density" from 0 to 1 and, for fire,
                      "temperature" in kelvin; +y is up
  --size N            voxels along the longest side, 8 to 2048; default 128
  --seed N            another of the kind; default 0
  --set NAME=VALUE    a parameter of the kind; may be repeated
  --half              16-bit floats: half the size
  --nthreads N        default 0: one per core; the file is the same for any number
  --quiet             errors only
)";

const char* const example_text = R"(
  brume make smoke --size 256 --set turbulence=0.8 -o smoke.vdb && brume smoke.vdb)";

struct Arguments {
  brume::VolumeRecipe recipe;
  std::string output;
  bool quiet = false, help = false;
};

Arguments parse_arguments(const std::vector<std::string>& given) {
  Arguments a;
  std::string size, seed, threads;
  std::vector<std::string> settings;
  CommandLine line;
  line.option("KIND", a.recipe.kind);
  line.option("-o,--output", a.output);
  line.option("--size", size);
  line.option("--seed", seed);
  line.options("--set", settings);
  line.option("--nthreads", threads);
  line.flag("--half", a.recipe.half);
  line.flag("--quiet", a.quiet);
  line.flag("-h,--help", a.help);
  line.parse(given);
  if (a.help) return a;
  if (a.recipe.kind.empty()) throw UsageError("brume make needs the kind of volume; brume make --help lists them");
  if (a.output.empty()) throw UsageError("brume make needs a file to write, as in -o " + a.recipe.kind + ".vdb");
  if (!size.empty()) a.recipe.size = static_cast<int>(parse_number("--size", size, 8, 2048));
  if (!seed.empty()) a.recipe.seed = static_cast<std::uint32_t>(parse_number("--seed", seed, 0, 0xffffffff));
  if (!threads.empty()) a.recipe.threads = static_cast<int>(parse_number("--nthreads", threads, 0, 4096));
  for (const std::string& setting : settings) {
    const auto [name, value] = parse_setting("--set ", setting);
    a.recipe.parameters[name] = value;
  }
  return a;
}

void show_help() {
  std::puts(help_text);
  for (const brume::VolumeKindInfo& kind : brume::volume_kinds()) {
    std::printf("  %-6s %s\n", kind.name.c_str(), kind.meaning.c_str());
    show_parameters(kind.parameters, "         ");
  }
  std::puts(example_text);
}

}  // namespace

int make_command(const std::vector<std::string>& arguments) {
  const Arguments a = parse_arguments(arguments);
  if (a.help) return show_help(), 0;
  const std::string lines = brume::make_volume(a.recipe, a.output);
  if (!a.quiet) std::fputs(lines.c_str(), stderr);
  return 0;
}
