// The phase functions, to be looked at.
#pragma once

#include <string>
#include <vector>

#include "brume/parameter.h"

namespace brume {

struct PhaseInfo {
  std::string name, meaning;
  std::vector<ParameterInfo> parameters;
};

// The phase functions that media can have.
std::vector<PhaseInfo> phase_infos();

// A phase function over the scattering angle.
struct PhaseCurve {
  std::string title;  // name and parameters, "draine, g = 0.5, alpha = 1"
  double mean_cosine = 0;
  std::vector<double> angles;  // degrees, from 0, straight on, to 180, straight back, in even steps
  std::vector<double> values;  // per steradian: over all directions their integral is 1
};

// `name` with its parameters, of which those left out have their defaults, at `count` >= 2 angles. Throws Error for
// a name or value that makes no sense.
PhaseCurve phase_curve(const std::string& name, const ParameterValues& parameters, int count);

// The smallest and largest decades, as exponents of 10, between which all values lie.
struct Decades {
  int lo = 0, hi = 1;
};
Decades decades(const PhaseCurve& curve);

// Writes a plot to a .png of 480 x 320 pixels: the angle to the right, marked every 45 degrees, the logarithm of the
// value upwards, marked by its decades. Throws Error.
void write_phase_plot(const PhaseCurve& curve, const std::string& path);

}  // namespace brume
