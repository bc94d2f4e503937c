// Indices of refraction by the names of materials.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/spectrum.h"

namespace duet {

/// Index of refraction at 589 nm and room temperature.
struct DielectricEntry {
  const char* name;
  double ior;
};

/// Complex index of refraction, its real part η and its imaginary part k, as linear sRGB.
struct ConductorEntry {
  const char* name;
  Spectrum eta, k;
};

/// All names of Mitsuba 0.6 and 3 (they are the same).
std::span<const DielectricEntry> dielectrics();
std::span<const ConductorEntry> conductors();

/// Names of dielectrics are found in any case, those of conductors exactly.
std::optional<double> find_dielectric(std::string_view name);
const ConductorEntry* find_conductor(std::string_view name);

/// The part of a conductor's index, called "eta" or "k", in a file that comes with Mitsuba, by the
/// file's name: data/ior/Au.eta.spd and the like. Null for others.
const Spectrum* index_of_file(std::string_view part, std::string_view file);

std::vector<std::string> dielectric_names();
std::vector<std::string> conductor_names();

}  // namespace duet
