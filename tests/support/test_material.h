// Materials made from Mitsuba's names, for tests.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "materials/materials.h"
#include "materials/wrappers.h"

namespace duet::test {

/// A texture with one value and one gradient everywhere.
class FlatTexture final : public Texture {
 public:
  explicit FlatTexture(const Spectrum& color, Point2f gradient = {0, 0})
      : color_(color), gradient_(gradient) {}
  Spectrum color(const Surface&) const override { return color_; }
  float value(const Surface&) const override { return color_.luminance(); }
  Point2f gradient(const Surface&) const override { return gradient_; }
  Spectrum average() const override { return color_; }

 private:
  Spectrum color_;
  Point2f gradient_;
};

/// A material with all that it is made of.
class TestMaterial {
 public:
  /// Takes a description like those of reference/make_bsdf_tables.py.
  explicit TestMaterial(const nlohmann::json& bsdf) : root_(&make(bsdf)) {}
  explicit TestMaterial(const char* bsdf) : TestMaterial(nlohmann::json::parse(bsdf)) {}

  const Material& operator*() const { return *root_; }
  const Material* operator->() const { return root_; }

 private:
  const Material& make(const nlohmann::json& bsdf);

  std::vector<std::unique_ptr<Texture>> textures_;
  std::vector<std::unique_ptr<Material>> materials_;
  const Material* root_;
};

/// A surface whose shading frame is the coordinate system.
Surface flat_surface();

Spectrum to_spectrum(const nlohmann::json& j);
Vector3f to_vector(const nlohmann::json& j);

/// The table made by reference/make_bsdf_tables.py.
const nlohmann::json& mitsuba_tables();

}  // namespace duet::test
