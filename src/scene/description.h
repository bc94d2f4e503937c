// The scene as plain data: what every parser yields and what build() makes a Scene of.
//
// A description has one meaning, whatever file version it came from: colours are linear sRGB,
// parameters have their names and units of Mitsuba 3, references are indices, meshes are loaded.
// Two descriptions compare equal if they describe the same scene; places and names do not count.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/diagnostics.h"
#include "geometry/curves.h"
#include "geometry/mesh.h"
#include "geometry/sdf_grid.h"
#include "image/filter.h"
#include "materials/measured_table.h"
#include "materials/microfacet_kind.h"
#include "materials/ward_variant.h"
#include "math/fov.h"
#include "math/motion.h"
#include "math/spectrum.h"
#include "math/transform.h"
#include "media/volume_grid.h"
#include "textures/bitmap_options.h"
#include "textures/curvature_kind.h"

namespace duet {

/// Indices into the arrays of a SceneDescription.
enum class TextureId : uint32_t {};
enum class MaterialId : uint32_t {};
enum class VolumeId : uint32_t {};
enum class PhaseId : uint32_t {};
enum class MediumId : uint32_t {};

/// A parameter that is either a constant or a texture.
using ColorInput = std::variant<Spectrum, TextureId>;
using FloatInput = std::variant<double, TextureId>;

/// How a thing is called in the file, for messages; it does not count in comparisons.
struct Label {
  std::string text;
  friend bool operator==(const Label&, const Label&) { return true; }
};

// ---- Textures ---------------------------------------------------------------------------------

struct BitmapTexture {
  std::string file;  ///< resolved path
  TextureFilter filter = TextureFilter::bilinear;
  WrapMode wrap_u = WrapMode::repeat, wrap_v = WrapMode::repeat;
  /// Values are data, not colours: nothing is decoded.
  bool raw = false;
  /// Overrides the file's transfer curve: 1 is linear, −1 sRGB, another number a power. Absent:
  /// sRGB for 8-bit files, linear for floating-point files.
  std::optional<double> gamma;
  TextureChannel channel = TextureChannel::all;
  UvTransform to_uv;
  bool operator==(const BitmapTexture&) const = default;
};

struct CheckerboardTexture {
  ColorInput color0 = Spectrum(0.4f), color1 = Spectrum(0.2f);
  /// Where a number is asked for (a roughness, an opacity), Mitsuba 3 exchanges the two colours;
  /// 0.x does not.
  bool swap_values = false;
  UvTransform to_uv;
  bool operator==(const CheckerboardTexture&) const = default;
};

struct MeshAttributeTexture {
  std::string attribute;
  double scale = 1;
  bool operator==(const MeshAttributeTexture&) const = default;
};

/// Unit squares of texture coordinates with lines that reach line_width into each.
struct GridLinesTexture {
  ColorInput color0 = Spectrum(0.2f), color1 = Spectrum(0.4f);
  double line_width = 0.01;
  UvTransform to_uv;
  bool operator==(const GridLinesTexture&) const = default;
};
/// The edges of triangles.
struct WireframeTexture {
  Spectrum interior{0.5f}, edge{0.1f};
  /// As far from an edge as it reaches; without: a tenth of a mesh's mean edge length.
  std::optional<double> line_width;
  /// The share of the line width, at its end, over which the colours change.
  double step_width = 0.5;
  bool operator==(const WireframeTexture&) const = default;
};
/// Curvature times a scale: positive red, negative blue.
struct CurvatureTexture {
  CurvatureKind shown = CurvatureKind::gaussian;
  double scale = 1;
  bool operator==(const CurvatureTexture&) const = default;
};
/// Another texture times a colour.
struct ScaledTextureDescription {
  TextureId inner{};
  Spectrum scale{1.0f};
  bool operator==(const ScaledTextureDescription&) const = default;
};
/// A volume, looked up in the world.
struct VolumeTextureDescription {
  std::variant<Spectrum, VolumeId> volume = Spectrum(0.75f);
  bool operator==(const VolumeTextureDescription&) const = default;
};

struct TextureDescription {
  SourceLocation where;
  Label label;
  std::variant<BitmapTexture, CheckerboardTexture, MeshAttributeTexture, GridLinesTexture,
               WireframeTexture, CurvatureTexture, ScaledTextureDescription,
               VolumeTextureDescription>
      model;
  bool operator==(const TextureDescription&) const = default;
};

// ---- Materials --------------------------------------------------------------------------------

/// A rough interface; absent where the interface is smooth.
struct Roughness {
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
  FloatInput alpha_u = 0.1, alpha_v = 0.1;
  bool sample_visible = true;
  bool operator==(const Roughness&) const = default;
};

struct DiffuseMaterial {
  ColorInput reflectance = Spectrum(0.5f);
  bool operator==(const DiffuseMaterial&) const = default;
};

/// `eta` and `k` are relative to the outside. A perfect mirror has eta = 0 and k = 1.
struct ConductorMaterial {
  ColorInput eta = Spectrum(0.0f), k = Spectrum(1.0f);
  ColorInput specular_reflectance = Spectrum(1.0f);
  std::optional<Roughness> roughness;
  bool operator==(const ConductorMaterial&) const = default;
};

struct DielectricMaterial {
  FloatInput eta = 1.5046 / 1.000277;  ///< inside over outside
  ColorInput specular_reflectance = Spectrum(1.0f), specular_transmittance = Spectrum(1.0f);
  std::optional<Roughness> roughness;
  bool operator==(const DielectricMaterial&) const = default;
};

struct ThinDielectricMaterial {
  double eta = 1.5046 / 1.000277;
  ColorInput specular_reflectance = Spectrum(1.0f), specular_transmittance = Spectrum(1.0f);
  bool operator==(const ThinDielectricMaterial&) const = default;
};

struct PlasticMaterial {
  double eta = 1.49 / 1.000277;
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(1.0f);
  bool nonlinear = false;
  std::optional<Roughness> roughness;  ///< isotropic: alpha_v equals alpha_u
  bool operator==(const PlasticMaterial&) const = default;
};

/// Burley 2012 and 2015, as parametrised by Mitsuba 3.
struct PrincipledMaterial {
  ColorInput base_color = Spectrum(0.5f);
  FloatInput roughness = 0.5, anisotropic = 0.0, metallic = 0.0, spec_trans = 0.0;
  /// The index of refraction, or Burley's `specular`; Mitsuba takes one of them.
  double eta = 1.5;
  std::optional<double> specular;
  FloatInput spec_tint = 0.0, sheen = 0.0, sheen_tint = 0.0, flatness = 0.0;
  FloatInput clearcoat = 0.0, clearcoat_gloss = 0.0;
  double diffuse_reflectance_sampling_rate = 1, main_specular_sampling_rate = 1,
         clearcoat_sampling_rate = 1;
  bool operator==(const PrincipledMaterial&) const = default;
};

struct PrincipledThinMaterial {
  ColorInput base_color = Spectrum(0.5f);
  FloatInput roughness = 0.5, anisotropic = 0.0, spec_trans = 0.0, eta = 1.5, spec_tint = 0.0,
             sheen = 0.0, sheen_tint = 0.0, flatness = 0.0, diff_trans = 0.0;
  double spec_reflectance_sampling_rate = 1, spec_transmittance_sampling_rate = 1,
         diffuse_reflectance_sampling_rate = 1, diffuse_transmittance_sampling_rate = 1;
  bool operator==(const PrincipledThinMaterial&) const = default;
};

struct PhongMaterial {
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(0.2f);
  FloatInput exponent = 30.0;
  bool operator==(const PhongMaterial&) const = default;
};

struct WardMaterial {
  WardVariant variant = WardVariant::balanced;
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(0.2f);
  FloatInput alpha_u = 0.1, alpha_v = 0.1;
  bool operator==(const WardMaterial&) const = default;
};

struct RoughDiffuseMaterial {
  ColorInput reflectance = Spectrum(0.5f);
  FloatInput alpha = 0.2;
  bool use_fast_approx = false;
  bool operator==(const RoughDiffuseMaterial&) const = default;
};

struct DiffuseTransmitterMaterial {
  ColorInput transmittance = Spectrum(0.5f);
  bool operator==(const DiffuseTransmitterMaterial&) const = default;
};

/// Chiang et al. 2016, as parametrised by Mitsuba 3; absorption is per radius.
struct HairMaterial {
  double longitudinal_roughness = 0.3, azimuthal_roughness = 0.3;
  double scale_tilt = 2;  ///< in degrees
  double eta = 1.55 / 1.000277;
  /// Concentrations, unless `sigma_a` is given.
  double eumelanin = 1.3, pheomelanin = 0.2;
  std::optional<ColorInput> sigma_a;
  double scale = 1;  ///< of sigma_a
  bool operator==(const HairMaterial&) const = default;
};

struct MeasuredMaterial {
  std::shared_ptr<const MeasuredTable> table;
  std::string file;
  friend bool operator==(const MeasuredMaterial& a, const MeasuredMaterial& b) {
    return a.table == b.table || (a.table && b.table && *a.table == *b.table);
  }
};

/// Baek et al. 2018 without polarisation.
struct PolarizedPlasticMaterial {
  double eta = 1.49 / 1.000277;
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(1.0f);
  Roughness interface;
  bool operator==(const PolarizedPlasticMaterial&) const = default;
};

/// Mitsuba's filters for polarised light, which weaken light without polarisation.
enum class FilterKindOfLight { polarizer, retarder, circular };
struct FilterMaterial {
  FilterKindOfLight kind = FilterKindOfLight::polarizer;
  ColorInput transmittance = Spectrum(1.0f);
  bool operator==(const FilterMaterial&) const = default;
};

/// A clear coat over another material.
struct CoatingMaterial {
  double eta = 1.5046 / 1.000277, thickness = 1;
  ColorInput sigma_a = Spectrum(0.0f), specular_reflectance = Spectrum(1.0f);
  std::optional<Roughness> roughness;  ///< isotropic: alpha_v equals alpha_u
  MaterialId nested{};
  bool operator==(const CoatingMaterial&) const = default;
};

/// Single scattering in a layer of a medium: Hanrahan & Krueger 1993.
struct ThinLayerMaterial {
  ColorInput sigma_s = Spectrum(1.0f), sigma_a = Spectrum(0.0f);
  double thickness = 1, g = 0;
  bool operator==(const ThinLayerMaterial&) const = default;
};

struct TwoSidedMaterial {
  MaterialId front{}, back{};
  bool operator==(const TwoSidedMaterial&) const = default;
};

struct MaskMaterial {
  FloatInput opacity = 0.5;
  MaterialId nested{};
  bool operator==(const MaskMaterial&) const = default;
};

/// (1 − weight) · first + weight · second.
struct BlendMaterial {
  FloatInput weight = 0.5;
  MaterialId first{}, second{};
  bool operator==(const BlendMaterial&) const = default;
};

/// Σ weight · material; the weights are positive and sum to at most one.
struct MixtureMaterial {
  std::vector<std::pair<double, MaterialId>> parts;
  bool operator==(const MixtureMaterial&) const = default;
};

struct BumpMapMaterial {
  TextureId height{};
  double scale = 1;
  bool flip_invalid_normals = true, use_shadowing_function = true;
  MaterialId nested{};
  bool operator==(const BumpMapMaterial&) const = default;
};

struct NormalMapMaterial {
  TextureId normals{};
  bool flip_invalid_normals = true, use_shadowing_function = true;
  MaterialId nested{};
  bool operator==(const NormalMapMaterial&) const = default;
};

struct NullMaterial {
  bool operator==(const NullMaterial&) const = default;
};

struct MaterialDescription {
  SourceLocation where;
  Label label;
  std::variant<DiffuseMaterial, ConductorMaterial, DielectricMaterial, ThinDielectricMaterial,
               PlasticMaterial, PrincipledMaterial, PrincipledThinMaterial, TwoSidedMaterial,
               MaskMaterial, BlendMaterial, BumpMapMaterial, NormalMapMaterial, NullMaterial,
               PhongMaterial, WardMaterial, RoughDiffuseMaterial, DiffuseTransmitterMaterial,
               MixtureMaterial, HairMaterial, MeasuredMaterial, PolarizedPlasticMaterial,
               FilterMaterial, CoatingMaterial, ThinLayerMaterial>
      model;
  bool operator==(const MaterialDescription&) const = default;
};

// ---- Media -------------------------------------------------------------------------------------

/// A parameter that is either the same everywhere or varies in space.
using ColorVolume = std::variant<Spectrum, VolumeId>;
using FloatVolume = std::variant<double, VolumeId>;

/// A grid that fills the unit cube of its own space.
struct VolumeDescription {
  SourceLocation where;
  Label label;
  std::string file;  ///< resolved path, or "" for a grid made by the program
  std::shared_ptr<const VolumeGrid> grid;
  /// Whether Mitsuba 3 can read the file: it knows only 32-bit floating-point numbers.
  bool is_float32 = true;
  Matrix4 to_world;
  VolumeFilter filter = VolumeFilter::trilinear;
  VolumeWrap wrap = VolumeWrap::clamp;
  /// The outermost nodes lie on the cube's faces (0.x), not half a cell inside them (3.x).
  bool nodes_on_faces = false;
  friend bool operator==(const VolumeDescription& a, const VolumeDescription& b) {
    return a.to_world == b.to_world && a.filter == b.filter && a.wrap == b.wrap &&
           a.nodes_on_faces == b.nodes_on_faces &&
           (a.grid == b.grid || (a.grid && b.grid && *a.grid == *b.grid));
  }
};

struct IsotropicPhase {
  bool operator==(const IsotropicPhase&) const = default;
};
/// Henyey & Greenstein 1941; g is the mean cosine of the deflection.
struct HenyeyGreensteinPhase {
  double g = 0.8;
  bool operator==(const HenyeyGreensteinPhase&) const = default;
};
struct RayleighPhase {
  bool operator==(const RayleighPhase&) const = default;
};
/// Values at equidistant cosines of the deflection from −1 (back) to 1 (straight on), linear in
/// between; of any scale.
struct TabulatedPhase {
  std::vector<double> values;
  bool operator==(const TabulatedPhase&) const = default;
};
/// Microflakes whose normals are those of an ellipsoid, given by the matrix xx, yy, zz, xy, xz, yz
/// (Heitz et al. 2015). Scales the extinction by the flakes' projected area.
struct SggxPhase {
  std::variant<std::array<double, 6>, VolumeId> matrix = std::array<double, 6>{1, 1, 1, 0, 0, 0};
  bool operator==(const SggxPhase&) const = default;
};
/// (1 − weight) · first + weight · second.
struct BlendPhase {
  FloatVolume weight = 0.5;
  PhaseId first{}, second{};
  bool operator==(const BlendPhase&) const = default;
};

struct PhaseDescription {
  SourceLocation where;
  Label label;
  std::variant<IsotropicPhase, HenyeyGreensteinPhase, RayleighPhase, TabulatedPhase, SggxPhase,
               BlendPhase>
      model;
  bool operator==(const PhaseDescription&) const = default;
};

/// Scatters and absorbs: extinction σ_t · scale per unit of length, of which `albedo` is scattered.
struct MediumDescription {
  SourceLocation where;
  Label label;
  ColorVolume sigma_t = Spectrum(1.0f), albedo = Spectrum(0.75f);
  double scale = 1;
  PhaseId phase{};
  bool operator==(const MediumDescription&) const = default;
};

// ---- Shapes -----------------------------------------------------------------------------------

/// Where a mesh came from, so that a description can be written out again.
struct MeshSource {
  std::string file;     ///< resolved path, or "" for a mesh made by the program
  std::string plugin;   ///< obj, ply, serialized
  int shape_index = 0;  ///< of a serialized file
  bool face_normals = false;
  bool flip_tex_coords = true;
  std::optional<double> max_smooth_angle;
  /// Not the whole OBJ file: one of its parts, or those of one material.
  bool is_part = false;
};

/// The mesh in its own space. Shapes may share one.
struct MeshShape {
  std::shared_ptr<const TriangleMesh> mesh;
  MeshSource source;
  friend bool operator==(const MeshShape& a, const MeshShape& b) {
    return a.mesh == b.mesh || (a.mesh && b.mesh && *a.mesh == *b.mesh);
  }
};
struct RectangleShape {
  bool operator==(const RectangleShape&) const = default;
};
struct CubeShape {
  bool operator==(const CubeShape&) const = default;
};
/// Unit shapes; a centre, radius or end points are part of `to_world`.
struct SphereShape {
  bool operator==(const SphereShape&) const = default;
};
struct DiskShape {
  bool operator==(const DiskShape&) const = default;
};
struct CylinderShape {
  bool operator==(const CylinderShape&) const = default;
};
/// A surface of zero distance.
struct SdfGridShape {
  std::shared_ptr<const SdfGrid> grid;
  std::string file;
  friend bool operator==(const SdfGridShape& a, const SdfGridShape& b) {
    return a.grid == b.grid || (a.grid && b.grid && *a.grid == *b.grid);
  }
};
/// Tubes, in the shape's own space; `to_world` moves their points but leaves the radii.
struct CurvesShape {
  std::shared_ptr<const CurveSet> curves;
  std::string file;
  friend bool operator==(const CurvesShape& a, const CurvesShape& b) {
    return a.curves == b.curves || (a.curves && b.curves && *a.curves == *b.curves);
  }
};
/// Bilinear patches over the square from (−1, −1) to (1, 1), facing +z, between heights that are
/// the luminance of a texture's texels times `scale`; its first row lies along y = −1.
struct HeightFieldShape {
  TextureId heights{};
  double scale = 1;
  int width = 32, height = 32;  ///< of a texture that is no image
  bool shading_normals = true;  ///< smooth from patch to patch
  /// Makes a number of heights that is one more than a power of two along either side.
  FilterDescription filter{.kind = FilterKind::lanczos, .lobes = 2};
  bool operator==(const HeightFieldShape&) const = default;
};
/// A copy of SceneDescription::groups[group].
struct InstanceShape {
  uint32_t group = 0;
  bool operator==(const InstanceShape&) const = default;
};

/// Radiance of a surface that emits.
struct AreaEmission {
  SourceLocation where;
  ColorInput radiance = Spectrum(1.0f);
  double sampling_weight = 1;  ///< as in LightDescription
  /// Light leaves along the normals only; `radiance` is power per unit area.
  bool directional = false;
  bool operator==(const AreaEmission&) const = default;
};

struct ShapeDescription {
  SourceLocation where;
  Label label;
  std::variant<MeshShape, RectangleShape, CubeShape, SphereShape, DiskShape, CylinderShape,
               InstanceShape, SdfGridShape, CurvesShape, HeightFieldShape>
      geometry;
  Matrix4 to_world;
  Motion motion;  ///< of what `to_world` has placed
  bool flip_normals = false;
  MaterialId material{};  ///< not used by instances
  std::optional<AreaEmission> emission;
  /// What fills the space behind and before the surface. A surface with neither of them changes
  /// nothing; one with either stands between the two, and the one that is absent is empty space.
  std::optional<MediumId> interior, exterior;
  bool operator==(const ShapeDescription&) const = default;
};

struct ShapeGroupDescription {
  SourceLocation where;
  Label label;
  std::vector<ShapeDescription> shapes;
  bool operator==(const ShapeGroupDescription&) const = default;
};

// ---- Lights that are not surfaces -------------------------------------------------------------

/// Radiant intensity in all directions, W/sr.
struct PointLight {
  Spectrum intensity{1.0f};
  bool operator==(const PointLight&) const = default;
};
/// At the origin of its transform, along +z. Angles in degrees from the axis: full intensity within
/// beam_width, none beyond cutoff_angle, linear in the angle between.
struct SpotLight {
  Spectrum intensity{1.0f};
  double cutoff_angle = 20, beam_width = 15;
  std::optional<TextureId> texture;
  bool operator==(const SpotLight&) const = default;
};
/// A pinhole camera turned around: throws the texture through a frustum along +z.
struct ProjectorLight {
  ColorInput irradiance = Spectrum(1.0f);
  double scale = 1;
  double fov = 45;
  FovAxis fov_axis = FovAxis::x;
  bool operator==(const ProjectorLight&) const = default;
};
/// Irradiance on a plane across the direction +z.
struct DirectionalLight {
  Spectrum irradiance{1.0f};
  bool operator==(const DirectionalLight&) const = default;
};
struct ConstantLight {
  Spectrum radiance{1.0f};
  bool operator==(const ConstantLight&) const = default;
};
/// A latitude–longitude image around the scene, +y up.
struct EnvironmentMapLight {
  std::string file;  ///< resolved path
  double scale = 1;
  std::optional<double> gamma;  ///< as in BitmapTexture
  bool operator==(const EnvironmentMapLight&) const = default;
};

/// Hosek and Wilkie's sky with the sun in it; +z is up.
struct SkyLight {
  double turbidity = 3;
  Spectrum albedo{0.3f};
  std::array<double, 3> sun{0, 0, 1};  ///< direction to the sun, not zero
  double sky_scale = 1, sun_scale = 1;
  double sun_aperture = 0.5358;  ///< degrees
  double stretch = 1;            ///< 0.x: how far the sky is drawn beyond the horizon
  bool extend = false;           ///< 0.x: the horizon goes on below
  bool operator==(const SkyLight&) const = default;
};
/// A thin beam along +z, in watts.
struct CollimatedLight {
  Spectrum power{1.0f};
  bool operator==(const CollimatedLight&) const = default;
};

struct LightDescription {
  SourceLocation where;
  Label label;
  std::variant<PointLight, SpotLight, ProjectorLight, DirectionalLight, ConstantLight,
               EnvironmentMapLight, SkyLight, CollimatedLight>
      model;
  Matrix4 to_world;
  Motion motion;  ///< as in ShapeDescription; environments only turn
  /// Multiplies the light's share in the choice of a light (`sampling_weight`).
  double sampling_weight = 1;
  std::optional<MediumId> medium;  ///< that the light stands in
  bool operator==(const LightDescription&) const = default;
};

// ---- Sensor, film, sampler --------------------------------------------------------------------

enum class SensorKind {
  perspective,
  thinlens,
  orthographic,
  telecentric,
  perspective_rdist,
  spherical,
  radiancemeter,
  irradiancemeter,
  fluencemeter,
  distant,
  batch,
};
/// Its name in Mitsuba.
constexpr const char* sensor_name(SensorKind k) {
  constexpr const char* names[] = {
      "perspective",       "thinlens",  "orthographic",  "telecentric",
      "perspective_rdist", "spherical", "radiancemeter", "irradiancemeter",
      "fluencemeter",      "distant",   "batch"};
  return names[size_t(k)];
}
/// Whether points of the scene can be joined with the sensor: Camera::connectible().
constexpr bool is_connectible(SensorKind k) {
  return k == SensorKind::perspective || k == SensorKind::thinlens ||
         k == SensorKind::orthographic || k == SensorKind::perspective_rdist ||
         k == SensorKind::spherical;
}
/// Whether a field of view says what the sensor sees.
constexpr bool has_fov(SensorKind k) {
  return k == SensorKind::perspective || k == SensorKind::thinlens ||
         k == SensorKind::perspective_rdist;
}
enum class PixelFormat { luminance, luminance_alpha, rgb, rgba, xyz, xyza };
enum class ComponentFormat { half, single };

/// A window of the film in pixels.
struct CropWindow {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const CropWindow&) const = default;
};

/// How 0.6's ldrfilm turns radiance into display values. Used for PNG and JPEG output only.
struct ToneMapping {
  bool reinhard = false;
  double gamma = -1;            ///< −1 is the sRGB curve
  double exposure = 0;          ///< in stops
  double key = 0.18, burn = 0;  ///< Reinhard's operator
  bool operator==(const ToneMapping&) const = default;
};

struct FilmDescription {
  SourceLocation where;
  int width = 768, height = 576;
  std::optional<CropWindow> crop;
  FilterDescription filter;
  PixelFormat pixel_format = PixelFormat::rgb;
  ComponentFormat component_format = ComponentFormat::half;
  std::optional<ToneMapping> tone_mapping;
  bool operator==(const FilmDescription&) const = default;
};

struct SamplerDescription {
  std::string name = "independent";  ///< as the scene calls it
  int sample_count = 4;
  uint64_t seed = 0;
  bool operator==(const SamplerDescription&) const = default;
};

struct SensorDescription {
  SourceLocation where;
  Label label;
  SensorKind kind = SensorKind::perspective;
  Matrix4 to_world;  ///< looks along +z, +x to the left of the image, +y up
  Motion motion;     ///< as in ShapeDescription
  /// When the shutter opens and closes, not before. Light is gathered evenly in between.
  std::array<double, 2> shutter{};
  double fov = 45;  ///< degrees
  FovAxis fov_axis = FovAxis::x;
  double principal_point_offset_x = 0, principal_point_offset_y = 0;  ///< in image sizes
  double near_clip = 1e-2, far_clip = 1e4;
  double aperture_radius = 0, focus_distance = 0;  ///< thinlens, telecentric
  std::array<double, 2> distortion{};              ///< perspective_rdist: of r³ and r⁵
  uint32_t shape = 0;                              ///< irradiancemeter: index in `shapes`
  /// distant: what it averages over; neither is the whole scene.
  std::optional<std::array<double, 3>> target_point;
  std::vector<ShapeDescription> target_shape;  ///< none or one
  std::vector<SensorDescription> parts;        ///< batch; their films and samplers do not count
  std::optional<MediumId> medium;              ///< that the sensor stands in
  FilmDescription film;
  SamplerDescription sampler;
  bool operator==(const SensorDescription&) const = default;
};

// ---- Integrator -------------------------------------------------------------------------------

/// What all methods that trace paths of any length share.
struct PathLimits {
  int max_depth = -1;  ///< longest path in segments; −1 is no limit
  int rr_depth = 5;    ///< segments before Russian roulette begins
  bool hide_emitters = false;
  /// Ignore directions that the shading and the geometric normal see on different sides.
  bool strict_normals = false;
  bool operator==(const PathLimits&) const = default;
};
struct PathIntegratorDescription : PathLimits {
  bool operator==(const PathIntegratorDescription&) const = default;
};
/// Mitsuba's two names for path tracing through media; Duet has one method for both.
enum class VolumePathName { volpath, volpathmis };
/// Its segments are between points where light is scattered: what passes straight through a surface
/// does not count.
struct VolumePathIntegratorDescription : PathLimits {
  VolumePathName name = VolumePathName::volpath;
  bool operator==(const VolumePathIntegratorDescription&) const = default;
};
struct DirectIntegratorDescription {
  int emitter_samples = 1, bsdf_samples = 1;
  bool hide_emitters = false, strict_normals = false;
  bool operator==(const DirectIntegratorDescription&) const = default;
};
struct DepthIntegratorDescription {
  bool operator==(const DepthIntegratorDescription&) const = default;
};

/// Ambient occlusion.
struct OcclusionIntegratorDescription {
  int shading_samples = 1;
  double ray_length = 0;  ///< world units; 0: half the radius of a sphere around the scene
  bool operator==(const OcclusionIntegratorDescription&) const = default;
};

/// Methods that trace sub-paths from the lights, too.
enum class BidirectionalMethod { ptracer, bdpt, reuse, ppm, bpm, vcm };
/// How `reuse` weights its techniques: exactly, or as the thesis does (docs/mis.md), in
/// either of two readings of it.
enum class ReuseWeights { exact, thesis_a, thesis_b };
struct BidirectionalIntegratorDescription {
  BidirectionalMethod method = BidirectionalMethod::bdpt;
  /// In segments; −1 is no limit, but max_eye_depth + max_light_depth + 1 with the thesis' weights.
  int max_depth = -1;
  int rr_depth = 5;
  bool hide_emitters = false, strict_normals = false;
  double light_paths = 0;  ///< light sub-paths per pixel; 0: the default of the method
  /// Light vertices to which each eye vertex is connected; −1: all of one light sub-path.
  int connections = -1;
  bool light_image = true;  ///< bdpt: connect light vertices to the camera
  double radius = 0;  ///< of merging in the first iteration, world units; 0: from the pixels' size
  double alpha = 0;   ///< how fast the radius shrinks; 0: the method's default
  int max_eye_depth = 4, max_light_depth = 3;  ///< reuse
  ReuseWeights weights = ReuseWeights::exact;  ///< reuse
  double continue_probability = 1;             ///< reuse
  /// vcm: the parts of the image in which it merges (transport/merge_mask.h), as chosen by `auto`;
  /// empty: all of it.
  std::vector<uint8_t> merge_parts = {};
  bool operator==(const BidirectionalIntegratorDescription&) const = default;
};

/// Whichever method suits the scene.
struct AutoIntegratorDescription : PathLimits {
  bool operator==(const AutoIntegratorDescription&) const = default;
};

/// Layers by their Mitsuba name and the name they get in the file.
struct AovDescription {
  struct Layer {
    std::string kind, name;
    bool operator==(const Layer&) const = default;
  };
  std::vector<Layer> layers;
  bool operator==(const AovDescription&) const = default;
};

struct IntegratorDescription {
  SourceLocation where;
  std::variant<PathIntegratorDescription, DirectIntegratorDescription, DepthIntegratorDescription,
               BidirectionalIntegratorDescription, VolumePathIntegratorDescription,
               AutoIntegratorDescription, OcclusionIntegratorDescription>
      method;
  AovDescription aovs;   ///< layers asked for by an `aov` integrator
  bool image = true;     ///< false if an `aov` integrator has no nested integrator
  bool moments = false;  ///< wrapped in a `moment` integrator: second moments as layers
  bool operator==(const IntegratorDescription&) const = default;
};

// ---- The scene --------------------------------------------------------------------------------

struct SceneDescription {
  std::string file;  ///< the main file
  std::vector<TextureDescription> textures;
  std::vector<MaterialDescription> materials;
  std::vector<VolumeDescription> volumes;
  std::vector<PhaseDescription> phases;
  std::vector<MediumDescription> media;
  std::vector<ShapeDescription> shapes;
  std::vector<ShapeGroupDescription> groups;
  std::vector<LightDescription> lights;
  std::vector<SensorDescription> sensors;
  IntegratorDescription integrator;
  /// What is rendered differently from what the file asks for, one sentence each.
  std::vector<Diagnostic> approximations;

  /// Compares what is described; the order of things counts.
  friend bool operator==(const SceneDescription& a, const SceneDescription& b) {
    return a.textures == b.textures && a.materials == b.materials && a.volumes == b.volumes &&
           a.phases == b.phases && a.media == b.media && a.shapes == b.shapes &&
           a.groups == b.groups && a.lights == b.lights && a.sensors == b.sensors &&
           a.integrator == b.integrator;
  }
};

/// The number of shapes, lights and sensors that move.
size_t count_moving(const SceneDescription& scene);
/// The scene as it stands at a time. Nothing in it moves.
SceneDescription scene_at(SceneDescription scene, double time);

}  // namespace duet
