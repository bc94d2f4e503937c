#include "evaluate/batch/scene_folder.h"

#include <doctest/doctest.h>

#include "evaluate/batch/image_pixels.h"
#include "support/files.h"

using namespace duet;
using namespace duet::batch;
using namespace duet::test;

namespace {

constexpr const char* kSensor = "<sensor type=\"perspective\"/>";

std::string scene(const std::string& contents) {
  return "<scene version=\"3.0.0\">" + contents + "</scene>";
}

}  // namespace

TEST_CASE("the scenes below a folder are found, and what belongs to them is not taken for one") {
  const TemporaryDirectory folder;
  for (const char* name : {"deep", "deep/er", "folder.xml"})
    std::filesystem::create_directory(folder.path(name));
  folder.write("deep/scene.xml", scene(kSensor));
  folder.write("deep/camera.xml", scene(kSensor));
  folder.write("deep/er/includes.xml", scene("<include filename=\"../camera.xml\"/>"));
  folder.write("deep/materials.xml", scene("<bsdf type=\"diffuse\" id=\"x\"/>"));
  folder.write("other.xml", "<project name=\"x\"/>");
  folder.write("cut.xml", scene(kSensor).substr(0, 40));
  folder.write("notes.txt", scene(kSensor));
  folder.write("p.pbrt", "Camera \"perspective\" # WorldBegin\nWorldBegin\nShape \"sphere\"\n");
  folder.write("part.pbrt", "# WorldBegin\nShape \"WorldBegin\" \"float x\" [1 2]\n");
  folder.write("damaged.pbrt", "Camera \"perspective\n");
  Diagnostics diagnostics;
  std::vector<std::string> names;
  for (const Job& job : scenes_below(folder.path(""), diagnostics))
    names.push_back(std::filesystem::path(job.scene).lexically_relative(folder.path("")).string());
  CHECK(names == std::vector<std::string>{"cut.xml", "damaged.pbrt", "deep/er/includes.xml",
                                          "deep/scene.xml", "p.pbrt"});
  CHECK(diagnostics.all().empty());
}

TEST_CASE("a folder without scenes is an error") {
  const TemporaryDirectory folder;
  folder.write("a.txt", "");
  for (const std::string& path : {folder.path(""), folder.path("nowhere")}) {
    Diagnostics diagnostics;
    CHECK(scenes_below(path, diagnostics).empty());
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all()[0].to_string().starts_with(path + ": error: "));
  }
}

TEST_CASE("the pixels of a job are those of its options, or of its film") {
  const TemporaryDirectory folder;
  const auto pixels = [&](const std::string& name, const std::string& text,
                          const std::vector<JobOption>& options = {}) {
    Job job;
    job.scene = folder.write(name, text);
    job.options = options;
    return image_pixels(job);
  };
  const std::string film = scene(
      "<default name=\"w\" value=\"40\"/><sensor type=\"perspective\"><film type=\"hdrfilm\">"
      "<integer name=\"width\" value=\"$w\"/><integer name=\"height\" value=\"30\"/></film>"
      "</sensor><shape type=\"obj\"><string name=\"filename\" value=\"nowhere.obj\"/></shape>");
  CHECK(pixels("a.xml", film) == 1200);
  CHECK(pixels("a.xml", film, {{"define", {"w=10"}}}) == 300);
  CHECK(pixels("a.xml", film, {{"size", {"64x32"}}}) == 2048);
  CHECK(pixels("a.xml", film, {{"size", {"64x32"}}, {"crop", {"8,8,4,5"}}}) == 20);
  CHECK(pixels("b.xml", scene(kSensor)) == 768 * 576);
  CHECK(!pixels("c.xml", "<scene"));
  CHECK(pixels("a.pbrt",
               "Film \"rgb\" \"integer yresolution\" [20] \"string filename\" \"x.exr\"\n"
               "\"integer xresolution\" 10\nWorldBegin") == 200);
  CHECK(pixels("b.pbrt", "WorldBegin Film \"rgb\" \"integer xresolution\" 1") == 1280 * 720);
  CHECK(!pixels("c.pbrt", "Film \"rgb"));
  Job missing;
  missing.scene = folder.path("missing.pbrt");
  CHECK(!image_pixels(missing));
}
