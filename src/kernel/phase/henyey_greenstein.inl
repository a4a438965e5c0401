// Henyey-Greenstein: p(mu) = (1 - g^2) / (4 pi (1 + g^2 - 2 g mu)^(3/2)), per steradian; p.x = g, its mean cosine,
// -1 < g < 1.
// Sampling: the distribution function inverted, 1 + g^2 - 2 g mu = ((1 - g^2) / (1 + g s))^2 with s = 2 u - 1, solved
// for the distance from the peak,
//   1 - mu = 2 (1 - g)^2 (1 - u) (1 + g u) / (1 - g + 2 g u)^2,
// a form without cancellation that needs no special case at g = 0. A lobe backwards, g < 0, is the one forwards in -mu
// and 1 - u.
// Source: L. G. Henyey and J. L. Greenstein, "Diffuse radiation in the galaxy", ApJ 93, 1941, eq. 2.

KERNEL F henyey_greenstein_eval(F mu, vec4 p) {
  F g = abs(p.x);
  F from_peak = 1.0f - select(p.x < 0.0f, -mu, mu);
  F d = fma(2.0f * g, from_peak, (1.0f - g) * (1.0f - g));  // 1 + g^2 - 2 g mu
  return 0.0795774715459f * ((1.0f - g) * (1.0f + g)) / (d * sqrt(d));
}

KERNEL F henyey_greenstein_sample(F u, vec4 p) {
  F g = abs(p.x);
  B backward = p.x < 0.0f;
  F v = select(backward, 1.0f - u, u);
  F ratio = (1.0f - g) / fma(2.0f * g, v, 1.0f - g);
  F from_peak = 2.0f * (ratio * ratio) * ((1.0f - v) * fma(g, v, F(1.0f)));
  F mu = max(1.0f - from_peak, F(-1.0f));
  return select(backward, -mu, mu);
}

KERNEL F henyey_greenstein_mean_cosine(vec4 p) { return p.x; }

#ifdef KERNEL_TABLES
inline PhasePrepared henyey_greenstein_prepare(const float* values) { return {values[0], 0, 0, 0}; }
inline constexpr PhaseFunction henyey_greenstein_table = {
    "henyey_greenstein",
    "forward or backward scattering with one lobe",
    {{"g", "mean cosine of the scattering angle; positive is forward", "1", -1.0f, 1.0f, 0.0f}}};
#endif
