// Numbers that a correct renderer of participating media reproduces, each with the scene that shows it and a fault that
// the number would show: one table, which every integrator that solves the whole of light transport is held to.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "render/estimates.h"

namespace brume {

// Something that a renderer could get wrong, as a change to the scene that has the same effect.
struct Fault {
  const char* name;
  void (*plant)(SceneDescription&);
};

struct Case {
  std::string name;
  SceneDescription scene;  // for one integrator or another
  std::vector<Expected> expected;
  Fault fault;
};

// How GoogleTest shows a case.
inline void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::vector<Case> transport_cases();

// Of which these are the slabs and half-spaces.
void add_slabs(std::vector<Case>& all);
void add_half_spaces(std::vector<Case>& all);

}  // namespace brume
