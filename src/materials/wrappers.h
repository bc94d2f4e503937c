// Materials made of other materials, which must outlive them.
#pragma once

#include <algorithm>
#include <vector>

#include "materials/material.h"
#include "textures/texture.h"

namespace duet {

/// One material on the side of the normal, another (or the same) on the back. Mitsuba allows only
/// materials here that do not transmit.
class TwoSided final : public Material {
 public:
  TwoSided(const Material& front, const Material& back);
  SurfaceNeeds needs() const override { return front_.needs() | back_.needs(); }
  int component_count() const override;
  bool transmits() const override { return front_.transmits() || back_.transmits(); }
  bool perturbs() const override { return front_.perturbs() || back_.perturbs(); }
  CoverCount cover_count() const override {
    return either(front_.cover_count(), back_.cover_count());
  }
  Spectrum local_albedo(const Surface& surface, const Vector3f& wo) const override;
  void list_textures(std::vector<const Texture*>& out) const override {
    front_.list_textures(out);
    if (&back_ != &front_) back_.list_textures(out);
  }
  /// The material of both sides, or null if they differ.
  const Material* of_both_sides() const { return &front_ == &back_ ? &front_ : nullptr; }

 protected:
  void add_components(const Surface& surface, BsdfBuilder& builder) const override;

 private:
  const Material &front_, &back_;
};

/// Lets the share 1 − opacity of the light pass straight through. Opacity is clamped to [0, 1].
class Mask final : public Material {
 public:
  Mask(const FloatSlot& opacity, const Material& nested) : opacity_(opacity), nested_(nested) {}
  const Material& nested() const { return nested_; }
  /// The share of the nested material, from 0 to 1; 0 where the opacity is no number.
  float share(const Surface& surface) const {
    const float opacity = opacity_(surface);
    return opacity > 0 ? std::min(opacity, 1.0f) : 0.0f;
  }
  SurfaceNeeds needs() const override;
  int component_count() const override { return nested_.component_count() + 1; }
  bool transmits() const override;
  bool passes_straight() const override { return true; }
  bool perturbs() const override { return nested_.perturbs(); }
  void list_textures(std::vector<const Texture*>& out) const override {
    opacity_.list_texture(out);
    nested_.list_textures(out);
  }
  CoverCount cover_count() const override { return nested_.cover_count(); }
  Spectrum local_albedo(const Surface& surface, const Vector3f& wo) const override {
    return nested_.local_albedo(surface, wo);
  }

 protected:
  void add_components(const Surface& surface, BsdfBuilder& builder) const override;

 private:
  FloatSlot opacity_;
  const Material& nested_;
};

/// (1 − weight) · first + weight · second, with the weight clamped to [0, 1].
class Blend final : public Material {
 public:
  Blend(const FloatSlot& weight, const Material& first, const Material& second)
      : weight_(weight), first_(first), second_(second) {}
  SurfaceNeeds needs() const override;
  int component_count() const override {
    return first_.component_count() + second_.component_count();
  }
  bool transmits() const override { return first_.transmits() || second_.transmits(); }
  bool passes_straight() const override {
    return first_.passes_straight() || second_.passes_straight();
  }
  bool perturbs() const override { return first_.perturbs() || second_.perturbs(); }
  void list_textures(std::vector<const Texture*>& out) const override {
    weight_.list_texture(out);
    first_.list_textures(out);
    second_.list_textures(out);
  }
  CoverCount cover_count() const override {
    return both(first_.cover_count(), second_.cover_count());
  }
  Spectrum local_albedo(const Surface& surface, const Vector3f& wo) const override;

 protected:
  void add_components(const Surface& surface, BsdfBuilder& builder) const override;

 private:
  FloatSlot weight_;
  const Material &first_, &second_;
};

/// Σ weight · material; weights are positive, and their sum is at most one.
class Mixture final : public Material {
 public:
  struct Part {
    float weight;
    const Material* material;
  };
  explicit Mixture(std::vector<Part> parts) : parts_(std::move(parts)) {}
  SurfaceNeeds needs() const override;
  int component_count() const override;
  bool transmits() const override;
  bool perturbs() const override;
  void list_textures(std::vector<const Texture*>& out) const override;
  CoverCount cover_count() const override;
  Spectrum local_albedo(const Surface& surface, const Vector3f& wo) const override;

 protected:
  void add_components(const Surface& surface, BsdfBuilder& builder) const override;

 private:
  std::vector<Part> parts_;
};

/// A material in a frame whose normal differs from place to place. Where `nested` perturbs normals
/// itself, it starts from that frame; an eye for which a normal is turned (see TiltOptions) changes
/// nothing about this.
class Perturbed : public Material {
 public:
  int component_count() const override { return nested_.component_count(); }
  bool transmits() const override { return nested_.transmits(); }
  bool passes_straight() const override { return nested_.passes_straight(); }
  bool perturbs() const override { return true; }
  CoverCount cover_count() const override { return nested_.cover_count().covered(); }
  Spectrum local_albedo(const Surface& surface, const Vector3f& wo) const override {
    return nested_.local_albedo(surface, wo);
  }
  const Material& nested() const { return nested_; }
  /// `side` is −1 if the surface's frame is mirrored.
  Tilt tilt(const Surface& surface, float side) const {
    return {unit_normal(surface), options_, side};
  }

 protected:
  Perturbed(const TiltOptions& options, const Material& nested)
      : options_(options), nested_(nested), nested_perturbs_(nested.perturbs()) {}
  void add_components(const Surface& surface, BsdfBuilder& builder) const override;
  /// The perturbed normal in the shading frame, of any length.
  virtual Normal3f normal(const Surface& surface) const = 0;
  Normal3f unit_normal(const Surface& surface) const;

  TiltOptions options_;
  const Material& nested_;
  bool nested_perturbs_;
};

/// Normals of the surface displaced by scale · height. If it `follows_curvature`, as in pbrt, the
/// displacement also stretches the surface where its normal turns, and meshes have their own
/// tangents (BumpTangents); Mitsuba leaves both out.
/// Source: Blinn, "Simulation of Wrinkled Surfaces", 1978.
class BumpMap final : public Perturbed {
 public:
  BumpMap(const FloatSlot& height, float scale, bool follows_curvature, const TiltOptions& options,
          const Material& nested)
      : Perturbed(options, nested),
        height_(height),
        scale_(scale),
        follows_curvature_(follows_curvature) {}
  SurfaceNeeds needs() const override;
  void list_textures(std::vector<const Texture*>& out) const override {
    height_.list_texture(out);
    nested_.list_textures(out);
  }

 protected:
  Normal3f normal(const Surface& surface) const override;

 private:
  FloatSlot height_;
  float scale_;
  bool follows_curvature_;
};

/// Normals in the shading frame, stored as colours (n + 1) / 2.
class NormalMap final : public Perturbed {
 public:
  NormalMap(const ColorSlot& normals, const TiltOptions& options, const Material& nested)
      : Perturbed(options, nested), normals_(normals) {}
  SurfaceNeeds needs() const override;
  void list_textures(std::vector<const Texture*>& out) const override {
    normals_.list_texture(out);
    nested_.list_textures(out);
  }

 protected:
  Normal3f normal(const Surface& surface) const override;

 private:
  ColorSlot normals_;
};

}  // namespace duet
