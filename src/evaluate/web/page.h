// The frame of the reports: one HTML file that opens from disk and needs nothing else.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "image/flip.h"
#include "image/image.h"

namespace duet {

/// The text with the characters escaped that mean something in HTML, SVG and XML.
std::string escape_markup(const std::string& text);

/// Colours of an image as the pages hold them: binary16 numbers in base64.
struct WebImage {
  int width = 0, height = 0;
  std::string half;
  int reduced_by = 1;  ///< pixels of the image along each side of one of these
};
/// Reduced by averaging until neither side is longer than `longest`. The image has channels R, G, B
/// or Y; throws std::invalid_argument without them.
WebImage web_image(const Image& image, int longest);

/// The FLIP map of an image as the pages hold it: bytes from 0 to 255 in base64, of the size of the
/// WebImage that was reduced to the same longest side.
struct WebFlip {
  std::string bytes;  ///< "" for none
  double mean = 0;    ///< of the whole image
};
WebFlip web_flip(const FlipResult& flip, int width, int longest);

/// One of the images of a viewer.
struct ViewedImage {
  std::string name, note;
  WebImage image;
  WebFlip flip;  ///< against the reference
};
/// What the viewer reads: images of one size, one of which may be the reference of the false-colour
/// error and of FLIP.
nlohmann::ordered_json viewer_data(const std::vector<ViewedImage>& images,
                                   std::optional<size_t> reference);
/// A viewer for them.
std::string viewer_html(const std::vector<ViewedImage>& images, std::optional<size_t> reference);

/// A paragraph about the keys of a viewer.
std::string viewer_keys(bool has_reference = true);

/// A complete page. `body` is HTML, `title` plain text.
std::string web_page(const std::string& title, const std::string& body);
/// What stands before the body and behind it, for pages that are written piece by piece.
std::string web_page_start(const std::string& title);
std::string web_page_end();

}  // namespace duet
