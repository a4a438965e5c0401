// Phase functions by kind, from the list that the build makes of src/kernel/phase.
#pragma once

#include "compiled/compiled_scene.h"
#include "kernel/scalar.h"

namespace brume {

// The medium's phase function at mu, the cosine between the directions of propagation; per steradian.
inline float phase_eval(const CompiledMedium& medium, float mu) {
  const auto& q = medium.phase_prepared;
  const kernel::vec4 p(q[0], q[1], q[2], q[3]);
  enum {
#define PHASE(name) kind_##name,
#include "kernel/phase_list.inl"
#undef PHASE
  };
  switch (medium.phase) {
#define PHASE(name) \
  case kind_##name: \
    return kernel::name##_eval(mu, p);
#include "kernel/phase_list.inl"
#undef PHASE
  }
  return 0;
}

}  // namespace brume
