#include "session/furnace.h"

#include <algorithm>
#include <limits>

#include "base/parallel.h"
#include "compile/compile.h"
#include "kernel/phase_table.h"
#include "render/random_keys.h"

namespace brume {

namespace {

constexpr std::uint32_t random_count = 1 << 12;
constexpr std::uint32_t path_count = 1024;  // as many as volpath has in flight

}  // namespace

CompiledScene furnace_scene(VolumeGrid grid, int threads) {
  CompiledMedium medium;
  medium.phase = phase_kind("henyey_greenstein");
  const float g = 0.85f;
  medium.phase_prepared = phase_functions()[static_cast<std::size_t>(medium.phase)].prepare(&g);
  medium.grid = 0;
  medium.index_from_world = inverse(grid.medium_from_index);
  CompiledGrid compiled = compile_grid(std::move(grid), medium.linear, BrickLayout::plain, thread_count(threads));
  medium.sigma_t = medium.sigma_s = constant_spectrum(100 / (2 * compiled.max_density));
  CompiledScene scene;
  scene.volumes = {{0, {CompiledRegion::Kind::box, medium.index_from_world, compiled.bounds_lo, compiled.bounds_hi}}};
  scene.media = {medium};
  scene.grids.push_back(std::move(compiled));
  return scene;
}

FurnacePaths::FurnacePaths(const CompiledScene& scene)
    : scene_(scene),
      intersector_(scene),
      media_along_ray_(scene, intersector_),
      media_(scene, intersector_, media_along_ray_),
      memory_(path_count),
      paths_(memory_),
      shadows_(memory_) {
  const CompiledMedium& medium = scene.media.front();
  job_.max_depth = std::numeric_limits<int>::max();
  job_.phase = medium.phase;
  std::copy(medium.phase_prepared.begin(), medium.phase_prepared.end(), job_.phase_numbers);
  for (int c = 0; c < 3; ++c) {
    job_.sigma_t[c] = medium.sigma_t[c];
    job_.sigma_s[c] = medium.sigma_s[c];
  }
  for (std::uint32_t i = 0; i < random_count; ++i) random_.push_back(kernel::random_uniform(1, 0, i, 0));
  for (std::uint32_t path = 0; path < path_count; ++path) start(path);
}

// At a random place of the volume's side z = -1, about along +z; with numbers from a table, for making them is not what
// is measured.
void FurnacePaths::start(std::uint32_t path) {
  const std::uint32_t number = started_++;
  const auto random = [&](std::uint32_t i) { return random_[(number * 19 + i) % random_count]; };
  const kernel::vec3 origin(2 * random(0) - 1, 2 * random(1) - 1, -1);
  const kernel::vec3 direction = normalize(kernel::vec3(0.3f * random(2) - 0.15f, 0.3f * random(3) - 0.15f, 1));
  const float from[] = {origin.x, origin.y, origin.z}, towards[] = {direction.x, direction.y, direction.z};
  for (int i = 0; i < 3; ++i) {
    paths_.ray.origin[i][path] = from[i];
    paths_.ray.direction[i][path] = towards[i];
    paths_.throughput[i][path] = paths_.rescale[i][path] = 1;
    paths_.radiance[i][path] = 0;
  }
  paths_.ray.t_max[path] = far_away;
  paths_.ray.key[path] = random_keys::event_key(0, 0);
  paths_.ray.pixel[path] = number;
  paths_.ray.sample[path] = paths_.ray.hero[path] = 0;
  for (std::uint32_t i = 0; i < point_dimensions; ++i) paths_.points[i][path] = random(4 + i);
  paths_.ray.distance_u[path] = paths_.points[0][path];
  paths_.direction_density[path] = -1;
  paths_.depth[path] = 1;  // a first flight would be split
  paths_.target[path] = path;
}

std::int64_t FurnacePaths::advance() {
  const auto events = [&] { return media_.counts().steps + media_.counts().look_ups; };
  const std::int64_t before = events();
  media_.find_stretches(paths_.ray, path_count);
  media_.find_collisions(paths_.ray, path_count, paths_.flight);
  for (std::uint32_t path = 0; path < path_count; ++path)
    if (paths_.flight.medium[path] == no_medium) paths_.ray.t_max[path] = 0;
  std::uint32_t shadow_count = 0;
  scatter_paths(job_, paths_, path_count, shadows_, shadow_count, nullptr);
  for (std::uint32_t path = 0; path < path_count; ++path)
    if (!(paths_.ray.t_max[path] > 0)) start(path);
  return events() - before;
}

void FurnacePaths::append_stretches(TrackTasks& to) {
  media_.find_stretches(paths_.ray, path_count);
  const TrackTasks& from = media_.stretches(0);
  for (std::uint32_t i = 0; i < from.count; ++i) to.append(from, i);
}

}  // namespace brume
