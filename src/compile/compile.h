// SceneDescription to CompiledScene: reads the volumes that the scene names, resolves names to indices, derives what
// rendering needs, and checks what only the whole scene shows.
#pragma once

#include <vector>

#include "base/diagnostics.h"
#include "compiled/compiled_scene.h"
#include "scene/description.h"
#include "volume/volume_grid.h"

namespace brume {

// Throws InputError, with all errors found; warnings are appended.
CompiledScene compile(const SceneDescription& scene, int threads, std::vector<Diagnostic>& warnings);

// Of a scene whose text has errors: what is wrong with the volumes and pictures that it names. compile() finds the same
// of one without.
std::vector<Diagnostic> file_errors(const SceneDescription& scene, int threads);

// Bordered bricks are for marching and traversal, which look up all eight corners of a cell; plain ones for tracking,
// which looks up one (kernel/lookup.inl).
enum class BrickLayout { plain, bordered };

// A grid by itself, for linear or nearest interpolation.
CompiledGrid compile_grid(VolumeGrid grid, bool linear, BrickLayout layout, int threads);

}  // namespace brume
