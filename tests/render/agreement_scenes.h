// Small scenes, each with one thing that integrators must agree on.
#pragma once

#include <string>
#include <vector>

#include "render/scenes.h"

namespace brume {

struct AgreementScene {
  std::string name;
  SceneDescription scene;
};

// Scenes of 32 x 32 pixels. `folder` takes the pictures of image lights, and must outlive the scenes.
std::vector<AgreementScene> agreement_scenes(const std::string& folder);

// A fault to plant in any scene: the first medium that is not black scatters, and attenuates, `factor` times as much.
void scale_media(SceneDescription& scene, float factor);

}  // namespace brume
