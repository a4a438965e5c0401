#include "render/open_boundary.h"

#include <algorithm>

namespace brume {

using kernel::vec3;

namespace {

constexpr std::size_t most_shapes = 64;
constexpr std::uint32_t tries = 8;

// A few numbers of [-1, 1) for each shape and try.
class Numbers {
 public:
  Numbers(std::size_t shape, std::uint32_t number) : shape_(static_cast<std::uint32_t>(shape)), number_(number) {}
  float next() { return 2 * kernel::random_uniform(23, shape_, number_, count_++) - 1; }
  double next_double() { return static_cast<double>(next()); }

 private:
  std::uint32_t shape_, number_, count_ = 0;
};

vec3 to_vec3(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }
vec3 to_vec3(Vector3 p) { return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}; }
Vector3 to_vector3(vec3 p) { return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)}; }

// Near one of its triangles, or near the middle of what it is a part of.
Vector3 place_near(const CompiledScene& scene, const CompiledShape& shape, Numbers& numbers) {
  if (shape.kind == CompiledShape::Kind::mesh) {
    const CompiledMesh& mesh = scene.meshes[shape.index];
    const float u = 0.5f * (numbers.next() + 1);
    const auto number =
        std::min(static_cast<std::uint32_t>(u * static_cast<float>(mesh.triangle_count)), mesh.triangle_count - 1);
    const auto& triangle = scene.triangles[mesh.first_triangle + number];
    const auto corner = [&](std::size_t i) { return to_vec3(scene.positions[mesh.first_vertex + triangle[i]]); };
    const vec3 a = corner(1) - corner(0), b = corner(2) - corner(0);
    const vec3 middle = corner(0) + (1 / 3.0f) * (a + b);
    return to_vector3(middle +
                      0.3f * kernel::max(length(a), length(b)) * vec3(numbers.next(), numbers.next(), numbers.next()));
  }
  const CompiledQuadric& quadric = scene.quadrics[shape.index];
  Vector3 p{0.3 * numbers.next_double(), 0.3 * numbers.next_double(), 0.3 * numbers.next_double()};
  if (quadric.kind == CompiledQuadric::Kind::disk) p.x += 0.5 * (1 + quadric.inner_radius);
  if (quadric.kind == CompiledQuadric::Kind::cylinder) p.z += 0.5;
  if (quadric.kind == CompiledQuadric::Kind::saddle) p = p + Vector3{0.5, 0.5, 0.25};
  return quadric.world_from_object.point(p);
}

}  // namespace

std::optional<vec3> find_open_boundary(const CompiledScene& scene, const MediaAlongRay& media) {
  const auto look = [&](const CompiledObject& object, const Transform& world_from_object) -> std::optional<vec3> {
    std::vector<std::size_t> boundaries;
    for (std::size_t i = object.first_shape; i < object.first_shape + object.shape_count; ++i)
      if (scene.shapes[i].boundary >= 0) boundaries.push_back(i);
    const std::size_t stride = boundaries.size() / most_shapes + 1;
    for (std::size_t i = 0; i < boundaries.size(); i += stride)
      for (std::uint32_t number = 0; number < tries; ++number) {
        Numbers numbers(boundaries[i], number);
        const vec3 p = to_vec3(world_from_object.point(place_near(scene, scene.shapes[boundaries[i]], numbers)));
        const vec3 direction = normalize(vec3(numbers.next(), numbers.next(), numbers.next()));
        if (media.counts_at(p, direction) != media.counts_at(p, -1.0f * direction)) return p;
      }
    return std::nullopt;
  };
  if (const auto place = look(scene.world, {})) return place;
  std::vector<bool> seen(scene.objects.size());
  for (const CompiledInstance& instance : scene.instances) {
    if (seen[instance.object]) continue;
    seen[instance.object] = true;
    if (const auto place = look(scene.objects[instance.object], instance.world_from_object)) return place;
  }
  return std::nullopt;
}

}  // namespace brume
