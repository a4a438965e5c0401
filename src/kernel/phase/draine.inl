// Draine: p(mu) = (1 - g^2) (1 + alpha mu^2) / (4 pi (1 + alpha (1 + 2 g^2) / 3) (1 + g^2 - 2 g mu)^(3/2)), per
// steradian; p.x = g, -1 < g < 1, and p.y = alpha, 0 <= alpha <= 1000. alpha = 0 is Henyey-Greenstein with mean cosine
// g, alpha = 1 Cornette-Shanks, g = 0 with alpha = 1 Rayleigh.
// Sampling: with v the distribution function of Henyey-Greenstein at mu, counted from mu = -1, the density is 1 + alpha
// mu(v)^2 of v, and the distribution function is solved for v,
//   v (1 + alpha M(v)) = u (1 + alpha (1 + 2 g^2) / 3),   M(v) = the mean of mu^2 over [0, v].
// With the distance t = 1 - mu from the peak, A = 1 + g^2, Q = (1 + g)^2 (1 - g) / (1 - g + 2 g v) (the product of
// sqrt(A - 2 g mu) here and at mu = -1) and k = (A - Q) / (2 g) = (2 g mu - A t) / (A + Q),
//   3 M = A (2 mu - k t) / (A + Q) + k (k - t),
// where neither g -> 0 nor |g| -> 1 cancels or divides by zero. Left of mu = 0 this function of v is concave, right of
// it convex: from that point Halley's iteration converges fast on either side. Six steps leave 2e-10 of u in exact
// arithmetic and 6e-7 in float. (The closed form of J. Jendersie and E. d'Eon, SIGGRAPH Talks 2023, divides by g and
// by alpha, and in float is off by up to 1.5e-3 of u at alpha = 250.)
// A lobe backwards, g < 0, is the one forwards in -mu and 1 - u.
// Source: B. T. Draine, "Scattering by Interstellar Dust Grains. I. Optical and Ultraviolet", ApJ 598, 2003.

// 1 + alpha (1 + 2 g^2) / 3: the mean of 1 + alpha mu^2 under Henyey-Greenstein.
KERNEL F draine_norm(F g, F alpha) { return fma(alpha, fma(0.666666667f * g, g, F(0.333333333f)), F(1.0f)); }

KERNEL F draine_eval(F mu, vec4 p) {
  F g = abs(p.x);
  F from_peak = 1.0f - select(p.x < 0.0f, -mu, mu);
  F d = fma(2.0f * g, from_peak, (1.0f - g) * (1.0f - g));  // 1 + g^2 - 2 g mu
  F henyey_greenstein = 0.0795774715459f * ((1.0f - g) * (1.0f + g)) / (d * sqrt(d));
  return henyey_greenstein * (fma(p.y * mu, mu, F(1.0f)) / draine_norm(g, p.y));
}

// 1 - mu where Henyey-Greenstein's distribution function is v, as in henyey_greenstein_sample; 0 <= g < 1 and
// ratio = (1 - g) / (1 - g + 2 g v).
KERNEL F draine_from_peak(F v, F ratio, F g) { return 2.0f * (ratio * ratio) * ((1.0f - v) * fma(g, v, F(1.0f))); }

// One step of Halley's iteration towards the root v of f(v) = v (1 + alpha M(v)) - scaled_u, within [0, 1] and at most
// twice as far as Newton's; 0 <= g < 1.
KERNEL F draine_halley(F v, F scaled_u, F g, F alpha) {
  F a = fma(g, g, F(1.0f));
  F inverse = 1.0f / fma(2.0f * g, v, 1.0f - g);
  F ratio = (1.0f - g) * inverse;
  F t = draine_from_peak(v, ratio, g);
  F mu = 1.0f - t;
  F q = (1.0f + g) * (1.0f + g) * ratio;
  F inverse_sum = 1.0f / (a + q);
  F k = fma(2.0f * g, mu, -a * t) * inverse_sum;
  F mean_square = 0.333333333f * fma(a * inverse_sum, fma(-k, t, 2.0f * mu), k * (k - t));
  F f = fma(alpha * v, mean_square, v - scaled_u);
  F slope = fma(alpha * mu, mu, F(1.0f));
  F half_curvature = 2.0f * alpha * mu * (q * ratio * inverse);  // half of f'', with d mu / d v = 2 q ratio inverse
  F divisor = max(fma(slope, slope, -f * half_curvature), 0.5f * slope * slope);
  return min(max(v - f * slope / divisor, F(0.0f)), F(1.0f));
}

KERNEL F draine_sample(F u, vec4 p) {
  F g = abs(p.x);
  B backward = p.x < 0.0f;
  F scaled_u = select(backward, 1.0f - u, u) * draine_norm(g, p.y);
  F root = sqrt(fma(g, g, F(1.0f)));
  F v = (1.0f - g) / (root * (root + (1.0f + g)));  // where mu = 0
  for (int i = 0; i < 6; ++i) v = draine_halley(v, scaled_u, g, p.y);
  F mu = max(1.0f - draine_from_peak(v, (1.0f - g) / fma(2.0f * g, v, 1.0f - g), g), F(-1.0f));
  return select(backward, -mu, mu);
}

KERNEL F draine_mean_cosine(vec4 p) {
  F g = p.x;
  return g * fma(p.y, fma(0.4f * g, g, F(0.6f)), F(1.0f)) / draine_norm(g, p.y);
}

#ifdef KERNEL_TABLES
inline PhasePrepared draine_prepare(const float* values) { return {values[0], values[1], 0, 0}; }
inline constexpr PhaseFunction draine_table = {
    "draine",
    "one lobe that is stronger forward and backward than sideways, as that of dust",
    {{"g", "strength of the lobe; positive is forward", "1", -1, 1, 0},
     {"alpha", "weight of the squared cosine; 0 is Henyey-Greenstein, 1 Cornette-Shanks", "1", 0, 1000, 1, true}}};
#endif
