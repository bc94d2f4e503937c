// Reads the objects of the catalogue's file.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/diagnostics.h"
#include "evaluate/stability/catalogue.h"

namespace duet::stability {

using JsonValue = nlohmann::json;

/// One object of the file: its keys are asked for one by one, and one that nobody asked for is an
/// error.
class JsonObject {
 public:
  JsonObject(const JsonValue& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json.is_object()) fail("an object is needed here");
  }
  [[noreturn]] void fail(const std::string& text) const {
    throw CatalogueError(where_ + ": " + text);
  }
  const std::string& where() const { return where_; }
  bool has(const std::string& key) const { return json_.contains(key); }

  /// Null if the key is not there.
  const JsonValue* find(const std::string& key) {
    asked_.push_back(key);
    const auto at = json_.find(key);
    return at == json_.end() ? nullptr : &*at;
  }
  template <class T>
  T get(const std::string& key, T otherwise) {
    const JsonValue* j = find(key);
    if (!j) return otherwise;
    try {
      return j->get<T>();
    } catch (const JsonValue::exception&) {
      fail(fmt::format("\"{}\" has the wrong type", key));
    }
  }
  std::string text(const std::string& key) {
    const std::string value = get<std::string>(key, "");
    if (value.empty()) fail(fmt::format("\"{}\" is missing", key));
    return value;
  }
  int count(const std::string& key, int otherwise, int least) {
    const int value = get<int>(key, otherwise);
    if (value < least || value > 1 << 20)
      fail(fmt::format("\"{}\" is to be a whole number from {} on", key, least));
    return value;
  }
  std::optional<double> number(const std::string& key) {
    if (!has(key)) return find(key), std::nullopt;
    return get<double>(key, 0);
  }
  /// To be called when everything has been asked for.
  void check_keys() const {
    for (const auto& [key, value] : json_.items())
      if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
        fail(fmt::format("unknown key \"{}\"{}", key, did_you_mean(key, asked_)));
  }

 private:
  const JsonValue& json_;
  std::string where_;
  std::vector<std::string> asked_;
};

}  // namespace duet::stability
