#include "evaluate/web/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "evaluate/web/files.h"
#include "evaluate/web/pixels.h"
#include "image/colours.h"
#include "image/half.h"

namespace duet {

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

nlohmann::ordered_json viewer_data(const std::vector<ViewedImage>& images,
                                   std::optional<size_t> reference) {
  nlohmann::ordered_json data;
  const WebImage& first = images.at(reference.value_or(0)).image;
  data["width"] = first.width;
  data["height"] = first.height;
  if (reference) data["reference"] = *reference;
  data["images"] = nlohmann::ordered_json::array();
  for (const ViewedImage& i : images) {
    data["images"].push_back({{"name", i.name}, {"note", i.note}, {"half", i.image.half}});
    if (i.flip.bytes.empty()) continue;
    data["images"].back()["flip"] = i.flip.bytes;
    data["images"].back()["mean_flip"] = i.flip.mean;
  }
  return data;
}

std::string viewer_html(const std::vector<ViewedImage>& images, std::optional<size_t> reference) {
  // A name may not end the script that it stands in.
  std::string text =
      viewer_data(images, reference).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  for (size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3)
    text.insert(at + 1, "\\");
  return "<div class=\"viewer\"><script type=\"application/json\">" + text + "</script></div>\n";
}

std::string viewer_keys(bool has_reference) {
  return fmt::format(
      "<p class=\"soft\">Keys of the viewer: <kbd>1</kbd>–<kbd>9</kbd> choose an image, "
      "<kbd>space</kbd> toggles between it and the one before, {}<kbd>r</kbd> resets; drag to "
      "move, and the wheel zooms once the viewer was clicked.</p>\n",
      has_reference ? "<kbd>e</kbd> shows the error, <kbd>f</kbd> shows FLIP, " : "");
}

std::string web_page_start(const std::string& title) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<link rel=\"icon\" "
      "href=\"data:,\">\n<style>\n{}</style>\n</head>\n<body>\n",
      escape_markup(title), web_files::page_css);
}

std::string web_page_end() {
  return fmt::format("\n<script>\n{}</script>\n<script>\n{}</script>\n</body>\n</html>\n",
                     web_files::viewer_js, web_files::table_js);
}

std::string web_page(const std::string& title, const std::string& body) {
  return web_page_start(title) + body + web_page_end();
}

}  // namespace duet
