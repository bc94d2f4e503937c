// How an image is looked up as a texture.
#pragma once

namespace duet {

enum class TextureFilter { nearest, bilinear };
/// What lies outside the unit square. `zero` and `one` exist in Mitsuba 0.x only.
enum class WrapMode { repeat, mirror, clamp, zero, one };
/// Which channel of the file is used as a number.
/// `number`: as pbrt-v4 does, the mean of the colours, or the alpha of an image that is not opaque.
enum class TextureChannel { all, red, green, blue, alpha, number };

}  // namespace duet
