// The integrators that solve the whole of volumetric light transport: what holds for one must hold for all.
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace brume {

inline auto path_tracers() { return ::testing::Values("reference", "volpath"); }

// For INSTANTIATE_TEST_SUITE_P.
inline std::string integrator_name(const ::testing::TestParamInfo<const char*>& test) { return test.param; }

}  // namespace brume
