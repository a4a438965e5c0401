// A volume on its own, made into a scene that shows it: framed by a camera, lit by sun and sky, scaled to be neither a
// veil nor a solid.
#pragma once

#include <string>

#include "scene/description.h"

namespace brume {

// What the camera has to show: half the width and half the height of the volume's outline, margin included, as tangents
// of angles from the picture's centre.
struct Framing {
  double half_width = 1, half_height = 1;
};

struct FramedVolume {
  SceneDescription scene;
  Framing framing;
  std::string note;  // one line: what was read and how it was scaled
};

// Frames a grid of a volume file; `grid` empty chooses as read_volume does; where `sanitize`, values that no density
// can have are taken as 0. Throws InputError.
FramedVolume frame_volume(const std::string& path, const std::string& grid, bool sanitize);

// The field of view, as CameraDescription has it, at which a picture of this size shows the whole framing.
double fov_for(const Framing& framing, int width, int height);

}  // namespace brume
