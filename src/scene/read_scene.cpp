#include "scene/read_scene.h"

#include <filesystem>

#include "base/file.h"
#include "scene/reader.h"

namespace brume {

SceneDescription read_scene_text(std::string_view text, const std::string& name, const std::string& folder,
                                 std::vector<Diagnostic>& warnings) {
  Messages messages;
  Reader reader(folder, messages);
  SceneDescription scene = reader.read(name, text);
  messages.finish(warnings);
  return scene;
}

SceneDescription read_scene(const std::string& path, std::vector<Diagnostic>& warnings) {
  const std::string text = read_file(path);
  return read_scene_text(text, path, std::filesystem::path(path).parent_path().string(), warnings);
}

}  // namespace brume
