#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/file.h"
#include "kernel/phase_table.h"
#include "scene/read_scene.h"

namespace brume {

namespace {

constexpr std::string_view traversal_names[] = {"march", "dda"};
constexpr std::string_view storage_names[] = {"8-bit", "16-bit", "float"};
constexpr std::string_view placement_names[] = {"start", "random", "middle", "middle-random"};

// In the order of TextureDescription::kind and of ImageTexture::Wrap.
constexpr std::string_view texture_names[] = {"constant", "scale", "mix", "checkerboard", "imagemap"};
constexpr std::string_view wrap_names[] = {"repeat", "clamp", "black"};

std::string quoted(std::string_view text) {
  constexpr std::string_view special = "\b\f\n\r\t\\\"", letters = "bfnrt\\\"";
  std::string result = "\"";
  for (const char c : text) {
    const std::size_t escape = special.find(c);
    if (escape == std::string_view::npos)
      result += c;
    else
      (result += '\\') += letters[escape];
  }
  return result + '"';
}

std::string numbers(Vector3 v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

bool is_identity(const Transform& t) { return t == Transform(); }

std::string filter_parameters(const PixelFilter& f) {
  switch (f.kind) {
    case PixelFilter::Kind::gaussian:
      return fmt::format(" \"float sigma\" {}", f.sigma);
    case PixelFilter::Kind::mitchell:
      return fmt::format(" \"float B\" {} \"float C\" {}", f.b, f.c);
    case PixelFilter::Kind::sinc:
      return fmt::format(" \"float tau\" {}", f.tau);
    case PixelFilter::Kind::box:
    case PixelFilter::Kind::triangle:
      break;
  }
  return {};
}

// Lines of text, indented by the blocks they stand in. Numbers are written with the fewest digits that read back as the
// same.
class Writer {
 public:
  explicit Writer(const SceneDescription& scene) : scene_(scene) {}

  std::string scene() {
    line(
        "# A scene for Brume: pbrt-v4's language with Brume's additions. Lengths are in world units, colours in "
        "linear");
    line("# sRGB; matrices are written column by column.");
    options(scene_);
    camera(scene_);
    line("");
    line("WorldBegin");
    for (const MediumDescription& m : scene_.media) medium(m);
    for (const LightDescription& l : scene_.lights) light(l);
    for (const TextureDescription& t : scene_.textures) texture(t);
    for (const ObjectDescription& o : scene_.objects) object(o);
    for (const ShapeDescription& s : scene_.shapes) shape(s);
    for (const InstanceDescription& i : scene_.instances) instance(i);
    return std::move(text_);
  }

 private:
  template <typename... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    const std::size_t begin = text_.size();
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    if (text_.size() > begin) text_.insert(begin, static_cast<std::size_t>(2 * depth_), ' ');
    text_ += '\n';
  }

  // `keyword [values]`; where they are many, in lines that hold whole triples.
  template <typename Values>
  void list(std::string_view keyword, const Values& values) {
    constexpr std::size_t per_line = 12;
    if (values.size() <= per_line) {
      line("  {} [{}]", keyword, fmt::join(values, " "));
      return;
    }
    line("  {} [", keyword);
    for (std::size_t i = 0; i < values.size(); i += per_line)
      line("    {}",
           fmt::join(values.begin() + static_cast<std::ptrdiff_t>(i),
                     values.begin() + static_cast<std::ptrdiff_t>(std::min(i + per_line, values.size())), " "));
    line("  ]");
  }

  void matrix(const Transform& t) {
    std::string columns;  // adding 0 writes -0 as 0
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t r = 0; r < 4; ++r) columns += fmt::format("{}{}", columns.empty() ? "" : " ", t.m[r][c] + 0.0);
    line("Transform [{}]", columns);
  }

  void colour(std::string_view name, const Spectrum& value) {
    line("  \"rgb {}\" [{} {} {}]", name, value[0], value[1], value[2]);
  }

  void textured(std::string_view name, const Textured& t, bool is_float = false) {
    if (t.texture >= 0)
      line("  \"texture {}\" {}", name, quoted(scene_.textures[static_cast<std::size_t>(t.texture)].name));
    else if (is_float)
      line("  \"float {}\" {}", name, t.value[0]);
    else
      colour(name, t.value);
  }

  void options(const SceneDescription& scene) {
    const FilmDescription& film = scene.film;
    const std::string_view space = colour_space_names[static_cast<std::size_t>(film.colour_space)];
    if (film.colour_space != ColourSpace::srgb) line("ColorSpace \"{}\"", space);
    line("Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {}", film.width, film.height);
    line("  \"string filename\" {} \"bool savefp16\" {}", quoted(film.filename), film.save_fp16);
    if (film.crop_window != FilmDescription{}.crop_window)
      line("  \"float cropwindow\" [{}]", fmt::join(film.crop_window, " "));
    if (film.iso != 100) line("  \"float iso\" {}", film.iso);
    if (film.white_balance > 0) line("  \"float whitebalance\" {}", film.white_balance);
    if (std::isfinite(film.max_component)) line("  \"float maxcomponentvalue\" {}", film.max_component);
    if (film.colour_space != ColourSpace::srgb) line("ColorSpace \"srgb\"");
    line("Sampler \"{}\" \"integer pixelsamples\" {} \"integer seed\" {}",
         scene.sampler.kind == SamplerDescription::Kind::zsobol ? "zsobol" : "independent", scene.sampler.pixel_samples,
         scene.sampler.seed);
    const PixelFilter& f = scene.filter;
    line("PixelFilter \"{}\" \"float xradius\" {} \"float yradius\" {}{}",
         filter_names[static_cast<std::size_t>(f.kind)], f.x_radius, f.y_radius, filter_parameters(f));
    const IntegratorDescription& i = scene.integrator;
    line("Integrator {} \"integer maxdepth\" {}", quoted(i.name), i.max_depth);
    if (i.name == "classic") {
      line("  \"string traversal\" \"{}\" \"string placement\" \"{}\" \"float step\" {} \"integer shadowsamples\" {}",
           traversal_names[static_cast<std::size_t>(i.traversal)],
           placement_names[static_cast<std::size_t>(i.placement)], i.step, i.shadow_samples);
      line("  \"string volumeshadows\" \"{}\"", i.volume_shadows == VolumeShadows::cached ? "cached" : "march");
    }
  }

  void camera(const SceneDescription& scene) {
    const CameraDescription& camera = scene.camera;
    line("");
    if (!camera.medium.empty()) line("MediumInterface \"\" {}", quoted(camera.medium));
    line("# Camera from world; the camera looks along its +z, +y is up and +x is right in the picture.");
    if (!is_identity(camera.world_from_camera)) matrix(inverse(camera.world_from_camera));
    if (camera.sphere_map)
      line("Camera \"spherical\" \"string mapping\" \"{}\"",
           sphere_map_names[static_cast<std::size_t>(*camera.sphere_map)]);
    else
      perspective(camera);
    if (camera.shutter_open != 0 || camera.shutter_close != 1)
      line("  \"float shutteropen\" {} \"float shutterclose\" {}", camera.shutter_open, camera.shutter_close);
    // What the Camera directive records lasts; nothing below is to inherit it.
    if (!camera.medium.empty()) line("MediumInterface \"\"");
  }

  void perspective(const CameraDescription& camera) {
    line("Camera \"perspective\" \"float fov\" {}", camera.fov);
    const std::array<double, 4>& w = camera.screen_window;
    if (w != std::array<double, 4>{}) line("  \"float screenwindow\" [{} {} {} {}]", w[0], w[1], w[2], w[3]);
    if (camera.lens_radius != 0 || camera.focal_distance != CameraDescription().focal_distance)
      line("  \"float lensradius\" {} \"float focaldistance\" {}", camera.lens_radius, camera.focal_distance);
  }

  void medium(const MediumDescription& m) {
    line("");
    const bool moved = !is_identity(m.world_from_medium);
    if (moved) begin_moved(m.world_from_medium);
    line("MakeNamedMedium {}", quoted(m.name));
    std::visit([&](const auto& kind) { medium_kind(kind); }, m.kind);
    if (std::holds_alternative<RgbGridMedium>(m.kind)) {
      line("  \"float scale\" {} \"float Lescale\" {}", m.sigma_a[0], m.emission[0]);
    } else {
      coefficients(m);
    }
    const PhaseFunction& phase = phase_functions()[static_cast<std::size_t>(m.phase)].table;
    line("  \"string phase\" \"{}\"", phase.name);
    for (std::size_t i = 0; i < m.phase_parameters.size(); ++i)
      line("  \"float {}\" {}", phase.parameters[i].name, m.phase_parameters[i]);
    if (!std::holds_alternative<HomogeneousMedium>(m.kind))
      line("  \"string interpolation\" \"{}\" \"string storage\" \"{}\"", m.linear_interpolation ? "linear" : "nearest",
           storage_names[static_cast<std::size_t>(m.storage_bits / 16)]);
    if (m.sanitize) line("  \"bool sanitize\" true");
    if (moved) end_block();
  }

  void coefficients(const MediumDescription& m) {
    line("  # per world unit, at density 1");
    colour("sigma_a", m.sigma_a);
    colour("sigma_s", m.sigma_s);
    if (m.temperatures)
      temperatures(*m.temperatures, m.emission[0]);
    else if (!is_zero(m.emission))
      colour("Le", m.emission);
  }

  void temperatures(const TemperatureScale& t, float strength) {
    if (t != TemperatureScale{})
      line("  \"float temperatureoffset\" {} \"float temperaturescale\" {}", t.offset, t.scale);
    if (strength != 1) line("  \"float Lescale\" {}", strength);
  }

  void medium_kind(const HomogeneousMedium&) { line("  \"string type\" \"homogeneous\""); }
  void medium_kind(const UniformGridMedium& grid) {
    line("  \"string type\" \"uniformgrid\"");
    line("  \"integer nx\" {} \"integer ny\" {} \"integer nz\" {}", grid.resolution[0], grid.resolution[1],
         grid.resolution[2]);
    line("  \"point3 p0\" [{}] \"point3 p1\" [{}]", numbers(grid.p0), numbers(grid.p1));
    list("\"float density\"", grid.density);
    if (!grid.temperature.empty()) list("\"float temperature\"", grid.temperature);
    if (!grid.strength.empty()) list("\"float Lescale\"", grid.strength);
  }
  void medium_kind(const FileMedium& file) {
    line("  \"string type\" \"{}\" \"string filename\" {}", suffix(file.filename.text) == ".vol" ? "vol" : "vdb",
         quoted(file.filename.text));
    if (!file.grid.empty()) line("  \"string gridname\" {}", quoted(file.grid.text));
    if (file.temperature_asked_for || file.temperature_grid.empty())
      line("  \"string temperaturename\" {}", quoted(file.temperature_grid.text));
  }
  void medium_kind(const ProceduralMedium& medium) {
    const Procedural& p = medium.procedural;
    line("  \"string type\" \"procedural\" \"string kind\" \"{}\" \"integer size\" {} \"integer seed\" {}",
         p.table().name, p.size, p.seed);
    for (std::size_t i = 0; i < p.values.size(); ++i)
      if (const std::string_view name = p.table().parameters[i].name; !name.empty())
        line("  \"float {}\" {}", name, p.values[i]);
  }
  void medium_kind(const RgbGridMedium& grid) {
    line("  \"string type\" \"rgbgrid\"");
    line("  \"integer nx\" {} \"integer ny\" {} \"integer nz\" {}", grid.resolution[0], grid.resolution[1],
         grid.resolution[2]);
    line("  \"point3 p0\" [{}] \"point3 p1\" [{}]", numbers(grid.p0), numbers(grid.p1));
    if (!grid.sigma_a.empty()) list("\"rgb sigma_a\"", grid.sigma_a);
    if (!grid.sigma_s.empty()) list("\"rgb sigma_s\"", grid.sigma_s);
    if (!grid.emission.empty()) list("\"rgb Le\"", grid.emission);
  }
  void medium_kind(const CloudMedium& medium) {
    const NoiseCloud& c = medium.cloud;
    line("  \"string type\" \"cloud\" \"integer size\" {}", c.size);
    line("  \"float density\" {} \"float wispiness\" {} \"float frequency\" {}", c.density, c.wispiness, c.frequency);
    line("  \"point3 p0\" [{}] \"point3 p1\" [{}]", numbers(c.p0), numbers(c.p1));
  }

  void light(const LightDescription& l) {
    line("");
    std::visit([&](const auto& kind) { light_kind(kind); }, l.kind);
  }
  void light_kind(const PointLight& l) {
    line("LightSource \"point\" \"point3 from\" [{}]", numbers(l.from));
    colour("I", l.intensity);
  }
  void light_kind(const SpotLight& l) {
    line("LightSource \"spot\" \"point3 from\" [{}] \"point3 to\" [{}]", numbers(l.from), numbers(l.to));
    line("  \"float coneangle\" {} \"float conedeltaangle\" {}", l.cone_angle, l.cone_delta);
    colour("I", l.intensity);
  }
  void light_kind(const DistantLight& l) {
    line("LightSource \"distant\" \"point3 from\" [{}] \"point3 to\" [0 0 0]", numbers(l.direction_to_light));
    colour("L", l.radiance);
  }
  void light_kind(const InfiniteLight& l) {
    if (l.filename.empty()) {
      line("LightSource \"infinite\"");
      colour("L", l.radiance);
      portal(l);
      return;
    }
    const bool moved = !is_identity(l.world_from_light);
    if (moved) begin_moved(l.world_from_light);
    line("LightSource \"infinite\" \"string filename\" {} \"float scale\" {}", quoted(l.filename.text), l.radiance[0]);
    if (l.illuminance > 0) line("  \"float illuminance\" {}", l.illuminance);
    portal(l);
    if (moved) end_block();
  }
  void portal(const InfiniteLight& l) {
    if (l.portal) list("\"point3 portal\"", flat({l.portal->begin(), l.portal->end()}));
  }
  void light_kind(const SphereLight& l) {
    line("LightSource \"sphere\" \"point3 from\" [{}] \"float radius\" {}", numbers(l.from), l.radius);
    colour("I", l.intensity);
  }
  void light_kind(const AmbientLight& l) {
    line("LightSource \"ambient\"");
    colour("L", l.radiance);
  }

  void texture(const TextureDescription& t) {
    line("");
    const bool moved = std::visit([](const auto& kind) { return !is_identity(space_of(kind)); }, t.kind);
    if (moved) begin_moved(std::visit([](const auto& kind) { return space_of(kind); }, t.kind));
    line("Texture {} \"{}\" \"{}\"", quoted(t.name), t.is_float ? "float" : "spectrum", texture_names[t.kind.index()]);
    std::visit([&](const auto& kind) { texture_kind(kind, t.is_float); }, t.kind);
    if (moved) end_block();
  }
  template <class Kind>
  static Transform space_of(const Kind& kind) {
    if constexpr (requires { kind.mapping; }) return kind.mapping.world_from_texture;
    return {};
  }
  void texture_kind(const ConstantTexture& t, bool is_float) { textured("value", t.value, is_float); }
  void texture_kind(const ScaleTexture& t, bool is_float) {
    textured("tex", t.texture, is_float);
    textured("scale", t.scale, true);
  }
  void texture_kind(const MixTexture& t, bool is_float) {
    textured("tex1", t.first, is_float);
    textured("tex2", t.second, is_float);
    textured("amount", t.amount, true);
  }
  void texture_kind(const CheckerboardTexture& t, bool is_float) {
    textured("tex1", t.first, is_float);
    textured("tex2", t.second, is_float);
    mapping(t.mapping);
  }
  void texture_kind(const ImageTexture& t, bool) {
    const std::string encoding = t.gamma == 0 ? "sRGB" : t.gamma == 1 ? "linear" : fmt::format("gamma {}", t.gamma);
    line("  \"string filename\" {} \"string encoding\" \"{}\"", quoted(t.filename.text), encoding);
    line("  \"string filter\" \"{}\" \"string wrap\" \"{}\" \"float scale\" {} \"bool invert\" {}",
         t.bilinear ? "bilinear" : "point", wrap_names[static_cast<std::size_t>(t.wrap)], t.scale, t.invert);
    mapping(t.mapping);
  }
  void mapping(const TextureMapping& m) {
    if (m.planar)
      line("  \"string mapping\" \"planar\" \"vector3 v1\" [{}] \"vector3 v2\" [{}]", numbers(m.v1), numbers(m.v2));
    else
      line("  \"float uscale\" {} \"float vscale\" {}", m.u_scale, m.v_scale);
    line("  \"float udelta\" {} \"float vdelta\" {}", m.u_offset, m.v_offset);
  }

  void object(const ObjectDescription& o) {
    line("");
    line("ObjectBegin {}", quoted(o.name));
    ++depth_;
    for (const ShapeDescription& s : o.shapes) shape(s);
    --depth_;
    line("ObjectEnd");
  }
  void instance(const InstanceDescription& i) {
    line("");
    begin_block();
    if (!is_identity(i.world_from_object)) matrix(i.world_from_object);
    line("ObjectInstance {}", quoted(i.object));
    end_block();
  }

  void shape(const ShapeDescription& s) {
    line("");
    begin_block();
    if (!s.inside.empty() || !s.outside.empty()) line("MediumInterface {} {}", quoted(s.inside), quoted(s.outside));
    if (!std::holds_alternative<VolumeShape>(s.kind)) {
      if (!is_identity(s.world_from_object)) matrix(s.world_from_object);
      if (s.reverse_orientation) line("ReverseOrientation");
      std::visit([&](const auto& m) { material(m); }, s.material);
      relief(s.relief);
      if (s.light) area_light(*s.light);
    }
    std::visit([&](const auto& kind) { shape_kind(kind); }, s.kind);
    if (is_cut_out(s)) textured("alpha", s.alpha, true);
    end_block();
  }

  void material(const DiffuseMaterial& m) {
    line("Material \"diffuse\"");
    textured("reflectance", m.reflectance);
  }
  void material(const BlinnPhongMaterial& m) {
    line("Material \"blinnphong\" \"float shininess\" {} \"float metallic\" {}", m.shininess, m.metallic);
    textured("ambient", m.ambient);
    textured("diffuse", m.diffuse);
    colour("specular", m.specular);
    colour("reflection", m.reflection);
    if (is_zero(m.refraction)) return;
    colour("refraction", m.refraction);
    line("  \"float index\" {}", m.index);
    colour("absorption", m.absorption);
  }
  void material(const InterfaceMaterial&) { line("Material \"interface\""); }
  void material(const ConductorMaterial& m) {
    line("Material \"conductor\"");
    colour("eta", m.eta);
    colour("k", m.k);
    roughness(m.alpha);
  }
  void material(const DielectricMaterial& m) {
    line("Material \"dielectric\" \"float eta\" {}", m.eta);
    roughness(m.alpha);
  }
  void material(const CoatedDiffuseMaterial& m) {
    line("Material \"coateddiffuse\" \"float eta\" {}", m.eta);
    textured("reflectance", m.reflectance);
    roughness(m.alpha);
  }
  void roughness(float alpha) {
    if (alpha > 0) line("  \"float roughness\" {} \"bool remaproughness\" false", alpha);
  }

  void relief(const Relief& r) {
    if (r.displacement >= 0)
      line("  \"texture displacement\" {}", quoted(scene_.textures[static_cast<std::size_t>(r.displacement)].name));
    if (!r.normal_map.empty()) line("  \"string normalmap\" {}", quoted(r.normal_map.text));
  }

  void area_light(const AreaLight& l) {
    line("AreaLightSource \"diffuse\" \"bool twosided\" {}", l.two_sided);
    if (l.filename.empty())
      colour("L", l.radiance);
    else
      line("  \"string filename\" {} \"float scale\" {}", quoted(l.filename.text), l.radiance[0]);
    if (l.power > 0) line("  \"float power\" {}", l.power);
  }

  void shape_kind(const SphereShape& s) {
    line("Shape \"sphere\" \"float radius\" {}", s.radius);
    if (std::isfinite(s.z_min)) line("  \"float zmin\" {}", s.z_min);
    if (std::isfinite(s.z_max)) line("  \"float zmax\" {}", s.z_max);
    if (s.phi_max < 360) line("  \"float phimax\" {}", s.phi_max);
  }
  void shape_kind(const QuadShape& s) {
    line("Shape \"quad\" \"point3 origin\" [{}]", numbers(s.origin));
    line("  \"vector3 edgeu\" [{}] \"vector3 edgev\" [{}]", numbers(s.edge_u), numbers(s.edge_v));
  }
  void shape_kind(const DiskShape& s) {
    line("Shape \"disk\" \"float radius\" {} \"float height\" {} \"float innerradius\" {} \"float phimax\" {}",
         s.radius, s.height, s.inner_radius, s.phi_max);
  }
  void shape_kind(const CylinderShape& s) {
    line("Shape \"cylinder\" \"float radius\" {} \"float zmin\" {} \"float zmax\" {} \"float phimax\" {}", s.radius,
         s.z_min, s.z_max, s.phi_max);
    if (s.caps) line("  \"bool caps\" true");
  }
  void shape_kind(const TriangleMeshShape& s) {
    line("Shape \"trianglemesh\"");
    list("\"integer indices\"", flat(s.triangles));
    vertices(s);
    if (!s.displacement) return;
    const auto& [texture, edge_length] = *s.displacement;
    line("  \"texture displacement\" {} \"float edgelength\" {}",
         quoted(scene_.textures[static_cast<std::size_t>(texture)].name), edge_length);
  }
  void shape_kind(const BilinearMeshShape& s) {
    line("Shape \"bilinearmesh\"");
    list("\"integer indices\"", flat(s.patches));
    vertices(s);
  }
  template <class Mesh>
  void vertices(const Mesh& s) {
    list("\"point3 P\"", flat(s.positions));
    if (!s.normals.empty()) list("\"normal N\"", flat(s.normals));
    if (!s.uv.empty()) list("\"point2 uv\"", flat(s.uv));
  }
  void shape_kind(const VolumeShape&) { line("Shape \"volume\""); }

  static std::vector<double> flat(const std::vector<Vector3>& vectors) {
    std::vector<double> values;
    for (const Vector3& v : vectors) values.insert(values.end(), {v.x, v.y, v.z});
    return values;
  }
  template <class T, std::size_t size>
  static std::vector<T> flat(const std::vector<std::array<T, size>>& tuples) {
    std::vector<T> values;
    for (const auto& t : tuples) values.insert(values.end(), t.begin(), t.end());
    return values;
  }

  void begin_block() {
    line("AttributeBegin");
    ++depth_;
  }
  void begin_moved(const Transform& t) {
    begin_block();
    matrix(t);
  }
  void end_block() {
    --depth_;
    line("AttributeEnd");
  }

  const SceneDescription& scene_;
  std::string text_;
  int depth_ = 0;
};

}  // namespace

std::string write_scene(const SceneDescription& scene) { return Writer(scene).scene(); }

}  // namespace brume
