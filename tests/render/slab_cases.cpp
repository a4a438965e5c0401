// Slabs and half-spaces, with and without a boundary that refracts. They are very wide boxes. By reciprocity a camera
// that looks along the normal at a slab lit by radiance 1 from one half-space alone sees its reflectance or its
// transmittance for normal incidence. One view shows both, in two channels: the sky, which is on the camera's side, is
// red, and beyond the slab there is a green glow, an absorber that emits and hides the sky. Where paths are long, and
// where no shadow ray would get through the boundary, the camera's side glows as well, so that nobody sends shadow
// rays.
//
// Sources: adding-doubling (H. C. van de Hulst, Multiple Light Scattering, 1980, and its method run to more digits);
// rows 1 and 2 as L. Wang, S. Jacques and L. Zheng quote van de Hulst and Giovanelli 1955: "MCML", Comput. Methods
// Programs Biomed. 47, 1995; half-spaces: S. Chandrasekhar, Radiative Transfer, 1950, chapter III.
#include <numbers>

#include "render/cases.h"

namespace brume {

namespace {

constexpr float wide = 2e4f;

constexpr Fault anisotropy{"anisotropy_a_tenth_off",
                           [](SceneDescription& s) { s.media[0].phase_parameters[0] *= 0.9f; }};
constexpr Fault extinction{"extinction_a_tenth_off", [](SceneDescription& s) {
                             s.media[0].sigma_a = 1.1f * s.media[0].sigma_a;
                             s.media[0].sigma_s = 1.1f * s.media[0].sigma_s;
                           }};
constexpr Fault absorption{"a_hundredth_of_what_scatters_absorbed", [](SceneDescription& s) {
                             s.media[0].sigma_a = s.media[0].sigma_a + 0.01f * s.media[0].sigma_s;
                             s.media[0].sigma_s = 0.99f * s.media[0].sigma_s;
                           }};
constexpr Fault index{"refractive_index_off_by_a_tenth",
                      [](SceneDescription& s) { std::get<DielectricMaterial>(s.shapes[0].material).eta -= 0.1f; }};
constexpr Fault forward_lobe{"Rayleigh_with_a_forward_lobe", [](SceneDescription& s) {
                               set_phase(s.media[0], "draine", {0.1f, 1});
                             }};

// What a camera on the normal sees of a slab.
struct Slab {
  std::string name;
  std::string phase;
  std::vector<float> phase_parameters;
  float albedo, thickness;
  double reflectance, transmittance, rounding;  // transmittance below 0: a half-space
  Fault fault;
  float index = 1;
};

// An absorber that is opaque and emits this radiance.
void add_glow(SceneDescription& s, const std::string& name, double z, const Spectrum& radiance) {
  s.media.push_back(homogeneous_medium(name, 1, 0));
  s.media.back().emission = radiance;
  s.shapes.push_back(box_shape({-wide, -wide, z}, {wide, wide, z + 100}, name));
}

// The camera stands below and looks up along +z at the slab from z = 0 on.
SceneDescription dark_slab(const Slab& slab) {
  SceneDescription s = needle_scene({0, 0, -1});
  s.integrator.max_depth = 100000;
  s.media = {homogeneous_medium("slab", 1 - slab.albedo, slab.albedo)};
  set_phase(s.media[0], slab.phase, slab.phase_parameters);
  s.shapes = {box_shape({-wide, -wide, 0}, {wide, wide, slab.thickness}, "slab")};
  if (slab.index != 1) s.shapes[0].material = DielectricMaterial{slab.index};
  return s;
}

SceneDescription lit_slab(const Slab& slab) {
  SceneDescription s = dark_slab(slab);
  const Spectrum red{{1, 0, 0}}, green{{0, 1, 0}};
  if (slab.thickness <= 2)
    s.lights = {{InfiniteLight{red}, {}}};
  else
    add_glow(s, "below", -102, red);
  if (slab.transmittance >= 0) add_glow(s, "above", slab.thickness + 1.0, green);
  return s;
}

// For Lambertian light, which by reciprocity is a view in all directions in proportion to the cosine: the camera looks
// at a white speck that faces the slab.
SceneDescription lambert_lit_slab(const Slab& slab) {
  SceneDescription s = lit_slab(slab);
  s.camera.world_from_camera = translate({0, 0, -0.5}) * rotate(180, {0, 1, 0});
  s.shapes.push_back(square_facing_z({0, 0, -1}, 1e-3, 1));
  return s;
}

void add(std::vector<Case>& all, const Slab& slab, const SceneDescription& scene) {
  Case c{slab.name, scene, {{slab.reflectance, slab.rounding}}, slab.fault};
  if (slab.transmittance >= 0) c.expected.push_back({slab.transmittance, slab.rounding});
  all.push_back(c);
}

void add_back_scattering(std::vector<Case>& all, const std::string& name, float albedo, float thickness, double factor,
                         double h) {
  Case c{name, dark_slab({name, "isotropic", {}, albedo, thickness, 0, -1, 0, absorption}), {}, absorption};
  c.scene.lights = {distant_light({0, 0, -1}, 1)};
  c.expected = {{factor * h * h / std::numbers::pi, factor * 2 * h * 5e-7 / std::numbers::pi}};
  all.push_back(c);
}

}  // namespace

void add_slabs(std::vector<Case>& all) {
  const std::string hg = "henyey_greenstein";
  const Slab row_1{"01_HG_075_albedo_09_b_2", hg, {0.75f}, 0.9f, 2, 0.097395, 0.660958, 5e-7, anisotropy};
  add(all, row_1, lit_slab(row_1));
  for (const Slab& slab :
       {Slab{"04_HG_075_albedo_09_b_2_n_14", hg, {0.75f}, 0.9f, 2, 0.1162, 0.5270, 5e-5, index, 1.4f},
        Slab{"05_HG_085_albedo_099_b_10_n_133", hg, {0.85f}, 0.99f, 10, 0.3159, 0.4133, 5e-5, anisotropy, 1.33f},
        Slab{"06_isotropic_conservative_b_1", "isotropic", {}, 1, 1, 0.341329, 0.658671, 5e-7, extinction},
        Slab{"07_isotropic_albedo_09_b_1", "isotropic", {}, 0.9f, 1, 0.267410, 0.591625, 5e-7, absorption},
        Slab{"08_HG_085_conservative_b_16", hg, {0.85f}, 1, 16, 0.55721, 0.44279, 5e-6, anisotropy},
        Slab{"09_HG_085_albedo_0999_b_8", hg, {0.85f}, 0.999f, 8, 0.352121, 0.632507, 5e-7, absorption},
        Slab{"11_Rayleigh_conservative_b_1", "rayleigh", {}, 1, 1, 0.340471, 0.659529, 5e-7, forward_lobe}})
    add(all, slab, lit_slab(slab));
  for (const Slab& slab :
       {Slab{"06_isotropic_conservative_b_1_Lambert_lit", "isotropic", {}, 1, 1, 0.446594, 0.553406, 5e-7, extinction},
        Slab{"10_HG_085_conservative_b_32_Lambert_lit", hg, {0.85f}, 1, 32, 0.78591, 0.21409, 5e-6, anisotropy}})
    add(all, slab, lambert_lit_slab(slab));

  // The slab of row 1 as a grid of ones.
  Slab grid = row_1;
  grid.name = "01_as_a_grid";
  SceneDescription s = lit_slab(grid);
  s.media[0].kind = UniformGridMedium{
      {4, 5, 9}, {-wide, -wide, 0}, {wide, wide, grid.thickness}, std::vector<float>(std::size_t{4} * 5 * 9, 1)};
  s.media[0].linear_interpolation = false;
  s.shapes[0] = free_volume("slab");
  add(all, grid, s);
}

// As thick as is as good as infinitely thick.
void add_half_spaces(std::vector<Case>& all) {
  const std::string hg = "henyey_greenstein";
  for (const Slab& slab :
       {Slab{"02_half_space_albedo_09_n_15", "isotropic", {}, 0.9f, 40, 0.2600, -1, 5e-5, index, 1.5f},
        Slab{"03_half_space_albedo_099_n_15", "isotropic", {}, 0.99f, 100, 0.6020, -1, 5e-5, absorption, 1.5f},
        Slab{"14_half_space_HG_075_albedo_099", hg, {0.75f}, 0.99f, 200, 0.559170, -1, 5e-7, anisotropy},
        Slab{"14_half_space_HG_085_albedo_0999", hg, {0.85f}, 0.999f, 1000, 0.78730, -1, 5e-6, anisotropy}})
    add(all, slab, lit_slab(slab));

  // The plane albedo is 1 - H(1) sqrt(1 - w).
  for (const Slab& slab :
       {Slab{"13_half_space_albedo_05", "isotropic", {}, 0.5f, 40, 0.115226, -1, 5e-7, absorption},
        Slab{"13_half_space_albedo_09", "isotropic", {}, 0.9f, 40, 0.414947, -1, 5e-7, absorption},
        Slab{"13_half_space_albedo_099", "isotropic", {}, 0.99f, 100, 0.752721, -1, 5e-7, absorption},
        Slab{"13_half_space_albedo_0999", "isotropic", {}, 0.999f, 300, 0.912845, -1, 5e-7, absorption}})
    add(all, slab, lit_slab(slab));

  // Light of perpendicular irradiance 1 along the normal comes back along it as w H(1)^2 / (8 pi).
  add_back_scattering(all, "12_H_of_albedo_09", 0.9f, 40, 0.9 / 8, 1.850099);
  add_back_scattering(all, "12_H_of_albedo_099", 0.99f, 50, 0.99 / 8, 2.472793);
  // A slab of thickness b without absorption sends H(1)^2 / (4 (b + 1.42089)) / pi less: van de Hulst, section 5.2.
  add_back_scattering(all, "12_H_of_albedo_1", 1, 20, 1.0 / 8 - 0.25 / (20 + 1.42089), 2.907811);
}

}  // namespace brume
