#include "pbrt/lexer.h"

#include <sys/stat.h>
#include <zlib.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "values/text.h"

namespace duet::pbrt {

struct Lexer::Source {
  gzFile file;
  explicit Source(gzFile f) : file(f) {}
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  ~Source() { gzclose(file); }
};

Lexer::Lexer(const std::string& path) : name_(std::make_shared<const std::string>(path)) {
  struct stat status;
  if (stat(path.c_str(), &status) != 0)
    throw ReadError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  if (!S_ISREG(status.st_mode)) throw ReadError(fmt::format("{}: is not a file", path));
  // Files that are not compressed are read as they are.
  const gzFile file = gzopen(path.c_str(), "rb");
  if (!file) throw ReadError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  source_ = std::make_unique<Source>(file);
  gzbuffer(file, unsigned(kBlock));
  buffer_.resize(kBlock + kLongest);
  begin_ = next_ = end_ = buffer_.data();
}

Lexer::Lexer(std::string name, std::string_view text)
    : name_(std::make_shared<const std::string>(std::move(name))),
      begin_(text.data()),
      next_(begin_),
      end_(begin_ + text.size()) {}

Lexer::~Lexer() = default;

void Lexer::refill() {
  if (!source_) return;
  base_ += uint64_t(next_ - begin_);
  const size_t kept = size_t(end_ - next_);
  std::memmove(buffer_.data(), next_, kept);
  const int n = gzread(source_->file, buffer_.data() + kept, unsigned(buffer_.size() - kept));
  begin_ = next_ = buffer_.data();
  end_ = next_ + kept + size_t(std::max(n, 0));
  if (n > 0) return;
  int code = 0;
  const std::string message = gzerror(source_->file, &code);
  source_.reset();
  if (n < 0 || code < 0) throw SyntaxError{where(), "the file cannot be read on: " + message};
}

SourceLocation Lexer::where() const {
  return {name_, line_, int(base_ + uint64_t(next_ - begin_) - line_start_) + 1};
}

Kind Lexer::peek() {
  while (true) {
    if (next_ == end_) {
      refill();
      if (next_ == end_) return Kind::end;
    }
    const char c = *next_;
    switch (c) {
      case '\n':
        new_line(++next_);
        continue;
      case ' ':
      case '\t':
      case '\r':
      case '\f':
      case '\v':
      case ',':
        ++next_;
        continue;
      case '#':
        while (next_ != end_ && *next_ != '\n')
          if (++next_ == end_) refill();
        continue;
      case '"':
        return Kind::string;
      case '[':
        return Kind::open;
      case ']':
        return Kind::close;
      default:
        break;
    }
    if ((c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.') return Kind::number;
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) return Kind::word;
    const SourceLocation place = where();
    const std::string shown = in_quotes(std::string_view(next_, 1));
    ++next_;
    throw SyntaxError{place, fmt::format("the character {} cannot stand here", shown)};
  }
}

std::string Lexer::take_word() {
  std::string word;
  while (true) {
    if (next_ == end_) refill();
    if (next_ == end_) return word;
    const char c = *next_;
    const bool part = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '_' || c == ':';
    if (!part) return word;
    word += c;
    ++next_;
  }
}

std::string Lexer::take_string() {
  const SourceLocation start = where();
  ++next_;
  std::string text;
  while (true) {
    if (next_ == end_) refill();
    if (next_ == end_ || *next_ == '\n') throw SyntaxError{start, "a string without its end"};
    char c = *next_++;
    if (c == '"') return text;
    if (c == '\\') {
      if (next_ == end_) refill();
      if (next_ == end_) continue;
      c = *next_++;
      if (c == 'n') c = '\n';
      if (c == 't') c = '\t';
      if (c == 'r') c = '\r';
    }
    text += c;
  }
}

double Lexer::take_number() {
  need(kLongest);
  const char* first = *next_ == '+' ? next_ + 1 : next_;
  double x = 0;
  auto [stop, error] = std::from_chars(first, end_, x);
  const auto ends = [](char c) {
    return c == ' ' || c == '\n' || c == ']' || c == '\t' || c == '\r' || c == '"' || c == '#' ||
           c == '[' || c == ',' || c == '\f' || c == '\v';
  };
  const bool out_of_range = error == std::errc::result_out_of_range;
  if (error == std::errc() || out_of_range) {
    // Too small to be represented is zero.
    const std::string_view text(first, size_t(stop - first));
    const bool tiny =
        out_of_range && (text.find("e-") != text.npos || text.find("E-") != text.npos);
    if (tiny) x = 0;
    if ((stop == end_ || ends(*stop)) && (!out_of_range || tiny) && std::isfinite(float(x))) {
      next_ = stop;
      return x;
    }
  }
  stop = next_;
  while (stop != end_ && !ends(*stop)) ++stop;
  const SourceLocation place = where();
  const std::string_view text(next_, size_t(stop - next_));
  std::string message = fmt::format("{} is not a number", in_quotes(text));
  if (out_of_range) message += " that single precision can hold";
  next_ = stop;
  throw SyntaxError{place, message};
}

void Lexer::take_numbers(std::vector<double>& values) {
  do values.push_back(take_number());
  while (peek() == Kind::number);
}

void Lexer::skip_to_next_line() {
  while (true) {
    if (next_ == end_) refill();
    if (next_ == end_) return;
    if (*next_++ != '\n') continue;
    new_line(next_);
    if (next_ == end_) refill();
    if (next_ != end_ && ((*next_ >= 'A' && *next_ <= 'Z') || *next_ == ' ' || *next_ == '\t'))
      return;
  }
}

}  // namespace duet::pbrt
