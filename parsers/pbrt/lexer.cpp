#include "pbrt/lexer.h"

#include <zlib.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <utility>

#include "values/text.h"

namespace duet::pbrt {

struct Lexer::Source {
  gzFile file;
  explicit Source(gzFile f) : file(f) {}
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  ~Source() { gzclose(file); }
};

Lexer::Input Lexer::open(const std::string& path, uint64_t most) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (error) throw ReadError(fmt::format("{}: cannot be opened: {}", path, error.message()));
  if (!std::filesystem::is_regular_file(status))
    throw ReadError(fmt::format("{}: is not a file", path));
  // Files that are not compressed are read as they are.
  const gzFile file = gzopen(path.c_str(), "rb");
  if (!file) throw ReadError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  Input in;
  in.name = std::make_shared<const std::string>(path);
  in.source = std::make_unique<Source>(file);
  in.most = most;
  gzbuffer(file, unsigned(kBlock));
  in.buffer.resize(kBlock + kLongest);
  in.begin = in.next = in.end = in.buffer.data();
  return in;
}

Lexer::Lexer(const std::string& path, uint64_t most) : in_(open(path, most)) {}

Lexer::Lexer(std::string name, std::string_view text) {
  in_.name = std::make_shared<const std::string>(std::move(name));
  in_.begin = in_.next = text.data();
  in_.end = in_.begin + text.size();
}

void Lexer::include(const std::string& path) {
  Input included = open(path, UINT64_MAX);
  outer_.push_back(std::exchange(in_, std::move(included)));
}

Lexer::~Lexer() = default;

void Lexer::refill() {
  if (!in_.source) return;
  in_.base += uint64_t(in_.next - in_.begin);
  const size_t kept = size_t(in_.end - in_.next);
  std::memmove(in_.buffer.data(), in_.next, kept);
  const size_t room = std::min<uint64_t>(in_.buffer.size() - kept, in_.most);
  const int n = gzread(in_.source->file, in_.buffer.data() + kept, unsigned(room));
  in_.most -= uint64_t(std::max(n, 0));
  in_.begin = in_.next = in_.buffer.data();
  in_.end = in_.next + kept + size_t(std::max(n, 0));
  if (n > 0) return;
  int code = 0;
  const std::string message = gzerror(in_.source->file, &code);
  in_.source.reset();
  if (n < 0 || code < 0) throw SyntaxError{where(), "the file cannot be read on: " + message};
}

SourceLocation Lexer::where() const {
  return {in_.name, in_.line, int(in_.base + uint64_t(in_.next - in_.begin) - in_.line_start) + 1};
}

Kind Lexer::peek() {
  while (true) {
    if (in_.next == in_.end) {
      refill();
      if (in_.next == in_.end) {
        if (outer_.empty()) return Kind::end;
        in_ = std::move(outer_.back());
        outer_.pop_back();
        continue;
      }
    }
    const char c = *in_.next;
    switch (c) {
      case '\n':
        new_line(++in_.next);
        continue;
      case ' ':
      case '\t':
      case '\r':
      case '\f':
      case '\v':
      case ',':
        ++in_.next;
        continue;
      case '#':
        while (in_.next != in_.end && *in_.next != '\n')
          if (++in_.next == in_.end) refill();
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
    const std::string shown = in_quotes(std::string_view(in_.next, 1));
    ++in_.next;
    throw SyntaxError{place, fmt::format("the character {} cannot stand here", shown)};
  }
}

std::string Lexer::take_word() {
  std::string word;
  while (true) {
    if (in_.next == in_.end) refill();
    if (in_.next == in_.end) return word;
    const char c = *in_.next;
    const bool part = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '_' || c == ':';
    if (!part) return word;
    word += c;
    ++in_.next;
  }
}

std::string Lexer::take_string() {
  const SourceLocation start = where();
  ++in_.next;
  std::string text;
  while (true) {
    if (in_.next == in_.end) refill();
    if (in_.next == in_.end || *in_.next == '\n')
      throw SyntaxError{start, "a string without its end"};
    char c = *in_.next++;
    if (c == '"') return text;
    if (c == '\\') {
      if (in_.next == in_.end) refill();
      if (in_.next == in_.end) continue;
      c = *in_.next++;
      if (c == 'n') c = '\n';
      if (c == 't') c = '\t';
      if (c == 'r') c = '\r';
    }
    text += c;
  }
}

double Lexer::take_number() {
  need(kLongest);
  const char* first = *in_.next == '+' ? in_.next + 1 : in_.next;
  double x = 0;
  auto [stop, error] = std::from_chars(first, in_.end, x);
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
    if ((stop == in_.end || ends(*stop)) && (!out_of_range || tiny) && std::isfinite(float(x))) {
      in_.next = stop;
      return x;
    }
  }
  stop = in_.next;
  while (stop != in_.end && !ends(*stop)) ++stop;
  const SourceLocation place = where();
  const std::string_view text(in_.next, size_t(stop - in_.next));
  std::string message = fmt::format("{} is not a number", in_quotes(text));
  if (out_of_range) message += " that single precision can hold";
  in_.next = stop;
  throw SyntaxError{place, message};
}

void Lexer::take_numbers(std::vector<double>& values) {
  do values.push_back(take_number());
  while (peek() == Kind::number);
}

void Lexer::skip_to_next_line() {
  while (true) {
    if (in_.next == in_.end) refill();
    if (in_.next == in_.end) return;
    if (*in_.next++ != '\n') continue;
    new_line(in_.next);
    if (in_.next == in_.end) refill();
    if (in_.next != in_.end &&
        ((*in_.next >= 'A' && *in_.next <= 'Z') || *in_.next == ' ' || *in_.next == '\t'))
      return;
  }
}

}  // namespace duet::pbrt
