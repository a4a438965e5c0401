#include "render/shadow_cache.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include "base/parallel.h"
#include "render/lights.h"

namespace brume {

using kernel::vec3;

namespace {

constexpr int most_points_an_axis = 128;
constexpr double most_bytes = 256e6;
// How far the outermost points lie within the grid, in voxels: rays along its faces could be rounded to pass it by.
constexpr double inset = 1.0 / 64;

// Along each axis of a grid with these bounds.
std::array<int, 3> lattice_points(const CompiledGrid& grid, int most) {
  std::array<int, 3> points{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    points[axis] = static_cast<int>(std::clamp(std::ceil(0.5f * (grid.bounds_hi[axis] - grid.bounds_lo[axis])) + 1,
                                               2.0f, static_cast<float>(most)));
  return points;
}

}  // namespace

ShadowCache::ShadowCache(const CompiledScene& scene, const Intersector& intersector, const MediaAlongRay& media,
                         int threads, const std::function<bool()>& keep_going)
    : scene_(scene), media_(scene.media), lattice_of_(scene.lights.size() * scene.media.size(), -1) {
  std::size_t lights = 0;
  for (const CompiledLight& light : scene.lights) lights += !has_extent(light);
  const auto bytes = [&](int most) {
    double points = 0;
    for (const CompiledMedium& medium : media_) {
      if (medium.grid < 0) continue;
      const auto [x, y, z] = lattice_points(scene.grids[static_cast<std::size_t>(medium.grid)], most);
      points += static_cast<double>(x) * y * z;
    }
    return points * static_cast<double>(lights * sizeof(Spectrum));
  };
  int most = most_points_an_axis;
  while (most > 2 && bytes(most) > most_bytes) most = most * 3 / 4;
  for (std::size_t light = 0; light < scene.lights.size(); ++light)
    for (std::size_t medium = 0; medium < media_.size(); ++medium)
      if (!has_extent(scene.lights[light]) && media_[medium].grid >= 0)
        add_lattice(light, static_cast<int>(medium), most);

  threads = thread_count(threads);
  std::vector<std::unique_ptr<Visibility>> visibilities;
  for (int i = 0; i < threads; ++i) visibilities.push_back(std::make_unique<Visibility>(scene, intersector, media));
  std::atomic<bool> stopped = false;
  for (Lattice& lattice : lattices_)
    parallel_for(lattice.points[2], threads, [&](int layer, int worker) {
      if (stopped) return;
      fill_layer(lattice, layer, *visibilities[static_cast<std::size_t>(worker)]);
      if (worker == 0 && !keep_going()) stopped = true;
    });
  for (const auto& v : visibilities)
    if (const auto place = v->too_many_media()) too_many_media_ = place;
}

void ShadowCache::add_lattice(std::size_t light, int medium, int most_points) {
  const auto index = static_cast<std::size_t>(medium);
  const CompiledGrid& grid = scene_.grids[static_cast<std::size_t>(media_[index].grid)];
  Lattice lattice{light, medium, lattice_points(grid, most_points), {}, {}, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double lo = static_cast<double>(grid.bounds_lo[axis]) + inset,
                 hi = static_cast<double>(grid.bounds_hi[axis]) - inset;
    lattice.lo[axis] = lo;
    lattice.spacing[axis] = (hi - lo) / (lattice.points[axis] - 1);
  }
  const auto [x, y, z] = lattice.points;
  lattice.values.resize(static_cast<std::size_t>(x) * static_cast<std::size_t>(y) * static_cast<std::size_t>(z));
  lattice_of_[light * media_.size() + index] = static_cast<int>(lattices_.size());
  lattices_.push_back(std::move(lattice));
}

// The points of one z, a row of shadow rays at a time.
void ShadowCache::fill_layer(Lattice& lattice, int layer, Visibility& visibility) const {
  const Transform world_from_index = inverse(media_[static_cast<std::size_t>(lattice.medium)].index_from_world);
  const auto [nx, ny, nz] = lattice.points;
  ShadowRays rays;
  std::vector<Spectrum> row;
  for (int y = 0; y < ny; ++y) {
    RandomStream random(scene_, y, layer, lattice.medium);
    rays.clear();
    for (int x = 0; x < nx; ++x) {
      const Vector3 p =
          world_from_index.point({lattice.lo[0] + x * lattice.spacing[0], lattice.lo[1] + y * lattice.spacing[1],
                                  lattice.lo[2] + layer * lattice.spacing[2]});
      const vec3 origin(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
      rays.add(sample_light(scene_, scene_.lights[lattice.light], origin, nullptr, RandomStream::Pair{}).ray,
               random.next_bits());
    }
    row.assign(rays.size(), constant_spectrum(1));
    visibility.cross_media(rays, row);
    std::copy(row.begin(), row.end(),
              lattice.values.begin() + (static_cast<std::ptrdiff_t>(layer) * ny + y) * static_cast<std::ptrdiff_t>(nx));
  }
}

Spectrum ShadowCache::transmittance(std::size_t light, int medium, vec3 p) const {
  const Lattice& lattice = lattices_[static_cast<std::size_t>(lattice_of(light, medium))];
  const Vector3 at = media_[static_cast<std::size_t>(medium)].index_from_world.point({p.x, p.y, p.z});
  std::array<std::size_t, 3> cell{};
  std::array<float, 3> f{};
  const std::array index{at.x, at.y, at.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = lattice.points[axis] - 1;
    const double place = std::clamp((index[axis] - lattice.lo[axis]) / lattice.spacing[axis], 0.0, last);
    cell[axis] = static_cast<std::size_t>(std::min(place, last - 1));
    f[axis] = static_cast<float>(place - static_cast<double>(cell[axis]));
  }
  const auto row = static_cast<std::size_t>(lattice.points[0]),
             layer = row * static_cast<std::size_t>(lattice.points[1]);
  const std::size_t first = cell[2] * layer + cell[1] * row + cell[0];
  Spectrum result;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const float weight = (x ? f[0] : 1 - f[0]) * (y ? f[1] : 1 - f[1]) * (z ? f[2] : 1 - f[2]);
    result = result + weight * lattice.values[first + z * layer + y * row + x];
  }
  return result;
}

}  // namespace brume
