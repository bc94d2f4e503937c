// The separate library that is loaded when a file needs OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "image/codec_module.h"
#include "image/image_limits.h"

namespace {

/// The reason of a failure of an ImageInput or ImageOutput; of the library if that is null.
template <class File>
[[noreturn]] void fail(const File& file) {
  std::string reason;
  if (file)
    reason = file->geterror();
  else
    reason = OIIO::geterror();
  // One line: the library appends what its own libraries say.
  while (!reason.empty() && reason.back() == '\n') reason.pop_back();
  std::replace(reason.begin(), reason.end(), '\n', ';');
  if (reason.empty()) reason = "the file is damaged";
  throw std::runtime_error(reason);
}

/// Runs `work`; what it throws becomes the error text, as no exception may leave the module.
template <class Work>
int guarded(char* error, size_t error_size, Work work) {
  std::string reason;
  try {
    work();
    return 1;
  } catch (const std::bad_alloc&) {
    reason = "is too large for the memory";
  } catch (const std::exception& e) {
    reason = e.what();
  }
  reason.resize(std::min(reason.size(), error_size - 1));
  std::memcpy(error, reason.c_str(), reason.size() + 1);
  return 0;
}

struct Free {
  void operator()(void* p) const { std::free(p); }
};
std::unique_ptr<void, Free> allocate(size_t size) {
  std::unique_ptr<void, Free> memory(std::malloc(size));
  if (!memory) throw std::bad_alloc();
  return memory;
}

/// Knows whether it was asked for bytes beyond the end of the file: libtiff fills what is missing
/// with zeros and reports nothing. For libpng this reader does the same, because OpenImageIO 2.4
/// loses the memory of its own message when it jumps out of a read that comes short.
class WatchedReader : public OIIO::Filesystem::IOMemReader {
 public:
  WatchedReader(const uint8_t* bytes, size_t size, bool fill)
      : IOMemReader(bytes, size), fill_(fill) {}
  size_t read(void* target, size_t size) override {
    return watch(target, IOMemReader::read(target, size), size);
  }
  size_t pread(void* target, size_t size, int64_t offset) override {
    return watch(target, IOMemReader::pread(target, size, offset), size);
  }
  bool overrun() const { return overrun_; }

 private:
  size_t watch(void* target, size_t got, size_t wanted) {
    overrun_ = overrun_ || got < wanted;
    if (!fill_) return got;
    std::memset(static_cast<char*>(target) + got, 0, wanted - got);
    return wanted;
  }
  bool fill_, overrun_ = false;
};

/// Throws if a format whose reader asks for no more than it needs was asked beyond the end.
void check_end(const WatchedReader& source, std::string_view kind) {
  if (source.overrun() && (kind == "tiff" || kind == "png"))
    throw std::runtime_error("the file ends in the middle of the image");
}

int decode(const char* kind, const uint8_t* bytes, size_t size, DuetDecodedImage* image,
           char* error, size_t error_size) {
  return guarded(error, error_size, [&] {
    WatchedReader source(bytes, size, std::string_view(kind) == "png");
    auto input = OIIO::ImageInput::create(kind);
    if (!input || !input->set_ioproxy(&source)) fail(input);
    OIIO::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->open(kind, spec, config)) {
      check_end(source, kind);
      fail(input);
    }
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0 ||
        spec.width > duet::kGreatestImageSize || spec.height > duet::kGreatestImageSize)
      throw std::runtime_error("an image of " + std::to_string(spec.width) + " x " +
                               std::to_string(spec.height) + " cannot be read");
    const bool is_byte = spec.format == OIIO::TypeDesc::UINT8;
    const size_t count = size_t(spec.width) * size_t(spec.height) * size_t(spec.nchannels);
    const size_t image_bytes = count * (is_byte ? 1 : sizeof(float));
    if (!duet::is_plausible_size(image_bytes, size))
      throw std::runtime_error("the file is too short for an image of " +
                               std::to_string(spec.width) + " x " + std::to_string(spec.height));
    auto pixels = allocate(image_bytes);
    if (!input->read_image(0, 0, 0, spec.nchannels,
                           is_byte ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT, pixels.get())) {
      check_end(source, kind);
      fail(input);
    }
    check_end(source, kind);
    *image = {spec.width,
              spec.height,
              spec.nchannels,
              is_byte ? 0 : 1,
              spec.format.is_floating_point() ? 0 : 1,
              pixels.release()};
  });
}

void release(void* memory) {
  std::free(memory);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const DuetCodecs* duet_codecs() {
  static const DuetCodecs codecs{DUET_CODEC_VERSION, decode, release};
  return &codecs;
}
