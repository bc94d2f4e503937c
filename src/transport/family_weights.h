// Weights that also say which kinds of techniques could have made a path, and how likely: what
// other methods would have made of it can be told from that.
#pragma once

#include <array>
#include <span>

#include "transport/connection.h"

namespace duet {

/// Shares of kinds of techniques in the density Σ n_i p_i of a path, over all techniques of a
/// method with connections and merges. The first four sum to one.
struct FamilyShares {
  float unidirectional = 0;  ///< s = 0 and s = 1: what path tracing has
  float light_image = 0;     ///< t = 1
  float connections = 0;     ///< s, t >= 2
  float merges = 0;
  /// Of these the one at the first vertex from the eye at which photons are merged and that does
  /// not scatter by a delta lobe.
  float first_merge = 0;
  /// For how many each of the unidirectional ones counts in the density: γ of docs/mis.md.
  float gain = 1;
};

/// The weights of BalanceWeights for connections (connection.h) by the densities of all vertices of
/// the path, in time proportional to their number. The method has all techniques, each connection
/// once.
class FamilyWeights {
 public:
  /// More vertices between light and lens than a path may have.
  static constexpr int kMostVertices = 64;

  explicit FamilyWeights(const TechniqueSet& set)
      : light_paths_(double(set.light_paths)),
        eta_(double(set.light_paths) * double(set.merge_area)) {}
  /// The sub-paths that are connected. The vertex pdfs of the light sub-path may go on beyond the
  /// vertex at hand; if the sub-path may have gone straight on from there, `ends` are those at that
  /// vertex.
  void set_light(std::span<const VertexPdfs> pdfs, const EndPdfs* ends = nullptr) {
    light_ = pdfs, ends_ = ends;
  }
  void set_eye(const SubpathPdfs& pdfs) { eye_ = pdfs; }

  float hit(const Subpath& subpath, float direct, float emission,
            const LightSampleVariance& light_sample) const;
  float light_sample(const PathVertex& eye, float direct, float bsdf,
                     const ConnectionEnd& eye_end) const;
  float camera(const PathVertex& light, const ConnectionEnd& light_end) const;
  float connection(const PathVertex& light, const ConnectionEnd& light_end, const PathVertex& eye,
                   const ConnectionEnd& eye_end) const;
  float merge(const LightVertex& light, float light_reverse, const PathVertex& eye,
              float eye_reverse) const;

  /// Those of the last connection that was weighed.
  const FamilyShares& shares() const { return shares_; }

 private:
  /// The path of the connection at hand. Vertex 1 is the first from the light, vertex `count` the
  /// last before the lens.
  struct Path {
    int count = 0;
    /// Densities with which rays from vertex 1 find the light and with which light samples do,
    /// per solid angle; and that of both vertices for a light sub-path.
    double found = 0, direct = 0, emitted = 0;
    std::array<double, kMostVertices> light{}, eye{};  ///< area densities; light[1] has no meaning
    std::array<bool, kMostVertices> specular{}, merges{};

    double gain = 1;  ///< how often hits and light samples count, which have it in their densities

    void count_direct(float times) {
      gain = double(times);
      found *= gain, direct *= gain;
    }
  };
  Path& start(int count) const;
  /// Vertices 1 … m of the light sub-path, seen from the vertex beyond by `end`.
  void take_light(Path& path, int m, const ConnectionEnd& end) const;
  /// Vertices n … 1 of the eye sub-path alike.
  void take_eye(Path& path, int n, const ConnectionEnd& end) const;
  /// `s` is the number of light vertices of the technique at hand, or one more than the vertex at
  /// which it merges.
  float weigh(const Path& path, int s, bool merges) const;

  double light_paths_, eta_;
  std::span<const VertexPdfs> light_, eye_;
  const EndPdfs* ends_ = nullptr;
  mutable Path path_;
  mutable FamilyShares shares_;
};

}  // namespace duet
