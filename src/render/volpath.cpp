#include "render/volpath.h"

#include <algorithm>
#include <cmath>

#include "render/camera_ray.h"
#include "render/light_placement.h"
#include "render/lights.h"
#include "render/phase.h"
#include "render/random_stream.h"

namespace brume {

using kernel::vec3;

namespace {

// Paths in flight: enough to fill the tracking stream many times over, few enough for the second cache.
constexpr std::uint32_t path_count = 1024;
constexpr std::uint32_t shadow_room = 2 * path_count;
constexpr float near_in_free_paths = 1.0f;
constexpr std::uint32_t idle = 0xffffffff;  // the target of a path that is none

// Whether a path can meet light by itself, without a shadow ray.
bool paths_meet_light(const CompiledScene& scene) {
  using Kind = CompiledLight::Kind;
  return std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const CompiledLight& l) { return l.kind != Kind::point && l.kind != Kind::distant; }) ||
         std::any_of(scene.media.begin(), scene.media.end(),
                     [](const CompiledMedium& m) { return !is_zero(m.emission); });
}

void set_lights(ScatterJob& job, const LightTable& table) {
  job.lights = table.delta_lights.data();
  job.light_count = static_cast<int>(table.delta_lights.size());
  job.picks_of_delta_lights = table.delta_lights.empty() ? 0 : table.delta_lights.back().pick[1];
  job.pick_end = table.lights.empty() ? 0 : 1;
}

}  // namespace

VolpathIntegrator::VolpathIntegrator(const CompiledScene& scene, const Intersector& intersector,
                                     const MediaAlongRay& media, const Filter& filter)
    : scene_(scene),
      intersector_(intersector),
      filter_(filter),
      depth_(scene.camera),
      aim_(make_aim(scene, media)),
      last_depth_(scene.integrator.max_depth - (paths_meet_light(scene) ? 0 : 1)),
      media_(scene, intersector, media),
      shadow_media_(scene, intersector, media),
      path_memory_(path_count),
      memory_(shadow_room),
      paths_(path_memory_),
      shadows_(memory_),
      hits_(path_count),
      requests_(path_count) {
  memory_.make_floats(transmittance_);
  fresh_ = {memory_.words(), memory_.words(), memory_.words()};
  for (float*& column : fresh_points_) column = memory_.floats();
  // The middle of the lens: what stays where nothing is drawn for it.
  for (int d = lens_point; d < sample_dimensions; ++d) std::fill_n(fresh_points_[d], path_count, 0.5f);
  std::fill_n(paths_.target, path_count, idle);
  make_jobs();
}

// Per world unit, at the most.
float VolpathIntegrator::max_extinction(const CompiledMedium& medium) const {
  const float density = medium.grid < 0 ? 1 : scene_.grids[static_cast<std::size_t>(medium.grid)].max_density;
  return std::max(max_value(medium.sigma_t) * density, 1e-18f);
}

// Those whose light is gathered where paths collide with the medium.
const LightTable& VolpathIntegrator::lights_at_collisions(const CompiledMedium& medium) const {
  return medium.grid < 0 ? other_lights_ : all_lights_;
}

void VolpathIntegrator::make_jobs() {
  using Kind = CompiledLight::Kind;
  const auto is_left_to_paths = [](const CompiledLight& l) { return l.kind == Kind::infinite; };
  const auto is_point = [](const CompiledLight& l) { return l.kind == Kind::point; };
  all_lights_ = make_light_table(scene_, [&](const CompiledLight& l) { return !is_left_to_paths(l); });
  point_lights_ = make_light_table(scene_, is_point);
  other_lights_ =
      make_light_table(scene_, [&](const CompiledLight& l) { return !is_left_to_paths(l) && !is_point(l); });
  for (std::size_t i = 0; i < scene_.media.size(); ++i) {
    const CompiledMedium& medium = scene_.media[i];
    const bool has_grid = medium.grid >= 0, places = !point_lights_.lights.empty();
    ScatterJob job;
    job.max_depth = scene_.integrator.max_depth;
    job.last_depth = last_depth_;
    job.aimed_lights = aim_.lights.data();
    job.aimed_light_count = static_cast<int>(aim_.lights.size());
    job.elsewhere = aim_.elsewhere;
    job.seed = scene_.seed;
    job.is_chromatic = media_.is_chromatic();
    job.medium = static_cast<std::int32_t>(i);
    job.phase = medium.phase;
    for (int c = 0; c < 3; ++c) {
      job.sigma_t[c] = medium.sigma_t[c];
      job.sigma_s[c] = medium.sigma_s[c];
      job.emission[c] = medium.emission[c];
    }
    std::copy(medium.phase_prepared.begin(), medium.phase_prepared.end(), job.phase_numbers);
    job.grid = media_.grid(job.medium);
    if (medium.emission_factor >= 0) {
      emission_jobs_.push_back(emission_job(job.medium));
      job.emission_field = emission_jobs_.back().field;
      job.emission_thin = emission_jobs_.back().thin;
    }
    if (places) {
      // Through a homogeneous medium all light of points is placed; in a grid, whose density is known only where it is
      // looked up, that near them.
      const float near = has_grid ? near_in_free_paths / max_extinction(medium) : 1e18f;
      job.near_squared = near * near;
      placement_jobs_.push_back(job);
      set_lights(placement_jobs_.back(), point_lights_);
    }
    set_lights(job, lights_at_collisions(medium));
    // Chances are other ones here than at surfaces; multiple importance sampling sees their ratio in the density.
    if (places && !has_grid && other_lights_.total > 0) job.density_scale = other_lights_.total / all_lights_.total;
    jobs_.push_back(job);
  }
}

EmissionJob VolpathIntegrator::emission_job(std::int32_t index) const {
  const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(index)];
  EmissionJob job;
  job.medium = index;
  job.grid = media_.grid(index);
  const auto& factor = scene_.emission_factors[static_cast<std::size_t>(medium.emission_factor)];
  job.cells = factor.cells.data();
  job.thin = factor.thin;
  job.field = emission_field(scene_, medium);
  std::copy_n(medium.emission.value.begin(), channel_count, job.emission);
  job.is_chromatic = media_.is_chromatic();
  return job;
}

// Calls place(job, stretches, first, last) for the stretches of the jobs' media, no more at a time than there is room
// for.
template <class Job, class Place>
void VolpathIntegrator::place_along_flights(const std::vector<Job>& jobs, Place place) {
  for (const Job& job : jobs) {
    const TrackTasks& stretches = media_.stretches(job.medium);
    for (std::uint32_t first = 0; first < stretches.count; first += path_count) {
      make_room_for_shadow_rays(path_count);
      place(job, stretches.columns, first, std::min(first + path_count, stretches.count));
    }
  }
}

void VolpathIntegrator::render_tile(const PixelBox& pixels, int first, int last, Film& film) {
  const auto samples = static_cast<std::uint32_t>(last - first);
  Tile tile{pixels, first, last, static_cast<std::uint32_t>(pixels.width() * pixels.height()) * samples, 0};
  sums_.assign(tile.sample_count, {});
  foregrounds_.assign(tile.sample_count, {});
  filter_weights_.resize(tile.sample_count);
  places_ = path_count;
  for (idle_.clear(); idle_.size() < places_;) idle_.push_back(static_cast<std::uint32_t>(idle_.size()));
  for (;;) {
    start_paths(tile);
    if (idle_.size() == places_) break;
    if (tile.next == tile.sample_count && idle_.size() > places_ / 2) close_ranks();
    find_surfaces();
    shadow_count_ = 0;
    media_.find_stretches(paths_.ray, places_);
    place_along_flights(placement_jobs_, [&](const ScatterJob& job, const TrackColumns& stretches, std::uint32_t begin,
                                             std::uint32_t end) {
      place_lights(job, paths_, stretches, begin, end, shadows_, shadow_count_);
    });
    place_along_flights(emission_jobs_, [&](const EmissionJob& job, const TrackColumns& stretches, std::uint32_t begin,
                                            std::uint32_t end) {
      place_emission(job, paths_, stretches, begin, end, shadows_, shadow_count_);
    });
    media_.find_collisions(paths_.ray, places_, paths_.flight);
    end_flights();
    for (const ScatterJob& job : jobs_) {
      make_room_for_shadow_rays(places_);
      answer_requests(job, scatter_paths(job, paths_, places_, shadows_, shadow_count_, requests_.data()));
    }
    gather_shadow_rays();
    finish_paths();
  }
  std::uint32_t at = 0;
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1; ++x)
      for (std::uint32_t s = 0; s < samples; ++s, ++at)
        film.add(x, y, sums_[at], foregrounds_[at], filter_weights_[at]);
}

RenderCounts VolpathIntegrator::counts() const {
  RenderCounts counts = counts_;
  for (const TrackCounts& tracking : {media_.counts(), shadow_media_.counts()}) {
    counts.cells += tracking.steps;
    counts.look_ups += tracking.look_ups;
    counts.majorant_violations += tracking.majorant_violations;
  }
  return counts;
}

// The last paths of a tile can be long ones, and the stages go through all places: moves the paths to the first ones.
void VolpathIntegrator::close_ranks() {
  std::uint32_t taken = 0;
  for (std::uint32_t i = 0; i < places_; ++i) {
    if (paths_.target[i] == idle) continue;
    if (i != taken) {
      path_memory_.copy_row(i, taken);
      paths_.ray.t_max[i] = 0;
      paths_.target[i] = idle;
    }
    ++taken;
  }
  places_ = taken;
  idle_.clear();
}

// Fills idle paths with new samples, once there are many of them or nothing else is left to do.
void VolpathIntegrator::start_paths(Tile& tile) {
  const auto fresh = std::min(static_cast<std::uint32_t>(idle_.size()), tile.sample_count - tile.next);
  if (fresh == 0 || (idle_.size() < places_ / 8 && idle_.size() < places_)) return;
  const auto width = static_cast<std::uint32_t>(tile.pixels.width());
  const auto samples = static_cast<std::uint32_t>(tile.last - tile.first);
  for (std::uint32_t i = 0; i < fresh; ++i) {
    const std::uint32_t target = tile.next + i, pixel = target / samples;
    fresh_.x[i] = static_cast<std::uint32_t>(scene_.crop.x0 + tile.pixels.x0) + pixel % width;
    fresh_.y[i] = static_cast<std::uint32_t>(scene_.crop.y0 + tile.pixels.y0) + pixel / width;
    fresh_.sample[i] = static_cast<std::uint32_t>(tile.first) + target % samples;
  }
  find_sample_points(scene_, fresh_, fresh, scene_.camera.has_lens() ? sample_dimensions : lens_point, fresh_points_);
  for (std::uint32_t i = 0; i < fresh; ++i) {
    start_path(idle_.back(), i, tile.next + i);
    idle_.pop_back();
  }
  tile.next += fresh;
}

void VolpathIntegrator::start_path(std::uint32_t path, std::uint32_t fresh, std::uint32_t target) {
  const std::uint32_t x = fresh_.x[fresh], y = fresh_.y[fresh], sample = fresh_.sample[fresh];
  const FilterSample place = filter_.sample(fresh_points_[0][fresh], fresh_points_[1][fresh]);
  filter_weights_[target] = place.weight;
  const Ray ray =
      camera_ray(scene_.camera, x + 0.5 + static_cast<double>(place.x), y + 0.5 + static_cast<double>(place.y),
                 fresh_points_[lens_point][fresh], fresh_points_[lens_point + 1][fresh]);
  set(paths_.ray.origin, path, ray.origin);
  set(paths_.ray.direction, path, ray.direction);
  paths_.ray.t_max[path] = far_away;
  paths_.ray.key[path] = random_keys::event_key(scene_.seed, 0);
  paths_.ray.pixel[path] = y * static_cast<std::uint32_t>(scene_.width) + x;
  paths_.ray.sample[path] = sample;
  paths_.ray.hero[path] =
      media_.is_chromatic() ? (kernel::hash_word(paths_.ray.pixel[path] ^ kernel::hash_word(scene_.seed)) + sample) % 3
                            : 0;
  for (int d = 0; d < point_dimensions; ++d) paths_.points[d][path] = fresh_points_[d + 2][fresh];
  paths_.ray.distance_u[path] = paths_.points[0][path];
  set(paths_.throughput, path, constant_spectrum(1));
  set(paths_.rescale, path, constant_spectrum(1));
  set(paths_.radiance, path, Spectrum{});
  set(paths_.gathered, path, Spectrum{});
  paths_.direction_density[path] = -1;
  paths_.depth[path] = 0;
  paths_.target[path] = target;
}

RandomStream VolpathIntegrator::random_of(std::uint32_t path) const {
  const auto width = static_cast<std::uint32_t>(scene_.width);
  return {scene_, static_cast<int>(paths_.ray.pixel[path] % width), static_cast<int>(paths_.ray.pixel[path] / width),
          static_cast<int>(paths_.ray.sample[path])};
}

Ray VolpathIntegrator::ray_of(std::uint32_t path) const {
  return {at(paths_.ray.origin, path), at(paths_.ray.direction, path), paths_.ray.t_max[path]};
}

// Flights end at the first surface ahead.
void VolpathIntegrator::find_surfaces() {
  if (!intersector_.has_surfaces()) return;
  for (std::uint32_t i = 0; i < places_; ++i) {
    hits_[i].shape = -1;
    if (!(paths_.ray.t_max[i] > 0)) continue;
    if (intersector_.nearest_surface(ray_of(i), hits_[i]))
      paths_.ray.t_max[i] = hits_[i].t;
    else
      hits_[i].shape = -1;
  }
}

// What becomes of paths that met no medium.
void VolpathIntegrator::end_flights() {
  const bool has_surfaces = intersector_.has_surfaces();
  std::uint32_t rays = 0, collisions = 0, surface_hits = 0;
  for (std::uint32_t i = 0; i < places_; ++i) {
    if (!(paths_.ray.t_max[i] > 0)) continue;
    ++rays;
    if (media_.is_chromatic())
      for (int c = 0; c < 3; ++c) {
        paths_.throughput[c][i] *= paths_.flight.weight[c][i];
        paths_.rescale[c][i] *= paths_.flight.weight[c][i];
      }
    const bool has_surface = has_surfaces && hits_[i].shape >= 0;
    const float passed = paths_.flight.passed[i];
    float share = 1;  // of the path, that goes on
    if (passed > 0 && has_surface) {
      // Two paths would have to go on; one of them does.
      if (kernel::random_uniform(paths_.ray.key[i], paths_.ray.pixel[i], paths_.ray.sample[i],
                                 random_keys::surface_is_reached) < passed)
        paths_.flight.medium[i] = no_medium;
    } else if (passed > 0) {
      see_environment(i, passed);
      share = 1 - passed;
      for (float* throughput : paths_.throughput) throughput[i] *= share;
    }
    const bool collides = paths_.flight.medium[i] != no_medium;
    if (paths_.depth[i] == 0 && (collides || has_surface))
      foregrounds_[paths_.target[i]].add(
          share, depth_.along(at(paths_.ray.direction, i)) * (collides ? paths_.flight.t[i] : hits_[i].t));
    collisions += collides;
    if (collides) continue;
    if (has_surface) {
      ++surface_hits;
      meet_surface(i);
    } else {
      see_environment(i, 1);
      paths_.ray.t_max[i] = 0;
    }
  }
  counts_.rays += rays;
  counts_.collisions += collisions;
  counts_.surface_hits += surface_hits;
}

// What contributions are divided by: the balance heuristic over heroes.
float VolpathIntegrator::rescale_mean(std::uint32_t path) const {
  if (!media_.is_chromatic()) return 1;
  return (paths_.rescale[0][path] + paths_.rescale[1][path] + paths_.rescale[2][path]) / 3;
}

// The path sees radiance that shadow rays would have found with `light_density`, per steradian.
void VolpathIntegrator::reach_light(std::uint32_t path, const Spectrum& radiance, float light_density) {
  const float density = paths_.direction_density[path];
  const float share = density < 0 ? 1 : density / (density + light_density);
  add(paths_.radiance, path, (share / rescale_mean(path)) * spectrum_at(paths_.throughput, path) * radiance);
}

// The share of the path that meets nothing any more sees the infinite lights.
void VolpathIntegrator::see_environment(std::uint32_t path, float share) {
  const Ray ray = ray_of(path);
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
    const CompiledLight& light = scene_.lights[i];
    const Spectrum radiance = environment_radiance(scene_, light, ray);
    if (is_zero(radiance)) continue;
    const float density =
        all_lights_.chance[i] > 0 ? all_lights_.chance[i] * light_pdf(scene_, light, ray, nullptr, {}) : 0;
    reach_light(path, share * radiance, density);
  }
}

void VolpathIntegrator::send_shadow_ray(std::uint32_t path, std::uint32_t depth, const Ray& ray,
                                        const Spectrum& value) {
  if (is_zero(value)) return;
  make_room_for_shadow_rays(1);
  const std::uint32_t i = shadow_count_++;
  shadows_.lead.t_max[i] = 0;
  set(shadows_.ray.origin, i, ray.origin);
  set(shadows_.ray.direction, i, ray.direction);
  shadows_.ray.t_max[i] = ray.t_max;
  shadows_.ray.key[i] = kernel::hash_word(random_keys::event_key(scene_.seed, depth) ^ random_keys::to_light);
  shadows_.ray.pixel[i] = paths_.ray.pixel[path];
  shadows_.ray.sample[i] = paths_.ray.sample[path];
  shadows_.ray.hero[i] = paths_.ray.hero[path];
  shadows_.ray.distance_u[i] = kernel::random_uniform(shadows_.ray.key[i], shadows_.ray.pixel[i],
                                                      shadows_.ray.sample[i], random_keys::shadow_distance);
  shadows_.path[i] = path;
  set(shadows_.value, i, value);
}

// Light at collisions from lights that are neither points nor directions.
void VolpathIntegrator::answer_requests(const ScatterJob& job, std::uint32_t count) {
  const CompiledMedium& medium = scene_.media[static_cast<std::size_t>(job.medium)];
  const LightTable& table = lights_at_collisions(medium);
  for (std::uint32_t k = 0; k < count; ++k) {
    const LightRequest& request = requests_[k];
    const int picked = table.pick(request.u);
    if (picked < 0) continue;
    const auto i = static_cast<std::size_t>(picked);
    const std::uint32_t path = request.path, depth = paths_.depth[path] - 1;
    RandomStream random = random_of(path);
    random.skip_to(static_cast<std::uint32_t>(placement_point + 2) / 2, depth == 0 ? 1 : 0,
                   random_keys::light_choice(depth));
    const vec3 p(request.position[0], request.position[1], request.position[2]);
    const vec3 direction(request.direction[0], request.direction[1], request.direction[2]);
    const LightSample s = sample_light(scene_, scene_.lights[i], p, nullptr, random);
    const float phase = phase_eval(medium, std::clamp(dot(s.ray.direction, direction), -1.0f, 1.0f));
    const float light_density = table.chance[i] * s.pdf;
    const auto phase_towards = [&](vec3 to) { return phase_eval(medium, std::clamp(dot(to, direction), -1.0f, 1.0f)); };
    const float density = AimFrom(aim_, p, phase_towards).density(s.ray.direction, phase);
    const float share = s.pdf > 0 ? light_density / (light_density + density) : 1;
    const Spectrum worth{{request.value[0], request.value[1], request.value[2]}};
    send_shadow_ray(path, depth, s.ray, (share * phase / table.chance[i]) * worth * s.value);
  }
}

// Sends the shadow rays on their way once there is no room for `more`.
void VolpathIntegrator::make_room_for_shadow_rays(std::uint32_t more) {
  if (shadow_count_ + more > shadow_room) gather_shadow_rays();
}

void VolpathIntegrator::gather_shadow_rays() {
  if (shadow_count_ == 0) return;
  counts_.shadow_rays += shadow_count_;
  if (intersector_.has_surfaces()) {
    shadow_rays_.clear();
    for (std::uint32_t i = 0; i < shadow_count_; ++i)
      shadow_rays_.push_back({at(shadows_.ray.origin, i), at(shadows_.ray.direction, i), shadows_.ray.t_max[i]});
    blocked_.resize(shadow_count_);
    intersector_.occluded(shadow_rays_, blocked_);
    for (std::uint32_t i = 0; i < shadow_count_; ++i) {
      if (!blocked_[i] || shadows_.ray.t_max[i] == 0) continue;
      shadows_.ray.t_max[i] = shadows_.lead.t_max[i] = 0;
      set(shadows_.value, i, Spectrum{});
    }
  }
  const auto pass = [&](const RayColumns& rays) {
    shadow_media_.find_stretches(rays, shadow_count_);
    shadow_media_.find_transmittance(shadow_count_, transmittance_);
    for (std::uint32_t i = 0; i < shadow_count_; ++i)
      for (int c = 0; c < 3; ++c) shadows_.value[c][i] *= transmittance_[media_.is_chromatic() ? c : 0][i];
  };
  pass(shadows_.ray);
  if (!placement_jobs_.empty() || !emission_jobs_.empty()) pass(shadows_.lead);
  for (std::uint32_t i = 0; i < shadow_count_; ++i)
    for (int c = 0; c < 3; ++c) paths_.gathered[c][shadows_.path[i]] += shadows_.value[c][i];
  shadow_count_ = 0;
}

// Hands in the samples whose paths have ended.
void VolpathIntegrator::finish_paths() {
  for (std::uint32_t i = 0; i < places_; ++i) {
    if (paths_.ray.t_max[i] > 0 || paths_.target[i] == idle) continue;
    sums_[paths_.target[i]] = spectrum_at(paths_.radiance, i) + spectrum_at(paths_.gathered, i);
    paths_.target[i] = idle;
    idle_.push_back(i);
  }
}

}  // namespace brume
