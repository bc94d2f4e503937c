// compare SCENE: how far path tracing with 16 samples is from 256 other ones, as `duet compare --json` says it.
#include <duet/duet.h>

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

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: compare SCENE\n";
    return 2;
  }
  try {
    const duet::SceneFile scene = duet::SceneFile::load(argv[1]);
    std::cout << duet::compare_images(render(scene, 16, 1), render(scene, 256, 2)) << '\n';
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
