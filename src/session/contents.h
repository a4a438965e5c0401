// What a Scene is made of.
#pragma once

#include <optional>
#include <string>

#include "brume/scene.h"
#include "scene/description.h"
#include "session/frame_volume.h"

namespace brume {

struct Scene::Contents {
  SceneDescription description;
  std::optional<Framing> framing;  // of a volume on its own
  std::string framing_note;
  double reading_seconds = 0;
};

}  // namespace brume
