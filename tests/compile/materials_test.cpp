// Which materials shapes have.
#include <gtest/gtest.h>

#include "compile/compile.h"
#include "scene/read_scene.h"

namespace brume {
namespace {

CompiledScene compiled(const std::string& world) {
  std::vector<Diagnostic> warnings;
  return compile(read_scene_text("WorldBegin\n" + world, "test.pbrt", "", warnings), 1, warnings);
}

TEST(Materials, ThoseThatAreAlikeAreOneAtTheirFirstPlace) {
  const std::string red = "Material \"diffuse\" \"rgb reflectance\" [1 0 0] Shape \"sphere\"\n";
  const std::string coat = "Material \"coateddiffuse\" \"float roughness\" 0.3 Shape \"sphere\"\n";
  const std::string smoother = "Material \"coateddiffuse\" \"float roughness\" 0.2 Shape \"sphere\"\n";
  const CompiledScene scene = compiled(coat + red + coat + smoother + red + coat);
  std::vector<std::int32_t> materials;
  for (const CompiledShape& shape : scene.shapes) materials.push_back(shape.material);
  EXPECT_EQ(materials, (std::vector<std::int32_t>{0, 1, 0, 2, 1, 0}));
  ASSERT_EQ(scene.materials.size(), 3u);
  // The tables of the coats are there, and each has its own.
  EXPECT_GT(scene.materials[0].internal_reflectance, 0.5f);
  EXPECT_GT(scene.materials[2].internal_reflectance, 0.5f);
  EXPECT_NE(scene.materials[0].coat_transmittance, scene.materials[2].coat_transmittance);
}

}  // namespace
}  // namespace brume
