// Reads Mitsuba 0.6's descriptions of woven cloth (.wv), which are a small language.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "math/spectrum.h"

namespace duet {

/// A colour, or the name of the parameter of the scene that has it.
struct WeaveColor {
  Spectrum value;
  std::string parameter;
};

struct Yarn {
  WeaveColor diffuse, specular;
};

/// What a repeated tile of cloth shows: of its cells, the yarns that are on top.
struct Weave {
  std::vector<Yarn> yarns;
  std::vector<uint32_t> pattern;  ///< indices of yarns, one for each cell

  /// How much of the cloth each yarn is.
  std::vector<float> shares() const;
};

/// Reads `weave { name = value, …, pattern { n, … }, yarn { … }, … }`, where comments are as in C
/// and values are numbers, colours in braces, texts, words, or `$name`. How fibres are twisted and
/// bent is read and not kept. Throws ReadError "file:line: message". A weave that is returned has
/// cells, each of a yarn, and finite colours that are not negative.
Weave parse_weave(std::string_view text, const std::string& file);

}  // namespace duet
