// The reader of scene files: one member function per directive, in reader.cpp (blocks, includes, names),
// transforms.cpp, files.cpp, film.cpp, options.cpp, media.cpp, shapes.cpp, objects.cpp, textures.cpp, materials.cpp and
// lights.cpp.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/description.h"
#include "scene/parameters.h"

namespace brume {

// What a material says of shapes.
struct Material {
  MaterialDescription surface;
  Relief relief;
};

// What AttributeBegin saves and AttributeEnd brings back.
struct GraphicsState {
  Transform ctm;  // the current transformation matrix: world from object, before WorldBegin camera from world
  bool only_end_is_active = false;  // transforms change where things move to, which nothing does
  bool reverse_orientation = false;
  ColourSpace colour_space = ColourSpace::srgb;  // of rgb values
  std::string inside, outside;
  Material material;
  std::optional<AreaLight> area_light;
  // Default parameters by the target of the Attribute directive; shared, since they may be large.
  std::map<std::string, std::shared_ptr<const std::vector<Parameter>>> defaults;
};

class Reader {
 public:
  explicit Reader(Messages& messages);

  // A file of a scene; relative file names in it resolve against `folder`.
  struct File {
    std::string name;
    std::string_view text;
    std::string folder;
  };
  // Reads a scene, file by file; errors are noted in the messages, and the scene then holds what could be read of it.
  // The texts must outlive the reader, and the reader the messages that it noted.
  SceneDescription read(const std::vector<File>& files);

 private:
  enum class Block { options, world, both };
  struct Directive {
    std::string_view name;
    Block block;
    void (Reader::*read)();
  };
  static const std::vector<Directive>& directives();

  void open(const File& file);
  void read_directives();
  void read_directive(const Token& word);
  void check_block(const Directive& directive);

  // Blocks, names and files.
  void world_begin();
  void world_end();
  void attribute_begin();
  void attribute_end();
  void transform_begin();
  void transform_end();
  void push_state(std::string_view begin);
  void pop_state(std::string_view begin, std::string_view end);
  void attribute();
  void include();
  void import();
  void end_import();
  void push_file();
  void refused();

  // Transforms.
  void identity();
  void translate_by();
  void scale_by();
  void rotate_by();
  void look_at_point();
  void transform();
  void concat_transform();
  void coordinate_system();
  void coord_sys_transform();
  void active_transform();
  void transform_times();
  void reverse_orientation();
  Transform matrix_argument();
  void multiply(const Transform& t);
  void set_ctm(const Transform& t);

  // Options.
  void camera();
  void film();
  void sampler();
  void pixel_filter();
  void gaussian_sigma(ParameterList& p);
  void integrator();
  void accelerator();
  void color_space();
  void option();
  void screen_window(ParameterList& parameters);
  void crop_window(ParameterList& parameters);
  void sensor(ParameterList& parameters);

  // The world.
  void make_named_medium();
  void medium_interface();
  void shape();
  void add_shape(ShapeDescription shape);
  void object_begin();
  void object_end();
  void object_instance();
  void texture();
  void material();
  void make_named_material();
  void named_material();
  void light_source();
  void area_light_source();
  InfiniteLight infinite_light(ParameterList& p, const Transform& ctm);
  TriangleMeshShape ply_mesh(ParameterList& p);
  TriangleMeshShape obj_mesh(ParameterList& p);
  std::optional<Displacement> displacement(ParameterList& p);
  TextureMapping read_mapping(ParameterList& p);
  ImageTexture read_image_texture(ParameterList& p);
  // The colour, or with is_float the number, that a parameter of a texture gives, or the texture that it names.
  Textured textured(ParameterList& p, std::string_view name, bool is_float, const Textured& fallback);
  // Takes the texture that the parameter names, where it names one, in place of the value.
  void use_texture(ParameterList& p, std::string_view name, bool is_float, Textured& value);
  Material read_material(const std::string& given, const Place& type_place, ParameterList& p);
  MaterialDescription read_surface(const std::string& given, const Place& type_place, ParameterList& p);
  Relief read_relief(ParameterList& p);

  // Arguments of directives; what is not there leaves the directive with an error.
  std::string string_argument(std::string_view what);
  double number_argument();
  Vector3 vector_argument();
  // The parameters that follow, colours in the current colour space and spectra read from their files.
  std::vector<Parameter> read_list();
  void read_spectrum_file(Parameter& parameter);
  // The parameter list of the directive being read, with the defaults of `target` where that is not empty.
  ParameterList parameters(const std::string& owner, const std::string& target = {});
  // The current transformation matrix, which must not be singular, for `what`.
  Transform usable_ctm(std::string_view what);
  // `old_name` to `name` with a warning, where `given` is it.
  void modernise(std::string& given, std::string_view old_name, std::string_view name);
  // About a type of `what` at `place` that is not among those read here.
  [[noreturn]] void unknown_type(const Place& place, std::string_view what, std::string_view type,
                                 const std::vector<std::string_view>& read_here,
                                 const std::vector<std::string_view>& of_pbrt);
  // A file name of the scene: in the folder where there is such a file, else as given.
  std::string resolve(const std::string& filename);
  // The file that a parameter names, resolved; "" where it names none.
  GivenName file_name(ParameterList& p, std::string_view parameter);
  const Source& open_source(const std::string& filename, const Place& place);

  // What only the whole scene shows.
  void check_whole();
  void check_media_names();
  void check_volumes();
  void check_object_names();

  std::string folder_;  // of the file being read
  Messages& messages_;
  TokenStream tokens_;
  std::vector<std::unique_ptr<Source>> sources_;
  std::map<std::string, std::string> texts_;  // of included files, by name
  std::map<std::string, const Source*> sources_by_name_;
  int inclusions_ = 0;
  std::set<const Source*> included_;
  std::size_t repeated_text_ = 0;  // bytes, of all inclusions but the first of each file

  SceneDescription scene_;
  GraphicsState state_;
  struct Saved {
    GraphicsState state;
    std::string_view begin;  // the directive that saved it
    Place place;
  };
  std::vector<Saved> stack_;
  std::map<std::string, Transform> coordinate_systems_;
  // Files that are being imported, and what there was before.
  struct Imported {
    GraphicsState state;
    std::map<std::string, Transform> coordinate_systems;
    std::size_t stack_size;
    std::size_t depth;  // of open files, the imported one included
  };
  std::vector<Imported> imports_;
  std::map<std::string, Material> named_materials_;
  bool in_world_ = false;
  std::optional<std::uint32_t> sampler_seed_, global_seed_;
  Token directive_;     // the one being read
  Place argument_;      // the string last taken as its argument
  bool early_ = false;  // something that belongs after WorldBegin stood before it, and was reported

  struct NamedMedium {
    std::size_t index;  // into scene_.media
    Place place;        // of its name
  };
  std::map<std::string, NamedMedium, std::less<>> media_by_name_;
  std::map<std::string, Place> medium_uses_;  // the first of each name
  // Names of things that were to be made; where there is none, an error was noted.
  std::set<std::string> media_tried_, materials_tried_, textures_tried_;
  struct VolumeUse {
    std::string inside;
    Transform ctm;
    Place place;
  };
  std::vector<VolumeUse> volume_uses_;
  // Indices into scene_.textures, of colours and of numbers.
  std::map<std::string, int, std::less<>> textures_by_name_[2];
  std::vector<int> texture_sizes_;                                   // how many textures each evaluates
  bool in_object_ = false;                                           // between ObjectBegin and ObjectEnd
  std::map<std::string, std::size_t, std::less<>> objects_by_name_;  // index into scene_.objects
  std::map<std::string, Place> object_uses_;                         // the first of each name
};

}  // namespace brume
