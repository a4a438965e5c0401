#include "render/emitters.h"

namespace brume {

ShapeDescription emitter(decltype(ShapeDescription::kind) kind, const Transform& place, bool two_sided) {
  ShapeDescription s;
  s.kind = std::move(kind);
  s.world_from_object = place;
  s.material = DiffuseMaterial{};
  std::get<DiffuseMaterial>(s.material).reflectance = {};
  s.light = AreaLight{constant_spectrum(1), two_sided, 0};
  return s;
}

SceneDescription lit_square(const char* integrator, std::vector<ShapeDescription> emitters) {
  SceneDescription s = needle_scene({0, 0, -0.5});
  s.integrator.name = integrator;
  s.integrator.max_depth = 1;
  s.shapes = std::move(emitters);
  s.shapes.push_back(square_facing_z({0, 0, 0}, 0.5, 0.5f));
  return s;
}

std::vector<Emitters> emitter_cases() {
  const Transform askew = translate({0.2, 0.1, -1.5}) * rotate(50, {1, 2, 3}) * scale({1.2, 0.3, 0.6});
  TriangleMeshShape mesh = std::get<TriangleMeshShape>(box_shape({-0.3, -0.2, -1.6}, {0.3, 0.5, -0.9}, "").kind);
  const BilinearMeshShape patch{{{-0.9, -0.8, -1.2}, {0.8, -1, -0.4}, {-1, 0.9, -0.3}, {1, 0.7, -1.5}}, {{0, 1, 2, 3}}};
  const ShapeDescription ball = emitter(SphereShape{0.5}, translate({0.3, 0, -1.5}));
  const ShapeDescription tube = emitter(CylinderShape{0.8, -1, 1.2, 250}, askew, true);
  const ShapeDescription disk = emitter(DiskShape{0.8, 0.1, 0.2, 300}, askew, true);
  const ShapeDescription quad = emitter(QuadShape{}, translate({0.5, 0, -1.2}) * rotate(100, {1, 0, 0}), true);
  return {
      {"sphere", {ball}},
      {"ellipsoid", {emitter(SphereShape{1}, askew)}},
      {"around", {emitter(SphereShape{3}, scale({1, 1.5, 2}), true)}},
      {"disk", {disk}},
      {"cylinder", {tube}},
      {"quad", {quad}},
      {"mesh", {emitter(mesh, Transform())}},
      {"cap", {emitter(CylinderShape{0.4, -0.5, 0.7, 360, true}, translate({0.4, 0, -1.3}) * rotate(60, {1, 2, 0}))}},
      {"bowl", {emitter(SphereShape{0.7, -0.5, 0.2, 300}, translate({0.3, 0.1, -1}) * rotate(20, {1, 0, 0}), true)}},
      {"patch", {emitter(patch, Transform(), true)}},
      {"several", {tube, quad, emitter(mesh, translate({-0.9, 0, 0}))}}};
}

std::vector<Emitters> cut_out_emitter_cases() {
  std::vector<Emitters> all = emitter_cases();
  for (Emitters& emitters : all)
    for (ShapeDescription& shape : emitters.shapes) {
      shape.light->two_sided = true;
      shape.alpha = constant_spectrum(0.4f);
    }
  return all;
}

}  // namespace brume
