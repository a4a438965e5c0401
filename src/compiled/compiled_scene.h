// CompiledScene: what integrators and intersectors see. Flat arrays with indices and offsets in place of pointers, so
// that a GPU could take them as they are. Everything is in world space unless its name says otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/geometry.h"
#include "base/pixel_filter.h"
#include "base/spectrum.h"
#include "kernel/scalar.h"

namespace brume {

constexpr int no_medium = -1;
// The most media that may be active at one point along a path.
constexpr int max_active_media = 16;

// A brick grid (see kernel/lookup.inl): two arrays of words and how to read them.
struct CompiledGrid {
  std::vector<std::uint32_t> table, words;
  std::uint32_t table_x = 0, table_xy = 0, bits = 16;
  float max_density = 0;                          // bounds every value, rounding included
  std::array<float, 3> bounds_lo{}, bounds_hi{};  // index coordinates; the density is 0 outside
  kernel::BrickGrid view() const { return {table.data(), words.data(), table_x, table_xy, bits}; }
};

// Coefficients, phase function, and the density's grid with its placement; homogeneous where grid is below 0.
struct CompiledMedium {
  Spectrum sigma_t, sigma_s;  // per world unit at density 1
  Spectrum emission;          // sigma_a Le, per world unit at density 1
  int phase = 0;
  std::array<float, 4> phase_prepared{};
  int grid = -1;
  bool linear = true;
  Transform index_from_world;
  double default_step = 0;  // world units, half the smallest edge of a voxel; 0 for homogeneous media
};

// Diffuse and Blinn-Phong in one: f = diffuse / pi + specular (s + 8) / (8 pi) (n.h)^s, and a mirror.
struct CompiledMaterial {
  Spectrum diffuse, specular, mirror;
  float shininess = 1;
  bool operator==(const CompiledMaterial&) const = default;
};

// The two sides of a shape that bounds media: crossing it inwards removes `outside` and adds `inside`.
struct CompiledBoundary {
  std::int32_t inside = no_medium, outside = no_medium;
};

// Triangles that share a material and a boundary.
struct CompiledMesh {
  std::uint32_t first_vertex = 0, vertex_count = 0;      // in `positions`
  std::uint32_t first_triangle = 0, triangle_count = 0;  // in `triangles`
  bool has_normals = false;
  bool flip_normal = false;  // the geometric normal is the negative of (p1 - p0) x (p2 - p0)
};

// A unit sphere under an affine map.
struct CompiledSphere {
  Transform object_from_world;
  Transform world_from_object;
  bool flip_normal = false;
};

// What a shape is, apart from its geometry.
struct CompiledShape {
  enum class Kind { mesh, sphere } kind = Kind::mesh;
  std::uint32_t index = 0;     // in meshes or spheres
  std::int32_t material = -1;  // below 0: no surface
  std::int32_t boundary = -1;  // below 0: the same media on both sides
};

struct CompiledLight {
  enum class Kind { point, distant, infinite } kind = Kind::point;
  Vector3 position;      // point
  Vector3 direction_to;  // distant: unit, towards the light
  Spectrum value;        // point: intensity; distant: irradiance of a facing surface; infinite: radiance
};

struct CompiledCamera {
  Transform world_from_camera;
  // Camera-space ray through the picture's point (x, y), in pixels from the top left: (x0 + x dx, y0 + y dy, 1).
  double x0 = 0, dx = 0, y0 = 0, dy = 0;
};

// Where random numbers come from: render/random_stream.h.
enum class SamplerKind { independent, zsobol };

struct CompiledIntegrator {
  enum class Kind { classic, reference } kind = Kind::classic;
  int max_depth = 5;
  bool dda = false;
  float placement_base = 0.5f, placement_spread = 0;  // see kernel/march.inl
  double step = 0;                                    // world units; 0: each medium's default
};

struct CompiledScene {
  int width = 0, height = 0;
  int samples_per_pixel = 16;
  std::uint32_t seed = 0;
  SamplerKind sampler = SamplerKind::independent;
  PixelFilter filter;
  CompiledCamera camera;
  CompiledIntegrator integrator;

  std::vector<CompiledGrid> grids;
  std::vector<CompiledMedium> media;
  std::vector<std::int32_t> free_volumes;  // media that fill their grid's bounds, without a shape
  std::int32_t camera_medium = no_medium;  // as the Camera directive records it

  std::vector<std::array<float, 3>> positions, normals;  // normals are parallel to positions where any mesh has them
  std::vector<std::array<std::uint32_t, 3>> triangles;   // relative to the mesh's first vertex
  std::vector<CompiledMesh> meshes;
  std::vector<CompiledSphere> spheres;
  std::vector<CompiledShape> shapes;
  std::vector<CompiledBoundary> boundaries;
  std::vector<CompiledMaterial> materials;
  std::vector<CompiledLight> lights;
};

}  // namespace brume
