#include "render/scenes.h"

#include "compile/compile.h"
#include "kernel/phase_table.h"
#include "render/backend.h"

namespace brume {

SceneDescription needle_scene(Vector3 eye) {
  SceneDescription s;
  s.film.width = s.film.height = 1;
  s.filter.kind = PixelFilter::Kind::box;
  s.filter.x_radius = s.filter.y_radius = 0.5f;
  s.sampler.kind = SamplerDescription::Kind::independent;  // the statistical tests need samples without relation
  s.camera.fov = 1e-5;
  s.camera.world_from_camera = translate(eye);
  s.integrator.name = "classic";
  s.integrator.max_depth = 1;
  return s;
}

MediumDescription homogeneous_medium(const std::string& name, float sigma_a, float sigma_s) {
  MediumDescription m;
  m.name = name;
  m.sigma_a = constant_spectrum(sigma_a);
  m.sigma_s = constant_spectrum(sigma_s);
  set_phase(m, "isotropic", {});
  return m;
}

MediumDescription grid_medium(const std::string& name, Vector3 lo, Vector3 hi, std::array<int, 3> resolution,
                              std::vector<float> density, float sigma_a, float sigma_s) {
  MediumDescription m = homogeneous_medium(name, sigma_a, sigma_s);
  m.kind = UniformGridMedium{resolution, lo, hi, std::move(density)};
  return m;
}

void set_phase(MediumDescription& medium, const std::string& phase, std::vector<float> parameters) {
  medium.phase = phase_kind(phase);
  medium.phase_parameters = std::move(parameters);
}

ShapeDescription box_shape(Vector3 lo, Vector3 hi, const std::string& inside, const std::string& outside) {
  ShapeDescription s;
  TriangleMeshShape mesh;
  for (unsigned corner = 0; corner < 8; ++corner)
    mesh.positions.push_back({corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  s.kind = mesh;
  s.material = InterfaceMaterial{};
  s.inside = inside;
  s.outside = outside;
  return s;
}

ShapeDescription sphere_shape(Vector3 centre, double radius, const std::string& inside, const std::string& outside) {
  ShapeDescription s;
  s.kind = SphereShape{radius};
  s.world_from_object = translate(centre);
  s.material = InterfaceMaterial{};
  s.inside = inside;
  s.outside = outside;
  return s;
}

ShapeDescription free_volume(const std::string& medium) {
  ShapeDescription s;
  s.kind = VolumeShape{};
  s.material = InterfaceMaterial{};
  s.inside = medium;
  return s;
}

ShapeDescription square_facing_z(Vector3 c, double h, float reflectance) {
  ShapeDescription s;
  s.kind = QuadShape{{c.x - h, c.y - h, c.z}, {2 * h, 0, 0}, {0, 2 * h, 0}};
  s.material = DiffuseMaterial{constant_spectrum(reflectance)};
  return s;
}

ShapeDescription square_facing_y(Vector3 c, double h, float reflectance) {
  ShapeDescription s;
  s.kind = QuadShape{{c.x - h, c.y, c.z + h}, {2 * h, 0, 0}, {0, 0, -2 * h}};
  s.material = DiffuseMaterial{constant_spectrum(reflectance)};
  return s;
}

LightDescription point_light(Vector3 from, float intensity) {
  return {PointLight{from, constant_spectrum(intensity)}, {}};
}

LightDescription distant_light(Vector3 towards, float irradiance) {
  return {DistantLight{normalize(towards), constant_spectrum(irradiance)}, {}};
}

LightDescription sky(float radiance) { return {InfiniteLight{constant_spectrum(radiance)}, {}}; }

Film render_film(const SceneDescription& scene, int samples, int threads) {
  std::vector<Diagnostic> warnings;
  const CompiledScene compiled = compile(scene, threads, warnings);
  const auto backend = make_cpu_backend();
  backend->prepare(compiled);
  Film film(compiled.crop.width(), compiled.crop.height(), compiled.film_response);
  backend->render(0, samples, threads, film, [](double) { return true; });
  return film;
}

float radiance(const SceneDescription& scene, int samples) { return render_film(scene, samples).image().pixels[0]; }

}  // namespace brume
