// Fibres, measurements, filters, coats, layers and maps as Mitsuba 3 writes them, or would.
#include "mitsuba/scene_writer.h"

namespace duet {

void SceneWriter::write_model(const HairMaterial& m) {
  out_.number("longitudinal_roughness", m.longitudinal_roughness);
  out_.number("azimuthal_roughness", m.azimuthal_roughness);
  out_.number("scale_tilt", m.scale_tilt);
  out_.number("int_ior", m.eta);
  out_.number("ext_ior", 1);
  if (m.sigma_a) {
    color("sigma_a", *m.sigma_a);
    out_.number("scale", m.scale);
  } else {
    out_.number("eumelanin", m.eumelanin);
    out_.number("pheomelanin", m.pheomelanin);
  }
}

void SceneWriter::write_model(const MeasuredMaterial& m) {
  out_.string("filename", m.file);
}

void SceneWriter::write_model(const PolarizedPlasticMaterial& m) {
  out_.number("int_ior", m.eta);
  out_.number("ext_ior", 1);
  color("diffuse_reflectance", m.diffuse_reflectance);
  color("specular_reflectance", m.specular_reflectance);
  roughness(m.interface, false);
}

void SceneWriter::write_model(const FilterMaterial& m) {
  color("transmittance", m.transmittance);
}

void SceneWriter::write_model(const CoatingMaterial& m) {
  out_.number("int_ior", m.eta);
  out_.number("ext_ior", 1);
  out_.number("thickness", m.thickness);
  color("sigma_a", m.sigma_a);
  color("specular_reflectance", m.specular_reflectance);
  roughness(m.roughness, true);
  out_.reference({}, material_id(m.nested));
}

void SceneWriter::write_model(const ThinLayerMaterial& m) {
  color("sigma_s", m.sigma_s);
  color("sigma_a", m.sigma_a);
  out_.number("thickness", m.thickness);
  if (m.g != 0) lose("the phase function of \"hk\" is missing");
}

void SceneWriter::write_model(const BumpMapMaterial& m) {
  if (const TextureId* height = std::get_if<TextureId>(&m.height)) {
    out_.reference({}, texture_id(*height));
  } else {
    out_.open("texture", "uniform");
    number("value", m.height);
    out_.close();
  }
  out_.number("scale", m.scale);
  out_.boolean("flip_invalid_normals", m.flip_invalid_normals);
  out_.boolean("use_shadowing_function", m.use_shadowing_function);
  out_.reference({}, material_id(m.nested));
}

void SceneWriter::write_model(const NormalMapMaterial& m) {
  color("normalmap", m.normals);
  out_.boolean("flip_invalid_normals", m.flip_invalid_normals);
  out_.boolean("use_shadowing_function", m.use_shadowing_function);
  out_.reference({}, material_id(m.nested));
}

}  // namespace duet
