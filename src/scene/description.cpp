#include "scene/description.h"

namespace brume {

MediumDescription::MediumDescription() = default;
MediumDescription::MediumDescription(const MediumDescription&) = default;
MediumDescription::MediumDescription(MediumDescription&&) noexcept = default;
MediumDescription& MediumDescription::operator=(const MediumDescription&) = default;
MediumDescription& MediumDescription::operator=(MediumDescription&&) noexcept = default;
MediumDescription::~MediumDescription() = default;

ShapeDescription::ShapeDescription() = default;
ShapeDescription::ShapeDescription(const ShapeDescription&) = default;
ShapeDescription::ShapeDescription(ShapeDescription&&) noexcept = default;
ShapeDescription& ShapeDescription::operator=(const ShapeDescription&) = default;
ShapeDescription& ShapeDescription::operator=(ShapeDescription&&) noexcept = default;
ShapeDescription::~ShapeDescription() = default;

SceneDescription::SceneDescription() = default;
SceneDescription::SceneDescription(const SceneDescription&) = default;
SceneDescription::SceneDescription(SceneDescription&&) noexcept = default;
SceneDescription& SceneDescription::operator=(const SceneDescription&) = default;
SceneDescription& SceneDescription::operator=(SceneDescription&&) noexcept = default;
SceneDescription::~SceneDescription() = default;

}  // namespace brume
