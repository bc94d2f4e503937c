// Numbers and lists in attribute values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace duet {

/// A finite number that single precision can hold, with nothing but white space around it.
std::optional<double> parse_number(std::string_view text);
std::optional<int64_t> parse_integer(std::string_view text);
/// "true" or "false" in any case.
std::optional<bool> parse_boolean(std::string_view text);

std::string_view trim(std::string_view text);
std::string to_lower(std::string_view text);
/// The parts of a list between commas and white space; empty parts do not count.
std::vector<std::string_view> split_list(std::string_view text);
/// The numbers of such a list; nothing if one of them is not a number.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

/// The snake_case form of a parameter name: toWorld and to_world are the same, intIOR is int_ior.
std::string snake_case(std::string_view name);
/// The camelCase form, as Mitsuba 0.x writes names.
std::string camel_case(std::string_view name);

/// A piece of text for a message: control characters removed, cut to a bearable length.
std::string in_quotes(std::string_view text);

}  // namespace duet
