// Small scenes put together in C++, and their radiance along single rays.
#pragma once

#include <string>

#include "image/film.h"
#include "scene/description.h"

namespace brume {

// A scene of one pixel whose camera stands at `eye` and looks along +z through a needle's eye.
SceneDescription needle_scene(Vector3 eye = {0, 0, 0});

MediumDescription homogeneous_medium(const std::string& name, float sigma_a, float sigma_s);
// A uniform grid over the box [lo, hi], cut there.
MediumDescription grid_medium(const std::string& name, Vector3 lo, Vector3 hi, std::array<int, 3> resolution,
                              std::vector<float> density, float sigma_a, float sigma_s);
void set_phase(MediumDescription& medium, const std::string& phase, std::vector<float> parameters);

// A closed box of triangles, normals outwards.
ShapeDescription box_shape(Vector3 lo, Vector3 hi, const std::string& inside, const std::string& outside = "");
ShapeDescription sphere_shape(Vector3 centre, double radius, const std::string& inside,
                              const std::string& outside = "");
ShapeDescription free_volume(const std::string& medium);
// A square of half-edge `half` about `centre`, facing +-z or +-y as its normal says, with a diffuse reflectance.
ShapeDescription square_facing_z(Vector3 centre, double half, float reflectance);
ShapeDescription square_facing_y(Vector3 centre, double half, float reflectance);

LightDescription point_light(Vector3 from, float intensity);
LightDescription distant_light(Vector3 towards, float irradiance);
LightDescription sky(float radiance);

// The film after samples [0, count).
Film render_film(const SceneDescription& scene, int samples, int threads = 1);
// The first channel of the first pixel.
float radiance(const SceneDescription& scene, int samples = 1);

}  // namespace brume
