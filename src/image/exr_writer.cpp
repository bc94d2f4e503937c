#include <ImathBox.h>
#include <ImathMatrix.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "image/channel_names.h"
#include "image/exr_io.h"
#include "image/half.h"

namespace duet {

namespace {

class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : OStream("memory") {}
  void write(const char source[], int count) override {
    if (position_ + uint64_t(count) > bytes.size()) bytes.resize(position_ + uint64_t(count));
    std::memcpy(bytes.data() + position_, source, size_t(count));
    position_ += uint64_t(count);
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }

  std::vector<uint8_t> bytes;

 private:
  uint64_t position_ = 0;
};

struct InsertAttribute {
  Imf::Header& header;
  const std::string& name;
  void operator()(const std::string& v) const { header.insert(name, Imf::StringAttribute(v)); }
  void operator()(float v) const { header.insert(name, Imf::FloatAttribute(v)); }
  void operator()(int v) const { header.insert(name, Imf::IntAttribute(v)); }
  void operator()(const std::array<float, 16>& v) const {
    Imath::M44f m;
    for (size_t i = 0; i < 16; ++i) m[int(i / 4)][int(i % 4)] = v[i];
    header.insert(name, Imf::M44fAttribute(m));
  }
};

/// Channels of an image that go to one part of a file.
struct Part {
  Imf::Header header;
  std::vector<size_t> channels;
};

class ExrWriter {
 public:
  ExrWriter(const Image& image, const ExrOptions& options) : image_(image), options_(options) {
    if (image.width <= 0 || image.height <= 0 || image.channels.empty())
      throw std::runtime_error("the image is empty");
    for (auto c = image.channels.begin(); c != image.channels.end(); ++c)
      if (std::find(image.channels.begin(), c, *c) != c)
        throw std::runtime_error(fmt::format("there are two channels \"{}\"", *c));
  }

  std::vector<uint8_t> file() const {
    MemoryOutput stream;
    options_.parts ? write_parts(stream) : write_single(stream);
    return std::move(stream.bytes);
  }

 private:
  void write_single(MemoryOutput& stream) const {
    Part all{header(), {}};
    for (size_t c = 0; c < image_.channels.size(); ++c) add_channel(all, c);
    add_attributes(all.header);
    Imf::OutputFile output(stream, all.header, 0);
    write_lines(output, all);
  }

  /// Each layer is a part that has its name. What is said of the image stands in the first.
  void write_parts(MemoryOutput& stream) const {
    std::vector<Part> parts;
    for (size_t c = 0; c < image_.channels.size(); ++c) {
      const std::string name = part_name(image_.channels, c);
      auto part = std::find_if(parts.begin(), parts.end(),
                               [&](const Part& p) { return p.header.name() == name; });
      if (part == parts.end()) {
        part = parts.insert(part, {header(), {}});
        part->header.setName(name);
        part->header.setType(Imf::SCANLINEIMAGE);
      }
      add_channel(*part, c);
    }
    add_attributes(parts[0].header);
    std::vector<Imf::Header> headers;
    for (const Part& part : parts) headers.push_back(part.header);
    Imf::MultiPartOutputFile file(stream, headers.data(), int(headers.size()), false, 0);
    for (size_t p = 0; p < parts.size(); ++p) {
      Imf::OutputPart output(file, int(p));
      write_lines(output, parts[p]);
    }
  }

  Imf::Header header() const {
    const Point2i& origin = options_.origin;
    const Point2i full = options_.full_size == Point2i{0, 0}
                             ? Point2i{origin.x + image_.width, origin.y + image_.height}
                             : options_.full_size;
    const Imath::Box2i window({origin.x, origin.y},
                              {origin.x + image_.width - 1, origin.y + image_.height - 1});
    return {{{0, 0}, {full.x - 1, full.y - 1}},
            window,
            options_.pixel_aspect,
            {0, 0},
            1,
            Imf::INCREASING_Y,
            Imf::ZIP_COMPRESSION};
  }

  void add_channel(Part& part, size_t channel) const {
    part.channels.push_back(channel);
    const Imf::PixelType type = is_half(channel) ? Imf::HALF : Imf::FLOAT;
    part.header.channels().insert(image_.channels[channel], Imf::Channel(type));
  }

  void add_attributes(Imf::Header& header) const {
    for (const auto& [name, value] : options_.header)
      std::visit(InsertAttribute{header, name}, value);
  }

  bool is_half(size_t channel) const {
    const auto& exact = options_.full_precision;
    return options_.half &&
           std::find(exact.begin(), exact.end(), image_.channels[channel]) == exact.end();
  }

  /// Converted and written by blocks of lines: no second image.
  template <class Output>
  void write_lines(Output& output, const Part& part) const {
    constexpr int kLines = 16;
    const Imath::V2i origin = part.header.dataWindow().min;
    const size_t width = size_t(image_.width);
    std::vector<half> halves(options_.half ? kLines * width * part.channels.size() : 0);
    for (int y = 0; y < image_.height; y += kLines) {
      const int lines = std::min(kLines, image_.height - y);
      Imf::FrameBuffer buffer;
      const auto insert = [&](size_t channel, Imf::PixelType type, const auto* base,
                              size_t channels) {
        const size_t pixel = channels * sizeof(*base);
        buffer.insert(image_.channels[channel],
                      Imf::Slice::Make(type, base, {origin.x, origin.y + y}, image_.width, lines,
                                       pixel, pixel * width));
      };
      half* plane = halves.data();
      for (const size_t channel : part.channels) {
        const float* source = image_.pixel(0, y) + channel;
        if (!is_half(channel)) {
          insert(channel, Imf::FLOAT, source, image_.channels.size());
          continue;
        }
        for (size_t i = 0; i < size_t(lines) * width; ++i)
          plane[i] = half(half::FromBits, half_bits(source[i * image_.channels.size()]));
        insert(channel, Imf::HALF, plane, 1);
        plane += size_t(lines) * width;
      }
      output.setFrameBuffer(buffer);
      output.writePixels(lines);
    }
  }

  const Image& image_;
  const ExrOptions& options_;
};

}  // namespace

std::vector<uint8_t> encode_exr(const Image& image, const ExrOptions& options) {
  return ExrWriter(image, options).file();
}

}  // namespace duet
