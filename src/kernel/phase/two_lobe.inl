// Two Henyey-Greenstein lobes: p(mu) = w HG(mu; g1) + (1 - w) HG(mu; g2), per steradian; p.x = g1, p.y = g2, both above
// -1 and below 1, and p.z = w, 0 <= w <= 1.
// Sampling: u chooses the lobe and, stretched to [0, 1], places mu in it.
// Source: G. W. Kattawar, "A three-parameter analytic phase function for multiple scattering calculations", JQSRT 15,
// 1975.

KERNEL F two_lobe_eval(F mu, vec4 p) {
  F first = henyey_greenstein_eval(mu, p);
  F second = henyey_greenstein_eval(mu, vec4(p.y, 0.0f, 0.0f, 0.0f));
  return fma(p.z, first, (1.0f - p.z) * second);
}

KERNEL F two_lobe_sample(F u, vec4 p) {
  B is_first = u < p.z;
  F stretched = select(is_first, u, u - p.z) / select(is_first, p.z, 1.0f - p.z);
  return henyey_greenstein_sample(stretched, vec4(select(is_first, p.x, p.y), 0.0f, 0.0f, 0.0f));
}

KERNEL F two_lobe_mean_cosine(vec4 p) { return fma(p.z, p.x, (1.0f - p.z) * p.y); }

#ifdef KERNEL_TABLES
inline PhasePrepared two_lobe_prepare(const float* values) { return {values[0], values[1], values[2], 0}; }
inline constexpr PhaseFunction two_lobe_table = {
    "two_lobe",
    "a lobe forward and one backward, or a narrow and a wide one",
    {{"g1", "mean cosine of the first lobe; positive is forward", "1", -1, 1, 0.8f},
     {"g2", "mean cosine of the second lobe; positive is forward", "1", -1, 1, -0.3f},
     {"w", "weight of the first lobe", "1", 0, 1, 0.7f, true}}};
#endif
