// Film, Camera, Option and Import.
#include <filesystem>
#include <fstream>

#include "scene_test.h"

namespace brume {
namespace {

TEST(ReadFilm, ExposureWhiteBalanceAndColourSpace) {
  const SceneDescription s = scene_of(
      "ColorSpace \"rec2020\" Film \"rgb\" \"float iso\" 200 \"float whitebalance\" 5000 \"float maxcomponentvalue\" "
      "10 "
      "ColorSpace \"srgb\" Camera \"perspective\" \"float shutteropen\" 0.5 \"float shutterclose\" 1.5 WorldBegin");
  EXPECT_EQ(s.film.colour_space, ColourSpace::rec2020);
  EXPECT_EQ(s.film.iso, 200);
  EXPECT_EQ(s.film.white_balance, 5000);
  EXPECT_EQ(s.film.max_component, 10);
  EXPECT_EQ(s.camera.shutter_open, 0.5);
  EXPECT_EQ(s.camera.shutter_close, 1.5);
  std::vector<Diagnostic> warnings;
  EXPECT_EQ(scene_of("Film \"rgb\" \"float scale\" 3 WorldBegin", &warnings).film.iso, 300);
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(ReadCamera, TheLens) {
  const CameraDescription pinhole = scene_of("Camera \"perspective\" WorldBegin").camera;
  EXPECT_EQ(pinhole.lens_radius, 0);
  EXPECT_EQ(pinhole.focal_distance, 1e6);
  const CameraDescription lens =
      scene_of("Camera \"perspective\" \"float lensradius\" 0.125 \"float focaldistance\" 7 WorldBegin").camera;
  EXPECT_EQ(lens.lens_radius, 0.125);
  EXPECT_EQ(lens.focal_distance, 7);
}

class Import : public testing::Test {
 protected:
  Import() { std::filesystem::create_directories(folder_); }
  ~Import() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ + "/" + name) << text; }
  SceneDescription read(const std::string& text) {
    std::vector<Diagnostic> warnings;
    return read_scene_text(text, "t", folder_, warnings);
  }
  const std::string folder_ = testing::TempDir() + "/brume_import";
};

// What the file makes stays; what it sets does not. Catches an Import that is an Include: everything after it would be
// moved, glass and turned about.
TEST_F(Import, KeepsWhatIsMadeAndForgetsWhatIsSet) {
  write("thing.pbrt",
        "Translate 1 0 0 Material \"dielectric\" ReverseOrientation ColorSpace \"rec2020\" "
        "MakeNamedMaterial \"grey\" \"string type\" \"diffuse\" \"rgb reflectance\" [0.25 0.25 0.25] "
        "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" MediumInterface \"m\" CoordinateSystem \"there\" "
        "Attribute \"shape\" \"float radius\" 7 Include \"ball.inc\"");
  write("ball.inc", "Translate 0 2 0 Shape \"sphere\"");
  const SceneDescription s = read(
      "WorldBegin Import \"thing.pbrt\" Shape \"sphere\" NamedMaterial \"grey\" Shape \"sphere\" \"float radius\" 2");
  ASSERT_EQ(s.shapes.size(), 3u);
  EXPECT_EQ(s.shapes[0].world_from_object, translate({1, 2, 0}));
  EXPECT_EQ(std::get<SphereShape>(s.shapes[0].kind).radius, 7);
  EXPECT_TRUE(s.shapes[0].reverse_orientation);
  EXPECT_EQ(s.shapes[0].inside, "m");
  EXPECT_EQ(s.shapes[1].world_from_object, Transform());
  EXPECT_EQ(std::get<SphereShape>(s.shapes[1].kind).radius, 1);
  EXPECT_FALSE(s.shapes[1].reverse_orientation);
  EXPECT_EQ(s.shapes[1].inside, "");
  EXPECT_TRUE(std::holds_alternative<DiffuseMaterial>(s.shapes[1].material));
  EXPECT_EQ(std::get<DiffuseMaterial>(s.shapes[2].material).reflectance, constant_spectrum(0.25f));
  ASSERT_EQ(s.media.size(), 1u);
  EXPECT_THROW(read("WorldBegin Import \"thing.pbrt\" CoordSysTransform \"there\""), InputError);
}

TEST_F(Import, MayHoldOthersAndEndWithThem) {
  write("a.pbrt", "Translate 1 0 0 Import \"b.pbrt\" Shape \"sphere\" Import \"empty.pbrt\" Import \"b.pbrt\"");
  write("b.pbrt", "Translate 0 1 0 Shape \"sphere\"");
  write("empty.pbrt", "# nothing\n");
  const SceneDescription s = read("WorldBegin AttributeBegin Import \"a.pbrt\" AttributeEnd Shape \"sphere\"");
  ASSERT_EQ(s.shapes.size(), 4u);
  EXPECT_EQ(s.shapes[0].world_from_object, translate({1, 1, 0}));
  EXPECT_EQ(s.shapes[1].world_from_object, translate({1, 0, 0}));
  EXPECT_EQ(s.shapes[2].world_from_object, translate({1, 1, 0}));
  EXPECT_EQ(s.shapes[3].world_from_object, Transform());
}

}  // namespace
}  // namespace brume
