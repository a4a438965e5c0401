#include "intersect/intersector.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <new>
#include <stdexcept>
#include <tuple>

#include "intersect/attached_shape.h"
#include "intersect/cut_outs.h"
#include "intersect/relief.h"
#include "intersect/surface_uv.h"

namespace brume {

using kernel::vec3;

namespace {

constexpr int packet_size = 16;

// Whether the ray is one that Embree takes; at others it ends the program.
bool is_valid(const Ray& ray) {
  const vec3 o = ray.origin, d = ray.direction;
  const auto fits = [](float x) { return std::abs(x) <= 1.8e18f; };  // false of what is not a number
  return fits(o.x) && fits(o.y) && fits(o.z) && fits(d.x) && fits(d.y) && fits(d.z) && !std::isnan(ray.t_max);
}

void set_ray(RTCRay16& r, int i, const Ray& ray, float t_far) {
  r.org_x[i] = ray.origin.x;
  r.org_y[i] = ray.origin.y;
  r.org_z[i] = ray.origin.z;
  r.dir_x[i] = ray.direction.x;
  r.dir_y[i] = ray.direction.y;
  r.dir_z[i] = ray.direction.z;
  r.tnear[i] = 0;
  r.tfar[i] = t_far;
  r.time[i] = 0;
  r.mask[i] = ~0u;
  r.id[i] = static_cast<unsigned>(i);
  r.flags[i] = 0;
}

// Drops the second of two passages the same way through one boundary at one place: the edge of two triangles, or of two
// parts of a shape.
void drop_doubles(const CompiledScene& scene, std::vector<Crossing>& found, std::size_t first) {
  std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.ray, a.t, a.shape, a.instance, a.inwards) < std::tie(b.ray, b.t, b.shape, b.instance, b.inwards);
  });
  const auto way = [&](const Crossing& c) {
    return std::tuple(scene.shapes[static_cast<std::size_t>(c.shape)].boundary, c.instance, c.inwards);
  };
  std::size_t kept = first;
  for (std::size_t i = first; i < found.size(); ++i) {
    const Crossing& c = found[i];
    bool is_double = false;
    for (std::size_t j = kept; j-- > first && found[j].ray == c.ray && c.t - found[j].t <= 4e-6f * c.t;)
      is_double = is_double || way(found[j]) == way(c);
    if (!is_double) found[kept++] = c;
  }
  found.resize(kept);
}

vec3 to_float(Vector3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
Vector3 to_double(vec3 v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }
vec3 to_vec3(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

std::array<double, 2> difference(std::array<float, 2> a, std::array<float, 2> b) {
  return {static_cast<double>(a[0]) - static_cast<double>(b[0]), static_cast<double>(a[1]) - static_cast<double>(b[1])};
}

// From those by the place in the saddle's unit square, for a patch with (u, v) of its own.
Tangents patch_tangents(const Tangents& by_place, const std::array<std::array<float, 2>, 4>& uv, Vector3 p) {
  const auto between = [](double t, std::array<double, 2> a, std::array<double, 2> b) {
    return std::array{(1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1]};
  };
  return tangents_from(by_place, between(p.y, difference(uv[1], uv[0]), difference(uv[3], uv[2])),
                       between(p.x, difference(uv[2], uv[0]), difference(uv[3], uv[1])));
}

}  // namespace

// A scene of Embree's for the surfaces of the world, one for its boundaries of media, and two for each object. A shape
// has the number of its place in its object, or in the world; instances come after the world's shapes.
struct Intersector::Embree {
  // Null where there is nothing.
  struct Layers {
    RTCScene surfaces = nullptr, boundaries = nullptr;
  };

  const CompiledScene& scene;
  RTCDevice device = nullptr;
  Layers world;
  std::vector<Layers> objects;
  std::deque<AttachedShape> attached;  // which never moves them
  const bool has_cut_outs;

  explicit Embree(const CompiledScene& s)
      : scene(s),
        has_cut_outs(std::any_of(s.shapes.begin(), s.shapes.end(), [](const auto& x) { return x.alpha >= 0; })) {
    device = rtcNewDevice("threads=1,set_affinity=0");
    if (!device) throw std::runtime_error("Embree cannot start on this machine");
    for (const CompiledObject& object : scene.objects)
      objects.push_back({commit(attach_shapes(object, false)), commit(attach_shapes(object, true))});
    world = {attach_shapes(scene.world, false), attach_shapes(scene.world, true)};
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      attach_instance(world.surfaces, objects[scene.instances[i].object].surfaces, i);
      attach_instance(world.boundaries, objects[scene.instances[i].object].boundaries, i);
    }
    commit(world.surfaces);
    commit(world.boundaries);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::bad_alloc();
  }

  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  ~Embree() {
    objects.push_back(world);
    for (const Layers& layers : objects)
      for (RTCScene rtc : {layers.surfaces, layers.boundaries})
        if (rtc) rtcReleaseScene(rtc);
    rtcReleaseDevice(device);
  }

  RTCScene new_scene() const {
    RTCScene rtc = rtcNewScene(device);
    if (!rtc) throw std::bad_alloc();
    rtcSetSceneFlags(rtc, RTC_SCENE_FLAG_ROBUST);
    return rtc;
  }

  static RTCScene commit(RTCScene rtc) {
    if (rtc) rtcCommitScene(rtc);
    return rtc;
  }

  // Those of the object's shapes that have a surface, or bound media.
  RTCScene attach_shapes(const CompiledObject& object, bool boundaries) {
    RTCScene rtc = nullptr;
    for (std::uint32_t i = 0; i < object.shape_count; ++i) {
      const CompiledShape& shape = scene.shapes[object.first_shape + i];
      if ((boundaries ? shape.boundary : shape.material) < 0) continue;
      AttachedShape& a = attached.emplace_back();
      a.shape = static_cast<int>(object.first_shape + i);
      a.is_boundary = boundaries;
      if (shape.kind == CompiledShape::Kind::quadric)
        a.quadric = &scene.quadrics[shape.index];
      else
        a.flip_normal = scene.meshes[shape.index].flip_normal;
      if (!rtc) rtc = new_scene();
      attach(rtc, make_geometry(device, scene, a), i);
    }
    return rtc;
  }

  void attach_instance(RTCScene& rtc, RTCScene object, std::size_t index) const {
    if (!object) return;
    const CompiledInstance& instance = scene.instances[index];
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, object);
    std::array<float, 12> rows{};
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] = static_cast<float>(instance.world_from_object.m[i / 4][i % 4]);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, rows.data());
    rtcCommitGeometry(geometry);
    if (!rtc) rtc = new_scene();
    attach(rtc, geometry, first_instance() + static_cast<unsigned>(index));
  }

  static void attach(RTCScene rtc, RTCGeometry geometry, unsigned number) {
    rtcAttachGeometryByID(rtc, geometry, number);
    rtcReleaseGeometry(geometry);
  }

  unsigned first_instance() const { return scene.world.shape_count; }

  // The first surface between t_begin and the end of the ray, cut-outs included.
  bool nearest(const Ray& ray, float t_begin, SurfaceHit& hit) const {
    if (!is_valid(ray)) return false;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit r{};
    const vec3 o = ray.origin, d = ray.direction;
    r.ray = {o.x, o.y, o.z, t_begin, d.x, d.y, d.z, 0, ray.t_max, ~0u, 0, 0};
    r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(world.surfaces, &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit.t = r.ray.tfar;
    describe(r.hit, ray, hit);
    return true;
  }

  // Fills in what else there is to say of a hit whose t is known.
  void describe(const RTCHit& rtc, const Ray& ray, SurfaceHit& hit) const {
    hit.position = ray.at(hit.t);
    const bool in_world = rtc.instID[0] == RTC_INVALID_GEOMETRY_ID;
    const CompiledInstance* instance = in_world ? nullptr : &scene.instances[rtc.instID[0] - first_instance()];
    const CompiledObject& object = instance ? scene.objects[instance->object] : scene.world;
    hit.shape = static_cast<int>(object.first_shape + rtc.geomID);
    const CompiledShape& shape = scene.shapes[object.first_shape + rtc.geomID];
    const CompiledMaterial* relief = relief_of(shape);
    vec3 normal, smooth(0, 0, 0);
    Tangents tangents;
    hit.extent = rounding_extent(hit.position, hit.t);
    if (shape.kind == CompiledShape::Kind::mesh) {
      const CompiledMesh& mesh = scene.meshes[shape.index];
      hit.extent = rounding_extent(hit.position, hit.t, tilted_extent(rtc, mesh, instance));
      normal = vec3(rtc.Ng_x, rtc.Ng_y, rtc.Ng_z);
      if (mesh.flip_normal) normal = -normal;
      if (mesh.has_normals) smooth = triangle_normal(rtc, mesh);
      if (shape.is_textured) hit.uv = triangle_uv(scene, mesh, rtc.primID, rtc.u, rtc.v);
      if (relief) tangents = triangle_tangents(rtc, mesh);
    } else {
      const CompiledQuadric& quadric = scene.quadrics[shape.index];
      Vector3 p = to_double(hit.position);
      if (instance) p = instance->object_from_world.point(p);
      p = quadric.object_from_world.point(p);
      normal = to_float(quadric_normal(quadric, p));
      const CompiledPatch* patch =
          quadric.patch < 0 ? nullptr : &scene.patches[static_cast<std::size_t>(quadric.patch)];
      if (patch) smooth = to_vec3(at_patch(patch->normals, p));
      if (shape.is_textured) hit.uv = surface_uv(scene, quadric, p);
      if (relief) tangents = quadric_tangents(quadric, p);
      if (relief && patch) tangents = patch_tangents(tangents, patch->uv, p);
    }
    if (instance) {
      normal = to_world(*instance, normal);
      smooth = to_world(*instance, smooth);
      tangents = {instance->world_from_object.vector(tangents.u), instance->world_from_object.vector(tangents.v)};
    }
    set_normals(normal, smooth, hit);
    if (relief) hit.shading_normal = relief_normal(scene, *relief, hit, tangents);
  }

  // The shape's material, where that has relief.
  const CompiledMaterial* relief_of(const CompiledShape& shape) const {
    if (!shape.is_textured) return nullptr;
    const CompiledMaterial& material = scene.materials[static_cast<std::size_t>(shape.material)];
    return has_relief(material) ? &material : nullptr;
  }

  // From normals of any length; `smooth` is 0 where there is none.
  static void set_normals(vec3 normal, vec3 smooth, SurfaceHit& hit) {
    normal = normalize(normal);
    hit.normal = hit.shading_normal = normal;
    const float squared = dot(smooth, smooth);
    if (!(squared > 0)) return;
    smooth = smooth * (1 / std::sqrt(squared));
    hit.shading_normal = smooth;
    if (dot(smooth, normal) < 0) hit.normal = -normal;
  }

  static vec3 to_world(const CompiledInstance& instance, vec3 n) {
    return to_float(normalize(transposed(instance.object_from_world, to_double(n))));
  }

  // The tilted_length in the world: in an instance, at most this.
  float tilted_extent(const RTCHit& rtc, const CompiledMesh& mesh, const CompiledInstance* instance) const {
    const auto& [a, b, c] = scene.triangles[mesh.first_triangle + rtc.primID];
    const auto at = [&, first = mesh.first_vertex](std::uint32_t corner) {
      return to_vec3(scene.positions[first + corner]);
    };
    const vec3 u = at(b) - at(a), v = at(c) - at(a), w = v - u;
    const float longest = std::sqrt(std::max({dot(u, u), dot(v, v), dot(w, w)}));
    const float tilted = tilted_length({rtc.Ng_x, rtc.Ng_y, rtc.Ng_z}, longest);
    return instance ? tilted * instance->largest_scale : tilted;
  }

  // By the hit's weights of the corners; not normalised.
  vec3 triangle_normal(const RTCHit& rtc, const CompiledMesh& mesh) const {
    const auto at = [&, first = mesh.first_vertex](std::uint32_t corner) {
      return to_vec3(scene.normals[first + corner]);
    };
    const auto& [a, b, c] = scene.triangles[mesh.first_triangle + rtc.primID];
    return (1 - rtc.u - rtc.v) * at(a) + rtc.u * at(b) + rtc.v * at(c);
  }
  Tangents triangle_tangents(const RTCHit& rtc, const CompiledMesh& mesh) const {
    const auto at = [&, first = mesh.first_vertex](std::uint32_t corner) {
      return to_double(to_vec3(scene.positions[first + corner]));
    };
    const auto& [a, b, c] = scene.triangles[mesh.first_triangle + rtc.primID];
    const std::array<std::array<float, 2>, 3> uv = corner_uvs(rtc, mesh);
    return tangents_from({at(b) - at(a), at(c) - at(a)}, difference(uv[1], uv[0]), difference(uv[2], uv[0]));
  }
  std::array<std::array<float, 2>, 3> corner_uvs(const RTCHit& rtc, const CompiledMesh& mesh) const {
    if (mesh.first_uv < 0) return {{{0, 0}, {1, 0}, {1, 1}}};
    const auto at = [&, first = static_cast<std::size_t>(mesh.first_uv)](std::uint32_t corner) {
      return scene.uvs[first + corner];
    };
    const auto& [a, b, c] = scene.triangles[mesh.first_triangle + rtc.primID];
    return {at(a), at(b), at(c)};
  }
};

Intersector::Intersector(const CompiledScene& scene) : embree_(std::make_unique<Embree>(scene)) {}
Intersector::~Intersector() = default;

bool Intersector::has_surfaces() const { return embree_->world.surfaces != nullptr; }
bool Intersector::has_boundaries() const { return embree_->world.boundaries != nullptr; }

bool Intersector::nearest_surface(const Ray& ray, SurfaceHit& hit) const {
  if (!has_surfaces()) return false;
  float t_begin = 0;
  while (embree_->nearest(ray, t_begin, hit)) {
    if (!passes(embree_->scene, ray, hit)) return true;
    t_begin = std::nextafter(1.000001f * std::max(hit.t, t_begin), far_away);  // the same place is not met again
  }
  return false;
}

void Intersector::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  std::fill(blocked.begin(), blocked.end(), std::uint8_t{0});
  if (!has_surfaces()) return;
  for (std::size_t first = 0; first < rays.size(); first += packet_size) {
    const int n = static_cast<int>(std::min<std::size_t>(packet_size, rays.size() - first));
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    alignas(64) int valid[packet_size] = {};
    RTCRay16 packet{};
    for (int i = 0; i < n; ++i) {
      const Ray& ray = rays[first + static_cast<std::size_t>(i)];
      valid[i] = is_valid(ray) ? -1 : 0;
      set_ray(packet, i, ray, ray.t_max);
    }
    rtcOccluded16(valid, embree_->world.surfaces, &context, &packet);
    for (int i = 0; i < n; ++i) blocked[first + static_cast<std::size_t>(i)] = packet.tfar[i] < 0;
  }
  if (!embree_->has_cut_outs) return;
  SurfaceHit hit;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (blocked[i]) blocked[i] = nearest_surface(rays[i], hit);
}

void Intersector::crossings(std::span<const Ray> rays, std::vector<Crossing>& found) const {
  found.clear();
  if (!has_boundaries()) return;
  for (std::size_t first = 0; first < rays.size(); first += packet_size) {
    const int n = static_cast<int>(std::min<std::size_t>(packet_size, rays.size() - first));
    CrossingContext context;
    rtcInitIntersectContext(&context.embree);
    context.found = &found;
    context.first_ray = static_cast<int>(first);
    context.first_instance = embree_->first_instance();
    const std::size_t before = found.size();
    alignas(64) int valid[packet_size] = {};
    RTCRayHit16 packet{};
    for (int i = 0; i < n; ++i) {
      const Ray& ray = rays[first + static_cast<std::size_t>(i)];
      valid[i] = is_valid(ray) ? -1 : 0;
      set_ray(packet.ray, i, ray, far_away);
      packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, embree_->world.boundaries, &context.embree, &packet);
    drop_doubles(embree_->scene, found, before);
  }
}

}  // namespace brume
