#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/file.h"
#include "kernel/phase_table.h"
#include "scene/read_scene.h"
#include "session/describe_file.h"
#include "session/errors.h"
#include "volume/read_volume.h"

namespace brume {

namespace {

std::string text(const Vector3& v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); }
std::string text(const Spectrum& s) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", s[0], s[1], s[2]); }

struct DescribeMediumKind {
  std::string operator()(const HomogeneousMedium&) const { return "homogeneous"; }
  std::string operator()(const UniformGridMedium& m) const {
    return fmt::format("uniform grid of {} x {} x {} voxels", m.resolution[0], m.resolution[1], m.resolution[2]);
  }
  std::string operator()(const FileMedium& m) const {
    return fmt::format("grid {} of {}", m.grid.empty() ? "by default" : m.grid.text, m.filename.text);
  }
  std::string operator()(const ProceduralMedium& m) const {
    return fmt::format("procedural {} of {} voxels", m.procedural.table().name, m.procedural.size);
  }
  std::string operator()(const RgbGridMedium& m) const {
    return fmt::format("coloured grid of {} x {} x {} voxels", m.resolution[0], m.resolution[1], m.resolution[2]);
  }
  std::string operator()(const CloudMedium& m) const { return fmt::format("noise cloud of {} voxels", m.cloud.size); }
};

struct DescribeLight {
  std::string operator()(const PointLight& l) const {
    return fmt::format("point at {}, intensity {}", text(l.from), text(l.intensity));
  }
  std::string operator()(const SpotLight& l) const {
    return fmt::format("spot at {}, towards {}, intensity {}", text(l.from), text(l.to), text(l.intensity));
  }
  std::string operator()(const DistantLight& l) const {
    return fmt::format("distant, towards {}, radiance {}", text(l.direction_to_light), text(l.radiance));
  }
  std::string operator()(const InfiniteLight& l) const {
    const std::string_view where = l.portal ? ", through a portal" : "";
    if (!l.filename.empty())
      return fmt::format("infinite, image {} times {}{}", l.filename.text, text(l.radiance), where);
    return fmt::format("infinite, radiance {}{}", text(l.radiance), where);
  }
  std::string operator()(const SphereLight& l) const {
    return fmt::format("sphere at {} of radius {}, intensity {}", text(l.from), l.radius, text(l.intensity));
  }
  std::string operator()(const AmbientLight& l) const { return fmt::format("ambient, radiance {}", text(l.radiance)); }
};

std::string describe_shapes(const std::vector<ShapeDescription>& shapes) {
  constexpr std::array names{"sphere", "triangle mesh", "bilinear mesh", "quad", "disk", "cylinder", "volume"};
  static_assert(names.size() == std::variant_size_v<decltype(ShapeDescription::kind)>);
  std::array<int, names.size()> counts{};
  for (const ShapeDescription& shape : shapes) ++counts[shape.kind.index()];
  std::string line;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (counts[i] > 0) line += fmt::format("{}{} {}", line.empty() ? "" : ", ", counts[i], names[i]);
  return line.empty() ? "none" : line;
}

std::string describe_scene(const std::string& path) {
  std::vector<Diagnostic> warnings;
  const SceneDescription scene = read_scene(path, warnings);
  std::string lines = fmt::format("{}: scene\n", path);
  lines += fmt::format("  film: {} x {} pixels, {} samples per pixel, to {}\n", scene.film.width, scene.film.height,
                       scene.sampler.pixel_samples, scene.film.filename);
  lines += fmt::format(
      "  camera: at {}, {}\n", text(scene.camera.world_from_camera.point({})),
      scene.camera.sphere_map ? "all directions" : fmt::format("field of view {:.4g} degrees", scene.camera.fov));
  lines += fmt::format("  integrator: {}, maxdepth {}\n", scene.integrator.name, scene.integrator.max_depth);
  for (const MediumDescription& medium : scene.media)
    lines += fmt::format("  medium {}: {}, sigma_s {}, sigma_a {}, {}\n", medium.name,
                         std::visit(DescribeMediumKind{}, medium.kind), text(medium.sigma_s), text(medium.sigma_a),
                         phase_functions()[static_cast<std::size_t>(medium.phase)].table.name);
  lines += fmt::format("  shapes: {}\n", describe_shapes(scene.shapes));
  for (const ObjectDescription& object : scene.objects)
    lines += fmt::format("  object {}: {}, {} times\n", object.name, describe_shapes(object.shapes),
                         std::count_if(scene.instances.begin(), scene.instances.end(),
                                       [&](const InstanceDescription& i) { return i.object == object.name; }));
  for (const LightDescription& light : scene.lights)
    lines += fmt::format("  light: {}\n", std::visit(DescribeLight{}, light.kind));
  for (const Diagnostic& warning : warnings) lines += to_string(warning) + '\n';
  return lines;
}

}  // namespace

FileDescription describe_file(const std::string& path) {
  return with_public_errors([&]() -> FileDescription {
    const std::string s = suffix(path);
    if (is_volume_file(path)) return describe_volume(path);
    if (is_scene_file(path)) return {describe_scene(path), {}};
    if (s == ".exr" || s == ".pfm") return {describe_picture(path), {}};
    throw InputError(path,
                     fmt::format("{}; known are scenes (.pbrt), volumes ({}) and pictures (.exr, .pfm)",
                                 s.empty() ? "no suffix" : fmt::format("unknown suffix \"{}\"", s), volume_suffixes));
  });
}

}  // namespace brume
