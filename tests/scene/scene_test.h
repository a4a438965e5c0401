// What the tests of the scene reader share.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "scene/read_scene.h"

namespace brume {

inline std::string test_folder(const std::string& name) { return (std::filesystem::path(SCENE_TESTS) / name).string(); }

// A scene from text; errors fail the test.
inline SceneDescription scene_of(const std::string& text, std::vector<Diagnostic>* warnings = nullptr) {
  std::vector<Diagnostic> unheard;
  try {
    return read_scene_text(text, "test.pbrt", "", warnings ? *warnings : unheard);
  } catch (const InputError& e) {
    ADD_FAILURE() << e.what();
    return {};
  }
}

// The scene whose world holds `text`.
inline SceneDescription world_of(const std::string& text) { return scene_of("WorldBegin\n" + text); }

// The messages of a text's errors, without their places.
inline std::vector<std::string> errors_of(const std::string& text) {
  std::vector<Diagnostic> warnings;
  std::vector<std::string> messages;
  try {
    read_scene_text(text, "test.pbrt", "", warnings);
  } catch (const InputError& e) {
    for (const Diagnostic& d : e.diagnostics()) messages.push_back(d.message);
  }
  return messages;
}

}  // namespace brume
