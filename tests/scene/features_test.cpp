#include "scene/features.h"

#include <doctest/doctest.h>

#include "scene/description.h"

using namespace duet;

namespace {

ShapeDescription shape(decltype(ShapeDescription::geometry) geometry, uint32_t material = 0,
                       const Matrix4& to_world = {}) {
  ShapeDescription s;
  s.geometry = std::move(geometry);
  s.material = MaterialId{material};
  s.to_world = to_world;
  return s;
}

}  // namespace

TEST_CASE("an empty scene has no features") {
  const SceneFeatures f = scene_features({});
  CHECK(f.bounds.empty());
  CHECK(describe(f) == "no shapes; no lights; no materials");
}

TEST_CASE("shapes, copies and their extent are counted") {
  SceneDescription d;
  d.materials.resize(1);
  d.shapes.push_back(shape(RectangleShape{}));
  d.shapes.push_back(shape(SphereShape{}, 0, Matrix4::translate(5, 0, 0)));
  ShapeGroupDescription group;
  group.shapes.push_back(shape(CubeShape{}));
  d.groups.push_back(group);
  for (const double y : {10.0, -10.0})
    d.shapes.push_back(
        shape(InstanceShape{0}, 0, Matrix4::translate(0, y, 0) * Matrix4::scale(2, 2, 2)));
  const SceneFeatures f = scene_features(d);
  CHECK(f.meshes == 2);
  CHECK(f.analytic_shapes == 1);
  CHECK(f.instances == 2);
  CHECK(f.triangles == 2 + 12);
  CHECK(f.placed_triangles == 2 + 2 * 12);
  CHECK(f.bounds.lower == Point3f(-2, -12, -2));
  CHECK(f.bounds.upper.x == doctest::Approx(6));
  CHECK(f.bounds.upper.y == 12);
  CHECK(f.bounds.upper.z == 2);
  CHECK(f.diffuse == 1);
  CHECK(describe(f) ==
        "2 meshes, 14 triangles, 1 analytic shape, 2 instances (26 triangles in all copies); no "
        "lights; diffuse reflection");
}

TEST_CASE("materials count by how they scatter, wherever they are nested, and only if used") {
  SceneDescription d;
  d.textures.resize(1);
  const auto add = [&](decltype(MaterialDescription::model) model) {
    d.materials.push_back({{}, {}, std::move(model)});
    return MaterialId{uint32_t(d.materials.size() - 1)};
  };
  const auto features = [&](MaterialId id) {
    SceneDescription copy = d;
    copy.shapes = {shape(SphereShape{}, uint32_t(id))};
    return scene_features(copy);
  };
  const MaterialId mirror = add(ConductorMaterial{}), glass = add(DielectricMaterial{});
  ConductorMaterial rough;
  rough.roughness.emplace();
  DielectricMaterial frosted;
  frosted.roughness.emplace();
  const MaterialId metal = add(rough), frost = add(frosted), plastic = add(PlasticMaterial{});
  const MaterialId mask = add(MaskMaterial{0.5, glass});
  const MaterialId blend = add(BlendMaterial{0.5, metal, mask});
  const MaterialId bump = add(BumpMapMaterial{TextureId{0}, 1, true, true, true, false, blend});
  const MaterialId sides = add(TwoSidedMaterial{plastic, bump});
  PrincipledMaterial clear;
  clear.spec_trans = 0.5;
  const MaterialId principled = add(clear), opaque = add(PrincipledMaterial{});

  CHECK(features(mirror).mirrors == 1);
  CHECK(features(mirror).smooth_glass == 0);
  CHECK(features(glass).smooth_glass == 1);
  CHECK(features(metal).rough_reflection == 1);
  CHECK(features(metal).mirrors == 0);
  CHECK(features(frost).rough_refraction == 1);
  CHECK(features(frost).smooth_glass == 0);
  const SceneFeatures all = features(sides);
  CHECK(all.diffuse == 1);
  CHECK(all.mirrors == 1);  // on top of the plastic
  CHECK(all.rough_reflection == 1);
  CHECK(all.smooth_glass == 1);
  CHECK(all.masks == 1);
  CHECK(all.bumps == 1);
  CHECK(all.textures == 1);
  CHECK(features(principled).rough_refraction == 1);
  CHECK(features(opaque).rough_refraction == 0);
}

TEST_CASE("lights and lenses are counted") {
  SceneDescription d;
  d.materials.resize(1);
  d.textures.resize(1);
  ShapeDescription lamp = shape(DiskShape{});
  lamp.emission = AreaEmission{};
  d.shapes.push_back(lamp);
  lamp.emission->radiance = TextureId{0};
  d.shapes.push_back(lamp);
  const auto add = [&](decltype(LightDescription::model) model) {
    d.lights.push_back({{}, {}, std::move(model), {}, {}, 1, {}});
  };
  add(PointLight{}), add(PointLight{}), add(SpotLight{}), add(ProjectorLight{});
  add(DirectionalLight{}), add(ConstantLight{}), add(EnvironmentMapLight{});
  SensorDescription lens;
  lens.kind = SensorKind::thinlens;
  d.sensors.push_back(lens);
  CHECK(!scene_features(d).depth_of_field);
  d.sensors[0].aperture_radius = 0.1;
  const SceneFeatures f = scene_features(d);
  CHECK(f.depth_of_field);
  CHECK(describe(f) ==
        "2 analytic shapes; 2 area lights, 1 of them textured, 2 point lights, 1 spot light, 1 "
        "projector, 1 directional light, constant environment, environment map; diffuse "
        "reflection, 1 texture; depth of field");
}
