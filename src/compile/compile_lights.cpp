#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/sphere_map.h"
#include "compile/compiler.h"
#include "image/image.h"
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
    const double share = e.projection == CompiledEnvironment::Projection::equal_area
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
      const Vector3 d = e.projection == CompiledEnvironment::Projection::equal_area ? equal_area_direction(centre)
                                                                                    : equirectangular_direction(centre);
      const float* rgb = e.pixels.data() + 3 * (static_cast<std::size_t>(y) * e.width + x);
      sum += std::max(0.0, d.z) * static_cast<double>(e.pixel_solid_angle[y]) * luminance({{rgb[0], rgb[1], rgb[2]}});
    }
  return sum;
}

// Turns and mirrors, without stretching: the columns of the map at length 1.
Transform rotation(const Transform& t) {
  Transform r;
  const double size = std::cbrt(std::abs(t.determinant()));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = t.m[i][j] / size;
  return r;
}

// The area of a quadric in the world. The affine map enlarges a piece with the unit normal n by |det M| |M^-T n|; the
// midpoint rule over a turn is good for a smooth periodic function.
double world_area(const CompiledQuadric& q) {
  constexpr int steps = 256;
  const double determinant = std::abs(q.world_from_object.determinant());
  const auto growth = [&](Vector3 n) { return determinant * length(transposed(q.object_from_world, n)); };
  if (q.kind == CompiledQuadric::Kind::disk)
    return growth({0, 0, 1}) * q.phi_max / 2 * (1 - q.inner_radius * q.inner_radius);
  const bool sphere = q.kind == CompiledQuadric::Kind::sphere;
  const double sweep = sphere ? 2 * pi : q.phi_max;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double phi = sweep * (i + 0.5) / steps;
    for (int j = 0; j < steps; ++j) {
      const double z = sphere ? 2 * (j + 0.5) / steps - 1 : 0, ring = std::sqrt(1 - z * z);
      sum += growth({ring * std::cos(phi), ring * std::sin(phi), z});
    }
  }
  return sum / (steps * steps) * sweep * (sphere ? 2 : 1);
}

}  // namespace

void Compiler::add_lights() {
  for (const LightDescription& light : scene_.lights) {
    CompiledLight c;
    if (const auto* point = std::get_if<PointLight>(&light.kind)) {
      c.kind = CompiledLight::Kind::point;
      c.position = point->from;
      c.value = point->intensity;
    } else if (const auto* distant = std::get_if<DistantLight>(&light.kind)) {
      c.kind = CompiledLight::Kind::distant;
      c.direction_to = distant->direction_to_light;
      c.value = distant->radiance;
    } else {
      add_infinite_light(light);
      continue;
    }
    compiled_.lights.push_back(c);
  }
}

void Compiler::add_infinite_light(const LightDescription& description) {
  const auto& light = std::get<InfiniteLight>(description.kind);
  CompiledLight c;
  c.kind = CompiledLight::Kind::infinite;
  c.value = light.radiance;
  if (!light.filename.empty()) {
    CompiledEnvironment e;
    if (!read_environment(light.filename, description.location, e)) return;
    e.world_from_light = rotation(light.world_from_light);
    e.light_from_world = inverse(e.world_from_light);
    mean_brightness_.push_back(add_table(e));
    if (light.illuminance > 0)
      if (const double unit = illuminance(e); unit > 0)
        c.value = static_cast<float>(light.illuminance / unit) * c.value;
    c.kind = CompiledLight::Kind::image;
    c.environment = static_cast<std::int32_t>(compiled_.environments.size());
    compiled_.environments.push_back(std::move(e));
  }
  compiled_.lights.push_back(c);
}

// Square pictures are octahedral maps of equal area, pictures twice as wide as high equirectangular ones.
bool Compiler::read_environment(const std::string& filename, const Location& location, CompiledEnvironment& e) {
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
                                filename, image.width, image.height));
    return false;
  }
  bool negative = false;
  for (float& v : image.pixels) {
    if (!std::isfinite(v)) {
      error(location, fmt::format("{} has pixels that are infinite or not a number", filename));
      return false;
    }
    negative = negative || v < 0;
    v = std::max(0.0f, v);
  }
  if (negative)
    warnings_.push_back(
        {Severity::warning, location, fmt::format("{} has negative pixels; they are taken as 0", filename), {}});
  e.projection = image.width == image.height ? CompiledEnvironment::Projection::equal_area
                                             : CompiledEnvironment::Projection::equirectangular;
  e.width = static_cast<std::uint32_t>(image.width);
  e.height = static_cast<std::uint32_t>(image.height);
  e.pixels = std::move(image.pixels);
  return true;
}

std::int32_t Compiler::add_area_light(const AreaLight& light, const CompiledShape& shape) {
  CompiledLight c;
  c.kind = CompiledLight::Kind::area;
  c.value = light.radiance;
  c.two_sided = light.two_sided;
  c.shape_kind = shape.kind;
  c.shape_index = shape.index;
  double area = 0;  // in the world
  if (shape.kind == CompiledShape::Kind::quadric) {
    const CompiledQuadric& q = compiled_.quadrics[shape.index];
    area = world_area(q);
    const bool disk = q.kind == CompiledQuadric::Kind::disk;
    c.area = static_cast<float>(q.phi_max * (disk ? (1 - q.inner_radius * q.inner_radius) / 2 : 1));
  } else {
    const CompiledMesh& mesh = compiled_.meshes[shape.index];
    std::vector<double> areas;
    for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) {
      const auto& corners = compiled_.triangles[mesh.first_triangle + i];
      const auto at = [&](std::size_t k) { return to_double(compiled_.positions[mesh.first_vertex + corners[k]]); };
      areas.push_back(0.5 * length(cross(at(1) - at(0), at(2) - at(0))));
    }
    c.first_triangle_cdf = static_cast<std::uint32_t>(compiled_.triangle_cdfs.size()) + 1;  // past the leading 0
    area = append_cdf(areas, compiled_.triangle_cdfs);
    c.area = static_cast<float>(area);
  }
  if (!(area > 0)) return -1;
  if (light.power > 0) c.value = static_cast<float>(light.power / (pi * area * (light.two_sided ? 2 : 1))) * c.value;
  compiled_.lights.push_back(c);
  light_areas_.push_back({compiled_.lights.size() - 1, area});
  return static_cast<std::int32_t>(compiled_.lights.size() - 1);
}

// In proportion to the power that reaches the scene, a part of which all lights share equally: power alone would all
// but forget a lamp in a wide landscape under a sky.
void Compiler::add_light_choice() {
  constexpr double equal_part = 0.1;
  const std::size_t n = compiled_.lights.size();
  if (n == 0) return;
  const double radius = scene_radius(), disk = pi * radius * radius;
  std::vector<double> powers(n);
  for (std::size_t i = 0; i < n; ++i) {
    const CompiledLight& light = compiled_.lights[i];
    powers[i] = mean(light.value);
    if (light.kind == CompiledLight::Kind::point) powers[i] *= 4 * pi;
    if (light.kind == CompiledLight::Kind::distant) powers[i] *= disk;
    if (light.kind == CompiledLight::Kind::infinite) powers[i] *= 4 * pi * disk;
    if (light.kind == CompiledLight::Kind::image)
      powers[i] *= 4 * pi * disk * mean_brightness_[static_cast<std::size_t>(light.environment)];
  }
  for (const auto& [light, area] : light_areas_)
    powers[light] *= pi * area * (compiled_.lights[light].two_sided ? 2 : 1);
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
  for (const auto& p : compiled_.positions) box.include(to_double(p));
  const auto include = [&](const Transform& world_from_box, Vector3 lo, Vector3 hi) {
    const Box3 b = bounds(world_from_box, Box3{lo, hi});
    box.include(b.lo);
    box.include(b.hi);
  };
  for (const CompiledQuadric& q : compiled_.quadrics) include(q.world_from_object, {-1, -1, -1}, {1, 1, 1});
  for (const CompiledVolume& v : compiled_.volumes)
    include(inverse(v.region.local_from_world), to_double(v.region.lo), to_double(v.region.hi));
  return box.empty() ? 1 : 0.5 * length(box.hi - box.lo);
}

}  // namespace brume
