// Reads the material libraries of OBJ files (.mtl).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace duet {

/// One material of a library, as far as Mitsuba 0.6 understands it.
struct MtlMaterial {
  /// A number, a colour or an image; of several lines about one thing the last counts.
  struct Value {
    std::array<double, 3> numbers{};  ///< a single number is all three
    std::string image;                ///< as the library names it, or "" for the numbers
    int line = 0;                     ///< 0 if the library does not say
  };
  std::string name;
  int line = 0;
  Value diffuse, specular;  ///< Kd, Ks, map_Kd, map_Ks; colours as in the file, sRGB
  Value exponent;           ///< Ns
  Value opacity;            ///< d, map_d; absent if it is 1
  Value bump;
  int illum = 0;
};

/// In the order of the file. Lines that end in a backslash go on in the next. Keywords other than
/// the above are passed over, and so is what follows the values of a line. Throws ReadError
/// "file:line: message" for values that are no finite numbers or missing, and for materials without
/// a name.
std::vector<MtlMaterial> parse_mtl(std::string_view text, const std::string& file);

}  // namespace duet
