// Weights for sub-paths of limited length: the balance heuristic over the techniques that are left
// and the unidirectional tail, exactly, by a product over all vertices of the path (docs/mis.md).
// Direct light counts as LightSampleVariance says.
#pragma once

#include <span>

#include "transport/connection.h"

namespace duet {

/// The limits of path reuse.
struct Windows {
  int eye = 4;             ///< T: segments of the eye sub-path before its tail
  int light = 3;           ///< S: segments of a light sub-path
  double tail = 1;         ///< q: probability with which the eye sub-path goes on beyond T
  double light_paths = 1;  ///< N_L

  /// How many samples technique (s, t) takes; 0 if it is not among the method's. Its tail consists
  /// of hits and light samples.
  double share(int s, int t) const {
    if (t <= eye + 1 && s <= light + 1) return t == 1 ? light_paths : 1.0;
    return t > eye + 1 && s <= 1 ? tail : 0.0;
  }
};

/// Weighs the connections of a light sub-path and an eye sub-path by their vertex pdfs; either may
/// be null where no connection asks for it. The vertex pdfs end with the vertices to be connected.
class WindowWeights {
 public:
  WindowWeights(const Windows& windows, const SubpathPdfs* light, const SubpathPdfs* eye)
      : windows_(windows), light_(light), eye_(eye) {}
  /// For connections: the vertex pdfs of a light sub-path, as FamilyWeights::set_light() takes
  /// them.
  void set_light(std::span<const VertexPdfs> pdfs, const EndPdfs* ends = nullptr) {
    light_subpath_ = pdfs, ends_ = ends;
  }

  float hit(const Subpath& subpath, float direct, float emission,
            const LightSampleVariance& light_sample) const;
  float light_sample(const PathVertex& eye, float direct, float bsdf,
                     const ConnectionEnd& eye_end) const;
  float camera(const PathVertex& light, const ConnectionEnd& light_end) const;
  float connection(const PathVertex& light, const ConnectionEnd& light_end, const PathVertex& eye,
                   const ConnectionEnd& eye_end) const;

 private:
  /// Density of the techniques with fewer light vertices, relative to the one at hand, whose last
  /// light vertex is number `m`; `t` is its number of eye vertices. `ends` are those at vertex m.
  double fewer(std::span<const VertexPdfs> light, const EndPdfs& ends, int m, int t,
               const ConnectionEnd& end) const;
  /// The same for more light vertices: eye vertex `n` and all before it change sides one by one.
  /// `s` is the number of light vertices of the technique at hand.
  double more(int n, int s, const ConnectionEnd& end) const;

  Windows windows_;
  const SubpathPdfs* light_;
  const SubpathPdfs* eye_;
  std::span<const VertexPdfs> light_subpath_;
  const EndPdfs* ends_ = nullptr;
};

}  // namespace duet
