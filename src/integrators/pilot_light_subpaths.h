// The light sub-paths of a pilot, with the densities of all their vertices and where photons came
// from.
#pragma once

#include <span>
#include <vector>

#include "transport/light_vertex.h"
#include "transport/mis.h"

namespace duet {

/// How a light sub-path arrived at a vertex.
struct PhotonArrival {
  /// The vertex before, the point on the light, or where the last surface was passed straight.
  Point3f from;
  Normal3f normal;  ///< of the surface: geometric, unit; in a medium none
  EndPdfs ends;     ///< of the sub-path's vertex pdfs
};

/// The vertices of some light sub-paths, sub-path after sub-path.
struct PilotLightSubpaths {
  std::vector<LightVertex> vertices;
  std::vector<PhotonArrival> arrivals;  ///< of each vertex
  std::vector<uint32_t> owner;          ///< the sub-path of each vertex
  std::vector<uint32_t> vertex_ends, end_pdfs;
  SubpathPdfs pdf_lists;

  std::span<const VertexPdfs> pdfs(size_t subpath) const {
    const uint32_t first = subpath == 0 ? 0 : end_pdfs[subpath - 1];
    return {pdf_lists.data() + first, end_pdfs[subpath] - first};
  }
  /// Vertices of the sub-path are numbers first_vertex() to vertex_ends[subpath] − 1.
  size_t first_vertex(size_t subpath) const { return subpath == 0 ? 0 : vertex_ends[subpath - 1]; }
  /// A vertex of the sub-path that is under way, and has these vertex pdfs.
  template <class Vertex>
  void add(const Vertex& v, const Hit& hit, const SubpathPdfs& pdfs) {
    vertices.emplace_back(v, hit);
    PhotonArrival a{v.position(), {}, {pdfs.front(), pdfs.back()}};
    if (v.surface.shape) a.from = v.position() + v.wo * hit.t, a.normal = v.surface.ng;
    arrivals.push_back(a);
    owner.push_back(uint32_t(vertex_ends.size()));
  }
  /// Ends the sub-path that is under way.
  void end_subpath(const SubpathPdfs& pdfs) {
    vertex_ends.push_back(uint32_t(vertices.size()));
    pdf_lists.insert(pdf_lists.end(), pdfs.begin(), pdfs.end());
    end_pdfs.push_back(uint32_t(pdf_lists.size()));
  }
  void append(const PilotLightSubpaths& o) {
    const uint32_t first = uint32_t(vertices.size()), first_pdfs = uint32_t(pdf_lists.size()),
                   subpaths = uint32_t(vertex_ends.size());
    vertices.insert(vertices.end(), o.vertices.begin(), o.vertices.end());
    arrivals.insert(arrivals.end(), o.arrivals.begin(), o.arrivals.end());
    pdf_lists.insert(pdf_lists.end(), o.pdf_lists.begin(), o.pdf_lists.end());
    for (const uint32_t w : o.owner) owner.push_back(subpaths + w);
    for (const uint32_t e : o.vertex_ends) vertex_ends.push_back(first + e);
    for (const uint32_t e : o.end_pdfs) end_pdfs.push_back(first_pdfs + e);
  }
};

}  // namespace duet
