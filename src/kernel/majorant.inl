// The walk through a grid of majorants: upper bounds of the density, one for each cube of `edge` voxels. DDA as in
// dda.inl, but with t_next accumulated, which is cheaper and off by at most 1e-6 of the walk's length: the bounds hold
// one voxel beyond their cells, so that a t near a plane may fall on either side of it.
// Cell (i, j, k) of the walk is the cube [i, i + 1] x ... of index coordinates divided by the edge. A border of one
// cell on every side takes what lies up to one cell outside the array of voxels. Callers clip their rays to the grid's
// bounds and stop there.
// Source: L. Szirmay-Kalos et al., "Free Path Sampling in High Resolution Inhomogeneous Participating Media", CGF 30(1),
// 2011.

struct MajorantGrid {
  Words cells;  // the bits of a float each
  uint row;     // cells along x, border included
  uint layer;   // cells in a layer, border included
  float cells_per_voxel;
};

struct MajorantWalk {
  vec3 t_next;  // where the ray leaves the current cell through each axis' plane
  vec3 t_cell;  // from plane to plane
  I cell;       // index of the current cell
  I step_x, step_y, step_z;
};

// The distance in t between two planes of an axis; 3e38 for an axis that the ray does not move along.
KERNEL F majorant_plane_distance(F direction) {
  B parallel = abs(direction) < 1e-30f;
  return select(parallel, F(3e38f), F(1.0f) / select(parallel, F(1.0f), abs(direction)));
}

// How far it is to the first plane, from `fraction` of a cell above its lower plane.
KERNEL F majorant_first_plane(F fraction, F direction, F t_cell) {
  return min(select(direction < 0.0f, fraction, 1.0f - fraction) * t_cell, F(3e38f));
}

KERNEL MajorantWalk majorant_start(MajorantGrid g, vec3 origin_index, vec3 direction_index) {
  vec3 o = origin_index * F(g.cells_per_voxel);
  vec3 d = direction_index * F(g.cells_per_voxel);
  I x = floor_to_int(o.x);
  I y = floor_to_int(o.y);
  I z = floor_to_int(o.z);
  MajorantWalk w;
  w.t_cell = vec3(majorant_plane_distance(d.x), majorant_plane_distance(d.y), majorant_plane_distance(d.z));
  w.t_next = vec3(majorant_first_plane(o.x - to_float(x), d.x, w.t_cell.x),
                  majorant_first_plane(o.y - to_float(y), d.y, w.t_cell.y),
                  majorant_first_plane(o.z - to_float(z), d.z, w.t_cell.z));
  I row = as_int(U(g.row));
  I layer = as_int(U(g.layer));
  w.cell = (z + 1) * layer + (y + 1) * row + (x + 1);
  w.step_x = select(d.x < 0.0f, I(-1), I(1));
  w.step_y = select(d.y < 0.0f, I(0) - row, row);
  w.step_z = select(d.z < 0.0f, I(0) - layer, layer);
  return w;
}

// Where the ray leaves the current cell.
KERNEL F majorant_cell_exit(MajorantWalk w) { return min(w.t_next.x, min(w.t_next.y, w.t_next.z)); }

// Moves to the next cell where `moves`, through the nearest plane (x before y before z where they are equally near).
KERNEL void majorant_step(INOUT(MajorantWalk) w, B moves) {
  B x = both(moves, both(w.t_next.x <= w.t_next.y, w.t_next.x <= w.t_next.z));
  B y = both(both(moves, negate(x)), w.t_next.y <= w.t_next.z);
  B z = both(moves, negate(either(x, y)));
  w.cell = w.cell + select(x, w.step_x, select(y, w.step_y, select(z, w.step_z, I(0))));
  w.t_next.x = w.t_next.x + select(x, w.t_cell.x, F(0.0f));
  w.t_next.y = w.t_next.y + select(y, w.t_cell.y, F(0.0f));
  w.t_next.z = w.t_next.z + select(z, w.t_cell.z, F(0.0f));
}

// The bound of the density in cell `cell`.
KERNEL F majorant_at(MajorantGrid g, I cell) { return bits_float(load_u32(g.cells, cell)); }

// One voxel in place of the trilinear interpolant's eight: a neighbour of p_index chosen with the interpolant's
// weights, so that the expectation of its value is the interpolant. `a` and `b` are words of random bits: 16 for each
// axis.
// Source: M. Pharr, B. Wronski, M. Salvi and M. Fajardo, "Filtering After Shading With Stochastic Texture Filtering",
// I3D 2024.
KERNEL VoxelPlace grid_stochastic_place(BrickGrid g, vec3 p_index, U a, U b) {
  F ux = to_float(as_int(a & 0xffffu)) * 1.52587890625e-5f;
  F uy = to_float(as_int(a >> 16)) * 1.52587890625e-5f;
  F uz = to_float(as_int(b & 0xffffu)) * 1.52587890625e-5f;
  return grid_place(g, floor_to_int(p_index.x - 0.5f + ux), floor_to_int(p_index.y - 0.5f + uy),
                    floor_to_int(p_index.z - 0.5f + uz));
}

KERNEL F grid_stochastic(BrickGrid g, vec3 p_index, U a, U b) {
  return grid_value(g, grid_stochastic_place(g, p_index, a, b));
}
