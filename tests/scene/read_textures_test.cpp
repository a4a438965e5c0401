// What the reader makes of textures, objects and the places on shapes.
#include <cmath>

#include "scene_test.h"

namespace brume {
namespace {

TEST(ReadTextures, ColoursAndNumbersOfAllClasses) {
  const SceneDescription s = world_of(
      "Texture \"red\" \"spectrum\" \"constant\" \"rgb value\" [1 0 0]\n"
      "Texture \"red\" \"float\" \"constant\" \"float value\" 0.25\n"
      "Texture \"dim\" \"spectrum\" \"scale\" \"texture tex\" \"red\" \"texture scale\" \"red\"\n"
      "Texture \"mixed\" \"spectrum\" \"mix\" \"texture tex1\" \"dim\" \"rgb tex2\" [0 0 1] \"float amount\" 0.75\n"
      "Texture \"board\" \"spectrum\" \"checkerboard\" \"texture tex1\" \"mixed\" \"float uscale\" 4 \"float vdelta\" "
      "3\n"
      "Texture \"image\" \"float\" \"imagemap\" \"string filename\" \"a.png\" \"string wrap\" \"black\" \"bool "
      "invert\" true"
      " \"string encoding\" \"gamma 2.2\" \"string filter\" \"point\" \"float scale\" 2\n"
      "Material \"diffuse\" \"texture reflectance\" \"board\"\nShape \"sphere\"\n"
      "Material \"blinnphong\" \"texture diffuse\" \"red\"\nShape \"sphere\"");
  ASSERT_EQ(s.textures.size(), 6u);
  EXPECT_EQ(std::get<ConstantTexture>(s.textures[0].kind).value, (Spectrum{{1, 0, 0}}));
  EXPECT_EQ(std::get<ConstantTexture>(s.textures[1].kind).value, constant_spectrum(0.25f));
  EXPECT_TRUE(s.textures[1].is_float);
  const auto& scaled = std::get<ScaleTexture>(s.textures[2].kind);
  EXPECT_EQ(scaled.texture.texture, 0);
  EXPECT_EQ(scaled.scale.texture, 1);  // of numbers, under the same name
  const auto& mix = std::get<MixTexture>(s.textures[3].kind);
  EXPECT_EQ(mix.first.texture, 2);
  EXPECT_EQ(mix.second.value, (Spectrum{{0, 0, 1}}));
  EXPECT_EQ(mix.amount.value, constant_spectrum(0.75f));
  const auto& board = std::get<CheckerboardTexture>(s.textures[4].kind);
  EXPECT_EQ(board.first.texture, 3);
  EXPECT_EQ(board.second, Textured(constant_spectrum(0)));
  EXPECT_EQ(board.mapping.u_scale, 4);
  EXPECT_EQ(board.mapping.v_offset, 3);
  const auto& image = std::get<ImageTexture>(s.textures[5].kind);
  EXPECT_EQ(image.filename, "a.png");
  EXPECT_EQ(image.wrap, ImageTexture::Wrap::black);
  EXPECT_EQ(image.gamma, 2.2);
  EXPECT_EQ(image.scale, 2);
  EXPECT_TRUE(image.invert);
  EXPECT_FALSE(image.bilinear);
  EXPECT_EQ(std::get<DiffuseMaterial>(s.shapes.at(0).material).reflectance.texture, 4);
  EXPECT_EQ(std::get<BlinnPhongMaterial>(s.shapes.at(1).material).diffuse.texture, 0);
}

// The space of a planar texture is the one that it is made in.
TEST(ReadTextures, PlanarMappingsKeepTheirTransformation) {
  const SceneDescription s = world_of(
      "Translate 1 2 3\nTexture \"t\" \"spectrum\" \"checkerboard\" \"string mapping\" \"planar\" \"vector3 v2\" [0 0 "
      "2]");
  const TextureMapping& m = std::get<CheckerboardTexture>(s.textures.at(0).kind).mapping;
  EXPECT_TRUE(m.planar);
  EXPECT_EQ(m.v2, (Vector3{0, 0, 2}));
  EXPECT_EQ(m.world_from_texture, translate({1, 2, 3}));
}

// Each of 40 textures names the last one twice: evaluated naively, 2^40 look-ups.
TEST(ReadTextures, OnesThatMultiplyAreRefused) {
  std::string text = "WorldBegin\nTexture \"0\" \"spectrum\" \"constant\"\n";
  for (int i = 1; i <= 40; ++i) {
    const std::string last = std::to_string(i - 1), next = std::to_string(i);
    text += "Texture \"" + next + "\" \"spectrum\" \"mix\" \"texture tex1\" \"" + last + "\" \"texture tex2\" \"" +
            last + "\"\n";
  }
  const std::vector<std::string> errors = errors_of(text);
  ASSERT_FALSE(errors.empty());
  EXPECT_EQ(errors[0], "the texture is made of more than 1000 others");
}

TEST(ReadObjects, ShapesAreKeptOnceAndPlacedByInstances) {
  const SceneDescription s = world_of(
      "Translate 1 0 0\nObjectBegin \"pair\"\nShape \"sphere\"\nScale 2 2 2\nShape \"disk\"\nObjectEnd\nShape "
      "\"quad\"\n"
      "AttributeBegin\nScale 3 3 3\nObjectInstance \"pair\"\nAttributeEnd\nIdentity\nObjectInstance \"pair\"");
  ASSERT_EQ(s.objects.size(), 1u);
  ASSERT_EQ(s.objects[0].shapes.size(), 2u);
  EXPECT_EQ(s.objects[0].name, "pair");
  EXPECT_EQ(s.objects[0].shapes[1].world_from_object, translate({1, 0, 0}) * scale({2, 2, 2}));
  ASSERT_EQ(s.shapes.size(), 1u);
  EXPECT_EQ(s.shapes[0].world_from_object, translate({1, 0, 0}));  // what was set in the object ended with it
  ASSERT_EQ(s.instances.size(), 2u);
  EXPECT_EQ(s.instances[0].world_from_object, translate({1, 0, 0}) * scale({3, 3, 3}));
  EXPECT_EQ(s.instances[1].world_from_object, Transform());
}

TEST(ReadShapes, PartsOfSpheresAndCaps) {
  const SceneDescription s = world_of(
      "Shape \"sphere\" \"float zmin\" -5 \"float zmax\" 0.5\nShape \"sphere\" \"float radius\" 2 \"float zmin\" 1 "
      "\"float zmax\" -1 "
      "\"float phimax\" 90\nShape \"cylinder\" \"bool caps\" true");
  const auto cut = std::get<SphereShape>(s.shapes.at(0).kind), band = std::get<SphereShape>(s.shapes.at(1).kind);
  EXPECT_FALSE(std::isfinite(cut.z_min));  // the whole lower half
  EXPECT_EQ(cut.z_max, 0.5);
  EXPECT_EQ(band.z_min, -1);  // as pbrt swaps them
  EXPECT_EQ(band.z_max, 1);
  EXPECT_EQ(band.phi_max, 90);
  EXPECT_TRUE(std::get<CylinderShape>(s.shapes.at(2).kind).caps);
}

TEST(ReadShapes, MeshesKeepTheirUv) {
  const SceneDescription s = world_of(
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0.5 1 2 3 4]\n"
      "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1] \"float st\" [0 0 1 0 0 1 1 1]");
  const std::vector<std::array<double, 2>> uv = {{0, 0.5}, {1, 2}, {3, 4}};
  EXPECT_EQ(std::get<TriangleMeshShape>(s.shapes.at(0).kind).uv, uv);
  const auto& patch = std::get<BilinearMeshShape>(s.shapes.at(1).kind);
  EXPECT_EQ(patch.uv.size(), 4u);
  EXPECT_EQ(patch.patches.at(0), (std::array<std::uint32_t, 4>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace brume
