#include "evaluate/batch/pbrt_skim.h"

#include <vector>

namespace duet::batch {

std::map<std::string, double> take_parameters(pbrt::Lexer& in) {
  std::map<std::string, double> numbers;
  std::string name;
  for (;;) {
    const pbrt::Kind kind = in.peek();
    if (kind == pbrt::Kind::string) {
      const std::string text = in.take_string();
      name = text.substr(text.find_last_of(' ') + 1);
    } else if (kind == pbrt::Kind::number) {
      std::vector<double> values;
      in.take_numbers(values);
      if (!values.empty()) numbers.emplace(name, values[0]);
    } else if (kind == pbrt::Kind::open || kind == pbrt::Kind::close) {
      in.take_bracket();
    } else {
      return numbers;
    }
  }
}

}  // namespace duet::batch
