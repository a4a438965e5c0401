#include "brume/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/file.h"
#include "base/parallel.h"
#include "compile/compile.h"
#include "scene/read_scene.h"
#include "session/contents.h"
#include "session/errors.h"
#include "session/example_scene.h"
#include "session/stopwatch.h"
#include "volume/read_volume.h"

namespace brume {

namespace {

constexpr int max_edge = 65536, max_samples = 1 << 24;
constexpr std::int64_t max_pixels = std::int64_t{1} << 28;

void check_resolution(int width, int height) {
  if (width < 1 || height < 1 || width > max_edge || height > max_edge || std::int64_t{width} * height > max_pixels)
    fail(fmt::format("resolution {}x{} is out of range: each side from 1 to {} pixels, together at most {}", width,
                     height, max_edge, max_pixels));
}

void check_crop_window(const FilmDescription& film) {
  const auto [x0, x1, y0, y1] = film.crop_window;
  if (!(0 <= x0 && x0 < x1 && x1 <= 1 && 0 <= y0 && y0 < y1 && y1 <= 1))
    fail(fmt::format("crop window {},{},{},{}: must be x0,x1,y0,y1 with 0 <= x0 < x1 <= 1 and 0 <= y0 < y1 <= 1", x0,
                     x1, y0, y1));
  if (const PixelBox crop = cropped_pixels(film); crop.width() < 1 || crop.height() < 1)
    fail(fmt::format("crop window {},{},{},{} holds no pixel of the {} x {} pixels", x0, x1, y0, y1, film.width,
                     film.height));
}

// Bounds in pixels as the crop window that has them.
std::array<double, 4> window_of(const std::array<int, 4>& bounds, const FilmDescription& film) {
  const auto [x0, x1, y0, y1] = bounds;
  if (!(0 <= x0 && x0 < x1 && x1 <= film.width && 0 <= y0 && y0 < y1 && y1 <= film.height))
    fail(
        fmt::format("pixel bounds {},{},{},{}: must be x0,x1,y0,y1 with 0 <= x0 < x1 <= {} and 0 <= y0 < y1 <= {}, the "
                    "size of the picture",
                    x0, x1, y0, y1, film.width, film.height));
  const double width = film.width, height = film.height;
  return {x0 / width, x1 / width, y0 / height, y1 / height};
}

void check_integrator(const std::string& name) {
  if (std::find(std::begin(integrator_names), std::end(integrator_names), name) != std::end(integrator_names)) return;
  const std::string_view nearest = nearest_name(name, integrator_names);
  fail(fmt::format("unknown integrator \"{}\"{}; valid are {}", name,
                   nearest.empty() ? "" : fmt::format(", did you mean \"{}\"?", nearest),
                   fmt::join(integrator_names, ", ")));
}

void check_is_scene(const std::string& path) {
  if (is_scene_file(path)) return;
  if (is_volume_file(path)) throw InputError(path, "a volume is rendered on its own, or named by a scene");
  const std::string s = suffix(path);
  throw InputError(path,
                   fmt::format("{}; scenes are .pbrt or .pbrt.gz files, volumes {}",
                               s.empty() ? "no suffix" : fmt::format("unknown suffix \"{}\"", s), volume_suffixes));
}

// A scene as text or in another folder must find its volumes and pictures from anywhere.
SceneDescription with_absolute_names(SceneDescription scene) {
  const auto make_absolute = [](GivenName& name) {
    if (!name.empty()) name.text = std::filesystem::absolute(name.text).lexically_normal().string();
  };
  const auto of_shapes = [&](std::vector<ShapeDescription>& shapes) {
    for (ShapeDescription& shape : shapes) {
      make_absolute(shape.relief.normal_map);
      if (shape.light) make_absolute(shape.light->filename);
    }
  };
  for (MediumDescription& medium : scene.media)
    if (auto* file = std::get_if<FileMedium>(&medium.kind)) make_absolute(file->filename);
  for (LightDescription& light : scene.lights)
    if (auto* infinite = std::get_if<InfiniteLight>(&light.kind)) make_absolute(infinite->filename);
  for (TextureDescription& texture : scene.textures)
    if (auto* image = std::get_if<ImageTexture>(&texture.kind)) make_absolute(image->filename);
  of_shapes(scene.shapes);
  for (ObjectDescription& object : scene.objects) of_shapes(object.shapes);
  return scene;
}

SceneDescription read_description(const std::vector<std::string>& paths, std::vector<std::string>& warnings,
                                  bool strict) {
  std::vector<Diagnostic> found;
  const auto file_errors = [](const SceneDescription& scene) { return brume::file_errors(scene, thread_count(0)); };
  SceneDescription scene = read_scene_files(paths, found, strict, file_errors);
  for (const Diagnostic& warning : found) warnings.push_back(to_string(warning));
  return scene;
}

}  // namespace

Scene::Scene(std::unique_ptr<Contents> contents) : contents_(std::move(contents)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Scene Scene::load(const std::string& path, std::vector<std::string>& warnings) { return load_files({path}, warnings); }

Scene Scene::load_files(const std::vector<std::string>& paths, std::vector<std::string>& warnings, bool strict) {
  return with_public_errors([&] {
    const Stopwatch watch;
    if (paths.size() == 1 && is_volume_file(paths[0])) return frame_volume(paths[0]);
    for (const std::string& path : paths) check_is_scene(path);
    SceneDescription description = read_description(paths, warnings, strict);
    return Scene(std::make_unique<Contents>(Contents{std::move(description), {}, {}, watch.seconds()}));
  });
}

Scene Scene::frame_volume(const std::string& path, const std::string& grid, bool sanitize) {
  return with_public_errors([&] {
    const Stopwatch watch;
    if (!is_volume_file(path))
      throw InputError(path, fmt::format("not a volume file, whose suffix would be {}; a scene says of each medium "
                                         "which grid it is, and whether to sanitize it",
                                         volume_suffixes));
    FramedVolume framed = brume::frame_volume(path, grid, sanitize);
    return Scene(std::make_unique<Contents>(
        Contents{std::move(framed.scene), framed.framing, std::move(framed.note), watch.seconds()}));
  });
}

Scene Scene::example() { return Scene(std::make_unique<Contents>(Contents{example_scene(), {}, {}, 0})); }

void Scene::apply(const SceneOptions& options) {
  SceneDescription& scene = contents_->description;
  FilmDescription film = scene.film;
  const auto draft = [&](int number) { return options.quick ? std::max(1, number / 4) : number; };
  film.width = options.width.value_or(draft(film.width));
  film.height = options.height.value_or(draft(film.height));
  if (options.pixel_bounds) film.crop_window = window_of(*options.pixel_bounds, film);
  film.crop_window = options.crop_window.value_or(film.crop_window);
  if (options.width || options.height) check_resolution(film.width, film.height);
  check_crop_window(film);
  const int samples = options.samples_per_pixel.value_or(draft(scene.sampler.pixel_samples));
  if (options.samples_per_pixel && (samples < 1 || samples > max_samples))
    fail(fmt::format("{} samples per pixel are out of range: from 1 to {}", samples, max_samples));
  if (options.integrator) check_integrator(*options.integrator);

  scene.film = std::move(film);
  scene.sampler.pixel_samples = samples;
  if (options.seed) scene.sampler.seed = *options.seed;
  if (options.integrator) {
    scene.integrator.name = *options.integrator;
    scene.integrator.location = {};
  }
  if (contents_->framing) scene.camera.fov = fov_for(*contents_->framing, scene.film.width, scene.film.height);
}

std::string Scene::text() const {
  return with_public_errors([&] { return write_scene(with_absolute_names(contents_->description)); });
}

void Scene::write(const std::string& path) const {
  with_public_errors([&] { write_file_atomically(path, write_scene(with_absolute_names(contents_->description))); });
}

std::vector<std::string> Scene::input_files() const { return contents_->description.files; }

std::string Scene::output_filename() const { return contents_->description.film.filename; }

std::string Scene::framing_note() const { return contents_->framing_note; }

}  // namespace brume
