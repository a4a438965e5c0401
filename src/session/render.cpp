#include "brume/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "base/parallel.h"
#include "compile/compile.h"
#include "image/film.h"
#include "render/backend.h"
#include "session/contents.h"
#include "session/errors.h"
#include "session/instruction_set_choice.h"
#include "session/picture.h"
#include "session/version.h"

namespace brume {

namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

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
  const std::string& name = description.integrator.name;
  if (name != "classic" && name != "reference")
    warnings.add(
        fmt::format("warning: integrator \"{}\" is not built yet; rendering with \"reference\", a path tracer that "
                    "takes longer for the same picture",
                    name));
  std::vector<Diagnostic> found;
  CompiledScene compiled = compile(description, threads, found);
  for (const Diagnostic& warning : found) warnings.add(to_string(warning));
  return compiled;
}

// Renders all samples in passes of 1, 1, 2, 4, 8, 8, ...: a picture that is stopped early has had nearly the same
// number in every pixel, and longer passes would only make stopping slower. False where on_progress said to stop.
bool render_samples(Backend& backend, int samples, const RenderOptions& options, Film& film) {
  const Stopwatch watch;
  const auto report = [&](double fraction) {
    if (!options.on_progress) return true;
    Progress progress{fraction, watch.seconds(), -1};
    // Before half a second has passed an extrapolation would say little.
    if (fraction > 0 && progress.elapsed_seconds > 0.5)
      progress.remaining_seconds = progress.elapsed_seconds * (1 - fraction) / fraction;
    return options.on_progress(progress);
  };
  if (!report(0)) return false;
  for (int first = 0; first < samples;) {
    const int pass = std::min({std::max(first, 1), 8, samples - first});
    const auto keep_going = [&](double fraction) { return report((first + fraction * pass) / samples); };
    if (!backend.render(first, first + pass, thread_count(options.threads), film, keep_going)) return false;
    first += pass;
  }
  report(1);
  return true;
}

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
  metadata.ndc_from_world = ndc_from_world(scene, metadata.camera_from_world);
  metadata.seed = scene.seed;
  metadata.partial = picture.partial;
  // Rounding to halves would be noise that the variance does not tell of.
  metadata.half = description.film.save_fp16 && picture.variance.empty();
  metadata.software = software_name();
  return metadata;
}

Picture render_description(const SceneDescription& description, const RenderOptions& options) {
  const Stopwatch watch;
  Warnings warnings(options);
  apply_instruction_set_choice();
  if (options.variance && description.sampler.pixel_samples < 2)
    throw Error("the variance can be estimated from two samples per pixel on, not from one");
  const CompiledScene scene = compile_scene(description, thread_count(options.threads), warnings);
  const std::unique_ptr<Backend> backend = make_cpu_backend();
  backend->prepare(scene);
  Film film(scene.width, scene.height);

  Picture picture;
  picture.partial = !render_samples(*backend, scene.samples_per_pixel, options, film);
  Image image = film.image();
  picture.width = image.width;
  picture.height = image.height;
  picture.pixels = std::move(image.pixels);
  if (options.variance) picture.variance = film.variance();
  picture.samples_per_pixel = film.samples_per_pixel();
  picture.invalid_samples = film.invalid_samples();
  if (backend->majorant_violations() > 0)
    warnings.add(
        fmt::format("warning: {} densities exceeded the bound that tracking relies on; the picture is biased, and "
                    "this is a fault in Brume",
                    backend->majorant_violations()));
  picture.seconds = watch.seconds();
  if (picture.invalid_samples > 0)
    warnings.add(fmt::format("warning: {} samples were not finite numbers and were left out", picture.invalid_samples));
  picture.metadata =
      std::make_shared<const Picture::Metadata>(Picture::Metadata{make_metadata(scene, description, picture)});
  picture.warnings = warnings.take();
  return picture;
}

}  // namespace

Picture render(const Scene& scene, const RenderOptions& options) {
  return with_public_errors([&] { return render_description(scene.contents().description, options); });
}

}  // namespace brume
