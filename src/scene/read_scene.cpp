#include "scene/read_scene.h"

#include <filesystem>

#include "base/file.h"
#include "base/gzip.h"
#include "scene/reader.h"

namespace brume {

namespace {

const std::string standard_input = "standard input";

}  // namespace

bool is_scene_file(const std::string& path) {
  const std::string s = suffix(path);
  return path == "-" || s == ".pbrt" || (s == ".gz" && suffix(path.substr(0, path.size() - 3)) == ".pbrt");
}

SceneDescription read_scene_text(std::string_view text, const std::string& name, const std::string& folder,
                                 std::vector<Diagnostic>& warnings) {
  Messages messages;
  Reader reader(folder, messages);
  SceneDescription scene = reader.read(name, text);
  messages.finish(warnings);
  return scene;
}

SceneDescription read_scene(const std::string& path, std::vector<Diagnostic>& warnings) {
  if (path == "-")
    return read_scene_text(unpacked(standard_input, read_standard_input()), standard_input, "", warnings);
  const std::string text = read_file_unpacked(path);
  return read_scene_text(text, path, std::filesystem::path(path).parent_path().string(), warnings);
}

}  // namespace brume
