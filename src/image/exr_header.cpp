#include "image/exr_header.h"

#include <ImathBox.h>
#include <ImathMatrix.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>

#include "image/check_exr_header.h"
#include "image/exr_memory_stream.h"
#include "image/formats.h"

namespace brume {

namespace {

// Of no interest to anyone, or shown as what they are.
constexpr std::string_view usual_attributes[] = {"channels",           "compression",      "dataWindow",
                                                 "displayWindow",      "lineOrder",        "pixelAspectRatio",
                                                 "screenWindowCenter", "screenWindowWidth"};

template <class Attribute>
const Attribute* as(const Imf::Attribute& attribute) {
  return dynamic_cast<const Attribute*>(&attribute);
}

std::string text(const Imf::Attribute& attribute) {
  if (const auto* a = as<Imf::IntAttribute>(attribute)) return fmt::format("{}", a->value());
  if (const auto* a = as<Imf::FloatAttribute>(attribute)) return fmt::format("{:.6g}", a->value());
  if (const auto* a = as<Imf::DoubleAttribute>(attribute)) return fmt::format("{:.6g}", a->value());
  if (const auto* a = as<Imf::StringAttribute>(attribute)) return a->value();
  if (const auto* a = as<Imf::M44fAttribute>(attribute)) {
    std::string rows;
    for (int i = 0; i < 4; ++i) {
      const auto value = [&](int j) { return a->value()[i][j] + 0.0f; };  // -0 to 0
      rows += fmt::format("{}({:.5g} {:.5g} {:.5g} {:.5g})", i == 0 ? "" : " ", value(0), value(1), value(2), value(3));
    }
    return rows;
  }
  return {};
}

const char* type_name(Imf::PixelType type) {
  return type == Imf::HALF ? "half" : type == Imf::FLOAT ? "float" : "uint";
}

std::array<int, 4> corners(const Imath::Box2i& box) { return {box.min.x, box.min.y, box.max.x, box.max.y}; }

}  // namespace

ExrHeader decode_exr_header(std::string_view bytes) {
  check_exr_header(bytes);
  ExrMemoryStream stream(bytes);
  const Imf::InputFile file(stream);
  const Imf::Header& header = file.header();
  ExrHeader result{corners(header.dataWindow()), corners(header.displayWindow()), {}, {}};
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i)
    result.channels.emplace_back(i.name(), type_name(i.channel().type));
  for (auto i = header.begin(); i != header.end(); ++i)
    if (std::find(std::begin(usual_attributes), std::end(usual_attributes), i.name()) == std::end(usual_attributes))
      result.attributes.push_back({i.name(), i.attribute().typeName(), text(i.attribute())});
  return result;
}

}  // namespace brume
