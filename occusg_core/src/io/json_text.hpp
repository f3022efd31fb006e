// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// Reading: strict, with sentences. `where` opens every sentence: file, then the place in it.

/// Values, arrays and objects a document may hold. Who writes keeps to it as who reads.
inline constexpr std::size_t kMaxJsonValues = 2'000'000;

/// Parses a whole document; nesting and the number of values are capped, so memory stays within a
/// small multiple of the text.
/// @throws Error naming the line of the first fault.
[[nodiscard]] nlohmann::json parseJson(const std::string& text, const std::string& where,
                                       std::size_t max_values = kMaxJsonValues);

/// @throws Error unless `value` is an object that has `key`.
[[nodiscard]] const nlohmann::json& member(const nlohmann::json& value, const std::string& key,
                                           const std::string& where);
/// The member, or null when there is none.
/// @throws Error unless `value` is an object.
[[nodiscard]] const nlohmann::json* optionalMember(const nlohmann::json& value,
                                                   const std::string& key,
                                                   const std::string& where);
[[nodiscard]] double numberOf(const nlohmann::json& value, const std::string& where);
[[nodiscard]] int integerOf(const nlohmann::json& value, const std::string& where);
[[nodiscard]] std::string stringOf(const nlohmann::json& value, const std::string& where);
/// @throws Error unless `value` is an array.
[[nodiscard]] const nlohmann::json& arrayOf(const nlohmann::json& value, const std::string& where);

/// Writing: equal values give equal bytes.

/// `value` rounded to 1e-4 (or to `digits` decimals), never minus zero.
/// @throws Error when not finite: it would not read back.
[[nodiscard]] double rounded(double value, int digits = 4);
[[nodiscard]] nlohmann::json jsonOf(const Point2& point);
[[nodiscard]] nlohmann::json jsonOf(const Ring& ring);
/// The holes of a polygon, each as `jsonOf` of its ring.
[[nodiscard]] nlohmann::json holesOf(const Polygon& polygon);
/// Shortest text that reads back as `value`; "nan", "inf" or "-inf" for what JSON cannot hold.
[[nodiscard]] std::string toText(double value);

/// Writes one object as it is made, so that a large one never stands in memory: a member a line in
/// the given order, and an element a line in a list. Bytes that are not UTF-8 become U+FFFD.
class JsonStream {
 public:
  /// @param where opens the sentence when there are more than `max_values`.
  JsonStream(std::ostream& out, std::string where, std::size_t max_values = kMaxJsonValues);

  /// @throws Error when the document holds more values than a reader takes; so does `element`.
  void member(const std::string& key, const nlohmann::json& value);
  /// A member that is an array of objects, given one after another.
  void beginList(const std::string& key);
  void element(const nlohmann::json& object);
  void endList();
  /// Nothing may follow.
  void end();

 private:
  void beginMember(const std::string& key);
  void count(const nlohmann::json& value);

  std::ostream& out_;
  std::string where_;
  std::size_t max_values_;
  std::size_t values_ = 1;
  bool has_members_ = false;
  bool has_elements_ = false;
};

/// One object, a member a line in the given order, and an element a line in a member that is an
/// array of objects, so that people can read it and diff it. Ends with a newline. Bytes that are
/// not UTF-8 become U+FFFD.
[[nodiscard]] std::string jsonDocument(
    const std::vector<std::pair<std::string, nlohmann::json>>& members);

}  // namespace occusg
