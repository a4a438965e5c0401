// What write_scene writes reads back as the same scene.
#include <cmath>
#include <limits>
#include <random>

#include "kernel/phase_table.h"
#include "scene_test.h"

namespace brume {
namespace {

void expect_equal(const Transform& a, const Transform& b, double tolerance) {
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(a.m[r][c], b.m[r][c], tolerance);
}

void expect_equal(const MediumDescription& a, const MediumDescription& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.world_from_medium, b.world_from_medium);
  EXPECT_EQ(a.sigma_a, b.sigma_a);
  EXPECT_EQ(a.sigma_s, b.sigma_s);
  EXPECT_EQ(a.emission, b.emission);
  EXPECT_EQ(a.temperatures, b.temperatures);
  EXPECT_EQ(a.phase, b.phase);
  EXPECT_EQ(a.phase_parameters, b.phase_parameters);
  EXPECT_EQ(a.linear_interpolation, b.linear_interpolation);
  EXPECT_EQ(a.storage_bits, b.storage_bits);
  EXPECT_EQ(a.sanitize, b.sanitize);
  ASSERT_EQ(a.kind.index(), b.kind.index());
  if (const auto* grid = std::get_if<UniformGridMedium>(&a.kind)) {
    const auto& other = std::get<UniformGridMedium>(b.kind);
    EXPECT_EQ(grid->resolution, other.resolution);
    EXPECT_EQ(grid->p0, other.p0);
    EXPECT_EQ(grid->p1, other.p1);
    EXPECT_EQ(grid->density, other.density);
    EXPECT_EQ(grid->temperature, other.temperature);
    EXPECT_EQ(grid->strength, other.strength);
  }
  if (const auto* file = std::get_if<FileMedium>(&a.kind)) {
    EXPECT_EQ(file->filename, std::get<FileMedium>(b.kind).filename);
    const auto& other = std::get<FileMedium>(b.kind);
    EXPECT_EQ(file->grid, other.grid);
    EXPECT_EQ(file->temperature_grid, other.temperature_grid);
    EXPECT_EQ(file->temperature_asked_for, other.temperature_asked_for);
  }
  if (const auto* made = std::get_if<ProceduralMedium>(&a.kind)) {
    EXPECT_EQ(made->procedural, std::get<ProceduralMedium>(b.kind).procedural);
  }
  if (const auto* coloured = std::get_if<RgbGridMedium>(&a.kind)) {
    const auto& other = std::get<RgbGridMedium>(b.kind);
    EXPECT_EQ(coloured->resolution, other.resolution);
    EXPECT_EQ(coloured->p1, other.p1);
    EXPECT_EQ(coloured->sigma_a, other.sigma_a);
    EXPECT_EQ(coloured->sigma_s, other.sigma_s);
    EXPECT_EQ(coloured->emission, other.emission);
  }
  if (const auto* noise = std::get_if<CloudMedium>(&a.kind)) {
    EXPECT_EQ(noise->cloud, std::get<CloudMedium>(b.kind).cloud);
  }
}

void expect_equal(const ShapeDescription& a, const ShapeDescription& b) {
  EXPECT_EQ(a.world_from_object, b.world_from_object);
  EXPECT_EQ(a.reverse_orientation, b.reverse_orientation);
  EXPECT_EQ(a.inside, b.inside);
  EXPECT_EQ(a.outside, b.outside);
  EXPECT_EQ(a.alpha, b.alpha);
  EXPECT_EQ(a.relief.displacement, b.relief.displacement);
  EXPECT_EQ(a.relief.normal_map, b.relief.normal_map);
  ASSERT_EQ(a.material.index(), b.material.index());
  if (const auto* diffuse = std::get_if<DiffuseMaterial>(&a.material)) {
    EXPECT_EQ(diffuse->reflectance, std::get<DiffuseMaterial>(b.material).reflectance);
  }
  if (const auto* phong = std::get_if<BlinnPhongMaterial>(&a.material)) {
    const auto& other = std::get<BlinnPhongMaterial>(b.material);
    EXPECT_EQ(phong->diffuse, other.diffuse);
    EXPECT_EQ(phong->specular, other.specular);
    EXPECT_EQ(phong->reflection, other.reflection);
    EXPECT_EQ(phong->shininess, other.shininess);
    EXPECT_EQ(phong->refraction, other.refraction);
    EXPECT_EQ(phong->absorption, other.absorption);
    EXPECT_EQ(phong->ambient, other.ambient);
    EXPECT_EQ(phong->metallic, other.metallic);
    EXPECT_EQ(phong->index, other.index);
  }
  if (const auto* coated = std::get_if<CoatedDiffuseMaterial>(&a.material)) {
    EXPECT_EQ(coated->reflectance, std::get<CoatedDiffuseMaterial>(b.material).reflectance);
    EXPECT_EQ(coated->eta, std::get<CoatedDiffuseMaterial>(b.material).eta);
    EXPECT_EQ(coated->alpha, std::get<CoatedDiffuseMaterial>(b.material).alpha);
  }
  if (const auto* conductor = std::get_if<ConductorMaterial>(&a.material)) {
    EXPECT_EQ(conductor->eta, std::get<ConductorMaterial>(b.material).eta);
    EXPECT_EQ(conductor->k, std::get<ConductorMaterial>(b.material).k);
    EXPECT_EQ(conductor->alpha, std::get<ConductorMaterial>(b.material).alpha);
  }
  if (const auto* dielectric = std::get_if<DielectricMaterial>(&a.material)) {
    EXPECT_EQ(dielectric->eta, std::get<DielectricMaterial>(b.material).eta);
    EXPECT_EQ(dielectric->alpha, std::get<DielectricMaterial>(b.material).alpha);
  }
  ASSERT_EQ(a.light.has_value(), b.light.has_value());
  if (a.light) {
    EXPECT_EQ(a.light->radiance, b.light->radiance);
    EXPECT_EQ(a.light->two_sided, b.light->two_sided);
    EXPECT_EQ(a.light->power, b.light->power);
    EXPECT_EQ(a.light->filename, b.light->filename);
  }
  ASSERT_EQ(a.kind.index(), b.kind.index());
  if (const auto* disk = std::get_if<DiskShape>(&a.kind)) {
    const auto& other = std::get<DiskShape>(b.kind);
    EXPECT_EQ(disk->radius, other.radius);
    EXPECT_EQ(disk->height, other.height);
    EXPECT_EQ(disk->inner_radius, other.inner_radius);
    EXPECT_EQ(disk->phi_max, other.phi_max);
  }
  if (const auto* cylinder = std::get_if<CylinderShape>(&a.kind)) {
    const auto& other = std::get<CylinderShape>(b.kind);
    EXPECT_EQ(cylinder->radius, other.radius);
    EXPECT_EQ(cylinder->z_min, other.z_min);
    EXPECT_EQ(cylinder->z_max, other.z_max);
    EXPECT_EQ(cylinder->phi_max, other.phi_max);
    EXPECT_EQ(cylinder->caps, other.caps);
  }
  if (const auto* sphere = std::get_if<SphereShape>(&a.kind)) {
    const auto& other = std::get<SphereShape>(b.kind);
    EXPECT_EQ(sphere->radius, other.radius);
    EXPECT_EQ(sphere->z_min, other.z_min);
    EXPECT_EQ(sphere->z_max, other.z_max);
    EXPECT_EQ(sphere->phi_max, other.phi_max);
  }
  if (const auto* mesh = std::get_if<TriangleMeshShape>(&a.kind)) {
    const auto& other = std::get<TriangleMeshShape>(b.kind);
    EXPECT_EQ(mesh->positions, other.positions);
    EXPECT_EQ(mesh->triangles, other.triangles);
    EXPECT_EQ(mesh->normals, other.normals);
    EXPECT_EQ(mesh->uv, other.uv);
    EXPECT_EQ(mesh->displacement, other.displacement);
  }
  if (const auto* patches = std::get_if<BilinearMeshShape>(&a.kind)) {
    const auto& other = std::get<BilinearMeshShape>(b.kind);
    EXPECT_EQ(patches->positions, other.positions);
    EXPECT_EQ(patches->patches, other.patches);
    EXPECT_EQ(patches->normals, other.normals);
    EXPECT_EQ(patches->uv, other.uv);
  }
  if (const auto* quad = std::get_if<QuadShape>(&a.kind)) {
    const auto& other = std::get<QuadShape>(b.kind);
    EXPECT_EQ(quad->origin, other.origin);
    EXPECT_EQ(quad->edge_u, other.edge_u);
    EXPECT_EQ(quad->edge_v, other.edge_v);
  }
}

void expect_equal(const LightDescription& a, const LightDescription& b) {
  ASSERT_EQ(a.kind.index(), b.kind.index());
  if (const auto* point = std::get_if<PointLight>(&a.kind)) {
    EXPECT_EQ(point->from, std::get<PointLight>(b.kind).from);
    EXPECT_EQ(point->intensity, std::get<PointLight>(b.kind).intensity);
  }
  if (const auto* spot = std::get_if<SpotLight>(&a.kind)) {
    const auto& other = std::get<SpotLight>(b.kind);
    EXPECT_EQ(spot->from, other.from);
    EXPECT_EQ(spot->to, other.to);
    EXPECT_EQ(spot->intensity, other.intensity);
    EXPECT_EQ(spot->cone_angle, other.cone_angle);
    EXPECT_EQ(spot->cone_delta, other.cone_delta);
  }
  if (const auto* distant = std::get_if<DistantLight>(&a.kind)) {
    EXPECT_EQ(distant->direction_to_light, std::get<DistantLight>(b.kind).direction_to_light);
    EXPECT_EQ(distant->radiance, std::get<DistantLight>(b.kind).radiance);
  }
  if (const auto* infinite = std::get_if<InfiniteLight>(&a.kind)) {
    const auto& other = std::get<InfiniteLight>(b.kind);
    EXPECT_EQ(infinite->radiance, other.radiance);
    EXPECT_EQ(infinite->filename, other.filename);
    EXPECT_EQ(infinite->world_from_light, other.world_from_light);
    EXPECT_EQ(infinite->illuminance, other.illuminance);
    EXPECT_EQ(infinite->portal, other.portal);
  }
  if (const auto* sphere = std::get_if<SphereLight>(&a.kind)) {
    const auto& other = std::get<SphereLight>(b.kind);
    EXPECT_EQ(sphere->from, other.from);
    EXPECT_EQ(sphere->radius, other.radius);
    EXPECT_EQ(sphere->intensity, other.intensity);
  }
  if (const auto* ambient = std::get_if<AmbientLight>(&a.kind)) {
    EXPECT_EQ(ambient->radiance, std::get<AmbientLight>(b.kind).radiance);
  }
}

void expect_equal(const TextureDescription& a, const TextureDescription& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.is_float, b.is_float);
  EXPECT_EQ(a.kind, b.kind) << a.name;
}

void expect_equal(const std::vector<ShapeDescription>& a, const std::vector<ShapeDescription>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) expect_equal(a[i], b[i]);
}

// Exact but for the camera's matrix, which the language gives by its inverse.
void expect_equal(const SceneDescription& a, const SceneDescription& b) {
  EXPECT_EQ(a.film.filename, b.film.filename);
  EXPECT_EQ(a.film.width, b.film.width);
  EXPECT_EQ(a.film.height, b.film.height);
  EXPECT_EQ(a.film.save_fp16, b.film.save_fp16);
  EXPECT_EQ(a.film.colour_space, b.film.colour_space);
  EXPECT_EQ(a.film.iso, b.film.iso);
  EXPECT_EQ(a.film.white_balance, b.film.white_balance);
  EXPECT_EQ(a.film.max_component, b.film.max_component);
  EXPECT_EQ(a.camera.shutter_open, b.camera.shutter_open);
  EXPECT_EQ(a.camera.shutter_close, b.camera.shutter_close);
  EXPECT_EQ(a.sampler.kind, b.sampler.kind);
  EXPECT_EQ(a.sampler.pixel_samples, b.sampler.pixel_samples);
  EXPECT_EQ(a.sampler.seed, b.sampler.seed);
  EXPECT_EQ(a.filter, b.filter);
  EXPECT_EQ(a.integrator.name, b.integrator.name);
  EXPECT_EQ(a.integrator.max_depth, b.integrator.max_depth);
  EXPECT_EQ(a.integrator.traversal, b.integrator.traversal);
  EXPECT_EQ(a.integrator.placement, b.integrator.placement);
  EXPECT_EQ(a.integrator.step, b.integrator.step);
  EXPECT_EQ(a.integrator.volume_shadows, b.integrator.volume_shadows);
  EXPECT_EQ(a.integrator.shadow_samples, b.integrator.shadow_samples);
  expect_equal(a.camera.world_from_camera, b.camera.world_from_camera, 1e-14);
  EXPECT_EQ(a.camera.sphere_map, b.camera.sphere_map);
  EXPECT_EQ(a.camera.fov, b.camera.fov);
  EXPECT_EQ(a.camera.screen_window, b.camera.screen_window);
  EXPECT_EQ(a.camera.lens_radius, b.camera.lens_radius);
  EXPECT_EQ(a.camera.focal_distance, b.camera.focal_distance);
  EXPECT_EQ(a.camera.medium, b.camera.medium);
  ASSERT_EQ(a.media.size(), b.media.size());
  for (std::size_t i = 0; i < a.media.size(); ++i) expect_equal(a.media[i], b.media[i]);
  ASSERT_EQ(a.textures.size(), b.textures.size());
  for (std::size_t i = 0; i < a.textures.size(); ++i) expect_equal(a.textures[i], b.textures[i]);
  expect_equal(a.shapes, b.shapes);
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    EXPECT_EQ(a.objects[i].name, b.objects[i].name);
    expect_equal(a.objects[i].shapes, b.objects[i].shapes);
  }
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].object, b.instances[i].object);
    EXPECT_EQ(a.instances[i].world_from_object, b.instances[i].world_from_object);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) expect_equal(a.lights[i], b.lights[i]);
}

void expect_round_trip(const SceneDescription& scene) {
  std::vector<Diagnostic> warnings;
  const SceneDescription again = scene_of(write_scene(scene), &warnings);
  for (const Diagnostic& w : warnings) ADD_FAILURE() << to_string(w);
  expect_equal(scene, again);
}

class WriteSceneFile : public testing::TestWithParam<const char*> {};
TEST_P(WriteSceneFile, ReadsBackTheSame) {
  std::vector<Diagnostic> warnings;
  expect_round_trip(read_scene(test_folder(std::string("scenes/") + GetParam()), warnings));
}
INSTANTIATE_TEST_SUITE_P(Scenes, WriteSceneFile,
                         testing::Values("fog.pbrt", "smoke.pbrt", "additions.pbrt", "surfaces.pbrt", "classic.pbrt",
                                         "shapes.pbrt"));

TEST(WriteScene, AnEmptySceneReadsBackTheSame) { expect_round_trip({}); }

TEST(WriteScene, ExposureAndColourSpaceReadBackTheSame) {
  SceneDescription scene;
  scene.film.colour_space = ColourSpace::aces2065_1;
  scene.film.iso = 150;
  scene.film.white_balance = 5003;
  scene.film.max_component = 12.5;
  scene.camera.shutter_open = 0.25;
  scene.camera.shutter_close = 0.3;
  scene.lights.push_back({PointLight{{}, {{0.1f, 0.7f, 3}}}, {}});
  expect_round_trip(scene);
}

TEST(WriteScene, PortalsReadBackTheSame) {
  SceneDescription scene;
  InfiniteLight constant{constant_spectrum(2)}, image{constant_spectrum(3), "/sky.exr", rotate(30, {1, 2, 3}), 5};
  constant.portal = {{{0.1, 2, 3}, {1.1, 2, 3}, {1.1, 2, 4}, {0.1, 2, 4}}};
  image.portal = {{{0.1, 2, 4}, {1.1, 2, 4}, {1.1, 2, 3}, {0.1, 2, 3}}};
  scene.lights = {{constant, {}}, {image, {}}};
  expect_round_trip(scene);
}

TEST(WriteScene, TheLensReadsBackTheSame) {
  SceneDescription scene;
  scene.camera.lens_radius = 0.0625;
  scene.camera.focal_distance = 7.3;
  expect_round_trip(scene);
  scene.camera.lens_radius = 0;  // says nothing then, and is kept
  expect_round_trip(scene);
}

TEST(WriteScene, EverySamplerAndFilterReadsBackTheSame) {
  using Kind = PixelFilter::Kind;
  SceneDescription scene;
  for (const auto kind : {SamplerDescription::Kind::independent, SamplerDescription::Kind::zsobol}) {
    scene.sampler.kind = kind;
    expect_round_trip(scene);
  }
  const std::vector<PixelFilter> filters = {{Kind::box, 0.7f, 0.6f},
                                            {Kind::gaussian, 1.1f, 2.3f, 0.37f},
                                            {Kind::mitchell, 2.1f, 1.9f, 0.5f, 0.2f, 0.4f},
                                            {Kind::triangle, 1.3f, 0.9f},
                                            {Kind::sinc, 3.7f, 4.1f, 0.5f, 1 / 3.0f, 1 / 3.0f, 2.9f}};
  for (const PixelFilter& filter : filters) {
    scene.filter = filter;
    expect_round_trip(scene);
  }
}

TEST(WriteScene, ACameraOfAllDirectionsReadsBackTheSame) {
  for (const SphereMap map : {SphereMap::equal_area, SphereMap::equirectangular}) {
    SceneDescription scene;
    scene.camera.sphere_map = map;
    expect_round_trip(scene);
  }
}

// Boundaries of all the scene's media: what is not used is warned of.
void use_media(SceneDescription& scene) {
  for (const MediumDescription& medium : scene.media) {
    ShapeDescription shape;
    shape.material = InterfaceMaterial{};
    shape.inside = medium.name;
    shape.kind = SphereShape{};
    scene.shapes.push_back(shape);
  }
}

TEST(WriteScene, EveryProceduralMediumReadsBackTheSame) {
  SceneDescription scene;
  for (std::size_t kind = 0; kind < procedural_kinds.size(); ++kind) {
    Procedural procedural = usual_procedural(static_cast<ProceduralName>(kind), 50, 3);
    for (std::size_t i = 0; i < procedural.values.size(); ++i) procedural.values[i] *= 0.9f;
    scene.media.push_back({});
    scene.media.back().name = procedural.table().name;
    scene.media.back().kind = ProceduralMedium{procedural};
    if (!procedural.table().has_temperature) continue;
    scene.media.back().temperatures = TemperatureScale{100, 1.5};
    scene.media.back().emission = constant_spectrum(0.7f);
  }
  scene.media.push_back({});
  scene.media.back().name = "noise";
  scene.media.back().kind = CloudMedium{{2, 0.5, 3, {-1, 0, 0}, {1, 0.5, 2}, 40}};
  use_media(scene);
  expect_round_trip(scene);
}

TEST(WriteScene, EveryWayToEmitReadsBackTheSame) {
  SceneDescription scene;
  const auto add = [&](const std::string& name, auto kind) -> MediumDescription& {
    MediumDescription& m = scene.media.emplace_back();
    m.name = name;
    m.kind = std::move(kind);
    m.emission = constant_spectrum(1);
    return m;
  };
  add("glows", HomogeneousMedium{}).emission = Spectrum{{1, 0.5f, 0.2f}};
  UniformGridMedium grid{{2, 1, 1}, {0, 0, 0}, {1, 1, 1}, {1, 2}, {}, {0.5f, 3}};
  add("from place to place", grid);
  grid.temperature = {-20.5f, 1500};
  add("by temperature from place to place", grid).temperatures = TemperatureScale{-3, 2};
  grid.strength.clear();
  MediumDescription& hot = add("by temperature", grid);
  hot.temperatures = TemperatureScale{};
  hot.emission = constant_spectrum(2.5f);
  MediumDescription& coloured =
      add("coloured", RgbGridMedium{{2, 1, 1}, {0, 0, 0}, {1, 1, 1}, {1, 2, 3, 4, 5, 6}, {}, {0.5f, 0, 0, 1, 2, 3}});
  coloured.emission = constant_spectrum(0.25f);
  coloured.sigma_a = coloured.sigma_s = constant_spectrum(3);
  add("a file's", FileMedium{"/a.vdb", "", "temperature", false}).temperatures = TemperatureScale{};
  add("a file's by name", FileMedium{"/a.vdb", "density", "heat", true}).temperatures = TemperatureScale{0, 1000};
  add("a file's, not used", FileMedium{"/a.vdb", "", "", false}).emission = {};
  add("a file with Le", FileMedium{"/a.vdb", "", "", false}).emission = Spectrum{{1, 2, 3}};
  use_media(scene);
  expect_round_trip(scene);
}

TEST(WriteScene, NamesWithSpecialCharactersReadBackTheSame) {
  SceneDescription scene;
  scene.film.filename = "C:\\new folder\\\"x\"\t[1] # \xc3\xa9.exr";
  scene.media.push_back({});
  scene.media[0].name = "/obj/x/volumewrangle1[3,4,5]\n";
  scene.media[0].phase = phase_kind("isotropic");
  scene.media[0].phase_parameters.clear();
  scene.camera.medium = scene.media[0].name;
  expect_round_trip(scene);
}

// Numbers with all their digits: random bit patterns within what the language holds.
TEST(WriteScene, NumbersReadBackToTheLastBit) {
  std::mt19937_64 random(1);
  const auto number = [&] {
    const double mantissa = static_cast<double>(random() >> 11) * 0x1p-53 + 0.5;
    return std::ldexp(mantissa, static_cast<int>(random() % 200) - 100) * (random() % 2 ? 1 : -1);
  };
  const auto colour = [&] {
    Spectrum s;
    for (int c = 0; c < channel_count; ++c) s[c] = static_cast<float>(std::abs(number()));
    return s;
  };
  SceneDescription scene;
  for (int i = 0; i < 50; ++i) {
    scene.lights.push_back({PointLight{{number(), number(), number()}, colour()}, {}});
    scene.lights.push_back({SpotLight{{number(), 1, 2}, {0, number(), 5}, colour(), 40 + 0.3 * i, 0.7 * i}, {}});
    scene.lights.push_back({DistantLight{normalize({number(), number(), number()}), colour()}, {}});
    ShapeDescription shape;
    shape.world_from_object = translate({number(), number(), number()}) * rotate(number(), {1, number(), 2});
    shape.kind = TriangleMeshShape{{{number(), number(), number()}, {number(), 1, 0}, {0, 0, 1}}, {{0, 1, 2}}, {}};
    scene.shapes.push_back(shape);
  }
  MediumDescription medium;
  medium.name = "grid";
  medium.phase = phase_kind("henyey_greenstein");
  medium.phase_parameters = {0.1f};
  UniformGridMedium grid;
  grid.resolution = {100, 1, 1};
  for (int i = 0; i < 100; ++i) grid.density.push_back(static_cast<float>(std::abs(number())));
  grid.density[0] = std::numeric_limits<float>::max();
  grid.density[1] = std::numeric_limits<float>::denorm_min();
  medium.kind = grid;
  scene.media.push_back(medium);
  use_media(scene);
  expect_round_trip(scene);
}

}  // namespace
}  // namespace brume
