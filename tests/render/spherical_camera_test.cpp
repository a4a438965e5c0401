// Cameras that show all directions. The faults this catches: axes exchanged or a direction of turning reversed, a map
// taken for the other, pixels off by a half, and places of the filter beyond the picture's edge that see what is not
// beside it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "image/image.h"
#include "image/temporary_folder.h"
#include "render/camera_ray.h"
#include "render/scenes.h"

namespace brume {
namespace {

constexpr SphereMap maps[] = {SphereMap::equal_area, SphereMap::equirectangular};

CompiledCamera camera_of(SphereMap map) {
  CompiledCamera camera;
  camera.sphere_map = map;
  camera.dx = camera.dy = 1;  // pictures of one pixel
  return camera;
}

kernel::vec3 direction(SphereMap map, double u, double v) {
  return camera_ray(camera_of(map), u, v, 0.5f, 0.5f).direction;
}

void expect_direction(kernel::vec3 found, float x, float y, float z) {
  EXPECT_NEAR(found.x, x, 1e-6);
  EXPECT_NEAR(found.y, y, 1e-6);
  EXPECT_NEAR(found.z, z, 1e-6);
}

TEST(SphericalCamera, LooksWhereTheMapsSay) {
  expect_direction(direction(SphereMap::equirectangular, 0.25, 0.5), 0, 0, 1);
  expect_direction(direction(SphereMap::equirectangular, 0, 0.5), 1, 0, 0);
  expect_direction(direction(SphereMap::equirectangular, 0.7, 0), 0, 1, 0);
  expect_direction(direction(SphereMap::equal_area, 0.5, 0.5), 0, 1, 0);
  expect_direction(direction(SphereMap::equal_area, 1, 0.5), 1, 0, 0);
  expect_direction(direction(SphereMap::equal_area, 0.5, 1), 0, 0, 1);
  expect_direction(direction(SphereMap::equal_area, 0, 0), 0, -1, 0);
}

// Across the edges neighbours stay neighbours.
TEST(SphericalCamera, TheMapsGoOnBeyondTheirEdges) {
  constexpr double step = 1e-4;
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const double along = std::uniform_real_distribution(0.0, 1.0)(random);
    const auto at = [&](SphereMap map, double out) {
      const double across = i % 2 == 0 ? -out : 1 + out;
      return i % 4 < 2 ? direction(map, across, along) : direction(map, along, across);
    };
    for (const SphereMap map : maps) EXPECT_LT(length(at(map, -step) - at(map, step)), 15 * step);
  }
}

// The solid angle of a piece of the equal-area map is 4 pi times its area, there too. The twin is the other map.
TEST(SphericalCamera, BeyondTheEdgesAreasAreEqualToo) {
  constexpr double h = 1e-6;
  std::mt19937 random(1);
  std::uniform_real_distribution coordinate(-0.25, 1.25);
  int wrong[2] = {};
  for (int i = 0; i < 10000; ++i) {
    const SquarePoint p{coordinate(random), coordinate(random)};
    for (const SphereMap map : maps) {
      const auto at = [&](double u, double v) { return map_direction(map, {u, v}); };
      const Vector3 du = at(p.u + h, p.v) - at(p.u - h, p.v), dv = at(p.u, p.v + h) - at(p.u, p.v - h);
      wrong[static_cast<int>(map)] += std::abs(length(cross(du, dv)) / (4 * h * h) - 4 * std::numbers::pi) > 0.01;
    }
  }
  EXPECT_LE(wrong[0], 100);  // on creases of the map
  EXPECT_GT(wrong[1], 9000);
}

// The picture of an image around the scene is that image. The twins are the other map's camera, and one turned.
TEST(SphericalCamera, ShowsTheImageAroundIt) {
  const TemporaryFolder folder;
  for (const SphereMap map : maps) {
    const int height = 8, width = map == SphereMap::equal_area ? 8 : 16;
    Image image;
    image.width = width;
    image.height = height;
    for (int i = 0; i < 3 * width * height; ++i) image.pixels.push_back(static_cast<float>(i + 1));
    write_image(folder.file("sky.pfm"), image, {});
    SceneDescription scene = needle_scene();
    InfiniteLight sky{constant_spectrum(1), folder.file("sky.pfm")};
    sky.world_from_light.m = {{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}};
    scene.lights.push_back({sky, {}});
    scene.film.width = width;
    scene.film.height = height;
    scene.filter.kind = PixelFilter::Kind::box;
    scene.filter.x_radius = scene.filter.y_radius = 0.01f;
    for (const char* integrator : {"classic", "reference", "volpath"}) {
      scene.integrator.name = integrator;
      scene.camera = {};
      scene.camera.sphere_map = map;
      EXPECT_EQ(render_film(scene, 1).image().pixels, image.pixels) << integrator;
      scene.camera.world_from_camera = rotate(90, {0, 1, 0});
      EXPECT_NE(render_film(scene, 1).image().pixels, image.pixels);
      scene.camera = {};
      scene.camera.sphere_map = map == SphereMap::equal_area ? SphereMap::equirectangular : SphereMap::equal_area;
      EXPECT_NE(render_film(scene, 1).image().pixels, image.pixels);
    }
  }
}

// Around the camera, at a distance of 3.
TEST(SphericalCamera, DepthIsDistance) {
  for (const char* integrator : {"classic", "reference", "volpath"}) {
    SceneDescription scene = needle_scene();
    scene.integrator.name = integrator;
    scene.film.width = scene.film.height = 4;
    scene.camera.sphere_map = SphereMap::equal_area;
    scene.shapes.push_back(sphere_shape({0, 0, 0}, 3, ""));
    scene.shapes.back().material = DiffuseMaterial{};
    for (const float depth : render_film(scene, 2).image().depth) EXPECT_NEAR(depth, 3, 1e-4) << integrator;
    scene.camera.sphere_map.reset();  // the twin: along an axis
    scene.camera.fov = 90;
    scene.camera.screen_window = {};
    EXPECT_LT(render_film(scene, 2).image().depth.front(), 2.8f);
  }
}

}  // namespace
}  // namespace brume
