#include "compile/compile.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>

#include "compile/compiler.h"
#include "compile/rgb_grids.h"

namespace brume {

namespace {

// Exposure; the light that is to be white, made so; the picture's colour space.
FilmResponse film_response(const FilmDescription& film, const CameraDescription& camera) {
  FilmResponse response;
  response.max_component = static_cast<float>(film.max_component);
  const double exposure = (camera.shutter_close - camera.shutter_open) * film.iso / 100;
  if (exposure != 1) response.matrix = exposure * response.matrix;
  if (film.colour_space == ColourSpace::srgb && film.white_balance == 0) return response;
  Matrix3 xyz = xyz_from(ColourSpace::srgb);
  if (film.white_balance > 0)
    xyz = white_adaptation(daylight(film.white_balance), primaries(film.colour_space).white) * xyz;
  response.matrix = exposure * (inverse(xyz_from(film.colour_space)) * xyz);
  return response;
}

}  // namespace

CompiledScene compile(const SceneDescription& scene, int threads, std::vector<Diagnostic>& warnings) {
  if (has_rgb_grids(scene)) return Compiler(with_rgb_grids_as_sums(scene), threads).run(warnings);
  return Compiler(scene, threads).run(warnings);
}

std::vector<Diagnostic> file_errors(const SceneDescription& scene, int threads) {
  return Compiler(scene, threads).file_errors();
}

CompiledScene Compiler::run(std::vector<Diagnostic>& warnings) {
  compiled_.file = scene_.file;
  compiled_.width = scene_.film.width;
  compiled_.height = scene_.film.height;
  compiled_.crop = cropped_pixels(scene_.film);
  compiled_.samples_per_pixel = scene_.sampler.pixel_samples;
  compiled_.seed = scene_.sampler.seed;
  compiled_.sampler =
      scene_.sampler.kind == SamplerDescription::Kind::zsobol ? SamplerKind::zsobol : SamplerKind::independent;
  compiled_.filter = scene_.filter;
  compiled_.film_response = film_response(scene_.film, scene_.camera);
  add_camera();
  add_integrator();
  add_lights();
  add_textures();
  add_shapes();
  add_instances();
  boundaries_to_volumes();
  add_light_choice();
  sort_by_place(errors_);
  sort_by_place(warnings_);
  if (!errors_.empty()) throw InputError(std::move(errors_));
  warnings.insert(warnings.end(), warnings_.begin(), warnings_.end());
  return std::move(compiled_);
}

std::vector<Diagnostic> Compiler::file_errors() {
  std::set<std::string> used = {scene_.camera.medium};
  const auto use = [&](const std::vector<ShapeDescription>& shapes) {
    for (const ShapeDescription& shape : shapes) used.insert({shape.inside, shape.outside});
  };
  use(scene_.shapes);
  for (const ObjectDescription& object : scene_.objects) use(object.shapes);
  for (const MediumDescription& medium : scene_.media) {
    const auto* file = std::get_if<FileMedium>(&medium.kind);
    if (!file || file->filename.empty() || !used.contains(medium.name)) continue;
    density_grid(medium);
    if (file->temperature_asked_for) temperature_grid(medium);
  }
  for (const TextureDescription& texture : scene_.textures)
    if (const auto* image = std::get_if<ImageTexture>(&texture.kind); image && !image->filename.empty())
      image_index(*image, texture.is_float, fmt::format("Texture \"{}\"", texture.name));
  for (const LightDescription& light : scene_.lights)
    if (const auto* infinite = std::get_if<InfiniteLight>(&light.kind); infinite && !infinite->filename.empty()) {
      CompiledEnvironment unused;
      read_environment(infinite->filename, unused);
    }
  const auto of_shapes = [&](const std::vector<ShapeDescription>& shapes) {
    for (const ShapeDescription& shape : shapes) {
      if (!shape.relief.normal_map.empty()) normal_map(shape.relief);
      if (shape.light) light_image(*shape.light);
    }
  };
  of_shapes(scene_.shapes);
  for (const ObjectDescription& object : scene_.objects) of_shapes(object.shapes);
  return std::move(errors_);
}

// pbrt's perspective camera: fov across the shorter side of the picture, whose screen window is then +-1, and +-aspect
// along the longer.
void Compiler::add_camera() {
  const CameraDescription& camera = scene_.camera;
  compiled_.camera_medium = medium_index(camera.medium, camera.location);
  const double width = scene_.film.width, height = scene_.film.height;
  CompiledCamera& c = compiled_.camera;
  c.world_from_camera = camera.world_from_camera;
  const Vector3 eye = camera.world_from_camera.point({});
  check_range({eye, eye}, "the camera", camera.location);
  c.sphere_map = camera.sphere_map;
  c.dx = 1 / width;
  c.dy = 1 / height;
  if (c.sphere_map) return;
  std::array<double, 4> window = camera.screen_window;
  if (window == std::array<double, 4>{}) {
    const double x = std::max(1.0, width / height), y = std::max(1.0, height / width);
    window = {-x, x, -y, y};
  }
  const double scale = std::tan(camera.fov * std::numbers::pi / 360);
  c.x0 = scale * window[0];
  c.dx = scale * (window[1] - window[0]) / width;
  c.y0 = scale * window[3];
  c.dy = -scale * (window[3] - window[2]) / height;
  c.lens_radius = camera.lens_radius;
  c.focal_distance = camera.focal_distance;
}

void Compiler::add_integrator() {
  const IntegratorDescription& from = scene_.integrator;
  CompiledIntegrator& to = compiled_.integrator;
  to.kind = from.name == "classic"     ? CompiledIntegrator::Kind::classic
            : from.name == "reference" ? CompiledIntegrator::Kind::reference
                                       : CompiledIntegrator::Kind::volpath;
  to.max_depth = from.max_depth;
  to.dda = from.traversal == Traversal::dda;
  to.step = from.step;
  to.cached_shadows = from.name == "classic" && from.volume_shadows == VolumeShadows::cached;
  to.shadow_samples = from.shadow_samples;
  const auto place = [&](float base, float spread) {
    to.placement_base = base;
    to.placement_spread = spread;
  };
  switch (from.placement) {
    case Placement::start:
      return place(0, 0);
    case Placement::random:
      return place(0, 1);
    case Placement::middle:
      return place(0.5f, 0);
    case Placement::middle_random:
      return place(0.25f, 0.5f);
  }
}

void Compiler::error(const Location& location, const std::string& message) {
  errors_.push_back({Severity::error, location, message, {}});
}

}  // namespace brume
