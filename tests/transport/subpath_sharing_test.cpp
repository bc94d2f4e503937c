// That pixels share light sub-paths evenly, and that the noise of the image shows no direction.
#include "transport/subpath_sharing.h"

#include <algorithm>
#include <cmath>

#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// Pixels of each sub-path.
std::vector<int> shares(const SubpathSharing& sharing, Point2i film, size_t subpaths) {
  std::vector<int> count(subpaths);
  for (uint64_t pixel = 0; pixel < uint64_t(film.x) * uint64_t(film.y); ++pixel)
    ++count.at(sharing.subpath(pixel, subpaths));
  return count;
}

/// A room whose light comes in by a door ajar: most of it has been scattered several times, and is
/// found by connections.
std::string indirect_room() {
  const auto box = [](const std::string& size, const std::string& center,
                      const std::string& reflectance) {
    return "<shape type='cube'><transform name='to_world'><scale value='" + size +
           "'/><translate value='" + center + "'/></transform>" + grey(reflectance) + "</shape>";
  };
  return camera_xml("0.4, -0.9, 1.1", "-0.3, 1, 0.8", 192) + room_xml(grey("0.7")) +
         box("1, 0.02, 1", "0, -1, 1", "0.7") + box("0.02, 0.75, 1", "0.3, 0.25, 1", "0.7") +
         box("0.4, 0.15, 0.3", "-0.4, 0.8, 0.3", "0.4") +
         box("0.4, 0.1, 0.02", "-0.4, 0.9, 1.1", "0.5") +
         "<shape type='rectangle'><transform name='to_world'><scale value='0.2'/>"
         "<rotate x='1' angle='180'/><translate x='0.7' y='0.4' z='1.9'/></transform>"
         "<emitter type='area'><rgb name='radiance' value='40'/></emitter></shape>";
}

struct Correlation {
  double across, down;
};

/// Of what two images that differ in their seeds alone do not have in common, in logarithms of
/// luminance, between pixels side by side and between those below each other.
Correlation noise_correlation(const TransportScene& s, const std::string& method,
                              const TransportScene::Parameters& parameters) {
  const Image a = s.render(method, parameters, 2, 1).image,
              b = s.render(method, parameters, 2, 2).image;
  const auto luminance = [](const Image& image, size_t i) {
    const float* p = &image.data[i * image.channels.size()];
    return std::log(1e-3 + double(Spectrum(p[0], p[1], p[2]).luminance()));
  };
  const size_t width = size_t(a.width), height = size_t(a.height);
  std::vector<double> d(width * height);
  double mean = 0, variance = 0, across = 0, down = 0;
  for (size_t i = 0; i < d.size(); ++i)
    mean += (d[i] = luminance(a, i) - luminance(b, i)) / double(d.size());
  for (double& x : d) x -= mean, variance += x * x;
  for (size_t y = 0; y < height; ++y)
    for (size_t x = 0; x < width; ++x) {
      if (x > 0) across += d[y * width + x] * d[y * width + x - 1];
      if (y > 0) down += d[y * width + x] * d[(y - 1) * width + x];
    }
  return {across / variance, down / variance};
}

}  // namespace

TEST_CASE("pixels share light sub-paths evenly, whatever the size of the image") {
  for (const Point2i film : {Point2i{64, 48}, Point2i{1, 1}, Point2i{33, 7}, Point2i{50, 37}}) {
    const size_t pixels = size_t(film.x) * size_t(film.y);
    SubpathSharing sharing;
    sharing.start(film, 5);
    for (const double per_pixel : {1 / 16.0, 0.25, 0.7, 1.0, 2.5}) {
      const size_t subpaths = std::max<size_t>(1, size_t(std::round(per_pixel * double(pixels))));
      const std::vector<int> count = shares(sharing, film, subpaths);
      const auto [least, most] = std::minmax_element(count.begin(), count.end());
      CAPTURE(film.x);
      CAPTURE(per_pixel);
      CHECK(*most - *least <= 1);
      CHECK(*most == int((pixels + subpaths - 1) / subpaths));
    }
  }
}

TEST_CASE("pixels that share a light sub-path lie apart, but near enough for a cache") {
  constexpr int kSize = 64;
  constexpr size_t kPixels = kSize * kSize;
  SubpathSharing one, other;
  one.start({kSize, kSize}, 1);
  other.start({kSize, kSize}, 2);
  for (const size_t subpaths : {kPixels / 4, kPixels / 16}) {
    int across = 0, down = 0, diagonal = 0, differ = 0;
    std::vector<Point2i> first(subpaths, {-1, -1});
    bool near = true;
    for (int y = 1; y < kSize; ++y)
      for (int x = 1; x < kSize; ++x) {
        const auto subpath = [&](int i, int j) {
          return one.subpath(uint64_t(j * kSize + i), subpaths);
        };
        const size_t w = subpath(x, y);
        across += w == subpath(x - 1, y);
        down += w == subpath(x, y - 1);
        diagonal += w == subpath(x - 1, y - 1);
        differ += w != other.subpath(uint64_t(y * kSize + x), subpaths);
        if (first[w].x < 0) first[w] = {x, y};
        near &= first[w].x / 16 == x / 16 && first[w].y / 16 == y / 16;
      }
    CHECK(near);
    // At random it would be one in 85 of the pairs, or one in 17.
    for (const int pairs : {across, down, diagonal}) CHECK(pairs < int(kPixels) / 40);
    CHECK(differ > int(kPixels) * 3 / 4);
  }
}

TEST_CASE(
    "the vertices of an eye sub-path are connected with different light sub-paths of a tile") {
  for (const Point2i film : {Point2i{64, 48}, Point2i{1, 1}, Point2i{33, 7}, Point2i{50, 37}}) {
    const size_t pixels = size_t(film.x) * size_t(film.y);
    PixelPhases phases;
    phases.start(film, 5);
    const PixelPhase part{&phases, 1, 4};
    for (const PixelPhase* phase : {static_cast<const PixelPhase*>(nullptr), &part})
      for (const double per_pixel : {1 / 16.0, 0.25, 0.7, 1.0, 2.5}) {
        const size_t all = phase ? size_t(phase->pixels()) : pixels;
        const size_t subpaths = std::max<size_t>(1, size_t(std::round(per_pixel * double(all))));
        if (all == 0) continue;
        SubpathSharing sharing;
        sharing.start(film, 5, phase);
        for (const int depth : {1, 2, 3, 7, 1000}) {
          std::vector<int> met(subpaths);
          size_t apart = 0, alike = 0;
          for (size_t own = 0; own < subpaths; ++own) {
            const size_t here = sharing.at_vertex(own, subpaths, depth),
                         next = sharing.at_vertex(own, subpaths, depth + 1);
            const auto [first, count] = sharing.group(own, subpaths);
            ++met.at(here);
            apart += here < first || here >= first + count;
            alike += here == next && count > 1;
            if (depth == 1) CHECK(here == own);
          }
          CAPTURE(film.x);
          CAPTURE(per_pixel);
          CHECK(apart == 0);
          CHECK(alike == 0);
          CHECK(std::count(met.begin(), met.end(), 1) == int(subpaths));
        }
      }
  }
}

TEST_CASE("noise has no direction, although pixels share light sub-paths") {
  const TransportScene s(indirect_room());
  const Correlation path = noise_correlation(s, "path", {{"max_depth", "6"}});
  // These vary by 0.005.
  CHECK(std::abs(path.across) < 0.02);
  CHECK(std::abs(path.down) < 0.02);
  const std::pair<const char*, TransportScene::Parameters> methods[] = {
      {"bdpt", {}},
      {"bdpt", {{"light_paths", "0.0625"}}},
      {"bdpt", {{"light_paths", "0.4"}}},
      {"bdpt", {{"connections", "2"}}},
      {"reuse", {{"light_paths", "0.25"}}},
      {"vcm", {}},
  };
  for (const auto& method : methods) {
    const std::string name = method.first;
    TransportScene::Parameters parameters = method.second;
    parameters.emplace_back("max_depth", "6");
    const Correlation c = noise_correlation(s, name, parameters);
    CAPTURE(name);
    CAPTURE(parameters[0].second);
    CAPTURE(c.across);
    CAPTURE(c.down);
    CHECK(std::abs((c.across - c.down) - (path.across - path.down)) < 0.03);
    // Neighbours have photons in common, which makes the noise of merging alike in all directions.
    const double most = name == "vcm" ? 0.05 : 0.03;
    CHECK(std::abs(c.across - path.across) < most);
    CHECK(std::abs(c.down - path.down) < most);
  }
}
