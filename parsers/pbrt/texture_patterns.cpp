// Textures that are patterns by formulas.
#include <algorithm>
#include <array>

#include "pbrt/texture_readers.h"

namespace duet::pbrt {

namespace {

using enum Status;

constexpr Spec kChecks[] = {{"tex1", kEither, "1"},
                            {"tex2", kEither, "0"},
                            {"dimension", kInteger, "2"},
                            {"aamode", kString, "closedform", "", 1, inert, Versions::v3},
                            DUET_MAPPING_SPECS};

void read_checkerboard(Values& v, const Request& request, Made& made) {
  Reader& reader = v.reader();
  const ColorInput a = color_of(v, request, "tex1"), b = color_of(v, request, "tex2");
  const int dimension = v.integer("dimension");
  if (dimension == 3) {
    set(made, reader.add_texture(SolidCheckerboardDescription{a, b, from_world(v)}, v.where()));
    return;
  }
  if (dimension != 2)
    reader.report().error(v.where("dimension"), "a checkerboard has 2 or 3 dimensions, not {}",
                          dimension);
  CheckerboardTexture board;
  board.to_uv = mapping(v);
  const bool by_uv = v.string("mapping") == "uv";
  // Textures in it keep their own mapping: then the board says only which of the two it is.
  board.color0 = by_uv ? a : ColorInput(Spectrum(0.0f));
  board.color1 = by_uv ? b : ColorInput(Spectrum(1.0f));
  // Mitsuba's squares are half as wide.
  for (auto& row : board.to_uv.m)
    for (double& x : row) x *= 0.5;
  TextureId id = reader.add_texture(board, v.where());
  if (!by_uv) id = reader.add_texture(MixDescription{a, b, mapped(v, id)}, v.where());
  set(made, id);
}

constexpr Spec kBilerp[] = {{"v00", kEither, "0"},
                            {"v01", kEither, "1"},
                            {"v10", kEither, "0"},
                            {"v11", kEither, "1"},
                            DUET_MAPPING_SPECS};

void read_bilerp(Values& v, const Request& request, Made& made) {
  BilerpDescription b;
  const auto corner = [&](const char* name) {
    const ColorInput input = color_of(v, request, name);
    if (const Spectrum* constant = std::get_if<Spectrum>(&input)) return *constant;
    v.reader().report().error(v.where(name), "a corner of bilerp is no texture");
    return Spectrum(0.0f);
  };
  b.v00 = corner("v00"), b.v01 = corner("v01"), b.v10 = corner("v10"), b.v11 = corner("v11");
  b.to_uv = mapping(v);
  set(made, mapped(v, v.reader().add_texture(b, v.where())));
}

constexpr Spec kCoordinates[] = {DUET_MAPPING_SPECS};

/// Red is u and green is v, both from 0 to 1 in each unit square.
void read_coordinates(Values& v, const Request& request, Made& made) {
  if (!request.is_color)
    return v.reader().report().error(v.where(), "texture coordinates are colours, not numbers");
  const BilerpDescription b{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, mapping(v), true};
  set(made, mapped(v, v.reader().add_texture(b, v.where())));
}

constexpr Spec kDots[] = {{"inside", kEither, "1", "around the dots, as pbrt has it"},
                          {"outside", kEither, "0", "in the dots"},
                          DUET_MAPPING_SPECS};

void read_dots(Values& v, const Request& request, Made& made) {
  Reader& reader = v.reader();
  // pbrt's images have "inside" around the dots and "outside" in them.
  const ColorInput b = color_of(v, request, "inside"), a = color_of(v, request, "outside");
  DotsDescription dots;
  dots.to_uv = mapping(v);
  if (v.string("mapping") == "uv") {
    dots.inside = a, dots.outside = b;
    set(made, reader.add_texture(dots, v.where()));
    return;
  }
  // Textures in it keep their own mapping.
  const TextureId where = mapped(v, reader.add_texture(dots, v.where()));
  set(made, reader.add_texture(MixDescription{b, a, where}, v.where()));
}

constexpr Spec kNoise[] = {{"octaves", kInteger, "8"}, {"roughness", kNumber, "0.5"}};
constexpr Spec kMarble[] = {{"octaves", kInteger, "8"},
                            {"roughness", kNumber, "0.5"},
                            {"scale", kNumber, "1"},
                            {"variation", kNumber, "0.2"}};

void add_noise(Values& v, NoiseKind kind, Made& made) {
  NoiseTextureDescription n;
  n.kind = kind;
  n.from_world = from_world(v);
  if (kind != NoiseKind::windy) {
    n.octaves = std::clamp(v.integer("octaves"), 1, 32);
    n.roughness = v.number("roughness");
  }
  if (kind == NoiseKind::marble) n.scale = v.number("scale"), n.variation = v.number("variation");
  set(made, v.reader().add_texture(n, v.where()));
}

template <NoiseKind kind>
void read_noise(Values& v, const Request&, Made& made) {
  add_noise(v, kind, made);
}

constexpr Record<ReadTexture> kPatterns[] = {
    {"checkerboard", Versions::both, done, "never blurred by its distance", kChecks,
     read_checkerboard},
    {"bilerp", Versions::both, done, "", kBilerp, read_bilerp},
    {"uv", Versions::v3, done, "", kCoordinates, read_coordinates},
    {"dots", Versions::both, done, "", kDots, read_dots},
    {"fbm", Versions::both, done, "never blurred by its distance", kNoise,
     read_noise<NoiseKind::fbm>},
    {"wrinkled", Versions::both, done, "never blurred by its distance", kNoise,
     read_noise<NoiseKind::wrinkled>},
    {"windy",
     Versions::both,
     done,
     "never blurred by its distance",
     {},
     read_noise<NoiseKind::windy>},
    {"marble", Versions::both, done, "never blurred by its distance", kMarble,
     read_noise<NoiseKind::marble>},
};

}  // namespace

std::span<const Record<ReadTexture>> pattern_textures() {
  return kPatterns;
}

}  // namespace duet::pbrt
