// SPDX-License-Identifier: BSD-3-Clause
#include "graph/class_key.hpp"

namespace occusg {

std::string classKey(const std::string& class_name) {
  constexpr const char* kSpace = " \t\r\n";
  const std::size_t begin = class_name.find_first_not_of(kSpace);
  if (begin == std::string::npos) return {};
  std::string key = class_name.substr(begin, class_name.find_last_not_of(kSpace) - begin + 1);
  for (char& character : key) {
    // Not std::tolower, which depends on the locale.
    if (character >= 'A' && character <= 'Z') character = static_cast<char>(character - 'A' + 'a');
    if (character == ' ' || character == '-') character = '_';
  }
  return key;
}

}  // namespace occusg
