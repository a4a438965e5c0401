// The state of one compilation, shared by the files of this folder.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "compiled/compiled_scene.h"
#include "scene/description.h"

namespace brume {

class Compiler {
 public:
  Compiler(const SceneDescription& scene, int threads) : scene_(scene), threads_(threads) {}
  // Throws InputError with all errors found.
  CompiledScene run(std::vector<Diagnostic>& warnings);

 private:
  void add_camera();
  void add_integrator();
  void add_lights();
  void add_infinite_light(const LightDescription& light);
  bool read_environment(const std::string& filename, const Location& location, CompiledEnvironment& environment);
  // The index of the shape's light, whose geometry is there already.
  std::int32_t add_area_light(const AreaLight& light, const CompiledShape& shape);
  // Fills in with which chance each light is chosen.
  void add_light_choice();
  double scene_radius() const;

  // The index of the medium called `name` in the compiled scene, which is added on first use; no_medium for "" and for
  // names that are not defined (an error).
  std::int32_t medium_index(const std::string& name, const Location& used_at);
  CompiledMedium make_medium(const MediumDescription& medium);
  struct LoadedGrid {
    int index;  // below 0: none
    Transform medium_from_index;
  };
  // The grid that `load` returns, or one that was loaded before under the same key. One that cannot be read is an error
  // at the medium.
  template <class Load>
  LoadedGrid loaded_grid(const MediumDescription& medium, const std::string& key, Load load);
  LoadedGrid density_grid(const MediumDescription& medium);
  LoadedGrid temperature_grid(const MediumDescription& medium);
  LoadedGrid strength_grid(const MediumDescription& medium);
  // Emission by temperatures or from place to place, for a medium whose grid is there and that emits.
  void add_emission_factor(const MediumDescription& medium, const LoadedGrid& density, CompiledMedium& compiled);

  // The medium fills the bounds of its grid.
  void add_volume(std::int32_t medium);
  // Turns shapes that are nothing but boundaries of media, and boxes or spheres, into volumes.
  void boundaries_to_volumes();

  void add_shape(const ShapeDescription& shape);
  void add_geometry(const ShapeDescription& shape, CompiledShape& compiled);
  std::uint32_t add_mesh(const ShapeDescription& shape, const std::vector<Vector3>& positions,
                         const std::vector<std::array<std::uint32_t, 3>>& triangles,
                         const std::vector<Vector3>& normals);
  std::int32_t material_index(const MaterialDescription& material);

  void error(const Location& location, const std::string& message);

  const SceneDescription& scene_;
  int threads_;
  CompiledScene compiled_;
  std::vector<Diagnostic> errors_, warnings_;
  std::map<std::string, std::int32_t> media_;  // by name
  std::vector<double> mean_brightness_;        // of the environments
  struct LightArea {
    std::size_t light;
    double area;  // in the world
  };
  std::vector<LightArea> light_areas_;       // of the area lights
  std::map<std::string, LoadedGrid> grids_;  // by file, grid, storage and interpolation
};

}  // namespace brume
