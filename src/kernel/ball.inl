// Ray and unit ball about the origin: the span of t in which |origin + t direction| <= 1. The roots are taken about the
// point of the line that is nearest to the centre, where cancellation costs little: with m the t of that point and
// h^2 = (1 - |origin + m direction|^2) / |direction|^2 they are m - h and m + h.
// An origin at a distance of d radii costs digits of the nearest point: the ball is met as if it were shifted by up to
// 2e-7 d radii.
// Source: E. Haines et al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019, chapter 7.

// The span of [t_begin, t_end] in the ball.
KERNEL BoxSpan ball_span(vec3 origin, vec3 direction, F t_begin, F t_end) {
  F squared = max(dot(direction, direction), F(1e-37f));
  F middle = -dot(origin, direction) / squared;
  vec3 nearest =
      vec3(fma(middle, direction.x, origin.x), fma(middle, direction.y, origin.y), fma(middle, direction.z, origin.z));
  F left = F(1.0f) - dot(nearest, nearest);
  F half_chord = sqrt(max(left, F(0.0f)) / squared);
  F t_enter = max(middle - half_chord, t_begin);
  F t_exit = min(middle + half_chord, t_end);
  B hit = both(F(0.0f) < left, t_enter < t_exit);
  BoxSpan s;
  s.t_enter = select(hit, t_enter, t_begin);
  s.entry = vec3(fma(s.t_enter, direction.x, origin.x), fma(s.t_enter, direction.y, origin.y),
                 fma(s.t_enter, direction.z, origin.z));
  s.t_length = select(hit, t_exit - s.t_enter, F(0.0f));
  return s;
}
