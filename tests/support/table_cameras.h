// The cameras of the tables.
#pragma once

#include <memory>

#include "cameras/orthographic.h"
#include "cameras/perspective.h"
#include "math/fov.h"
#include "support/tables.h"

namespace duet::test {

inline FovAxis to_fov_axis(const std::string& name) {
  return name == "y"          ? FovAxis::y
         : name == "diagonal" ? FovAxis::diagonal
         : name == "smaller"  ? FovAxis::smaller
         : name == "larger"   ? FovAxis::larger
                              : FovAxis::x;
}

inline std::unique_ptr<Camera> to_camera(const Json& c) {
  const Json& p = c["parameters"];
  const Transform to_world(to_matrix(c["to_world"]));
  const Point2i film{c["size"][0], c["size"][1]};
  if (c["kind"] == "orthographic")
    return std::make_unique<OrthographicCamera>(
        OrthographicView{to_world, film, p["near_clip"], p["far_clip"]});
  PerspectiveView view;
  view.to_world = to_world;
  view.film = film;
  view.horizontal_fov = horizontal_fov(p["fov"], to_fov_axis(p.value("fov_axis", "x")),
                                       double(film.x) / double(film.y));
  view.offset_x = p.value("principal_point_offset_x", 0.0);
  view.offset_y = p.value("principal_point_offset_y", 0.0);
  view.near_clip = p["near_clip"];
  view.far_clip = p["far_clip"];
  if (c["kind"] == "thinlens")
    return std::make_unique<ThinLensCamera>(view,
                                            ThinLens{p["aperture_radius"], p["focus_distance"]});
  return std::make_unique<PerspectiveCamera>(view);
}

}  // namespace duet::test
