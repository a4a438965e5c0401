// Rayleigh scattering of unpolarised light by particles much smaller than the wavelength, without depolarisation:
// p(mu) = 3 (1 + mu^2) / (16 pi), per steradian. mu in [-1, 1]; mean cosine 0.
// Sampling: the distribution function (4 + 3 mu + mu^3) / 8 = u inverted, that is mu^3 + 3 mu = c with c = 8 u - 4, by
// two Newton steps from a start within 0.015 of the root, which leaves a relative error below 4e-9. (Cardano's formula
// for the root, b^(-1/3) - b^(1/3) with b = a + sqrt(1 + a^2), a = 2 - 4 u, needs a cube root and cancels near mu = 0.)
// Source: S. Chandrasekhar, Radiative Transfer, 1950, section 16; for Cardano's formula J. R. Frisvad, "Importance
// sampling the Rayleigh phase function", JOSA A 28(12), 2011.

KERNEL F rayleigh_eval(F mu, vec4) { return 0.0596831036595f * fma(mu, mu, F(1.0f)); }

// One Newton step towards the root of m^3 + 3 m = c.
KERNEL F rayleigh_newton(F m, F c) {
  F m2 = m * m;
  return fma(2.0f * m2, m, c) / fma(F(3.0f), m2, F(3.0f));
}

KERNEL F rayleigh_sample(F u, vec4) {
  F c = fma(F(8.0f), u, F(-4.0f));
  F start = c * fma(c * c, -0.004f, 0.312f);
  return min(max(rayleigh_newton(rayleigh_newton(start, c), c), F(-1.0f)), F(1.0f));
}

KERNEL F rayleigh_mean_cosine(vec4) { return F(0.0f); }

#ifdef KERNEL_TABLES
inline PhasePrepared rayleigh_prepare(const float*) { return {}; }
inline constexpr PhaseFunction rayleigh_table = {"rayleigh", "particles much smaller than the wavelength", {}};
#endif
