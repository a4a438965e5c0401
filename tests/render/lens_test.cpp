// Depth of field: which share of a thin lens sees what is out of focus is geometry, and every integrator is held to it.
// The faults this catches: a lens that is square or denser towards its middle; a focal distance, or a depth, along the
// ray in place of the axis; places on the lens that depend on the place in the pixel; media as they are at the lens's
// middle; a lens that the camera's scale leaves as it is. Faulty lenses are planted as pinhole cameras, one at each of
// many places of such a lens: the mean of their pictures is the lens's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "kernel/scalar.h"
#include "render/scenes.h"

namespace brume {
namespace {

constexpr double radius = 0.5, focal_distance = 4;
constexpr double slope = 0.75;                  // the pixel's ray through the middle of the lens is (slope, 0, 1) ...
const Vector3 focus{3, 0, 4};                   // ... and meets the focal plane here,
constexpr double focal_distance_by_rays = 3.2;  // as it would a plane at this distance, measured along it
constexpr int samples = 60000;

// A pixel that looks through the lens at `focus`.
SceneDescription lens_scene(const char* integrator = "classic") {
  SceneDescription s = needle_scene();
  s.camera.fov = 90;
  s.camera.screen_window = {slope - 1e-9, slope + 1e-9, -1e-9, 1e-9};
  s.camera.lens_radius = radius;
  s.camera.focal_distance = focal_distance;
  s.integrator.name = integrator;
  return s;
}

double mean(const SceneDescription& scene) { return static_cast<double>(radiance(scene, samples)); }

// Of a share of samples that are 1 where all others are 0.
double standard_error(double share) { return std::sqrt(share * (1 - share) / samples); }

void expect_share(double found, double expected, const std::string& what) {
  EXPECT_NEAR(found, expected, 4 * standard_error(expected) + 1e-5) << what;
}
void expect_rejected(double found, double expected) {
  EXPECT_GT(std::abs(found - expected), 8 * standard_error(expected) + 1e-5);
}

// The share of a disk of radius 1 in which x < h: what a chord leaves of it.
double share_below(double h) {
  h = std::clamp(h, -1.0, 1.0);
  return 1 - (std::acos(h) - h * std::sqrt(1 - h * h)) / std::numbers::pi;
}

// How far apart the rays are at a distance, as a share of what they are at the lens; negative beyond the focus.
double narrowing(double distance) { return 1 - distance / focal_distance; }

struct Place {
  double x, y;
};
using Lens = Place (*)(double u, double v);
Place even_lens(double u, double v) {
  return {std::sqrt(u) * std::cos(2 * std::numbers::pi * v), std::sqrt(u) * std::sin(2 * std::numbers::pi * v)};
}
Place dense_lens(double u, double v) { return even_lens(u * u, v); }
Place square_lens(double u, double v) { return {2 * u - 1, 2 * v - 1}; }

using Focus = Vector3 (*)(double u, double v);
Vector3 one_focus(double, double) { return focus; }

// What pinholes see that are spread over a lens and look at their focus.
double mean_of_pinholes(SceneDescription scene, Lens lens, Focus focus_of = one_focus) {
  constexpr int n = 32;
  scene.camera = {};
  scene.camera.fov = 1e-7;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double u = (i + 0.5) / n, v = (k + 0.5) / n;
      const Place place = lens(u, v);
      scene.camera.world_from_camera =
          inverse(look_at({radius * place.x, radius * place.y, 0}, focus_of(u, v), {0, 1, 0}));
      sum += static_cast<double>(radiance(scene));
    }
  return sum / (n * n);
}
constexpr double pinhole_error = 0.01;

// A disk of radiance 1 about the ray through the middle of the lens.
ShapeDescription bright_disk(double distance, double disk_radius) {
  ShapeDescription s;
  s.kind = DiskShape{disk_radius};
  s.world_from_object = translate({slope * distance, 0, distance});
  s.material = DiffuseMaterial{};
  s.light = AreaLight{constant_spectrum(1), true};
  return s;
}

// A black plate before the sky, from x on, which a chord of the lens at h of its radius sees end there.
void add_edge(SceneDescription& s, double distance, double h) {
  const double x = slope * distance + h * radius * std::abs(narrowing(distance));
  s.lights = {sky(1)};
  s.shapes = {square_facing_z({x + 100, 0, distance}, 100, 0)};
}

class Lenses : public testing::TestWithParam<const char*> {};

TEST_P(Lenses, APointInTheFocalPlaneIsSharp) {
  SceneDescription s = lens_scene(GetParam());
  s.shapes = {bright_disk(focal_distance, 1e-3)};
  EXPECT_EQ(mean(s), 1);
  s.camera.focal_distance = focal_distance_by_rays;  // the twin
  EXPECT_LT(mean(s), 0.01);
}

TEST_P(Lenses, AnEdgeOutOfFocusIsSeenPastAChordOfTheLens) {
  for (const double distance : {2.0, 5.5})
    for (const double h : {-0.5, 0.0, 0.7}) {
      SceneDescription s = lens_scene(GetParam());
      add_edge(s, distance, h);
      expect_share(mean(s), share_below(h), std::to_string(distance) + ", " + std::to_string(h));
    }
}

TEST_P(Lenses, ADiskOutOfFocusIsSeenByTheMiddleOfTheLens) {
  for (const double distance : {2.0, 5.5})
    for (const double share : {0.1, 0.5}) {
      SceneDescription s = lens_scene(GetParam());
      s.shapes = {bright_disk(distance, std::sqrt(share) * radius * std::abs(narrowing(distance)))};
      expect_share(mean(s), share, std::to_string(distance) + ", " + std::to_string(share));
    }
}

TEST(LensesTwin, ASquareOrADenseLensIsRejected) {
  SceneDescription edge = lens_scene(), disk = lens_scene();
  add_edge(edge, 2, -0.5);
  EXPECT_NEAR(mean_of_pinholes(edge, even_lens), share_below(-0.5), pinhole_error);
  expect_rejected(mean_of_pinholes(edge, square_lens), share_below(-0.5));
  expect_rejected(mean_of_pinholes(edge, dense_lens), share_below(-0.5));
  disk.shapes = {bright_disk(2, std::sqrt(0.1) * radius * narrowing(2))};
  EXPECT_NEAR(mean_of_pinholes(disk, even_lens), 0.1, pinhole_error);
  expect_rejected(mean_of_pinholes(disk, square_lens), 0.1);
  expect_rejected(mean_of_pinholes(disk, dense_lens), 0.1);
}

// A pixel so wide that an edge is as much out of its place as it is out of focus: with x on the lens and t in the
// pixel, both from -1 to 1, the plate is missed where x + t < h.
constexpr double wide_h = 1, wide_distance = 2;
const double half_width = radius * narrowing(wide_distance) / wide_distance;

SceneDescription wide_pixel(const char* integrator, SamplerDescription::Kind sampler) {
  SceneDescription s = lens_scene(integrator);
  s.camera.screen_window = {-half_width, half_width, -half_width, half_width};
  s.sampler = {sampler, samples};
  s.lights = {sky(1)};
  s.shapes = {square_facing_z({100 + wide_h * radius * narrowing(wide_distance), 0, wide_distance}, 100, 0)};
  return s;
}

double share_of_wide_pixel() {
  constexpr int n = 10000;
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += share_below(wide_h - (2 * (i + 0.5) / n - 1));
  return sum / n;
}

TEST_P(Lenses, PlacesOnTheLensDoNotDependOnPlacesInThePixel) {
  for (const auto sampler : {SamplerDescription::Kind::independent, SamplerDescription::Kind::zsobol})
    expect_share(mean(wide_pixel(GetParam(), sampler)), share_of_wide_pixel(), "");
}

TEST(LensesTwin, PlacesThatAreThoseInThePixelAreRejected) {
  const SceneDescription s = wide_pixel("classic", SamplerDescription::Kind::independent);
  const auto place = [](double u, double v) {
    float x, y;
    kernel::disk_point(static_cast<float>(u), static_cast<float>(v), x, y);
    return Place{static_cast<double>(x), static_cast<double>(y)};
  };
  expect_rejected(mean_of_pinholes(s, place,
                                   [](double u, double v) {
                                     return Vector3{focal_distance * half_width * (2 * u - 1),
                                                    focal_distance * half_width * (2 * v - 1), focal_distance};
                                   }),
                  share_of_wide_pixel());
}

// A lens that stands partly in fog, with a focus so far away that its rays are parallel: those from x > h of its radius
// begin in the fog and cross 2 units of it, and no other ray meets it. Fog of boxes is found by arithmetic; that in a
// cylinder elsewhere makes Embree find it in the box too.
enum class Fog { box, boundary, grid };

SceneDescription lens_in_fog(const char* integrator, Fog fog, double h) {
  SceneDescription s = lens_scene(integrator);
  s.camera.screen_window = {-1e-9, 1e-9, -1e-9, 1e-9};
  s.camera.focal_distance = 1e9;
  s.camera.medium = h < 0 && fog != Fog::grid ? "fog" : "";
  s.lights = {sky(1)};
  const Vector3 lo{h * radius, -10, -1}, hi{10, 10, 2};
  s.media = {fog == Fog::grid ? grid_medium("fog", lo, hi, {2, 2, 2}, std::vector<float>(8, 1), 1, 0)
                              : homogeneous_medium("fog", 1, 0)};
  s.media[0].linear_interpolation = false;  // it would fade at the ends
  s.shapes = {fog == Fog::grid ? free_volume("fog") : box_shape(lo, hi, "fog")};
  if (fog == Fog::boundary) {
    s.shapes.push_back(sphere_shape({0, 0, 0}, 1, "fog"));
    s.shapes.back().kind = CylinderShape{1, -1, 1, 360, true};
    s.shapes.back().world_from_object = translate({0, 50, 0});
  }
  return s;
}

TEST_P(Lenses, MediaAreThoseAtThePlaceOnTheLens) {
  for (const Fog fog : {Fog::box, Fog::boundary, Fog::grid})
    for (const double h : {-0.5, 0.5}) {
      const double expected = share_below(h) + (1 - share_below(h)) * std::exp(-2.0);
      expect_share(mean(lens_in_fog(GetParam(), fog, h)), expected, std::to_string(h));
      // The twin: what is at the middle of the lens is at all of it.
      expect_rejected(mean(lens_in_fog(GetParam(), fog, h < 0 ? -2 : 2)), expected);
    }
}

TEST_P(Lenses, DepthIsAlongTheAxis) {
  SceneDescription s = lens_scene(GetParam());
  s.lights = {sky(1)};
  s.shapes = {square_facing_z({0, 0, 6}, 50, 0.5f)};
  EXPECT_NEAR(render_film(s, 64).image().depth[0], 6, 1e-5);
  // The twin: the axis of a camera that is turned towards the plate is the ray.
  s.camera.world_from_camera = inverse(look_at({0, 0, 0}, focus, {0, 1, 0}));
  s.camera.screen_window = {-1e-9, 1e-9, -1e-9, 1e-9};
  EXPECT_GT(render_film(s, 64).image().depth[0], 6.5);
}

TEST_P(Lenses, TheCamerasScaleIsTheLenssToo) {
  SceneDescription s = lens_scene(GetParam()), scaled = s;
  scaled.camera.world_from_camera = scale({2, 2, 2});
  scaled.camera.lens_radius = radius / 2;
  scaled.camera.focal_distance = focal_distance / 2;
  add_edge(s, 2, 0.3);
  add_edge(scaled, 2, 0.3);
  EXPECT_EQ(mean(scaled), mean(s));
  scaled.camera.lens_radius = radius;  // the twins
  EXPECT_NE(mean(scaled), mean(s));
  scaled.camera.lens_radius = radius / 2;
  scaled.camera.focal_distance = focal_distance;
  EXPECT_NE(mean(scaled), mean(s));
}

INSTANTIATE_TEST_SUITE_P(Integrators, Lenses, testing::Values("classic", "reference", "volpath"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace brume
