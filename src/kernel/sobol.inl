// Owen-scrambled Sobol' points in pairs of dimensions, with the pixels in an order that spreads the error over the
// picture like blue noise. All pixels of a tile of 64 x 64 share one scrambled (0,2)-sequence for each pair; a pixel
// takes `samples` consecutive points of it, and pixels that are near each other take stretches that are near each
// other, so that 2 x 2, 4 x 4, ... pixels together hold a whole net too, and their errors cancel. The order of the
// pixels and the order of the points within a pixel are shuffled for each pair on its own, which pads pairs to more
// dimensions.
//
// Every 2^k consecutive points of a pixel that start at a multiple of 2^k, k <= log2(samples), are a (0,k,2)-net in
// base 2: each box of area 2^-k of any dyadic shape holds one point. A point is a function of its counters alone, so
// any part of a pixel's samples can be taken in any order. Unbiased: each point on its own is uniform. Sources: I. M.
// Sobol', USSR Comp. Math. and Math. Phys. 7(4), 1967; A. B. Owen, "Randomly Permuted (t,m,s)-Nets and
// (t,s)-Sequences", 1995; B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020; A. Ahmed and P. Wonka,
// "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels", TOG 39(6),
// 2020.

// An integer hash, a bijection. Source: C. Wellons, "Prospecting for Hash Functions", 2018.
KERNEL U hash_word(U x) {
  x = x ^ (x >> 16);
  x = x * 0x7feb352du;
  x = x ^ (x >> 15);
  x = x * 0x846ca68bu;
  return x ^ (x >> 16);
}

KERNEL U reverse_bits(U x) {
  x = (x >> 16) | (x << 16);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

// A nested uniform (Owen) scrambling in base 2 of a word with its bits reversed: a bijection in which a bit decides
// over those above it alone. Source: the hash of S. Laine and T. Karras, "Stratified Sampling for Stochastic
// Transparency", EGSR 2011, in the form of N. Vegdahl, "Building a Better LK Hash", 2021.
KERNEL U owen_reversed(U x, U key) {
  x = x ^ (x * 0x3d20adeau);
  x = x + key;
  x = x * ((key >> 16) | 1u);
  x = x ^ (x * 0x05526c56u);
  return x ^ (x * 0x53a22864u);
}

// The second dimension of the Sobol' sequence, with its bits reversed (the first is `index` itself). Bit r of the
// result is the sum modulo 2 of the bits j of the index with odd C(j, r), that is of those whose number j holds all
// bits of r.
KERNEL U sobol_second_reversed(U index) {
  index = index ^ ((index >> 1) & 0x55555555u);
  index = index ^ ((index >> 2) & 0x33333333u);
  index = index ^ ((index >> 4) & 0x0f0f0f0fu);
  index = index ^ ((index >> 8) & 0x00ff00ffu);
  return index ^ (index >> 16);
}

// Bits 0 to 5 of x, moved to the even places.
KERNEL U spread_bits(U x) {
  x = x & 63u;
  x = (x | (x << 4)) & 0x30fu;
  x = (x | (x << 2)) & 0x333u;
  return (x | (x << 1)) & 0x555u;
}

// A digit in base 4 under one of its 24 permutations, drawn by 32 random bits: the affine maps of pairs of bits. The
// six invertible matrices are written as their two columns, two bits each.
KERNEL U permute_digit(U digit, U random) {
  U matrix = shift_right_by(U(0xb7e6d9u), (((random & 0xffffu) * 6u) >> 16) << 2);
  U columns = ((matrix & 3u) * (digit & 1u)) ^ (((matrix >> 2) & 3u) * (digit >> 1));
  return columns ^ (random >> 30);
}

// Where the pixels of a tile stand in the shared sequence: their Morton numbers (with a 1 in front, so that prefixes of
// different lengths differ), each digit permuted by a hash of the digits above it. 0 to 4095.
KERNEL U pixel_order(U morton, U key) {
  U order = U(0u);
  for (int shift = 10; shift >= 0; shift -= 2) {
    U above = morton >> (shift + 2);
    order = (order << 2) | permute_digit((morton >> shift) & 3u, hash_word(above ^ key));
  }
  return order;
}

// Pair number `pair` of point `index` of pixel (x, y), as 32-bit fractions, for the stream `seed`. `samples`, a power
// of two up to 2^20, is the number of points that a pixel has of the shared sequence; higher indices start others.
KERNEL void sobol_pair(U seed, U x, U y, U samples, U index, U pair, INOUT(U) first, INOUT(U) second) {
  U in_pixel = index & (samples - 1u);
  U tile = (x >> 6) | ((y >> 6) << 16);
  U key = random_bits(seed, tile, index - in_pixel, pair);
  U morton = spread_bits(x) | (spread_bits(y) << 1) | 4096u;
  U order = pixel_order(morton, key);
  U shuffled = reverse_bits(owen_reversed(reverse_bits(in_pixel), hash_word(morton ^ key)));
  U point = order * samples + (shuffled & (samples - 1u));
  first = reverse_bits(owen_reversed(point, hash_word(key ^ 0x68bc21ebu)));
  second = reverse_bits(owen_reversed(sobol_second_reversed(point), hash_word(key ^ 0x02e5be93u)));
}
