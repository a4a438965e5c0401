#include "scene/read_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/file.h"
#include "base/gzip.h"
#include "scene/reader.h"

namespace brume {

namespace {

const std::string standard_input = "standard input";

SceneDescription read_files(const std::vector<Reader::File>& files, std::vector<Diagnostic>& warnings, bool strict,
                            const MoreErrors& more_errors) {
  Messages messages(strict);
  Reader reader(messages);  // the messages point into its sources
  SceneDescription scene = reader.read(files);
  std::vector<Diagnostic> errors = messages.finish(warnings);
  if (errors.empty()) return scene;
  if (more_errors && errors.size() < Messages::max_errors) {
    std::vector<Diagnostic> more = more_errors(scene);
    add_source_lines(more);
    errors.insert(errors.end(), more.begin(), more.end());
    sort_by_place(errors);
    errors.resize(std::min(errors.size(), Messages::max_errors));
  }
  if (errors.size() == Messages::max_errors) {
    Diagnostic& note = errors.emplace_back();
    note.severity = Severity::note;
    note.location.file = files.front().name;
    note.message = fmt::format("there may be more than these {} errors", Messages::max_errors);
  }
  throw InputError(std::move(errors));
}

}  // namespace

bool is_scene_file(const std::string& path) {
  const std::string s = suffix(path);
  return path == "-" || s == ".pbrt" || (s == ".gz" && suffix(path.substr(0, path.size() - 3)) == ".pbrt");
}

SceneDescription read_scene_text(std::string_view text, const std::string& name, const std::string& folder,
                                 std::vector<Diagnostic>& warnings, bool strict) {
  return read_files({{name, text, folder}}, warnings, strict, {});
}

SceneDescription read_scene(const std::string& path, std::vector<Diagnostic>& warnings) {
  return read_scene_files({path}, warnings);
}

SceneDescription read_scene_files(const std::vector<std::string>& paths, std::vector<Diagnostic>& warnings, bool strict,
                                  const MoreErrors& more_errors) {
  std::vector<std::string> texts;
  for (const std::string& path : paths)
    texts.push_back(path == "-" ? unpacked(standard_input, read_standard_input()) : read_file_unpacked(path));
  std::vector<Reader::File> files;
  for (std::size_t i = 0; i < paths.size(); ++i)
    files.push_back({paths[i] == "-" ? standard_input : paths[i], texts[i],
                     std::filesystem::path(paths[i]).parent_path().string()});
  return read_files(files, warnings, strict, more_errors);
}

}  // namespace brume
