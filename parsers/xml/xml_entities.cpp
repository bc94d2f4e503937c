// Entities of a document type: <!DOCTYPE scene [<!ENTITY name "text"> <!ENTITY name SYSTEM
// "file">]> with &name; in their place, as XML 1.0 defines them, section 4.
#include <algorithm>
#include <deque>
#include <map>

#include "files/file_access.h"
#include "values/text.h"
#include "xml/xml_text.h"

namespace duet {

namespace {

constexpr int kDeepestEntity = 16;
constexpr int kMostReplacements = 1'000'000;
constexpr size_t kLongestExpansion = size_t(64) << 20;
constexpr std::string_view kSpace = " \t\r\n";

/// A part of a text, or the name of a file.
struct Entity {
  size_t begin = 0, end = 0;
  std::string file;
};
using Entities = std::map<std::string, Entity, std::less<>>;

/// Goes through a declaration.
class Scanner {
 public:
  Scanner(std::string_view text, size_t at) : text_(text), at_(at) {}
  bool skip(std::string_view word) {
    at_ = std::min(text_.find_first_not_of(kSpace, at_), text_.size());
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }
  std::string_view name() {
    at_ = std::min(text_.find_first_not_of(kSpace, at_), text_.size());
    const size_t begin = at_;
    at_ = std::min(text_.find_first_of(" \t\r\n\"'<>[]%&;", at_), text_.size());
    return text_.substr(begin, at_ - begin);
  }
  /// Begin and end of a text in quotes.
  std::optional<std::pair<size_t, size_t>> quoted() {
    at_ = std::min(text_.find_first_not_of(kSpace, at_), text_.size());
    if (at_ == text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) return std::nullopt;
    const size_t end = text_.find(text_[at_], at_ + 1);
    if (end == text_.npos) return std::nullopt;
    const std::pair<size_t, size_t> range{at_ + 1, end};
    at_ = end + 1;
    return range;
  }
  size_t position() const { return at_; }

 private:
  std::string_view text_;
  size_t at_;
};

/// Where the declarations of the document type begin; nothing if there are none.
std::optional<size_t> internal_subset(std::string_view text) {
  const size_t type = text.find("<!DOCTYPE");
  if (type == text.npos) return std::nullopt;
  Scanner scanner(text, type + 9);
  scanner.name();
  if (scanner.skip("PUBLIC")) scanner.quoted(), scanner.quoted();
  if (scanner.skip("SYSTEM")) scanner.quoted();
  return scanner.skip("[") ? std::optional(scanner.position()) : std::nullopt;
}

/// Reads what stands behind "<!ENTITY". Parameter entities and those of other programs are none of
/// ours.
void read_declaration(std::string_view text, Scanner& scanner, Entities& entities) {
  const std::string name(scanner.name());
  if (name.empty()) return;
  Entity entity;
  const bool is_public = scanner.skip("PUBLIC");
  if (is_public) scanner.quoted();
  if (is_public || scanner.skip("SYSTEM")) {
    const auto file = scanner.quoted();
    if (!file || scanner.skip("NDATA")) return;
    entity.file = text.substr(file->first, file->second - file->first);
  } else if (const auto value = scanner.quoted()) {
    entity.begin = value->first, entity.end = value->second;
  } else {
    return;
  }
  entities.try_emplace(name, entity);  // the first declaration holds
}

/// `end` becomes the end of the declarations.
Entities read_entities(std::string_view text, size_t& end) {
  Entities entities;
  const auto begin = internal_subset(text);
  if (!begin) return entities;
  Scanner scanner(text, *begin);
  while (scanner.position() < text.size() && !scanner.skip("]")) {
    if (scanner.skip("<!ENTITY")) {
      read_declaration(text, scanner, entities);
    } else if (scanner.skip("<!--")) {
      const size_t close = text.find("-->", scanner.position());
      if (close == text.npos) break;
      scanner = Scanner(text, close + 3);
    } else if (!scanner.quoted()) {
      scanner = Scanner(text, scanner.position() + 1);
    }
  }
  end = scanner.position();
  return entities;
}

}  // namespace

/// Copies a text with its entities replaced.
class EntityExpander {
 public:
  EntityExpander(const XmlText& original, const XmlText::ReadFile& read, Report& report)
      : entities_(read_entities(original.text(), declarations_end_)), read_(read), report_(report) {
    texts_.push_back(original.text());
    out_.sources_ = original.sources_;
  }

  XmlText run() {
    copy(0, 0, texts_[0].size(), 0);
    return std::move(out_);
  }

 private:
  /// Appends a part of a source.
  void copy(size_t source, size_t begin, size_t end, int depth) {
    const std::string& text = texts_[source];
    size_t from = begin;
    for (size_t i = begin; i < end && good_;) {
      const std::string_view rest = std::string_view(text).substr(i, end - i);
      if (rest.starts_with("<!--")) {
        i = std::min(text.find("-->", i), end);
      } else if (rest.starts_with("<![CDATA[")) {
        i = std::min(text.find("]]>", i), end);
      } else if (source == 0 && rest.starts_with("<!DOCTYPE")) {
        i = std::max(i + 1, declarations_end_);
      } else if (const auto entity = reference(rest); entity != entities_.end()) {
        plain(source, from, i);
        replace(entity->second, depth, source, i);
        from = i += entity->first.size() + 2;
      } else {
        ++i;
      }
    }
    plain(source, from, end);
  }

  /// The entity that the text begins with.
  Entities::const_iterator reference(std::string_view text) const {
    if (!text.starts_with('&')) return entities_.end();
    const size_t end = text.find(';');
    return end == text.npos ? entities_.end() : entities_.find(text.substr(1, end - 1));
  }

  /// Appends what an entity stands for; its reference is in `source` at `place`.
  void replace(const Entity& entity, int depth, size_t source, size_t place) {
    const auto fail = [&](const std::string& why) {
      report_.error(where(source, place), "{}", why);
      good_ = false;
    };
    if (depth >= kDeepestEntity)
      return fail(fmt::format("entities are nested more than {} deep", kDeepestEntity));
    if (++replaced_ > kMostReplacements)
      return fail(fmt::format("more than {} entities are replaced", kMostReplacements));
    if (out_.text_.size() > kLongestExpansion)
      return fail(fmt::format("entities make the text longer than {} MB", kLongestExpansion >> 20));
    if (entity.file.empty()) return copy(0, entity.begin, entity.end, depth + 1);
    const std::string path = beside(*out_.sources_[0].file, entity.file);
    auto text = read_(path);
    auto utf8 = text ? to_utf8(std::move(*text)) : std::nullopt;
    if (!utf8) return fail("cannot read the entity's file " + in_quotes(path));
    // A declaration in front of it tells its encoding.
    const size_t begin =
        utf8->starts_with("<?xml") ? std::min(utf8->find("?>") + 2, utf8->size()) : 0;
    out_.sources_.push_back(XmlText::make_source(*utf8, std::make_shared<const std::string>(path)));
    texts_.push_back(std::move(*utf8));
    copy(texts_.size() - 1, begin, texts_.back().size(), depth + 1);
  }

  void plain(size_t source, size_t begin, size_t end) {
    if (begin >= end) return;
    out_.pieces_.push_back({out_.text_.size(), source, begin});
    out_.text_.append(texts_[source], begin, end - begin);
  }

  SourceLocation where(size_t source, size_t offset) const {
    XmlText place;
    place.sources_ = {out_.sources_[source]};
    place.pieces_ = {{0, 0, 0}};
    return place.at(offset);
  }

  static std::string beside(const std::string& file, const std::string& name) {
    if (name.starts_with('/')) return name;
    const std::string folder = folder_of(file);
    return folder == "." ? name : folder + "/" + name;
  }

  size_t declarations_end_ = 0;
  Entities entities_;
  const XmlText::ReadFile& read_;
  Report& report_;
  std::deque<std::string> texts_;  ///< of the sources
  XmlText out_;
  int replaced_ = 0;
  bool good_ = true;
};

bool XmlText::declares_entities() const {
  return text_.find("<!ENTITY") != std::string::npos;
}

XmlText XmlText::replace_entities(const ReadFile& read, Report& report) const {
  return EntityExpander(*this, read, report).run();
}

}  // namespace duet
