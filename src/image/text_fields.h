// Names and values that PNG and JPEG files hold beside their pixels.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace duet {

using TextFields = std::vector<std::pair<std::string, std::string>>;

/// Adds a text chunk for each field to an encoded PNG file: tEXt, or iTXt for what is not ASCII.
/// Names are of 1 to 79 ASCII characters. Source: PNG (Third Edition), section 11.3.3.
void add_png_text(std::vector<uint8_t>& png, const TextFields& fields);
/// Adds the fields to an encoded JPEG file, as lines `name: value` of its comment, a value of
/// several lines as one. Source: ITU-T T.81, B.2.4.5; a comment that is too long for one marker
/// takes several.
void add_jpeg_comment(std::vector<uint8_t>& jpeg, const TextFields& fields);

/// What the functions above have added, and whether the file goes on to its end, without looking at
/// the pixels. Other text chunks are fields, too; compressed ones are left out.
struct TextFieldsFound {
  TextFields fields;
  bool is_complete = false;
};
TextFieldsFound find_png_text(std::FILE* file);
TextFieldsFound find_jpeg_comment(std::FILE* file);

}  // namespace duet
