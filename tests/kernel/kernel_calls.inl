// Every kernel function behind one signature, so that one loop compares the builds: a[] holds its arguments and r[]
// takes its results, integers as the bits of a float. Included textually in each build, as the kernel files are, after
// macros of the build's own: KERNEL_CALL(name) begins the function call_name, which has a, r and a test grid, `grid`,
// in its scope; EVAL, SAMPLE and MEAN_COSINE call a phase function.

#define VEC3(i) vec3(a[i], a[i + 1], a[i + 2])
#define VEC4(i) vec4(a[i], a[i + 1], a[i + 2], a[i + 3])

KERNEL I call_int(F x) { return as_int(float_bits(x)); }
KERNEL F call_result(I x) { return bits_float(as_uint(x)); }
KERNEL BrickGrid call_grid(TestGrid words) {
  BrickGrid g;
  g.table = words.table;
  g.bricks = words.bricks;
  g.table_x = words.table_x;
  g.table_xy = words.table_xy;
  g.bits = words.bits;
  g.bordered = words.bordered;
  return g;
}

KERNEL_CALL(log_natural) { r[0] = log_natural(a[0]); }
KERNEL_CALL(exp_natural) { r[0] = exp_natural(a[0]); }
KERNEL_CALL(sincos_turns) { sincos_turns(a[0], r[0], r[1]); }
KERNEL_CALL(atan_turns) { r[0] = atan_turns(a[0]); }
KERNEL_CALL(pow_positive) { r[0] = pow_positive(a[0], a[1]); }
KERNEL_CALL(beer_lambert) { r[0] = beer_lambert(a[0]); }
KERNEL_CALL(mean_transmittance) { r[0] = mean_transmittance(a[0]); }
KERNEL_CALL(march_position) { r[0] = march_position(a[0], a[1], call_int(a[2]), a[3], a[4], a[5]); }
KERNEL_CALL(random_bits) {
  r[0] = bits_float(random_bits(float_bits(a[0]), float_bits(a[1]), float_bits(a[2]), float_bits(a[3])));
  r[1] = random_uniform(float_bits(a[0]), float_bits(a[1]), float_bits(a[2]), float_bits(a[3]));
}
KERNEL_CALL(random_words) {
  RandomWords four = random_words(float_bits(a[0]), float_bits(a[1]), float_bits(a[2]), float_bits(a[3]));
  r[0] = bits_float(four.x);
  r[1] = bits_float(four.y);
  r[2] = bits_float(four.z);
  r[3] = bits_float(four.w);
}
KERNEL_CALL(sobol_pair) {
  U first;
  U second;
  sobol_pair(float_bits(a[0]), float_bits(a[1]), float_bits(a[2]), float_bits(a[3]), float_bits(a[4]), float_bits(a[5]),
             first, second);
  r[0] = bits_float(first);
  r[1] = bits_float(second);
}
KERNEL_CALL(box_clip) {
  r[0] = a[12];
  r[1] = a[13];
  B hit = box_clip(VEC3(0), VEC3(3), VEC3(6), VEC3(9), r[0], r[1]);
  r[2] = select(hit, F(1.0f), F(0.0f));
}
KERNEL_CALL(box_span) {
  BoxSpan s = box_span(VEC3(0), VEC3(3), VEC3(6), VEC3(9), F(0.0f), F(1e30f));
  r[0] = s.entry.x;
  r[1] = s.entry.y;
  r[2] = s.entry.z;
  r[3] = s.t_enter;
  r[4] = s.t_length;
}
KERNEL_CALL(ball_span) {
  BoxSpan s = ball_span(VEC3(0), VEC3(3), F(0.0f), F(1e30f));
  r[0] = s.entry.x;
  r[1] = s.entry.y;
  r[2] = s.entry.z;
  r[3] = s.t_enter;
  r[4] = s.t_length;
}
// About the axis a[0..2], which is made a unit vector; a[3] and a[4] are in [0, 1).
KERNEL_CALL(directions) {
  vec3 axis = normalize(VEC3(0));
  vec3 turned = direction_at_cosine(axis, 2.0f * a[3] - 1.0f, a[4]);
  r[0] = turned.x;
  r[1] = turned.y;
  r[2] = turned.z;
  turned = aimed_direction(axis, a[3], a[4]);
  r[3] = turned.x;
  r[4] = turned.y;
  r[5] = turned.z;
}
KERNEL_CALL(disk_point) { disk_point(a[0], a[1], r[0], r[1]); }
KERNEL_CALL(aimed_density) { r[0] = aimed_density(normalize(VEC3(0)), normalize(VEC3(3))); }
KERNEL_CALL(aimed_strength) { r[0] = aimed_strength(a[0], a[1], a[2]); }
KERNEL_CALL(cone_falloff) { r[0] = cone_falloff(a[0], a[1], a[2]); }
// Twelve steps: the cells and where each is left.
KERNEL_CALL(dda) {
  Dda walk = dda_start(VEC3(0), VEC3(3));
  for (int step = 0; step < 12; ++step) {
    r[4 * step] = call_result(walk.cell_x);
    r[4 * step + 1] = call_result(walk.cell_y);
    r[4 * step + 2] = call_result(walk.cell_z);
    r[4 * step + 3] = dda_cell_exit(walk);
    dda_step(walk);
  }
}
// Eight steps: the cells, where each is left and its bound. The words of the test grid's bricks stand in for bounds.
KERNEL_CALL(majorant_walk) {
  MajorantGrid majorants;
  majorants.cells = grid.bricks;
  majorants.row = 8u;
  majorants.layer = 64u;
  majorants.cells_per_voxel = 0.25f;
  MajorantWalk walk = majorant_start(majorants, VEC3(0), VEC3(3));
  for (int step = 0; step < 8; ++step) {
    r[3 * step] = call_result(walk.cell);
    r[3 * step + 1] = majorant_cell_exit(walk);
    I cell = select(both(I(-1) < walk.cell, walk.cell < I(512)), walk.cell, I(0));
    r[3 * step + 2] = majorant_at(majorants, cell);
    majorant_step(walk, F(0.0f) < F(1.0f));
  }
}
KERNEL_CALL(grid_stochastic) { r[0] = grid_stochastic(call_grid(grid), VEC3(0), float_bits(a[3]), float_bits(a[4])); }
KERNEL_CALL(grid_nearest) { r[0] = grid_nearest(call_grid(grid), VEC3(0)); }
KERNEL_CALL(grid_linear) { r[0] = grid_linear(call_grid(grid), VEC3(0)); }
KERNEL_CALL(brick_is_empty) {
  I x = floor_to_int(a[0]);
  I y = floor_to_int(a[1]);
  I z = floor_to_int(a[2]);
  Brick brick = grid_brick(call_grid(grid), x, y, z);
  r[0] = select(brick_is_empty(brick, false), F(1.0f), F(0.0f));
  r[1] = select(brick_is_empty(brick, true), F(1.0f), F(0.0f));
}
KERNEL_CALL(cell_mean_linear) {
  I x = floor_to_int(a[0]);
  I y = floor_to_int(a[1]);
  I z = floor_to_int(a[2]);
  r[0] = cell_mean_linear(grid_cell(call_grid(grid), x, y, z), x, y, z, VEC3(0), VEC3(3), F(0.0f), a[6]);
}
// With the grid, turned a little, as temperature and as strength.
KERNEL_CALL(emission_factor) {
  PlacedGrid placed;
  placed.grid = call_grid(grid);
  for (int i = 0; i < 12; ++i) placed.to_own[i] = 0.0f;
  placed.to_own[0] = 0.9f;
  placed.to_own[1] = 0.1f;
  placed.to_own[3] = 1.0f;
  placed.to_own[4] = -0.1f;
  placed.to_own[5] = 0.9f;
  placed.to_own[7] = 2.0f;
  placed.to_own[10] = 1.0f;
  placed.to_own[11] = -1.0f;
  for (int i = 0; i < 3; ++i) placed.lo[i] = 0.0f;
  placed.hi[0] = 20.0f;
  placed.hi[1] = 17.0f;
  placed.hi[2] = 19.0f;
  placed.linear = true;
  EmissionField field;
  field.has_temperature = true;
  field.has_strength = true;
  field.temperature = placed;
  field.strength = placed;
  field.offset = 0.1f;
  field.scale = 9000.0f;
  field.blackbody = grid.blackbody;
  vec3 factor = emission_factor(field, VEC3(0));
  r[0] = factor.x;
  r[1] = factor.y;
  r[2] = factor.z;
}
KERNEL_CALL(emission_along_flights) { r[0] = emission_along_flights(a[0], 0.6f); }

#define PHASE(name)                                                  \
  KERNEL_CALL(name##_eval) { r[0] = EVAL(name, a[0], VEC4(1)); }     \
  KERNEL_CALL(name##_sample) { r[0] = SAMPLE(name, a[0], VEC4(1)); } \
  KERNEL_CALL(name##_mean_cosine) { r[0] = MEAN_COSINE(name, VEC4(0)); }
#include "kernel/phase_list.inl"
#undef PHASE

#undef VEC3
#undef VEC4
