// The reader and the writer of the scene language, which is pbrt-v4's with Brume's additions (docs/scene-language.md).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/description.h"

namespace brume {

// Whether the name is that of a scene: .pbrt, .pbrt.gz or "-".
bool is_scene_file(const std::string& path);

// Reads a scene file, compressed by gzip or not; "-" is the standard input, whose relative names stand for files in the
// current folder. All of a file's errors (at most 20) are thrown together as one InputError; warnings are appended
// to `warnings`.
SceneDescription read_scene(const std::string& path, std::vector<Diagnostic>& warnings);

// What else is wrong with a scene whose text has errors, which holds what could be read of it.
using MoreErrors = std::function<std::vector<Diagnostic>(const SceneDescription&)>;

// Several files, one after another, as one scene; each one's relative names resolve against its own folder. Where
// `strict`, old spellings are errors. Where there are errors, `more_errors` is asked for others to be thrown with them.
SceneDescription read_scene_files(const std::vector<std::string>& paths, std::vector<Diagnostic>& warnings,
                                  bool strict = false, const MoreErrors& more_errors = {});

// From text; `name` stands for the file in messages, and relative names resolve against `folder`.
SceneDescription read_scene_text(std::string_view text, const std::string& name, const std::string& folder,
                                 std::vector<Diagnostic>& warnings, bool strict = false);

// Gives diagnostics about a scene that was read before the lines that they are about, where its files can be read
// again.
void add_source_lines(std::vector<Diagnostic>& diagnostics);

// The scene as text that read_scene takes. Reading it gives an equal scene, but for the camera's matrix: the language
// gives its inverse, so that it comes back within rounding. Relative names in it are written as they are.
std::string write_scene(const SceneDescription& scene);

}  // namespace brume
