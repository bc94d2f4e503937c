// The kinds of procedural textures and of what is done with others, as descriptions name them.
#pragma once

namespace duet {

/// Forms of noise in space. Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd ed.,
/// 2016, section 10.6.
enum class NoiseKind {
  fbm,       ///< fractal_noise()
  wrinkled,  ///< turbulence()
  windy,     ///< |fbm of three octaves at a tenth of the frequency| · fbm of six octaves
  marble,    ///< colours by the sine of y, which fbm moves
};

/// From space to texture coordinates, in the space of the texture.
enum class SpaceMapKind {
  spherical,    ///< s = θ / π from +z, t = φ / 2π from +x towards +y
  cylindrical,  ///< s = 1/2 + φ / 2π with φ in [−π, π], t = z
  planar,       ///< s = x, t = y
};

/// What is made of the values of a texture.
enum class TextureFunction {
  inverse,       ///< max(0, 1 − x)
  root,          ///< √max(0, x): pbrt-v4's roughness to α
  v3_roughness,  ///< pbrt-v3's: a polynomial of log max(x, 10⁻³)
  metal_k,  ///< 2√x / √(1 − x), x at most 0.9999: the k with which a metal of η = 1 reflects x
  positive,  ///< 1 above zero, else 0: what pbrt-v3 makes of an alpha
};

}  // namespace duet
