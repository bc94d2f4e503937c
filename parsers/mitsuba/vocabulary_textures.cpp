#include "mitsuba/readers.h"
#include "mitsuba/vocabulary_tables.h"

namespace duet::vocabulary {

namespace {

constexpr Parameter kToUv{
    .name = "to_uv", .type = transform, .note = "applied to texture coordinates", .versions = v3};
constexpr Parameter kUOffset{.name = "uoffset", .type = number, .preset = "0", .versions = v0};
constexpr Parameter kVOffset{.name = "voffset", .type = number, .preset = "0", .versions = v0};
constexpr Parameter kUScale{
    .name = "uscale", .type = number, .preset = "(uvscale)", .versions = v0};
constexpr Parameter kVScale{
    .name = "vscale", .type = number, .preset = "(uvscale)", .versions = v0};
constexpr Parameter kUvScale{.name = "uvscale", .type = number, .preset = "1", .versions = v0};
constexpr Parameter kCoordinates{
    .name = "coordinates", .type = string, .preset = "uv", .versions = v0, .support = inert};

constexpr Parameter kBitmap[] = {
    {.name = "filename", .type = file, .required = true},
    {.name = "filter_type",
     .type = string,
     .preset = "bilinear",
     .note = "nearest or bilinear; ewa and trilinear of 0.x are approximated by bilinear",
     .preset_0x = "ewa"},
    {"wrap_mode", string, "repeat", "repeat, mirror, clamp; in 0.x also zero and one"},
    {.name = "wrap_mode_u", .type = string, .preset = "(wrap_mode)", .versions = v0},
    {.name = "wrap_mode_v", .type = string, .preset = "(wrap_mode)", .versions = v0},
    {.name = "raw",
     .type = boolean,
     .preset = "false",
     .note = "values are data, not colours",
     .versions = v3},
    {.name = "gamma",
     .type = number,
     .preset = "(of the file)",
     .note = "1: linear, -1: sRGB",
     .versions = v0},
    {.name = "channel",
     .type = string,
     .preset = "(all)",
     .note = "r, g, b or a: use one as a number",
     .versions = v0},
    kToUv,
    kUOffset,
    kVOffset,
    kUScale,
    kVScale,
    kUvScale,
    kCoordinates,
    {.name = "max_anisotropy", .type = number, .versions = v0, .support = inert},
    {.name = "cache", .type = boolean, .versions = v0, .support = inert},
    {.name = "accel", .type = boolean, .versions = v3, .support = inert},
    {.name = "format", .type = string, .versions = v3, .support = inert},
};

constexpr Parameter kCheckerboard[] = {{"color0", reflectance, "0.4"},
                                       {"color1", reflectance, "0.2"},
                                       kToUv,
                                       kUOffset,
                                       kVOffset,
                                       kUScale,
                                       kVScale,
                                       kUvScale,
                                       kCoordinates};

constexpr Parameter kMeshAttribute[] = {
    {.name = "name", .type = string, .note = "vertex_… or face_…", .required = true},
    {"scale", number, "1"}};

constexpr Parameter kScaleTexture[] = {{.name = "scale",
                                        .type = unbounded,
                                        .preset = "1",
                                        .note = "number or colour",
                                        .aliases = "value"}};

constexpr Parameter kUniform[] = {{.name = "value", .type = number, .preset = "1"},
                                  {.name = "wavelength_min", .type = number, .support = inert},
                                  {.name = "wavelength_max", .type = number, .support = inert}};
constexpr Parameter kSrgb[] = {{.name = "color", .type = unbounded, .required = true},
                               {"unbounded", boolean, "false"}};
constexpr Parameter kD65[] = {{"color", unbounded, "1"},
                              {"scale", number, "1"},
                              {.name = "value", .type = number, .preset = "1", .support = inert}};
constexpr Parameter kRawConstant[] = {{.name = "value", .type = unbounded, .required = true}};
constexpr Parameter kIrregular[] = {{.name = "wavelengths", .type = string, .required = true},
                                    {.name = "values", .type = string, .required = true}};
constexpr Parameter kRegular[] = {{.name = "wavelength_min", .type = number, .required = true},
                                  {.name = "wavelength_max", .type = number, .required = true},
                                  {.name = "values", .type = string, .required = true}};
constexpr Parameter kBlackbody[] = {{.name = "temperature",
                                     .type = number,
                                     .note = "in kelvin",
                                     .range = positive,
                                     .required = true},
                                    {.name = "wavelength_min", .type = number, .support = inert},
                                    {.name = "wavelength_max", .type = number, .support = inert}};

constexpr Parameter kVolume[] = {{"volume", albedo, "0.75"}};
constexpr Parameter kGridTexture[] = {
    {"color0", reflectance, "0.2", "of the fields"},
    {"color1", reflectance, "0.4", "of the lines"},
    {"line_width", number, "0.01", "into each field", not_negative},
    kUOffset,
    kVOffset,
    kUScale,
    kVScale,
    kUvScale,
    kCoordinates};

constexpr Parameter kCurvature[] = {{"curvature", string, "gaussian", "gaussian or mean"},
                                    {.name = "scale",
                                     .type = number,
                                     .note = "of the curvature: red up to 1, blue down to -1",
                                     .range = not_negative,
                                     .required = true}};
constexpr Parameter kWireframe[] = {
    {"interior_color", unbounded, "0.5", "constant"},
    {"edge_color", unbounded, "0.1", "constant"},
    {"line_width", number, "0", "0: a tenth of a mesh's mean edge length", not_negative},
    {"step_width", number, "0.5",
     "share of the line width over which the colours change; limited to 0 to 1"}};

constexpr Plugin kTextures[] = {
    {"bitmap", both, kBitmap, &read_bitmap},
    {"checkerboard", both, kCheckerboard, &read_checkerboard},
    {"mesh_attribute", v3, kMeshAttribute, &read_mesh_attribute},
    {"vertexcolors", v0, {}, &read_vertexcolors},
    {"scale", v0, kScaleTexture, &read_scale, "holds a texture"},
    {"uniform", v3, kUniform, &read_uniform},
    {"srgb", v3, kSrgb, &read_srgb},
    {.name = "d65", .versions = v3, .parameters = kD65, .reader = &read_d65, .aliases = "srgb_d65"},
    {"rawconstant", v3, kRawConstant, &read_rawconstant},
    {"irregular", v3, kIrregular, &read_irregular},
    {"regular", v3, kRegular, &read_regular},
    {"blackbody", v3, kBlackbody, &read_blackbody},
    {"volume", v3, kVolume, &read_volume_texture, "looked up in the world"},
    {"gridtexture", v0, kGridTexture, &read_gridtexture},
    {"curvature", v0, kCurvature, &read_curvature,
     "not on curves; instances show that of the shape before it is placed"},
    {"wireframe", v0, kWireframe, &read_wireframe,
     "on meshes and cubes, other shapes are all interior; instances show the lines of the mesh "
     "before it is placed"},
};

}  // namespace

std::span<const Plugin> textures() {
  return kTextures;
}

}  // namespace duet::vocabulary
