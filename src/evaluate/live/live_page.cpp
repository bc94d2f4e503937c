#include "evaluate/live/live_page.h"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <thread>

#include "evaluate/web/files.h"
#include "evaluate/web/layers.h"
#include "evaluate/web/page.h"

namespace duet {

namespace {

using Clock = std::chrono::steady_clock;

/// Longer sides are reduced.
constexpr int kLongest = 1024;
/// Who has not asked for so long looks no more: hidden pages ask once a second.
constexpr std::chrono::seconds kAttention{3};
constexpr std::chrono::seconds kTimeForLastImage{2};

std::string page() {
  return web_page("Duet", fmt::format("<h1>Duet</h1>\n<p id=\"state\">There is no image yet.</p>\n"
                                      "<div class=\"card\" id=\"image\"></div>\n{}<script>\n{}"
                                      "</script>\n",
                                      viewer_keys(false), web_files::live_js));
}

}  // namespace

LivePage::LivePage(uint16_t port)
    : server_(port, [this](const std::string& target) { return answer(target); }) {}

std::string LivePage::url() const {
  return fmt::format("http://127.0.0.1:{}/", server_.port());
}

bool LivePage::wants_image() const {
  const std::lock_guard lock(mutex_);
  return fetched_ == shown_->number && Clock::now() - asked_ < kAttention;
}

void LivePage::show(const std::string& name, Image image, const std::string& state) {
  const std::lock_guard lock(mutex_);
  shown_ = std::make_shared<Shown>(Shown{name, state, std::move(image), shown_->number + 1});
}

void LivePage::finish() const {
  const Clock::time_point end = Clock::now() + kTimeForLastImage;
  const auto is_awaited = [&] {
    const std::lock_guard lock(mutex_);
    return fetched_ != shown_->number && Clock::now() - asked_ < kAttention;
  };
  while (Clock::now() < end && is_awaited())
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

std::chrono::duration<double> LivePage::cost() const {
  const std::lock_guard lock(mutex_);
  return cost_;
}

HttpAnswer LivePage::answer(const std::string& target) {
  if (target == "/") return {200, "text/html; charset=utf-8", page()};
  constexpr std::string_view prefix = "/image?after=";
  uint64_t after = 0;
  const char* const end = target.data() + target.size();
  if (target.starts_with(prefix)) {
    const auto [rest, error] = std::from_chars(target.data() + prefix.size(), end, after);
    if (error == std::errc() && rest == end) return answer_image(after);
  }
  return {404, HttpAnswer{}.type, "There is nothing here.\n"};
}

HttpAnswer LivePage::answer_image(uint64_t after) {
  std::shared_ptr<const Shown> shown;
  {
    const std::lock_guard lock(mutex_);
    asked_ = Clock::now();
    shown = shown_;
  }
  if (shown->number <= after) return {204, "", ""};
  const Clock::time_point start = Clock::now();
  nlohmann::ordered_json data;
  data["number"] = shown->number;
  data["name"] = shown->name;
  data["state"] = shown->state;
  data["viewer"] = viewer_data(viewed_layers(shown->image, kLongest), std::nullopt);
  HttpAnswer a{200, "application/json",
               data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
  const std::lock_guard lock(mutex_);
  fetched_ = shown->number;
  cost_ = Clock::now() - start;
  return a;
}

}  // namespace duet
