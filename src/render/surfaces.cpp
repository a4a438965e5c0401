#include "render/surfaces.h"

#include <numbers>

#include "base/fresnel.h"
#include "base/microfacet.h"
#include "compiled/coat.h"
#include "render/rough_glass.h"

namespace brume {

using kernel::vec3;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

// How likely a path is to go on in each way.
struct Chances {
  float reflected = 0, refracted = 0, diffuse = 0, highlight = 0;
};

float mean_of(const Spectrum& s) { return sum(s) / channel_count; }

// What the base of a coated surface sends back of diffuse light under the coat: it goes to and fro between the two.
Spectrum base_reflectance(const CompiledMaterial& m) {
  Spectrum s;
  for (int c = 0; c < channel_count; ++c) s[c] = m.diffuse[c] / (1 - m.diffuse[c] * m.internal_reflectance);
  return s;
}

Spectrum highlight_colour(const CompiledMaterial& m) {
  return m.specular * (constant_spectrum(1 - m.metallic) + m.metallic * m.diffuse);
}

// Of a metal or of a coat.
Spectrum fresnel(const CompiledMaterial& m, float cosine) {
  Spectrum s;
  float refracted_cosine = 0;
  if (m.kind == CompiledMaterial::Kind::coated_diffuse)
    return constant_spectrum(fresnel_dielectric(cosine, m.refractive_index, refracted_cosine));
  for (int c = 0; c < channel_count; ++c) s[c] = fresnel_conductor(cosine, m.eta[c], m.k[c]);
  return s;
}

// Most surfaces are.
bool is_diffuse_alone(const CompiledMaterial& m) {
  return m.kind == CompiledMaterial::Kind::blinn_phong && is_zero(m.specular) && is_zero(m.mirror) &&
         is_zero(m.refraction) && !is_zero(m.diffuse);
}

// In proportion to what each way sends on of light that comes along `direction`.
Chances chances_of(const CompiledMaterial& m, const SmoothLobes& lobes, vec3 n, vec3 direction) {
  if (is_diffuse_alone(m)) return {0, 0, 1, 0};
  Chances c{mean_of(lobes.reflected), mean_of(lobes.refracted), mean_of(m.diffuse), mean_of(highlight_colour(m))};
  const float cosine = clamped_cosine(n, -direction);
  if (m.kind == CompiledMaterial::Kind::coated_diffuse)
    c.diffuse = coat_transmittance(m, cosine) * (1 - m.internal_reflectance) * mean_of(base_reflectance(m));
  if (m.alpha > 0) c.highlight = mean_of(fresnel(m, cosine));
  const float total = c.reflected + c.refracted + c.diffuse + c.highlight;
  if (!(total > 0)) return {1, 0, 0, 0};
  return {c.reflected / total, c.refracted / total, c.diffuse / total, c.highlight / total};
}

// The direction half way between two others, and its cosine to the normal; 0 where there is none.
struct HalfWay {
  vec3 direction{0, 0, 0};
  float cosine = 0;
};

HalfWay half_way(vec3 n, vec3 a, vec3 b) {
  const vec3 sum = a + b;
  const float squared = dot(sum, sum);
  if (!(squared > 0)) return {};
  const vec3 direction = (1 / std::sqrt(squared)) * sum;
  return {direction, clamped_cosine(n, direction)};
}

// The reflection of facets: F D / (4 n.l n.v (1 + Lambda + Lambda')).
Spectrum facets_bsdf(const CompiledMaterial& m, vec3 n, vec3 to_light, vec3 to_viewer) {
  const float light = clamped_cosine(n, to_light), viewer = clamped_cosine(n, to_viewer);
  const HalfWay h = half_way(n, to_light, to_viewer);
  if (light == 0 || viewer == 0 || h.cosine == 0) return {};
  const float seen = 1 / (1 + hidden_facets(light, m.alpha) + hidden_facets(viewer, m.alpha));
  return (facet_density(h.cosine, m.alpha) * seen / (4 * light * viewer)) *
         fresnel(m, clamped_cosine(h.direction, to_viewer));
}

Spectrum base_bsdf(const CompiledMaterial& m, vec3 n, vec3 to_light, vec3 to_viewer) {
  const float let_through =
      coat_transmittance(m, clamped_cosine(n, to_light)) * coat_transmittance(m, clamped_cosine(n, to_viewer));
  return (let_through / (pi * m.refractive_index * m.refractive_index)) * base_reflectance(m);
}

// Without mirrors, glass and facets.
Spectrum matt_bsdf(const CompiledMaterial& m, vec3 n, vec3 to_light, vec3 to_viewer) {
  if (m.kind == CompiledMaterial::Kind::conductor) return {};
  if (m.kind == CompiledMaterial::Kind::coated_diffuse) return base_bsdf(m, n, to_light, to_viewer);
  const Spectrum diffuse = (1 / pi) * m.diffuse;
  if (is_zero(m.specular)) return diffuse;
  const float cosine = half_way(n, to_light, to_viewer).cosine;
  if (cosine == 0) return diffuse;
  return diffuse + m.highlight_scale * kernel::pow_positive(cosine, m.shininess) * highlight_colour(m);
}

// Without mirrors and glass.
Spectrum bsdf(const CompiledMaterial& m, vec3 n, vec3 to_light, vec3 to_viewer) {
  const Spectrum matt = matt_bsdf(m, n, to_light, to_viewer);
  return m.alpha > 0 ? matt + facets_bsdf(m, n, to_light, to_viewer) : matt;
}

// The density of directions of the highlight: they are the mirror's about a normal h, drawn from the facets that are
// seen, or for Blinn-Phong with a density of (s + 1) / (2 pi) (n.h)^s.
float highlight_pdf(const CompiledMaterial& m, vec3 n, vec3 to_light, vec3 to_viewer) {
  const HalfWay h = half_way(n, to_light, to_viewer);
  if (h.cosine == 0) return 0;
  if (m.alpha > 0) {
    const float viewer = clamped_cosine(n, to_viewer);
    return viewer > 0 ? facet_density(h.cosine, m.alpha) / (4 * viewer * (1 + hidden_facets(viewer, m.alpha))) : 0;
  }
  const float density = (m.shininess + 1) / (2 * pi) * kernel::pow_positive(h.cosine, m.shininess);
  return density / (4 * clamped_cosine(h.direction, to_viewer));
}

float bsdf_pdf(const CompiledMaterial& m, const Chances& chances, vec3 n, vec3 to_light, vec3 to_viewer) {
  const float pdf = chances.diffuse * clamped_cosine(n, to_light) / pi;
  return chances.highlight > 0 ? pdf + chances.highlight * highlight_pdf(m, n, to_light, to_viewer) : pdf;
}

// To the shading normal; 0 for directions that are not on its side and on the geometric normal's.
float cosine_on_outside(const SurfaceHit& hit, vec3 direction) {
  return dot(direction, hit.normal) > 0 ? clamped_cosine(hit.shading_normal, direction) : 0;
}

vec3 draw_direction(const CompiledMaterial& m, vec3 n, vec3 direction, bool highlight, RandomStream& random) {
  const auto [u, turns] = random.next_pair();
  if (!highlight) return kernel::direction_at_cosine(n, std::sqrt(1 - u), turns);
  if (m.alpha > 0) return reflect(direction, draw_facet(n, -direction, m.alpha, u, turns));
  const float cosine = std::pow(1 - u, 1 / (m.shininess + 1));
  return reflect(direction, kernel::direction_at_cosine(n, cosine, turns));
}

SurfaceSample sample_material(const CompiledMaterial& material, const SurfaceHit& hit, vec3 direction,
                              RandomStream& random) {
  if (material.kind == CompiledMaterial::Kind::rough_dielectric)
    return sample_rough_glass(material, hit, direction, random);
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
  if (m.kind != CompiledMaterial::Kind::blinn_phong) {
    if (m.alpha == 0) lobes.reflected = fresnel(m, cosine);
    return lobes;
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
  SurfaceSample s = sample_material(*MaterialAt(scene, hit), hit, direction, random);
  // A shading normal can send a path through a surface that it should leave, or back from one that it should cross.
  if ((dot(s.direction, hit.normal) < 0) != s.transmitted) s.weight = {};
  return s;
}

Spectrum eval_matt(const CompiledScene& scene, const SurfaceHit& hit, vec3 direction, vec3 to_light) {
  const float cosine = cosine_on_outside(hit, to_light);
  if (cosine == 0) return {};
  return cosine * matt_bsdf(*MaterialAt(scene, hit), hit.shading_normal, to_light, -direction);
}

Spectrum eval_facets(const CompiledScene& scene, const SurfaceHit& hit, vec3 direction, vec3 to_light, float& pdf) {
  const MaterialAt at(scene, hit);
  const CompiledMaterial& material = *at;
  if (material.kind == CompiledMaterial::Kind::rough_dielectric)
    return eval_rough_glass(material, hit, direction, to_light, pdf);
  const float cosine = cosine_on_outside(hit, to_light);
  pdf = 0;
  if (material.alpha == 0 || cosine == 0) return {};
  pdf = highlight_pdf(material, hit.shading_normal, to_light, -direction);
  return cosine * facets_bsdf(material, hit.shading_normal, to_light, -direction);
}

SurfaceSample sample_facets(const CompiledMaterial& material, const SurfaceHit& hit, vec3 direction,
                            RandomStream& random) {
  if (material.kind == CompiledMaterial::Kind::rough_dielectric)
    return sample_rough_glass(material, hit, direction, random);
  const vec3 n = hit.shading_normal;
  const vec3 to_light = draw_direction(material, n, direction, true, random);
  const float cosine = dot(to_light, n), pdf = highlight_pdf(material, n, to_light, -direction);
  if (!(cosine > 0 && pdf > 0)) return {to_light, {}, 0, false};
  return {to_light, (cosine / pdf) * facets_bsdf(material, n, to_light, -direction), pdf, false};
}

Spectrum eval_surface(const CompiledScene& scene, const SurfaceHit& hit, vec3 direction, vec3 to_light, float& pdf) {
  const MaterialAt at(scene, hit);
  const CompiledMaterial& material = *at;
  if (material.kind == CompiledMaterial::Kind::rough_dielectric)
    return eval_rough_glass(material, hit, direction, to_light, pdf);
  const vec3 n = hit.shading_normal;
  const float cosine = cosine_on_outside(hit, to_light);
  pdf = 0;
  if (!scatters_widely(material) || cosine == 0) return {};
  const Chances chances = chances_of(material, smooth_lobes(material, hit, direction), n, direction);
  pdf = bsdf_pdf(material, chances, n, to_light, -direction);
  return cosine * bsdf(material, n, to_light, -direction);
}

bool scatters_widely(const CompiledMaterial& material) {
  return !is_zero(material.diffuse) || !is_zero(material.specular) || material.alpha > 0;
}

Spectrum straight_transmittance(const CompiledMaterial& material, float cosine) {
  if (is_zero(material.refraction)) return {};
  float refracted_cosine = 0;
  return (1 - fresnel_dielectric(cosine, material.refractive_index, refracted_cosine)) * material.refraction;
}

}  // namespace brume
