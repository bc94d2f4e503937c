#include "image/exr_io.h"

#include <ImathBox.h>
#include <ImathMatrix.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "base/readable.h"
#include "image/exr_sizes.h"
#include "image/image_limits.h"

namespace duet {

namespace {

class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(const std::string& name, const std::vector<uint8_t>& bytes)
      : IStream(name.c_str()), bytes_(bytes) {}
  bool read(char target[], int count) override {
    if (count < 0 || position_ > bytes_.size() || bytes_.size() - position_ < uint64_t(count))
      throw std::runtime_error("the file ends too early");
    std::memcpy(target, bytes_.data() + position_, size_t(count));
    position_ += uint64_t(count);
    return position_ < bytes_.size();
  }
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t position) override { position_ = position; }

 private:
  const std::vector<uint8_t>& bytes_;
  uint64_t position_ = 0;
};

/// "layer.R" → ("layer.", R's place among R, G, B, A and others).
std::pair<std::string, int> channel_order(const std::string& name) {
  const size_t dot = name.rfind('.');
  const std::string layer = dot == name.npos ? "" : name.substr(0, dot + 1);
  const std::string_view last = std::string_view(name).substr(layer.size());
  const size_t place = last.size() == 1 ? std::string_view("RGBXYZUV").find(last) : 0;
  return {layer, last == "A" ? 99 : last.size() == 1 && place != last.npos ? int(place) : 50};
}

/// The channels of a part in the order in which they are handed out, with their names in the file.
std::vector<std::string> ordered_channels(const Imf::Header& header) {
  std::vector<std::string> names;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    names.push_back(c.name());
  std::stable_sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return channel_order(a) < channel_order(b);
  });
  return names;
}

std::vector<std::pair<std::string, std::string>> read_attributes(const Imf::Header& header) {
  std::vector<std::pair<std::string, std::string>> fields;
  for (auto a = header.begin(); a != header.end(); ++a) {
    const Imf::Attribute& value = a.attribute();
    std::string text;
    if (const auto* s = dynamic_cast<const Imf::StringAttribute*>(&value)) {
      text = s->value();
    } else if (const auto* f = dynamic_cast<const Imf::FloatAttribute*>(&value)) {
      text = fmt::format("{}", f->value());
    } else if (const auto* d = dynamic_cast<const Imf::DoubleAttribute*>(&value)) {
      text = fmt::format("{}", d->value());
    } else if (const auto* i = dynamic_cast<const Imf::IntAttribute*>(&value)) {
      text = fmt::format("{}", i->value());
    } else if (const auto* m = dynamic_cast<const Imf::M44fAttribute*>(&value)) {
      for (int k = 0; k < 16; ++k)
        text += fmt::format("{}{}", k ? " " : "", m->value()[k / 4][k % 4]);
    } else if (const auto* c = dynamic_cast<const Imf::ChromaticitiesAttribute*>(&value)) {
      const Imf::Chromaticities& xy = c->value();
      text = fmt::format("{} {} {} {} {} {} {} {}", xy.red.x, xy.red.y, xy.green.x, xy.green.y,
                         xy.blue.x, xy.blue.y, xy.white.x, xy.white.y);
    } else {
      continue;
    }
    fields.emplace_back(a.name(), text);
  }
  return fields;
}

/// Checks what is said of a part before memory is made for its pixels; returns their size.
uint64_t check_part(const Imf::Header& header) {
  if (header.hasType() && Imf::isDeepData(header.type()))
    throw std::runtime_error("deep images cannot be read");
  const Imath::Box2i& window = header.dataWindow();
  const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
  uint64_t channels = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c, ++channels)
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
      throw std::runtime_error(fmt::format("channel {} is subsampled", c.name()));
  if (channels == 0) throw std::runtime_error("the image has no channels");
  return uint64_t(width) * uint64_t(height) * channels * sizeof(float);
}

/// Whether the last lines of a part are there.
bool is_complete(Imf::MultiPartInputFile& input, int part) {
  if (!input.partComplete(part)) return false;
  const Imf::Header& header = input.header(part);
  if (header.hasTileDescription() || (header.hasType() && Imf::isDeepData(header.type())))
    return true;
  // The table of where lines are comes before them: whether the last ones are there shows when
  // they are read.
  try {
    const char* data = nullptr;
    int size = 0;
    Imf::InputPart(input, part).rawPixelData(header.dataWindow().max.y, data, size);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

bool is_exr(const std::vector<uint8_t>& bytes) {
  constexpr uint8_t kMagic[4] = {0x76, 0x2f, 0x31, 0x01};
  return bytes.size() >= 4 && std::equal(kMagic, kMagic + 4, bytes.begin());
}

ImageFile decode_exr(const std::string& path, const std::vector<uint8_t>& bytes) {
  try {
    MemoryInput stream(path, bytes);
    check_sizes(stream);
    Imf::MultiPartInputFile input(stream, 0, false);
    const Imf::Header& first = input.header(0);
    const Imath::Box2i window = first.dataWindow(), display = first.displayWindow();

    uint64_t image_bytes = 0;
    std::vector<std::string> names;
    for (int p = 0; p < input.parts(); ++p) {
      const Imf::Header& header = input.header(p);
      image_bytes += check_part(header);
      if (header.dataWindow() != window)
        throw std::runtime_error("parts of different size cannot be read");
      const std::string prefix = p == 0 ? "" : header.name() + ".";
      // Most programs repeat the name of the part in those of its channels.
      for (const std::string& name : ordered_channels(header))
        names.push_back(name.starts_with(prefix) ? name : prefix + name);
    }
    if (!is_plausible_size(image_bytes, bytes.size()))
      throw std::runtime_error(fmt::format(
          "the file is too short for an image of {} x {} with {} channels",
          window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, names.size()));

    ImageFile file;
    file.header = read_attributes(first);
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    file.image = Image(width, height, names);
    file.origin = {window.min.x - display.min.x, window.min.y - display.min.y};
    file.display_size = {display.max.x - display.min.x + 1, display.max.y - display.min.y + 1};
    const size_t pixel = names.size() * sizeof(float);
    size_t channel = 0;
    for (int p = 0; p < input.parts(); ++p) {
      Imf::FrameBuffer buffer;
      for (const std::string& name : ordered_channels(input.header(p)))
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, &file.image.data[channel++], window.min,
                                             width, height, pixel, pixel * size_t(width)));
      Imf::InputPart part(input, p);
      part.setFrameBuffer(buffer);
      part.readPixels(window.min.y, window.max.y);
    }
    return file;
  } catch (const std::bad_alloc&) {
    throw ReadError(path + ": is too large for the memory");
  } catch (const std::exception& e) {
    throw ReadError(fmt::format("{}: {}", path, e.what()));
  }
}

ImageFacts exr_facts(const std::string& path) {
  refuse_pipe(path);
  ImageFacts facts;
  try {
    Imf::StdIFStream stream(path.c_str());
    check_sizes(stream);
    Imf::MultiPartInputFile input(stream, 0);
    const Imath::Box2i& window = input.header(0).dataWindow();
    facts.width = window.max.x - window.min.x + 1;
    facts.height = window.max.y - window.min.y + 1;
    facts.fields = read_attributes(input.header(0));
    facts.numbers = StoredNumbers::halves;
    facts.is_complete = true;
    for (int p = 0; p < input.parts(); ++p) {
      const Imf::ChannelList& channels = input.header(p).channels();
      for (auto c = channels.begin(); c != channels.end(); ++c, ++facts.channels)
        if (c.channel().type != Imf::HALF) facts.numbers = StoredNumbers::others;
      facts.is_complete &= is_complete(input, p);
    }
  } catch (const std::exception& e) {
    throw ReadError(fmt::format("{}: {}", path, e.what()));
  }
  return facts;
}

}  // namespace duet
