// log, exp, sine and cosine as polynomials, so that the scalar, SIMD and GLSL builds compute the same thing.
// Errors against the exact value, with fused multiply-adds or without, tested in tests/kernel: log_natural 1 ulp;
// exp_natural 1.1 ulp on [-87.3, 88], exactly 0 below; sincos_turns 1.2e-7 absolute.
// Source: minimax coefficients of Cephes' logf and expf (S. L. Moshier, 1989) and, for sine and cosine, sinf, cosf.

// Natural logarithm of x, for normal x > 0 (x = 0 gives about -88, nothing faults).
// x = m 2^e with m in [sqrt(1/2), sqrt(2)); ln x = ln m + e ln 2, ln m = r - r^2/2 + r^3 P(r), r = m - 1.
KERNEL F log_natural(F x) {
  U bits = float_bits(x) - 0x3f3504f3u;  // bits of sqrt(1/2): the exponent's step falls there
  I exponent = as_int(bits) >> 23;
  F m = bits_float((bits & 0x007fffffu) + 0x3f3504f3u);
  F r = m - 1.0f;
  F e = to_float(exponent);
  F p = fma(r, 7.0376836292e-2f, -1.1514610310e-1f);
  p = fma(p, r, 1.1676998740e-1f);
  p = fma(p, r, -1.2420140846e-1f);
  p = fma(p, r, 1.4249322787e-1f);
  p = fma(p, r, -1.6668057665e-1f);
  p = fma(p, r, 2.0000714765e-1f);
  p = fma(p, r, -2.4999993993e-1f);
  p = fma(p, r, 3.3333331174e-1f);
  F r2 = r * r;
  F y = p * r * r2;
  y = fma(e, -2.12194440e-4f, y);  // ln 2 = 0.693359375 - 2.12194440e-4
  y = fma(r2, -0.5f, y);
  return fma(e, 0.693359375f, r + y);
}

// e^x; 0 below -87.3, clamped at e^88 above 88.
// x = n ln 2 + r, |r| <= ln 2 / 2; e^x = 2^n (1 + r + r^2 P(r)).
KERNEL F exp_natural(F x) {
  F clamped = min(max(x, -87.3f), 88.0f);
  I n = round_to_int(clamped * 1.44269504088896341f);
  F nf = to_float(n);
  F r = fma(nf, -0.693359375f, clamped);
  r = fma(nf, 2.12194440e-4f, r);
  F p = fma(r, 1.9875691500e-4f, 1.3981999507e-3f);
  p = fma(p, r, 8.3334519073e-3f);
  p = fma(p, r, 4.1665795894e-2f);
  p = fma(p, r, 1.6666665459e-1f);
  p = fma(p, r, 5.0000001201e-1f);
  F y = fma(p, r * r, r) + 1.0f;
  F scale = bits_float(as_uint(n + 127) << 23);
  return select(x < -87.3f, 0.0f, y * scale);
}

// sine and cosine of 2 pi u, for |u| < 1e5. In turns the reduction to a quarter turn is exact.
KERNEL void sincos_turns(F u, INOUT(F) sine, INOUT(F) cosine) {
  F quarters = u * 4.0f;
  I k = round_to_int(quarters);
  F a = (quarters - to_float(k)) * 1.57079632679489662f;
  F a2 = a * a;
  F s = fma(a2, -1.9515295891e-4f, 8.3321608736e-3f);
  s = fma(s, a2, -1.6666654611e-1f);
  s = fma(s * a2, a, a);
  F c = fma(a2, 2.443315711809948e-5f, -1.388731625493765e-3f);
  c = fma(c, a2, 4.166664568298827e-2f);
  c = fma(c, a2 * a2, fma(a2, -0.5f, 1.0f));
  B odd = (k & 1) == 1;
  F s_k = select(odd, c, s);
  F c_k = select(odd, s, c);
  sine = select((k & 2) == 2, -s_k, s_k);
  cosine = select(((k + 1) & 2) == 2, -c_k, c_k);
}

// The angle whose tangent is x, in turns (of 2 pi), in (-1/4, 1/4): relative error below 3e-7. tan(a - pi/4) and
// tan(a - pi/2) bring the tangent below tan(pi/8).
// Source: Cephes' atanf.
KERNEL F atan_turns(F x) {
  F a = abs(x);
  B large = a > 2.414213562373095f;
  B middle = both(a > 0.4142135623730950f, negate(large));
  F y = select(large, F(-1.0f) / max(a, F(1.0f)), select(middle, (a - 1.0f) / (a + 1.0f), a));
  F z = y * y;
  F p = fma(z, 8.05374449538e-2f, -1.38776856032e-1f);
  p = fma(p, z, 1.99777106478e-1f);
  p = fma(p, z, -3.33329491539e-1f);
  F angle = fma(p * z, y, y) * 0.159154943091895f + select(large, F(0.25f), select(middle, F(0.125f), F(0.0f)));
  return select(x < 0.0f, -angle, angle);
}

// x^y for x > 0, as e^(y ln x): relative error below 1.3e-7 (1 + |y ln x|), for |y ln x| < 87.
KERNEL F pow_positive(F x, F y) { return exp_natural(y * log_natural(x)); }
