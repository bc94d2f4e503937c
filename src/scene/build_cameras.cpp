// Builds the sensor that a scene is seen by.
#include "cameras/batch.h"
#include "cameras/meters.h"
#include "cameras/orthographic.h"
#include "cameras/perspective.h"
#include "cameras/realistic.h"
#include "cameras/spherical.h"
#include "scene/builder.h"

namespace duet {

std::unique_ptr<Camera> SceneBuilder::camera(SensorDescription& d, const Point2i& film) {
  if (!check_transform(d.to_world, d.where)) return nullptr;
  const Transform to_world(d.to_world);
  const auto orthographic = [&] {
    return OrthographicView{to_world, film, d.near_clip, d.far_clip};
  };
  const auto perspective = [&] {
    return PerspectiveView{to_world,
                           film,
                           horizontal_fov(d.fov, d.fov_axis, double(film.x) / film.y),
                           d.principal_point_offset_x,
                           d.principal_point_offset_y,
                           d.near_clip,
                           d.far_clip};
  };
  switch (d.kind) {
    case SensorKind::perspective:
      return std::make_unique<PerspectiveCamera>(perspective());
    case SensorKind::thinlens:
      return std::make_unique<ThinLensCamera>(
          perspective(), ThinLens{d.aperture_radius, d.focus_distance, d.aperture_aspect});
    case SensorKind::orthographic:
      return std::make_unique<OrthographicCamera>(orthographic());
    case SensorKind::telecentric:
      return std::make_unique<TelecentricCamera>(orthographic(), d.aperture_radius,
                                                 d.focus_distance);
    case SensorKind::perspective_rdist:
      return std::make_unique<DistortedCamera>(perspective(), d.distortion[0], d.distortion[1]);
    case SensorKind::spherical:
      return std::make_unique<SphericalCamera>(to_world, film,
                                               d.sphere_mapping == SphereMapping::equal_area);
    case SensorKind::realistic:
      return realistic(d, film);
    case SensorKind::radiancemeter:
      return check_single_pixel(d, film) ? std::make_unique<RadianceMeter>(to_world) : nullptr;
    case SensorKind::irradiancemeter:
      return irradiance_meter(d, film);
    case SensorKind::fluencemeter:
      return check_single_pixel(d, film) ? std::make_unique<FluenceMeter>(to_world) : nullptr;
    case SensorKind::distant:
      return distant_meter(d, film);
    case SensorKind::batch:
      return batch(d, film);
  }
  return nullptr;
}

std::optional<LensStop> SceneBuilder::lens_stop(const SensorDescription& d) {
  if (d.lenses.stop != StopShape::image) return LensStop(d.lenses.stop);
  const auto image = pixels(d.lenses.stop_image, {}, d.where);
  if (!image) return std::nullopt;  // after an error
  std::vector<float> values;
  float largest = 0;
  for (int y = 0; y < image->height(); ++y)
    for (int x = 0; x < image->width(); ++x) {
      const Spectrum c = image->color(x, y);
      values.push_back(std::max(0.0f, c.mean()));
      largest = std::max(largest, values.back());
    }
  drop_pixels(d.lenses.stop_image, {});
  if (largest > 0) return LensStop(image->width(), image->height(), std::move(values));
  diagnostics_.error(d.where, "the image of the lens's stop is black");
  return std::nullopt;
}

std::unique_ptr<Camera> SceneBuilder::realistic(const SensorDescription& d, const Point2i& film) {
  const LensDescription& l = d.lenses;
  auto stop = lens_stop(d);
  if (!stop) return nullptr;
  LensSystem lens(l.surfaces, *std::move(stop));
  const auto distance = lens.film_distance_for(l.focus_distance);
  if (!distance) {
    diagnostics_.error(d.where, "these lenses cannot be focused {:g} before the film",
                       l.focus_distance);
    return nullptr;
  }
  lens.set_film_distance(*distance);
  auto camera = std::make_unique<RealisticCamera>(Transform(d.to_world), film, l.film_diagonal,
                                                  std::move(lens), l.relative_to_pupil);
  if (!camera->pupil().empty()) return camera;
  diagnostics_.error(d.where, "no light passes these lenses");
  return nullptr;
}

bool SceneBuilder::check_single_pixel(const SensorDescription& d, const Point2i& film) {
  if (film.x == 1 && film.y == 1) return true;
  diagnostics_.error(d.where, "this sensor measures one number: its film has 1x1 pixels, not {}x{}",
                     film.x, film.y);
  return false;
}

std::unique_ptr<Camera> SceneBuilder::irradiance_meter(const SensorDescription& d,
                                                       const Point2i& film) {
  const uint32_t index = shape_index(d.shape);
  if (index >= scene_->shapes.size()) return nullptr;  // after an error
  const Shape& shape = scene_->shapes[index];
  if (ShapePoints::is_even(shape) && surface_area(shape) > 0)
    return std::make_unique<IrradianceMeter>(shape, film);
  diagnostics_.error(d.where,
                     "irradiance is measured on meshes, disks, and spheres and cylinders that are "
                     "not stretched, with an area");
  return nullptr;
}

std::unique_ptr<Camera> SceneBuilder::distant_meter(SensorDescription& d, const Point2i& film) {
  if (!check_single_pixel(d, film)) return nullptr;
  const Transform to_world(d.to_world);
  if (d.target_point) {
    const auto& p = *d.target_point;
    return std::make_unique<DistantMeter>(to_world, Point3f(float(p[0]), float(p[1]), float(p[2])));
  }
  if (d.target_shape.empty()) return std::make_unique<DistantMeter>(to_world);
  ShapeDescription& target = d.target_shape.front();
  if (!check_transform(target.to_world, target.where)) return nullptr;
  Shape shape = geometry(target, {});
  if (ShapePoints::is_even(shape) && surface_area(shape) > 0)
    return std::make_unique<DistantMeter>(to_world, std::move(shape));
  diagnostics_.error(target.where,
                     "a target is a mesh, a disk, or a sphere or cylinder that is not stretched, "
                     "with an area");
  return nullptr;
}

std::unique_ptr<Camera> SceneBuilder::batch(SensorDescription& d, const Point2i& film) {
  const int count = int(d.parts.size());
  if (film.x % count != 0) {
    diagnostics_.error(d.where, "a film {} pixels wide cannot be divided among {} sensors", film.x,
                       count);
    return nullptr;
  }
  std::vector<std::unique_ptr<Camera>> cameras;
  for (SensorDescription& part : d.parts) {
    auto made = camera(part, {film.x / count, film.y});
    if (made) cameras.push_back(std::move(made));
  }
  if (cameras.size() != d.parts.size()) return nullptr;
  return std::make_unique<CameraBatch>(std::move(cameras), film.x / count);
}

}  // namespace duet
