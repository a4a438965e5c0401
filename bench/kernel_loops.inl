// The loops that bench/kernels.cpp times, written once: included textually in the scalar build's namespace and in each
// instruction set's, after load_lanes, lane_count and lane_sum. Each takes lane_count() rays at a time, one vector in
// flight, and returns a sum so that nothing is optimised away.

inline BrickGrid loop_grid(const BenchGrid& g) { return {g.table, g.words, g.table_x, g.table_xy, g.bits, g.bordered}; }
inline vec3 loop_vec3(const BenchRays& r, int first, int n) {
  return vec3(load_lanes(r.data + first * r.count + n), load_lanes(r.data + (first + 1) * r.count + n),
              load_lanes(r.data + (first + 2) * r.count + n));
}

// One look-up for each ray, at its origin.
inline float loop_nearest(const BenchGrid& grid, const BenchRays& rays) {
  const BrickGrid g = loop_grid(grid);
  F sum = F(0.0f);
  for (int n = 0; n < rays.count; n += lane_count()) sum = sum + grid_nearest(g, loop_vec3(rays, 0, n));
  return lane_sum(sum);
}

inline float loop_linear(const BenchGrid& grid, const BenchRays& rays) {
  const BrickGrid g = loop_grid(grid);
  F sum = F(0.0f);
  for (int n = 0; n < rays.count; n += lane_count()) sum = sum + grid_linear(g, loop_vec3(rays, 0, n));
  return lane_sum(sum);
}

// bench_steps cells for each ray.
inline float loop_dda(const BenchGrid&, const BenchRays& rays) {
  F sum = F(0.0f);
  for (int n = 0; n < rays.count; n += lane_count()) {
    Dda walk = dda_start(loop_vec3(rays, 0, n), loop_vec3(rays, 3, n));
    for (int step = 0; step < bench_steps; ++step) {
      sum = sum + dda_cell_exit(walk);
      dda_step(walk);
    }
  }
  return lane_sum(sum);
}

// bench_steps points along each ray, with a linear look-up at each.
inline float loop_march(const BenchGrid& grid, const BenchRays& rays) {
  const BrickGrid g = loop_grid(grid);
  F sum = F(0.0f);
  for (int n = 0; n < rays.count; n += lane_count()) {
    const vec3 origin = loop_vec3(rays, 0, n), direction = loop_vec3(rays, 3, n);
    for (int step = 0; step < bench_steps; ++step) {
      const F t = march_position(F(0.0f), F(rays.step), I(step), F(0.5f), F(0.0f), F(0.0f));
      sum = sum + grid_linear(g, vec3(fma(t, direction.x, origin.x), fma(t, direction.y, origin.y),
                                      fma(t, direction.z, origin.z)));
    }
  }
  return lane_sum(sum);
}

inline float run_loop(Loop loop, const BenchGrid& grid, const BenchRays& rays) {
  switch (loop) {
    case Loop::nearest:
      return loop_nearest(grid, rays);
    case Loop::linear:
      return loop_linear(grid, rays);
    case Loop::dda:
      return loop_dda(grid, rays);
    case Loop::march:
      return loop_march(grid, rays);
  }
  return 0;
}
