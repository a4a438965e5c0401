// What the reader makes of scenes that are right.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/file.h"
#include "kernel/phase_table.h"
#include "scene/colour.h"
#include "scene_test.h"

namespace brume {
namespace {

SceneDescription scene_file(const std::string& name, std::vector<Diagnostic>& warnings) {
  return read_scene(test_folder("scenes/" + name), warnings);
}

Spectrum rgb(float r, float g, float b) {
  Spectrum s;
  s[0] = r;
  s[1] = g;
  s[2] = b;
  return s;
}

template <typename T>
const T& kind(const auto& entity) {
  return std::get<T>(entity.kind);
}

TEST(ReadScene, FogInABox) {
  std::vector<Diagnostic> warnings;
  const SceneDescription s = scene_file("fog.pbrt", warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(s.film.width, 64);
  EXPECT_EQ(s.film.height, 48);
  EXPECT_EQ(s.film.filename, "fog.exr");
  EXPECT_TRUE(s.film.save_fp16);
  EXPECT_EQ(s.filter.kind, PixelFilter::Kind::box);
  EXPECT_EQ(s.filter.x_radius, 0.5f);
  EXPECT_EQ(s.sampler.pixel_samples, 16);
  EXPECT_EQ(s.integrator.name, "volpath");
  EXPECT_EQ(s.integrator.max_depth, 1);
  EXPECT_EQ(s.camera.fov, 36);
  EXPECT_EQ(s.camera.medium, "");
  EXPECT_EQ(s.camera.location.line, 8);
  ASSERT_EQ(s.media.size(), 1u);
  EXPECT_EQ(s.media[0].name, "fog");
  EXPECT_EQ(s.media[0].sigma_s, constant_spectrum(0.5f));
  EXPECT_EQ(s.media[0].sigma_a, constant_spectrum(0.05f));
  EXPECT_TRUE(is_zero(s.media[0].emission));
  EXPECT_EQ(s.media[0].phase, phase_kind("henyey_greenstein"));
  EXPECT_EQ(s.media[0].phase_parameters, std::vector<float>{0});
  EXPECT_TRUE(std::holds_alternative<HomogeneousMedium>(s.media[0].kind));
  ASSERT_EQ(s.lights.size(), 1u);
  EXPECT_EQ(kind<PointLight>(s.lights[0]).from, (Vector3{0.3, 1.0, 0.4}));
  EXPECT_EQ(kind<PointLight>(s.lights[0]).intensity, constant_spectrum(4));
  ASSERT_EQ(s.shapes.size(), 3u);
  EXPECT_EQ(kind<TriangleMeshShape>(s.shapes[0]).positions.size(), 4u);
  EXPECT_EQ(kind<TriangleMeshShape>(s.shapes[0]).triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
  EXPECT_EQ(std::get<DiffuseMaterial>(s.shapes[1].material).reflectance, rgb(0.8f, 0.25f, 0.2f));
  EXPECT_EQ(kind<SphereShape>(s.shapes[1]).radius, 0.35);
  EXPECT_EQ(s.shapes[1].inside, "");
  EXPECT_TRUE(std::holds_alternative<InterfaceMaterial>(s.shapes[2].material));
  EXPECT_EQ(s.shapes[2].inside, "fog");
  EXPECT_EQ(s.shapes[2].outside, "");
  EXPECT_EQ(kind<TriangleMeshShape>(s.shapes[2]).triangles.size(), 12u);
}

TEST(ReadScene, SmokeFromAFileUnderSunAndSky) {
  std::vector<Diagnostic> warnings;
  const SceneDescription s = scene_file("smoke.pbrt", warnings);
  EXPECT_TRUE(warnings.empty());
  ASSERT_EQ(s.media.size(), 1u);
  EXPECT_EQ(kind<FileMedium>(s.media[0]).filename, "smoke.nvdb");  // there is none in the folder: as given
  EXPECT_EQ(kind<FileMedium>(s.media[0]).grid, "");
  EXPECT_TRUE(s.media[0].linear_interpolation);
  EXPECT_EQ(s.media[0].storage_bits, 16);
  ASSERT_EQ(s.lights.size(), 2u);
  EXPECT_EQ(kind<InfiniteLight>(s.lights[0]).radiance, rgb(0.4f, 0.55f, 0.8f));
  EXPECT_EQ(kind<DistantLight>(s.lights[1]).radiance, rgb(3, 2.8f, 2.5f));
  EXPECT_NEAR(kind<DistantLight>(s.lights[1]).direction_to_light.y, 0.7 / std::sqrt(1.01), 1e-15);
  EXPECT_EQ(s.integrator.name, "volpath");
  EXPECT_EQ(s.integrator.max_depth, 5);
}

TEST(ReadScene, AdditionsAndAListAcrossFiles) {
  std::vector<Diagnostic> warnings;
  const SceneDescription s = scene_file("additions.pbrt", warnings);
  ASSERT_EQ(warnings.size(), 1u) << to_string(warnings.back());  // of the sampler
  EXPECT_FALSE(s.film.save_fp16);
  EXPECT_EQ(s.sampler.pixel_samples, 15);
  EXPECT_EQ(s.sampler.seed, 4000000000u);
  EXPECT_EQ(s.integrator.traversal, Traversal::dda);
  EXPECT_EQ(s.integrator.placement, Placement::middle_random);
  EXPECT_EQ(s.integrator.step, 0.25);
  EXPECT_EQ(s.camera.medium, "haze");
  EXPECT_EQ(s.camera.screen_window, (std::array<double, 4>{-1, 1, -0.5, 0.5}));
  ASSERT_EQ(s.media.size(), 3u);
  EXPECT_EQ(s.media[0].sigma_s, constant_spectrum(16));
  EXPECT_TRUE(is_zero(s.media[0].sigma_a));
  EXPECT_EQ(s.media[0].phase_parameters, std::vector<float>{0.8f});
  EXPECT_FALSE(s.media[0].linear_interpolation);
  EXPECT_EQ(s.media[0].storage_bits, 8);
  EXPECT_EQ(kind<ProceduralMedium>(s.media[0]).procedural.size, 64);
  EXPECT_EQ(kind<ProceduralMedium>(s.media[0]).procedural.seed, 9u);
  const UniformGridMedium& grid = kind<UniformGridMedium>(s.media[1]);
  EXPECT_EQ(grid.density, (std::vector<float>{0, 0.1f, 0.25f, 1, 2, 0.3f}));
  EXPECT_EQ(grid.resolution, (std::array<int, 3>{2, 3, 1}));
  EXPECT_EQ(grid.p1, (Vector3{1, 2, 3}));
  EXPECT_EQ(s.media[1].sigma_a, rgb(0.5f, 0.25f, 0.125f));  // given after the included file's end
  EXPECT_NEAR(luminance(s.media[1].emission), 2, 1e-6);
  EXPECT_EQ(s.media[2].phase, phase_kind("isotropic"));
  EXPECT_TRUE(s.media[2].phase_parameters.empty());
  ASSERT_EQ(s.shapes.size(), 4u);
  EXPECT_TRUE(std::holds_alternative<VolumeShape>(s.shapes[0].kind));
  EXPECT_EQ(s.shapes[0].inside, "cloud");
  EXPECT_EQ(kind<SphereShape>(s.shapes[1]).radius, 3);  // the Attribute's default
  EXPECT_TRUE(s.shapes[1].reverse_orientation);
  EXPECT_EQ(s.shapes[1].outside, "haze");
  EXPECT_EQ(std::get<BlinnPhongMaterial>(s.shapes[1].material).shininess, 64);
  EXPECT_FALSE(s.shapes[2].reverse_orientation);
  EXPECT_EQ(kind<QuadShape>(s.shapes[2]).edge_v, (Vector3{0, 0, -8}));
  EXPECT_EQ(kind<TriangleMeshShape>(s.shapes[3]).triangles.size(), 1u);
  EXPECT_EQ(kind<TriangleMeshShape>(s.shapes[3]).normals.size(), 3u);
  ASSERT_EQ(s.lights.size(), 3u);
  // 100 lumens over the sphere; luminance 1 radiates 4 pi.
  EXPECT_NEAR(luminance(kind<PointLight>(s.lights[0]).intensity), 100 / (4 * 3.14159265358979), 1e-5);
  EXPECT_NEAR(luminance(kind<DistantLight>(s.lights[1]).radiance), 3, 1e-5);
  EXPECT_EQ(kind<InfiniteLight>(s.lights[2]).radiance, rgb(0.2f, 0.4f, 0.6f));
}

TEST(ReadScene, ProceduralMediaHaveTheParametersOfTheirKind) {
  const SceneDescription s = world_of(R"(
    MakeNamedMedium "a" "string type" "procedural"
    MakeNamedMedium "b" "string type" "procedural" "string kind" "smoke" "float spread" 0.25 "integer size" 40
    MakeNamedMedium "c" "string type" "procedural" "string kind" "fog" "integer seed" 7)");
  EXPECT_EQ(kind<ProceduralMedium>(s.media.at(0)).procedural, usual_procedural(ProceduralName::cloud));
  Procedural smoke = usual_procedural(ProceduralName::smoke, 40);
  smoke.values[1] = 0.25f;
  EXPECT_EQ(kind<ProceduralMedium>(s.media.at(1)).procedural, smoke);
  EXPECT_EQ(kind<ProceduralMedium>(s.media.at(2)).procedural, usual_procedural(ProceduralName::fog, 128, 7));
}

TEST(ReadScene, DefaultsOfAnEmptyWorld) {
  const SceneDescription s = scene_of("WorldBegin");
  EXPECT_EQ(s.film.width, 1280);
  EXPECT_EQ(s.film.height, 720);
  EXPECT_EQ(s.filter.kind, PixelFilter::Kind::gaussian);
  EXPECT_EQ(s.filter.sigma, 0.5f);
  EXPECT_EQ(s.sampler.pixel_samples, 16);
  EXPECT_EQ(s.camera.fov, 90);
  EXPECT_EQ(s.camera.world_from_camera, Transform());
  EXPECT_EQ(s.integrator.max_depth, 5);
  EXPECT_EQ(s.integrator.placement, Placement::middle);
}

TEST(ReadScene, CropWindowsAndPixelBounds) {
  const auto pixels = [](const std::string& parameters) {
    return cropped_pixels(
        scene_of("Film \"rgb\" \"integer xresolution\" 49 \"integer yresolution\" 30 " + parameters + " WorldBegin")
            .film);
  };
  EXPECT_EQ(pixels(""), (PixelBox{0, 49, 0, 30}));
  EXPECT_EQ(pixels("\"float cropwindow\" [0 0.5 0.1 1]"), (PixelBox{0, 25, 3, 30}));
  EXPECT_EQ(pixels("\"integer pixelbounds\" [1 48 2 29]"), (PixelBox{1, 48, 2, 29}));
  EXPECT_EQ(pixels("\"integer pixelbounds\" [1 48 2 29] \"float cropwindow\" [0 0.5 0.1 1]"), (PixelBox{0, 25, 3, 30}));
}

TEST(ReadScene, OneMediumNameIsForBothSides) {
  const SceneDescription s =
      world_of("MakeNamedMedium \"m\" \"string type\" \"homogeneous\" MediumInterface \"m\" Shape \"sphere\"");
  EXPECT_EQ(s.shapes.at(0).inside, "m");
  EXPECT_EQ(s.shapes.at(0).outside, "m");
}

TEST(ReadScene, FrameAspectRatioMakesTheScreenWindow) {
  const auto window = [](const std::string& aspect) {
    return scene_of("Camera \"perspective\" \"float frameaspectratio\" " + aspect + " WorldBegin").camera.screen_window;
  };
  EXPECT_EQ(window("2"), (std::array<double, 4>{-2, 2, -1, 1}));
  EXPECT_EQ(window("0.5"), (std::array<double, 4>{-1, 1, -2, 2}));
}

TEST(ReadScene, SamplersAndFilters) {
  EXPECT_EQ(scene_of("Sampler \"independent\" WorldBegin").sampler.pixel_samples, 4);
  EXPECT_EQ(scene_of("Sampler \"halton\" WorldBegin").sampler.pixel_samples, 16);
  EXPECT_EQ(scene_of("Option \"seed\" 3 WorldBegin").sampler.seed, 3u);
  EXPECT_EQ(scene_of("Option \"seed\" 3 Sampler \"independent\" \"integer seed\" 4 WorldBegin").sampler.seed, 4u);
  EXPECT_NEAR(scene_of("PixelFilter \"gaussian\" \"float alpha\" 2 WorldBegin").filter.sigma, 0.5, 1e-7);
}

TEST(ReadScene, EverySamplerButIndependentIsZsobol) {
  using Kind = SamplerDescription::Kind;
  const auto read = [](const std::string& name, std::size_t expected_warnings) {
    std::vector<Diagnostic> warnings;
    const SceneDescription s = scene_of("Sampler \"" + name + "\" WorldBegin", &warnings);
    EXPECT_EQ(warnings.size(), expected_warnings) << name;
    return s.sampler.kind;
  };
  EXPECT_EQ(scene_of("WorldBegin").sampler.kind, Kind::zsobol);
  EXPECT_EQ(read("independent", 0), Kind::independent);
  for (const char* name : {"zsobol", "sobol", "paddedsobol"}) EXPECT_EQ(read(name, 0), Kind::zsobol);
  for (const char* name : {"halton", "pmj02bn", "stratified"}) EXPECT_EQ(read(name, 1), Kind::zsobol);
}

TEST(ReadScene, FiltersHavePbrtsDefaults) {
  using Kind = PixelFilter::Kind;
  const auto filter = [](const std::string& text) {
    std::vector<Diagnostic> warnings;
    const SceneDescription s = scene_of("PixelFilter " + text + " WorldBegin", &warnings);
    EXPECT_TRUE(warnings.empty()) << text;
    return s.filter;
  };
  EXPECT_EQ(filter("\"box\""), (PixelFilter{Kind::box, 0.5f, 0.5f}));
  EXPECT_EQ(filter("\"gaussian\""), (PixelFilter{Kind::gaussian, 1.5f, 1.5f, 0.5f}));
  EXPECT_EQ(filter("\"triangle\""), (PixelFilter{Kind::triangle, 2, 2}));
  EXPECT_EQ(filter("\"mitchell\""), (PixelFilter{Kind::mitchell, 2, 2}));
  EXPECT_EQ(filter("\"sinc\""), (PixelFilter{Kind::sinc, 4, 4}));
  const PixelFilter mitchell = filter("\"mitchell\" \"float B\" 0.25 \"float C\" 0.5 \"float yradius\" 3");
  EXPECT_EQ(mitchell, (PixelFilter{Kind::mitchell, 2, 3, 0.5f, 0.25f, 0.5f}));
  EXPECT_EQ(filter("\"sinc\" \"float tau\" 2").tau, 2);
}

TEST(ReadScene, EveryPhaseFunctionOfTheKernelCanBeNamed) {
  for (const PhaseEntry& entry : phase_functions()) {
    const std::string head = "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"string phase\" \"" +
                             std::string(entry.table.name) + "\"";
    const SceneDescription s = world_of(head);
    ASSERT_EQ(s.media.size(), 1u);
    EXPECT_EQ(phase_functions()[static_cast<std::size_t>(s.media[0].phase)].table.name, entry.table.name);
    for (const PhaseParameter& p : entry.table.parameters) {
      if (p.name.empty()) break;
      const auto errors_at = [&](double value) {
        return errors_of("WorldBegin " + head + " \"float " + std::string(p.name) + "\" " + std::to_string(value))
            .size();
      };
      for (const double end : {p.lo, p.hi})
        EXPECT_EQ(errors_at(end), p.ends_included ? 0u : 1u) << entry.table.name << ' ' << p.name << ' ' << end;
      for (const double outside : {p.lo - 0.001, p.hi + 0.001})
        EXPECT_EQ(errors_at(outside), 1u) << entry.table.name << ' ' << p.name << ' ' << outside;
    }
  }
  EXPECT_EQ(errors_of("WorldBegin MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"string phase\" \"x\"").size(),
            1u);
}

TEST(ReadScene, ConstantSpectraOfLightsAreWhiteAtLuminanceOne) {
  const SceneDescription s = world_of("LightSource \"infinite\" \"spectrum L\" [200 7 900 7] \"float scale\" 3");
  EXPECT_NEAR(luminance(kind<InfiniteLight>(s.lights.at(0)).radiance), 3, 1e-5);
}

TEST(ReadScene, FilesAreFoundInTheScenesFolderElseAsGiven) {
  std::vector<Diagnostic> warnings;
  const std::string medium = "WorldBegin MakeNamedMedium \"m\" \"string type\" \"vdb\" \"string filename\" ";
  const auto file = [&](const std::string& name) {
    const SceneDescription s = read_scene_text(medium + '"' + name + '"', "t", test_folder("scenes"), warnings);
    return kind<FileMedium>(s.media.at(0)).filename;
  };
  EXPECT_EQ(file("fog.pbrt"), test_folder("scenes/fog.pbrt"));  // what it holds is not looked at here
  EXPECT_EQ(file("elsewhere/x.vdb"), "elsewhere/x.vdb");
  EXPECT_EQ(file("/x.vdb"), "/x.vdb");
}

TEST(ReadScene, FilesThatIncludeEachOtherTwiceEnd) {
  const std::string folder = testing::TempDir();
  for (int i = 0; i < 40; ++i) {
    std::ofstream out(folder + "/bomb" + std::to_string(i) + ".inc");
    const std::string next = "Include \"bomb" + std::to_string(i + 1) + ".inc\"\n";
    if (i < 39) out << next << next;
  }
  std::vector<Diagnostic> warnings;
  EXPECT_THROW(read_scene_text("WorldBegin Include \"bomb0.inc\"", "t", folder, warnings), InputError);
}

// A file that comes again and again stands for more text than any file holds.
TEST(ReadScene, TextThatIsIncludedAgainIsBounded) {
  const std::string folder = testing::TempDir(), include = "Include \"blank.inc\"\n";
  std::ofstream(folder + "/blank.inc") << std::string(std::size_t{1} << 24, '\n');
  std::string text = "WorldBegin\n" + include;
  for (int i = 0; i < 4; ++i) text += include;
  std::vector<Diagnostic> warnings;
  EXPECT_NO_THROW(read_scene_text(text, "t", folder, warnings));
  EXPECT_THROW(read_scene_text(text + include, "t", folder, warnings), InputError);
}

TEST(ReadScene, DefaultsAreBounded) {
  const auto defaults = [](int count) {
    std::string text = "Attribute \"shape\"";
    for (int i = 0; i < count; ++i) text += " \"float p" + std::to_string(i) + "\" 1";
    return text;
  };
  const std::string world = "WorldBegin ", again = " Attribute \"shape\" \"float p0\" 2", ball = " Shape \"sphere\"";
  EXPECT_TRUE(errors_of(world + defaults(256) + again + ball).empty());
  const auto is_refused = [](const std::string& text) {
    const std::vector<std::string> errors = errors_of(text);
    return errors.size() == 1 && errors[0].starts_with("more than 256 parameters are set for \"shape\"");
  };
  EXPECT_TRUE(is_refused(world + defaults(257) + ball));
  EXPECT_TRUE(is_refused(world + defaults(256) + " Attribute \"shape\" \"float q\" 1" + ball));
}

TEST(ReadScene, DeepNestingIsRefused) {
  std::string text = "WorldBegin\n";
  for (int i = 0; i < 20000; ++i) text += "AttributeBegin\n";
  EXPECT_FALSE(errors_of(text).empty());
}

// The example on the page of the language is the indented text after "A whole scene:".
TEST(ReadScene, TheExampleOfTheManualIsAScene) {
  std::istringstream page(read_file(test_folder("../../docs/scene-language.md")));
  std::string line, text;
  while (std::getline(page, line) && line != "A whole scene:") {
  }
  while (std::getline(page, line) && (line.empty() || line.starts_with("    "))) text += line + '\n';
  std::vector<Diagnostic> warnings;
  const SceneDescription s = scene_of(text, &warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(s.lights.size(), 2u);
  ASSERT_EQ(s.shapes.size(), 1u);
  EXPECT_EQ(s.shapes[0].inside, "cloud");
}

// Each file's names resolve against its own folder, and what stands in one goes on in the next.
TEST(ReadScene, SeveralFilesAreOneScene) {
  namespace fs = std::filesystem;
  const std::string folder = testing::TempDir() + "/brume_several_files";
  fs::create_directories(folder + "/a");
  fs::create_directories(folder + "/b");
  std::ofstream(folder + "/a/film.pbrt") << "Film \"rgb\" \"integer xresolution\" 7 WorldBegin AttributeBegin";
  std::ofstream(folder + "/b/world.pbrt") << "Translate 1 2 3 Include \"lamp.inc\" AttributeEnd";
  std::ofstream(folder + "/b/lamp.inc") << "LightSource \"point\"";
  std::vector<Diagnostic> warnings;
  const SceneDescription s = read_scene_files({folder + "/a/film.pbrt", folder + "/b/world.pbrt"}, warnings);
  EXPECT_EQ(s.file, folder + "/a/film.pbrt");
  EXPECT_EQ(s.film.width, 7);
  ASSERT_EQ(s.lights.size(), 1u);
  EXPECT_EQ(kind<PointLight>(s.lights[0]).from, (Vector3{1, 2, 3}));
  fs::remove_all(folder);
}

TEST(ReadScene, AMissingFileIsAnInputError) {
  std::vector<Diagnostic> warnings;
  EXPECT_THROW(read_scene(test_folder("scenes/none.pbrt"), warnings), InputError);
  EXPECT_THROW(read_scene(test_folder("scenes"), warnings), InputError);
}

}  // namespace
}  // namespace brume
