// Isotropic scattering: p(mu) = 1 / (4 pi), the same in all directions. mu in [-1, 1]; per steradian.
// Source: S. Chandrasekhar, Radiative Transfer, 1950, section 3.

KERNEL F isotropic_eval(F, vec4) { return F(0.0795774715459f); }

KERNEL F isotropic_sample(F u, vec4) { return fma(F(-2.0f), u, F(1.0f)); }

KERNEL F isotropic_mean_cosine(vec4) { return F(0.0f); }

#ifdef KERNEL_TABLES
inline PhasePrepared isotropic_prepare(const float*) { return {}; }
inline constexpr PhaseFunction isotropic_table = {"isotropic", "the same in all directions", {}};
#endif
