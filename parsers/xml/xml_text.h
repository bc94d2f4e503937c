// The text of an XML file: as UTF-8, with its entities replaced, and where each part comes from.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "values/report.h"

namespace duet {

/// The text as UTF-8. It may be UTF-16, with or without a byte order mark, or ISO-8859-1 if its
/// declaration says so; zero bytes at its end are left out. Nothing if it is broken UTF-16.
std::optional<std::string> to_utf8(std::string text);

/// A text made of parts of files.
class XmlText {
 public:
  /// What stands for a line; null for the file with line and column.
  using PlaceOfLine = std::function<std::shared_ptr<const std::string>(int line)>;
  /// A whole file.
  XmlText(std::string text, std::shared_ptr<const std::string> file, PlaceOfLine place = {});

  const std::string& text() const { return text_; }
  /// Gives the text away; what at() needs stays.
  std::string release() { return std::move(text_); }
  /// The place in its file of the byte at an offset.
  SourceLocation at(size_t offset) const;

  /// Whether a document type declares entities.
  bool declares_entities() const;
  using ReadFile = std::function<std::optional<std::string>(const std::string& path)>;
  /// The same with the entities replaced that its document type declares, those in other files
  /// (SYSTEM), too. What cannot be read or grows beyond all bounds is an error.
  XmlText replace_entities(const ReadFile& read, Report& report) const;

 private:
  friend class EntityExpander;
  struct Source {
    std::shared_ptr<const std::string> file;
    std::vector<size_t> line_starts;
    PlaceOfLine place = {};  ///< or null
  };
  /// From `begin` on the text is that of a source from `source_begin` on.
  struct Piece {
    size_t begin, source, source_begin;
  };
  XmlText() = default;
  static Source make_source(const std::string& text, std::shared_ptr<const std::string> file);

  std::string text_;
  std::vector<Source> sources_;
  std::vector<Piece> pieces_;
};

}  // namespace duet
