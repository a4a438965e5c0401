// A program of somebody else: renders a small scene through the public interface.
#include "brume/brume.h"

#include <cstdio>
#include <fstream>

int main() try {
  std::ofstream("sky.pbrt") << "WorldBegin\nLightSource \"infinite\" \"rgb L\" [0.5 0.5 0.5]\n";
  std::vector<std::string> warnings;
  brume::Scene scene = brume::Scene::load("sky.pbrt", warnings);
  brume::SceneOptions options;
  options.width = 8;
  options.height = 4;
  options.samples_per_pixel = 2;
  scene.apply(options);
  const brume::Picture picture = brume::render(scene);
  picture.write("sky.exr");
  std::printf("the sky is %g, alpha %g\n", static_cast<double>(picture.pixels[0]),
              static_cast<double>(picture.alpha[0]));
} catch (const brume::Error& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
