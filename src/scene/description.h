// SceneDescription: a scene as plain structs, the one thing that readers make and that compile takes. Values are
// checked and in their final units (world units, radians nowhere: angles in degrees as scenes give them), colours are
// scene-linear Rec.709; each entity remembers where in which file it stood. The large structs have their special
// members in description.cpp: otherwise every file that handles scenes compiles them, a third of its time.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/colour_space.h"
#include "base/diagnostics.h"
#include "base/geometry.h"
#include "base/pixel_box.h"
#include "base/pixel_filter.h"
#include "base/procedural.h"
#include "base/spectrum.h"
#include "base/sphere_map.h"
#include "kernel/phase_table.h"

namespace brume {

// A name that a scene gives, of a file or of something in one, and where it gives it.
struct GivenName {
  GivenName() = default;
  GivenName(std::string name, Location at = {}) : text(std::move(name)), location(std::move(at)) {}
  GivenName(const char* name) : text(name) {}
  bool empty() const { return text.empty(); }
  operator const std::string&() const { return text; }
  bool operator==(const GivenName& other) const { return text == other.text; }

  std::string text;
  Location location;
};

struct FilmDescription {
  std::string filename = "brume.exr";
  int width = 1280, height = 720;
  std::array<double, 4> crop_window{0, 1, 0, 1};  // x0 x1 y0 y1, as fractions: the part that is rendered
  bool save_fp16 = true;
  // What becomes of radiance: it is multiplied by the time that the camera's shutter is open times iso / 100, and the
  // light of white_balance kelvin becomes white; 0: the light of the colour space's white.
  ColourSpace colour_space = ColourSpace::srgb;  // of the picture
  double iso = 100, white_balance = 0;
  double max_component = std::numeric_limits<double>::infinity();  // samples above it are scaled down to it
};

// The pixels of the crop window. As pbrt has it, a pixel belongs to the window that its upper left corner lies in: from
// ceil(x0 width) up to ceil(x1 width), so that windows which tile the picture share no pixel. A millionth of a pixel is
// taken for rounding.
inline PixelBox cropped_pixels(const FilmDescription& film) {
  const auto first = [](double fraction, int edge) { return static_cast<int>(std::ceil(fraction * edge - 1e-6)); };
  const std::array<double, 4>& c = film.crop_window;
  return {first(c[0], film.width), first(c[1], film.width), first(c[2], film.height), first(c[3], film.height)};
}

struct SamplerDescription {
  enum class Kind { independent, zsobol } kind = Kind::zsobol;
  int pixel_samples = 16;
  std::uint32_t seed = 0;
};

// pbrt's, in the order of PixelFilter::Kind.
inline constexpr std::string_view filter_names[] = {"box", "gaussian", "mitchell", "triangle", "sinc"};

inline constexpr std::string_view sphere_map_names[] = {"equalarea", "equirectangular"};

struct CameraDescription {
  Transform world_from_camera;  // camera space: +x right, +y up, +z forward
  // Shows all directions, with +y for the map's +z and +z for its +y; fov to focal_distance are of no use then.
  std::optional<SphereMap> sphere_map;
  double fov = 90;                        // degrees across the shorter image side
  std::array<double, 4> screen_window{};  // x0 x1 y0 y1; all 0: from the aspect of the film
  double lens_radius = 0;                 // in camera space, as is the next; 0: a pinhole
  double focal_distance = 1e6;            // along the axis
  double shutter_open = 0, shutter_close = 1;
  std::string medium;  // what the Camera directive records: the outside medium then current, or ""
  Location location;
};

enum class Traversal { march, dda };
enum class VolumeShadows { march, cached };
enum class Placement { start, random, middle, middle_random };

// "classic" and "reference" are Brume's own; the others are pbrt-v4's, and "volpath" renders what they would.
inline constexpr std::string_view integrator_names[] = {"classic", "reference",  "volpath",    "simplevolpath",
                                                        "path",    "simplepath", "randomwalk", "lightpath",
                                                        "bdpt",    "mlt",        "sppm",       "ambientocclusion"};

struct IntegratorDescription {
  std::string name = "volpath";
  int max_depth = 5;
  Traversal traversal = Traversal::march;
  Placement placement = Placement::middle;
  double step = 0;  // world units; 0 is the default of each medium
  VolumeShadows volume_shadows = VolumeShadows::march;
  int shadow_samples = 1;  // classic: shadow rays from a surface to a light with a size
  Location location;
};

// Extinction and scattering coefficients per world unit at density 1, already times `scale`.
struct HomogeneousMedium {};

struct UniformGridMedium {
  std::array<int, 3> resolution{1, 1, 1};
  Vector3 p0{0, 0, 0}, p1{1, 1, 1};
  std::vector<float> density;        // x fastest
  std::vector<float> temperature{};  // the same; empty: none
  std::vector<float> strength{};     // what emission is multiplied by; empty: 1 everywhere
};

// Type "rgbgrid": coefficients of each cell and channel, times `sigma_a` and `sigma_s` of the medium; `emission` of the
// medium multiplies what is emitted.
struct RgbGridMedium {
  std::array<int, 3> resolution{1, 1, 1};
  Vector3 p0{0, 0, 0}, p1{1, 1, 1};
  std::vector<float> sigma_a, sigma_s;  // three a cell, x fastest; empty: 1 everywhere
  std::vector<float> emission;          // Le, three a cell; empty: none
};

// Type "vdb", "nanovdb" or "vol": a grid from a file (its suffix says of which kind), read when the scene is compiled.
struct FileMedium {
  GivenName filename;  // resolved
  GivenName grid;      // "" chooses
  // Of temperatures; "": none. One that was not asked for by name may be missing.
  GivenName temperature_grid{};
  bool temperature_asked_for = false;
};

// Type "procedural".
struct ProceduralMedium {
  Procedural procedural = usual_procedural(ProceduralName::cloud);
};

// Emission by temperature: where the medium's grid of temperatures holds t, as of a black body at (t - offset) scale
// kelvin.
struct TemperatureScale {
  double offset = 0, scale = 1;
  bool operator==(const TemperatureScale&) const = default;
};

// Type "cloud".
struct CloudMedium {
  NoiseCloud cloud;
};

struct MediumDescription {
  MediumDescription();
  MediumDescription(const MediumDescription&);
  MediumDescription(MediumDescription&&) noexcept;
  MediumDescription& operator=(const MediumDescription&);
  MediumDescription& operator=(MediumDescription&&) noexcept;
  ~MediumDescription();

  std::string name;
  Transform world_from_medium;
  Spectrum sigma_a = constant_spectrum(1), sigma_s = constant_spectrum(1);
  // Le: the emitted radiance is sigma_a Le per unit of length. With temperatures, what black bodies' colours (see
  // blackbody_emission in scene/colour.h) are multiplied by.
  Spectrum emission;
  std::optional<TemperatureScale> temperatures{};
  int phase = phase_kind("henyey_greenstein");  // index into phase_functions()
  std::vector<float> phase_parameters = {0};    // in the order of the phase function's table
  bool linear_interpolation = true;
  int storage_bits = 16;  // 8, 16 or 32
  bool sanitize = false;  // whether densities of files that are negative or not finite are taken as 0
  std::variant<HomogeneousMedium, UniformGridMedium, FileMedium, ProceduralMedium, CloudMedium, RgbGridMedium> kind;
  Location location;
};

// What may vary over a surface: a value, or in its place a texture. For numbers all channels are the same.
struct Textured {
  Spectrum value;
  int texture = -1;  // in SceneDescription::textures; below 0: the value
  Textured() = default;
  Textured(const Spectrum& v) : value(v) {}
  bool operator==(const Textured&) const = default;
};

// From a place on a surface to the plane of a texture: (u_scale u + u_offset, v_scale v + v_offset), or planar, of a
// point p in the texture's space, (dot(p, v1) + u_offset, dot(p, v2) + v_offset).
struct TextureMapping {
  bool planar = false;
  double u_scale = 1, v_scale = 1, u_offset = 0, v_offset = 0;
  Vector3 v1{1, 0, 0}, v2{0, 1, 0};
  Transform world_from_texture;
  bool operator==(const TextureMapping&) const = default;
};

struct ConstantTexture {
  Spectrum value = constant_spectrum(1);
  bool operator==(const ConstantTexture&) const = default;
};
struct ScaleTexture {
  Textured texture = constant_spectrum(1), scale = constant_spectrum(1);
  bool operator==(const ScaleTexture&) const = default;
};
// (1 - amount) first + amount second.
struct MixTexture {
  Textured first, second = constant_spectrum(1), amount = constant_spectrum(0.5f);
  bool operator==(const MixTexture&) const = default;
};
// The first where floor(s) + floor(t) is even, else the second.
struct CheckerboardTexture {
  Textured first = constant_spectrum(1), second;
  TextureMapping mapping;
  bool operator==(const CheckerboardTexture&) const = default;
};
// A picture over the unit square, its lowest row at t = 0; times scale, and where inverted taken from 1.
struct ImageTexture {
  enum class Wrap { repeat, clamp, black };
  GivenName filename;    // resolved
  double gamma = 0;      // of .png files: 0 is sRGB's curve, else linear values are the file's to this power
  bool bilinear = true;  // else the nearest pixel
  Wrap wrap = Wrap::repeat;
  double scale = 1;
  bool invert = false;
  TextureMapping mapping;
  bool operator==(const ImageTexture&) const = default;
};

struct TextureDescription {
  std::string name;
  bool is_float = false;  // of numbers, else of colours; the two have names of their own
  std::variant<ConstantTexture, ScaleTexture, MixTexture, CheckerboardTexture, ImageTexture> kind;
  Location location;
};

struct DiffuseMaterial {
  Textured reflectance = constant_spectrum(0.5f);
};
// A diffuse colour and a highlight about the mirror's direction, tinted by the diffuse colour as far as the material is
// metallic; a mirror of colour `reflection`; and a share `refraction` of the light for which the surface is glass that
// absorbs within (see CompiledMaterial). `ambient` is the colour under light that comes from nowhere.
struct BlinnPhongMaterial {
  Textured diffuse = constant_spectrum(0.5f);
  Spectrum specular, reflection;
  float shininess = 32;
  Spectrum refraction{}, absorption{};  // absorption: per world unit
  Textured ambient = constant_spectrum(0.5f);
  float metallic = 0, index = 1.5f;
};
// No surface: the boundary of a medium.
struct InterfaceMaterial {};
// A metal, by its complex index of refraction. Here and below alpha is the width of the distribution of facets
// (base/microfacet.h); 0 is smooth.
struct ConductorMaterial {
  Spectrum eta, k;
  float alpha = 0;
};
// Glass, by the index of refraction of its inside over that of its outside.
struct DielectricMaterial {
  float eta = 1.5f;
  float alpha = 0;
};
// A diffuse base under a clear coat, whose index of refraction over that of the outside is eta.
struct CoatedDiffuseMaterial {
  Textured reflectance = constant_spectrum(0.5f);
  float eta = 1.5f;
  float alpha = 0;
};
using MaterialDescription = std::variant<DiffuseMaterial, BlinnPhongMaterial, InterfaceMaterial, ConductorMaterial,
                                         DielectricMaterial, CoatedDiffuseMaterial>;

// Bumps that a material only seems to have: they turn shading normals, and leave the shape as it is. At most one of the
// two is given.
struct Relief {
  int displacement = -1;  // a texture of numbers, in SceneDescription::textures: how far points seem to be moved
  GivenName normal_map;   // an image, resolved; "": none
};

// About the origin, cut at z_min and z_max.
struct SphereShape {
  double radius = 1;
  double z_min = -std::numeric_limits<double>::infinity(), z_max = std::numeric_limits<double>::infinity();
  double phi_max = 360;  // degrees from the x axis
};
// Vertices move along their normals, in the space of the mesh, by what a texture of numbers is at their uv, after
// triangles were split until no edge is longer than edge_length in the world (in an object, in the space of the
// object).
struct Displacement {
  int texture = 0;  // in SceneDescription::textures
  double edge_length = 1;
  bool operator==(const Displacement&) const = default;
};
struct TriangleMeshShape {
  std::vector<Vector3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices checked
  std::vector<Vector3> normals;                         // empty or one per position
  std::vector<std::array<double, 2>> uv{};              // likewise
  std::optional<Displacement> displacement{};
};
// Surfaces p(u, v) between four points each, at the corners (0, 0), (1, 0), (0, 1), (1, 1), linear in u and in v.
struct BilinearMeshShape {
  std::vector<Vector3> positions;
  std::vector<std::array<std::uint32_t, 4>> patches;  // indices checked
  std::vector<Vector3> normals{};                     // empty or one per position
  std::vector<std::array<double, 2>> uv{};            // likewise
};
// A parallelogram: origin, origin + edge_u, origin + edge_u + edge_v, origin + edge_v.
struct QuadShape {
  Vector3 origin{-1, 0, 1}, edge_u{2, 0, 0}, edge_v{0, 0, -2};
};
// In the plane z = height, facing +z.
struct DiskShape {
  double radius = 1, height = 0, inner_radius = 0;
  double phi_max = 360;  // degrees from the x axis
};
// About the z axis; caps are disks at its ends, with their normals outwards.
struct CylinderShape {
  double radius = 1, z_min = -1, z_max = 1;
  double phi_max = 360;
  bool caps = false;
};
// The bounds of the inside medium itself, without a surface.
struct VolumeShape {};

// What a shape sends out on the side of its normal, or on both.
struct AreaLight {
  Spectrum radiance;
  bool two_sided = false;
  // Above 0: `radiance` is to be multiplied by power / (pi area), halved where two-sided, and divided by the image's
  // mean luminance.
  double power = 0;
  GivenName filename{};  // of an image over the shape's (u, v) that multiplies `radiance`, resolved; "" for none
};

struct ShapeDescription {
  ShapeDescription();
  ShapeDescription(const ShapeDescription&);
  ShapeDescription(ShapeDescription&&) noexcept;
  ShapeDescription& operator=(const ShapeDescription&);
  ShapeDescription& operator=(ShapeDescription&&) noexcept;
  ~ShapeDescription();

  Transform world_from_object;
  // By ReverseOrientation alone; a transform that mirrors flips the normal too, as pbrt's does.
  bool reverse_orientation = false;
  MaterialDescription material;
  Relief relief;
  Textured alpha = constant_spectrum(1);  // the share of rays that meet it; the others pass
  std::string inside, outside;            // media; "" is none
  std::optional<AreaLight> light{};
  std::variant<SphereShape, TriangleMeshShape, BilinearMeshShape, QuadShape, DiskShape, CylinderShape, VolumeShape>
      kind;
  Location location;
};

// Whether rays may pass it.
inline bool is_cut_out(const ShapeDescription& shape) { return shape.alpha != Textured(constant_spectrum(1)); }

// Shapes that appear where instances place them. Their world_from_object leads to the space of the object.
struct ObjectDescription {
  std::string name;
  std::vector<ShapeDescription> shapes;  // none shines, none is a volume
};
struct InstanceDescription {
  std::string object;  // its name
  Transform world_from_object;
  Location location;
};

struct PointLight {
  Vector3 from;        // world
  Spectrum intensity;  // times scale
};
// A point that shines in a cone: with all its intensity within cone_angle - cone_delta of the axis, and from there on
// less and less up to cone_angle.
struct SpotLight {
  Vector3 from, to{0, 0, 1};  // world; the axis goes from the one to the other
  Spectrum intensity;         // on the axis, times scale
  double cone_angle = 30, cone_delta = 5;
};
struct DistantLight {
  Vector3 direction_to_light;  // world, unit
  Spectrum radiance;           // irradiance on a surface that faces it
};
// Constant, or an image around the scene.
struct InfiniteLight {
  Spectrum radiance;     // multiplies the image
  GivenName filename{};  // of the image, resolved; "" for none
  Transform world_from_light{};
  double illuminance = 0;  // above 0: an image is scaled to this illuminance of a surface that faces the light's +z
  // The corners p0 to p3 of a rectangle in the world: the light is seen only through it, and only along directions on
  // the side of (p3 - p0) x (p1 - p0).
  std::optional<std::array<Vector3, 4>> portal{};
};
// A black ball that shines alike in all directions.
struct SphereLight {
  Vector3 from;  // world: its centre
  double radius = 1;
  Spectrum intensity;  // of the whole ball, times scale
};
// Light of this radiance from everywhere that nothing shadows: for the integrator "classic".
struct AmbientLight {
  Spectrum radiance;
};
struct LightDescription {
  std::variant<PointLight, SpotLight, DistantLight, InfiniteLight, SphereLight, AmbientLight> kind;
  Location location;
};

struct SceneDescription {
  SceneDescription();
  SceneDescription(const SceneDescription&);
  SceneDescription(SceneDescription&&) noexcept;
  SceneDescription& operator=(const SceneDescription&);
  SceneDescription& operator=(SceneDescription&&) noexcept;
  ~SceneDescription();

  std::string file = "scene";      // the first that it was read from, for messages about all of it
  std::vector<std::string> files;  // all that were read for it, or that it names
  FilmDescription film;
  SamplerDescription sampler;
  PixelFilter filter;
  CameraDescription camera;
  IntegratorDescription integrator;
  std::vector<MediumDescription> media;
  std::vector<TextureDescription> textures;  // each uses only such as come before it
  std::vector<ShapeDescription> shapes;
  std::vector<ObjectDescription> objects;
  std::vector<InstanceDescription> instances;
  std::vector<LightDescription> lights;
};

}  // namespace brume
