// DDA: the cells of the integer lattice that a ray crosses, in order, one step a cell.
// Cell (i, j, k) is the cube [i, i+1] x [j, j+1] x [k, k+1]. Walked in index coordinates it visits voxels; walked in
// index coordinates less one half, it visits the dual cells, the cubes between eight voxel centres, within which the
// trilinear interpolant is a cubic in t. Planes are computed from integer indices, not accumulated, so their t's error
// is 2 ulp of (plane - origin) / direction however long the walk. Start with the origin clipped to the box: from a
// distant origin digits are lost before the first step.
// Source: J. Amanatides and A. Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987.

struct Dda {
  vec3 origin;
  vec3 inverse;  // 1 / direction, 0 on axes that the ray does not move along
  vec3 t_next;   // where the ray leaves the current cell through each axis' plane
  I cell_x, cell_y, cell_z;
  I step_x, step_y, step_z;
};

// 1 / direction, or 0 for a direction too small to cross a plane (below 1e-37).
KERNEL F dda_inverse(F direction) {
  B parallel = abs(direction) < 1e-37f;
  return select(parallel, F(0.0f), F(1.0f) / select(parallel, F(1.0f), direction));
}

// The t at which an axis' far plane of `cell` is crossed; 3e38 for a parallel axis.
KERNEL F dda_plane(F origin, F inverse, I cell, I step) {
  I plane = cell + max(step, I(0));
  return select(inverse == 0.0f, F(3e38f), (to_float(plane) - origin) * inverse);
}

// The walk that starts in the cell of `origin`. On a plane the cell is the one above it: a ray that goes down from
// there has a first cell of no length.
KERNEL Dda dda_start(vec3 origin, vec3 direction) {
  Dda s;
  s.origin = origin;
  s.inverse = vec3(dda_inverse(direction.x), dda_inverse(direction.y), dda_inverse(direction.z));
  s.cell_x = floor_to_int(origin.x);
  s.cell_y = floor_to_int(origin.y);
  s.cell_z = floor_to_int(origin.z);
  s.step_x = select(direction.x < 0.0f, I(-1), I(1));
  s.step_y = select(direction.y < 0.0f, I(-1), I(1));
  s.step_z = select(direction.z < 0.0f, I(-1), I(1));
  s.t_next =
      vec3(dda_plane(origin.x, s.inverse.x, s.cell_x, s.step_x), dda_plane(origin.y, s.inverse.y, s.cell_y, s.step_y),
           dda_plane(origin.z, s.inverse.z, s.cell_z, s.step_z));
  return s;
}

// Where the ray leaves the current cell.
KERNEL F dda_cell_exit(Dda s) { return min(s.t_next.x, min(s.t_next.y, s.t_next.z)); }

// Moves to the next cell, through the nearest plane (x before y before z where they are equally near).
KERNEL void dda_step(INOUT(Dda) s) {
  B x = both(s.t_next.x <= s.t_next.y, s.t_next.x <= s.t_next.z);
  B y = both(negate(x), s.t_next.y <= s.t_next.z);
  B z = negate(either(x, y));
  s.cell_x = s.cell_x + select(x, s.step_x, I(0));
  s.cell_y = s.cell_y + select(y, s.step_y, I(0));
  s.cell_z = s.cell_z + select(z, s.step_z, I(0));
  s.t_next.x = select(x, dda_plane(s.origin.x, s.inverse.x, s.cell_x, s.step_x), s.t_next.x);
  s.t_next.y = select(y, dda_plane(s.origin.y, s.inverse.y, s.cell_y, s.step_y), s.t_next.y);
  s.t_next.z = select(z, dda_plane(s.origin.z, s.inverse.z, s.cell_z, s.step_z), s.t_next.z);
}
