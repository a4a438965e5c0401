// Schlick: p(mu) = (1 - k^2) / (4 pi (1 - k mu)^2), per steradian; p.x = k, -1 < k < 1, of the mean cosine's sign.
// A lobe like Henyey-Greenstein's without its square root; k = 1.55 g - 0.55 g^3 gives it roughly that shape for mean
// cosines g up to 0.93, and k leaves the valid range above.
// Sampling: the distribution function inverted, mu = (s + k) / (1 + k s) with s = 2 u - 1, solved for the distance from
// the peak,
//   1 - mu = 2 (1 - k) (1 - u) / (1 - k + 2 k u), a form without cancellation.
// A lobe backwards, k < 0, is the one forwards in -mu and 1 - u.
// Source: P. Blasi, B. Le Saec and C. Schlick, "A Rendering Algorithm for Discrete Volume Density Objects", CGF 12(3),
// 1993.

KERNEL F schlick_eval(F mu, vec4 p) {
  F k = abs(p.x);
  F from_peak = 1.0f - select(p.x < 0.0f, -mu, mu);
  F d = fma(k, from_peak, 1.0f - k);  // 1 - k mu
  return 0.0795774715459f * ((1.0f - k) * (1.0f + k)) / (d * d);
}

KERNEL F schlick_sample(F u, vec4 p) {
  F k = abs(p.x);
  B backward = p.x < 0.0f;
  F v = select(backward, 1.0f - u, u);
  F d = fma(2.0f * k, v, 1.0f - k);
  F mu = max(1.0f - 2.0f * ((1.0f - k) * (1.0f - v)) / d, F(-1.0f));
  return select(backward, -mu, mu);
}

// 1/k + (1 - k^2) / (2 k^2) ln((1 - k) / (1 + k)) = sum of 2 k^(2n-1) / ((2n-1)(2n+1)), n = 1, 2, ...: the series below
// |k| = 1/2, where the difference would cancel; absolute error below 1e-6.
KERNEL F schlick_mean_cosine(vec4 p) {
  F k = p.x;
  F k2 = k * k;
  F series = fma(k2, 6.19195e-3f, 7.84314e-3f);
  series = fma(series, k2, 1.02564103e-2f);
  series = fma(series, k2, 1.39860140e-2f);
  series = fma(series, k2, 2.02020202e-2f);
  series = fma(series, k2, 3.17460317e-2f);
  series = fma(series, k2, 5.71428571e-2f);
  series = fma(series, k2, 1.33333333e-1f);
  series = fma(series, k2, 6.66666667e-1f);
  B small = abs(k) < 0.5f;
  F divisor = select(small, F(1.0f), k);
  F direct = (1.0f + (1.0f - k) * (1.0f + k) / (2.0f * divisor) * log_natural((1.0f - k) / (1.0f + k))) / divisor;
  return select(small, series * k, direct);
}

#ifdef KERNEL_TABLES
inline PhasePrepared schlick_prepare(const float* values) { return {values[0], 0, 0, 0}; }
inline constexpr PhaseFunction schlick_table = {
    "schlick",
    "a lobe like Henyey-Greenstein's that is cheaper to evaluate",
    {{"k", "strength of the lobe; positive is forward", "1", -1.0f, 1.0f, 0.0f}}};
#endif
