// Which shapes stand in the world, and which in objects that instances place there.
#include <fmt/format.h>

#include <map>

#include "compile/compiler.h"

namespace brume {

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
    else if (compiled_.objects[object->second].shape_count > 0)
      compiled_.instances.push_back({object->second, instance.world_from_object, inverse(instance.world_from_object)});
  }
}

Box3 Compiler::object_bounds(const CompiledObject& object) const {
  Box3 box;
  for (std::uint32_t i = object.first_shape; i < object.first_shape + object.shape_count; ++i) {
    const CompiledShape& shape = compiled_.shapes[i];
    if (shape.kind == CompiledShape::Kind::quadric) {
      const Box3 b = quadric_box(compiled_.quadrics[shape.index]);
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

}  // namespace brume
