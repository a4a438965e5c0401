// How much light a smooth boundary reflects: Fresnel's equations, for unpolarised light.
#pragma once

#include <algorithm>
#include <cmath>

namespace brume {

// The reflectance of a dielectric for light that meets it at a cosine >= 0 to its normal; eta is the refractive index
// beyond it over that on the near side. `refracted_cosine` gets the cosine beyond it, 0 where all light is reflected.
inline float fresnel_dielectric(float cosine, float eta, float& refracted_cosine) {
  const float squared = 1 - (1 - cosine * cosine) / (eta * eta);  // Snell
  refracted_cosine = squared > 0 ? std::sqrt(squared) : 0;
  if (squared <= 0) return 1;
  const float parallel = (eta * cosine - refracted_cosine) / (eta * cosine + refracted_cosine);
  const float perpendicular = (cosine - eta * refracted_cosine) / (cosine + eta * refracted_cosine);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

// The reflectance of a conductor whose refractive index is eta + i k over that on the near side. With a + i b the root
// of (eta + i k)^2 - sin^2, the amplitudes are (c - (a + i b)) / (c + (a + i b)) and that times (a + i b - sin tan) /
// (a + i b + sin tan); below are their squared magnitudes.
// Source: M. Born and E. Wolf, Principles of Optics, 7th ed., section 14.2.
inline float fresnel_conductor(float cosine, float eta, float k) {
  if (cosine < 1e-6f) return 1;
  const float c2 = cosine * cosine, s2 = 1 - c2;
  const float real = eta * eta - k * k - s2;
  const float magnitude = std::sqrt(real * real + 4 * eta * eta * k * k);  // a^2 + b^2
  const float a = std::sqrt(std::max(0.0f, 0.5f * (magnitude + real)));
  const float perpendicular = (magnitude + c2 - 2 * a * cosine) / (magnitude + c2 + 2 * a * cosine);
  const float t = c2 * magnitude + s2 * s2, u = 2 * a * cosine * s2;
  const float parallel = perpendicular * (t - u) / (t + u);
  return 0.5f * (perpendicular + parallel);
}

}  // namespace brume
