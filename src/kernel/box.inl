// Ray and axis-aligned box: the interval of t in which origin + t direction lies in [lo, hi], by slabs.
// Exact in real arithmetic; in float each end is off by at most 3 ulp of |plane - origin| / |direction| per axis.
// A direction component below 1e-37 in magnitude (+0, -0 and denormals among them) counts as parallel to its slab: the
// ray is then inside that slab for all t or for none, so that 0/0 never arises for an origin on the slab's plane.
// Source: T. L. Kay and J. T. Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986.

// Narrows [t_enter, t_exit] to the slab lo <= origin + t direction <= hi of one axis.
KERNEL void box_clip_axis(F origin, F direction, F lo, F hi, INOUT(F) t_enter, INOUT(F) t_exit) {
  B parallel = abs(direction) < 1e-37f;
  B inside = both(lo <= origin, origin <= hi);
  F inverse = F(1.0f) / select(parallel, F(1.0f), direction);
  F a = (lo - origin) * inverse;
  F b = (hi - origin) * inverse;
  F never_enters = select(inside, F(-3e38f), F(3e38f));
  t_enter = max(t_enter, select(parallel, never_enters, min(a, b)));
  t_exit = min(t_exit, select(parallel, -never_enters, max(a, b)));
}

// Narrows the ray's interval [t_enter, t_exit] to the box [lo, hi]; true where something is left of it.
KERNEL B box_clip(vec3 origin, vec3 direction, vec3 lo, vec3 hi, INOUT(F) t_enter, INOUT(F) t_exit) {
  box_clip_axis(origin.x, direction.x, lo.x, hi.x, t_enter, t_exit);
  box_clip_axis(origin.y, direction.y, lo.y, hi.y, t_enter, t_exit);
  box_clip_axis(origin.z, direction.z, lo.z, hi.z, t_enter, t_exit);
  return t_enter <= t_exit;
}

// The part of a ray that lies in a box, as a ray of its own: t restarts at 0 at the entry, so that a distant origin
// costs digits once, in the entry's place, and not in every t along the way.
struct BoxSpan {
  vec3 entry;
  F t_enter;   // of the entry, on the ray as given
  F t_length;  // the span is [0, t_length] of entry + t direction; 0 for a ray that misses
};

// The span of [t_begin, t_end] in the box [lo, hi]. The entry lies in the box; rounding may leave the span's other end
// outside, by no more than one unit (a voxel, in index coordinates) however distant the origin. t_length is off by at
// most 1e-6 (|t_enter| + t_length), except where that bound of one unit cuts it. A ray that is not of finite numbers
// misses.
KERNEL BoxSpan box_span(vec3 origin, vec3 direction, vec3 lo, vec3 hi, F t_begin, F t_end) {
  BoxSpan s;
  F t_enter = t_begin;
  F t_exit = t_end;
  F magnitude = abs(origin.x) + abs(origin.y) + abs(origin.z) + abs(direction.x) + abs(direction.y) + abs(direction.z);
  B hit = both(box_clip(origin, direction, lo, hi, t_enter, t_exit), magnitude < 3e38f);
  s.t_enter = select(hit, t_enter, t_begin);
  s.entry = vec3(min(max(fma(s.t_enter, direction.x, origin.x), lo.x), hi.x),
                 min(max(fma(s.t_enter, direction.y, origin.y), lo.y), hi.y),
                 min(max(fma(s.t_enter, direction.z, origin.z), lo.z), hi.z));
  F begin = F(0.0f);
  F end = t_exit - s.t_enter;
  vec3 unit = vec3(F(1.0f), F(1.0f), F(1.0f));
  box_clip(s.entry, direction, lo - unit, hi + unit, begin, end);
  s.t_length = select(hit, max(end, F(0.0f)), F(0.0f));
  return s;
}
