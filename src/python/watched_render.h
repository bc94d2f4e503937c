// Renders that Python waits for.
#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <future>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "duet/duet.h"
#include "python/calls.h"

namespace duet::python {

/// A render on a thread of its own, so that the calling one can answer to Python: to Ctrl-C, and to
/// those who watch the progress.
class WatchedRender {
 public:
  WatchedRender(const SceneFile& scene, const RenderSettings& settings);
  ~WatchedRender();
  WatchedRender(const WatchedRender&) = delete;
  WatchedRender& operator=(const WatchedRender&) = delete;

  /// Waits for the image. `watch` is None or gets fraction, samples per pixel and seconds, the last
  /// time when the render has ended.
  std::optional<RenderedImage> wait(const nanobind::object& watch);
  /// To be asked for when the render has ended.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  bool is_ready() const;
  void tell(const nanobind::object& watch);
  void set_progress(const RenderedShare& p);
  RenderedShare progress();

  const Call call_;  ///< until the thread of the render is gone and no watcher is called
  std::atomic<bool> cancel_{false};
  std::mutex mutex_;
  RenderedShare progress_;
  std::vector<std::string> warnings_;
  std::future<std::optional<RenderedImage>> render_;
};

/// The image and the warnings.
std::pair<RenderedImage, std::vector<std::string>> render(const SceneFile& scene,
                                                          const RenderSettings& settings,
                                                          const nanobind::object& watch);

}  // namespace duet::python
