#include "session/example_scene.h"

#include "kernel/phase_table.h"

namespace brume {

namespace {

// The cloud fills [-1, 1] x [-0.6, 0.6] x [-1, 1] of its own space.
constexpr double cloud_scale = 2.4, cloud_height = 3.2;

MediumDescription cloud() {
  MediumDescription medium;
  medium.name = "cloud";
  medium.world_from_medium = translate({0, cloud_height, 0}) * scale({cloud_scale, cloud_scale, cloud_scale});
  medium.sigma_s = constant_spectrum(19.99f);
  medium.sigma_a = constant_spectrum(0.01f);
  medium.phase = phase_kind("henyey_greenstein");
  medium.phase_parameters = {0.5f};
  medium.kind = ProceduralMedium{};
  return medium;
}

ShapeDescription cloud_bounds() {
  ShapeDescription shape;
  shape.material = InterfaceMaterial{};
  shape.inside = "cloud";
  shape.kind = VolumeShape{};
  return shape;
}

// Reaches far enough that its edge reads as the horizon. Its normal, edge_u x edge_v, points up.
ShapeDescription ground() {
  ShapeDescription shape;
  shape.material = DiffuseMaterial{Spectrum{{0.2f, 0.24f, 0.13f}}};
  shape.kind = QuadShape{{-400, 0, 400}, {800, 0, 0}, {0, 0, -800}};
  return shape;
}

}  // namespace

SceneDescription example_scene() {
  SceneDescription scene;
  scene.film.filename = "cloud.png";
  scene.film.width = 640;
  scene.film.height = 400;
  // The leading mirror turns the camera's left-handed space to fit a right-handed world (+y up, +z towards the viewer).
  scene.camera.world_from_camera = inverse(scale({-1, 1, 1}) * look_at({1, 2, 10.5}, {0.7, 2.4, 0}, {0, 1, 0}));
  scene.camera.fov = 31;
  scene.sampler.pixel_samples = 64;
  scene.integrator.max_depth = 100;
  scene.integrator.placement = Placement::middle_random;
  scene.integrator.step = 0.06;
  scene.media.push_back(cloud());
  scene.shapes.push_back(cloud_bounds());
  scene.shapes.push_back(ground());
  scene.lights = {{DistantLight{normalize({-0.8, 0.6, 0.3}), Spectrum{{3.4f, 2.9f, 2.2f}}}, {}},
                  {InfiniteLight{Spectrum{{0.17f, 0.27f, 0.46f}}}, {}}};
  return scene;
}

}  // namespace brume
