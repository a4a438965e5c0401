// CompiledScene: what integrators and intersectors see. Flat arrays with indices and offsets in place of pointers, so
// that a GPU could take them as they are. Everything is in world space unless its name says otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/film_response.h"
#include "base/geometry.h"
#include "base/pixel_box.h"
#include "base/pixel_filter.h"
#include "base/spectrum.h"
#include "base/sphere_map.h"
#include "kernel/scalar.h"

namespace brume {

constexpr int no_medium = -1;
// The most media that may be active at one point along a path.
constexpr int max_active_media = 16;

// A brick grid (see kernel/lookup.inl): two arrays of words and how to read them.
struct CompiledGrid {
  std::vector<std::uint32_t> table, words;
  std::uint32_t table_x = 0, table_xy = 0, bits = 16, bordered = 0;
  float max_density = 0;  // bounds every value, rounding included
  // Local bounds (see kernel/majorant.inl).
  std::vector<std::uint32_t> majorants;
  std::uint32_t majorant_row = 0, majorant_layer = 0;
  float majorant_cells_per_voxel = 0;
  std::array<float, 3> bounds_lo{}, bounds_hi{};  // index coordinates; the density is 0 outside
  kernel::BrickGrid view() const { return {table.data(), words.data(), table_x, table_xy, bits, bordered}; }
  kernel::MajorantGrid majorant_view() const {
    return {majorants.data(), majorant_row, majorant_layer, majorant_cells_per_voxel};
  }
};

// Coefficients, phase function, and the density's grid with its placement; homogeneous where grid is below 0.
struct CompiledMedium {
  Spectrum sigma_t, sigma_s;  // per world unit at density 1
  Spectrum emission;          // sigma_a Le, per world unit at density 1 and where its factor is 1
  int phase = 0;
  std::array<float, 4> phase_prepared{};
  int grid = -1;
  int emission_factor = -1;  // in emission_factors: of every medium with a grid that emits; of no other
  bool linear = true;
  Transform index_from_world;
  double default_step = 0;  // world units, half the smallest edge of a voxel; 0 for homogeneous media
};

// What emission is multiplied by from place to place (kernel/emission.inl), and where to look for it.
struct CompiledEmissionFactor {
  int temperature = -1, strength = -1;                    // grids; below 0: none
  Transform temperature_from_index, strength_from_index;  // from the index coordinates of the medium's density
  float temperature_offset = 0, temperature_scale = 1;
  // Of each of the density's cells of majorants: about how much of what is emitted in it is to be gathered along
  // flights, in proportion. Above 0 wherever the density is.
  std::vector<std::uint32_t> cells;
  float thin = 0;  // world units; see emission_along_flights of the kernel
};

// A box, lo <= p <= hi, or the unit ball, |p| <= 1, in coordinates of its own.
struct CompiledRegion {
  enum class Kind { box, ball } kind = Kind::box;
  Transform local_from_world;
  std::array<float, 3> lo{-1, -1, -1}, hi{1, 1, 1};
  bool contains(Vector3 p_world) const {
    const Vector3 p = local_from_world.point(p_world);
    if (kind == Kind::ball) return dot(p, p) <= 1;
    return p.x >= static_cast<double>(lo[0]) && p.x <= static_cast<double>(hi[0]) &&
           p.y >= static_cast<double>(lo[1]) && p.y <= static_cast<double>(hi[1]) &&
           p.z >= static_cast<double>(lo[2]) && p.z <= static_cast<double>(hi[2]);
  }
};

// A medium that fills a region, but for a hole where another shape displaces it. The coordinates of a grid's region are
// the grid's index coordinates, and the region lies within the grid's bounds.
struct CompiledVolume {
  std::int32_t medium = no_medium;
  CompiledRegion region;
  std::int32_t hole = -1;  // in `holes`; below 0: none
};

// From a place on a surface to the plane of a texture: s = (row 0) . (u, v, 0, 1), t with row 1; planar, with the
// point's (x, y, z, 1) in place of (u, v, 0, 1).
struct CompiledMapping {
  bool planar = false;
  std::array<std::array<double, 4>, 2> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}}};
};

// What it computes of its operands, which are textures that come before it: see the kinds of TextureDescription.
struct CompiledTexture {
  enum class Kind { constant, scale, mix, checkerboard, image } kind = Kind::constant;
  Spectrum value;                          // constant
  std::array<std::int32_t, 3> operands{};  // scale: texture, factor; mix: two and the amount; checkerboard: two
  CompiledMapping mapping;                 // checkerboard, image
  std::int32_t image = -1;                 // in images
  enum class Wrap { repeat, clamp, black } wrap = Wrap::repeat;
  bool bilinear = true, invert = false;
  float scale = 1;
};

// Linear values, rows from the top, `channels` (1 or 3) a pixel.
struct CompiledImage {
  std::uint32_t width = 0, height = 0, channels = 3;
  std::vector<float> pixels;
};

// A surface. blinn_phong: the sum of f = diffuse / pi + highlight c (n.h)^shininess, of a mirror, and of glass that the
// share `refraction` of the light meets (1 for a dielectric), which it reflects and refracts by Fresnel's equations;
// highlight = specular lerp(1, diffuse, metallic). conductor: a metal. coated_diffuse: glass above a diffuse base.
// rough_dielectric: glass whose facets reflect and refract; all of the light meets it, and so `refraction` is 1.
struct CompiledMaterial {
  enum class Kind { blinn_phong, conductor, coated_diffuse, rough_dielectric } kind = Kind::blinn_phong;
  Spectrum diffuse, specular, mirror, refraction;
  Spectrum ambient;                                         // colour under the scene's ambient light
  std::int32_t diffuse_texture = -1, ambient_texture = -1;  // at or above 0: in place of diffuse and ambient
  std::int32_t displacement = -1, normal_map = -1;          // textures (see intersect/relief.h); below 0: none
  float shininess = 1, metallic = 0;
  float highlight_scale = 0;       // c
  Spectrum eta, k;                 // conductor: complex index of refraction
  float refractive_index = 1;      // of glass: inside over outside
  float alpha = 0;                 // not blinn_phong: see base/microfacet.h; 0: smooth
  float internal_reflectance = 0;  // coated_diffuse: of the coat, for diffuse light from its inside
  // coated_diffuse with alpha above 0: how much light the coat lets in, by its cosine: 0, 1 / 32, 2 / 32, ..., 1.
  std::array<float, 33> coat_transmittance{};
  auto operator<=>(const CompiledMaterial&) const = default;
};
inline bool is_textured(const CompiledMaterial& m) { return m.diffuse_texture >= 0 || m.ambient_texture >= 0; }
inline bool has_relief(const CompiledMaterial& m) { return m.displacement >= 0 || m.normal_map >= 0; }

// The two sides of a shape that bounds media: crossing it inwards removes `outside` and adds `inside`.
struct CompiledBoundary {
  std::int32_t inside = no_medium, outside = no_medium;
};

// Triangles that share a material and a boundary.
struct CompiledMesh {
  std::uint32_t first_vertex = 0, vertex_count = 0;      // in `positions`
  std::uint32_t first_triangle = 0, triangle_count = 0;  // in `triangles`
  bool has_normals = false;
  std::int64_t first_uv =
      -1;                    // in `uvs`, one a vertex; below 0: (0, 0), (1, 0), (1, 1) at the corners of each triangle
  bool flip_normal = false;  // the geometric normal is the negative of (p1 - p0) x (p2 - p0)
};

// A part of a unit sphere, disk, cylinder or saddle under an affine map. The disk lies at z = 0 and faces +z, the
// cylinder stands on it and reaches to z = 1. The saddle is z = x y over the unit square, facing +z: any bilinear patch
// that is not flat is the image of it.
struct CompiledQuadric {
  enum class Kind { sphere, disk, cylinder, saddle } kind = Kind::sphere;
  Transform object_from_world;
  Transform world_from_object;
  double z_min = -1, z_max = 1;           // sphere: where it is cut
  double inner_radius = 0;                // disk: of its hole
  double phi_max = 2 * std::numbers::pi;  // radians from the x axis
  bool flip_normal = false;
  std::int32_t patch = -1;  // saddle: in `patches`; below 0: no shading normals, and uv is the place in the unit square
  bool is_whole_sphere() const {
    return kind == Kind::sphere && z_min <= -1 && z_max >= 1 && phi_max >= 2 * std::numbers::pi;
  }
};

// At the corners (0, 0), (1, 0), (0, 1), (1, 1) of a saddle.
struct CompiledPatch {
  std::array<std::array<float, 3>, 4> normals{};  // all 0: none
  std::array<std::array<float, 2>, 4> uv{};
};

// What a shape is, apart from its geometry.
struct CompiledShape {
  enum class Kind { mesh, quadric } kind = Kind::mesh;
  std::uint32_t index = 0;     // in meshes or quadrics
  std::int32_t material = -1;  // below 0: no surface
  std::int32_t boundary = -1;  // below 0: the same media on both sides
  std::int32_t light = -1;     // the area light that it is; below 0: none
  std::int32_t alpha = -1;     // the texture of the share of rays that meet it; below 0: all do
  bool is_textured = false;    // its material, its relief, its alpha or its light depends on where a hit is
};

// A part of the scene's shapes that is placed as a whole.
struct CompiledObject {
  std::uint32_t first_shape = 0, shape_count = 0;
};

// An object in the world. Its shapes' "world" is then the object's own space, and normals that point out of a shape
// still do.
struct CompiledInstance {
  std::uint32_t object = 0;
  Transform world_from_object, object_from_world;
  float largest_scale = 1;  // lengths grow by no more
};

// The directions in which a point light shines, about a unit axis (kernel/cone.inl): all of them, where nothing else is
// said.
struct LightCone {
  kernel::vec3 axis{0, 0, 1};
  float end = -3, start = -2;  // cosines
  // The mean of its fall-off over all directions.
  float share() const { return start < -1 ? 1 : 0.5f * (1 - 0.5f * (start + end)); }
};

struct CompiledLight {
  enum class Kind { point, distant, infinite, image, area } kind = Kind::point;
  Vector3 position;      // point
  LightCone cone;        // point
  Vector3 direction_to;  // distant: unit, towards the light
  Spectrum value;        // point: intensity on its axis; distant: irradiance of a facing surface; infinite and area:
                         // radiance; image: a factor
  float chance = 0;      // with which it is chosen among all lights (see light_cdf)
  std::int32_t environment = -1;  // image: in environments
  std::int32_t portal = -1;       // image: in portals; below 0: it shines from everywhere

  // Area: its shape, as CompiledShape has it, and its area, which for a quadric is that before the affine map.
  CompiledShape::Kind shape_kind = CompiledShape::Kind::mesh;
  std::uint32_t shape_index = 0;
  bool two_sided = false;
  float area = 0;
  std::int32_t texture = -1;             // what the radiance is multiplied by from place to place; below 0: 1
  std::int32_t alpha = -1;               // as its shape has it; below 0: all of its points shine
  bool is_seen = true;                   // by rays that meet it
  std::uint32_t first_triangle_cdf = 0;  // mesh: in triangle_cdfs
};

inline bool is_textured(const CompiledLight& light) { return light.texture >= 0 || light.alpha >= 0; }

// An image around the scene, constant in each of its pixels, and a table to draw pixels in proportion to the mean of
// their channels times solid angle. Row i holds the pixels [i width, (i + 1) width); cumulative chances begin with 0
// and end with 1.
struct CompiledEnvironment {
  SphereMap map = SphereMap::equal_area;
  std::uint32_t width = 0, height = 0;
  Transform light_from_world, world_from_light;  // rotations, mirroring allowed
  std::vector<float> pixels;                     // 3 a pixel
  std::vector<float> pixel_solid_angle;          // by row
  std::vector<float> row_cdf;                    // height + 1
  std::vector<float> pixel_cdf;                  // width + 1 a row
};

// A rectangle through which alone an image shines, and only for who looks out: along directions on the side of
// `outwards`. Its points are corner + s x + t y, for s from 0 to width and t from 0 to height.
struct CompiledPortal {
  Vector3 corner;
  Vector3 x, y, outwards;  // unit, and at right angles to each other
  double width = 0, height = 0;
  float image_share = 0;  // of the directions towards the light: these are drawn from the image's table
};

struct CompiledCamera {
  Transform world_from_camera;
  std::optional<SphereMap> sphere_map;  // of a camera that shows all directions
  // Camera-space ray through the picture's point (x, y), in pixels from the top left, and the middle of the lens:
  // (x0 + x dx, y0 + y dy, 1); with a sphere_map, its point (x0 + x dx, y0 + y dy).
  double x0 = 0, dx = 0, y0 = 0, dy = 0;
  double lens_radius = 0, focal_distance = 1e6;  // in camera space
  bool has_lens() const { return lens_radius > 0; }
};

// Where random numbers come from: render/random_stream.h.
enum class SamplerKind { independent, zsobol };

struct CompiledIntegrator {
  enum class Kind { classic, reference, volpath } kind = Kind::classic;
  int max_depth = 5;
  bool dda = false;
  float placement_base = 0.5f, placement_spread = 0;  // see kernel/march.inl
  double step = 0;                                    // world units; 0: each medium's default
  bool cached_shadows = false;                        // of media, for single scattering: see render/shadow_cache.h
  int shadow_samples = 1;                             // shadow rays from a surface to a light with a size
};

struct CompiledScene {
  std::string file = "scene";  // for messages about all of it
  int width = 0, height = 0;   // of the whole picture
  PixelBox crop;               // the pixels of it that are rendered: the film's
  int samples_per_pixel = 16;
  std::uint32_t seed = 0;
  SamplerKind sampler = SamplerKind::independent;
  PixelFilter filter;
  FilmResponse film_response;
  CompiledCamera camera;
  CompiledIntegrator integrator;

  std::vector<CompiledGrid> grids;
  std::vector<CompiledMedium> media;
  std::vector<CompiledEmissionFactor> emission_factors;
  std::vector<std::uint32_t> blackbody;  // the table of kernel/emission.inl, where a medium has temperatures
  std::vector<CompiledVolume> volumes;
  std::vector<CompiledRegion> holes;
  std::int32_t camera_medium = no_medium;  // as the Camera directive records it

  std::vector<std::array<float, 3>> positions, normals;  // normals are parallel to positions where any mesh has them
  std::vector<std::array<std::uint32_t, 3>> triangles;   // relative to the mesh's first vertex
  std::vector<CompiledMesh> meshes;
  std::vector<CompiledQuadric> quadrics;
  std::vector<CompiledPatch> patches;
  std::vector<std::array<float, 2>> uvs;
  std::vector<CompiledShape> shapes;  // those of the objects, then those that stand in the world themselves
  std::vector<CompiledObject> objects;
  CompiledObject world;
  std::vector<CompiledInstance> instances;
  std::vector<CompiledBoundary> boundaries;
  std::vector<CompiledMaterial> materials;
  std::vector<CompiledTexture> textures;
  std::vector<CompiledImage> images;
  std::vector<CompiledLight> lights;
  Spectrum ambient;                  // radiance from everywhere, for `classic`
  float mean_radiance = 0;           // in the scene, about: that of light which crosses it without being absorbed
  std::vector<float> light_cdf;      // cumulative chances of lights, without the leading 0
  std::vector<float> triangle_cdfs;  // cumulative shares of area of the triangles of mesh lights, likewise
  std::vector<CompiledEnvironment> environments;
  std::vector<CompiledPortal> portals;
};

// As kernels take it.
inline kernel::PlacedGrid placed_grid(const CompiledGrid& grid, const Transform& own_from_index, bool linear) {
  kernel::PlacedGrid placed{grid.view(), {}, {}, {}, linear};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t i = 0; i < 4; ++i) placed.to_own[4 * row + i] = static_cast<float>(own_from_index.m[row][i]);
    placed.lo[row] = grid.bounds_lo[row];
    placed.hi[row] = grid.bounds_hi[row];
  }
  return placed;
}

inline kernel::EmissionField emission_field(const CompiledScene& scene, const CompiledMedium& medium) {
  kernel::EmissionField field{};
  if (medium.emission_factor < 0) return field;
  const auto& factor = scene.emission_factors[static_cast<std::size_t>(medium.emission_factor)];
  const auto place = [&](int grid, const Transform& own_from_index) {
    return placed_grid(scene.grids[static_cast<std::size_t>(grid)], own_from_index, medium.linear);
  };
  field.has_temperature = factor.temperature >= 0;
  if (field.has_temperature) field.temperature = place(factor.temperature, factor.temperature_from_index);
  field.has_strength = factor.strength >= 0;
  if (field.has_strength) field.strength = place(factor.strength, factor.strength_from_index);
  field.offset = factor.temperature_offset;
  field.scale = factor.temperature_scale;
  field.blackbody = scene.blackbody.data();
  return field;
}

// Of each medium.
inline std::vector<kernel::EmissionField> emission_fields(const CompiledScene& scene) {
  std::vector<kernel::EmissionField> fields;
  for (const CompiledMedium& medium : scene.media) fields.push_back(emission_field(scene, medium));
  return fields;
}

// What a medium emits at a place in its grid's index coordinates, per unit of density.
inline Spectrum emission_at(const CompiledMedium& medium, const kernel::EmissionField& field, kernel::vec3 p_index) {
  if (is_zero(medium.emission)) return {};
  const kernel::vec3 factor = kernel::emission_factor(field, p_index);
  return medium.emission * Spectrum{{factor.x, factor.y, factor.z}};
}

}  // namespace brume
