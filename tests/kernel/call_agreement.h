// What two builds of the kernel functions are given, and how far apart their results may be. Two results agree within a
// number of ulps, or within an absolute difference where results pass through 0.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "kernel/call_kernels.h"

namespace brume {

// The sets of arguments that each function is called with.
constexpr int call_count = 16 * 4096;

struct Agreement {
  int ulps = 0;
  double absolute = 0;
  std::function<float(int n, int argument)> arguments;  // argument number `argument` of set `n`
};

// By the function's name.
std::map<std::string, Agreement, std::less<>> agreements();

std::vector<float> make_arguments(const CallShape& shape, const Agreement& agreement);

// The number of results of `b` that disagree with the scalar build's, `a`; describes the first.
int disagreements(const CallShape& shape, const std::vector<float>& a, const std::vector<float>& b,
                  const Agreement& within, std::string& first);

}  // namespace brume
