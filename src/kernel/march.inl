// Ray marching: the integral of f over [t_begin, t_begin + n step] as step times the sum of f at one point in each
// step. Biased for exp(-integral) by O(step^2) (middle) or O(step) (start); unbiased for the integral itself where the
// point is uniform in the step (random). A placement is two numbers: the point lies at base + spread u of its step, u
// in [0, 1):
//   start 0, 0;  random 0, 1;  middle 1/2, 0;  middle-random 1/4, 1/2 (uniform in the middle half).
// Source: K. Perlin and E. Hoffert, "Hypertexture", SIGGRAPH 1989; for the random placements M. Pauly, T. Kollig and
// A. Keller, "Metropolis Light Transport for Participating Media", EGWR 2000.

// The t of the point in step number `index`.
KERNEL F march_position(F t_begin, F step, I index, F base, F spread, F u) {
  return fma(to_float(index) + fma(spread, u, base), step, t_begin);
}
