// --display: what a viewer is sent, and viewers that take it badly.
#include <doctest/doctest.h>

#include <cstring>
#include <map>

#include "app/workplace.h"
#include "image/image_io.h"
#include "support/listener.h"

using namespace duet;
using namespace duet::test;

namespace {

/// What tev would show after some messages, decoded as tev does it.
struct Shown {
  int created = 0;
  int32_t width = 0, height = 0;
  std::vector<std::string> channels;
  std::map<std::string, std::vector<float>> values;
  std::map<std::string, int> updates;
  std::string name;
};

/// Takes the fields of one message apart.
struct Fields {
  std::string bytes;
  size_t at = 0;

  template <class T>
  T number() {
    REQUIRE(at + sizeof(T) <= bytes.size());
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof(T));
    at += sizeof(T);
    return value;
  }
  std::string text() {
    const size_t end = bytes.find('\0', at);
    REQUIRE(end != std::string::npos);
    const std::string result = bytes.substr(at, end - at);
    at = end + 1;
    return result;
  }
};

void create(Fields& m, Shown& shown) {
  ++shown.created;
  shown.name = m.text();
  shown.width = m.number<int32_t>();
  shown.height = m.number<int32_t>();
  shown.channels.resize(size_t(m.number<int32_t>()));
  for (std::string& channel : shown.channels) channel = m.text();
}

void update(Fields& m, Shown& shown) {
  CHECK(m.text() == shown.name);
  const std::string channel = m.text();
  ++shown.updates[channel];
  for (const int32_t expected : {0, 0, shown.width, shown.height})
    CHECK(m.number<int32_t>() == expected);
  std::vector<float>& values = shown.values[channel];
  values.resize(size_t(shown.width) * size_t(shown.height));
  for (float& value : values) value = m.number<float>();
}

Shown decode(const std::string& bytes) {
  Shown shown;
  for (size_t at = 0; at < bytes.size();) {
    Fields m{bytes.substr(at)};
    const auto length = m.number<uint32_t>();
    REQUIRE(length <= bytes.size() - at);
    m.bytes.resize(length);
    const auto kind = m.number<uint8_t>();
    CHECK(m.number<uint8_t>() == 0);  // nobody's focus is grabbed
    REQUIRE((kind == 3 || kind == 4));
    kind == 4 ? create(m, shown) : update(m, shown);
    CHECK(m.at == length);
    at += length;
  }
  return shown;
}

std::string viewer(uint16_t port) {
  return "tev://127.0.0.1:" + std::to_string(port);
}

/// More values than systems keep of what nobody reads.
TinyScene large_scene() {
  TinyScene s = exact_scene();
  s.film = R"(<film type="hdrfilm"><integer name="width" value="1400"/>
    <integer name="height" value="1000"/><string name="component_format" value="float32"/>
    <rfilter type="box"/></film>)";
  return s;
}

/// Renders with a viewer and without: the same pixels, exit code 0 and one warning, and about as
/// soon as with a viewer that reads, for which the image is sent as well.
void check_failing_viewer(const std::string& address, const TinyScene& scene) {
  const Workplace place;
  place.scene("tiny.xml", scene);
  const Outcome plain = place.run({"tiny.xml", "-o", "plain.exr", "--spp", "2"});
  REQUIRE(plain.code == 0);
  const Outcome o = place.run({"tiny.xml", "-o", "shown.exr", "--spp", "2", "--display", address});
  CHECK(o.code == 0);
  CHECK(occurrences(o.err, "warning:") == 1);
  CHECK(contains(o.err, "does not show shown.exr"));
  CHECK(read_image(place.path("shown.exr")).image.data ==
        read_image(place.path("plain.exr")).image.data);
  // Two seconds for the last image, and as much again for a machine that has others to serve.
  Listener tev(Listener::Manner::reads);
  const Outcome read =
      place.run({"tiny.xml", "-o", "read.exr", "--spp", "2", "--display", viewer(tev.port())});
  CHECK(o.seconds < 1.5 * read.seconds + 4);
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("tev is sent the image that is written, with all of its layers") {
    const Workplace place;
    place.scene("tiny.xml", exact_scene());
    Listener tev(Listener::Manner::reads);
    const Outcome o = place.run(
        {"tiny.xml", "--aov", "depth", "-o", "out/a.exr", "--display", viewer(tev.port())});
    CHECK(o.code == 0);
    CHECK(!contains(o.err, "warning"));
    const Shown shown = decode(tev.received());
    const Image image = read_image(place.path("out/a.exr")).image;
    CHECK(shown.created == 1);
    CHECK(shown.name == "out/a.exr");
    CHECK(shown.width == image.width);
    CHECK(shown.height == image.height);
    CHECK(shown.channels == std::vector<std::string>{"R", "G", "B", "A", "depth.T"});
    for (const std::string channel : {"R", "G", "B", "depth.T"}) {
      CAPTURE(channel);
      const int c = image.find_channel(channel);
      REQUIRE(c >= 0);
      std::vector<float> written;
      for (size_t i = size_t(c); i < image.data.size(); i += image.channels.size())
        written.push_back(image.data[i]);
      CHECK(shown.values.at(channel) == written);
    }
  }

  TEST_CASE("tev sees an image grow, on one connection") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    Listener tev(Listener::Manner::reads);
    const Outcome o = place.run({"endless.xml", "--time", "3s", "--display", viewer(tev.port())});
    CHECK(o.code == 0);
    const Shown shown = decode(tev.received());
    CHECK(tev.connections() == 1);
    CHECK(shown.created == 1);
    CHECK(shown.updates.at("R") >= 3);
    CHECK(shown.updates.at("R") == shown.updates.at("B"));
  }

  TEST_CASE("a viewer that is not there is warned of once, and the image is as it would be") {
    check_failing_viewer(viewer(silent_port()), exact_scene());
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    const Outcome o =
        place.run({"endless.xml", "--time", "2s", "--display", viewer(silent_port())});
    CHECK(o.code == 0);
    CHECK(occurrences(o.err, "warning:") == 1);
    CHECK(contains(o.err, "Connection refused"));
  }

  TEST_CASE("a viewer that never reads does not hold the render up") {
    Listener tev(Listener::Manner::never_reads);
    check_failing_viewer(viewer(tev.port()), large_scene());
    CHECK(tev.connections() >= 1);
  }

  TEST_CASE("a viewer that closes midway is no reason to stop") {
    Listener tev(Listener::Manner::closes);
    check_failing_viewer(viewer(tev.port()), large_scene());
    CHECK(tev.connections() >= 1);
  }

  TEST_CASE("what is no viewer, or a host that there is not, is wrong usage") {
    const Workplace place;
    place.scene();
    for (const std::string address :
         {"tev:", "tev://", "tev://[::1", "tev://[]", "tev://localhost:", "tev://localhost:0",
          "tev://localhost:65536", "http://a", "tev://no host"}) {
      CAPTURE(address);
      const Outcome o = place.run({"tiny.xml", "--display", address});
      CHECK(o.code == 2);
      CHECK(contains(o.err, "--display"));
      CHECK(!place.has("tiny.exr"));
    }
  }
}
