// A compute shader that reaches every kernel function: what the build compiles to SPIR-V and validates (glslc drops
// what is not reached; a test looks for each name). Each invocation takes its arguments from `words` and writes what
// the kernels return to `results`.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer WordsBuffer { uint words[]; };
layout(std430, binding = 1) writeonly buffer ResultsBuffer { float results[]; };
layout(push_constant) uniform Arguments {
  uint table, bricks, table_x, table_xy, bits, majorants, majorant_row, majorant_layer;
  int phase_kind;
} arguments;

#include "kernel/dialect.glsl"
uint load_u32(uint array, uint index) { return words[array + index]; }
uint load_u32(uint array, int index) { return words[array + uint(index)]; }
void load_u32_pair(uint array, uint pair, out uint first, out uint second) {
  first = words[array + 2u * pair];
  second = words[array + 2u * pair + 1u];
}
#include "kernel/all.inl"
#include "kernel/phase_dispatch.glsl"

const uint result_count = 32;

void main() {
  uint id = gl_GlobalInvocationID.x;
  float u[12];
  for (uint i = 0; i < 12; ++i) u[i] = random_uniform(words[0], id, 0u, i);
  vec3 origin = vec3(u[0], u[1], u[2]), direction = vec3(u[3], u[4], u[5]);
  uint out_index = id * result_count;

  float sine, cosine;
  sincos_turns(u[6], sine, cosine);
  results[out_index + 0] = log_natural(u[6]);
  results[out_index + 1] = exp_natural(u[6]);
  results[out_index + 2] = sine;
  results[out_index + 3] = cosine;
  results[out_index + 4] = pow_positive(u[6], u[7]);
  results[out_index + 5] = mean_transmittance(u[6]);
  results[out_index + 6] = beer_lambert(u[6]);

  float t_enter = 0.0, t_exit = 1e30;
  bool hit = box_clip(origin, direction, vec3(0.25), vec3(0.75), t_enter, t_exit);
  results[out_index + 7] = hit ? t_enter : t_exit;

  BoxSpan span = box_span(origin, direction, vec3(0.25), vec3(0.75), 0.0, 1e30);
  results[out_index + 15] = span.t_enter;
  results[out_index + 16] = span.t_length;
  results[out_index + 27] = ball_span(origin, direction, 0.0, 1e30).t_length;

  Dda walk = dda_start(span.entry, direction);
  dda_step(walk);
  results[out_index + 8] = dda_cell_exit(walk);
  results[out_index + 9] = march_position(u[6], u[7], 3, 0.25, 0.5, u[8]);

  BrickGrid grid = BrickGrid(arguments.table, arguments.bricks, arguments.table_x, arguments.table_xy, arguments.bits);
  results[out_index + 10] = grid_nearest(grid, origin * 8.0);
  results[out_index + 11] = grid_linear(grid, origin * 8.0);
  results[out_index + 31] = select(grid_is_empty(grid, true, int(id), 0, 0), 1.0, 0.0);
  Cell cell = grid_cell(grid, 0, 0, 0);
  results[out_index + 12] = cell_mean_linear(cell, 0, 0, 0, origin, direction, 0.0, 0.1);

  vec4 p = vec4(u[8], u[9], u[10], u[11]);
  results[out_index + 13] = phase_eval(arguments.phase_kind, 2.0 * u[6] - 1.0, p);
  results[out_index + 14] = phase_sample(arguments.phase_kind, u[7], p);
  results[out_index + 17] = phase_mean_cosine(arguments.phase_kind, p);

  vec3 axis = normalize(origin);
  vec3 turned = aimed_direction(axis, u[6], u[7]) + direction_at_cosine(axis, u[6], u[7]);
  results[out_index + 24] = turned.x + turned.y + turned.z;
  results[out_index + 25] = aimed_density(axis, normalize(direction));
  results[out_index + 26] = aimed_strength(u[6], u[7], u[8]);
  results[out_index + 28] = cone_falloff(u[6], u[7], u[8]);
  float disk_x, disk_y;
  disk_point(u[6], u[7], disk_x, disk_y);
  results[out_index + 30] = disk_x + disk_y;

  uint first, second;
  sobol_pair(words[0], id & 63u, id >> 6, 16u, words[1], 0u, first, second);
  results[out_index + 18] = uniform_from_bits(first);
  results[out_index + 19] = uniform_from_bits(second);

  results[out_index + 20] = atan_turns(tan(u[6]));
  MajorantGrid majorants =
      MajorantGrid(arguments.majorants, arguments.majorant_row, arguments.majorant_layer, 0.25);
  MajorantWalk cells = majorant_start(majorants, origin * 8.0, direction);
  majorant_step(cells, true);
  results[out_index + 21] = majorant_cell_exit(cells);
  results[out_index + 22] = majorant_at(majorants, cells.cell);
  RandomWords r = random_words(words[0], id, 0u, 12u);
  results[out_index + 23] = grid_stochastic(grid, origin * 8.0, r.x, r.y);

  PlacedGrid placed;
  placed.grid = grid;
  for (int i = 0; i < 12; ++i) placed.to_own[i] = u[i];
  placed.lo = float[3](0.0, 0.0, 0.0);
  placed.hi = float[3](8.0, 8.0, 8.0);
  placed.linear = true;
  EmissionField field = EmissionField(true, true, placed, placed, u[0], 2000.0, arguments.majorants);
  vec3 emitted = emission_factor(field, origin * 8.0);
  results[out_index + 29] = emitted.x + emitted.y + emitted.z + emission_along_flights(u[0], u[1]);
}
