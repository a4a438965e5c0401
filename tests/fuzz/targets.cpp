#include "fuzz/targets.h"

#include "base/gzip.h"
#include "scene/read_obj.h"
#include "scene/read_ply.h"
#include "scene/read_scene.h"
#include "volume/formats.h"

namespace brume {

namespace {

// What is read must be written so that it can be read again.
void read_as_scene(std::string_view bytes) {
  std::vector<Diagnostic> warnings;
  const SceneDescription scene = read_scene_text(bytes, "fuzz", "", warnings);
  const std::string again = write_scene(scene);
  try {
    read_scene_text(again, "again", "", warnings);
  } catch (const InputError& e) {
    throw std::logic_error(e.what() + ("\nof the scene that was written:\n" + again));
  }
}

void read_as_ply(std::string_view bytes) { read_ply_bytes("fuzz", bytes); }

void read_as_obj(std::string_view bytes) { read_obj_text("fuzz", std::string(bytes)); }

void read_as_vol(std::string_view bytes) {
  list_vol("fuzz", bytes);
  read_vol("fuzz", bytes, 0, Storage::u8);
}

void read_as_gzip(std::string_view bytes) { unpacked("fuzz", std::string(bytes)); }

template <void (*read)(std::string_view)>
void run(std::string_view bytes) {
  try {
    read(bytes);
  } catch (const InputError&) {
  }
}

}  // namespace

const std::vector<FuzzTarget>& fuzz_targets() {
  static const std::vector<FuzzTarget> all = {{"scene", run<read_as_scene>},
                                              {"ply", run<read_as_ply>},
                                              {"obj", run<read_as_obj>},
                                              {"vol", run<read_as_vol>},
                                              {"gzip", run<read_as_gzip>}};
  return all;
}

}  // namespace brume
