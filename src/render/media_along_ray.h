// Which media a ray crosses, and where: the rule of sets (docs/architecture.md, "Where media are").
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "compiled/compiled_scene.h"
#include "intersect/intersector.h"

namespace brume {

// A stretch [t_begin, t_end] of a ray through one medium. Within a grid, clipped to the grid's bounds.
struct MediumSpan {
  int ray = 0;
  int medium = no_medium;
  int count = 1;  // how many times over the medium is there
  float t_begin = 0, t_end = 0;
  // For a grid (or a box): the ray restarted at t_begin, p_index = entry_index + (t - t_begin) direction_index.
  kernel::vec3 entry_index{0, 0, 0}, direction_index{0, 0, 0};
};

// Whether a volume's medium is there.
inline bool is_in(const CompiledScene& scene, const CompiledVolume& volume, Vector3 p) {
  return volume.region.contains(p) &&
         !(volume.hole >= 0 && scene.holes[static_cast<std::size_t>(volume.hole)].contains(p));
}

class MediaAlongRay {
 public:
  // Finds, once, which media surround all shapes: the one that the camera records, where the boundaries around the
  // camera do not account for it; and what lies outside of shapes that the camera is in, where nothing else puts it
  // there.
  MediaAlongRay(const CompiledScene& scene, const Intersector& intersector);

  // The media along each ray from its origin to its t_max, in no particular order within a ray. At most
  // max_active_media at a time are followed; where there are more, returns such a place.
  //
  // How often each medium is there at the ray's origin follows from the crossings ahead: far away only the surrounding
  // media are left. So nothing is carried from ray to ray that rounding at a boundary could get wrong.
  std::optional<kernel::vec3> find(std::span<const Ray> rays, std::vector<MediumSpan>& spans,
                                   std::vector<Crossing>& scratch) const;

  // The same for media with boundaries of shapes and the one around all; the scene's volumes are left out.
  std::optional<kernel::vec3> find_bounded(std::span<const Ray> rays, std::vector<MediumSpan>& spans,
                                           std::vector<Crossing>& scratch) const;

  // Whether any medium surrounds all shapes.
  bool has_surrounding_medium() const { return !surrounding_.empty(); }

  // The media at a point and how many times over each is there, the scene's volumes apart, in order; counted along a
  // ray in the direction, which matters only where boundaries are not closed. For the camera and for checks.
  std::vector<std::pair<int, int>> counts_at(kernel::vec3 p, kernel::vec3 direction = {0.577f, 0.591f, 0.563f}) const;

 private:
  std::optional<kernel::vec3> follow(const Ray& ray, int ray_index, std::span<const Crossing> crossings,
                                     std::vector<MediumSpan>& spans) const;
  void add_span(const Ray& ray, MediumSpan span, std::vector<MediumSpan>& spans) const;

  const CompiledScene& scene_;
  const Intersector& intersector_;
  std::vector<std::pair<int, int>> surrounding_;  // media and how many times over each is there
};

}  // namespace brume
