#include "compile/rgb_grids.h"
#include "compile/bounds_media.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace brume {

namespace {

// pbrt does not normalise what an rgb grid emits: white has the luminance of the integral of the matching function.
// Source: CIE 15:2004, the sum of y at 1 nm.
constexpr float emission_of_white = 106.856895f;

std::vector<float> channel_of(const std::vector<float>& triples, std::size_t channel) {
  std::vector<float> values(triples.size() / 3);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = triples[3 * i + channel];
  return values;
}

bool is_grey(const std::vector<float>& triples) {
  for (std::size_t i = 0; i + 2 < triples.size(); i += 3)
    if (triples[i] != triples[i + 1] || triples[i] != triples[i + 2]) return false;
  return true;
}

bool is_dark(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float v) { return v == 0; });
}

// Collects the parts of one medium.
class Parts {
 public:
  Parts(const MediumDescription& medium, const RgbGridMedium& grid) : medium_(medium), grid_(grid) {}

  std::vector<MediumDescription> find() {
    add_all(grid_.sigma_s, medium_.sigma_s, &MediumDescription::sigma_s, {});
    add_all(grid_.sigma_a, medium_.sigma_a, &MediumDescription::sigma_a, grid_.emission);
    if (parts_.empty()) add(std::vector<float>(cells(), 0), {}, &MediumDescription::sigma_a, {});
    return std::move(parts_);
  }

 private:
  std::size_t cells() const {
    return static_cast<std::size_t>(grid_.resolution[0]) * static_cast<std::size_t>(grid_.resolution[1]) *
           static_cast<std::size_t>(grid_.resolution[2]);
  }

  // A coefficient, and what it emits.
  void add_all(const std::vector<float>& sigma, const Spectrum& scale, Spectrum MediumDescription::*coefficient,
               const std::vector<float>& emission) {
    if (sigma.empty()) return add(std::vector<float>(cells(), 1), scale, coefficient, {});
    if (is_grey(sigma) && is_grey(emission))
      return add(channel_of(sigma, 0), scale, coefficient, channel_of(emission, 0));
    for (int c = 0; c < channel_count; ++c) {
      const auto channel = static_cast<std::size_t>(c);
      Spectrum alone;
      alone[c] = scale[c];
      add(channel_of(sigma, channel), alone, coefficient, channel_of(emission, channel));
    }
  }

  void add(std::vector<float> density, const Spectrum& scale, Spectrum MediumDescription::*coefficient,
           std::vector<float> emission) {
    if (is_dark(density) && !is_zero(scale)) return;
    MediumDescription part = medium_;
    // A name in a scene holds no such character.
    if (!parts_.empty()) part.name += fmt::format("{}{}", '\0', parts_.size());
    part.sigma_a = part.sigma_s = {};
    part.*coefficient = scale;
    part.emission = is_dark(emission) ? Spectrum{} : emission_of_white * medium_.emission;
    if (is_dark(emission)) emission.clear();
    part.kind = UniformGridMedium{grid_.resolution, grid_.p0, grid_.p1, std::move(density), {}, std::move(emission)};
    parts_.push_back(std::move(part));
  }

  const MediumDescription& medium_;
  const RgbGridMedium& grid_;
  std::vector<MediumDescription> parts_;
};

// Of media, beyond the first part: the parts' names.
using MoreParts = std::map<std::string, std::vector<std::string>>;

// Adds, for each shape that bounds a medium of several parts, the boundaries of the further ones.
void add_boundaries(const std::vector<ShapeDescription>& shapes, const MoreParts& more_parts,
                    std::vector<ShapeDescription>& to) {
  for (const ShapeDescription& shape : shapes) {
    const bool is_volume = std::holds_alternative<VolumeShape>(shape.kind);
    if (!is_volume && !bounds_media(shape)) continue;
    const auto add = [&](const std::string& inside, const std::string& outside) {
      ShapeDescription boundary = shape;
      boundary.material = InterfaceMaterial{};
      boundary.light.reset();
      boundary.inside = inside;
      boundary.outside = outside;
      to.push_back(std::move(boundary));
    };
    if (const auto more = more_parts.find(shape.inside); more != more_parts.end())
      for (const std::string& part : more->second) add(part, "");
    if (is_volume) continue;
    if (const auto more = more_parts.find(shape.outside); more != more_parts.end())
      for (const std::string& part : more->second) add("", part);
  }
}

}  // namespace

bool has_rgb_grids(const SceneDescription& scene) {
  return std::any_of(scene.media.begin(), scene.media.end(),
                     [](const MediumDescription& m) { return std::holds_alternative<RgbGridMedium>(m.kind); });
}

SceneDescription with_rgb_grids_as_sums(const SceneDescription& scene) {
  SceneDescription sums = scene;
  sums.media.clear();
  MoreParts more_parts;
  for (const MediumDescription& medium : scene.media) {
    const auto* grid = std::get_if<RgbGridMedium>(&medium.kind);
    if (!grid) {
      sums.media.push_back(medium);
      continue;
    }
    std::vector<MediumDescription> parts = Parts(medium, *grid).find();
    for (std::size_t i = 1; i < parts.size(); ++i) more_parts[medium.name].push_back(parts[i].name);
    std::move(parts.begin(), parts.end(), std::back_inserter(sums.media));
  }
  add_boundaries(scene.shapes, more_parts, sums.shapes);
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    add_boundaries(scene.objects[i].shapes, more_parts, sums.objects[i].shapes);
  return sums;
}

}  // namespace brume
