// Points on the unit disk: the concentric map from the unit square, which takes squares about its centre to circles and
// keeps ratios of areas, so that what is well distributed over the square is so over the disk. Exact.
// With a = 2u - 1 and b = 2v - 1: r = a and phi = (pi/4) b/a where |b| < |a|, else r = b and phi = pi/2 - (pi/4) a/b.
// A negative r turns the point to the other side, and (1/2, 1/2) is the centre.
// Source: P. Shirley and K. Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997.

// The point (x, y) for u and v in [0, 1).
KERNEL void disk_point(F u, F v, INOUT(F) x, INOUT(F) y) {
  F a = 2.0f * u - 1.0f;
  F b = 2.0f * v - 1.0f;
  B wide = abs(b) < abs(a);
  F r = select(wide, a, b);
  F ratio = select(wide, b, a) / select(abs(r) > 0.0f, r, F(1.0f));
  F sine;
  F cosine;
  sincos_turns(0.125f * select(wide, ratio, 2.0f - ratio), sine, cosine);
  x = r * cosine;
  y = r * sine;
}
