#include "kernel/call_agreement.h"

#include <array>
#include <bit>
#include <cmath>

#include "kernel/phase_cases.h"

namespace brume {

namespace {

using Arguments = std::function<float(int n, int argument)>;

float uniform(int n, int argument, float lo, float hi) {
  const float u = kernel::random_uniform(21, 0, static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(argument));
  return lo + (hi - lo) * u;
}

Arguments range(float lo, float hi) {
  return [=](int n, int argument) { return uniform(n, argument, lo, hi); };
}

// Positive floats of all magnitudes from 2^-lo to 2^hi.
float magnitude(int n, int argument, float lo, float hi) { return std::exp2(uniform(n, argument, lo, hi)); }

// A component of a direction: often 0, -0 or tiny.
float component(int n, int argument) {
  constexpr std::array special{0.0f, -0.0f, 1e-40f, -1e-38f, 1.0f, -1.0f};
  const float pick = uniform(n, argument + 100, 0, 30);
  return pick < 6 ? special[static_cast<std::size_t>(pick)] : uniform(n, argument, -1, 1);
}

// Rays that start in and about the box that arguments 6 to 11 give.
float box_argument(int n, int argument) {
  if (argument < 3) return uniform(n, argument, -20, 36);
  if (argument < 6) return component(n, argument);
  if (argument < 9) return 0.0f;
  if (argument < 12) return 16.0f;
  return argument == 12 ? 0.0f : uniform(n, argument, 1, 100);
}

float inside_argument(int n, int argument) {
  return argument < 3 ? uniform(n, argument, 0, 16) : component(n, argument);
}

float random_word(int n, int argument) {
  return std::bit_cast<float>(
      kernel::random_bits(5, 6, static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(argument)));
}

Arguments phase_arguments(bool with_number, float lo, const std::string& name) {
  const std::vector<PhaseCase> all = phase_cases();
  std::vector<kernel::vec4> prepared;
  for (const PhaseCase& phase : all)
    if (phase.name.starts_with(name + "_")) prepared.push_back(phase.p);
  return [=](int n, int argument) {
    const kernel::vec4 p = prepared[static_cast<std::size_t>(n) % prepared.size()];
    if (with_number && argument == 0) return uniform(n, 0, lo, 1);
    return std::array{p.x, p.y, p.z, p.w}[static_cast<std::size_t>(argument - (with_number ? 1 : 0))];
  };
}

std::int64_t ulp_distance(float a, float b) {
  const auto order = [](float x) {
    const std::int64_t bits = std::bit_cast<std::int32_t>(x);
    return bits < 0 ? -(bits & 0x7fffffff) : bits;
  };
  return std::abs(order(a) - order(b));
}

bool agrees(float a, float b, const Agreement& within) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || ulp_distance(a, b) <= within.ulps ||
         std::abs(static_cast<double>(a) - b) <= within.absolute;
}

}  // namespace

std::map<std::string, Agreement, std::less<>> agreements() {
  std::map<std::string, Agreement, std::less<>> all;
  all["log_natural"] = {2, 0, [](int n, int a) { return n % 2 ? magnitude(n, a, -126, 127) : uniform(n, a, 0.5f, 2); }};
  all["exp_natural"] = {2, 0, range(-90, 90)};
  all["atan_turns"] = {2, 0, [](int n, int a) { return (n % 2 ? 1.0f : -1.0f) * magnitude(n, a, -20, 20); }};
  all["sincos_turns"] = {2, 1.2e-7, range(-10, 10)};
  all["pow_positive"] = {64, 0, [](int n, int a) { return a == 0 ? magnitude(n, a, -20, 20) : uniform(n, a, -4, 4); }};
  all["beer_lambert"] = {2, 0, range(0, 90)};
  all["mean_transmittance"] = {4, 0, [](int n, int a) { return magnitude(n, a, -20, 7); }};
  all["march_position"] = {2, 0,
                           [](int n, int a) { return a == 2 ? std::bit_cast<float>(n % 1000) : uniform(n, a, 0, 1); }};
  all["random_bits"] = all["random_words"] = {0, 0, random_word};
  all["sobol_pair"] = {0, 0, [](int n, int a) {
                         const std::uint32_t bits =
                             kernel::random_bits(7, 8, static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(a));
                         return std::bit_cast<float>(a == 3 ? 1u << bits % 21 : bits >> (bits % 32));
                       }};
  all["box_clip"] = {0, 0, box_argument};
  all["box_span"] = {2, 1e-5, box_argument};
  // A grazing ray's chord is the root of a difference of nearly equal numbers.
  all["ball_span"] = {2, 2e-3, [](int n, int a) { return uniform(n, a, -2, 2); }};
  all["directions"] = {8, 4e-7, [](int n, int a) { return uniform(n, a, a < 3 ? -1 : 0, 1); }};
  all["disk_point"] = {8, 2e-7, [](int n, int a) { return n % 64 ? uniform(n, a, 0, 1) : 0.5f; }};
  all["aimed_density"] = {128, 1e-6, range(-1, 1)};
  all["aimed_strength"] = {2, 0, range(0.1f, 2)};
  all["cone_falloff"] = {2, 3e-7, [](int n, int a) { return uniform(n, a, a == 2 ? 0.1f : -1, a == 1 ? 0 : 1); }};
  all["dda"] = {0, 0, inside_argument};
  all["majorant_walk"] = {0, 0, inside_argument};
  all["grid_stochastic"] = {2, 0, [](int n, int a) { return a < 3 ? uniform(n, a, -7, 23) : random_word(n, a); }};
  all["grid_nearest"] = {2, 0, range(-7.5f, 23.5f)};
  all["grid_linear"] = {2, 3e-7, range(-7, 23.5f)};
  all["brick_is_empty"] = {0, 0, range(-7.5f, 23.5f)};
  // Neighbouring colours of the table have no relation here; black bodies' are within a hundredth of each other.
  all["emission_factor"] = {2, 2e-3, range(-7, 23.5f)};
  all["emission_along_flights"] = {4, 0, range(0, 90)};
  all["cell_mean_linear"] = {2, 3e-7,
                             [](int n, int a) { return a < 3 ? uniform(n, a, 0, 16) : uniform(n, a, 0, 0.5f); }};
  for (const PhaseEntry& entry : phase_functions()) {
    const std::string name(entry.table.name);
    all[name + "_eval"] = {8, 0, phase_arguments(true, -1, name)};
    all[name + "_sample"] = {4, 6e-7, phase_arguments(true, 0, name)};
    all[name + "_mean_cosine"] = {4, 1e-6, phase_arguments(false, 0, name)};
  }
  // Near mu = 0 these have a density as low as 1 / (1 + alpha / 3) of a uniform one, and the iterations end where u is
  // met to a few ulps of 1.
  all["draine_sample"].absolute = 1e-4;
  all["mie_sample"].absolute = 2e-5;
  return all;
}

std::vector<float> make_arguments(const CallShape& shape, const Agreement& agreement) {
  std::vector<float> in(static_cast<std::size_t>(call_count * shape.inputs));
  for (int i = 0; i < shape.inputs; ++i)
    for (int n = 0; n < call_count; ++n) in[static_cast<std::size_t>(i * call_count + n)] = agreement.arguments(n, i);
  return in;
}

int disagreements(const CallShape& shape, const std::vector<float>& a, const std::vector<float>& b,
                  const Agreement& within, std::string& first) {
  int wrong = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (agrees(a[i], b[i], within)) continue;
    if (wrong++ == 0)
      first = std::string(shape.name) + " result " + std::to_string(i / call_count) + " of set " +
              std::to_string(i % call_count) + ": scalar " + std::to_string(a[i]) + ", here " + std::to_string(b[i]) +
              ", " + std::to_string(ulp_distance(a[i], b[i])) + " ulp";
  }
  return wrong;
}

}  // namespace brume
