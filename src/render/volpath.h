// The integrator "volpath": path tracing through media and between surfaces, unbiased, in SIMD lanes.
//
// Many paths at a time go through the same stages, each a loop over columns: surfaces ahead (Embree), the first
// collision on the way (track.h), scattering by media (scatter.h) and by surfaces, shadow rays. A path that ends makes
// room for a new one, so that the loops stay full.
//
// Light is gathered by shadow rays to one light a scattering, chosen in proportion to power, and by paths that meet a
// light, with the balance heuristic of multiple importance sampling. What thin grids emit is gathered along
// flights (emission_placement.h), what other media emit where paths collide. A constant infinite light is left to paths
// alone: they find it with less noise than shadow rays do. Light of points in media is gathered along flights as well
// (light_placement.h), which are aimed at the points (aim.h).
#pragma once

#include <memory>
#include <vector>

#include "image/film.h"
#include "image/filter.h"
#include "render/camera_ray.h"
#include "render/emission_placement.h"
#include "render/light_table.h"
#include "render/paths.h"
#include "render/random_keys.h"
#include "render/render_counts.h"
#include "render/sample_points.h"
#include "render/scatter.h"
#include "render/surfaces.h"

namespace brume {

// One to each worker.
class VolpathIntegrator {
 public:
  VolpathIntegrator(const CompiledScene& scene, const Intersector& intersector, const MediaAlongRay& media,
                    const Filter& filter);

  // Adds samples [first, last) of these pixels of the film to it.
  void render_tile(const PixelBox& pixels, int first, int last, Film& film);

  std::optional<kernel::vec3> too_many_media() const {
    return media_.too_many_media() ? media_.too_many_media() : shadow_media_.too_many_media();
  }
  RenderCounts counts() const;

 private:
  struct Tile {
    PixelBox pixels;
    int first, last;
    std::uint32_t sample_count;
    std::uint32_t next = 0;  // sample to be started
  };

  float max_extinction(const CompiledMedium& medium) const;
  const LightTable& lights_at_collisions(const CompiledMedium& medium) const;
  void make_jobs();
  EmissionJob emission_job(std::int32_t medium) const;
  void close_ranks();
  void start_paths(Tile& tile);
  void start_path(std::uint32_t path, std::uint32_t fresh, std::uint32_t target);
  void find_surfaces();
  template <class Job, class Place>
  void place_along_flights(const std::vector<Job>& jobs, Place place);
  void end_flights();
  void see_environment(std::uint32_t path, float share);
  void meet_surface(std::uint32_t path);
  void reach_light(std::uint32_t path, const Spectrum& radiance, float light_density);
  void gather_at_surface(std::uint32_t path, const SurfaceHit& hit, const Spectrum& throughput);
  void answer_requests(const ScatterJob& job, std::uint32_t count);
  // From the event after `depth` others.
  void send_shadow_ray(std::uint32_t path, std::uint32_t depth, const Ray& ray, const Spectrum& value);
  void make_room_for_shadow_rays(std::uint32_t more);
  void gather_shadow_rays();
  void finish_paths();

  SurfaceSample scatter_at_surface(std::uint32_t path, const SurfaceHit& hit, RandomStream& random) const;
  Ray ray_of(std::uint32_t path) const;
  RandomStream random_of(std::uint32_t path) const;
  float rescale_mean(std::uint32_t path) const;

  const CompiledScene& scene_;
  const Intersector& intersector_;
  const Filter& filter_;
  const CameraDepth depth_;
  const Aim aim_;
  const int last_depth_;  // paths that have been scattered more often meet no light any more
  MediumTasks media_, shadow_media_;
  ColumnMemory path_memory_, memory_;
  PathColumns paths_;
  std::uint32_t places_ = 0;  // of paths_: the rows that are in use
  ShadowColumns shadows_;
  std::uint32_t shadow_count_ = 0;
  float* transmittance_[3] = {};
  std::vector<SurfaceHit> hits_;  // by path; shape below 0: nothing ahead
  SampleColumns fresh_;
  float* fresh_points_[sample_dimensions] = {};

  LightTable all_lights_, point_lights_, other_lights_;
  std::vector<ScatterJob> jobs_;            // by medium: at collisions
  std::vector<ScatterJob> placement_jobs_;  // by medium: along flights; none where no light is placed
  std::vector<EmissionJob> emission_jobs_;  // by medium: of those with grids that emit
  std::vector<LightRequest> requests_;

  std::vector<std::uint32_t> idle_;  // places of paths that are to be started
  std::vector<Spectrum> sums_;       // by sample of the tile
  std::vector<Foreground> foregrounds_;
  std::vector<float> filter_weights_;
  std::vector<Ray> shadow_rays_;
  std::vector<std::uint8_t> blocked_;
  RenderCounts counts_;  // but for those of tracking
};

}  // namespace brume
