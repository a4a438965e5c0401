// Every kernel function behind one signature, so that one loop compares the builds: in[] and out[] hold its arguments
// and results, integers as the bits of a float. Included textually in the namespace of each build, as the kernel files
// are.

inline I call_int(F x) { return as_int(float_bits(x)); }
inline F call_result(I x) { return bits_float(as_uint(x)); }
inline vec3 call_vec3(const F* in) { return vec3(in[0], in[1], in[2]); }
inline BrickGrid call_grid(const TestGrid& g) { return {g.table, g.words, g.table_x, g.table_xy, g.bits}; }

inline void call_log_natural(const F* in, F* out, const TestGrid&) { out[0] = log_natural(in[0]); }
inline void call_exp_natural(const F* in, F* out, const TestGrid&) { out[0] = exp_natural(in[0]); }
inline void call_sincos_turns(const F* in, F* out, const TestGrid&) { sincos_turns(in[0], out[0], out[1]); }
inline void call_atan_turns(const F* in, F* out, const TestGrid&) { out[0] = atan_turns(in[0]); }
inline void call_pow_positive(const F* in, F* out, const TestGrid&) { out[0] = pow_positive(in[0], in[1]); }
inline void call_beer_lambert(const F* in, F* out, const TestGrid&) { out[0] = beer_lambert(in[0]); }
inline void call_mean_transmittance(const F* in, F* out, const TestGrid&) { out[0] = mean_transmittance(in[0]); }
inline void call_march_position(const F* in, F* out, const TestGrid&) {
  out[0] = march_position(in[0], in[1], call_int(in[2]), in[3], in[4], in[5]);
}
inline void call_random_bits(const F* in, F* out, const TestGrid&) {
  const U bits = random_bits(float_bits(in[0]), float_bits(in[1]), float_bits(in[2]), float_bits(in[3]));
  out[0] = bits_float(bits);
  out[1] = uniform_from_bits(bits);
}
inline void call_random_words(const F* in, F* out, const TestGrid&) {
  const RandomWords r = random_words(float_bits(in[0]), float_bits(in[1]), float_bits(in[2]), float_bits(in[3]));
  out[0] = bits_float(r.x);
  out[1] = bits_float(r.y);
  out[2] = bits_float(r.z);
  out[3] = bits_float(r.w);
}
inline void call_sobol_pair(const F* in, F* out, const TestGrid&) {
  U first, second;
  sobol_pair(float_bits(in[0]), float_bits(in[1]), float_bits(in[2]), float_bits(in[3]), float_bits(in[4]),
             float_bits(in[5]), first, second);
  out[0] = bits_float(first);
  out[1] = bits_float(second);
}
inline void call_box_clip(const F* in, F* out, const TestGrid&) {
  out[0] = in[12];
  out[1] = in[13];
  const B hit = box_clip(call_vec3(in), call_vec3(in + 3), call_vec3(in + 6), call_vec3(in + 9), out[0], out[1]);
  out[2] = select(hit, F(1.0f), F(0.0f));
}
inline void call_box_span(const F* in, F* out, const TestGrid&) {
  const BoxSpan s = box_span(call_vec3(in), call_vec3(in + 3), call_vec3(in + 6), call_vec3(in + 9), F(0.0f), F(1e30f));
  out[0] = s.entry.x;
  out[1] = s.entry.y;
  out[2] = s.entry.z;
  out[3] = s.t_enter;
  out[4] = s.t_length;
}
inline void call_ball_span(const F* in, F* out, const TestGrid&) {
  const BoxSpan s = ball_span(call_vec3(in), call_vec3(in + 3), F(0.0f), F(1e30f));
  out[0] = s.entry.x;
  out[1] = s.entry.y;
  out[2] = s.entry.z;
  out[3] = s.t_enter;
  out[4] = s.t_length;
}
// About the axis in[0..2], which is made a unit vector; in[3] and in[4] are in [0, 1).
inline void call_directions(const F* in, F* out, const TestGrid&) {
  const vec3 axis = normalize(call_vec3(in));
  const vec3 all[] = {direction_at_cosine(axis, 2.0f * in[3] - 1.0f, in[4]), aimed_direction(axis, in[3], in[4])};
  for (const vec3& direction : all) {
    *out++ = direction.x;
    *out++ = direction.y;
    *out++ = direction.z;
  }
}
inline void call_disk_point(const F* in, F* out, const TestGrid&) { disk_point(in[0], in[1], out[0], out[1]); }
inline void call_aimed_density(const F* in, F* out, const TestGrid&) {
  out[0] = aimed_density(normalize(call_vec3(in)), normalize(call_vec3(in + 3)));
}
inline void call_aimed_strength(const F* in, F* out, const TestGrid&) { out[0] = aimed_strength(in[0], in[1], in[2]); }
inline void call_cone_falloff(const F* in, F* out, const TestGrid&) { out[0] = cone_falloff(in[0], in[1], in[2]); }
// Twelve steps: the cells and where each is left.
inline void call_dda(const F* in, F* out, const TestGrid&) {
  Dda walk = dda_start(call_vec3(in), call_vec3(in + 3));
  for (int step = 0; step < 12; ++step) {
    *out++ = call_result(walk.cell_x);
    *out++ = call_result(walk.cell_y);
    *out++ = call_result(walk.cell_z);
    *out++ = dda_cell_exit(walk);
    dda_step(walk);
  }
}
// Eight steps: the cells, where each is left and its bound. The words of the test grid's bricks stand in for bounds.
inline void call_majorant_walk(const F* in, F* out, const TestGrid& g) {
  const MajorantGrid majorants = {g.words, 8u, 64u, 0.25f};
  MajorantWalk walk = majorant_start(majorants, call_vec3(in), call_vec3(in + 3));
  for (int step = 0; step < 8; ++step) {
    *out++ = call_result(walk.cell);
    *out++ = majorant_cell_exit(walk);
    const I cell = select(both(I(-1) < walk.cell, walk.cell < I(512)), walk.cell, I(0));
    *out++ = majorant_at(majorants, cell);
    majorant_step(walk, F(0.0f) < F(1.0f));
  }
}
inline void call_grid_stochastic(const F* in, F* out, const TestGrid& g) {
  out[0] = grid_stochastic(call_grid(g), call_vec3(in), float_bits(in[3]), float_bits(in[4]));
}
inline void call_grid_nearest(const F* in, F* out, const TestGrid& g) {
  out[0] = grid_nearest(call_grid(g), call_vec3(in));
}
inline void call_grid_linear(const F* in, F* out, const TestGrid& g) {
  out[0] = grid_linear(call_grid(g), call_vec3(in));
}
inline void call_grid_is_empty(const F* in, F* out, const TestGrid& g) {
  for (int linear = 0; linear < 2; ++linear) {
    const B empty =
        grid_is_empty(call_grid(g), linear == 1, floor_to_int(in[0]), floor_to_int(in[1]), floor_to_int(in[2]));
    out[linear] = select(empty, F(1.0f), F(0.0f));
  }
}
inline void call_cell_mean_linear(const F* in, F* out, const TestGrid& g) {
  const I x = floor_to_int(in[0]), y = floor_to_int(in[1]), z = floor_to_int(in[2]);
  const Cell cell = grid_cell(call_grid(g), x, y, z);
  out[0] = cell_mean_linear(cell, x, y, z, call_vec3(in), call_vec3(in + 3), F(0.0f), in[6]);
}
// With the grid, turned a little, as temperature and as strength.
inline void call_emission_factor(const F* in, F* out, const TestGrid& g) {
  const PlacedGrid placed = {
      call_grid(g), {0.9f, 0.1f, 0, 1, -0.1f, 0.9f, 0, 2, 0, 0, 1, -1}, {0, 0, 0}, {20, 17, 19}, true};
  const vec3 factor = emission_factor({true, true, placed, placed, 0.1f, 9000.0f, g.blackbody}, call_vec3(in));
  out[0] = factor.x;
  out[1] = factor.y;
  out[2] = factor.z;
}

inline void call_emission_along_flights(const F* in, F* out, const TestGrid&) {
  out[0] = emission_along_flights(in[0], 0.6f);
}

#define PHASE(name)                                                             \
  inline void call_##name##_eval(const F* in, F* out, const TestGrid&) {        \
    out[0] = name##_eval(in[0], vec4(in[1], in[2], in[3], in[4]));              \
  }                                                                             \
  inline void call_##name##_sample(const F* in, F* out, const TestGrid&) {      \
    out[0] = name##_sample(in[0], vec4(in[1], in[2], in[3], in[4]));            \
  }                                                                             \
  inline void call_##name##_mean_cosine(const F* in, F* out, const TestGrid&) { \
    out[0] = name##_mean_cosine(vec4(in[0], in[1], in[2], in[3]));              \
  }
#include "kernel/phase_list.inl"
#undef PHASE

struct KernelCall {
  const char* name;
  int inputs, outputs;
  void (*function)(const F* in, F* out, const TestGrid& grid);
};

#define CALL(name, inputs, outputs) \
  { #name, inputs, outputs, call_##name }
#define PHASE(name) CALL(name##_eval, 5, 1), CALL(name##_sample, 5, 1), CALL(name##_mean_cosine, 4, 1),
constexpr KernelCall kernel_calls[] = {
    CALL(log_natural, 1, 1),      CALL(exp_natural, 1, 1),
    CALL(sincos_turns, 1, 2),     CALL(pow_positive, 2, 1),
    CALL(beer_lambert, 1, 1),     CALL(mean_transmittance, 1, 1),
    CALL(march_position, 6, 1),   CALL(random_bits, 4, 2),
    CALL(box_clip, 14, 3),        CALL(box_span, 12, 5),
    CALL(directions, 5, 6),       CALL(aimed_density, 6, 1),
    CALL(aimed_strength, 3, 1),   CALL(dda, 6, 48),
    CALL(grid_nearest, 3, 1),     CALL(grid_linear, 3, 1),
    CALL(cell_mean_linear, 7, 1), CALL(sobol_pair, 6, 2),
    CALL(atan_turns, 1, 1),       CALL(random_words, 4, 4),
    CALL(majorant_walk, 6, 24),   CALL(grid_stochastic, 5, 1),
    CALL(ball_span, 6, 5),        CALL(cone_falloff, 3, 1),
    CALL(emission_factor, 3, 3),  CALL(emission_along_flights, 1, 1),
    CALL(grid_is_empty, 3, 2),    CALL(disk_point, 2, 2),
#include "kernel/phase_list.inl"
};
#undef PHASE
#undef CALL
