#include "evaluate/render/batch.h"

#include <fmt/format.h>

namespace duet {

void Batch::begin_scene() {
  ++current_;
  scene_start_ = Clock::now();
}

void Batch::end_scene(bool rendered) {
  if (!rendered) return;
  ++rendered_;
  rendered_seconds_ += scene_seconds();
}

std::string Batch::label() const {
  return is_several() ? fmt::format("[{}/{}] ", current_, scenes_) : "";
}

double Batch::seconds_left(double scene_left) const {
  const double all = rendered_seconds_ + scene_seconds() + scene_left;
  const double mean = all / double(rendered_ + 1);
  return scene_left + double(scenes_ - current_) * mean;
}

double Batch::scene_seconds() const {
  return std::chrono::duration<double>(Clock::now() - scene_start_).count();
}

}  // namespace duet
