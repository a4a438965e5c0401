// Which shapes stand in the world, and which in objects that instances place there.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "compile/compiler.h"
#include "intersect/intersector.h"
#include "intersect/quadric.h"

namespace brume {

namespace {

// By the Frobenius norm, which is no less than the largest singular value.
float largest_scale(const Transform& t) {
  double squared = 0;
  for (const auto& row : t.m) squared += row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
  return static_cast<float>(std::sqrt(squared));
}

}  // namespace

void Compiler::add_shapes() {
  const auto add = [&](const std::vector<ShapeDescription>& shapes) {
    const std::size_t first = compiled_.shapes.size();
    for (const ShapeDescription& shape : shapes) add_shape(shape);
    return CompiledObject{static_cast<std::uint32_t>(first),
                          static_cast<std::uint32_t>(compiled_.shapes.size() - first)};
  };
  for (const ObjectDescription& object : scene_.objects) compiled_.objects.push_back(add(object.shapes));
  first_world_vertex_ = compiled_.positions.size();
  first_world_quadric_ = compiled_.quadrics.size();
  compiled_.world = add(scene_.shapes);
  compiled_.world.shape_count += add(balls_of_lights()).shape_count;
}

void Compiler::add_instances() {
  std::map<std::string, std::uint32_t> objects;
  for (std::size_t i = 0; i < scene_.objects.size(); ++i)
    objects.emplace(scene_.objects[i].name, static_cast<std::uint32_t>(i));
  for (const InstanceDescription& instance : scene_.instances) {
    const auto object = objects.find(instance.object);
    if (object == objects.end())
      error(instance.location, fmt::format("there is no object \"{}\"", instance.object));
    else if (const CompiledObject& o = compiled_.objects[object->second]; o.shape_count > 0) {
      check_range(bounds(instance.world_from_object, object_bounds(o)), "the instance", instance.location);
      compiled_.instances.push_back({object->second, instance.world_from_object, inverse(instance.world_from_object),
                                     largest_scale(instance.world_from_object)});
    }
  }
}

Box3 Compiler::object_bounds(const CompiledObject& object) const {
  return bounds_of(std::span(compiled_.shapes).subspan(object.first_shape, object.shape_count));
}

Box3 Compiler::bounds_of(std::span<const CompiledShape> shapes) const {
  Box3 box;
  for (const CompiledShape& shape : shapes) {
    if (shape.kind == CompiledShape::Kind::quadric) {
      const Box3 b = quadric_bounds(compiled_.quadrics[shape.index]);
      box.include(b.lo);
      box.include(b.hi);
      continue;
    }
    const CompiledMesh& mesh = compiled_.meshes[shape.index];
    for (std::uint32_t v = mesh.first_vertex; v < mesh.first_vertex + mesh.vertex_count; ++v) {
      const auto& [x, y, z] = compiled_.positions[v];
      box.include({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
    }
  }
  return box;
}

void Compiler::check_range(const Box3& box, std::string_view what, const Location& location) {
  const auto in_range = [](Vector3 p) {
    return std::abs(p.x) <= farthest_coordinate && std::abs(p.y) <= farthest_coordinate &&
           std::abs(p.z) <= farthest_coordinate;
  };
  if (in_range(box.lo) && in_range(box.hi)) return;
  const auto text = [](Vector3 p) { return fmt::format("({:.3g}, {:.3g}, {:.3g})", p.x, p.y, p.z); };
  const std::string place =
      box.lo == box.hi ? "is at " + text(box.lo) : "reaches from " + text(box.lo) + " to " + text(box.hi);
  error(location, fmt::format("{} {}; coordinates may be at most {:g}", what, place, farthest_coordinate));
}

}  // namespace brume
