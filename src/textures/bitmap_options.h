// How an image is looked up as a texture.
#pragma once

namespace duet {

enum class TextureFilter { nearest, bilinear };
/// What lies outside the unit square. `zero` and `one` exist in Mitsuba 0.x only.
enum class WrapMode { repeat, mirror, clamp, zero, one };
/// Which channel of the file is used as a number.
enum class TextureChannel { all, red, green, blue, alpha };

}  // namespace duet
