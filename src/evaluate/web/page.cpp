#include "evaluate/web/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "evaluate/web/files.h"
#include "image/colours.h"
#include "image/half.h"

namespace duet {

namespace {

std::string base64(std::span<const uint8_t> bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t left = bytes.size() - i;
    const uint32_t block = uint32_t(bytes[i]) << 16 | (left > 1 ? uint32_t(bytes[i + 1]) << 8 : 0) |
                           (left > 2 ? uint32_t(bytes[i + 2]) : 0);
    for (size_t k = 0; k < 4; ++k) text += k <= left ? digits[block >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// Calls `use(mean)` for each block of n × n pixels, in rows from the top, with the mean of
/// `value(pixel)` over what there is of it.
template <class Value, class Use>
void for_each_block(int width, int height, int n, Value value, Use use) {
  for (int y = 0; y < height; y += n)
    for (int x = 0; x < width; x += n) {
      const int x1 = std::min(x + n, width), y1 = std::min(y + n, height);
      std::array<double, 3> sum{};
      for (int j = y; j < y1; ++j)
        for (int i = x; i < x1; ++i) {
          const std::array<double, 3> v = value(size_t(j) * size_t(width) + size_t(i));
          for (size_t c = 0; c < 3; ++c) sum[c] += v[c];
        }
      for (double& s : sum) s /= double(x1 - x) * (y1 - y);
      use(sum);
    }
}

/// Pixels along each side of a block, so that no side has more blocks than `longest`.
int reduction(int width, int height, int longest) {
  return (std::max(width, height) + longest - 1) / longest;
}

}  // namespace

std::string escape_markup(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

WebImage web_image(const Image& image, int longest) {
  const Colours colours(image);
  WebImage web;
  const int n = web.reduced_by = reduction(image.width, image.height, longest);
  web.width = (image.width + n - 1) / n, web.height = (image.height + n - 1) / n;
  std::vector<uint8_t> bytes;
  bytes.reserve(size_t(web.width) * size_t(web.height) * 6);
  for_each_block(
      image.width, image.height, n,
      [&](size_t i) {
        return std::array<double, 3>{colours(i, 0), colours(i, 1), colours(i, 2)};
      },
      [&](const std::array<double, 3>& mean) {
        for (const double v : mean) {
          const uint16_t bits = half_bits(float(v));
          bytes.push_back(uint8_t(bits));
          bytes.push_back(uint8_t(bits >> 8));
        }
      });
  web.half = base64(bytes);
  return web;
}

WebFlip web_flip(const FlipResult& flip, int width, int longest) {
  const int height = int(flip.map.size()) / width;
  std::vector<uint8_t> bytes;
  for_each_block(
      width, height, reduction(width, height, longest),
      [&](size_t i) {
        return std::array<double, 3>{flip.map[i], 0, 0};
      },
      [&](const std::array<double, 3>& mean) {
        bytes.push_back(uint8_t(std::lround(255 * std::clamp(mean[0], 0.0, 1.0))));
      });
  return {base64(bytes), flip.mean};
}

std::string viewer_html(const std::vector<ViewedImage>& images, size_t reference) {
  nlohmann::ordered_json data;
  data["width"] = images.at(reference).image.width;
  data["height"] = images.at(reference).image.height;
  data["reference"] = reference;
  data["images"] = nlohmann::ordered_json::array();
  for (const ViewedImage& i : images) {
    data["images"].push_back({{"name", i.name}, {"note", i.note}, {"half", i.image.half}});
    if (i.flip.bytes.empty()) continue;
    data["images"].back()["flip"] = i.flip.bytes;
    data["images"].back()["mean_flip"] = i.flip.mean;
  }
  // A name may not end the script that it stands in.
  std::string text = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  for (size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3)
    text.insert(at + 1, "\\");
  return "<div class=\"viewer\"><script type=\"application/json\">" + text + "</script></div>\n";
}

std::string viewer_keys() {
  return "<p class=\"soft\">Keys of the viewer: <kbd>1</kbd>–<kbd>9</kbd> choose an image, "
         "<kbd>space</kbd> toggles between it and the one before, <kbd>e</kbd> shows the error, "
         "<kbd>f</kbd> shows FLIP, <kbd>r</kbd> resets; drag to move, and the wheel zooms once the "
         "viewer was clicked.</p>\n";
}

std::string web_page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<link rel=\"icon\" "
      "href=\"data:,\">\n<style>\n{}</style>\n</head>\n<body>\n{}\n<script>\n{}</script>\n"
      "<script>\n{}</script>\n</body>\n</html>\n",
      escape_markup(title), web_files::page_css, body, web_files::viewer_js, web_files::table_js);
}

}  // namespace duet
