#include "render/area_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "intersect/surface_uv.h"

namespace brume {

using kernel::vec3;

namespace {

vec3 to_float(Vector3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
Vector3 to_double(vec3 v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }

// The cone of directions in which the unit sphere is seen from a point; all directions from within.
struct Cone {
  Vector3 axis{0, 0, 1};
  double size = 2;  // 1 - cosine of its half angle
  double density() const { return 1 / (2 * std::numbers::pi * size); }
};

Cone cone_to_sphere(Vector3 from) {
  const double squared = dot(from, from);
  if (!(squared > 1)) return {};
  const double sine2 = 1 / squared;
  return {normalize(-from), sine2 / (1 + std::sqrt(1 - sine2))};
}

// The point q of the quadric's own space, where the unit normal is n.
LightPoint light_point(const CompiledScene& scene, const CompiledLight& light, const CompiledQuadric& quadric,
                       Vector3 q, vec3 n, float pdf) {
  LightPoint point{to_float(quadric.world_from_object.point(q)), n, pdf};
  if (is_textured(light)) point.uv = surface_uv(scene, quadric, q);
  return point;
}

// Directions d of object space and w = M d / |M d| of the world, M the affine map's 3 x 3 part: a solid angle grows by
// |det M| / |M d|^3.
LightPoint sample_sphere(const CompiledScene& scene, const CompiledLight& light, const CompiledQuadric& sphere, vec3 p,
                         RandomStream::Pair numbers) {
  const Vector3 from = sphere.object_from_world.point(to_double(p));
  const Cone cone = cone_to_sphere(from);
  const auto [u, turns] = numbers;
  const double z = 1 - static_cast<double>(u) * cone.size;
  const Vector3 d =
      normalize(to_double(kernel::direction_at_cosine(to_float(cone.axis), static_cast<float>(z), turns)));
  const double b = -dot(from, d), half_chord = std::sqrt(std::max(0.0, 1 - dot(from + b * d, from + b * d)));
  // The near side, unless that is cut away or is where p lies itself.
  Vector3 q = normalize(from + (b - half_chord) * d);
  if (cone.size == 2 || b - half_chord < 1e-5 || !is_on_quadric(sphere, q)) {
    q = normalize(from + (b + half_chord) * d);
    if (!is_on_quadric(sphere, q)) return {};
  }
  const double stretch = length(sphere.world_from_object.vector(d));
  const double pdf = cone.density() * stretch * stretch * stretch / std::abs(sphere.world_from_object.determinant());
  const Vector3 n = normalize(transposed(sphere.object_from_world, q));
  return light_point(scene, light, sphere, q, to_float(sphere.flip_normal ? -n : n), static_cast<float>(pdf));
}

float sphere_pdf(const CompiledQuadric& sphere, const Ray& ray) {
  const Cone cone = cone_to_sphere(sphere.object_from_world.point(to_double(ray.origin)));
  const double squeeze = length(sphere.object_from_world.vector(to_double(ray.direction)));
  return static_cast<float>(cone.density() * std::abs(sphere.object_from_world.determinant()) /
                            (squeeze * squeeze * squeeze));
}

// By how much the affine map enlarges a piece of area whose normal in the world is n: |det M| / |M^T n|.
double area_growth(const CompiledQuadric& quadric, vec3 n) {
  return std::abs(quadric.world_from_object.determinant()) /
         length(transposed(quadric.world_from_object, to_double(n)));
}

// The unit normal of a hit at p, a point in the saddle's own space (see Intersector).
vec3 saddle_normal(const CompiledScene& scene, const CompiledQuadric& saddle, Vector3 p) {
  const vec3 n = to_float(quadric_normal(saddle, p));
  if (saddle.patch < 0) return n;
  const auto smooth = at_patch(scene.patches[static_cast<std::size_t>(saddle.patch)].normals, p);
  return dot(n, vec3(smooth[0], smooth[1], smooth[2])) < 0 ? -n : n;
}

// A point and its density per unit of area.
LightPoint sample_saddle(const CompiledScene& scene, const CompiledLight& light, const CompiledQuadric& saddle,
                         RandomStream::Pair numbers) {
  const auto [u, v] = numbers;
  const double x = static_cast<double>(u), y = static_cast<double>(v);
  const Vector3 q{x, y, x * y};
  return light_point(scene, light, saddle, q, saddle_normal(scene, saddle, q),
                     static_cast<float>(1 / saddle_area(saddle, q)));
}

// Likewise.
LightPoint sample_turned(const CompiledScene& scene, const CompiledLight& light, const CompiledQuadric& quadric,
                         RandomStream::Pair numbers) {
  const auto [u, v] = numbers;
  const double phi = static_cast<double>(v) * quadric.phi_max, cosine = std::cos(phi), sine = std::sin(phi);
  Vector3 q{cosine, sine, static_cast<double>(u)}, n{cosine, sine, 0};
  if (quadric.kind == CompiledQuadric::Kind::disk) {
    const double inner2 = quadric.inner_radius * quadric.inner_radius;
    const double r = std::sqrt(inner2 + static_cast<double>(u) * (1 - inner2));
    q = {r * cosine, r * sine, 0};
    n = {0, 0, 1};
  } else if (quadric.kind == CompiledQuadric::Kind::sphere) {
    const double z = quadric.z_min + static_cast<double>(u) * (quadric.z_max - quadric.z_min);
    const double ring = std::sqrt(std::max(0.0, 1 - z * z));
    q = n = {ring * cosine, ring * sine, z};
  }
  const vec3 normal = to_float(normalize(transposed(quadric.object_from_world, n)));
  return light_point(scene, light, quadric, q, quadric.flip_normal ? -normal : normal,
                     1 / (light.area * static_cast<float>(area_growth(quadric, normal))));
}

vec3 vertex(const std::vector<std::array<float, 3>>& from, std::uint32_t index) {
  return {from[index][0], from[index][1], from[index][2]};
}

// Likewise; the normal is that of a hit there (see Intersector). The first number draws the triangle, and what is left
// of it a place there.
LightPoint sample_mesh(const CompiledScene& scene, const CompiledLight& light, RandomStream::Pair numbers) {
  const CompiledMesh& mesh = scene.meshes[light.shape_index];
  auto [u, v] = numbers;
  std::uint32_t triangle = 0;
  if (mesh.triangle_count > 1) {
    const float* cdf = scene.triangle_cdfs.data() + light.first_triangle_cdf;
    triangle = static_cast<std::uint32_t>(std::upper_bound(cdf, cdf + mesh.triangle_count - 1, u) - cdf);
    const float begin = triangle == 0 ? 0 : cdf[triangle - 1];
    u = std::clamp((u - begin) / (cdf[triangle] - begin), 0.0f, 1.0f);
  }
  const auto& corners = scene.triangles[mesh.first_triangle + triangle];
  const auto at = [&](const auto& from, std::size_t corner) {
    return vertex(from, mesh.first_vertex + corners[corner]);
  };
  const vec3 p0 = at(scene.positions, 0), e1 = at(scene.positions, 1) - p0, e2 = at(scene.positions, 2) - p0;
  const float root = std::sqrt(u), b1 = root * (1 - v), b2 = root * v;
  vec3 n = normalize(cross(e1, e2));
  if (mesh.flip_normal) n = -n;
  if (mesh.has_normals) {
    const vec3 smooth = (1 - b1 - b2) * at(scene.normals, 0) + b1 * at(scene.normals, 1) + b2 * at(scene.normals, 2);
    if (dot(smooth, n) < 0) n = -n;
  }
  LightPoint point{p0 + b1 * e1 + b2 * e2, n, 1 / light.area};
  if (is_textured(light)) point.uv = triangle_uv(scene, mesh, triangle, b1, b2);
  point.tilted_length = tilted_length(n, std::sqrt(std::max({dot(e1, e1), dot(e2, e2), dot(e2 - e1, e2 - e1)})));
  return point;
}

// Of a sphere's near side and far side a ray can meet either one, where the near side has holes.
bool is_drawn_by_direction(const CompiledLight& light, const CompiledQuadric& quadric) {
  return quadric.kind == CompiledQuadric::Kind::sphere && light.alpha < 0;
}

const CompiledQuadric* quadric_of(const CompiledScene& scene, const CompiledLight& light) {
  return light.shape_kind == CompiledShape::Kind::quadric ? &scene.quadrics[light.shape_index] : nullptr;
}

}  // namespace

LightPoint sample_area_light(const CompiledScene& scene, const CompiledLight& light, vec3 p,
                             RandomStream::Pair numbers) {
  const CompiledQuadric* quadric = quadric_of(scene, light);
  if (quadric && is_drawn_by_direction(light, *quadric)) return sample_sphere(scene, light, *quadric, p, numbers);
  LightPoint q = !quadric                                         ? sample_mesh(scene, light, numbers)
                 : quadric->kind == CompiledQuadric::Kind::saddle ? sample_saddle(scene, light, *quadric, numbers)
                                                                  : sample_turned(scene, light, *quadric, numbers);
  const vec3 to_light = q.position - p;
  const float squared = dot(to_light, to_light), cosine = std::abs(dot(q.normal, to_light));  // times the distance
  q.pdf = cosine > 0 ? q.pdf * squared * std::sqrt(squared) / cosine : 0;
  return q;
}

float area_light_pdf(const CompiledScene& scene, const CompiledLight& light, const Ray& ray, const SurfaceHit& hit) {
  const CompiledQuadric* quadric = quadric_of(scene, light);
  if (quadric && is_drawn_by_direction(light, *quadric)) return sphere_pdf(*quadric, ray);
  float area = light.area;  // over the density of points there
  if (quadric && quadric->kind == CompiledQuadric::Kind::saddle)
    area = static_cast<float>(saddle_area(*quadric, quadric->object_from_world.point(to_double(ray.at(hit.t)))));
  else if (quadric)
    area *= static_cast<float>(area_growth(*quadric, hit.normal));
  const float cosine = std::abs(dot(hit.normal, ray.direction));
  return cosine > 0 ? hit.t * hit.t / (cosine * area) : 0;
}

}  // namespace brume
