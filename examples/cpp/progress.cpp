// progress: renders a scene that is a text here, on a thread of its own, shows how far it is, and stops after a second.
#include <duet/duet.h>

#include <atomic>
#include <cstdio>
#include <future>
#include <thread>

namespace {

const char* const kScene = R"(<scene version="3.0.0">
  <integrator type="path"><integer name="max_depth" value="8"/></integrator>
  <sensor type="perspective">
    <transform name="to_world"><lookat origin="0, 1, 5" target="0, 0, 0" up="0, 1, 0"/></transform>
    <film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="48"/></film>
  </sensor>
  <shape type="sphere"><bsdf type="roughplastic"/></shape>
  <emitter type="constant"/>
</scene>)";

}  // namespace

int main() {
  const duet::SceneFile scene = duet::SceneFile::from_text(kScene);
  duet::RenderSettings settings;
  settings.spp = 1 << 20;
  std::atomic<bool> stop{false};
  std::atomic<int> images{0};
  duet::RenderWatch watch;
  watch.progress = [](const duet::RenderedShare& share) {
    std::printf("%.0f samples per pixel, %.1f s\n", share.spp, share.seconds);
  };
  watch.image_so_far = [&](const duet::RenderedImage&) { ++images; };
  watch.image_seconds = 0.2;
  watch.cancel = &stop;
  auto render = std::async(std::launch::async, [&] { return duet::render_file(scene, settings, watch); });
  std::this_thread::sleep_for(std::chrono::seconds(1));
  stop = true;
  const std::optional<duet::RenderedImage> image = render.get();
  if (!image || !image->interrupted()) return 1;
  std::printf("%d images on the way, the last one of %zu values\n", images.load(),
              image->pixels().size());
  return images > 0 ? 0 : 1;
}
