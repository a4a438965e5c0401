// Small scenes, each with one thing that integrators must agree on.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "render/scenes.h"

namespace brume {

struct AgreementScene {
  std::string name;
  SceneDescription scene;
};

// How GoogleTest shows a scene.
inline void PrintTo(const AgreementScene& scene, std::ostream* out) { *out << scene.name; }

// Scenes of 32 x 32 pixels. Image lights name a file that does not exist: write_sky makes it.
std::vector<AgreementScene> agreement_scenes();
void write_sky(const std::string& path);

}  // namespace brume
