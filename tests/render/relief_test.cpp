// Bump maps and normal maps: the normals of surfaces that are truly displaced, by numerical differentiation, and those
// that a colour stands for; then in all integrators.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/diagnostics.h"
#include "image/image.h"
#include "image/temporary_folder.h"
#include "intersect/intersector.h"
#include "render/estimates.h"
#include "render/surface_cases.h"

namespace brume {
namespace {

constexpr double amplitude = 0.4;
using Normal = std::function<Vector3(const PlacedSurface&, double u, double v)>;

// What a picture of 2 x 2 pixels is between their centres, which lie at s and t of 1/4 and 3/4.
double ramps(double s, double t) {
  const double x = 2 * s - 0.5, y = 2 * t - 0.5;
  return amplitude * ((1 - y) * ((1 - x) * 0.1 + x * 0.9) + y * ((1 - x) * 0.4 + x * 0.2));
}

class Reliefs : public ::testing::Test {
 protected:
  void write(const Image& image) {
    ImageMetadata metadata;
    metadata.half = false;
    write_image(path_, image, metadata);
  }

  // A texture of which ramps(s, t) is the value, for u and v from 0 to 3.
  TextureDescription ramps_texture() {
    Image image{2, 2, {}};
    for (const float value : {0.4f, 0.2f, 0.1f, 0.9f}) image.pixels.insert(image.pixels.end(), 3, value);
    write(image);
    ImageTexture texture;
    texture.filename = path_;
    texture.scale = amplitude;
    texture.mapping.u_scale = texture.mapping.v_scale = 1.0 / 6;
    texture.mapping.u_offset = texture.mapping.v_offset = 0.25;
    return {"ramps", true, texture, {}};
  }

  Relief normal_map(const Spectrum& colour) {
    write({1, 1, {colour[0], colour[1], colour[2]}});
    return {-1, path_};
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("image.exr");
};

class ReliefOnShapes : public Reliefs, public ::testing::WithParamInterface<Surface> {
 protected:
  // How far shading normals are from what is expected, at most, over all ways to place the surface.
  double worst(const TextureDescription& texture, const Relief& relief, const Normal& expected) {
    std::mt19937 random(7);
    double result = 0;
    for (int way = 0; way < surface_ways; ++way) {
      const PlacedSurface placed = place_surface(GetParam(), way, DiffuseMaterial{}, texture, relief);
      const CompiledScene scene = compiled(placed.scene);
      const Intersector intersector(scene);
      for (int i = 0; i < 100; ++i) {
        const auto [u, v] = random_uv(GetParam(), random);
        const Vector3 n = placed.cross_normal(u, v);
        SurfaceHit hit;
        EXPECT_TRUE(intersector.nearest_surface({to_float(placed.point(u, v) + 0.02 * n), to_float(-n)}, hit));
        EXPECT_NEAR(length(to_double(hit.shading_normal)), 1, 1e-6);
        EXPECT_GT(dot(hit.normal, hit.shading_normal), 0);
        result = std::max(result, length(to_double(hit.shading_normal) - expected(placed, u, v)));
      }
    }
    return result;
  }
};

Vector3 outwards(const PlacedSurface& surface, double u, double v) {
  const Vector3 n = surface.cross_normal(u, v);
  return surface.against_cross ? -n : n;
}

// The displaced surface's normal, as if it passed through the point itself: a bump map leaves out how far that moves.
Normal displaced(const std::function<double(const PlacedSurface&, double u, double v)>& displacement) {
  return [=](const PlacedSurface& surface, double u, double v) {
    constexpr double step = 1e-4;
    const double here = displacement(surface, u, v);
    const auto at = [&](double a, double b) {
      return surface.point(a, b) + (displacement(surface, a, b) - here) * outwards(surface, a, b);
    };
    const Vector3 n = normalize(cross(at(u + step, v) - at(u - step, v), at(u, v + step) - at(u, v - step)));
    return surface.against_cross ? -n : n;
  };
}

// Catches bumps that are dents, that have u and v exchanged, or whose height is measured in the shape's own space.
TEST_P(ReliefOnShapes, BumpMapsTurnNormalsAsDisplacementsDo) {
  const auto value = [](double u, double v) { return ramps(0.25 + u / 6, 0.25 + v / 6); };
  const auto found = [&](const Normal& expected) { return worst(ramps_texture(), {0, ""}, expected); };
  EXPECT_LT(found(displaced([&](const PlacedSurface&, double u, double v) { return value(u, v); })), 1e-3);
  EXPECT_GT(found(displaced([&](const PlacedSurface&, double u, double v) { return -value(u, v); })), 0.02);
  EXPECT_GT(found(displaced([&](const PlacedSurface&, double u, double v) { return value(v, u); })), 0.02);
  EXPECT_GT(found(displaced([&](const PlacedSurface&, double u, double v) { return 1.2 * value(u, v); })), 0.004);
}

// A planar texture is looked up at places in the world. The twin looks it up at u and v.
TEST_P(ReliefOnShapes, BumpMapsFollowPlanarMappings) {
  TextureDescription texture = ramps_texture();
  auto& image = std::get<ImageTexture>(texture.kind);
  image.scale = 10 * amplitude;
  image.mapping = {true, 1, 1, 0.5, 0.5, {0.04, 0.01, 0}, {0, 0.03, -0.02}, Transform()};
  const auto found = [&](const Normal& expected) { return worst(texture, {0, ""}, expected); };
  EXPECT_LT(found(displaced([](const PlacedSurface& surface, double u, double v) {
              const Vector3 p = surface.point(u, v);
              return 10 * ramps(0.5 + 0.04 * p.x + 0.01 * p.y, 0.5 + 0.03 * p.y - 0.02 * p.z);
            })),
            4e-3);  // values of some units, in floats
  EXPECT_GT(found(displaced(
                [](const PlacedSurface&, double u, double v) { return 10 * ramps(0.5 + 0.04 * u, 0.5 + 0.03 * v); })),
            0.02);
}

TEST_P(ReliefOnShapes, ConstantDisplacementsChangeNothing) {
  const auto found = [&](const TextureDescription& texture) {
    const Relief relief{0, ""};
    const CompiledScene bumped = compiled(place_surface(GetParam(), 2, DiffuseMaterial{}, texture, relief).scene);
    const PlacedSurface plain = place_surface(GetParam(), 2, DiffuseMaterial{}, texture);
    const CompiledScene flat = compiled(plain.scene);
    const Intersector of_bumped(bumped), of_flat(flat);
    std::mt19937 random(7);
    float furthest = 0;
    for (int i = 0; i < 100; ++i) {
      const auto [u, v] = random_uv(GetParam(), random);
      const Vector3 n = plain.cross_normal(u, v);
      const Ray ray{to_float(plain.point(u, v) + 0.02 * n), to_float(-n)};
      SurfaceHit a, b;
      EXPECT_TRUE(of_bumped.nearest_surface(ray, a) && of_flat.nearest_surface(ray, b));
      furthest = std::max(furthest, length(a.shading_normal - b.shading_normal));
    }
    return furthest;
  };
  EXPECT_LT(found({"constant", true, ConstantTexture{constant_spectrum(3)}, {}}), 1e-6f);
  EXPECT_GT(found(ramps_texture()), 0.02f);
}

// Red is along u, green across it on the side of v, blue outwards. The twins have one of them turned over.
TEST_P(ReliefOnShapes, NormalMapsHoldNormals) {
  const TextureDescription none{"t", true, ConstantTexture{}, {}};
  const Vector3 local = normalize({0.3, -0.5, 0.7});
  const auto part = [](double x) { return static_cast<float>(0.5 * (x + 1)); };
  const Relief relief = normal_map({{part(local.x), part(local.y), part(local.z)}});
  const auto found = [&](double red, double green) {
    return worst(none, relief, [=](const PlacedSurface& surface, double u, double v) {
      constexpr double step = 1e-5;
      const Vector3 n = outwards(surface, u, v), p = surface.point(u, v);
      const Vector3 along_u = normalize(surface.point(u + step, v) - p);
      Vector3 across = cross(n, along_u);
      if (dot(across, surface.point(u, v + step) - p) < 0) across = -across;
      return red * local.x * along_u + green * local.y * across + local.z * n;
    });
  };
  EXPECT_LT(found(1, 1), 1e-3);
  EXPECT_GT(found(-1, 1), 0.1);
  EXPECT_GT(found(1, -1), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Shapes, ReliefOnShapes, ::testing::ValuesIn(surfaces()),
                         [](const auto& test) { return std::string(test.param.name); });

Vector3 shading_normal(const SceneDescription& s) {
  const CompiledScene scene = compiled(s);
  SurfaceHit hit;
  EXPECT_TRUE(Intersector(scene).nearest_surface({{0.3f, 0.1f, 3}, {0, 0, -1}}, hit));
  return to_double(hit.shading_normal);
}

// A square of width 2, over which u and v go from 0 to 1, with a slope of amplitude (0.8 - v) / 3 / 2 along u.
TEST_F(Reliefs, TiltSquares) {
  SceneDescription s = needle_scene();
  s.shapes = {square_facing_z({0, 0, 0}, 1, 0.5f)};
  s.shapes[0].relief = normal_map({{0.75f, 0.5f, static_cast<float>(0.5 + 0.25 * std::sqrt(3.0))}});  // 30 degrees
  EXPECT_LT(length(shading_normal(s) - Vector3{0.5, 0, std::sqrt(0.75)}), 1e-6);
  EXPECT_GT(length(shading_normal(s) - Vector3{0, 0.5, std::sqrt(0.75)}), 0.1);

  s.textures = {ramps_texture()};
  s.shapes[0].relief = {0, ""};
  const double u = 0.65, v = 0.55;  // ramps is amplitude (0.1 + 0.8 x + 0.3 y - y x), with x = u / 3, y = v / 3
  const double d_x = amplitude * (0.8 - v / 3) / 3 / 2, d_y = amplitude * (0.3 - u / 3) / 3 / 2;
  const Vector3 expected = normalize({-d_x, -d_y, 1}), reversed = normalize({d_x, d_y, 1});
  EXPECT_LT(length(shading_normal(s) - expected), 2e-4);
  EXPECT_GT(length(shading_normal(s) - reversed), 0.05);
}

// It would point inwards, or nowhere.
TEST_F(Reliefs, ThatTurnNormalsOverAreDropped) {
  SceneDescription s = needle_scene();
  s.shapes = {square_facing_z({0, 0, 0}, 1, 0.5f)};
  for (const Spectrum& colour : {Spectrum{{0.75f, 0.5f, 0.4f}}, {{0.5f, 0.5f, 0.5f}}}) {
    s.shapes[0].relief = normal_map(colour);
    EXPECT_EQ(shading_normal(s), (Vector3{0, 0, 1}));
  }
  s.shapes[0].relief = normal_map({{0.75f, 0.5f, 0.6f}});
  EXPECT_NE(shading_normal(s), (Vector3{0, 0, 1}));
}

// Where all of a triangle has one place in the texture, no direction is that of u.
TEST_F(Reliefs, DoNothingWithoutDirections) {
  SceneDescription s = needle_scene();
  s.textures = {ramps_texture()};
  s.shapes = {square_facing_z({0, 0, 0}, 1, 0.5f)};
  TriangleMeshShape triangle{{{-3, -3, 0}, {3, -3, 0}, {0, 3, 0}}, {{0, 1, 2}}, {{0, 1, 2}, {0, 1, 2}, {0, 1, 2}}};
  triangle.uv = {{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}};
  s.shapes[0].kind = triangle;
  s.shapes[0].relief = {0, ""};
  const Vector3 smooth = normalize({0, 1, 2});
  EXPECT_LT(length(shading_normal(s) - smooth), 1e-6);
  triangle.uv = {{0, 0}, {1, 0}, {0, 1}};
  s.shapes[0].kind = triangle;
  EXPECT_GT(length(shading_normal(s) - smooth), 0.001);
}

// The normal map 30 degrees towards +x, seen from behind, under a light from there: the cosine law about that normal.
// The twin has the map turned over.
TEST_F(Reliefs, AreSeenByAllIntegrators) {
  constexpr double reflectance = 0.6;
  const Vector3 to_light = normalize({-0.4, 0.3, -1}), normal{-0.5, 0, -std::sqrt(0.75)};
  const double expected = reflectance / std::numbers::pi * dot(to_light, normal);
  const auto blue = static_cast<float>(0.5 + 0.25 * std::sqrt(3.0));
  for (const char* integrator : {"classic", "reference", "volpath"}) {
    SceneDescription s = needle_scene({0.3, 0.1, -3});
    s.integrator.name = integrator;
    s.shapes = {square_facing_z({0, 0, 0}, 1, static_cast<float>(reflectance))};
    s.lights = {distant_light(to_light, 1)};
    s.shapes[0].relief = normal_map({{0.75f, 0.5f, blue}});
    expect_estimate(s, expected, 1e-5, 1e-3);
    s.shapes[0].relief = normal_map({{0.25f, 0.5f, blue}});
    expect_rejected(s, expected);
  }
}

TEST_F(Reliefs, FilesThatCannotBeReadAreErrorsThatNameThem) {
  SceneDescription s = needle_scene();
  s.shapes = {square_facing_z({0, 0, 0}, 1, 0.5f), square_facing_z({0, 0, 1}, 1, 0.5f)};
  for (ShapeDescription& shape : s.shapes) shape.relief = {-1, {folder_.file("none.png"), {"test.pbrt", 3, 1}}};
  try {
    compiled(s);
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_EQ(e.diagnostics().size(), 1u);
    const std::string what = e.what();
    EXPECT_TRUE(what.starts_with("test.pbrt:3:1: error: the image of the material's normal map: ")) << what;
    EXPECT_NE(what.find("none.png"), std::string::npos);
  }
}

}  // namespace
}  // namespace brume
