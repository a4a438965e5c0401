// Light through portals: solid angles, form factors of windows, what is seen by who looks out, and light that fog
// scatters, in all integrators.
#include "render/portal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "compile/compile.h"
#include "image/image.h"
#include "image/temporary_folder.h"
#include "kernel/statistics.h"
#include "render/estimates.h"
#include "render/lights.h"

namespace brume {
namespace {

constexpr double pi = std::numbers::pi;

using Corners = std::array<Vector3, 4>;

// The rectangle from (x0, y0, z) to (x1, y1, z), out of which one looks along -z.
Corners window(double x0, double y0, double x1, double y1, double z) {
  return {{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}};
}

// Out of which one looks along the other way.
Corners turned_round(const Corners& p) { return {p[0], p[3], p[2], p[1]}; }

LightDescription light_through(const Corners& portal, const std::string& image = "") {
  InfiniteLight light{constant_spectrum(1), image, rotate(30, {1, 2, 3}), 0};
  light.portal = portal;
  return {light, {}};
}

CompiledScene compiled(const SceneDescription& scene) {
  std::vector<Diagnostic> warnings;
  return compile(scene, 1, warnings);
}

CompiledPortal compiled_portal(const Corners& corners) {
  SceneDescription s = needle_scene();
  s.lights = {light_through(corners)};
  return compiled(s).portals[0];
}

// The integral over a part of the window in the plane z of value(direction) times the solid angle, as seen from p.
template <class Value>
double over_window(Vector3 p, double x0, double y0, double x1, double y1, double z, int steps, Value value) {
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const Vector3 to = Vector3{x0 + (x1 - x0) * (i + 0.5) / steps, y0 + (y1 - y0) * (j + 0.5) / steps, z} - p;
      const double distance = length(to);
      sum += value((1 / distance) * to) * std::abs(to.z) / (distance * distance * distance);
    }
  return sum * (x1 - x0) * (y1 - y0) / (steps * steps);
}

// Pearson's test of directions by the part of the window that they pass, from in front of it and from aside. The twin
// is uniform in area.
TEST(PortalViews, AreUniformInSolidAngle) {
  constexpr int parts = 8, n = 1000000;
  const CompiledPortal portal = compiled_portal(window(-1, -0.5, 1.5, 2, -1));
  for (const kernel::vec3 p : {kernel::vec3(0.1f, 0.2f, -0.7f), kernel::vec3(3, -2, 0.5f)}) {
    const Vector3 from{p.x, p.y, p.z};
    const PortalView view(portal, p);
    std::vector<double> chances, counts(parts * parts), by_area(parts * parts, 1.0 / (parts * parts));
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < parts; ++j) {
        const double x = -1 + 2.5 * i / parts, y = -0.5 + 2.5 * j / parts, edge = 2.5 / parts;
        const double part = over_window(from, x, y, x + edge, y + edge, -1, 200, [](Vector3) { return 1; });
        chances.push_back(part / view.solid_angle());
      }
    double total = 0;
    for (const double c : chances) total += c;
    EXPECT_NEAR(total, 1, 1e-5);
    std::mt19937 random(5);
    const auto number = [&] { return static_cast<double>(random()) * 0x1p-32; };
    for (int i = 0; i < n; ++i) {
      const double u = number(), v = number();
      const kernel::vec3 d = view.direction(u, v), at = p + ((-1 - p.z) / d.z) * d;
      const int x = static_cast<int>((at.x + 1) / 2.5f * parts), y = static_cast<int>((at.y + 0.5f) / 2.5f * parts);
      counts[static_cast<std::size_t>(std::clamp(x, 0, parts - 1) * parts + std::clamp(y, 0, parts - 1))] += 1;
    }
    const double freedom = parts * parts - 1;
    EXPECT_GT(chi_squared_p_value(chi_squared(counts, chances, n), freedom), sidak(0.01, 2));
    EXPECT_GT(noncentrality(by_area, chances, n), 100);
    EXPECT_LT(chi_squared_p_value(chi_squared(counts, by_area, n), freedom), 1e-6);
  }
}

// Where a window is small, near its plane or touched, and from behind.
TEST(PortalViews, HaveTheirLimits) {
  const CompiledPortal portal = compiled_portal(window(-1, -1, 1, 1, -1));
  const auto solid_angle = [&](kernel::vec3 p) { return PortalView(portal, p).solid_angle(); };
  EXPECT_NEAR(solid_angle({0, 0, 9999}), 4e-8, 1e-12);
  EXPECT_NEAR(solid_angle({0, 0, -1 + 0x1p-20f}), 2 * pi, 1e-5);
  EXPECT_NEAR(solid_angle({5, 0, -1 + 0x1p-20f}), 0, 1e-6);
  EXPECT_NEAR(solid_angle({0, 0, 0}), 4 * pi / 6, 1e-12);  // a face of the cube about the point
  EXPECT_EQ(solid_angle({0, 0, -1}), 0);
  EXPECT_EQ(solid_angle({0, 0, -2}), 0);
}

// Samples have the density of their rays, all of the portal is found, and nothing else.
TEST(PortalSamples, HaveTheDensityOfTheirRays) {
  SceneDescription s = needle_scene();
  s.lights = {light_through(window(-1, -0.5, 1.5, 2, -1))};
  const CompiledScene c = compiled(s);
  const kernel::vec3 p(0.3f, -0.8f, 0.2f);
  const double solid_angle = PortalView(c.portals[0], p).solid_angle();
  for (int i = 0; i < 1000; ++i) {
    RandomStream random(c, 0, 0, i);
    const LightSample sample = sample_light(c, c.lights[0], p, nullptr, random);
    EXPECT_NEAR(static_cast<double>(sample.pdf) * solid_angle, 1, 1e-5);
    EXPECT_EQ(light_pdf(c, c.lights[0], sample.ray, nullptr, {}), sample.pdf);
    EXPECT_EQ(environment_radiance(c, c.lights[0], sample.ray), constant_spectrum(1));
  }
  const Ray beside{p, normalize(kernel::vec3(-2, 0, -1)), far_away}, back{p, {0, 0, 1}, far_away};
  for (const Ray& ray : {beside, back}) {
    EXPECT_EQ(light_pdf(c, c.lights[0], ray, nullptr, {}), 0);
    EXPECT_TRUE(is_zero(environment_radiance(c, c.lights[0], ray)));
  }
}

// A window sends in what a surface of its area and radiance would, and the whole sky at most.
TEST(PortalSamples, AreChosenByThePowerThatComesThrough) {
  SceneDescription s = needle_scene();
  s.shapes = {square_facing_z({0, 0, 0}, 5, 0.5f)};
  s.lights = {light_through(window(0, 0, 2, 3, -1)), point_light({0, 0, -1}, 1)};
  const double share = 6 * pi / (6 * pi + 4 * pi);
  EXPECT_NEAR(static_cast<double>(compiled(s).lights[0].chance), 0.05 + 0.9 * share, 1e-6);
  s.lights = {light_through(window(-1e6, -1e6, 1e6, 1e6, -1)), sky(1)};
  EXPECT_NEAR(static_cast<double>(compiled(s).lights[0].chance), 0.5, 1e-6);
}

class Portals : public ::testing::TestWithParam<const char*> {
 protected:
  // A grey square at z = 0, seen from z = -0.5, in the light of a window behind the camera.
  static SceneDescription lit_square(const LightDescription& light) {
    SceneDescription s = needle_scene({0, 0, -0.5});
    s.integrator.name = GetParam();
    s.integrator.max_depth = 1;
    s.shapes = {square_facing_z({0, 0, 0}, 0.5, 0.5f)};
    s.lights = {light};
    return s;
  }

  // Random pixels, so that no symmetry hides a fault, or white ones.
  std::string write(int width, int height, bool white) {
    std::mt19937 random(7);
    Image image{width, height, {}};
    for (int i = 0; i < 3 * width * height; ++i)
      image.pixels.push_back(white ? 1 : std::pow(static_cast<float>(random() >> 8) * 0x1p-24f, 4.0f));
    const std::string path = folder_.file("sky" + std::to_string(files_++) + ".pfm");
    write_image(path, image, {});
    return path;
  }

  TemporaryFolder folder_;
  int files_ = 0;
};
INSTANTIATE_TEST_SUITE_P(Integrators, Portals, ::testing::Values("classic", "reference", "volpath"),
                         [](const auto& test) { return std::string(test.param); });

// The form factor of the rectangle from (0, 0) to (x, y) for a facing surface at the distance 1 below its corner
// (0, 0), with the sign of x y. Source: J. R. Howell, "A Catalog of Radiation Heat Transfer Configuration Factors",
// B-3.
double corner_form_factor(double x, double y) {
  const double a = std::hypot(1, x), b = std::hypot(1, y);
  return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2 * pi);
}

TEST_P(Portals, WindowsGiveTheirFormFactors) {
  const std::string white = write(8, 8, true);
  for (const std::string& image : {std::string(), white})
    for (const double left : {-0.6, 0.2}) {  // above the point, and aside
      const auto [x0, y0, x1, y1] = std::array{left, -0.6, left + 1.2, 0.6};
      const double expected = 0.5 * (corner_form_factor(x1, y1) - corner_form_factor(x0, y1) -
                                     corner_form_factor(x1, y0) + corner_form_factor(x0, y0));
      expect_estimate(lit_square(light_through(window(x0, y0, x1, y1, -1), image)), expected, 0, 1e-3);
      expect_rejected(lit_square(light_through(window(x0, y0, x1, 1.05 * y1, -1), image)), expected);
      const Corners turned = turned_round(window(x0, y0, x1, y1, -1));
      EXPECT_EQ(estimate(lit_square(light_through(turned, image)), 10000).mean, 0);
    }
}

// What a window lets in of an image, by quadrature over the window.
TEST_P(Portals, ImagesShineThroughThem) {
  for (const int width : {16, 32}) {
    const std::string image = write(width, 16, false);
    SceneDescription s = lit_square(light_through(window(-0.4, -0.3, 1.5, 1.1, -1), image));
    const CompiledScene c = compiled(s);
    const double expected =
        0.5 / pi * over_window({}, -0.4, -0.3, 1.5, 1.1, -1, 2000, [&](Vector3 d) {
          const kernel::vec3 direction(static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z));
          return -d.z * static_cast<double>(environment_radiance(c, c.lights[0], {{0, 0, 0}, direction})[0]);
        });
    expect_estimate(s, expected, 1e-3 * expected, 2e-3);
    std::get<InfiniteLight>(s.lights[0].kind).world_from_light = rotate(120, {1, 2, 3});  // the image, turned
    expect_rejected(s, expected);
  }
}

// Who looks out sees the image within the window and black around it, and who stands outside sees nothing of it.
TEST_P(Portals, AreWindowsToTheOutside) {
  const std::string image = write(16, 16, false);
  const Corners outwards = turned_round(window(-1, -1, 1, 1, 2));  // along +z
  const auto seen = [&](const LightDescription& light, Vector3 eye) {
    SceneDescription s = needle_scene(eye);
    s.integrator.name = GetParam();
    s.lights = {light};
    return radiance(s);
  };
  LightDescription open = light_through(outwards, image);
  std::get<InfiniteLight>(open.kind).portal.reset();
  const float sky = seen(open, {0, 0, 0});
  EXPECT_GT(sky, 0);
  for (const double x : {-0.99, 0.0, 0.99}) EXPECT_EQ(seen(light_through(outwards, image), {x, 0.5, 0}), sky);
  for (const Vector3 beside : {Vector3{1.01, 0, 0}, {0, -1.01, 0}, {0, 0, 2.5}})
    EXPECT_EQ(seen(light_through(outwards, image), beside), 0);
  EXPECT_EQ(seen(light_through(turned_round(outwards), image), {0, 0, 0}), 0);
}

// Fog in the box [-0.5, 0.5]^2 x [0, 1] scatters once what comes through a window at its side, by quadrature along the
// camera's ray and over the window. The twin's window is a little nearer.
TEST_P(Portals, FogScattersWhatComesThrough) {
  constexpr double sigma_s = 1.2, sigma_t = 1.5, g = 0.6;
  SceneDescription s = needle_scene({0, 0, -0.5});
  s.integrator.name = GetParam();
  s.integrator.max_depth = 1;
  s.media = {homogeneous_medium("fog", static_cast<float>(sigma_t - sigma_s), static_cast<float>(sigma_s))};
  set_phase(s.media[0], "henyey_greenstein", {static_cast<float>(g)});
  s.shapes = {box_shape({-0.5, -0.5, 0}, {0.5, 0.5, 1}, "fog")};
  // Out of it one looks along -x. What over_window calls x, y and z are y, z and x here.
  const auto side_window = [](double x) {
    return Corners{{{x, -0.4, 0.1}, {x, 0.6, 0.1}, {x, 0.6, 0.9}, {x, -0.4, 0.9}}};
  };
  s.lights = {light_through(side_window(-0.7))};
  constexpr int steps = 64;
  double expected = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps;
    const auto scattered = [&](Vector3 d) {
      const double along = d.y, across = std::max(std::abs(d.z), std::abs(d.x));  // the camera's ray, and the others
      const double out = std::min(0.5 / across, along > 0 ? (1 - t) / along : t / -along);
      const double phase = (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * along, 1.5));
      return phase * std::exp(-sigma_t * out);
    };
    expected +=
        sigma_s * std::exp(-sigma_t * t) / steps * over_window({0, t, 0}, -0.4, 0.1, 0.6, 0.9, -0.7, 100, scattered);
  }
  expect_estimate(s, expected, 1e-3 * expected, 1e-3);
  s.lights = {light_through(side_window(-0.66))};
  expect_rejected(s, expected);
}

}  // namespace
}  // namespace brume
