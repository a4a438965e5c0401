#include "session/frame_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

#include "base/diagnostics.h"
#include "kernel/phase_table.h"
#include "session/grid_extent.h"
#include "volume/read_volume.h"

namespace brume {

namespace {

constexpr double optical_depth = 16;
constexpr float albedo = 0.99f, mean_cosine = 0.35f;

// An orthonormal frame of a right-handed world, seen by someone who looks along `forward`.
struct View {
  Vector3 eye, right, up, forward;
};

View look(Vector3 eye, Vector3 at) {
  const Vector3 forward = normalize(at - eye), right = normalize(cross(forward, {0, 1, 0}));
  return {eye, right, cross(right, forward), forward};
}

// The three-quarter view: from the front right and slightly above; +y is up, +z towards the viewer.
Vector3 towards_viewer() {
  const double around = 35 * std::numbers::pi / 180, above = 18 * std::numbers::pi / 180;
  return {std::sin(around) * std::cos(above), std::sin(above), std::cos(around) * std::cos(above)};
}

// The outline, in a view, of boxes placed in the world; as tangents.
struct Outline {
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
};

Outline outline(const View& view, const Transform& world_from_box, const std::vector<Box3>& boxes) {
  Outline o;
  for (const Box3& box : boxes)
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 p{corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                      corner & 4 ? box.hi.z : box.lo.z};
      const Vector3 d = world_from_box.point(p) - view.eye;
      const double depth = dot(d, view.forward), x = dot(d, view.right) / depth, y = dot(d, view.up) / depth;
      o.x0 = std::min(o.x0, x), o.x1 = std::max(o.x1, x), o.y0 = std::min(o.y0, y), o.y1 = std::max(o.y1, y);
    }
  return o;
}

// Aims at the boxes, which `whole` holds, from 1.75 times its diagonal away, with the middle of their outline in the
// middle of the picture.
View aim(const Transform& world_from_box, const std::vector<Box3>& boxes, const Box3& whole, Framing& framing) {
  const Vector3 centre = 0.5 * (whole.lo + whole.hi);
  const Vector3 eye = centre + 1.75 * length(whole.hi - whole.lo) * towards_viewer();
  View view = look(eye, centre);
  for (int i = 0; i < 3; ++i) {
    const Outline o = outline(view, world_from_box, boxes);
    view = look(eye, eye + view.forward + 0.5 * (o.x0 + o.x1) * view.right + 0.5 * (o.y0 + o.y1) * view.up);
  }
  constexpr double margin = 1.15;
  const Outline o = outline(view, world_from_box, boxes);
  framing = {margin * std::max(o.x1, -o.x0), margin * std::max(o.y1, -o.y0)};
  return view;
}

Transform world_from_camera(const View& v) {
  Transform t;
  for (int row = 0; row < 3; ++row)
    t.m[static_cast<std::size_t>(row)] = {v.right[row], v.up[row], v.forward[row], v.eye[row]};
  return t;
}

// A size of about 512 x 512 pixels in the shape of the framing, within 1 : 2 and 2 : 1.
void choose_size(const Framing& framing, FilmDescription& film) {
  const double aspect = std::clamp(framing.half_width / framing.half_height, 0.5, 2.0);
  const auto multiple_of_8 = [](double x) { return 8 * static_cast<int>(std::lround(x / 8)); };
  film.width = multiple_of_8(512 * std::sqrt(aspect));
  film.height = multiple_of_8(512 / std::sqrt(aspect));
}

// The index axis whose rows run most nearly along `direction`.
int axis_along(const Transform& world_from_index, Vector3 direction) {
  const auto alignment = [&](int axis) {
    Vector3 unit;
    unit[axis] = 1;
    return std::abs(dot(normalize(world_from_index.vector(unit)), direction));
  };
  int best = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (alignment(axis) > alignment(best)) best = axis;
  return best;
}

MediumDescription make_medium(const std::string& path, const VolumeGrid& grid, double sigma_t) {
  MediumDescription medium;
  medium.name = "volume";
  medium.sigma_s = constant_spectrum(static_cast<float>(albedo * sigma_t));
  medium.sigma_a = constant_spectrum(static_cast<float>((1 - albedo) * sigma_t));
  medium.phase = phase_kind("henyey_greenstein");
  medium.phase_parameters = {mean_cosine};
  medium.kind = FileMedium{std::filesystem::absolute(path).lexically_normal().string(), grid.name, "temperature"};
  medium.temperatures = TemperatureScale{};
  medium.emission = constant_spectrum(1);
  return medium;
}

// A warm sun from the upper left, on the viewer's side so far that the shape shows; a blue sky.
std::vector<LightDescription> sun_and_sky(const View& view) {
  const Vector3 to_sun = normalize(-0.75 * view.right + 0.6 * Vector3{0, 1, 0} - 0.3 * view.forward);
  return {{DistantLight{to_sun, Spectrum{{7, 5.8f, 4.3f}}}, {}}, {InfiniteLight{Spectrum{{0.05f, 0.085f, 0.16f}}}, {}}};
}

ShapeDescription whole_medium(const std::string& medium) {
  ShapeDescription shape;
  shape.material = InterfaceMaterial{};
  shape.inside = medium;
  shape.kind = VolumeShape{};
  return shape;
}

}  // namespace

double fov_for(const Framing& framing, int width, int height) {
  const double aspect = static_cast<double>(width) / height;
  const double half =
      std::max(framing.half_width / std::max(aspect, 1.0), framing.half_height / std::max(1 / aspect, 1.0));
  return 2 * std::atan(half) * 180 / std::numbers::pi;
}

FramedVolume frame_volume(const std::string& path, const std::string& grid_name, bool sanitize) {
  const VolumeGrid grid =
      read_volume(path, grid_name, {Storage::u16, sanitize ? BadValues::taken_as_0 : BadValues::rejected});
  const std::vector<Box3> boxes = occupied_boxes(grid);
  if (boxes.empty()) throw InputError(path, fmt::format("grid {} is empty: there is nothing to show", grid.name));
  Box3 whole;
  for (const Box3& box : boxes) {
    const Box3 world = bounds(grid.medium_from_index, box);
    whole.include(world.lo);
    whole.include(world.hi);
  }

  FramedVolume framed;
  SceneDescription& scene = framed.scene;
  scene.file = path;
  const View view = aim(grid.medium_from_index, boxes, whole, framed.framing);
  choose_size(framed.framing, scene.film);
  scene.film.filename = std::filesystem::path(path).stem().string() + ".png";
  scene.camera.world_from_camera = world_from_camera(view);
  scene.camera.fov = fov_for(framed.framing, scene.film.width, scene.film.height);

  const Vector3 voxel = voxel_size(grid);
  const int axis = axis_along(grid.medium_from_index, view.forward);
  const double row = densest_row(grid, axis) * voxel[axis];
  scene.media.push_back(make_medium(path, grid, optical_depth / row));
  scene.media.back().sanitize = sanitize;
  scene.shapes.push_back(whole_medium(scene.media.back().name));
  scene.lights = sun_and_sky(view);

  scene.sampler.pixel_samples = 64;
  // For those who choose the classic integrator. Half a voxel, as is usual, but at most 128 steps along the diagonal:
  // shadow rays take steps of the same length, so the time grows with the square of their number.
  const double diagonal = length(whole.hi - whole.lo);
  scene.integrator.max_depth = 100;
  scene.integrator.placement = Placement::middle_random;
  scene.integrator.step = std::max(0.5 * std::min({voxel.x, voxel.y, voxel.z}), diagonal / 128);

  framed.note = fmt::format(
      "{}: grid {}, {} x {} x {} voxels; extinction scaled to an optical depth of {} along the "
      "densest row of voxels in the viewing direction",
      std::filesystem::path(path).filename().string(), grid.name, grid.bricks.voxels[0] - grid.first_voxel[0],
      grid.bricks.voxels[1] - grid.first_voxel[1], grid.bricks.voxels[2] - grid.first_voxel[2], optical_depth);
  return framed;
}

}  // namespace brume
