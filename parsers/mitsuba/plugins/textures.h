// The textures and spectra of Mitsuba that mean more than their fields say: each function makes the
// row of one plugin, together with how it is read.
#pragma once

#include <optional>

#include "mitsuba/vocabulary.h"

namespace duet::plugins {

/// All of them, in the order in which they are listed.
std::vector<Plugin> textures();

// texture_bitmap.cpp
Plugin bitmap();
/// An error unless the parameter "gamma" has a value that means something.
void check_gamma(Properties& p, std::optional<double> gamma);
// spectra.cpp
std::vector<Plugin> spectra();

}  // namespace duet::plugins
