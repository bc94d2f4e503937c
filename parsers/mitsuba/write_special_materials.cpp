// Fibres, measurements, filters, coats and layers as Mitsuba 3 writes them, or would.
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

}  // namespace duet
