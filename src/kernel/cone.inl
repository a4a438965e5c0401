// How a point light's intensity falls off about an axis: 1 where the cosine of the angle to the axis is above `start`,
// 0 where it is below `end`, and between them the smooth step t^2 (3 - 2 t). Its mean over that ring of directions is
// 1/2. Exact. A light that shines everywhere has start and end below -1.
// Source: M. Pharr, W. Jakob and G. Humphreys, Physically Based Rendering, 4th ed., 2023, section 12.2.1.

KERNEL F cone_falloff(F cosine, F end, F start) {
  F t = min(max((cosine - end) / max(start - end, F(1e-7f)), F(0.0f)), F(1.0f));
  return t * t * (3.0f - 2.0f * t);
}
