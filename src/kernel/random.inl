// The random stream: a number is a function of (seed, pixel, sample, dimension), so a picture is a function of its
// seed for any order of work. One call gives one number; a caller counts dimensions up.
// Source: pcg4d of M. Jarzynski and M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.

// 32 random bits for the counter (pixel, index of the sample, dimension) of the stream `seed`.
KERNEL U random_bits(U seed, U pixel, U index, U dimension) {
  U x = seed * 1664525u + 1013904223u;
  U y = pixel * 1664525u + 1013904223u;
  U z = index * 1664525u + 1013904223u;
  U w = dimension * 1664525u + 1013904223u;
  x = x + y * w;
  y = y + z * x;
  z = z + x * y;
  w = w + y * z;
  x = x ^ (x >> 16);
  y = y ^ (y >> 16);
  z = z ^ (z >> 16);
  w = w ^ (w >> 16);
  x = x + y * w;
  y = y + z * x;
  z = z + x * y;
  w = w + y * z;
  return w ^ (w >> 16);
}

// A number in [0, 1), a multiple of 2^-24, from the top bits of a word.
KERNEL F uniform_from_bits(U bits) { return to_float(as_int(bits >> 8)) * 5.9604644775390625e-8f; }

// A number in [0, 1) for the counter (pixel, index of the sample, dimension) of the stream `seed`.
KERNEL F random_uniform(U seed, U pixel, U index, U dimension) {
  return uniform_from_bits(random_bits(seed, pixel, index, dimension));
}
