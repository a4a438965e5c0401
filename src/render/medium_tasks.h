// The stretches of rays through media: where each ray of a batch crosses which medium, the first collisions along them,
// and the transmittance of all of them together.
#pragma once

#include <optional>
#include <vector>

#include "render/media_along_ray.h"
#include "render/ray_batch.h"
#include "render/track.h"

namespace brume {

// Where a ray's flight ended.
struct FlightColumns {
  float* t = nullptr;              // of the first collision; the ray's t_max where there is none
  std::int32_t* medium = nullptr;  // which it is with; no_medium where there is none
  float* weight[3] = {};           // how the flight changed the path's weight, per channel; only if is_chromatic()
  // Paths that have not been scattered yet may be split by a grid: `passed` is the share that met no medium, where the
  // flight has a collision with one; it is 0 for flights that were not split.
  const std::uint32_t* depth = nullptr;
  float* passed = nullptr;
};

// A CompiledRegion in floats.
struct RegionFrame {
  float matrix[3][4] = {};
  float lo[3] = {}, hi[3] = {};
  bool is_ball = false;
};

// A CompiledVolume in floats. `ordinal` numbers the stretches that a ray may have in volumes, so that each has random
// numbers of its own; one with a hole has two.
struct VolumeFrame {
  RegionFrame region, hole;
  bool has_hole = false;
  std::int32_t medium = no_medium;
  std::uint32_t ordinal = 0;
};

// One to each worker: it keeps its memory from call to call.
class MediumTasks {
 public:
  MediumTasks(const CompiledScene& scene, const Intersector& intersector, const MediaAlongRay& media);

  // Null for a homogeneous medium.
  const TrackedGrid* grid(std::int32_t medium) const {
    const auto& grid = grids_[static_cast<std::size_t>(medium)];
    return grid ? &*grid : nullptr;
  }

  // Whether the extinction of any medium differs between channels.
  bool is_chromatic() const { return is_chromatic_; }

  // Finds the stretches of the `count` rays, up to their t_max, in all media.
  void find_stretches(const RayColumns& rays, std::uint32_t count);

  // Those in one medium, until the next call of the functions below.
  const TrackTasks& stretches(std::int32_t medium) const { return tasks_[static_cast<std::size_t>(medium)]; }

  // After find_stretches of the same rays: the first collision of each of the `count` rays up to its t_max. Each
  // medium's is sampled on its own, and the nearest wins (docs/architecture.md, "Where media are").
  void find_collisions(const RayColumns& rays, std::uint32_t count, const FlightColumns& flights);

  // After find_stretches: transmittance[c][i] = an unbiased estimate of what crosses ray i up to its t_max in channel
  // c; where channels do not differ only [0] is written.
  void find_transmittance(std::uint32_t count, float* const (&transmittance)[3]);

  std::optional<kernel::vec3> too_many_media() const { return too_many_media_; }
  const TrackCounts& counts() const { return counts_; }

 private:
  void add_bounded_media(const RayColumns& rays, std::uint32_t count);
  void cut_to_nearest(TrackTasks& tasks, const FlightColumns& flights) const;
  void collide(std::size_t medium, TrackTasks& tasks);
  void split_first_flights(std::size_t medium, const FlightColumns& flights);
  void weigh_flights(std::size_t medium, const FlightColumns& flights);

  const CompiledScene& scene_;
  const Intersector& intersector_;
  const MediaAlongRay& media_;
  bool is_chromatic_ = false;
  std::vector<VolumeFrame> volumes_;
  std::uint32_t ordinal_count_ = 0;                // of stretches in volumes
  std::vector<std::optional<TrackedGrid>> grids_;  // by medium; none for homogeneous ones
  std::vector<TrackTasks> tasks_;                  // by medium
  TrackTasks again_;
  std::vector<std::uint8_t> stretch_counts_;  // by ray
  std::optional<kernel::vec3> too_many_media_;
  TrackCounts counts_;
  std::vector<Ray> rays_;
  std::vector<std::uint32_t> ray_of_span_;
  std::vector<MediumSpan> spans_;
  std::vector<Crossing> crossings_;
};

}  // namespace brume
