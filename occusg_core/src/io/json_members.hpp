// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "io/json_text.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"

namespace occusg {

/// The members of one object of the file.
class Members {
 public:
  Members(const nlohmann::json& object, std::string where)
      : object_(object), where_(std::move(where)) {}

  [[nodiscard]] const nlohmann::json& at(const char* key) const {
    return member(object_, key, where_);
  }
  [[nodiscard]] const nlohmann::json* find(const char* key) const {
    return optionalMember(object_, key, where_);
  }
  [[nodiscard]] std::string placeOf(const char* key) const { return where_ + " " + key; }
  [[nodiscard]] const std::string& where() const { return where_; }
  [[nodiscard]] const nlohmann::json& object() const { return object_; }

  [[nodiscard]] double number(const char* key) const { return numberOf(at(key), placeOf(key)); }
  [[nodiscard]] double numberOr(const char* key, double absent) const {
    const nlohmann::json* value = find(key);
    return value == nullptr ? absent : numberOf(*value, placeOf(key));
  }
  [[nodiscard]] int integer(const char* key) const { return integerOf(at(key), placeOf(key)); }
  [[nodiscard]] int integerOr(const char* key, int absent) const {
    const nlohmann::json* value = find(key);
    return value == nullptr ? absent : integerOf(*value, placeOf(key));
  }
  [[nodiscard]] std::string text(const char* key) const { return stringOf(at(key), placeOf(key)); }

  /// The numbers of an array of that length.
  [[nodiscard]] std::vector<double> numbers(const nlohmann::json& value, const char* key,
                                            std::size_t count) const {
    if (arrayOf(value, placeOf(key)).size() != count) {
      throw refuse(placeOf(key), "has " + std::to_string(value.size()) + " values",
                   std::to_string(count) + " are needed");
    }
    std::vector<double> numbers;
    for (const nlohmann::json& number : value) numbers.push_back(numberOf(number, placeOf(key)));
    return numbers;
  }

  /// The value whose name stands there.
  template <typename Value>
  [[nodiscard]] Value named(const char* key, std::initializer_list<Value> values) const {
    return named(key, std::vector<Value>(values));
  }
  template <typename Value>
  [[nodiscard]] Value named(const char* key, const std::vector<Value>& values) const {
    const std::string name = text(key);
    std::string names;
    for (const Value value : values) {
      if (name == nameOf(value)) return value;
      names += (names.empty() ? "" : ", ") + std::string(nameOf(value));
    }
    throw refuse(placeOf(key), "is \"" + shown(name) + "\"", "one of " + names + " is needed");
  }

 private:
  const nlohmann::json& object_;
  std::string where_;
};

}  // namespace occusg
