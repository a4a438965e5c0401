#include "intersect/intersector.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <tuple>

#include "intersect/quadric.h"

namespace brume {

using kernel::vec3;

namespace {

constexpr int packet_size = 16;
constexpr float infinity = std::numeric_limits<float>::infinity();

// What a boundary query carries through Embree to the callbacks that collect its crossings.
struct CrossingContext {
  RTCIntersectContext embree;  // first, so that a pointer to it is a pointer to this
  std::vector<Crossing>* found;
  int first_ray;
};

// A quadric for Embree: one user geometry of one primitive.
struct QuadricGeometry {
  const CompiledQuadric* quadric;
  int shape;
  bool is_boundary;
};

void quadric_geometry_bounds(const RTCBoundsFunctionArguments* args) {
  const Box3 box = quadric_bounds(*static_cast<const QuadricGeometry*>(args->geometryUserPtr)->quadric);
  float* lo = &args->bounds_o->lower_x;
  float* hi = &args->bounds_o->upper_x;
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = static_cast<float>(box.lo[axis]);
    hi[axis] = static_cast<float>(box.hi[axis]);
  }
}

// Calls visit(lane, hit) for the hits of the rays of a packet, nearest first, also those behind their origins.
template <class Visit>
void for_hits(const int* valid, unsigned n, RTCRayN* rays, const QuadricGeometry& geometry, Visit visit) {
  for (unsigned i = 0; i < n; ++i) {
    if (valid[i] != -1) continue;
    const Vector3 o{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)};
    const Vector3 d{RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)};
    std::array<QuadricHit, 2> hits;
    const int count = quadric_hits(*geometry.quadric, o, d, hits);
    for (int k = 0; k < count; ++k) visit(i, hits[static_cast<std::size_t>(k)]);
  }
}

void add_crossing(CrossingContext& context, unsigned lane, float t, int shape, bool inwards) {
  context.found->push_back({context.first_ray + static_cast<int>(lane), t, shape, inwards});
}

void quadric_intersect(const RTCIntersectFunctionNArguments* args) {
  const auto& geometry = *static_cast<const QuadricGeometry*>(args->geometryUserPtr);
  const unsigned n = args->N;
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, n);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, n);
  for_hits(args->valid, n, rays, geometry, [&](unsigned i, QuadricHit hit) {
    const auto t = static_cast<float>(hit.t);
    if (geometry.is_boundary) {
      auto& context = *reinterpret_cast<CrossingContext*>(args->context);
      if (hit.t > 0) add_crossing(context, RTCRayN_id(rays, n, i), t, geometry.shape, hit.inwards);
      return;
    }
    if (!(t > RTCRayN_tnear(rays, n, i) && t < RTCRayN_tfar(rays, n, i))) return;
    RTCRayN_tfar(rays, n, i) = t;
    RTCHitN_geomID(hits, n, i) = static_cast<unsigned>(geometry.shape);
    RTCHitN_primID(hits, n, i) = 0;
    RTCHitN_instID(hits, n, i, 0) = RTC_INVALID_GEOMETRY_ID;
  });
}

void quadric_occluded(const RTCOccludedFunctionNArguments* args) {
  const auto& geometry = *static_cast<const QuadricGeometry*>(args->geometryUserPtr);
  for_hits(args->valid, args->N, args->ray, geometry, [&](unsigned i, QuadricHit hit) {
    const auto t = static_cast<float>(hit.t);
    if (t > RTCRayN_tnear(args->ray, args->N, i) && t < RTCRayN_tfar(args->ray, args->N, i))
      RTCRayN_tfar(args->ray, args->N, i) = -infinity;
  });
}

// Collects a triangle's crossing and lets the ray go on.
void collect_crossing(const RTCFilterFunctionNArguments* args) {
  auto& context = *reinterpret_cast<CrossingContext*>(args->context);
  const bool flip = args->geometryUserPtr != nullptr;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    args->valid[i] = 0;
    const vec3 normal(RTCHitN_Ng_x(args->hit, args->N, i), RTCHitN_Ng_y(args->hit, args->N, i),
                      RTCHitN_Ng_z(args->hit, args->N, i));
    const vec3 direction(RTCRayN_dir_x(args->ray, args->N, i), RTCRayN_dir_y(args->ray, args->N, i),
                         RTCRayN_dir_z(args->ray, args->N, i));
    const bool inwards = (dot(normal, direction) < 0) != flip;
    add_crossing(context, RTCRayN_id(args->ray, args->N, i), RTCRayN_tfar(args->ray, args->N, i),
                 static_cast<int>(RTCHitN_geomID(args->hit, args->N, i)), inwards);
  }
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

// Drops the second of two passages the same way through one shape at one place: the edge of two triangles.
void drop_doubles(std::vector<Crossing>& found, std::size_t first) {
  std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.ray, a.t, a.shape, a.inwards) < std::tie(b.ray, b.t, b.shape, b.inwards);
  });
  std::size_t kept = first;
  for (std::size_t i = first; i < found.size(); ++i) {
    const Crossing& c = found[i];
    bool is_double = false;
    for (std::size_t j = kept; j-- > first && found[j].ray == c.ray && c.t - found[j].t <= 4e-6f * c.t;)
      is_double = is_double || (found[j].shape == c.shape && found[j].inwards == c.inwards);
    if (!is_double) found[kept++] = c;
  }
  found.resize(kept);
}

}  // namespace

struct Intersector::Embree {
  const CompiledScene& scene;
  RTCDevice device = nullptr;
  RTCScene surfaces = nullptr, boundaries = nullptr;
  int surface_count = 0, boundary_count = 0;
  std::vector<std::unique_ptr<QuadricGeometry>> quadrics;

  explicit Embree(const CompiledScene& s) : scene(s) {
    device = rtcNewDevice("threads=1,set_affinity=0");
    if (!device) throw std::runtime_error("Embree cannot start on this machine");
    surfaces = rtcNewScene(device);
    boundaries = rtcNewScene(device);
    for (RTCScene rtc : {surfaces, boundaries}) rtcSetSceneFlags(rtc, RTC_SCENE_FLAG_ROBUST);
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
      const CompiledShape& shape = scene.shapes[i];
      if (shape.material >= 0) attach(surfaces, static_cast<int>(i), false), ++surface_count;
      if (shape.boundary >= 0) attach(boundaries, static_cast<int>(i), true), ++boundary_count;
    }
    for (RTCScene rtc : {surfaces, boundaries}) rtcCommitScene(rtc);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::bad_alloc();
  }

  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  ~Embree() {
    rtcReleaseScene(surfaces);
    rtcReleaseScene(boundaries);
    rtcReleaseDevice(device);
  }

  void attach(RTCScene rtc, int shape_index, bool is_boundary) {
    const CompiledShape& shape = scene.shapes[static_cast<std::size_t>(shape_index)];
    RTCGeometry geometry = shape.kind == CompiledShape::Kind::mesh
                               ? mesh_geometry(scene.meshes[shape.index], is_boundary)
                               : quadric_geometry(scene.quadrics[shape.index], shape_index, is_boundary);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(rtc, geometry, static_cast<unsigned>(shape_index));
    rtcReleaseGeometry(geometry);
  }

  // Copies, since Embree reads a few bytes beyond the last vertex.
  RTCGeometry mesh_geometry(const CompiledMesh& mesh, bool is_boundary) const {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<std::array<float, 3>*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(std::array<float, 3>), mesh.vertex_count));
    auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(std::array<std::uint32_t, 3>), mesh.triangle_count));
    if (!vertices || !triangles) throw std::bad_alloc();
    std::copy_n(scene.positions.begin() + mesh.first_vertex, mesh.vertex_count, vertices);
    std::copy_n(scene.triangles.begin() + mesh.first_triangle, mesh.triangle_count, triangles);
    if (is_boundary) {
      rtcSetGeometryIntersectFilterFunction(geometry, collect_crossing);
      // Any non-null pointer says that the shape's normal is the negative of the triangle's.
      rtcSetGeometryUserData(geometry, mesh.flip_normal ? const_cast<CompiledMesh*>(&mesh) : nullptr);
    }
    return geometry;
  }

  RTCGeometry quadric_geometry(const CompiledQuadric& quadric, int shape_index, bool is_boundary) {
    quadrics.push_back(std::make_unique<QuadricGeometry>(QuadricGeometry{&quadric, shape_index, is_boundary}));
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, 1);
    rtcSetGeometryUserData(geometry, quadrics.back().get());
    rtcSetGeometryBoundsFunction(geometry, quadric_geometry_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, quadric_intersect);
    rtcSetGeometryOccludedFunction(geometry, quadric_occluded);
    return geometry;
  }

  // Fills in the normals of a hit on a triangle, given Embree's normal and barycentric coordinates.
  void mesh_normals(const RTCHit& rtc, const CompiledMesh& mesh, SurfaceHit& hit) const {
    vec3 n = normalize(vec3(rtc.Ng_x, rtc.Ng_y, rtc.Ng_z));
    if (mesh.flip_normal) n = -n;
    hit.normal = hit.shading_normal = n;
    if (!mesh.has_normals) return;
    const auto& triangle = scene.triangles[mesh.first_triangle + rtc.primID];
    const float weights[3] = {1 - rtc.u - rtc.v, rtc.u, rtc.v};
    vec3 smooth(0, 0, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& v = scene.normals[mesh.first_vertex + triangle[i]];
      smooth = smooth + weights[i] * vec3(v[0], v[1], v[2]);
    }
    const float squared = dot(smooth, smooth);
    if (!(squared > 0)) return;
    smooth = smooth * (1 / std::sqrt(squared));
    hit.shading_normal = smooth;
    if (dot(smooth, n) < 0) hit.normal = -n;
  }
};

Intersector::Intersector(const CompiledScene& scene) : embree_(std::make_unique<Embree>(scene)) {}
Intersector::~Intersector() = default;

bool Intersector::has_surfaces() const { return embree_->surface_count > 0; }
bool Intersector::has_boundaries() const { return embree_->boundary_count > 0; }

bool Intersector::nearest_surface(const Ray& ray, SurfaceHit& hit) const {
  if (!has_surfaces()) return false;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit r{};
  r.ray = {ray.origin.x,
           ray.origin.y,
           ray.origin.z,
           0,
           ray.direction.x,
           ray.direction.y,
           ray.direction.z,
           0,
           ray.t_max,
           ~0u,
           0,
           0};
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_->surfaces, &context, &r);
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit.t = r.ray.tfar;
  hit.shape = static_cast<int>(r.hit.geomID);
  const CompiledShape& shape = embree_->scene.shapes[r.hit.geomID];
  if (shape.kind == CompiledShape::Kind::mesh) {
    embree_->mesh_normals(r.hit, embree_->scene.meshes[shape.index], hit);
  } else {
    const vec3 p = ray.at(hit.t);
    hit.normal = hit.shading_normal = quadric_normal(embree_->scene.quadrics[shape.index], {p.x, p.y, p.z});
  }
  return true;
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
      valid[i] = -1;
      set_ray(packet, i, ray, ray.t_max);
    }
    rtcOccluded16(valid, embree_->surfaces, &context, &packet);
    for (int i = 0; i < n; ++i) blocked[first + static_cast<std::size_t>(i)] = packet.tfar[i] < 0;
  }
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
    const std::size_t before = found.size();
    alignas(64) int valid[packet_size] = {};
    RTCRayHit16 packet{};
    for (int i = 0; i < n; ++i) {
      valid[i] = -1;
      set_ray(packet.ray, i, rays[first + static_cast<std::size_t>(i)], far_away);
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, embree_->boundaries, &context.embree, &packet);
    drop_doubles(found, before);
  }
}

}  // namespace brume
