// Density look-up in a brick grid: which brick, which word, which bits.
// Index coordinates: voxel (i, j, k) is the cube [i, i+1] x ..., its value sits at the centre i + 1/2. Outside the
// array the value is 0. Bricks are 8^3 voxels, x fastest; the table of bricks has a border of one empty brick on every
// side, so that indices in [-8, n + 7] need no bounds test; callers clip their rays to the grid's bounds, which lie
// within. A brick is its 512 values, packed: value = offset + scale * q for 8- and 16-bit q (error at most scale / 2),
// or the float itself. Offset and scale are floats of 16 bits (the upper halves of theirs), beside the brick's place in
// the table: one gather of 64 bits fetches all of a brick that a look-up needs to know. An empty brick whose neighbours
// on the upper sides are empty too has a scale of -0 (0x8000): all that is interpolated from there is 0.
// Bordered bricks are for those who look up all eight corners of a cell: 9^3 values, the last along each axis being
// those of the neighbours on the upper sides, so that all corners are in one brick. Five gathers do in place of
// sixteen, for 42 % more memory.

struct BrickGrid {
  Words table;  // two words for each brick: its first word in `bricks`, and offset (upper half) with scale (lower
                // half); the brick at 0 is the shared empty one
  Words bricks;
  uint table_x;   // bricks along x, border included: the table's row
  uint table_xy;  // bricks in a layer, border included
  uint bits;      // 8, 16 or 32 a voxel
  uint bordered;  // 0 or 1
};

// The eight values at a dual cell's corners: v011 is the one at (x, y + 1, z + 1).
struct Cell {
  F v000, v100, v010, v110, v001, v101, v011, v111;
};

// A brick in the table.
struct Brick {
  U first_word;
  U steps;  // offset and scale
};

// Where a voxel's value is, and how it is read there.
struct VoxelPlace {
  U word;   // its index in `bricks`
  U shift;  // of the value's bits in the word
  U steps;  // the brick's offset and scale
};

// The brick that holds voxel (x, y, z).
KERNEL Brick grid_brick(BrickGrid g, I x, I y, I z) {
  U bx = as_uint(x + 8) >> 3;
  U by = as_uint(y + 8) >> 3;
  U bz = as_uint(z + 8) >> 3;
  Brick brick;
  load_u32_pair(g.table, (bz * U(g.table_xy) + by * U(g.table_x) + bx) << 1, brick.first_word, brick.steps);
  return brick;
}

// Whether every look-up in the brick is 0; with linear interpolation, in the same brick of dual cells.
KERNEL B brick_is_empty(Brick brick, bool linear) {
  return as_int(linear ? brick.first_word | (brick.steps ^ U(0x8000u)) : brick.first_word) == I(0);
}

// Where voxel number `voxel` of a brick is.
KERNEL VoxelPlace brick_place(BrickGrid g, Brick brick, U voxel) {
  VoxelPlace place;
  place.word = brick.first_word;
  place.steps = brick.steps;
  if (g.bits == 32u) {
    place.word = place.word + voxel;
    place.shift = U(0u);
  } else if (g.bits == 16u) {
    place.word = place.word + (voxel >> 1);
    place.shift = (voxel & 1u) << 4;
  } else {
    place.word = place.word + (voxel >> 2);
    place.shift = (voxel & 3u) << 3;
  }
  return place;
}

// The number that voxel (x, y, z) has in its brick: x + 8 y + 64 z, or x + 9 (y + 9 z).
KERNEL U plain_voxel(I x, I y, I z) { return as_uint((x & 7) | ((y & 7) << 3) | ((z & 7) << 6)); }
KERNEL U bordered_voxel(I x, I y, I z) {
  I layer = z & 7;
  I row = (y & 7) + layer + (layer << 3);
  return as_uint((x & 7) + row + (row << 3));
}

KERNEL VoxelPlace grid_place(BrickGrid g, I x, I y, I z) {
  U voxel = g.bordered != 0u ? bordered_voxel(x, y, z) : plain_voxel(x, y, z);
  return brick_place(g, grid_brick(g, x, y, z), voxel);
}

// The value of level q.
KERNEL F level_value(U q, U steps) {
  return fma(to_float(as_int(q)), bits_float(steps << 16), bits_float(steps & 0xffff0000u));
}

KERNEL F grid_value(BrickGrid g, VoxelPlace place) {
  U word = load_u32(g.bricks, place.word);
  if (g.bits == 32u) return bits_float(word);
  U q = shift_right_by(word, place.shift) & U(g.bits == 16u ? 0xffffu : 0xffu);
  return level_value(q, place.steps);
}

// The value of voxel (x, y, z).
KERNEL F grid_voxel(BrickGrid g, I x, I y, I z) { return grid_value(g, grid_place(g, x, y, z)); }

// The voxel that holds p_index.
KERNEL VoxelPlace grid_nearest_place(BrickGrid g, vec3 p_index) {
  return grid_place(g, floor_to_int(p_index.x), floor_to_int(p_index.y), floor_to_int(p_index.z));
}

// The value of the voxel that holds p_index.
KERNEL F grid_nearest(BrickGrid g, vec3 p_index) { return grid_value(g, grid_nearest_place(g, p_index)); }

// The values of voxel number `voxel` of a brick and of the next, which are in the same word or in two that follow each
// other.
KERNEL void brick_two_values(BrickGrid g, Brick brick, U voxel, INOUT(F) value, INOUT(F) next_value) {
  VoxelPlace place = brick_place(g, brick, voxel);
  U word;
  U next_word;
  load_u32_pair(g.bricks, place.word, word, next_word);
  if (g.bits == 32u) {
    value = bits_float(word);
    next_value = bits_float(next_word);
  } else {
    U levels = U(g.bits == 16u ? 0xffffu : 0xffu);
    U next_shift = (place.shift + U(g.bits)) & 31u;
    next_word = select(as_int(next_shift) == I(0), next_word, word);
    value = level_value(shift_right_by(word, place.shift) & levels, place.steps);
    next_value = level_value(shift_right_by(next_word, next_shift) & levels, place.steps);
  }
}

// The corners of dual cell (x, y, z), which spans the centres of voxels x and x + 1, and so on; `brick` holds voxel
// (x, y, z).
KERNEL Cell brick_cell(BrickGrid g, Brick brick, I x, I y, I z) {
  Cell c;
  if (g.bordered != 0u) {
    U voxel = bordered_voxel(x, y, z);
    brick_two_values(g, brick, voxel, c.v000, c.v100);
    brick_two_values(g, brick, voxel + U(9u), c.v010, c.v110);
    brick_two_values(g, brick, voxel + U(81u), c.v001, c.v101);
    brick_two_values(g, brick, voxel + U(90u), c.v011, c.v111);
  } else {
    c.v000 = grid_value(g, brick_place(g, brick, plain_voxel(x, y, z)));
    c.v100 = grid_voxel(g, x + 1, y, z);
    c.v010 = grid_voxel(g, x, y + 1, z);
    c.v110 = grid_voxel(g, x + 1, y + 1, z);
    c.v001 = grid_voxel(g, x, y, z + 1);
    c.v101 = grid_voxel(g, x + 1, y, z + 1);
    c.v011 = grid_voxel(g, x, y + 1, z + 1);
    c.v111 = grid_voxel(g, x + 1, y + 1, z + 1);
  }
  return c;
}

KERNEL Cell grid_cell(BrickGrid g, I x, I y, I z) { return brick_cell(g, grid_brick(g, x, y, z), x, y, z); }

KERNEL F cell_mix(F a, F b, F f) { return fma(b - a, f, a); }

// The trilinear interpolant within a cell, at fractions fx, fy, fz in [0, 1].
KERNEL F cell_linear(Cell c, F fx, F fy, F fz) {
  F y0 = cell_mix(cell_mix(c.v000, c.v100, fx), cell_mix(c.v010, c.v110, fx), fy);
  F y1 = cell_mix(cell_mix(c.v001, c.v101, fx), cell_mix(c.v011, c.v111, fx), fy);
  return cell_mix(y0, y1, fz);
}

// The trilinear interpolant of the eight values around p_index.
KERNEL F grid_linear(BrickGrid g, vec3 p_index) {
  F x = p_index.x - 0.5f;
  F y = p_index.y - 0.5f;
  F z = p_index.z - 0.5f;
  I ix = floor_to_int(x);
  I iy = floor_to_int(y);
  I iz = floor_to_int(z);
  Cell c = grid_cell(g, ix, iy, iz);
  return cell_linear(c, x - to_float(ix), y - to_float(iy), z - to_float(iz));
}

// The mean of the trilinear interpolant over t in [t_begin, t_end] of the ray origin + t direction, all of which lies
// in dual cell (x, y, z); p's are index coordinates less one half. Exact: the interpolant is a cubic in t there, which
// two-point Gauss-Legendre quadrature integrates without error.
KERNEL F cell_mean_linear(Cell c, I x, I y, I z, vec3 dual_origin, vec3 direction, F t_begin, F t_end) {
  F middle = 0.5f * (t_begin + t_end);
  F half_width = 0.28867513459f * (t_end - t_begin);  // 1 / (2 sqrt 3)
  F ta = middle - half_width;
  F tb = middle + half_width;
  F ox = dual_origin.x - to_float(x);
  F oy = dual_origin.y - to_float(y);
  F oz = dual_origin.z - to_float(z);
  F a = cell_linear(c, fma(ta, direction.x, ox), fma(ta, direction.y, oy), fma(ta, direction.z, oz));
  F b = cell_linear(c, fma(tb, direction.x, ox), fma(tb, direction.y, oy), fma(tb, direction.z, oz));
  return 0.5f * (a + b);
}
