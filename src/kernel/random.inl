// The random stream: a number is a function of (seed, pixel, sample, dimension), so a picture is a function of its
// seed for any order of work. A caller counts dimensions up.
// Source: pcg4d of M. Jarzynski and M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.

struct RandomWords {
  U x, y, z, w;
};

// Four words of random bits for the counter (pixel, index of the sample, dimension) of the stream `seed`.
KERNEL RandomWords random_words(U seed, U pixel, U index, U dimension) {
  RandomWords r;
  r.x = seed * 1664525u + 1013904223u;
  r.y = pixel * 1664525u + 1013904223u;
  r.z = index * 1664525u + 1013904223u;
  r.w = dimension * 1664525u + 1013904223u;
  r.x = r.x + r.y * r.w;
  r.y = r.y + r.z * r.x;
  r.z = r.z + r.x * r.y;
  r.w = r.w + r.y * r.z;
  r.x = r.x ^ (r.x >> 16);
  r.y = r.y ^ (r.y >> 16);
  r.z = r.z ^ (r.z >> 16);
  r.w = r.w ^ (r.w >> 16);
  r.x = r.x + r.y * r.w;
  r.y = r.y + r.z * r.x;
  r.z = r.z + r.x * r.y;
  r.w = r.w + r.y * r.z;
  r.x = r.x ^ (r.x >> 16);
  r.y = r.y ^ (r.y >> 16);
  r.z = r.z ^ (r.z >> 16);
  r.w = r.w ^ (r.w >> 16);
  return r;
}

// 32 random bits for the same counter.
KERNEL U random_bits(U seed, U pixel, U index, U dimension) { return random_words(seed, pixel, index, dimension).w; }

// A number in [0, 1), a multiple of 2^-24, from the top bits of a word.
KERNEL F uniform_from_bits(U bits) { return to_float(as_int(bits >> 8)) * 5.9604644775390625e-8f; }

// A number in [0, 1) for the counter (pixel, index of the sample, dimension) of the stream `seed`.
KERNEL F random_uniform(U seed, U pixel, U index, U dimension) {
  return uniform_from_bits(random_bits(seed, pixel, index, dimension));
}
