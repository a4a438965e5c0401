#include "render/agreement_scenes.h"

#include "image/image.h"
#include "kernel/phase_table.h"
#include "kernel/scalar.h"

namespace brume {

namespace {

// The camera at z = -4 looks along +z at the cube [-1, 1]^3; light comes from a dim sky and from a sun aside.
SceneDescription view() {
  SceneDescription s = needle_scene({0.1, 0.2, -4});
  s.film.width = s.film.height = 32;
  s.camera.fov = 40;
  s.integrator.max_depth = 30;
  s.lights = {sky(0.3f), distant_light({1, 2, -1}, 2)};
  return s;
}

// Values in [0, 1), a third of them 0.
std::vector<float> noise(std::array<int, 3> resolution, std::uint32_t seed) {
  std::vector<float> values(static_cast<std::size_t>(resolution[0] * resolution[1] * resolution[2]));
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = std::max(0.0f, 1.5f * kernel::random_uniform(seed, 0, static_cast<std::uint32_t>(i), 0) - 0.5f);
  return values;
}

constexpr std::array<int, 3> resolution{11, 9, 13};

MediumDescription smoke(const std::string& name, float sigma_a, float sigma_s, std::uint32_t seed = 1) {
  return grid_medium(name, {-1, -1, -1}, {1, 1, 1}, resolution, noise(resolution, seed), sigma_a, sigma_s);
}

MediumDescription with_phase(MediumDescription medium, const std::string& phase, std::vector<float> parameters) {
  set_phase(medium, phase, std::move(parameters));
  return medium;
}

SceneDescription view_of(std::vector<MediumDescription> media, std::vector<ShapeDescription> shapes) {
  SceneDescription s = view();
  s.media = std::move(media);
  s.shapes = std::move(shapes);
  return s;
}

ShapeDescription with_material(ShapeDescription shape, MaterialDescription material) {
  shape.material = std::move(material);
  return shape;
}

ShapeDescription ground(float reflectance = 0.6f) { return square_facing_y({0, -1, 0}, 6, reflectance); }

ShapeDescription emitter(ShapeDescription shape, float radiance) {
  shape.material = DiffuseMaterial{constant_spectrum(0.3f)};
  shape.light = AreaLight{constant_spectrum(radiance), false, 0};
  return shape;
}

ShapeDescription octahedron(double radius, const std::string& inside, const std::string& outside = "") {
  ShapeDescription s;
  TriangleMeshShape mesh;
  const double r = radius;
  mesh.positions = {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  s.kind = mesh;
  s.material = InterfaceMaterial{};
  s.inside = inside;
  s.outside = outside;
  return s;
}

ShapeDescription turned(ShapeDescription shape, double degrees) {
  shape.world_from_object = rotate(degrees, {1, 2, 3}) * shape.world_from_object;
  return shape;
}

MediumDescription turned(MediumDescription medium, double degrees) {
  medium.world_from_medium = rotate(degrees, {1, 2, 3});
  return medium;
}

MediumDescription coloured(MediumDescription medium, Spectrum sigma_a, Spectrum sigma_s) {
  medium.sigma_a = sigma_a;
  medium.sigma_s = sigma_s;
  return medium;
}

const Spectrum red{{0.3f, 1, 2.5f}}, blue{{3, 1.2f, 0.2f}}, tenth = constant_spectrum(0.1f);

void add_media(std::vector<AgreementScene>& all) {
  const auto fog = homogeneous_medium("fog", 0.1f, 0.9f), ball = homogeneous_medium("ball", 0.2f, 1.5f);
  all.push_back({"homogeneous_box", view_of({fog}, {box_shape({-1, -1, -1}, {1, 1, 1}, "fog")})});
  all.push_back({"homogeneous_turned_box", view_of({fog}, {turned(box_shape({-1, -1, -1}, {1, 1, 1}, "fog"), 33)})});
  all.push_back({"homogeneous_sphere", view_of({ball}, {sphere_shape({0, 0, 0}, 1, "ball"), ground()})});
  all.push_back({"homogeneous_octahedron", view_of({ball}, {octahedron(1.4, "ball")})});
  for (const bool linear : {false, true})
    for (const int bits : {8, 16, 32}) {
      MediumDescription m = smoke("smoke", 0.3f, 4);
      m.linear_interpolation = linear;
      m.storage_bits = bits;
      all.push_back({std::string("grid_") + (linear ? "linear_" : "nearest_") + std::to_string(bits),
                     view_of({m}, {free_volume("smoke")})});
    }
  MediumDescription cloud = homogeneous_medium("cloud", 0, 12);
  cloud.kind = ProceduralMedium{usual_procedural(ProceduralName::cloud, 48, 3)};
  set_phase(cloud, "henyey_greenstein", {0.85f});
  all.push_back({"cloud", view_of({cloud}, {free_volume("cloud"), ground()})});
  all.push_back({"thin_grid", view_of({smoke("smoke", 0, 0.1f)}, {free_volume("smoke")})});
  all.push_back(
      {"thin_fog", view_of({homogeneous_medium("fog", 0, 0.03f)}, {box_shape({-1, -1, -1}, {1, 1, 1}, "fog")})});
  all.push_back({"dense_grid", view_of({smoke("smoke", 1, 60)}, {free_volume("smoke")})});
  all.push_back({"dense_fog", view_of({homogeneous_medium("fog", 2, 60)}, {sphere_shape({0, 0, 0}, 1, "fog")})});
  all.push_back({"turned_grid", view_of({turned(smoke("smoke", 0.3f, 4), 50)}, {free_volume("smoke")})});
  all.push_back(
      {"grid_cut_by_a_box", view_of({smoke("smoke", 0.3f, 4)}, {box_shape({-0.7, -2, -0.8}, {0.3, 0.6, 3}, "smoke")})});
  all.push_back(
      {"grid_cut_by_a_turned_box",
       view_of({smoke("smoke", 0.3f, 4)}, {turned(box_shape({-0.7, -2, -0.8}, {0.3, 0.6, 3}, "smoke"), 40)})});
  // Where light comes from one collision alone, what decides about collisions must tell nothing about the light.
  SceneDescription sun = view_of({smoke("smoke", 5, 1.5f)}, {free_volume("smoke")});
  sun.integrator.max_depth = 1;
  sun.lights = {distant_light({1, 2, -1}, 2)};
  all.push_back({"grid_under_a_sun_alone", sun});
  all.push_back({"grid_in_an_octahedron", view_of({smoke("smoke", 0.3f, 4)}, {octahedron(1.2, "smoke")})});
}

void add_phase_functions(std::vector<AgreementScene>& all) {
  const auto ball = [](const std::string& phase, std::vector<float> parameters) {
    SceneDescription s = view_of({with_phase(homogeneous_medium("ball", 0.1f, 2), phase, std::move(parameters))},
                                 {sphere_shape({0, 0, 0}, 1, "ball")});
    s.lights = {sky(0.1f), distant_light({1, 0.3, -2}, 1), distant_light({-3, 1, 1}, 1)};
    return s;
  };
  all.push_back({"phase_isotropic", ball("isotropic", {})});
  all.push_back({"phase_henyey_greenstein", ball("henyey_greenstein", {0.8f})});
  all.push_back({"phase_henyey_greenstein_backwards", ball("henyey_greenstein", {-0.6f})});
  all.push_back({"phase_schlick", ball("schlick", {0.7f})});
  all.push_back({"phase_rayleigh", ball("rayleigh", {})});
  all.push_back({"phase_draine", ball("draine", {0.6f, 2})});
  all.push_back({"phase_mie", ball("mie", {8})});
  all.push_back({"phase_two_lobe", ball("two_lobe", {0.8f, -0.4f, 0.7f})});
}

void add_sets_of_media(std::vector<AgreementScene>& all) {
  const auto fog = homogeneous_medium("fog", 0.05f, 0.25f), ball = homogeneous_medium("ball", 0.2f, 1.5f);
  const auto a = smoke("a", 0.2f, 3), b = turned(with_phase(smoke("b", 1, 2, 7), "henyey_greenstein", {0.7f}), 40);
  all.push_back({"two_grids", view_of({a, b}, {free_volume("a"), free_volume("b")})});
  all.push_back({"a_grid_twice", view_of({a}, {free_volume("a"), free_volume("a")})});
  SceneDescription s = view_of({fog, a}, {free_volume("a"), box_shape({-5, -2, -6}, {5, 3, 5}, "fog"), ground()});
  s.lights = {sky(0.2f), point_light({1, 6, -1.5}, 80)};  // a lamp in the fog has heavy tails
  all.push_back({"grid_in_fog", s});
  all.push_back({"three_media",
                 view_of({fog, a, b, ball}, {free_volume("a"), free_volume("b"), sphere_shape({0.4, 0, 0}, 0.9, "ball"),
                                             box_shape({-3, -2, -3}, {3, 2, 3}, "fog")})});
  s = view_of({a}, {free_volume("a")});
  s.camera.world_from_camera = translate({0.1, 0.2, 0.1});
  s.camera.fov = 80;
  all.push_back({"camera_in_a_grid", s});
  s = view_of({ball}, {sphere_shape({0, 0, 0}, 3, "ball"), ground()});
  s.camera.world_from_camera = translate({0.1, 0.2, 0.1});
  all.push_back({"camera_in_a_sphere", s});
  s = view_of({fog}, {ground()});
  s.camera.medium = "fog";
  s.lights = {point_light({1, 1, 1}, 5), point_light({-1, 0, 1}, 2)};
  all.push_back({"fog_everywhere", s});
  // Paths are aimed at lamps within fog, from media of every kind and from surfaces, and meet other lights besides.
  s = view_of({with_phase(fog, "henyey_greenstein", {0.4f}), a},
              {free_volume("a"), box_shape({-5, -2, -6}, {5, 4, 5}, "fog"), ground(),
               emitter(sphere_shape({-1.5, 1.2, -0.5}, 0.4, ""), 3)});
  s.lights = {sky(0.2f), point_light({1.5, 0.5, -1.5}, 1), point_light({-1.6, -0.5, 0.5}, 2),
              point_light({1, 20, 0}, 50), distant_light({1, 2, -1}, 0.5f)};
  all.push_back({"lamps_in_fog", s});
  s = view_of({fog, ball}, {sphere_shape({0, 0, 0}, 3, "fog"), sphere_shape({0.4, 0, 0}, 1, "ball", "fog"),
                            octahedron(0.5, "", "ball")});
  s.lights.push_back(point_light({-6, 3, -1}, 60));
  all.push_back({"nested_boundaries", s});
  all.push_back({"touching_boxes", view_of({ball}, {box_shape({-1, -1, -1}, {0.2, 1, 1}, "ball"),
                                                    box_shape({0.2, -1, -1}, {1, 1, 1}, "ball")})});
}

// Flames, thin and thick, with other media in and about them; all of their light comes from temperatures.
void add_fire(std::vector<AgreementScene>& all) {
  const auto fire = [](float sigma_a, float sigma_s, float strength) {
    MediumDescription m = homogeneous_medium("fire", sigma_a, sigma_s);
    m.kind = ProceduralMedium{usual_procedural(ProceduralName::fire, 40, 1)};
    m.temperatures = TemperatureScale{};
    m.emission = constant_spectrum(strength);
    return m;
  };
  SceneDescription s = view_of({fire(1, 0.5f, 3)}, {free_volume("fire")});
  s.camera.fov = 16;
  s.lights.clear();
  all.push_back({"fire", s});
  s.media[0] = fire(20, 40, 1);
  s.media[0].linear_interpolation = false;
  s.integrator.max_depth = 4;
  all.push_back({"thick_fire", s});
  s = view_of({fire(4, 2, 1), coloured(smoke("a", 0, 0), red, blue)},
              {free_volume("fire"), free_volume("a"), ground()});
  s.media[1].emission = Spectrum{{0.1f, 0.2f, 0.4f}};
  s.integrator.max_depth = 3;
  all.push_back({"fire_in_smoke", s});
}

// Coefficients and emission that vary in each channel; free, and bounded by glass within a fog that it displaces.
void add_rgb_grids(std::vector<AgreementScene>& all) {
  MediumDescription coloured = homogeneous_medium("coloured", 1, 1);
  const std::array<int, 3> cells{2, 3, 4};
  RgbGridMedium grid{cells, {-1, -1, -1}, {1, 1, 1}, noise({3 * 2, 3, 4}, 3), noise({3 * 2, 3, 4}, 4), {}};
  for (float& s : grid.sigma_s) s *= 4;
  for (std::size_t i = 0; i < grid.sigma_a.size(); ++i) grid.emission.push_back(i % 5 == 0 ? 0.01f : 0);
  coloured.kind = grid;
  all.push_back({"rgb_grid", view_of({coloured}, {free_volume("coloured")})});
  SceneDescription s =
      view_of({coloured, homogeneous_medium("fog", 0.05f, 0.2f)},
              {with_material(sphere_shape({0, 0, 0}, 0.9, "coloured", "fog"), DielectricMaterial{1.3f}),
               sphere_shape({0, 0, 0}, 2, "fog"), ground()});
  s.lights = {sky(1)};
  s.integrator.max_depth = 8;
  all.push_back({"rgb_grid_in_glass", s});
}

void add_colours(std::vector<AgreementScene>& all) {
  const auto grid = smoke("a", 0, 0), other = turned(smoke("b", 0, 0, 7), 40);
  const auto ball = homogeneous_medium("ball", 0, 0);
  all.push_back({"chromatic_albedo", view_of({coloured(grid, blue, Spectrum{{1, 2.8f, 3.8f}})}, {free_volume("a")})});
  all.push_back({"chromatic_homogeneous", view_of({coloured(ball, tenth, red)}, {sphere_shape({0, 0, 0}, 1, "ball")})});
  all.push_back({"chromatic_box",
                 view_of({coloured(ball, tenth, blue)}, {box_shape({-1, -1, -1}, {1, 1, 1}, "ball"), ground()})});
  all.push_back({"chromatic_grid",
                 view_of({with_phase(coloured(grid, red, blue), "henyey_greenstein", {0.5f})}, {free_volume("a")})});
  all.push_back({"chromatic_overlap",
                 view_of({coloured(grid, tenth, 2.0f * blue), coloured(other, blue, red), coloured(ball, tenth, red)},
                         {free_volume("a"), free_volume("b"), sphere_shape({0.4, 0, 0}, 0.9, "ball")})});
  all.push_back(
      {"chromatic_and_grey", view_of({coloured(grid, tenth, 2.0f * blue), homogeneous_medium("ball", 0.2f, 1)},
                                     {free_volume("a"), box_shape({-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}, "ball")})});
  SceneDescription s = view_of({coloured(grid, tenth, 2.0f * blue), coloured(ball, tenth, 0.2f * red)},
                               {free_volume("a"), box_shape({-5, -2, -6}, {5, 3, 5}, "ball"), ground()});
  s.lights = {sky(0.2f), point_light({1, 1.5, -1.5}, 4), distant_light({1, 2, -1}, 1)};
  all.push_back({"chromatic_fog_and_surfaces", s});
  s = view_of({coloured(ball, Spectrum{}, Spectrum{{0, 0.5f, 2}})}, {sphere_shape({0, 0, 0}, 1, "ball")});
  all.push_back({"one_channel_without_extinction", s});
  s = view_of({coloured(grid, red, blue), coloured(ball, blue, tenth)},
              {free_volume("a"), sphere_shape({0.5, 0, 0}, 0.8, "ball")});
  s.media[0].emission = Spectrum{{1, 0.5f, 0.2f}};
  s.media[1].emission = Spectrum{{0.1f, 0.5f, 1}};
  all.push_back({"chromatic_emission", s});
  s = view_of({homogeneous_medium("ball", 1, 0.5f), smoke("a", 3, 2)},
              {sphere_shape({0.5, 0, 0}, 0.8, "ball"), free_volume("a")});
  s.media[0].emission = s.media[1].emission = Spectrum{{3, 2, 1}};
  s.lights.clear();
  all.push_back({"emission", s});
  add_fire(all);
}

void add_surfaces(std::vector<AgreementScene>& all) {
  const auto fog = homogeneous_medium("fog", 0.02f, 0.2f);
  const auto grid = smoke("a", 0.2f, 3);
  const auto room = box_shape({-5, -2, -6}, {5, 4, 5}, "fog");
  SceneDescription s = view_of({grid}, {free_volume("a"), ground(), square_facing_z({0, 0, 2}, 3, 0.8f)});
  all.push_back({"diffuse_surfaces", s});
  s.shapes.push_back(
      with_material(sphere_shape({0.8, -0.3, -0.8}, 0.6, ""),
                    BlinnPhongMaterial{constant_spectrum(0.2f), constant_spectrum(0.3f), constant_spectrum(0.4f), 20}));
  all.push_back({"blinn_phong", s});
  s.shapes.back().material = ConductorMaterial{Spectrum{{0.2f, 0.9f, 1.1f}}, Spectrum{{3.9f, 2.4f, 2.2f}}};
  all.push_back({"conductor", s});
  s.shapes.back().material = DielectricMaterial{1.5f};
  s.lights = {sky(1)};
  all.push_back({"dielectric", s});
  s = view_of({homogeneous_medium("ball", 0.1f, 2), fog},
              {with_material(sphere_shape({0, 0, 0}, 1, "ball"), DielectricMaterial{1.4f}), ground()});
  s.lights = {sky(1)};
  all.push_back({"medium_in_glass", s});
  s.shapes[0].material = DielectricMaterial{1.4f, 0.3f};
  s.shapes.push_back(emitter(sphere_shape({0.3, 0.4, 2}, 0.4, ""), 4));
  s.lights.push_back(distant_light({-1, 1, -1}, 1));
  all.push_back({"medium_in_rough_glass", s});
  s = view_of({fog, grid}, {free_volume("a"), room, emitter(sphere_shape({1.2, 1, -0.5}, 0.3, ""), 10),
                            emitter(square_facing_z({-2, 0, 3}, 0.5, 0), 5), ground()});
  s.shapes[3].reverse_orientation = true;
  s.lights.clear();
  all.push_back({"area_lights", s});
  s = view_of({grid, fog}, {free_volume("a"), ground()});
  s.lights = {{InfiniteLight{constant_spectrum(1), "sky.exr"}, {}}};
  all.push_back({"image_light", s});
  s.shapes.push_back(room);
  s.shapes.push_back(emitter(sphere_shape({1.2, 1, -0.5}, 0.2, ""), 10));
  // Outside of the fog: near a lamp in a medium the reference's estimate has no variance that z-scores could go by.
  s.lights.push_back(point_light({-1, 6, -1}, 50));
  s.lights.push_back(distant_light({0, 1, -1}, 1));
  s.lights.push_back(sky(0.1f));
  all.push_back({"every_light", s});
}

Textured textured(int texture) {
  Textured t;
  t.texture = texture;
  return t;
}

// Textures, instances of glass and of smoke, and the shapes that are parts of others.
void add_textured_instances(std::vector<AgreementScene>& all) {
  SceneDescription s = view_of({homogeneous_medium("ball", 0.1f, 2), homogeneous_medium("fog", 0.02f, 0.1f)},
                               {with_material(ground(), DiffuseMaterial{textured(2)})});
  CheckerboardTexture board;
  board.first = Spectrum{{0.8f, 0.3f, 0.1f}};
  board.second.texture = 0;
  board.mapping.u_scale = 12;
  board.mapping.v_scale = 12;
  MixTexture mix;
  mix.first.texture = 1;
  mix.second = Spectrum{{0.1f, 0.2f, 0.9f}};
  s.textures = {{"grey", false, ConstantTexture{constant_spectrum(0.2f)}, {}},
                {"board", false, board, {}},
                {"mix", false, mix, {}}};
  ShapeDescription pipe;
  pipe.kind = CylinderShape{0.3, -0.5, 0.5, 360, true};
  pipe.material = BlinnPhongMaterial{textured(1), constant_spectrum(0.2f), {}, 20};
  ShapeDescription bowl;
  bowl.kind = SphereShape{0.5, -0.5, 0.1, 300};
  bowl.world_from_object = translate({0.9, 0, 0}) * rotate(-70, {1, 0, 0});
  s.objects = {{"things",
                {pipe, bowl, sphere_shape({0, 0.8, 0}, 0.3, "ball"),
                 with_material(sphere_shape({-0.8, 0.2, 0}, 0.4, "ball"), DielectricMaterial{1.3f})}}};
  s.instances = {{"things", translate({-0.3, -0.3, 0}) * scale({0.7, 0.7, 0.7}), {}},
                 {"things", translate({0.5, 0.5, 0.8}) * rotate(120, {0, 1, 1}) * scale({0.6, -0.9, 0.6}), {}}};
  ShapeDescription patch;
  patch.kind = BilinearMeshShape{{{-1.5, 1, 1}, {-0.2, 1.2, 1}, {-1.5, 1.8, 2}, {-0.2, 1.4, 0.5}}, {{0, 1, 2, 3}}};
  s.shapes.push_back(emitter(patch, 4));
  s.shapes.back().light->two_sided = true;
  s.shapes.push_back(emitter(pipe, 5));
  s.shapes.back().world_from_object = translate({1.4, -0.6, 0.2}) * scale({0.5, 0.5, 0.5});
  s.shapes.push_back(box_shape({-5, -2, -6}, {5, 4, 5}, "fog"));
  s.lights = {sky(0.5f)};
  all.push_back({"textured_instances", s});
}

// A sky that shines into the fog through one window.
void add_window(std::vector<AgreementScene>& all) {
  SceneDescription s = view_of({smoke("a", 0.2f, 3), homogeneous_medium("fog", 0.02f, 0.2f)},
                               {free_volume("a"), box_shape({-5, -2, -6}, {5, 4, 5}, "fog"), ground()});
  InfiniteLight light{constant_spectrum(3), "sky.exr"};
  light.portal = {{{-1.5, 2, -1.5}, {1, 2, -1.5}, {1, 2, 2}, {-1.5, 2, 2}}};
  s.lights = {{light, {}}};
  all.push_back({"window", s});
}

void add_depths(std::vector<AgreementScene>& all) {
  for (const int depth : {0, 1, 2, 5}) {
    SceneDescription s =
        view_of({homogeneous_medium("ball", 0.3f, 1.5f), smoke("a", 1, 2), homogeneous_medium("fog", 0.1f, 0.2f)},
                {sphere_shape({0.5, 0, 0}, 0.8, "ball"), free_volume("a"), ground(),
                 box_shape({-5, -2, -6}, {5, 4, 5}, "fog")});
    s.media[1].emission = constant_spectrum(1);
    s.media[2].emission = constant_spectrum(0.1f);
    s.lights.push_back(point_light({-1, 1, -1}, 2));
    s.integrator.max_depth = depth;
    all.push_back({"depth_" + std::to_string(depth), s});
  }
}

}  // namespace

std::vector<AgreementScene> agreement_scenes() {
  std::vector<AgreementScene> all;
  add_media(all);
  add_phase_functions(all);
  add_sets_of_media(all);
  add_colours(all);
  add_rgb_grids(all);
  add_surfaces(all);
  add_textured_instances(all);
  add_window(all);
  add_depths(all);
  return all;
}

void write_sky(const std::string& path) {
  Image image{16, 8, {}};
  for (std::uint32_t i = 0; i < 3 * 16 * 8; ++i) image.pixels.push_back(kernel::random_uniform(5, 0, i / 3, i % 3));
  for (std::size_t i = 60; i < 72; ++i) image.pixels[i] = 20;  // a bright patch
  write_image(path, image, {});
}

}  // namespace brume
