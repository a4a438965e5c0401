// What the reader makes of materials, shapes and lights beyond the plainest.
#include <cmath>

#include "image/temporary_folder.h"
#include "scene_test.h"

namespace brume {
namespace {

MaterialDescription material_of(const std::string& text) {
  const SceneDescription s = world_of("Material " + text + "\nShape \"sphere\"");
  return s.shapes.empty() ? MaterialDescription{} : s.shapes[0].material;
}

// The defaults are those of pbrt-v3.
TEST(ReadMaterials, OldOnesAreReadAsThoseOfToday) {
  const auto metal = std::get<ConductorMaterial>(material_of("\"metal\""));
  EXPECT_EQ(metal.eta, std::get<ConductorMaterial>(material_of("\"conductor\"")).eta);
  EXPECT_FLOAT_EQ(metal.alpha, 0.1f);
  const auto silver = std::get<ConductorMaterial>(
      material_of("\"conductor\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" \"metal-Ag-k\""));
  EXPECT_EQ(std::get<ConductorMaterial>(material_of("\"mirror\"")).k, silver.k);
  EXPECT_EQ(std::get<ConductorMaterial>(material_of("\"mirror\"")).eta, silver.eta);
  EXPECT_EQ(std::get<ConductorMaterial>(material_of("\"mirror\" \"rgb Kr\" [0.5 0.9 1]")).k,
            std::get<ConductorMaterial>(material_of("\"conductor\" \"rgb reflectance\" [0.5 0.9 1]")).k);
  const auto plastic = std::get<CoatedDiffuseMaterial>(material_of("\"plastic\""));
  EXPECT_EQ(plastic.reflectance.value, constant_spectrum(0.25f));
  EXPECT_FLOAT_EQ(plastic.alpha, std::sqrt(0.1f));
  const auto uber =
      std::get<CoatedDiffuseMaterial>(material_of("\"uber\" \"rgb Kd\" [0.1 0.2 0.3] \"float index\" 1.4"));
  EXPECT_EQ(uber.reflectance.value, (Spectrum{{0.1f, 0.2f, 0.3f}}));
  EXPECT_EQ(uber.eta, 1.4f);
  const auto substrate = std::get<CoatedDiffuseMaterial>(material_of("\"substrate\" \"float roughness\" 0.04"));
  EXPECT_EQ(substrate.reflectance.value, constant_spectrum(0.5f));
  EXPECT_FLOAT_EQ(substrate.alpha, 0.2f);
  EXPECT_EQ(std::get<DielectricMaterial>(material_of("\"glass\" \"float index\" 1.3")).eta, 1.3f);
}

// What an Attribute gives is stronger than an old material's own defaults, and of any type.
TEST(ReadMaterials, OldOnesTakeWhatAnAttributeGives) {
  const auto plastic = [](const std::string& attribute) {
    const SceneDescription s =
        world_of("Attribute \"material\" " + attribute + "\nMaterial \"plastic\"\nShape \"sphere\"");
    return std::get<CoatedDiffuseMaterial>(s.shapes.at(0).material);
  };
  EXPECT_EQ(plastic("\"rgb Kd\" [0 1 0]").reflectance.value, (Spectrum{{0, 1, 0}}));
  EXPECT_EQ(plastic("\"rgb reflectance\" [0 1 0]").reflectance.value, (Spectrum{{0, 1, 0}}));
  EXPECT_FLOAT_EQ(plastic("\"float roughness\" 0.04").alpha, 0.2f);
  EXPECT_NEAR(plastic("\"spectrum Kd\" [200 0.5 900 0.5]").reflectance.value[1], 0.5f, 1e-3);
}

TEST(ReadMaterials, ConductorsByNameByNumbersAndByReflectance) {
  const auto gold = std::get<ConductorMaterial>(
      material_of("\"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\""));
  // Yellow: red is reflected as well as by silver, blue badly.
  const auto reflectance = [&](int c) {
    const double n = static_cast<double>(gold.eta[c]), k = static_cast<double>(gold.k[c]);
    return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
  };
  EXPECT_GT(reflectance(0), 0.9);
  EXPECT_LT(reflectance(2), 0.5);
  const auto copper = std::get<ConductorMaterial>(material_of("\"conductor\""));
  const auto named = std::get<ConductorMaterial>(material_of("\"conductor\" \"spectrum eta\" \"metal-Cu-eta\""));
  EXPECT_EQ(copper.eta, named.eta);
  EXPECT_EQ(copper.k, named.k);
  const auto mirror = std::get<ConductorMaterial>(material_of("\"conductor\" \"rgb reflectance\" [0.5 0.9 1]"));
  EXPECT_EQ(mirror.eta, constant_spectrum(1));
  EXPECT_NEAR(mirror.k[0] * mirror.k[0] / (4 + mirror.k[0] * mirror.k[0]), 0.5, 1e-6);
  EXPECT_NEAR(mirror.k[1] * mirror.k[1] / (4 + mirror.k[1] * mirror.k[1]), 0.9, 1e-6);
  EXPECT_EQ(std::get<ConductorMaterial>(material_of("\"conductor\" \"rgb eta\" [1 2 3] \"rgb k\" [4 5 6]")).k[2], 6);
}

TEST(ReadMaterials, RoughnessIsPbrts) {
  const auto alpha = [](const std::string& text) {
    return std::get<ConductorMaterial>(material_of("\"conductor\" " + text)).alpha;
  };
  EXPECT_EQ(alpha(""), 0);
  EXPECT_EQ(alpha("\"float roughness\" 0.25"), 0.5f);
  EXPECT_EQ(alpha("\"float roughness\" 0.25 \"bool remaproughness\" false"), 0.25f);
  EXPECT_EQ(alpha("\"float uroughness\" 0.04 \"float vroughness\" 0.16 \"bool remaproughness\" false"), 0.08f);
  EXPECT_EQ(alpha("\"float roughness\" 0.0005 \"bool remaproughness\" false"), 0);
}

TEST(ReadMaterials, DielectricsByNumberAndByName) {
  EXPECT_EQ(std::get<DielectricMaterial>(material_of("\"dielectric\"")).eta, 1.5f);
  EXPECT_EQ(std::get<DielectricMaterial>(material_of("\"dielectric\" \"float eta\" 1.33")).eta, 1.33f);
  EXPECT_EQ(std::get<DielectricMaterial>(material_of("\"dielectric\" \"float roughness\" 0.25")).alpha, 0.5f);
  EXPECT_EQ(std::get<DielectricMaterial>(material_of("\"dielectric\" \"spectrum eta\" [200 1.4 900 1.4]")).eta, 1.4f);
  // At the wavelength of helium's yellow line, from the makers' data sheets.
  for (const auto& [glass, eta] : {std::pair{"BK7", 1.5168f},
                                   {"BAF10", 1.67f},
                                   {"FK51A", 1.4866f},
                                   {"LASF9", 1.8503f},
                                   {"F5", 1.6727f},
                                   {"F10", 1.7283f},
                                   {"F11", 1.7847f}})
    EXPECT_EQ(std::get<DielectricMaterial>(
                  material_of("\"dielectric\" \"spectrum eta\" \"glass-" + std::string(glass) + "\""))
                  .eta,
              eta);
}

TEST(ReadMaterials, BlinnPhongWithAllItsParts) {
  const auto plain = std::get<BlinnPhongMaterial>(material_of("\"blinnphong\" \"rgb diffuse\" [0.1 0.2 0.3]"));
  EXPECT_EQ(plain.ambient, plain.diffuse);
  EXPECT_EQ(plain.index, 1.5f);
  EXPECT_TRUE(is_zero(plain.refraction) && is_zero(plain.absorption));
  const auto whole = std::get<BlinnPhongMaterial>(
      material_of("\"blinnphong\" \"rgb diffuse\" [0 0 0] \"rgb ambient\" [0.1 0.1 0.1] \"float metallic\" 0.5 \"rgb "
                  "refraction\" [0.9 0.8 0.7] \"float index\" 1.33 \"rgb absorption\" [0 1 20]"));
  EXPECT_EQ(whole.ambient, constant_spectrum(0.1f));
  EXPECT_EQ(whole.metallic, 0.5f);
  EXPECT_EQ(whole.refraction, (Spectrum{{0.9f, 0.8f, 0.7f}}));
  EXPECT_EQ(whole.index, 1.33f);
  EXPECT_EQ(whole.absorption, (Spectrum{{0, 1, 20}}));
}

TEST(ReadMaterials, CoatedDiffuseTakesPbrtsParameters) {
  const auto coated = std::get<CoatedDiffuseMaterial>(material_of(
      "\"coateddiffuse\" \"rgb reflectance\" [0.1 0.2 0.3] \"spectrum eta\" \"glass-BK7\" \"float "
      "thickness\" 0.01 \"float g\" 0 \"rgb albedo\" [0 0 0] \"integer maxdepth\" 10 \"integer nsamples\" 1"));
  EXPECT_EQ(coated.reflectance, (Spectrum{{0.1f, 0.2f, 0.3f}}));
  EXPECT_EQ(coated.eta, 1.5168f);
  EXPECT_EQ(std::get<CoatedDiffuseMaterial>(material_of("\"coateddiffuse\"")).reflectance, constant_spectrum(0.5f));
}

TEST(ReadLights, SpheresAreEnlargedWithTheirSurroundings) {
  const SceneDescription s = world_of(
      "Translate 1 0 0\nScale 3 3 3\nLightSource \"sphere\" \"point3 from\" [0 1 0] \"float radius\" 0.5 \"rgb I\" [1 "
      "2 "
      "4]\nLightSource \"ambient\" \"rgb L\" [0.1 0.2 0.3] \"float scale\" 2");
  ASSERT_EQ(s.lights.size(), 2u);
  const auto& sphere = std::get<SphereLight>(s.lights[0].kind);
  EXPECT_EQ(sphere.from, (Vector3{1, 3, 0}));
  EXPECT_EQ(sphere.radius, 1.5);
  EXPECT_EQ(sphere.intensity, (Spectrum{{1, 2, 4}}));
  EXPECT_EQ(std::get<AmbientLight>(s.lights[1].kind).radiance, (Spectrum{{0.2f, 0.4f, 0.6f}}));
}

TEST(ReadShapes, DisksAndCylinders) {
  const SceneDescription s = world_of(
      "Shape \"disk\"\nShape \"disk\" \"float radius\" 2 \"float height\" 3 \"float innerradius\" 1 \"float phimax\" "
      "90\n"
      "Shape \"cylinder\" \"float zmin\" 2 \"float zmax\" -3 \"float radius\" 0.5");
  ASSERT_EQ(s.shapes.size(), 3u);
  EXPECT_EQ(std::get<DiskShape>(s.shapes[0].kind).radius, 1);
  const auto disk = std::get<DiskShape>(s.shapes[1].kind);
  EXPECT_EQ(disk.height, 3);
  EXPECT_EQ(disk.inner_radius, 1);
  EXPECT_EQ(disk.phi_max, 90);
  const auto cylinder = std::get<CylinderShape>(s.shapes[2].kind);
  EXPECT_EQ(cylinder.z_min, -3);  // as pbrt swaps them
  EXPECT_EQ(cylinder.z_max, 2);
  EXPECT_EQ(cylinder.phi_max, 360);
}

TEST(ReadShapes, MeshesOfPlyFiles) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("mesh.ply"))
      << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
         "end_header\n0 0 0 1 0 0 0 1 0 3 0 1 2\n";
  std::vector<Diagnostic> warnings;
  const std::string text = "WorldBegin\nShape \"plymesh\" \"string filename\" \"mesh.ply\"";
  const SceneDescription s = read_scene_text(text, "test.pbrt", folder.path(), warnings);
  ASSERT_EQ(s.shapes.size(), 1u);
  EXPECT_EQ(std::get<TriangleMeshShape>(s.shapes[0].kind).positions[1], (Vector3{1, 0, 0}));
  EXPECT_TRUE(warnings.empty());
}

TEST(ReadShapes, MeshesAreDisplacedByTexturesOfNumbers) {
  const std::string mesh = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] ";
  const SceneDescription s =
      world_of("Texture \"a\" \"float\" \"constant\"\nTexture \"b\" \"float\" \"constant\"\n" + mesh + "\n" + mesh +
               "\"texture displacement\" \"b\"\n" + mesh + "\"texture displacement\" \"a\" \"float edgelength\" 0.5");
  ASSERT_EQ(s.shapes.size(), 3u);
  const auto displacement = [&](std::size_t i) { return std::get<TriangleMeshShape>(s.shapes[i].kind).displacement; };
  EXPECT_FALSE(displacement(0));
  EXPECT_EQ(displacement(1), (Displacement{1, 1}));
  EXPECT_EQ(displacement(2), (Displacement{0, 0.5}));
}

// Catches a light that outlasts its block, or is not there for later shapes, or for shapes without a surface.
TEST(ReadLights, AreaLightsHoldForTheShapesOfTheirBlock) {
  const SceneDescription s = world_of(
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"float scale\" 2 \"bool twosided\" true\n"
      "Shape \"sphere\"\nShape \"disk\"\nMaterial \"interface\"\nShape \"sphere\"\nAttributeEnd\nShape \"sphere\"");
  ASSERT_EQ(s.shapes.size(), 4u);
  ASSERT_TRUE(s.shapes[0].light && s.shapes[1].light);
  EXPECT_EQ(s.shapes[1].light->radiance, (Spectrum{{2, 4, 6}}));
  EXPECT_TRUE(s.shapes[1].light->two_sided);
  EXPECT_EQ(s.shapes[1].light->power, 0);
  EXPECT_FALSE(s.shapes[2].light);
  EXPECT_FALSE(s.shapes[3].light);
}

TEST(ReadLights, AreaLightsHaveImages) {
  const SceneDescription s = world_of(
      "AreaLightSource \"diffuse\" \"string filename\" \"lamp.png\" \"float scale\" 3\n"
      "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1] \"string emissionfilename\" \"lamp.png\"");
  ASSERT_EQ(s.shapes.size(), 1u);
  ASSERT_TRUE(s.shapes[0].light);
  EXPECT_EQ(s.shapes[0].light->filename, "lamp.png");
  EXPECT_EQ(s.shapes[0].light->radiance, constant_spectrum(3));
  EXPECT_EQ(s.shapes[0].light->filename.location.line, 2);
}

TEST(ReadLights, ImagesAreTurnedAndScaled) {
  const SceneDescription s = world_of(
      "Rotate 90 1 0 0\nScale 2 2 -2\nLightSource \"infinite\" \"string filename\" \"sky.exr\" \"float scale\" 3 "
      "\"float illuminance\" 5");
  ASSERT_EQ(s.lights.size(), 1u);
  const auto& light = std::get<InfiniteLight>(s.lights[0].kind);
  EXPECT_EQ(light.filename, "sky.exr");
  EXPECT_EQ(light.radiance, constant_spectrum(3));
  EXPECT_EQ(light.illuminance, 5);
  EXPECT_NEAR(light.world_from_light.vector({0, 0, 1}).y, 2, 1e-12);
  EXPECT_FALSE(light.portal);
}

TEST(ReadLights, PortalsStandInTheWorld) {
  const SceneDescription s = world_of(
      "Rotate 90 1 0 0\nTranslate 1 2 3\nLightSource \"infinite\" \"string filename\" \"sky.exr\" "
      "\"point3 portal\" [0 0 5  2 0 5  2 3 5  0 3 5]\nLightSource \"infinite\" \"rgb L\" [1 2 3] "
      "\"point3 portal\" [0 0 5  0 3 5  2 3 5  2 0 5]");
  ASSERT_EQ(s.lights.size(), 2u);
  const auto &image = std::get<InfiniteLight>(s.lights[0].kind), &constant = std::get<InfiniteLight>(s.lights[1].kind);
  EXPECT_EQ(image.portal, (std::array<Vector3, 4>{{{0, 0, 5}, {2, 0, 5}, {2, 3, 5}, {0, 3, 5}}}));
  EXPECT_EQ(constant.portal, (std::array<Vector3, 4>{{{0, 0, 5}, {0, 3, 5}, {2, 3, 5}, {2, 0, 5}}}));
  EXPECT_EQ(constant.radiance, (Spectrum{{1, 2, 3}}));
}

}  // namespace
}  // namespace brume
