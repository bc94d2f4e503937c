#include "mesh/byte_reader.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace duet {

ByteReader::ByteReader(const std::string& path) : name_(path), file_(path), size_(file_->size()) {
  // The buffer here is the only one.
  std::setvbuf(file_->stream(), nullptr, _IONBF, 0);
  buffer_.resize(size_t(std::min<uint64_t>(kBlock, std::max<uint64_t>(size_, 1))));
  begin_ = next_ = end_ = buffer_.data();
}

ByteReader::ByteReader(std::string name, std::span<const uint8_t> memory)
    : name_(std::move(name)),
      begin_(memory.data()),
      next_(begin_),
      end_(begin_ + memory.size()),
      block_end_(memory.size()),
      size_(memory.size()) {}

void ByteReader::refill(size_t count) {
  if (!file_) return;
  size_t kept = available();
  std::memmove(buffer_.data(), next_, kept);
  while (kept < std::min(count, buffer_.size())) {
    const size_t n = std::fread(buffer_.data() + kept, 1, buffer_.size() - kept, file_->stream());
    if (n == 0) {
      if (std::ferror(file_->stream())) fail("cannot be read: {}", std::strerror(errno));
      break;
    }
    kept += n;
    block_end_ += n;
  }
  next_ = buffer_.data();
  end_ = next_ + kept;
}

void ByteReader::seek(uint64_t position) {
  if (!file_) {
    next_ = begin_ + position;
    return;
  }
  if (!file_->seek(position)) fail("cannot be read: {}", std::strerror(errno));
  next_ = end_ = buffer_.data();
  block_end_ = position;
}

bool ByteReader::next_line(std::string_view& text) {
  std::span<const uint8_t> bytes = peek(std::min<size_t>(kBlock, 256));
  const void* found = bytes.empty() ? nullptr : std::memchr(bytes.data(), '\n', bytes.size());
  if (!found) {
    bytes = peek(kBlock);
    found = bytes.empty() ? nullptr : std::memchr(bytes.data(), '\n', bytes.size());
  }
  if (bytes.empty()) return false;
  line_ += pending_lines_;
  pending_lines_ = 1;
  if (!found && bytes.size() == kBlock) fail("the line is too long");
  size_t length = found ? size_t(static_cast<const uint8_t*>(found) - bytes.data()) : bytes.size();
  skip(found ? length + 1 : length);
  if (length > 0 && bytes[length - 1] == '\r') --length;
  text = {reinterpret_cast<const char*>(bytes.data()), length};
  return true;
}

std::string_view ByteReader::next_word() {
  const auto is_space = [](uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
  constexpr size_t kLongestWord = 512;
  for (;;) {
    const std::span<const uint8_t> bytes = peek(kLongestWord);
    if (bytes.empty()) return {};
    size_t begin = 0;
    for (; begin < bytes.size() && is_space(bytes[begin]); ++begin)
      pending_lines_ += bytes[begin] == '\n';
    if (begin > 0) {
      skip(begin);
      continue;
    }
    size_t end = 0;
    while (end < bytes.size() && !is_space(bytes[end])) ++end;
    line_ += pending_lines_;
    pending_lines_ = 0;
    if (end == kLongestWord) fail("the word is too long");
    skip(end);
    return {reinterpret_cast<const char*>(bytes.data()), end};
  }
}

std::string ByteReader::place() const {
  return line_ > 0 ? fmt::format("{}:{}", name_, line_) : name_;
}

}  // namespace duet
