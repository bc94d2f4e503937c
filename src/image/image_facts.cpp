#include "image/image_facts.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string_view>

#include "base/diagnostics.h"
#include "image/exr_io.h"
#include "image/text_fields.h"

namespace duet {

std::string ImageFacts::field(const std::string& name) const {
  for (const auto& [key, value] : fields)
    if (key == name) return value;
  return "";
}

ImageFacts read_image_facts(const std::string& path) {
  const auto close = [](std::FILE* f) { std::fclose(f); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rbe"), close);
  if (!file) throw ReadError(path + ": cannot be opened: " + std::strerror(errno));
  struct stat status;
  if (fstat(fileno(file.get()), &status) != 0 || !S_ISREG(status.st_mode))
    throw ReadError(path + ": is not a file");
  if (status.st_size == 0) throw ReadError(path + ": is empty");
  std::vector<uint8_t> begin(8);
  begin.resize(std::fread(begin.data(), 1, begin.size(), file.get()));
  const std::string_view mark(reinterpret_cast<const char*>(begin.data()), begin.size());
  if (is_exr(begin)) return exr_facts(path);
  TextFieldsFound found;
  if (mark == "\x89PNG\r\n\x1a\n")
    found = find_png_text(file.get());
  else if (mark.starts_with("\xff\xd8\xff"))
    found = find_jpeg_comment(file.get());
  else
    throw ReadError(path + ": is not an EXR, PNG or JPEG image");
  return {std::move(found.fields), found.is_complete};
}

}  // namespace duet
