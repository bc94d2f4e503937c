// render SCENE IMAGE.exr|.png|.jpg [SPP]: an image of a scene, by the method that suits it.
#include <duet/duet.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: render SCENE IMAGE [SPP]\n";
    return 2;
  }
  try {
    const duet::SceneFile scene = duet::SceneFile::load(argv[1]);
    for (const std::string& warning : scene.warnings()) std::cerr << warning << '\n';
    duet::RenderSettings settings;
    settings.integrator = "auto";
    if (argc > 3) settings.spp = std::atoi(argv[3]);
    const duet::RenderedImage image = duet::render_file(scene, settings).value();
    image.save(argv[2]);
    std::cout << image.width() << " x " << image.height() << ", " << image.channels().size()
              << " channels\n";
  } catch (const duet::SceneError& e) {
    std::cerr << e.what() << '\n';
    return 1;
  } catch (const std::exception& e) {
    std::cerr << "render: " << e.what() << '\n';
    return 1;
  }
}
