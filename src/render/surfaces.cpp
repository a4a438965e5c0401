#include "render/surfaces.h"

#include <numbers>

#include "render/fresnel.h"

namespace brume {

using kernel::vec3;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

// How likely a path is to go on in each way.
struct Chances {
  float reflected = 0, refracted = 0, diffuse = 0, highlight = 0;
};

float mean_of(const Spectrum& s) { return sum(s) / channel_count; }

float coat_transmittance(const CompiledMaterial& m, float cosine) {
  float refracted_cosine = 0;
  return 1 - fresnel_dielectric(cosine, m.refractive_index, refracted_cosine);
}

// What the base of a coated surface sends back of diffuse light under the coat: it goes to and fro between the two.
Spectrum base_reflectance(const CompiledMaterial& m) {
  Spectrum s;
  for (int c = 0; c < channel_count; ++c) s[c] = m.diffuse[c] / (1 - m.diffuse[c] * m.internal_reflectance);
  return s;
}

Spectrum highlight_colour(const CompiledMaterial& m) {
  return m.specular * (constant_spectrum(1 - m.metallic) + m.metallic * m.diffuse);
}

// In proportion to what each way sends on of light that comes along `direction`.
Chances chances_of(const CompiledMaterial& m, const SmoothLobes& lobes, vec3 n, vec3 direction) {
  Chances c{mean_of(lobes.reflected), mean_of(lobes.refracted), mean_of(m.diffuse), mean_of(highlight_colour(m))};
  if (m.kind == CompiledMaterial::Kind::coated_diffuse)
    c.diffuse = coat_transmittance(m, clamped_cosine(n, -direction)) * (1 - m.internal_reflectance) *
                mean_of(base_reflectance(m));
  const float total = c.reflected + c.refracted + c.diffuse + c.highlight;
  if (!(total > 0)) return {1, 0, 0, 0};
  return {c.reflected / total, c.refracted / total, c.diffuse / total, c.highlight / total};
}

// The cosine between the normal and the direction half way between two others.
float half_cosine(vec3 n, vec3 a, vec3 b) {
  const vec3 sum = a + b;
  const float squared = dot(sum, sum);
  return squared > 0 ? clamped_cosine(n, sum) / std::sqrt(squared) : 0;
}

// Without the mirror and the glass.
Spectrum bsdf(const CompiledMaterial& m, vec3 n, vec3 to_light, vec3 to_viewer) {
  if (m.kind == CompiledMaterial::Kind::coated_diffuse)
    return (coat_transmittance(m, clamped_cosine(n, to_light)) * coat_transmittance(m, clamped_cosine(n, to_viewer)) /
            (pi * m.refractive_index * m.refractive_index)) *
           base_reflectance(m);
  const Spectrum diffuse = (1 / pi) * m.diffuse;
  if (is_zero(m.specular)) return diffuse;
  const float cosine = half_cosine(n, to_light, to_viewer);
  if (cosine == 0) return diffuse;
  return diffuse + m.highlight_scale * kernel::pow_positive(cosine, m.shininess) * highlight_colour(m);
}

// The density of directions that are drawn: by the cosine, or as the mirror's by a normal h that is drawn with a
// density of (s + 1) / (2 pi) (n.h)^s.
float bsdf_pdf(const CompiledMaterial& m, const Chances& chances, vec3 n, vec3 to_light, vec3 to_viewer) {
  float pdf = chances.diffuse * clamped_cosine(n, to_light) / pi;
  if (chances.highlight == 0) return pdf;
  const float cosine = half_cosine(n, to_light, to_viewer);
  if (cosine == 0) return pdf;
  const float density = (m.shininess + 1) / (2 * pi) * kernel::pow_positive(cosine, m.shininess);
  // The half way direction makes equal angles with both, whose cosine is half the length of their sum.
  return pdf + chances.highlight * density / (2 * length(to_light + to_viewer));
}

vec3 draw_direction(const CompiledMaterial& m, vec3 n, vec3 direction, bool highlight, RandomStream& random) {
  const auto [u, turns] = random.next_pair();
  if (!highlight) return kernel::direction_at_cosine(n, std::sqrt(1 - u), turns);
  const float cosine = std::pow(1 - u, 1 / (m.shininess + 1));
  return reflect(direction, kernel::direction_at_cosine(n, cosine, turns));
}

SurfaceSample sample_material(const CompiledMaterial& material, const SurfaceHit& hit, vec3 direction,
                              RandomStream& random) {
  const vec3 n = hit.shading_normal;
  const SmoothLobes lobes = smooth_lobes(material, hit, direction);
  const Chances chances = chances_of(material, lobes, n, direction);
  float pick = chances.diffuse == 1 ? 0 : random.next();
  if (pick < chances.reflected) return {reflect(direction, n), (1 / chances.reflected) * lobes.reflected, 0, false};
  pick -= chances.reflected;
  if (pick < chances.refracted)
    return {lobes.refracted_direction, (lobes.squeeze / chances.refracted) * lobes.refracted, 0, true};
  pick -= chances.refracted;
  const vec3 to_light = draw_direction(material, n, direction, pick >= chances.diffuse, random);
  const float cosine = dot(to_light, n), pdf = bsdf_pdf(material, chances, n, to_light, -direction);
  if (!(cosine > 0 && pdf > 0)) return {to_light, {}, 0, false};
  return {to_light, (cosine / pdf) * bsdf(material, n, to_light, -direction), pdf, false};
}

}  // namespace

SmoothLobes smooth_lobes(const CompiledMaterial& m, const SurfaceHit& hit, vec3 direction) {
  const vec3 n = hit.shading_normal;
  const float cosine = std::clamp(-dot(n, direction), 0.0f, 1.0f);
  SmoothLobes lobes;
  switch (m.kind) {
    case CompiledMaterial::Kind::conductor:
      for (int c = 0; c < channel_count; ++c) lobes.reflected[c] = fresnel_conductor(cosine, m.eta[c], m.k[c]);
      return lobes;
    case CompiledMaterial::Kind::coated_diffuse:
      lobes.reflected = constant_spectrum(1 - coat_transmittance(m, cosine));
      return lobes;
    case CompiledMaterial::Kind::blinn_phong:
      break;
  }
  lobes.reflected = m.mirror;
  if (is_zero(m.refraction)) return lobes;
  const float eta = hit.from_inside ? 1 / m.refractive_index : m.refractive_index;
  float refracted_cosine = 0;
  const float reflectance = fresnel_dielectric(cosine, eta, refracted_cosine);
  lobes.reflected = lobes.reflected + reflectance * m.refraction;
  lobes.refracted = (1 - reflectance) * m.refraction;
  lobes.refracted_direction = normalize((1 / eta) * direction + (cosine / eta - refracted_cosine) * n);
  lobes.squeeze = 1 / (eta * eta);
  return lobes;
}

SurfaceSample sample_surface(const CompiledScene& scene, const SurfaceHit& hit, vec3 direction, RandomStream& random) {
  SurfaceSample s = sample_material(material_at(scene, hit), hit, direction, random);
  // A shading normal can send a path through a surface that it should leave, or back from one that it should cross.
  if ((dot(s.direction, hit.normal) < 0) != s.transmitted) s.weight = {};
  return s;
}

Spectrum eval_surface(const CompiledScene& scene, const SurfaceHit& hit, vec3 direction, vec3 to_light) {
  const CompiledMaterial& material = material_at(scene, hit);
  const float cosine = dot(to_light, hit.shading_normal);
  if (!scatters_widely(material) || cosine <= 0 || dot(to_light, hit.normal) <= 0) return {};
  return cosine * bsdf(material, hit.shading_normal, to_light, -direction);
}

Spectrum eval_surface(const CompiledScene& scene, const SurfaceHit& hit, vec3 direction, vec3 to_light, float& pdf) {
  const Spectrum value = eval_surface(scene, hit, direction, to_light);
  pdf = 0;
  if (is_zero(value)) return {};
  const CompiledMaterial& material = material_at(scene, hit);
  const vec3 n = hit.shading_normal;
  const Chances chances = chances_of(material, smooth_lobes(material, hit, direction), n, direction);
  pdf = bsdf_pdf(material, chances, n, to_light, -direction);
  return value;
}

bool scatters_widely(const CompiledMaterial& material) {
  return !is_zero(material.diffuse) || !is_zero(material.specular);
}

Spectrum straight_transmittance(const CompiledMaterial& material, float cosine) {
  if (is_zero(material.refraction)) return {};
  float refracted_cosine = 0;
  return (1 - fresnel_dielectric(cosine, material.refractive_index, refracted_cosine)) * material.refraction;
}

}  // namespace brume
