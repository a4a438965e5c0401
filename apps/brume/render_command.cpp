#include "render_command.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>

#include "brume/brume.h"
#include "command_line.h"
#include "interrupt.h"
#include "progress_line.h"

namespace {

constexpr int exit_interrupted = 130;  // what shells give for a program that SIGINT ended

const char* const help_text =
    R"(Usage: brume [render] SCENE|VOLUME [options]   a .pbrt, .vdb, .nvdb or .vol file
       brume [render] --example [options]      the built-in example, a cloud

  -o, --output FILE      the picture: .png, .exr or .pfm; may be repeated.
                         Default: as the scene says; for a volume, VOLUME.png
  --spp N                samples per pixel
  --time SECONDS         as many samples as fit in this time, at most --spp
  --seed N               the same seed gives the same picture
  --nthreads N           default 0: one per core
  --resolution WxH       in pixels
  --cropwindow X0,X1,Y0,Y1   a part of it: fractions, Y from the top
  --pixelbounds X0,X1,Y0,Y1  the same in pixels, without X1 and Y1 themselves
  --quick                a draft: a quarter of the width, height and samples,
                         but for what --resolution and --spp say
  --exposure STOPS       .png files brighter, or below 0 darker, by powers of 2
  --integrator NAME      instead of the scene's
  --grid NAME            of a volume; default "density", or the only one
  --sanitize             of a volume: values that are no density are 0
  --write-scene FILE     save the scene as .pbrt; without -o do no more
  --write-partial-images write the picture so far every few seconds
  --variance             each pixel's variance too (.exr), for brume compare
  --stats                when it is done, a table of what it took and did
  --stats-json FILE      the same as a file for programs
  --strict               refuse old spellings in scenes
  --quiet                errors only
  --version, --help      BRUME_ISA=avx512|avx2|sse4|scalar in the environment
                         chooses the instruction set that --version shows

A scene may be packed (.pbrt.gz) or come from the standard input (-); several
files are one. A volume is framed and lit. Ctrl-C saves what is rendered.

  brume smoke.vdb -o smoke.png -o smoke.exr
  brume scene.pbrt --spp 64 --resolution 1280x720)";

struct Arguments {
  std::string grid, write_scene, stats_json;
  std::vector<std::string> files, outputs;
  int threads = 0;
  double seconds = 0;  // 0: no limit
  double exposure = 0;
  bool sanitize = false, example = false, strict = false, partial_images = false, variance = false, stats = false,
       quiet = false, help = false, version = false;
  brume::SceneOptions changes;
};

void parse_resolution(const std::string& text, brume::SceneOptions& changes) {
  const std::size_t x = text.find_first_of("xX");
  if (x == std::string::npos) throw UsageError("--resolution: \"" + text + "\" is not WIDTHxHEIGHT, as in 1280x720");
  changes.width = static_cast<int>(parse_number("--resolution: width", text.substr(0, x), 1, 65536));
  changes.height = static_cast<int>(parse_number("--resolution: height", text.substr(x + 1), 1, 65536));
}

// "0,0.5,0,1"; which numbers make a window is for the scene to say.
template <class Number>
std::array<Number, 4> parse_window(const std::string& option, const std::string& text, const char* example) {
  std::array<Number, 4> window{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < window.size(); ++i) {
    const auto [next, error] = std::from_chars(at, end, window[i]);
    const bool last = i + 1 == window.size();
    if (error != std::errc() || (last ? next != end : next == end || *next != ','))
      throw UsageError(option + ": \"" + text + "\" is not X0,X1,Y0,Y1, as in " + example);
    at = next + 1;
  }
  return window;
}

Arguments parse_arguments(const std::vector<std::string>& given) {
  Arguments a;
  std::string samples, seconds, seed, threads, resolution, crop_window, pixel_bounds, exposure;
  CommandLine line;
  line.options("SCENE", a.files);
  line.options("-o,--output", a.outputs);
  line.option("--spp", samples);
  line.option("--time", seconds);
  line.option("--seed", seed);
  line.option("--nthreads", threads);
  line.option("--resolution", resolution);
  line.option("--cropwindow", crop_window);
  line.option("--pixelbounds", pixel_bounds);
  line.flag("--quick", a.changes.quick);
  line.option("--exposure", exposure);
  line.option("--integrator", a.changes.integrator);
  line.option("--grid", a.grid);
  line.flag("--sanitize", a.sanitize);
  line.option("--write-scene", a.write_scene);
  line.flag("--example", a.example);
  line.flag("--strict", a.strict);
  line.flag("--write-partial-images", a.partial_images);
  line.flag("--variance", a.variance);
  line.flag("--stats", a.stats);
  line.option("--stats-json", a.stats_json);
  line.flag("--quiet", a.quiet);
  line.flag("--version", a.version);
  line.flag("-h,--help", a.help);
  line.parse(given);
  if (a.help || a.version) return a;

  if (!samples.empty()) a.changes.samples_per_pixel = static_cast<int>(parse_number("--spp", samples, 1, 1 << 24));
  if (!seconds.empty()) a.seconds = parse_seconds("--time", seconds);
  if (!seed.empty()) a.changes.seed = static_cast<std::uint32_t>(parse_number("--seed", seed, 0, 0xffffffff));
  if (!threads.empty()) a.threads = static_cast<int>(parse_number("--nthreads", threads, 0, 4096));
  if (!resolution.empty()) parse_resolution(resolution, a.changes);
  if (!crop_window.empty())
    a.changes.crop_window = parse_window<double>("--cropwindow", crop_window, "0,0.5,0,1 for the left half");
  if (!pixel_bounds.empty())
    a.changes.pixel_bounds = parse_window<int>("--pixelbounds", pixel_bounds, "0,64,0,64 for the first 64 x 64 pixels");
  if (!crop_window.empty() && !pixel_bounds.empty())
    throw UsageError("--cropwindow and --pixelbounds: only one can be given");
  if (!exposure.empty()) a.exposure = parse_real("--exposure", exposure, -100, 100);
  if (a.files.empty() && !a.example)
    throw UsageError("a scene or a volume to render is missing; brume --help shows how");
  if (!a.files.empty() && a.example) throw UsageError("--example takes no scene or volume");
  if ((!a.grid.empty() || a.sanitize) && a.files.size() != 1)
    throw UsageError("--grid and --sanitize are for one volume file");
  return a;
}

void say(const Arguments& a, const std::string& line) {
  if (!a.quiet) std::fprintf(stderr, "%s\n", line.c_str());
}

brume::Scene load(const Arguments& a) {
  if (a.example) return brume::Scene::example();
  if (!a.grid.empty() || a.sanitize) return brume::Scene::frame_volume(a.files[0], a.grid, a.sanitize);
  std::vector<std::string> warnings;
  brume::Scene scene = brume::Scene::load_files(a.files, warnings, a.strict);
  for (const std::string& warning : warnings) say(a, warning);
  return scene;
}

bool any_ends_in(const std::vector<std::string>& paths, const char* suffix) {
  return std::any_of(paths.begin(), paths.end(), [&](std::string path) {
    std::transform(path.begin(), path.end(), path.begin(), [](unsigned char c) { return std::tolower(c); });
    return path.ends_with(suffix);
  });
}

// Whether two paths lead to one file, which need not be there yet.
bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  const auto whole = [&](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  return whole(a) == whole(b);
}

// What is written replaces what was there: nothing may be lost so that was read, or was written just before.
void check_no_file_is_lost(const Arguments& a, std::vector<std::string> outputs, std::vector<std::string> inputs) {
  std::replace(inputs.begin(), inputs.end(), std::string("-"), std::string("/dev/stdin"));  // which may be a file
  for (const std::string& output : {a.write_scene, a.stats_json})
    if (!output.empty()) outputs.push_back(output);
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    const auto is_output = [&](const std::string& other) { return same_file(*output, other); };
    if (std::any_of(inputs.begin(), inputs.end(), is_output))
      throw UsageError(*output + " is read, so it cannot be an output; name another file");
    if (std::any_of(outputs.begin(), output, is_output))
      throw UsageError(*output + " is given for two outputs; each needs a file of its own");
  }
}

void check_outputs(const Arguments& a, const std::vector<std::string>& outputs,
                   const std::vector<std::string>& inputs) {
  if (!a.write_scene.empty() && !any_ends_in({a.write_scene}, ".pbrt"))
    throw UsageError("--write-scene: " + a.write_scene + " is not a .pbrt file");
  check_no_file_is_lost(a, outputs, inputs);
  for (const std::string& output : outputs) brume::Picture::check_output(output);
  if (!a.stats_json.empty()) brume::Statistics::check_output(a.stats_json);
  if (a.exposure != 0 && !outputs.empty() && !any_ends_in(outputs, ".png"))
    throw UsageError("--exposure needs a .png file among the outputs, as in -o picture.png");
  if (a.variance && !outputs.empty() && !any_ends_in(outputs, ".exr"))
    throw UsageError("--variance needs an .exr file among the outputs, as in -o picture.exr");
}

// The picture, or nothing where the render was stopped before it began.
std::optional<brume::Picture> render(const Arguments& a, const brume::Scene& scene,
                                     const std::vector<std::string>& outputs) {
  double reached = 0;
  ProgressLine line(a.quiet);
  const auto warn = [&](const std::string& warning) {
    line.clear();
    say(a, warning);
  };
  brume::RenderOptions options;
  options.threads = a.threads;
  options.variance = a.variance;
  options.seconds = a.seconds;
  options.max_samples = a.changes.samples_per_pixel.value_or(options.max_samples);
  options.on_warning = warn;
  options.on_progress = [&, watching = false](const brume::Progress& progress) mutable {
    // Until here there is nothing to save: Ctrl-C does what it does by default.
    if (!std::exchange(watching, true)) watch_for_interrupt();
    reached = progress.fraction;
    line.show(progress);
    return !interrupted();
  };
  bool can_write = true;
  if (a.partial_images)
    options.on_partial_picture = [&](const brume::Picture& picture) {
      // What cannot be written now may be at the end: no reason to give up a long render.
      try {
        for (const std::string& output : outputs) picture.write(output, a.exposure);
      } catch (const brume::Error& e) {
        if (can_write) warn(e.what());
        can_write = false;
      }
    };
  brume::Picture picture = brume::render(scene, options);
  if (picture.partial && reached == 0) return std::nullopt;
  return picture;
}

// Writes every output that can be written: where one disk is full, the picture is not lost on the others.
int save(const Arguments& a, const brume::Picture& picture, const std::vector<std::string>& outputs) {
  bool all_written = true;
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const brume::Error& e) {
      std::fprintf(stderr, "%s\n", e.what());
      all_written = false;
    }
  };
  for (const std::string& output : outputs)
    attempt([&] {
      picture.write(output, a.exposure);
      say(a, output + ": " + std::to_string(picture.width) + " x " + std::to_string(picture.height) + " pixels, " +
                 std::to_string(picture.samples_per_pixel) + " samples per pixel" +
                 (picture.partial ? " at least; partial" : "") + ", " + clock_text(picture.seconds));
    });
  if (a.stats) std::fputs(picture.statistics.table().c_str(), stderr);
  if (!a.stats_json.empty()) attempt([&] { picture.statistics.write(a.stats_json); });
  if (!all_written) return 1;
  return picture.partial ? exit_interrupted : 0;
}

}  // namespace

int render_command(const std::vector<std::string>& arguments) {
  const Arguments a = parse_arguments(arguments);
  if (a.help) return std::puts(help_text), 0;
  if (a.version) return std::puts(brume::version_text().c_str()), 0;

  check_outputs(a, a.outputs, a.files);
  brume::Scene scene = load(a);
  scene.apply(a.changes);
  const bool is_rendered = a.write_scene.empty() || !a.outputs.empty();
  std::vector<std::string> outputs = a.outputs, inputs = scene.input_files();
  if (is_rendered && outputs.empty()) outputs = {scene.output_filename()};
  inputs.insert(inputs.end(), a.files.begin(), a.files.end());
  check_outputs(a, outputs, inputs);
  if (!scene.framing_note().empty()) say(a, scene.framing_note());
  if (!a.write_scene.empty()) {
    scene.write(a.write_scene);
    say(a, a.write_scene + ": scene written");
  }
  if (!is_rendered) return 0;
  const std::optional<brume::Picture> picture = render(a, scene, outputs);
  if (interrupted()) say(a, picture ? "interrupted: saving what is rendered" : "interrupted: nothing was rendered yet");
  return picture ? save(a, *picture, outputs) : exit_interrupted;
}
