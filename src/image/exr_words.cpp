#include "image/exr_words.h"

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>

#include "base/diagnostics.h"
#include "base/readable.h"
#include "base/system/atomic_file.h"
#include "image/exr_sizes.h"

namespace duet {

namespace {

/// Rows that are handed to OpenEXR together.
constexpr int kRows = 16;

class AtomicOutput : public Imf::OStream {
 public:
  explicit AtomicOutput(const std::string& path) : OStream(path.c_str()), file_(path) {}
  void write(const char source[], int count) override {
    file_.write_at(position_, {reinterpret_cast<const uint8_t*>(source), size_t(count)});
    position_ += uint64_t(count);
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }
  /// Sums take long to make again: they are to survive the machine's end, too.
  void commit() {
    file_.sync();
    file_.commit();
  }

 private:
  AtomicFile file_;
  uint64_t position_ = 0;
};

/// Where OpenEXR finds the words of the rows from y on.
Imf::FrameBuffer frame_buffer(const WordPlane& plane, uint32_t* words, int y, int rows) {
  Imf::FrameBuffer buffer;
  const size_t pixel = plane.channels.size() * sizeof(uint32_t);
  for (size_t c = 0; c < plane.channels.size(); ++c)
    buffer.insert(plane.channels[c], Imf::Slice::Make(Imf::UINT, words + c, {0, y}, plane.width,
                                                      rows, pixel, pixel * size_t(plane.width)));
  return buffer;
}

}  // namespace

void write_words(const std::string& path, std::span<const WordPlane> planes,
                 const TextFields& texts,
                 const std::function<void(size_t, int, std::span<uint32_t>)>& row) {
  std::vector<Imf::Header> headers;
  // All parts of a file have one display window.
  Imath::Box2i display({0, 0}, {0, 0});
  for (const WordPlane& p : planes) display.extendBy(Imath::V2i(p.width - 1, p.height - 1));
  for (const WordPlane& p : planes) {
    const Imath::Box2i window({0, 0}, {p.width - 1, p.height - 1});
    Imf::Header& header = headers.emplace_back(display, window);
    // The upper words are runs, and the lower ones noise: DEFLATE takes ten times as long for a
    // quarter less.
    header.compression() = Imf::RLE_COMPRESSION;
    header.setName(p.name);
    header.setType(Imf::SCANLINEIMAGE);
    for (const std::string& c : p.channels) header.channels().insert(c, Imf::Channel(Imf::UINT));
  }
  for (const auto& [name, text] : texts) headers[0].insert(name, Imf::StringAttribute(text));
  AtomicOutput stream(path);
  {
    Imf::MultiPartOutputFile file(stream, headers.data(), int(headers.size()), false, 0);
    std::vector<uint32_t> words;
    for (size_t i = 0; i < planes.size(); ++i) {
      const WordPlane& p = planes[i];
      Imf::OutputPart part(file, int(i));
      const size_t n = size_t(p.width) * p.channels.size();
      words.resize(n * kRows);
      for (int y = 0; y < p.height; y += kRows) {
        const int rows = std::min(kRows, p.height - y);
        for (int k = 0; k < rows; ++k) row(i, y + k, std::span(words).subspan(size_t(k) * n, n));
        part.setFrameBuffer(frame_buffer(p, words.data(), y, rows));
        part.writePixels(rows);
      }
    }
  }
  stream.commit();
}

struct WordReader::File {
  explicit File(const std::string& file_path) : path(file_path), stream(file_path.c_str()) {}

  [[noreturn]] void fail(const std::string& reason) const {
    throw ReadError(fmt::format("{}: {}", path, reason));
  }
  std::string path;
  Imf::StdIFStream stream;
  std::unique_ptr<Imf::MultiPartInputFile> input;
};

WordReader::WordReader(const std::string& path) {
  refuse_pipe(path);
  try {
    file_ = std::make_unique<File>(path);
    check_sizes(file_->stream);
    file_->input = std::make_unique<Imf::MultiPartInputFile>(file_->stream, 0, false);
  } catch (const std::exception& e) {
    throw ReadError(fmt::format("{}: {}", path, e.what()));
  }
}

WordReader::~WordReader() = default;

const std::string* WordReader::text(const std::string& name) const {
  const auto* a = file_->input->header(0).findTypedAttribute<Imf::StringAttribute>(name);
  return a ? &a->value() : nullptr;
}

void WordReader::read(const WordPlane& plane,
                      const std::function<void(int, std::span<const uint32_t>)>& row) const {
  const Imf::MultiPartInputFile& input = *file_->input;
  int number = 0;
  // A file of one part may have no names.
  while (number < input.parts() && input.parts() > 1 && input.header(number).name() != plane.name)
    ++number;
  if (number == input.parts()) file_->fail(fmt::format("there is no part \"{}\"", plane.name));
  const Imf::Header& header = input.header(number);
  const Imath::Box2i& window = header.dataWindow();
  if (window != Imath::Box2i({0, 0}, {plane.width - 1, plane.height - 1}))
    file_->fail(fmt::format("part \"{}\" is {} x {}, not {} x {}", plane.name,
                            window.max.x - window.min.x + 1, window.max.y - window.min.y + 1,
                            plane.width, plane.height));
  for (const std::string& c : plane.channels) {
    const Imf::Channel* found = header.channels().findChannel(c);
    if (!found || found->type != Imf::UINT || found->xSampling != 1 || found->ySampling != 1)
      file_->fail(fmt::format("part \"{}\" has no channel {} of 32-bit integers", plane.name, c));
  }
  try {
    Imf::InputPart part(*file_->input, number);
    const size_t n = size_t(plane.width) * plane.channels.size();
    std::vector<uint32_t> words(n * kRows);
    for (int y = 0; y < plane.height; y += kRows) {
      const int rows = std::min(kRows, plane.height - y);
      part.setFrameBuffer(frame_buffer(plane, words.data(), y, rows));
      part.readPixels(y, y + rows - 1);
      for (int k = 0; k < rows; ++k)
        row(y + k, std::span<const uint32_t>(words).subspan(size_t(k) * n, n));
    }
  } catch (const ReadError&) {
    throw;
  } catch (const std::exception& e) {
    file_->fail(e.what());
  }
}

}  // namespace duet
