// progress: puts a scene together, renders it on a thread of its own, shows how far it is, and stops after a second.
#include <duet/duet.h>

#include <atomic>
#include <cstdio>
#include <future>
#include <thread>

namespace {

/// A ball on a floor of two triangles, under a white sky.
duet::SceneObject ball_on_floor() {
  duet::SceneObject film("film", "hdrfilm");
  film.set("width", 64).set("height", 48);
  duet::SceneObject sensor("sensor", "perspective");
  sensor.set("to_world", duet::SceneTransform::look_at({0, 1, 5}, {0, 0, 0}, {0, 1, 0}));
  sensor.add(film);

  duet::SceneObject wood("bsdf", "diffuse", "wood");
  wood.set("reflectance", duet::SceneRgb{0.5, 0.3, 0.2});
  duet::SceneMesh square;
  square.positions = {{-3, -1, -3}, {3, -1, -3}, {3, -1, 3}, {-3, -1, 3}};
  square.triangles = {{0, 2, 1}, {0, 3, 2}};
  duet::SceneObject floor = duet::SceneObject::mesh(square, "floor");
  floor.add(duet::SceneReference{"wood"});

  duet::SceneObject scene = duet::SceneObject::scene();
  scene.add(duet::SceneObject("integrator", "path").set("max_depth", 8)).add(sensor);
  scene.add(wood).add(floor);
  scene.add(duet::SceneObject("shape", "sphere").add(duet::SceneObject("bsdf", "roughplastic")));
  scene.add(duet::SceneObject("emitter", "constant"));
  return scene;
}

}  // namespace

int main() {
  const duet::SceneFile scene = duet::SceneFile::from_description(ball_on_floor());
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
