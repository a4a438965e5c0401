// What media leave of the light of point and distant lights, computed before rendering at the points of a lattice over
// each grid of density and looked up between them: "volumeshadows" "cached" of Integrator "classic". Shadow rays then
// ask for surfaces only.
//
// A lattice has one point for two voxels along each axis, 128 at the most, and fewer where all lattices together would
// take more than 256 MB. Between points the transmittance is interpolated linearly: biased by about
// (spacing d/ds)^2 T / 8, so shadows within a medium that are finer than the spacing are blurred.
// Source: J. Kajiya and B. Von Herzen, "Ray Tracing Volume Densities", SIGGRAPH 1984, section 3.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "render/visibility.h"

namespace brume {

class ShadowCache {
 public:
  // Fills the lattices on `threads` threads; the values do not depend on how many. Calls keep_going now and then, on
  // the calling thread, and gives up once it returns false.
  ShadowCache(const CompiledScene& scene, const Intersector& intersector, const MediaAlongRay& media, int threads,
              const std::function<bool()>& keep_going);

  // Whether there is a lattice for the light (an index in the scene's lights) and the medium.
  bool covers(std::size_t light, int medium) const { return lattice_of(light, medium) >= 0; }

  // The transmittance from p, which is in the medium, to the light, by channel, where `covers` says so.
  Spectrum transmittance(std::size_t light, int medium, kernel::vec3 p_world) const;

  // A place where more than max_active_media media overlap, once a ray has met one.
  std::optional<kernel::vec3> too_many_media() const { return too_many_media_; }

 private:
  // Point (i, j, k) lies at lo + (i, j, k) * spacing in the grid's index coordinates; x fastest.
  struct Lattice {
    std::size_t light;
    int medium;
    std::array<int, 3> points;
    std::array<double, 3> lo, spacing;
    std::vector<Spectrum> values;
  };

  int lattice_of(std::size_t light, int medium) const {
    return lattice_of_[light * media_.size() + static_cast<std::size_t>(medium)];
  }
  void add_lattice(std::size_t light, int medium, int most_points);
  void fill_layer(Lattice& lattice, int layer, Visibility& visibility) const;

  const CompiledScene& scene_;
  const std::vector<CompiledMedium>& media_;
  std::vector<Lattice> lattices_;
  std::optional<kernel::vec3> too_many_media_;
  std::vector<int> lattice_of_;  // by light and medium; -1: none
};

}  // namespace brume
