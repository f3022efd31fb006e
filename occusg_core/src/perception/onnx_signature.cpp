// SPDX-License-Identifier: BSD-3-Clause
#include "perception/onnx_signature.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>

namespace occusg {
namespace {

/// Far more than any model has; what comes after is not read.
constexpr std::size_t kMaxTensors = 100'000;
constexpr std::size_t kMaxDimensions = 16;

/// A field of a protocol buffer message.
struct Field {
  std::uint64_t number = 0;
  std::uint64_t integer = 0;  ///< Of wire type 0.
  std::string_view bytes;     ///< Of wire type 2: a text or an inner message.
};

/// Goes through the fields of a message (protocol buffers, "Encoding").
class Message {
 public:
  explicit Message(std::string_view bytes) : rest_(bytes) {}

  /// Nothing at the end of the message, or where it is broken.
  std::optional<Field> next() {
    if (rest_.empty()) return std::nullopt;
    const std::uint64_t key = varint();
    Field field;
    field.number = key >> 3U;
    switch (key & 7U) {
      case 0:
        field.integer = varint();
        break;
      case 1:
        (void)take(8);
        break;
      case 2:
        field.bytes = take(varint());
        break;
      case 5:
        (void)take(4);
        break;
      default:
        broken_ = true;
    }
    if (field.number == 0) broken_ = true;
    if (broken_) return std::nullopt;
    return field;
  }

  [[nodiscard]] bool broken() const { return broken_; }

 private:
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64 && !rest_.empty(); shift += 7) {
      const auto byte = static_cast<unsigned char>(rest_.front());
      rest_.remove_prefix(1);
      value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
      if (byte < 0x80U) return value;
    }
    broken_ = true;
    return 0;
  }

  std::string_view take(std::uint64_t size) {
    if (size > rest_.size()) broken_ = true;
    const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(size));
    rest_.remove_prefix(taken.size());
    return taken;
  }

  std::string_view rest_;
  bool broken_ = false;
};

/// The last field of that number, as protocol buffers want it; empty when there is none.
std::string_view inner(std::string_view message, std::uint64_t number) {
  std::string_view found;
  Message fields(message);
  while (const auto field = fields.next())
    if (field->number == number) found = field->bytes;
  return found;
}

/// TensorShapeProto: dim = 1; of a dimension dim_value = 1.
std::vector<std::int64_t> shapeOf(std::string_view tensor_shape) {
  std::vector<std::int64_t> shape;
  Message dimensions(tensor_shape);
  while (const auto dimension = dimensions.next()) {
    if (dimension->number != 1 || shape.size() >= kMaxDimensions) continue;
    std::int64_t size = 0;
    Message fields(dimension->bytes);
    while (const auto field = fields.next())
      if (field->number == 1) size = static_cast<std::int64_t>(field->integer);
    shape.push_back(size);
  }
  return shape;
}

/// ValueInfoProto: name = 1, type = 2; of the type tensor_type = 1; of that shape = 2.
OnnxTensor tensorOf(std::string_view value_info) {
  return {std::string(inner(value_info, 1)), shapeOf(inner(inner(inner(value_info, 2), 1), 2))};
}

}  // namespace

std::optional<OnnxSignature> readOnnxSignature(const std::string& bytes) {
  // ModelProto: graph = 7.
  Message model(bytes);
  std::string_view graph;
  while (const auto field = model.next())
    if (field->number == 7) graph = field->bytes;
  if (model.broken() || graph.empty()) return std::nullopt;

  // GraphProto: initializer = 5 (a TensorProto, name = 8), input = 11, output = 12.
  OnnxSignature signature;
  std::set<std::string> weights;
  Message fields(graph);
  while (const auto field = fields.next()) {
    if (field->number == 5 && weights.size() < kMaxTensors) weights.emplace(inner(field->bytes, 8));
    if (field->number == 11 && signature.inputs.size() < kMaxTensors)
      signature.inputs.push_back(tensorOf(field->bytes));
    if (field->number == 12 && signature.outputs.size() < kMaxTensors)
      signature.outputs.push_back(tensorOf(field->bytes));
  }
  if (fields.broken() || signature.outputs.empty()) return std::nullopt;
  // Models of the first IR versions list their weights among the inputs.
  const auto is_weight = [&](const OnnxTensor& input) { return weights.count(input.name) > 0; };
  signature.inputs.erase(
      std::remove_if(signature.inputs.begin(), signature.inputs.end(), is_weight),
      signature.inputs.end());
  return signature;
}

}  // namespace occusg
