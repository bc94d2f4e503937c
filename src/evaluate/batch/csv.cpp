#include "evaluate/batch/csv.h"

namespace duet::batch {

namespace {

class CsvReader {
 public:
  CsvReader(std::string_view text, const std::shared_ptr<const std::string>& file,
            Diagnostics& diagnostics)
      : text_(text), file_(file), diagnostics_(diagnostics) {
    if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  }

  std::vector<CsvRow> read() {
    std::vector<CsvRow> rows;
    while (!is_at_end()) {
      if (skip_line_end()) continue;
      rows.push_back(row());
    }
    return rows;
  }

 private:
  bool is_at_end() const { return next_ >= text_.size(); }
  char peek() const { return is_at_end() ? '\0' : text_[next_]; }
  bool is_at_line_end() const {
    return is_at_end() || peek() == '\n' || text_.substr(next_, 2) == "\r\n";
  }
  bool skip_line_end() {
    if (is_at_end() || !is_at_line_end()) return false;
    next_ += peek() == '\n' ? 1 : 2;
    ++line_;
    return true;
  }

  CsvRow row() {
    CsvRow row{line_, {}};
    while (true) {
      row.fields.push_back(peek() == '"' ? quoted_field() : plain_field());
      if (peek() != ',') break;
      ++next_;
    }
    skip_line_end();
    return row;
  }

  std::string plain_field() {
    std::string field;
    while (!is_at_line_end() && peek() != ',') field += text_[next_++];
    if (field.find('"') != field.npos)
      diagnostics_.error({file_, line_, 0},
                         "a quote within a field that does not begin with one: \"{}\"", field);
    return field;
  }

  std::string quoted_field() {
    const int begin = line_;
    std::string field;
    for (++next_; !is_at_end(); ++next_) {
      if (peek() == '"' && text_.substr(next_, 2) != "\"\"") break;
      if (peek() == '"') ++next_;
      line_ += peek() == '\n';
      field += peek();
    }
    if (is_at_end()) {
      diagnostics_.error({file_, begin, 0}, "a quote that begins here does not end");
      return field;
    }
    ++next_;
    if (is_at_line_end() || peek() == ',') return field;
    diagnostics_.error({file_, line_, 0}, "text follows the quote at the end of a field");
    return field + plain_field();
  }

  std::string_view text_;
  size_t next_ = 0;
  int line_ = 1;
  const std::shared_ptr<const std::string>& file_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::vector<CsvRow> read_csv(std::string_view text, const std::shared_ptr<const std::string>& file,
                             Diagnostics& diagnostics) {
  return CsvReader(text, file, diagnostics).read();
}

}  // namespace duet::batch
