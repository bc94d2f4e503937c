#include "mitsuba/plugins/bsdfs.h"

#include "mitsuba/plugins/bsdf.h"

namespace duet::plugins {

std::vector<Plugin> bsdfs() {
  constexpr const char* only_0x = "Mitsuba 3 has none";
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
      principled(),
      bsdf<PrincipledThinMaterial>({.versions = v3}),
      twosided(),
      bsdf<MaskMaterial>({.note = "holds a BSDF"}),
      bsdf<BlendMaterial>({.note = "holds two BSDFs; see `blend-delta` below"}),
      bumpmap(),
      normalmap(),
      bsdf<NullMaterial>(),
      phong(),
      ward(),
      bsdf<RoughDiffuseMaterial>({.note = only_0x}),
      bsdf<DiffuseTransmitterMaterial>({.note = only_0x}),
      mixturebsdf(),
      circular(),
      coating(),
      bsdf<CoatedConductorMaterial>({.note = kDuets}),
      bsdf<CoatedDiffuseMaterial>({.note = kDuets}),
      hair(),
      hk(),
      irawan(),
      measured(),
      measured_polarized(),
      polarizer(),
      pplastic(),
      retarder(),
      roughcoating(),
      sssbrdf(),
      bsdf<SubstrateMaterial>({.note = "Duet's own, that of pbrt-v3"}),
      bsdf<UberMaterial>({.note = "Duet's own, for what pbrt-v3 sums of lobes"}),
  };
}

}  // namespace duet::plugins
