#include "scene/scene_motion.h"

#include <stdexcept>
#include <utility>

#include "scene/builder.h"

namespace duet {

namespace {

/// Makes a shape the only one of a group, and an instance of it what stands in the scene.
void make_instance_of(ShapeDescription& shape, SceneDescription& description) {
  ShapeDescription instance;
  instance.where = shape.where;
  instance.label = shape.label;
  instance.geometry = InstanceShape{uint32_t(description.groups.size())};
  instance.motion = std::exchange(shape.motion, {});
  ShapeGroupDescription group{shape.where, {}, {}};
  group.shapes.push_back(std::exchange(shape, std::move(instance)));
  description.groups.push_back(std::move(group));
}

}  // namespace

std::vector<Mover> take_movers(SceneDescription& description, size_t sensor) {
  const SensorDescription& view = description.sensors[sensor];
  const double open = view.shutter[0], close = view.shutter[1];
  const auto moves = [&](const auto& thing) { return !thing.motion.is_still(open, close); };
  std::vector<Mover> movers;
  const auto take = [&](Mover::Kind kind, uint32_t index, const auto& thing) {
    if (moves(thing)) movers.push_back({kind, index, thing.to_world, thing.motion, {}});
  };
  uint32_t shapes = 0, instances = 0, lights = 0;
  for (size_t i = 0; i < description.shapes.size(); ++i) {
    ShapeDescription& s = description.shapes[i];
    const bool measures = view.kind == SensorKind::irradiancemeter && view.shape == i;
    const auto is_instance = [&] { return std::holds_alternative<InstanceShape>(s.geometry); };
    if (moves(s) && !s.emission && !measures && !is_instance()) make_instance_of(s, description);
    if (is_instance()) {
      take(Mover::Kind::instance, instances++, s);
      continue;
    }
    take(Mover::Kind::shape, shapes++, s);
    if (moves(s)) movers.back().mesh = own_triangles(s);
  }
  for (const LightDescription& light : description.lights)
    take(Mover::Kind::light, lights++, light);
  take(Mover::Kind::sensor, 0, view);
  description = scene_at(std::move(description), movers.empty() ? open : 0.5 * open + 0.5 * close);
  return movers;
}

SceneMotion::SceneMotion(std::shared_ptr<SceneBuilder> builder, std::vector<Mover> movers,
                         double open, double close)
    : builder_(std::move(builder)), movers_(std::move(movers)), open_(open), close_(close) {}

void SceneMotion::pose(double share) {
  if (share == share_) return;
  share_ = share;
  const double time = (1 - share) * open_ + share * close_;
  for (const Mover& m : movers_) {
    const Matrix4 to_world = m.motion.at(time) * m.first;
    switch (m.kind) {
      case Mover::Kind::shape:
        builder_->place_shape(m.index, to_world, m.mesh.get());
        break;
      case Mover::Kind::instance:
        builder_->place_instance(m.index, to_world);
        break;
      case Mover::Kind::light:
        builder_->place_light(m.index, to_world);
        break;
      case Mover::Kind::sensor:
        builder_->place_sensor(to_world);
        break;
    }
  }
  builder_->settle();
}

size_t SceneMotion::moved_triangles() const {
  size_t sum = 0;
  for (const Mover& m : movers_)
    if (m.mesh) sum += m.mesh->triangles.size();
  return sum;
}

MotionLease::MotionLease(SceneMotion* motion) : motion_(motion) {
  if (!motion) return;
  std::thread::id holder;
  if (motion->holder_.compare_exchange_strong(holder, std::this_thread::get_id())) return;
  if (holder != std::this_thread::get_id())
    throw std::runtime_error(
        "the scene moves while its shutter is open and is being rendered already: only one render "
        "at a time can move it (build the scene once more for another)");
  motion_ = nullptr;
}

MotionLease::~MotionLease() {
  if (motion_) motion_->holder_.store({});
}

}  // namespace duet
