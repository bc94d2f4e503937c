#include "evaluate/live/live_page.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "support/http.h"

using namespace duet;
using namespace duet::test;

namespace {

Image grey_page_image(float value) {
  Image image(2, 1, {"R", "G", "B", "depth.T"});
  for (float& v : image.data) v = value;
  return image;
}

uint16_t port_of(const LivePage& page) {
  const std::string url = page.url();
  return uint16_t(std::stoi(url.substr(url.rfind(':') + 1)));
}

}  // namespace

TEST_CASE("a live page has the newest image, and wants the next once it is fetched") {
  LivePage page(0);
  const uint16_t port = port_of(page);
  CHECK(!page.wants_image());  // nobody looks
  CHECK(http_get(port, "/").body.find("There is no image yet") != std::string::npos);
  CHECK(http_get(port, "/image?after=0").status == 204);
  CHECK(page.wants_image());
  page.show("a.exr", grey_page_image(1), "first");
  CHECK(!page.wants_image());
  page.show("a.exr", grey_page_image(2), "second");
  const HttpReply reply = http_get(port, "/image?after=0");
  CHECK(page.wants_image());
  const auto data = nlohmann::json::parse(reply.body);
  CHECK(data["number"] == 2);
  CHECK(data["name"] == "a.exr");
  CHECK(data["state"] == "second");
  CHECK(data["viewer"]["width"] == 2);
  CHECK(!data["viewer"].contains("reference"));
  CHECK(data["viewer"]["images"].size() == 2);
  CHECK(data["viewer"]["images"][1]["name"] == "depth.T");
  CHECK(data["viewer"]["images"][0]["half"] == "AEAAQABAAEAAQABA");  // six times 2.0, 0x4000
  CHECK(page.cost().count() > 0);
  CHECK(http_get(port, "/image?after=2").status == 204);
}

TEST_CASE("a live page has nothing else") {
  const LivePage page(0);
  for (const char* target : {"/image", "/image?after=", "/image?after=x", "/image?after=1x",
                             "/image?after=-1", "/etc/passwd", "/../", "*"})
    CHECK(http_get(port_of(page), target).status == 404);
}

TEST_CASE("the end waits for whoever looks, and for nobody else") {
  LivePage page(0);
  const auto seconds_of_finish = [&] {
    const auto start = std::chrono::steady_clock::now();
    page.finish();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  page.show("a.exr", grey_page_image(1), "last");
  CHECK(seconds_of_finish() < 1);
  CHECK(http_get(port_of(page), "/image?after=1").status == 204);  // looks, and fetches nothing
  CHECK(seconds_of_finish() > 1.9);
  CHECK(http_get(port_of(page), "/image?after=0").status == 200);
  CHECK(seconds_of_finish() < 1);
}
