// Point sources in an infinite medium, single scattering, emission, absorption, the white furnace.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/cases.h"
#include "scene/colour.h"

namespace brume {

namespace {

constexpr Fault scatters_forwards{"scattering_a_tenth_forwards", [](SceneDescription& s) {
                                    for (MediumDescription& m : s.media) set_phase(m, "henyey_greenstein", {0.1f});
                                  }};
constexpr Fault cut_short{"paths_that_end_after_twenty_scatterings",
                          [](SceneDescription& s) { s.integrator.max_depth = 20; }};
constexpr Fault extinction{"extinction_a_twentieth_off", [](SceneDescription& s) {
                             for (MediumDescription& m : s.media) {
                               m.sigma_a = 1.05f * m.sigma_a;
                               m.sigma_s = 1.05f * m.sigma_s;
                             }
                           }};
constexpr Fault larger{"a_sphere_a_twentieth_larger",
                       [](SceneDescription& s) { std::get<SphereShape>(s.shapes[0].kind).radius *= 1.05; }};
constexpr Fault backwards{"mu_of_the_wrong_sign", [](SceneDescription& s) { s.media[0].phase_parameters[0] *= -1; }};
constexpr Fault absorption{"a_hundredth_of_what_scatters_absorbed", [](SceneDescription& s) {
                             for (MediumDescription& m : s.media) m.sigma_a = m.sigma_a + 0.01f * m.sigma_s;
                           }};

constexpr Fault hotter{"temperatures_a_hundredth_higher", [](SceneDescription& s) {
                         for (float& t : std::get<UniformGridMedium>(s.media[0].kind).temperature) t *= 1.01f;
                       }};
constexpr Fault dimmer{"emission_a_twentieth_weaker", [](SceneDescription& s) {
                         for (float& v : std::get<UniformGridMedium>(s.media[0].kind).strength) v *= 0.95f;
                       }};

// The fluence of an isotropic point source of unit power in an infinite medium of extinction 1, integrated over shells:
// by reciprocity what its place sees, in any direction, of a shell that emits 1 per unit of length. Three shells emit,
// one a channel. A hundred mean free paths are as good as infinitely many.
SceneDescription shells(float albedo, const std::array<double, 4>& radii) {
  SceneDescription s = needle_scene();
  s.integrator.max_depth = 100000;
  const auto add = [&](const std::string& name, double radius) {
    const std::string outside = s.media.empty() ? "" : s.media.back().name;
    s.media.push_back(homogeneous_medium(name, 1 - albedo, albedo));
    s.shapes.push_back(sphere_shape({0, 0, 0}, radius, name, outside));
  };
  add("beyond", 100);
  for (std::size_t i = 3; i-- > 0;) {
    add("shell " + std::to_string(i), radii[i + 1]);
    s.media.back().emission[static_cast<int>(i)] = 1 / (1 - albedo);
  }
  if (radii[0] > 0) add("core", radii[0]);
  return s;
}

void add_point_source(std::vector<Case>& all, const std::string& row, float albedo,
                      const std::array<double, 6>& fluence) {
  const auto expected = [&](std::size_t first) {
    std::vector<Expected> e;
    for (std::size_t i = first; i < first + 3; ++i) e.push_back({fluence[i], 5e-7});
    return e;
  };
  all.push_back(
      {row + "_shells_near_a_point_source", shells(albedo, {0, 0.5, 1.5, 2.5}), expected(0), scatters_forwards});
  all.push_back(
      {row + "_shells_far_from_a_point_source", shells(albedo, {2.5, 4, 6, 10}), expected(3), scatters_forwards});
  SceneDescription everywhere = needle_scene();
  everywhere.integrator.max_depth = 100000;
  everywhere.media = {homogeneous_medium("fog", 1 - albedo, albedo)};
  everywhere.media[0].emission[0] = 1 / (1 - albedo);
  everywhere.shapes = {box_shape({-2000, -2000, -2000}, {2000, 2000, 2000}, "fog")};
  all.push_back({row + "_all_space_about_a_point_source",
                 everywhere,
                 {{1.0 / (1 - static_cast<double>(albedo)), 1e-5}},
                 cut_short});
}

void add_point_sources(std::vector<Case>& all) {
  add_point_source(all, "15", 0.9f, {0.638799, 1.769411, 1.852911, 2.263169, 1.852677, 1.324440});
  add_point_source(all, "16", 0.99f, {0.711019, 2.752264, 4.251450, 8.194095, 12.386502, 23.547192});
}

// Along a ray towards +z that a black square ends at z = 4, light of a point of intensity 1 at (1, 0, 2).
void add_single_scattering(std::vector<Case>& all) {
  const auto add = [&](const std::string& name, float sigma_a, float g, double expected, const Fault& fault) {
    SceneDescription s = needle_scene();
    s.integrator.max_depth = 1;
    s.media = {homogeneous_medium("fog", sigma_a, 0.5f)};
    if (g != 0) set_phase(s.media[0], "henyey_greenstein", {g});
    s.camera.medium = "fog";
    s.shapes = {square_facing_z({0, 0, 4}, 1, 0)};
    s.lights = {point_light({1, 0, 2}, 1)};
    all.push_back({name, s, {{expected, 5e-9}}, fault});
  };
  add("17_single_scattering", 0, 0, 0.01857249, extinction);
  add("17_single_scattering_HG_06", 0, 0.6f, 0.02007662, backwards);
  add("17_single_scattering_and_absorption", 0.5f, 0, 0.00446067, extinction);
}

void add_absorption_and_emission(std::vector<Case>& all) {
  // The fraction of uniform isotropic emission that escapes from an absorbing sphere of radius x mean free paths,
  // 3 / (8 x^3) (2 x^2 - 1 + (1 + 2 x) e^(-2x)): all of it crosses the sphere of radius d about it outwards, so that a
  // white speck there, facing it, shows 4 x^3 / (3 d^2) times the fraction.
  for (const auto& [x, fraction] : {std::pair{1.0, 0.5272522}, std::pair{5.0, 0.1470015}}) {
    const double d = 1.25 * x;
    SceneDescription s = needle_scene();
    s.camera.world_from_camera = translate({0, 0, -1.1 * x}) * rotate(180, {0, 1, 0});
    s.media = {homogeneous_medium("fire", 1, 0)};
    s.media[0].emission = constant_spectrum(1);
    s.shapes = {sphere_shape({0, 0, 0}, x, "fire"), square_facing_z({0, 0, -d}, 0.01 * x, 1)};
    const double scale = 4 * x * x * x / (3 * d * d);
    all.push_back({"18_emission_from_a_sphere_of_radius_" + std::to_string(static_cast<int>(x)),
                   s,
                   {{scale * fraction, scale * 5e-8}},
                   larger});
  }

  // One mean free path of absorber before the sky, seen by chance, and over a floor, where shadow rays are exact.
  SceneDescription s = needle_scene({0.1, 0.2, -5});
  s.lights = {sky(1)};
  s.media = {homogeneous_medium("absorber", 1, 0)};
  s.shapes = {box_shape({-1, -1, 0}, {1, 1, 1}, "absorber")};
  all.push_back({"21_absorber", s, {{0.36787944, 5e-9}}, extinction});
  s.media = {grid_medium("absorber", {-1, -1, 0}, {1, 1, 1}, {3, 5, 7}, std::vector<float>(3 * 5 * 7, 1), 1, 0)};
  s.media[0].linear_interpolation = false;
  s.shapes = {free_volume("absorber")};
  all.push_back({"21_absorber_as_a_grid", s, {{0.36787944, 5e-9}}, extinction});
  s = needle_scene();
  s.camera.world_from_camera = translate({0, 0.5, 0}) * rotate(90, {1, 0, 0});
  s.media = {homogeneous_medium("absorber", 0.5f, 0)};
  s.shapes = {square_facing_y({0, 0, 0}, 10, 0.5f), box_shape({-1, 1, -1}, {1, 3, 1}, "absorber")};
  s.lights = {distant_light({0, 1, 0}, static_cast<float>(2 * std::numbers::pi))};
  all.push_back({"21_absorber_over_a_floor", s, {{0.36787944, 1e-5}}, extinction});
}

// A black body's gas two units deep, whose absorption differs between channels: sigma_a Le over the way is
// Le (1 - exp(-2 sigma_a)). Then two layers, the nearer without emission.
void add_black_bodies(std::vector<Case>& all) {
  const Spectrum sigma_a{{0.5f, 0.7f, 1}};
  SceneDescription s = needle_scene({0.1, 0.2, -5});
  s.media = {grid_medium("fire", {-1, -1, 0}, {1, 1, 2}, {3, 5, 16}, std::vector<float>(240, 1), 0, 0)};
  s.media[0].sigma_a = sigma_a;
  s.media[0].linear_interpolation = false;
  s.media[0].temperatures = TemperatureScale{-100, 2};
  s.media[0].emission = constant_spectrum(3);
  s.shapes = {free_volume("fire")};
  auto& grid = std::get<UniformGridMedium>(s.media[0].kind);
  grid.temperature.assign(240, 1900);  // 4000 K
  const Spectrum le = 3 * blackbody_emission(4000);
  const auto expected = [&](auto layer) {
    std::vector<Expected> e;
    for (int c = 0; c < channel_count; ++c) {
      const double radiance = layer(static_cast<double>(sigma_a[c])) * static_cast<double>(le[c]);
      e.push_back({radiance, 1e-3 * radiance});  // of the table of colours
    }
    return e;
  };
  all.push_back({"black_body", s, expected([](double sigma) { return 1 - std::exp(-2 * sigma); }), hotter});
  grid.strength.assign(240, 0);
  std::fill(grid.strength.begin() + 120, grid.strength.end(), 2.0f);
  all.push_back({"black_body_behind_an_absorber", s,
                 expected([](double sigma) { return 2 * std::exp(-sigma) * (1 - std::exp(-sigma)); }), dimmer});
}

// A cell that absorbs and emits, each channel in its own way, before a sky of radiance 1.
void add_rgb_cell(std::vector<Case>& all) {
  const std::array<float, 3> sigma_a{0.2f, 0.5f, 0.8f}, le{0.01f, 0.002f, 0.005f};
  SceneDescription s = needle_scene({0.1, 0.2, -5});
  s.lights = {sky(1)};
  s.media = {homogeneous_medium("colours", 2, 2)};
  s.media[0].linear_interpolation = false;
  s.media[0].emission = constant_spectrum(3);
  s.media[0].kind = RgbGridMedium{{1, 1, 1}, {-1, -1, 0},           {1, 1, 1}, {sigma_a.begin(), sigma_a.end()},
                                  {0, 0, 0}, {le.begin(), le.end()}};
  s.shapes = {free_volume("colours")};
  std::vector<Expected> expected;
  for (std::size_t c = 0; c < 3; ++c) {
    const double passed = std::exp(-2 * static_cast<double>(sigma_a[c]));
    expected.push_back({passed + (1 - passed) * 3 * 106.856895 * static_cast<double>(le[c]), 1e-5});
  }
  all.push_back({"rgb_cell", s, expected, {"channels_exchanged", [](SceneDescription& scene) {
                                             auto& grid = std::get<RgbGridMedium>(scene.media[0].kind);
                                             std::swap(grid.sigma_a[0], grid.sigma_a[1]);
                                           }}});
}

// Uniform surroundings and no absorption: radiance 1 everywhere, whatever stands there.
void add_furnace(std::vector<Case>& all) {
  std::vector<float> density(6 * 5 * 4);
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = static_cast<float>((i * 7) % 5) / 4;
  SceneDescription s = needle_scene({0, 0, -3});
  s.integrator.max_depth = 100000;
  s.media = {homogeneous_medium("ball", 0, 2), grid_medium("grid", {-1, -1, -1}, {1, 1, 1}, {6, 5, 4}, density, 0, 3)};
  set_phase(s.media[1], "henyey_greenstein", {0.7f});
  s.shapes = {sphere_shape({0.3, 0, 0}, 0.8, "ball"), free_volume("grid"), square_facing_y({0, -1.5, 0}, 5, 1)};
  s.lights = {sky(1)};
  all.push_back({"20_furnace", s, {{1, 1e-5}}, absorption});
  s.media[1].sigma_s = Spectrum{{1, 2, 4}};
  all.push_back({"20_chromatic_furnace", s, {{1, 1e-5}, {1, 1e-5}, {1, 1e-5}}, absorption});
}

}  // namespace

std::vector<Case> transport_cases() {
  std::vector<Case> all;
  add_slabs(all);
  add_half_spaces(all);
  add_point_sources(all);
  add_single_scattering(all);
  add_absorption_and_emission(all);
  add_black_bodies(all);
  add_rgb_cell(all);
  add_furnace(all);
  return all;
}

}  // namespace brume
