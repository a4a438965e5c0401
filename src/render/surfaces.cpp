#include "render/surfaces.h"

#include "render/fresnel.h"

namespace brume {

using kernel::vec3;

namespace {

// The chance that a path takes the mirror of a Blinn-Phong material.
float mirror_chance(const CompiledMaterial& m) {
  const float mirror = sum(m.mirror), matt = sum(m.diffuse + m.specular);
  return mirror == 0 ? 0 : mirror / (mirror + matt);
}

// The mirror, or a direction by the cosine.
SurfaceSample sample_blinn_phong(const CompiledMaterial& material, vec3 n, vec3 direction, RandomStream& random) {
  const float chance = mirror_chance(material);
  if (chance > 0 && random.next() < chance) return {reflect(direction, n), (1 / chance) * material.mirror, 0, false};
  const auto [u, turns] = random.next_pair();
  const float cosine = std::sqrt(1 - u);
  const vec3 chosen = kernel::direction_at_cosine(n, cosine, turns);
  const Spectrum f = blinn_phong(material, n, chosen, -direction);
  return {chosen, (std::numbers::pi_v<float> / (1 - chance)) * f, (1 - chance) * cosine * std::numbers::inv_pi_v<float>,
          false};
}

SurfaceSample sample_conductor(const CompiledMaterial& material, vec3 n, vec3 direction) {
  const float cosine = std::min(1.0f, std::abs(dot(n, direction)));
  SurfaceSample s{reflect(direction, n), {}, 0, false};
  for (int c = 0; c < channel_count; ++c) s.weight[c] = fresnel_conductor(cosine, material.eta[c], material.k[c]);
  return s;
}

// Reflection with the chance that Fresnel's equations give, else refraction: the weights are 1 but for the squeeze of
// solid angle.
SurfaceSample sample_dielectric(const CompiledMaterial& material, const SurfaceHit& hit, vec3 direction,
                                RandomStream& random) {
  const vec3 n = hit.shading_normal;
  const float eta = hit.from_inside ? 1 / material.refractive_index : material.refractive_index;
  const float cosine = std::clamp(-dot(n, direction), 0.0f, 1.0f);
  float refracted_cosine = 0;
  if (random.next() < fresnel_dielectric(cosine, eta, refracted_cosine))
    return {reflect(direction, n), constant_spectrum(1), 0, false};
  const vec3 refracted = (1 / eta) * direction + (cosine / eta - refracted_cosine) * n;
  return {normalize(refracted), constant_spectrum(1 / (eta * eta)), 0, true};
}

SurfaceSample sample_material(const CompiledMaterial& material, const SurfaceHit& hit, vec3 direction,
                              RandomStream& random) {
  switch (material.kind) {
    case CompiledMaterial::Kind::blinn_phong:
      break;
    case CompiledMaterial::Kind::conductor:
      return sample_conductor(material, hit.shading_normal, direction);
    case CompiledMaterial::Kind::dielectric:
      return sample_dielectric(material, hit, direction, random);
  }
  return sample_blinn_phong(material, hit.shading_normal, direction, random);
}

}  // namespace

SurfaceSample sample_surface(const CompiledScene& scene, const SurfaceHit& hit, vec3 direction, RandomStream& random) {
  SurfaceSample s = sample_material(material_at(scene, hit), hit, direction, random);
  // A shading normal can send a path through a surface that it should leave, or back from one that it should cross.
  if ((dot(s.direction, hit.normal) < 0) != s.transmitted) s.weight = {};
  return s;
}

Spectrum eval_surface(const CompiledScene& scene, const SurfaceHit& hit, vec3 direction, vec3 to_light, float& pdf) {
  const CompiledMaterial material = material_at(scene, hit);
  const float cosine = dot(to_light, hit.shading_normal);
  pdf = 0;
  if (!scatters_widely(material) || cosine <= 0 || dot(to_light, hit.normal) <= 0) return {};
  pdf = (1 - mirror_chance(material)) * cosine * std::numbers::inv_pi_v<float>;
  return cosine * blinn_phong(material, hit.shading_normal, to_light, -direction);
}

bool scatters_widely(const CompiledMaterial& material) {
  return !is_zero(material.diffuse) || !is_zero(material.specular);
}

}  // namespace brume
