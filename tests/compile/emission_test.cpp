// Emission from place to place as compiled: the table of black bodies, and grids of temperatures from every source.
#include <gtest/gtest.h>

#include "base/file.h"
#include "compile/compile.h"
#include "image/temporary_folder.h"
#include "scene/colour.h"
#include "volume/procedural.h"
#include "volume/write_vdb.h"

namespace brume {
namespace {

SceneDescription scene_with(MediumDescription medium) {
  SceneDescription s;
  medium.name = "fire";
  medium.temperatures = TemperatureScale{};
  medium.emission = constant_spectrum(1);
  medium.phase_parameters = {0};
  s.media = {std::move(medium)};
  s.shapes.emplace_back();
  s.shapes[0].material = InterfaceMaterial{};
  s.shapes[0].inside = "fire";
  s.shapes[0].kind = VolumeShape{};
  return s;
}

CompiledScene compiled(const SceneDescription& scene) {
  std::vector<Diagnostic> warnings;
  return compile(scene, 2, warnings);
}

std::string error_of(const SceneDescription& scene) {
  try {
    compiled(scene);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

kernel::vec3 index_point(const CompiledMedium& medium, Vector3 world) {
  const Vector3 p = medium.index_from_world.point(world);
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

const Procedural fire = usual_procedural(ProceduralName::fire, 40, 2);

MediumDescription fire_of_file(const std::string& path) {
  MediumDescription medium;
  medium.kind = FileMedium{path, "density", "temperature", false};
  medium.storage_bits = 32;
  return medium;
}

// Interpolation in the table is within 1e-3 of Planck's law itself from 600 K on, and what is colder than 400 K is
// dark.
TEST(BlackbodyTable, IsPlancksLaw) {
  MediumDescription medium;
  medium.kind = ProceduralMedium{fire};
  const CompiledScene scene = compiled(scene_with(medium));
  for (double kelvin = 600.3; kelvin < 99000; kelvin *= 1.0137) {
    const kernel::vec3 found = kernel::blackbody_at(scene.blackbody.data(), static_cast<float>(kelvin));
    const Spectrum expected = blackbody_emission(kelvin);
    const float tolerance = 1e-3f * max_value(expected);
    EXPECT_NEAR(found.x, expected[0], tolerance) << kelvin;
    EXPECT_NEAR(found.y, expected[1], tolerance) << kelvin;
    EXPECT_NEAR(found.z, expected[2], tolerance) << kelvin;
  }
  for (const float kelvin : {-1e30f, -5.0f, 0.0f, 300.0f, 399.0f})
    EXPECT_EQ(kernel::blackbody_at(scene.blackbody.data(), kelvin).x, 0) << kelvin;
  EXPECT_EQ(kernel::blackbody_at(scene.blackbody.data(), 1e30f).x,
            kernel::blackbody_at(scene.blackbody.data(), 2e5f).x);
}

// A fire emits the same when it was written to a file, where each grid has a box of its own.
TEST(EmissionFactor, OfAFileIsThatOfTheProcedural) {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/fire.vdb";
  write_file_atomically(path, encode_vdb(procedural_grids(fire, Storage::f32, 2), false, "test"));
  MediumDescription made;
  made.kind = ProceduralMedium{fire};
  made.storage_bits = 32;
  const CompiledScene a = compiled(scene_with(made)), b = compiled(scene_with(fire_of_file(path)));
  int bright = 0;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const auto along = [&](std::uint32_t axis) { return 2 * kernel::random_uniform(1, 0, i, axis) - 1; };
    const Vector3 p{0.24 * static_cast<double>(along(0)), 0.9 * static_cast<double>(along(1)),
                    0.24 * static_cast<double>(along(2))};
    const Spectrum of_a = emission_at(a.media[0], emission_field(a, a.media[0]), index_point(a.media[0], p));
    const Spectrum of_b = emission_at(b.media[0], emission_field(b, b.media[0]), index_point(b.media[0], p));
    ASSERT_NEAR(of_a[0], of_b[0], 1e-3f * of_a[0] + 1e-6f) << p.x << ' ' << p.y << ' ' << p.z;
    bright += of_a[0] > 1;
  }
  EXPECT_GT(bright, 500);
}

TEST(EmissionFactor, OfAFileWithoutTemperaturesIsMissingOrAnError) {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/smoke.vdb";
  std::vector<VolumeGrid> grids = procedural_grids(fire, Storage::f32, 2);
  grids.pop_back();
  write_file_atomically(path, encode_vdb(grids, false, "test"));
  MediumDescription medium = fire_of_file(path);
  const CompiledScene dark = compiled(scene_with(medium));
  EXPECT_EQ(dark.media[0].emission_factor, -1);
  EXPECT_TRUE(is_zero(dark.media[0].emission));
  std::get<FileMedium>(medium.kind).temperature_asked_for = true;
  EXPECT_EQ(error_of(scene_with(medium)),
            path + ": error: has no grid \"temperature\"; it has density (float, fog volume)");
}

// Where the density is not 0, there is a chance to look for emission.
TEST(EmissionFactor, CellsLeaveNothingOut) {
  MediumDescription medium;
  UniformGridMedium grid{{24, 1, 1}, {0, 0, 0}, {1, 1, 1}, std::vector<float>(24, 0), std::vector<float>(24, 0), {}};
  grid.density[3] = grid.density[13] = 1;
  grid.temperature[4] = 2000;  // half-way to the density, nowhere at a voxel's centre
  medium.kind = grid;
  const CompiledScene scene = compiled(scene_with(medium));
  const auto& cells = scene.emission_factors.at(0).cells;
  ASSERT_EQ(cells.size(), scene.grids[0].majorants.size());
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(cells[i] != 0, scene.grids[0].majorants[i] != 0) << i;
}

}  // namespace
}  // namespace brume
