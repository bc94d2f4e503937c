// Directions that materials sample, counted, against the integral of the density that they claim.
#include "support/bsdf_checks.h"
#include "support/statistics.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A map of the sphere onto itself that magnifies the surroundings of an axis: lobes that are
/// narrower than a cell become wide. In the stereographic projection from the opposite of the axis
/// it multiplies the plane by `factor`.
class Zoom {
 public:
  /// The axis is the frame's normal.
  Zoom(const Frame& frame, double factor) : frame_(frame), factor_(factor) {}

  Vector3f magnify(const Vector3f& w) const {
    const Vector3f l = frame_.to_local(w);
    return scaled(l, factor_);
  }
  /// The direction that is magnified to `m`, and solid angle there per solid angle at `m`.
  Vector3f shrink(const Vector3f& m, double& solid_angle) const {
    const double p2 = (1 - double(m.z)) / std::max(1 + double(m.z), 1e-9);
    const double before = p2 / (factor_ * factor_);
    solid_angle = std::pow((1 + p2) / (1 + before) / factor_, 2);
    return normalize(frame_.to_world(scaled(m, 1 / factor_)));
  }

 private:
  static Vector3f scaled(const Vector3f& w, double factor) {
    const double down = std::max(1 + double(w.z), 1e-9);
    const double x = w.x / down * factor, y = w.y / down * factor, r2 = x * x + y * y;
    return {float(2 * x / (1 + r2)), float(2 * y / (1 + r2)), float((1 - r2) / (1 + r2))};
  }

  Frame frame_;
  double factor_;
};

struct Case {
  const char* name;
  const char* bsdf;
  /// Width of the narrowest lobe; one test is made around each of the directions of reflection and
  /// (with the relative index `eta`) refraction if it is less than 0.1.
  double width = 1;
  float eta = 0;
};

const Case kCases[] = {
    {"diffuse", R"({"type": "diffuse"})"},
    {"plastic", R"({"type": "plastic"})"},
    {"plastic, nonlinear",
     R"({"type": "plastic", "nonlinear": true, "int_ior": 1.9, "diffuse_reflectance": [0.9, 0.5, 0.1]})"},
    {"metal, GGX", R"({"type": "roughconductor", "distribution": "ggx", "alpha": 0.3})"},
    {"metal, GGX, very rough", R"({"type": "roughconductor", "distribution": "ggx", "alpha": 1})"},
    {"metal, GGX, fine", R"({"type": "roughconductor", "distribution": "ggx", "alpha": 0.01})",
     0.01},
    {"metal, GGX, finest", R"({"type": "roughconductor", "distribution": "ggx", "alpha": 0.001})",
     0.001},
    {"metal, GGX, anisotropic",
     R"({"type": "roughconductor", "distribution": "ggx", "alpha_u": 0.5, "alpha_v": 0.12})"},
    {"metal, GGX, all normals",
     R"({"type": "roughconductor", "distribution": "ggx", "alpha": 0.3, "sample_visible": false})"},
    {"metal, Beckmann", R"({"type": "roughconductor", "alpha": 0.3})"},
    {"metal, Beckmann, very rough", R"({"type": "roughconductor", "alpha": 1})"},
    {"metal, Beckmann, fine", R"({"type": "roughconductor", "alpha": 0.01})", 0.01},
    {"metal, Beckmann, anisotropic",
     R"({"type": "roughconductor", "alpha_u": 0.12, "alpha_v": 0.5})"},
    {"metal, Beckmann, all normals",
     R"({"type": "roughconductor", "alpha_u": 0.2, "alpha_v": 0.4, "sample_visible": false})"},
    {"hair", R"({"type": "hair"})"},
    {"hair, rough",
     R"({"type": "hair", "longitudinal_roughness": 0.8, "azimuthal_roughness": 0.7})"},
    {"polarised plastic", R"({"type": "pplastic", "alpha": 0.3})"},
    {"coat over a rough metal",
     R"({"type": "coating", "sigma_a": 0.3, "nested": [
         {"type": "roughconductor", "distribution": "ggx", "alpha": 0.4}]})"},
    {"rough coat over a diffuse base",
     R"({"type": "roughcoating", "alpha": 0.3, "nested": [{"type": "diffuse"}]})"},
    {"thin layer", R"({"type": "hk", "sigma_s": 1.5, "sigma_a": 0.2, "g": 0.4})"},
    {"glass, GGX", R"({"type": "roughdielectric", "distribution": "ggx", "alpha": 0.3})"},
    {"glass, GGX, fine",
     R"({"type": "roughdielectric", "distribution": "ggx", "alpha": 0.01, "int_ior": 1.5,
         "ext_ior": 1})",
     0.01, 1.5f},
    {"glass, GGX, anisotropic, coloured",
     R"({"type": "roughdielectric", "distribution": "ggx", "alpha_u": 0.5, "alpha_v": 0.2,
         "specular_reflectance": [0.2, 0.3, 0.4], "specular_transmittance": [0.9, 0.8, 0.7]})"},
    {"glass, GGX, all normals",
     R"({"type": "roughdielectric", "distribution": "ggx", "alpha": 0.3, "sample_visible": false})"},
    {"glass, Beckmann", R"({"type": "roughdielectric", "alpha": 0.4, "int_ior": 2.4})"},
    {"glass, Beckmann, fine",
     R"({"type": "roughdielectric", "alpha": 0.01, "int_ior": 1.5, "ext_ior": 1})", 0.01, 1.5f},
    {"glass, Beckmann, all normals",
     R"({"type": "roughdielectric", "alpha": 0.3, "sample_visible": false})"},
    {"bubble in water",
     R"({"type": "roughdielectric", "alpha": 0.3, "int_ior": 1, "ext_ior": 1.33})"},
    {"coat, GGX", R"({"type": "roughplastic", "distribution": "ggx", "alpha": 0.2})"},
    {"coat, Beckmann", R"({"type": "roughplastic", "alpha": 0.15})"},
    {"coat, all normals", R"({"type": "roughplastic", "alpha": 0.2, "sample_visible": false})"},
    {"coat, no base", R"({"type": "roughplastic", "alpha": 0.2, "diffuse_reflectance": 0})"},
    {"glass, correlated GGX",
     R"({"type": "roughdielectric", "distribution": "ggx_correlated", "alpha_u": 0.5, "alpha_v": 0.2})"},
    {"diffuse under a smooth coat", R"({"type": "coateddiffuse", "thickness": 0.5})"},
    {"diffuse under a rough coat", R"({"type": "coateddiffuse", "alpha": 0.3})"},
    {"diffuse under a rough coat and a scattering layer",
     R"({"type": "coateddiffuse", "alpha_u": 0.5, "alpha_v": 0.2, "albedo": 0.7, "g": 0.5})"},
    {"rough metal under a smooth coat",
     R"({"type": "coatedconductor", "conductor_alpha": 0.2, "reflectance": 0.9})"},
    {"smooth metal under a rough coat",
     R"({"type": "coatedconductor", "alpha": 0.5, "reflectance": 0.9})"},
    {"mirrors with a scattering layer between them",
     R"({"type": "coatedconductor", "albedo": 0.9, "thickness": 0.7})"},
    {"substrate", R"({"type": "substrate", "distribution": "ggx", "alpha": 0.3})"},
    {"uber, translucent",
     R"({"type": "uber", "distribution": "ggx_correlated", "alpha": 0.3, "diffuse_transmittance": 0.2,
         "glossy_transmittance": 0.5, "specular_reflectance": 0.3, "opacity": 0.7})"},
    {"phong", R"({"type": "phong", "exponent": 40})"},
    {"phong, broad", R"({"type": "phong", "exponent": 0.5, "specular_reflectance": 0.5})"},
    {"ward, balanced", R"({"type": "ward", "alpha_u": 0.15, "alpha_v": 0.4})"},
    {"ward", R"({"type": "ward", "alpha_u": 0.3, "alpha_v": 0.3, "variant": "ward"})"},
    {"ward, Duer", R"({"type": "ward", "alpha_u": 0.2, "alpha_v": 0.2, "variant": "ward-duer"})"},
    {"rough diffuse", R"({"type": "roughdiffuse", "alpha": 0.6})"},
    {"diffuse transmission", R"({"type": "difftrans"})"},
    {"mixture of three",
     R"({"type": "mixturebsdf", "weights": [0.3, 0.2, 0.4], "nested": [{"type": "phong"},
         {"type": "roughdiffuse"}, {"type": "difftrans"}]})"},
    {"principled", R"({"type": "principled"})"},
    {"principled, clear coat",
     R"({"type": "principled", "clearcoat": 1, "clearcoat_gloss": 0.2, "roughness": 0.6,
         "clearcoat_sampling_rate": 4})"},
    {"principled, anisotropic metal",
     R"({"type": "principled", "metallic": 0.8, "anisotropic": 0.7, "sheen": 0.5, "flatness": 0.3})"},
    {"principled, glass", R"({"type": "principled", "spec_trans": 1, "roughness": 0.6})"},
    {"principled, all",
     R"({"type": "principled", "spec_trans": 0.5, "metallic": 0.3, "roughness": 0.7, "spec_tint": 0.5,
         "sheen": 0.5, "clearcoat": 0.5, "eta": 1.3})"},
    {"thin, diffuse", R"({"type": "principledthin", "diff_trans": 0.8})"},
    {"thin, all",
     R"({"type": "principledthin", "spec_trans": 0.6, "diff_trans": 1.2, "roughness": 0.6,
         "anisotropic": 0.5})"},
    {"two sides",
     R"({"type": "twosided", "nested": [{"type": "diffuse"}, {"type": "roughplastic", "alpha": 0.2}]})"},
    {"mask of glass",
     R"({"type": "mask", "opacity": 0.3, "nested": [{"type": "roughdielectric", "alpha": 0.3}]})"},
    {"blend",
     R"({"type": "blendbsdf", "weight": 0.3, "nested": [{"type": "roughconductor", "alpha": 0.2},
         {"type": "blendbsdf", "weight": 0.6, "nested": [{"type": "plastic"},
           {"type": "roughdielectric", "alpha": 0.4}]}]})"},
    {"normal map on diffuse",
     R"({"type": "normalmap", "normal": [-0.7, 0.5, 0.6], "nested": [{"type": "diffuse"}]})"},
    {"normal map on metal",
     R"({"type": "normalmap", "normal": [0.3, 0.1, 0.9], "nested": [
         {"type": "roughconductor", "alpha_u": 0.4, "alpha_v": 0.2}]})"},
    {"normal map on glass",
     R"({"type": "normalmap", "normal": [0.5, -0.3, 0.8], "nested": [
         {"type": "roughdielectric", "distribution": "ggx", "alpha": 0.3}]})"},
    {"normal map, unflipped, on two sides",
     R"({"type": "normalmap", "normal": [0.3, 0.5, 0.8], "flip_invalid_normals": false, "nested": [
         {"type": "twosided", "nested": [{"type": "roughplastic", "alpha": 0.3}]}]})"},
    {"normal map that lets light leak, on two sides",
     R"({"type": "normalmap", "normal": [0.6, 0.4, 0.5], "flip_invalid_normals": false,
         "use_shadowing_function": false, "drops_leaks": false, "nested": [
         {"type": "twosided", "nested": [{"type": "roughplastic", "alpha": 0.3}]}]})"},
    {"bump map on plastic",
     R"({"type": "bumpmap", "slope": [0.7, -0.4], "nested": [{"type": "plastic"}]})"},
    {"two sides of a bump map",
     R"({"type": "twosided", "nested": [{"type": "bumpmap", "slope": [0.4, 0.6], "nested": [
         {"type": "roughplastic", "alpha": 0.3}]}]})"},
    {"bump map of a normal map on metal",
     R"({"type": "bumpmap", "slope": [0.7, -0.4], "nested": [
         {"type": "normalmap", "normal": [-0.3, 0.5, 0.8], "nested": [
         {"type": "roughconductor", "alpha_u": 0.4, "alpha_v": 0.2}]}]})"},
};

const Vector3f kChi2Views[] = {{0.1f, 0.2f, 0.95f},
                               {0.6f, -0.5f, 0.5f},
                               {-0.9f, 0.3f, 0.15f},
                               {0.4f, 0.3f, -0.8f},
                               {-0.5f, 0.8f, -0.2f}};

/// A part of the sphere and how it is looked at.
struct View {
  Zoom zoom;
  float side;  ///< of the surface that is looked at, 0 for both
};

std::vector<View> views_of(const Case& c, const Vector3f& wo) {
  if (c.width >= 0.1) {
    // The poles, where cells are long and thin, are kept away from the plane of incidence, and the
    // horizon runs between cells.
    const Vector3f z(0, 0, 1), pole = normalize(cross(z, wo));
    return {{Zoom(Frame(z, cross(pole, z), Normal3f(pole)), 1), 0}};
  }
  const float side = wo.z > 0 ? 1.0f : -1.0f;
  std::vector<View> views{{Zoom(Frame(Normal3f(-wo.x, -wo.y, wo.z)), 1 / c.width), side}};
  if (c.eta == 0) return views;
  const float eta = wo.z > 0 ? c.eta : 1 / c.eta;
  const Vector3f across(-wo.x / eta, -wo.y / eta, 0);
  const float z2 = 1 - length_squared(across);
  if (z2 > 0) {
    const Normal3f refracted(across.x, across.y, -side * std::sqrt(z2));
    views.push_back({Zoom(Frame(refracted), 1 / c.width), -side});
  }
  return views;
}

Chi2Result run(const Bsdf& bsdf, Transport transport, const View& view, const SquareTest& options,
               int& smooth) {
  const auto seen = [&](const Vector3f& wi) { return view.side == 0 || wi.z * view.side > 0; };
  return chi2_sphere(
      [&](float u, Point2f v, Vector3f& out) {
        const auto s = bsdf.sample(u, v, transport);
        if (!s || s->delta || !seen(s->wi)) return false;
        ++smooth;
        out = view.zoom.magnify(s->wi);
        return true;
      },
      [&](const Vector3f& m) {
        double solid_angle;
        const Vector3f wi = view.zoom.shrink(m, solid_angle);
        // Where a lobe ends within a cell, the points of the quadrature may all miss it.
        const double least = 1e-6;
        return seen(wi) ? (double(bsdf.eval(wi, transport).pdf.value) + least) * solid_angle : 0.0;
      },
      options);
}

}  // namespace

TEST_CASE("materials sample the densities that they claim") {
  const Surface surface = flat_surface();
  SquareTest options;
  options.nx = 32, options.ny = 16, options.sub = 16;
  options.samples = 100000;
  options.level = sidak(0.01, int(std::size(kCases) * std::size(kChi2Views) * 2));
  for (const Case& c : kCases) {
    CAPTURE(std::string(c.name));
    const TestMaterial material(c.bsdf);
    Failures failures(c.name);
    int tested = 0;
    for (const Vector3f& direction : kChi2Views) {
      const Vector3f wo = normalize(direction);
      const Bsdf bsdf = material->bind(surface, wo);
      for (const Transport transport : kTransports)
        for (const View& view : views_of(c, wo)) {
          int smooth = 0;
          const Chi2Result r = run(bsdf, transport, view, options, smooth);
          ++options.seed;
          // Seen from where it is black, a material samples nothing and must not claim otherwise.
          const bool dark = smooth == 0 && r.dof < 1;
          tested += !dark;
          if (!r.pass && !dark)
            failures.add(fmt::format("from {}, {}: {}", text(wo), name(transport), r.message));
        }
    }
    CHECK(tested >= 5);
  }
}
