#include "app/web_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "app/web_files.h"
#include "base/atomic_file.h"
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
  const int side = std::max(image.width, image.height);
  web.reduced_by = (side + longest - 1) / longest;
  const int n = web.reduced_by;
  web.width = (image.width + n - 1) / n, web.height = (image.height + n - 1) / n;
  std::vector<uint8_t> bytes;
  bytes.reserve(size_t(web.width) * size_t(web.height) * 6);
  for (int y = 0; y < image.height; y += n)
    for (int x = 0; x < image.width; x += n)
      for (int c = 0; c < 3; ++c) {
        const int x1 = std::min(x + n, image.width), y1 = std::min(y + n, image.height);
        double sum = 0;
        for (int j = y; j < y1; ++j)
          for (int i = x; i < x1; ++i)
            sum += colours(size_t(j) * size_t(image.width) + size_t(i), c);
        const uint16_t bits = half_bits(float(sum / (double(x1 - x) * (y1 - y))));
        bytes.push_back(uint8_t(bits));
        bytes.push_back(uint8_t(bits >> 8));
      }
  web.half = base64(bytes);
  return web;
}

std::string viewer_html(const std::vector<ViewedImage>& images, size_t reference) {
  nlohmann::ordered_json data;
  data["width"] = images.at(reference).image.width;
  data["height"] = images.at(reference).image.height;
  data["reference"] = reference;
  data["images"] = nlohmann::ordered_json::array();
  for (const ViewedImage& i : images)
    data["images"].push_back({{"name", i.name}, {"note", i.note}, {"half", i.image.half}});
  // A name may not end the script that it stands in.
  std::string text = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  for (size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3)
    text.insert(at + 1, "\\");
  return "<div class=\"viewer\"><script type=\"application/json\">" + text + "</script></div>\n";
}

std::string web_page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<link rel=\"icon\" "
      "href=\"data:,\">\n<style>\n{}</style>\n</head>\n<body>\n{}\n<script>\n{}</script>\n"
      "</body>\n</html>\n",
      escape_markup(title), web_files::page_css, body, web_files::viewer_js);
}

void write_text(const std::string& path, const std::string& text) {
  write_file_atomically(path, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

}  // namespace duet
