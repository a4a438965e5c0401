#include "scene/refractive_indices.h"

namespace brume {

namespace {

// pbrt's metals, at the wavelengths that stand for red, green and blue: 617, 549 and 471 nm, photons of 2.01, 2.26 and
// 2.63 eV. Rounded from P. B. Johnson and R. W. Christy, "Optical constants of the noble metals", Phys. Rev. B 6, 1972
// (Ag, Au, Cu); A. D. Rakic, "Algorithm for the determination of intrinsic optical constants of metal films", Appl.
// Opt. 34(22), 1995 (Al); J. R. DeVore, "Refractive indices of rutile and sphalerite", JOSA 41, 1951 (TiO2, ordinary
// ray); R. E. Stephens and I. H. Malitson, "Index of refraction of magnesium oxide", J. Res. NBS 49, 1952 (MgO); for
// brass, M. R. Querry's measurement as it is commonly given for red, green and blue.
constexpr Metal all_metals[] = {{"Ag", {{0.06f, 0.06f, 0.05f}}, {{4.152f, 3.586f, 2.869f}}},
                                {"Al", {{1.29f, 0.97f, 0.68f}}, {{7.43f, 6.65f, 5.67f}}},
                                {"Au", {{0.21f, 0.43f, 1.31f}}, {{3.272f, 2.455f, 1.849f}}},
                                {"Cu", {{0.30f, 1.02f, 1.25f}}, {{3.205f, 2.577f, 2.483f}}},
                                {"CuZn", {{0.444f, 0.527f, 1.094f}}, {{3.695f, 2.765f, 1.829f}}},
                                {"MgO", {{1.736f, 1.740f, 1.746f}}, {{0, 0, 0}}},
                                {"TiO2", {{2.594f, 2.648f, 2.744f}}, {{0, 0, 0}}}};

// pbrt's glasses by their index at 587.6 nm, from their makers' data sheets: there is no dispersion. Its F5, F10 and
// F11 are Schott's SF5, SF10 and SF11.
constexpr Glass all_glasses[] = {{"glass-BK7", 1.5168f},   {"glass-BAF10", 1.6700f}, {"glass-FK51A", 1.4866f},
                                 {"glass-LASF9", 1.8503f}, {"glass-F5", 1.6727f},    {"glass-F10", 1.7283f},
                                 {"glass-F11", 1.7847f}};

}  // namespace

std::span<const Metal> metals() { return all_metals; }
const Metal& copper() { return all_metals[3]; }
std::span<const Glass> glasses() { return all_glasses; }

}  // namespace brume
