// Approximate Mie scattering of visible light by water droplets of diameter d micrometres, 0.1 <= d <= 50: a narrow
// Henyey-Greenstein lobe and a wide Draine lobe,
//   p(mu) = (1 - w) HG(mu; g_HG) + w Draine(mu; g_D, alpha), per steradian;
// p.x = g_HG, p.y = g_D, p.z = alpha and p.w = w are fitted to Mie's theory for droplets of fog and clouds. The fit's
// pieces almost meet at d = 5 and jump at d = 1.5, where w goes from 0.21 to 0.37.
// Sampling: u chooses the lobe and, stretched to [0, 1], places mu in it. Henyey-Greenstein is Draine at alpha = 0, so
// that one sampler does for both.
// Source: J. Jendersie and E. d'Eon, "An Approximate Mie Scattering Function for Fog and Cloud Rendering", SIGGRAPH
// Talks 2023, and its supplement for d < 5.

KERNEL F mie_eval(F mu, vec4 p) {
  F narrow = henyey_greenstein_eval(mu, p);
  F wide = draine_eval(mu, vec4(p.y, p.z, 0.0f, 0.0f));
  return fma(p.w, wide, (1.0f - p.w) * narrow);
}

KERNEL F mie_sample(F u, vec4 p) {
  B is_wide = u < p.w;
  F stretched = select(is_wide, u, u - p.w) / select(is_wide, p.w, 1.0f - p.w);
  return draine_sample(stretched, vec4(select(is_wide, p.y, p.x), select(is_wide, p.z, F(0.0f)), 0.0f, 0.0f));
}

KERNEL F mie_mean_cosine(vec4 p) {
  F wide = draine_mean_cosine(vec4(p.y, p.z, 0.0f, 0.0f));
  return fma(p.w, wide, (1.0f - p.w) * p.x);
}

#ifdef KERNEL_TABLES
// g_HG, g_D, alpha and w of droplets with a diameter of 5 micrometres or more.
inline PhasePrepared mie_large(double d) {
  return {static_cast<float>(std::exp(-0.0990567 / (d - 1.67154))),
          static_cast<float>(std::exp(-2.20679 / (d + 3.91029) - 0.428934)),
          static_cast<float>(std::exp(3.62489 - 8.29288 / (d + 5.52825))),
          static_cast<float>(std::exp(-0.599085 / (d - 0.641583) - 0.665888))};
}

// From 1.5 to 5 micrometres.
inline PhasePrepared mie_medium(double d) {
  const double l = std::log(d), m = std::log(l);
  return {static_cast<float>(0.0604931 * m + 0.940256),
          static_cast<float>(0.500411 - 0.081287 / (std::tan(l) - 2 * l + 1.27551)),
          static_cast<float>(7.30354 * l + 6.31675),
          static_cast<float>(0.026914 * (l - std::cos(5.68947 * (m - 0.0292149))) + 0.376475)};
}

// Below 1.5 micrometres.
inline PhasePrepared mie_small(double d) {
  const double l = std::log(d);
  const double inner = 1.19692 * std::cos((l - 0.238604) * (l + 1.00667) / (0.507522 - 0.15677 * l));
  return {static_cast<float>(0.862 - 0.143 * l * l),
          static_cast<float>(0.379685 * std::cos(inner + 1.37932 * l + 0.0625835) + 0.344213), 250,
          static_cast<float>(0.146209 * std::cos(3.38707 * l + 2.11193) + 0.316072 + 0.0778917 * l)};
}

inline PhasePrepared mie_prepare(const float* values) {
  const double d = static_cast<double>(values[0]);
  return d < 1.5 ? mie_small(d) : d < 5 ? mie_medium(d) : mie_large(d);
}
inline constexpr PhaseFunction mie_table = {
    "mie", "water droplets of fog and clouds", {{"d", "diameter of the droplets", "um", 0.1, 50, 10, true}}};
#endif
