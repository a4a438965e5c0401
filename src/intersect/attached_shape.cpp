#include "intersect/attached_shape.h"

#include <algorithm>
#include <limits>
#include <new>

namespace brume {

using kernel::vec3;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

void quadric_geometry_bounds(const RTCBoundsFunctionArguments* args) {
  const Box3 box = quadric_bounds(*static_cast<const AttachedShape*>(args->geometryUserPtr)->quadric);
  float* lo = &args->bounds_o->lower_x;
  float* hi = &args->bounds_o->upper_x;
  for (int axis = 0; axis < 3; ++axis) {
    lo[axis] = static_cast<float>(box.lo[axis]);
    hi[axis] = static_cast<float>(box.hi[axis]);
  }
}

// Calls visit(lane, hit) for the hits of the rays of a packet, nearest first, also those behind their origins.
template <class Visit>
void for_hits(const int* valid, unsigned n, RTCRayN* rays, const AttachedShape& shape, Visit visit) {
  for (unsigned i = 0; i < n; ++i) {
    if (valid[i] != -1) continue;
    const Vector3 o{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)};
    const Vector3 d{RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)};
    std::array<QuadricHit, 2> hits;
    const int count = quadric_hits(*shape.quadric, o, d, hits);
    for (int k = 0; k < count; ++k) visit(i, hits[static_cast<std::size_t>(k)]);
  }
}

// Of a ray within the instance that Embree calls `instance`, if in any.
void add_crossing(CrossingContext& context, unsigned ray, float t, int shape, unsigned instance, bool inwards) {
  const int place = instance == RTC_INVALID_GEOMETRY_ID ? -1 : static_cast<int>(instance - context.first_instance);
  context.found->push_back({context.first_ray + static_cast<int>(ray), t, shape, place, inwards});
}

void quadric_intersect(const RTCIntersectFunctionNArguments* args) {
  const auto& shape = *static_cast<const AttachedShape*>(args->geometryUserPtr);
  const unsigned n = args->N;
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, n);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, n);
  const unsigned instance = args->context->instID[0];
  for_hits(args->valid, n, rays, shape, [&](unsigned i, QuadricHit hit) {
    const auto t = static_cast<float>(hit.t);
    if (shape.is_boundary) {
      auto& context = *reinterpret_cast<CrossingContext*>(args->context);
      if (hit.t > 0) add_crossing(context, RTCRayN_id(rays, n, i), t, shape.shape, instance, hit.inwards);
      return;
    }
    if (!(t > RTCRayN_tnear(rays, n, i) && t < RTCRayN_tfar(rays, n, i))) return;
    RTCRayN_tfar(rays, n, i) = t;
    RTCHitN_geomID(hits, n, i) = args->geomID;
    RTCHitN_primID(hits, n, i) = 0;
    RTCHitN_instID(hits, n, i, 0) = instance;
  });
}

void quadric_occluded(const RTCOccludedFunctionNArguments* args) {
  const auto& shape = *static_cast<const AttachedShape*>(args->geometryUserPtr);
  for_hits(args->valid, args->N, args->ray, shape, [&](unsigned i, QuadricHit hit) {
    const auto t = static_cast<float>(hit.t);
    if (t > RTCRayN_tnear(args->ray, args->N, i) && t < RTCRayN_tfar(args->ray, args->N, i))
      RTCRayN_tfar(args->ray, args->N, i) = -infinity;
  });
}

// Collects a triangle's crossing and lets the ray go on.
void collect_crossing(const RTCFilterFunctionNArguments* args) {
  auto& context = *reinterpret_cast<CrossingContext*>(args->context);
  const auto& shape = *static_cast<const AttachedShape*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    args->valid[i] = 0;
    const vec3 normal(RTCHitN_Ng_x(args->hit, args->N, i), RTCHitN_Ng_y(args->hit, args->N, i),
                      RTCHitN_Ng_z(args->hit, args->N, i));
    const vec3 direction(RTCRayN_dir_x(args->ray, args->N, i), RTCRayN_dir_y(args->ray, args->N, i),
                         RTCRayN_dir_z(args->ray, args->N, i));
    const bool inwards = (dot(normal, direction) < 0) != shape.flip_normal;
    add_crossing(context, RTCRayN_id(args->ray, args->N, i), RTCRayN_tfar(args->ray, args->N, i), shape.shape,
                 RTCHitN_instID(args->hit, args->N, i, 0), inwards);
  }
}

// Copies, since Embree reads a few bytes beyond the last vertex.
RTCGeometry mesh_geometry(RTCDevice device, const CompiledScene& scene, const CompiledMesh& mesh, bool is_boundary) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<std::array<float, 3>*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(std::array<float, 3>), mesh.vertex_count));
  auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(std::array<std::uint32_t, 3>), mesh.triangle_count));
  if (!vertices || !triangles) throw std::bad_alloc();
  std::copy_n(scene.positions.begin() + mesh.first_vertex, mesh.vertex_count, vertices);
  std::copy_n(scene.triangles.begin() + mesh.first_triangle, mesh.triangle_count, triangles);
  if (is_boundary) rtcSetGeometryIntersectFilterFunction(geometry, collect_crossing);
  return geometry;
}

// One user geometry of one primitive.
RTCGeometry quadric_geometry(RTCDevice device) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryBoundsFunction(geometry, quadric_geometry_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, quadric_intersect);
  rtcSetGeometryOccludedFunction(geometry, quadric_occluded);
  return geometry;
}

}  // namespace

RTCGeometry make_geometry(RTCDevice device, const CompiledScene& scene, const AttachedShape& shape) {
  const CompiledShape& compiled = scene.shapes[static_cast<std::size_t>(shape.shape)];
  RTCGeometry geometry = shape.quadric ? quadric_geometry(device)
                                       : mesh_geometry(device, scene, scene.meshes[compiled.index], shape.is_boundary);
  rtcSetGeometryUserData(geometry, const_cast<AttachedShape*>(&shape));
  rtcCommitGeometry(geometry);
  return geometry;
}

}  // namespace brume
