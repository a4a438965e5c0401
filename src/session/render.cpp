#include "brume/render.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/memory.h"
#include "base/parallel.h"
#include "compile/compile.h"
#include "image/film.h"
#include "lanes/instruction_set.h"
#include "render/backend.h"
#include "scene/read_scene.h"
#include "session/contents.h"
#include "session/errors.h"
#include "session/instruction_set_choice.h"
#include "session/picture.h"
#include "session/stopwatch.h"
#include "session/version.h"

namespace brume {

namespace {

// Passes on warnings as they come and keeps them for the picture.
class Warnings {
 public:
  explicit Warnings(const RenderOptions& options) : options_(options) {}
  void add(const std::string& text) {
    if (options_.on_warning) options_.on_warning(text);
    all_.push_back(text);
  }
  std::vector<std::string> take() { return std::move(all_); }

 private:
  const RenderOptions& options_;
  std::vector<std::string> all_;
};

CompiledScene compile_scene(const SceneDescription& description, int threads, Warnings& warnings) {
  std::vector<Diagnostic> found;
  const std::string& name = description.integrator.name;
  const Location& location = description.integrator.location;
  if (name != "classic" && name != "reference" && name != "volpath")
    found.push_back({Severity::warning,
                     location.line > 0 ? location : Location{description.file},
                     fmt::format("there is no integrator \"{}\" here; rendering with \"volpath\"", name),
                     {}});
  try {
    CompiledScene compiled = compile(description, threads, found);
    add_source_lines(found);
    for (const Diagnostic& warning : found) warnings.add(to_string(warning));
    return compiled;
  } catch (const InputError& e) {
    std::vector<Diagnostic> errors = e.diagnostics();
    add_source_lines(errors);
    throw InputError(std::move(errors));
  }
}

void check_film(const SceneDescription& description) {
  const PixelBox crop = cropped_pixels(description.film);
  const std::int64_t bytes = Film::bytes(crop.width(), crop.height());
  if (!can_hold(bytes))
    throw InputError(description.file,
                     fmt::format("rendering {} x {} pixels takes {} bytes, more than half of this machine's memory",
                                 crop.width(), crop.height(), bytes));
}

constexpr double partial_picture_interval = 3;  // seconds

// Adds samples to a film, pass by pass, until there are enough or the time is used.
class Passes {
 public:
  // A film of `pixels` pixels.
  Passes(const RenderOptions& options, const Stopwatch& since_call, int samples, double pixels)
      : options_(options), since_call_(since_call), samples_(samples), pixels_(pixels) {}

  // Passes of 1, 1, 2, 4, 8, 8, ... samples: a picture that is stopped early has had nearly the same number in every
  // pixel, and longer passes would only make stopping slower. Calls after_pass() between them. False where on_progress
  // said to stop.
  template <class AfterPass>
  bool render(Backend& backend, Film& film, AfterPass&& after_pass) {
    if (!report(0)) return false;
    for (int done = 0; done < samples_;) {
      const int pass = next_pass(done);
      if (pass == 0) break;
      const auto keep_going = [&](double fraction) { return report(done + fraction * pass); };
      if (!backend.render(done, done + pass, thread_count(options_.threads), film, keep_going)) return false;
      done += pass;
      if (done < samples_) after_pass();
    }
    report(samples_);
    return true;
  }

 private:
  // How many samples to add to the `done` ones; 0 where not one more fits in the time.
  int next_pass(int done) const {
    int pass = std::min({std::max(done, 1), 8, samples_ - done});
    if (done == 0) return pass;
    const double seconds_per_sample = std::max(since_first_.seconds() / done, 1e-9);
    const auto limit = [&](double seconds) {
      pass = static_cast<int>(std::min<double>(pass, seconds / seconds_per_sample));
    };
    if (options_.on_partial_picture) limit(std::max(partial_picture_interval, seconds_per_sample));
    if (options_.seconds > 0) limit(std::max(0.0, options_.seconds - since_call_.seconds()));
    return pass;
  }

  bool report(double samples_done) const {
    if (!options_.on_progress) return true;
    Progress progress{samples_done / samples_, since_first_.seconds(), -1, 0};
    progress.samples_per_second = samples_done * pixels_ / std::max(progress.elapsed_seconds, 1e-9);
    // Before half a second has passed an extrapolation would say little.
    if (samples_done > 0 && progress.elapsed_seconds > 0.5)
      progress.remaining_seconds = progress.elapsed_seconds * (1 - progress.fraction) / progress.fraction;
    if (options_.seconds > 0 && samples_done > 0) {
      const double used = std::min(1.0, since_call_.seconds() / options_.seconds), left = (1 - used) * options_.seconds;
      if (progress.remaining_seconds < 0 || left < progress.remaining_seconds) progress.remaining_seconds = left;
      progress.fraction = std::max(progress.fraction, used);
    }
    return options_.on_progress(progress);
  }

  const RenderOptions& options_;
  const Stopwatch& since_call_;
  const Stopwatch since_first_;
  int samples_;
  double pixels_;
};

// Camera space to [0, 1] across the picture: the inverse of what CompiledCamera says of its rays. The third row makes
// the matrix invertible; its result has no meaning.
std::array<std::array<double, 4>, 4> ndc_from_world(const CompiledScene& scene, const Transform& camera_from_world) {
  const CompiledCamera& c = scene.camera;
  const double sx = 1 / (c.dx * scene.width), sy = 1 / (c.dy * scene.height);
  const double ndc_from_camera[4][4] = {{sx, 0, -c.x0 * sx, 0}, {0, sy, -c.y0 * sy, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}};
  std::array<std::array<double, 4>, 4> m{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) m[i][j] += ndc_from_camera[i][k] * camera_from_world.m[k][j];
  return m;
}

ImageMetadata make_metadata(const CompiledScene& scene, const SceneDescription& description, const Picture& picture) {
  ImageMetadata metadata;
  metadata.samples_per_pixel = picture.samples_per_pixel;
  metadata.render_time_seconds = picture.seconds;
  metadata.camera_from_world = inverse(scene.camera.world_from_camera);
  if (!scene.camera.sphere_map) metadata.ndc_from_world = ndc_from_world(scene, metadata.camera_from_world);
  metadata.seed = scene.seed;
  metadata.colour_space = description.film.colour_space;
  if (picture.width != scene.width || picture.height != scene.height) {
    metadata.x = scene.crop.x0;
    metadata.y = scene.crop.y0;
    metadata.whole_width = scene.width;
    metadata.whole_height = scene.height;
  }
  metadata.partial = picture.partial;
  // Rounding to halves would be noise that the variance does not tell of.
  metadata.half = description.film.save_fp16 && picture.variance.empty();
  metadata.software = software_name();
  return metadata;
}

std::int64_t volume_bytes(const CompiledScene& scene) {
  std::size_t words = 0;
  for (const CompiledGrid& grid : scene.grids) words += grid.table.size() + grid.words.size() + grid.majorants.size();
  return static_cast<std::int64_t>(words * sizeof(std::uint32_t));
}

// But for the times.
Statistics make_statistics(const CompiledScene& scene, const Film& film, const RenderCounts& counts) {
  using Kind = CompiledIntegrator::Kind;
  Statistics s;
  s.software = software_name();
  s.instruction_set = current_instruction_set().title;
  s.integrator = scene.integrator.kind == Kind::classic     ? "classic"
                 : scene.integrator.kind == Kind::reference ? "reference"
                                                            : "volpath";
  s.samples = film.samples();
  s.rays = counts.rays;
  s.shadow_rays = counts.shadow_rays;
  s.collisions = counts.collisions;
  s.surface_hits = counts.surface_hits;
  s.majorant_cells = counts.cells;
  s.look_ups = counts.look_ups;
  s.majorant_violations = counts.majorant_violations;
  s.invalid_samples = film.invalid_samples();
  s.volume_bytes = volume_bytes(scene);
  s.peak_bytes = peak_memory();
  return s;
}

Picture make_picture(const Film& film, const CompiledScene& scene, const SceneDescription& description,
                     const RenderOptions& options, double seconds, bool partial) {
  Picture picture;
  Image image = film.image();
  picture.width = image.width;
  picture.height = image.height;
  picture.pixels = std::move(image.pixels);
  picture.alpha = std::move(image.alpha);
  picture.depth = std::move(image.depth);
  if (options.variance) picture.variance = film.variance();
  picture.samples_per_pixel = film.samples_per_pixel();
  picture.partial = partial;
  picture.seconds = seconds;
  picture.invalid_samples = film.invalid_samples();
  picture.metadata =
      std::make_shared<const Picture::Metadata>(Picture::Metadata{make_metadata(scene, description, picture)});
  return picture;
}

Picture render_contents(const Scene::Contents& contents, const RenderOptions& options) {
  const SceneDescription& description = contents.description;
  const Stopwatch watch;
  Warnings warnings(options);
  apply_instruction_set_choice();
  const int samples = options.seconds > 0 ? options.max_samples : description.sampler.pixel_samples;
  if (options.variance && samples < 2)
    fail("the variance can be estimated from two samples per pixel on, not from one");
  check_film(description);
  const CompiledScene scene = compile_scene(description, thread_count(options.threads), warnings);
  const std::unique_ptr<Backend> backend = make_cpu_backend();
  backend->prepare(scene);
  if (const auto place = backend->open_boundary())
    warnings.add(
        fmt::format("{}: warning: near ({:.4g}, {:.4g}, {:.4g}) how much of a medium there is depends on where it is "
                    "seen from; the shapes that bound it are not closed",
                    description.file, place->x, place->y, place->z));
  const double prepared = watch.seconds();
  Film film(scene.crop.width(), scene.crop.height(), scene.film_response);

  const auto picture_now = [&](bool partial) {
    return make_picture(film, scene, description, options, watch.seconds(), partial);
  };
  double shown = -partial_picture_interval;  // when the last partial picture was shown
  const double pixels = static_cast<double>(film.width()) * film.height();
  const bool finished = Passes(options, watch, samples, pixels).render(*backend, film, [&] {
    if (!options.on_partial_picture || watch.seconds() < shown + partial_picture_interval) return;
    options.on_partial_picture(picture_now(true));
    shown = watch.seconds();
  });
  Picture picture = picture_now(!finished);
  Statistics& statistics = picture.statistics;
  statistics = make_statistics(scene, film, backend->counts());
  statistics.threads = thread_count(options.threads);
  statistics.reading_seconds = contents.reading_seconds;
  statistics.preparing_seconds = prepared;
  statistics.rendering_seconds = watch.seconds() - prepared;
  if (statistics.majorant_violations > 0)
    warnings.add(
        fmt::format("warning: {} densities exceeded the bound that tracking relies on; the picture is biased, and "
                    "this is a fault in Brume",
                    statistics.majorant_violations));
  if (picture.invalid_samples > 0)
    warnings.add(fmt::format("warning: {} samples were not finite numbers and were left out", picture.invalid_samples));
  picture.warnings = warnings.take();
  return picture;
}

}  // namespace

Picture render(const Scene& scene, const RenderOptions& options) {
  return with_public_errors([&] { return render_contents(scene.contents(), options); });
}

}  // namespace brume
