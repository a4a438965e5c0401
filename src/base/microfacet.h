// Rough surfaces as many small mirrors whose normals are spread about the surface's own: the distribution of
// Trowbridge and Reitz (GGX), alike in all directions. alpha > 0 is its width.
// Sources: T. Trowbridge and K. Reitz, "Average irregularity representation of a rough surface for ray reflection",
// JOSA 65(5), 1975; E. Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2),
// 2014.
#pragma once

#include <cmath>
#include <numbers>

#include "kernel/scalar.h"

namespace brume {

// The density of facets whose normal has this cosine to the surface's, per area of the surface and solid angle.
inline float facet_density(float cosine, float alpha) {
  const float a2 = alpha * alpha, t = cosine * cosine * (a2 - 1) + 1;
  return a2 / (std::numbers::pi_v<float> * t * t);
}

// Smith's Lambda of a direction with this cosine > 0: of the facets turned to it, 1 / (1 + Lambda) are not hidden by
// others, and of those turned to two directions 1 / (1 + Lambda + Lambda') are seen from both.
inline float hidden_facets(float cosine, float alpha) {
  const float c2 = cosine * cosine;
  return 0.5f * (std::sqrt(1 + alpha * alpha * (1 - c2) / c2) - 1);
}

// Draws one of the facets that are seen from the direction v, in proportion to the area seen; n is the surface's
// normal. The density of mirrored directions is then facet_density / (4 n.v (1 + Lambda)).
// Source: J. Dupuy and A. Benyoub, "Sampling Visible GGX Normals with Spherical Caps", CGF 42(8), 2023.
inline kernel::vec3 draw_facet(kernel::vec3 n, kernel::vec3 v, float alpha, float u, float turns) {
  // Stretched so that the surface is a hemisphere of mirrors, of which a cap about v is seen.
  const auto stretched = [&](kernel::vec3 w) {
    const float along = dot(w, n);
    return normalize(alpha * (w - along * n) + along * n);
  };
  const kernel::vec3 seen_from = stretched(v);
  const float lowest = -dot(seen_from, n), cosine = 1 - u * (1 - lowest);
  return stretched(kernel::direction_at_cosine(n, cosine, turns) + seen_from);
}

}  // namespace brume
