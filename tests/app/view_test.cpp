// duet view, and duet render --live.
#include <doctest/doctest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "app/workplace.h"
#include "base/http_server.h"
#include "support/browser.h"
#include "support/http.h"
#include "support/listener.h"

using namespace duet;
using namespace duet::test;

TEST_SUITE("program") {
  TEST_CASE("an image is looked at in a browser, layer by layer") {
    const Workplace place;
    place.scene("tiny.xml", exact_scene());
    REQUIRE(place.run({"tiny.xml", "--aov", "depth,albedo"}).code == 0);
    const Outcome o = place.run({"view", "tiny.exr", "-o", "pages/tiny.html"});
    CHECK(o.code == 0);
    CHECK(o.err == "");
    const std::string html = read_file(place.path("pages/tiny.html"));
    CHECK(contains(html, "16 × 12 pixels"));
    CHECK(contains(html, "<td>spp</td><td class=\"text\">4</td>"));
    const std::string program = browser();
    if (program.empty()) {
      MESSAGE("skipped: DUET_BROWSER is none");
      return;
    }
    const DrivenPage page = drive_page(program, html, R"(
      const errors = [];
      addEventListener("error", (e) => errors.push(e.message));
      const root = document.querySelector(".viewer"), viewer = root.viewer;
      const names = [...root.querySelectorAll("button")].map((b) => b.textContent);
      const key = (k) => root.dispatchEvent(new KeyboardEvent("keydown", {key: k, bubbles: true}));
      const shown = () => root.dataset.shown, first = shown();
      key("e");  // there is no reference
      const map = viewer.map;
      const pixel = () => [...viewer.source.getContext("2d").getImageData(8, 6, 1, 1).data];
      const layers = viewer.images.map((i) => i.name), colours = {};
      layers.forEach((name, i) => { viewer.show(i); colours[name] = pixel(); });
      finish({names, first, map, layers, colours, errors});
    )",
                                       place.path(""));
    CAPTURE(page.console);
    const auto r = nlohmann::json::parse(page.result);
    CHECK(r["errors"].empty());
    CHECK(r["layers"] == nlohmann::json({"colours", "albedo", "depth.T"}));
    CHECK(r["first"] == "colours");
    CHECK(r["map"] == "");
    for (const auto& name : r["names"]) CHECK(name != "error");
    // The reflectance 0.8, 0.4, 0.2 as sRGB, and a distance of 2, above white.
    CHECK(r["colours"]["albedo"] == nlohmann::json({231, 170, 124, 255}));
    CHECK(r["colours"]["depth.T"] == nlohmann::json({255, 255, 255, 255}));
  }

  TEST_CASE("the page of an image on standard output") {
    const Workplace place;
    place.scene();
    REQUIRE(place.run({"tiny.xml", "-o", "tiny.png"}).code == 0);
    const Outcome o = place.run({"view", "tiny.png", "-o", "-"});
    CHECK(o.code == 0);
    CHECK(contains(o.out, "16 × 12 pixels"));
    CHECK(!place.has("-"));
  }

  TEST_CASE("the desktop opens the page of an image, if there is one") {
    const Workplace place;
    place.scene();
    REQUIRE(place.run({"tiny.xml", "-o", "tiny.png"}).code == 0);
    std::filesystem::create_directory(place.path("bin"));
    place.write("bin/xdg-open", "#!/bin/sh\ncp \"$1\" opened.html\n");
    std::filesystem::permissions(place.path("bin/xdg-open"), std::filesystem::perms::owner_all);
    const Outcome o = run_duet({"view", "tiny.png"},
                               {.directory = place.path(""),
                                .environment = {{"PATH", place.path("bin") + ":/usr/bin:/bin"},
                                                {"TMPDIR", place.path("")}}});
    CHECK(o.code == 0);
    CHECK(contains(o.err, "tiny.png.html"));
    CHECK(Process::wait_until([&] { return place.has("opened.html"); }, 60));
    CHECK(contains(read_file(place.path("opened.html")), "16 × 12 pixels"));
    const Outcome none = run_duet(
        {"view", "tiny.png"}, {.directory = place.path(""), .environment = {{"PATH", "/nowhere"}}});
    CHECK(none.code == 1);
    CHECK(contains(none.err, "no xdg-open"));
    for (const char* bad : {"missing.exr", "tiny.xml"}) {
      const Outcome failed = place.run({"view", bad, "-o", "bad.html"});
      CHECK(failed.code == 1);
      CHECK(contains(failed.err, bad));
      CHECK(failed.err.find(bad) == failed.err.rfind(bad));
      CHECK(!place.has("bad.html"));
    }
  }

  TEST_CASE("a page shows a render as it grows") {
    const std::string program = browser();
    if (program.empty()) {
      MESSAGE("skipped: DUET_BROWSER is none");
      return;
    }
    const Workplace place;
    place.scene("endless.xml", endless_scene());
    const uint16_t port = silent_port();
    Process duet({"endless.xml", "--time", "1h", "--live", "--live-port", std::to_string(port)},
                 {.directory = place.path("")});
    const std::string url = "http://127.0.0.1:" + std::to_string(port) + "/";
    REQUIRE(duet.wait_for_message(url, 300));
    // The page with a script of ours, whose requests go on to the program.
    const HttpServer test(0, [&](const std::string& target) {
      const HttpReply reply = http_get(port, target);
      if (target != "/") return HttpAnswer{reply.status, "application/json", reply.body};
      return HttpAnswer{200, "text/html; charset=utf-8", with_script(reply.body, R"(
        const errors = [];
        addEventListener("error", (e) => errors.push(e.message));
        const state = () => document.getElementById("state").textContent;
        const viewer = () => document.querySelector(".viewer")?.viewer;
        const pixel = () => viewer().images[0].pixels[3 * (32 * 64 + 32)];
        const before = state();
        when(viewer, () => {
          const first = state(), one = viewer();
          one.set_exposure(1);
          when(() => state() !== first, () => {
            finish({before, first, second: state(), same: one === viewer(), pixel: pixel(),
                    exposure: viewer().exposure, errors});
          });
        });
      )")};
    });
    const DrivenPage page =
        drive_url(program, "http://127.0.0.1:" + std::to_string(test.port()) + "/", place.path(""));
    duet.send(SIGINT);
    CHECK(duet.wait(300).code == 130);
    CAPTURE(page.console);
    const auto r = nlohmann::json::parse(page.result);
    CHECK(r["errors"].empty());
    CHECK(r["before"] == "There is no image yet.");
    CHECK(contains(r["first"], "samples per pixel so far"));
    CHECK(contains(r["second"], "endless.exr: "));
    CHECK(r["same"] == true);  // what is looked at stays
    CHECK(r["exposure"] == 1);
    CHECK(r["pixel"] > 0);
  }

  TEST_CASE("the port of a live page may be taken, or none") {
    const Workplace place;
    place.scene();
    const Listener other(Listener::Manner::reads);
    for (const std::string& port :
         {std::to_string(other.port()), std::string("0"), std::string("65536"), std::string("x")}) {
      const Outcome o = place.run({"tiny.xml", "--live", "--live-port", port});
      CHECK(o.code == 2);
      CHECK(contains(o.err, "--live"));
      CHECK(!place.has("tiny.exr"));
    }
    CHECK(place.run({"tiny.xml", "--live-port", "8000"}).code == 2);
    // Nobody looks: it costs nothing, and nobody is waited for.
    const Outcome o = place.run({"tiny.xml", "--live"});
    CHECK(o.code == 0);
    CHECK(contains(o.err, "http://127.0.0.1:"));
  }
}
