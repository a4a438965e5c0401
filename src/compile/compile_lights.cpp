#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/sphere_map.h"
#include "compile/compiler.h"
#include "image/image.h"
#include "intersect/quadric.h"
#include "scene/colour.h"

namespace brume {

namespace {

constexpr double pi = std::numbers::pi;

Vector3 to_double(const std::array<float, 3>& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

// The mean of the channels of a pixel, which decides how often it is chosen.
double brightness(const CompiledEnvironment& e, std::uint32_t x, std::uint32_t y) {
  const float* rgb = e.pixels.data() + 3 * (static_cast<std::size_t>(y) * e.width + x);
  return mean({{rgb[0], rgb[1], rgb[2]}});
}

// Appends the running sums of `weights` as shares of their total, which it returns, after a leading 0. Without any
// weight all shares are equal.
double append_cdf(const std::vector<double>& weights, std::vector<float>& cdf) {
  double total = 0, sum = 0;
  for (const double w : weights) total += w;
  cdf.push_back(0);
  for (std::size_t i = 0; i + 1 < weights.size(); ++i) {
    sum += total > 0 ? weights[i] / total : 1.0 / static_cast<double>(weights.size());
    cdf.push_back(static_cast<float>(std::min(sum, 1.0)));
  }
  cdf.push_back(1);
  return total;
}

// Fills the tables of an environment; returns its mean brightness over all directions.
double add_table(CompiledEnvironment& e) {
  std::vector<double> rows(e.height), pixels(e.width);
  for (std::uint32_t y = 0; y < e.height; ++y) {
    const double share = e.map == SphereMap::equal_area
                             ? 1.0 / e.height
                             : 0.5 * (std::cos(pi * y / e.height) - std::cos(pi * (y + 1) / e.height));
    const double solid_angle = 4 * pi * share / e.width;
    e.pixel_solid_angle.push_back(static_cast<float>(solid_angle));
    for (std::uint32_t x = 0; x < e.width; ++x) pixels[x] = brightness(e, x, y);
    rows[y] = append_cdf(pixels, e.pixel_cdf) * solid_angle;
  }
  return append_cdf(rows, e.row_cdf) / (4 * pi);
}

// The illuminance of a surface that faces +z of the light's space, for a factor of 1: pbrt's sum over pixels' centres.
double illuminance(const CompiledEnvironment& e) {
  double sum = 0;
  for (std::uint32_t y = 0; y < e.height; ++y)
    for (std::uint32_t x = 0; x < e.width; ++x) {
      const SquarePoint centre{(x + 0.5) / e.width, (y + 0.5) / e.height};
      const Vector3 d = map_direction(e.map, centre);
      const float* rgb = e.pixels.data() + 3 * (static_cast<std::size_t>(y) * e.width + x);
      sum += std::max(0.0, d.z) * static_cast<double>(e.pixel_solid_angle[y]) * luminance({{rgb[0], rgb[1], rgb[2]}});
    }
  return sum;
}

// Of all pixels; negative values are taken as 0.
Spectrum mean_colour(const CompiledImage& image) {
  std::array<double, channel_count> sums{};
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    sums[i % channel_count] += static_cast<double>(std::max(0.0f, image.pixels[i]));
  const double count = static_cast<double>(image.width) * image.height;
  Spectrum mean;
  for (std::size_t c = 0; c < sums.size(); ++c) mean.value[c] = static_cast<float>(sums[c] / count);
  return mean;
}

// Turns and mirrors, without stretching: the columns of the map at length 1.
Transform rotation(const Transform& t) {
  Transform r;
  const double size = std::cbrt(std::abs(t.determinant()));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = t.m[i][j] / size;
  return r;
}

// Which share of the directions through a portal the image's table is to draw: none where all pixels are as bright as
// each other, up to half of them the fewer pixels all light comes from.
float image_share(const CompiledEnvironment& e) {
  double sum = 0, squares = 0;
  for (std::uint32_t y = 0; y < e.height; ++y)
    for (std::uint32_t x = 0; x < e.width; ++x) {
      const double v = brightness(e, x, y), weight = static_cast<double>(e.pixel_solid_angle[y]) / (4 * pi);
      sum += weight * v;
      squares += weight * v * v;
    }
  return squares > 0 ? static_cast<float>(std::max(0.0, 0.5 * (1 - sum * sum / squares))) : 0;
}

CompiledPortal compile_portal(const std::array<Vector3, 4>& corners) {
  const Vector3 u = corners[1] - corners[0], v = corners[3] - corners[0];
  CompiledPortal portal;
  portal.corner = corners[0];
  portal.x = normalize(u);
  portal.outwards = normalize(cross(v, u));
  portal.y = cross(portal.x, portal.outwards);
  portal.width = length(u);
  portal.height = dot(v, portal.y);
  return portal;
}

// Whether the map makes lengths in all directions longer alike: its columns are at right angles and of one length.
bool is_similarity(const Transform& t) {
  const Vector3 x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
  const double square = dot(x, x);
  const auto is_small = [&](double v) { return std::abs(v) < 1e-9 * square; };
  return is_small(dot(x, y)) && is_small(dot(y, z)) && is_small(dot(z, x)) && is_small(dot(y, y) - square) &&
         is_small(dot(z, z) - square);
}

// Point i of the n of Gauss' rule of two points in each of n / 2 equal parts of 0 to 1. All have the same weight.
double gauss_point(int i, int n) {
  const int part = i / 2;
  const double offset = (i % 2 - 0.5) / std::numbers::sqrt3;  // from its middle
  return 2 * (part + 0.5 + offset) / n;
}

// The area of a quadric in the world. The affine map enlarges a piece with the unit normal n by |det M| |M^-T n|, which
// a similarity does everywhere alike; the midpoint rule over a turn is good for a smooth periodic function.
double world_area(const CompiledQuadric& q) {
  const double determinant = std::abs(q.world_from_object.determinant());
  const auto growth = [&](Vector3 n) { return determinant * length(transposed(q.object_from_world, n)); };
  if (q.kind == CompiledQuadric::Kind::disk)
    return growth({0, 0, 1}) * q.phi_max / 2 * (1 - q.inner_radius * q.inner_radius);
  if (q.kind == CompiledQuadric::Kind::saddle) {
    constexpr int points = 32;
    double sum = 0;
    for (int i = 0; i < points; ++i)
      for (int j = 0; j < points; ++j) sum += growth({-gauss_point(j, points), -gauss_point(i, points), 1});
    return sum / (points * points);
  }
  const int steps = is_similarity(q.world_from_object) ? 1 : 256;
  const bool sphere = q.kind == CompiledQuadric::Kind::sphere;
  const double lowest = sphere ? q.z_min : 0, height = sphere ? q.z_max - q.z_min : 1;
  const int z_steps = sphere ? steps : 1;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double phi = q.phi_max * (i + 0.5) / steps, x = std::cos(phi), y = std::sin(phi);
    for (int j = 0; j < z_steps; ++j) {
      const double z = sphere ? lowest + height * (j + 0.5) / z_steps : 0, ring = std::sqrt(1 - z * z);
      sum += growth({ring * x, ring * y, z});
    }
  }
  return sum / (steps * z_steps) * q.phi_max * height;
}

LightCone cone_of(const SpotLight& spot) {
  const Vector3 axis = normalize(spot.to - spot.from);
  const auto cosine = [](double degrees) { return static_cast<float>(std::cos(degrees * pi / 180)); };
  return {{static_cast<float>(axis.x), static_cast<float>(axis.y), static_cast<float>(axis.z)},
          cosine(spot.cone_angle),
          cosine(spot.cone_angle - spot.cone_delta)};
}

}  // namespace

void Compiler::add_lights() {
  for (const LightDescription& light : scene_.lights) {
    CompiledLight c;
    if (const auto* spot = std::get_if<SpotLight>(&light.kind)) {
      c.kind = CompiledLight::Kind::point;
      c.position = spot->from;
      c.value = spot->intensity;
      c.cone = cone_of(*spot);
    } else if (const auto* point = std::get_if<PointLight>(&light.kind)) {
      c.kind = CompiledLight::Kind::point;
      c.position = point->from;
      c.value = point->intensity;
    } else if (const auto* distant = std::get_if<DistantLight>(&light.kind)) {
      c.kind = CompiledLight::Kind::distant;
      c.direction_to = distant->direction_to_light;
      c.value = distant->radiance;
    } else if (std::holds_alternative<SphereLight>(light.kind)) {
      continue;  // add_shapes takes them
    } else if (const auto* ambient = std::get_if<AmbientLight>(&light.kind)) {
      add_ambient_light(*ambient, light.location);
      continue;
    } else {
      add_infinite_light(light);
      continue;
    }
    compiled_.lights.push_back(c);
  }
}

// A ball of radiance L has the intensity L pi radius^2 in every direction.
std::vector<ShapeDescription> Compiler::balls_of_lights() const {
  std::vector<ShapeDescription> balls;
  for (const LightDescription& description : scene_.lights) {
    const auto* light = std::get_if<SphereLight>(&description.kind);
    if (!light) continue;
    ShapeDescription& ball = balls.emplace_back();
    ball.world_from_object = translate(light->from);
    ball.material = DiffuseMaterial{{}};
    ball.kind = SphereShape{light->radius};
    ball.light = AreaLight{static_cast<float>(1 / (pi * light->radius * light->radius)) * light->intensity, false, 0};
    ball.location = description.location;
  }
  return balls;
}

void Compiler::add_ambient_light(const AmbientLight& light, const Location& location) {
  compiled_.ambient = compiled_.ambient + light.radiance;
  if (compiled_.integrator.kind == CompiledIntegrator::Kind::classic || warned_of_ambient_light_) return;
  warned_of_ambient_light_ = true;
  warnings_.push_back({Severity::warning,
                       location,
                       "LightSource \"ambient\" shines for Integrator \"classic\" only; LightSource \"infinite\" is "
                       "such light with its shadows",
                       {}});
}

void Compiler::add_infinite_light(const LightDescription& description) {
  const auto& light = std::get<InfiniteLight>(description.kind);
  CompiledLight c;
  c.value = light.radiance;
  if (light.filename.empty() && !light.portal) {
    c.kind = CompiledLight::Kind::infinite;
    compiled_.lights.push_back(c);
    return;
  }
  CompiledEnvironment e;
  if (light.filename.empty()) {
    e.width = e.height = 1;
    e.pixels = {1, 1, 1};
  } else if (!read_environment(light.filename, e)) {
    return;
  }
  e.world_from_light = rotation(light.world_from_light);
  e.light_from_world = inverse(e.world_from_light);
  mean_brightness_.push_back(add_table(e));
  if (light.illuminance > 0)
    if (const double unit = illuminance(e); unit > 0) c.value = static_cast<float>(light.illuminance / unit) * c.value;
  if (light.portal) {
    c.portal = static_cast<std::int32_t>(compiled_.portals.size());
    compiled_.portals.push_back(compile_portal(*light.portal));
    compiled_.portals.back().image_share = image_share(e);
  }
  c.kind = CompiledLight::Kind::image;
  c.environment = static_cast<std::int32_t>(compiled_.environments.size());
  compiled_.environments.push_back(std::move(e));
  compiled_.lights.push_back(c);
}

// Square pictures are octahedral maps of equal area, pictures twice as wide as high equirectangular ones.
bool Compiler::read_environment(const GivenName& filename, CompiledEnvironment& e) {
  const Location& location = filename.location;
  Image image;
  try {
    image = read_image(filename);
  } catch (const InputError& fault) {
    for (const Diagnostic& d : fault.diagnostics())
      error(location, fmt::format("the image of LightSource \"infinite\": {}: {}", d.location.file, d.message));
    return false;
  }
  if (image.width != image.height && image.width != 2 * image.height) {
    error(location, fmt::format("{} has {} x {} pixels: the image of LightSource \"infinite\" is either square (an "
                                "equal-area octahedral map) or twice as wide as high (an equirectangular one)",
                                filename.text, image.width, image.height));
    return false;
  }
  bool negative = false;
  for (float& v : image.pixels) {
    if (!std::isfinite(v)) {
      error(location, fmt::format("{} has pixels that are infinite or not a number", filename.text));
      return false;
    }
    negative = negative || v < 0;
    v = std::max(0.0f, v);
  }
  if (negative)
    warnings_.push_back(
        {Severity::warning, location, fmt::format("{} has negative pixels; they are taken as 0", filename.text), {}});
  e.map = image.width == image.height ? SphereMap::equal_area : SphereMap::equirectangular;
  e.width = static_cast<std::uint32_t>(image.width);
  e.height = static_cast<std::uint32_t>(image.height);
  e.pixels = std::move(image.pixels);
  return true;
}

Compiler::LightImage Compiler::light_image(const AreaLight& light) {
  if (light.filename.empty()) return {};
  const auto [known, is_new] = light_images_.try_emplace(light.filename.text);
  LightImage& made = known->second;
  if (!is_new) return made;
  ImageTexture picture;
  picture.filename = light.filename;
  CompiledTexture texture;
  texture.kind = CompiledTexture::Kind::image;
  texture.image = image_index(picture, false, "AreaLightSource \"diffuse\"");
  texture.wrap = CompiledTexture::Wrap::clamp;
  if (texture.image < 0) return made;
  const CompiledImage& image = compiled_.images[static_cast<std::size_t>(texture.image)];
  if (*std::min_element(image.pixels.begin(), image.pixels.end()) < 0)
    warnings_.push_back({Severity::warning,
                         light.filename.location,
                         fmt::format("{} has negative pixels; they are taken as 0", light.filename.text),
                         {}});
  made = {add_texture(texture), mean_colour(image)};
  return made;
}

// Whether its alpha is the number 0.
bool Compiler::passes_all_rays(const CompiledShape& shape) const {
  if (shape.alpha < 0) return false;
  const CompiledTexture& alpha = compiled_.textures[static_cast<std::size_t>(shape.alpha)];
  return alpha.kind == CompiledTexture::Kind::constant && is_zero(alpha.value);
}

// As pbrt has it, a light that no ray can meet shines as if there was all of it.
void Compiler::add_area_lights(const AreaLight& light, std::vector<CompiledShape>& parts) {
  const LightImage image = light_image(light);
  const std::size_t first = compiled_.lights.size();
  double total = 0;  // area
  for (CompiledShape& part : parts) {
    CompiledLight c;
    c.kind = CompiledLight::Kind::area;
    c.value = light.radiance;
    c.two_sided = light.two_sided;
    c.texture = image.texture;
    c.is_seen = !passes_all_rays(part);
    if (c.is_seen) c.alpha = part.alpha;
    const double area = add_emitting_geometry(part, c);
    if (!(area > 0)) continue;
    total += area;
    part.light = static_cast<std::int32_t>(compiled_.lights.size());
    part.is_textured = part.is_textured || c.texture >= 0;
    light_areas_.push_back({compiled_.lights.size(), area, mean(image.mean)});
    compiled_.lights.push_back(c);
  }
  const double sides = light.two_sided ? 2 : 1, unit = pi * total * sides * luminance(image.mean);
  if (!(light.power > 0 && unit > 0)) return;
  for (std::size_t i = first; i < compiled_.lights.size(); ++i) {
    Spectrum& value = compiled_.lights[i].value;
    value = static_cast<float>(light.power / unit) * value;
  }
}

double Compiler::add_emitting_geometry(const CompiledShape& shape, CompiledLight& light) {
  light.shape_kind = shape.kind;
  light.shape_index = shape.index;
  if (shape.kind == CompiledShape::Kind::quadric) {
    const CompiledQuadric& q = compiled_.quadrics[shape.index];
    const double turn_area = q.kind == CompiledQuadric::Kind::disk     ? (1 - q.inner_radius * q.inner_radius) / 2
                             : q.kind == CompiledQuadric::Kind::sphere ? q.z_max - q.z_min
                                                                       : 1;
    light.area = static_cast<float>(q.phi_max * turn_area);
    return world_area(q);
  }
  const CompiledMesh& mesh = compiled_.meshes[shape.index];
  std::vector<double> areas;
  for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) {
    const auto& corners = compiled_.triangles[mesh.first_triangle + i];
    const auto at = [&](std::size_t k) { return to_double(compiled_.positions[mesh.first_vertex + corners[k]]); };
    areas.push_back(0.5 * length(cross(at(1) - at(0), at(2) - at(0))));
  }
  light.first_triangle_cdf = static_cast<std::uint32_t>(compiled_.triangle_cdfs.size()) + 1;  // past the leading 0
  const double area = append_cdf(areas, compiled_.triangle_cdfs);
  light.area = static_cast<float>(area);
  return area;
}

// In proportion to the power that reaches the scene, a part of which all lights share equally: power alone would all
// but forget a lamp in a wide landscape under a sky.
void Compiler::add_light_choice() {
  constexpr double equal_part = 0.1;
  const std::size_t n = compiled_.lights.size();
  if (n == 0) return;
  const double radius = scene_radius(), disk = pi * radius * radius;
  // Of a surface that would send out on one side what an image brings into the scene.
  const auto lit_area = [&](const CompiledLight& image) {
    if (image.portal < 0) return 4 * disk;
    const CompiledPortal& portal = compiled_.portals[static_cast<std::size_t>(image.portal)];
    return std::min(4 * disk, portal.width * portal.height);
  };
  std::vector<double> powers(n);
  for (std::size_t i = 0; i < n; ++i) {
    const CompiledLight& light = compiled_.lights[i];
    powers[i] = mean(light.value);
    if (light.kind == CompiledLight::Kind::point) powers[i] *= 4 * pi * static_cast<double>(light.cone.share());
    if (light.kind == CompiledLight::Kind::distant) powers[i] *= disk;
    if (light.kind == CompiledLight::Kind::infinite) powers[i] *= 4 * pi * disk;
    if (light.kind == CompiledLight::Kind::image)
      powers[i] *= pi * mean_brightness_[static_cast<std::size_t>(light.environment)] * lit_area(light);
  }
  for (const auto& [light, area, brightness] : light_areas_)
    powers[light] *= brightness * pi * area * (compiled_.lights[light].two_sided ? 2 : 1);
  double total = 0;
  for (const double p : powers) total += p;
  for (double& p : powers) p = equal_part / static_cast<double>(n) + (total > 0 ? (1 - equal_part) * p / total : 0);
  compiled_.mean_radiance = static_cast<float>(total / (4 * pi * disk));
  std::vector<float> cdf;
  append_cdf(powers, cdf);
  for (std::size_t i = 0; i < n; ++i) compiled_.lights[i].chance = cdf[i + 1] - cdf[i];
  compiled_.light_cdf.assign(cdf.begin() + 1, cdf.end());
}

// Of a ball about everything that has a place.
double Compiler::scene_radius() const {
  Box3 box;
  const auto include = [&](const Box3& b) {
    if (b.empty()) return;
    box.include(b.lo);
    box.include(b.hi);
  };
  for (std::size_t i = first_world_vertex_; i < compiled_.positions.size(); ++i)
    box.include(to_double(compiled_.positions[i]));
  for (std::size_t i = first_world_quadric_; i < compiled_.quadrics.size(); ++i)
    include(quadric_bounds(compiled_.quadrics[i]));
  for (const CompiledVolume& v : compiled_.volumes)
    include(bounds(inverse(v.region.local_from_world), Box3{to_double(v.region.lo), to_double(v.region.hi)}));
  std::vector<Box3> objects;
  for (const CompiledObject& object : compiled_.objects) objects.push_back(object_bounds(object));
  for (const CompiledInstance& instance : compiled_.instances)
    include(bounds(instance.world_from_object, objects[instance.object]));
  return box.empty() ? 1 : 0.5 * length(box.hi - box.lo);
}

}  // namespace brume
