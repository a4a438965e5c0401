#pragma once

#include "brume/render.h"
#include "image/image.h"

namespace brume {

struct Picture::Metadata {
  ImageMetadata image;
};

}  // namespace brume
