#include "image/image_facts.h"

#include <cstdio>
#include <string_view>

#include "base/diagnostics.h"
#include "base/system/files.h"
#include "image/exr_io.h"
#include "image/text_fields.h"

namespace duet {

std::string ImageFacts::field(const std::string& name) const {
  for (const auto& [key, value] : fields)
    if (key == name) return value;
  return "";
}

ImageFacts read_image_facts(const std::string& path) {
  const InputFile file(path);
  if (file.size() == 0) throw ReadError(path + ": is empty");
  std::vector<uint8_t> begin(8);
  begin.resize(std::fread(begin.data(), 1, begin.size(), file.stream()));
  const std::string_view mark(reinterpret_cast<const char*>(begin.data()), begin.size());
  if (is_exr(begin)) return exr_facts(path);
  TextFieldsFound found;
  if (mark == "\x89PNG\r\n\x1a\n")
    found = find_png_text(file.stream());
  else if (mark.starts_with("\xff\xd8\xff"))
    found = find_jpeg_comment(file.stream());
  else
    throw ReadError(path + ": is not an EXR, PNG or JPEG image");
  return {std::move(found.fields), found.is_complete};
}

}  // namespace duet
