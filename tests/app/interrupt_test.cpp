// Renders that end before their samples are used up.
#include <doctest/doctest.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/workplace.h"
#include "image/image_io.h"

using namespace duet;
using namespace duet::test;

namespace {

std::string field(const ImageFile& file, const std::string& name) {
  for (const auto& [key, value] : file.header)
    if (key == name) return value;
  return "";
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("Ctrl-C and SIGTERM keep the image") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    place.scene("next.xml");
    for (const int signal : {SIGINT, SIGTERM}) {
      std::filesystem::remove(place.path("endless.exr"));
      Process duet(
          {"endless.xml", "next.xml", "--time", "1h", "--progress", "bar", "--stats", "s.json"},
          {.directory = place.path("")});
      REQUIRE(duet.wait_for_message("error", 20));  // some passes are done
      duet.send(signal);
      const Outcome o = duet.wait(120);
      CAPTURE(o.err);
      CHECK(o.code == 128 + signal);
      CHECK(contains(o.err, "interrupted"));
      CHECK(contains(o.err, "1 of 2 scenes were not tried"));
      CHECK(!place.has("next.exr"));
      const ImageFile file = read_image(place.path("endless.exr"));
      CHECK(file.image.pixel(32, 32)[0] > 0);
      CHECK(std::stod(field(file, "spp")) >= 1);
      const auto stats = nlohmann::json::parse(read_file(place.path("s.json")));
      CHECK(stats[0]["interrupted"] == true);
      CHECK(place.count() == 4);
    }
  }

  TEST_CASE("a second Ctrl-C ends the program at once") {
    const Workplace place;
    // A pass of this many samples takes minutes, and the first signal waits for its tiles.
    place.scene("endless.xml", endless_scene());
    Process duet({"endless.xml", "--spp", "1000000000", "-t", "1"}, {.directory = place.path("")});
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    duet.send(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    duet.send(SIGINT);
    const Outcome o = duet.wait(30);
    CHECK(o.code == 130);
    CHECK(!place.has("endless.exr"));
  }

  TEST_CASE("time limits are kept") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    const Outcome o = place.run({"endless.xml", "--time", "1s", "--stats", "s.json"});
    CHECK(o.code == 0);
    const auto stats = nlohmann::json::parse(read_file(place.path("s.json")));
    const double seconds = stats["seconds"]["render"];
    CHECK(seconds > 0.5);
    CHECK(seconds < 2);
    CHECK(stats["spp"] >= 2);
    CHECK(std::stod(field(read_image(place.path("endless.exr")), "spp")) == stats["spp"]);
    // The samples, if they are used up first.
    const Outcome samples = place.run({"endless.xml", "--time", "1h", "--spp", "2"});
    CHECK(samples.code == 0);
    CHECK(contains(samples.err, "2 spp"));
  }

  TEST_CASE("a target error is reached, and rightly estimated") {
    const Workplace place;
    TinyScene s;
    s.integrator = R"(<integrator type="path"><integer name="max_depth" value="3"/></integrator>)";
    // Noise comes from the environment.
    s.extra =
        "<emitter type=\"constant\"/><shape type=\"sphere\"><float name=\"radius\" "
        "value=\"0.5\"/><bsdf type=\"diffuse\"/></shape>";
    place.scene("noisy.xml", s);
    CHECK(place.run({"noisy.xml", "--spp", "4096", "-o", "reference.exr", "--seed", "1"}).code ==
          0);
    const Outcome o = place.run(
        {"noisy.xml", "--target-error", "2%", "--stats", "s.json", "-o", "{spp}-{scene}.exr"});
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    const auto stats = nlohmann::json::parse(read_file(place.path("s.json")));
    const double estimate = stats["error"]["relative_rmse_estimate"];
    CHECK(estimate <= 0.02);
    CHECK(estimate > 0.005);
    CHECK(stats["error"]["is_upper_bound"] == false);
    const std::string image = fmt::format("{}-noisy.exr", int(stats["spp"]));
    REQUIRE(place.has(image));
    const Outcome compared = place.run({"compare", image, "reference.exr", "--json"});
    const double error = nlohmann::json::parse(compared.out)["relrmse"];
    CHECK(error > 0.6 * estimate);
    CHECK(error < 1.6 * estimate);
    // Samples may run out before.
    const Outcome capped = place.run({"noisy.xml", "--target-error", "0.0001", "--spp", "20"});
    CHECK(capped.code == 0);
    CHECK(contains(capped.err, "20 spp"));
  }

  TEST_CASE("progress is shown as asked") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    const Outcome bar = place.run({"endless.xml", "--time", "0.7", "--progress", "bar"});
    for (const char* part : {"[###", "Msamples/s", "error", "left"}) {
      CAPTURE(part);
      CHECK(contains(bar.err, part));
    }
    const Outcome none = place.run({"endless.xml", "--time", "0.7", "--progress", "none"});
    CHECK(!contains(none.err, "Msamples/s"));
    // Lines come every five seconds.
    const Outcome plain = place.run({"endless.xml", "--time", "5.5"});
    CHECK(contains(plain.err, "Msamples/s"));
    CHECK(!contains(plain.err, "\r"));
  }
}
