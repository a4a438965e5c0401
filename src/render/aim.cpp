#include "render/aim.h"

#include <numbers>

namespace brume {

namespace {

// Of the homogeneous media at a point.
float mean_sigma_s_at(const CompiledScene& scene, const MediaAlongRay& media, Vector3 p) {
  float sigma_s = 0;
  const auto add = [&](std::int32_t medium, int count) {
    const CompiledMedium& m = scene.media[static_cast<std::size_t>(medium)];
    if (m.grid < 0) sigma_s += static_cast<float>(count * mean(m.sigma_s));
  };
  for (const CompiledVolume& volume : scene.volumes) {
    if (is_in(scene, volume, p)) add(volume.medium, 1);
  }
  for (const auto& [medium, count] :
       media.counts_at({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}))
    add(medium, count);
  return sigma_s;
}

}  // namespace

Aim make_aim(const CompiledScene& scene, const MediaAlongRay& media) {
  Aim aim;
  aim.elsewhere = scene.mean_radiance;
  for (const CompiledLight& light : scene.lights) {
    if (light.kind != CompiledLight::Kind::point) continue;
    const Vector3& p = light.position;
    // A flight at an angle alpha gathers sigma_s I / (4 pi) (pi - alpha) / sin alpha; the mean over the sphere.
    const float strength =
        mean_sigma_s_at(scene, media, p) * static_cast<float>(mean(light.value) * std::numbers::pi / 16);
    if (strength > 0)
      aim.lights.push_back({{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}, strength});
  }
  return aim;
}

}  // namespace brume
