// Written as a pbrt-v4 file and read again, a scene stays what it is.
#include "pbrt/writer.h"

#include <doctest/doctest.h>

#include "support/pbrt_round_trip.h"
#include "support/source_path.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kImageFile = "\"string filename\" \"image.exr\" ";

/// A material that is written in the place where it is read: the state's own is not.
const std::string kPlain = "Material \"diffuse\"\n";

std::string with_material(const std::string& material) {
  std::string textures;
  if (material.find("\"grey\"") != material.npos)
    textures += "Texture \"grey\" \"float\" \"imagemap\" " + kImageFile;
  if (material.find("\"colour\"") != material.npos)
    textures += "Texture \"colour\" \"spectrum\" \"imagemap\" " + kImageFile;
  return textures + material + "\nShape \"sphere\" \"float radius\" 2\n";
}
std::string with_color(const std::string& texture) {
  return "Texture \"t\" \"spectrum\" " + texture +
         "\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n";
}
std::string with_number(const std::string& texture) {
  return "Texture \"t\" \"float\" " + texture +
         "\nMaterial \"conductor\" \"texture roughness\" \"t\" \"bool remaproughness\" false\n"
         "Shape \"sphere\"\n";
}
std::string with_medium(const std::string& medium) {
  return "Translate 4 5 6 Scale 2 4 8\nMakeNamedMedium \"fog\" \"string type\" " + medium +
         "\nMediumInterface \"fog\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n";
}

}  // namespace

TEST_CASE("pbrt writer: lights survive") {
  for (const std::string light :
       {"\"point\" \"rgb I\" [1 2 3] \"point3 from\" [4 5 6]", "\"point\" \"float power\" 12",
        "\"spot\" \"rgb I\" [0.1 0.2 0.3] \"float coneangle\" 30 \"float conedeltaangle\" 10",
        "\"distant\" \"rgb L\" [1 2 3] \"point3 from\" [0 0 2]", "\"infinite\" \"rgb L\" [1 2 3]",
        "\"infinite\" \"float scale\" 3 \"float illuminance\" 7 \"string filename\" \"image.exr\"",
        "\"infinite\" \"string filename\" \"image.exr\" \"point3 portal\" [0 0 0 1 0 0 1 1 0 0 1 "
        "0]",
        "\"goniometric\" \"rgb I\" [1 2 3] \"string filename\" \"image.exr\"",
        "\"projection\" \"float fov\" 60 \"float scale\" 3 \"string filename\" \"image.exr\""}) {
    CAPTURE(light);
    const SceneDescription d = check_pbrt_round_trip("LightSource " + light);
    CHECK(d.lights.size() == 1);
  }
  check_pbrt_round_trip("LightSource \"infinite\" LightSource \"infinite\" \"rgb L\" [1 2 3]");
  check_pbrt_round_trip(
      kPlain +
      "AreaLightSource \"diffuse\" \"rgb L\" [3 2 1] \"bool twosided\" true Shape \"sphere\"");
  const std::string triangle =
      kPlain +
      "AreaLightSource \"diffuse\" \"rgb L\" [3 2 1] Shape \"trianglemesh\" \"point3 P\" "
      "[0 0 0 1 0 0 0 1 0] \"point2 uv\" [0 0 1 0 0 1] ";
  check_pbrt_round_trip(triangle + "\"float alpha\" .5");
  check_pbrt_round_trip("Texture \"a\" \"float\" \"bilerp\" " + triangle +
                        "\"texture alpha\" \"a\"");
  check_pbrt_round_trip(kPlain + "AreaLightSource \"diffuse\" \"float scale\" 2 " + kImageFile +
                        "Shape \"sphere\"");
  check_pbrt_round_trip(
      "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
      "MediumInterface \"\" \"fog\" LightSource \"point\"");
}

TEST_CASE("pbrt writer: shapes survive, on the side that they face") {
  const std::string quad = "\"point3 P\" [0 0 0 1 0 0 1 1 0.1 0 1 0] ";
  for (const std::string& shape :
       {std::string("\"sphere\" \"float radius\" 2"),
        std::string("\"sphere\" \"float zmax\" 0.5 \"float phimax\" 270"),
        std::string("\"cylinder\" \"float radius\" 2 \"float zmin\" -2 \"float zmax\" 6"),
        std::string("\"disk\" \"float height\" 3 \"float radius\" 4"),
        std::string("\"disk\" \"float innerradius\" 0.25"), "\"bilinearmesh\" " + quad,
        "\"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] " + quad,
        "\"trianglemesh\" \"integer indices\" [0 1 2] " + quad +
            "\"normal N\" [0 0 1 0 0 1 0 0 1 0 0 1] \"point2 uv\" [0 0 1 0 1 1 0.3 1]",
        "\"loopsubdiv\" \"integer levels\" 1 \"integer indices\" [0 1 2 0 2 3] " + quad,
        std::string("\"sphere\" \"float alpha\" 0.5"),
        std::string("\"plymesh\" \"string filename\" \"mesh.ply\"")})
    for (const std::string before : {"", "ReverseOrientation ", "Scale -2 2 2 ",
                                     "ReverseOrientation Translate 1 2 3 Scale 1 -1 2 "}) {
      CAPTURE(before + shape);
      const SceneDescription d = check_pbrt_round_trip(kPlain + before + "Shape " + shape);
      CHECK(d.shapes.size() == 1);
    }
}

TEST_CASE("pbrt writer: curves survive, in their three forms") {
  for (const std::string type : {"flat", "cylinder"})
    for (const std::string material : {"Material \"diffuse\" ", "Material \"hair\" "}) {
      CAPTURE(type + material);
      const SceneDescription d = check_pbrt_round_trip(
          material + "Shape \"curve\" \"string type\" \"" + type +
          "\" \"point3 P\" [0 0 0 6 0 0 6 6 0 0 6 6] \"float width0\" 0.5 \"float width1\" 1");
      const CurveSet& curves = *std::get<CurvesShape>(d.shapes.at(0).geometry).curves;
      CHECK(curves.profile == (material.find("hair") != material.npos ? CurveProfile::tube
                               : type == "flat"                       ? CurveProfile::ribbon
                                                : CurveProfile::round_ribbon));
    }
}

TEST_CASE("pbrt writer: instances and motion survive") {
  const SceneDescription d = check_pbrt_round_trip(
      "ObjectBegin \"a\" Material \"diffuse\" \"rgb reflectance\" [1 0 0] Shape \"sphere\"\n"
      "ObjectEnd Material \"diffuse\" ObjectBegin \"b\" Shape \"disk\" Shape \"sphere\" ObjectEnd\n"
      "AttributeBegin Translate 1 2 3 ObjectInstance \"b\" AttributeEnd ObjectInstance \"a\"");
  CHECK(d.groups.size() == 2);
  CHECK(std::get<InstanceShape>(d.shapes.at(0).geometry).group == 1);
  const SceneDescription moving = check_pbrt_round_trip(
      kPlain +
      "LightSource \"point\" ActiveTransform EndTime Translate 1 0 0 ActiveTransform All "
      "Shape \"sphere\"\n");
  CHECK(moving.shapes.at(0).motion.keyframes().size() == 2);
}

TEST_CASE("pbrt writer: materials survive") {
  const std::string rough = " \"float uroughness\" 0.25 \"float vroughness\" 0.0625 ";
  for (const std::string& material :
       {std::string("\"diffuse\" \"rgb reflectance\" [0.1 0.2 0.3]"),
        std::string("\"diffuse\" \"texture reflectance\" \"colour\""),
        "\"conductor\" \"rgb eta\" [1 2 3] \"rgb k\" [4 5 6]" + rough,
        std::string("\"conductor\" \"texture reflectance\" \"colour\""),
        std::string("\"conductor\" \"texture roughness\" \"grey\""),
        std::string("\"dielectric\" \"float eta\" 1.25"),
        "\"dielectric\" \"bool remaproughness\" false" + rough,
        std::string("\"thindielectric\" \"float eta\" 1.25"),
        std::string("\"diffusetransmission\" \"rgb reflectance\" [0.25 0.5 0.125] "
                    "\"rgb transmittance\" [0.5 0.25 0.25]"),
        std::string("\"diffusetransmission\" \"texture reflectance\" \"colour\""),
        "\"coateddiffuse\" \"float thickness\" 0.5 \"rgb albedo\" [0.1 0.2 0.3] \"float g\" 0.25 "
        "\"integer maxdepth\" 7 \"integer nsamples\" 3 \"float eta\" 1.25" +
            rough,
        std::string("\"coatedconductor\" \"rgb reflectance\" [0.5 0.25 0.75]"),
        std::string("\"coatedconductor\" \"rgb conductor.eta\" [1 2 3] \"rgb conductor.k\" [3 2 1] "
                    "\"float conductor.roughness\" 0.25 \"float interface.eta\" 1.25 "
                    "\"texture interface.roughness\" \"grey\""),
        std::string("\"hair\" \"rgb sigma_a\" [0.5 1 2] \"float beta_m\" 0.2 \"float beta_n\" 0.4 "
                    "\"float alpha\" 3 \"float eta\" 1.5"),
        std::string("\"hair\" \"texture eumelanin\" \"grey\" \"float pheomelanin\" 0.5"),
        std::string("\"hair\" \"texture reflectance\" \"colour\""),
        std::string("\"hair\" \"rgb reflectance\" [0.5 0.25 0.75] \"texture beta_n\" \"grey\""),
        std::string("\"hair\" \"texture beta_m\" \"grey\" \"texture alpha\" \"grey\" \"texture "
                    "eta\" \"grey\""),
        std::string("\"subsurface\" \"rgb sigma_a\" [0.25 0.5 0.25] \"rgb sigma_s\" [0.75 0.5 "
                    "0.25]"),
        "\"measured\" \"string filename\" \"" + source_path("scenes/bsdf-measured/isotropic.bsdf") +
            "\"",
        std::string("\"interface\""),
        std::string("\"diffuse\" \"texture displacement\" \"grey\""),
        std::string("\"diffuse\" \"string normalmap\" \"image.exr\"")}) {
    CAPTURE(material);
    check_pbrt_round_trip(with_material("Material " + material));
  }
  check_pbrt_round_trip(with_material(
      "MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\nMakeNamedMaterial \"b\" \"string "
      "type\" "
      "\"conductor\"\nMaterial \"mix\" \"string materials\" [\"a\" \"b\"] \"texture amount\" "
      "\"grey\""));
}

TEST_CASE("pbrt writer: images survive with all that is done to them") {
  for (const std::string image :
       {"\"float uscale\" 2 \"float vscale\" 4 \"float udelta\" 0.25 \"float vdelta\" 0.5",
        "\"float scale\" 0.5", "\"float scale\" 2", "\"float scale\" 2 \"bool invert\" true",
        "\"bool invert\" true", "\"string wrap\" \"clamp\" \"string filter\" \"point\"",
        "\"string wrap\" \"black\"", "\"string mapping\" \"spherical\" \"float scale\" 0.5",
        "\"string mapping\" \"cylindrical\""}) {
    CAPTURE(image);
    check_pbrt_round_trip("Scale 2 2 4 " + with_color("\"imagemap\" " + kImageFile + image));
    check_pbrt_round_trip("Scale 2 2 4 " + with_number("\"imagemap\" " + kImageFile + image));
  }
  // The third coordinate of a plane is not looked at.
  const std::string planar =
      "\"string mapping\" \"planar\" \"vector3 v1\" [2 0 1] \"vector3 v2\" [0 1 4] "
      "\"float udelta\" 0.5 ";
  check_pbrt_round_trip(with_color("\"imagemap\" " + kImageFile + planar));
  check_pbrt_round_trip(with_color("\"checkerboard\" \"rgb tex1\" [1 0 0] " + planar));
  check_pbrt_round_trip(with_color("\"dots\" \"rgb inside\" [1 0 0] " + planar));
  const SceneDescription d = read_pbrt_text("Translate 1 2 3 Scale 2 2 4 " +
                                            with_color("\"imagemap\" " + kImageFile + planar));
  const SceneDescription again = read_pbrt_text(pbrt::write_pbrt(d).text, false);
  const auto mapped = [](const SceneDescription& scene) {
    for (const TextureDescription& t : scene.textures)
      if (const auto* map = std::get_if<MappedTextureDescription>(&t.model)) return *map;
    FAIL("no mapped texture");
    return MappedTextureDescription{};
  };
  for (int row = 0; row < 2; ++row)
    CHECK(mapped(d).from_world[row] == mapped(again).from_world[row]);
}

TEST_CASE("pbrt writer: patterns survive") {
  const std::string red = "\"rgb tex1\" [1 0 0] ", both = red + "\"rgb tex2\" [0.1 0.2 0.3] ";
  for (const std::string& pattern :
       {"\"checkerboard\" " + both + "\"float uscale\" 8",
        "\"checkerboard\" \"integer dimension\" 3 " + both,
        "\"checkerboard\" \"string mapping\" \"spherical\" " + both,
        std::string("\"dots\" \"rgb inside\" [1 0 0] \"float vscale\" 4"),
        std::string("\"bilerp\" \"rgb v00\" [1 0 0] \"rgb v01\" [0 1 0] \"rgb v10\" [0 0 1]"),
        std::string("\"marble\" \"float scale\" 2 \"float variation\" 0.5"),
        "\"directionmix\" \"vector3 dir\" [1 2 4] " + both}) {
    CAPTURE(pattern);
    check_pbrt_round_trip("Translate 1 2 3 Scale 2 2 4 " + with_color(pattern));
  }
  // v4 has these of numbers only, and the others of both kinds.
  for (const std::string pattern : {"\"fbm\" \"integer octaves\" 4 \"float roughness\" 0.25",
                                    "\"wrinkled\" \"integer octaves\" 3", "\"windy\""}) {
    CAPTURE(pattern);
    check_pbrt_round_trip("Translate 1 2 3 Scale 2 2 4 " + with_number(pattern));
  }
  for (const std::string pattern :
       {"\"checkerboard\" \"float tex1\" 0.5 \"string mapping\" \"planar\"",
        "\"dots\" \"float inside\" 0.25"}) {
    CAPTURE(pattern);
    check_pbrt_round_trip(with_number(pattern));
  }
  const std::string grey = "Texture \"g\" \"float\" \"imagemap\" " + kImageFile;
  check_pbrt_round_trip(grey + with_color("\"mix\" \"texture amount\" \"g\" " + both));
  check_pbrt_round_trip("Texture \"c\" \"spectrum\" \"imagemap\" " + kImageFile + grey +
                        with_color("\"scale\" \"texture tex\" \"c\" \"texture scale\" \"g\""));
}

TEST_CASE("pbrt writer: media survive, with what they emit") {
  const std::string sigma = " \"rgb sigma_a\" [0.25 0.5 0.75] \"rgb sigma_s\" [0.75 0.5 0.25] ";
  const std::string grid =
      " \"integer nx\" 2 \"integer ny\" 2 \"integer nz\" 2 \"point3 p0\" [0 0 0] \"point3 p1\" "
      "[1 1 1] ";
  const std::string density = grid + "\"float density\" [1 2 3 4 5 6 7 8] ";
  for (const std::string& medium :
       {"\"homogeneous\"" + sigma + "\"float scale\" 3 \"float g\" 0.5",
        "\"homogeneous\"" + sigma + "\"rgb Le\" [1 2 3] \"float Lescale\" 2",
        "\"uniformgrid\"" + sigma + density + "\"float g\" 0.25 \"float scale\" 3",
        "\"uniformgrid\"" + sigma + density + "\"rgb Le\" [4 2 1]",
        "\"uniformgrid\"" + sigma + density +
            "\"rgb Le\" [4 2 1] \"float Lescale\" [1 2 4 8 1 2 4 8]",
        "\"uniformgrid\"" + sigma + density +
            "\"float temperature\" [1000 2000 3000 4000 1000 1000 1000 1000] "
            "\"float temperatureoffset\" 10 \"float temperaturescale\" 1.5 "
            "\"float Lescale\" [1 2 4 8 1 2 4 8]",
        "\"cloud\"" + sigma +
            "\"float density\" 2 \"float wispiness\" 3 \"float frequency\" 4 "
            "\"point3 p0\" [-1 -2 -3] \"point3 p1\" [3 2 1]"}) {
    CAPTURE(medium);
    const SceneDescription d = check_pbrt_round_trip(with_medium(medium));
    CHECK(d.media.size() == 1);
  }
  // Extinction and albedo are made of absorption and scattering, and have to be taken apart again.
  std::string colors = "\"rgb sigma_a\" [", emission = "] \"rgb Le\" [";
  for (int i = 0; i < 8; ++i) colors += "0.5 0.25 1 ", emission += fmt::format("{} 1 2 ", i);
  const SceneDescription d = read_pbrt_text(with_medium(
      "\"rgbgrid\"" + grid + colors + "] \"rgb sigma_s\" [" + colors.substr(15) + emission + "]"));
  check_pbrt_parts(d, read_pbrt_text(pbrt::write_pbrt(d).text, false), 1e-6f);
  CHECK(pbrt::write_pbrt(d).losses.empty());
}

TEST_CASE("pbrt writer: numbers keep their bits") {
  const SceneDescription d = check_pbrt_round_trip(
      kPlain +
      "LightSource \"point\" \"rgb I\" [0.1 16777217 1.17549435e-38] \"point3 from\" "
      "[0.1 3.3333333333333335 1e-9]\n"
      "Shape \"trianglemesh\" \"point3 P\" [0.1 0.2 0.3 3.4028234e38 1e-30 -0.7 7 8 9.000001]");
  CHECK(std::get<PointLight>(d.lights.at(0).model).intensity.r == 0.1f);
  const auto& mesh = *std::get<MeshShape>(d.shapes.at(0).geometry).mesh;
  CHECK(mesh.positions.at(2).z == 9.000001f);
}
