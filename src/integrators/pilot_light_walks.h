// The light walks of a pilot, with the densities of all their vertices and where photons came from.
#pragma once

#include <span>
#include <vector>

#include "transport/light_vertex.h"
#include "transport/mis.h"

namespace duet {

/// How a light walk arrived at a vertex.
struct PhotonArrival {
  /// The vertex before, the point on the light, or where the last surface was passed straight.
  Point3f from;
  Normal3f normal;  ///< of the surface: geometric, unit; in a medium none
  TrailEnds ends;   ///< of the walk's trail
};

/// The vertices of some light walks, walk after walk.
struct PilotLightWalks {
  std::vector<LightVertex> vertices;
  std::vector<PhotonArrival> arrivals;  ///< of each vertex
  std::vector<uint32_t> owner;          ///< the walk of each vertex
  std::vector<uint32_t> vertex_ends, trail_ends;
  Trail trails;

  std::span<const TrailVertex> trail(size_t walk) const {
    const uint32_t first = walk == 0 ? 0 : trail_ends[walk - 1];
    return {trails.data() + first, trail_ends[walk] - first};
  }
  /// Vertices of the walk are numbers first_vertex() to vertex_ends[walk] − 1.
  size_t first_vertex(size_t walk) const { return walk == 0 ? 0 : vertex_ends[walk - 1]; }
  /// A vertex of the walk that is under way, and has this trail.
  template <class Vertex>
  void add(const Vertex& v, const Hit& hit, const Trail& trail) {
    vertices.emplace_back(v, hit);
    PhotonArrival a{v.position(), {}, {trail.front(), trail.back()}};
    if (v.surface.shape) a.from = v.position() + v.wo * hit.t, a.normal = v.surface.ng;
    arrivals.push_back(a);
    owner.push_back(uint32_t(vertex_ends.size()));
  }
  /// Ends the walk that is under way.
  void end_walk(const Trail& trail) {
    vertex_ends.push_back(uint32_t(vertices.size()));
    trails.insert(trails.end(), trail.begin(), trail.end());
    trail_ends.push_back(uint32_t(trails.size()));
  }
  void append(const PilotLightWalks& o) {
    const uint32_t first = uint32_t(vertices.size()), first_trail = uint32_t(trails.size()),
                   walks = uint32_t(vertex_ends.size());
    vertices.insert(vertices.end(), o.vertices.begin(), o.vertices.end());
    arrivals.insert(arrivals.end(), o.arrivals.begin(), o.arrivals.end());
    trails.insert(trails.end(), o.trails.begin(), o.trails.end());
    for (const uint32_t w : o.owner) owner.push_back(walks + w);
    for (const uint32_t e : o.vertex_ends) vertex_ends.push_back(first + e);
    for (const uint32_t e : o.trail_ends) trail_ends.push_back(first_trail + e);
  }
};

}  // namespace duet
