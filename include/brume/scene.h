// Scenes: from a .pbrt file, from a volume file alone, or the built-in example.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace brume {

// What every function here throws when its input is at fault. what() is ready to be shown: one or more messages that
// begin with the file they are about, file:line:column, where there is one, then "error:"; then the line and a caret.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Changes to what a scene says; what is not set stays as the scene has it.
struct SceneOptions {
  std::optional<int> width, height;      // pixels, 1 to 65536, together at most 2^28
  std::optional<int> samples_per_pixel;  // 1 to 2^24
  // x0 x1 y0 y1, fractions of the picture with y from the top, 0 <= x0 < x1 <= 1: only the pixels whose upper left
  // corners lie in it are rendered, with the values that they have in the whole picture.
  std::optional<std::array<double, 4>> crop_window;
  // The same in pixels: x0 x1 y0 y1, the first ones rendered, the last ones not; within the picture. crop_window
  // overrides it.
  std::optional<std::array<int, 4>> pixel_bounds;
  // A draft: a quarter of the width, of the height and of the samples per pixel, but at least 1; what is set above
  // stays as it is set.
  bool quick = false;
  std::optional<std::uint32_t> seed;
  std::optional<std::string> integrator;
};

class Scene {
 public:
  // Reads a scene (.pbrt, .pbrt.gz, or "-" for the standard input) or frames a volume (.vdb, .nvdb, .vol). Warnings,
  // ready to be shown, are appended to `warnings`. Throws Error, as all that follow do.
  static Scene load(const std::string& path, std::vector<std::string>& warnings);
  // Reads several scene files, one after another, as one scene, or does with one file what load does. Where `strict`,
  // old spellings of the scene language are errors and not warnings.
  static Scene load_files(const std::vector<std::string>& paths, std::vector<std::string>& warnings,
                          bool strict = false);
  // A volume on its own: the grid framed by a camera, lit by sun and sky, its extinction scaled to the optical depth
  // that framing_note() states. `grid` empty: "density", or the only grid that can be rendered. Values that are
  // negative or not finite are an error, or 0 where `sanitize`.
  static Scene frame_volume(const std::string& path, const std::string& grid = {}, bool sanitize = false);
  // The built-in example: a procedural cloud over a ground.
  static Scene example();

  void apply(const SceneOptions& options);
  // The scene in the scene language.
  std::string text() const;
  // Writes text() to a file, whole or not at all.
  void write(const std::string& path) const;
  // The files that were read for it or that it names: what it includes, meshes, volumes, pictures, spectra.
  std::vector<std::string> input_files() const;
  // The file name that the scene's Film gives.
  std::string output_filename() const;
  // One line about what frame_volume chose; empty for other scenes.
  std::string framing_note() const;

  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  struct Contents;
  const Contents& contents() const { return *contents_; }

 private:
  explicit Scene(std::unique_ptr<Contents> contents);
  std::unique_ptr<Contents> contents_;
};

// What a file holds: a scene's entities, a volume file's grids, or what a picture says of itself.
struct FileDescription {
  std::string lines;                // to be shown
  std::vector<std::string> faults;  // of grids that cannot be read, ready to be shown; they are in the lines too
};
FileDescription describe_file(const std::string& path);

// The version, the instruction sets that this machine offers and the one in use. Throws Error where BRUME_ISA is set to
// a name that is unknown or that the machine does not have.
std::string version_text();

}  // namespace brume
