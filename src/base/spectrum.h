// Colour as the renderer carries it: one value per channel. Three channels, scene-linear Rec.709 red, green and blue,
// for now; code that does not speak of red, green and blue by name must not depend on the number.
#pragma once

#include <array>
#include <compare>

namespace brume {

constexpr int channel_count = 3;

struct Spectrum {
  std::array<float, channel_count> value{};
  float& operator[](int channel) { return value[static_cast<std::size_t>(channel)]; }
  float operator[](int channel) const { return value[static_cast<std::size_t>(channel)]; }
  auto operator<=>(const Spectrum&) const = default;
};

inline Spectrum constant_spectrum(float v) {
  Spectrum s;
  s.value.fill(v);
  return s;
}
inline Spectrum operator+(Spectrum a, const Spectrum& b) {
  for (int c = 0; c < channel_count; ++c) a[c] += b[c];
  return a;
}
inline Spectrum operator*(Spectrum a, const Spectrum& b) {
  for (int c = 0; c < channel_count; ++c) a[c] *= b[c];
  return a;
}
inline Spectrum operator*(float s, Spectrum a) {
  for (int c = 0; c < channel_count; ++c) a[c] *= s;
  return a;
}
inline float max_value(const Spectrum& s) {
  float m = s[0];
  for (int c = 1; c < channel_count; ++c) m = s[c] > m ? s[c] : m;
  return m;
}
inline float sum(const Spectrum& s) {
  float total = 0;
  for (int c = 0; c < channel_count; ++c) total += s[c];
  return total;
}
inline double mean(const Spectrum& s) {
  double sum = 0;
  for (int c = 0; c < channel_count; ++c) sum += static_cast<double>(s[c]);
  return sum / channel_count;
}
inline bool is_zero(const Spectrum& s) { return s == Spectrum{}; }

}  // namespace brume
