// Renders that end before their samples are used up.
#include <doctest/doctest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "app/workplace.h"
#include "support/image_header.h"

using namespace duet;
using namespace duet::test;

TEST_SUITE("program") {
  TEST_CASE("Ctrl-C, SIGTERM and SIGHUP keep the image") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    place.scene("next.xml");
    place.write("endless.exr", "good");
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      std::filesystem::remove(place.path("endless.partial.exr"));
      Process duet(
          {"endless.xml", "next.xml", "--time", "1h", "--progress", "bar", "--stats", "s.json"},
          {.directory = place.path("")});
      REQUIRE(duet.wait_for_message("error", 300));  // some passes are done
      duet.send(signal);
      const Outcome o = duet.wait(300);
      CAPTURE(o.err);
      CHECK(o.code == 128 + signal);
      CHECK(contains(o.err, "interrupted"));
      CHECK(contains(o.err, "1 of 2 scenes were not tried"));
      CHECK(!place.has("next.exr"));
      CHECK(read_file(place.path("endless.exr")) == "good");
      const ImageFile file = read_image(place.path("endless.partial.exr"));
      CHECK(file.image.pixel(32, 32)[0] > 0);
      CHECK(std::stod(header_field(file, "spp")) >= 1);
      CHECK(header_field(file, "interrupted") == "1");
      CHECK(header_field(file, "requestedSeconds") == "3600");
      const auto stats = nlohmann::json::parse(read_file(place.path("s.json")));
      CHECK(stats[0]["interrupted"] == true);
      CHECK(place.count() == 5);
    }
  }

  TEST_CASE("passes are short whatever --spp is") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    // An eighth of these samples takes hours.
    Process duet(
        {"endless.xml", "--spp", "1000000", "--progress", "bar", "--keep-partial-name", "-v"},
        {.directory = place.path("")});
    REQUIRE(duet.wait_for_message("built in", 300));
    duet.send(SIGUSR1);
    REQUIRE(Process::wait_until([&] { return place.has("endless.exr"); }, 300));
    duet.send(SIGINT);
    const Outcome o = duet.wait(300);
    CAPTURE(o.err);
    CHECK(o.code == 130);
    const ImageFile file = read_image(place.path("endless.exr"));
    CHECK(std::stod(header_field(file, "spp")) >= 1);
    CHECK(header_field(file, "requestedSpp") == "1000000");
    CHECK(header_field(file, "interrupted") == "1");
    CHECK(!place.has("endless.partial.exr"));
    bool lit = true;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) lit &= file.image.pixel(x, y)[0] > 0;
    CHECK(lit);
  }

  TEST_CASE("SIGUSR1 writes the image so far and goes on") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    for (const bool adaptive : {false, true}) {
      std::vector<std::string> arguments{"endless.xml", "--time", "1h",    "-o",
                                         "a.exr",       "-o",     "b.png", "-v"};
      if (adaptive) arguments.insert(arguments.end(), {"--target-error", "0.001%"});
      Process duet(arguments, {.directory = place.path("")});
      REQUIRE(duet.wait_for_message("built in", 300));
      for (int i = 0; i < 2; ++i) {
        std::filesystem::remove(place.path("b.partial.png"));
        duet.send(SIGUSR1);
        REQUIRE(Process::wait_until([&] { return place.has("b.partial.png"); }, 300));
      }
      const ImageFile file = read_image(place.path("a.partial.exr"));
      CHECK(header_field(file, "interrupted") == "1");
      CHECK(file.image.pixel(32, 32)[0] > 0);
      CHECK(!place.has("a.exr"));
      duet.send(SIGTERM);
      const Outcome o = duet.wait(300);
      CHECK(o.code == 143);
      CHECK(contains(o.err, "spp so far -> a.partial.exr"));
    }
  }

  TEST_CASE("a finished image replaces what there was of it") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    Process duet({"endless.xml", "--time", "3s", "-o", "{spp}.exr", "-v"},
                 {.directory = place.path("")});
    REQUIRE(duet.wait_for_message("built in", 300));
    duet.send(SIGUSR1);
    const Outcome o = duet.wait(300);
    CAPTURE(o.err);
    CHECK(o.code == 0);
    CHECK(contains(o.err, ".partial.exr"));
    CHECK(place.count() == 2);  // the scene and its image
    // An older one, too, if it is of the same scene and says that it is partial.
    Process other({"endless.xml", "--spp", "100000", "-v"}, {.directory = place.path("")});
    REQUIRE(other.wait_for_message("built in", 300));
    other.send(SIGUSR1);
    REQUIRE(Process::wait_until([&] { return place.has("endless.partial.exr"); }, 300));
    other.send(SIGINT);
    CHECK(other.wait(300).code == 130);
    CHECK(place.has("endless.partial.exr"));
    place.scene("tiny.xml");
    std::filesystem::copy(place.path("endless.partial.exr"), place.path("tiny.partial.exr"));
    CHECK(place.run({"endless.xml", "tiny.xml", "--spp", "1"}).code == 0);
    CHECK(!place.has("endless.partial.exr"));
    CHECK(place.has("tiny.partial.exr"));
    place.write("tiny.partial.exr", "mine");
    CHECK(place.run({"tiny.xml", "--spp", "1"}).code == 0);
    CHECK(read_file(place.path("tiny.partial.exr")) == "mine");
  }

  TEST_CASE("an interrupt before every pixel has a sample replaces no image") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    for (const char* name : {"image.exr", "image.png", "image.jpg"}) place.write(name, "good");
    // One sample per pixel takes minutes.
    Process duet(
        {"endless.xml", "--spp", "4", "--size", "2000x2000", "-o", "image.exr", "-o", "image.png",
         "-o", "image.jpg", "--keep-partial-name", "--progress", "bar", "--stats", "s.json"},
        {.directory = place.path("")});
    REQUIRE(duet.wait_for_message(" spp", 300));
    duet.send(SIGTERM);
    const Outcome o = duet.wait(300);
    CAPTURE(o.err);
    CHECK(o.code == 143);
    CHECK(contains(o.err, "no image is written"));
    for (const char* name : {"image.exr", "image.png", "image.jpg"})
      CHECK(read_file(place.path(name)) == "good");
    const auto stats = nlohmann::json::parse(read_file(place.path("s.json")));
    CHECK(stats["failed"] == true);
    CHECK(stats["interrupted"] == true);
    CHECK(place.count() == 5);
  }

  TEST_CASE("what is ignored stays ignored") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    Process duet({"endless.xml", "--time", "2s", "-v"},
                 {.directory = place.path(""), .ignored = {SIGHUP, SIGINT}});
    REQUIRE(duet.wait_for_message("built in", 300));
    duet.send(SIGHUP);
    duet.send(SIGINT);
    CHECK(duet.wait(300).code == 0);
    CHECK(place.has("endless.exr"));
  }

  TEST_CASE("a second Ctrl-C ends the program at once") {
    const Workplace place;
    // An iteration of this size takes minutes, and is finished as a whole.
    place.scene("endless.xml", endless_scene());
    Process duet({"endless.xml", "-i", "ptracer", "--spp", "4", "--size", "2000x2000", "-v"},
                 {.directory = place.path("")});
    REQUIRE(duet.wait_for_message("built in", 300));
    duet.send(SIGINT);
    REQUIRE(duet.wait_for_message("a second signal", 300));
    duet.send(SIGINT);
    const Outcome o = duet.wait(300);
    CHECK(o.code == 130);
    CHECK(place.count() == 1);
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
    CHECK(std::stod(header_field(read_image(place.path("endless.exr")), "spp")) == stats["spp"]);
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
    CHECK(stats["error"]["target"] == 0.02);
    CHECK(stats["error"]["target_met"] == true);
    CHECK(place.run({"noisy.xml", "--target-error", "2%", "--require-target"}).code == 0);
    CHECK(place.run({"noisy.xml", "--target-error", "2%", "--require-target", "-x"}).code == 0);
    // Samples may run out before, or time.
    using Texts = std::vector<std::string>;
    for (const Texts& limit : {Texts{"--spp", "20"}, Texts{"--time", "0.2"}}) {
      std::vector<std::string> arguments{"noisy.xml", "--target-error", "0.01%", "--stats",
                                         "s.json"};
      arguments.insert(arguments.end(), limit.begin(), limit.end());
      const Outcome capped = place.run(arguments);
      CAPTURE(capped.err);
      CHECK(capped.code == 0);
      CHECK(contains(capped.err, "--target-error 0.01 % is not met: the estimate is "));
      CHECK(contains(capped.err, limit[0] == "--spp" ? "the samples of --spp are used up"
                                                     : "the time is used up"));
      const auto missed = nlohmann::json::parse(read_file(place.path("s.json")));
      CHECK(missed["error"]["target_met"] == false);
      CHECK(missed["error"]["target"] == 0.0001);
      arguments.push_back("--require-target");
      CHECK(place.run(arguments).code == 4);
      CHECK(place.has("noisy.exr"));
      // The image is finished, and no better.
      arguments.emplace_back("-x");
      const Outcome kept = place.run(arguments);
      CHECK(kept.code == 4);
      CHECK(contains(kept.err, "noisy.xml: skipped"));
      CHECK(contains(kept.err, "--target-error 0.01 % is not met: the estimate is "));
    }
    CHECK(place.run({"noisy.xml", "--require-target"}).code == 2);
  }

  TEST_CASE("progress is shown as asked") {
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    Process bar({"endless.xml", "--time", "1h", "--progress", "bar"},
                {.directory = place.path("")});
    for (const char* part : {"[", "] ", "Msamples/s", "error", "spp"}) {
      CAPTURE(part);
      CHECK(bar.wait_for_message(part, 300));
    }
    bar.send(SIGINT);
    bar.wait(300);
    Process left({"endless.xml", "--time", "20", "--progress", "bar"},
                 {.directory = place.path("")});
    CHECK(left.wait_for_message("[#", 300));
    CHECK(left.wait_for_message("left", 300));
    left.send(SIGINT);
    left.wait(300);
    const Outcome none = place.run({"endless.xml", "--time", "0.7", "--progress", "none"});
    CHECK(!contains(none.err, "Msamples/s"));
    // Lines come every five seconds.
    const Outcome plain = place.run({"endless.xml", "--time", "5.5"});
    CHECK(contains(plain.err, "Msamples/s"));
    CHECK(!contains(plain.err, "\r"));
  }
}
