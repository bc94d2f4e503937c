// The properties of one plugin, asked for by name: checked, with the presets of the vocabulary.
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mitsuba/node.h"
#include "values/report.h"

namespace duet {

/// Names are those of the vocabulary; asking for one that the plugin does not have is a mistake in
/// the program. What is asked for counts as used. After an error the preset is returned.
class Properties {
 public:
  /// The node's plugin must be known.
  Properties(const Node& node, Report& report);

  const Node& node() const { return node_; }
  bool is_0x() const { return node_.version.is_0x(); }
  Report& report() { return report_; }

  /// Whether the file gives the parameter a value, be it a wrong one.
  bool has(std::string_view name) const;
  /// The property, or null (after an error if it is required).
  const Property* find(std::string_view name);
  /// A parameter that the vocabulary cannot know, since a file of the plugin's defines it: by the
  /// name that the scene writes; null if there is none.
  const Property* find_own(std::string_view written);
  /// What the vocabulary says of a parameter, and whether the plugin has one of that name.
  const Parameter& parameter(std::string_view name) const;
  bool knows(std::string_view name) const;
  /// The value that holds where the file gives none.
  std::string_view preset(std::string_view name) const;
  /// Where the value stands, or the plugin if there is none.
  const SourceLocation& where(std::string_view name) const;

  /// The value if the file gives one of that type; null, after an error if it is of another one.
  template <class T>
  const T* value(std::string_view name);
  bool boolean(std::string_view name);
  int integer(std::string_view name);
  double number(std::string_view name);
  std::string string(std::string_view name);
  Triple triple(std::string_view name);
  /// A list of numbers; empty after an error.
  std::vector<double> numbers(std::string_view name);
  Matrix4 transform(std::string_view name);
  /// A transform that may change with time: then the result is the identity and `motion` says more.
  Matrix4 transform(std::string_view name, Motion& motion);
  /// The number of a parameter that may be missing.
  std::optional<double> optional_number(std::string_view name);
  /// One of several words, in any case and with or without underscores.
  template <class E>
  E choice(std::string_view name, std::initializer_list<std::pair<std::string_view, E>> choices);
  /// The same by its place among the words; 0 after an error.
  size_t choice(std::string_view name, std::span<const std::string_view> words);

  /// A check that needs more than one value failed.
  template <class... Args>
  void error(std::string_view name, fmt::format_string<Args...> text, Args&&... args) {
    report_.error(where(name), text, std::forward<Args>(args)...);
  }
  /// Reports that the plugin needs something.
  template <class... Args>
  void needs(fmt::format_string<Args...> what, Args&&... args) {
    report_.error(node_.where, "{} needs {}", describe(node_),
                  fmt::format(what, std::forward<Args>(args)...));
  }
  /// An error if both are given; at `name`, or where `at` is.
  void only_one(std::string_view name, std::string_view other, std::string_view at = "");
  /// Reports that the value has a type that the parameter cannot have.
  void wrong_type(std::string_view name, const Property& property);
  /// Checks a number from a property against the range of its parameter.
  bool in_range(std::string_view name, double value);

  struct Child {
    const Node* node;
    const Property* property;
  };
  /// The plugins of a kind that are no parameters; nested or by reference.
  std::vector<Child> children(PluginKind kind);
  /// At most one such plugin; more are an error.
  const Node* child(PluginKind kind);

  /// Reports what was not asked for: unknown parameters, wrong nesting.
  void finish();

 private:
  struct Entry {
    const Property* property;
    const Parameter* parameter;  ///< null if the plugin has none of that name
    bool used = false;
  };
  const Entry* entry(std::string_view name) const;
  std::string expected(const Parameter& p) const;
  // properties_unused.cpp
  void report_unused(const Entry& e);
  /// Whether it is a plugin of which nothing more is to be said.
  bool report_misplaced(const Property& p);
  void report_without_effect(const Parameter& known, const Property& p);

  const Node& node_;
  Report& report_;
  std::vector<Entry> entries_;
};

template <class T>
const T* Properties::value(std::string_view name) {
  const Property* p = find(name);
  const T* value = p ? std::get_if<T>(&p->value) : nullptr;
  if (p && !value) wrong_type(name, *p);
  return value;
}

template <class E>
E Properties::choice(std::string_view name,
                     std::initializer_list<std::pair<std::string_view, E>> choices) {
  std::vector<std::string_view> words;
  for (const auto& [word, meaning] : choices) words.push_back(word);
  return (choices.begin() + choice(name, words))->second;
}

}  // namespace duet
