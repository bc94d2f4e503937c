#include "scene/mitsuba_differences.h"

#include <fmt/format.h>

#include "scene/mitsuba_constructs.h"

namespace duet {

namespace {

constexpr MitsubaDifference kDifferences[] = {
    {"attribute-light-samples", "area lights whose radiance is a `mesh_attribute`",
     "Mitsuba 3.9.1's light samples bring no light, but rays that meet the lamp are weighted as if "
     "they did",
     "a coloured disk above a floor, `path`: 0.1023 ± 0.0004 of what rays alone find; `direct` "
     "with light samples alone: 0",
     "light samples and rays have to agree, and Mitsuba's rays agree with Duet", &emits_attributes},
    {"blend-delta",
     "`blendbsdf` of a side with a delta lobe (mirror, glass, smooth plastic) and one without",
     "Mitsuba 3.9.1 adds the probability of the delta lobe to a density of the other side, and "
     "their values likewise",
     "a ball in a white furnace, half black and half mirror: 0.768 ± 0.001 of what is due; half "
     "white and half black smooth "
     "plastic: 1.214 ± 0.001; `path`, `direct` and `prb` alike",
     "the furnace has an exact answer, the weighted sum of the sides alone, which Mitsuba gives "
     "for each of them",
     &blends_delta},
    {"bump-tangents", "`bumpmap` over an anisotropic BSDF or another bump or normal map",
     "Mitsuba 3.9.1 turns the tangent by the derivative of the position in the axes of the world, "
     "but the normal in those of the surface",
     "a bumpy square of metal with roughnesses 0.05 and 0.4 under a lamp, all turned about its "
     "normal by 0, 30, 60 and 90 degrees: 0.0142, 0.0118, 0.0050 and 0.0018, each ± 0.0002; with "
     "the same bumps in place of the roughness 0.05: 0.0125, 0.0119, 0.0115 and 0.0113, each "
     "± 0.0001",
     "an image does not depend on the axes of the world", &bumps_tangents},
    {"direct-delta-lights",
     "`direct` with `emitter_samples` above one, and point, spot, directional lights or projectors",
     "Mitsuba 3.9.1 adds their samples up instead of averaging them",
     "4.0000 times as bright with 4 samples, 2.0000 times with 2: a square under each of point, "
     "spot and directional light",
     "one sample gives the irradiance of the formula, and so does Mitsuba's `path`",
     &repeats_delta_lights},
    {"elliptic-cylinders",
     "area lights on cylinders that `to_world` stretches so that their cross-section is no circle",
     "Mitsuba 3.9.1 samples them as if all parts of the surface were stretched alike; it warns of "
     "them",
     "a lamp of 0.6 × 0.9 above a floor, `direct` with light samples alone: 0.958 ± 0.002 of what "
     "rays alone find",
     "light samples and rays have to agree, and Mitsuba's rays agree with Duet",
     &emits_from_elliptic_cylinders},
    {"endless-media",
     "environments or directional lights, and a medium around the sensor that no shape closes",
     "Mitsuba 3.9.1 attenuates samples of such lights over twice the radius of the scene, but rays "
     "that meet them over an infinite distance",
     "a square in a medium with a mean free path of 2 under a white sky: 0.0319 ± 0.0001; with a "
     "small ball at a distance of 10 beside it 0.0012; 0 is due",
     "rays and light samples have to agree, and an image does not depend on a thing that it does "
     "not show",
     &has_light_behind_fog},
    {"null-paths",
     "`path`, surfaces with `mask`, `null` or `thindielectric`, and no environment that the camera "
     "sees",
     "Mitsuba 3.9.1 drops all light of a path that has met nothing but null lobes when it leaves "
     "the scene, with what was sampled from lights on its way",
     "a square of opacity 0.5 or 0.1 under a point light: 0.5025 ± 0.0010 and 0.1016 ± 0.0009 of "
     "what is due",
     "Mitsuba's `volpath` and `direct` keep it; the opacity counts twice otherwise",
     &drops_null_paths},
    {"ray-offset-media",
     "media whose mean free path is below 50 of Mitsuba's ray offsets, which are 0.00009 · (1 + "
     "largest coordinate)",
     "Mitsuba 3.9.1 skips that much of the medium wherever a ray enters it",
     "a ball of 10 free paths, albedo 0.9, in a white furnace: −0.3 % ± 0.5 % where the offset is "
     "0.9 % of a free path, "
     "−4.1 % ± 0.5 % where it is 9 %, −29.4 % ± 0.4 % where it is 90 %",
     "the image does not depend on the unit of length: Mitsuba's approaches one value as the scene "
     "is scaled up",
     &has_short_free_path},
    {"ray-offset-surfaces",
     "scenes whose radius is below 100 of these ray offsets: tiny ones, and small ones far from "
     "the origin",
     "Mitsuba 3.9.1 starts rays beyond what is near: shadows at contacts are lost or wrong",
     "a ball of radius 0.001 on a floor, white furnace: −0.31 % ± 0.06 % of the whole image "
     "against radius 1; none seen (0.06 %) "
     "at radius 0.01",
     "the image does not depend on the unit of length", &is_small},
    {"smooth-light-samples",
     "area lights on meshes with vertex normals, unless they are those of the triangles",
     "Mitsuba 3.9.1 turns the density of its light samples into one of directions by the cosine "
     "at the interpolated normal instead of that at the triangle",
     "a square lamp whose normals are spread by 0.2 and 0.5, `direct` with light samples alone: "
     "0.9164 ± 0.0008 and 0.7748 ± 0.0008 of what rays alone find; with both, as in `path`, about "
     "1 % of an image",
     "light samples and rays have to agree, and Mitsuba's rays agree with Duet",
     &emits_from_smooth_meshes},
    {"sggx-flakes", "`sggx` with flakes that are no balls",
     "Mitsuba 3.9.1 samples other directions than those whose density it computes",
     "a cube of one free path, albedo 1, in a white furnace: 0.896 ± 0.002 (flat flakes, "
     "`volpath`), 0.918 ± 0.001 (`volpathmis`), "
     "0.858 ± 0.002 and 0.901 ± 0.001 for long ones; 1.001 ± 0.002 for balls",
     "where nothing is absorbed the furnace is 1 everywhere; Mitsuba's two integrators contradict "
     "each other",
     &has_uneven_flakes},
    {"texture-light-samples",
     "area lights with a texture on meshes whose texture coordinates meet a point of it more than "
     "once, such as those of a cube",
     "Mitsuba 3.9.1 samples a point of the texture, and of all triangles that show it only one",
     "a textured cube above a floor, `direct` with light samples alone: 0.903 ± 0.002 of what rays "
     "alone find",
     "light samples and rays have to agree, and Mitsuba's rays agree with Duet",
     &emits_texture_repeatedly},
    {"animation-shear", "an `<animation>` with stretches that are not along the axes of the object",
     "Mitsuba 0.6 drops the part of the stretch across the axes",
     "computed from its source, as there is no program to ask: of a stretch by 2 along the "
     "diagonal of a square it keeps 1.5 along "
     "both sides",
     "the poses at the times that the file gives are not those of the file", &moves_sheared},
};

constexpr std::string_view kIntroduction = R"(## Where Mitsuba is off

Here Duet's image is not Mitsuba's, and Mitsuba's is believed to be wrong; Duet renders each thing as
it is defined. `duet info` names those that a scene meets. The figures are those of
`reference/measure_differences.py`, with Mitsuba 3.9.1 (`llvm_ad_rgb`); ± is one standard error.

| Name | Scenes with | Mitsuba | Measured | Why Duet is believed |
|---|---|---|---|---|
)";

}  // namespace

std::span<const MitsubaDifference> mitsuba_differences() {
  return kDifferences;
}

std::vector<const MitsubaDifference*> mitsuba_differences(const SceneDescription& scene,
                                                          const SceneFeatures& features) {
  std::vector<const MitsubaDifference*> out;
  for (const MitsubaDifference& d : kDifferences)
    if (d.met(scene, features)) out.push_back(&d);
  return out;
}

std::string mitsuba_differences_markdown() {
  std::string out(kIntroduction);
  for (const MitsubaDifference& d : kDifferences)
    out += fmt::format("| `{}` | {} | {} | {} | {} |\n", d.id, d.construct, d.mitsuba, d.measured,
                       d.reason);
  return out;
}

}  // namespace duet
