// Rough glass: facets (base/microfacet.h) that reflect and refract as Fresnel's equations have it. Light that meets a
// second facet is lost.
// Source: B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007.
#pragma once

#include "render/surfaces.h"

namespace brume {

// As eval_surface and sample_surface, for a material of kind rough_dielectric.
Spectrum eval_rough_glass(const CompiledMaterial& material, const SurfaceHit& hit, kernel::vec3 direction,
                          kernel::vec3 to_light, float& pdf);
SurfaceSample sample_rough_glass(const CompiledMaterial& material, const SurfaceHit& hit, kernel::vec3 direction,
                                 RandomStream& random);

}  // namespace brume
