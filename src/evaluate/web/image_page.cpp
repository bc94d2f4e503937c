#include "evaluate/web/image_page.h"

#include <fmt/format.h>

#include "evaluate/web/layers.h"
#include "evaluate/web/page.h"

namespace duet {

namespace {

constexpr int kLongest = 2048;

std::string header_table(const LinearImage& image) {
  if (image.header.empty()) return "";
  std::string html = "<h2>Header</h2>\n<div class=\"card scroll\"><table>\n";
  for (const auto& [name, value] : image.header)
    html += fmt::format("<tr><td>{}</td><td class=\"text\">{}</td></tr>\n", escape_markup(name),
                        escape_markup(value));
  return html + "</table></div>\n";
}

}  // namespace

std::string image_page(const std::string& name, const LinearImage& image) {
  const Image& pixels = image.image;
  return web_page(
      name, fmt::format("<h1>{}</h1>\n<p class=\"soft\">{} × {} pixels, {} channels{}</p>\n"
                        "<div class=\"card\">{}</div>\n{}{}",
                        escape_markup(name), pixels.width, pixels.height, pixels.channel_count(),
                        image.display_encoded ? ", decoded from sRGB" : "",
                        viewer_html(viewed_layers(pixels, kLongest), std::nullopt),
                        viewer_keys(false), header_table(image)));
}

}  // namespace duet
