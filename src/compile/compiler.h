// The state of one compilation, shared by the files of this folder.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/diagnostics.h"
#include "compiled/compiled_scene.h"
#include "scene/description.h"

namespace brume {

inline Vector3 to_vector(const std::array<float, 3>& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

// Whether the shape's normal in the world is the negative of what its own coordinates, moved, say.
bool flips_normal(const ShapeDescription& shape);
// A shading normal of the shape in the world.
Vector3 world_normal(const ShapeDescription& shape, Vector3 n);

class Compiler {
 public:
  Compiler(const SceneDescription& scene, int threads) : scene_(scene), threads_(threads) {}
  // Throws InputError with all errors found.
  CompiledScene run(std::vector<Diagnostic>& warnings);
  // What is wrong with the volumes and pictures that the scene names.
  std::vector<Diagnostic> file_errors();

 private:
  void add_camera();
  void add_integrator();
  void add_lights();
  std::vector<ShapeDescription> balls_of_lights() const;
  void add_ambient_light(const AmbientLight& light, const Location& location);
  void add_infinite_light(const LightDescription& description);
  bool read_environment(const GivenName& filename, CompiledEnvironment& environment);
  // Lights that the parts of a shape are, whose geometry is there already.
  void add_area_lights(const AreaLight& light, std::vector<CompiledShape>& parts);
  // What an area light's radiance is multiplied by over its shape, and the mean of that.
  struct LightImage {
    std::int32_t texture = -1;  // below 0: 1 everywhere
    Spectrum mean = constant_spectrum(1);
  };
  // Read on first use.
  LightImage light_image(const AreaLight& light);
  // The light's place, and its area in the world.
  double add_emitting_geometry(const CompiledShape& shape, CompiledLight& light);
  // Fills in with which chance each light is chosen.
  void add_light_choice();
  double scene_radius() const;
  // Of the object in its own space.
  Box3 object_bounds(const CompiledObject& object) const;
  Box3 bounds_of(std::span<const CompiledShape> shapes) const;
  // An error where the box reaches beyond farthest_coordinate.
  void check_range(const Box3& box, std::string_view what, const Location& location);

  // The index of the medium called `name` in the compiled scene, which is added on first use; no_medium for "" and for
  // names that are not defined (an error).
  std::int32_t medium_index(const std::string& name, const Location& used_at);
  CompiledMedium make_medium(const MediumDescription& medium);
  // An error where the grid is too large, too small or too dense in the world.
  void check_grid(const Transform& world_from_index, const CompiledMedium& c, const MediumDescription& medium);
  struct LoadedGrid {
    int index;  // below 0: none
    Transform medium_from_index;
  };
  // The grid that `load` returns, or one that was loaded before under the same key. One that cannot be read is an error
  // where the medium gives the name of the file, or `grid_name`, that of the grid.
  template <class Load>
  LoadedGrid loaded_grid(const MediumDescription& medium, const GivenName& grid_name, const std::string& key,
                         Load load);
  LoadedGrid density_grid(const MediumDescription& medium);
  LoadedGrid temperature_grid(const MediumDescription& medium);
  LoadedGrid strength_grid(const MediumDescription& medium);
  // Emission by temperatures or from place to place, for a medium whose grid is there and that emits.
  void add_emission_factor(const MediumDescription& medium, const LoadedGrid& density, CompiledMedium& compiled);

  // The medium fills the bounds of its grid.
  void add_volume(std::int32_t medium);
  // Turns shapes that are nothing but boundaries of media, and boxes or spheres, into volumes.
  void boundaries_to_volumes();

  void add_shapes();
  void add_instances();
  void add_shape(const ShapeDescription& shape);
  void check_cut_out(const ShapeDescription& shape);
  bool passes_all_rays(const CompiledShape& shape) const;
  // What the shape consists of, apart from materials, media and lights.
  std::vector<CompiledShape> add_geometry(const ShapeDescription& shape);
  CompiledShape add_quadric(const CompiledQuadric& quadric);
  CompiledShape add_mesh(const ShapeDescription& shape, const TriangleMeshShape& mesh);
  // After an error, the mesh as it is.
  TriangleMeshShape displaced_mesh(const ShapeDescription& shape, const TriangleMeshShape& mesh);
  std::vector<CompiledShape> add_patches(const ShapeDescription& shape, const BilinearMeshShape& patches);
  CompiledShape add_saddle(const ShapeDescription& shape, const Transform& object_from_saddle,
                           const std::array<Vector3, 4>& normals, const std::array<std::array<double, 2>, 4>& uv);
  std::int32_t material_index(const MaterialDescription& material, const Relief& relief);
  // A medium that fills the inside of the shape with these parts beside what is there, and does nothing but absorb.
  void add_absorption(std::vector<CompiledShape> parts, const Spectrum& sigma_a);
  // All but the tables of a coat.
  CompiledMaterial compile_material(const MaterialDescription& material) const;

  void add_textures();
  std::int32_t add_texture(const CompiledTexture& texture);
  // The compiled texture that a texture's operand is.
  std::int32_t operand(const Textured& value);
  // Of normals, which are not light: its values are linear.
  std::int32_t normal_map(const Relief& relief);
  // The index of a picture of `owner`, which is read on first use; below 0 after an error.
  std::int32_t image_index(const ImageTexture& from, bool is_float, const std::string& owner);

  void error(const Location& location, const std::string& message);

  const SceneDescription& scene_;
  int threads_;
  CompiledScene compiled_;
  std::vector<Diagnostic> errors_, warnings_;
  std::map<std::string, std::int32_t> media_;  // by name
  std::vector<std::int32_t> absorbers_;        // media of bodies that absorb
  bool warned_of_ambient_light_ = false;
  std::vector<double> mean_brightness_;  // of the environments
  struct LightArea {
    std::size_t light;
    double area;        // in the world
    double brightness;  // the mean of what its radiance is multiplied by
  };
  std::vector<LightArea> light_areas_;                            // of the area lights
  std::size_t first_world_vertex_ = 0, first_world_quadric_ = 0;  // those before belong to objects
  std::map<CompiledMaterial, std::int32_t> materials_;            // as they are before add_coat_tables
  std::vector<std::int32_t> textures_;  // in the compiled scene, by the index of their description
  std::map<std::tuple<std::string, double, bool>, std::int32_t> images_;  // by file, gamma and whether of numbers
  std::map<std::string, LightImage> light_images_;                        // by file
  std::map<std::string, std::int32_t> normal_maps_;                       // textures, by file
  std::map<std::string, LoadedGrid> grids_;                               // by file, grid, storage and interpolation
};

}  // namespace brume
