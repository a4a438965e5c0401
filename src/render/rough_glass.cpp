#include "render/rough_glass.h"

#include "base/fresnel.h"
#include "base/microfacet.h"

namespace brume {

using kernel::vec3;

namespace {

// The index beyond the surface over that on the ray's side.
float index_ahead(const CompiledMaterial& m, const SurfaceHit& hit) {
  return hit.from_inside ? 1 / m.refractive_index : m.refractive_index;
}

}  // namespace

// With the facet's normal h, that of mirrors v + l or of Snell's law v + eta l: facets are drawn with the density
// D v.h / (v.n (1 + Lambda_v)), and directions with that times dh/dl, which is 1 / (4 v.h) for mirrors and
// eta^2 |l.h| / (v.h + eta l.h)^2 for refraction (Walter et al., equations 14 and 17). f |cos| is that times
// (1 + Lambda_v) / (1 + Lambda_v + Lambda_l), the share of facets seen from v that are seen from l too.
Spectrum eval_rough_glass(const CompiledMaterial& m, const SurfaceHit& hit, vec3 direction, vec3 to_light, float& pdf) {
  pdf = 0;
  const vec3 n = hit.shading_normal, to_viewer = -direction;
  const float viewer = dot(n, to_viewer), light = dot(n, to_light);
  const bool reflects = light > 0;
  if (!(viewer > 0) || light == 0 || reflects != (dot(hit.normal, to_light) > 0)) return {};
  const float eta = index_ahead(m, hit);
  vec3 h = reflects ? to_viewer + to_light : to_viewer + eta * to_light;
  const float squared = dot(h, h);
  if (!(squared > 0)) return {};
  h = ((dot(h, n) < 0 ? -1 : 1) / std::sqrt(squared)) * h;
  const float viewer_h = dot(to_viewer, h), light_h = dot(to_light, h);
  if (!(viewer_h > 0) || (light_h > 0) != reflects) return {};

  float refracted_cosine = 0;
  const float reflectance = fresnel_dielectric(viewer_h, eta, refracted_cosine);
  const float hidden_from_viewer = hidden_facets(viewer, m.alpha);
  const float facets = facet_density(dot(n, h), m.alpha) * viewer_h / (viewer * (1 + hidden_from_viewer));
  const float bend = viewer_h + eta * light_h;
  pdf = facets *
        (reflects ? reflectance / (4 * viewer_h) : (1 - reflectance) * eta * eta * std::abs(light_h) / (bend * bend));
  const float seen = (1 + hidden_from_viewer) / (1 + hidden_from_viewer + hidden_facets(std::abs(light), m.alpha));
  return constant_spectrum(pdf * seen * (reflects ? 1 : 1 / (eta * eta)));
}

SurfaceSample sample_rough_glass(const CompiledMaterial& m, const SurfaceHit& hit, vec3 direction,
                                 RandomStream& random) {
  const auto [u, turns] = random.next_pair();
  const vec3 h = draw_facet(hit.shading_normal, -direction, m.alpha, u, turns);
  const float cosine = std::clamp(-dot(h, direction), 0.0f, 1.0f), eta = index_ahead(m, hit);
  float refracted_cosine = 0;
  const float reflectance = fresnel_dielectric(cosine, eta, refracted_cosine);
  SurfaceSample s;
  s.transmitted = !(random.next() < reflectance);
  s.direction =
      s.transmitted ? normalize((1 / eta) * direction + (cosine / eta - refracted_cosine) * h) : reflect(direction, h);
  if ((dot(s.direction, hit.shading_normal) < 0) != s.transmitted) return s;
  const Spectrum f = eval_rough_glass(m, hit, direction, s.direction, s.pdf);
  if (s.pdf > 0) s.weight = (1 / s.pdf) * f;
  return s;
}

}  // namespace brume
