// Textures: exact look-ups in pictures without any symmetry, and textured surfaces in all integrators.
#include "intersect/textures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compile/compile.h"
#include "image/image.h"
#include "image/temporary_folder.h"
#include "render/estimates.h"
#include "render/surfaces.h"

namespace brume {
namespace {

// 3 x 2 pixels, each of its own colour: column in red, row from the top in green, their product and more in blue.
Spectrum colour(int column, int row) {
  return {{0.1f + 0.3f * static_cast<float>(column), 0.2f + 0.5f * static_cast<float>(row),
           0.05f + 0.1f * static_cast<float>(column * (row + 1))}};
}

void expect_near(const Spectrum& a, const Spectrum& b) {
  for (int c = 0; c < channel_count; ++c) EXPECT_NEAR(a[c], b[c], 2e-6f) << "channel " << c;
}

class Textures : public ::testing::Test {
 protected:
  Textures() {
    Image image{3, 2, {}};
    for (int row = 0; row < 2; ++row)
      for (int column = 0; column < 3; ++column)
        for (int c = 0; c < 3; ++c) image.pixels.push_back(colour(column, row)[c]);
    ImageMetadata metadata;
    metadata.half = false;
    write_image(path_, image, metadata);
    image_.filename = path_;
    image_.bilinear = false;
  }

  // Of the last of the textures, which is added.
  template <class Kind>
  Spectrum value(const Kind& kind, double u, double v, Vector3 p = {}, bool is_float = false) {
    SceneDescription s = needle_scene();
    s.textures = textures_;
    s.textures.push_back({"t", is_float, kind, {}});
    s.shapes = {square_facing_z({0, 0, 0}, 1, 0.5f)};
    std::get<DiffuseMaterial>(s.shapes[0].material).reflectance.texture = static_cast<int>(textures_.size());
    std::vector<Diagnostic> warnings;
    const CompiledScene c = compile(s, 1, warnings);
    SurfaceHit hit;
    hit.shape = 0;
    hit.uv = {static_cast<float>(u), static_cast<float>(v)};
    hit.position = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    const std::int32_t texture = c.materials[0].diffuse_texture;
    expect_near(MaterialAt(c, hit)->diffuse, texture_reflectance(c, texture, hit));
    return texture_value(c, texture, hit);
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("image.exr");
  ImageTexture image_;
  std::vector<TextureDescription> textures_;
};

// v = 0 is the lowest row, u = 0 the left column. Catches pictures that are mirrored, turned or upside down.
TEST_F(Textures, ImagesLieTheRightWayUp) {
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column)
      expect_near(value(image_, (column + 0.5) / 3, 1 - (row + 0.5) / 2), colour(column, row));
  expect_near(value(image_, 0.01, 0.01), colour(0, 1));
  expect_near(value(image_, 0.99, 0.99), colour(2, 0));
}

TEST_F(Textures, ImagesRepeatOrEndAsTheirWrapSays) {
  expect_near(value(image_, 5 + 0.5 / 3, -7 + 0.75), colour(0, 0));
  expect_near(value(image_, 1, 1), colour(0, 1));  // the next one begins
  image_.wrap = ImageTexture::Wrap::clamp;
  expect_near(value(image_, 1e6, 1e6), colour(2, 0));
  expect_near(value(image_, -1e6, -1e6), colour(0, 1));
  image_.wrap = ImageTexture::Wrap::black;
  expect_near(value(image_, 0.99, 0.99), colour(2, 0));
  expect_near(value(image_, 1.01, 0.99), {});
  expect_near(value(image_, 0.5, -0.01), {});
  expect_near(value(image_, INFINITY, NAN), colour(0, 1));  // as at 0
}

TEST_F(Textures, BilinearLookUpsMeetAtPixelsCentres) {
  image_.bilinear = true;
  expect_near(value(image_, 0.5, 0.75), colour(1, 0));
  // A quarter of the way from (0, 0) to (1, 0), and then half way down.
  const Spectrum upper = 0.75f * colour(0, 0) + 0.25f * colour(1, 0),
                 lower = 0.75f * colour(0, 1) + 0.25f * colour(1, 1);
  expect_near(value(image_, 0.75 / 3, 0.75), upper);
  expect_near(value(image_, 0.75 / 3, 0.5), 0.5f * upper + 0.5f * lower);
  // Across the edge, to the other side or to what is there.
  expect_near(value(image_, 0, 0.75), 0.5f * colour(0, 0) + 0.5f * colour(2, 0));
  expect_near(value(image_, 0.5, 1), 0.5f * colour(1, 0) + 0.5f * colour(1, 1));
  image_.wrap = ImageTexture::Wrap::clamp;
  expect_near(value(image_, 0, 0.75), colour(0, 0));
  image_.wrap = ImageTexture::Wrap::black;
  expect_near(value(image_, 0, 0.75), 0.5f * colour(0, 0));
}

TEST_F(Textures, ImagesAreScaledInvertedAndMadeNumbers) {
  image_.scale = 0.5;
  expect_near(value(image_, 0.5, 0.75), 0.5f * colour(1, 0));
  image_.invert = true;
  Spectrum expected;
  for (int c = 0; c < channel_count; ++c) expected[c] = 1 - 0.5f * colour(1, 0)[c];
  expect_near(value(image_, 0.5, 0.75), expected);
  image_.scale = 10;
  EXPECT_EQ(value(image_, 0.99, 0.01)[1], 0);  // never below 0
  image_.scale = 1;
  image_.invert = false;
  expect_near(value(image_, 0.5, 0.75, {}, true), constant_spectrum(sum(colour(1, 0)) / 3));
}

TEST_F(Textures, MappingsMoveAndStretch) {
  image_.mapping.u_scale = 2;
  image_.mapping.v_scale = 0.5;
  image_.mapping.u_offset = 1.0 / 3;
  image_.mapping.v_offset = 0.5;
  expect_near(value(image_, 0.25, 0.5), colour(2, 0));  // at (5/6, 3/4)
  image_.mapping = {};
  image_.mapping.planar = true;
  image_.mapping.v1 = {0.5, 0, 0};
  image_.mapping.v2 = {0, 0, 1};
  image_.mapping.u_offset = 0.25;
  image_.mapping.world_from_texture = translate({10, 20, 30}) * rotate(90, {1, 0, 0}) * scale({2, 2, 2});
  // (1, 7, 0.75) of the texture's space: s = 0.5 + 0.25, t = 0.75.
  const Vector3 p = image_.mapping.world_from_texture.point({1, 7, 0.75});
  expect_near(value(image_, 0, 0, p), colour(2, 0));
}

TEST_F(Textures, CheckerboardsBeginWithTheFirst) {
  CheckerboardTexture board;
  board.first = Spectrum{{1, 0, 0}};
  board.second = Spectrum{{0, 0, 1}};
  board.mapping.u_scale = 4;
  board.mapping.v_scale = 2;
  for (int i = -5; i < 5; ++i)
    for (int j = -5; j < 5; ++j)
      expect_near(value(board, (i + 0.3) / 4, (j + 0.6) / 2),
                  (i + j) % 2 == 0 ? board.first.value : board.second.value);
}

TEST_F(Textures, ScaleAndMixCombineOthers) {
  textures_ = {{"red", false, ConstantTexture{Spectrum{{0.8f, 0.2f, 0}}}, {}},
               {"amount", true, image_, {}},
               {"scaled", false, ScaleTexture{}, {}}};
  auto& scaled = std::get<ScaleTexture>(textures_[2].kind);
  scaled.texture.texture = 0;
  scaled.scale.texture = 1;
  MixTexture mix;
  mix.first.texture = 2;
  mix.second = Spectrum{{0, 0, 1}};
  mix.amount = constant_spectrum(0.25f);
  const float grey = sum(colour(1, 0)) / 3;
  expect_near(value(mix, 0.5, 0.75), {{0.75f * grey * 0.8f, 0.75f * grey * 0.2f, 0.25f}});
}

TEST_F(Textures, FilesThatCannotBeReadAreErrorsThatNameThem) {
  image_.filename = folder_.file("none.png");
  try {
    value(image_, 0, 0);
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("none.png"), std::string::npos);
  }
}

// A square under a constant sky shows its reflectance, by each integrator: at the place where the ray meets it.
// The twin has the columns the other way round.
TEST_F(Textures, AreSeenByAllIntegrators) {
  for (const char* integrator : {"classic", "reference", "volpath"}) {
    SceneDescription s = needle_scene({-0.6, 0.4, -3});  // in the left column and the upper row
    s.integrator.name = integrator;
    s.textures = {{"t", false, image_, {}}};
    ShapeDescription square;  // seen from its back, u to the right and v upwards
    square.kind = QuadShape{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}};
    for (const bool phong : {false, true}) {
      Textured t;
      t.texture = 0;
      square.material = phong ? MaterialDescription{BlinnPhongMaterial{t, {}, {}, 1}} : DiffuseMaterial{t};
      s.shapes = {square};
      s.lights = {sky(1)};
      const Spectrum expected = colour(0, 0);
      expect_estimates(s, {{static_cast<double>(expected[0]), 1e-5}, {static_cast<double>(expected[1]), 1e-5}}, 2e-3);
    }
    std::get<ImageTexture>(s.textures[0].kind).mapping.u_scale = -1;
    expect_rejected(s, {{static_cast<double>(colour(0, 0)[0]), 0}}, 2e-3);
  }
}

}  // namespace
}  // namespace brume
