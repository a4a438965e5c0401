// Directions about an axis, and directions aimed at a point light.
//
// A flight through a homogeneous medium gathers light of a point light in proportion to about 1 / (r sin alpha): alpha
// is the angle between the flight and the way to the light, r the distance of the light from where the flight starts,
// so that r sin alpha is how near it passes the light. A flight whose alpha is uniform over [0, pi] gathers about as
// much in every direction; its density is 1 / (2 pi^2 sin alpha) per steradian. Exact.
// Source: T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017; I. Georgiev et al., "Joint
// Importance Sampling of Low-Order Volumetric Scattering", TOG 32(6), 2013, section 4.

// The unit vector at an angle to the unit vector `axis` of which sine and cosine are given, `turns` (of 2 pi) around
// it.
KERNEL vec3 direction_about(vec3 axis, F sine, F cosine, F turns) {
  F s;
  F c;
  sincos_turns(turns, s, c);
  F x = sine * c;
  F y = sine * s;
  F sign = select(axis.z < 0.0f, F(-1.0f), F(1.0f));
  F a = F(-1.0f) / (sign + axis.z);
  F b = axis.x * axis.y * a;
  vec3 x_axis = vec3(fma(sign * axis.x, axis.x * a, F(1.0f)), sign * b, -(sign * axis.x));
  vec3 y_axis = vec3(b, fma(axis.y, axis.y * a, sign), -axis.y);
  return normalize(x * x_axis + y * y_axis + cosine * axis);
}

// The same for a cosine in [-1, 1] alone.
KERNEL vec3 direction_at_cosine(vec3 axis, F cosine, F turns) {
  return direction_about(axis, sqrt(max(1.0f - cosine * cosine, F(0.0f))), cosine, turns);
}

// A direction aimed at the light in the direction `to_light`, for u and turns in [0, 1).
KERNEL vec3 aimed_direction(vec3 to_light, F u, F turns) {
  F sine;
  F cosine;
  sincos_turns(0.5f * u, sine, cosine);
  return direction_about(to_light, sine, cosine, turns);
}

// The density of aimed directions, per steradian; `to_light` and `direction` are unit vectors.
KERNEL F aimed_density(vec3 to_light, vec3 direction) {
  return F(0.050660592f) / max(length(cross(to_light, direction)), F(1e-6f));
}

// How much of a light's light flights gather at the distance r from it, as against everything else: `strength` is that
// for directions spread evenly and r = 1, `density` that of the directions about the way to the light, per steradian.
KERNEL F aimed_strength(F strength, F r, F density) { return strength * (density * 12.566371f) / r; }
