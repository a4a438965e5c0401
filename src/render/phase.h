// Phase functions by kind, from the list that the build makes of src/kernel/phase.
#pragma once

#include "compiled/compiled_scene.h"
#include "kernel/scalar.h"

namespace brume {

// The names of the kinds, as enumerators kind_NAME.
enum PhaseKind {
#define PHASE(name) kind_##name,
#include "kernel/phase_list.inl"
#undef PHASE
};

inline kernel::vec4 phase_numbers(const CompiledMedium& medium) {
  const auto& q = medium.phase_prepared;
  return {q[0], q[1], q[2], q[3]};
}

// The medium's phase function at mu, the cosine between the directions of propagation; per steradian.
inline float phase_eval(const CompiledMedium& medium, float mu) {
  switch (medium.phase) {
#define PHASE(name) \
  case kind_##name: \
    return kernel::name##_eval(mu, phase_numbers(medium));
#include "kernel/phase_list.inl"
#undef PHASE
  }
  return 0;
}

// mu drawn from the medium's phase function, for u in [0, 1).
inline float phase_sample(const CompiledMedium& medium, float u) {
  switch (medium.phase) {
#define PHASE(name) \
  case kind_##name: \
    return kernel::name##_sample(u, phase_numbers(medium));
#include "kernel/phase_list.inl"
#undef PHASE
  }
  return 1;
}

}  // namespace brume
