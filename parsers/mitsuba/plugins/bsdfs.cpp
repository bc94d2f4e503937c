#include "mitsuba/plugins/bsdfs.h"

#include "mitsuba/plugins/bsdf.h"
#include "mitsuba/plugins/tables.h"

namespace duet::plugins {

std::vector<Plugin> bsdfs() {
  constexpr const char* only_0x = "Mitsuba 3 has none";
  constexpr const char* kCoat = "holds a BSDF; Mitsuba 3 has none";
  constexpr const char* kDuets = "Duet's own, that of pbrt-v4; only its upper side scatters light";
  return {
      bsdf<DiffuseMaterial>(),
      conductor(),
      roughconductor(),
      bsdf<DielectricMaterial>(),
      rough_bsdf<DielectricMaterial>({.name = "roughdielectric"}),
      bsdf<ThinDielectricMaterial>(),
      bsdf<PlasticMaterial>(),
      rough_bsdf<PlasticMaterial>({.name = "roughplastic"}),
      bsdf<PrincipledMaterial, check_principled>({.versions = v3}),
      bsdf<PrincipledThinMaterial>({.versions = v3}),
      twosided(),
      bsdf<MaskMaterial>({.note = "holds a BSDF"}),
      bsdf<BlendMaterial>({.note = "holds two BSDFs; see `blend-delta` below"}),
      bumpmap(),
      normalmap(),
      bsdf<NullMaterial>(),
      // These are listed with the glossy lobe first.
      bsdf<PhongMaterial, check_phong>({.parameters = parameters_of<PhongMaterial>(
                                            "exponent specular_reflectance diffuse_reflectance"),
                                        .note = only_0x}),
      bsdf<WardMaterial, check_ward>(
          {.parameters = parameters_of<WardMaterial>(
               "variant alpha_u alpha_v specular_reflectance diffuse_reflectance"),
           .note = only_0x}),
      bsdf<RoughDiffuseMaterial>({.note = only_0x}),
      bsdf<DiffuseTransmitterMaterial>({.note = only_0x}),
      mixturebsdf(),
      circular(),
      bsdf<CoatingMaterial, check_coating>({.note = kCoat}),
      bsdf<CoatedConductorMaterial>({.note = kDuets}),
      bsdf<CoatedDiffuseMaterial>({.note = kDuets}),
      bsdf<HairMaterial, check_hair>({.versions = v3, .note = "for bsplinecurve"}),
      hk(),
      irawan(),
      measured(),
      refused_plugin("measured_polarized", v3, "light has no polarisation here",
                     "filename alpha_sample wavelength"),
      polarizer(),
      bsdf<PolarizedPlasticMaterial, check_pplastic>(
          {.versions = v3, .note = "as Mitsuba's variants without polarisation"}),
      retarder(),
      rough_bsdf<CoatingMaterial, check_coating>({.name = "roughcoating", .note = kCoat}),
      sssbrdf(),
      bsdf<SubstrateMaterial>({.note = "Duet's own, that of pbrt-v3"}),
      bsdf<UberMaterial>({.note = "Duet's own, for what pbrt-v3 sums of lobes"}),
  };
}

}  // namespace duet::plugins
