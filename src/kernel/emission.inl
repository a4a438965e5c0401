// What a medium with a grid emits from place to place: the factor of its emission coefficient, beside density. It is
// the colour of a black body at the temperature that another grid gives, times the value of a third grid; where there
// is neither, 1. Source: M. Pharr, W. Jakob and G. Humphreys, Physically Based Rendering, 4th ed. 2023, section 11.4.

// A grid in the index coordinates p of another: its own are rows r of `to_own`, r.xyz . p + r.w.
struct PlacedGrid {
  BrickGrid grid;
  float to_own[12];
  float lo[3];  // bounds, in its own; the value is 0 outside
  float hi[3];
  bool linear;  // else nearest
};

struct EmissionField {
  bool has_temperature, has_strength;
  PlacedGrid temperature, strength;
  float offset, scale;  // kelvin = (value - offset) scale
  Words blackbody;      // a table of black bodies' colours
};

KERNEL F placed_row(PlacedGrid g, int row, vec3 p) {
  return fma(F(g.to_own[4 * row]), p.x,
             fma(F(g.to_own[4 * row + 1]), p.y, fma(F(g.to_own[4 * row + 2]), p.z, F(g.to_own[4 * row + 3]))));
}

KERNEL F placed_grid_value(PlacedGrid g, vec3 p) {
  vec3 own = vec3(placed_row(g, 0, p), placed_row(g, 1, p), placed_row(g, 2, p));
  B inside = both(both(both(own.x >= F(g.lo[0]), own.x <= F(g.hi[0])), both(own.y >= F(g.lo[1]), own.y <= F(g.hi[1]))),
                  both(own.z >= F(g.lo[2]), own.z <= F(g.hi[2])));
  own = vec3(select(inside, own.x, F(g.lo[0])), select(inside, own.y, F(g.lo[1])), select(inside, own.z, F(g.lo[2])));
  F value;
  if (g.linear)
    value = grid_linear(g.grid, own);
  else
    value = grid_nearest(g.grid, own);
  return select(inside, value, F(0.0f));
}

KERNEL F blackbody_channel(Words table, I entry, F fraction) {
  F below = bits_float(load_u32(table, entry));
  return fma(bits_float(load_u32(table, entry + 3)) - below, fraction, below);
}

// The colour of a black body, from a table of 2121 temperatures that goes from 400 K to 1e5 K in steps of e^(1/384):
// linear Rec.709, three words a temperature. Black below, as at 1e5 K above.
KERNEL vec3 blackbody_at(Words table, F kelvin) {
  F place = log_natural(max(kelvin, F(1.0f)) * 0.0025f) * 384.0f;
  B glows = place >= F(0.0f);
  F clamped = min(max(place, F(0.0f)), F(2120.0f));
  I step = min(to_int(clamped), I(2119));
  F fraction = clamped - to_float(step);
  I entry = step * 3;
  return vec3(select(glows, blackbody_channel(table, entry, fraction), F(0.0f)),
              select(glows, blackbody_channel(table, entry + 1, fraction), F(0.0f)),
              select(glows, blackbody_channel(table, entry + 2, fraction), F(0.0f)));
}

// The share of the emission of a place that is gathered along flights, by the bound of the extinction there; the rest
// is seen where paths collide. Where the medium is thin, few do: `thin` is the length of a free path from which on more
// than half is gathered along flights.
KERNEL F emission_along_flights(F majorant, float thin) {
  F depth = majorant * thin;
  return F(1.0f) / fma(depth, depth, F(1.0f));
}

KERNEL vec3 emission_factor(EmissionField e, vec3 p) {
  vec3 factor = vec3(F(1.0f), F(1.0f), F(1.0f));
  if (e.has_temperature)
    factor = blackbody_at(e.blackbody, (placed_grid_value(e.temperature, p) - F(e.offset)) * F(e.scale));
  if (e.has_strength) factor = factor * placed_grid_value(e.strength, p);
  return factor;
}
