// Beer-Lambert: the fraction exp(-tau) of light that crosses the optical depth tau = integral of sigma_t (no unit),
// and what a stretch of constant coefficients scatters towards the viewer. Exact, unbiased.
// Source: S. Chandrasekhar, Radiative Transfer, 1950, ch. I.

// The transmittance of optical depth tau >= 0.
KERNEL F beer_lambert(F optical_depth) { return exp_natural(-optical_depth); }

// (1 - exp(-tau)) / tau: the mean transmittance from the points of a stretch of constant extinction to its near end,
// in [0, 1]. By its Taylor series below tau = 1/2, where the difference would cancel. Relative error below 2e-7.
KERNEL F mean_transmittance(F optical_depth) {
  F tau = optical_depth;
  F series = fma(tau, -2.4801587e-5f, 1.9841270e-4f);
  series = fma(tau, series, -1.3888889e-3f);
  series = fma(tau, series, 8.3333333e-3f);
  series = fma(tau, series, -4.1666667e-2f);
  series = fma(tau, series, 0.16666667f);
  series = fma(tau, series, -0.5f);
  series = fma(tau, series, 1.0f);
  F direct = (1.0f - exp_natural(-tau)) / max(tau, 0.5f);
  return select(tau < 0.5f, series, direct);
}
