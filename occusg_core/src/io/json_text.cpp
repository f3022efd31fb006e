// SPDX-License-Identifier: BSD-3-Clause
#include "io/json_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <sstream>
#include <utility>

#include "occusg/error.hpp"

namespace occusg {
namespace {

using nlohmann::json;

constexpr int kMaxDepth = 32;
constexpr std::size_t kMaxQuotedText = 60;

/// A value as it stands in the file, shortened for a sentence.
std::string quoted(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  if (text.size() > kMaxQuotedText) text = text.substr(0, kMaxQuotedText) + "...";
  return text;
}

[[noreturn]] void failOnCount(const std::string& where, std::size_t max_values) {
  throw refuse(where, "holds more than " + std::to_string(max_values) + " values",
               "a smaller file is needed");
}

/// Goes through a document before anything of it is kept. Ends quietly where it is no JSON, which
/// the parser says better.
class LimitCheck {
 public:
  LimitCheck(const std::string& where, std::size_t max_values)
      : where_(where), max_values_(max_values) {}

  // The names are the library's (json_sax).
  bool null() { return count(); }
  bool boolean(bool /*value*/) { return count(); }
  bool number_integer(json::number_integer_t /*value*/) { return count(); }
  bool number_unsigned(json::number_unsigned_t /*value*/) { return count(); }
  bool number_float(json::number_float_t /*value*/, const std::string& /*text*/) { return count(); }
  bool string(std::string& /*value*/) { return count(); }
  template <typename Bytes>
  bool binary(Bytes& /*value*/) {
    return count();
  }
  bool start_object(std::size_t /*elements*/) { return open(); }
  bool key(std::string& /*value*/) { return true; }
  bool end_object() { return close(); }
  bool start_array(std::size_t /*elements*/) { return open(); }
  bool end_array() { return close(); }
  static bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                          const json::exception& /*error*/) {
    return false;
  }

 private:
  bool count() {
    if (++values_ > max_values_) failOnCount(where_, max_values_);
    return true;
  }
  bool open() {
    if (++depth_ > kMaxDepth) {
      throw refuse(where_, "is nested deeper than " + std::to_string(kMaxDepth) + " levels",
                   "a flatter file is needed");
    }
    return count();
  }
  bool close() {
    --depth_;
    return true;
  }

  const std::string& where_;
  std::size_t max_values_;
  std::size_t values_ = 0;
  int depth_ = 0;
};

std::size_t valuesIn(const json& value) {
  std::size_t count = 1;
  if (value.is_structured())
    for (const json& part : value) count += valuesIn(part);
  return count;
}

std::string lineAt(const std::string& text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return std::to_string(1 + std::count(text.begin(), end, '\n'));
}

std::string dumped(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// The parser's message without its "[json.exception...] parse error at ...: " head, which differs
/// between versions of the library.
std::string reasonOf(const json::exception& error) {
  const std::string message = error.what();
  const std::size_t head = message.find("] ");
  const std::string rest = head == std::string::npos ? message : message.substr(head + 2);
  const std::size_t colon = rest.find(": ");
  return colon == std::string::npos ? rest : rest.substr(colon + 2);
}

}  // namespace

json parseJson(const std::string& text, const std::string& where, std::size_t max_values) {
  // Not with a callback of the parser: it goes through a whole array again after each object in it.
  LimitCheck limits(where, max_values);
  (void)json::sax_parse(text, &limits);
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    const std::size_t byte = error.byte == 0 ? 0 : error.byte - 1;
    throw refuse(where + ":" + lineAt(text, byte), "is not valid JSON (" + reasonOf(error) + ")",
                 "a complete JSON document is needed");
  } catch (const json::exception& error) {
    throw refuse(where, "is not valid JSON (" + reasonOf(error) + ")",
                 "a complete JSON document is needed");
  }
}

const json& member(const json& value, const std::string& key, const std::string& where) {
  const json* found = optionalMember(value, key, where);
  if (found == nullptr) throw refuse(where, "has no \"" + key + "\"", "the key is required");
  return *found;
}

const json* optionalMember(const json& value, const std::string& key, const std::string& where) {
  if (!value.is_object()) throw refuse(where, "is " + quoted(value), "an object is needed");
  const auto found = value.find(key);
  return found == value.end() ? nullptr : &*found;
}

double numberOf(const json& value, const std::string& where) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw refuse(where, "is " + quoted(value), "a finite number is needed");
  return value.get<double>();
}

int integerOf(const json& value, const std::string& where) {
  constexpr std::int64_t kLargest = std::numeric_limits<int>::max();
  const bool fits = value.is_number_unsigned()
                        ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(kLargest)
                        : value.is_number_integer() && value.get<std::int64_t>() >= -kLargest;
  if (!fits) {
    throw refuse(where, "is " + quoted(value),
                 "an integer of at most " + std::to_string(kLargest) + " is needed");
  }
  return value.get<int>();
}

std::string stringOf(const json& value, const std::string& where) {
  if (!value.is_string()) throw refuse(where, "is " + quoted(value), "a string is needed");
  return value.get<std::string>();
}

const json& arrayOf(const json& value, const std::string& where) {
  if (!value.is_array()) throw refuse(where, "is " + quoted(value), "an array is needed");
  return value;
}

double rounded(double value, int digits) {
  if (!std::isfinite(value))
    throw refuse("output", "a value is not finite", "only finite numbers can be written");
  const double per_unit = std::pow(10.0, digits);
  // Beyond this doubles are spaced wider than the rounding.
  if (std::abs(value) * per_unit > 1e15) return value;
  return std::round(value * per_unit) / per_unit + 0.0;
}

json jsonOf(const Point2& point) { return json::array({rounded(point.x), rounded(point.y)}); }

json jsonOf(const Ring& ring) {
  json points = json::array();
  for (const Point2& point : ring) points.push_back(jsonOf(point));
  return points;
}

json holesOf(const Polygon& polygon) {
  json holes = json::array();
  for (const Ring& hole : polygon.holes) holes.push_back(jsonOf(hole));
  return holes;
}

std::string toText(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return dumped(json(value));
}

JsonStream::JsonStream(std::ostream& out, std::string where, std::size_t max_values)
    : out_(out), where_(std::move(where)), max_values_(max_values) {
  out_ << "{\n";
}

void JsonStream::beginMember(const std::string& key) {
  if (has_members_) out_ << ",\n";
  has_members_ = true;
  out_ << dumped(json(key)) << ": ";
}

void JsonStream::count(const json& value) {
  values_ += valuesIn(value);
  if (values_ > max_values_) failOnCount(where_, max_values_);
}

void JsonStream::member(const std::string& key, const json& value) {
  if (value.is_array() && !value.empty() && value.front().is_object()) {
    beginList(key);
    for (const json& object : value) element(object);
    endList();
    return;
  }
  count(value);
  beginMember(key);
  out_ << dumped(value);
}

void JsonStream::beginList(const std::string& key) {
  beginMember(key);
  ++values_;
  has_elements_ = false;
  out_ << '[';
}

void JsonStream::element(const json& object) {
  count(object);
  out_ << (has_elements_ ? ",\n  " : "\n  ") << dumped(object);
  has_elements_ = true;
}

void JsonStream::endList() { out_ << (has_elements_ ? "\n]" : "]"); }

void JsonStream::end() { out_ << (has_members_ ? "\n}\n" : "}\n"); }

std::string jsonDocument(const std::vector<std::pair<std::string, json>>& members) {
  std::ostringstream text;
  JsonStream document(text, "output");
  for (const auto& [key, value] : members) document.member(key, value);
  document.end();
  return text.str();
}

}  // namespace occusg
