#include "python/watched_render.h"

#include <chrono>

namespace nb = nanobind;

namespace duet::python {

WatchedRender::WatchedRender(const SceneFile& scene, const RenderSettings& settings)
    : render_(std::async(std::launch::async, [this, scene, settings] {
        return render_file(scene, settings,
                           {.progress = [this](const RenderedShare& p) { set_progress(p); },
                            .warning = [this](const std::string& w) { warnings_.push_back(w); },
                            .cancel = &cancel_});
      })) {}

WatchedRender::~WatchedRender() {
  cancel_ = true;
  const OthersMayRun others_may_run;
  if (render_.valid()) render_.wait();
}

std::optional<RenderedImage> WatchedRender::wait(const nb::object& watch) {
  while (!is_ready()) {
    // An exception of a signal's handler: Ctrl-C gets the samples so far, another one ends it.
    if (PyErr_CheckSignals() != 0) {
      if (!PyErr_ExceptionMatches(PyExc_KeyboardInterrupt)) throw nb::python_error();
      PyErr_Clear();
      cancel_ = true;
    }
    if (is_ending())
      cancel_ = true;
    else if (!watch.is_none())
      tell(watch);
  }
  std::optional<RenderedImage> image = render_.get();
  if (!watch.is_none() && !is_ending()) tell(watch);
  return image;
}

bool WatchedRender::is_ready() const {
  const OthersMayRun others_may_run;
  return render_.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
}

void WatchedRender::tell(const nb::object& watch) {
  const RenderedShare p = progress();
  try {
    watch(p.fraction, p.spp, p.seconds);
  } catch (const nb::python_error& e) {
    if (!e.matches(PyExc_KeyboardInterrupt)) throw;
    cancel_ = true;
  }
}

void WatchedRender::set_progress(const RenderedShare& p) {
  const std::lock_guard lock(mutex_);
  progress_ = p;
}

RenderedShare WatchedRender::progress() {
  const std::lock_guard lock(mutex_);
  return progress_;
}

std::pair<RenderedImage, std::vector<std::string>> render(const SceneFile& scene,
                                                          const RenderSettings& settings,
                                                          const nb::object& watch) {
  WatchedRender render(scene, settings);
  std::optional<RenderedImage> image = render.wait(watch);
  if (!image) {
    // Threads end by SystemExit without a word.
    PyErr_SetNone(is_ending() ? PyExc_SystemExit : PyExc_KeyboardInterrupt);
    throw nb::python_error();
  }
  return {std::move(*image), render.warnings()};
}

}  // namespace duet::python
