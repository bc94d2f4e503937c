// compare SCENE [CHART.html TABLE.html]: how far path tracing with 16 samples is from 256 other ones, as
// `duet compare --json` says it; a chart of two methods in two seconds; and what they make of a white ball under a white
// sky, from the failure catalogue.
#include <duet/duet.h>

#include <fstream>
#include <iostream>

namespace {

duet::ComparedImage render(const duet::SceneFile& scene, int spp, uint64_t seed) {
  duet::RenderSettings settings;
  settings.integrator = "path";
  settings.size = {64, 64};
  settings.spp = spp;
  settings.seed = seed;
  const duet::RenderedImage image = duet::render_file(scene, settings).value();
  return duet::ComparedImage::from_pixels(image.pixels(), image.width(), image.height(),
                                          image.channels());
}

int chart(const duet::SceneFile& scene, const char* page) {
  duet::ChartSettings settings;
  settings.methods = {{"path", {}, ""}, {"bdpt", {{"max_depth", "8"}}, "bdpt, short paths"}};
  settings.size = {64, 64};
  settings.seconds = 2;
  const duet::MethodChart chart = duet::chart_file(scene, settings).value();
  std::ofstream(page) << chart.page("compare");
  for (const duet::ChartedLine& line : chart.lines())
    std::cout << line.name << ": " << line.points.back().spp << " samples per pixel\n";
  return chart.lines().size() == 2 ? 0 : 1;
}

int check(const char* page) {
  duet::StabilitySettings settings;
  settings.rows = {"white-furnace"};
  settings.methods = {"path", "bdpt"};
  settings.fast = true;
  const duet::StabilityTable table = duet::check_stability(settings).value();
  std::ofstream(page) << table.page("compare");
  std::cout << table.summary();
  return table.is_as_expected() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: compare SCENE [CHART.html TABLE.html]\n";
    return 2;
  }
  try {
    const duet::SceneFile scene = duet::SceneFile::load(argv[1]);
    std::cout << duet::compare_images(render(scene, 16, 1), render(scene, 256, 2)) << '\n';
    return argc < 4 ? 0 : chart(scene, argv[2]) + check(argv[3]);
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
